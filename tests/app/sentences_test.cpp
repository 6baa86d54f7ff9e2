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
#include "linkwright/core/sentence.h"
#include "linkwright/study/display_units.h"
#include "linkwright/study/read.h"
#include "linkwright/study/result_units.h"
#include "linkwright/study/study.h"
#include "support/message.h"

// What all examples say: headlines, facts and warnings are sentences whose numbers are numbers.
namespace linkwright::app {
namespace {

struct Told {
  std::string example;
  study::Result result;
};

// Of searches what they find in their first moment; the words are the same.
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
      out.push_back({example.name, study::run_study(*prepared, context)});
    }
    return out;
  }();
  return all;
}

std::vector<Sentence> sentences_of(const study::Result& result) {
  std::vector<Sentence> out{result.headline};
  for (const study::Fact& fact : result.facts) out.push_back(fact.text);
  for (const Diagnostic& d : result.diagnostics) out.push_back(d.message);
  return out;
}

// What has no value says an order of solution, a type or a way in words.
TEST(SentencesOfExamples, MostFactsHaveAValue) {
  std::size_t facts = 0, values = 0;
  for (const Told& t : told())
    for (const study::Fact& fact : t.result.facts) ++facts, values += fact.text.value().has_value();
  ASSERT_GE(told().size(), 20u);
  ASSERT_GE(facts, 100u);
  EXPECT_GE(static_cast<double>(values), 0.85 * static_cast<double>(facts)) << values << " of " << facts;
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

}  // namespace
}  // namespace linkwright::app
