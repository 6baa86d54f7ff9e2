// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/linkage.h"

#include <gtest/gtest.h>

#include "linkwright/planar/dyads/passage.h"
#include "linkwright/planar/dyads/solve.h"
#include "linkwright/planar/linkage/motion.h"
#include "planar/dyad_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// The general solver of linkages at the coordinate that the passage says must hold the body at each pose.
TEST(GuidedBody, IsAtItsPosesWhereThePassageSays) {
  int linkages = 0, kinds = 0;
  for (const char* id : {"MO-5-anchor", "MO-5-smooth-two-dyads", "MO-5-smooth-four-dyads",
                         "MO-5-slider-crank", "MO-5-inverted"}) {
    const std::vector<BodyPose> poses = stored_poses(id);
    const GuidingDyads dyads = solve_dyads(poses);
    for (const GuidingDyad& driver : dyads.real())
      for (const GuidingDyad& other : dyads.real()) {
        if (&driver == &other) continue;
        const Passage p = passage(poses, driver, other);
        if (p.defect != PoseDefect::none) continue;
        const Linkage linkage = guided_body(driver, other, poses[0]);
        const PlanResult planned = plan_linkage(linkage);
        ASSERT_TRUE(planned.problems.empty()) << id;
        LinkageMotion motion(planned.plan);
        for (std::size_t k = 0; k < poses.size(); ++k) {
          const InputMotion input{p.drive[k], 0, 0};
          solve_motion(planned.plan, std::span(&input, 1), motion);
          ASSERT_EQ(motion.status, Status::done) << id << k;
          const PartState<double> body = body_state(planned.plan, motion, 1);
          EXPECT_LT(std::abs(number(body.origin) - poses[k].origin), 1e-7) << id << k;
          EXPECT_LT(std::abs(number(body.direction) - std::polar(1.0, poses[k].angle)), 1e-7) << id << k;
        }
        ++linkages;
        kinds |= 1 << static_cast<int>(other.type);
      }
  }
  EXPECT_GE(linkages, 9);
  EXPECT_EQ(kinds & 3, 3);
}

TEST(GuidedBody, IsALinkageOfAnyTwoDyads) {
  const BodyPose pose{{0.2, 0.5}, 0.3};
  const GuidingDyad link{GuidingDyadType::rr, {0, 0}, {-0.1, 0.2}, std::abs(place(pose, {-0.1, 0.2})), 0, 0};
  const auto slide = [&](GuidingDyadType type, Complex pivot, double normal) {
    GuidingDyad out{type, 0, 0, 0, std::polar(1.0, normal), 0};
    (type == GuidingDyadType::pr ? out.moving : out.fixed) = pivot;
    out.offset = gap(out, pose);
    return out;
  };
  const std::vector<GuidingDyad> dyads = {link, slide(GuidingDyadType::pr, {0.4, -0.1}, 1.9),
                                          slide(GuidingDyadType::rp, {1.5, 0.4}, 1.2)};
  for (const GuidingDyad& driver : dyads)
    for (const GuidingDyad& other : dyads) {
      if (&driver == &other) continue;
      const Linkage linkage = guided_body(driver, other, pose);
      const PlanResult planned = plan_linkage(linkage);
      ASSERT_TRUE(planned.problems.empty());
      const std::vector<BodyPose> twice = {pose, pose};
      LinkageMotion motion(planned.plan);
      const InputMotion input{passage(twice, driver, other).drive[0], 0, 0};
      solve_motion(planned.plan, std::span(&input, 1), motion);
      ASSERT_EQ(motion.status, Status::done);
      const PartState<double> body = body_state(planned.plan, motion, 1);
      EXPECT_LT(std::abs(number(body.origin) - pose.origin), 1e-9);
      EXPECT_LT(std::abs(number(body.direction) - std::polar(1.0, pose.angle)), 1e-9);
    }
}

}  // namespace
}  // namespace linkwright::planar
