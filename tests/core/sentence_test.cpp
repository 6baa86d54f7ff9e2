// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/sentence.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright {
namespace {

TEST(Sentence, IsTextWithNumbersInIt) {
  const Sentence s = say("{} at {}, the largest of {}", newton_metres(5.5671234, 4), degrees_of(pi), 12);
  EXPECT_EQ(to_string(s), "5.567 N m at 180°, the largest of 12");
  ASSERT_TRUE(s.value());
  EXPECT_EQ(s.value()->si, 5.5671234);
  EXPECT_EQ(s.value()->unit_words(), "N m");
  EXPECT_EQ(s.value()->dimension, Dimension::torque);
}

TEST(Sentence, NumbersAreWrittenAsTheirAuthorWants) {
  EXPECT_EQ(to_string(millimetres(0.50308, 5)), "503.08 mm");
  EXPECT_EQ(to_string(millimetres(0.5).fixed(1)), "500.0 mm");
  EXPECT_EQ(to_string(degrees_of(-pi / 6).fixed(2).spelled()), "-30.00 deg");
  EXPECT_EQ(to_string(measured("m2", 0.25)), "0.25 m²");
  EXPECT_EQ(to_string(measured("m2", 0.25).spelled()), "0.25 m2");
  EXPECT_EQ(to_string(measured("rad_per_s2", 3)), "3 rad/s²");
  EXPECT_EQ(to_string(measured("deg_per_m", pi)), "180 °/m");
  EXPECT_EQ(to_string(percent(0.1234, 3)), "12.3 %");
  EXPECT_EQ(to_string(plain_number(2.5).with_sign()), "+2.5");
  EXPECT_EQ(to_string(millimetres(-0.0)), "0 mm");
  EXPECT_EQ(to_string(length_by_size(1.25)), "1.25 m");
  EXPECT_EQ(to_string(length_by_size(0.0125)), "12.5 mm");
  EXPECT_EQ(to_string(length_by_size(3.14159e-6)), "3.14 µm");
  EXPECT_EQ(to_string(count_of(1234567)), "1234567");
  EXPECT_THROW((void)measured("furlong", 1), ContractError);
}

TEST(Sentence, NumbersMayHaveUnitsOfTheirOwn) {
  constexpr Unit turn_by_turn{"deg_per_deg"}, by_kilonewton{"deg_per_kN", pi, 180e3};
  EXPECT_EQ(to_string(measured(turn_by_turn, 0.25)), "0.25 °/°");
  EXPECT_EQ(to_string(measured(by_kilonewton, pi / 180e3).fixed(2)), "1.00 °/kN");
  EXPECT_EQ(measured(by_kilonewton, 0).unit_words(), "deg/kN");
}

TEST(Sentence, NumbersOfOneUnitShareIt) {
  const Sentence s = say("{} x {}", millimetres(0.50308, 5).sharing_unit(), millimetres(0.22832, 5));
  EXPECT_EQ(to_string(s), "503.08 x 228.32 mm");
}

TEST(Sentence, IsJoinedFromOthers) {
  Sentence s = "first";
  s += say(", then {}", seconds(0.5));
  s += " and last";
  EXPECT_EQ(to_string(s), "first, then 0.5 s and last");
  EXPECT_EQ(s.parts().size(), 3u);
  EXPECT_EQ(to_string(say("({})", s)), "(first, then 0.5 s and last)");
  EXPECT_TRUE(Sentence().empty());
  EXPECT_TRUE(Sentence("").empty());
  EXPECT_EQ(to_string(say("no number")), "no number");
}

TEST(Sentence, ItsValueIsNoPlace) {
  const Sentence s =
      say("at {}: {}", at_place(std::string("crank") + "_angle", degrees_of(pi / 2)), newtons(3));
  ASSERT_TRUE(s.value());
  EXPECT_EQ(s.value()->si, 3);
  EXPECT_EQ(std::get<Measured>(s.parts()[1]).place_key(), "crank_angle_deg");
  EXPECT_EQ(at_place("use", percent(0.5)).place_key(), "use_percent");
  EXPECT_EQ(at_place("point", count_of(7)).place_key(), "point");
  EXPECT_FALSE(Sentence("no number").value());
}

TEST(Sentence, NumbersKeepTheirDigitsInOtherUnits) {
  const Unit& inch = *find_unit(Dimension::length, "in");
  EXPECT_EQ(to_string(millimetres(0.50308, 5).in(inch)), "19.806 in");
  EXPECT_EQ(to_string(millimetres(0.254).fixed(1).in(inch)), "10 in");
  EXPECT_EQ(to_string(millimetres(0.00254).fixed(2).in(inch)), "0.1 in");
}

}  // namespace
}  // namespace linkwright
