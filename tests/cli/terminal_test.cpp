// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/terminal.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace linkwright::cli {
namespace {

TEST(Colours, NoColorBeforeForceBeforeTheTerminal) {
  ::unsetenv("NO_COLOR");
  ::setenv("CLICOLOR_FORCE", "1", 1);
  EXPECT_TRUE(wants_colours(Stream::out));
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_FALSE(wants_colours(Stream::out));
  ::setenv("NO_COLOR", "", 1);
  EXPECT_TRUE(wants_colours(Stream::out));
  ::setenv("CLICOLOR_FORCE", "0", 1);
  ::setenv("TERM", "dumb", 1);
  EXPECT_FALSE(wants_colours(Stream::out));
  ::unsetenv("CLICOLOR_FORCE");
}

TEST(Colours, PaintOnlyTheWordOfADiagnostic) {
  Diagnostic d{Diagnostic::Severity::error, "my error: file.toml", {2, 1}, "a", "is wrong", {}};
  EXPECT_EQ(painted(d, false), to_string(d));
  EXPECT_EQ(painted(d, true), "my error: file.toml:2:1: \033[1;31merror:\033[0m a: is wrong");
  d.severity = Diagnostic::Severity::warning;
  EXPECT_EQ(painted(d, true), "my error: file.toml:2:1: \033[33mwarning:\033[0m a: is wrong");
  EXPECT_EQ(paint("x", Colour::pale, true), "\033[2mx\033[0m");
  EXPECT_EQ(paint("x", Colour::green, false), "x");
}

TEST(Interruptible, TheFirstSignalCancelsTheRun) {
  RunContext context;
  {
    const Interruptible guard(context);
    std::raise(SIGINT);
  }
  EXPECT_EQ(context.interruption(), Status::cancelled);
}

}  // namespace
}  // namespace linkwright::cli
