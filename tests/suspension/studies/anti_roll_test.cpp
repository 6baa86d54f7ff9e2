// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/anti_roll.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "linkwright/suspension/wheel/axle.h"
#include "suspension/pushrod_corner.h"
#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

using test::column;
using test::pushrod_study;
using test::replaced;
using test::run_text;

/// The corner with a T bar in place of the U bar: its post lies along -x.
const std::string t_bar_study = replaced(pushrod_study, "axis_mm     = [[120, 0, 250], [120, 100, 250]]",
                                         "shape = \"T\"\naxis_mm = [[200, 0, 250], [20, 0, 260]]");

/// The twist of that bar by the rocker angles of both wheels, which turn about -x: Newton's method with
/// differences, the crossbar turned about its post by Rodrigues' formula.
double twist_by_distances(double left, double right) {
  const auto droplink = [](double angle, double side) {  // (170, 470) about (200, 430) in y and z
    const double y = 0.17 - 0.2, z = 0.47 - 0.43;
    return Vec3{0.02, side * (0.2 + y * std::cos(angle) + z * std::sin(angle)),
                0.43 - y * std::sin(angle) + z * std::cos(angle)};
  };
  const Vec3 foot{0.2, 0, 0.25}, post = unit(Vec3{-0.18, 0, 0.01});
  const auto miss = [&](double tilt, double twist, double side) {
    const Vec3 r = Vec3{0.02, side * 0.17, 0.25} - foot;
    const Vec3 t = std::cos(twist) * r + std::sin(twist) * cross(post, r) +
                   ((1 - std::cos(twist)) * dot(post, r)) * post;
    const Vec3 end = foot + Vec3{std::cos(tilt) * t.x + std::sin(tilt) * t.z, t.y,
                                 -std::sin(tilt) * t.x + std::cos(tilt) * t.z};
    return norm(droplink(side > 0 ? left : right, side) - end) - 0.22;
  };
  double tilt = 0, twist = 0;
  for (int i = 0; i < 30; ++i) {
    const double h = 1e-6, a = miss(tilt, twist, 1), b = miss(tilt, twist, -1);
    const double at = (miss(tilt + h, twist, 1) - miss(tilt - h, twist, 1)) / (2 * h),
                 aw = (miss(tilt, twist + h, 1) - miss(tilt, twist - h, 1)) / (2 * h),
                 bt = (miss(tilt + h, twist, -1) - miss(tilt - h, twist, -1)) / (2 * h),
                 bw = (miss(tilt, twist + h, -1) - miss(tilt, twist - h, -1)) / (2 * h),
                 det = at * bw - aw * bt;
    tilt -= (a * bw - b * aw) / det;
    twist -= (at * b - bt * a) / det;
  }
  return twist;
}

TEST(AntiRoll, TBarByItsEnergy) {
  const study::Result result = run_text(t_bar_study + "[axle.opposite]\nvalues_mm = [-10, 0, 10]\n");
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  const AxlePlan axle = prepare_axle(pushrod_corner());
  const AxlePosition reference = reference_position(axle);
  const auto twist = [&](double l, double r) {
    const AxlePosition at = solve_axle(axle, {Driver::wheel_centre_z, l, r, 0}, reference);
    EXPECT_EQ(at.status, Status::done);
    return twist_by_distances(rocker_states(axle.left, at.left.place, 0)[0].angle,
                              rocker_states(axle.right, at.right.place, 0)[0].angle);
  };
  const auto energy = [&](double l, double r) { return 1200 * std::pow(twist(l, r), 2) / 2; };
  const auto slope = [](double step, auto&& of) {
    return (8 * (of(step) - of(-step)) - (of(2 * step) - of(-2 * step))) / (12 * step);
  };
  const auto second = [](double step, auto&& of) {
    return (16 * (of(step) + of(-step)) - (of(2 * step) + of(-2 * step)) - 30 * of(0)) / (12 * step * step);
  };
  const Table& table = *result.table("opposite");
  const auto at = [&](std::string_view key, std::size_t row) { return table.find(key)->values.at(row); };
  for (const std::size_t row : {0U, 1U, 2U}) {
    const double z = 0.01 * (static_cast<double>(row) - 1);
    EXPECT_NEAR(at("twist_rad", row), twist(z, -z), 1e-11);
    EXPECT_NEAR(at("left_anti_roll_bar_force_N", row),
                slope(4e-4, [&](double d) { return energy(z + d, -z); }), 1e-5);
    EXPECT_NEAR(at("right_anti_roll_bar_force_N", row),
                slope(4e-4, [&](double d) { return energy(z, -z + d); }), 1e-5);
    EXPECT_NEAR(at("anti_roll_bar_wheel_rate_N_per_m", row) + at("anti_roll_bar_geometric_rate_N_per_m", row),
                second(1e-3, [&](double d) { return energy(z + d, -z - d); }) / 2, 0.01);
  }
  EXPECT_EQ(table.find("left_anti_roll_bar_angle_rad"), nullptr);
  EXPECT_NEAR(at("anti_roll_bar_tilt_rad", 1), 0, 1e-12);
  // From equal travels, at each of which the post is tilted and not twisted.
  for (const std::size_t row : {0U, 2U, 4U}) {
    const double z = std::array{-0.03, -0.015, 0.0, 0.015, 0.03}.at(row);
    EXPECT_NEAR(column(result, "anti_roll_bar_wheel_rate_N_per_m").at(row),
                second(1e-3, [&](double d) { return energy(z + d, z - d); }) / 2, 0.01);
  }
  // The study as written, and that of the right wheel.
  std::string messages;
  const auto study = test::prepare(t_bar_study, messages);
  ASSERT_TRUE(study) << messages;
  EXPECT_EQ(study->canonical.find("mechanism")->find("anti_roll_bar")->find("shape")->as_string(), "T");
  const study::Result right =
      run_text(replaced(test::pushrod_text(Side::right), "axis_mm     = [[120, -0, 250], [120, -100, 250]]",
                        "shape = \"T\"\naxis_mm = [[200, 0, 250], [20, 0, 260]]"));
  for (const char* key : {"anti_roll_bar_wheel_rate_N_per_m", "anti_roll_bar_angle_rad"})
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(column(right, key).at(i), column(result, key).at(i),
                  1e-9 * (1 + std::abs(column(result, key).at(i))))
          << key;
}

}  // namespace
}  // namespace linkwright::suspension
