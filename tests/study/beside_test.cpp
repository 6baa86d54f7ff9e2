// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/beside.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "linkwright/study/study.h"

namespace linkwright::study {
namespace {

using ::testing::HasSubstr;

TEST(ReadBeside, ReadsFilesInTheFolderOfTheStudyOrSaysWhyNot) {
  const auto folder = std::filesystem::temp_directory_path() / "linkwright_beside_test";
  std::filesystem::create_directories(folder / "inner");
  std::ofstream(folder / "points.csv", std::ios::binary) << "x_m\r\n1\r\n";
  std::ofstream(folder / "large.csv") << std::string((4u << 20) + 1, 'x');
  Diagnostics problems;
  const Value document = read_text("file = \"points.csv\"\n", Syntax::toml, "study.toml", problems);
  DocumentReader reader(document, "study.toml", problems);
  ObjectReader root = reader.root();
  ASSERT_TRUE(root.has("file"));
  EXPECT_EQ(read_beside(root, "file", folder, "points.csv"), "x_m\r\n1\r\n");
  EXPECT_TRUE(problems.empty());
  const auto told = [&](const std::string& file) {
    problems.clear();
    EXPECT_FALSE(read_beside(root, "file", folder, file));
    return problems.empty() ? std::string() : to_string(problems[0]);
  };
  EXPECT_THAT(told("nowhere.csv"), HasSubstr("study.toml:1:8: error: file: cannot read '"));
  EXPECT_THAT(told("inner"), HasSubstr("cannot read '"));
  EXPECT_THAT(told("large.csv"), HasSubstr("'large.csv' has 4194305 bytes, at most 4194304 are allowed"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace linkwright::study
