// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/study.h"

#include <gmock/gmock.h>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/memory.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/write.h"
#include "support/message.h"
#include "tests/study/sample_kind.h"

namespace linkwright::study {
namespace {
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Prepare {
  std::vector<Kind> kinds = sample::kinds();
  Diagnostics diagnostics;
  std::optional<Study> study;
  std::string messages;

  explicit Prepare(std::string_view text) {
    const Value document = read_text(text, Syntax::toml, "s.toml", diagnostics);
    study = prepare(document, "s.toml", ".", kinds, diagnostics);
    messages = test::lines_of(diagnostics);
    EXPECT_EQ(study.has_value(), !has_errors(diagnostics)) << messages;
  }
};

/// The example with one piece of its text replaced.
std::string changed(std::string_view from, std::string_view to) {
  std::string text = sample::example;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string messages(std::string_view from, std::string_view to) {
  return Prepare(changed(from, to)).messages;
}

TEST(Study, CanonicalHoldsEverythingInSiUnits) {
  const Prepare p(sample::example);
  ASSERT_TRUE(p.study) << p.messages;
  EXPECT_EQ(
      to_json(p.study->canonical),
      R"({"schema":1,"kind":"synthesis","title":"A lever","mechanism":{"type":"sample.lever","length_m":0.4,"mode":"done"},)"
      R"("target":{"type":"angle","to_rad":1.5707963267948966},"optimiser":{"seeds":{"first":1,"count":2}},)"
      R"("output":{"dir":"","formats":["json","csv","html"],"samples":361,"units":"si","digits":"full"},)"
      R"("check":[{"quantity":"best.height_mm","equals":400.0,"tolerance":1e-09}]})");
}

// The drawing of a report names what it shows.
TEST(Study, ScenesWithoutATitleGetThatOfTheStudy) {
  Prepare p(sample::example);
  ASSERT_TRUE(p.study) << p.messages;
  p.study->run = [](RunContext&) {
    Result result;
    result.scenes.resize(2);
    result.scenes[1].title = "2: double rocker";
    return result;
  };
  RunContext context;
  const Result result = run_study(*p.study, context);
  EXPECT_EQ(result.scenes[0].title, "A lever");
  EXPECT_EQ(result.scenes[1].title, "2: double rocker");
  p.study->common.title.clear();
  EXPECT_EQ(run_study(*p.study, context).scenes[0].title, name_of(*p.study->kind));
}

// A canonical study is itself a study, and stands for the same thing.
TEST(Study, CanonicalReadsBackToItself) {
  const Prepare first(sample::example);
  ASSERT_TRUE(first.study);
  Prepare again(to_toml(first.study->canonical));
  ASSERT_TRUE(again.study) << again.messages;
  EXPECT_EQ(to_json(again.study->canonical), to_json(first.study->canonical));
}

TEST(Study, RunsAndChecks) {
  const Prepare p(sample::example);
  RunContext context;
  const Result result = run_study(*p.study, context);
  ASSERT_EQ(result.checks.size(), 1u);
  EXPECT_TRUE(result.checks[0].passed);
  EXPECT_NEAR(result.checks[0].value, 400, 1e-12);
}

TEST(Study, ARunThatEndsWithNothingInHandHasItsStatus) {
  Study study;
  study.run = [](RunContext& run) -> Result {
    throw_if_interrupted(run);
    return {.status = Status::done};
  };
  RunContext context;
  EXPECT_EQ(run_study(study, context).status, Status::done);
  context.cancel();
  const Result result = run_study(study, context);
  EXPECT_EQ(result.status, Status::cancelled);
  EXPECT_EQ(result.headline, "Interrupted before there was anything to report.");
}

TEST(Study, RefusesMoreCandidatesThanThereIsMemoryFor) {
  const MemoryLimit limit(1e8);
  EXPECT_THAT(
      messages("[optimiser]", "[optimiser]\npopulation = 1000000"),
      AllOf(HasSubstr("optimiser.population: 1000000 candidates of 10 unknowns"),
            HasSubstr("of memory, at most 100 MB may be taken; take fewer candidates, or allow more")));
  EXPECT_THAT(messages("[optimiser]", "[optimiser]\npopulation = 1000"), Not(HasSubstr("memory")));
}

TEST(Study, VersionOfTheGrammar) {
  EXPECT_EQ(messages("schema = 1", "schema = 2"),
            "s.toml:2:10: error: schema: is 2, must be 1; this program reads studies of that version\n");
  EXPECT_EQ(messages("schema = 1", ""), "s.toml:1:1: error: schema: this key is missing; add schema = 1\n");
  EXPECT_EQ(messages("schema = 1", "schema = '1'"),
            "s.toml:2:10: error: schema: is the text '1', must be a whole number\n");
}

TEST(Study, ChoosingTheKind) {
  EXPECT_EQ(messages("\"synthesis\"", "'sinthesis'"),
            "s.toml:3:8: error: kind: is 'sinthesis', must be one of: synthesis, analysis; did you mean "
            "'synthesis'?\n");
  EXPECT_EQ(messages("\"sample.lever\"", "'sample.levr'"),
            "s.toml:7:8: error: mechanism.type: is 'sample.levr', must be one of: sample.lever; did you mean "
            "'sample.lever'?\n");
  EXPECT_EQ(messages("\"angle\"", "'pose'"),
            "s.toml:11:8: error: target.type: is 'pose', must be one of: angle, point\n");
  EXPECT_EQ(messages("type = \"angle\"\n", ""), "s.toml:10:1: error: target.type: this key is missing\n");
  EXPECT_EQ(messages("[target]\ntype = \"angle\"\nto_deg = 90\n", ""),
            "s.toml:1:1: error: target: this key is missing\n");
  EXPECT_THAT(messages("kind = \"synthesis\"", ""),
              HasSubstr("s.toml:1:1: error: kind: this key is missing"));
  EXPECT_THAT(messages("[mechanism]\ntype = \"sample.lever\"\n", "mechanism = 3\n[other]\n"),
              HasSubstr("mechanism: is 3, must be a table"));
}

// A misspelt kind does not hide the other problems of the file.
TEST(Study, GoesOnWithTheKindThatWasMeant) {
  std::string text = changed("\"synthesis\"", "'sinthesis'");
  text.replace(text.find("length_mm"), 9, "lenght_mm");
  const std::string all = Prepare(text).messages;
  EXPECT_THAT(all, HasSubstr("kind: is 'sinthesis'"));
  EXPECT_THAT(all, HasSubstr("mechanism.lenght_mm: unknown key; did you mean 'length_mm'?"));
}

TEST(Study, UnknownKeysOnEveryLevel) {
  EXPECT_EQ(messages("title = \"A lever\"", "titel = 'x'"),
            "s.toml:4:1: error: titel: unknown key; did you mean 'title'?\n");
  EXPECT_THAT(messages("title = \"A lever\"", "zzz = 'x'"),
              HasSubstr("zzz: unknown key; allowed here: schema, title, source, kind, mechanism, target, "
                        "output, check, optimiser"));
  EXPECT_EQ(messages("[optimiser]", "[optimizer]"),
            "s.toml:14:2: error: optimizer: unknown key; did you mean 'optimiser'?\n");
  EXPECT_THAT(messages("first = 1", "frst = 1"),
              HasSubstr("optimiser.seeds.frst: unknown key; did you mean 'first'?"));
  EXPECT_THAT(messages("[optimiser]", "[output]\nfolder = 'x'\n[optimiser]"),
              HasSubstr("output.folder: unknown key; allowed here: dir, formats, samples, units, digits, "
                        "parts, quantities"));
}

TEST(Study, KeysOfOtherTablesAreSentHome) {
  EXPECT_EQ(messages("to_deg = 90", "to_deg = 90\nmode = 'done'"),
            "s.toml:13:1: error: target.mode: unknown key; it belongs in [mechanism]\n");
  EXPECT_EQ(messages("to_deg = 90", "to_deg = 90\nsource = 'a book'"),
            "s.toml:13:1: error: target.source: unknown key; it belongs at the top of the file, before the "
            "first table\n");
  EXPECT_EQ(messages("to_deg = 90", "to_deg = 90\n[target.output]\nsamples = 3"),
            "s.toml:13:9: error: target.output: unknown key; it belongs in [output]\n");
  // Several tables that know a key leave open which is meant.
  EXPECT_THAT(messages("[mechanism]", "type = 'x'\n[mechanism]"),
              HasSubstr("type: unknown key; allowed here: "));
}

TEST(Study, OutputWords) {
  EXPECT_EQ(
      messages("[optimiser]", "[output]\nformats = ['jsn']\n[optimiser]"),
      "s.toml:15:12: error: output.formats[0]: is 'jsn', must be one of: json, csv, html, svg, dxf, step; "
      "did you mean "
      "'json'?\n");
  EXPECT_EQ(
      messages("[optimiser]", "[output]\nquantities = ['hight']\n[optimiser]"),
      "s.toml:15:14: error: output.quantities: 'hight' is none of: angle, height; did you mean 'height'?\n");
  EXPECT_THAT(messages("[optimiser]", "[output]\nsamples = 1\n[optimiser]"),
              HasSubstr("output.samples: is 1, must be at least 2"));
}

TEST(Study, OneSeedHasAShortForm) {
  const Prepare p(changed("seeds = { first = 1, count = 2 }", "seed = 7"));
  ASSERT_TRUE(p.study) << p.messages;
  EXPECT_EQ(p.study->common.seeds.first, 7);
  EXPECT_EQ(p.study->common.seeds.count, 1);
  EXPECT_THAT(messages("seeds = {", "seed = 7\nseeds = {"),
              HasSubstr("optimiser.seed: stands beside seeds; keep one of them"));
  EXPECT_THAT(messages("seeds = { first = 1, count = 2 }", "seed = -1"), HasSubstr("optimiser.seed: "));
}

TEST(Study, KindsWithoutTargetSeedsOrQuantities) {
  const std::string_view head =
      "schema = 1\nkind = 'analysis'\n[mechanism]\ntype = 'sample.wheel'\nlength_m = 1\n";
  EXPECT_EQ(Prepare(head).messages, "");
  EXPECT_THAT(Prepare(std::string(head) + "[optimiser]\nseeds = {}\n").messages,
              HasSubstr("optimiser: unknown key"));
  EXPECT_THAT(Prepare(std::string(head) + "[output]\nquantities = []\n").messages,
              HasSubstr("output.quantities: unknown key"));
}

TEST(Study, AKindThatCannotRunIsAFault) {
  std::vector<Kind> kinds = sample::kinds();
  kinds[0].prepare = [](ObjectReader& document, const Common&) {
    document.members();
    return Prepared{};
  };
  Diagnostics diagnostics;
  const Value document =
      read_text("schema = 1\nkind = 'synthesis'\nmechanism.type = 'sample.lever'\ntarget.type = 'angle'\n",
                Syntax::toml, "s", diagnostics);
  EXPECT_THROW(prepare(document, "s", ".", kinds, diagnostics), ContractError);
}

TEST(Study, Schema) {
  const std::vector<Kind> kinds = sample::kinds();
  const Value schema = schema_of(kinds[0]);
  const Value* properties = schema.find("properties");
  EXPECT_EQ(properties->find("schema")->find("const")->as_integer(), 1);
  EXPECT_EQ(properties->find("mechanism")->find("properties")->find("type")->find("const")->as_string(),
            "sample.lever");
  EXPECT_EQ(properties->find("mechanism")->find("properties")->find("length_m")->find("unit")->as_string(),
            "m");
  EXPECT_NE(properties->find("optimiser")->find("properties")->find("seeds"), nullptr);
  EXPECT_EQ(properties->find("output")
                ->find("properties")
                ->find("quantities")
                ->find("items")
                ->find("oneOf")
                ->as_array()
                .size(),
            2u);
  EXPECT_EQ(schema_of(kinds[1]).find("properties")->find("target")->find("properties")->find("type"),
            nullptr);
  EXPECT_EQ(schema_of(kinds).find("anyOf")->as_array().size(), 3u);
  EXPECT_EQ(name_of(kinds[0]), "synthesis/sample.lever/angle");
  EXPECT_EQ(name_of(kinds[1]), "analysis/sample.wheel");
}

}  // namespace
}  // namespace linkwright::study
