// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/program.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/ioctl.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "linkwright/study/study.h"
#include "tests/cli/program_fixture.h"
#include "tests/study/sample_kind.h"

// Runs the built program (with the sample domain) as users do: exit codes and both streams.
namespace linkwright::cli {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

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
            "  report.html\n"
            "open out/s/report.html\n");
  EXPECT_EQ(result("out/s/result.json").find("status")->as_string(), "done");
}

TEST_F(Program, TheSummaryIsInTheUnitsOfTheOutput) {
  EXPECT_EQ(run({"run", "s.toml", "--set", "output.units=[\"mm\"]"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("  length  400 mm\n"));
}

TEST_F(Program, EveryWriteIsCheckedToItsEnd) {
  ::setenv("L", program_.c_str(), 1);
  const auto shell = [&](const std::string& command) {
    const int status = std::system(("cd '" + folder_.string() + "' && (" + command + ") 2> stderr").c_str());
    err_ = text_of(folder_ / "stderr");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  // A full device behind standard output.
  for (const std::string command : {"new analysis/sample.wheel -", "check s.toml", "run s.toml --json",
                                    "run s.toml", "schema", "catalogue", "schema result", "--help"}) {
    EXPECT_EQ(shell("$L " + command + " > /dev/full"), 3) << command;
    EXPECT_EQ(err_, "standard output: error: cannot be written: No space left on device\n") << command;
  }
  EXPECT_EQ(shell("$L check none.toml 2> /dev/full"), 2);
  // A limit of the size of files: what is not written is named, and not half there.
  EXPECT_EQ(shell("ulimit -f 1; $L run s.toml --out limited > stdout"), 3);
  EXPECT_THAT(err_, HasSubstr("limited/report.html: error: cannot be written: File too large\n"));
  EXPECT_FALSE(fs::exists(folder_ / "limited/report.html"));
  // A folder that is no more.
  const std::string gone = "mkdir gone; cd gone; rmdir ../gone; ",
                    study = "'" + (folder_ / "s.toml").string() + "'";
  EXPECT_EQ(shell(gone + "$L run " + study + " > ../stdout"), 2);
  EXPECT_THAT(err_, HasSubstr("out/s: error: the folder cannot be made: No such file or directory\n"));
  EXPECT_EQ(shell(gone + "timeout 20 $L serve " + study + " > ../stdout"), 3);
  EXPECT_THAT(err_, HasSubstr("cannot be reached: No such file or directory\n"));
  // Stacks of 4 GB, of which no thread gets one.
  EXPECT_EQ(shell("ulimit -s 4000000; ulimit -v 3000000; timeout 20 $L serve s.toml --port 0 > stdout"), 5);
  EXPECT_THAT(err_, HasSubstr("the system gives no more threads"));
}

TEST_F(Program, OnlyPlainFilesAreRead) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe.toml").c_str(), 0600), 0);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", "pipe.toml"}, {"check", "pipe.toml"}, {"serve", "pipe.toml"}}) {
    EXPECT_EQ(run(words), 2) << words[0];
    EXPECT_EQ(
        err_,
        "pipe.toml: error: is not a plain file, but a pipe or a device; write the study to a file, or give - "
        "and the study as standard input\n");
  }
}

TEST_F(Program, TheFirstInterruptEndsItWhileItWaitsForText) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const int pipe = ::open((folder_ / "pipe").c_str(), O_RDWR);
  input_ = (folder_ / "pipe").string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", "-"}, {"check", "-"}, {"compare", "-", "s.toml"}}) {
    const pid_t child = start(words);
    const std::string_view begun = "schema = 1\n";
    ASSERT_EQ(::write(pipe, begun.data(), begun.size()), static_cast<ssize_t>(begun.size()));
    for (int left = 1; left != 0;) ASSERT_EQ(::ioctl(pipe, FIONREAD, &left), 0);  // it reads
    ::kill(child, SIGINT);
    EXPECT_EQ(finish(child), -SIGINT) << words[0];
  }
  ::close(pipe);
}

TEST_F(Program, AReadOnlyResultIsLeftAsItIs) {
  EXPECT_EQ(run({"run", "s.toml"}), 0);
  fs::permissions(folder_ / "out/s/sweep.csv", static_cast<fs::perms>(0444));
  write("out/s/other", "");
  EXPECT_EQ(run({"run", "s.toml", "--set", "mechanism.length_m=0.5"}), 3);
  EXPECT_THAT(err_, HasSubstr("out/s/sweep.csv: error: cannot be written: Permission denied\n"));
}

TEST_F(Program, JsonIsTheResultFileAndNothingElse) {
  EXPECT_EQ(run({"run", "s.toml", "--out", "there", "--json"}), 0);
  EXPECT_EQ(out_, text_of(folder_ / "there/result.json"));
  EXPECT_EQ(err_, "");
}

TEST_F(Program, QuietPrintsErrorsOnly) {
  EXPECT_EQ(run({"run", "s.toml", "--quiet"}), 0);
  EXPECT_EQ(out_ + err_, "");
  EXPECT_EQ(run({"run", "none.toml", "-q"}), 2);
  EXPECT_EQ(err_, "none.toml: error: there is no such file\n");
}

TEST_F(Program, AStudyAloneOrFromStandardInputIsRun) {
  EXPECT_EQ(run({"s.toml", "--quiet"}), 0) << err_;
  EXPECT_TRUE(fs::exists(folder_ / "out/s/report.html"));
  input_ = "s.toml";
  EXPECT_EQ(run({"run", "-"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("\nopen out/standard-input/report.html\n"));
  EXPECT_EQ(run({"check", "-"}), 0) << err_;
  EXPECT_EQ(out_, "standard input: good, synthesis/sample.lever/angle\n");
  write("bad.toml",
        "schema = 1\nkind = 'synthesis'\nmechanism = { type = 'sample.lever', lenth_m = 1 }\ntarget = { type "
        "= 'angle', to_rad = 1 }\n");
  input_ = "bad.toml";
  EXPECT_EQ(run({"run", "-"}), 2);
  EXPECT_EQ(err_, "standard input:3:38: error: mechanism.lenth_m: unknown key; did you mean 'length_m'?\n");
}

TEST_F(Program, OpensTheReportIfItCan) {
  write("xdg-open", "#!/bin/sh\necho \"$1\" >\"$(dirname \"$0\")/opened\"\n");
  fs::permissions(folder_ / "xdg-open", fs::perms::owner_all);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (folder_.string() + ":" + path).c_str(), 1);
  EXPECT_EQ(run({"run", "s.toml", "--open", "-q"}), 0);
  EXPECT_EQ(err_, "");
  const std::string expected = (fs::canonical(folder_) / "out/s/report.html").string() + "\n";
  for (int wait = 0; wait < 1000 && text_of(folder_ / "opened") != expected; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_EQ(text_of(folder_ / "opened"), expected);
  ::setenv("PATH", "/nowhere", 1);
  EXPECT_EQ(run({"run", "s.toml", "--open", "-q"}), 0);
  EXPECT_EQ(err_,
            "the report was not opened: there is no 'xdg-open' on this machine; open out/s/report.html in a "
            "browser\n");
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(run({"run", "s.toml", "--open", "-q", "--set", "output.formats=['csv']"}), 0);
  EXPECT_EQ(err_, "there is no report to open: output.formats of the study does not list html\n");
}

TEST_F(Program, ColoursOnDemandOnly) {
  ::setenv("CLICOLOR_FORCE", "1", 1);
  EXPECT_EQ(run({"run", "s.toml"}), 0);
  EXPECT_THAT(out_, HasSubstr("  status  \033[32mdone\033[0m\n"));
  EXPECT_EQ(run({"run", "none.toml"}), 2);
  EXPECT_EQ(err_, "none.toml: \033[1;31merror:\033[0m there is no such file\n");
  ::setenv("NO_COLOR", "1", 1);
  EXPECT_EQ(run({"run", "none.toml"}), 2);
  EXPECT_EQ(err_, "none.toml: error: there is no such file\n");
  ::unsetenv("NO_COLOR");
  ::unsetenv("CLICOLOR_FORCE");
}

TEST_F(Program, CompareWritesOneReportOfSeveral) {
  EXPECT_EQ(run({"run", "s.toml", "-q"}), 0);
  std::string text(study::sample::example);
  text.replace(text.find("A lever"), 7, "A longer lever");
  text.replace(text.find("= 400"), 5, "= 500");
  text.replace(text.find("equals = 400"), 12, "equals = 500");
  write("long.toml", text);
  EXPECT_EQ(run({"compare", "out/s", "long.toml"}), 0) << err_;
  EXPECT_EQ(out_,
            "A lever | A longer lever\n"
            "  2 studies compared: 1 of 2 results differ.\n"
            "  status  done\n"
            "  1       A lever: done\n"
            "  2       A longer lever: done\n"
            "  length  0.4 m\n"
            "checks: 2 passed, 0 failed\n"
            "  passed  best.height_mm at A lever = 400  (equals 400 within 1e-09)\n"
            "  passed  best.height_mm at A longer lever = 500  (equals 500 within 1e-09)\n"
            "results in compare:\n"
            "  result.json\n"
            "  figures.csv\n"
            "  report.html\n"
            "open compare/report.html\n");
  EXPECT_EQ(result("compare/result.json").find("study")->find("compare")->as_array().size(), 2u);
  EXPECT_EQ(text_of(folder_ / "compare/figures.csv"),
            "name,study_1,study_2,difference_2_to_1,status\r\n"
            "length (m),0.4,0.4,0,done\r\n"
            "height_m,0.4,0.5,0.09999999999999998,done\r\n");
  EXPECT_EQ(run({"new", "wheel", "wheel.toml"}), 0);
  text.replace(text.find("kind = \"synthesis\""), 18, "kind = \"analysis\"");
  text.replace(text.find("sample.lever"), 12, "sample.wheel");
  text.erase(text.find("[optimiser]"), text.find("[[check]]") - text.find("[optimiser]"));
  text.erase(text.find("type = \"angle\"\n"), 15);
  write("wheel.toml", text);
  EXPECT_EQ(run({"compare", "s.toml", "wheel.toml"}), 2);
  EXPECT_EQ(err_,
            "wheel.toml: error: is a study of analysis/sample.wheel, but s.toml is one of "
            "synthesis/sample.lever/angle; only studies of one kind are compared\n");
  EXPECT_EQ(run({"compare", "compare", "s.toml"}), 2);
  EXPECT_EQ(err_, "compare/result.json: error: is a comparison; compare the studies that it is made of\n");
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

}  // namespace
}  // namespace linkwright::cli
