// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/geneva.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::problems_of;
using test::replaced;
using test::run_text;
using ::testing::HasSubstr;

// Slots; crank by the distance of the axes, greatest speed ratio, greatest acceleration and its place (deg
// from the middle), acceleration at the entry, share of a turn in which the wheel moves.
struct Row {
  int slots;
  double crank, ratio, acceleration, place, entry, share;
};
constexpr Row rows[] = {
    {3, 0.8660254037844386, 6.4641016151377215, 31.39242847028085, 4.758213118266372, 1.7320508075688748,
     1.0 / 6},
    {4, 0.7071067811865475, 2.4142135623730923, 5.4069810345519125, 11.463745431315175, 1.0, 0.25},
    {5, 0.5877852522924731, 1.4259199981595918, 2.2988282396241364, 17.571444353372296, 0.726542528005361,
     0.3},
    {6, 0.49999999999999994, 0.9999999999999996, 1.349637275901902, 22.90306186582177, 0.5773502691896254,
     1.0 / 3},
    {12, 0.25881904510252074, 0.3491981862085499, 0.34765499216415147, 44.004641266992444, 0.2679491924311227,
     5.0 / 12}};

bool moves(const GenevaSlots& wheel, double crank) { return geneva_motion(wheel, crank)[1] != 0; }

TEST(Geneva, ExternalWheelsHaveTheirRatiosAndAccelerations) {
  for (const Row& row : rows) {
    const GenevaSlots wheel{row.slots, false};
    EXPECT_NEAR(geneva_crank(wheel, 1), row.crank, 1e-15);
    EXPECT_NEAR(-geneva_motion(wheel, 0)[1], row.ratio, 1e-12);
    const double place = row.place * pi / 180, entry = row.share * pi;
    EXPECT_NEAR(std::abs(geneva_motion(wheel, place)[2]), row.acceleration, 1e-10);
    EXPECT_NEAR(geneva_motion(wheel, place)[3], 0, 1e-9);
    EXPECT_NEAR(std::abs(geneva_motion(wheel, entry - 1e-12)[2]), row.entry, 1e-9);
    EXPECT_TRUE(moves(wheel, entry - 1e-9));
    EXPECT_FALSE(moves(wheel, entry + 1e-9));
    EXPECT_EQ(geneva_motion(wheel, entry + 1e-9)[2], 0);
  }
}

TEST(Geneva, StepsByOneSlotForEachTurnWithoutGaps) {
  for (const bool internal : {false, true})
    for (const int slots : {3, 4, 7}) {
      const GenevaSlots wheel{slots, internal};
      const double step = (internal ? 1 : -1) * full_turn / slots;
      for (double crank = -7; crank < 7; crank += 0.01) {
        const auto now = geneva_motion(wheel, crank), next = geneva_motion(wheel, crank + full_turn);
        EXPECT_NEAR(next[0] - now[0], step, 1e-13);
        constexpr double h = 1e-5;
        const auto before = geneva_motion(wheel, crank - h), after = geneva_motion(wheel, crank + h);
        EXPECT_NEAR((after[0] - before[0]) / (2 * h), now[1], 1e-4);
        if (moves(wheel, crank - h) == moves(wheel, crank + h)) {
          EXPECT_NEAR((after[1] - before[1]) / (2 * h), now[2], 1e-7 * (1 + std::abs(now[3])));
          EXPECT_NEAR((after[2] - before[2]) / (2 * h), now[3], 1e-5 * (1 + std::abs(now[3])));
        }
      }
    }
}

/// Five slots, axes 120 mm apart, a wheel of 2.5e-3 kg m2, 90 rpm, from 20 degrees before the middle.
const std::string study = R"(schema = 1
kind = "analysis"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name = "ground"
points_mm = { A = [0, 0], B = [120, 0] }
[[mechanism.body]]
name = "crank"
points_mm = { A = [0, 0], pin = [70.53423027509677, 0] }
mass_kg = 0
inertia_kg_m2 = 0
[[mechanism.body]]
name = "wheel"
points_mm = { B = [0, 0] }
mass_kg = 0
inertia_kg_m2 = 2.5e-3
centre_mm = [0, 0]
[[mechanism.joint]]
name = "A"
first = "ground.A"
second = "crank.A"
[[mechanism.joint]]
name = "drive"
type = "geneva"
first = "crank.pin"
second = "wheel.B"
slots = 5
[[mechanism.joint]]
name = "B"
first = "ground.B"
second = "wheel.B"
[environment]
gravity_m_per_s2 = 0
[[drive]]
joint = "A"
speed_rpm = 90
[sweep]
type = "grid"
[[sweep.input]]
from_deg = -20
to_deg = 340
samples = 3
)";

TEST(Geneva, AccelerationsLoadPinAndCrank) {
  const study::Result r = run_text(study);
  ASSERT_EQ(r.status, Status::done);
  const Table& sweep = r.tables[0];
  const auto at = [&](const char* key, std::size_t row) { return sweep.find(key)->values.at(row); };
  // The wheel turns the other way: 24.18 degrees before the middle, where a slot points at the crank (180
  // degrees).
  EXPECT_NEAR(std::remainder(at("wheel_angle_rad", 0) - (pi + 24.183692917280943 * pi / 180), full_turn), 0,
              1e-12);
  EXPECT_NEAR(at("wheel_speed_rad_per_s", 0), -8.095278585190782, 1e-11);
  EXPECT_NEAR(at("wheel_acceleration_rad_per_s2", 0), -201.53717433358077, 1e-9);
  EXPECT_NEAR(at("A_drive_torque_N_m", 0), 0.4327687024282194, 1e-11);
  EXPECT_NEAR(std::abs(at("drive_tangential_N", 0)), 8.555999305615218, 1e-9);
  // The bearings carry the force of the pin alone: it is the only other force on each body.
  EXPECT_NEAR(at("B_N", 0), 8.555999305615218, 1e-9);
  EXPECT_NEAR(at("A_N", 0), 8.555999305615218, 1e-9);
  EXPECT_LT(std::abs(at("closure_residual_m", 0)), 1e-12);
  // Locked half a turn on, and one slot on after a turn.
  EXPECT_EQ(at("wheel_speed_rad_per_s", 1), 0);
  EXPECT_NEAR(std::remainder(at("wheel_angle_rad", 2) - at("wheel_angle_rad", 0) + full_turn / 5, full_turn),
              0, 1e-12);
}

TEST(Geneva, ADrawnWheelStandsAsItIsDrawn) {
  // The crank 20 degrees before the middle, the slot through the pin.
  std::string drawn = replaced(study, "type = \"planar.linkage\"", "type = \"planar.linkage\"\ndrawn = true");
  drawn = replaced(drawn, "pin = [70.53423027509677, 0]", "pin = [66.2804953, -24.1241274]");
  drawn = replaced(drawn, "points_mm = { B = [0, 0] }", "points_mm = { B = [120, 0] }");
  drawn = replaced(drawn, "centre_mm = [0, 0]", "centre_mm = [120, 0]");
  drawn = replaced(drawn, "from_deg = -20\nto_deg = 340", "from_deg = 0\nto_deg = 20");
  const study::Result r = run_text(drawn);
  ASSERT_EQ(r.status, Status::done);
  const Column& angle = *r.tables[0].find("wheel_angle_rad");
  EXPECT_NEAR(std::remainder(angle.values.at(0), full_turn), 0, 1e-8);
  EXPECT_NEAR(std::remainder(angle.values.at(2) + 24.183692917280943 * pi / 180, full_turn), 0, 1e-7);
}

TEST(Geneva, SaysWhichRadiusThePinNeeds) {
  EXPECT_THAT(problems_of(replaced(study, "pin = [70.53423027509677, 0]", "pin = [60, 0]")),
              HasSubstr("the pin of 'crank' is 60 mm from its axis: it would not enter 5 slots along them"));
  EXPECT_THAT(problems_of(replaced(study, "pin = [70.53423027509677, 0]", "pin = [60, 0]")),
              HasSubstr("takes a radius of 70.53423 mm"));
  EXPECT_THAT(problems_of(replaced(study, "slots = 5\n", "")),
              HasSubstr("the wheel of Geneva drive 'drive' has no slots"));
  EXPECT_THAT(problems_of(replaced(study, "slots = 5", "slots = 2")), HasSubstr("slots"));
}

}  // namespace
}  // namespace linkwright::planar
