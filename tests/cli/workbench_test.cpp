// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/workbench.h"

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <regex>
#include <thread>

#include "tests/cli/program_fixture.h"
#include "tests/study/sample_kind.h"

namespace linkwright::cli {
namespace {
namespace fs = std::filesystem;
using ::testing::ContainsRegex;
using ::testing::MatchesRegex;

class Workbench : public test::ProgramFixture {
 protected:
  Workbench() : ProgramFixture(LINKWRIGHT_SAMPLE_PROGRAM) { write("s.toml", study::sample::example); }

  /// Waits for what the program writes.
  std::string written(const std::string& file, const std::string& pattern) const {
    for (int wait = 0; wait < 2000; ++wait) {
      if (const std::string text = text_of(folder_ / file); std::regex_search(text, std::regex(pattern)))
        return text;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return text_of(folder_ / file);
  }
};

TEST_F(Workbench, SaysWhereItIsAndEndsWithCtrlC) {
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove(folder_ / "stdout");
    const pid_t child = start({"serve", "s.toml"});
    written("stdout", "Ctrl-C");
    ::kill(child, signal);
    EXPECT_EQ(finish(child), 0);
    EXPECT_THAT(out_, MatchesRegex("open http://127\\.0\\.0\\.1:[0-9]+/#token=[0-9a-f]+\n"
                                   "Ctrl-C ends the workbench; the address is for you alone\n\n"
                                   "the workbench has ended\n"));
    EXPECT_EQ(err_, "");
  }
}

TEST_F(Workbench, SaysWhyItDoesNotStart) {
  EXPECT_EQ(run({"serve", "none.toml"}), 2);
  EXPECT_EQ(err_, "none.toml: error: there is no such file\n");
  EXPECT_EQ(run({"serve", "--port", "65536"}), 2);
  fs::remove(folder_ / "stdout");
  const pid_t child = start({"serve"});
  const std::string said = written("stdout", "Ctrl-C");
  std::smatch port;
  ASSERT_TRUE(std::regex_search(said, port, std::regex(":([0-9]+)/")));
  const std::string number = port[1];
  EXPECT_EQ(run({"serve", "--port", number}), 2);
  EXPECT_EQ(err_, "linkwright serve: port " + number +
                      " is taken by another program; leave --port out for a free one\n");
  ::kill(child, SIGINT);
  EXPECT_EQ(finish(child), 0);
}

TEST_F(Workbench, OpensThePageIfItCan) {
  write("xdg-open", "#!/bin/sh\necho \"$1\" >\"$(dirname \"$0\")/opened\"\n");
  fs::permissions(folder_ / "xdg-open", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder_.string() + ":" + path).c_str(), 1);
  const pid_t child = start({"serve", "--open"});
  const std::string opened = written("opened", "\n");
  // All users of the machine see the arguments that a browser is started with: a page of this one leads on.
  EXPECT_THAT(opened, MatchesRegex("/.*/linkwright-[A-Za-z0-9]+/workbench.html\n"));
  const fs::path page = opened.substr(0, opened.size() - 1);
  EXPECT_THAT(text_of(page), ContainsRegex("url=http://127\\.0\\.0\\.1:[0-9]+/#token=[0-9a-f]+\""));
  EXPECT_EQ(fs::status(page.parent_path()).permissions(), fs::perms::owner_all);
  ::kill(child, SIGINT);
  EXPECT_EQ(finish(child), 0);
  EXPECT_FALSE(fs::exists(page.parent_path()));
  ::setenv("PATH", "/nowhere", 1);
  fs::remove(folder_ / "stderr");
  const pid_t other = start({"serve", "--open"});
  written("stderr", "\n");
  ::kill(other, SIGINT);
  EXPECT_EQ(finish(other), 0);
  EXPECT_EQ(
      err_,
      "the page was not opened: there is no 'xdg-open' on this machine; open the address in a browser\n");
  ::setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace linkwright::cli
