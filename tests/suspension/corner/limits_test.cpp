// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/limits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/wheel/derivatives.h"

namespace linkwright::suspension {
namespace {

const std::vector<CornerInput> inputs{{-0.06, 0}, {0, 0.03}, {0.07, -0.02}};

struct Looked {
  std::vector<LimitAnswer> answers;
};

Looked look(const Suspension& suspension, const CornerLimits& limits,
            const std::vector<DesignNumber>& numbers) {
  const DerivativePlan plan = prepare_derivatives(suspension, numbers);
  std::vector<CornerPosition> positions;
  std::vector<std::vector<Twist>> shifts;
  for (const CornerInput& input : inputs) {
    positions.push_back(
        solve_position(plan.plan, Driver::wheel_centre_z, input, reference_position(plan.plan)));
    shifts.push_back(wheel_derivatives(plan, positions.back(), Extent::at_rest).shift);
  }
  return {limit_answers(suspension, limits, positions, numbers, shifts)};
}

CornerLimits all_kinds() {
  CornerLimits out;
  out.keep_out = {{0, false, 0, {{0.1, 0.3, -0.2}, {0.3, 0.5, 0.0}}},
                  {0, true, 0, {{-0.1, 0.6, -0.05}, {0.1, 0.8, 0.05}}}};
  out.lengths = {{0, 0.4, 0.5}, {2, 0.3}};
  out.links = {{0, 1, 0.05}, {0, 2, 0.05}};
  out.tyres = {{1, {0.4, 0.64, 0.2}, 0.01}};
  out.boxes = {{2, {{-0.3, 0.3, -0.2}, {-0.2, 0.9, 0.2}}, 0.02}};
  return out;
}

TEST(CornerLimits, DerivativesAgreeWithDifferences) {
  const Suspension suspension = corner_sample("2RS-US").suspension;
  std::vector<DesignNumber> numbers = hard_points(suspension);
  numbers.push_back({DesignKind::wheel_centre, 0, 0, 1});
  const Looked exact = look(suspension, all_kinds(), numbers);
  ASSERT_EQ(exact.answers.size(), 9);
  const double h = 1e-6;
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    const auto moved = [&](double by) {
      Suspension other = suspension;
      design_value(other, numbers[j]) += by;
      return look(other, all_kinds(), {});
    };
    const Looked a = moved(-h), b = moved(h);
    for (std::size_t i = 0; i < exact.answers.size(); ++i) {
      EXPECT_EQ(a.answers[i].position, b.answers[i].position);
      // Central differences to 1e-6^2; the search along a line ends within 1e-9 of its length.
      EXPECT_NEAR(exact.answers[i].by[j], (b.answers[i].excess - a.answers[i].excess) / (2 * h), 1e-6)
          << exact.answers[i].name << ", " << label(suspension, numbers[j]);
    }
  }
}

TEST(CornerLimits, AreWhatAnyPointOfTheLinesSays) {
  // Against many points of both lines: never nearer than the limit says, and as near within the spacing.
  const Suspension suspension = corner_sample("5US").suspension;
  CornerLimits limits;
  limits.links = {{0, 1, 0.0}, {2, 3, 0.0}, {3, 4, 0.0}};
  limits.tyres = {{0, {0.4, 0.62, 0.2}, 0.0}};
  const CornerPlan plan = prepare_suspension(suspension);
  const std::vector<CornerPosition> at{
      solve_position(plan, Driver::wheel_centre_z, {0.05, 0}, reference_position(plan))};
  const auto found = limit_answers(suspension, limits, at, {}, {});
  constexpr int steps = 400;
  const auto point = [&](int link, int i) {
    const Vec3 a = suspension.links[link].body[0];
    const Vec3 b = place(at[0].place.carrier, suspension.links[link].carrier[0], suspension.wheel.centre);
    return a + (static_cast<double>(i) / steps) * (b - a);
  };
  for (std::size_t k = 0; k < limits.links.size(); ++k) {
    double least = HUGE_VAL;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= steps; ++j)
        least = std::min(least, norm(point(limits.links[k].first, i) - point(limits.links[k].second, j)));
    EXPECT_LE(-found[k].excess, least + 1e-12);
    EXPECT_GT(-found[k].excess, least - 1e-3);
  }
  const Vec3 u =
      at[0].place.carrier.rotation * wheel_axis(Side::left, suspension.wheel.toe, suspension.wheel.camber);
  double least = HUGE_VAL;
  for (int i = 0; i <= steps; ++i) {
    const Vec3 p = point(0, i) - at[0].place.carrier.centre;
    const double along = dot(p, u), radius = norm(p - along * u);
    least = std::min(least, std::max({0.2 - radius, radius - 0.31, std::abs(along) - 0.1}));
  }
  EXPECT_NEAR(-found[3].excess, least, 1e-3);
}

TEST(CornerLimits, HaveSignsAndNames) {
  Suspension suspension = corner_sample("5US").suspension;
  suspension.links[0].name = "front rod";
  CornerLimits limits;
  const Vec3 p = suspension.links[0].body[0];
  limits.keep_out = {{0, false, 0, box_around(p, 0.02)},
                     {0, false, 0, box_around(p + Vec3{0.03, 0, 0}, 0.02)}};
  const double length = norm(suspension.links[0].carrier[0] - p);
  limits.lengths = {{0, length + 0.01, length - 0.02}};
  const auto found = limit_answers(suspension, limits, {}, {}, {});
  ASSERT_EQ(found.size(), 4);
  // In the middle of a box of 20 mm; 20 mm before the face of the other.
  EXPECT_NEAR(found[0].excess, 0.01, 1e-15);
  EXPECT_NEAR(found[1].excess, -0.02, 1e-15);
  EXPECT_NEAR(found[2].excess, 0.01, 1e-15);
  EXPECT_NEAR(found[3].excess, 0.02, 1e-15);
  EXPECT_EQ(found[0].name, "body point 1 of front rod out of its box");
  EXPECT_EQ(found[3].name, "greatest length of front rod");
}

TEST(CornerLimits, OfLinksThatAreNotThereAreRefused) {
  const Suspension suspension = corner_sample("5US").suspension;
  CornerLimits limits;
  limits.links = {{0, 5, 0.01}};
  EXPECT_THAT([&] { limit_answers(suspension, limits, {}, {}, {}); },
              ::testing::ThrowsMessage<ContractError>(
                  ::testing::HasSubstr("a limit for link 5, the suspension has 5")));
  limits = {};
  limits.keep_out = {{0, true, 1, {}}};
  EXPECT_THAT([&] { limit_answers(suspension, limits, {}, {}, {}); },
              ::testing::ThrowsMessage<ContractError>(
                  ::testing::HasSubstr("point 1 of lower front rod, which has 1")));
}

}  // namespace
}  // namespace linkwright::suspension
