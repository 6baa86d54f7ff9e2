// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/contact_simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearance/contact_cases.h"
#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

ContactRun slider_crank(double friction, double to, const ContactOptions& options = {}, int rows = 2,
                        const ContactOutput& output = {}) {
  const planar::Linkage l = contact_slider_crank();
  const ContactJoint joint = slider_crank_joint(l, friction);
  const planar::InputDrive crank = uniform_crank(slider_crank_speed);
  return simulate_contact(l, std::span(&joint, 1), std::span(&crank, 1), evenly_spaced(0, to, rows), options,
                          output);
}

void compare(const std::vector<ContactEvent>& events, const Value& wanted, std::size_t count) {
  ASSERT_GE(events.size(), count);
  for (std::size_t k = 0; k < count; ++k) {
    const Value& w = wanted.as_array().at(k);
    // Each contact multiplies what differs before it; the reference stopped its steps at 1e-9 or so.
    const double tolerance = 1e-5;
    EXPECT_NEAR(events[k].start / test::number_at(w, "start_s"), 1, tolerance) << k;
    EXPECT_NEAR(events[k].end / test::number_at(w, "end_s"), 1, tolerance) << k;
    EXPECT_NEAR(events[k].approach / test::number_at(w, "approach_m_s"), 1, tolerance) << k;
    EXPECT_NEAR(math::angle_difference(events[k].angle, test::number_at(w, "angle_rad")), 0, 1e-4) << k;
    // The reference gives the largest value at its steps.
    EXPECT_NEAR(events[k].force / test::number_at(w, "F_max_N"), 1, 2e-4) << k;
  }
}

TEST(ContactSimulation, SliderCrankOfTheLiterature) {
  const ContactRun run = slider_crank(0, 1e-3);
  ASSERT_EQ(run.status, Status::done) << run.message;
  compare(run.events, test::at(computed("slider-crank-contact"), "contacts"), 3);
}

TEST(ContactSimulation, SliderCrankWithFriction) {
  const ContactRun run = slider_crank(0.03, 1e-3);
  ASSERT_EQ(run.status, Status::done) << run.message;
  compare(run.events, test::at(computed("slider-crank-contact"), "contacts_with_friction.events"), 2);
}

// The slider alone, along its guide, against a rod that cannot give way: its speeds before and after give the
// restitution of the law, and the flight between two impacts its clearance.
TEST(ContactSimulation, RestitutionAndFlightOfASlider) {
  const planar::Linkage l = contact_slider_crank();
  for (const ContactDamping damping : {ContactDamping::lankarani_nikravesh, ContactDamping::flores_2011}) {
    ContactJoint joint = slider_crank_joint(l);
    joint.law.restitution = 0.7;
    joint.law.damping = damping;
    joint.start.rate = -0.5;  // the pin on the rod seen from the bush on the slider
    const planar::InputDrive crank{math::ConstantSpeed{0, 0}, 0, 0};
    const ContactRun run =
        simulate_contact(l, std::span(&joint, 1), std::span(&crank, 1), std::vector{0.0, 9e-3});
    ASSERT_EQ(run.status, Status::done) << run.message;
    ASSERT_GE(run.events.size(), 3u);
    const double e = effective_restitution(joint.law);
    for (std::size_t k = 0; k < 3; ++k) {
      const ContactEvent& event = run.events[k];
      EXPECT_NEAR(event.approach, 0.5 * std::pow(e, static_cast<double>(k)), 1e-7);
      EXPECT_NEAR(event.separation / event.approach, e, 1e-6);
      const double from = k == 0 ? 0 : run.events[k - 1].end,
                   way = k == 0 ? joint.clearance : 2 * joint.clearance;
      EXPECT_NEAR(event.start, from + way / event.approach, 1e-9);
      EXPECT_NEAR(std::abs(event.angle), k % 2 == 0 ? full_turn / 2 : 0, 1e-9);
    }
  }
}

TEST(ContactSimulation, AnImpactAsComputedElsewhere) {
  const planar::Linkage l = contact_slider_crank();
  const Value& example = test::at(computed("contact-restitution"), "example");
  ContactJoint joint = slider_crank_joint(l);
  joint.law.stiffness = test::number_at(example, "K");
  joint.start.rate = -test::number_at(example, "v_m_s");
  const planar::InputDrive crank{math::ConstantSpeed{0, 0}, 0, 0};
  const ContactRun run =
      simulate_contact(l, std::span(&joint, 1), std::span(&crank, 1), std::vector{0.0, 2e-3});
  ASSERT_GE(run.events.size(), 1u);
  EXPECT_NEAR(run.events[0].depth / test::number_at(example, "delta_max_m"), 1, 1e-6);
  EXPECT_NEAR(run.events[0].force / test::number_at(example, "F_max_N"), 1, 1e-5);
  EXPECT_NEAR((run.events[0].end - run.events[0].start) / test::number_at(example, "duration_s"), 1, 1e-5);
  EXPECT_NEAR(run.events[0].separation / run.events[0].approach, test::number_at(example, "e"), 1e-6);
}

// Rows are looked at, not stepped to.
TEST(ContactSimulation, RowsChangeNothing) {
  const ContactRun few = slider_crank(0, 4e-3, {}, 11), many = slider_crank(0, 4e-3, {}, 1001);
  ASSERT_GE(few.events.size(), 8u);
  ASSERT_EQ(few.events.size(), many.events.size());
  for (std::size_t k = 0; k < few.events.size(); ++k) {
    EXPECT_EQ(few.events[k].start, many.events[k].start) << k;
    EXPECT_EQ(few.events[k].force, many.events[k].force) << k;
  }
  EXPECT_EQ(few.steps, many.steps);
}

TEST(ContactSimulation, ConvergesWithTheTolerance) {
  const auto start = [](double tolerance) {
    return slider_crank(0, 4e-3, {.tolerance = tolerance}).events.at(10).start;
  };
  const double best = start(1e-12);
  EXPECT_NEAR(best, 3.871314e-3, 1e-9);
  EXPECT_LT(std::abs(start(1e-10) - best), 5e-10);
  EXPECT_LT(std::abs(start(1e-9) - best), 5e-9);
  EXPECT_LT(std::abs(start(1e-7) - best), 1e-7);
}

// Elastic contacts: what the drive puts in is in motion, weight and contacts.
TEST(ContactSimulation, EnergyIsAccountedFor) {
  planar::Linkage l = contact_slider_crank();
  l.gravity = {0, -9.81};
  for (const double restitution : {1.0, 0.8}) {
    std::vector<ContactJoint> joints{slider_crank_joint(l), slider_crank_joint(l, 0, "A")};
    for (ContactJoint& j : joints) {
      j.law.restitution = restitution;
      j.law.damping = ContactDamping::flores_2011;
      j.law.friction = restitution < 1 ? 0.05 : 0;
    }
    const planar::InputDrive crank = uniform_crank(200);
    double dissipated = 0, work = 0, elastic = 0;
    bool rising = true;
    const ContactRun run = simulate_contact(l, joints, std::span(&crank, 1), evenly_spaced(0, 0.02, 2001),
                                            {.tolerance = 1e-11}, [&](const ContactRow& row) {
                                              rising = rising && row.dissipated >= dissipated - 1e-9;
                                              dissipated = row.dissipated;
                                              work = row.work;
                                              elastic = std::max(elastic, row.elastic);
                                              return true;
                                            });
    ASSERT_EQ(run.status, Status::done) << run.message;
    EXPECT_GT(run.events.size(), 10u);
    EXPECT_LT(run.largest_drift, 1e-6 * run.peak_energy) << restitution;
    EXPECT_TRUE(rising);
    EXPECT_GT(elastic, 0.01);
    EXPECT_NE(work, 0);
    if (restitution == 1)
      EXPECT_NEAR(dissipated, 0, 1e-12);
    else
      EXPECT_GT(dissipated, 0.1);
  }
}

// Both models agree where the tension of continuous contact stays positive.
TEST(ContactSimulation, PressedContactIsContinuousContact) {
  const ClearanceFourBar model = published_four_bar("gamma-design2-table3-g0-w10");
  const Value& wanted = computed("fourbar-contact-vs-continuous");
  const planar::Linkage l = as_linkage(model);
  ContactJoint joint{.joint = planar::joint_index(l, "A"),
                     .clearance = 1e-3,
                     .bush_radius = 0.01,
                     .law = {.stiffness = pin_stiffness(0.01, 0.009),
                             .restitution = 0.5,
                             .damping = ContactDamping::lankarani_nikravesh}};
  EXPECT_NEAR(joint.law.stiffness / test::number_at(wanted, "K"), 1, 1e-12);
  const double angle = 10 * full_turn / 360;
  // From bush to pin, against the direction of the clearance link.
  joint.start = {-std::polar(1e-3, angle), -std::polar(1e-3 * 10, angle + full_turn / 4)};
  const planar::InputDrive crank = uniform_crank(10);
  const std::vector<double> times = evenly_spaced(0, full_turn / 10, 121);
  std::vector<double> link, tension;
  simulate_clearance(model, math::ConstantSpeed{0, 10}, {angle, 10}, times, {}, [&](const ClearanceRow& row) {
    link.push_back(row.link.angle);
    tension.push_back(row.instant->tension);
    return true;
  });
  std::size_t k = 0;
  double off = 0, depth = 0, force = 0;
  const ContactRun run =
      simulate_contact(l, std::span(&joint, 1), std::span(&crank, 1), times, {}, [&](const ContactRow& row) {
        off = std::max(off, std::abs(math::angle_difference(std::arg(-row.joints[0].eccentricity), link[k])));
        depth = std::max(depth, row.joints[0].depth);
        if (k > 0) force = std::max(force, std::abs(row.joints[0].normal / tension[k] - 1));
        ++k;
        return true;
      });
  ASSERT_EQ(run.status, Status::done) << run.message;
  EXPECT_EQ(run.events.size(), 1u);  // never apart
  EXPECT_LT(off, 1e-3);              // 4.8e-4 elsewhere
  EXPECT_NEAR(depth, test::number_at(wanted, "max_penetration_m"), 5e-9);
  EXPECT_LT(force, 0.01);
}

// Pressed pins with vanishing clearance carry the force of the ideal joint.
TEST(ContactSimulation, TheIdealJointIsTheLimit) {
  const ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w50");
  const planar::Linkage l = as_linkage(model);
  ClearanceFourBar ideal = model;
  ideal.clearance = 0;
  double before = 0;
  for (const double c : {1e-3, 1e-4}) {
    ContactJoint joint{.joint = planar::joint_index(l, "A"),
                       .clearance = c,
                       .bush_radius = 0.01,
                       .law = {.stiffness = 1e10, .restitution = 0.5}};
    const double direction = force_direction(model, 0, 50, 0), h = 1e-5;
    const double pace = 50 * math::angle_difference(force_direction(model, h, 50, 0), direction) / h;
    joint.start = {-std::polar(c, direction), -std::polar(c * pace, direction + full_turn / 4)};
    const planar::InputDrive crank = uniform_crank(50);
    double worst = 0;
    const ContactRun run = simulate_contact(
        l, std::span(&joint, 1), std::span(&crank, 1), evenly_spaced(0, 0.03, 61), {},
        [&](const ContactRow& row) {
          if (row.time < 1e-3) return true;  // until the contact has settled
          const double force = std::abs(clearance_instant(ideal, 50 * row.time, 50, 0, {}).pin_force);
          worst = std::max(worst, std::abs(row.joints[0].normal / force - 1));
          return true;
        });
    ASSERT_EQ(run.status, Status::done) << run.message;
    EXPECT_EQ(run.events.size(), 1u) << c;
    EXPECT_LT(worst, c == 1e-3 ? 0.3 : 0.03);
    if (before > 0) {
      EXPECT_LT(worst, before / 3);
    }
    before = worst;
  }
}

// Any joints of a four-bar; with clearance at both of its pins the coupler hangs on nothing.
TEST(ContactSimulation, AnyPinsOfAFourBar) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w20");
  model.coupler.centre = {0.1, 0};
  const planar::Linkage l = as_linkage(model);
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"A"}, {"B"}, {"O4"}, {"A", "B"}, {"A", "B", "O4"}}) {
    std::vector<ContactJoint> joints;
    for (const std::string& name : names)
      joints.push_back({.joint = planar::joint_index(l, name),
                        .clearance = 2e-4,
                        .bush_radius = 0.01,
                        .law = {.stiffness = 1e9, .restitution = 0.8, .friction = 0.02}});
    const planar::InputDrive crank = uniform_crank(20);
    double off = 0;
    const ContactRun run = simulate_contact(l, joints, std::span(&crank, 1), evenly_spaced(0, 0.05, 51),
                                            {.tolerance = 1e-10}, [&](const ContactRow& row) {
                                              for (const ContactState& s : row.joints)
                                                off = std::max(off, std::abs(s.eccentricity));
                                              return true;
                                            });
    ASSERT_EQ(run.status, Status::done) << names.size() << names[0] << ": " << run.message;
    EXPECT_GT(run.events.size(), names.size());
    EXPECT_LT(run.largest_drift, 2e-6 * run.peak_energy) << names.size() << names[0];
    EXPECT_LT(off, 2e-4 + 3e-5);  // pressed in by some hundredths of a millimetre
  }
}

// A pin that grazes its bush at the start: pressed on by its motion around it, it is in contact with an
// approach of zero, which min_approach keeps finite; moving away it is free.
TEST(ContactSimulation, GrazingStarts) {
  const planar::Linkage l = contact_slider_crank();
  const planar::InputDrive crank{math::ConstantSpeed{0, 0}, 0, 0};
  for (const bool pressed : {true, false}) {
    ContactJoint joint = slider_crank_joint(l);
    joint.start.eccentricity = -5e-4;
    joint.start.rate = pressed ? std::complex<double>(0, 0.5) : std::complex<double>(1e-3, 0);
    double force = 0;
    const ContactRun run = simulate_contact(l, std::span(&joint, 1), std::span(&crank, 1),
                                            evenly_spaced(0, 2e-4, 21), {}, [&](const ContactRow& row) {
                                              if (row.time > 0) force = std::max(force, row.joints[0].normal);
                                              return true;
                                            });
    ASSERT_EQ(run.status, Status::done) << run.message;
    ASSERT_EQ(run.events.size(), pressed ? 1u : 0u);
    if (!pressed) continue;
    EXPECT_EQ(run.events[0].start, 0);
    EXPECT_LT(run.events[0].approach, min_approach);
    // On the circle about the end of the rod: m v^2 / c at most, with the mass that the slider and the rod
    // have along the force, 0.35 kg together at most.
    EXPECT_GT(force, 1);
    EXPECT_LT(force, 0.35 * 0.25 / 5e-4);
    EXPECT_LT(run.largest_drift, 1e-6 * run.peak_energy);
  }
}

TEST(ContactSimulation, CountsAllStepsWhenTheyAreUsedUp) {
  const ContactRun run = slider_crank(0, 4e-3, {.max_steps = 300});
  EXPECT_EQ(run.status, Status::not_converged);
  EXPECT_EQ(run.steps, 300);
  EXPECT_THAT(run.message, ::testing::HasSubstr(": 300 steps used up"));
  ASSERT_GE(run.events.size(), 2u) << "what had happened is kept";
  EXPECT_NEAR(run.events[0].start, 2.2728603e-4, 2e-9);
}

TEST(ContactSimulation, RefusesWhatIsNoBush) {
  const planar::Linkage l = contact_slider_crank();
  const planar::InputDrive crank = uniform_crank(1);
  const auto text = [&](const ContactJoint& j) {
    return test::message([&] {
      simulate_contact(l, std::span(&j, 1), std::span(&crank, 1), std::vector{0.0, 1.0});
    });
  };
  ContactJoint joint = slider_crank_joint(l);
  joint.clearance = 0;
  EXPECT_THAT(text(joint), ::testing::HasSubstr("clearance 0 m in a bush of 0.01 m"));
  joint = slider_crank_joint(l);
  joint.start.eccentricity = 1e-3;
  EXPECT_THAT(text(joint),
              ::testing::HasSubstr("pin 0.001 m off the middle of its bush, clearance 0.0005 m"));
  joint = slider_crank_joint(l);
  joint.law.stiffness = 0;
  EXPECT_THAT(text(joint), ::testing::HasSubstr("stiffness 0"));
  joint = slider_crank_joint(l);
  joint.law.restitution = 1.5;
  EXPECT_THAT(text(joint), ::testing::HasSubstr("restitution 1.5"));
  joint = slider_crank_joint(l);
  EXPECT_THAT(test::message([&] {
                simulate_contact(l, std::span(&joint, 1), std::span(&crank, 1), std::vector{0.0, 1.0},
                                 {.tolerance = 0});
              }),
              ::testing::HasSubstr("tolerance 0, step in contact 0.05"));
  joint = slider_crank_joint(l, 0, "guide");
  EXPECT_THAT(text(joint),
              ::testing::HasSubstr("joint 'guide' must be a revolute joint without drive and friction"));
}

// Only the first contacts of a long motion are listed, and the totals are those of all.
TEST(ContactSimulation, ListsNoMoreContactsThanAskedForAndCountsAll) {
  const ContactRun all = slider_crank(0, 8e-3, {}), few = slider_crank(0, 8e-3, {.max_events = 3});
  ASSERT_GT(all.events.size(), 10u);
  ASSERT_EQ(few.events.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(few.events[k].start, all.events[k].start);
    EXPECT_EQ(few.events[k].end, all.events[k].end);
    EXPECT_EQ(few.events[k].force, all.events[k].force);
  }
  ASSERT_EQ(few.totals.size(), 1u);
  double touching = 0, force = 0, approach = 0, depth = 0, shortest = infinity;
  for (const ContactEvent& e : all.events) {
    touching += (std::isnan(e.end) ? all.time : e.end) - e.start;
    force = std::max(force, e.force);
    approach = std::max(approach, e.approach);
    depth = std::max(depth, e.depth);
    if (!std::isnan(e.end)) shortest = std::min(shortest, e.end - e.start);
  }
  for (const ContactTotals& of : {few.totals[0], all.totals.at(0)}) {
    EXPECT_EQ(of.contacts, static_cast<long>(all.events.size()));
    EXPECT_EQ(of.touching, touching);
    EXPECT_EQ(of.force, force);
    EXPECT_EQ(of.approach, approach);
    EXPECT_EQ(of.depth, depth);
    EXPECT_EQ(of.shortest, shortest);
  }
}

}  // namespace
}  // namespace linkwright::clearance
