// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/markings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

using testing::ElementsAre;
using testing::Pair;

std::size_t count(int links, int freedoms, const MarkingChoice& choice) {
  std::size_t out = 0;
  for (const Chain& chain : chains(links, freedoms)) out += markings(chain, choice).size();
  return out;
}

// All of these were counted by a second program, which subdivides multigraphs and takes isomorphisms and
// automorphisms from networkx; 1, 5, 71, 1834 are published as well (Mruthyunjaya 2003).
TEST(Markings, CountInversions) {
  struct Case {
    int links, freedoms;
    std::size_t ground, driver;
  };
  for (const auto& [links, freedoms, ground, driver] :
       {Case{4, 1, 1, 1}, Case{6, 1, 5, 9}, Case{8, 1, 71, 153}, Case{10, 1, 1834, 4506}, Case{5, 2, 1, 1},
        Case{7, 2, 11, 19}, Case{9, 2, 220, 481}, Case{6, 3, 1, 1}, Case{8, 3, 18, 33},
        Case{10, 3, 517, 1142}}) {
    EXPECT_EQ(count(links, freedoms, {.ground = true}), ground) << links << ' ' << freedoms;
    EXPECT_EQ(count(links, freedoms, {.ground = true, .driver = true}), driver) << links << ' ' << freedoms;
  }
}

std::vector<std::size_t> slider_counts(int links, int most, bool ground) {
  std::vector<std::size_t> out;
  for (int sliders = 0; sliders <= most; ++sliders)
    out.push_back(count(links, 1, {.sliders = sliders, .ground = ground}));
  return out;
}

TEST(Markings, CountSliders) {
  EXPECT_THAT(slider_counts(4, 3, false), ElementsAre(1, 1, 2, 0));
  EXPECT_THAT(slider_counts(4, 3, true), ElementsAre(1, 2, 4, 0));
  EXPECT_THAT(slider_counts(6, 4, false), ElementsAre(2, 6, 16, 19, 9));
  EXPECT_THAT(slider_counts(6, 4, true), ElementsAre(5, 25, 71, 94, 39));
}

// 15 and 391 were counted by a second program as well, and so were those without a locked part, with ranks of
// rational numbers.
TEST(Markings, CountGearPairs) {
  for (const auto& [links, all, moving] :
       {std::array{5, 1, 1}, std::array{7, 15, 11}, std::array{9, 391, 246}}) {
    int found = 0, free = 0;
    for (const Chain& chain : chains(links, 2))
      for (const Marking& m : markings(chain, {.gear = true})) {
        const Mobility mobile = mobility(chain.graph, 0, m.gear);
        ++found;
        free += mobile.freedoms == 1 && mobile.each_joint_moves;
      }
    EXPECT_EQ(found, all) << links;
    EXPECT_EQ(free, moving) << links;
  }
}

// Gear pairs of a chain by images under all permutations of its links that leave it unchanged.
TEST(Markings, OfGearPairsAgreeWithAllPermutations) {
  for (const Chain& chain : chains(7, 2)) {
    std::set<std::set<std::array<int, 3>>> orbits;
    std::array<std::uint8_t, max_chain_links> start{};
    for (std::size_t v = 0; v < start.size(); ++v) start[v] = static_cast<std::uint8_t>(v);
    std::vector<Labelling> symmetries;
    Labelling p = start;
    do
      if (relabelled(chain.graph, p) == chain.graph) symmetries.push_back(p);
    while (std::next_permutation(p.begin(), p.begin() + 7));
    for (int c = 0; c < 7; ++c)
      for (int a = 0; a < 7; ++a)
        for (int b = a + 1; b < 7; ++b) {
          if (!chain.graph.joined(c, a) || !chain.graph.joined(c, b) || chain.graph.joined(a, b)) continue;
          std::set<std::array<int, 3>> orbit;
          for (const Labelling& s : symmetries)
            orbit.insert({s[linkwright::at(c)], std::min(s[linkwright::at(a)], s[linkwright::at(b)]),
                          std::max(s[linkwright::at(a)], s[linkwright::at(b)])});
          orbits.insert(orbit);
        }
    EXPECT_EQ(markings(chain, {.gear = true}).size(), orbits.size());
  }
}

TEST(Markings, AreInOrderAndComplete) {
  const Chain watt = chains(6, 1).front();
  const std::vector<Marking> all = markings(watt, {.ground = true, .driver = true});
  for (const Marking& m : all) {
    ASSERT_TRUE(m.ground && m.driver);
    EXPECT_TRUE(watt.graph.joined(*m.ground, driven_link(watt.graph, m)));
  }
  EXPECT_EQ(placements(watt.graph, {.sliders = 2, .ground = true, .driver = true}), 21.0 * 14);
  EXPECT_EQ(placements(watt.graph, {.gear = true, .ground = true}), 10.0 * 6);
}

// Published groups of the eight-links: 69 by pairs alone, 52 with one group of four links, 32 with one of
// six.
TEST(DrivenGroups, OfEightLinks) {
  std::map<std::vector<int>, int> found;
  for (const Chain& chain : chains(8, 1))
    for (const Marking& m : markings(chain, {.ground = true, .driver = true})) {
      std::vector<int> groups = driven_groups(chain.graph, m);
      std::sort(groups.begin(), groups.end());
      ++found[groups];
    }
  EXPECT_THAT(found, ElementsAre(Pair(ElementsAre(2, 2, 2), 69), Pair(ElementsAre(2, 4), 52),
                                 Pair(ElementsAre(6), 32)));
}

TEST(Markings, RefuseAnImpossibleChoice) {
  const Chain four_bar = chains(4, 1).front();
  EXPECT_THROW(markings(four_bar, {.driver = true}), ContractError);
  EXPECT_THROW(markings(four_bar, {.sliders = 5}), ContractError);
  EXPECT_THROW(driven_link(four_bar.graph, {}), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
