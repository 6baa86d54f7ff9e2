// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/write.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "linkwright/core/check.h"
#include "linkwright/study/study.h"

namespace linkwright::study {
namespace {

Value read_good(const std::string& text, Syntax syntax) {
  Diagnostics diagnostics;
  Value value = read_text(text, syntax, "text", diagnostics);
  for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d) << "\n" << text;
  return value;
}

TEST(WriteJson, CompactAndReadable) {
  Value v;
  v["b"] = 1;
  v["a"]["x"] = 0.1;
  v["a"]["list"] = Value(Value::Array{1.0, 1e-9, -0.0, std::nan(""), INFINITY});
  v["points"] = Value(Value::Array{Value(Value::Array{1, 2}), Value(Value::Array{3, 4})});
  v["none"] = nullptr;
  v["empty"] = Value::object();
  v["nothing"] = Value::array();
  EXPECT_EQ(
      to_json(v),
      R"({"b":1,"a":{"x":0.1,"list":[1.0,1e-09,-0.0,null,null]},"points":[[1,2],[3,4]],"none":null,"empty":{},"nothing":[]})");
  EXPECT_EQ(to_json_readable(v), R"({
  "b": 1,
  "a": {
    "x": 0.1,
    "list": [1.0, 1e-09, -0.0, null, null]
  },
  "points": [
    [1, 2],
    [3, 4]
  ],
  "none": null,
  "empty": {},
  "nothing": []
}
)");
}

TEST(WriteJson, StringsSurvive) {
  const std::string text =
      "quote \" backslash \\ line\nend tab\t bell\x07 delete\x7F \xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80";
  Value v;
  v[text] = text;
  EXPECT_EQ(read_good(to_json(v), Syntax::json), v);
  EXPECT_EQ(read_good(to_toml(v), Syntax::toml), v);
}

TEST(WriteJson, BytesThatAreNoTextAreReplaced) {
  EXPECT_EQ(to_json(Value("a\xFF"
                          "b")),
            "\"a\xEF\xBF\xBD"
            "b\"");
  EXPECT_EQ(to_json(Value("\xC3")), "\"\xEF\xBF\xBD\"");
  // An encoded surrogate is three bytes that stand for nothing.
  EXPECT_EQ(to_json(Value("\xED\xA0\x80")), "\"\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD\"");
}

TEST(WriteToml, SectionsInlineTablesAndArraysOfTables) {
  const std::string text = R"(schema = 1
title = "a \"quoted\" title"
points_m = [[0.5, 1.1], [0.4, 1.0]]

[mechanism]
type = "planar.four_bar"
at = { travel_mm = 50.0, rack_mm = 0.0 }

[mechanism.parameters]
a_m = { min = 0.0, max = 50.0 }
b_m = 1.0
c_m = 1.0
d_m = 1.0
e_m = 1.0

[[link]]
name = "a"
body = { near = [1.0, 2.0], box = 0.1 }

[[link]]
"odd key" = 1e-09
)";
  const Value v = read_good(text, Syntax::toml);
  EXPECT_EQ(to_toml(v), text);
  EXPECT_EQ(read_good(to_json(v), Syntax::json), v);
  EXPECT_EQ(read_good(to_toml(read_good(to_json_readable(v), Syntax::json)), Syntax::toml), v);
}

TEST(WriteToml, TablesOfTheDocumentAreSections) {
  const Value v = read_good("[sweep]\nrange = { min = 0, max = 1 }\n[empty]\n", Syntax::toml);
  EXPECT_EQ(to_toml(v), "empty = {}\n\n[sweep]\nrange = { min = 0, max = 1 }\n");
}

TEST(WriteToml, OnlyTables) { EXPECT_THROW(to_toml(Value(1)), ContractError); }

/// Members in alphabetical order: TOML writes plain values before tables, so the order of the members may
/// change.
void sort_members(Value& value) {
  if (value.is_array())
    for (Value& element : value.as_array()) sort_members(element);
  if (!value.is_object()) return;
  for (Value::Member& member : value.as_object()) sort_members(member.value);
  std::sort(value.as_object().begin(), value.as_object().end(),
            [](const Value::Member& a, const Value::Member& b) { return a.key < b.key; });
}

TEST(RoundTrip, ExamplesThroughBothSyntaxes) {
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(LINKWRIGHT_SOURCE_DIR) /
                                                               "examples/studies")) {
    if (entry.path().extension() != ".toml") continue;
    Diagnostics diagnostics;
    Value study = read_file(entry.path(), diagnostics);
    ASSERT_TRUE(diagnostics.empty()) << to_string(diagnostics[0]);
    EXPECT_EQ(read_good(to_json(study), Syntax::json), study) << entry.path();
    Value again = read_good(to_toml(study), Syntax::toml);
    sort_members(again);
    sort_members(study);
    EXPECT_EQ(again, study) << entry.path();
  }
}

}  // namespace
}  // namespace linkwright::study
