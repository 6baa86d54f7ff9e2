// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/curve.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/modes.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

// Solved all at once, four-bars have the ranges and places of their closed form.
TEST(LinkageCurve, HasTheModesOfAFourBar) {
  for (const Linkage& l : {four_bar_linkage(1, 1, 0.6, 0.7), four_bar_linkage(0.6, 0.1, 0.4, 0.32),
                           four_bar_linkage(1, 0.8, 0.3, 0.75)}) {
    const LinkagePlan closed = planned(l), open = planned(l, PlanRoute::all_at_once);
    const std::vector<double> at_zero{0};
    const InputLimits limits = input_limits(closed, at_zero, 0, -pi, pi);
    for (const InputRange& range : limits.ranges) {
      const double start = range.from.value + 0.37 * (range.to.value - range.from.value);
      LinkageMotion m(closed), n(open);
      m.modes = range.modes;
      solve_position(closed, std::vector<InputMotion>{{start, 0, 0}}, m);
      ASSERT_EQ(m.status, Status::done);
      ModeCurve curve(open, along_input(at_zero, 0), start, m.parts, start - 2 * pi, start + 2 * pi, 2 * pi);
      EXPECT_EQ(curve.period() > 0, range.full_turn);
      EXPECT_FALSE(curve.lost());
      if (!range.full_turn) {
        EXPECT_NEAR(curve.low().value, range.from.value, 1e-10);
        EXPECT_NEAR(curve.high().value, range.to.value, 1e-10);
        EXPECT_EQ(curve.low().kind, EndKind::limit);
      }
      for (const double share : {1e-6, 0.01, 0.3, 0.77, 0.999999}) {
        const double value = range.from.value + share * (range.to.value - range.from.value);
        ASSERT_EQ(curve.place(value, n), Status::done);
        solve_position(closed, std::vector<InputMotion>{{value, 0, 0}}, m);
        for (std::size_t p = 1; p < m.parts.size(); ++p)
          EXPECT_LE(norm(m.parts[p].origin - n.parts[p].origin), 1e-10) << share;
      }
    }
  }
}

// A parallelogram goes through its flat positions smoothly, or ends there.
TEST(LinkageCurve, PassesChangePoints) {
  const Linkage l = four_bar_linkage(0.4, 0.1, 0.4, 0.1);
  const LinkagePlan closed = planned(l), open = planned(l, PlanRoute::all_at_once);
  const std::vector<double> at_zero{0};
  const double start = 1;
  LinkageMotion m(closed), n(open);
  solve_position(closed, std::vector<InputMotion>{{start, 0, 0}}, m);
  ModeCurve smooth(open, along_input(at_zero, 0), start, m.parts, start - 2 * pi, start + 2 * pi, 2 * pi);
  EXPECT_NEAR(smooth.period(), 2 * pi, 1e-12);
  ASSERT_EQ(smooth.change_points().size(), 2u);
  EXPECT_NEAR(smooth.change_points()[0], pi, 1e-6);
  EXPECT_NEAR(smooth.change_points()[1], 2 * pi, 1e-6);
  for (double value = -3; value < 10; value += 0.1) {
    ASSERT_EQ(smooth.place(value, n), Status::done);
    // The coupler stays parallel to the ground.
    EXPECT_NEAR(angle_of(n.parts[2].direction), 0, 1e-7) << value;
  }
  ModeCurve stop(open, along_input(at_zero, 0), start, m.parts, -4, 8, 0, AtChangePoint::stop);
  EXPECT_EQ(stop.low().kind, EndKind::change_point);
  EXPECT_NEAR(stop.low().value, 0, 1e-6);
  EXPECT_NEAR(stop.high().value, pi, 1e-6);
  EXPECT_EQ(stop.place(3.5, n), Status::limit_reached);
}

// Just not a parallelogram: what lies a hair's breadth beside each other is kept apart.
TEST(LinkageCurve, DoesNotLeapOverANarrowGap) {
  for (const double off : {1e-3, 1e-5, 1e-7, -1e-3, -1e-5, -1e-7}) {
    const Linkage l = four_bar_linkage(0.4, 0.1, 0.4, 0.1 + off);
    const LinkagePlan closed = planned(l), open = planned(l, PlanRoute::all_at_once);
    const std::vector<double> at_zero{0};
    const InputLimits limits = input_limits(closed, at_zero, 0, -pi, pi);
    const double start = 1;
    LinkageMotion m(closed), n(open);
    solve_position(closed, std::vector<InputMotion>{{start, 0, 0}}, m);
    const InputRange* range = range_at(limits, m.modes, start);
    ASSERT_TRUE(range);
    ModeCurve curve(open, along_input(at_zero, 0), start, m.parts, start - 2 * pi, start + 2 * pi, 2 * pi);
    EXPECT_TRUE(curve.change_points().empty()) << off;
    EXPECT_EQ(curve.period() > 0, range->full_turn) << off;
    if (!range->full_turn) {
      EXPECT_NEAR(curve.high().value, range->to.value, 1e-8) << off;
    }
  }
}

// Poses that are off are moved onto the joints by as little as can be, the input with them.
TEST(LinkageCurve, FindsTheNearestPlace) {
  const Linkage l = three_legged_plate();
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const AssemblyModes modes = assembly_modes(p, std::vector<double>{0.4});
  ASSERT_FALSE(modes.found.empty());
  std::vector<PartState<double>> parts = modes.found[0].parts;
  const std::vector<PartState<double>> exact = parts;
  for (std::size_t k = 1; k < parts.size(); ++k) parts[k].origin = parts[k].origin + math::Vec2{1e-3, -1e-3};
  double value = 0.4;
  ASSERT_TRUE(nearest_place(p, along_input(std::vector<double>{0.4}, 0), value, parts));
  EXPECT_NEAR(value, 0.4, 0.02);
  for (std::size_t k = 1; k < parts.size(); ++k) EXPECT_LE(norm(parts[k].origin - exact[k].origin), 0.02);
  m.parts = parts;
  solve_position(p, std::vector<InputMotion>{{value, 0, 0}}, m);
  EXPECT_EQ(m.status, Status::done);
  for (std::size_t k = 1; k < parts.size(); ++k) EXPECT_LE(norm(parts[k].origin - m.parts[k].origin), 1e-12);
}

}  // namespace
}  // namespace linkwright::planar
