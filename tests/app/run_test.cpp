// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/run.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/npy.h"
#include "tests/study/sample_kind.h"

namespace linkwright::app {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Run : public ::testing::Test {
 protected:
  Run() : folder_(fs::temp_directory_path() / ("linkwright-run-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("s.toml", study::sample::example);
  }
  ~Run() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, std::string_view text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  static std::string read(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }
  std::optional<study::Study> load(const RunOptions& options) {
    diagnostics_.clear();
    return load_study(folder_ / "s.toml", options, kinds_, diagnostics_);
  }
  std::string message() const { return diagnostics_.empty() ? "" : to_string(diagnostics_[0]); }

  std::vector<study::Kind> kinds_ = study::sample::kinds();
  Diagnostics diagnostics_;
  fs::path folder_;
};

TEST_F(Run, OptionsChangeTheCanonicalStudy) {
  const auto study = load({.out = "x", .seed = 7, .set = {"mechanism.length_m=0.25", "target.to_rad=1"}});
  ASSERT_TRUE(study) << message();
  EXPECT_EQ(study->common.seeds.first, 7);
  EXPECT_EQ(study->common.seeds.count, 2);
  EXPECT_EQ(study->canonical.find("mechanism")->find("length_m")->as_number(), 0.25);
  EXPECT_EQ(study->canonical.find("output")->find("dir")->as_string(), "");
}

TEST_F(Run, ProblemsOfOptionsNameTheOption) {
  EXPECT_FALSE(load({.out = {}, .seed = {}, .set = {"mechanism.length_m=-1"}}));
  EXPECT_EQ(message(),
            "--set mechanism.length_m=-1: error: mechanism.length_m: is -1 m, must be at least 0 m");
  EXPECT_FALSE(load({.out = {}, .seed = {}, .set = {"mechanism.lenth_m=1"}}));
  EXPECT_EQ(message(),
            "--set mechanism.lenth_m=1: error: mechanism.lenth_m: unknown key; did you mean 'length_m'?");
  EXPECT_FALSE(load({.out = {}, .seed = {}, .set = {"nonsense"}}));
  EXPECT_EQ(message(), "--set nonsense: error: has no value; write --set key=value");
}

TEST_F(Run, ASeedNeedsAStudyWithSeeds) {
  write("s.toml", "schema = 1\nkind = 'analysis'\nmechanism = { type = 'sample.wheel', length_m = 1 }\n");
  EXPECT_FALSE(load({.out = {}, .seed = 3, .set = {}}));
  EXPECT_EQ(message(), "--seed 3: error: this kind of study has no seeds; leave out --seed");
}

TEST_F(Run, FolderOfTheResults) {
  auto study = load({});
  EXPECT_EQ(output_folder(*study, "a/lever.toml", {}), fs::path("out/lever"));
  EXPECT_EQ(output_folder(*study, "a/lever.toml", {.out = "b", .seed = {}, .set = {}}), fs::path("b"));
  study->common.output.dir = "c";
  EXPECT_EQ(output_folder(*study, "a/lever.toml", {}), fs::path("c"));
}

TEST_F(Run, StudiesOfOneNameInTwoFoldersDoNotShareTheirResults) {
  const auto study = load({});
  const fs::path here = fs::current_path();
  fs::create_directories(folder_ / "a");
  fs::create_directories(folder_ / "b");
  fs::current_path(folder_);
  write("a/lever.toml", "");
  write("b/lever.toml", "");
  std::vector<std::string> folders;
  for (const char* file : {"a/lever.toml", "b/lever.toml", "a/lever.toml", "b/lever.toml", "lever.toml"}) {
    const fs::path folder = output_folder(*study, file, {});
    folders.push_back(folder.generic_string());
    EXPECT_TRUE(prepare_folder(folder, diagnostics_));
    EXPECT_EQ(note_owner(folder, file, {}, *study), "");
    std::ofstream(folder / "sweep.csv") << file;
  }
  // A study beside `out` has its folder by its name.
  fs::remove_all("out");
  write("lever.toml", "");
  fs::create_directories("out/lever");
  std::ofstream("out/lever/sweep.csv") << "lever.toml";
  folders.push_back(output_folder(*study, "lever.toml", {}).generic_string());
  folders.push_back(output_folder(*study, "./a/../lever.toml", {}).generic_string());
  folders.push_back(output_folder(*study, "a/lever.toml", {}).generic_string());
  fs::current_path(here);
  EXPECT_THAT(folders, ::testing::ElementsAre("out/lever", "out/b-lever", "out/lever", "out/b-lever",
                                              "out/" + folder_.filename().string() + "-lever", "out/lever",
                                              "out/lever", "out/a-lever"));
}

TEST_F(Run, WritesWhatTheStudyAsksFor) {
  const auto study = load({.out = {}, .seed = {}, .set = {"output.formats=['csv']"}});
  ASSERT_TRUE(study) << message();
  RunContext context;
  ASSERT_TRUE(prepare_folder(folder_ / "deep/out", diagnostics_));
  const auto written =
      write_results(*study, run_and_record(*study, context), folder_ / "deep/out", diagnostics_);
  EXPECT_EQ(written, std::vector<fs::path>{folder_ / "deep/out/sweep.csv"});
  EXPECT_EQ(read(written[0]),
            "angle_rad,height_m,status\r\n0,0,done\r\n0.7853981633974483,,no_assembly\r\n1.5707963267948966,"
            "0.4,done\r\n");
  // Nothing is left of the temporary files.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "deep/out"), fs::directory_iterator()), 1);
}

TEST_F(Run, SolidsAreFilesOfTheResult) {
  kinds_.assign(catalogue().begin(), catalogue().end());
  write("s.toml", find_kind("analysis/planar.four_bar", kinds_, diagnostics_)->example);
  const auto study = load({.out = {}, .seed = {}, .set = {"output.formats=['step']"}});
  ASSERT_TRUE(study) << message();
  RunContext context;
  const RunOutcome outcome = run_and_record(*study, context);
  ASSERT_EQ(outcome.result.files.size(), outcome.result.scenes.size());
  EXPECT_EQ(outcome.result.files.at(0).name, "motion.step");
  EXPECT_TRUE(outcome.result.files[0].text.starts_with("ISO-10303-21;"));
  ASSERT_TRUE(prepare_folder(folder_ / "out", diagnostics_));
  EXPECT_EQ(write_results(*study, outcome, folder_ / "out", diagnostics_),
            std::vector<fs::path>{folder_ / "out/motion.step"});
}

TEST_F(Run, WhatAKilledRunHasLeftIsRemoved) {
  const pid_t dead = ::fork();
  if (dead == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(dead, nullptr, 0), dead);
  const auto study = load({});
  ASSERT_TRUE(study) << message();
  RunContext context;
  ASSERT_TRUE(prepare_folder(folder_ / "out", diagnostics_));
  const auto written = write_results(*study, run_and_record(*study, context), folder_ / "out", diagnostics_);
  ASSERT_FALSE(written.empty());
  for (const fs::path& file : written) std::ofstream(fmt::format("{}.{}.part", file.string(), dead)) << "x";
  write_results(*study, run_and_record(*study, context), folder_ / "out", diagnostics_);
  for (const fs::path& file : written)
    EXPECT_FALSE(fs::exists(fmt::format("{}.{}.part", file.string(), dead))) << file;
}

TEST_F(Run, LongTablesStandBesideTheResult) {
  const auto study = load({.out = {}, .seed = {}, .set = {"output.formats=['csv', 'json', 'html']"}});
  ASSERT_TRUE(study) << message();
  RunContext context;
  ASSERT_TRUE(prepare_folder(folder_ / "out", diagnostics_));
  for (const std::size_t most : {2u, 3u}) {
    const RunOutcome outcome = run_and_record(*study, context, most);
    const auto written = write_results(*study, outcome, folder_ / "out", diagnostics_);
    const bool apart = most < 3;
    EXPECT_EQ(written, (std::vector<fs::path>{folder_ / "out/result.json",
                                              folder_ / (apart ? "out/sweep.npy" : "out/sweep.csv"),
                                              folder_ / "out/report.html"}));
    const Value document =
        *result_json(*study, presented(*study, outcome.result), outcome.record, {}, most).find("tables");
    const Value& table = document.as_array().at(0);
    EXPECT_EQ(table.find("columns")->as_array().size(), 3u);
    EXPECT_EQ(table.find("data") == nullptr, apart);
    EXPECT_EQ(table.find("file") != nullptr && table.find("file")->as_string() == "sweep.npy", apart);
    const auto& remarks = outcome.result.diagnostics;
    EXPECT_EQ(
        std::any_of(remarks.begin(), remarks.end(),
                    [](const Diagnostic& d) {
                      return d.message ==
                             "the table 'sweep' has 3 rows, more than 2: it is written as sweep.npy, without "
                             "CSV, and the report shows a part of its rows";
                    }),
        apart);
  }
  std::string npy;
  const RunOutcome again = run_and_record(*study, context);
  NpyPieces pieces(again.result.tables.at(0));
  for (std::string_view piece = pieces.next(); !piece.empty(); piece = pieces.next()) npy += piece;
  EXPECT_EQ(read(folder_ / "out/sweep.npy"), npy);
}

TEST_F(Run, ReportsShowAPartOfLongTables) {
  study::Result result;
  Table& table = result.tables.emplace_back(Table{.name = "trials"});
  table.add("x_m", "x", std::vector<double>(25000));
  for (std::size_t i = 0; i < 25000; ++i) table.columns[0].values[i] = static_cast<double>(i);
  table.status.resize(25000, "done");
  table.status[3] = "singular";
  result.plots = {{.name = "a", .table = "trials"},
                  {.name = "b", .table = "trials", .style = study::Plot::Style::map}};
  EXPECT_EQ(with_short_tables(result, 25000).tables[0].rows(), 25000u);
  const study::Result shown = with_short_tables(result, 24999);
  ASSERT_EQ(shown.tables[0].rows(), 8334u);
  EXPECT_EQ(shown.tables[0].columns[0].values[1], 3);
  EXPECT_EQ(shown.tables[0].columns[0].values.back(), 24999);
  EXPECT_EQ(shown.tables[0].status.size(), 8334u);
  EXPECT_EQ(shown.tables[0].status[1], "singular");
  ASSERT_EQ(shown.plots.size(), 1u);
  EXPECT_EQ(shown.plots[0].name, "a");
}

TEST_F(Run, WritesTheStudiesOfDesigns) {
  const auto study = load({.out = {}, .seed = {}, .set = {"output.formats=['csv']"}});
  ASSERT_TRUE(study) << message();
  RunContext context;
  RunOutcome outcome = run_and_record(*study, context);
  ASSERT_EQ(outcome.result.solutions.size(), 1u);
  outcome.result.solutions.resize(3, outcome.result.solutions[0]);
  for (const std::size_t i : {0u, 2u}) {  // the second one has none
    outcome.result.solutions[i].study["kind"] = "analysis";
    outcome.result.solutions[i].study["mechanism"]["type"] = "lever";
  }
  ASSERT_TRUE(prepare_folder(folder_ / "out", diagnostics_));
  const auto written = write_results(*study, outcome, folder_ / "out", diagnostics_);
  EXPECT_EQ(written, (std::vector<fs::path>{folder_ / "out/sweep.csv", folder_ / "out/designs/1-lever.toml",
                                            folder_ / "out/designs/3-lever.toml"}));
  ASSERT_EQ(written.size(), 3u) << message();
  EXPECT_EQ(read(written[2]), "#:schema ./analysis-lever.schema.json\n# Solution 3 of \"" + title_of(*study) +
                                  "\", found by linkwright 0.1.0: lever\nkind = \"analysis\"\n\n"
                                  "[mechanism]\ntype = \"lever\"\n");
  const Value solutions =
      *result_json(*study, presented(*study, outcome.result), outcome.record).find("solutions");
  EXPECT_EQ(*solutions.as_array()[0].find("study"), outcome.result.solutions[0].study);
  EXPECT_EQ(solutions.as_array()[1].find("study"), nullptr);
}

TEST_F(Run, UnwritableFolders) {
  EXPECT_FALSE(prepare_folder(folder_ / "s.toml" / "below", diagnostics_));
  EXPECT_THAT(message(), HasSubstr("s.toml/below: error: the folder cannot be made: Not a directory"));
  diagnostics_.clear();
  EXPECT_FALSE(prepare_folder("/proc", diagnostics_));
  EXPECT_THAT(message(), HasSubstr("/proc: error: the folder cannot be written"));
  diagnostics_.clear();
  const auto study = load({});
  RunContext context;
  EXPECT_TRUE(write_results(*study, run_and_record(*study, context), folder_ / "none", diagnostics_).empty());
  EXPECT_THAT(message(), HasSubstr("none/result.json: error: cannot be written: No such file or directory"));
}

TEST(ExitCode, StatusBeforeChecks) {
  study::Result result;
  EXPECT_EQ(exit_code(result), 0);
  result.checks.resize(1);
  EXPECT_EQ(exit_code(result), 1);
  result.checks[0].passed = true;
  EXPECT_EQ(exit_code(result), 0);
  result.status = Status::deadline;
  EXPECT_EQ(exit_code(result), 0);
  result.checks[0].passed = false;
  EXPECT_EQ(exit_code(result), 1);
  for (Status status : {Status::no_assembly, Status::not_converged, Status::infeasible, Status::limit_reached,
                        Status::self_locking}) {
    result.status = status;
    EXPECT_EQ(exit_code(result), 3);
  }
  result.status = Status::cancelled;
  EXPECT_EQ(exit_code(result), 4);
}

}  // namespace
}  // namespace linkwright::app
