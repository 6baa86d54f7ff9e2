// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/embedding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/chains/chains.h"

namespace linkwright::planar {
namespace {

ChainGraph complete_graph(int links) {
  ChainGraph out{.links = links};
  for (int a = 0; a < links; ++a)
    for (int b = a + 1; b < links; ++b) out.join(a, b);
  return out;
}

ChainGraph three_wells() {
  ChainGraph out{.links = 6};
  for (int a = 0; a < 3; ++a)
    for (int b = 3; b < 6; ++b) out.join(a, b);
  return out;
}

TEST(Cycles, OfCompleteGraphs) {
  EXPECT_EQ(cycles(complete_graph(3)).size(), 1u);
  EXPECT_EQ(cycles(complete_graph(4)).size(), 7u);   // four triangles, three quadrilaterals
  EXPECT_EQ(cycles(complete_graph(5)).size(), 37u);  // 10 + 15 + 12
  EXPECT_EQ(cycles(three_wells()).size(), 15u);      // 9 quadrilaterals, 6 hexagons
  EXPECT_EQ(cycles(complete_graph(5)).front().size(), 5u);
}

TEST(Embedding, KnowsKuratowskisGraphs) {
  EXPECT_TRUE(embedding(complete_graph(4)));
  EXPECT_FALSE(embedding(complete_graph(5)));
  EXPECT_FALSE(embedding(three_wells()));
}

// Each joint has a mesh on its left as it is passed in one sense and one on its right; the border passes the
// outer ones once more, clockwise seen from outside.
void expect_whole(const ChainGraph& graph, const ChainEmbedding& drawn) {
  std::map<JointEnds, int> passed;
  const auto pass = [&](const LinkCycle& cycle, bool backwards) {
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      const int a = cycle[k], b = cycle[(k + 1) % cycle.size()];
      ASSERT_TRUE(graph.joined(a, b));
      ++passed[backwards ? JointEnds{b, a} : JointEnds{a, b}];
    }
  };
  for (const LinkCycle& mesh : drawn.meshes) pass(mesh, false);
  pass(drawn.border, true);
  EXPECT_EQ(std::ssize(passed), 2 * graph.joints());
  for (const auto& [ends, times] : passed) EXPECT_EQ(times, 1);
  EXPECT_EQ(std::ssize(drawn.meshes), graph.joints() - graph.links + 1);  // Euler
}

TEST(Embedding, HasEveryJointOnceInEachSense) {
  for (const auto& [links, freedoms] :
       {std::array{6, 1}, std::array{8, 1}, std::array{10, 3}, std::array{9, 2}})
    for (const Chain& chain : chains(links, freedoms)) {
      const auto drawn = embedding(chain.graph);
      ASSERT_TRUE(drawn);
      expect_whole(chain.graph, *drawn);
    }
}

// Published: 219 of the 230 graphs are planar.
TEST(Embedding, OfTenLinksIsMissingForElevenChains) {
  const std::vector<Chain> all = chains(10, 1);
  EXPECT_EQ(std::count_if(all.begin(), all.end(), [](const Chain& c) { return !embedding(c.graph); }), 11);
}

TEST(Embedding, HasAGivenLinkOnItsBorder) {
  for (const Chain& chain : chains(8, 1))
    for (int link = 0; link < 8; ++link) {
      const auto drawn = embedding(chain.graph, link);
      ASSERT_TRUE(drawn);
      EXPECT_EQ(std::count(drawn->border.begin(), drawn->border.end(), link), 1);
    }
}

TEST(TwoConnected, HasNoCutLink) {
  EXPECT_TRUE(is_two_connected(three_wells()));
  for (const Chain& chain : fractionated_chains(9, 2)) EXPECT_FALSE(is_two_connected(chain.graph));
}

}  // namespace
}  // namespace linkwright::planar
