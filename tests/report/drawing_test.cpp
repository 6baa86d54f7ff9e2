// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/numbers.h"
#include "tests/report/sample_result.h"

namespace linkwright::report {
namespace {

TEST(Drawing, BoundsLeaveOutWhatDoesNotExist) {
  study::Scene scene;
  EXPECT_TRUE(bounds(scene).empty());
  scene.points = {{"A", {1, nan, 3}, {5, 6, 4}}};
  study::Scene::Target target;
  target.x = {-1};
  target.y = {4.5};
  scene.targets = {target};
  const Box box = bounds(scene);
  EXPECT_EQ(box.x_min, -1);
  EXPECT_EQ(box.x_max, 3);
  EXPECT_EQ(box.y_min, 4);
  EXPECT_EQ(box.y_max, 5);
}

TEST(Drawing, LinesLoseOnlyWhatLiesOnThem) {
  const auto xs = [](const std::vector<Place>& line) {
    std::vector<double> out;
    for (const Place& p : line) out.push_back(p.x);
    return out;
  };
  const std::vector<Place> bent = {{0, 0}, {1, 0.05}, {2, 0}, {3, 1}, {4, 0}, {5, 0}};
  EXPECT_EQ(xs(simplified(bent, 0.1)), (std::vector<double>{0, 2, 3, 4, 5}));
  EXPECT_EQ(xs(simplified(bent, 0.01)), (std::vector<double>{0, 1, 2, 3, 4, 5}));
  // There and back again: what lies beyond the ends of a line is not on it.
  EXPECT_EQ(xs(simplified({{0, 0}, {5, 0}, {2, 0}}, 0.1)), (std::vector<double>{0, 5, 2}));
  EXPECT_EQ(xs(simplified({{0, 0}, {5, 0}, {-4, 0}, {0, 0}}, 0.1)), (std::vector<double>{0, 5, -4, 0}));
  EXPECT_EQ(xs(simplified({{0, 0}, {0, 0}}, 0.1)), (std::vector<double>{0, 0}));
  EXPECT_TRUE(simplified({}, 0.1).empty());
}

TEST(Drawing, CirclesTakeTheirRadius) {
  study::Scene scene;
  scene.input = {0, 1};
  scene.points = {{"O", {1}, {1}}, {"rim", {4, nan}, {5, nan}}};
  scene.circles = {{"wheel", 0, 1}};
  EXPECT_DOUBLE_EQ(radius(scene, scene.circles[0], 0), 5);
  EXPECT_TRUE(std::isnan(radius(scene, scene.circles[0], 1)));
  const Box box = bounds(scene);
  EXPECT_EQ(box.x_min, -4);
  EXPECT_EQ(box.y_max, 6);
}

TEST(Drawing, SymbolsRunFromPointToPoint) {
  using Style = study::Scene::BodyStyle;
  const Place a{1, 0}, b{1, 10};
  const auto spring = symbol_lines(Style::spring, a, b, 2);
  ASSERT_EQ(spring.size(), 1u);
  EXPECT_DOUBLE_EQ(spring[0].front().y, 0);
  EXPECT_DOUBLE_EQ(spring[0].back().y, 10);
  double left = 9, right = -9;
  for (const Place& p : spring[0]) left = std::min(left, p.x), right = std::max(right, p.x);
  EXPECT_DOUBLE_EQ(right - left, 2);
  EXPECT_EQ(symbol_lines(Style::damper, a, b, 2).size(), 4u);
  const auto guide = symbol_lines(Style::guide, a, b, 2);
  EXPECT_EQ(guide.size(), 6u);  // the line and a mark every width
  // Hatched on the right of the way from a to b, which points up here.
  for (std::size_t i = 1; i < guide.size(); ++i) EXPECT_GT(guide[i][1].x, 1);
  for (const Style style : {Style::ground, Style::bar, Style::plate})
    EXPECT_TRUE(symbol_lines(style, a, b, 2).empty());
  EXPECT_TRUE(symbol_lines(Style::spring, a, a, 2).empty());
  EXPECT_TRUE(symbol_lines(Style::spring, a, {nan, 0}, 2).empty());
}

TEST(Drawing, PlacesOfFixedMovingAndMissingPoints) {
  study::Scene scene;
  scene.input = {0, 1};
  scene.points = {{"O", {7}, {8}}, {"A", {1, nan}, {2, nan}}};
  EXPECT_EQ(place(scene, 0, 1).x, 7);
  EXPECT_EQ(place(scene, 1, 0).y, 2);
  EXPECT_FALSE(place(scene, 1, 1).finite());
  EXPECT_FALSE(place(scene, 2, 0).finite());
  EXPECT_FALSE(place(scene, -1, 0).finite());
  EXPECT_TRUE(assembled(scene, 0));
  EXPECT_FALSE(assembled(scene, 1));
}

TEST(Drawing, ReferenceSampleIsTheFirstAssembledOne) {
  study::Scene scene;
  scene.input = {0, 1, 2};
  scene.points = {{"A", {nan, 1, 1}, {nan, 1, 1}}};
  EXPECT_EQ(reference_sample(scene), 1u);
  scene.status = {"no_assembly", "no_assembly", "done"};
  EXPECT_EQ(reference_sample(scene), 2u);
  scene.status = {"no_assembly", "no_assembly", "no_assembly"};
  EXPECT_EQ(reference_sample(scene), 0u);
}

TEST(Drawing, NiceSteps) {
  EXPECT_DOUBLE_EQ(nice_step(9.9, 10), 0.5);
  EXPECT_DOUBLE_EQ(nice_step(30, 10), 2);
  EXPECT_DOUBLE_EQ(nice_step(0.012, 1), 0.01);
  EXPECT_EQ(nice_step(0, 5), 1);
  EXPECT_EQ(nice_step(nan, 5), 1);
}

TEST(Drawing, TicksAreMultiplesOfTheStep) {
  EXPECT_EQ(ticks(-0.5, 1.2, 0.5), (std::vector<double>{-0.5, 0, 0.5, 1}));
  EXPECT_TRUE(ticks(0.1, 0.4, 0.5).empty());
  EXPECT_EQ(ticks(1, std::nextafter(1.0, 2.0), 1e-300).size(), 40u);
}

TEST(Drawing, StepsOfAnglesArePartsOfATurn) {
  EXPECT_EQ(degree_step(360, 6), 90);
  EXPECT_EQ(degree_step(360, 8), 45);
  EXPECT_EQ(degree_step(120, 5), 30);
  EXPECT_EQ(degree_step(60, 6), 10);
  EXPECT_DOUBLE_EQ(degree_step(20, 6), 5);
  EXPECT_DOUBLE_EQ(degree_step(12, 6), 2);
  EXPECT_DOUBLE_EQ(degree_step(0.45, 6), 0.1);
  EXPECT_EQ(degree_step(7200, 6), 1800);
}

TEST(Drawing, BodiesOfOneRoleHaveOneNumber) {
  const auto numbers = [](std::initializer_list<const char*> names) {
    study::Scene scene;
    for (const char* name : names)
      scene.bodies.push_back({name,
                              {},
                              std::string_view(name) == "base" ? study::Scene::BodyStyle::ground
                                                               : study::Scene::BodyStyle::bar});
    return role_numbers(scene);
  };
  using Numbers = std::vector<std::size_t>;
  EXPECT_EQ(numbers({"base", "arm", "rod", "rod", "", "", "arm"}), (Numbers{0, 0, 1, 1, 2, 3, 0}));
  EXPECT_EQ(numbers({"right wishbone", "right tie rod", "left wishbone", "left tie rod"}),
            (Numbers{0, 1, 0, 1}));
  EXPECT_EQ(numbers({"arm 1", "rod 1", "arm 2", "rod 2", "platform"}), (Numbers{0, 1, 0, 1, 2}));
  EXPECT_EQ(numbers({"link 1", "link 2", "link 3"}), (Numbers{0, 1, 2}));
}

TEST(Drawing, UnitsFollowTheSize) {
  EXPECT_EQ(length_unit(0.3).symbol, "mm");
  EXPECT_EQ(length_unit(2).symbol, "m");
}

TEST(Drawing, WorstTarget) {
  study::Scene::Target target;
  EXPECT_FALSE(worst(target).any());
  target.x = {0, 0, 0};
  target.y = {0, 0, 0};
  target.achieved_x = {3, nan, 1};
  target.achieved_y = {4, nan, 1};
  EXPECT_EQ(worst(target).row, 0u);
  EXPECT_DOUBLE_EQ(worst(target).value, 5);
}

}  // namespace
}  // namespace linkwright::report
