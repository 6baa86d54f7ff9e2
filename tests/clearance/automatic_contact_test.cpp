// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/automatic_contact.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearance/contact_cases.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::clearance {
namespace {

AutomaticPin steel_pin(const planar::Linkage& l, const char* joint, double angle, double rate) {
  return {.contact = {.joint = planar::joint_index(l, joint),
                      .clearance = 1e-3,
                      .bush_radius = 0.01,
                      .law = {.stiffness = pin_stiffness(0.01, 0.009), .restitution = 0.5}},
          .angle = angle,
          .rate = rate};
}

// Lasting contact is continuous contact, to the bit.
TEST(AutomaticContact, IsContinuousContactWhereThatHolds) {
  const planar::Linkage l = as_linkage(published_four_bar("gamma-design2-table3-g0-w10"));
  const AutomaticPin pin = steel_pin(l, "A", full_turn / 36, 10);
  const planar::InputDrive crank = uniform_crank(10);
  const std::vector<double> times = evenly_spaced(0, full_turn / 10, 73);
  std::vector<double> angles, tensions;
  const AutomaticContactRun run =
      simulate_automatic_contact(l, std::span(&pin, 1), std::span(&crank, 1), times, {},
                                 {.continuous = [&](const JointClearanceRow& row) {
                                   angles.push_back(row.joints[0].angle);
                                   tensions.push_back(row.joints[0].tension);
                                   return true;
                                 }});
  ASSERT_EQ(run.status, Status::done) << run.message;
  EXPECT_TRUE(std::isnan(run.switched));
  EXPECT_EQ(run.pin, -1);
  EXPECT_EQ(run.time, times.back());
  EXPECT_TRUE(run.contact.events.empty());
  std::size_t k = 0;
  simulate_joint_clearance(l, continuous_joints(std::span(&pin, 1)), std::span(&crank, 1), times,
                           {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-10},
                           [&](const JointClearanceRow& row) {
                             EXPECT_EQ(row.joints[0].angle, angles.at(k));
                             EXPECT_EQ(row.joints[0].tension, tensions.at(k++));
                             return true;
                           });
  EXPECT_EQ(k, angles.size());
}

struct Lost {
  planar::Linkage linkage = as_linkage(published_four_bar("gamma-design1-table2-g0-w10"));
  AutomaticPin pin = steel_pin(linkage, "A", full_turn / 36, 10);
  planar::InputDrive crank = uniform_crank(10);
  std::vector<double> times = evenly_spaced(0, full_turn / 10, 721);
};

// From the loss on it is the contact model, started where continuous contact ended; and the contact model
// started touching at the start comes to the same.
TEST(AutomaticContact, GoesOnWithRealContactWhereItIsLost) {
  const Lost lost;
  double last = -1, first = -1, energy_before = 0;
  std::vector<std::complex<double>> ways;
  std::vector<double> at;
  const AutomaticContactRun run = simulate_automatic_contact(
      lost.linkage, std::span(&lost.pin, 1), std::span(&lost.crank, 1), lost.times, {},
      {.continuous =
           [&](const JointClearanceRow& row) {
             last = row.instant.time;
             energy_before = row.instant.kinetic;
             return true;
           },
       .contact =
           [&](const ContactRow& row) {
             if (first < 0) first = row.time;
             at.push_back(row.time);
             ways.push_back(row.joints[0].eccentricity);
             return true;
           }});
  ASSERT_EQ(run.status, Status::done) << run.message;
  ASSERT_FALSE(std::isnan(run.switched));
  EXPECT_EQ(run.pin, 0);
  EXPECT_EQ(run.switched, run.continuous.joints[0].first_separation);
  EXPECT_LT(last, run.switched);
  EXPECT_GT(first, run.switched);
  EXPECT_NEAR(first - last, lost.times[1], 1e-12) << "no row is lost or doubled";
  EXPECT_GE(run.contact.events.size(), 1u);
  EXPECT_GT(run.contact.events[0].start, run.switched);
  // One pin: nothing is pressed in at the switch, so energy is continuous, up to the billionth of the
  // clearance that the pin is moved by.
  EXPECT_GT(energy_before, 0);
  EXPECT_NEAR(run.energy_step, 0, 1e-10 * energy_before);
  EXPECT_LT(run.largest_drift, 1e-6 * run.peak_energy);

  // The contact model from the state at the switch: the same, to the bit.
  const std::vector<ContactJoint> joints = contact_joints(std::span(&lost.pin, 1), run.continuous.end);
  std::vector<double> rest{run.switched};
  rest.insert(rest.end(), at.begin(), at.end());
  std::size_t k = 0;
  simulate_contact(lost.linkage, joints, std::span(&lost.crank, 1), rest,
                   {.max_steps = 10'000'000 - run.continuous.simulation.steps}, [&](const ContactRow& row) {
                     if (row.time > run.switched) {
                       EXPECT_EQ(row.joints[0].eccentricity, ways.at(k++));
                     }
                     return true;
                   });
  EXPECT_EQ(k, ways.size());

  // The contact model from the start: elastic bushes press in by 1e-7 m, and stay in contact by 0.6 ms
  // longer; the times of the impacts differ by 0.03 %, and their forces.
  AutomaticPin touching = lost.pin;
  const ClearanceState start{.angle = touching.angle, .rate = touching.rate};
  const std::vector<ContactJoint> from = contact_joints(std::span(&touching, 1), std::span(&start, 1));
  const ContactRun whole =
      simulate_contact(lost.linkage, from, std::span(&lost.crank, 1), std::vector{0.0, lost.times.back()});
  ASSERT_EQ(whole.status, Status::done) << whole.message;
  ASSERT_GE(whole.events.size(), 4u);
  EXPECT_NEAR(whole.events[0].end / run.switched, 1, 5e-3);
  for (std::size_t e = 0; e < 3; ++e) {
    EXPECT_NEAR(whole.events[e + 1].start / run.contact.events[e].start, 1, 1e-3) << e;
    EXPECT_NEAR(whole.events[e + 1].force / run.contact.events[e].force, 1, 3e-3) << e;
  }
}

// Rows are looked at, not stepped to: neither the switch nor the impacts are missed.
TEST(AutomaticContact, RowsChangeNothing) {
  const Lost lost;
  const auto run = [&](int rows) {
    return simulate_automatic_contact(lost.linkage, std::span(&lost.pin, 1), std::span(&lost.crank, 1),
                                      evenly_spaced(0, 0.3 * full_turn / 10, rows));
  };
  const AutomaticContactRun few = run(3), many = run(301);
  EXPECT_EQ(few.switched, many.switched);
  ASSERT_EQ(few.contact.events.size(), many.contact.events.size());
  for (std::size_t k = 0; k < few.contact.events.size(); ++k)
    EXPECT_EQ(few.contact.events[k].start, many.contact.events[k].start);
  EXPECT_EQ(few.steps, many.steps);
}

// All clearance joints go over when the first of them parts. The other one is still pressed on: it begins in
// contact, as deep as its tension needs, which costs the energy of its springs.
TEST(AutomaticContact, SeveralPinsGoOverTogether) {
  const Lost lost;
  const planar::Linkage& l = lost.linkage;
  std::vector<AutomaticPin> pins{lost.pin, steel_pin(l, "O4", 1.5, 0)};
  pins[1].contact.pin = PinSide::second;
  std::size_t rows = 0;
  bool pressed = false;
  const AutomaticContactRun run =
      simulate_automatic_contact(l, pins, std::span(&lost.crank, 1), evenly_spaced(0, 0.1, 1001), {},
                                 {.contact = [&](const ContactRow& row) {
                                   if (rows++ == 0) pressed = row.joints[0].contact || row.joints[1].contact;
                                   return true;
                                 }});
  ASSERT_EQ(run.status, Status::done) << run.message;
  ASSERT_GE(run.pin, 0);
  const std::size_t other = run.pin == 0 ? 1 : 0;
  const double tension = run.continuous.end[other].tension;
  const std::vector<ContactJoint> joints = contact_joints(pins, run.continuous.end);
  const double depth = std::abs(joints[other].start.eccentricity) - 1e-3;
  if (tension > 0) {
    EXPECT_TRUE(pressed);
    EXPECT_NEAR(normal_force(joints[other].law, depth, 0, 1), tension, 1e-6 * tension);
    EXPECT_NEAR(run.energy_step, elastic_energy(joints[other].law, depth), 1e-4 * run.peak_energy);
  }
  EXPECT_LT(run.largest_drift, 1e-6 * run.peak_energy + std::abs(run.energy_step));
}

// A start without tension switches at once, and its first row is one of real contact.
TEST(AutomaticContact, StartsInFlightWhereThereIsNoTension) {
  Lost lost;
  const AutomaticContactRun until = simulate_automatic_contact(
      lost.linkage, std::span(&lost.pin, 1), std::span(&lost.crank, 1), std::vector{0.0, full_turn / 10});
  ASSERT_GE(until.pin, 0);
  lost.crank = {math::ConstantSpeed{10 * (until.switched + 1e-5), 10}, 0, 0};
  const ClearanceState& end = until.continuous.end[0];
  lost.pin.angle = end.angle + 1e-5 * end.rate;
  lost.pin.rate = end.rate + 1e-5 * end.acceleration;
  std::vector<double> at;
  const AutomaticContactRun run =
      simulate_automatic_contact(lost.linkage, std::span(&lost.pin, 1), std::span(&lost.crank, 1),
                                 std::vector{0.0, 1e-3}, {}, {.contact = [&](const ContactRow& row) {
                                   at.push_back(row.time);
                                   return true;
                                 }});
  ASSERT_EQ(run.status, Status::done) << run.message;
  EXPECT_EQ(run.switched, 0);
  EXPECT_EQ(at, (std::vector{0.0, 1e-3}));
}

TEST(AutomaticContact, GivesUpWhenAllStepsAreUsed) {
  const Lost lost;
  const AutomaticContactRun run = simulate_automatic_contact(
      lost.linkage, std::span(&lost.pin, 1), std::span(&lost.crank, 1), lost.times, {.max_steps = 400});
  EXPECT_EQ(run.status, Status::not_converged);
  EXPECT_FALSE(std::isnan(run.switched));
  EXPECT_EQ(run.steps, 400);
  EXPECT_THAT(run.message, ::testing::HasSubstr("steps used up"));
}

}  // namespace
}  // namespace linkwright::clearance
