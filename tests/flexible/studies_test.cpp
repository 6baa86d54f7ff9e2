// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies.h"

#include <gmock/gmock.h>

#include "support/study_text.h"

namespace linkwright::flexible {
namespace {

TEST(FlexibleStudies, AreThoseOfLinksThatBendAndTheirExamplesRun) {
  const auto kinds = studies();
  ASSERT_EQ(kinds.size(), 3u);
  EXPECT_EQ(study::name_of(kinds[0]), "simulation/flexible.arm");
  EXPECT_EQ(study::name_of(kinds[1]), "simulation/flexible.hub_link");
  EXPECT_EQ(study::name_of(kinds[2]), "analysis/flexible.hub_link");
  for (const study::Kind& kind : kinds) {
    const auto result = test::run_text(kinds, kind.example);
    EXPECT_EQ(result.status, Status::done) << to_string(result.headline);
    EXPECT_FALSE(result.scenes.empty());
  }
}

}  // namespace
}  // namespace linkwright::flexible
