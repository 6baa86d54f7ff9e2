// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_fit_projected.h"

#include <gtest/gtest.h>

#include "linkwright/math/differences.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

std::vector<int> columns_of(const LinkTask& task) {
  std::vector<int> columns;
  int next = 0;
  for (const auto& boxes : {task.body, task.carrier})
    for (const PointBox& b : boxes)
      for (const bool free : {b.lower.x < b.upper.x, b.lower.y < b.upper.y, b.lower.z < b.upper.z})
        columns.push_back(free ? next++ : -1);
  return columns;
}

std::vector<double> coordinates(const CornerLink& link) {
  std::vector<double> x;
  for (const auto& points : {link.body, link.carrier})
    for (const Vec3& p : points) x.insert(x.end(), {p.x, p.y, p.z});
  return x;
}

TEST(LinkFitProjected, EliminatedPointsOfATrueLinkAreItsOwn) {
  for (const char* id : {"ex1-forward", "ex2-forward", "mechanism-RR-US", "mechanism-2RS-US",
                         "mechanism-RS-SP-US", "mechanism-2SR-US"}) {
    const test::Example e = test::published_example(id);
    for (const CornerLink& link : e.links) {
      RandomStream random({3});
      const LinkMotion motion = link_motion(e.targets, link.moved_by_rack);
      LinkProjection projection(motion, link, columns_of(test::random_task(link, 0.15, random)));
      ASSERT_TRUE(projection.applicable());
      const std::vector<double> all = coordinates(link);
      std::vector<double> x, r(projection.rows());
      for (const int place : projection.unknowns()) x.push_back(all[place]);
      ASSERT_TRUE(projection.evaluate(x, r, {}));
      // Rounding of positions, 1e-13, times the condition of the linear problem, up to 1e4.
      EXPECT_LT(largest_distance(projection.link(), link), 1e-8) << id << " " << link.name;
    }
  }
}

TEST(LinkFitProjected, DerivativesAreThoseOfTheResiduals) {
  const test::Example e = test::published_example("mechanism-2RS-US");
  for (const LinkType type : {LinkType::US, LinkType::RS, LinkType::SR, LinkType::RR, LinkType::SP}) {
    CornerLink link{.type = type};
    for (int k = 0; k < body_points(type); ++k) link.body.push_back({0.2 - 0.4 * k, 0.35, -0.1 + 0.04 * k});
    for (int k = 0; k < carrier_points(type); ++k)
      link.carrier.push_back({0.05 - 0.1 * k, 0.7, -0.13 + 0.02 * k});
    RandomStream random({4});
    const LinkMotion motion = link_motion(e.targets, false);
    const LinkTask task = test::random_task(link, 0.15, random);
    LinkProjection projection(motion, link, columns_of(task));
    const std::vector<double> all = coordinates(link);
    std::vector<double> x;
    for (const int place : projection.unknowns()) x.push_back(all[place]);
    EXPECT_EQ(x.size(), type == LinkType::RR ? 4u : 3u);
    const std::vector<double> scale(x.size(), 0.3);
    const auto check =
        math::check_jacobian([&](std::span<const double> at, std::span<double> r,
                                 std::span<double> j) { return projection.evaluate(at, r, j); },
                             projection.rows(), x, scale);
    EXPECT_TRUE(check.passed) << name_of(type) << " row " << check.row << " column " << check.column << ": "
                              << check.analytic << " for " << check.numeric;
  }
}

}  // namespace
}  // namespace linkwright::suspension
