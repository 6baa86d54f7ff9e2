// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/compare.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <utility>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/examples.h"
#include "linkwright/app/run.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"
#include "tests/study/sample_kind.h"

namespace linkwright::app {
namespace {
namespace fs = std::filesystem;
using ::testing::ElementsAre;

/// A result with one of everything that is compared.
Compared mechanism(std::string name, double length, std::vector<double> inputs) {
  Compared one;
  one.name = std::move(name);
  study::Result& result = one.result;
  result.facts = {{"length", millimetres(length / 1e3), study::Fact::Verdict::plain},
                  {"type", "lever", study::Fact::Verdict::plain}};
  Table& table = result.tables.emplace_back();
  table.name = "sweep";
  table.add("angle_rad", "angle (rad)", inputs);
  std::vector<double> heights;
  for (const double angle : inputs) heights.push_back(length * std::sin(angle));
  table.add("height_m", "height (m)", heights);
  result.plots.push_back({.name = "height",
                          .title = "Height",
                          .table = "sweep",
                          .x = "angle_rad",
                          .y = {"height_m", "depth_m"},
                          .scene = "motion"});
  study::Scene& scene = result.scenes.emplace_back();
  scene.name = "motion";
  scene.input = inputs;
  const std::vector<double> zero(inputs.size(), 0);
  scene.points = {{.name = "O", .x = {0}, .y = {0}}, {.name = "A", .x = heights, .y = zero}};
  scene.bodies = {{"ground", {0, 0}, study::Scene::BodyStyle::ground}, {"lever", {0, 1}}};
  scene.traces = {{1, "A", false}};
  study::Solution solution;
  solution.label = "lever";
  solution.objectives["cost"] = length / 100;
  solution.scene = "motion";
  result.solutions.push_back(solution);
  result.checks.push_back({.quantity = "cost", .value = 1, .limit = "at_most 2", .passed = true});
  return one;
}

TEST(Compare, FiguresStandSideBySideWithTheirDifference) {
  const std::vector<Compared> all = {mechanism("short", 400, {0, 1}), mechanism("long", 500, {0, 1})};
  const study::Result result = compare(all);
  EXPECT_EQ(to_string(result.headline), "2 studies compared: 2 of 3 results differ.");
  std::vector<std::string> facts;
  for (const study::Fact& fact : result.facts) facts.push_back(to_string(fact.label + "=" + fact.text));
  EXPECT_THAT(facts,
              ElementsAre("1=short: done", "2=long: done", "length=400 mm | 500 mm (+25 %)", "type=lever"));
  const Table* figures = result.table("figures");
  ASSERT_NE(figures, nullptr);
  EXPECT_EQ(to_csv(*figures),
            "name,study_1,study_2,difference_2_to_1,status\r\n"
            "length (mm),400,500,100,done\r\n"
            "cost,4,5,1,done\r\n");
  EXPECT_EQ(figures->columns[1].label, "long");
  ASSERT_EQ(result.checks.size(), 2u);
  EXPECT_EQ(result.checks[1].at, "long");
  ASSERT_EQ(result.solutions.size(), 2u);
  EXPECT_EQ(result.solutions[1].label, "long: lever");
}

TEST(Compare, FactsInOtherUnitsAreConverted) {
  std::vector<Compared> all = {mechanism("short", 400, {0, 1}), mechanism("long", 500, {0, 1})};
  all[1].result.facts[0].text = metres(0.5);
  const study::Result result = compare(all);
  EXPECT_EQ(to_string(result.facts[2].text), "400 mm | 0.5 m (+25 %)");
  all[0].result.facts[0].text = degrees_of(math::radians(20));
  all[1].result.facts[0].text = degrees_of(math::radians(25));
  EXPECT_EQ(to_string(compare(all).facts[2].text), "20° | 25° (+25 %)");
  all[0].result.facts[0].text = say("{} at {}", millimetres(0.02), degrees_of(0.05, 1));
  all[1].result.facts[0].text = say("{} at {}", millimetres(0.025), degrees_of(0.05, 1));
  EXPECT_EQ(to_string(compare(all).facts[2].text), "20 mm at 3° | 25 mm at 3° (+25 %)");
  all[0].result.facts[0].text = millimetres(0.4);
  all[1].result.facts[0].text = measured("kg", 0.5);
  EXPECT_EQ(to_string(compare(all).facts[2].text), "400 mm | 0.5 kg");
}

TEST(Compare, RoundingIsNoDifference) {
  std::vector<Compared> all = {mechanism("short", 400, {0, 1}), mechanism("long", 500, {0, 1})};
  all[0].result.facts[0].text = metres(2.2e-16);
  all[1].result.facts[0].text = metres(5.6e-16);
  study::Result result = compare(all);
  EXPECT_EQ(to_string(result.facts[2].text), "2.2e-16 m | 5.6e-16 m");
  EXPECT_EQ(to_string(result.headline), "2 studies compared: 1 of 3 results differ.");
  all[1].result.facts[0].text = metres(1e-6);
  result = compare(all);
  EXPECT_EQ(to_string(result.headline), "2 studies compared: 2 of 3 results differ.");
}

TEST(Compare, CurvesOfEqualInputsAreColumnsOfOneTable) {
  const std::vector<Compared> all = {mechanism("short", 400, {0, 1}), mechanism("long", 500, {0, 1})};
  const study::Result result = compare(all);
  const Table* table = result.table("sweep");
  ASSERT_NE(table, nullptr);
  ASSERT_EQ(table->columns.size(), 3u);
  EXPECT_EQ(table->columns[0].key, "angle_rad");
  EXPECT_EQ(table->columns[1].key, "height_1_m");
  EXPECT_EQ(table->columns[1].label, "short: height (m)");
  EXPECT_EQ(table->columns[2].values, all[1].result.tables[0].columns[1].values);
  const Table* difference = result.table("sweep-differences");
  ASSERT_NE(difference, nullptr);
  ASSERT_EQ(difference->columns.size(), 2u);
  EXPECT_EQ(difference->columns[1].key, "height_2_minus_1_m");
  EXPECT_EQ(difference->columns[1].label, "long minus short: height (m)");
  EXPECT_DOUBLE_EQ(difference->columns[1].values[1], 100 * std::sin(1.0));
  ASSERT_EQ(result.plots.size(), 1u);
  // Columns that no table has are left out.
  EXPECT_THAT(result.plots[0].y, ElementsAre("height_1_m", "height_2_m"));
  EXPECT_EQ(result.plots[0].scene, "motion");
}

TEST(Compare, CurvesOfOtherInputsAreRowsOfEachStudy) {
  const std::vector<Compared> all = {mechanism("short", 400, {0, 1}), mechanism("long", 500, {0, 1, 2})};
  const study::Result result = compare(all);
  EXPECT_EQ(result.table("sweep"), nullptr);
  const Table* table = result.table("sweep-of-each");
  ASSERT_NE(table, nullptr);
  EXPECT_THAT(table->find("study")->values, ElementsAre(1, 1, 2, 2, 2));
  EXPECT_THAT(table->find("angle_rad")->values, ElementsAre(0, 1, 0, 1, 2));
  ASSERT_EQ(result.plots.size(), 1u);
  EXPECT_EQ(result.plots[0].group, "study");
  EXPECT_THAT(result.plots[0].group_names, ElementsAre("short", "long"));
  EXPECT_EQ(result.plots[0].scene, "");
  // Nor can one be drawn behind the other.
  ASSERT_EQ(result.scenes.size(), 2u);
  EXPECT_EQ(result.scenes[1].name, "motion-2");
  EXPECT_EQ(result.scenes[1].title, "long");
  EXPECT_EQ(result.scenes[0].bodies.size(), 2u);
}

TEST(Compare, TheOthersAreGhostsBehindTheFirst) {
  const std::vector<Compared> all = {mechanism("short", 400, {0, 1}), mechanism("long", 500, {0, 1})};
  const study::Result result = compare(all);
  ASSERT_EQ(result.scenes.size(), 1u);
  const study::Scene& scene = result.scenes[0];
  EXPECT_EQ(scene.title, "short");
  EXPECT_THAT(scene.runs, ElementsAre("short", "long"));
  ASSERT_EQ(scene.points.size(), 4u);
  ASSERT_EQ(scene.bodies.size(), 3u);  // the ground of the other is left out
  EXPECT_EQ(scene.bodies[2].name, "lever of long");
  EXPECT_EQ(scene.bodies[1].run, 0);
  EXPECT_EQ(scene.bodies[2].run, 1);
  EXPECT_THAT(scene.bodies[2].points, ElementsAre(2, 3));
  ASSERT_EQ(scene.traces.size(), 2u);
  EXPECT_EQ(scene.traces[1].name, "A of long");
  EXPECT_EQ(scene.traces[1].point, 3);
  EXPECT_EQ(scene.traces[1].run, 1);
}

TEST(Compare, AGhostHasTheNumberOfItsCurve) {
  const std::vector<Compared> all = {mechanism("short", 400, {0, 1}), mechanism("other", 450, {0, 1, 2}),
                                     mechanism("long", 500, {0, 1})};
  const study::Result result = compare(all);
  ASSERT_EQ(result.scenes.size(), 2u);
  EXPECT_THAT(result.scenes[0].runs, ElementsAre("short", "other", "long"));
  EXPECT_EQ(result.scenes[0].bodies[2].run, 2);
}

TEST(Compare, IsAsGoodAsTheWorst) {
  std::vector<Compared> all = {mechanism("short", 400, {0, 1}), mechanism("long", 500, {0, 1})};
  all[1].result.status = Status::no_assembly;
  const study::Result result = compare(all);
  EXPECT_EQ(result.status, Status::no_assembly);
  EXPECT_EQ(to_string(result.facts[1].text), "long: no_assembly");
  EXPECT_EQ(result.facts[1].verdict, study::Fact::Verdict::bad);
}

TEST(Compare, TheStudyInEveryResultIsReadBack) {
  const std::span<const study::Kind> kinds = catalogue();
  const fs::path folder = LINKWRIGHT_SOURCE_DIR "/examples";
  std::size_t count = 0;
  for (const EmbeddedFile& file : example_files()) {
    if (!file.path.ends_with(".toml")) continue;
    SCOPED_TRACE(file.path);
    Diagnostics diagnostics;
    const auto study = load_study(folder / file.path, {}, kinds, diagnostics);
    ASSERT_TRUE(study);
    // The study as in result.json: numbers with all digits, no comments and no places in a file.
    const std::string text = study::to_json(study->canonical);
    const Value document = study::read_text(text, study::Syntax::json, "result.json", diagnostics);
    diagnostics.clear();
    const auto again = study::prepare(document, "result.json", {}, kinds, diagnostics);
    ASSERT_TRUE(again.has_value()) << (diagnostics.empty() ? "" : to_string(diagnostics.front()));
    EXPECT_EQ(study::to_json(again->canonical), text);
    ++count;
  }
  EXPECT_GE(count, 80u);
}

/// Studies and results on the disk.
class LoadCompared : public ::testing::Test {
 protected:
  LoadCompared()
      : folder_(fs::temp_directory_path() / ("linkwright-compare-" + std::to_string(::getpid()))),
        kinds_(study::sample::kinds()) {
    fs::create_directories(folder_ / "out");
    std::ofstream(folder_ / "s.toml") << study::sample::example;
  }
  ~LoadCompared() override { fs::remove_all(folder_); }

  void write_result(Status status) {
    Diagnostics diagnostics;
    const auto study = load_study(folder_ / "s.toml", {}, kinds_, diagnostics);
    study::Result result;
    result.status = status;
    std::ofstream(folder_ / "out/result.json")
        << study::to_json_readable(result_json(*study, presented(*study, result), {}));
  }
  std::string refusal(const fs::path& path) {
    Diagnostics diagnostics;
    EXPECT_FALSE(load_compared(path, kinds_, diagnostics));
    EXPECT_EQ(diagnostics.size(), 1u);
    return diagnostics.empty() ? "" : to_string(diagnostics[0]);
  }

  const fs::path folder_;
  const std::vector<study::Kind> kinds_;
};

TEST_F(LoadCompared, AStudyAResultAndItsFolderAreTheSameStudy) {
  write_result(Status::done);
  Diagnostics diagnostics;
  const auto study = load_compared(folder_ / "s.toml", kinds_, diagnostics);
  const auto result = load_compared(folder_ / "out/result.json", kinds_, diagnostics);
  const auto folder = load_compared(folder_ / "out", kinds_, diagnostics);
  ASSERT_TRUE(study && result && folder) << to_string(diagnostics.at(0));
  EXPECT_EQ(study->folder, fs::path());
  EXPECT_EQ(folder->folder, folder_ / "out");
  for (const auto* one : {&result, &folder})
    EXPECT_EQ(study::to_json((*one)->study.canonical), study::to_json(study->study.canonical));
  const study::Study* studies[] = {&study->study, &folder->study};
  const fs::path paths[] = {"s.toml", "out"};
  EXPECT_THAT(names_of(paths, studies), ElementsAre("s.toml", "out"));
  const std::vector<Compared> all = {{"a", study->study, {}}, {"b", folder->study, {}}};
  const study::Study both = comparison_study(all);
  EXPECT_EQ(both.common.title, "a | b");
  EXPECT_EQ(both.canonical.find("compare")->as_array().size(), 2u);
}

TEST_F(LoadCompared, WhatCannotBeHadAgainIsRefused) {
  const std::string out = (folder_ / "out").string();
  EXPECT_EQ(refusal(folder_ / "out"),
            out + ": error: holds no result.json; name the folder of a run, or a study, which is then run");
  write_result(Status::deadline);
  EXPECT_EQ(
      refusal(folder_ / "out"),
      out +
          "/result.json: error: was stopped before its end and cannot be computed again; let it end with "
          "--resume, or compare its study");
  std::ofstream(folder_ / "out/result.json")
      << R"({"study_sha256": "", "status": "done", "study": {"schema": 1, "kind": "none"}})";
  EXPECT_EQ(
      refusal(folder_ / "out"),
      out +
          "/result.json: error: holds a study that cannot be run again (kind: is 'none', must be one of: "
          "synthesis, analysis); compare the study file that it comes from");
  EXPECT_EQ(refusal(folder_ / "none.toml"),
            (folder_ / "none.toml").string() + ": error: there is no such file");
}

}  // namespace
}  // namespace linkwright::app
