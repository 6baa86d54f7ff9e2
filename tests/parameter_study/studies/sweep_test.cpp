// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parameter_study/studies/sweep.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/numbers.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/study.h"
#include "support/resumed.h"

namespace linkwright::parameter_study {
namespace {
namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A study of a four-bar behind `head`.
std::string sweep(const std::string& head) {
  return "schema = 1\nkind = \"sweep\"\n" + head + R"(
[study]
kind = "analysis"
[study.mechanism]
type = "planar.four_bar"
branch = "open"
[study.mechanism.parameters]
ground_mm = 100.0
crank_mm = 30.0
coupler_mm = 85.0
rocker_mm = 90.0
[study.drive]
input = "crank"
speed_rpm = 60.0
[study.sweep.crank_angle]
from_deg = 0.0
to_deg = 360.0
samples = 73
[study.output]
quantities = ["position", "transmission_angle"]
)";
}
constexpr const char* measure = "[[measure]]\nquantity = \"sweep.rocker_angle_deg.max\"\n";
std::string parameter(const std::string& key, const std::string& rest) {
  return "[[parameter]]\nkey = \"" + key + "\"\n" + rest + "\n";
}
const std::string crank = parameter("mechanism.parameters.crank_mm", "min = 20\nmax = 40\nsteps = 3");

study::Result result_of(const std::string& text) { return test::run_text(app::catalogue(), text); }
std::string messages_of(const std::string& text) { return test::problems_of(app::catalogue(), text); }

/// The study of `sweep` alone, with a key set.
double alone(const std::string& set, const char* quantity) {
  const std::string text = sweep("");
  Diagnostics diagnostics;
  const Value all = study::read_text(text, study::Syntax::toml, "s.toml", diagnostics);
  Value document = *all.find("study");
  document["schema"] = 1;
  std::string rest = set;
  for (std::size_t end = rest.find(';'); !rest.empty(); end = rest.find(';')) {
    study::Override change;
    EXPECT_TRUE(study::parse_override(rest.substr(0, end), change, diagnostics));
    EXPECT_TRUE(study::apply_override(document, change, diagnostics));
    rest = end == std::string::npos ? "" : rest.substr(end + 1);
  }
  const auto study = study::prepare(document, "s.toml", {}, app::catalogue(), diagnostics);
  EXPECT_TRUE(study) << test::lines_of(diagnostics);
  RunContext context;
  return study::evaluate({.quantity = quantity}, study::run_study(*study, context)).value;
}

TEST(Sweep, AGridHasTheResultsOfItsStudies) {
  const study::Result result =
      result_of(sweep(crank + parameter("mechanism.branch", "values = [\"open\", \"crossed\"]") + measure));
  EXPECT_EQ(result.status, Status::done);
  const Table& trials = *result.table("trials");
  ASSERT_EQ(trials.rows(), 6u);
  ASSERT_EQ(trials.columns.size(), 3u);
  EXPECT_EQ(trials.columns[0].key, "crank_m");
  EXPECT_THAT(trials.columns[0].values, ElementsAre(0.02, 0.02, 0.03, 0.03, 0.04, 0.04));
  EXPECT_EQ(trials.columns[1].label, "branch (1 = open, 2 = crossed)");
  EXPECT_THAT(trials.columns[1].values, ElementsAre(1, 2, 1, 2, 1, 2));
  EXPECT_EQ(trials.columns[2].key, "rocker_angle_max_rad");
  EXPECT_EQ(trials.columns[2].label, "greatest rocker angle (rad)");
  int row = 0;
  for (const char* length : {"20", "30", "40"})
    for (const char* branch : {"open", "crossed"})
      EXPECT_DOUBLE_EQ(
          trials.columns[2].values[static_cast<std::size_t>(row++)],
          3.14159265358979323846 / 180 *
              alone(std::string("mechanism.parameters.crank_mm=") + length + ";mechanism.branch=" + branch,
                    "sweep.rocker_angle_deg.max"))
          << row;
  EXPECT_THAT(result.scenes, ::testing::SizeIs(1));
  EXPECT_EQ(result.plots.front().group_names, (std::vector<std::string>{"open", "crossed"}));
  const Table& summary = *result.table("summary");
  EXPECT_EQ(summary.names[1], "least");
  EXPECT_EQ(summary.columns[0].values[0], trials.columns[2].values[2]) << "as given";
}

TEST(Sweep, TheSameBitsForAnyThreadsAndFromACheckpoint) {
  const std::string text =
      sweep(parameter("mechanism.parameters.crank_mm", "min = 10\nmax = 120") +
            parameter("mechanism.parameters.rocker_mm", "min = 60\nmax = 100") + measure +
            "[sampling]\nmethod = \"latin_hypercube\"\nsamples = 50\nseed = 4\n");
  std::string messages;
  const auto study = test::prepare(app::catalogue(), text, messages);
  ASSERT_TRUE(study) << messages;
  test::MemoryCheckpoint kept;
  const auto run = [&](int threads = 0) {
    RunContext context;
    context.set_checkpoint(&kept);
    context.set_threads(threads);
    return test::all_of(study::run_study(*study, context));
  };
  const std::string one = run(1);
  EXPECT_THAT(one, HasSubstr("no_assembly"));
  EXPECT_EQ(run(), one);
  std::erase_if(kept.entries, [](const auto&) { return true; });
  EXPECT_EQ(run(4), one);
  ASSERT_EQ(kept.entries.size(), 50u);
  std::erase_if(kept.entries, [](const auto& entry) { return entry.first.size() % 2 == 0; });
  EXPECT_EQ(run(), one);
  kept.entries["trials 1"] = Value(3);
  EXPECT_THROW(run(), CheckpointError);
}

TEST(Sweep, EverySamplingMakesItsTrials) {
  const std::string two = parameter("mechanism.parameters.crank_mm", "min = 20\nmax = 40") +
                          parameter("mechanism.parameters.coupler_mm", "min = 80\nmax = 90") + measure;
  const auto rows = [&](const std::string& sampling) {
    return result_of(sweep(two + "[sampling]\n" + sampling + "\n")).table("trials")->rows();
  };
  EXPECT_EQ(rows("method = \"grid\""), 121u);
  EXPECT_EQ(rows("method = \"sobol\"\nsamples = 16"), 16u);
  EXPECT_EQ(rows("method = \"morris\"\ntrajectories = 5"), 15u);
  EXPECT_EQ(rows("method = \"sobol_indices\"\nsamples = 8"), 32u);
  const study::Result morris = result_of(sweep(two + "[sampling]\nmethod = \"morris\"\n"));
  const Table& sensitivity = *morris.table("sensitivity");
  EXPECT_THAT(sensitivity.names, ElementsAre("crank", "coupler"));
  // The crank moves the rocker more than the coupler does.
  const Column& strength = *sensitivity.find("rocker_angle_max_mu_star_rad");
  EXPECT_GT(strength.values[0], strength.values[1]);
}

TEST(Sweep, LogarithmicStepsAndLists) {
  const Table trials =
      *result_of(sweep(parameter("mechanism.parameters.coupler_mm",
                                 "min = 80\nmax = 125\nsteps = 3\nspacing = \"logarithmic\"") +
                       measure))
           .table("trials");
  EXPECT_NEAR(trials.columns[0].values[1], 0.1, 1e-15);
  const Table listed =
      *result_of(sweep(parameter("mechanism.parameters.crank_mm", "") + parameter("mechanism.branch", "") +
                       measure +
                       "[sampling]\nmethod = \"list\"\ntrials = [[25, \"open\"], [30, \"crossed\"]]\n"))
           .table("trials");
  EXPECT_THAT(listed.columns[0].values, ElementsAre(0.025, 0.03));
  EXPECT_THAT(listed.columns[1].values, ElementsAre(1, 2));
}

TEST(Sweep, FilesOfStudiesAndOfTrials) {
  const fs::path folder = fs::temp_directory_path() / ("linkwright-sweep-" + std::to_string(::getpid()));
  fs::create_directories(folder / "below");
  Diagnostics none;
  const Value all = study::read_text(sweep(""), study::Syntax::toml, "s.toml", none);
  std::string inner = sweep("");
  inner = "schema = 1\n" + inner.substr(inner.find("[study]\n") + 8);
  for (std::size_t at; (at = inner.find("[study.")) != std::string::npos;) inner.erase(at + 1, 6);
  std::ofstream(folder / "below/four-bar.toml") << inner;
  std::ofstream(folder / "trials.csv")
      << "mechanism.parameters.crank_mm;mechanism.parameters.rocker_mm\n25;90\n30;95,5\n";
  const std::string head = "schema = 1\nkind = \"sweep\"\nstudy.file = \"below/four-bar.toml\"\n";
  std::string messages;
  auto study = test::prepare(app::catalogue(),
                             head + measure + "[sampling]\nmethod = \"list\"\nfile = \"trials.csv\"\n",
                             messages, folder);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  const Table& trials = *result.table("trials");
  EXPECT_THAT(trials.columns[1].values, ElementsAre(0.09, 0.0955));
  EXPECT_THAT(trials.status, ElementsAre("done", "done"));

  // The written study holds everything, and is the same study.
  Diagnostics diagnostics;
  const auto again = study::prepare(study->canonical, "s.json", {}, app::catalogue(), diagnostics);
  ASSERT_TRUE(again) << test::lines_of(diagnostics);
  EXPECT_EQ(again->canonical, study->canonical);
  EXPECT_EQ(test::all_of(study::run_study(*again, context)), test::all_of(result));

  std::ofstream(folder / "below/four-bar.toml") << inner << "wrong = 1\n";
  EXPECT_FALSE(test::prepare(app::catalogue(), head + crank + measure, messages, folder));
  EXPECT_THAT(messages, HasSubstr("study.file: "));
  EXPECT_THAT(messages, HasSubstr("four-bar.toml:"));
  EXPECT_THAT(messages, HasSubstr("output.wrong: unknown key"));
  fs::remove_all(folder);
}

TEST(Sweep, TrialsThatAreNoStudiesAreNamed) {
  const study::Result result =
      result_of(sweep(parameter("mechanism.parameters.crank_mm", "values = [30, -5, 300]") + measure));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_THAT(result.table("trials")->status, ElementsAre("done", "invalid", "no_assembly"));
  const std::string said = test::lines_of(result.diagnostics);
  EXPECT_THAT(said, HasSubstr("1 of 3 trials are studies with errors; the first at crank -5 mm: "
                              "mechanism.parameters.crank_mm: "));
  EXPECT_THAT(said, HasSubstr("not all trials came to their end: 1 no_assembly"));
  for (const double value :
       {result.table("trials")->columns[1].values[1], result.table("trials")->columns[1].values[2]})
    EXPECT_TRUE(std::isnan(value)) << "of a part of the way";
}

TEST(Sweep, AMeasureThatIsNotThereEndsItAtOnce) {
  const study::Result result =
      result_of(sweep(crank + "[[measure]]\nquantity = \"sweep.roker_angle_deg.max\"\n"));
  EXPECT_EQ(result.status, Status::infeasible);
  EXPECT_THAT(to_string(result.headline),
              HasSubstr("Nothing was tried. sweep.roker_angle_deg.max: there is no column of 'sweep' "
                        "'roker_angle_deg'; did you mean 'rocker_angle"));
}

TEST(Sweep, WhatIsWrongIsSaidWhereItStands) {
  EXPECT_THAT(messages_of(sweep(measure)),
              HasSubstr("study.toml:1:1: error: parameter: this key is missing; write [[parameter]]"));
  EXPECT_THAT(messages_of(sweep(crank)), HasSubstr("error: measure: this key is missing; write [[measure]]"));
  EXPECT_THAT(messages_of(sweep(parameter("mechanism.parameters.crnk_mm", "min = 1\nmax = 2") + measure)),
              HasSubstr("study.toml:4:7: error: parameter[0].key: the study has no key "
                        "'mechanism.parameters.crnk_mm'; did you "
                        "mean 'crank"));
  EXPECT_THAT(messages_of(sweep(parameter("mechanism.parameters.crank_mm", "min = 1") + measure)),
              HasSubstr("parameter[0].max: the range is not complete; write min and max"));
  EXPECT_THAT(messages_of(sweep(parameter("mechanism.parameters.crank_mm", "min = 3\nmax = 2") + measure)),
              HasSubstr("parameter[0].max: is 2, must be more than min, which is 3"));
  EXPECT_THAT(messages_of(sweep(
                  parameter("mechanism.parameters.crank_mm", "min = 0\nmax = 2\nspacing = \"logarithmic\"") +
                  measure)),
              HasSubstr("equal ratios begin above 0"));
  EXPECT_THAT(messages_of(sweep(crank + crank + measure)),
              HasSubstr("'mechanism.parameters.crank_mm' is changed twice"));
  EXPECT_THAT(messages_of(sweep(parameter("mechanism..x", "min = 1\nmax = 2") + measure)),
              HasSubstr("'mechanism..x' is not the path of a key"));
  EXPECT_THAT(messages_of(sweep(crank + measure + "[sampling]\nmethod = \"list\"\n")),
              HasSubstr("the trials are missing"));
  EXPECT_THAT(messages_of(sweep(parameter("mechanism.branch", "") + measure +
                                "[sampling]\nmethod = \"list\"\ntrials = [[\"open\", 3]]\n")),
              HasSubstr("sampling.trials: trial 1 has 2 values, there are 1 parameters"));
  EXPECT_THAT(
      messages_of(sweep(parameter("mechanism.parameters.crank_mm", "min = 1\nmax = 2\nsteps = 1000000") +
                        parameter("mechanism.parameters.rocker_mm", "min = 1\nmax = 2\nsteps = 1000000") +
                        measure)),
      HasSubstr("1e+12 trials, at most 1e+07 are made"));
  std::string wrong = sweep(crank + measure);
  wrong.replace(wrong.find("rocker_mm = 90.0"), 16, "rocker_mm = -1.0");
  EXPECT_THAT(messages_of(wrong), HasSubstr("study.mechanism.parameters.rocker_mm: "));
}

TEST(Sweep, ASweepDoesNotRunSweeps) {
  std::string text = sweep(crank + measure);
  text.replace(text.find("kind = \"analysis\""), 17, "kind = \"sweep\"");
  EXPECT_THAT(messages_of(text), HasSubstr("study.kind: is 'sweep', must be one of: synthesis"));
}

}  // namespace
}  // namespace linkwright::parameter_study
