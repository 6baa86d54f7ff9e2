#include "linkwright/optimise/pareto.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "support/message.h"

namespace linkwright::optimise {
namespace {

using linkwright::test::message;
using testing::HasSubstr;

bool wins(const std::vector<double>& a, const std::vector<double>& b) { return dominates(a, b); }

TEST(Dominates, NoneMoreAndOneLess) {
  EXPECT_TRUE(wins({1, 2, 3}, {1, 2, 4}));
  EXPECT_TRUE(wins({0, 0, 0}, {1, 2, 4}));
  EXPECT_FALSE(wins({1, 2, 3}, {1, 2, 3}));
  EXPECT_FALSE(wins({1, 2, 4}, {1, 2, 3}));
  EXPECT_FALSE(wins({0, 5}, {1, 2}));
  EXPECT_FALSE(wins({1, 2}, {0, 5}));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(wins({1, infinity}, {2, infinity}));
  EXPECT_FALSE(wins({infinity, infinity}, {infinity, infinity}));
}

TEST(Dominates, ComparesAsManyObjectives) {
  EXPECT_THAT(message([] { wins({1, 2}, {1}); }), HasSubstr("2 and 1 objectives"));
}

}  // namespace
}  // namespace linkwright::optimise
