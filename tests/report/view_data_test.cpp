// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/view_data.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "linkwright/study/answer.h"
#include "linkwright/study/design.h"
#include "linkwright/study/write.h"
#include "tests/report/sample_result.h"

namespace linkwright::report {
namespace {

Value data(const study::Result& result) {
  return view_data({.result = result,
                    .units = {},
                    .study_toml = {},
                    .title = "T",
                    .source = {},
                    .tool = {},
                    .command = {},
                    .result_json = {}});
}

TEST(ViewData, CoordinatesHaveNineDigitsAndErrorsAllOfThem) {
  study::Result result;
  study::Scene scene;
  scene.input = {0};
  scene.points = {{"A", {0.123456789012345}, {1}}};
  study::Scene::Target target;
  target.x = {0.123456789012345};
  target.y = {0};
  scene.targets = {target};
  result.scenes = {scene};
  const Value out = data(result);
  const Value& drawn = out.find("scenes")->as_array()[0];
  EXPECT_EQ(study::to_json(*drawn.find("points")->as_array()[0].find("x")), "[0.123456789]");
  EXPECT_EQ(drawn.find("targets")->as_array()[0].find("x")->as_array()[0].as_number(), 0.123456789012345);
}

TEST(ViewData, ArrowsCouplesCirclesAndPolarPlots) {
  study::Result result;
  study::Scene scene;
  scene.bodies = {{"s", {}, study::Scene::BodyStyle::spring},
                  {"d", {}, study::Scene::BodyStyle::damper},
                  {"g", {}, study::Scene::BodyStyle::guide}};
  scene.circles = {{"wheel", 1, 2}};
  scene.vectors = {{"v", study::Scene::Quantity::velocity, "m/s", 3, {1, NAN}, {0.123456789012345}, "vA"}};
  scene.moments = {{"drive", "N m", 4, {-5}, "M"}};
  result.scenes = {scene};
  result.plots = {{.name = "p",
                   .title = "P",
                   .table = "t",
                   .x = "",
                   .y = {},
                   .style = study::Plot::Style::polar,
                   .scene = {}}};
  const Value out = data(result);
  const Value& drawn = out.find("scenes")->as_array()[0];
  EXPECT_EQ(study::to_json(*drawn.find("circles")), R"([{"name":"wheel","centre":1,"rim":2}])");
  EXPECT_EQ(
      study::to_json(*drawn.find("vectors")),
      R"([{"name":"v","quantity":"velocity","unit":"m/s","point":3,"x":[1.0,null],"y":[0.123456789],"symbol":"vA"}])");
  EXPECT_EQ(study::to_json(*drawn.find("moments")),
            R"([{"name":"drive","unit":"N m","point":4,"value":[-5.0],"symbol":"M"}])");
  const char* styles[] = {"spring", "damper", "guide"};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(drawn.find("bodies")->as_array()[i].find("style")->as_string(), styles[i]);
  EXPECT_EQ(out.find("plots")->as_array()[0].find("style")->as_string(), "polar");
}

TEST(ViewData, ArrowsAreInTheUnitsThatAreShown) {
  study::Result result;
  study::Scene scene;
  scene.vectors = {{"v", study::Scene::Quantity::velocity, "m/s", 3, {1.5}, {-0.25}, "vA"},
                   {"f", study::Scene::Quantity::force, "N", 3, {2}, {3}, "F"}};
  result.scenes = {scene};
  ReportInput input{.result = result};
  input.units.choose(*split_unit("crank_mm"));
  input.units.follow();
  const Value out = view_data(input);
  EXPECT_EQ(
      study::to_json(*out.find("scenes")->as_array()[0].find("vectors")),
      R"([{"name":"v","quantity":"velocity","unit":"mm/s","point":3,"x":[1500.0],"y":[-250.0],"symbol":"vA"},)"
      R"({"name":"f","quantity":"force","unit":"N","point":3,"x":[2.0],"y":[3.0],"symbol":"F"}])");
}

TEST(ViewData, SpatialScenesAndTheirPlots) {
  study::Result result;
  study::Scene scene;
  scene.input = {0};
  scene.second_key = "rack_m";
  scene.second_label = "rack";
  scene.second = {-0.01, 0.01};
  scene.points = {{"A", {1}, {2}, {3, 4}}, {"B", {1}, {2}}};
  scene.bodies = {{"hinge", {0, 1}, study::Scene::BodyStyle::axis}};
  scene.discs = {{"wheel", 0, 1, 0.3, 0.2}};
  scene.vectors = {{"f", study::Scene::Quantity::force, "N", 0, {1}, {2}, "F", {3}}};
  result.scenes = {scene};
  study::Plot plot;
  plot.group = "rack_m";
  plot.bands = {{"low", "high", "target"}};
  plot.baseline = "before";
  result.plots = {plot, study::Plot()};
  const Value out = data(result);
  const Value& drawn = out.find("scenes")->as_array()[0];
  EXPECT_EQ(drawn.find("second_key")->as_string(), "rack_m");
  EXPECT_EQ(drawn.find("second_label")->as_string(), "rack");
  EXPECT_EQ(study::to_json(*drawn.find("second")), "[-0.01,0.01]");
  EXPECT_EQ(study::to_json(*drawn.find("points")),
            R"([{"name":"A","x":[1.0],"y":[2.0],"z":[3.0,4.0]},{"name":"B","x":[1.0],"y":[2.0]}])");
  EXPECT_EQ(drawn.find("bodies")->as_array()[0].find("style")->as_string(), "axis");
  EXPECT_EQ(study::to_json(*drawn.find("discs")),
            R"([{"name":"wheel","centre":0,"axis":1,"radius":0.3,"width":0.2}])");
  EXPECT_EQ(study::to_json(*drawn.find("vectors")->as_array()[0].find("z")), "[3.0]");
  const auto& plots = out.find("plots")->as_array();
  EXPECT_EQ(plots[0].find("group")->as_string(), "rack_m");
  EXPECT_EQ(study::to_json(*plots[0].find("bands")), R"([{"lower":"low","upper":"high","label":"target"}])");
  EXPECT_EQ(plots[0].find("baseline")->as_string(), "before");
  // A planar report does not carry keys that it does not have.
  for (const char* key : {"group", "bands", "baseline"}) EXPECT_EQ(plots[1].find(key), nullptr) << key;
}

TEST(ViewData, NamesOfStylesAndStatus) {
  const Value out = data(test::sample_result());
  const Value& scene = out.find("scenes")->as_array()[0];
  EXPECT_EQ(scene.find("bodies")->as_array()[0].find("style")->as_string(), "ground");
  EXPECT_EQ(scene.find("bodies")->as_array()[2].find("style")->as_string(), "plate");
  EXPECT_EQ(scene.find("joints")->as_array()[4].find("style")->as_string(), "tracer");
  EXPECT_EQ(out.find("plots")->as_array()[0].find("style")->as_string(), "line");
  EXPECT_EQ(out.find("status")->as_string(), "done");
  EXPECT_EQ(out.find("solution_scenes")->as_array()[2].as_string(), "solution-3");
}

TEST(ViewData, DesignsAreFilesOfTheirSolutions) {
  const study::Result result = test::sample_result();
  const Value out = data(result);
  const auto& designs = out.find("designs")->as_array();
  ASSERT_EQ(designs.size(), 2u) << "the third solution has no study";
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const study::Solution& solution = result.solutions[i];
    EXPECT_EQ(designs[i].find("solution")->as_integer(), static_cast<std::int64_t>(i));
    EXPECT_EQ(designs[i].find("name")->as_string(), study::design_name(solution, i + 1));
    EXPECT_EQ(
        designs[i].find("toml")->as_string(),
        study::design_toml(solution, i + 1, out.find("title")->as_string(), out.find("tool")->as_string()));
  }
}

// The types of the viewer, without comments.
std::string viewer_types() {
  std::ifstream file(LINKWRIGHT_SOURCE_DIR "/web/src/data.ts");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  return std::regex_replace(text, std::regex(R"(//[^\n]*|/\*([^*]|\*[^/])*\*/)"), "");
}
// Keys of the type that begins where `type` ends, with a brace.
std::set<std::string> keys_of(std::string_view type) {
  std::set<std::string> out;
  std::string word;
  int depth = 0;
  for (const char c : type) {
    if (c == '{') ++depth;
    if (c == '}' && --depth == 0) break;
    if (c == ';' || c == '{' || c == '}') word.clear();
    if (depth == 1 && c == ':') out.insert(word);
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') word += c;
  }
  return out;
}
std::set<std::string> keys_of(const Value& object) {
  std::set<std::string> out;
  for (const auto& member : object.as_object()) out.insert(member.key);
  return out;
}

TEST(ViewData, TheViewerHasTheSameKeys) {
  const auto first_of = [](const Value& object, std::string_view key) -> const Value& {
    return object.find(key)->as_array().at(0);
  };
  study::Result result;
  study::Scene scene;
  scene.second = {1};
  scene.second_key = "rack_m";
  scene.points = {{"A", {1}, {2}, {3}}};
  scene.runs = {"before", "after"};
  scene.bodies = {{"crank", {0}, study::Scene::BodyStyle::bar, 1}};
  scene.joints.resize(1);
  scene.traces = {{0, "A", false, 1}};
  scene.targets.resize(1);
  scene.circles.resize(1);
  scene.discs.resize(1);
  scene.frames.resize(1);
  scene.handles.resize(1);
  scene.vectors = {{"f", study::Scene::Quantity::force, "N", 0, {1}, {2}, "F", {3}}};
  scene.moments.resize(1);
  result.scenes = {scene};
  study::Plot plot;
  plot.group = plot.baseline = "some";
  plot.group_names = {"before", "after"};
  plot.bands.resize(1);
  plot.upright = true;
  result.plots = {plot};
  result.facts = {
      {"contact", say("kept: minimum tension {}, at a crank angle of {}", newtons(2.008), degrees_of(0.96))}};
  result.solutions.resize(1);
  result.solutions[0].parameters.resize(1);
  result.solutions[0].study["mechanism"]["type"] = "planar.four_bar";
  result.changes.resize(1);
  result.comparisons.resize(1);
  // A page with the program behind it has the handles that a report leaves out.
  EXPECT_EQ(first_of(data(result), "scenes").find("handles"), nullptr);
  std::vector<double> numbers;
  const Value out = view_data({.result = result, .lists = NumberLists(numbers)});
  const std::string types = viewer_types();
  const auto expect = [&](const std::string& type, const Value& written) {
    const std::size_t at = types.find(type + " {");
    ASSERT_NE(at, std::string::npos) << type;
    EXPECT_EQ(keys_of(std::string_view(types).substr(at)), keys_of(written)) << type;
  };
  expect("interface View", out);
  for (const auto& [key, type] : {std::pair{"facts", "interface Fact"},
                                  {"units", "interface ShownSuffix"},
                                  {"scenes", "interface Scene"},
                                  {"plots", "interface Plot"},
                                  {"designs", "interface Design"},
                                  {"changes", "interface Change"},
                                  {"comparisons", "interface Comparison"}})
    expect(type, first_of(out, key));
  expect("interface Parameter", out.find("parameters")->as_array().at(0).as_array().at(0));
  expect("bands?:", first_of(first_of(out, "plots"), "bands"));
  for (const auto& [key, type] : {std::pair{"points", "points:"},
                                  {"bodies", "bodies:"},
                                  {"joints", "joints:"},
                                  {"traces", "traces:"},
                                  {"targets", "interface Target"},
                                  {"circles", "circles:"},
                                  {"discs", "interface Disc"},
                                  {"vectors", "interface Vector"},
                                  {"moments", "interface Moment"},
                                  {"frames", "frames?:"},
                                  {"handles", "handles?:"}})
    expect(type, first_of(first_of(out, "scenes"), key));
}

template <class E>
std::string union_of_words() {
  std::string out;
  for (const auto& word : names(E{})) out += fmt::format("{}\"{}\"", out.empty() ? "" : " | ", word.name);
  return out;
}

TEST(ViewData, TheViewerKnowsTheSameWords) {
  const std::string types = viewer_types();
  for (const std::string& words :
       {"BodyStyle = " + union_of_words<study::Scene::BodyStyle>(),
        "style: " + union_of_words<study::Scene::JointStyle>(),
        "Quantity = " + union_of_words<study::Scene::Quantity>(),
        "style: " + union_of_words<study::Plot::Style>(),
        "verdict: " + union_of_words<study::Fact::Verdict>(), "verdict: " + union_of_words<study::Verdict>()})
    EXPECT_NE(types.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace linkwright::report
