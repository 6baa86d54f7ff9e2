// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/step.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/report/flat_scene.h"

namespace linkwright::report {
namespace {

using test::parallel_crank, test::sizes, test::Scene;
using ::testing::HasSubstr;

/// The entities of a STEP file by number: "LINE('',#1,#2)".
std::map<int, std::string> entities(const std::string& text) {
  std::map<int, std::string> out;
  for (std::size_t at = 0; (at = text.find("\n#", at)) != std::string::npos; ++at) {
    const std::size_t equal = text.find('=', at), end = text.find(";\n", at);
    out[std::atoi(text.c_str() + at + 2)] = text.substr(equal + 1, end - equal - 1);
  }
  return out;
}

std::vector<int> references(const std::string& entity) {
  std::vector<int> out;
  for (std::size_t at = 0; (at = entity.find('#', at)) != std::string::npos; ++at)
    out.push_back(std::atoi(entity.c_str() + at + 1));
  return out;
}

TEST(Step, EveryEdgeJoinsTwoFacesInOppositeDirections) {
  const std::string text = step(parallel_crank(), sizes);
  const auto all = entities(text);
  std::map<int, std::pair<int, int>> uses;  // of edges, forwards and backwards
  int solids = 0, cylinders = 0;
  for (const auto& [id, entity] : all) {
    for (const int other : references(entity)) EXPECT_EQ(all.count(other), 1U) << entity;
    if (entity.starts_with("ORIENTED_EDGE"))
      ++(entity.find(".T.") != std::string::npos ? uses[references(entity)[0]].first
                                                 : uses[references(entity)[0]].second);
    solids += entity.starts_with("MANIFOLD_SOLID_BREP");
    cylinders += entity.starts_with("CYLINDRICAL_SURFACE");
  }
  EXPECT_EQ(solids, 8);      // 4 links and 4 pins
  EXPECT_EQ(cylinders, 20);  // 2 rounded ends and 2 holes of each link, and the pins
  for (const auto& [edge, use] : uses) EXPECT_EQ(use, std::pair(1, 1)) << all.at(edge);
}

TEST(Step, EdgesOfALoopFollowEachOther) {
  const auto all = entities(step(parallel_crank(), sizes));
  const auto ends = [&](int oriented) {
    const std::vector<int> edge = references(all.at(references(all.at(oriented))[0]));
    const bool forward = all.at(oriented).find(".T.") != std::string::npos;
    return forward ? std::pair(edge[0], edge[1]) : std::pair(edge[1], edge[0]);
  };
  int loops = 0;
  for (const auto& [id, entity] : all) {
    if (!entity.starts_with("EDGE_LOOP")) continue;
    ++loops;
    const std::vector<int> edges = references(entity);
    for (std::size_t i = 0; i < edges.size(); ++i)
      EXPECT_EQ(ends(edges[i]).second, ends(edges[(i + 1) % edges.size()]).first) << entity;
  }
  EXPECT_GT(loops, 50);
}

TEST(Step, NamesArePlainAndScenesInSpaceHaveNoParts) {
  Scene scene = parallel_crank();
  scene.bodies[0].name = "l'axe é";
  const std::string text = step(scene, sizes);
  EXPECT_THAT(text, HasSubstr("MANIFOLD_SOLID_BREP('l''axe ?"));
  EXPECT_THAT(text, HasSubstr("SI_UNIT(.MILLI.,.METRE.)"));
  scene.points[0].z = {0};
  EXPECT_EQ(step(scene, sizes), "");
}

}  // namespace
}  // namespace linkwright::report
