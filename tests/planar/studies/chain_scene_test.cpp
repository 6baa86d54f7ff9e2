// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/chain_scene.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/vector2.h"

namespace linkwright::planar {
namespace {

using study::Scene;

std::vector<ChainFigure> figures_of(const std::vector<Chain>& all) {
  std::vector<ChainFigure> out;
  for (const Chain& chain : all) out.push_back({&chain, {}, chain.name});
  return out;
}

TEST(ChainSheets, HoldTwentyFiguresEach) {
  const std::vector<Chain> all = chains(9, 2);
  const std::vector<Scene> sheets = chain_sheets(figures_of(all));
  ASSERT_EQ(sheets.size(), 2u);
  EXPECT_EQ(sheets[0].name, "sheet-1");
  EXPECT_EQ(to_string(sheets[1].title), "Sketches 2 of 2");
  EXPECT_EQ(sheets[0].bodies.size(), 20u * 9);
  EXPECT_EQ(sheets[1].bodies.size(), 15u * 9);
  // One joint of each figure carries its name.
  const auto named = [](const Scene::Joint& joint) { return !joint.name.empty(); };
  EXPECT_EQ(std::count_if(sheets[1].joints.begin(), sheets[1].joints.end(), named), 15);
  for (const Scene& sheet : sheets)
    for (const Scene::Point& p : sheet.points)
      EXPECT_TRUE(std::isfinite(p.x.at(0)) && std::isfinite(p.y.at(0)));
}

TEST(ChainSheets, DrawGroundSlidersAndDriver) {
  const std::vector<Chain> all = chains(4, 1);
  const Chain& four_bar = all.front();
  std::vector<ChainFigure> figures;
  for (const Marking& m : markings(four_bar, {.sliders = 1, .ground = true, .driver = true}))
    figures.push_back({&four_bar, m, "x"});
  const std::vector<Scene> sheets = chain_sheets(figures);
  ASSERT_EQ(sheets.size(), 1u);
  const auto guides = std::count_if(sheets[0].bodies.begin(), sheets[0].bodies.end(),
                                    [](const auto& body) { return body.style == Scene::BodyStyle::guide; });
  EXPECT_EQ(guides, std::ssize(figures));
  EXPECT_EQ(sheets[0].circles.size(), figures.size());
}

// Pitch circles touch where both have their mark.
TEST(ChainSheets, DrawGearsThatTouch) {
  const std::vector<Chain> all = chains(5, 2);
  const Marking geared = markings(all.front(), {.gear = true}).front();
  const std::vector<ChainFigure> figures{{&all.front(), geared, "geared five-bar"}};
  const Scene sheet = chain_sheets(figures).front();
  ASSERT_EQ(sheet.circles.size(), 2u);
  EXPECT_EQ(sheet.circles[0].rim, sheet.circles[1].rim);
  const auto at_point = [&](int k) { return math::Vec2{sheet.points[at(k)].x[0], sheet.points[at(k)].y[0]}; };
  const math::Vec2 a = at_point(sheet.circles[0].centre), b = at_point(sheet.circles[1].centre),
                   mesh = at_point(sheet.circles[0].rim);
  EXPECT_NEAR(std::hypot(mesh.x - a.x, mesh.y - a.y), std::hypot(mesh.x - b.x, mesh.y - b.y), 1e-12);
}

}  // namespace
}  // namespace linkwright::planar
