// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/limits.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/samples.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

const std::vector<double> at_zero{0};

InputLimits turn_limits(const Linkage& l, double from = 0) {
  return input_limits(planned(l), at_zero, 0, from, from + 2 * pi);
}

TEST(LinkageLimits, AgreeWithTheClassificationOfFourBars) {
  for (std::uint32_t i = 0; i < 300; ++i) {
    RandomStream random({.seed = 7, .individual = i});
    double links[4];
    for (double& v : links) v = random.uniform(0.2, 1);
    const FourBarClass c =
        classify({.ground = links[0], .crank = links[1], .coupler = links[2], .rocker = links[3]});
    const InputLimits l = turn_limits(four_bar_linkage(links[0], links[1], links[2], links[3]));
    SCOPED_TRACE(i);
    ASSERT_EQ(l.ranges.size(), 2 * c.inputs.size());
    EXPECT_EQ(l.circuits, c.circuits);
    for (std::size_t r = 0; r < c.inputs.size(); ++r) {
      if (c.crank_rotates_fully) {
        EXPECT_TRUE(l.ranges[r].full_turn);
        continue;
      }
      // The same interval, in any turn and order. Limits near each other have flat slopes: square root of
      // rounding at worst.
      bool found = false;
      for (const InputRange& range : l.ranges)
        found = found || (std::abs(std::remainder(range.from.value - c.inputs[r].from, 2 * pi)) < 1e-9 &&
                          std::abs(std::remainder(range.to.value - c.inputs[r].to, 2 * pi)) < 1e-9 &&
                          range.from.kind == EndKind::limit && range.to.kind == EndKind::limit);
      EXPECT_TRUE(found) << c.inputs[r].from << " to " << c.inputs[r].to;
    }
  }
}

TEST(LinkageLimits, OfAParallelogramMeetAtChangePoints) {
  for (const double from : {0.0, -1.0, pi}) {
    const InputLimits l = turn_limits(four_bar_linkage(2, 1, 2, 1), from);
    ASSERT_EQ(l.ranges.size(), 4u);
    EXPECT_EQ(l.circuits, 1);
    for (const InputRange& r : l.ranges) {
      EXPECT_EQ(r.from.kind, EndKind::change_point);
      EXPECT_EQ(r.to.kind, EndKind::change_point);
      EXPECT_THAT(r.to.groups, ::testing::ElementsAre(1));
      EXPECT_NEAR(r.to.value - r.from.value, pi, 1e-14);
      EXPECT_NEAR(std::remainder(r.from.value, pi), 0, 1e-14);
    }
  }
}

TEST(LinkageLimits, OfARowOfRodsMeetAllAtOnce) {
  // Four combinations of modes, each from 0 to pi and on to 2 pi; outer pins coincide at pi in all of them.
  const InputLimits l = turn_limits(rod_row(3));
  EXPECT_EQ(l.circuits, 1);
  ASSERT_GE(l.ranges.size(), 8u);
  for (const InputRange& r : l.ranges) EXPECT_EQ(r.from.kind, EndKind::change_point);
}

TEST(LinkageLimits, OfAJansenLegTurnFullyAsItIsBuilt) {
  const Linkage leg = jansen_leg();
  const LinkagePlan p = planned(leg);
  const InputLimits l = turn_limits(leg);
  std::vector<double> modes;
  for (const Group& g : p.groups) modes.push_back(g.mode);
  const InputRange* r = range_at(l, modes, 1.0);
  ASSERT_NE(r, nullptr);
  EXPECT_TRUE(r->full_turn);
  EXPECT_EQ(to_string(assembly_range_text(l, modes)), "assembles over the full turn");
  EXPECT_EQ(mode_text(p, modes),
            "upper rod + upper plate minus, lower rod + lower rocker plus, side rod + foot plate minus");
}

TEST(LinkageLimits, EveryRangeAssemblesInsideAndNotOutside) {
  for (const Linkage& linkage :
       {jansen_leg(), whitworth_sample().linkage, four_bar_linkage(1, 0.9, 0.4, 0.5)}) {
    const LinkagePlan p = planned(linkage);
    const InputLimits l = input_limits(p, at_zero, 0, 0, 2 * pi);
    LinkageMotion m(p);
    for (const InputRange& range : l.ranges) {
      m.modes = range.modes;
      const auto status = [&](double x) {
        solve_position(p, std::vector<InputMotion>{{x, 0, 0}}, m);
        return m.status;
      };
      for (int i = 0; i <= 20; ++i) {
        // Nearer to a limit the pair counts as being at its dead point.
        const double inside = 1e-6 + (1 - 2e-6) * i / 20.0;
        EXPECT_EQ(status(range.from.value + inside * (range.to.value - range.from.value)), Status::done);
      }
      if (range.to.kind == EndKind::limit) {
        EXPECT_EQ(status(range.to.value + 1e-9), Status::no_assembly);
        EXPECT_THAT(range.to.groups, ::testing::ElementsAre(m.failed_group));
      }
    }
  }
}

TEST(LinkageLimits, CircuitsOfACrankRockerAreTwo) {
  const InputLimits l = turn_limits(four_bar_linkage(0.6, 0.1, 0.4, 0.32));
  ASSERT_EQ(l.ranges.size(), 2u);
  EXPECT_EQ(l.circuits, 2);
  EXPECT_EQ(l.ranges[0].modes[1], 1);
  EXPECT_EQ(l.ranges[1].modes[1], -1);
  EXPECT_NE(range_at(l, l.ranges[0].modes, 1234.5), nullptr);
}

TEST(LinkageLimits, InWords) {
  const Linkage linkage = four_bar_linkage(1, 1, 0.6, 0.7);
  const LinkagePlan p = planned(linkage);
  const std::vector<double> modes{1, 1};
  InputLimits l = input_limits(p, at_zero, 0, 0, pi);
  EXPECT_EQ(to_string(assembly_range_text(l, modes)), "assembles from 5.7 to 81.1 deg");
  EXPECT_EQ(to_string(assembly_range_text(turn_limits(linkage), modes)),
            "assembles from 5.7 to 81.1 deg and from 278.9 to 354.3 deg");
  EXPECT_EQ(to_string(assembly_range_text(input_limits(p, at_zero, 0, 2, 4), modes)),
            "assembles nowhere from 114.6 to 229.2 deg");
  EXPECT_EQ(to_string(assembly_range_text(turn_limits(four_bar_linkage(2, 1, 2, 1)), modes)),
            "assembles over the full turn");
  // Across the end of the turn, up to where coupler and rocker lie in line: law of cosines.
  const Linkage rocker = four_bar_linkage(0.4, 0.3, 0.25, 0.3);
  const double far = math::degrees(std::acos((0.16 + 0.09 - 0.55 * 0.55) / 0.24));
  EXPECT_EQ(to_string(assembly_range_text(turn_limits(rocker), modes)),
            fmt::format("assembles from {:.1f} to {:.1f} deg", -far, far));
  LinkageMotion m(p);
  solve_position(p, std::vector<InputMotion>{{math::radians(81.5), 0, 0}}, m);
  EXPECT_EQ(to_string(assembly_gap_text(p, m, 0, math::radians(81.5))),
            "at 81.5 deg short by 5.5 mm ('coupler + rocker')");
  solve_position(p, std::vector<InputMotion>{{1, 0, 0}}, m);
  EXPECT_EQ(to_string(assembly_gap_text(p, m, 0, 1)), "at 57.3 deg it assembles");
  // A hundred millimetres and more have no power of ten.
  const LinkagePlan large = planned(four_bar_linkage(100, 100, 60, 70));
  LinkageMotion gap(large);
  solve_position(large, std::vector<InputMotion>{{math::radians(81.5), 0, 0}}, gap);
  EXPECT_THAT(to_string(assembly_gap_text(large, gap, 0, math::radians(81.5))),
              ::testing::MatchesRegex("at 81.5 deg short by 5[0-9][0-9] mm .*"));
}

TEST(LinkageLimits, OfALinearInputAreLengths) {
  // An engine driven by its piston: dead centres are the limits.
  Linkage l = grounded({{"O", {0, 0}}, {"guide", {0, 0}}});
  add_body(l, "piston", {{"B", {0, 0}}});
  add_bar(l, "rod", "B", "A", 0.15);
  add_bar(l, "crank", "O", "A", 0.05);
  add_slide(l, "guide", "ground.guide", "piston.B");
  add_pin(l, "B", "piston.B", "rod.B");
  add_pin(l, "A", "rod.A", "crank.A");
  add_pin(l, "O", "ground.O", "crank.O");
  add_drive(l, "guide");
  const LinkagePlan p = planned(l);
  const InputLimits limits = input_limits(p, at_zero, 0, -1, 1);
  ASSERT_EQ(limits.ranges.size(), 4u);  // right and left of the pivot, in two modes each
  EXPECT_EQ(limits.circuits, 2);
  EXPECT_NEAR(limits.ranges[1].from.value, 0.1, 1e-15);
  EXPECT_NEAR(limits.ranges[1].to.value, 0.2, 1e-15);
  EXPECT_EQ(to_string(assembly_range_text(limits, limits.ranges[0].modes)),
            "assembles from -200 to -100 mm and from 100 to 200 mm");
  EXPECT_THROW(input_limits(p, at_zero, 0, 1, 1), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
