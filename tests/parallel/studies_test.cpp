// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies.h"

#include <gmock/gmock.h>

#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

TEST(RobotStudies, AreThoseOfRobotsAndPiJoints) {
  std::vector<std::string> names;
  for (const study::Kind& kind : studies()) names.push_back(study::name_of(kind));
  EXPECT_THAT(names,
              ::testing::ElementsAre("analysis/parallel.pi_joint", "synthesis/parallel.pi_joint/requirements",
                                     "analysis/parallel.delta", "analysis/parallel.hexa",
                                     "analysis/parallel.five_bar", "analysis/parallel.constant_orientation",
                                     "analysis/parallel.serial_pi_arm", "synthesis/parallel.delta/region",
                                     "synthesis/parallel.hexa/region", "synthesis/parallel.five_bar/region"));
}

TEST(RobotStudies, ExamplesRun) {
  for (const study::Kind& kind : studies()) {
    SCOPED_TRACE(study::name_of(kind));
    const study::Result result = test::run_text(kind.example);
    EXPECT_EQ(result.status, Status::done) << to_string(result.headline);
    EXPECT_FALSE(result.headline.empty());
    EXPECT_FALSE(result.tables.empty());
    EXPECT_FALSE(result.scenes.empty());
    for (const Diagnostic& d : result.diagnostics) ADD_FAILURE() << to_string(d);
  }
}

}  // namespace
}  // namespace linkwright::parallel
