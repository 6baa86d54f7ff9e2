// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/path_run.h"
#include "linkwright/planar/studies/slider_crank_path.h"
#include "planar/slider_crank_path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

SliderPathDesign published(const SliderPathProblem& p) {
  return measure(p, slider_crank(at(path_case("T4.2"), "inputs.design")), 1, angles_of(p, 0.53607));
}

// The drawing comes from the linkage, the table from the closed form: two routes to one curve and one stroke.
TEST(SliderPathScene, DrawsTheCurveThatTheTableLists) {
  const SliderPathProblem p = printed_eighteen_slider_points();
  const SliderPathDesign d = published(p);
  const study::Scene scene = path_scene<SliderPathKind>(p, d, "solution-1", "1", 181);
  const Table motion = path_motion<SliderPathKind>(d, "motion", 181);
  ASSERT_EQ(scene.traces.size(), 1u);
  const auto& curve = scene.points[static_cast<std::size_t>(scene.traces[0].point)];
  ASSERT_EQ(curve.x.size(), 181u);
  for (std::size_t i = 0; i < 181; ++i) {
    EXPECT_NEAR(curve.x[i], motion.find("point_x_m")->values[i], 1e-13);
    EXPECT_NEAR(curve.y[i], motion.find("point_y_m")->values[i], 1e-13);
    EXPECT_EQ(scene.input[i], motion.find("crank_angle_rad")->values[i]);
  }
  const auto& way = motion.find("slider_m")->values;
  const auto [low, high] = std::minmax_element(way.begin(), way.end());
  EXPECT_NEAR(*high - *low, d.stroke, 1e-3);  // second order in steps of 2 degrees
  EXPECT_EQ(scene.name, "solution-1");
  ASSERT_EQ(scene.targets.size(), 1u);
  EXPECT_EQ(scene.targets[0].x.size(), 18u);
}

TEST(SliderPathScene, ACrankThatRocksIsShownOverWhatItReaches) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.crank_rotates_fully = p.closed = false;
  SliderCrankMechanism m;
  m.parameters = {.crank = 1, .rod = 0.5, .rod_u = 0.2};
  p.timing = Timing::free;
  std::vector<double> angles;
  for (int k = 0; k < 18; ++k) angles.push_back(-0.3 + 0.03 * k);
  for (const double sense : {1.0, -1.0}) {
    std::vector<double> shown = shown_angles<SliderCrankPath>(measure(p, m, sense, angles), 11);
    EXPECT_NEAR(shown.front(), -sense * pi / 6, 1e-12);
    EXPECT_NEAR(shown.back(), sense * pi / 6, 1e-12);
  }
}

}  // namespace
}  // namespace linkwright::planar
