// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/coupler_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/suspension/indirect/corner_errors.h"
#include "linkwright/suspension/indirect/synthesis_carrier_pitch.h"
#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

TEST(CouplerFit, IsFoundToTheNanometre) {
  const test::Example e = test::published_example("ex3-forward");
  const CouplerTask task{.second = 2, .min_offset = 0.1, .point = box_around({0.23, 0.6, -0.07}, 0.15)};
  const CouplerFit fit = fit_coupler(e.targets, e.links, task);
  EXPECT_EQ(fit.status, Status::done);
  EXPECT_NEAR(fit.offset, 0.176, 1e-8);  // errors of the positions, 1e-15 m, times a condition of 1e6
  EXPECT_LT(norm(fit.coupler.point - Vec3{0.2, 0.628, -0.058}), 1e-8);
  EXPECT_LT(fit.rms, 1e-13);
}

TEST(CouplerFit, KeepsToItsBox) {
  const test::Example e = test::published_example("ex3-forward");
  const CouplerTask task{.second = 2, .min_offset = 0.1, .point = box_around({0.3, 0.7, -0.07}, 0.1)};
  const CouplerFit fit = fit_coupler(e.targets, e.links, task);
  EXPECT_EQ(fit.status, Status::not_converged);
  EXPECT_GT(fit.rms, 1e-7);
  EXPECT_GE(fit.coupler.point.x, 0.25);
  EXPECT_GE(fit.coupler.point.y, 0.65);
}

// Limits cut the valley of good couplers, and a search that starts outside of them ends where it first meets
// one. No start of many random ones may end lower than the fit.
TEST(CouplerFit, IsTheBestPlaceOfItsBox) {
  const test::Example e = test::published_example("ex3-forward");
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random({seed, 77});
    const auto off = [&] { return random.uniform(-0.2, 0.2); };
    const double x = off(), y = off(), z = off();
    const PointBox box = box_around(Vec3{0.2, 0.628, -0.058} + Vec3{x, y, z}, 0.15);
    const CouplerTask task{.second = 2, .min_offset = 0.1, .max_offset = 0.28, .point = box};
    const CouplerFit fit = fit_coupler(e.targets, e.links, task);
    ASSERT_TRUE(std::isfinite(fit.rms));
    std::vector<LinkTask> links;
    for (const CornerLink& l : e.links) links.push_back(given_link(l));
    CornerErrors errors(e.targets, links, std::vector{task});
    double least = fit.rms;
    for (int start = 0; start < 40; ++start) {
      Coupler begin{.first = 0, .second = 2};
      const auto within = [&](double low, double high) { return random.uniform(low, high); };
      begin.fraction = within(0.1, 0.28) / norm(e.links[0].carrier[0] - e.links[0].body[0]);
      const double px = within(box.lower.x, box.upper.x), py = within(box.lower.y, box.upper.y),
                   pz = within(box.lower.z, box.upper.z);
      begin.point = {px, py, pz};
      const CarrierPitchFit other = fit_together(e.targets, links, std::vector{task}, e.links,
                                                 std::vector{begin}, {.distinct_links = 0});
      least = std::min(least, other.coupler_errors.at(0).rms());
    }
    EXPECT_LE(fit.rms, least * (1 + 1e-4) + 1e-12) << seed;
  }
}

TEST(CouplerFit, RefusesLinksItCannotJoin) {
  const test::Example e = test::published_example("ex3-forward");
  const auto told = [&](const CouplerTask& task) {
    return message([&] { fit_coupler(e.targets, e.links, task); });
  };
  EXPECT_THAT(told({.name = "c", .first = 0, .second = 1}),
              HasSubstr("coupler 'c': link 1 is of type US, needs SR"));
  EXPECT_THAT(told({.name = "c", .first = 0, .second = 5}), HasSubstr("coupler 'c': link 5 of 3"));
  EXPECT_THAT(told({.name = "c", .second = 2, .min_offset = 1}),
              HasSubstr("coupler 'c': offset of at least 1 m and at most inf m on a link of 0.286"));
}

}  // namespace
}  // namespace linkwright::suspension
