// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/manual.h"

#include <gmock/gmock.h>

#include "linkwright/cli/arguments.h"

namespace linkwright::cli {
namespace {
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(Manual, HoldsEveryCommandAndOptionOfTheHelp) {
  const std::string page = manual_page();
  EXPECT_THAT(page, StartsWith(".TH LINKWRIGHT 1 \"\" \"linkwright 0.1.0\" \"User Commands\"\n.SH NAME\n"
                               "linkwright \\- analyse, balance and synthesise mechanisms\n"));
  for (const CommandHelp& command : command_help())
    EXPECT_THAT(page, HasSubstr("\n.SS " + command.name + "\n.B linkwright " + command.name + "\n"));
  EXPECT_THAT(page, HasSubstr("\n.TP\n.BI \"\\-o, \\-\\-out \" FOLDER\n"
                              "folder of the results (default: what the study says, or out/STUDY)\n"));
  EXPECT_THAT(page,
              HasSubstr("\n.SS compare\n.B linkwright compare\n.RI [ options ]\n.IR RESULT \" ...\"\n"));
  EXPECT_THAT(page, HasSubstr("\n.SH EXIT STATUS\n.TP\n.B 0\ndone\n.TP\n.B 1\na check failed\n"));
}

}  // namespace
}  // namespace linkwright::cli
