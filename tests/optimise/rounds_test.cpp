// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/rounds.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace linkwright::optimise {
namespace {

struct Counter {
  int destroyed = 0;
};
struct Guard {
  Counter& counter;
  ~Guard() { ++counter.destroyed; }
};

Rounds countdown(std::size_t from, Counter& counter) {
  const Guard guard = {counter};
  for (;;) {
    for (std::size_t n = from; n > 0; --n) co_yield n;
    co_yield Rounds::generation_over;
  }
}

Rounds failing() {
  co_yield 1;
  throw std::runtime_error("in the second round");
}

TEST(Rounds, GoOnWhereTheyWereSuspended) {
  Counter counter;
  Rounds rounds = countdown(2, counter);
  for (int generation = 0; generation < 3; ++generation) {
    EXPECT_EQ(rounds.next(), 2u);
    EXPECT_EQ(rounds.next(), 1u);
    EXPECT_EQ(rounds.next(), Rounds::generation_over);
  }
}

TEST(Rounds, EndWithTheirOwner) {
  Counter counter;
  {
    Rounds owner;
    {
      Rounds rounds = countdown(2, counter);
      rounds.next();
      owner = std::move(rounds);
    }
    EXPECT_EQ(counter.destroyed, 0);
    EXPECT_EQ(owner.next(), 1u);
  }
  EXPECT_EQ(counter.destroyed, 1);
}

TEST(Rounds, LetExceptionsThrough) {
  Rounds rounds = failing();
  EXPECT_EQ(rounds.next(), 1u);
  EXPECT_THROW(rounds.next(), std::runtime_error);
}

}  // namespace
}  // namespace linkwright::optimise
