// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/function_ref.h"

#include <gtest/gtest.h>

#include <string>

namespace linkwright::math {
namespace {

double twice(FunctionRef<double(double)> f, double x) { return f(f(x)); }
void call_twice(FunctionRef<int()> f) {
  f();
  f();
}
double plus_one(double x) { return x + 1; }

TEST(FunctionRef, CallsWhatItRefersTo) {
  EXPECT_EQ(twice([](double x) { return 3 * x; }, 2), 18);
  int count = 0;
  auto counter = [&count] { return ++count; };
  call_twice(counter);
  EXPECT_EQ(count, 2);
  int own = 0;
  auto changing = [own]() mutable { return ++own; };  // the caller's object is called, not a copy
  call_twice(changing);
  EXPECT_EQ(changing(), 3);
}

TEST(FunctionRef, TakesConstObjectsAndPlainFunctions) {
  const auto f = [](double x) { return x + 1; };
  EXPECT_EQ(twice(f, 1), 3);
  EXPECT_EQ(twice(plus_one, 1), 3);
  EXPECT_EQ(twice(&plus_one, 1), 3);
}

TEST(FunctionRef, IsNotMadeFromAnythingElse) {
  EXPECT_FALSE((std::is_constructible_v<FunctionRef<double(double)>, int>));
  EXPECT_FALSE((std::is_constructible_v<FunctionRef<double(double)>, std::string>));
}

}  // namespace
}  // namespace linkwright::math
