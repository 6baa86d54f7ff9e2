#include "linkwright/planar/linkage_trace.h"

#include <cmath>
#include <numbers>

#include "linkwright/core/check.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

constexpr double pi = std::numbers::pi;
const std::vector<double> at_zero{0};

TEST(LinkageTrace, FindsWhatClosedFormsHave) {
  // Triple rocker, crank-rocker, double rocker: all at once, as one general group.
  for (const Linkage& l : {four_bar_linkage(1, 1, 0.6, 0.7), four_bar_linkage(0.6, 0.1, 0.4, 0.32),
                           four_bar_linkage(1, 0.8, 0.3, 0.75)}) {
    const InputLimits closed = input_limits(planned(l), at_zero, 0, 0, 2 * pi);
    const InputLimits traced = trace_limits(planned(l, PlanRoute::all_at_once), at_zero, 0, 0, 2 * pi);
    ASSERT_EQ(traced.ranges.size(), closed.ranges.size());
    EXPECT_EQ(traced.circuits, closed.circuits);
    for (const InputRange& r : traced.ranges) {
      int same = 0;
      for (const InputRange& c : closed.ranges) {
        const bool turn = r.full_turn && c.full_turn;
        same += turn || (std::abs(std::remainder(r.from.value - c.from.value, 2 * pi)) < 1e-9 &&
                         std::abs(std::remainder(r.to.value - c.to.value, 2 * pi)) < 1e-9 &&
                         r.from.kind == c.from.kind && r.to.kind == c.to.kind);
      }
      EXPECT_EQ(same, 2) << r.from.value << " to " << r.to.value;  // both modes have the same range
    }
  }
}

TEST(LinkageTrace, LimitsOfAGroupWithoutClosedFormAreDeadPoints) {
  const Linkage linkage = three_legged_plate();
  const LinkagePlan p = planned(linkage);
  const InputLimits l = trace_limits(p, at_zero, 0, 0, 2 * pi);
  ASSERT_GE(l.ranges.size(), 2u);
  EXPECT_GE(l.circuits, 1);
  // Each limit ends two ranges or one at both sides.
  int ends = 0;
  for (const InputRange& r : l.ranges)
    ends += (r.from.kind == EndKind::limit) + (r.to.kind == EndKind::limit);
  EXPECT_EQ(ends % 2, 0);
  for (const InputRange& r : l.ranges) {
    if (r.to.kind != EndKind::limit) continue;
    EXPECT_THAT(r.to.groups, testing::ElementsAre(1));
    // On either side of a limit the number of modes differs by two.
    ModeSearch search;
    search.starts = 400;
    const auto count = [&](double x) {
      return assembly_modes(p, std::vector<double>{x}, search).found.size();
    };
    EXPECT_EQ(count(r.to.value - 1e-5), count(r.to.value + 1e-5) + 2) << r.to.value;
  }
}

TEST(LinkageTrace, StaysInTheIntervalThatIsAsked) {
  const LinkagePlan p = planned(four_bar_linkage(0.6, 0.1, 0.4, 0.32), PlanRoute::all_at_once);
  const InputLimits l = trace_limits(p, at_zero, 0, 0.5, 1.5);
  ASSERT_EQ(l.ranges.size(), 2u);
  for (const InputRange& r : l.ranges) {
    EXPECT_EQ(r.from.value, 0.5);
    EXPECT_EQ(r.to.value, 1.5);
    EXPECT_EQ(r.to.kind, EndKind::bound);
  }
  EXPECT_THROW(trace_limits(planned(four_bar_linkage(1, 1, 1, 1)), at_zero, 0, 0, 1), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
