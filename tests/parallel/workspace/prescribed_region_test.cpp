// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/prescribed_region.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::parallel {
namespace {

PrescribedRegion cylinder() { return {.width = 0.8, .height = 0.25}; }

double mean(const std::vector<RegionPoint>& points, double (*f)(const math::Vec3&)) {
  double sum = 0;
  for (const RegionPoint& p : points) sum += p.weight * f(p.place);
  return sum;
}

TEST(PrescribedRegion, NodesTakeInTheEndsAndEachPlaceOnce) {
  const auto nodes = region_nodes(cylinder());
  // One a height on the axis, 4 radii of 61 azimuths.
  ASSERT_EQ(nodes.size(), 5u + 4 * 61 * 5);
  EXPECT_EQ(nodes.front().place, math::Vec3());
  EXPECT_NEAR(nodes.back().place.x, 0.2, 1e-15);
  EXPECT_NEAR(nodes.back().place.y, 0.4 * std::sqrt(0.75), 1e-15);
  EXPECT_EQ(nodes.back().place.z, -0.25);

  PrescribedRegion full = cylinder();
  full.symmetric = false;
  full.nodes = {3, 13, 2};
  const auto round = region_nodes(full);
  EXPECT_EQ(round.size(), 2u + 2 * 12 * 2);
  for (std::size_t a = 0; a < round.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT(norm(round[a].place - round[b].place), 1e-3);
}

// Mean values known in closed form; the midpoint rule has an error of second order in the cells.
TEST(PrescribedRegion, CellsGiveMeanValues) {
  const auto square = [](const math::Vec3& p) { return p.x * p.x + p.y * p.y; };
  const auto depth = [](const math::Vec3& p) { return p.z; };
  PrescribedRegion region = cylinder();
  region.cells = {60, 6, 3};
  EXPECT_NEAR(mean(region_cells(region), square), 0.4 * 0.4 / 2, 1e-4);
  EXPECT_NEAR(mean(region_cells(region), depth), -0.125, 1e-14);
  const PrescribedRegion circle{.shape = RegionShape::circle, .width = 0.4, .cells = {60, 60, 1}};
  EXPECT_NEAR(mean(region_cells(circle), [](const math::Vec3& p) { return p.y; }), 0.2, 1e-14);
  const PrescribedRegion box{.shape = RegionShape::box,
                             .width = 0.4,
                             .length = 0.6,
                             .height = 0.2,
                             .symmetric = false,
                             .cells = {20, 20, 20}};
  // The midpoint rule of n cells gives 1 - 1/n^2 of the second moment of an interval.
  EXPECT_NEAR(mean(region_cells(box), square), (0.16 + 0.36) / 12 * (1 - 1.0 / 400), 1e-15);
}

TEST(PrescribedRegion, SaysWhatIsWrong) {
  EXPECT_EQ(problem(cylinder()), "");
  EXPECT_EQ(problem({.height = 1}), "width = 0 m");
  EXPECT_EQ(problem({.width = 1}), "height = 0 m");
  EXPECT_EQ(problem({.shape = RegionShape::circle, .width = 1}), "");
  EXPECT_EQ(problem({.width = 1, .height = 1, .nodes = {5, 1, 5}}), "1 nodes along coordinate 2: 2 to 1000");
  EXPECT_EQ(problem({.shape = RegionShape::box, .width = 1, .length = 1, .height = 1}),
            "a box does not have the symmetry of the robots");
}

TEST(PrescribedRegion, HasAMiddle) {
  EXPECT_EQ(middle_of({.shape = RegionShape::cylinder, .width = 1, .height = 0.4}), (math::Vec3{0, 0, -0.2}));
  EXPECT_EQ(middle_of({.shape = RegionShape::box, .width = 1, .length = 2, .height = 0.4}),
            (math::Vec3{0, 0, -0.2}));
  EXPECT_EQ(middle_of({.shape = RegionShape::circle, .width = 1}), (math::Vec3{0, 0.5, 0}));
  EXPECT_EQ(middle_of({.shape = RegionShape::rectangle, .width = 1, .height = 0.4}), (math::Vec3{0, 0.2, 0}));
}

}  // namespace
}  // namespace linkwright::parallel
