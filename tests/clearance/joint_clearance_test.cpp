// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/joint_clearance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearance/clearance_linkages.h"
#include "clearance/published_four_bar.h"
#include "linkwright/clearance/four_bar_clearance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/samples.h"
#include "linkwright/planar/simulation/coordinates.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

struct Rows {
  JointClearanceRun run;
  std::vector<std::vector<ClearanceState>> joints;
  std::vector<double> drift;
};
Rows simulated(const planar::Linkage& l, const std::vector<JointClearance>& clearances, double speed,
               const std::vector<double>& times, double tolerance = 1e-11) {
  Rows out;
  const planar::InputDrive crank{math::ConstantSpeed{0, speed}, 0, 0};
  out.run = simulate_joint_clearance(l, clearances, std::span(&crank, 1), times,
                                     {.relative_tolerance = tolerance, .absolute_tolerance = tolerance},
                                     [&](const JointClearanceRow& row) {
                                       out.joints.emplace_back(row.joints.begin(), row.joints.end());
                                       out.drift.push_back(row.instant.drift);
                                       return true;
                                     });
  return out;
}

// The general machinery knows nothing of the closed form of the four-bar: groups, Kane's equations and joint
// forces against angles by hand.
TEST(JointClearance, FourBarAgreesWithItsClosedForm) {
  for (const char* id : {"gamma-design2-table3-g9.81-w20", "gamma-design2-damped"}) {
    ClearanceFourBar model = published_four_bar(id);
    if (std::string_view(id) == "gamma-design2-damped") {
      model.coupler_damping = 1e-5;
      model.rocker_damping = 2e-5;
      model.link_damping = 1e-7;
    }
    const std::vector<double> times = evenly_spaced(0, full_turn / 20, 73);
    const planar::Linkage l = as_linkage(model);
    const Rows rows = simulated(l,
                                {{.joint = planar::joint_index(l, "A"),
                                  .clearance = model.clearance,
                                  .angle = 0.1,
                                  .rate = 20,
                                  .damping = model.link_damping}},
                                20, times);
    ASSERT_EQ(rows.run.status, Status::done) << rows.run.message;
    std::size_t k = 0;
    const ClearanceRun run = simulate_clearance(
        model, math::ConstantSpeed{0, 20}, {0.1, 20}, times, {.relative = 1e-12, .absolute = 1e-13},
        [&](const ClearanceRow& row) {
          const ClearanceState& s = rows.joints.at(k++).at(0);
          EXPECT_NEAR(s.angle, row.link.angle, 1e-9);
          EXPECT_NEAR(s.rate, row.link.rate, 1e-9 * 400);  // rates of up to 200 rad/s
          EXPECT_NEAR(s.acceleration / row.instant->link_acceleration, 1, 1e-7) << row.time;
          EXPECT_NEAR(s.tension, row.instant->tension, 1e-8);
          return true;
        });
    EXPECT_EQ(k, times.size());
    EXPECT_TRUE(std::isnan(rows.run.joints[0].first_separation));
    EXPECT_EQ(rows.run.joints[0].sign_changes, 0);
    EXPECT_NEAR(rows.run.joints[0].min_tension, run.min_tension, 0.05);  // steps are not the same
  }
}

// Times of the loss of contact are events of the integration: those of the closed form, whatever the rows.
TEST(JointClearance, SeesSeparationAsTheClosedFormDoes) {
  const ClearanceFourBar model = published_four_bar("gamma-design1-table2-g9.81-w50");
  const planar::Linkage l = as_linkage(model);
  const double to = 0.6 * full_turn / 50, degree = full_turn / 360;
  const std::vector<JointClearance> pin{
      {.joint = planar::joint_index(l, "A"), .clearance = 1e-3, .angle = 10 * degree, .rate = 50}};
  const ClearanceRun wanted =
      simulate_clearance(model, math::ConstantSpeed{0, 50}, {10 * degree, 50}, std::vector{0.0, to},
                         {.relative = 1e-12, .absolute = 1e-13});
  ASSERT_FALSE(std::isnan(wanted.first_separation));
  std::vector<ContactValidity> found;
  for (const int rows : {2, 21, 2001})
    found.push_back(simulated(l, pin, 50, evenly_spaced(0, to, rows), 1e-12).run.joints[0]);
  for (const ContactValidity& v : found) {
    // The motion is violent: what the two integrations differ by grows a thousandfold.
    EXPECT_NEAR(v.first_separation, wanted.first_separation, 1e-10);
    EXPECT_NEAR(v.separated, wanted.separated, 1e-7);
    EXPECT_EQ(v.sign_changes, wanted.sign_changes);
    // Steps do not see the rows.
    EXPECT_EQ(v.first_separation, found[0].first_separation);
    EXPECT_EQ(v.separated, found[0].separated);
  }
  EXPECT_GT(wanted.separated, 0.05);
}

// A run that is to stop does so on the far side of the loss, and the state there is one to go on from.
TEST(JointClearance, StopsWhereContactIsLost) {
  const ClearanceFourBar model = published_four_bar("gamma-design1-table2-g9.81-w50");
  const planar::Linkage l = as_linkage(model);
  const planar::InputDrive crank{math::ConstantSpeed{0, 50}, 0, 0};
  const JointClearance pin{
      .joint = planar::joint_index(l, "A"), .clearance = 1e-3, .angle = 10 * full_turn / 360, .rate = 50};
  const std::vector<double> times = evenly_spaced(0, full_turn / 50, 101);
  std::size_t rows = 0;
  double last = -1;
  const auto run = [&](const JointClearance& from, double shift) {
    rows = 0;
    const planar::InputDrive drive{math::ConstantSpeed{50 * shift, 50}, 0, 0};
    return simulate_joint_clearance(
        l, std::span(&from, 1), std::span(&drive, 1), times,
        {.relative_tolerance = 1e-11, .absolute_tolerance = 1e-12},
        [&](const JointClearanceRow& row) {
          ++rows;
          last = row.instant.time;
          return true;
        },
        nullptr, AtSeparation::stop);
  };
  const JointClearanceRun whole =
      simulate_joint_clearance(l, std::span(&pin, 1), std::span(&crank, 1), times,
                               {.relative_tolerance = 1e-11, .absolute_tolerance = 1e-12});
  const JointClearanceRun part = run(pin, 0);
  ASSERT_EQ(part.status, Status::done) << part.message;
  EXPECT_EQ(part.parted, 0);
  EXPECT_EQ(part.simulation.time, part.joints[0].first_separation);
  EXPECT_EQ(part.simulation.time, whole.joints[0].first_separation);
  EXPECT_LE(last, part.simulation.time);
  EXPECT_LT(rows, times.size());
  EXPECT_LE(part.end[0].tension, 0);
  EXPECT_GT(part.end[0].tension, -1e-6);
  EXPECT_EQ(part.end[0].tension, part.joints[0].min_tension);
  EXPECT_NEAR(part.inputs[0].value, 50 * part.simulation.time, 1e-12);
  EXPECT_LT(whole.parted, 0);
  // A start without contact has no row at all. Two millionths of a turn after the loss the tension is
  // negative.
  JointClearance later = pin;
  later.angle = part.end[0].angle + 2e-6 * part.end[0].rate;
  later.rate = part.end[0].rate + 2e-6 * part.end[0].acceleration;
  const JointClearanceRun none = run(later, part.simulation.time + 2e-6);
  EXPECT_EQ(none.status, Status::done);
  EXPECT_EQ(none.parted, 0);
  EXPECT_EQ(rows, 0u);
  EXPECT_EQ(none.simulation.time, 0);
  EXPECT_LT(none.end[0].tension, 0);
}

// Clearance within a dyad: no closed form. The other route is that in the places of all bodies.
TEST(JointClearance, PinsWithinADyadAndSeveralAtOnce) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w20");
  model.coupler.centre = {0.1, 0.01};
  model.rocker.centre = {0.12, 0};
  const planar::Linkage l = as_linkage(model);
  const std::vector<double> times = evenly_spaced(0, 0.02, 5);
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"B"}, {"O4"}, {"A", "O4"}, {"A", "B", "O4"}}) {
    std::vector<JointClearance> clearances;
    for (const std::string& name : names)
      clearances.push_back({.joint = planar::joint_index(l, name),
                            .clearance = 0.01,
                            .angle = 0.3 + static_cast<double>(clearances.size()),
                            .rate = 5});
    const Rows rows = simulated(l, clearances, 20, times, 1e-10);
    ASSERT_EQ(rows.run.status, Status::done) << names[0] << ": " << rows.run.message;
    EXPECT_NEAR(rows.joints[0][0].angle, 0.3, 1e-12);
    EXPECT_NEAR(rows.joints[0][0].rate, 5, 1e-11);
    EXPECT_LT(rows.run.simulation.largest_drift, 1e-8 * rows.run.simulation.peak_energy);

    const ClearedLinkage cleared = with_clearance(l, clearances, std::vector{0.0});
    ASSERT_EQ(cleared.status, Status::done);
    EXPECT_EQ(cleared.plan.inputs(), 1 + names.size());
    EXPECT_TRUE(cleared.plan.closed_form()) << names[0];
    // The same start for the other route: the inputs at the first row.
    std::vector<planar::InputDrive> drives{{math::ConstantSpeed{0, 20}, 0, 0}};
    const planar::InputDrive crank = drives[0];
    simulate_joint_clearance(l, clearances, std::span(&crank, 1), times, {},
                             [&](const JointClearanceRow& row) {
                               for (const ClearanceBar& bar : cleared.bars) {
                                 const auto input = row.instant.inputs[static_cast<std::size_t>(bar.input)];
                                 drives.push_back({{}, input.value, input.rate});
                               }
                               return false;
                             });
    std::size_t k = 0;
    planar::simulate_all_coordinates(
        cleared.linkage, cleared.plan, drives, times, {.relative_tolerance = 1e-10},
        [&](const planar::SimulationInstant& now) {
          for (std::size_t j = 0; j < cleared.bars.size(); ++j) {
            const auto& s = now.motion->parts[static_cast<std::size_t>(cleared.bars[j].body)];
            EXPECT_NEAR(math::angle_difference(math::angle_of(s.direction), rows.joints[k][j].angle), 0, 1e-7)
                << names[j] << " row " << k;
          }
          ++k;
          return true;
        });
    EXPECT_EQ(k, times.size());
  }
}

// Any linkage: a leg with seven bodies, clearance in a pin on the ground.
TEST(JointClearance, AnyLinkage) {
  planar::LinkageSample sample = planar::jansen_leg_sample();
  planar::Linkage l = sample.linkage;
  for (std::size_t b = 1; b < l.bodies.size(); ++b) ASSERT_TRUE(l.bodies[b].mass);
  int joint = -1;
  for (std::size_t j = 0; j < l.joints.size(); ++j)
    if (l.joints[j].first.body != 0 && l.joints[j].second.body != 0) joint = static_cast<int>(j);
  ASSERT_GE(joint, 0);
  const double c = 1e-3 * planar::size_of(l);
  const JointClearance clearance{.joint = joint, .clearance = c, .angle = -1.5};
  const planar::InputDrive crank{math::ConstantSpeed{sample.from[0], 2}, 0, 0};
  const JointClearanceRun run =
      simulate_joint_clearance(l, std::span(&clearance, 1), std::span(&crank, 1), std::vector{0.0, 0.01}, {});
  ASSERT_EQ(run.status, Status::done) << run.message;
  EXPECT_LT(run.simulation.largest_drift, 1e-7 * run.simulation.peak_energy);
}

// For vanishing clearance the tension becomes the force of the ideal joint, and the path its path, both with
// the first power of the clearance: the start is where that force presses, turning as it does.
TEST(JointClearance, TheIdealJointIsTheLimit) {
  const ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w50");
  ClearanceFourBar ideal = model;
  ideal.clearance = 0;
  const double direction = force_direction(model, 0, 50, 0), h = 1e-5;
  const double pace = 50 * math::angle_difference(force_direction(model, h, 50, 0), direction) / h;
  const planar::InputDrive crank{math::ConstantSpeed{0, 50}, 0, 0};
  double force_before = 0, path_before = 0;
  for (const double c : {1e-3, 2.5e-4}) {
    ClearanceFourBar loose = model;
    loose.clearance = c;
    const planar::Linkage l = as_linkage(loose);
    const std::size_t p = 2;  // "P" of the coupler
    const JointClearance pin{
        .joint = planar::joint_index(l, "A"), .clearance = c, .angle = direction, .rate = pace};
    const ClearedLinkage cleared = with_clearance(l, std::span(&pin, 1), std::vector{0.0});
    double force = 0, path = 0;
    const JointClearanceRun run = simulate_joint_clearance(
        l, std::span(&pin, 1), std::span(&crank, 1), evenly_spaced(0, 0.03, 61),
        {.relative_tolerance = 1e-11, .absolute_tolerance = 1e-12}, [&](const JointClearanceRow& row) {
          const ClearanceInstant wanted = clearance_instant(ideal, 50 * row.instant.time, 50, 0, {});
          force = std::max(force, std::abs(row.joints[0].tension / std::abs(wanted.pin_force) - 1));
          const std::complex<double> point = number(
              planar::point_motion(cleared.plan, *row.instant.motion, 2, l.bodies[2].points[p].at).position);
          path = std::max(path, std::abs(point - wanted.position.point));
          return true;
        });
    ASSERT_EQ(run.status, Status::done) << run.message;
    EXPECT_LT(run.simulation.largest_drift, 1e-6 * run.simulation.peak_energy);
    if (force_before > 0) {
      EXPECT_NEAR(std::log(path_before / path) / std::log(4.0), 1, 0.2) << c;
      EXPECT_GT(std::log(force_before / force) / std::log(4.0), 0.7) << c;
    }
    force_before = force;
    path_before = path;
  }
}

TEST(JointClearance, RefusesWhatIsNoFreePin) {
  const planar::Linkage l = as_linkage(published_four_bar("gamma-design2-table3-g9.81-w20"));
  const auto text = [&](std::vector<JointClearance> c) {
    return test::message([&] { with_clearance(l, c, std::vector{0.0}); });
  };
  EXPECT_THAT(text({{.joint = 0, .clearance = 1e-3}}),
              ::testing::HasSubstr("joint 'O2' must be a revolute joint without drive and friction"));
  EXPECT_THAT(text({{.joint = 7, .clearance = 1e-3}}), ::testing::HasSubstr("there is no joint 7 among 4"));
  EXPECT_THAT(text({{.joint = 1, .clearance = 0}}),
              ::testing::HasSubstr("joint 'A': clearance 0 m must be positive"));
  EXPECT_THAT(text({{.joint = 1, .clearance = 1e-3}, {.joint = 1, .clearance = 1e-3}}),
              ::testing::HasSubstr("joint 'A' is given twice"));
}

TEST(JointClearance, SaysWhenTheIdealLinkageHasNoStart) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w20");
  model.linkage.coupler = 0.01;
  const planar::Linkage l = as_linkage(model);
  const JointClearance clearance{.joint = 1, .clearance = 1e-3};
  const ClearedLinkage none = with_clearance(l, std::span(&clearance, 1), std::vector{0.0});
  EXPECT_EQ(none.status, Status::no_assembly);
  EXPECT_THAT(none.message, ::testing::HasSubstr("without clearance the start does not work"));
}

}  // namespace
}  // namespace linkwright::clearance
