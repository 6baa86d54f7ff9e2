// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/pose_completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

const CarrierTarget& state(const test::Example& e, double travel, double rack) {
  for (const CarrierTarget& pose : e.targets.poses)
    if (std::abs(pose.centre.z - e.targets.wheel.centre.z - travel) < 1e-9 &&
        std::abs(pose.rack - rack) < 1e-9)
      return pose;
  throw std::runtime_error("no such state");
}

TEST(PoseCompletion, DyadOfTheSource) {
  for (const Value& row : test::at(published("rs-dyad-spin"), "computed.rows").as_array()) {
    const test::Example e = test::published_example(test::at(row, "mechanism").as_string() + "-forward");
    const CornerLink& rod = e.links[static_cast<std::size_t>(test::number_at(row, "link_1based")) - 1];
    const CarrierTarget& pose = state(e, test::number_at(row, "travel_m"), test::number_at(row, "rack_m"));
    const RsDyad dyad = rs_dyad(e.targets, pose, rod);
    EXPECT_EQ(dyad.status, Status::done);
    EXPECT_NEAR(dyad.e, test::number_at(row, "E_m2"), 1e-10);
    EXPECT_NEAR(dyad.f, test::number_at(row, "F_m2"), 1e-10);
    EXPECT_NEAR(dyad.g, test::number_at(row, "G_m2"), 1e-10);
    EXPECT_NEAR(dyad.relative, test::number_at(row, "beta_rel_rad"), 1e-10);
    EXPECT_NEAR(dyad.other, test::number_at(row, "beta_rel_other_branch_rad"), 1e-10);
    // The carrier pitch of (50) is another angle of the same rotation.
    const double carrier_pitch = test::number_at(row, "beta_nt_rad");
    EXPECT_NEAR(wheel_angles(Side::left, e.targets.wheel, dyad.rotation).carrier_pitch, carrier_pitch, 1e-10);
    EXPECT_NEAR(solve_for(e.targets, pose, rod, PoseParameter::carrier_pitch).value, carrier_pitch, 1e-10);
    EXPECT_GT(std::abs(dyad.relative - carrier_pitch), 3e-5);
  }
}

TEST(PoseCompletion, DyadAndClosedFormTurnTheCarrierAlike) {
  for (const char* id : {"ex1-forward", "ex2-forward", "ex4-forward", "mechanism-5US", "mechanism-RS-3US"}) {
    const test::Example e = test::published_example(id);
    for (const CornerLink& rod : e.links) {
      if (rod.type != LinkType::US) continue;
      for (const CarrierTarget& pose : e.targets.poses) {
        const RsDyad dyad = rs_dyad(e.targets, pose, rod);
        const RodSolution carrier_pitch = solve_for(e.targets, pose, rod, PoseParameter::carrier_pitch);
        ASSERT_EQ(dyad.status, carrier_pitch.status) << id;
        CarrierTarget turned = pose;
        turned.angles.carrier_pitch = carrier_pitch.value;
        const Mat3 r = target_rotation(e.targets, turned);
        // Next to the end of the rod's reach an error of the length counts by its root.
        for (int k = 0; k < 3; ++k) EXPECT_LT(norm(r.row[k] - dyad.rotation.row[k]), 1e-7) << id;
        // The other branch keeps the length, too.
        turned.angles.carrier_pitch = carrier_pitch.other;
        const Vec3 p =
            place({pose.centre, target_rotation(e.targets, turned)}, rod.carrier[0], e.targets.wheel.centre);
        const Vec3 body = rod.moved_by_rack ? rod.body[0] + pose.rack * Vec3{0, 1, 0} : rod.body[0];
        EXPECT_NEAR(norm(p - body), norm(rod.carrier[0] - rod.body[0]), 1e-12) << id;
      }
    }
  }
}

TEST(PoseCompletion, EveryParameterComesBack) {
  // All rods of the rear suspension, each parameter in turn, through the dead point of link 3 for the carrier
  // pitch. The dead point of links 1 and 4 for the height lies next to the reference: nothing distinguishes
  // the sides.
  const test::Example e = test::published_example("ex4-forward");
  for (const auto& parameter : names(PoseParameter{}))
    for (const CornerLink& rod : e.links) {
      if (parameter.value == PoseParameter::centre_z && (rod.name == "link 1" || rod.name == "link 4"))
        continue;
      CarrierTargets open = e.targets;
      for (CarrierTarget& pose : open.poses) set_value(pose, parameter.value, nan);
      const PoseCompletion made = complete(open, rod, parameter.value);
      ASSERT_EQ(made.status, Status::done);
      for (std::size_t i = 0; i < open.poses.size(); ++i)
        EXPECT_NEAR(value_of(made.targets.poses[i], parameter.value),
                    value_of(e.targets.poses[i], parameter.value), 1e-11)
            << parameter.name << " by " << rod.name << " at " << i;
    }
}

TEST(PoseCompletion, ARodOutOfReachIsTold) {
  const test::Example e = test::published_example("ex4-forward");
  CornerLink rod = e.links[0];
  rod.length = 0.2;  // half a metre is needed
  CarrierTargets open = e.targets;
  for (CarrierTarget& pose : open.poses) pose.angles.carrier_pitch = nan;
  const PoseCompletion made = complete(open, rod, PoseParameter::carrier_pitch);
  EXPECT_EQ(made.status, Status::no_assembly);
  EXPECT_EQ(made.position, 6);  // the reference itself is settled first
  EXPECT_GT(made.shortfall, 0.01);
  EXPECT_TRUE(std::isnan(made.targets.poses[0].angles.carrier_pitch));
  EXPECT_EQ(rs_dyad(e.targets, e.targets.poses[0], rod).status, Status::no_assembly);
  const RodSolution x = solve_for(e.targets, e.targets.poses[0], rod, PoseParameter::centre_x);
  EXPECT_EQ(x.status, Status::no_assembly);
  EXPECT_GT(x.shortfall, 0.1);
}

TEST(PoseCompletion, ARodOnTheWheelsAxisSettlesNoCarrierPitch) {
  const test::Example e = test::published_example("ex4-forward");
  CornerLink rod = e.links[0];
  rod.carrier[0] = e.targets.wheel.centre - 0.1 * wheel_axis(Side::left, 0, e.targets.wheel.camber);
  EXPECT_EQ(solve_for(e.targets, e.targets.poses[2], rod, PoseParameter::carrier_pitch).status,
            Status::singular);
}

TEST(PoseCompletion, WhatIsRefused) {
  const test::Example e = test::published_example("ex2-forward");
  EXPECT_THAT(message([&] {
                complete(e.targets, e.links[3], PoseParameter::carrier_pitch);
                rs_dyad(e.targets, e.targets.poses[0], e.links[3]);
              }),
              HasSubstr("link 'link 4' of type SP: only a US or SS link settles a parameter"));
  CarrierTarget pose = e.targets.poses[0];
  pose.angles.toe = pose.angles.carrier_pitch = nan;
  EXPECT_THAT(message([&] { solve_for(e.targets, pose, e.links[0], PoseParameter::carrier_pitch); }),
              HasSubstr("link 'link 1' cannot settle carrier_pitch: toe is also missing"));
}

}  // namespace
}  // namespace linkwright::suspension
