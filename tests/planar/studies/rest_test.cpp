// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/rest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "linkwright/core/numbers.h"
#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

std::string template_text() { return std::string(rest_kind().example); }

TEST(RestStudy, TellsPositionsWithTheirFrequencies) {
  const study::Result result = run_text(template_text());
  ASSERT_EQ(result.status, Status::done);
  const std::vector<double>& stable = column(result, "rest", "stable");
  ASSERT_EQ(result.statistics.find("stable")->as_number(), 1);
  EXPECT_THAT(to_string(result.headline), HasSubstr("O rests stably at"));
  EXPECT_EQ(stable.size(), column(result, "rest", "frequency_Hz").size());
  EXPECT_THAT(fact(result, "range"), HasSubstr("-80"));
  ASSERT_EQ(result.scenes.size(), 1u);
  EXPECT_EQ(result.scenes[0].input.size(), stable.size());
  EXPECT_FALSE(column(result, "forces", "torque_N_m").empty());
}

// The lamp of the examples: its first arm alone is free.
std::string two_arms() {
  return replaced(
      replaced(template_text(), "[[mechanism.joint]]",
               "[[mechanism.body]]\nname = \"hand\"\npoints_mm = { B = [0, 0], C = [200, 0] }\nmass_kg = "
               "0.3\n[[mechanism.joint]]\nname = \"B\"\nfirst = \"arm.B\"\nsecond = \"hand.B\"\n"
               "[[mechanism.joint]]"),
      "[rest]", "[[drive]]\njoint = \"B\"\nstart_deg = -90.0\n[rest]");
}

TEST(RestStudy, OtherJointsAreHeld) {
  const study::Result result = run_text(two_arms());
  ASSERT_EQ(result.status, Status::done);
  EXPECT_GE(result.tables[0].rows(), 1u);
  EXPECT_THAT(problems_of(replaced(two_arms(), "free  = true", "")), HasSubstr("no joint is free to move"));
}

TEST(RestStudy, SeveralFreeJointsAreSearchedFromAGrid) {
  std::string text = replaced(two_arms(), "start_deg = -90.0", "free = true");
  EXPECT_THAT(problems_of(text), HasSubstr("it is for one free joint, and 2 are free"));
  text = replaced(replaced(text, "from_deg = -80.0", "starts = 10"), "to_deg   = 80.0", "");
  const study::Result result = run_text(text);
  ASSERT_EQ(result.status, Status::done);
  EXPECT_THAT(fact(result, "search"), HasSubstr("100 starts"));
  const std::vector<double>& stable = column(result, "rest", "stable");
  ASSERT_GE(stable.size(), 4u);
  EXPECT_EQ(column(result, "rest", "vibration_2_frequency_Hz").size(), stable.size());
  EXPECT_THAT(to_string(result.headline), HasSubstr("rest positions"));
  EXPECT_THAT(problems_of(replaced(text, "starts = 10", "starts = 2000")), HasSubstr("at most 1000"));
  EXPECT_THAT(problems_of(replaced(template_text(), "from_deg = -80.0", "from_deg = -80.0\nstarts = 9")),
              HasSubstr("they are for several free joints"));
}

TEST(RestStudy, WrongInputIsNamed) {
  const auto wrong = [](const std::string& what, const std::string& by) {
    return problems_of(replaced(template_text(), what, by));
  };
  EXPECT_THAT(wrong("to_deg   = 80.0", ""), HasSubstr("the range has one end alone"));
  EXPECT_THAT(wrong("to_deg   = 80.0", "to_deg = -90"), HasSubstr("the range ends before it begins"));
  EXPECT_THAT(wrong("[rest]",
                    "[[mechanism.torque]]\nname = \"t\"\nbody = \"arm\"\ntorque_N_m = 1.0\nagainst = "
                    "\"time\"\nargument = [0, 1]\nfactor = [0, 1]\n[rest]"),
              HasSubstr("torque 't' goes by time"));
}

TEST(RestStudy, SaysWhereNothingRests) {
  const std::string fallen =
      replaced(template_text(), "stiffness_N_per_mm = 0.22", "stiffness_N_per_mm = 0.0");
  const study::Result pressed = run_text(fallen);
  EXPECT_EQ(to_string(pressed.headline), "O rests at the ends of its range alone, at -80°.");
  const std::string driven =
      replaced(replaced(replaced(fallen, "from_deg = -80.0", ""), "to_deg   = 80.0", ""), "[rest]",
               "[[mechanism.torque]]\nname = \"t\"\nbody = \"arm\"\ntorque_N_m = 20.0\n[rest]");
  const study::Result nothing = run_text(driven);
  EXPECT_THAT(to_string(nothing.headline),
              HasSubstr("Nothing rests from -180 deg to 180 deg: the torque goes from"));
  EXPECT_THAT(lines_of(nothing.diagnostics), HasSubstr("add a stop, or a spring"));
}

}  // namespace
}  // namespace linkwright::planar
