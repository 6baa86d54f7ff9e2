// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/dxf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "tests/report/sample_result.h"

namespace linkwright::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The script check_dxf.py tests what other programs read.

TEST(Dxf, LayersCanBeLeftOut) {
  const auto result = test::sample_result();
  DxfOptions options;
  options.layers = {.ground = false, .links = true, .joints = false, .trace = false, .targets = false};
  const std::string text = dxf(result.scenes[0], options);
  const std::string entities = text.substr(text.find("ENTITIES"));
  EXPECT_THAT(entities, HasSubstr("POLYLINE\n  8\nLINKS\n"));
  for (const char* layer : {"GROUND", "JOINTS", "TRACE", "TARGETS"})
    EXPECT_THAT(entities, Not(HasSubstr(layer)));
}

TEST(Dxf, MissingPointsAreLeftOutAndTracesBroken) {
  const auto result = test::sample_result();
  const std::string text = dxf(result.scenes[2]);
  EXPECT_THAT(text, Not(HasSubstr("nan")));
  EXPECT_THAT(text, HasSubstr("POLYLINE\n  8\nTRACE\n"));
}

TEST(Dxf, NamesCannotAddLines) {
  auto result = test::sample_result();
  result.scenes[0].joints[0].name = "O\n  0\nEOF ö";
  EXPECT_THAT(dxf(result.scenes[0]), HasSubstr("\n  1\nO?  0?EOF ??\n"));
}

TEST(Dxf, SpringsGuidesAndCirclesAreDrawnAndArrowsAreNot) {
  study::Scene scene;
  scene.input = {0};
  scene.points = {{"O", {0}, {0}}, {"A", {0.25}, {0}}};
  scene.bodies = {{"spring", {0, 1}, study::Scene::BodyStyle::spring}};
  const std::string bare = dxf(scene);
  EXPECT_THAT(bare, HasSubstr("POLYLINE\n  8\nLINKS"));
  scene.vectors = {{"push", study::Scene::Quantity::force, "N", 1, {300}, {400}}};
  scene.moments = {{"torque", "N m", 0, {2}}};
  EXPECT_EQ(dxf(scene), bare);
  scene.bodies[0].style = study::Scene::BodyStyle::guide;
  EXPECT_THAT(dxf(scene), HasSubstr("POLYLINE\n  8\nGROUND"));
  scene.circles = {{"wheel", 0, 1}};
  EXPECT_THAT(dxf(scene), HasSubstr("CIRCLE\n  8\nLINKS\n 10\n0\n 20\n0\n 30\n0\n 40\n250\n"));
}

TEST(Dxf, ComparedMechanismsAreLeftOut) {
  study::Scene scene = test::sample_compared().scenes.at(0);
  const std::string together = dxf(scene, {});
  std::erase_if(scene.bodies, [](const auto& body) { return body.run > 0; });
  std::erase_if(scene.traces, [](const auto& trace) { return trace.run > 0; });
  EXPECT_TRUE(together == dxf(scene, {}));
}

TEST(Dxf, SpatialScenesAreDrawnInSpace) {
  study::Scene scene;
  scene.input = {0};
  scene.second = {0, 1};
  scene.points = {{"A", {0.1}, {0.2}, {0.3}}, {"B", {0.1}, {0.7, 0.8}, {0.3}}};
  scene.bodies = {{"bar", {0, 1}, study::Scene::BodyStyle::bar},
                  {"hinge", {0, 1}, study::Scene::BodyStyle::axis},
                  {"spring", {0, 1}, study::Scene::BodyStyle::spring}};
  scene.joints = {{"A", 0, study::Scene::JointStyle::ground_pivot}};
  scene.discs = {{"wheel", 1, 0, 0.3, 0.2}};
  DxfOptions options;
  options.sample = 1;
  const std::string text = dxf(scene, options);
  EXPECT_THAT(text,
              HasSubstr("LINE\n  8\nLINKS\n 10\n100\n 20\n200\n 30\n300\n 11\n100\n 21\n800\n 31\n300\n"));
  // 15 % of 600 mm beyond A.
  EXPECT_THAT(text, HasSubstr("LINE\n  8\nAXES\n 10\n100\n 20\n110\n 30\n300\n"));
  EXPECT_THAT(text, HasSubstr("POLYLINE\n  8\nWHEELS\n 66\n     1\n 10\n0\n 20\n0\n 30\n0\n 70\n     9\n"));
  EXPECT_THAT(text, HasSubstr("POINT\n  8\nJOINTS\n"));
  EXPECT_THAT(text, Not(HasSubstr("CIRCLE")));
  // The lowest and highest place of the wheel.
  EXPECT_THAT(text, HasSubstr(" 30\n0\n  9\n$EXTMAX"));
}

TEST(Dxf, PlanarScenesHaveNoSpatialLayers) {
  const std::string text = dxf(test::sample_result().scenes[0]);
  EXPECT_THAT(text, Not(HasSubstr("AXES")));
  EXPECT_THAT(text, Not(HasSubstr("WHEELS")));
}

TEST(Dxf, EmptySceneIsAnEmptyDrawing) {
  const std::string text = dxf(study::Scene());
  EXPECT_THAT(text, HasSubstr("ENTITIES\n  0\nENDSEC\n  0\nEOF\n"));
}

TEST(Dxf, SampleOutsideTheSceneBreaksTheContract) {
  DxfOptions options;
  options.sample = 0;
  EXPECT_THROW(dxf(study::Scene(), options), ContractError);
}

}  // namespace
}  // namespace linkwright::report
