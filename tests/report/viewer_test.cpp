// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/viewer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace linkwright::report {
namespace {

TEST(Viewer, StyleSheetIsEmbeddedByteForByte) {
  std::ifstream file(LINKWRIGHT_SOURCE_DIR "/web/src/report.css", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(report_css(), text);
}

TEST(Viewer, ScriptIsThereWhenItWasBuiltAndStaysSmall) {
  EXPECT_EQ(viewer_js().empty(), !LINKWRIGHT_HAS_VIEWER);
  EXPECT_EQ(viewer_css().empty(), !LINKWRIGHT_HAS_VIEWER);
  // Under 150 kB compressed, which is about a third of this.
  EXPECT_LT(viewer_js().size(), 400'000u);
  EXPECT_EQ(space_js().empty(), !LINKWRIGHT_HAS_VIEWER);
  EXPECT_LT(space_js().size(), 800'000u);
  EXPECT_EQ(boot_js().empty(), !LINKWRIGHT_HAS_VIEWER);
  EXPECT_LT(boot_js().size(), 4'000u);
}

}  // namespace
}  // namespace linkwright::report
