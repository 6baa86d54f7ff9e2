// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/plug_ins.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <string>

#include "linkwright/cli/arguments.h"
#include "tests/cli/program_fixture.h"

namespace linkwright::cli {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(PlugIns, ThatAreNotThereAreNamed) {
  std::string problem;
  EXPECT_EQ(load_plug_in("none.so", problem), nullptr);
  EXPECT_THAT(problem, HasSubstr("lib/linkwright/none.so is not there"));
}

// The program without its plug-ins, elsewhere.
class ProgramAlone : public test::ProgramFixture {
 protected:
  ProgramAlone() : ProgramFixture("/usr/bin/env") {
    fs::create_directory(folder_ / "bin");
    fs::copy(LINKWRIGHT_PROGRAM, folder_ / "bin/linkwright");
  }
  int search(const std::string& method) {
    return run({folder_ / "bin/linkwright", "run", LINKWRIGHT_STUDIES "/fourbar-18-points.toml", "--out",
                "out", "--quiet", "--set", "check=[]", "--set", "optimiser={method='" + method + "'}"});
  }
};

TEST_F(ProgramAlone, RunsWhatNeedsNoneAndSaysWhatIsMissing) {
  EXPECT_EQ(search("grey_wolf"), 0) << err_;
  if (!fs::exists(LINKWRIGHT_PAGMO_PLUG_IN)) GTEST_SKIP() << "this build has pagmo in the program";
  EXPECT_EQ(search("cma_es"), internal_error);
  EXPECT_THAT(err_, HasSubstr("the program's part for pagmo (CMA-ES, NSGA-II, MOEA/D) cannot be loaded: "));
  EXPECT_THAT(err_, HasSubstr("pagmo.so is not there"));
  EXPECT_THAT(err_, HasSubstr("Install the program again"));
  fs::create_directories(folder_ / "lib/linkwright");
  fs::copy(LINKWRIGHT_PAGMO_PLUG_IN, folder_ / "lib/linkwright/pagmo.so");
  EXPECT_EQ(search("cma_es"), 0) << err_;
}

}  // namespace
}  // namespace linkwright::cli
