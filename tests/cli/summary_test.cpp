// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/summary.h"

#include <gtest/gtest.h>

namespace linkwright::cli {
namespace {

study::Result doubtful() {
  study::Result result;
  result.headline = "It turns";
  result.facts = {{"length", "0.4 m", study::Fact::Verdict::plain},
                  {"angle", "3 deg", study::Fact::Verdict::bad}};
  return result;
}

TEST(Summary, EndsWithTheReportToOpen) {
  EXPECT_EQ(summary("A lever", doubtful(), {"out/s/result.json", "out/s/report.html", "out/s/a.svg"}, false),
            "A lever\n"
            "  It turns\n"
            "  status  done\n"
            "  length  0.4 m\n"
            "  angle   3 deg  (!)\n"
            "results in out/s:\n"
            "  result.json\n"
            "  report.html\n"
            "  a.svg\n"
            "open out/s/report.html\n");
  EXPECT_EQ(summary("", doubtful(), {"out/s/result.json"}, false),
            "  It turns\n  status  done\n  length  0.4 m\n  angle   3 deg  (!)\nresults in out/s:\n  "
            "result.json\n");
}

TEST(Summary, FilesOfFoldersStandWithThem) {
  EXPECT_EQ(summary("", doubtful(), {"out/s/result.json", "out/s/designs/1-open.toml"}, false),
            "  It turns\n  status  done\n  length  0.4 m\n  angle   3 deg  (!)\nresults in out/s:\n"
            "  result.json\n  designs/1-open.toml\n");
}

TEST(Summary, ColoursFollowTheVerdict) {
  EXPECT_EQ(summary("A", doubtful(), {}, true),
            "\033[1mA\033[0m\n  It turns\n  status  \033[33mdone\033[0m\n  length  0.4 m\n"
            "  angle   \033[1;31m3 deg  (!)\033[0m\n");
  study::Result failed = doubtful();
  failed.status = Status::no_assembly;
  failed.facts.clear();
  EXPECT_EQ(summary("", failed, {}, true), "  It turns\n  status  \033[1;31mno_assembly\033[0m\n");
}

}  // namespace
}  // namespace linkwright::cli
