// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "linkwright/study/study.h"

namespace linkwright::planar {
namespace {

TEST(Studies, AreThoseOfPlanarLinkages) {
  std::vector<std::string> names, seeded;
  for (const study::Kind& kind : studies()) {
    names.push_back(study::name_of(kind));
    if (kind.seeded) seeded.push_back(names.back());
  }
  EXPECT_THAT(
      names,
      ::testing::ElementsAre(
          "synthesis/planar.four_bar/path_points", "synthesis/planar.slider_crank/path_points",
          "synthesis/planar.any/path_points", "synthesis/planar.any/poses", "synthesis/planar.any/function",
          "synthesis/planar.four_bar/poses", "synthesis/planar.four_bar/function",
          "synthesis/planar.slider_crank/function", "synthesis/planar.four_bar/swing",
          "synthesis/planar.slider_crank/stroke", "synthesis/planar.six_bar/function",
          "synthesis/planar.six_bar/dwell", "enumeration/planar.chain", "analysis/planar.four_bar",
          "analysis/planar.linkage", "analysis/planar.slider_crank", "simulation/planar.linkage",
          "simulation/planar.four_bar", "simulation/planar.slider_crank", "speed_fluctuation/planar.linkage",
          "speed_fluctuation/planar.four_bar", "speed_fluctuation/planar.slider_crank",
          "analysis/planar.serial_arm", "balancing/planar.four_bar", "balancing/planar.linkage",
          "balancing/planar.slider_crank", "balancing/planar.serial_arm", "rest/planar.linkage",
          "analysis/planar.cam", "synthesis/planar.cam"));
  EXPECT_THAT(seeded, ::testing::ElementsAre("synthesis/planar.four_bar/path_points",
                                             "synthesis/planar.slider_crank/path_points",
                                             "synthesis/planar.any/path_points", "synthesis/planar.any/poses",
                                             "synthesis/planar.any/function", "balancing/planar.four_bar",
                                             "balancing/planar.linkage", "balancing/planar.slider_crank",
                                             "balancing/planar.serial_arm"));
}

}  // namespace
}  // namespace linkwright::planar
