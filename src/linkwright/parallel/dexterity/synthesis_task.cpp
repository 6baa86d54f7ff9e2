// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/dexterity/synthesis.h"

namespace linkwright::parallel {
namespace {

constexpr double right = pi / 2;

std::optional<std::string> range_problem(std::string_view name, const DesignRange& range, double least) {
  if (!(range.lower >= least && range.upper >= range.lower && std::isfinite(range.upper)))
    return fmt::format("{}: {} to {}", name, range.lower, range.upper);
  return {};
}

std::optional<std::string> share_problem(std::string_view name, double value) {
  if (!(value >= 0 && value <= 1)) return fmt::format("limit of {}: {} is not in [0, 1]", name, value);
  return {};
}

std::optional<std::string> positive_problem(std::string_view name, double value, double least = 0) {
  if (!(value > least)) return fmt::format("limit of {}: {} is not above {}", name, value, least);
  return {};
}

std::optional<std::string> pi_problem(const PiTravelTask& travel) {
  const PiRequirements& l = travel.limits;
  if (const auto p = range_problem("mounting of the Pi-joints", travel.mounting, -HUGE_VAL)) return p;
  if (const auto p = range_problem("ratio of the Pi-joints", travel.ratio, 1e-3)) return p;
  if (travel.mirror != 1 && travel.mirror != -1)
    return fmt::format("mirror is 1 or -1, not {}", travel.mirror);
  if (!(l.end_margin > 0 && l.end_margin < right))
    return fmt::format("margin to +-90 deg: {} rad is not in (0, pi/2)", l.end_margin);
  if (!(l.transmission >= 0 && l.transmission < right))
    return fmt::format("limit of the transmission angle: {} rad is not in [0, pi/2)", l.transmission);
  if (const auto p = positive_problem("telescoping", l.telescoping, 1)) return p;
  if (const auto p = positive_problem("stroke", l.stroke)) return p;
  if (const auto p = positive_problem("the screw's force", l.force_limit)) return p;
  if (const auto p = positive_problem("the screw's rate", l.rate_limit)) return p;
  if (const auto p = positive_problem("resolution", l.resolution)) return p;
  for (const auto& [name, value] :
       {std::pair{"torque", l.torque}, {"speed", l.speed}, {"quantum", l.quantum}})
    if (!(value >= 0 && std::isfinite(value))) return fmt::format("{} of the Pi-joints: {}", name, value);
  return {};
}

}  // namespace

bool size_is_limited(const DexterityLimits& l) {
  return l.conditioning > 0 || l.transmission > 0 || (l.input > 0 && l.output > 0);
}

std::optional<std::string> problem(const DexterityTask& task) {
  const auto family = dimensions(task.family);
  if (task.dimensions.size() != family.size())
    return fmt::format("{} ranges for {} dimensions of a {}", task.dimensions.size(), family.size(),
                       name_of(task.family));
  for (std::size_t j = 0; j < family.size(); ++j) {
    const bool member = family[j].name == "arm" || family[j].name == "rod";
    // A member of no length is no member.
    if (const auto p = range_problem(family[j].name, task.dimensions[j], member ? 1e-6 : -HUGE_VAL)) return p;
  }
  const std::string region = problem(task.region);
  if (!region.empty()) return "region: " + region;
  if (is_planar(task.region.shape) != (task.family == RobotFamily::five_bar))
    return fmt::format("a {} cannot serve a {}", name_of(task.family), name_of(task.region.shape));
  const bool turns = task.family == RobotFamily::hexa;
  const bool level = task.orientations.size() == 1 && task.orientations[0] == Mat3{};
  if (task.orientations.empty()) return "no orientation of the platform";
  if (!turns && !level) return fmt::format("the platform of a {} does not turn", name_of(task.family));
  if (task.region.symmetric && !level) return "a turned platform needs all of the region: it has no symmetry";
  if (!(task.length > 0)) return fmt::format("characteristic length = {} m", task.length);
  const DexterityLimits& l = task.limits;
  if (const auto p = share_problem("conditioning", l.conditioning)) return p;
  if (const auto p = share_problem("constraint", l.constraint)) return p;
  if (task.goal == DexterityGoal::size && !size_is_limited(l))
    return "the smallest robot without limits is singular: give a limit of conditioning, of transmission, or "
           "of both "
           "input and output";
  if (const auto p = share_problem("input", l.input)) return p;
  if (const auto p = share_problem("output", l.output)) return p;
  if (const auto p = share_problem("transmission", l.transmission)) return p;
  if (const auto p = positive_problem("arm travel", l.arm_travel)) return p;
  if (const auto p = positive_problem("size", l.size)) return p;
  if (!(l.side_swing > 0 && l.side_swing <= right))
    return fmt::format("limit of side swing: {} rad is not in (0, pi/2]", l.side_swing);
  if (task.pi_joint) return pi_problem(*task.pi_joint);
  return {};
}

}  // namespace linkwright::parallel
