// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "tests/report/sample_result.h"
#include "tests/report/sample_spatial.h"
#include "tests/report/well_formed.h"

namespace linkwright::report {
namespace {

using test::count;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Svg, DrawsEveryPartOfTheScene) {
  const auto result = test::sample_result();
  const std::string picture = svg(result.scenes[0]);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_EQ(count(picture, "class=\"body\""), 4u);
  EXPECT_EQ(count(picture, "class=\"joint\""), 5u);
  EXPECT_EQ(count(picture, "class=\"trace\""), 1u);
  EXPECT_EQ(count(picture, "class=\"worst\""), 1u);
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
}

TEST(Svg, OptionsLeaveThingsOut) {
  const auto result = test::sample_result();
  SvgOptions options;
  options.grid = options.traces = options.targets = options.labels = false;
  const std::string bare = svg(result.scenes[0], options);
  EXPECT_THAT(bare, Not(HasSubstr("class=\"grid\"")));
  EXPECT_THAT(bare, Not(HasSubstr("class=\"trace\"")));
  EXPECT_THAT(bare, Not(HasSubstr("class=\"target\"")));
  EXPECT_THAT(bare, Not(HasSubstr("<text")));
  options.ghosts = 4;
  EXPECT_EQ(count(svg(result.scenes[0], options), "class=\"body\""), 20u);
}

TEST(Svg, GridLinesAreAtRoundNumbersOfTheUnitShown) {
  const auto result = test::sample_result();
  SvgOptions options;
  options.length = LengthUnit{1 / 0.0254, "in"};
  const std::string picture = svg(result.scenes[0], options);
  const std::string grid = picture.substr(picture.find("<g class=\"grid\""));
  const std::regex label("<text[^>]*>([^<]*)</text>");
  std::vector<double> shown;
  for (std::sregex_iterator at(grid.begin(), grid.begin() + static_cast<long>(grid.find("</g>")), label), end;
       at != end; ++at)
    if ((*at)[1] != "in") shown.push_back(std::stod((*at)[1].str()));
  ASSERT_GT(shown.size(), 6u);
  const double step = shown[1] - shown[0];
  EXPECT_THAT(step, ::testing::AnyOf(1, 2, 5, 10, 20, 50));
  for (const double number : shown) EXPECT_EQ(std::remainder(number, step), 0) << number;
}

TEST(Svg, RolesHaveTheColoursOfThePage) {
  std::ifstream file(LINKWRIGHT_SOURCE_DIR "/web/src/report.css");
  const std::string css(std::istreambuf_iterator<char>(file), {});
  study::Scene scene;
  scene.input = {0};
  const std::string light = css.substr(0, css.find("prefers-color-scheme: dark"));
  const std::regex colour("--c[0-9]+: (#[0-9a-f]{6});");
  std::vector<std::string> wanted;
  for (std::sregex_iterator c(light.begin(), light.end(), colour), end; c != end; ++c) {
    std::string upper = (*c)[1];
    for (char& letter : upper) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    wanted.push_back(upper);
    const int n = static_cast<int>(scene.points.size());
    scene.points.push_back({"", {0.1 * n}, {0}});
    scene.points.push_back({"", {0.1 * n}, {0.1}});
    scene.bodies.push_back({std::string(1, static_cast<char>('a' + n / 2)) + " body", {n, n + 1}});
  }
  ASSERT_EQ(wanted.size(), 18U);
  const std::string picture = svg(scene);
  for (const std::string& one : wanted) EXPECT_EQ(count(picture, "stroke=\"" + one + "\""), 1U) << one;
}

// A crank of 0.5 m with everything that is drawn of forces and machine parts.
study::Scene machine() {
  using Body = study::Scene::BodyStyle;
  using Quantity = study::Scene::Quantity;
  study::Scene scene;
  scene.input = {0, 1};
  scene.points = {{"O", {0}, {0}}, {"A", {0.5, 0}, {0, 0.5}}, {"F", {1}, {0}}};
  scene.bodies = {{"crank", {0, 1}, Body::bar},
                  {"return spring", {1, 2}, Body::spring},
                  {"damper", {1, 2}, Body::damper},
                  {"slide", {0, 2}, Body::guide}};
  scene.joints = {{"O", 0, study::Scene::JointStyle::ground_pivot}};
  scene.circles = {{"wheel", 0, 1}};
  scene.vectors = {{"push", Quantity::force, "N", 1, {300, -100}, {400, 0}, "F1"},
                   {"speed", Quantity::velocity, "m/s", 1, {0, -2}, {2, 0}},
                   {"pull", Quantity::acceleration, "m/s2", 1, {-8, 0}, {0, nan}}};
  scene.moments = {{"drive torque", "N m", 0, {2, -1}}};
  return scene;
}

TEST(Svg, DrawsForcesWithTheirScale) {
  const std::string picture = svg(machine());
  EXPECT_EQ(test::fault_of_xml(picture), "");
  // The arrow and the one of the key.
  EXPECT_EQ(count(picture, "class=\"arrow force\""), 2u);
  EXPECT_THAT(picture, HasSubstr("<title>push: 500 N</title>"));
  EXPECT_THAT(picture, HasSubstr("text-anchor=\"start\">F1</text>"));
  EXPECT_THAT(picture, HasSubstr(">force 500 N</text>"));
  EXPECT_THAT(picture, HasSubstr("<title>drive torque: 2 N m</title>"));
  EXPECT_THAT(picture, HasSubstr(">full arc 2 N m</text>"));
  EXPECT_THAT(picture, Not(HasSubstr("arrow velocity")));
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
}

TEST(Svg, QuantitiesCanBeChosenAndFollowTheSample) {
  SvgOptions options;
  options.forces = false;
  options.velocities = options.accelerations = true;
  options.sample = 1;
  const std::string picture = svg(machine(), options);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_THAT(picture, Not(HasSubstr("force")));
  EXPECT_THAT(picture, Not(HasSubstr("class=\"moment\"")));
  EXPECT_THAT(picture, HasSubstr("<title>speed: 2 m/s</title>"));
  // The acceleration is not known here; its key stands.
  EXPECT_THAT(picture, Not(HasSubstr("<title>pull")));
  EXPECT_THAT(picture, HasSubstr(">acceleration 5 m/s2</text>"));
  options.forces = true;
  EXPECT_THAT(svg(machine(), options), HasSubstr("<title>push: 100 N</title>"));
}

TEST(Svg, ManyShortBarsAreThin) {
  study::Scene chain;
  chain.input = {0};
  for (int i = 0; i <= 81; ++i) {
    chain.points.push_back({"", {0.1 * i}, {0}});
    if (i > 0) chain.bodies.push_back({"bar", {i - 1, i}, study::Scene::BodyStyle::bar});
  }
  const std::string thin = svg(chain);
  EXPECT_THAT(thin, Not(HasSubstr("stroke-width=\"13\"")));
  chain.bodies.resize(1);
  chain.points.resize(2);
  EXPECT_THAT(svg(chain), HasSubstr("stroke-width=\"13\""));
}

TEST(Svg, SceneWithoutArrowsHasNoKey) {
  EXPECT_THAT(svg(test::sample_result().scenes[0]), Not(HasSubstr("class=\"key\"")));
}

TEST(Svg, DrawsSpringsDampersGuidesAndCircles) {
  const std::string picture = svg(machine());
  for (const char* name : {"return spring", "damper", "slide", "wheel"})
    EXPECT_THAT(picture, HasSubstr(std::string("<title>") + name + "</title>"));
  EXPECT_EQ(count(picture, "class=\"circle\""), 1u);
}

TEST(Svg, SpatialScenesAreSeenFromThreeSides) {
  const auto result = test::sample_spatial();
  const std::string picture = svg(result.scenes[0]);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_EQ(count(picture, "class=\"view\""), 3u);
  for (const char* name : {">rear view</text>", ">side view from the left</text>", ">top view</text>"})
    EXPECT_THAT(picture, HasSubstr(name));
  EXPECT_EQ(count(picture, "class=\"wheel\""), 3u);
  EXPECT_EQ(count(picture, "class=\"joint\""), 30u);
  EXPECT_EQ(count(picture, "<title>steering axis</title>"), 3u);
  // The arrow of the force is seen from behind and from the side, and stands in the one key; from above it is
  // a point.
  EXPECT_EQ(count(picture, "class=\"arrow force\""), 3u);
  EXPECT_THAT(picture, HasSubstr("<title>tyre force: 4000 N</title>"));
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
}

TEST(Svg, SpatialNumbersGrowToTheLeft) {
  study::Scene scene;
  scene.input = {0};
  scene.points = {{"A", {0}, {0}, {0}}, {"B", {0.5}, {0.4}, {0.3}}};
  scene.bodies = {{"bar", {0, 1}, study::Scene::BodyStyle::bar}};
  const std::string picture = svg(scene);
  const std::size_t near = picture.find(">0</text>"), far = picture.find(">200</text>");
  ASSERT_NE(near, std::string::npos);
  ASSERT_NE(far, std::string::npos);
  EXPECT_LT(far, near);  // written from left to right
  EXPECT_THAT(picture, HasSubstr("text-anchor=\"end\">y (mm)</text>"));
}

TEST(Svg, SecondInputsAreDrawnWithTheirSample) {
  study::Scene scene;
  scene.input = {0, 1};
  scene.second = {0, 1};
  scene.points = {{"O", {0}, {0}}, {"A", {1, 2, 3, 4}, {1, 1, 1, 1}}};
  scene.bodies = {{"bar", {0, 1}, study::Scene::BodyStyle::bar}};
  scene.traces = {{1, "path"}};
  SvgOptions options;
  options.sample = 3;
  study::Scene row = scene;
  row.second.clear();
  row.points[1].x = {3, 4};
  row.points[1].y = {1, 1};
  const std::string picture = svg(scene, options);
  options.sample = 1;
  EXPECT_EQ(picture, svg(row, options));
}

TEST(Svg, EmptySpatialSceneSaysSo) {
  study::Scene scene;
  scene.input = {0};
  scene.points = {{"A", {nan}, {nan}, {nan}}};
  EXPECT_THAT(svg(scene), HasSubstr("Nothing to draw: the mechanism assembles at no input."));
}

TEST(Svg, UnassembledSamplesAreLeftOut) {
  auto result = test::sample_result();
  const auto& scene = result.scenes[2];
  std::size_t missing = 0;
  while (scene.status[missing] == "done") ++missing;
  SvgOptions options;
  options.sample = missing;
  const std::string picture = svg(scene, options);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
  // Ground and crank stay; what hangs on the open loop is gone.
  EXPECT_EQ(count(picture, "class=\"body\""), 2u);
}

TEST(Svg, ComparedMechanismsAreThinAndNamed) {
  const std::string picture = svg(test::sample_compared().scenes.at(0), {});
  EXPECT_EQ(test::fault_of_xml(picture), "");
  for (const char* name : {">short</text>", ">middle</text>", ">long</text>"})
    EXPECT_THAT(picture, HasSubstr(name));
  EXPECT_THAT(picture,
              HasSubstr("stroke=\"#D55E00\" stroke-width=\"1.6\" stroke-dasharray=\"8 4\"><title>crank of "
                        "middle</title>"));
  EXPECT_THAT(picture,
              HasSubstr("stroke=\"#009E73\" stroke-width=\"1.6\" stroke-dasharray=\"2 3\"><title>crank of "
                        "long</title>"));
  // Their paths have their colours.
  EXPECT_THAT(picture, HasSubstr("stroke=\"#009E73\" stroke-width=\"1.4\""));
}

TEST(Svg, AGapIsDashedAndSaysHowLongItIs) {
  study::Scene scene;
  scene.input = {0, 1};
  scene.status = {"no_assembly", "done"};
  scene.points = {{"A", {0, nan}, {0, nan}}, {"B", {0.3, nan}, {0.4, nan}}, {"O", {-1}, {-1}}};
  scene.bodies = {{"rod cannot close", {0, 1}, study::Scene::BodyStyle::gap}};
  SvgOptions options;
  options.sample = 0;
  const std::string open = svg(scene, options);
  EXPECT_EQ(test::fault_of_xml(open), "");
  EXPECT_THAT(open, HasSubstr("<title>rod cannot close</title>"));
  EXPECT_THAT(open, HasSubstr("stroke-dasharray=\"6 5\""));
  EXPECT_THAT(open, HasSubstr(">gap 500 mm</text>"));
  options.sample = 1;
  EXPECT_THAT(svg(scene, options), Not(HasSubstr("cannot close")));
}

TEST(Svg, HostileNamesStayText) {
  auto result = test::sample_result();
  auto& scene = result.scenes[0];
  scene.title = test::hostile;
  scene.bodies[1].name = scene.joints[0].name = scene.traces[0].name = scene.targets[0].name = test::hostile;
  const std::string picture = svg(scene);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_THAT(picture, Not(HasSubstr("<script")));
  EXPECT_THAT(picture, Not(HasSubstr("<img")));
}

TEST(Svg, EmptySceneSaysSo) {
  study::Scene scene;
  EXPECT_THAT(svg(scene), HasSubstr("Nothing to draw: the mechanism assembles at no input."));
  scene.input = {0};
  scene.points = {{"A", {nan}, {nan}}};
  EXPECT_EQ(test::fault_of_xml(svg(scene)), "");
}

TEST(Svg, BadIndicesAndSingleValuesAreHarmless) {
  study::Scene scene;
  scene.input = {0};
  scene.points = {{"A", {1}, {1}}};
  scene.bodies = {{"odd", {0, 9}, study::Scene::BodyStyle::bar},
                  {"lonely", {0}, study::Scene::BodyStyle::plate}};
  scene.joints = {{"gone", 5, study::Scene::JointStyle::pivot}};
  const std::string picture = svg(scene);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_THAT(picture, Not(HasSubstr("class=\"body\"")));
}

TEST(Svg, SampleOutsideTheSceneBreaksTheContract) {
  const auto result = test::sample_result();
  SvgOptions options;
  options.sample = 361;
  try {
    svg(result.scenes[0], options);
    FAIL();
  } catch (const ContractError& error) {
    EXPECT_THAT(error.what(), HasSubstr("sample 361 of a scene with 361 samples"));
  }
}

}  // namespace
}  // namespace linkwright::report
