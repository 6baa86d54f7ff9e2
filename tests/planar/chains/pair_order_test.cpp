// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/pair_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "linkwright/core/check.h"
#include "linkwright/planar/chains/names.h"

namespace linkwright::planar {
namespace {

using testing::ElementsAre;

TEST(PairOrder, Counts) {
  constexpr std::size_t expected[3][4] = {{1, 1, 1, 1}, {12, 6, 8, 7}, {360, 69, 84, 75}};
  for (int pairs = 1; pairs <= 3; ++pairs) {
    const auto& row = expected[pairs - 1];
    EXPECT_EQ(pair_sequences(pairs).size(), row[0]);
    EXPECT_EQ(pair_machines(pairs).size(), row[1]);
    EXPECT_EQ(traced_pair_machines(pairs, false).size(), row[2]);
    EXPECT_EQ(traced_pair_machines(pairs, true).size(), row[3]);
  }
  EXPECT_THROW(pair_sequences(0), ContractError);
}

// The chains themselves lead to the same machines: those whose ground and driver leave groups of two links.
TEST(PairOrder, IsFoundFromTheChains) {
  struct Case {
    int links;
    std::size_t machines;
  };
  for (const auto& [links, machines] : {Case{4, 1}, Case{6, 6}, Case{8, 69}, Case{10, 1283}}) {
    std::set<PairProgram> found;
    for (const Chain& chain : chains(links, 1))
      for (const Marking& m : markings(chain, {.ground = true, .driver = true}))
        if (const auto program = pair_program(chain.graph, m)) {
          found.insert(*program);
          ASSERT_EQ(canonical_form(program->graph()).graph, chain.graph);
        }
    EXPECT_EQ(found.size(), machines) << links;
    if (links > 8) continue;
    const std::vector<PairProgram> listed = pair_machines(links / 2 - 1);
    EXPECT_TRUE(std::equal(found.begin(), found.end(), listed.begin(), listed.end())) << links;
  }
}

std::string six_bar(int a, int b) {
  const PairProgram program{.pairs = {{1, 0}, {a, b}}};
  const ChainGraph graph = program.graph();
  return common_name(graph, {.ground = 0});
}

TEST(PairOrder, OfSixBars) {
  EXPECT_EQ(six_bar(2, 3), "Watt I");
  EXPECT_EQ(six_bar(1, 2), "Watt I");
  EXPECT_EQ(six_bar(0, 3), "Watt II");
  EXPECT_EQ(six_bar(0, 1), "Watt II");
  EXPECT_EQ(six_bar(1, 3), "Stephenson I");
  EXPECT_EQ(six_bar(0, 2), "Stephenson III");
}

TEST(PairOrder, TracesSixBars) {
  std::vector<std::string> names;
  for (const PairProgram& program : traced_pair_machines(2, true)) names.push_back(program_name(program));
  EXPECT_THAT(names, ElementsAre("six-bar 02 b", "six-bar 12 a", "six-bar 12 b", "six-bar 13 a",
                                 "six-bar 13 b", "six-bar 23 a", "six-bar 23 b"));
}

TEST(PairOrder, NamesProgramsByTheirPairs) {
  EXPECT_EQ(program_name({.pairs = {{1, 0}}}), "four-bar");
  EXPECT_EQ(program_name({.pairs = {{1, 0}, {1, 3}, {2, 4}}, .traced = 7}), "eight-bar 13-24 b");
}

}  // namespace
}  // namespace linkwright::planar
