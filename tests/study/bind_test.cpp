// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/bind.h"

#include <gmock/gmock.h>

#include "linkwright/core/numbers.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/study.h"
#include "support/message.h"

namespace linkwright::study {
namespace bind_sample {

enum class Branch { open, crossed, any };
constexpr std::array<EnumName<Branch>, 3> names(Branch) {
  return {
      {{Branch::open, "open", "coupler does not cross"}, {Branch::crossed, "crossed"}, {Branch::any, "any"}}};
}

struct Wolves {
  int population = 30;
};
template <class V>
void fields(V&& visit, Wolves& o) {
  visit(field::entry("population", "wolves in the pack").at_least(4), o.population);
}
constexpr Word choice_word(const Wolves&) { return {"grey_wolf", "a pack"}; }

struct Descent {
  double step = 0.5;
};
template <class V>
void fields(V&& visit, Descent& o) {
  visit(field::entry("step", "first step").positive(), o.step);
}
constexpr Word choice_word(const Descent&) { return {"descent"}; }

struct Box {
  std::array<double, 3> near{};
  double edge = 0;
};
template <class V>
void fields(V&& visit, Box& o) {
  visit(field::length("near", "centre").required().with_inherited_unit(), o.near);
  visit(field::length("box", "edge"), o.edge);
}

struct Link {
  std::string name;
  Box body;
};
template <class V>
void fields(V&& visit, Link& o) {
  visit(field::entry("name", "of the link").required(), o.name);
  visit(field::length("body", "point on the body"), o.body);
}

struct Sample {
  Range crank{0.1, 2};
  double angle = 0;
  std::optional<double> limit;
  bool closed = true;
  Branch branch = Branch::any;
  std::vector<Branch> branches;
  std::vector<std::array<double, 2>> points;
  std::vector<double> weights;
  std::vector<std::string> tags;
  std::vector<Link> links;
  std::variant<Wolves, Descent> method;
};
template <class V>
void fields(V&& visit, Sample& o) {
  visit(field::length("crank", "crank length").between(0, 50).required(), o.crank);
  visit(field::angle("angle", "start"), o.angle);
  visit(field::mass("limit", "largest mass").not_negative(), o.limit);
  visit(field::entry("closed", "is the path closed"), o.closed);
  visit(field::entry("branch", "assembly"), o.branch);
  visit(field::entry("branches", "assemblies"), o.branches);
  visit(field::length("points", "targets"), o.points);
  visit(field::entry("weights", "of points").not_negative(), o.weights);
  visit(field::entry("tags", "words"), o.tags);
  visit(field::entry("link", "links"), o.links);
  visit(field::entry("method", "optimiser"), o.method);
}

}  // namespace bind_sample

namespace {
using bind_sample::Branch;
using bind_sample::Sample;
using ::testing::HasSubstr;

struct Reading {
  Sample sample;
  std::string messages;
};

Reading read_sample(std::string_view text, Syntax syntax = Syntax::toml) {
  Reading reading;
  Diagnostics diagnostics;
  const Value document = read_text(text, syntax, "s.toml", diagnostics);
  DocumentReader reader(document, "s.toml", diagnostics);
  reader.root().read(reading.sample);
  reader.finish();
  reading.messages = test::lines_of(diagnostics);
  return reading;
}

std::string messages(std::string_view text) { return read_sample(text).messages; }

constexpr std::string_view everything = R"(
crank_mm = { min = 100, max = 2000.0 }
angle_deg = 180
limit_g = 250
closed = false
branch = "open"
branches = ["open", "crossed"]
points_mm = [[500, 1100], [400, 1100.0]]
weights = [1, 0.5]
tags = ["a", "b"]
method = "descent"
step = 0.25
[[link]]
name = "front"
body_mm = { near = [1, 2, 3], box_m = 0.15 }
[[link]]
name = "rear"
)";

TEST(Bind, ReadsEveryKindOfMemberInSiUnits) {
  const auto [s, text] = read_sample(everything);
  EXPECT_EQ(text, "");
  EXPECT_EQ(s.crank, (Range{0.1, 2}));
  EXPECT_EQ(s.angle, pi);
  EXPECT_EQ(s.limit, 0.25);
  EXPECT_FALSE(s.closed);
  EXPECT_EQ(s.branch, Branch::open);
  EXPECT_EQ(s.branches, (std::vector{Branch::open, Branch::crossed}));
  EXPECT_EQ(s.points, (std::vector<std::array<double, 2>>{{0.5, 1.1}, {0.4, 1.1}}));
  EXPECT_EQ(s.weights, (std::vector{1.0, 0.5}));
  EXPECT_EQ(s.tags, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(std::get<bind_sample::Descent>(s.method).step, 0.25);
  ASSERT_EQ(s.links.size(), 2u);
  EXPECT_EQ(s.links[0].body.near, (std::array<double, 3>{0.001, 0.002, 0.003}));
  EXPECT_EQ(s.links[0].body.edge, 0.15);
  EXPECT_EQ(s.links[1].name, "rear");
}

TEST(Bind, AbsentKeysKeepTheDefaults) {
  const auto [s, text] = read_sample("crank_m = 0.4\n");
  EXPECT_EQ(text, "");
  EXPECT_TRUE(s.crank.fixed());
  EXPECT_FALSE(s.limit.has_value());
  EXPECT_EQ(std::get<bind_sample::Wolves>(s.method).population, 30);
}

TEST(Bind, WritingAndReadingAgain) {
  const Sample sample = read_sample(everything).sample;
  const Value written = write_fields(sample);
  EXPECT_EQ(written.find("crank_m")->find("max")->as_number(), 2.0);
  EXPECT_EQ(written.find("method")->as_string(), "descent");
  EXPECT_EQ(written.find("step")->as_number(), 0.25);
  EXPECT_EQ(written.find("link")->as_array()[0].find("body_m")->find("box_m")->as_number(), 0.15);
  Diagnostics diagnostics;
  DocumentReader reader(written, "again", diagnostics);
  Sample again;
  reader.root().read(again);
  reader.finish();
  for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
  EXPECT_EQ(write_fields(again), written);
}

TEST(Bind, UnknownKeysComeWithASuggestion) {
  EXPECT_EQ(messages("crank_m = 1\nclsed = true\n"),
            "s.toml:2:1: error: clsed: unknown key; did you mean 'closed'?\n");
  // The unit of the misspelt key is kept, and the crank is not reported as missing besides.
  EXPECT_EQ(messages("crnk_mm = 100\n"),
            "s.toml:1:1: error: crnk_mm: unknown key; did you mean 'crank_mm'?\n");
  EXPECT_THAT(messages("crank_m = 1\nxyzzy = 1\n"),
              HasSubstr("s.toml:2:1: error: xyzzy: unknown key; allowed here: crank_m, angle_rad, limit_kg"));
  EXPECT_THAT(messages("crank_m = 1\n[[link]]\nname = 'x'\nbdy_m = {}\n"),
              HasSubstr("s.toml:4:1: error: link[0].bdy_m: unknown key; did you mean 'body_m'?"));
  // Another unit would change the size, so none is proposed.
  EXPECT_EQ(messages("crank_ft = 100\n"),
            "s.toml:1:1: error: crank_ft: unknown key; 'ft' is not a unit of a length here; write crank_m, "
            "crank_mm, "
            "crank_cm, crank_um or crank_in\n");
  // In another language.
  EXPECT_EQ(messages("kurbel_mm = 100\n"),
            "s.toml:1:1: error: kurbel_mm: unknown key; did you mean 'crank_mm'?\n");
  EXPECT_THAT(messages("crank_m = {min = 1, max = 2, mid = 3}"), HasSubstr("crank_m.mid: unknown key"));
  // A key of another choice is unknown here.
  EXPECT_THAT(messages("crank_m = 1\nmethod = 'grey_wolf'\nstep = 1.0\n"),
              HasSubstr("s.toml:3:1: error: step: unknown key"));
}

TEST(Bind, UnitsOfKeys) {
  EXPECT_EQ(messages("crank = 1\n"),
            "s.toml:1:1: error: crank: the unit is missing; write crank_m, crank_mm, crank_cm, crank_um or "
            "crank_in\n");
  EXPECT_EQ(messages("crank_m = 1\ncrank_mm = 1000\n"),
            "s.toml:2:1: error: crank_mm: is given twice, as crank_m and crank_mm; keep one of them\n");
  EXPECT_EQ(messages("crank_m = 1\nangle_mm = 1000\n"),
            "s.toml:2:1: error: angle_mm: is an angle, but 'mm' is not a unit of it; write angle_rad or "
            "angle_deg\n");
  EXPECT_EQ(messages("closed = true\n"),
            "s.toml:1:1: error: crank_m: this key is missing; write crank_m, crank_mm, crank_cm, crank_um or "
            "crank_in\n");
}

TEST(Bind, NumbersAndTheirLimits) {
  EXPECT_EQ(messages("crank_mm = -3\n"), "s.toml:1:12: error: crank_mm: is -3 mm, must be at least 0 mm\n");
  EXPECT_EQ(messages("crank_mm = { min = 1, max = 60000 }\n"),
            "s.toml:1:29: error: crank_mm.max: is 60000 mm, must be at most 50000 mm\n");
  EXPECT_EQ(messages("crank_m = 1\npopulation = -3\n"),
            "s.toml:2:14: error: population: is -3, must be at least 4\n");
  EXPECT_EQ(messages("crank_m = 1\npopulation = 4.5\n"),
            "s.toml:2:14: error: population: is 4.5, must be a whole number\n");
  EXPECT_EQ(messages("crank_m = 1\npopulation = 3000000000\n"),
            "s.toml:2:14: error: population: is 3000000000, must be at most 2147483647\n");
  EXPECT_EQ(messages("crank_m = 1\nmethod = 'descent'\nstep = 0\n"),
            "s.toml:3:8: error: step: is 0, must be more than 0\n");
  EXPECT_EQ(messages("crank_m = inf\n"), "s.toml:1:11: error: crank_m: is inf, must be a finite number\n");
  EXPECT_EQ(messages("crank_m = { min = nan, max = 1 }\n"),
            "s.toml:1:19: error: crank_m.min: is nan, must be a finite number\n");
  EXPECT_EQ(messages("crank_mm = { min = 2, max = 1 }\n"),
            "s.toml:1:12: error: crank_mm: min is 2 mm, larger than max, which is 1 mm\n");
  EXPECT_EQ(messages("crank_m = { min = 2 }\n"), "s.toml:1:11: error: crank_m.max: this key is missing\n");
  EXPECT_EQ(read_sample("{\"crank_m\": 1, \"population\": 40.0}", Syntax::json).messages, "");
}

TEST(Bind, AnglesOfManyTurnsInRadiansAreDoubtful) {
  EXPECT_EQ(messages("crank_m = 1\nangle_rad = 360\n"),
            "s.toml:2:13: warning: angle_rad: is 360 rad, 57 turns; if degrees are meant, write angle_deg\n");
  EXPECT_EQ(messages("crank_m = 1\nangle_rad = 125\n"), "");
  EXPECT_EQ(messages("crank_m = 1\nangle_deg = 36000\n"), "");
}

TEST(Bind, WrongTypes) {
  EXPECT_EQ(
      messages("crank_m = 'long'\n"),
      "s.toml:1:11: error: crank_m: is the text 'long', must be a number or { min = ..., max = ... }\n");
  EXPECT_EQ(messages("crank_m = 1\nangle_deg = [1]\n"),
            "s.toml:2:13: error: angle_deg: is an array, must be a number\n");
  EXPECT_EQ(messages("crank_m = 1\nclosed = 1\n"),
            "s.toml:2:10: error: closed: is 1, must be true or false\n");
  EXPECT_EQ(messages("crank_m = 1\ntags = ['a', 2]\n"),
            "s.toml:2:14: error: tags[1]: is 2, must be a text in quotes\n");
  EXPECT_EQ(messages("crank_m = 1\nweights = 3\n"),
            "s.toml:2:11: error: weights: is 3, must be an array of numbers\n");
  EXPECT_EQ(messages("crank_m = 1\npoints_m = [[1, 2], [1, 2, 3], 4]\n"),
            "s.toml:2:21: error: points_m[1]: has 3 numbers, must have 2\n"
            "s.toml:2:32: error: points_m[2]: is 4, must be an array of 2 numbers\n");
  EXPECT_EQ(messages("crank_m = 1\nlink = 3\n"),
            "s.toml:2:8: error: link: is 3, must be an array of tables\n");
  EXPECT_EQ(
      messages("crank_m = 1\nbranch = 'opn'\n"),
      "s.toml:2:10: error: branch: is 'opn', must be one of: open, crossed, any; did you mean 'open'?\n");
  EXPECT_EQ(messages("crank_m = 1\nbranch = 1\n"),
            "s.toml:2:10: error: branch: is 1, must be one of: open, crossed, any\n");
  EXPECT_EQ(messages("crank_m = 1\nmethod = 'gray_wolf'\n"),
            "s.toml:2:10: error: method: is 'gray_wolf', must be one of: grey_wolf, descent; did you mean "
            "'grey_wolf'?\n");
}

TEST(Bind, AllProblemsInTheOrderOfTheFile) {
  EXPECT_EQ(messages("branch = 'x'\ncrank_m = -1\nclosd = true\nclosed = 3\n"),
            "s.toml:1:10: error: branch: is 'x', must be one of: open, crossed, any\n"
            "s.toml:2:11: error: crank_m: is -1 m, must be at least 0 m\n"
            "s.toml:3:1: error: closd: unknown key; did you mean 'closed'?\n"
            "s.toml:4:10: error: closed: is 3, must be true or false\n");
}

TEST(Bind, AFloodOfUnknownKeysIsCut) {
  std::string text = "crank_m = 1\n";
  for (int i = 0; i < 2000; ++i) text += "unknown" + std::to_string(i) + " = 1\n";
  const std::string all = messages(text);
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 51);
  EXPECT_THAT(all, HasSubstr("1950 more unknown keys"));
}

TEST(Bind, TablesErrorsOfMeaningAndFreeNames) {
  Diagnostics diagnostics;
  const Value document =
      read_text("[mass.crank]\nmass_kg = 1\n[timing]\nstep_deg = 20\n", Syntax::toml, "s.toml", diagnostics);
  DocumentReader reader(document, "s.toml", diagnostics);
  ObjectReader root = reader.root();
  EXPECT_FALSE(root.table("nothing").has_value());
  ObjectReader timing = *root.table("timing");
  double step = 0;
  EXPECT_TRUE(timing(field::angle("step"), step));
  timing.error("step", "does not divide the turn");
  ObjectReader mass = *root.table("mass");
  EXPECT_EQ(mass.members().front().key, "crank");
  EXPECT_EQ(mass.path(), "mass");
  reader.finish();
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_EQ(to_string(diagnostics[0]), "s.toml:4:12: error: timing.step_deg: does not divide the turn");
}

/// A reader like that of a domain: it reads links, then looks for one by name, in a table of its own.
std::string read_and_refer(std::string_view text, bool with_schema = true) {
  Diagnostics diagnostics;
  const Value document = read_text(text, Syntax::toml, "s.toml", diagnostics);
  DocumentReader reader(document, "s.toml", diagnostics);
  ObjectReader root = reader.root();
  std::vector<bind_sample::Link> links;
  std::optional<ObjectReader> mechanism = root.table("mechanism");
  (*mechanism)(field::entry("link"), links);
  for (std::size_t i = 1; i < links.size(); ++i)
    if (links[i].name == links[0].name)
      mechanism->unreadable("link", "'" + links[i].name + "' is used twice");
  for (ObjectReader trace : root.tables("trace")) {
    if (reader.has_errors()) break;  // the mechanism is not known: `of` is not asked for
    std::string of;
    trace(field::entry("of"), of);
  }
  if (std::optional<ObjectReader> limit = root.table("limit")) {
    std::string of;
    (*limit)(field::entry("of"), of);
    if (std::none_of(links.begin(), links.end(), [&](const auto& l) { return l.name == of; }))
      limit->error("of", "there is no link '" + of + "'");
  }
  reader.finish([&] {
    if (!with_schema) return Value();
    SchemaWriter all, mechanisms, traces, limits;
    mechanisms(field::entry("link"), links);
    traces(field::entry("of"), std::string());
    limits(field::entry("of"), std::string());
    all.property(field::entry("mechanism"), std::move(mechanisms).finish());
    all.property(field::entry("trace"), schema_array(std::move(traces).finish()));
    all.property(field::entry("limit"), std::move(limits).finish());
    return std::move(all).finish();
  });
  return test::lines_of(diagnostics);
}

TEST(Bind, OneMistakeGivesOneMessage) {
  const std::string rest = "[[trace]]\nof = 'rod'\n[limit]\nof = 'rod'\n";
  EXPECT_EQ(read_and_refer("[[mechanism.link]]\nname = 'rod'\n" + rest), "");
  EXPECT_EQ(read_and_refer("[[mechanism.link]]\nname = 'bar'\n" + rest),
            "s.toml:6:6: error: limit.of: there is no link 'rod'\n");
  // The list of links is not known: neither a missing link nor the unread key of the trace is a mistake.
  EXPECT_EQ(read_and_refer("[[mechanism.link]]\nname = 5\n" + rest),
            "s.toml:2:8: error: mechanism.link[0].name: is 5, must be a text in quotes\n");
  EXPECT_EQ(read_and_refer("[[mechanism.link]]\nnme = 'rod'\n" + rest),
            "s.toml:2:1: error: mechanism.link[0].nme: unknown key; did you mean 'name'?\n");
  EXPECT_EQ(read_and_refer("[[mechanism.link]]\nname = 'a'\n[[mechanism.link]]\nname = 'a'\n" + rest),
            "s.toml:1:1: error: mechanism.link: 'a' is used twice\n");
  // A key that the schema does not know is unknown all the same.
  EXPECT_EQ(read_and_refer("[[mechanism.link]]\nname = 5\n[[trace]]\nby = 'x'\n"),
            "s.toml:2:8: error: mechanism.link[0].name: is 5, must be a text in quotes\n"
            "s.toml:4:1: error: trace[0].by: unknown key\n");
}

TEST(Bind, PathsHaveNoEmptyKeys) {
  Diagnostics diagnostics;
  const Value document = read_text("[a]\n", Syntax::toml, "s.toml", diagnostics);
  DocumentReader reader(document, "s.toml", diagnostics);
  ObjectReader root = reader.root();
  root.table("a")->error("", "is of no use");
  root.error("", "nothing is requested");
  reader.finish();
  EXPECT_EQ(test::lines_of(diagnostics),
            "s.toml:1:1: error: a: is of no use\ns.toml:1:1: error: nothing is requested\n");

  diagnostics.clear();
  const Value unknown = read_text("\"\" = 1\n[a]\n\"\" = 2\n", Syntax::toml, "s.toml", diagnostics);
  DocumentReader other(unknown, "s.toml", diagnostics);
  other.root().table("a");
  other.finish();
  EXPECT_EQ(test::lines_of(diagnostics),
            "s.toml:1:1: error: '': unknown key; allowed here: a\ns.toml:3:1: error: a.'': unknown key\n");
}

/// A table with a choice, and a sample that stands for a wheel and links.
std::string read_choice(std::string_view text) {
  Diagnostics diagnostics;
  const Value document = read_text(text, Syntax::toml, "s.toml", diagnostics);
  DocumentReader reader(document, "s.toml", diagnostics);
  ObjectReader root = reader.root();
  if (std::optional<ObjectReader> table = root.table("table")) {
    std::variant<bind_sample::Wolves, bind_sample::Descent> method;
    (*table)(field::entry("method"), method);
    std::string sample;
    if (!(*table)(field::entry("sample"), sample)) {
      if (auto wheel = table->table(field::entry("wheel").required())) {
        double radius = 0;
        (*wheel)(field::entry("radius").required(), radius);
      }
      int links = 0;
      if (!(*table)(field::entry("links"), links)) table->unreadable("links", "there are no links");
    }
  } else {
    root.error("motion", "needs the table");
  }
  if (std::optional<ObjectReader> output = root.table("output")) output->error("", "is empty");
  reader.finish();
  return test::lines_of(diagnostics);
}

TEST(Bind, AMisspeltKeyExplainsWhatIsMissingForIt) {
  // Other tables refer to it; the output does not.
  EXPECT_EQ(read_choice("[tabel]\nsample = 'a'\n[output]\n"),
            "s.toml:1:2: error: tabel: unknown key; did you mean 'table'?\n"
            "s.toml:3:1: error: output: is empty\n");
  EXPECT_EQ(read_choice("[table]\n"),
            "s.toml:1:1: error: table.links: there are no links\n"
            "s.toml:1:1: error: table.wheel: this key is missing\n");
  // The choice is asked for only without the key.
  EXPECT_EQ(read_choice("[table]\nsampel = 'a'\n"),
            "s.toml:2:1: error: table.sampel: unknown key; did you mean 'sample'?\n");
  // One that is there as well explains nothing.
  EXPECT_EQ(read_choice("[table]\nlinks = 1\nlink = 2\n"),
            "s.toml:1:1: error: table.wheel: this key is missing\n"
            "s.toml:3:1: error: table.link: unknown key; did you mean 'links'?\n");
  // The keys of a choice.
  EXPECT_EQ(read_choice("[table]\nsample = 'a'\nstep = 1\nmethd = 'descent'\n"),
            "s.toml:4:1: error: table.methd: unknown key; did you mean 'method'?\n");
  EXPECT_EQ(read_choice("[table]\nsample = 'a'\nstep = 1\n"),
            "s.toml:3:1: error: table.step: unknown key; allowed here: method, population, sample\n");
  // The other part of a table stands under its own name.
  EXPECT_EQ(read_choice("[table]\nlinks = 1\n[table.whel]\nradius = 1\n[table.wheel.hub]\n"),
            "s.toml:3:8: error: table.whel: unknown key; did you mean 'wheel'?\n"
            "s.toml:5:14: error: table.wheel.hub: unknown key; allowed here: radius\n");
}

TEST(Bind, SchemaFollowsTheFieldList) {
  const Value schema = schema_fields<Sample>();
  const Value* crank = schema.find("properties")->find("crank_m");
  EXPECT_EQ(crank->find("description")->as_string(), "crank length");
  EXPECT_EQ(crank->find("unit")->as_string(), "m");
  EXPECT_EQ(crank->find("anyOf")->as_array()[0].find("maximum")->as_number(), 50.0);
  EXPECT_NE(schema.find("patternProperties")->find("^crank_(mm|cm|um|in)$"), nullptr);
  EXPECT_EQ(
      schema.find("properties")->find("branch")->find("oneOf")->as_array()[1].find("const")->as_string(),
      "crossed");
  EXPECT_EQ(schema.find("properties")->find("branch")->find("default")->as_string(), "any");
  EXPECT_EQ(schema.find("properties")->find("points_m")->find("items")->find("minItems")->as_integer(), 2);
  EXPECT_EQ(schema.find("oneOf")
                ->as_array()[0]
                .find("properties")
                ->find("population")
                ->find("minimum")
                ->as_number(),
            4);
  EXPECT_FALSE(schema.find("unevaluatedProperties")->as_bool());
}

// Exactly one alternative takes a table without the key of a choice, if that may be absent, exactly one
// alternative takes a table without it.
TEST(Bind, SchemaOfAChoiceAsksForItsKeyButOnce) {
  const auto required = [](const Value& alternative) {
    const Value* keys = alternative.find("required");
    return keys ? keys->as_array().size() : 0;
  };
  const Value with_default = schema_fields<Sample>();
  const auto& options = with_default.find("oneOf")->as_array();
  ASSERT_EQ(options.size(), 2u);
  EXPECT_EQ(required(options[0]), 0u) << "grey_wolf is the default";
  EXPECT_EQ(required(options[1]), 1u);
  SchemaWriter writer;
  writer(field::entry("method"), std::optional<std::variant<bind_sample::Wolves, bind_sample::Descent>>());
  const Value optional = std::move(writer).finish();
  const auto& three = optional.find("oneOf")->as_array();
  ASSERT_EQ(three.size(), 3u);
  EXPECT_EQ(required(three[0]), 1u);
  EXPECT_NE(three[2].find("not"), nullptr);
}

TEST(Bind, AsksForAKeyByItsNameAloneWithTheUnitThatItWasReadWith) {
  Diagnostics diagnostics;
  const Value document = read_text("crank_mm = 5\n", Syntax::toml, "s.toml", diagnostics);
  DocumentReader reader(document, "s.toml", diagnostics);
  ObjectReader root = reader.root();
  Sample sample;
  root.read(sample);
  EXPECT_TRUE(root.has("crank"));
  EXPECT_FALSE(root.has("angle"));
  EXPECT_FALSE(root.has("cran"));
}

}  // namespace
}  // namespace linkwright::study
