// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_holding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

// The lever of tests/published that carries 1000 N, with an effort that is to be found.
const std::string lever = R"(
schema = 1
kind   = "analysis"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name      = "ground"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name      = "lever"
points_mm = { O = [0, 0], L = [80, 0], E = [0, 300] }
mass_kg   = 0.0
[[mechanism.joint]]
name          = "O"
first         = "ground.O"
second        = "lever.O"
friction      = 0.25
pin_radius_mm = 20.0
[[mechanism.force]]
name            = "load"
point           = "lever.L"
force_N         = [0, -1000]
turns_with_body = true
[[mechanism.force]]
name            = "effort"
point           = "lever.E"
force_N         = [-1, 0]
turns_with_body = true
[drive]
joint     = "O"
speed_rpm = 10.0
[[sweep.input]]
joint    = "O"
from_deg = 0.0
to_deg   = 90.0
samples  = 3
[holding]
load = "effort"
)";

TEST(LinkageHolding, ColumnsAndFactsOfALoad) {
  const study::Result result = run_text(lever);
  ASSERT_EQ(result.status, Status::done);
  // The forces turn with the lever, so that all positions are alike.
  for (const double v : column(result, "holding_least_N")) EXPECT_NEAR(v, 249.489123, 1e-6);
  for (const double v : column(result, "holding_greatest_N")) EXPECT_NEAR(v, 283.992400, 1e-6);
  EXPECT_THAT(fact(result, "greatest that holds"), HasSubstr("283.99 N"));
  EXPECT_THAT(fact(result, "locks by itself"), HasSubstr("nowhere; its margin is"));
}

// An arm of two bars that brakes hold: the load at its tip, and its margin.
const std::string braked = R"(
schema = 1
kind   = "analysis"
[mechanism]
type = "planar.linkage"
[[mechanism.body]]
name      = "ground"
points_mm = { O = [0, 0] }
[[mechanism.body]]
name      = "upper"
points_mm = { O = [0, 0], A = [500, 0] }
mass_kg   = 2.0
[[mechanism.body]]
name      = "fore"
points_mm = { A = [0, 0], tip = [400, 0] }
mass_kg   = 1.5
[[mechanism.joint]]
name                = "shoulder"
first               = "ground.O"
second              = "upper.O"
friction_torque_N_m = 18.0
[[mechanism.joint]]
name                = "elbow"
first               = "upper.A"
second              = "fore.A"
friction_torque_N_m = 6.0
[[mechanism.force]]
name    = "W"
point   = "fore.tip"
force_N = [0, -1]
[[drive]]
joint = "shoulder"
[[drive]]
joint = "elbow"
[[sweep.input]]
joint    = "shoulder"
from_deg = 40.0
to_deg   = 60.0
samples  = 2
[[sweep.input]]
joint    = "elbow"
from_deg = -60.0
to_deg   = -30.0
samples  = 2
[holding]
load = "W"
)";

TEST(LinkageHolding, SeveralJointsHoldALoad) {
  const study::Result result = run_text(braked);
  ASSERT_EQ(result.status, Status::done);
  EXPECT_NEAR(column(result, "holding_least_N")[0], -23.32016658713868, 1e-8);
  EXPECT_NEAR(column(result, "holding_greatest_N")[0], 7.696495259840608, 1e-8);
  EXPECT_NEAR(column(result, "self_locking_margin")[0], 1.48036841906272, 1e-8);
  // The shoulder bears 18 N m of 2 g 0.5 cos 40 / 2 + 1.5 g (0.5 cos 40 + 0.2 cos 10) = 12.29 N m.
  EXPECT_THAT(fact(result, "locks by itself"),
              HasSubstr("in 4 of 4 positions; the least margin is 1.464 at 40"));
  EXPECT_THAT(problems_of(replaced(braked, "load = \"W\"", "drive = \"elbow\"")),
              HasSubstr("the linkage has 2 inputs; a drive alone holds one input"));
}

TEST(LinkageHolding, ColumnsOfADrive) {
  const study::Result result = run_text(replaced(lever, "load = \"effort\"", "drive = \"O\""));
  const std::vector<double>&least = column(result, "holding_least_N_m"),
        &greatest = column(result, "holding_greatest_N_m");
  // The load of 1000 N at 80 mm, the effort of 1 N at 300 mm, and the pin with the force of both.
  const double torque = 80 - 0.3, pin = 0.25 * 0.02 * std::hypot(1000.0, 1.0);
  EXPECT_NEAR(least[0], torque - pin, 1e-9);
  EXPECT_NEAR(greatest[0], torque + pin, 1e-9);
}

TEST(LinkageHolding, WrongInputIsNamed) {
  const auto wrong = [](const std::string& by) {
    return problems_of(replaced(lever, "load = \"effort\"", by));
  };
  EXPECT_THAT(wrong("load = \"efort\""), HasSubstr("there is no force 'efort'"));
  EXPECT_THAT(wrong("drive = \"A\""), HasSubstr("the drive is at 'O', not at 'A'"));
  EXPECT_THAT(wrong("drive = \"O\"\nload = \"effort\""), HasSubstr("one of them is unknown"));
  EXPECT_THAT(problems_of(replaced(lever, "[-1, 0]", "[0, 0]")), HasSubstr("has no direction"));
}

}  // namespace
}  // namespace linkwright::planar
