// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"

namespace linkwright::planar {
namespace {

ChainGraph graph_of(int links, const std::vector<JointEnds>& joints) {
  ChainGraph out{.links = links};
  for (const auto& [a, b] : joints) out.join(a, b);
  return out;
}

// The graph whose possible joints, in a fixed order, are the bits of a number.
ChainGraph graph_of_bits(int links, unsigned bits) {
  ChainGraph out{.links = links};
  int k = 0;
  for (int a = 0; a < links; ++a)
    for (int b = a + 1; b < links; ++b, ++k)
      if ((bits >> k & 1) != 0) out.join(a, b);
  return out;
}

std::vector<Labelling> permutations(int links) {
  Labelling now{};
  std::iota(now.begin(), now.end(), std::uint8_t{0});
  std::vector<Labelling> out;
  do out.push_back(now);
  while (std::next_permutation(now.begin(), now.begin() + links));
  return out;
}

TEST(ChainGraph, CountsJointsAndFreedoms) {
  const ChainGraph four_bar = graph_of(4, {{0, 1}, {1, 2}, {2, 3}, {0, 3}});
  EXPECT_EQ(four_bar.joints(), 4);
  EXPECT_EQ(four_bar.degree(2), 2);
  EXPECT_EQ(freedoms(four_bar), 1);
  EXPECT_EQ(joints_of(four_bar), (std::vector<JointEnds>{{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
  EXPECT_FALSE(has_rigid_part(four_bar));
}

TEST(ChainGraph, FindsRigidParts) {
  // A triangle between a five-bar's links, and the smallest Baranov truss of five links within seven.
  EXPECT_TRUE(has_rigid_part(graph_of(5, {{0, 1}, {1, 2}, {0, 2}, {2, 3}, {3, 4}, {0, 4}})));
  const std::vector<JointEnds> truss{{0, 1}, {1, 2}, {2, 3}, {0, 3}, {0, 4}, {2, 4}};
  EXPECT_FALSE(has_rigid_part(graph_of(5, truss)));  // rigid as a whole
  std::vector<JointEnds> more = truss;
  more.insert(more.end(), {{1, 5}, {5, 6}, {3, 6}});
  EXPECT_TRUE(has_rigid_part(graph_of(7, more)));
}

// All graphs of five vertices: 34 up to isomorphism (published: A000088), by canonical forms and by the least
// of all 120 permutations.
TEST(CanonicalForm, AgreesWithAllPermutations) {
  const std::vector<Labelling> all = permutations(5);
  std::set<ChainGraph> forms, least;
  for (unsigned bits = 0; bits < 1u << 10; ++bits) {
    const ChainGraph graph = graph_of_bits(5, bits);
    const CanonicalForm form = canonical_form(graph);
    ChainGraph first = graph;
    std::size_t unchanged = 0;
    for (const Labelling& p : all) {
      first = std::min(first, relabelled(graph, p));
      unchanged += relabelled(graph, p) == graph;
    }
    forms.insert(form.graph), least.insert(first);
    ASSERT_EQ(form.labellings.size(), unchanged) << bits;
    for (const Labelling& l : form.labellings) ASSERT_EQ(relabelled(graph, l), form.graph);
    for (const Labelling& p : automorphisms(graph)) ASSERT_EQ(relabelled(graph, p), graph);
  }
  EXPECT_EQ(forms.size(), 34u);
  EXPECT_EQ(least.size(), 34u);
}

TEST(CanonicalForm, IsTheSameForAnyNumbering) {
  RandomStream random({.seed = 3});
  for (int trial = 0; trial < 200; ++trial) {
    ChainGraph graph{.links = 10};
    for (int k = 0; k < 13; ++k) {
      const int a = static_cast<int>(random.below(10)), b = static_cast<int>(random.below(10));
      if (a != b) graph.join(a, b);
    }
    Labelling shuffled{};
    std::iota(shuffled.begin(), shuffled.end(), std::uint8_t{0});
    for (std::uint32_t i = 10; i > 1; --i) std::swap(shuffled[i - 1], shuffled[random.below(i)]);
    const ChainGraph other = relabelled(graph, shuffled);
    ASSERT_EQ(canonical_form(graph).graph, canonical_form(other).graph);
    ASSERT_EQ(automorphisms(graph).size(), automorphisms(other).size());
  }
}

TEST(CanonicalForm, KeepsColoursApart) {
  const ChainGraph ring = graph_of(6, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {0, 5}});
  EXPECT_EQ(automorphisms(ring).size(), 12u);
  const auto form = [&](std::vector<int> colours) { return canonical_form(ring, colours); };
  // Two marked links of a ring of six: neighbours, next to neighbours, opposite.
  std::set<ChainGraph> classes;
  for (int link = 1; link < 6; ++link) {
    std::vector<int> colours(6, 1);
    colours[0] = colours[static_cast<std::size_t>(link)] = 0;
    const CanonicalForm found = form(colours);
    classes.insert(found.graph);
    EXPECT_EQ(found.labellings.size(), link == 3 ? 4u : 2u);
  }
  EXPECT_EQ(classes.size(), 3u);
}

TEST(CanonicalForm, RefusesTooManyLinks) {
  EXPECT_THROW(canonical_form({.links = 13}), ContractError);
  const std::vector<int> colours{1, 2};
  EXPECT_THROW(canonical_form({.links = 3}, colours), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
