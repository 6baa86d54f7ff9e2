// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "support/memory_checkpoint.h"

namespace linkwright::optimise {
namespace {

/// One of several runs that share the pieces.
class Shared final : public Checkpoint {
 public:
  explicit Shared(std::size_t remainder) : remainder_(remainder) {}
  Value find(std::string_view name) const override { return kept.find(name); }
  void keep(std::string_view name, const Value& value) override { kept.keep(name, value); }
  std::chrono::duration<double> interval() const override { return kept.interval(); }
  std::size_t own_piece(std::string_view loop, std::size_t from, std::size_t count) override {
    loops.emplace(loop);
    return std::min(from + (remainder_ + 3 - from % 3) % 3, count);
  }
  void rejoin(std::string_view) override {
    if (!others) throw LeftToOthers();
    for (const auto& [name, value] : others->entries) kept.keep(name, value);
  }

  test::MemoryCheckpoint kept;
  // Checkpoints that they have saved when this one waits for them.
  const test::MemoryCheckpoint* others = nullptr;
  std::set<std::string> loops;

 private:
  std::size_t remainder_;
};

struct Squares {
  explicit Squares(std::size_t count) : values(count, 0.0) {}
  PieceLoop run(RunContext& context) {
    return for_each_piece(
        values.size(), context, "squares", [](std::size_t i) { return "piece " + std::to_string(i); },
        [&](std::size_t i) {
          ++done;
          return values[i] = static_cast<double>(i * i);
        },
        [&](std::size_t i) { return Value(values[i]); },
        [&](std::size_t i, const Value& value) { return values[i] = value.as_number(); });
  }
  std::vector<double> values;
  std::atomic<int> done{0};
};

TEST(Pieces, AllAreDoneOnAnyThreads) {
  for (const int threads : {1, 2, 8}) {
    RunContext context;
    context.set_threads(threads);
    std::vector<double> fractions;
    context.set_progress([&](const Progress& p) { fractions.push_back(p.fraction); });
    std::vector<int> done(100, 0);
    const PieceLoop loop = for_each_piece(100, context, "test", [&](std::size_t i) {
      ++done[i];
      return infinity;
    });
    EXPECT_EQ(loop.status, Status::done);
    EXPECT_EQ(done, std::vector<int>(100, 1));
    EXPECT_EQ(loop.ran, std::vector<bool>(100, true));
    ASSERT_FALSE(fractions.empty());
    EXPECT_LE(fractions.back(), 1);
  }
  RunContext context;
  EXPECT_THROW(for_each_piece(0, context, "test", [](std::size_t) { return 0.0; }), ContractError);
}

TEST(Pieces, TheFirstIsDoneWhateverHappens) {
  RunContext context;
  context.cancel();
  Squares squares(10);
  const PieceLoop loop = squares.run(context);
  EXPECT_EQ(loop.status, Status::cancelled);
  EXPECT_EQ(squares.done, 1);
  EXPECT_TRUE(loop.ran[0]);
  EXPECT_FALSE(loop.ran[1]);
}

TEST(Pieces, WhatIsKeptIsNotDoneAgain) {
  test::MemoryCheckpoint kept;
  kept.keep("piece 4", Value(-4.0));
  RunContext context;
  context.set_checkpoint(&kept);
  Squares squares(10);
  const PieceLoop loop = squares.run(context);
  EXPECT_EQ(squares.done, 9);
  EXPECT_EQ(squares.values[4], -4);
  EXPECT_EQ(squares.values[9], 81);
  EXPECT_TRUE(loop.ran[4]);
  EXPECT_EQ(kept.entries.size(), 10u);
}

TEST(Pieces, RunsThatShareThemHaveAllTogether) {
  test::MemoryCheckpoint together;
  for (std::size_t part = 0; part < 3; ++part) {
    Shared own(part);
    RunContext context;
    context.set_checkpoint(&own);
    Squares squares(10);
    EXPECT_THROW(squares.run(context), LeftToOthers);
    EXPECT_EQ(squares.done, part == 0 ? 4 : 3);
    for (const auto& [name, value] : own.kept.entries) together.keep(name, value);
  }
  RunContext context;
  context.set_checkpoint(&together);
  Squares squares(10);
  squares.run(context);
  EXPECT_EQ(squares.done, 0);
  EXPECT_EQ(squares.values[9], 81);
}

TEST(Pieces, OneRunWaitsForTheOthersAndDoesWhatTheyDidNotEnd) {
  test::MemoryCheckpoint others;
  others.keep("piece 1", Value(-1.0));
  others.keep("piece 5", Value(-5.0));
  for (const int threads : {1, 4}) {
    Shared own(0);
    own.others = &others;
    RunContext context;
    context.set_threads(threads);
    context.set_checkpoint(&own);
    Squares squares(7);
    const PieceLoop loop = squares.run(context);
    EXPECT_EQ(squares.values, (std::vector<double>{0, -1, 4, 9, 16, -5, 36}));
    EXPECT_EQ(loop.ran, std::vector<bool>(7, true));
    EXPECT_EQ(squares.done, 5);
    EXPECT_EQ(own.loops, std::set<std::string>{"piece 0"});
  }
}

TEST(Pieces, FractionsEndAtOneForEachRun) {
  for (const std::size_t part : {0u, 2u}) {
    Shared own(part);
    RunContext context;
    context.set_threads(1);
    context.set_checkpoint(&own);
    std::vector<double> fractions;
    context.set_progress([&](const Progress& p) { fractions.push_back(p.fraction); });
    Squares squares(9);
    EXPECT_THROW(squares.run(context), LeftToOthers);
    ASSERT_EQ(fractions.size(), 3u);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_EQ(fractions.back(), part == 0 ? 7 / 9.0 : 1.0);
  }
}

TEST(Pieces, AnErrorOfOneIsTheErrorOfAll) {
  RunContext context;
  context.set_threads(2);
  const auto run = [&] {
    for_each_piece(100, context, "test", [](std::size_t i) -> double {
      if (i == 7) throw std::runtime_error("seven");
      return 0;
    });
  };
  EXPECT_THROW(run(), std::runtime_error);
}

}  // namespace
}  // namespace linkwright::optimise
