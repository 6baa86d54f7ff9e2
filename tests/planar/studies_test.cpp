#include "linkwright/planar/studies.h"

#include <gtest/gtest.h>

namespace linkwright::planar {
namespace {

TEST(Studies, ArePathSynthesisWithAnExample) {
  const auto kinds = studies();
  ASSERT_EQ(kinds.size(), 1u);
  EXPECT_EQ(kinds[0].mechanism, "planar.four_bar");
  EXPECT_EQ(kinds[0].target, "path_points");
  EXPECT_TRUE(kinds[0].seeded);
}

}  // namespace
}  // namespace linkwright::planar
