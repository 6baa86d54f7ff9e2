// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/published_targets.h"

#include <cmath>
#include <string>

#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"

namespace linkwright::suspension {
namespace {

/// Coefficients c1 ... c14, c0 of x1^4, x1^3 x2, ..., x2^4, x1^3, ..., x2^3, x1^2, x1 x2, x2^2, x1, x2, 1, x1
/// the travel and x2 the rack (m); toe and camber in rad.
using Polynomial = std::array<double, 15>;
constexpr Polynomial toe_targets{-56.8157, -206.172, -414.478,  -412.571, -1672.94,
                                 10.1499,  25.3615,  19.2855,   217.48,   -2.259,
                                 0.560529, -3.88192, 0.0240037, 6.34032,  0.00500037};
constexpr Polynomial camber_targets{-16.7587,  25.2388,  104.936,  38.7101,   197.41,
                                    1.80886,   -1.13993, -6.08698, -25.026,   -1.16772,
                                    -0.775725, 0.945156, 0.112717, -0.172086, 0.00500037};
constexpr Polynomial relative_track_targets{-3.40506, -24.9132, -78.0012,  -42.2912, -214.783,
                                            0.762582, 4.49888,  5.42728,   19.2137,  -1.74714,
                                            0.514008, -2.78094, 0.0237093, 0.118886, 0};

TargetObjective objective(const char* name, WheelQuantity quantity, const Polynomial& targets) {
  TargetCurve curve{.quantity = quantity, .measure = TargetMeasure::value, .reference = {}, .points = {}};
  const auto add = [&](double travel, double rack) {
    curve.points.push_back({.input = {travel, rack}, .value = quartic(targets, travel, rack)});
  };
  for (int i = -4; i <= 4; ++i) add(0.025 * i, 0);
  for (const int i : {-3, -2, -1, 1, 2, 3}) add(0, 0.025 * i);
  return {name, {std::move(curve)}};
}

/// 0.05 deg up to 2 deg, then 0.025 deg more a degree.
void set_angle_tolerances(TargetObjective& of) {
  const ToleranceRule rule{math::radians(0.05), 0.025, math::radians(2)};
  for (TargetPoint& p : of.curves[0].points) p.tolerance = tolerance_of(rule, p.value);
}

}  // namespace

DirectTask published_direct_task() {
  DirectTask task;
  const Vec3 centre{0.001, 0.747, 0.0006}, axis = unit(centre - Vec3{0.0005, 0.647, 0.0011});
  task.suspension.wheel = {centre, std::atan2(axis.x, axis.y), -std::asin(axis.z), 0.604};
  const std::array<Vec3, 5> body{{{0.1441, 0.3452, -0.0922},
                                  {-0.2292, 0.3622, -0.1017},
                                  {-0.102012769207, 0.399822349681, 0.305914089595},
                                  {-0.082881868731, 0.398796048098, 0.41269681505},
                                  {0.115100628874, 0.420916540058, 0.413010307388}}};
  const std::array<Vec3, 5> carrier{{{0.0287, 0.6909, -0.098},
                                     {-0.0244, 0.687, -0.1316},
                                     {-0.1357, 0.6171, 0.2869},
                                     {-0.0181, 0.6398, 0.3884},
                                     {0.0154, 0.6733, 0.3895}}};
  const std::array<double, 5> length{norm(carrier[0] - body[0]), norm(carrier[1] - body[1]), 0.2209, 0.25,
                                     0.273};
  for (std::size_t i = 0; i < 5; ++i)
    task.suspension.links.push_back({.name = "link " + std::to_string(i + 1),
                                     .type = LinkType::US,
                                     .body = {body[i]},
                                     .carrier = {carrier[i]},
                                     .length = length[i],
                                     .moved_by_rack = i == 2});
  task.objectives = {objective("toe", WheelQuantity::toe, toe_targets),
                     objective("camber", WheelQuantity::camber, camber_targets),
                     objective("track", WheelQuantity::track, relative_track_targets)};
  set_angle_tolerances(task.objectives[0]);
  set_angle_tolerances(task.objectives[1]);
  TargetCurve& track = task.objectives[2].curves[0];
  track.measure = TargetMeasure::relative_change;
  double largest = 0;
  for (const TargetPoint& p : track.points) largest = std::max(largest, std::abs(p.value));
  for (TargetPoint& p : track.points) p.tolerance = 0.05 * largest;
  return task;
}

void place_published_boxes(DirectTask& task, std::uint64_t seed) {
  constexpr double edge = 0.150;
  RandomStream random({seed, 5});
  task.designed.clear();
  for (int link = 2; link < 5; ++link)
    for (int axis = 0; axis < 3; ++axis) {
      const DesignNumber number{DesignKind::body, link, 0, axis};
      const double middle = design_value(task.suspension, number) + random.uniform(-edge / 2, edge / 2);
      task.designed.push_back({number, middle - edge / 2, middle + edge / 2});
    }
}

}  // namespace linkwright::suspension
