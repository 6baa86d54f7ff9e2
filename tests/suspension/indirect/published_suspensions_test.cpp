// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/published_suspensions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/math/angles.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

TEST(PublishedGuides, AreThoseOfTheReference) {
  ASSERT_EQ(published_suspensions().size(), 4u);
  for (const PublishedSuspension& suspension : published_suspensions()) {
    const std::string id = "ex" + std::to_string(suspension.example) + "-forward";
    const auto& rows = test::at(published(id), "published.rows").as_array();
    ASSERT_EQ(rows.size(), suspension.positions.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::vector<double> wanted = test::numbers(rows[i]);
      const PublishedPosition& p = suspension.positions[i];
      const std::vector<double> found{p.travel, p.rack, p.x, p.y, p.toe, p.camber, p.carrier_pitch};
      const std::array<std::size_t, 7> column{1, 2, 3, 4, 6, 7, 8};
      for (std::size_t k = 0; k < 7; ++k) {
        if (column[k] < wanted.size())
          EXPECT_EQ(found[k], wanted[column[k]]) << id << " row " << i;
        else
          EXPECT_TRUE(std::isnan(found[k]));
      }
    }
    const test::Example e = test::published_example(id);
    const CarrierTargets targets = published_targets(suspension);
    for (std::size_t i = 0; i < rows.size(); ++i)
      EXPECT_LT(norm(targets.poses[i].centre - e.targets.poses[i].centre), 1e-12);
  }
}

TEST(PublishedGuides, EvolutionIsThatOfTheReference) {
  const Value& given = test::at(published("statistics-indirect-synthesis"), "published");
  const auto expect = [&](const char* key, const PublishedEvolution& e) {
    const Value& wanted = test::at(given, key);
    EXPECT_EQ(e.coordinate_error, test::number_at(wanted, "coord_error_mean_m")) << key;
    if (const Value* repeats = wanted.find("repeats")) {
      EXPECT_EQ(e.repeats, repeats->as_number());
    }
    if (const Value* generations = wanted.find("generations")) {
      EXPECT_EQ(e.generations, generations->as_number());
    }
    if (const Value* generations = wanted.find("generations_total")) {
      EXPECT_EQ(e.generations, generations->as_number());
    }
  };
  expect("ex1", published_suspensions()[0].evolution);
  expect("ex2", published_suspensions()[1].evolution);
  expect("ex3", published_suspensions()[2].evolution);
  expect("ex4_spin_given", published_suspensions()[3].evolution);
  expect("ex4_polynomial", published_quadratic());
  expect("ex4_dyad", published_dyad());
  const auto off = test::numbers(test::at(published("ex1-appendix-de-run"), "inputs.x_true_minus_x_found_m"));
  EXPECT_TRUE(std::equal(off.begin(), off.end(), published_run().begin(), published_run().end()));
}

// Figure 6-3 to its four decimals misses its own table.
TEST(PublishedGuides, TheStrutAsPrintedMissesItsTable) {
  const Value& wanted =
      test::at(published("ex2-forward-printed-points"), "computed.max_abs_difference_to_published");
  const CornerPlan plan = prepare_suspension(strut_as_printed());
  const CornerPosition start = reference_position(plan);
  std::array<double, 5> largest{};
  for (const PublishedPosition& row : published_suspensions()[1].positions) {
    const CornerPosition at = solve_position(plan, Driver::wheel_centre_z, {row.travel, row.rack}, start);
    ASSERT_EQ(at.status, Status::done);
    const WheelAngles angles = wheel_angles(Side::left, plan.wheel, at.place.carrier.rotation);
    const std::array found{at.place.carrier.centre.x, at.place.carrier.centre.y, math::degrees(angles.toe),
                           math::degrees(angles.camber), math::degrees(angles.carrier_pitch)};
    const std::array table{row.x, row.y, row.toe, row.camber, row.carrier_pitch};
    for (std::size_t k = 0; k < 5; ++k) largest[k] = std::max(largest[k], std::abs(found[k] - table[k]));
  }
  const std::array keys{"x_m", "y_m", "toe_deg", "camber_deg", "carrier_spin_deg"};
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_NEAR(largest[k], test::number_at(wanted, keys[k]), k < 2 ? 1e-12 : 1e-10) << keys[k];
}

TEST(PublishedGuides, BoxesHoldTheTrueLinks) {
  for (const PublishedSuspension& suspension : published_suspensions()) {
    const Suspension& truth = corner_sample(suspension.sample).suspension;
    int unknowns = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const std::vector<LinkTask> tasks = published_tasks(truth, seed);
      unknowns = 0;
      for (std::size_t l = 0; l < tasks.size(); ++l) {
        EXPECT_TRUE(LinkCoordinates(tasks[l]).inside(truth.links[l]));
        unknowns += static_cast<int>(LinkCoordinates(tasks[l]).free().size());
      }
      EXPECT_EQ(coordinate_error(tasks, truth.links, truth.couplers, truth), 0);
    }
    // 22 coordinates in example 3, three of them those of the coupler's point.
    EXPECT_EQ(unknowns, (std::array{30, 23, 19, 30})[static_cast<std::size_t>(suspension.example - 1)]);
  }
  const Suspension& truth = corner_sample("front_5US").suspension;
  const std::vector<LinkTask> tasks = published_tasks(truth, 1);
  std::vector<CornerLink> links = truth.links;
  links[0].body[0].x += 3e-3;
  EXPECT_NEAR(coordinate_error(tasks, links, {}, truth), 1e-4, 1e-15);
}

}  // namespace
}  // namespace linkwright::suspension
