// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "clearance/clearance_linkages.h"
#include "clearance/published_four_bar.h"
#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

constexpr double degree = pi / 180;

struct Trajectory {
  ClearanceRun run;
  std::vector<double> link, tension, phase;
};
Trajectory simulated(const ClearanceFourBar& model, double speed, const LinkState& start,
                     const std::vector<double>& crank_angles, const ClearanceTolerances& tolerances = {}) {
  Trajectory out;
  std::vector<double> times;
  for (const double angle : crank_angles) times.push_back(angle / speed);
  out.run = simulate_clearance(model, math::ConstantSpeed{0, speed}, start, times, tolerances,
                               [&](const ClearanceRow& row) {
                                 out.link.push_back(row.link.angle);
                                 out.tension.push_back(row.instant->tension);
                                 out.phase.push_back(row.link.angle - row.crank.value);
                                 return true;
                               });
  return out;
}

class PublishedDesign2 : public ::testing::TestWithParam<const char*> {};

TEST_P(PublishedDesign2, FollowsTheReferenceThroughATurn) {
  const char* id = GetParam();
  const ClearanceFourBar model = published_four_bar(id);
  const double speed = crank_speed(id);
  const Value& ivp = test::at(computed(id), "ivp");
  const auto angles = test::numbers(test::at(ivp, "theta2_rad"));
  const LinkState start{10 * degree, speed};
  const Trajectory t = simulated(model, speed, start, angles);
  ASSERT_EQ(t.run.status, Status::done);
  const auto link = test::numbers(test::at(ivp, "gamma_rad"));
  const auto tension = test::numbers(test::at(ivp, "link_tension_N"));
  ASSERT_EQ(t.link.size(), link.size());
  // Both integrations at relative tolerances of 1e-10.
  for (std::size_t k = 0; k < link.size(); ++k) {
    EXPECT_NEAR(t.link[k], link[k], 1e-7) << k;
    EXPECT_NEAR(t.tension[k] / tension[k], 1, 1e-6) << k;
  }
  EXPECT_NEAR(phase_error(model, {0, speed}, start, 10 * degree, 72), test::number_at(ivp, "F2_n72"), 1e-7);

  // Ranges of the reference are those of its own samples, which pass by the extremes.
  const Value& turned = test::at(computed(id), "one_rev");
  const Trajectory fine = simulated(model, speed, start, evenly_spaced(0, full_turn, 3601));
  const auto [least, most] = std::minmax_element(fine.phase.begin(), fine.phase.end());
  EXPECT_NEAR(*least / degree, test::number_at(turned, "psi_min_deg"), 0.02);
  EXPECT_NEAR(*most / degree, test::number_at(turned, "psi_max_deg"), 0.02);
  EXPECT_NEAR(fine.run.min_tension / test::number_at(turned, "tension_min_N"), 1, 3e-4);
  EXPECT_NEAR(fine.run.max_tension / test::number_at(turned, "tension_max_N"), 1, 3e-4);
  EXPECT_NEAR(fine.run.fastest_link / speed / test::number_at(turned, "gammadot_max_over_w2"), 1, 1e-3);
  EXPECT_TRUE(std::isnan(fine.run.first_separation));
  EXPECT_EQ(fine.run.separated, 0);
  EXPECT_EQ(fine.run.sign_changes, 0);
}

TEST_P(PublishedDesign2, HasThePeriodicOrbitOfTheReference) {
  const char* id = GetParam();
  const ClearanceFourBar model = published_four_bar(id);
  const double speed = crank_speed(id);
  const Value& periodic = test::at(computed(id), "periodic");
  const ClearanceOrbit orbit = find_orbit(model, {0, speed}, 0.15, -0.3);
  ASSERT_EQ(orbit.status, Status::done) << orbit.message;
  EXPECT_LT(orbit.residual, 1e-10);
  EXPECT_NEAR(orbit.phase, test::number_at(periodic, "psi0_rad"), 1e-7);
  EXPECT_NEAR(orbit.slope, test::number_at(periodic, "dpsi_dtheta2_0"), 1e-6);
  // Without damping: a pair on the unit circle. Central differences of 1e-5 give it to 1e-6.
  const auto first = test::numbers(test::at(periodic, "floquet").as_array().at(0));
  EXPECT_NEAR(std::abs(orbit.multipliers[0]), 1, 1e-6);
  EXPECT_NEAR(orbit.multipliers[0].real(), first[0], 1e-5);
  EXPECT_NEAR(std::abs(orbit.multipliers[0].imag()), std::abs(first[1]), 1e-5);

  const auto angles = test::numbers(test::at(periodic, "theta2_rad"));
  const auto link = test::numbers(test::at(periodic, "gamma_rad"));
  const Trajectory t = simulated(model, speed, orbit.start({0, speed}), angles);
  for (std::size_t k = 0; k < link.size(); ++k) EXPECT_NEAR(t.link.at(k), link[k], 1e-6) << k;
  EXPECT_NEAR(t.link.back() - t.link.front(), full_turn, 1e-9);
}

// No work is done on a passive coupler over a turn: the mean of N sin(phase) is zero, so that the phase
// cannot be positive throughout while pin and bush touch.
TEST_P(PublishedDesign2, DoesNoWorkOverAPeriod) {
  const char* id = GetParam();
  const ClearanceFourBar model = published_four_bar(id);
  const double speed = crank_speed(id);
  const ClearanceOrbit orbit = find_orbit(model, {0, speed}, 0.15, -0.3);
  const Trajectory t = simulated(model, speed, orbit.start({0, speed}), evenly_spaced(0, full_turn, 2001));
  double moment = 0, size = 0;  // trapezium rule of a periodic function: exact to rounding
  for (std::size_t k = 0; k + 1 < t.phase.size(); ++k) {
    moment += t.tension[k] * std::sin(t.phase[k]);
    size += t.tension[k];
  }
  EXPECT_NEAR(moment / size, 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Cases, PublishedDesign2,
                         ::testing::Values("gamma-design2-table3-g0-w10", "gamma-design2-table3-g9.81-w50",
                                           "gamma-design2-table3-g9.81-w20"),
                         [](const auto& which) {
                           return which.index == 0 ? "weightless" : which.index == 1 ? "fast" : "slow";
                         });

TEST(FourBarClearanceMotion, AllTermsOfTheEquationWithDamping) {
  const char* id = "gamma-design2-damped";
  ClearanceFourBar model = published_four_bar(id);
  const Value& inputs = test::at(reference(id), "inputs");
  model.coupler_damping = test::number_at(inputs, "C_theta3_Nms");
  model.rocker_damping = test::number_at(inputs, "C_theta4_Nms");
  model.link_damping = test::number_at(inputs, "C_gamma_Nms");
  const auto angles = test::numbers(test::at(computed(id), "theta2_rad"));
  const auto link = test::numbers(test::at(computed(id), "gamma_rad"));
  const auto tension = test::numbers(test::at(computed(id), "link_tension_N"));
  const Trajectory t = simulated(model, 20, {0, 20}, angles);
  ASSERT_EQ(t.run.status, Status::done);
  for (std::size_t k = 0; k < link.size(); ++k) {
    EXPECT_NEAR(t.link[k], link[k], 1e-7) << k;
    EXPECT_NEAR(t.tension[k] / tension[k], 1, 1e-6) << k;
  }
}

// Violent motion: small errors grow, so only the first third of a turn is compared.
TEST(FourBarClearanceMotion, Design1LosesContact) {
  for (const char* id :
       {"gamma-design1-table2-g0-w10", "gamma-design1-table2-g9.81-w50", "gamma-design1-table2-g9.81-w20"}) {
    const ClearanceFourBar model = published_four_bar(id);
    const double speed = crank_speed(id);
    const Value& ivp = test::at(computed(id), "ivp");
    const auto angles = test::numbers(test::at(ivp, "theta2_rad"));
    const auto link = test::numbers(test::at(ivp, "gamma_rad"));
    const Trajectory t = simulated(model, speed, {10 * degree, speed}, angles);
    for (std::size_t k = 0; k < link.size() && angles[k] <= 2.1; ++k)
      EXPECT_NEAR(t.link.at(k), link[k], 1e-4) << id << k;

    const ClearanceRun whole = simulated(model, speed, {10 * degree, speed}, {0, full_turn}).run;
    EXPECT_EQ(whole.status, Status::done);
    EXPECT_GE(whole.sign_changes, 10);  // 14 to 18 elsewhere
    EXPECT_GT(whole.fastest_link / speed, 30);
    EXPECT_GT(whole.separated, 0.01);
    EXPECT_LT(whole.separated, 0.5);
    // The tension is positive before the first separation and negative behind it.
    const double t0 = whole.first_separation;
    std::vector<double> near;
    simulate_clearance(model, math::ConstantSpeed{0, speed}, {10 * degree, speed},
                       std::vector{0.0, t0 * (1 - 1e-5), t0 * (1 + 1e-5)}, {}, [&](const ClearanceRow& row) {
                         near.push_back(row.instant->tension);
                         return true;
                       });
    EXPECT_GT(near.at(1), 0) << id;
    EXPECT_LT(near.at(2), 0) << id;
  }
}

TEST(FourBarClearanceMotion, WithoutWeightSpeedIsOnlyATimeScale) {
  const ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  const auto angles = evenly_spaced(0, full_turn, 13);
  const Trajectory slow = simulated(model, 10, {0.2, 10}, angles),
                   fast = simulated(model, 250, {0.2, 250}, angles);
  for (std::size_t k = 0; k < angles.size(); ++k) {
    EXPECT_NEAR(fast.link[k], slow.link[k], 1e-8) << k;
    EXPECT_NEAR(fast.tension[k] / slow.tension[k] / 625, 1, 1e-7) << k;
  }
}

// A link with all mass at A' swings about the crank's direction like a pendulum in the field of the
// centripetal acceleration: sqrt(L2 / r) times a turn, ten for 1 mm in 100 mm.
TEST(FourBarClearanceMotion, SwingsAsOftenAsThePendulumDoes) {
  ClearanceFourBar model = published_four_bar("gamma-design1-table2-g0-w10");
  model.coupler = {1, 0, {0, 0}};
  model.rocker = {0, 0, {0, 0}};
  const Trajectory t = simulated(model, 10, {1e-3, 10}, evenly_spaced(0, full_turn, 2001));
  int changes = 0;
  for (std::size_t k = 1; k < t.phase.size(); ++k) changes += (t.phase[k] > 0) != (t.phase[k - 1] > 0);
  EXPECT_EQ(changes, 20);
  EXPECT_NEAR(t.phase.back(), 1e-3, 1e-7);  // ten whole periods, amplitude corrections of 1e-7
}

// r -> 0: the periodic orbit goes to the direction of the force of the ideal joint, with the clearance.
TEST(FourBarClearanceMotion, TheForceOfTheIdealJointIsTheLimit) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w50");
  double before = 0;
  for (const double r : {4e-4, 1e-4}) {
    model.clearance = r;
    const double direction = force_direction(model, 0, 50, 0);
    const ClearanceOrbit orbit = find_orbit(model, {0, 50}, direction, 0);
    ASSERT_EQ(orbit.status, Status::done) << orbit.message;
    double worst = 0;
    simulate_clearance(model, math::ConstantSpeed{0, 50}, orbit.start({0, 50}),
                       evenly_spaced(0, full_turn / 50, 73), {}, [&](const ClearanceRow& row) {
                         const double limit = force_direction(model, row.crank.value, 50, 0);
                         worst = std::max(worst, std::abs(math::angle_difference(row.link.angle, limit)));
                         return true;
                       });
    EXPECT_LT(worst, r == 4e-4 ? 0.12 : 0.03);
    if (before > 0) {
      EXPECT_LT(worst, before / 3);
    }
    before = worst;
  }
}

// Damping: the motion settles by itself, its multipliers lie inside the unit circle, and the mean of the
// phase is negative.
TEST(FourBarClearanceMotion, SettlesWithDamping) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  model.link_damping = 1e-5;
  const UniformCrank crank{0, 10};
  const ClearanceOrbit settled = settle(model, crank, {0.1, 10}, 100);
  ASSERT_EQ(settled.status, Status::done) << settled.message;
  const ClearanceOrbit orbit = find_orbit(model, crank, 0.1, -0.2);
  ASSERT_EQ(orbit.status, Status::done) << orbit.message;
  EXPECT_NEAR(math::angle_difference(settled.phase, orbit.phase), 0, 1e-7);
  EXPECT_LT(std::abs(orbit.multipliers[0]), 0.999);
  const Trajectory t = simulated(model, 10, orbit.start(crank), evenly_spaced(0, full_turn, 721));
  double mean = 0;
  for (std::size_t k = 0; k + 1 < t.phase.size(); ++k) mean += t.phase[k] / 720;
  EXPECT_LT(mean, -1e-3);
}

TEST(FourBarClearanceMotion, FollowsAnOrbitToANeighbour) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  const ClearanceOrbit known = find_orbit(model, {0, 10}, 0.15, -0.3);
  model.coupler.mass *= 1.01;
  const ClearanceOrbit near = follow_orbit(model, {0, 10}, known),
                       anew = find_orbit(model, {0, 10}, 0.15, -0.3);
  ASSERT_EQ(near.status, Status::done);
  EXPECT_NEAR(near.phase, anew.phase, 1e-8);
  EXPECT_NEAR(near.slope, anew.slope, 1e-8);
  EXPECT_GT(std::abs(near.phase - known.phase), 1e-5);
  // Too far for that: a search of its own.
  model.coupler.centre = {0.02, 0.01};
  const ClearanceOrbit far = follow_orbit(model, {0, 10}, known);
  ASSERT_EQ(far.status, Status::done);
  EXPECT_LT(far.residual, 1e-9);
}

TEST(FourBarClearanceMotion, SaysThatItHasNotSettled) {
  const ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  const ClearanceOrbit orbit = settle(model, {0, 10}, {0.1, 10}, 5);
  EXPECT_EQ(orbit.status, Status::not_converged);
  EXPECT_THAT(orbit.message,
              ::testing::HasSubstr("not periodic within 5 turns: the last one changed the motion by"));
}

TEST(FourBarClearanceMotion, EndsWhereTheLinksDoNotMeet) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  model.linkage.coupler = 0.1;  // turns no more
  const ClearanceRun run =
      simulate_clearance(model, math::ConstantSpeed{1.8, 10}, {1.8, 10}, std::vector{0.0, 0.6});
  EXPECT_EQ(run.status, Status::limit_reached);
  EXPECT_THAT(run.message, ::testing::HasSubstr("the crank stops at 0.370"));
  // There the crank is so near to O4 that coupler and rocker, 150.6 mm less 100 mm, cannot be laid between.
  EXPECT_NEAR(std::abs(std::polar(model.linkage.ground, model.linkage.frame_angle) -
                       std::polar(model.linkage.crank, 1.8 + 10 * run.time)) +
                  model.clearance,
              model.linkage.rocker - model.linkage.coupler, 2e-5);
  EXPECT_EQ(find_orbit(model, {1.8, 10}).status, Status::limit_reached);
  EXPECT_TRUE(std::isinf(phase_error(model, {1.8, 10}, {1.8, 10}, 0, 8)));
  model.linkage.coupler = 0.01;
  model.clearance = 1e-3;
  const ClearanceRun none =
      simulate_clearance(model, math::ConstantSpeed{4, 10}, {4, 10}, std::vector{0.0, 0.3});
  EXPECT_EQ(none.status, Status::no_assembly);
  EXPECT_THAT(none.message,
              ::testing::HasSubstr("no assembly at 0 s, crank at -130.8169 deg: the links miss"));
  EXPECT_EQ(none.time, 0);
}

TEST(FourBarClearanceMotion, RefusesTheIdealJointAndCranksThatStand) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  EXPECT_THAT(test::message([&] {
                find_orbit(model, {0, 0});
              }),
              ::testing::HasSubstr("the crank must turn, at 0 rad/s"));
  EXPECT_THAT(test::message([&] {
                settle(model, {0, 1}, {}, 0);
              }),
              ::testing::HasSubstr("needs 1 turn at least"));
  model.clearance = 0;
  EXPECT_THAT(test::message([&] {
                simulate_clearance(model, math::ConstantSpeed{}, {}, std::vector{0.0, 1.0});
              }),
              ::testing::HasSubstr("clearance 0 m: the ideal joint has no motion of its own"));
}

}  // namespace
}  // namespace linkwright::clearance
