// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/path_points.h"

#include <gmock/gmock.h>

#include <optional>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/study/study.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

struct ReadPoints {
  std::vector<double> x, y;
  std::string problems;
};
// `rotation`: of the crank from the first point to the last, in equal steps; nothing = free timing.
ReadPoints read(const std::string& text, bool closed, std::optional<double> rotation = 1) {
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "study.toml", diagnostics);
  study::DocumentReader reader(document, "study.toml", diagnostics);
  study::ObjectReader root = reader.root();
  ReadPoints out;
  if (auto target = root.table("target")) {
    PathTargetForm form;
    target->read(form);
    form.closed = closed;
    if (rotation && form.points && form.points->size() > 1)
      form.timing = {.mode = Timing::equal_steps,
                     .step = *rotation / static_cast<double>(form.points->size() - 1)};
    const PathTargets points = read_path_targets(*target, {}, form);
    out.x = points.x, out.y = points.y;
  }
  reader.finish();
  out.problems = test::lines_of(diagnostics);
  return out;
}

TEST(PathPointsStudy, ReadsPointsInAnyUnit) {
  const ReadPoints points = read("[target]\npoints_mm = [[0, 1], [2, 3], [4, 5]]\n", true);
  EXPECT_EQ(points.problems, "");
  EXPECT_THAT(points.x, ::testing::ElementsAre(0, 0.002, 0.004));
  EXPECT_THAT(points.y, ::testing::ElementsAre(0.001, 0.003, 0.005));
}

// The closing point of a closed path counts once; an open path meets it twice.
TEST(PathPointsStudy, TheClosingPointOfAClosedPathCountsOnce) {
  const std::string text = "[target]\npoints_m = [[0, 1], [2, 3], [4, 5], [0, 1]]\n";
  EXPECT_EQ(read(text, false).problems, "");
  EXPECT_EQ(read(text, false).x.size(), 4u);
  const ReadPoints closed = read(text, true);
  EXPECT_THAT(closed.problems,
              ::testing::HasSubstr("warning: target.points_m: the last of 4 points repeats the "
                                   "first: taken once"));
  EXPECT_THAT(closed.x, ::testing::ElementsAre(0, 2, 4));
  EXPECT_THAT(closed.y, ::testing::ElementsAre(1, 3, 5));
  // A path whose timing says a turn, or nothing, is closed by it.
  for (const auto rotation : {std::optional(-2 * pi), std::optional<double>()}) {
    const ReadPoints turned = read(text, false, rotation);
    EXPECT_THAT(turned.problems,
                ::testing::HasSubstr("study.toml:2:12: warning: target.points_m: the last of 4 "
                                     "points repeats the first: taken once, and the path as "
                                     "closed; write closed = true, or closed = false"));
    EXPECT_THAT(turned.x, ::testing::SizeIs(3));
  }
  // Two points and the first again are no path.
  EXPECT_THAT(read("[target]\npoints_m = [[0, 1], [2, 3], [0, 1]]\n", true).x, ::testing::SizeIs(3));
}

TEST(PathPointsStudy, RepetitionIsToldToRounding) {
  EXPECT_TRUE(repeats_first_point({0.1, 5, 3, 0.1 + 1e-13}, {1, 2, 3, 1}));
  EXPECT_FALSE(repeats_first_point({0.1, 5, 3, 0.1 + 1e-9}, {1, 2, 3, 1}));
  EXPECT_FALSE(repeats_first_point({1}, {1}));
}

TEST(PathPointsStudy, TellsWhatIsMissing) {
  EXPECT_THAT(read("[target]\n", false).problems, ::testing::HasSubstr("the target has no points"));
  EXPECT_THAT(read("[target]\npoints_m = [[0, 1]]\npoints_file = \"a.csv\"\n", false).problems,
              ::testing::HasSubstr("the target has both points and points_file"));
  EXPECT_THAT(read("[target]\npoints_m = [[0, 1], [1, 0]]\n", false).problems,
              ::testing::HasSubstr("2 points make no path, at least 3 are needed"));
}

}  // namespace
}  // namespace linkwright::planar
