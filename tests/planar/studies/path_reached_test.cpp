// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/path_reached.h"

#include <gmock/gmock.h>

#include <complex>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

// A point, a point with a tolerance, a gate from (3, 0) to (3, 2), and where a tracing point comes.
PathTargets targets() {
  PathTargets p;
  p.x = {0, 1, 3};
  p.y = {0, 1, 1};
  p.gate_x = {0, 0, 0};
  p.gate_y = {0, 0, 1};
  p.tolerance = {0, 0.5, 0};
  p.closed = false;
  return p;
}
PathTargets points() {
  PathTargets p = targets();
  p.gate_x.clear(), p.gate_y.clear(), p.tolerance.clear();
  return p;
}
const std::vector<double> angles = {0.1, 0.2, 0.3};
PathErrors errors(const PathTargets& p) { return path_errors(p, {{0.25, 0}, {1.75, 1}, {3, 1.875}}); }

TEST(PathReached, TableHoldsDistancesAndWhatIsBeyondTheTolerance) {
  const Table table = point_table(targets(), angles, errors(targets()), "points");
  EXPECT_THAT(table.find("distance_m")->values, ::testing::ElementsAre(0.25, 0.75, 0));
  EXPECT_THAT(table.find("excess_m")->values, ::testing::ElementsAre(0.25, 0.25, 0));
  EXPECT_THAT(table.find("tolerance_m")->values, ::testing::ElementsAre(0, 0.5, 0));
  EXPECT_THAT(table.find("crank_angle_rad")->values, ::testing::ElementsAreArray(angles));
  const Table plain = point_table(points(), angles, errors(points()), "points");
  EXPECT_THAT(plain.find("distance_m")->values, ::testing::ElementsAre(0.25, 0.75, 0.875));
  EXPECT_EQ(plain.find("excess_m"), nullptr);
  const Table apart = point_table(points(), angles, path_errors(points(), {{0, 0}, {nan, nan}, {3, 1}}), "p");
  EXPECT_THAT(apart.status, ::testing::ElementsAre("done", "no_assembly", "done"));
}

TEST(PathReached, WordsTellHowNear) {
  EXPECT_EQ(to_string(how_near(points(), errors(points()), 3 * 0.25)),
            "passes the 3 points within 0.875 m (root mean square 0.5 m)");
  EXPECT_EQ(to_string(how_near(targets(), errors(targets()), 3 * 0.0625)),
            "passes the 3 gates within 0.25 m of their tolerance (root mean square 0.25 m)");
  EXPECT_EQ(to_string(how_near(points(), path_errors(points(), {{0, 0}, {1, 1}, {3, 1}}), 0)),
            "passes the 3 points exactly");
  EXPECT_EQ(to_string(how_near(targets(), path_errors(targets(), {{0, 0}, {1.25, 1}, {3, 2}}), 0)),
            "passes the 3 gates within their tolerance");
  EXPECT_EQ(to_string(worst_fact(points(), errors(points())).text), "0.875 m at point 3");
  EXPECT_EQ(to_string(worst_fact(targets(), errors(targets())).text), "0.25 m at gate 1");
}

TEST(PathReached, DrawsPointsToDragAndGatesWithTheirPosts) {
  study::Scene scene;
  add_targets(scene, points(), angles, errors(points()));
  ASSERT_EQ(scene.targets.size(), 1u);
  ASSERT_EQ(scene.handles.size(), 3u);
  EXPECT_EQ(scene.handles[2].key, "target.points_m[2]");
  study::Scene gates;
  add_targets(gates, targets(), angles, errors(targets()));
  ASSERT_EQ(gates.targets.size(), 2u);
  EXPECT_THAT(gates.handles, ::testing::IsEmpty());
  EXPECT_THAT(gates.targets[0].y, ::testing::ElementsAre(0, 1, 1.875));  // the nearest place of each
  EXPECT_THAT(gates.targets[1].y, ::testing::ElementsAre(0, 0, 1, 1, 0, 2));
}

}  // namespace
}  // namespace linkwright::planar
