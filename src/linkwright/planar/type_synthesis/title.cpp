// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/title.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace linkwright::planar {
namespace {

/// The links that the pairs after the first join: "13-15".
std::string links_of_pairs(const PointProgram& program) {
  std::string out;
  for (std::size_t k = 1; k < program.pairs.size(); ++k)
    out += fmt::format("{}{}{}", out.empty() ? "" : "-", program.pairs[k][0], program.pairs[k][1]);
  return out;
}

/// True for a Watt I whose crank has three pins.
bool has_ternary_crank(const PointProgram& program) {
  return program.family == MachineFamily::watt_1 &&
         std::find(program.pairs[1].begin(), program.pairs[1].end(), 1) != program.pairs[1].end();
}

std::string_view six_bar_of(MachineFamily family) {
  switch (family) {
    case MachineFamily::watt_1:
      return "Watt I";
    case MachineFamily::watt_2:
      return "Watt II";
    case MachineFamily::stephenson_1:
      return "Stephenson I";
    case MachineFamily::stephenson_2:
      return "Stephenson II";
    default:
      return "Stephenson III";
  }
}

/// The machine without its output.
std::string machine_of(const PointProgram& program) {
  switch (program.family) {
    case MachineFamily::four_bar:
      return "Four-bar linkage";
    case MachineFamily::slider_crank:
      return "Slider-crank";
    case MachineFamily::inverted_slider:
      return "Inverted slider-crank";
    case MachineFamily::geared_five_bar:
      return fmt::format("Five-bar linkage with cranks geared 1 to {}", program.gear_ratio);
    case MachineFamily::watt_1:
    case MachineFamily::watt_2:
    case MachineFamily::stephenson_1:
    case MachineFamily::stephenson_2:
    case MachineFamily::stephenson_3:
      return fmt::format("{} six-bar linkage{}", six_bar_of(program.family),
                         has_ternary_crank(program) ? " with a ternary crank" : "");
    case MachineFamily::eight_bar:
    case MachineFamily::ten_bar:
      break;
  }
  return fmt::format("{} linkage {}", program.family == MachineFamily::eight_bar ? "Eight-bar" : "Ten-bar",
                     links_of_pairs(program));
}

std::string traced_bar_of(const PointProgram& program) {
  const char* bar = program.trace_second ? "second" : "first";
  switch (program.family) {
    case MachineFamily::four_bar:
      return "the coupler";
    case MachineFamily::slider_crank:
      return "the connecting rod";
    case MachineFamily::inverted_slider:
      return "the rod through the swinging sleeve";
    case MachineFamily::geared_five_bar:
      return "the bar at the first crank";
    case MachineFamily::stephenson_2:
      return program.traced_bar == 3 ? "the ternary link at the crank" : "a binary bar";
    case MachineFamily::eight_bar:
    case MachineFamily::ten_bar:
      return fmt::format("the {} bar of the last pair", bar);
    default:
      return fmt::format("the {} bar of the second pair", bar);
  }
}

}  // namespace

std::string title_of(const PointProgram& program) {
  const std::string machine = machine_of(program);
  switch (program.output) {
    case MachineOutput::point:
      return fmt::format("{}, traced point on {}", machine, traced_bar_of(program));
    case MachineOutput::angle:
      return fmt::format("{}, output by {}", machine,
                         program.family == MachineFamily::inverted_slider ? "its swinging sleeve"
                         : program.family == MachineFamily::four_bar      ? "its rocker"
                                                                          : "its last link on the ground");
    case MachineOutput::slide:
      return program.family == MachineFamily::eight_bar
                 ? fmt::format("{}, output by a slider on {}", machine, traced_bar_of(program))
                 : fmt::format("{}, output by its slider", machine);
  }
  return machine;
}

std::string short_name_of(const PointProgram& program) {
  const bool traces = program.output == MachineOutput::point;
  const bool on_bar =
      traces || (program.output == MachineOutput::slide && program.family == MachineFamily::eight_bar);
  const bool second = program.group >= 0 ? program.traced_bar == 4 : program.trace_second;
  const std::string_view bar = !on_bar ? "" : second ? " b" : " a";
  const std::string_view end = program.output == MachineOutput::slide ? " with slider" : "";
  switch (program.family) {
    case MachineFamily::four_bar:
      return "four-bar";
    case MachineFamily::slider_crank:
      return "slider-crank";
    case MachineFamily::inverted_slider:
      return "inverted slider-crank";
    case MachineFamily::geared_five_bar:
      return fmt::format("geared five-bar 1:{}", program.gear_ratio);
    case MachineFamily::watt_1:
    case MachineFamily::stephenson_1:
      return fmt::format("{} {}{}", six_bar_of(program.family), links_of_pairs(program), bar);
    case MachineFamily::watt_2:
    case MachineFamily::stephenson_2:
    case MachineFamily::stephenson_3:
      if (traces && program.group < 0)
        return fmt::format("{} {}{}", six_bar_of(program.family), links_of_pairs(program), bar);
      return fmt::format("{}{}{}", six_bar_of(program.family), bar, end);
    case MachineFamily::eight_bar:
    case MachineFamily::ten_bar:
      break;
  }
  return fmt::format("{} {}{}{}", program.family == MachineFamily::eight_bar ? "eight-bar" : "ten-bar",
                     links_of_pairs(program), bar, end);
}

}  // namespace linkwright::planar
