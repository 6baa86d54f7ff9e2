// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/study_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>

namespace linkwright::serve {
namespace {
namespace fs = std::filesystem;

class StudyFileTest : public ::testing::Test {
 protected:
  StudyFileTest()
      : folder_(fs::temp_directory_path() / ("linkwright-study-file-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("one\n");
  }
  ~StudyFileTest() override { fs::remove_all(folder_); }

  void write(const std::string& text) const { std::ofstream(folder_ / "s.toml", std::ios::binary) << text; }
  std::string text() const {
    std::ostringstream found;
    found << std::ifstream(folder_ / "s.toml", std::ios::binary).rdbuf();
    return found.str();
  }

  fs::path folder_;
};

TEST_F(StudyFileTest, SavesWhatWasReadHereAndNothingElse) {
  StudyFile file(folder_ / "s.toml");
  const StudyFile::Text read = file.read();
  EXPECT_EQ(read.text, "one\n");
  const StudyFile::Saved saved = file.save("two\n", read.version);
  EXPECT_EQ(saved.outcome, StudyFile::Outcome::saved);
  EXPECT_EQ(text(), "two\n");
  EXPECT_EQ(saved.version, file.read().version);
  // The version of before is one no more.
  const StudyFile::Saved again = file.save("three\n", read.version);
  EXPECT_EQ(again.outcome, StudyFile::Outcome::changed);
  EXPECT_EQ(again.problem, "was changed by another program since it was opened here");
  EXPECT_EQ(text(), "two\n");
  write("of somebody else\n");
  EXPECT_EQ(file.save("three\n", saved.version).outcome, StudyFile::Outcome::changed);
  EXPECT_EQ(text(), "of somebody else\n");
  EXPECT_EQ(file.save("three\n", "").outcome, StudyFile::Outcome::changed);
}

TEST_F(StudyFileTest, APipeIsNotWaitedFor) {
  StudyFile file(folder_ / "s.toml");
  const std::string version = file.read().version;
  fs::remove(folder_ / "s.toml");
  ASSERT_EQ(::mkfifo((folder_ / "s.toml").c_str(), 0600), 0);
  EXPECT_EQ(file.read().problem, "is not a plain file");
  EXPECT_EQ(file.save("two\n", version).outcome, StudyFile::Outcome::changed);
}

TEST_F(StudyFileTest, AReadOnlyFileIsNotReplaced) {
  StudyFile file(folder_ / "s.toml");
  ASSERT_EQ(::chmod((folder_ / "s.toml").c_str(), 0444), 0);
  const StudyFile::Saved saved = file.save("two\n", file.read().version);
  EXPECT_EQ(saved.outcome, StudyFile::Outcome::failed);
  EXPECT_EQ(saved.problem, "cannot be written: Permission denied");
  EXPECT_EQ(text(), "one\n");
}

TEST_F(StudyFileTest, AFileThatIsGoneIsNotWrittenAgain) {
  StudyFile file(folder_ / "s.toml");
  const std::string version = file.read().version;
  fs::remove(folder_ / "s.toml");
  EXPECT_EQ(file.read().problem, "there is no such file");
  EXPECT_EQ(file.save("two\n", version).outcome, StudyFile::Outcome::changed);
  EXPECT_EQ(file.save("two\n", "").outcome, StudyFile::Outcome::changed);
  EXPECT_FALSE(fs::exists(folder_ / "s.toml"));
}

TEST_F(StudyFileTest, ALinkAndThePermissionsStay) {
  fs::create_symlink("s.toml", folder_ / "link.toml");
  ASSERT_EQ(::chmod((folder_ / "s.toml").c_str(), 0640), 0);
  StudyFile file(folder_ / "link.toml");
  EXPECT_EQ(file.save("two\n", file.read().version).outcome, StudyFile::Outcome::saved);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.toml"));
  EXPECT_EQ(text(), "two\n");
  struct stat now = {};
  ASSERT_EQ(::stat((folder_ / "s.toml").c_str(), &now), 0);
  EXPECT_EQ(now.st_mode & 07777, 0640u);
}

TEST_F(StudyFileTest, OtherEncodingsAreNotEdited) {
  write("title = \"M\xfc\"\n");
  EXPECT_EQ(StudyFile(folder_ / "s.toml").read().problem,
            "is not UTF-8; convert it before it is edited here");
}

TEST_F(StudyFileTest, AKillInTheMiddleLeavesTheOldOrTheNewText) {
  const std::string old_text(200000, 'a'), new_text(300000, 'b');
  for (int round = 0; round < 30; ++round) {
    write(old_text);
    const pid_t child = ::fork();
    if (child == 0) {
      StudyFile file(folder_ / "s.toml");
      for (std::string text = new_text;; text = text == new_text ? old_text : new_text)
        file.save(text, file.read().version);
    }
    ::usleep(static_cast<useconds_t>(2000 + 500 * round));
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    const std::string found = text();
    EXPECT_TRUE(found == old_text || found == new_text) << found.size();
    const StudyFile next(folder_ / "s.toml");  // takes away what was half written
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
  }
}

}  // namespace
}  // namespace linkwright::serve
