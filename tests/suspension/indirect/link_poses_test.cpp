// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_poses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

TEST(LinkPoses, TakeTheirPointsAlong) {
  for (const CornerSample& sample : corner_samples()) {
    SCOPED_TRACE(sample.name);
    const Suspension& suspension = sample.suspension;
    const CornerPlan plan = prepare_suspension(suspension);
    const double rack = 0.02;
    const CornerPosition at =
        solve_position(plan, Driver::wheel_centre_z, {0.05, rack}, reference_position(plan));
    ASSERT_EQ(at.status, Status::done);
    const auto poses = link_poses(suspension, at.place, rack);
    ASSERT_EQ(poses.size(), suspension.links.size());
    for (int i = 0; i < static_cast<int>(poses.size()); ++i) {
      const CornerLink& link = suspension.links[i];
      for (int k = 0; k < static_cast<int>(link.body.size()); ++k)
        EXPECT_LT(distance(placed(poses[i], link.body[k]), body_point(suspension, i, k, rack)), 1e-14);
      // The strut's point slides along the link; all others are points of it. Rounding of the residuals.
      if (link.type == LinkType::SP) continue;
      for (int k = 0; k < static_cast<int>(link.carrier.size()); ++k)
        EXPECT_LT(
            distance(placed(poses[i], link.carrier[k]), carrier_point(suspension, i, k, at.place.carrier)),
            1e-13);
    }
    if (!suspension.spring) continue;
    EXPECT_NEAR(norm(spring_end(suspension, at.place, rack) - suspension.spring->body),
                plan.spring->length + driver_value(plan, at.place, rack, Driver::spring), 1e-13);
  }
}

// A U joint is two hinges: about the axis that stands in the body, then about the one that turns with the
// rod. The angles follow from where the rod has gone.
TEST(LinkPoses, AKJointIsTwoHinges) {
  for (const std::optional<Vec3>& axis : {std::optional<Vec3>{}, std::optional<Vec3>{Vec3{0.9, 0.3, -0.4}}}) {
    Suspension suspension = corner_sample("5US").suspension;
    suspension.spring->link = 2;  // the tie rod, which the rack moves
    suspension.links[2].cross_axis = axis;
    ASSERT_TRUE(suspension.links[2].moved_by_rack);
    ASSERT_TRUE(check(suspension).empty());
    const CornerPlan plan = prepare_suspension(suspension);
    for (const CornerInput& input : {CornerInput{0.07, -0.02}, CornerInput{-0.06, 0.03}}) {
      const CornerPosition at = solve_position(plan, Driver::wheel_centre_z, input, reference_position(plan));
      ASSERT_EQ(at.status, Status::done);
      const CornerLink& rod = suspension.links[2];
      const Vec3 then = unit(rod.carrier[0] - rod.body[0]), from = body_point(suspension, 2, 0, input.rack);
      const Vec3 now = unit(carrier_point(suspension, 2, 0, at.place.carrier) - from);
      const Vec3 standing = unit(axis.value_or(cross(Vec3{0, 0, 1}, then)));
      if (!axis) {
        EXPECT_NEAR(standing.z, 0, 1e-15);
      }
      const Vec3 turning = unit(cross(standing, then)), turned = unit(cross(standing, now));
      const double first = std::atan2(dot(cross(turning, turned), standing), dot(turning, turned));
      const Vec3 back = math::turn_about(-first * standing) * now;
      const double second = std::atan2(dot(cross(then, back), turning), dot(then, back));
      const Mat3 both = math::turn_about(first * standing) * math::turn_about(second * turning);
      EXPECT_LT(distance(both * then, now), 1e-14);
      const Vec3 end = from + both * (suspension.spring->moving - rod.body[0]);
      EXPECT_LT(distance(spring_end(suspension, at.place, input.rack), end), 1e-14);
      EXPECT_NEAR(norm(end - suspension.spring->body),
                  plan.spring->length + driver_value(plan, at.place, input.rack, Driver::spring), 1e-13);
      const auto [a, b] = cross_axes(suspension, 2, at.place.carrier, input.rack);
      EXPECT_LT(distance(a, standing) + distance(b, turned), 1e-14);
    }
  }
}

TEST(LinkPoses, ASpringOnARodOfAnotherLengthKeepsItsShare) {
  Suspension suspension = corner_sample("5US").suspension;
  const Vec3 from = suspension.links[0].body[0], to = suspension.links[0].carrier[0];
  suspension.links[0].length = 1.02 * norm(to - from);
  suspension.spring = {{0, 0.5, 0.4}, from + 0.6 * (to - from), 0};
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition at = reference_position(plan);
  ASSERT_EQ(at.status, Status::done) << at.reason;
  EXPECT_NEAR(norm(spring_end(suspension, at.place, 0) - suspension.spring->body),
              plan.spring->length + driver_value(plan, at.place, 0, Driver::spring), 1e-13);
}

}  // namespace
}  // namespace linkwright::suspension
