// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/motion_target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "linkwright/planar/type_synthesis/search.h"
#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

/// The curve of a machine over a part of its turn, placed elsewhere, and its crank rotations.
Stroke curve_of(const char* program, double turned, std::vector<double>& rotations) {
  const MachineShape shape = test::some_shape(*program_named(program), 11);
  constexpr int count = 240;
  std::vector<double> angles;
  rotations.clear();
  for (int k = 0; k < count; ++k) {
    rotations.push_back(turned * k / count);
    angles.push_back(1.3 + rotations.back());
  }
  Stroke out{.closed = turned > 6};
  for (const auto& p : test::traced(shape, angles))
    out.points.push_back(std::polar(0.8, 2.1) * p + std::complex<double>(-4, 2));
  return out;
}

TEST(TimedStrokes, TurnOnWithTheArcLength) {
  const Stroke stroke{.points = {{0, 0}, {1, 0}, {1, 3}, {0, 3}}, .closed = false};
  const MotionTarget target = timed_stroke(stroke, std::vector<double>{0.5, -0.5, -1.0, -3.5});
  EXPECT_TRUE(target.timed);
  EXPECT_DOUBLE_EQ(target.turn.front(), 0);
  EXPECT_DOUBLE_EQ(target.turn.back(), 4);
  // A fifth of the samples is on the first side.
  EXPECT_NEAR(target.turn[19], 1.0, 1e-12);
  EXPECT_NEAR(target.turn[76], 1.5, 1e-12);
}

TEST(TimedStrokes, AreMetAtTheirTimes) {
  for (const double turned : {4.0, 2 * pi}) {
    std::vector<double> rotations;
    const Stroke stroke = curve_of("four_bar", turned, rotations);
    const MotionTarget target = timed_stroke(stroke, rotations);
    RunContext context;
    const auto answer =
        search_types(target,
                     {.families = {MachineFamily::four_bar},
                      .limits = {.min_pair_angle = 0.05, .min_length = 1e-3, .max_length = 100},
                      .max_curves = 60'000},
                     context);
    ASSERT_FALSE(answer.machines.empty());
    const FoundMachine& best = answer.machines[0];
    EXPECT_LT(best.measures.error, 2e-3);
    for (std::size_t k = 0; k < stroke_samples; ++k)
      EXPECT_NEAR(std::abs(best.machine.angle[k] - best.machine.angle[0]), target.turn[k], 1e-9);
  }
}

// A band as wide as the error of the best machines: all are as good, and the search keeps the kind ones.
TEST(Tolerances, CostNothing) {
  MotionTarget target(sampled_stroke(test::stroke_of(test::stroke_case("leg"))));
  target.tolerance = 0.05;
  RunContext context;
  const auto answer =
      search_types(target, {.families = {MachineFamily::four_bar}, .max_curves = 60'000}, context);
  ASSERT_FALSE(answer.machines.empty());
  const MachineMeasures& best = answer.machines[0].measures;
  EXPECT_LT(best.error, 1e-12);
  EXPECT_LE(best.largest_deviation, 0.05 + 1e-12);
  EXPECT_GT(best.distance, 0);
}

/// Places and angles of the traced bar of a machine, turned and stretched, with its angles counted from
/// elsewhere.
Stroke poses_of(const char* program, bool closed, std::size_t count, std::vector<double>& angles) {
  const MachineShape shape = test::some_shape(*program_named(program), 19);
  std::vector<double> crank(count), x(count), y(count), bx(count), by(count);
  for (std::size_t k = 0; k < count; ++k)
    crank[k] = 0.4 + (closed ? 2 * pi : 3.0) * static_cast<double>(k) / static_cast<double>(count);
  compute_curve({.program = shape.program,
                 .x = shape.x.data(),
                 .signs = shape.signs,
                 .angle = crank.data(),
                 .count = count,
                 .px = x.data(),
                 .py = y.data(),
                 .bx = bx.data(),
                 .by = by.data()});
  Stroke out{.closed = closed};
  angles.clear();
  for (std::size_t k = 0; k < count; ++k) {
    out.points.push_back(std::polar(0.2, 1.0) * std::complex<double>(x[k], y[k]) + 7.0);
    angles.push_back(std::atan2(by[k], bx[k]) + 1.0 + 2.3);
  }
  return out;
}

TEST(PoseTargets, SpreadOverSamplesInEights) {
  const Stroke places{.points = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}}};
  const MotionTarget target = pose_target(places, std::vector<double>{0, 0.1, 0.2, 0.3, 0.4}, 0.5);
  EXPECT_EQ(target.count, 8u);
  double weights = 0;
  for (std::size_t k = 0; k < target.count; ++k) weights += target.weight[k];
  EXPECT_NEAR(weights, 5, 1e-12);
  EXPECT_NEAR(target.angle_length * target.stroke.size, 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(target.at[0], 0);
  EXPECT_NEAR(target.at[7], stroke_samples - 1, 1e-9);
  EXPECT_NEAR(target.x[7] * target.stroke.size + target.stroke.centre.real(), 2, 1e-12);
}

// The polish from the machine itself, changed a little, and the search from nothing.
TEST(PoseTargets, AreMetByTheirOwnMachine) {
  for (const bool closed : {false, true}) {
    std::vector<double> angles;
    const Stroke places = poses_of("four_bar", closed, 16, angles);
    const MotionTarget target = pose_target(places, angles, {});
    RunContext context;
    const auto answer =
        search_types(target,
                     {.families = {MachineFamily::four_bar},
                      .limits = {.min_pair_angle = 0.05, .min_length = 1e-3, .max_length = 100},
                      .max_curves = 60'000},
                     context);
    ASSERT_FALSE(answer.machines.empty());
    EXPECT_LT(answer.machines[0].measures.error, 1e-4) << closed;
    EXPECT_LT(answer.machines[0].measures.largest_rotation, 1e-3) << closed;
  }
}

}  // namespace
}  // namespace linkwright::planar
