// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/corner_targets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/suspension.h"
#include "tests/suspension/direct_cases.h"

namespace linkwright::suspension {
namespace {

using test::at;
using test::numbers;

TEST(CornerTargets, OfExample5) {
  const Value& given = published("ex5-targets");
  const std::vector<double> travel = numbers(at(given, "inputs.dz_m"));
  const std::vector<double> rack = numbers(at(given, "inputs.rack_m"));
  const ToleranceRule angle{math::radians(0.05), 0.025, math::radians(2.0)};
  double most = 0;
  for (const auto& [name, key] :
       {std::pair{"toe", "toe_rad"}, {"camber", "camber_rad"}, {"relative_track", "relative_track"}}) {
    const std::vector<double> c = numbers(at(at(given, "inputs.coefficients_c1_to_c14_c0"), name));
    const std::vector<double> values = numbers(at(at(given, "computed"), key));
    ASSERT_EQ(c.size(), 15);
    for (std::size_t i = 0; i < travel.size(); ++i) {
      const double value = quartic(std::span<const double, 15>(c), travel[i], rack[i]);
      EXPECT_NEAR(value, values[i], 1e-14) << name << i;
      if (std::string(name) == "relative_track") {
        most = std::max(most, std::abs(value));
        continue;
      }
      const auto tolerances = numbers(at(at(given, "computed"), "tolerance_" + std::string(key)));
      EXPECT_NEAR(tolerance_of(angle, value), tolerances[i], 1e-14) << name << i;
    }
  }
  // Five per cent of the largest.
  EXPECT_NEAR(0.05 * most, test::number_at(given, "computed.tolerance_track"), 1e-14);
}

TEST(CornerTargets, ObjectivesAtThePublishedOptimum) {
  const DirectTask task = published_direct_task();
  const TargetPositions positions = target_positions(task.objectives, task.driver);
  EXPECT_EQ(positions.inputs.size(), 15);
  EXPECT_EQ(positions.rows.size(), 45);
  for (const char* id : {"ex5-minmax-optimum", "ex5-least-squares-optimum"}) {
    const Value& computed = at(published(id), "computed");
    const Suspension suspension = test::with_points(task, at(computed, "points_03_04_05_m"));
    const TargetAnswer found = answer(suspension, task.objectives, positions, {});
    ASSERT_TRUE(found.assembled);
    const auto values = objective_values(task.objectives, positions, found.deviations);
    const auto expected = numbers(at(computed, "f_toe_camber_track"));
    // Coordinates are given to 1e-12 m, and a tolerance is a thousandth of a radian.
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(values[k], expected[k], 1e-8) << id << k;
  }
}

TEST(CornerTargets, DerivativesAgreeWithDifferences) {
  DirectTask task = published_direct_task();
  task.objectives[0].curves.push_back(
      {.quantity = WheelQuantity::roll_centre_height,
       .measure = TargetMeasure::change,
       .reference = {0.02, 0},
       .points = {{.input = {0.05, 0.01}, .value = 0.02, .tolerance = 0.01, .weight = 2}}});
  const TargetPositions positions = target_positions(task.objectives, task.driver);
  EXPECT_EQ(positions.extent, Extent::all);
  const std::vector<DesignNumber> designed{{DesignKind::body, 2, 0, 1}, {DesignKind::length, 3}};
  const TargetAnswer exact = answer(task.suspension, task.objectives, positions, designed);
  ASSERT_TRUE(exact.assembled);
  const double h = 1e-5;
  for (std::size_t j = 0; j < designed.size(); ++j) {
    const auto moved = [&](double by) {
      Suspension suspension = task.suspension;
      design_value(suspension, designed[j]) += by;
      return answer(suspension, task.objectives, positions, {}).deviations;
    };
    const auto a = moved(-h), b = moved(h);
    for (std::size_t r = 0; r < a.size(); ++r)
      // Third derivatives: (1e-5 / 0.1)^2 of values in the thousands.
      EXPECT_NEAR(exact.by[r * designed.size() + j], (b[r] - a[r]) / (2 * h),
                  2e-5 * (1 + std::abs(b[r] - a[r]) / h))
          << j << ' ' << r;
  }
}

TEST(CornerTargets, TellHowFarADesignComes) {
  DirectTask task = published_direct_task();
  task.suspension.links[4].length = *task.suspension.links[4].length + 0.2;
  const TargetPositions positions = target_positions(task.objectives, task.driver);
  const TargetAnswer none = answer(task.suspension, task.objectives, positions, {});
  EXPECT_FALSE(none.assembled);
  EXPECT_EQ(none.reached, 0);
  DirectTask far = published_direct_task();
  for (TargetPoint& point : far.objectives[0].curves[0].points) point.input.value *= 2.5;
  const TargetAnswer some =
      answer(far.suspension, far.objectives, target_positions(far.objectives, far.driver), {});
  EXPECT_FALSE(some.assembled);
  EXPECT_GT(some.reached, 0.3);
  EXPECT_LT(some.reached, 1);
}

TEST(CornerTargets, ContractsAreChecked) {
  DirectTask task = published_direct_task();
  task.objectives[1].curves[0].points[3].tolerance = 0;
  EXPECT_THAT([&] { target_positions(task.objectives, task.driver); },
              ::testing::ThrowsMessage<ContractError>(
                  ::testing::AllOf(::testing::HasSubstr("objective 'camber', camber: value 0.0014178101953"),
                                   ::testing::HasSubstr(", tolerance 0, weight 1"))));
  task.objectives[1].curves.clear();
  EXPECT_THAT(
      [&] { target_positions(task.objectives, task.driver); },
      ::testing::ThrowsMessage<ContractError>(::testing::HasSubstr("objective 'camber' has no targets")));
}

}  // namespace
}  // namespace linkwright::suspension
