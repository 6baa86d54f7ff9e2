#include "linkwright/math/zero.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::math {
namespace {

TEST(ZeroBetween, FindsZerosToTheLastDigit) {
  // One unit in the last place of the zero, which is where the sign of the function changes.
  const double eps = std::numeric_limits<double>::epsilon();
  EXPECT_NEAR(zero_between([](double x) { return std::cos(x); }, 1, 2), pi / 2, 2 * eps);
  EXPECT_NEAR(zero_between([](double x) { return x * x * x - 2; }, 5, 0), std::cbrt(2.0), 2 * eps);
  EXPECT_NEAR(zero_between([](double x) { return std::exp(x) - 1e-3; }, -50, 50), std::log(1e-3), 16 * eps);
}

TEST(ZeroBetween, TakesFewStepsOnSmoothFunctionsAndNotManyOnSteepOnes) {
  int calls = 0;
  zero_between([&](double x) { return ++calls, std::cos(x); }, 1, 2);
  EXPECT_LE(calls, 12);
  calls = 0;
  const double x = zero_between([&](double v) { return ++calls, v < 0.3 ? -1.0 : 1e9; }, 0, 1);
  EXPECT_NEAR(x, 0.3, 1e-15);
  EXPECT_LE(calls, 80);
}

TEST(ZeroBetween, TakesAnEndThatIsZero) {
  EXPECT_EQ(zero_between([](double x) { return x - 1; }, 1, 2), 1);
  EXPECT_EQ(zero_between([](double x) { return x - 2; }, 1, 2), 2);
}

TEST(ZeroBetween, WantsAChangeOfSign) {
  EXPECT_THROW(zero_between([](double x) { return x * x + 1; }, -1, 1), ContractError);
}

}  // namespace
}  // namespace linkwright::math
