// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/chain.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using test::problems_of;
using test::run_text;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string chain_study(const std::string& mechanism) {
  return "schema = 1\nkind = \"enumeration\"\ntitle = \"test\"\n[mechanism]\ntype = \"planar.chain\"\n" +
         mechanism;
}

TEST(ChainStudyRead, SaysWhatCannotBe) {
  EXPECT_THAT(problems_of(chain_study("")), HasSubstr("mechanism.links"));
  EXPECT_THAT(problems_of(chain_study("links = 12\n")), HasSubstr("is 12, must be at most 10"));
  EXPECT_THAT(problems_of(chain_study("links = 7\n")),
              HasSubstr("no chain of 7 links has 1 degree of freedom"));
  EXPECT_THAT(problems_of(chain_study("links = 7\n")), HasSubstr("write links = 6 or 8"));
  EXPECT_THAT(problems_of(chain_study("links = 4\nfreedoms = 3\n")), HasSubstr("write links = 6"));
  EXPECT_THAT(problems_of(chain_study("links = 4\nsliders = 4\n")), HasSubstr("write at most 3"));
  EXPECT_THAT(problems_of(chain_study("links = 6\ngear_pair = true\n")), HasSubstr("write freedoms = 2"));
  EXPECT_THAT(problems_of(chain_study("links = 6\nground = false\ndriver = true\n")),
              HasSubstr("write ground = true, or driver = false"));
  EXPECT_THAT(problems_of(chain_study("links = 10\nsliders = 3\n")),
              HasSubstr("take fewer sliders or links"));
}

double count(const study::Result& result, const std::string& key) {
  return result.table("counts")->find(key)->values.at(0);
}

TEST(ChainStudy, ListsSixBars) {
  const study::Result result = run_text(chain_study("links = 6\n"));
  EXPECT_EQ(result.status, Status::done);
  EXPECT_EQ(
      to_string(result.headline),
      "2 chains of 6 links with 1 degree of freedom; 5 mechanisms by their ground, 9 with a driven joint.");
  EXPECT_EQ(count(result, "graphs"), 3);
  EXPECT_EQ(count(result, "chains"), 2);
  EXPECT_EQ(count(result, "inversions"), 5);
  EXPECT_EQ(count(result, "mechanisms"), 9);
  EXPECT_EQ(count(result, "by_pairs"), 6);
  EXPECT_EQ(count(result, "traced_machines"), 8);
  EXPECT_EQ(count(result, "own_curves"), 7);
  const Table& chains = *result.table("chains");
  EXPECT_THAT(chains.names, ElementsAre("6-1", "6-2"));
  EXPECT_THAT(chains.find("ternary")->values, ElementsAre(2, 2));
  EXPECT_THAT(chains.find("joints")->values, ElementsAre(7, 7));
  const Table& mechanisms = *result.table("mechanisms");
  ASSERT_EQ(mechanisms.rows(), 9u);
  EXPECT_THAT(mechanisms.names, Contains(HasSubstr("Stephenson II (6-2/ground ")).Times(2));
  EXPECT_THAT(mechanisms.find("largest_group")->values, Contains(4).Times(3));
}

TEST(ChainStudy, DrawsEachMechanism) {
  const study::Result result = run_text(chain_study("links = 6\n"));
  ASSERT_EQ(result.scenes.size(), 1u);
  const study::Scene& sheet = result.scenes[0];
  EXPECT_EQ(sheet.bodies.size(), 9u * 6);
  EXPECT_EQ(sheet.joints.size(), 9u * 7);
  EXPECT_EQ(sheet.circles.size(), 9u);  // driven joints
  const auto ground = [](const auto& body) { return body.style == study::Scene::BodyStyle::ground; };
  EXPECT_EQ(std::count_if(sheet.bodies.begin(), sheet.bodies.end(), ground), 9);
}

TEST(ChainStudy, DrawsOnlyChainsWhereMechanismsAreMany) {
  const study::Result result = run_text(chain_study("links = 10\n"));
  EXPECT_EQ(count(result, "mechanisms"), 4506);
  EXPECT_EQ(count(result, "by_pairs"), 1283);
  EXPECT_EQ(result.scenes.size(), 12u);
  EXPECT_EQ(result.table("mechanisms")->rows(), 4506u);
  EXPECT_EQ(result.table("traced_machines"), nullptr);
}

TEST(ChainStudy, PlacesSlidersAndGears) {
  const study::Result sliders = run_text(chain_study("links = 4\nsliders = 2\ndriver = false\n"));
  EXPECT_EQ(count(sliders, "arrangements"), 2);
  EXPECT_EQ(count(sliders, "inversions"), 4);
  EXPECT_THAT(sliders.table("mechanisms")->names, Contains(HasSubstr("Oldham coupling (4-1/sliders ")));
  EXPECT_EQ(to_string(sliders.headline),
            "1 chain of 4 links with 1 degree of freedom: 2 with 2 sliders; 4 mechanisms by their ground.");
  const study::Result geared =
      run_text(chain_study("links = 7\nfreedoms = 2\ngear_pair = true\nground = false\n"));
  EXPECT_EQ(count(geared, "arrangements"), 15);
  EXPECT_EQ(count(geared, "locked"), 4);
  EXPECT_EQ(geared.table("mechanisms")->rows(), 15u);
  EXPECT_EQ(geared.scenes.at(0).circles.size(), 30u);
}

TEST(ChainStudy, ListsFractionatedChains) {
  const study::Result result =
      run_text(chain_study("links = 9\nfreedoms = 2\nfractionated = true\nground = false\n"));
  EXPECT_EQ(count(result, "chains"), 35);
  EXPECT_EQ(count(result, "fractionated"), 5);
  EXPECT_EQ(result.table("chains")->names.back(), "9-c5");
  EXPECT_EQ(result.table("mechanisms"), nullptr);
}

TEST(ChainStudy, StopsWhenAsked) {
  std::string messages;
  const auto study = test::prepare(chain_study("links = 10\n"), messages);
  ASSERT_TRUE(study) << messages;
  RunContext context;
  context.cancel();
  const study::Result result = study->run(context);
  EXPECT_EQ(result.status, Status::cancelled);
  EXPECT_TRUE(result.tables.empty());
}

}  // namespace
}  // namespace linkwright::planar
