// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/trade_words.h"

#include <gtest/gtest.h>

namespace linkwright::study {
namespace {

using Words = std::vector<std::string_view>;

const Words mechanisms{"planar.four_bar", "planar.linkage", "planar.slider_crank", "suspension.corner"};
const Words lengths{"ground", "crank", "coupler", "rocker"};
const Words rods{"crank", "rod", "offset"};
const Words joints{"revolute", "prismatic", "pin_in_slot", "fixed", "gear"};
const Words links{"R", "RR", "S", "RS", "SR", "SP", "US", "SS"};
const Words samples{"R", "RR-US", "2RS-US", "RS-SP-US", "5US"};

TEST(Synonyms, CaseBlanksAndPunctuationDoNotMatter) {
  for (const char* word :
       {"fourbar", "four-bar", "Four Bar", "four_bar", "planar.fourbar", "PLANAR.FOUR_BAR"})
    EXPECT_EQ(meant_word(word, mechanisms), "planar.four_bar") << word;
  EXPECT_EQ(meant_word("Pin-in-slot", joints), "pin_in_slot");
}

TEST(Synonyms, OtherNamesAndOtherLanguages) {
  for (const char* word : {"4bar", "planar.4bar", "4-bar linkage", "Viergelenk", "quatre barres"})
    EXPECT_EQ(meant_word(word, mechanisms), "planar.four_bar") << word;
  EXPECT_EQ(meant_word("Schubkurbel", mechanisms), "planar.slider_crank");
  for (const char* word : {"Kurbel", "manivelle", "manivela"})
    EXPECT_EQ(meant_word(word, lengths), "crank") << word;
  for (const char* word : {"Koppel", "bielle", "biela"})
    EXPECT_EQ(meant_word(word, lengths), "coupler") << word;
  EXPECT_EQ(meant_word("Schwinge", lengths), "rocker");
  EXPECT_EQ(meant_word("Gestell", lengths), "ground");
  for (const char* word : {"hinge", "pin", "Drehgelenk", "charnière"})
    EXPECT_EQ(meant_word(word, joints), "revolute") << word;
  for (const char* word : {"wishbone", "A-arm", "Querlenker"})
    EXPECT_EQ(meant_word(word, links), "RS") << word;
  for (const char* word : {"tie rod", "Lenker", "biellette"})
    EXPECT_EQ(meant_word(word, links), "US") << word;
}

TEST(Synonyms, MeanWhatIsAllowed) {
  EXPECT_EQ(meant_word("bielle", rods), "rod");
  EXPECT_EQ(meant_word("MacPherson", mechanisms), "suspension.corner");
  EXPECT_EQ(meant_word("MacPherson", samples), "RS-SP-US");
  EXPECT_EQ(meant_word("MacPherson", links), "SP");
  EXPECT_EQ(meant_word("double wishbone", samples), "2RS-US");
  EXPECT_EQ(meant_word("grashof", {"order", "crank_rotates_fully"}), "crank_rotates_fully");
}

TEST(Synonyms, ElseTheNearestOrNone) {
  EXPECT_EQ(meant_word("cupler", lengths), "coupler");
  EXPECT_EQ(meant_word("temperature", lengths), "");
  EXPECT_EQ(meant_word("", lengths), "");
  EXPECT_EQ(meant_word("...", lengths), "");
  EXPECT_EQ(suggestion("Koppel", lengths), "did you mean 'coupler'?");
  EXPECT_EQ(suggestion("temperature", lengths, "there are: ground, crank"), "there are: ground, crank");
}

}  // namespace
}  // namespace linkwright::study
