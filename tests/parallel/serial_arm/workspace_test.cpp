// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/serial_arm/workspace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "support/allocations.h"

namespace linkwright::parallel {
namespace {

SerialConditions conditions() {
  SerialConditions out{.arm = {.offset = {0.06, -0.02}, .arm = {0.3, 0.25}}, .mode = -1};
  out.arm.drive[0] = {.type = DriveType::pi_joint, .mounting = 0.5, .lowest = -1, .highest = 1};
  out.arm.drive[1] = {.type = DriveType::pi_joint, .mirror = -1, .lowest = -1, .highest = 1};
  out.min_elbow = 0.6;
  out.max_elbow = 2.6;
  out.min_drive_transmission = 0.3;
  out.min_conditioning = 0.2;
  return out;
}

// The criteria in their order by the functions of the arm alone.
SerialCriterion expected(const SerialConditions& c, const math::Vec2& point) {
  const SerialAngles q = inverse(c.arm, point, c.mode);
  if (q.status != Status::done) return SerialCriterion::reach;
  for (std::size_t k = 0; k < 2; ++k)
    if (drive_at(c.arm.drive[k], c.arm.arm[k], q.angle[k]).status != Status::done)
      return SerialCriterion::travel;
  // By the law of cosines.
  const double x = point.x - c.arm.offset.x, y = point.y - c.arm.offset.y;
  const double elbow = std::acos((0.09 + 0.0625 - x * x - y * y) / 0.15);
  if (elbow < c.min_elbow || elbow > c.max_elbow) return SerialCriterion::elbow;
  const SerialQuality quality_at = quality(c.arm, q.angle);
  for (const double t : quality_at.transmission)
    if (t < c.min_drive_transmission) return SerialCriterion::drive_transmission;
  return quality_at.condition > 1 / c.min_conditioning ? SerialCriterion::conditioning
                                                       : SerialCriterion::none;
}

TEST(SerialPiWorkspace, StopsAtTheFirstCriterion) {
  const SerialConditions c = conditions();
  RandomStream random({.seed = 5});
  std::array<int, serial_criterion_count> seen{};
  for (int trial = 0; trial < 20'000; ++trial) {
    const math::Vec2 point{1.3 * random.uniform() - 0.6, 1.3 * random.uniform() - 0.65};
    const SerialPlace place = look_at(c, point);
    ASSERT_EQ(place.criterion, expected(c, point)) << point.x << ' ' << point.y;
    ++seen[static_cast<std::size_t>(place.criterion)];
    EXPECT_EQ(std::isnan(place[SerialIndex::sine]), place.criterion == SerialCriterion::reach);
  }
  for (const SerialCriterion h : {SerialCriterion::none, SerialCriterion::reach, SerialCriterion::travel,
                                  SerialCriterion::elbow, SerialCriterion::drive_transmission})
    EXPECT_GT(seen[static_cast<std::size_t>(h)], 10) << name_of(h);
}

TEST(SerialPiWorkspace, MapCoversTheAnnulus) {
  SerialConditions c = conditions();
  c = {.arm = {.base = {1, 2}, .offset = {0.06, -0.02}, .arm = {0.3, 0.25}}};
  const SerialGrid grid = whole_reach(c.arm, 0.004);
  RunContext context;
  const SerialMap map = workspace(c, grid, context);
  EXPECT_EQ(map.status, Status::done);
  EXPECT_EQ(map.nodes[0], 277u);
  EXPECT_NEAR(map.position(map.place.size() / 2).x, 1.06, 1e-12);
  EXPECT_NEAR(map.position(map.place.size() - 1).y, 1.98 + 0.552, 1e-12);
  // Some 870 cells of 16 mm2 lie on the edges and are counted or not at random.
  EXPECT_NEAR(static_cast<double>(map.count(SerialCriterion::none)) * map.cell(), reachable_area(c.arm),
              1e-3);
  EXPECT_EQ(map.count(SerialCriterion::none) + map.count(SerialCriterion::reach), map.place.size());
}

TEST(SerialPiWorkspace, StopsWhenAsked) {
  RunContext context;
  context.cancel();
  const SerialMap map = workspace(conditions(), whole_reach(conditions().arm, 0.01), context);
  EXPECT_EQ(map.status, Status::cancelled);
  EXPECT_EQ(map.count(SerialCriterion::open), map.place.size());
}

TEST(SerialPiWorkspace, RefusesGridsWithoutSense) {
  RunContext context;
  const auto grid = [&](const SerialGrid& g) { workspace(conditions(), g, context); };
  EXPECT_THROW(grid({{0, 0}, {1, 1}, 0}), ContractError);
  EXPECT_THROW(grid({{0, 0}, {1, -1}, 0.1}), ContractError);
  EXPECT_THROW(grid({{0, 0}, {1, 1}, 1e-5}), ContractError);
  EXPECT_THROW(whole_reach(conditions().arm, 0), ContractError);
}

TEST(SerialPiWorkspace, AngleBetweenTheArms) {
  EXPECT_NEAR(elbow_angle({0.3, 0.3}), pi, 1e-15);
  EXPECT_NEAR(elbow_angle({3, -3}), pi - (2 * pi - 6), 1e-15);
  EXPECT_NEAR(elbow_angle({1, 1 - pi}), 0, 1e-15);
}

TEST(SerialPiWorkspace, AllocatesNothing) {
  const SerialConditions c = conditions();
  const std::size_t before = test::allocations();
  look_at(c, {0.4, 0.2});
  EXPECT_EQ(test::allocations(), before);
}

}  // namespace
}  // namespace linkwright::parallel
