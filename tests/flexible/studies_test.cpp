#include "linkwright/flexible/studies.h"

#include <gmock/gmock.h>

#include "support/study_text.h"

namespace linkwright::flexible {
namespace {

TEST(FlexibleStudies, AreThoseOfLinksThatBendAndTheirExamplesRun) {
  const auto kinds = studies();
  ASSERT_EQ(kinds.size(), 1u);
  EXPECT_EQ(study::name_of(kinds[0]), "simulation/flexible.hub_link");
  const auto result = testing::run_text(kinds, kinds[0].example);
  EXPECT_EQ(result.status, Status::done) << result.headline;
  EXPECT_EQ(result.scenes.size(), 1u);
}

}  // namespace
}  // namespace linkwright::flexible
