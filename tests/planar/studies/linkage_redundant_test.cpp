// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/study/write.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

std::string coupled_wheels() {
  std::ifstream file(std::string(LINKWRIGHT_SOURCE_DIR) + "/examples/studies/coupled-wheels.toml");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(LinkageRedundant, CoupledWheelsMoveAndSayWhichJointsAreTooMany) {
  std::string messages;
  ASSERT_TRUE(prepare(coupled_wheels(), messages));
  EXPECT_THAT(messages,
              HasSubstr("one of the joints A1, A2, A3, P1, P2, P3 holds one direction too many; the "
                        "linkage moves since its dimensions agree (12 equations of rank 11 for 12 "
                        "coordinates)"));
  const study::Result result = run_text(coupled_wheels());
  ASSERT_EQ(result.status, Status::done) << to_string(result.headline);
  EXPECT_EQ(fact(result, "redundant constraints"), "1: 12 equations of rank 11");
  // The three pins of the rod balance it.
  const char* axes[] = {"_x_N", "_y_N"};
  for (const char* axis : axes)
    for (std::size_t i = 0; i < 161; i += 16)
      EXPECT_NEAR(column(result, std::string("P1") + axis)[i] + column(result, std::string("P2") + axis)[i] +
                      column(result, std::string("P3") + axis)[i],
                  0, 1e-8)
          << i;
  // The canonical study is the one that was written, not the one that is solved.
  const auto first = prepare(coupled_wheels(), messages);
  const auto second = prepare(study::to_toml(first->canonical), messages);
  ASSERT_TRUE(second) << messages;
  EXPECT_EQ(first->canonical, second->canonical);
}

TEST(LinkageRedundant, ForcesFollowTheComplianceOfJoints) {
  const std::string asked = coupled_wheels() + "\n[redundant]\nforces = \"compliance\"\n";
  EXPECT_THAT(problems_of(asked), HasSubstr("nothing gives way to the forces that balance each other"));
  const std::string soft = replaced(asked, "name   = \"P3\"", "name   = \"P3\"\ncompliance_m_per_N = 1e-6");
  std::string messages;
  const auto first = prepare(soft, messages);
  ASSERT_TRUE(first) << messages;
  const auto second = prepare(study::to_toml(first->canonical), messages);
  ASSERT_TRUE(second) << messages;
  EXPECT_EQ(first->canonical, second->canonical);
  const study::Result result = run_text(soft), squares = run_text(coupled_wheels());
  EXPECT_EQ(fact(result, "redundant joint forces"), "by the compliance of bars and joints");
  EXPECT_EQ(fact(squares, "redundant joint forces"), "by least squares");
  // In the drawn position, row 30, the only pin that gives way has no force along its self-stress.
  const Table& stress = table(result, "self_stress");
  EXPECT_EQ(stress.rows(), 6u);
  const auto at_p3 = static_cast<std::size_t>(std::find(stress.names.begin(), stress.names.end(), "P3") -
                                              stress.names.begin());
  const double sx = stress.find("stress_1_x")->values.at(at_p3),
               sy = stress.find("stress_1_y")->values.at(at_p3);
  EXPECT_NEAR(column(result, "P3_x_N")[30] * sx + column(result, "P3_y_N")[30] * sy, 0, 1e-8);
  EXPECT_GT(std::abs(column(squares, "P3_x_N")[30] * sx + column(squares, "P3_y_N")[30] * sy), 1e-3);
  // The drive does not depend on the rule.
  EXPECT_NEAR(column(result, "A1_drive_torque_N_m")[7], column(squares, "A1_drive_torque_N_m")[7], 1e-9);
  EXPECT_THAT(problems_of(std::string(linkage_kind().example) + "\n[redundant]\n"),
              HasSubstr("no joint of the linkage is redundant"));
}

TEST(LinkageRedundant, WheelsThatLockAreNamed) {
  const std::string longer =
      replaced(replaced(coupled_wheels(),
                        "P3 = [2453.2088886238, 128.5575219373] }\nmass_kg   = 0\n\n[[mechanism.body]]",
                        "P3 = [2491.5111107797, 160.6969024217] }\nmass_kg   = 0\n\n[[mechanism.body]]"),
               "P3 = [2453.2088886238, 128.5575219373] }\nmass_kg   = 0\n\n[[mechanism.joint]]",
               "P3 = [2491.5111107797, 160.6969024217] }\nmass_kg   = 0\n\n[[mechanism.joint]]");
  EXPECT_THAT(problems_of(longer),
              HasSubstr("the linkage cannot move: with the drive 0.003 away from the drawing"));
}

}  // namespace
}  // namespace linkwright::planar
