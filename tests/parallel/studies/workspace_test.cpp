// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/workspace.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/study/result_units.h"
#include "parallel/robots.h"
#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::column;
using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;

const std::string delta =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.delta\"\nbase_radius_mm = "
    "200\nplatform_radius_mm = 45\n"
    "arm_mm = 350\nrod_mm = 800\n[mechanism.drive]\ntype = \"pi_joint\"\nmounting_deg = 30\ntravel_deg = "
    "[-60, 60]\n"
    "[limits]\ntransmission = 0.5\n[home]\nposition_mm = [0, 0, -800]\n";
const std::string box =
    "[workspace]\nlower_mm = [-1000, -1000, -1200]\nupper_mm = [1000, 1000, 0]\nstep_mm = 40\n";

TEST(WorkspaceStudy, CountsNodesByWhatTheyFail) {
  const auto result = run_text(delta + box);
  EXPECT_EQ(result.status, Status::done);
  const auto& left = column(result, "workspace_totals", "left");
  for (std::size_t i = 1; i < left.size(); ++i) EXPECT_LE(left[i], left[i - 1]);
  // A grid of 20 mm has 44273 nodes, 0.3542 m3; one of 40 mm about an eighth of them.
  EXPECT_NEAR(column(result, "workspace_totals", "volume_left_m3").back(), 0.3542, 0.006);
  const Table& nodes = test::table(result, "workspace");
  EXPECT_EQ(std::count(nodes.status.begin(), nodes.status.end(), "done"), static_cast<long>(left.back()));
  double sum = 0;
  for (const double lci : column(result, "workspace", "conditioning"))
    if (!std::isnan(lci)) sum += lci;
  EXPECT_NEAR(sum / left.back(), 0.3915, 0.003);
}

TEST(WorkspaceStudy, DrawsSlices) {
  const auto result = run_text(delta + box + "slices = 3\nindices = [\"transmission\"]\nnodes = false\n");
  ASSERT_EQ(result.plots.size(), 1u);
  EXPECT_EQ(result.plots[0].style, study::Plot::Style::map);
  EXPECT_EQ(result.plots[0].group, "z_m");
  std::set<double> levels;
  for (const double z : column(result, "workspace_slices", "z_m")) levels.insert(z);
  EXPECT_EQ(levels.size(), 3u);
  for (const Table& t : result.tables) EXPECT_NE(t.name, "workspace");
}

TEST(WorkspaceStudy, OfMoreNodesThanMemoryHoldsTotalsAndCoarseSlices) {
  const std::string fine =
      "[workspace]\nlower_mm = [-600, -600, -1150]\nupper_mm = [600, 600, -400]\nstep_mm = 8\n"
      "slices = 3\nboundary = 24\n";
  const auto result = run_text(delta + fine);
  EXPECT_EQ(result.status, Status::done);
  // 2.17 million nodes of 8 mm beside the 44273 nodes of 20 mm of all of it.
  EXPECT_NEAR(column(result, "workspace_totals", "volume_left_m3").back(), 0.3542, 0.002);
  EXPECT_THAT(test::fact(result, "workspace"), HasSubstr(" of 2143294 nodes"));
  EXPECT_THAT(test::fact(result, "joined to home without a singularity"), HasSubstr("not looked at"));
  EXPECT_THAT(test::fact(result, "table of nodes"), HasSubstr("left out"));
  std::set<double> levels;
  for (const double z : column(result, "workspace_slices", "z_m")) levels.insert(z);
  EXPECT_EQ(levels.size(), 3u);
  EXPECT_GT(test::table(result, "workspace_slices").rows(), 30000u);
  EXPECT_LE(test::table(result, "workspace_slices").rows(), 100000u);
  EXPECT_GE(test::table(result, "workspace_boundary").rows(), 72u);
  EXPECT_EQ(result.plots.size(), 2u);
}

TEST(WorkspaceStudy, TellsWhatCanBePromised) {
  const auto result =
      run_text(delta + box + "boundary = 36\n[workspace.inscribed]\naxis_mm = [0, 0]\nheight_mm = 200\n");
  EXPECT_THAT(test::fact(result, "joined to home without a singularity"),
              HasSubstr(" of 5530 nodes, 4 aspects"));
  EXPECT_THAT(test::fact(result, "largest cylinder"), HasSubstr("height 200 mm, at 0, 0, "));
  // Every ray of every slice ends where a pose no longer passes.
  const Table& boundary = test::table(result, "workspace_boundary");
  ASSERT_GE(boundary.rows(), 100u);
  const Drive drive{
      .type = DriveType::pi_joint, .ratio = 0.4, .mounting = pi / 6, .lowest = -pi / 3, .highest = pi / 3};
  PoseConditions conditions{.robot = reference_delta(), .assembly = -1, .min_transmission = 0.5};
  conditions.drives.fill(drive);
  const auto &z = column(result, "workspace_boundary", "z_m"),
             &angle = column(result, "workspace_boundary", "direction_rad"),
             &to = column(result, "workspace_boundary", "to_m");
  for (std::size_t i = 0; i < boundary.rows(); ++i) {
    const auto at = [&](double radius) {
      return check_pose(conditions, {{radius * std::cos(angle[i]), radius * std::sin(angle[i]), z[i]}});
    };
    EXPECT_EQ(at(to[i] - 1e-6), Criterion::none);
    EXPECT_NE(at(to[i] + 1e-6), Criterion::none);
  }
}

/// The sizes and the centre of the body, in this unit.
std::string body_text(const study::Result& result, std::string_view label, std::string_view unit) {
  study::DisplayUnits units;
  units.choose({{}, find_unit(Dimension::length, unit), Dimension::length});
  return test::fact(study::in_units(result, units), label);
}

TEST(WorkspaceStudy, SaysABodyInOneUnit) {
  const auto space = run_text(delta + box + "[workspace.inscribed]\naxis_mm = [0, 0]\nheight_mm = 254\n");
  EXPECT_THAT(body_text(space, "largest cylinder", "in"),
              ContainsRegex("^diameter [0-9.]+ in, height 10 in, at 0, 0, -[0-9.]+ in,"));
  const auto plane = run_text(
      "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.five_bar\"\n"
      "[[mechanism.leg]]\nbase_mm = [-150, 0]\narm_mm = 250\nrod_mm = 350\n"
      "[[mechanism.leg]]\nbase_mm = [150, 0]\narm_mm = 250\nrod_mm = 350\n[home]\nposition_mm = [0, 400, "
      "0]\n"
      "[workspace]\nlower_mm = [-600, -600, 0]\nupper_mm = [600, 600, 0]\nstep_mm = 40\n"
      "[workspace.inscribed]\nshape = \"box\"\n");
  EXPECT_THAT(body_text(plane, "largest box", "mm"),
              ContainsRegex("^[0-9.]+ x [0-9.]+ mm, at -?[0-9.]+, -?[0-9.]+ mm"));
  EXPECT_THAT(body_text(plane, "largest box", "in"),
              ContainsRegex("^[0-9.]+ x [0-9.]+ in, at -?[0-9.]+, -?[0-9.]+ in"));
}

TEST(WorkspaceStudy, TellsWhatIsWrongWithTheBox) {
  EXPECT_THAT(problems_of(delta + replaced(box, "step_mm = 40", "step_mm = 1")),
              HasSubstr("makes 4.81e+09 nodes, at most 1e+09 are allowed"));
  EXPECT_THAT(
      problems_of(delta + replaced(box, "step_mm = 40", "step_mm = 10") + "[workspace.inscribed]\n"),
      HasSubstr("error: workspace.inscribed: needs all nodes in memory: at most 2e+06, these are 4.89e+06"));
  EXPECT_THAT(problems_of(delta + replaced(box, "upper_mm = [1000", "upper_mm = [-2000")),
              HasSubstr("is below lower along x"));
  EXPECT_THAT(problems_of(delta + box + "rotation_deg = [0, 0, 5]\n"),
              HasSubstr("the platform of this robot does not turn"));
  EXPECT_THAT(problems_of(delta + box + "indices = []\n"), HasSubstr("name at least one"));
  EXPECT_THAT(problems_of(delta + box + "indices = [\"rods\", \"rods\"]\n"), HasSubstr("one is named twice"));
  EXPECT_THAT(problems_of(delta + box + "[workspace.inscribed]\nshape = \"box\"\nheight_mm = 20\n"),
              HasSubstr("axis, height and ratio are those of a cylinder"));
  EXPECT_THAT(problems_of(delta + box + "[workspace.inscribed]\nratio = 2\nheight_mm = 20\n"),
              HasSubstr("keep one of them"));
}

}  // namespace
}  // namespace linkwright::parallel
