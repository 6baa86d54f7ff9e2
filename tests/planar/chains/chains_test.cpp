// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/chains.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <set>

#include "linkwright/core/check.h"

namespace linkwright::planar {
namespace {

using testing::ElementsAre;
using testing::Pair;

struct Count {
  int links, freedoms;
  std::size_t graphs, chains, fractionated;
};
// Chains of one freedom: Tuttle 1996 and Mruthyunjaya 2003. Those of two and three, the graphs and the chains
// with cut links were counted by a second program as well, which subdivides multigraphs.
constexpr Count counts[] = {{4, 1, 1, 1, 0}, {6, 1, 3, 2, 0},     {8, 1, 40, 16, 0}, {10, 1, 1034, 230, 0},
                            {5, 2, 1, 1, 0}, {7, 2, 4, 3, 1},     {9, 2, 70, 35, 5}, {6, 3, 1, 1, 0},
                            {8, 3, 6, 5, 1}, {10, 3, 121, 74, 19}};

int joints(const Count& c) { return (3 * (c.links - 1) - c.freedoms) / 2; }

TEST(Chains, AreAsManyAsPublished) {
  for (const Count& c : counts) {
    EXPECT_EQ(two_connected_graphs(c.links, joints(c)).size(), c.graphs) << c.links << ' ' << c.freedoms;
    EXPECT_EQ(chains(c.links, c.freedoms).size(), c.chains) << c.links << ' ' << c.freedoms;
    EXPECT_EQ(fractionated_chains(c.links, c.freedoms).size(), c.fractionated)
        << c.links << ' ' << c.freedoms;
  }
}

TEST(Chains, OfElevenLinksAreAsManyAsPublished) { EXPECT_EQ(chains(11, 2).size(), 753u); }

TEST(Chains, HaveTheirFreedomsAndNoRigidPart) {
  for (const Count& c : counts)
    for (const Chain& chain : chains(c.links, c.freedoms)) {
      ASSERT_EQ(freedoms(chain.graph), c.freedoms);
      ASSERT_FALSE(has_rigid_part(chain.graph));
      ASSERT_EQ(canonical_form(chain.graph).graph, chain.graph);
      for (const Labelling& a : chain.automorphisms) ASSERT_EQ(relabelled(chain.graph, a), chain.graph);
    }
}

// The same chains without ears: all sets of seven of the fifteen possible joints of six links.
TEST(Chains, OfSixLinksAreThoseOfAllGraphs) {
  std::set<ChainGraph> found;
  for (unsigned bits = 0; bits < 1u << 15; ++bits) {
    if (std::popcount(bits) != 7) continue;
    ChainGraph graph{.links = 6};
    for (int a = 0, k = 0; a < 6; ++a)
      for (int b = a + 1; b < 6; ++b, ++k)
        if ((bits >> k & 1) != 0) graph.join(a, b);
    bool binary_at_least = true;
    for (int v = 0; v < 6; ++v) binary_at_least = binary_at_least && graph.degree(v) >= 2;
    if (binary_at_least && !has_rigid_part(graph)) found.insert(canonical_form(graph).graph);
  }
  ASSERT_EQ(found.size(), 2u);
  for (const Chain& chain : chains(6, 1)) EXPECT_EQ(found.count(chain.graph), 1u);
}

std::map<std::string, int> assortments(int links) {
  std::map<std::string, int> out;
  for (const Chain& chain : chains(links, 1)) ++out[assortment_text(chain.graph)];
  return out;
}

TEST(Chains, HaveTheAssortmentsOfTheLiterature) {
  EXPECT_THAT(assortments(8), ElementsAre(Pair("3333 2222", 9), Pair("433 22222", 5), Pair("44 222222", 2)));
  EXPECT_THAT(assortments(10),
              ElementsAre(Pair("333333 2222", 50), Pair("43333 22222", 95), Pair("4433 222222", 57),
                          Pair("444 2222222", 3), Pair("5333 222222", 15), Pair("543 2222222", 8),
                          Pair("55 22222222", 2)));
  EXPECT_EQ(assortment(chains(8, 1).back().graph), (std::vector<int>{6, 0, 2}));
}

// The names of chains are their places in the list, which may not change: FNV-1a of all codes.
std::uint64_t hash_of_list(int links, int freedoms) {
  std::uint64_t out = 14695981039346656037u;
  for (const Chain& chain : chains(links, freedoms))
    for (int v = 0; v < links; ++v) {
      const std::uint16_t row = chain.graph.neighbours[static_cast<std::size_t>(v)];
      for (const unsigned byte : {row & 255u, unsigned{row} >> 8}) out = (out ^ byte) * 1099511628211u;
    }
  return out;
}

TEST(Chains, KeepTheirNames) {
  EXPECT_EQ(hash_of_list(6, 1), 11962181007074442837u);
  EXPECT_EQ(hash_of_list(8, 1), 17170039320186237053u);
  EXPECT_EQ(hash_of_list(10, 1), 7160610609746885263u);
  EXPECT_EQ(hash_of_list(9, 2), 18369493529300085570u);
  EXPECT_EQ(hash_of_list(10, 3), 10614916168451954667u);
}

TEST(Chains, AreNamedByLinksAndRank) {
  EXPECT_EQ(chains(4, 1).front().name, "4-1");
  EXPECT_EQ(chains(8, 1)[6].name, "8-07");
  EXPECT_EQ(chains(8, 1)[6].rank, 7);
  EXPECT_EQ(chains(10, 1).back().name, "10-230");
  EXPECT_EQ(chains(8, 3).back().name, "8F3-5");
  EXPECT_EQ(fractionated_chains(9, 2).front().name, "9-c1");
}

TEST(Chains, StopWhenAsked) {
  RunContext context;
  context.cancel();
  EXPECT_TRUE(chains(10, 1, context).empty());
}

TEST(Chains, ThatCannotExistAreRefused) {
  EXPECT_TRUE(chain_can_exist(8, 1));
  EXPECT_FALSE(chain_can_exist(7, 1));
  EXPECT_FALSE(chain_can_exist(4, 3));
  EXPECT_THROW(chains(7, 1), ContractError);
  EXPECT_THROW(chains(14, 1), ContractError);
  EXPECT_THROW(fractionated_chains(14, 3), ContractError);
  EXPECT_THROW(two_connected_graphs(2, 1), ContractError);
  EXPECT_TRUE(two_connected_graphs(5, 4).empty());
}

}  // namespace
}  // namespace linkwright::planar
