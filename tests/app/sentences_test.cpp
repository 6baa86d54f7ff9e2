// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/examples.h"
#include "linkwright/app/result_json.h"
#include "linkwright/app/view.h"
#include "linkwright/core/sentence.h"
#include "linkwright/report/view_data.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/result_units.h"
#include "linkwright/study/study.h"
#include "support/message.h"

// The texts of all examples: headlines, facts and warnings are sentences whose numbers are numbers.
namespace linkwright::app {
namespace {

struct Told {
  study::Study study;
  study::Result result;
  std::string example;
};

// Searches show what they find in their first moment; the words are the same.
const std::vector<Told>& told() {
  static const std::vector<Told> all = [] {
    std::vector<Told> out;
    for (const Example& example : examples()) {
      const std::filesystem::path folder =
          std::filesystem::path(LINKWRIGHT_SOURCE_DIR) / "examples" /
          (std::filesystem::exists(std::filesystem::path(LINKWRIGHT_SOURCE_DIR) / "examples/studies" /
                                   (example.name + ".toml"))
               ? "studies"
               : "robots");
      Diagnostics diagnostics;
      const Value document =
          study::read_text(example.text, study::Syntax::toml, example.name + ".toml", diagnostics);
      if (document.find("kind")->as_string() != "analysis") continue;
      const auto prepared =
          study::prepare(document, example.name + ".toml", folder, catalogue(), diagnostics);
      if (!prepared) continue;  // it reads files that lie elsewhere
      RunContext context;
      out.push_back({*prepared, study::run_study(*prepared, context), example.name});
    }
    return out;
  }();
  return all;
}

std::vector<Sentence> sentences_of(const study::Result& result) {
  std::vector<Sentence> out{result.headline};
  for (const study::Fact& fact : result.facts) out.push_back(fact.label), out.push_back(fact.text);
  for (const study::Solution& solution : result.solutions) {
    out.push_back(solution.label);
    out.insert(out.end(), solution.defects.begin(), solution.defects.end());
  }
  for (const study::Trouble& trouble : result.troubles) out.push_back(trouble.why);
  for (const Diagnostic& d : result.diagnostics) out.push_back(d.message);
  return out;
}

// A fact without a value says an order of solution, a type or a way in words.
TEST(SentencesOfExamples, MostFactsHaveAValue) {
  std::size_t facts = 0, values = 0;
  for (const Told& t : told())
    for (const study::Fact& fact : t.result.facts) ++facts, values += fact.value().has_value();
  ASSERT_GE(told().size(), 20u);
  ASSERT_GE(facts, 100u);
  EXPECT_GE(static_cast<double>(values), 0.9 * static_cast<double>(facts)) << values << " of " << facts;
}

// A number with its unit in the text itself would keep that unit whatever the output is in.
TEST(SentencesOfExamples, NumbersWithUnitsAreNoText) {
  static const std::regex number_with_unit(
      R"((^|[^\w.])-?\d+(\.\d+)?(e[+-]?\d+)? ?(mm|cm|m|deg|rad|s|ms|N|kN|N m|kg|rpm|rad/s|m/s|MPa|Pa|J|W|Hz|°|%)([ ,;:.)]|$))");
  for (const Told& t : told())
    for (const Sentence& sentence : sentences_of(t.result))
      for (const Sentence::Part& part : sentence.parts())
        if (const auto* text = std::get_if<std::string>(&part)) {
          EXPECT_FALSE(std::regex_search(*text, number_with_unit))
              << t.example << ": " << to_string(sentence);
        }
}

// In every system of units the numbers of one dimension in one sentence have one unit.
TEST(SentencesOfExamples, HaveOneUnitForEachDimension) {
  const std::vector<std::vector<std::string>> systems = {
      {"m"},         {"mm"},        {"in"},        {"cm"},         {"mm", "rad"},
      {"in", "deg"}, {"mm", "rpm"}, {"in", "lbf"}, {"mm", "N_mm"}, {"m", "kgf", "deg_per_s"}};
  for (const std::vector<std::string>& system : systems) {
    const study::DisplayUnits units = study::chosen_units(
        {.choice = study::OutputUnits::Choice::list, .list = system}, study::DisplayUnits());
    for (const Told& t : told())
      for (const Sentence& sentence : sentences_of(study::in_units(t.result, units))) {
        std::map<Dimension, std::set<std::string>> written;
        for (const Sentence::Part& part : sentence.parts())
          if (const auto* number = std::get_if<Measured>(&part);
              number && number->dimension != Dimension::none)
            written[number->dimension].insert(number->unit_words());
        for (const auto& [dimension, suffixes] : written)
          if (units.chosen(dimension)) {
            EXPECT_EQ(suffixes.size(), 1u) << t.example << " in " << system[0] << ": " << to_string(sentence);
          }
      }
  }
}

// Every text of a value, but not the study itself and its drawings.
void texts_of(const Value& value, std::vector<std::string>& out) {
  if (value.is_string()) out.push_back(value.as_string());
  if (value.is_array())
    for (const Value& element : value.as_array()) texts_of(element, out);
  if (value.is_object())
    for (const Value::Member& member : value.as_object()) texts_of(member.value, out);
}

// Lengths and forces in inches and pounds: what is written to files and to the page has no others.
TEST(SentencesOfExamples, AreInTheUnitsOfTheOutputEverywhere) {
  static const std::regex others(
      "(^|[^\\w.])[-−]?\\d+(\\.\\d+)?( |\u202f)(mm|cm|m|µm|um|N(?! m| s)|kN(?! m| s))([ ,;:.)<]|$)");
  std::size_t found = 0;
  for (const Told& t : told()) {
    study::Study study = t.study;
    study.common.output.units = {study::OutputUnits::Choice::list, {"in", "lbf"}};
    const study::Result shown = presented(study, t.result);
    std::vector<std::string> texts;
    const Value json = result_json(study, shown, {});
    for (const char* part : {"answer", "solutions", "diagnostics"}) texts_of(*json.find(part), texts);
    const Value page = report::view_data(report_input(study, shown, {}, {}));
    for (const char* part : {"headline", "facts", "remarks", "solutions"}) texts_of(*page.find(part), texts);
    for (const Value& scene : page.find("scenes")->as_array())
      if (scene.find("title")->as_string() != study::title_of(study))  // the author chose that one
        texts.push_back(scene.find("title")->as_string());
    for (const std::string& text : texts) {
      EXPECT_FALSE(std::regex_search(text, others)) << t.example << ": " << text;
      found += text.find(" in") != std::string::npos;
    }
  }
  EXPECT_GE(found, 100u);
}

// The tables that a study announces before it runs have the columns of the result.
TEST(SentencesOfExamples, ColumnsAreKnownBeforeTheRun) {
  std::size_t known = 0;
  for (const Told& t : told())
    for (const Table& said : t.study.tables) {
      const Table* made = t.result.table(said.name);
      ASSERT_NE(made, nullptr) << t.example << ": " << said.name;
      ASSERT_GE(made->columns.size(), said.columns.size()) << t.example << ": " << said.name;
      for (std::size_t c = 0; c < said.columns.size(); ++c) {
        EXPECT_EQ(said.columns[c].key, made->columns[c].key) << t.example;
        EXPECT_EQ(said.columns[c].label, made->columns[c].label) << t.example;
      }
      known += said.columns.size();
    }
  EXPECT_GE(known, 1000u);
}

}  // namespace
}  // namespace linkwright::app
