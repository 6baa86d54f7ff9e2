// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/motion_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/planar/type_synthesis/place.h"
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
  set_tolerances(target, 0.05, {});
  RunContext context;
  const auto answer =
      search_types(target, {.families = {MachineFamily::four_bar}, .max_curves = 60'000}, context);
  ASSERT_FALSE(answer.machines.empty());
  const MachineMeasures& best = answer.machines[0].measures;
  EXPECT_LT(best.error, 1e-12);
  EXPECT_LE(best.largest_deviation, 0.05 + 1e-12);
  EXPECT_GT(best.distance, 0);
}

TEST(ToleranceBands, HaveTheSamplesBetweenTheirEnds) {
  const std::vector<std::complex<double>> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const MotionTarget closed(sampled_stroke({square, true})), open(sampled_stroke({square, false}));
  // A sample is a 96th of a closed stroke and a 95th of an open one.
  EXPECT_EQ(samples_of(closed, {.from = 0, .to = 1}).size(), stroke_samples);
  EXPECT_EQ(samples_of(open, {.from = 0, .to = 1}).size(), stroke_samples);
  EXPECT_EQ(samples_of(closed, {.from = 0.25, .to = 0.5}).size(), 25u);
  const auto round_the_end = samples_of(closed, {.from = 0.75, .to = 0.25});
  EXPECT_EQ(round_the_end.size(), 49u);
  EXPECT_EQ(round_the_end.front(), 0u);
  EXPECT_EQ(round_the_end.back(), 95u);
  EXPECT_EQ(samples_of(closed, {.from = 0.501, .to = 0.502}), std::vector<std::size_t>{48});
  EXPECT_EQ(samples_of(closed, {.from = 0.999, .to = 0.9995}), std::vector<std::size_t>{0});
  EXPECT_EQ(samples_of(open, {.from = 1, .to = 1}), std::vector<std::size_t>{95});
}

TEST(ToleranceBands, TakeTheLeastWhereTheyOverlap) {
  MotionTarget target(sampled_stroke({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true}));
  EXPECT_FALSE(target.has_tolerance());
  const std::vector<ToleranceBand> bands{{.from = 0, .to = 0.5, .tolerance = 0.2},
                                         {.from = 0.25, .to = 0.75, .tolerance = 0.1}};
  set_tolerances(target, 0.01, bands);
  EXPECT_EQ(target.tolerance[12], 0.2);
  EXPECT_EQ(target.tolerance[30], 0.1);
  EXPECT_EQ(target.tolerance[60], 0.1);
  EXPECT_EQ(target.tolerance[90], 0.01);
  EXPECT_TRUE(target.has_tolerance_everywhere());
  set_tolerances(target, 0, bands);
  EXPECT_TRUE(target.has_tolerance());
  EXPECT_FALSE(target.has_tolerance_everywhere());
}

TEST(Weights, ChangeAlongTheStrokeAndOnlyTheirProportionsMatter) {
  const Stroke stroke{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, false};
  const MotionTarget plain(sampled_stroke(stroke));
  MotionTarget same = plain, rising = plain, larger = plain;
  weigh_points(same, stroke, std::vector<double>{7, 7, 7, 7});
  EXPECT_EQ(same.weight, plain.weight);
  weigh_points(rising, stroke, std::vector<double>{0, 1, 2, 3});
  weigh_points(larger, stroke, std::vector<double>{0, 10, 20, 30});
  double sum = 0;
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    EXPECT_NEAR(rising.weight[k], 2.0 * static_cast<double>(k) / 95, 1e-12);
    EXPECT_NEAR(rising.weight[k], larger.weight[k], 1e-12);
    sum += rising.weight[k];
  }
  EXPECT_NEAR(sum, rising.total_weight, 1e-9);
  EXPECT_THROW(weigh_points(rising, stroke, std::vector<double>{1, 2}), ContractError);
}

// Half of the derivatives of the squared error, with tolerances and weights that change along the stroke.
TEST(ErrorModels, HaveTheGradientOfTheSquaredError) {
  for (const bool timed : {false, true}) {
    SCOPED_TRACE(timed ? "timed" : "free");
    const Stroke leg = test::stroke_of(test::stroke_case("leg"));
    std::vector<double> rotations, weights;
    for (std::size_t k = 0; k < leg.points.size(); ++k) {
      rotations.push_back(2 * pi * static_cast<double>(k) / static_cast<double>(leg.points.size()));
      weights.push_back(0.2 + static_cast<double>(k % 7));
    }
    MotionTarget target = timed ? timed_stroke(leg, rotations) : MotionTarget(sampled_stroke(leg));
    const std::vector<ToleranceBand> bands{{.from = 0.2, .to = 0.5, .tolerance = 0.02},
                                           {.from = 0.6, .to = 0.1, .tolerance = 0.005}};
    set_tolerances(target, 0, bands);
    weigh_points(target, leg, weights);
    FittedMachine machine{.shape = test::some_shape(*program_named("four_bar"), 19)};
    ASSERT_LT(place_on(target, machine), 1);
    MachineFitter fitter(target, {});
    // Crank angles that are free must be those of closest points, which a machine far from the stroke does
    // not have.
    if (!timed) {
      ASSERT_TRUE(fitter.polish(machine, infinity));
    }
    // Away from the optimum, where all derivatives are zero.
    for (double& x : machine.shape.x) x *= 1.001;
    ASSERT_GT(fitter.measure(machine).error, 1e-4);
    const ErrorModel model = fitter.error_model(machine, false);
    double largest = 0;
    for (const double g : model.gradient) largest = std::max(largest, std::abs(g));
    for (std::size_t i = 0; i < model.unknowns; ++i) {
      constexpr double step = 1e-6;
      const auto squares = [&](double by) {
        FittedMachine moved = machine;
        std::vector<double> change(model.unknowns, 0.0);
        change[i] = by;
        fitter.move(moved, change);
        const double error = fitter.measure(moved).error;
        return error * error;
      };
      EXPECT_NEAR(model.gradient[i], (squares(step) - squares(-step)) / (4 * step), 1e-5 * largest) << i;
    }
  }
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

// The poses of a machine, one of which is moved: it is met when it counts much more than the others.
TEST(Weights, MakePosesMatter) {
  std::vector<double> angles;
  Stroke places = poses_of("four_bar", false, 8, angles);
  places.points[3] += 0.01;
  const auto error_at_it = [&](double weight) {
    std::vector<double> weights(8, 1.0), alone(8, 0.0);
    weights[3] = weight, alone[3] = 1;
    MotionTarget target = pose_target(places, angles, 0.2), of_it = target;
    weigh_points(target, places, weights), weigh_points(of_it, places, alone);
    FittedMachine machine{.shape = test::some_shape(*program_named("four_bar"), 19)};
    EXPECT_LT(place_on(target, machine), 0.1);
    MachineFitter fitter(target, {.min_pair_angle = 0.05, .min_length = 1e-3, .max_length = 100});
    fitter.turn_body(machine);
    EXPECT_TRUE(fitter.polish(machine, infinity));
    return MachineFitter(of_it, {}).measure(machine).error;
  };
  const double as_others = error_at_it(1);
  EXPECT_GT(as_others, 1e-4);
  EXPECT_LT(error_at_it(1000), 0.1 * as_others);
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
