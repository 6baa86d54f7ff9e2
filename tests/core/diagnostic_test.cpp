// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/diagnostic.h"

#include <gtest/gtest.h>

namespace linkwright {
namespace {

TEST(Diagnostic, TellsFileLineColumnKeyAndHint) {
  Diagnostic d;
  d.file = "study.toml";
  d.position = {12, 3};
  d.key = "mechanism.parameters.crnk_m";
  d.message = "unknown key";
  d.hint = "did you mean 'crank_m'?";
  EXPECT_EQ(to_string(d),
            "study.toml:12:3: error: mechanism.parameters.crnk_m: unknown key; did you mean 'crank_m'?");
  EXPECT_TRUE(has_errors({d}));
  d.severity = Diagnostic::Severity::warning;
  EXPECT_FALSE(has_errors({d}));
}

TEST(NearestWord, FindsSwapsAndMissingLetters) {
  EXPECT_EQ(nearest_word("crnak_m", {"crank_m", "rocker_m"}), "crank_m");
  EXPECT_EQ(nearest_word("grey_wulf", {"grey_wolf", "recommended"}), "grey_wolf");
  EXPECT_EQ(nearest_word("zebra", {"crank_m", "rocker_m"}), "");
  EXPECT_EQ(nearest_word("", {"a"}), "");
  EXPECT_EQ(did_you_mean("grey_wulf", {"grey_wolf", "recommended"}, "there are: two"),
            "did you mean 'grey_wolf'?");
  EXPECT_EQ(did_you_mean("zebra", {"crank_m", "rocker_m"}, "there are: two"), "there are: two");
  EXPECT_EQ(did_you_mean("zebra", {"crank_m", "rocker_m"}), "");
}

}  // namespace
}  // namespace linkwright
