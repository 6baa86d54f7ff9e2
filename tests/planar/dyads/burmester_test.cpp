// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/burmester.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "linkwright/planar/dyads/solve.h"
#include "planar/dyad_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using linkwright::test::at;

TEST(BurmesterCurves, HoldTheFourPoses) {
  int points = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const std::vector<BodyPose> poses = random_poses(4, i);
    for (const BurmesterPoint& p : burmester_curves(poses, 30)) {
      const double length = std::abs(place(poses[0], p.moving) - p.fixed),
                   size = 1 + length + std::abs(p.moving);
      for (const BodyPose& pose : poses)
        EXPECT_NEAR(std::abs(place(pose, p.moving) - p.fixed), length, 1e-8 * size * size) << i;
      ++points;
    }
  }
  EXPECT_GT(points, 2000);
}

// Distance of a point from the polygon of the fixed pivots.
double distance_from_curve(const std::vector<BurmesterPoint>& curve, Complex point) {
  double least = infinity;
  for (std::size_t k = 1; k < curve.size(); ++k) {
    if (curve[k].piece != curve[k - 1].piece) continue;
    const Complex a = curve[k - 1].fixed, b = curve[k].fixed;
    if (std::abs(b - a) > 0.2) continue;  // through infinity
    const double t = std::clamp(std::real(std::conj(b - a) * (point - a)) / std::norm(b - a), 0.0, 1.0);
    least = std::min(least, std::abs(point - a - t * (b - a)));
  }
  return least;
}

TEST(BurmesterCurves, PassTheStoredCentrePoints) {
  const Value& known = linkwright::test::published_case("path-synthesis.json", "MG-4-centre-point-curve");
  const std::vector<BodyPose> poses = poses_of(at(known, "inputs.poses"));
  const std::vector<BurmesterPoint> curve = burmester_curves(poses, 20000);
  for (const Value& value : at(known, "computed.centre_points_m").as_array())
    EXPECT_LT(distance_from_curve(curve, {value.as_array()[0].as_number(), value.as_array()[1].as_number()}),
              1e-5);
}

TEST(BurmesterCurves, ContainTheDyadsOfFivePoses) {
  std::vector<BodyPose> poses = stored_poses("MO-5-anchor");
  const GuidingDyads dyads = solve_dyads(poses);
  poses.pop_back();
  const std::vector<BurmesterPoint> curve = burmester_curves(poses, 20000);
  for (const GuidingDyad& dyad : dyads.real()) EXPECT_LT(distance_from_curve(curve, dyad.fixed), 1e-5);
}

TEST(BurmesterCurves, PiecesCloseWhereTheLinkOnlySwings) {
  for (std::uint32_t i = 0; i < 40; ++i) {
    const std::vector<BodyPose> poses = random_poses(4, i);
    const std::vector<BurmesterPoint> curve = burmester_curves(poses, 50);
    ASSERT_FALSE(curve.empty());
    EXPECT_LE(curve.back().piece, 1);
  }
  EXPECT_THROW((void)burmester_curves(random_poses(5, 1), 10), ContractError);
  std::vector<BodyPose> translated = random_poses(4, 2);
  for (BodyPose& pose : translated) pose.angle = 0;
  EXPECT_TRUE(burmester_curves(translated, 10).empty());
}

}  // namespace
}  // namespace linkwright::planar
