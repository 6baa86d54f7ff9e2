// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/path_families.h"

#include <gmock/gmock.h>

#include <set>
#include <span>
#include <string>

#include "linkwright/planar/studies/four_bar_path.h"
#include "linkwright/planar/studies/slider_crank_path.h"
#include "linkwright/study/study.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

const Value* part(const Value& schema, const char* key) {
  return schema.is_object() ? schema.find(key) : nullptr;
}

// The keys of a schema with their tables and without unit, "target.gates", and their words,
// "target.point = \"rod\"". What stands beside a word belongs to it: "constraint[\"stroke\"].max".
void collect(const Value& schema, const std::string& path, std::set<std::string>& out) {
  for (const char* either : {"allOf", "anyOf", "oneOf"})
    if (const Value* forms = part(schema, either))
      for (const Value& form : forms->as_array()) {
        std::string own = path;
        if (const Value* properties = part(form, "properties"))
          for (const Value::Member& member : properties->as_object())
            if (const Value* word = part(member.value, "const"); word && word->is_string()) {
              out.insert(path + "." + member.key + " = \"" + word->as_string() + "\"");
              own += "[\"" + word->as_string() + "\"]";
            }
        if (const Value* word = part(form, "const"); word && word->is_string())
          out.insert(path + " = \"" + word->as_string() + "\"");
        collect(form, own, out);
      }
  if (const Value* items = part(schema, "items")) collect(*items, path, out);
  if (const Value* properties = part(schema, "properties"))
    for (const Value::Member& member : properties->as_object()) {
      if (part(member.value, "const")) continue;
      const auto parts = split_unit(member.key);
      const std::string key = (path.empty() ? "" : path + ".") +
                              (part(member.value, "unit") && parts ? std::string(parts->base) : member.key);
      out.insert(key);
      collect(member.value, key, out);
    }
}
std::set<std::string> keys_of(const study::Kind& kind) {
  std::set<std::string> out;
  collect(study::schema_of(kind), "", out);
  return out;
}
std::set<std::string> names_of(std::span<const study::Absent> absent) {
  std::set<std::string> out;
  for (const study::Absent& a : absent)
    out.insert(std::string(a.key) + (a.word.empty() ? "" : " = \"" + std::string(a.word) + "\""));
  return out;
}
// True for a key that belongs to an absent word, "constraint[\"stroke\"].max" to
// "constraint.type = \"stroke\"", or that is part of an absent table, "parameters.rod.max" of
// "parameters.rod".
bool goes_with(const std::string& key, const std::set<std::string>& absent) {
  for (const std::string& name : absent) {
    const std::size_t quote = name.find('"');
    if (quote != std::string::npos && key.find("[" + name.substr(quote) + "]") != std::string::npos)
      return true;
    if (key.starts_with(name + ".")) return true;
  }
  return false;
}

// Every key of one path synthesis is one of the other, or has a reason why not.
TEST(PathFamilies, DifferInNothingButWhatHasItsReason) {
  const std::set<std::string> four_bar = keys_of(four_bar_path_kind()), slider = keys_of(slider_path_kind());
  ASSERT_THAT(four_bar,
              IsSupersetOf({"target.gates", "target.timing.increments", "constraint.type = \"order\"",
                            "optimiser.method = \"recommended\"", "mechanism.parameters.ground"}));
  ASSERT_THAT(slider,
              IsSupersetOf({"target.tolerances", "optimiser.front", "objective.type = \"slider.stroke\""}));
  const auto check = [](const std::set<std::string>& own, const std::set<std::string>& other,
                        const std::set<std::string>& absent, const char* what) {
    for (const std::string& key : other)
      EXPECT_TRUE(own.contains(key) || absent.contains(key) || goes_with(key, absent))
          << key << " is missing from " << what << " without a reason";
    for (const std::string& key : absent) {
      EXPECT_FALSE(own.contains(key)) << key << " is in " << what << ", but has a reason why not";
      EXPECT_TRUE(other.contains(key)) << key << " is nowhere, but " << what << " have a reason why not";
    }
  };
  check(four_bar, slider, names_of(absent_from_four_bar_paths()), "four-bars");
  check(slider, four_bar, names_of(absent_from_slider_crank_paths()), "slider-cranks");
}

// The schema, from which the reference is made, holds every reason.
TEST(PathFamilies, TheSchemaTellsTheReasons) {
  for (const study::Kind& kind : {four_bar_path_kind(), slider_path_kind()}) {
    const Value schema = study::schema_of(kind);
    ASSERT_TRUE(schema.find("absent"));
    const auto& told = schema.find("absent")->as_array();
    ASSERT_EQ(told.size(), kind.absent.size());
    for (std::size_t i = 0; i < told.size(); ++i)
      EXPECT_EQ(told[i].find("reason")->as_string(), kind.absent[i].reason);
  }
}

TEST(PathFamilies, MessagesTellTheReasons) {
  const auto study = [](const char* type, const std::string& parameters, const std::string& more) {
    return test::problems_of(
        std::string("schema = 1\nkind = \"synthesis\"\n[mechanism]\ntype = \"planar.") + type + "\"\n" +
        parameters + "[target]\ntype = \"path_points\"\npoints_m = [[0, 0], [1, 0], [1, 1], [0, 1]]\n" +
        more);
  };
  EXPECT_THAT(
      study("slider_crank", "", "[[constraint]]\ntype = \"packaging\"\nx_m = { min = 0, max = 1 }\n"),
      HasSubstr("not for slider-cranks: they have one fixed pivot; give pivot_x and pivot_y as ranges"));
  EXPECT_THAT(
      study("slider_crank", "[mechanism.parameters]\nrocker_pivot_x_mm = 3\n", ""),
      HasSubstr("mechanism.parameters.rocker_pivot_x_mm: unknown key; not for slider-cranks: they have one "
                "fixed pivot"));
  EXPECT_THAT(study("four_bar", "", "[optimiser]\nfront = 5\n"),
              HasSubstr("optimiser.front: unknown key; not for four-bars: a front needs two objectives"));
  EXPECT_THAT(study("four_bar", "", "[[constraint]]\ntype = \"pressure_angle\"\nmax_deg = 50\n"),
              HasSubstr("not for four-bars: write transmission_angle"));
  EXPECT_THAT(study("four_bar", "branch = \"forward\"\n", ""), HasSubstr("their branch is the side of the"));
}

}  // namespace
}  // namespace linkwright::planar
