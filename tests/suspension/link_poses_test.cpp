#include "linkwright/suspension/link_poses.h"

#include <gtest/gtest.h>

#include "linkwright/suspension/position.h"
#include "linkwright/suspension/samples.h"
#include "suspension/guides.h"

namespace linkwright::suspension {
namespace {

TEST(LinkPoses, TakeTheirPointsAlong) {
  for (const GuideSample& sample : guide_samples()) {
    SCOPED_TRACE(sample.name);
    const WheelGuide& guide = sample.guide;
    const GuidePlan plan = prepare(guide);
    const double rack = 0.02;
    const GuidePosition at =
        solve_position(plan, Driver::wheel_centre_z, {0.05, rack}, reference_position(plan));
    ASSERT_EQ(at.status, Status::done);
    const auto poses = link_poses(guide, at.place, rack);
    ASSERT_EQ(poses.size(), guide.links.size());
    for (int i = 0; i < static_cast<int>(poses.size()); ++i) {
      const GuideLink& link = guide.links[i];
      for (int k = 0; k < static_cast<int>(link.body.size()); ++k)
        EXPECT_LT(distance(placed(poses[i], link.body[k]), body_point(guide, i, k, rack)), 1e-14);
      // The strut's point slides along the link; all others are points of it. Rounding of the residuals.
      if (link.type == LinkType::SP) continue;
      for (int k = 0; k < static_cast<int>(link.carrier.size()); ++k)
        EXPECT_LT(distance(placed(poses[i], link.carrier[k]), carrier_point(guide, i, k, at.place.carrier)),
                  1e-13);
    }
    if (!guide.spring) continue;
    EXPECT_NEAR(norm(spring_end(guide, at.place, rack) - guide.spring->body),
                plan.spring->length + driver_value(plan, at.place, rack, Driver::spring), 1e-13);
  }
}

TEST(LinkPoses, ASpringOnARodOfAnotherLengthKeepsItsShare) {
  WheelGuide guide = guide_sample("5KS").guide;
  const Vec3 from = guide.links[0].body[0], to = guide.links[0].carrier[0];
  guide.links[0].length = 1.02 * norm(to - from);
  guide.spring = {{0, 0.5, 0.4}, from + 0.6 * (to - from), 0};
  const GuidePlan plan = prepare(guide);
  const GuidePosition at = reference_position(plan);
  ASSERT_EQ(at.status, Status::done) << at.reason;
  EXPECT_NEAR(norm(spring_end(guide, at.place, 0) - guide.spring->body),
              plan.spring->length + driver_value(plan, at.place, 0, Driver::spring), 1e-13);
}

}  // namespace
}  // namespace linkwright::suspension
