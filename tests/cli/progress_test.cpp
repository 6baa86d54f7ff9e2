#include "linkwright/cli/progress.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkwright::cli {
namespace {

TEST(ProgressLine, StageShareAndBest) {
  EXPECT_EQ(progress_line({"grey_wolf", 0.5, 0.0090288}),
            "grey_wolf  [##########..........]  50%  best 0.0090288");
  EXPECT_EQ(progress_line({"sweep", 0.999, std::nan("")}), "sweep  [###################.]  99%");
  EXPECT_EQ(progress_line({"x", 7, std::nan("")}), "x  [####################] 100%");
  EXPECT_EQ(progress_line({"x", std::nan(""), std::nan("")}), "x  [....................]   0%");
  EXPECT_EQ(progress_line({std::string_view("a long stage"), 0, 1}, 10).size(), 10u);
}

}  // namespace
}  // namespace linkwright::cli
