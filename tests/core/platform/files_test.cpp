// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace linkwright::platform {
namespace {
namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

TEST(Files, PrivateFoldersAreNewAndForThisUserAlone) {
  std::error_code error;
  const auto nothing = [] { return std::string_view(); };
  const fs::path parent = fs::temp_directory_path();
  const fs::path one = make_private_folder(parent, error), two = make_private_folder(parent, error);
  ASSERT_FALSE(error);
  EXPECT_NE(one, two);
  EXPECT_EQ(one.parent_path(), parent);
  EXPECT_EQ(fs::status(one).permissions(), fs::perms::owner_all);

  std::vector<std::string_view> pieces = {{}, "b\n", {"a\0", 2}};
  const auto next = [&] {
    const std::string_view piece = pieces.back();
    pieces.pop_back();
    return piece;
  };
  EXPECT_FALSE(write_to_disk(one / "file", next, one / "none"));
  EXPECT_EQ(text_of(one / "file"), std::string("a\0b\n", 4));
  fs::permissions(one / "file", fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_FALSE(write_to_disk(one / "like", nothing, one / "file"));
  EXPECT_EQ(fs::status(one / "like").permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(write_to_disk(one / "none" / "file", nothing, {}), std::errc::no_such_file_or_directory);
  sync_folder(one);
  sync_folder(one / "none");  // nothing there, nothing to do

  EXPECT_TRUE(make_private_folder(one / "none", error).empty());
  EXPECT_EQ(error, std::errc::no_such_file_or_directory);
  for (const fs::path& folder : {one, two}) fs::remove_all(folder);
}

}  // namespace
}  // namespace linkwright::platform
