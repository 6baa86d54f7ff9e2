#include "linkwright/optimise/problem.h"

#include <gtest/gtest.h>

#include <limits>

namespace linkwright::optimise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Better, PrefersFeasibleToInfeasibleWhateverTheCost) {
  EXPECT_TRUE(better(1e9, 0, 1, 1e-12));
  EXPECT_FALSE(better(1, 1e-12, 1e9, 0));
}

TEST(Better, ComparesFeasibleOnesByCost) {
  EXPECT_TRUE(better(1, 0, 2, 0));
  EXPECT_FALSE(better(2, 0, 1, 0));
}

TEST(Better, ComparesInfeasibleOnesByViolationThenCost) {
  EXPECT_TRUE(better(5, 0.1, 1, 0.2));
  EXPECT_TRUE(better(1, 0.1, 5, 0.1));
  EXPECT_TRUE(better(infinity, 0.1, infinity, 0.2));
}

TEST(Better, IsStrict) {
  EXPECT_FALSE(better(1, 0, 1, 0));
  EXPECT_FALSE(better(infinity, 0.1, infinity, 0.1));
}

}  // namespace
}  // namespace linkwright::optimise
