#include "linkwright/report/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "linkwright/core/check.h"
#include "tests/report/sample_result.h"
#include "tests/report/well_formed.h"

namespace linkwright::report {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

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

TEST(Svg, HostileNamesStayText) {
  auto result = test::sample_result();
  auto& scene = result.scenes[0];
  scene.title = scene.bodies[1].name = scene.joints[0].name = scene.traces[0].name = scene.targets[0].name =
      test::hostile;
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
