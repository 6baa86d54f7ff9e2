// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "linkwright/core/numbers.h"
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
