// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_fit_direct.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "linkwright/math/differences.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

TEST(LinkFitDirect, LinksOfEveryMechanismHaveNoErrors) {
  for (const char* id :
       {"ex1-forward", "ex2-forward", "ex3-forward", "ex4-forward", "mechanism-R", "mechanism-RR-US",
        "mechanism-S-2US", "mechanism-2RS-US", "mechanism-RS-SP-US", "mechanism-2SR-US"}) {
    const test::Example e = test::published_example(id);
    for (const CornerLink& link : e.links) {
      const LinkMotion motion = link_motion(e.targets, link.moved_by_rack);
      std::vector<double> errors(error_rows(link.type, motion.size()), 1.0);
      ASSERT_TRUE(structural_errors(motion, link, errors, {}, {}));
      // Positions were solved to 1e-13 m; arms of 0.5 m turn rounding of angles into the same.
      for (const double error : errors) EXPECT_LT(std::abs(error), 2e-12) << id << " " << link.name;
    }
  }
}

TEST(LinkFitDirect, DerivativesAreThoseOfTheErrors) {
  const test::Example e = test::published_example("ex1-forward");
  for (const LinkType type :
       {LinkType::US, LinkType::RS, LinkType::SR, LinkType::RR, LinkType::SP, LinkType::S, LinkType::R}) {
    CornerLink link{.type = type};
    for (int k = 0; k < body_points(type); ++k) link.body.push_back({0.2 - 0.3 * k, 0.4, -0.1 + 0.05 * k});
    for (int k = 0; k < carrier_points(type); ++k)
      link.carrier.push_back({0.01 + 0.1 * k, 0.7, -0.13 + 0.02 * k});
    const LinkMotion motion = link_motion(e.targets, true);
    const std::size_t coordinates = 3 * (link.body.size() + link.carrier.size());
    std::vector<int> columns(coordinates);
    std::iota(columns.begin(), columns.end(), 0);
    std::vector<double> x;
    for (const auto& points : {link.body, link.carrier})
      for (const Vec3& p : points) x.insert(x.end(), {p.x, p.y, p.z});
    const auto function = [&](std::span<const double> at, std::span<double> r, std::span<double> j) {
      std::size_t i = 0;
      for (auto* points : {&link.body, &link.carrier})
        for (Vec3& p : *points) p = {at[i], at[i + 1], at[i + 2]}, i += 3;
      return structural_errors(motion, link, r, columns, j);
    };
    const std::vector<double> scale(coordinates, 0.3);
    const auto check = math::check_jacobian(function, error_rows(type, motion.size()), x, scale);
    EXPECT_TRUE(check.passed) << name_of(type) << " row " << check.row << " column " << check.column << ": "
                              << check.analytic << " for " << check.numeric;
  }
}

}  // namespace
}  // namespace linkwright::suspension
