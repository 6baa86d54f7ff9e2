// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/robot_analysis.h"

#include <gtest/gtest.h>

#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

TEST(RobotAnalysisStudy, FindsAHomeOnTheAxis) {
  for (const auto& [robot, mode] :
       {std::pair{reference_delta(), all_positive}, std::pair{reference_hexa(), all_positive},
        std::pair{reference_five_bar(), WorkingMode{-1, 1}}}) {
    const auto home = usual_home(robot, mode);
    ASSERT_TRUE(home);
    EXPECT_NEAR(home->position.x, 0, 1e-15);
    EXPECT_EQ(inverse(robot, *home, mode).status, Status::done);
    EXPECT_NE(assembly_at(robot, *home, mode), 0);
  }
  // Rods too short for anything.
  Robot stub = reference_delta();
  for (Leg& leg : stub.leg) leg.rod = 0.01, leg.arm = 0.01;
  EXPECT_EQ(usual_home(stub, all_positive), std::nullopt);
}

}  // namespace
}  // namespace linkwright::parallel
