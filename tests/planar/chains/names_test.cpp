// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/chains/names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

namespace linkwright::planar {
namespace {

using testing::ElementsAre;
using testing::Pair;
using testing::UnorderedElementsAre;

std::vector<std::string> common_names(int links, int freedoms, const MarkingChoice& choice) {
  std::vector<std::string> out;
  for (const Chain& chain : chains(links, freedoms))
    for (const Marking& m : markings(chain, choice)) out.push_back(common_name(chain.graph, m));
  return out;
}

TEST(CommonName, OfFourLinks) {
  EXPECT_THAT(common_names(4, 1, {.ground = true}), ElementsAre("four-bar"));
  EXPECT_THAT(common_names(4, 1, {.sliders = 1, .ground = true}),
              UnorderedElementsAre("slider-crank", "inverted slider-crank"));
  EXPECT_THAT(common_names(4, 1, {.sliders = 2, .ground = true}),
              UnorderedElementsAre("trammel", "Scotch yoke", "Oldham coupling", "Rapson slide"));
  EXPECT_THAT(common_names(4, 1, {.sliders = 2}),
              UnorderedElementsAre("double-slider chain", "Rapson chain"));
  EXPECT_THAT(common_names(4, 1, {.sliders = 1}), ElementsAre("slider-crank chain"));
}

TEST(CommonName, OfSixLinks) {
  EXPECT_THAT(common_names(6, 1, {.ground = true}),
              UnorderedElementsAre("Watt I", "Watt II", "Stephenson I", "Stephenson II", "Stephenson III"));
  // With a driver: crank binary or ternary for Watt I, and so on.
  std::map<std::string, int> driven;
  for (const std::string& name : common_names(6, 1, {.ground = true, .driver = true})) ++driven[name];
  EXPECT_THAT(driven, ElementsAre(Pair("Stephenson I", 1), Pair("Stephenson II", 2),
                                  Pair("Stephenson III", 2), Pair("Watt I", 2), Pair("Watt II", 2)));
  EXPECT_THAT(common_names(6, 1, {}), ElementsAre("Watt chain", "Stephenson chain"));
}

TEST(CommonName, OfFiveLinksAndOfOthers) {
  EXPECT_THAT(common_names(5, 2, {.ground = true}), ElementsAre("five-bar"));
  EXPECT_THAT(common_names(5, 2, {.gear = true}), ElementsAre("geared five-bar chain"));
  for (const std::string& name : common_names(8, 1, {.ground = true})) EXPECT_EQ(name, "");
}

TEST(MechanismName, ListsItsMarks) {
  const Chain seventh = chains(8, 1)[6];
  const std::vector<Marking> all = markings(seventh, {.ground = true, .driver = true});
  EXPECT_EQ(mechanism_name(seventh, {}), "8-07");
  EXPECT_THAT(mechanism_name(seventh, all.front()), testing::MatchesRegex("8-07/ground 1/driver [2-8]"));
  const Chain watt = chains(6, 1).front();
  EXPECT_THAT(mechanism_name(watt, markings(watt, {.sliders = 2, .ground = true}).front()),
              testing::MatchesRegex("6-1/sliders [1-6]-[1-6] [1-6]-[1-6]/ground [1-6]"));
  const Chain five_bar = chains(5, 2).front();
  EXPECT_THAT(mechanism_name(five_bar, markings(five_bar, {.gear = true}).front()),
              testing::MatchesRegex("5-1/gears [1-5]-[1-5] on 1"));
}

}  // namespace
}  // namespace linkwright::planar
