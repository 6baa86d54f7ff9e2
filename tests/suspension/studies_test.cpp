// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "linkwright/study/study.h"

namespace linkwright::suspension {
namespace {

TEST(Studies, AreThoseOfCornersAndBeamAxles) {
  std::vector<std::string> names, seeded;
  for (const study::Kind& kind : studies()) {
    names.push_back(study::name_of(kind));
    if (kind.seeded) seeded.push_back(names.back());
  }
  EXPECT_THAT(names, ::testing::ElementsAre(
                         "analysis/suspension.corner", "synthesis/suspension.corner/carrier_poses",
                         "synthesis/suspension.corner/wheel_parameters", "analysis/suspension.beam_axle"));
  EXPECT_THAT(seeded, ::testing::ElementsAre("synthesis/suspension.corner/carrier_poses",
                                             "synthesis/suspension.corner/wheel_parameters"));
}

}  // namespace
}  // namespace linkwright::suspension
