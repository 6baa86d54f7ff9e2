// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/carrier_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/csv.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(CarrierPoses, RotationIsMeasuredFromTheReference) {
  const CarrierTargets targets{.wheel = {{0, 0.7, 0}, 0.02, -0.03, 0.6}};
  const Mat3 r = target_rotation(targets, {.angles = {0.02, -0.03, 0}}), identity;
  for (int k = 0; k < 3; ++k) EXPECT_LT(norm(r.row[k] - identity.row[k]), 1e-15);
}

CarrierTargets reference() { return {.wheel = {{0, 0.768, 0}, 0, -0.7 * M_PI / 180, 0.604}}; }

std::optional<CarrierTargets> read(const std::string& text, Diagnostics& found) {
  const auto table = read_csv(text, "poses.csv", found);
  return table ? carrier_targets(reference(), *table, "poses.csv", found) : std::nullopt;
}

TEST(CarrierPoses, AreReadFromColumnsInAnyUnit) {
  Diagnostics found;
  const auto targets = read(
      "travel_m,rack_mm,centre_x_m,centre_y_mm,centre_z_m,toe_deg,camber_rad,carrier_pitch_deg\n"
      "0.05,25,-0.0027,765.7,0.05,180,-0.03,-0.5\n0,0,0,768,0,0,-0.01,0\n",
      found);
  ASSERT_TRUE(targets) << to_string(found.at(0));
  ASSERT_EQ(targets->poses.size(), 2u);
  const CarrierTarget& pose = targets->poses[0];
  EXPECT_DOUBLE_EQ(pose.rack, 0.025);
  EXPECT_DOUBLE_EQ(pose.centre.y, 0.7657);
  EXPECT_DOUBLE_EQ(pose.angles.toe, M_PI);
  EXPECT_DOUBLE_EQ(pose.angles.camber, -0.03);
  EXPECT_DOUBLE_EQ(pose.angles.carrier_pitch, -0.5 * M_PI / 180);
  EXPECT_TRUE(carrier_pitch_is_given(*targets));
}

TEST(CarrierPoses, CarrierPitchMayBeLeftOut) {
  Diagnostics found;
  const auto targets = read("centre_x_m,centre_y_m,centre_z_m,toe_deg,camber_deg\n0,0.768,0.1,0,0\n", found);
  ASSERT_TRUE(targets);
  EXPECT_FALSE(carrier_pitch_is_given(*targets));
  EXPECT_EQ(targets->poses[0].rack, 0);
}

TEST(CarrierPoses, AllProblemsOfATableAreTold) {
  Diagnostics found;
  EXPECT_FALSE(read("travel_m,centre_x_m,centre_y_deg,centre_z_m,toe_deg,steer_deg\n0,,0.7,0,0,0\n", found));
  std::vector<std::string> texts;
  for (const Diagnostic& d : found) texts.push_back(to_string(d));
  EXPECT_THAT(texts, ElementsAre(HasSubstr("centre_y_deg: needs the unit of a length; write centre_y_m"),
                                 HasSubstr("steer_deg: unknown column; columns are travel, rack,"),
                                 HasSubstr("centre_x_m: row 1 holds no number"),
                                 HasSubstr("camber: column is missing; add camber_rad")));
  found.clear();
  EXPECT_FALSE(
      read("travel_m,centre_x_m,centre_y_m,centre_z_m,toe_deg,camber_deg\n0.02,0,0.7,0.01,0,0\n", found));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message, "row 1: travel 0.02 m, but the centre is 0.01 m above the reference");
}

}  // namespace
}  // namespace linkwright::suspension
