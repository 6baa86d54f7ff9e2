// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/detail/finding_words.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::planar {
namespace {

std::string in_degrees(double angle) { return fmt::format("{:.6g}°", math::degrees(angle)); }
std::string of_follower(double value, bool rotary) {
  return rotary ? in_degrees(value) : fmt::format("{:.6g} mm", value * 1e3);
}

}  // namespace

FindingWords words_for(const ProgrammeFinding& f, bool rotary) {
  switch (f.issue) {
    case ProgrammeIssue::no_motion:
      return {
          "",
          "the programme is not a motion: a table needs increasing angles from 0, a polynomial conditions "
          "that it can meet",
          "write [[mechanism.segment]] with law, over_deg and to_mm or to_deg"};
    case ProgrammeIssue::segments_do_not_fill:
      return {"segment",
              fmt::format("the programme covers {} of the turn of {}", in_degrees(2 * pi - f.size),
                          in_degrees(2 * pi)),
              f.size > 0 ? fmt::format("add {}, or write sector = true", in_degrees(f.size))
                         : fmt::format("take {} away", in_degrees(-f.size))};
    case ProgrammeIssue::does_not_close:
      return {"segment",
              fmt::format("the programme ends {} {} its start", of_follower(std::abs(f.size), rotary),
                          f.size > 0 ? "above" : "below"),
              "end the last segment at the start value, or write sector = true"};
    case ProgrammeIssue::jump_of_value:
      return {"segment",
              fmt::format("the follower would jump by {} at {}", of_follower(std::abs(f.size), rotary),
                          in_degrees(f.angle)),
              "let each segment begin where the one before it ends"};
    case ProgrammeIssue::jump_of_rate:
      return {"segment",
              fmt::format("the speed of the follower would jump by {} per radian of the cam at {}",
                          of_follower(std::abs(f.size), rotary), in_degrees(f.angle)),
              "take laws that start and end at rest, such as cycloidal, or a polynomial with these rates"};
    case ProgrammeIssue::jump_of_acceleration:
    case ProgrammeIssue::jump_of_jerk:
      break;
  }
  return {};
}

}  // namespace linkwright::planar
