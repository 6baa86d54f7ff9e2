#pragma once

#include <string>
#include <vector>

#include "linkwright/core/random.h"
#include "linkwright/suspension/direct_synthesis.h"
#include "tests/suspension/guides.h"

namespace linkwright::suspension::test {

/// Example 5 of Poznanovic 2016: a front five-link guide whose body points 3, 4 and 5 are to be found, with
/// ranges about the optimum that is known. Objectives toe, camber and relative track.
inline DirectTask example_5() {
  using testing::at, testing::numbers;
  const Value& given = at(published("ex5-targets"), "inputs");
  const Value& targets = at(published("ex5-targets"), "computed");
  DirectTask task;
  const Vec3 u = point(at(given, "wheel_axis"));
  task.guide.wheel = {point(at(given, "wheel_centre_m")), std::atan2(u.x, u.y), -std::asin(u.z),
                      testing::number_at(given, "tyre_diameter_m")};
  const auto carrier = at(given, "carrier_points_11_to_15_m").as_array();
  const auto body = at(given, "body_points_01_02_m").as_array();
  const auto optimum = at(published("ex5-minmax-optimum"), "computed.points_03_04_05_m").as_array();
  const std::vector<double> lengths = numbers(at(given, "lengths_1_to_5_m"));
  for (int i = 0; i < 5; ++i)
    task.guide.links.push_back({.name = "link " + std::to_string(i + 1),
                                .type = LinkType::KS,
                                .body = {point(i < 2 ? body[i] : optimum[i - 2])},
                                .carrier = {point(carrier[i])},
                                .length = lengths[i],
                                .moved_by_rack = i == 2});
  const std::vector<double> travel = numbers(at(given, "dz_m")), rack = numbers(at(given, "rack_m"));
  const auto objective = [&](const char* name, WheelQuantity quantity, const char* values,
                             const char* tolerances) {
    TargetCurve curve{.quantity = quantity};
    const std::vector<double> value = numbers(at(targets, values));
    for (std::size_t i = 0; i < travel.size(); ++i)
      curve.points.push_back({.input = {travel[i], rack[i]},
                              .value = value[i],
                              .tolerance = std::string(tolerances) == "tolerance_track"
                                               ? testing::number_at(targets, tolerances)
                                               : numbers(at(targets, tolerances))[i]});
    task.objectives.push_back({name, {curve}});
  };
  objective("toe", WheelQuantity::toe, "toe_rad", "tolerance_toe_rad");
  objective("camber", WheelQuantity::camber, "camber_rad", "tolerance_camber_rad");
  objective("track", WheelQuantity::track, "relative_track", "tolerance_track");
  task.objectives[2].curves[0].measure = TargetMeasure::relative_change;
  return task;
}

/// Gives the body points 3, 4 and 5 boxes of 150 mm, placed at random around the optimum.
inline void place_boxes(DirectTask& task, std::uint64_t seed) {
  RandomStream random({seed, 5});
  task.designed.clear();
  for (int link = 2; link < 5; ++link)
    for (int axis = 0; axis < 3; ++axis) {
      const DesignNumber number{DesignKind::body, link, 0, axis};
      const double middle = at(task.guide, number) + random.uniform(-0.075, 0.075);
      task.designed.push_back({number, middle - 0.075, middle + 0.075});
    }
}

/// The guide with other body points 3, 4 and 5.
inline WheelGuide with_points(const DirectTask& task, const Value& points) {
  WheelGuide out = task.guide;
  for (int i = 0; i < 3; ++i) out.links[2 + i].body[0] = point(points.as_array()[i]);
  return out;
}

}  // namespace linkwright::suspension::test
