// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "linkwright/core/check.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {
namespace {

TEST(Population, RowsAreAlignedAndPadded) {
  Population population(3, 10);
  EXPECT_EQ(population.view().stride, 16u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(population.row(i)) % 64, 0u);
  const std::array<double, 3> x = {1, 2, 3};
  population.set(9, x);
  std::array<double, 3> back{};
  population.get(9, back);
  EXPECT_EQ(back, x);
  EXPECT_EQ(population.view()(2, 9), 3);
  EXPECT_THROW(population.set(10, x), ContractError);
}

}  // namespace
}  // namespace linkwright::optimise
