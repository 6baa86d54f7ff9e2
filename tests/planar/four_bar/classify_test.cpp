// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/four_bars.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

bool within(const std::vector<AngleInterval>& intervals, double angle, double slack = 0) {
  return std::any_of(intervals.begin(), intervals.end(), [&](const AngleInterval& i) {
    for (const double turned : {angle, angle + 2 * pi, angle - 2 * pi})
      if (turned >= i.from - slack && turned <= i.to + slack) return true;
    return false;
  });
}

TEST(Classify, TypesInWordsEndWithTheirCode) {
  EXPECT_EQ(in_words(FourBarType::crank_rocker), "crank-rocker");
  EXPECT_EQ(in_words(FourBarType::triple_rocker_0pi),
            "non-Grashof, input through 0, output through pi (0pi)");
}

TEST(Classify, NamesThePublishedTypes) {
  const auto& rows = at(path_case("TYPES"), "computed.rows").as_array();
  ASSERT_EQ(rows.size(), 8u);
  for (const Value& row : rows) {
    const FourBarClass found = classify(four_bar(row));
    const std::string& type = at(row, "type").as_string();
    EXPECT_EQ(name_of(found.type), type);
    const bool grashof = type.find('-') != std::string::npos;
    EXPECT_EQ(found.grashof, grashof) << type;
    EXPECT_EQ(found.circuits, grashof ? 2 : 1) << type;
    EXPECT_EQ(found.crank_rotates_fully, type == "crank-rocker" || type == "double-crank") << type;
  }
}

TEST(Classify, MarginIsTheSmallestOfTheRotationConditions) {
  // 1.9 + 1.6 - 2.2 - 0.75 = 0.55 and (2.2 - 0.75) - (1.9 - 1.6) = 1.15.
  EXPECT_NEAR(classify({.ground = 2.2, .crank = 0.75, .coupler = 1.9, .rocker = 1.6}).crank_margin, 0.55,
              1e-15);
  // 1.3 + 1.1 - 0.6 - 1.4 = 0.4 and (1.4 - 0.6) - (1.3 - 1.1) = 0.6.
  EXPECT_NEAR(classify({.ground = 0.6, .crank = 1.4, .coupler = 1.3, .rocker = 1.1}).crank_margin, 0.4,
              1e-15);
  EXPECT_LT(classify({.ground = 1.9, .crank = 1.6, .coupler = 2.2, .rocker = 0.75}).crank_margin, 0);
}

TEST(Classify, ReportsAChangePointAsSuch) {
  for (const FourBar& l :
       {FourBar{.ground = 3, .crank = 1, .coupler = 2, .rocker = 2},  // T2 = T1 = 2, T3 = 0
        FourBar{.ground = 2, .crank = 1, .coupler = 2, .rocker = 1},  // parallelogram
        FourBar{.ground = 1, .crank = 1, .coupler = 3, .rocker = 3},  // kite
        FourBar{.ground = 1, .crank = 1, .coupler = 1, .rocker = 1}}) {
    const FourBarClass found = classify(l);
    EXPECT_EQ(found.type, FourBarType::change_point);
    EXPECT_TRUE(found.grashof);
    EXPECT_EQ(found.circuits, 1);
    EXPECT_TRUE(found.crank_rotates_fully);
    EXPECT_EQ(found.crank_margin, 0);
  }
  // A millionth beside it is the neighbour's type, unless the tolerance says otherwise.
  const FourBar beside{.ground = 3, .crank = 1, .coupler = 2 + 1e-6, .rocker = 2};
  EXPECT_EQ(classify(beside).type, FourBarType::crank_rocker);
  EXPECT_EQ(classify(beside, 1e-6).type, FourBarType::change_point);
}

TEST(Classify, InputLimitsByFormula) {
  // 00: both limits count. Crank 2 against ground 1.9, coupler 1.2, rocker 0.6.
  const auto limit = [](const FourBar& l, double distance) {
    return std::acos((l.ground * l.ground + l.crank * l.crank - distance * distance) /
                     (2 * l.ground * l.crank));
  };
  const FourBar both{.ground = 1.9, .crank = 2.0, .coupler = 1.2, .rocker = 0.6};
  const auto two = classify(both).inputs;
  ASSERT_EQ(two.size(), 2u);
  EXPECT_NEAR(two[1].from, limit(both, 0.6), 1e-14);
  EXPECT_NEAR(two[1].to, limit(both, 1.8), 1e-14);
  EXPECT_EQ(two[0].from, -two[1].to);
  EXPECT_EQ(two[0].to, -two[1].from);
  // Only the stretched limit: the arc round the ground link.
  const FourBar outer{.ground = 2, .crank = 1.5, .coupler = 1.2, .rocker = 1.1};
  const auto one = classify(outer).inputs;
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one[0].to, limit(outer, 2.3), 1e-14);
  EXPECT_EQ(one[0].from, -one[0].to);
  // Only the folded limit: the arc away from it.
  const FourBar inner{.ground = 2, .crank = 1.5, .coupler = 3.1, .rocker = 1.1};
  const auto back = classify(inner).inputs;
  ASSERT_EQ(back.size(), 1u);
  EXPECT_NEAR(back[0].from, limit(inner, 2.0), 1e-14);
  EXPECT_NEAR(back[0].to, 2 * pi - back[0].from, 1e-14);
}

TEST(Classify, ALinkLongerThanTheOthersTogetherNeverAssembles) {
  for (const FourBar& l :
       {FourBar{.ground = 10}, FourBar{.crank = 10}, FourBar{.coupler = 10}, FourBar{.rocker = 10}}) {
    const FourBarClass found = classify(l);
    EXPECT_EQ(found.circuits, 0);
    EXPECT_TRUE(found.inputs.empty());
    EXPECT_FALSE(found.crank_rotates_fully);
    EXPECT_FALSE(found.grashof);
  }
}

TEST(Classify, RejectsWhatIsNoLinkage) {
  EXPECT_THAT([] { classify({.ground = -1}); }, ThrowsMessage<ContractError>(HasSubstr("got ground -1")));
  EXPECT_THAT([] { classify({}, -1e-3); },
              ThrowsMessage<ContractError>(HasSubstr("tolerance must not be negative, got -0.001")));
  EXPECT_THAT([] { transmission_angles({}, 1, 0.5); },
              ThrowsMessage<ContractError>(HasSubstr("the arc must run upwards, got 1 to 0.5")));
  EXPECT_THAT([] { transmission_angles({.crank = 0}); },
              ThrowsMessage<ContractError>(HasSubstr("link lengths must be positive")));
}

constexpr int samples = 2000;

RC_GTEST_PROP(Classify, InputsAreTheAnglesThatAssemble, ()) {
  const FourBar l = *any_four_bar();
  const auto found = classify(l);
  for (int i = 0; i < samples; ++i) {
    const double angle = -pi + 2 * pi * i / samples;
    const bool assembles = position(l, angle).status != Status::no_assembly;
    // Next to a limit both answers are right.
    if (assembles) RC_ASSERT(within(found.inputs, angle, 1e-6));
    if (!assembles) RC_ASSERT(!within(found.inputs, angle, -1e-6));
  }
  for (const AngleInterval& interval : found.inputs) RC_ASSERT(interval.from < interval.to);
  RC_ASSERT(found.inputs.empty() == (found.circuits == 0));
}

RC_GTEST_PROP(Classify, RotatesFullyWhenEveryAngleAssembles, ()) {
  const bool turning = *rc::gen::arbitrary<bool>();
  const FourBar l = turning ? *turning_four_bar() : *any_four_bar();
  const auto found = classify(l);
  if (turning) RC_ASSERT(found.crank_rotates_fully);
  RC_PRE(std::abs(found.crank_margin) > 1e-9);
  bool everywhere = true;  // the distance of A and B0 is extreme where crank and ground are in line
  for (int i = 0; i <= samples; ++i)
    everywhere = everywhere && position(l, pi * i / samples).status != Status::no_assembly;
  RC_ASSERT(found.crank_rotates_fully == everywhere);
  RC_ASSERT(found.crank_rotates_fully == (found.crank_margin >= 0));
  if (everywhere) {
    RC_ASSERT(found.inputs.size() == 1u);
    RC_ASSERT(std::abs(found.inputs[0].to - found.inputs[0].from - 2 * pi) < 1e-15);
    RC_ASSERT(found.type == FourBarType::crank_rocker || found.type == FourBarType::double_crank);
  }
}

// Circuits by their meaning: the branches meet at a toggle that the motion can reach, or they never do.
RC_GTEST_PROP(Classify, TwoCircuitsWhenNoLinkIsInLineWithinReach, ()) {
  const FourBar l = *any_four_bar();
  const auto found = classify(l);
  RC_PRE(found.circuits > 0 && found.type != FourBarType::change_point);
  double lengths[4] = {l.ground, l.crank, l.coupler, l.rocker};
  std::sort(lengths, lengths + 4);
  const bool grashof = lengths[0] + lengths[3] < lengths[1] + lengths[2];
  RC_ASSERT(found.grashof == grashof);
  RC_ASSERT(found.circuits == (grashof ? 2 : 1));
}

TransmissionAngles scanned(const FourBar& l, double from, double to) {
  TransmissionAngles out{pi, 0};
  for (int i = 0; i <= samples; ++i) {
    const auto pose = position(l, from + (to - from) * i / samples);
    const double mu = pose.status == Status::no_assembly ? 0 : pose.transmission_angle;
    out.minimum = std::min(out.minimum, mu);
    out.maximum = std::max(out.maximum, mu);
  }
  return out;
}

// A scan misses an extreme by at most one step of the angle: |d mu / d theta| = L1 L2 |sin theta| /
// (L3 L4 sin mu), and at the right angle it misses the top of a kink of that slope.
double scan_error(const FourBar& l, double arc, double mu_min) {
  return 1e-9 +
         arc / samples * l.ground * l.crank / (l.coupler * l.rocker * std::max(std::sin(mu_min), 1e-3));
}

RC_GTEST_PROP(TransmissionAngles, OverAFullTurnAsSampled, ()) {
  const FourBar l = *turning_four_bar();
  const auto found = transmission_angles(l), expected = scanned(l, 0, 2 * pi);
  const double slack = scan_error(l, 2 * pi, found.minimum);
  RC_ASSERT(found.minimum <= expected.minimum + 1e-9);
  RC_ASSERT(found.minimum >= expected.minimum - 1e-6);  // at 0 or pi, which the scan meets
  RC_ASSERT(found.maximum >= expected.maximum - 1e-9);
  RC_ASSERT(found.maximum <= expected.maximum + slack);
}

RC_GTEST_PROP(TransmissionAngles, OverAnArcAsSampled, ()) {
  const FourBar l = *turning_four_bar();
  const double from = *any_angle(), to = from + *between(0, 8);
  const auto found = transmission_angles(l, from, to), expected = scanned(l, from, to);
  const double slack = scan_error(l, to - from, found.minimum);
  RC_ASSERT(found.minimum <= expected.minimum + 1e-9 && found.minimum >= expected.minimum - slack);
  RC_ASSERT(found.maximum >= expected.maximum - 1e-9 && found.maximum <= expected.maximum + slack);
}

TEST(TransmissionAngles, OfALinkageThatDoesNotTurn) {
  // Both limits are toggles, between them the angle passes 90 degrees: 1.2^2 + 0.6^2 lies within.
  const auto found = transmission_angles({.ground = 1.9, .crank = 2.0, .coupler = 1.2, .rocker = 0.6});
  EXPECT_EQ(found.minimum, 0);
  EXPECT_EQ(found.maximum, pi / 2);
}

RC_GTEST_PROP(Classify, AnswersAnyInput, ()) {
  const auto wild = rc::gen::oneOf(log_between(1e-300, 1e300), log_between(1e-69, 1e69), rc::gen::just(nan),
                                   rc::gen::just(-1.0), rc::gen::just(1.0));
  const FourBar l{.ground = *wild, .crank = *wild, .coupler = *wild, .rocker = *wild};
  try {
    const auto found = classify(l);
    RC_ASSERT(std::isfinite(found.crank_margin));
    for (const AngleInterval& i : found.inputs) RC_ASSERT(std::isfinite(i.from) && std::isfinite(i.to));
    const auto mu = transmission_angles(l);
    RC_ASSERT(0 <= mu.minimum && mu.minimum <= mu.maximum && mu.maximum <= pi / 2);
  } catch (const ContractError&) {
    const auto usable = [](double length) { return length >= shortest_link && length <= max_link; };
    RC_ASSERT(!(usable(l.ground) && usable(l.crank) && usable(l.coupler) && usable(l.rocker)));
  }
}

}  // namespace
}  // namespace linkwright::planar
