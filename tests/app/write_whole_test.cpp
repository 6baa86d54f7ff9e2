// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/write_whole.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>
#include <sstream>

namespace linkwright::app {
namespace {
namespace fs = std::filesystem;

class WriteWhole : public ::testing::Test {
 protected:
  WriteWhole() : folder_(fs::temp_directory_path() / ("linkwright-write-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~WriteWhole() override { fs::remove_all(folder_); }

  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename().string());
    return names;
  }

  fs::path folder_;
};

TEST_F(WriteWhole, ReplacesAndLeavesNothingElse) {
  for (const std::string& text : {std::string("one\n"), std::string("\0two", 4), std::string()}) {
    EXPECT_EQ(write_whole(folder_ / "a", text), "");
    std::ostringstream found;
    found << std::ifstream(folder_ / "a", std::ios::binary).rdbuf();
    EXPECT_EQ(found.str(), text);
    EXPECT_EQ(names(), std::set<std::string>{"a"});
  }
}

TEST_F(WriteWhole, KeepsThePermissionsOfWhatItReplaces) {
  for (const mode_t mode : {0600u, 0640u, 0755u}) {
    std::ofstream(folder_ / "a") << "x";
    ASSERT_EQ(::chmod((folder_ / "a").c_str(), mode), 0);
    EXPECT_EQ(write_whole(folder_ / "a", "y"), "");
    struct stat now = {};
    ASSERT_EQ(::stat((folder_ / "a").c_str(), &now), 0);
    EXPECT_EQ(now.st_mode & 07777, mode);
  }
}

TEST_F(WriteWhole, LeavesWhatNobodyMayWrite) {
  std::ofstream(folder_ / "a") << "x";
  ASSERT_EQ(::chmod((folder_ / "a").c_str(), 0444), 0);
  EXPECT_EQ(write_whole(folder_ / "a", "y"), "Permission denied");
  std::ostringstream found;
  found << std::ifstream(folder_ / "a").rdbuf();
  EXPECT_EQ(found.str(), "x");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

TEST_F(WriteWhole, KeepsTheOwner) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root gives files away";
  std::ofstream(folder_ / "a") << "x";
  ASSERT_EQ(::chown((folder_ / "a").c_str(), 1234, 4321), 0);
  EXPECT_EQ(write_whole(folder_ / "a", "y"), "");
  struct stat now = {};
  ASSERT_EQ(::stat((folder_ / "a").c_str(), &now), 0);
  EXPECT_EQ(now.st_uid, 1234U);
  EXPECT_EQ(now.st_gid, 4321U);
}

TEST_F(WriteWhole, SaysWhyNot) {
  EXPECT_EQ(write_whole(folder_ / "none" / "a", "x"), "No such file or directory");
  fs::create_directories(folder_ / "a" / "b");  // a folder with something in it is not replaced
  EXPECT_NE(write_whole(folder_ / "a", "x"), "");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

TEST_F(WriteWhole, LeftoversOfDeadProcessesGo) {
  const pid_t dead = ::fork();
  if (dead == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(dead, nullptr, 0), dead);
  const std::string gone = "a." + std::to_string(dead) + ".part",
                    alive = "a." + std::to_string(::getpid()) + ".part",
                    other = "b." + std::to_string(dead) + ".part";
  const std::set<std::string> stay = {"a", "a.part", "a.1x.part", "a.-1.part", "a..part", alive, other};
  for (const std::string& name : stay) std::ofstream(folder_ / name) << "x";
  std::ofstream(folder_ / gone) << "x";
  remove_leftovers(folder_ / "a");
  EXPECT_EQ(names(), stay);
  remove_leftovers(folder_ / "none" / "a");  // nothing there, nothing to do
}

}  // namespace
}  // namespace linkwright::app
