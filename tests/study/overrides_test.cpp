// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/overrides.h"

#include <gmock/gmock.h>

#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::study {
namespace {
using ::testing::HasSubstr;

/// The document after an override, or the message that came instead.
std::string with(std::string_view text) {
  Diagnostics diagnostics;
  Value document =
      read_text("a = 1\n[t]\ncrank_mm = 5\n[[list]]\nname = 'x'\n", Syntax::toml, "s", diagnostics);
  Override change;
  if (parse_override(text, change, diagnostics)) apply_override(document, change, diagnostics);
  return diagnostics.empty() ? to_json(document) : to_string(diagnostics[0]);
}

TEST(Overrides, SetReplaceAndMake) {
  EXPECT_EQ(with("a=2.5"), R"({"a":2.5,"t":{"crank_mm":5},"list":[{"name":"x"}]})");
  EXPECT_EQ(with("list[0].name=front"), R"({"a":1,"t":{"crank_mm":5},"list":[{"name":"front"}]})");
  EXPECT_EQ(with("u.v.w={ min = 1, max = 2 }"),
            R"({"a":1,"t":{"crank_mm":5},"list":[{"name":"x"}],"u":{"v":{"w":{"min":1,"max":2}}}})");
  EXPECT_EQ(with("t.crank_m = 0.2"), R"({"a":1,"t":{"crank_m":0.2},"list":[{"name":"x"}]})");
}

TEST(Overrides, EntriesOfAListKeepItsUnit) {
  Diagnostics diagnostics;
  Value document = read_text("[t]\npoints_mm = [[1.0, 2.0], [3.0, 4.0]]\nangles_deg = [10.0]\n", Syntax::toml,
                             "s", diagnostics);
  for (const char* text : {"t.points_m[1] = [0.5, 6]", "t.points_mm[0][1] = 7", "t.angles_deg[0] = 20"}) {
    Override change;
    ASSERT_TRUE(parse_override(text, change, diagnostics));
    EXPECT_TRUE(apply_override(document, change, diagnostics)) << text;
  }
  EXPECT_THAT(diagnostics, ::testing::IsEmpty());
  EXPECT_EQ(to_json(document), R"({"t":{"points_mm":[[1.0,7],[500.0,6000.0]],"angles_deg":[20]}})");
}

TEST(Overrides, WhatIsWrong) {
  EXPECT_EQ(with("a"), "--set a: error: has no value; write --set key=value");
  EXPECT_THAT(with("=3"), HasSubstr("--set =3: error: '' is not the path of a key"));
  EXPECT_THAT(with("a..b=3"), HasSubstr("'a..b' is not the path of a key"));
  EXPECT_THAT(with("list[x].name=3"), HasSubstr("'list[x].name' is not the path of a key"));
  EXPECT_EQ(with("list[1].name=x"), "--set list[1].name=x: error: 'list' has 1 entries, counted from 0");
  EXPECT_EQ(with("t[0]=x"), "--set t[0]=x: error: 't' is not an array");
  EXPECT_EQ(with("a.b=x"), "--set a.b=x: error: 'b' is not in a table");
  EXPECT_EQ(with("list.name=x"),
            "--set list.name=x: error: 'list' is a list of 1; say which one is meant: list[0].name, ...");
  EXPECT_THAT(with("a=[1"), HasSubstr("--set a=[1: error: '[1' is not a value"));
}

TEST(Overrides, DiagnosticsNameTheOverride) {
  Diagnostics diagnostics(3);
  diagnostics[0].file = diagnostics[1].file = diagnostics[2].file = "s.toml";
  diagnostics[0].key = "t.crank_m.min";
  diagnostics[1].key = "t.crank_mm";
  diagnostics[2].key = "t.crank_m";
  diagnostics[2].position = {3, 1};
  name_overrides(diagnostics, {{"--set t.crank_m=x", "t.crank_m", Value()}});
  EXPECT_EQ(diagnostics[0].file, "--set t.crank_m=x");
  EXPECT_EQ(diagnostics[1].file, "s.toml");
  EXPECT_EQ(diagnostics[2].file, "s.toml");
}

}  // namespace
}  // namespace linkwright::study
