// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/defects.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "planar/slider_crank_path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The interval against a walk in small steps from the angle, both ways.
TEST(SliderPathDefects, TheCrankReachesWhatAWalkReaches) {
  RandomStream r({.seed = 8});
  int some = 0, none = 0;
  for (int i = 0; i < 400; ++i) {
    SliderCrankMechanism m;
    m.parameters = {.crank = r.uniform(0.3, 1),
                    .rod = r.uniform(0.2, 1.2),
                    .offset = r.uniform(-1, 1),
                    .guide_angle = r.uniform(-4, 4)};
    const double angle = r.uniform(-9, 9);
    const auto interval = SliderCrankPath::reach(m, angle);
    if (slider_crank_pose(m, angle).status == Status::no_assembly) {
      EXPECT_FALSE(interval);
      ++none;
      continue;
    }
    ASSERT_TRUE(interval);
    if (rotation_margin(m.parameters) >= 0) {
      EXPECT_NEAR(interval->to - interval->from, 2 * pi, 1e-12);
      continue;
    }
    ++some;
    const double step = 1e-3;
    double low = angle, high = angle;
    while (slider_crank_pose(m, low - step).status != Status::no_assembly) low -= step;
    while (slider_crank_pose(m, high + step).status != Status::no_assembly) high += step;
    EXPECT_NEAR(interval->from, low, 1.01 * step);
    EXPECT_NEAR(interval->to, high, 1.01 * step);
  }
  EXPECT_GT(some, 100);
  EXPECT_GT(none, 50);
}

TEST(SliderPathDefects, TellsAssemblyCircuitAndOrder) {
  SliderPathProblem p = printed_eighteen_slider_points();
  const SliderCrankMechanism good = slider_crank(at(path_case("T4.2"), "inputs.design"));
  EXPECT_THAT(defects(p, measure(p, good, 1, angles_of(p, 0.53607))), IsEmpty());

  SliderCrankMechanism shorter = good;
  shorter.parameters.rod = 0.35;
  const auto apart = defects(p, measure(p, shorter, 1, angles_of(p, 0.53607)));
  ASSERT_FALSE(apart.empty());
  EXPECT_EQ(apart[0].kind, DefectKind::assembly);
  EXPECT_THAT(to_string(apart[0].text), HasSubstr("too short to reach the guide"));

  p.timing = Timing::free;
  p.crank_rotates_fully = p.closed = false;
  auto angles = angles_of(p, 0.53607);
  std::swap(angles[3], angles[4]);
  const auto disordered = defects(p, measure(p, good, 1, angles));
  ASSERT_EQ(disordered.size(), 1u);
  EXPECT_EQ(disordered[0].kind, DefectKind::order);

  // Guide at 0, offset 0, rod shorter than the crank: two pieces around 0 and pi, no way between them.
  SliderPathProblem three;
  three.x = {0, 1, 2}, three.y = {0, 1, 0};
  three.bounds = derive_slider_bounds(three.x, three.y);
  three.timing = Timing::free;
  three.closed = three.crank_rotates_fully = false;
  SliderCrankMechanism rocking;
  rocking.parameters = {.crank = 1, .rod = 0.5};
  const auto parted = defects(three, measure(three, rocking, 1, {-0.2, 0.2, pi}));
  ASSERT_EQ(parted.size(), 1u);
  EXPECT_EQ(parted[0].kind, DefectKind::circuit);
  EXPECT_THAT(to_string(parted[0].text), HasSubstr("from point 2 to point 3"));
  // The rod square to the guide: its modes meet.
  const auto square = defects(three, measure(three, rocking, 1, {-0.2, 0.2, pi / 6}));
  ASSERT_EQ(square.size(), 1u);
  EXPECT_EQ(square[0].kind, DefectKind::branch);
}

}  // namespace
}  // namespace linkwright::planar
