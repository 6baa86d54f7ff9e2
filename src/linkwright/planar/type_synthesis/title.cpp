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
  return family == MachineFamily::watt_1         ? "Watt I"
         : family == MachineFamily::stephenson_1 ? "Stephenson I"
                                                 : "Stephenson III";
}

}  // namespace

std::string title_of(const PointProgram& program) {
  const char* bar = program.trace_second ? "second" : "first";
  switch (program.family) {
    case MachineFamily::four_bar:
      return "Four-bar linkage, traced point on the coupler";
    case MachineFamily::slider_crank:
      return "Slider-crank, traced point on the connecting rod";
    case MachineFamily::inverted_slider:
      return "Inverted slider-crank, traced point on the rod through the swinging sleeve";
    case MachineFamily::geared_five_bar:
      return fmt::format(
          "Five-bar linkage with cranks geared 1 to {}, traced point on the bar at the first crank",
          program.gear_ratio);
    case MachineFamily::watt_1:
    case MachineFamily::stephenson_1:
    case MachineFamily::stephenson_3:
      return fmt::format("{} six-bar linkage{}, traced point on the {} bar of the second pair",
                         six_bar_of(program.family),
                         has_ternary_crank(program) ? " with a ternary crank" : "", bar);
    case MachineFamily::eight_bar:
    case MachineFamily::ten_bar:
      break;
  }
  return fmt::format("{} linkage {}, traced point on the {} bar of the last pair",
                     program.family == MachineFamily::eight_bar ? "Eight-bar" : "Ten-bar",
                     links_of_pairs(program), bar);
}

std::string short_name_of(const PointProgram& program) {
  const char bar = program.trace_second ? 'b' : 'a';
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
    case MachineFamily::stephenson_3:
      return fmt::format("{} {} {}", six_bar_of(program.family), links_of_pairs(program), bar);
    case MachineFamily::eight_bar:
    case MachineFamily::ten_bar:
      break;
  }
  return fmt::format("{} {} {}", program.family == MachineFamily::eight_bar ? "eight-bar" : "ten-bar",
                     links_of_pairs(program), bar);
}

}  // namespace linkwright::planar
