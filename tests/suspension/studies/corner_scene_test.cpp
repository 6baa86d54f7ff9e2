// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/corner_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

TEST(CornerScene, DrawsWheelsOfBothSidesOverTheGrid) {
  const study::Result result = test::run_text(
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"suspension.corner\"\nsample = \"2RS-US\"\n"
      "[sweep.travel]\nfrom_mm = -80\nto_mm = 80\nstep_mm = 40\n[sweep.rack]\nvalues_mm = [-30, 0, 30]\n");
  const study::Scene& scene = result.scenes.at(0);
  EXPECT_TRUE(scene.spatial());
  EXPECT_EQ(scene.input.size(), 5U);
  EXPECT_EQ(scene.second.size(), 3U);
  EXPECT_EQ(scene.samples(), 15U);
  ASSERT_EQ(scene.discs.size(), 2U);
  const auto& left = scene.points.at(static_cast<std::size_t>(scene.discs[0].centre));
  const auto& right = scene.points.at(static_cast<std::size_t>(scene.discs[1].centre));
  EXPECT_EQ(left.name, "left wheel centre");
  EXPECT_EQ(right.name, "right wheel centre");
  // The right wheel is the mirror image of the left one at the opposite rack displacement.
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(right.y[i], -left.y[10 + i]);
    EXPECT_EQ(right.z[i], left.z[10 + i]);
  }
  // A rod keeps its length.
  for (const auto& body : scene.bodies) {
    if (body.name != "left tie rod") continue;
    const auto at = [&](int p, std::size_t i) {
      const auto& q = scene.points.at(static_cast<std::size_t>(p));
      const auto of = [&](const std::vector<double>& v) { return v.size() == 1 ? v[0] : v[i]; };
      return Vec3{of(q.x), of(q.y), of(q.z)};
    };
    const double length = norm(at(body.points[1], 0) - at(body.points[0], 0));
    for (std::size_t i = 1; i < 15; ++i)
      EXPECT_NEAR(norm(at(body.points[1], i) - at(body.points[0], i)), length, 1e-12);
  }
}

TEST(CornerScene, DrawsRockersWithTheirRodsAndWhatTheyCarry) {
  const study::Result result = test::run_text(test::pushrod_study);
  const study::Scene& scene = result.scenes.at(0);
  const auto length = [&](std::string_view name, std::size_t sample) {
    for (const auto& body : scene.bodies)
      if (body.name == name) {
        const auto at = [&](int p) {
          const auto& q = scene.points.at(static_cast<std::size_t>(p));
          const auto of = [&](const std::vector<double>& v) { return v.size() == 1 ? v[0] : v[sample]; };
          return Vec3{of(q.x), of(q.y), of(q.z)};
        };
        return norm(at(body.points[1]) - at(body.points[0]));
      }
    ADD_FAILURE() << name;
    return 0.0;
  };
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(length("left rocker, rod", i), std::hypot(0.003, 0.24, 0.18), 1e-12);
    EXPECT_NEAR(length("right rocker, rod", i), std::hypot(0.003, 0.24, 0.18), 1e-12);
    EXPECT_NEAR(length("left anti-roll bar, rod", i), 0.22, 1e-12);
    EXPECT_NEAR(length("left spring", i), test::column(result, "spring_length_m")[i], 1e-12);
  }
}

}  // namespace
}  // namespace linkwright::suspension
