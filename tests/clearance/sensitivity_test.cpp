// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/sensitivity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clearance/clearance_linkages.h"
#include "clearance/published_four_bar.h"
#include "linkwright/core/looks.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/samples.h"
#include "support/memory_checkpoint.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

std::vector<planar::InputMotion> crank_motions(int samples, double speed = 0) {
  std::vector<planar::InputMotion> out;
  for (int k = 0; k < samples; ++k) out.push_back({0.1 + full_turn * k / samples, speed, 0});
  return out;
}
planar::BodyPoint tracing_point(const planar::Linkage& l) { return planar::point_named(l, "coupler.P"); }

// A pin at the crank: the change of the tracing point is known in closed form, and the worst over all
// directions of the clearance link can be tried.
TEST(ClearanceSensitivity, WorstPathErrorOfAFourBarOverAllDirections) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  const planar::Linkage l = as_linkage(model);
  const double r = 1e-5;
  const auto rows = clearance_sensitivity(l, {.pins = {{planar::joint_index(l, "A"), r}}},
                                          {.points = {tracing_point(l)}}, crank_motions(24));
  ASSERT_EQ(rows.size(), 24u);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    ASSERT_EQ(rows[k].status, Status::done);
    const double crank = crank_motions(24)[k].value;
    model.clearance = 0;
    const auto ideal = clearance_position(model, crank, 0).point;
    EXPECT_NEAR(rows[k].values[0], ideal.real(), 1e-15);
    model.clearance = r;
    double worst = 0, sum = 0;
    for (int i = 0; i < 720; ++i) {
      const auto off = clearance_position(model, crank, full_turn * i / 720).point - ideal;
      worst = std::max(worst, std::abs(off));
      sum += off.real() * off.real() / 720;
    }
    // Second order: r over the distances that bend, some hundredths of a metre.
    EXPECT_NEAR(rows[k].worst_error[0] / worst, 1, 1e-3) << k;
    EXPECT_NEAR(rows[k].deviation[0] / std::sqrt(sum), 1, 2e-3) << k;
  }
}

// Whole samples, the same as those of an undisturbed run.
TEST(ClearanceSensitivity, InterruptedGivesTheSamplesSoFar) {
  const planar::Linkage l = as_linkage(published_four_bar("gamma-design2-table3-g0-w10"));
  const LinkageTolerances tolerances{.pins = {{planar::joint_index(l, "A"), 1e-5}}};
  const ToleranceOutputs outputs{.points = {tracing_point(l)}};
  const auto samples = crank_motions(10000);
  const auto all = clearance_sensitivity(l, tolerances, outputs, samples);
  RunContext context;
  {
    const LooksAllowed looks(2);  // at every 1024 samples of the nominal motion
    const auto some = clearance_sensitivity(l, tolerances, outputs, samples, {}, &context);
    EXPECT_EQ(some.size(), 2048u);  // size of the third part; one block of derivatives
    for (std::size_t k = 0; k < some.size(); ++k) EXPECT_EQ(some[k].worst_error, all[k].worst_error);
  }
  const LooksAllowed looks(9 + 3);  // after four blocks of 2048, two parameters each
  EXPECT_EQ(clearance_sensitivity(l, tolerances, outputs, samples, {}, &context).size(), 8192u);
}

// Angle of the rocker by the lengths, from the derivatives of the closure.
TEST(ClearanceSensitivity, FunctionByLengths) {
  const ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  const planar::Linkage l = as_linkage(model);
  const auto body = [&](const char* name) { return planar::body_index(l, name); };
  const LinkageTolerances tolerances{.lengths = {{body("crank"), 0, 1, 1e-4}, {body("coupler"), 0, 1, 2e-4}}};
  const auto rows =
      clearance_sensitivity(l, tolerances, {.coordinates = {planar::joint_index(l, "O4")}}, crank_motions(9));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double crank = crank_motions(9)[k].value;
    ClearanceFourBar ideal = model;
    ideal.clearance = 0;
    const ClearancePosition p = clearance_position(ideal, crank, 0);
    // L4 i e4 d(theta4) = e2 dL2 + e3 dL3 along e3 turned: across the coupler the coupler's turning drops
    // out.
    const double by_crank = std::cos(crank - p.coupler_angle) / (model.linkage.rocker * p.sine);
    const double by_coupler = 1 / (model.linkage.rocker * p.sine);
    EXPECT_NEAR(std::abs(rows[k].derivatives[0]), std::abs(by_crank), 1e-7);
    EXPECT_NEAR(std::abs(rows[k].derivatives[1]), std::abs(by_coupler), 1e-7);
    EXPECT_EQ(rows[k].derivatives[0] * rows[k].derivatives[1] > 0, by_crank * by_coupler > 0);
    EXPECT_NEAR(rows[k].worst[0], 1e-4 * std::abs(by_crank) + 2e-4 * std::abs(by_coupler), 1e-10);
  }
}

// Several tolerances at once: their worst direction, tried.
TEST(ClearanceSensitivity, WorstErrorIsThatOfTheWorstDirection) {
  const planar::Linkage l = as_linkage(published_four_bar("gamma-design2-table3-g0-w10"));
  const LinkageTolerances tolerances{
      .pins = {{planar::joint_index(l, "A"), 2e-5}, {planar::joint_index(l, "B"), 1e-5}},
      .lengths = {{planar::body_index(l, "crank"), 0, 1, 3e-5},
                  {planar::body_index(l, "rocker"), 0, 1, 4e-5}}};
  const ToleranceOutputs outputs{.points = {tracing_point(l)}, .coordinates = {planar::joint_index(l, "O4")}};
  ASSERT_EQ(quantity_count(l, outputs), 2u);
  for (const SensitivitySample& row : clearance_sensitivity(l, tolerances, outputs, crank_motions(12))) {
    const double *x = row.derivatives.data(), *y = x + 6;
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const math::Vec2 n = math::unit(full_turn / 2 * i / 20000);
      const auto along = [&](std::size_t j) { return n.x * x[j] + n.y * y[j]; };
      worst = std::max(worst, 2e-5 * std::hypot(along(0), along(1)) + 1e-5 * std::hypot(along(2), along(3)) +
                                  3e-5 * std::abs(along(4)) + 4e-5 * std::abs(along(5)));
    }
    // The next direction tried is at most 0.8e-4 rad off: half of its square, and kinks 1e-4.
    EXPECT_NEAR(row.worst_error[0] / worst, 1, 1e-4);
    EXPECT_GE(row.worst_error[0], worst * (1 - 1e-12));
    double parts = 0, squares = 0;
    for (std::size_t k = 0; k < 4; ++k) parts += row.contributions[k], squares += row.mean_squares[k];
    EXPECT_NEAR(parts, row.worst_error[0], 1e-18);
    EXPECT_NEAR(squares, row.deviation[0] * row.deviation[0] + row.deviation[1] * row.deviation[1], 1e-20);
    // The error of a number is that of the value.
    EXPECT_NEAR(row.worst_error[1], row.worst[2], 1e-16);
  }
}

// Random linkages agree with the first order, for path, function, forces and drive, and stay within the worst
// case.
TEST(ClearanceSensitivity, MonteCarloAgreesWithTheFirstOrder) {
  planar::Linkage l = as_linkage(published_four_bar("gamma-design1-table2-g9.81-w20"));
  const LinkageTolerances tolerances{
      .pins = {{planar::joint_index(l, "A"), 2e-6}, {planar::joint_index(l, "O4"), 1e-6}},
      .lengths = {{planar::body_index(l, "rocker"), 0, 1, 3e-6}}};
  const ToleranceOutputs outputs{.points = {tracing_point(l)},
                                 .coordinates = {planar::joint_index(l, "O4")},
                                 .forces = {planar::joint_index(l, "B")},
                                 .drives = true};
  ASSERT_EQ(value_count(l, outputs), 6u);
  const auto samples = crank_motions(7, 20);
  const auto first = clearance_sensitivity(l, tolerances, outputs, samples);
  RunContext context;
  const MonteCarloResult drawn = clearance_monte_carlo(l, tolerances, outputs, samples, 4000, 5, context);
  EXPECT_EQ(drawn.draws, 4000);
  for (std::size_t s = 0; s < samples.size(); ++s) {
    ASSERT_EQ(drawn.samples[s].assembled, 4000);
    for (std::size_t i = 0; i < 6; ++i) {
      // 4000 draws: the deviation is known to 1.1 %, 4 of that.
      EXPECT_NEAR(drawn.samples[s].deviation[i] / first[s].deviation[i], 1, 0.045) << s << " " << i;
      EXPECT_NEAR(drawn.samples[s].mean[i], first[s].values[i],
                  4 * first[s].deviation[i] / std::sqrt(4000.0) * 1.2);
      EXPECT_LT(drawn.samples[s].most[i] - first[s].values[i], first[s].worst[i] * 1.001);
      EXPECT_GT(drawn.samples[s].most[i] - first[s].values[i], first[s].worst[i] * 0.7);
      EXPECT_LT(first[s].values[i] - drawn.samples[s].least[i], first[s].worst[i] * 1.001);
    }
    EXPECT_LT(drawn.samples[s].worst_error[0], first[s].worst_error[0] * 1.001);
  }
  // In pieces that are kept, on any threads: the same bits.
  test::MemoryCheckpoint kept;
  for (const int threads : {1, 3}) {
    RunContext own;
    own.set_threads(threads);
    own.set_checkpoint(&kept);
    const MonteCarloResult resumed = clearance_monte_carlo(l, tolerances, outputs, samples, 4000, 5, own);
    EXPECT_EQ(resumed.draws, 4000);
    EXPECT_EQ(resumed.missed, drawn.missed);
    EXPECT_EQ(resumed.largest, drawn.largest);
    for (std::size_t s = 0; s < samples.size(); ++s) {
      EXPECT_EQ(resumed.samples[s].mean, drawn.samples[s].mean);
      EXPECT_EQ(resumed.samples[s].deviation, drawn.samples[s].deviation);
      EXPECT_EQ(resumed.samples[s].most, drawn.samples[s].most);
      EXPECT_EQ(resumed.samples[s].worst_error, drawn.samples[s].worst_error);
    }
    EXPECT_GT(kept.entries.size(), 100u);
    std::erase_if(kept.entries, [](const auto& entry) { return entry.first.size() % 2 == 0; });
  }
  kept.entries["linkages 2"] = pack_numbers(std::vector<double>(3));
  RunContext own;
  own.set_checkpoint(&kept);
  EXPECT_THROW(clearance_monte_carlo(l, tolerances, outputs, samples, 4000, 5, own), CheckpointError);
  // The same seed, the same numbers.
  const MonteCarloResult again = clearance_monte_carlo(l, tolerances, outputs, samples, 100, 5, context),
                         same = clearance_monte_carlo(l, tolerances, outputs, samples, 100, 5, context);
  EXPECT_EQ(again.samples[3].mean, same.samples[3].mean);
}

// Pins that several joints share, groups without closed form: every linkage.
TEST(ClearanceSensitivity, AnyLinkage) {
  for (const char* name : {"jansen_leg", "stephenson_2", "slider_crank"}) {
    const planar::LinkageSample& sample = planar::linkage_sample(name);
    LinkageTolerances tolerances;
    for (std::size_t j = 0; j < sample.linkage.joints.size(); ++j)
      if (sample.linkage.joints[j].type == planar::JointType::revolute)
        tolerances.pins.push_back({static_cast<int>(j), 1e-5 * planar::size_of(sample.linkage)});
    std::vector<planar::InputMotion> samples;
    for (int k = 0; k < 5; ++k)
      samples.push_back({sample.from[0] + (sample.to[0] - sample.from[0]) * (k + 0.3) / 20, sample.speed, 0});
    const planar::BodyPoint point{static_cast<int>(sample.linkage.bodies.size()) - 1, 0};
    const auto rows =
        clearance_sensitivity(sample.linkage, tolerances, {.points = {point}, .drives = true}, samples);
    RunContext context;
    const MonteCarloResult drawn = clearance_monte_carlo(
        sample.linkage, tolerances, {.points = {point}, .drives = true}, samples, 200, 1, context);
    for (std::size_t s = 0; s < samples.size(); ++s) {
      ASSERT_EQ(rows[s].status, Status::done) << name;
      EXPECT_GT(rows[s].worst_error[0], 0) << name;
      EXPECT_EQ(drawn.samples[s].assembled, 200) << name;
      EXPECT_LT(drawn.samples[s].worst_error[0], rows[s].worst_error[0] * 1.02) << name;
      EXPECT_GT(drawn.samples[s].worst_error[0], rows[s].worst_error[0] * 0.2) << name;
    }
  }
}

TEST(ClearanceSensitivity, RefusesWhatIsNotThere) {
  const planar::Linkage l = as_linkage(published_four_bar("gamma-design1-table2-g9.81-w20"));
  const auto text = [&](const LinkageTolerances& t, const ToleranceOutputs& o, std::size_t samples = 1) {
    return test::message([&] { clearance_sensitivity(l, t, o, std::vector<planar::InputMotion>(samples)); });
  };
  EXPECT_THAT(text({.pins = {{9, 1e-3}}}, {}), ::testing::HasSubstr("there is no joint 9 among 4"));
  EXPECT_THAT(text({.pins = {{1, -1e-3}}}, {}), ::testing::HasSubstr("joint 'A': clearance -0.001 m"));
  EXPECT_THAT(text({.lengths = {{1, 0, 0, 1e-3}}}, {}),
              ::testing::HasSubstr("body 'crank': points 0 and 0 have no distance"));
  EXPECT_THAT(text({}, {.points = {{2, 7}}}), ::testing::HasSubstr("there is no point 7 of body 2"));
  // A linkage that does not assemble has no values.
  planar::Linkage apart = l;
  apart.bodies[2].points[1].at = 0.01;
  const auto rows =
      clearance_sensitivity(apart, {}, {.coordinates = {3}}, std::vector<planar::InputMotion>(1));
  EXPECT_EQ(rows[0].status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(rows[0].values[0]));
}

}  // namespace
}  // namespace linkwright::clearance
