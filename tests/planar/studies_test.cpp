#include "linkwright/planar/studies.h"

#include <gtest/gtest.h>

#include "linkwright/study/study.h"

namespace linkwright::planar {
namespace {

TEST(Studies, ArePathSynthesisAndTheAnalysesOfFourBarAndArm) {
  const auto kinds = studies();
  ASSERT_EQ(kinds.size(), 3u);
  EXPECT_EQ(study::name_of(kinds[0]), "synthesis/planar.four_bar/path_points");
  EXPECT_TRUE(kinds[0].seeded);
  EXPECT_EQ(study::name_of(kinds[1]), "analysis/planar.four_bar");
  EXPECT_FALSE(kinds[1].seeded);
  EXPECT_EQ(study::name_of(kinds[2]), "analysis/planar.serial_arm");
}

}  // namespace
}  // namespace linkwright::planar
