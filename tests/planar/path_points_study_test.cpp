#include "linkwright/planar/path_points_study.h"

#include <gmock/gmock.h>

#include <string>

#include "linkwright/study/read.h"

namespace linkwright::planar {
namespace {

struct ReadPoints {
  std::vector<double> x, y;
  std::string problems;
};
ReadPoints read(const std::string& text, bool closed) {
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "study.toml", diagnostics);
  study::DocumentReader reader(document, "study.toml", diagnostics);
  study::ObjectReader root = reader.root();
  ReadPoints out;
  if (auto target = root.table("target")) {
    PathPointsForm form;
    target->read(form);
    read_path_points(*target, {}, form, closed, out.x, out.y);
  }
  reader.finish();
  for (const Diagnostic& d : diagnostics) out.problems += to_string(d) + "\n";
  return out;
}

TEST(PathPointsStudy, ReadsPointsInAnyUnit) {
  const ReadPoints points = read("[target]\npoints_mm = [[0, 1], [2, 3], [4, 5]]\n", true);
  EXPECT_EQ(points.problems, "");
  EXPECT_THAT(points.x, ::testing::ElementsAre(0, 0.002, 0.004));
  EXPECT_THAT(points.y, ::testing::ElementsAre(0.001, 0.003, 0.005));
}

// Points that a closed path must not repeat are no problem of an open one.
TEST(PathPointsStudy, OnlyClosedPathsMustNotEndWhereTheyBegin) {
  const std::string text = "[target]\npoints_m = [[0, 1], [2, 3], [4, 5], [0, 1]]\n";
  EXPECT_EQ(read(text, false).problems, "");
  EXPECT_THAT(read(text, true).problems, ::testing::HasSubstr("the last point repeats the first: (0, 1)"));
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
