// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/path.h"

#include <fmt/core.h>

#include <cmath>

namespace linkwright::parallel {

std::string step_name(const ToolPath& path, int step) {
  const std::string_view kind =
      std::visit([](const auto& s) { return choice_word(s).name; }, path.steps.at(step).form);
  return fmt::format("step {} ({})", step + 1, kind);
}

std::optional<ToolProblem> problem(const ToolLimits& limits) {
  struct Limit {
    std::string_view key;
    double value;
    std::string_view unit;
  };
  for (const auto& [key, value, unit] : {Limit{"speed", limits.speed, "m/s"},
                                         {"acceleration", limits.acceleration, "m/s2"},
                                         {"jerk", limits.jerk, "m/s3"},
                                         {"angular_speed", limits.angular_speed, "rad/s"},
                                         {"angular_acceleration", limits.angular_acceleration, "rad/s2"},
                                         {"angular_jerk", limits.angular_jerk, "rad/s3"}})
    if (!(value > 0) || !std::isfinite(value))
      return ToolProblem{
          -1,
          key,
          fmt::format("the limit {} is {:g} {}, must be more than 0 and finite", key, value, unit),
          {}};
  return {};
}

}  // namespace linkwright::parallel
