#include "linkwright/cli/program.h"

#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include "linkwright/study/read.h"
#include "tests/cli/program_fixture.h"
#include "tests/study/sample_kind.h"

// Runs the built program (with the sample domain) as users do: exit codes and both streams.
namespace linkwright::cli {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Program : public test::ProgramFixture {
 protected:
  Program() : ProgramFixture(LINKWRIGHT_SAMPLE_PROGRAM) { write("s.toml", study::sample::example); }

  /// Files below the test's folder besides the study and the two streams.
  std::size_t files() const {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) count += entry.is_regular_file();
    return count - 3;
  }
};

TEST_F(Program, RunWritesAndSummarises) {
  EXPECT_EQ(run({"run", "s.toml"}), 0) << err_;
  EXPECT_EQ(err_, "");
  EXPECT_EQ(out_,
            "A lever\n"
            "  The lever turns\n"
            "  status  done\n"
            "  length  0.4 m\n"
            "checks: 1 passed, 0 failed\n"
            "  passed  best.height_mm = 400  (equals 400 within 1e-09)\n"
            "results in out/s:\n"
            "  result.json\n"
            "  sweep.csv\n"
            "  report.html\n");
  EXPECT_EQ(result("out/s/result.json").find("status")->as_string(), "done");
}

TEST_F(Program, JsonIsTheResultFileAndNothingElse) {
  EXPECT_EQ(run({"run", "s.toml", "--out", "there", "--json"}), 0);
  EXPECT_EQ(out_, text_of(folder_ / "there/result.json"));
  EXPECT_EQ(err_, "");
}

TEST_F(Program, FailedCheckIsOne) {
  EXPECT_EQ(run({"run", "s.toml", "--set", "check[0].equals=1"}), 1);
  EXPECT_THAT(
      out_, HasSubstr("checks: 0 passed, 1 failed\n  FAILED  best.height_mm = 400  (equals 1 within 1e-09)"));
  EXPECT_EQ(run({"run", "s.toml", "--set", "check[0].quantity=best.hight_mm"}), 1);
  EXPECT_THAT(out_, HasSubstr("FAILED  best.hight_mm: there is no number of the best solution 'hight_mm'; "
                              "did you mean 'height_m'?"));
}

TEST_F(Program, BadInputIsTwoAndWritesNothing) {
  EXPECT_EQ(run({"run", "none.toml"}), 2);
  EXPECT_EQ(err_, "none.toml: error: there is no such file\n");
  write("bad.toml",
        "schema = 1\nkind = 'synthesis'\nmechanism = { type = 'sample.lever', lenth_m = 1 }\ntarget = { type "
        "= 'angle', to = 1 }\n");
  EXPECT_EQ(run({"run", "bad.toml"}), 2);
  EXPECT_EQ(err_,
            "bad.toml:3:38: error: mechanism.lenth_m: unknown key; did you mean 'length_m'?\n"
            "bad.toml:4:28: error: target.to: the unit is missing; write to_rad or to_deg\n"
            "2 errors\n");
  EXPECT_EQ(out_, "");
  EXPECT_EQ(run({"run", "."}), 2);
  EXPECT_EQ(run({"run", "s.toml", "--treads", "2"}), 2);
  EXPECT_THAT(err_, HasSubstr("did you mean '--threads'?"));
  EXPECT_EQ(run({"run", "s.toml", "--out", "s.toml/x"}), 2);
  EXPECT_THAT(err_, HasSubstr("s.toml/x: error: the folder cannot be made: Not a directory"));
  EXPECT_EQ(files(), 1u) << "only bad.toml came to what the test began with";
}

TEST_F(Program, NumericFailureIsThreeAndKeepsTheGoodPart) {
  EXPECT_EQ(run({"run", "s.toml", "--set", "mechanism.mode=no_assembly"}), 3);
  EXPECT_EQ(result("out/s/result.json").find("status")->as_string(), "no_assembly");
  EXPECT_TRUE(fs::exists(folder_ / "out/s/sweep.csv"));
}

TEST_F(Program, TheTimeLimitIsANormalEnd) {
  EXPECT_EQ(run({"run", "s.toml", "--set", "mechanism.mode=wait", "--time-limit", "0.05"}), 0);
  EXPECT_EQ(result("out/s/result.json").find("status")->as_string(), "deadline");
}

TEST_F(Program, ControlCWritesTheBestSoFarAndIsFour) {
  const pid_t child = start({"run", "s.toml", "--set", "mechanism.mode=wait", "--time-limit", "60"});
  // The handler is set before the folder is made.
  while (!fs::exists(folder_ / "out/s")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(child, SIGINT);
  EXPECT_EQ(finish(child), 4);
  EXPECT_EQ(result("out/s/result.json").find("status")->as_string(), "cancelled");
}

TEST_F(Program, InternalErrorsAreSeventy) {
  EXPECT_EQ(run({"run", "s.toml", "--set", "mechanism.mode=fail"}), 70);
  EXPECT_EQ(
      err_,
      "linkwright: internal error: the lever broke\nThis is a fault of the program, not of the study.\n");
}

TEST_F(Program, CheckOnlyReads) {
  EXPECT_EQ(run({"check", "s.toml"}), 0);
  EXPECT_EQ(out_, "s.toml: good, synthesis/sample.lever/angle\n");
  EXPECT_EQ(run({"check", "s.toml", "--set", "kind=sinthesis"}), 2);
  EXPECT_EQ(err_,
            "--set kind=sinthesis: error: kind: is 'sinthesis', must be one of: synthesis, analysis; did you "
            "mean 'synthesis'?\n");
  EXPECT_EQ(files(), 0u);
}

TEST_F(Program, NewWritesAnExampleOnce) {
  EXPECT_EQ(run({"new", "synthesis/sample.lever/angle"}), 0) << err_;
  EXPECT_EQ(text_of(folder_ / "synthesis-sample.lever-angle.toml"), study::sample::example);
  EXPECT_EQ(run({"check", "synthesis-sample.lever-angle.toml"}), 0);
  EXPECT_EQ(run({"new", "synthesis/sample.lever/angle", "s.toml"}), 2);
  EXPECT_EQ(err_, "s.toml: error: already exists and is left unchanged\n");
  EXPECT_EQ(run({"new", "analysis", "-"}), 0);
  EXPECT_EQ(out_, study::sample::example);
  EXPECT_EQ(run({"new", "analisis/sample.wheel"}), 2);
  EXPECT_THAT(err_, HasSubstr("did you mean 'analysis/sample.wheel'?"));
}

TEST_F(Program, SchemaAndCatalogue) {
  EXPECT_EQ(run({"catalogue"}), 0);
  EXPECT_THAT(out_, HasSubstr("analysis/sample.wheel\n    Turns a wheel.\n"));
  for (const std::vector<std::string>& words : {std::vector<std::string>{"schema"}, {"schema", "analysis"}}) {
    EXPECT_EQ(run(words), 0);
    Diagnostics diagnostics;
    EXPECT_TRUE(study::read_text(out_, study::Syntax::json, "schema", diagnostics).is_object());
  }
}

TEST_F(Program, ReproduceListsAndRefuses) {
  EXPECT_EQ(run({"reproduce"}), 0);
  EXPECT_EQ(out_, "");  // this program has no tables
  EXPECT_EQ(run({"reproduce", "table-1"}), 2);
  EXPECT_THAT(err_, HasSubstr("there is no published table 'table-1'"));
}

}  // namespace
}  // namespace linkwright::cli
