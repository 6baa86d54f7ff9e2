// SPDX-License-Identifier: BSD-3-Clause
#include "clearance/studies.h"

#include <gmock/gmock.h>

namespace linkwright::clearance {
namespace {

TEST(ClearanceStudies, AreThoseOfLinkagesWithClearance) {
  std::vector<std::string> names;
  for (const study::Kind& kind : studies()) names.push_back(study::name_of(kind));
  EXPECT_THAT(names, ::testing::ElementsAre("synthesis/clearance.four_bar/path_points",
                                            "synthesis/clearance.four_bar/phase",
                                            "synthesis/clearance.four_bar/path_points_and_phase",
                                            "simulation/clearance.linkage", "analysis/clearance.linkage"));
}

TEST(ClearanceStudies, ExamplesRun) {
  for (const study::Kind& kind : studies()) {
    SCOPED_TRACE(study::name_of(kind));
    const study::Result result = test::run_text(kind.example);
    EXPECT_EQ(result.status, Status::done) << to_string(result.headline);
    EXPECT_FALSE(result.scenes.empty());
    for (const Diagnostic& d : result.diagnostics) ADD_FAILURE() << to_string(d);
  }
}

}  // namespace
}  // namespace linkwright::clearance
