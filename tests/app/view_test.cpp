// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/view.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/core/numbers.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::app {
namespace {

using testing::ElementsAre;

constexpr const char* hoeken =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nsample = \"hoeken\"\n";

// The document with its lists in it, as a page puts it together.
Value with_lists(const Value& value, const std::vector<double>& numbers) {
  if (value.is_array()) {
    Value out = Value::array();
    for (const Value& v : value.as_array()) out.push_back(with_lists(v, numbers));
    return out;
  }
  if (!value.is_object()) return value;
  if (const Value* place = value.find("__")) {
    const auto first = static_cast<std::ptrdiff_t>(place->as_array()[0].as_integer());
    const auto count = static_cast<std::ptrdiff_t>(place->as_array()[1].as_integer());
    return Value(std::vector<double>(numbers.begin() + first, numbers.begin() + first + count));
  }
  Value out = Value::object();
  for (const Value::Member& m : value.as_object()) out[m.key] = with_lists(m.value, numbers);
  return out;
}
Value run(std::string_view text, std::string_view edits = {}) {
  RunContext context;
  const View view = run_text(text, edits, {}, context);
  Diagnostics diagnostics;
  // No member of a study file may be without a name, and those that stand for lists are.
  std::string json = view.json;
  for (std::size_t at = 0; (at = json.find("{\"\":", at)) != std::string::npos;)
    json.replace(at, 4, "{\"__\":");
  return with_lists(study::read_text(json, study::Syntax::json, "view", diagnostics), view.numbers);
}

TEST(PageView, AStudyIsRunAndShowsWhatAReportWould) {
  const Value out = run(hoeken);
  EXPECT_TRUE(out.find("diagnostics")->as_array().empty());
  EXPECT_EQ(out.find("text")->as_string(), hoeken);
  EXPECT_EQ(out.find("view")->find("status")->as_string(), "done");
  EXPECT_GT(out.find("seconds")->as_number(), 0);
  const Value& table = out.find("result")->find("tables")->as_array()[0];
  EXPECT_EQ(table.find("data")->as_array()[0].as_array().size(), 361u);
  EXPECT_NE(out.find("canonical")->find("mechanism")->find("body"), nullptr);
}

/// A number or a list of a document, by its key.
const Value* value_at(const Value& document, std::string_view key) {
  const auto path = study::parse_path(key);
  const Value* out = &document;
  for (const study::KeyStep& step : path.value()) {
    out = out->find(step.key);
    for (const std::size_t index : step.indices) out = out ? &out->as_array().at(index) : nullptr;
    if (!out) return nullptr;
  }
  return out;
}

TEST(PageView, PointsSayWhichNumbersMadeThem) {
  const Value out = run(hoeken);
  const Value& scene = out.find("view")->find("scenes")->as_array()[0];
  const Value::Array& handles = scene.find("handles")->as_array();
  ASSERT_EQ(handles.size(),
            12u);  // points of ground, crank, coupler with its pen, rocker; three mass centres
  const auto at = [](const Value& list, std::size_t i) {
    return list.as_array()[list.as_array().size() == 1 ? 0 : i].as_number();
  };
  // The numbers in their frame are the place that is drawn, at any sample.
  for (const Value& handle : handles) {
    const std::string& key = handle.find("key")->as_string();
    const Value* const local = value_at(*out.find("canonical"), key);
    ASSERT_NE(local, nullptr) << key;
    const Value& frame =
        scene.find("frames")->as_array()[static_cast<std::size_t>(handle.find("frame")->as_integer())];
    const Value& point =
        scene.find("points")->as_array()[static_cast<std::size_t>(handle.find("point")->as_integer())];
    for (const std::size_t i : {0u, 77u, 300u}) {
      const double angle = at(*frame.find("angle"), i), x = at(*local, 0), y = at(*local, 1);
      EXPECT_NEAR(at(*frame.find("x"), i) + std::cos(angle) * x - std::sin(angle) * y,
                  at(*point.find("x"), i), 1e-8)
          << key;
      EXPECT_NEAR(at(*frame.find("y"), i) + std::sin(angle) * x + std::cos(angle) * y,
                  at(*point.find("y"), i), 1e-8)
          << key;
    }
  }
}

/// The place of a point in a scene; the origin for index -1.
std::array<double, 3> place_of(const Value& scene, std::int64_t index, std::size_t sample) {
  if (index < 0) return {0, 0, 0};
  const Value& point = scene.find("points")->as_array()[static_cast<std::size_t>(index)];
  std::array<double, 3> out{};
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t k = 0; k < axes.size(); ++k)
    if (const Value* list = point.find(axes[k]); list && !list->as_array().empty()) {
      const Value& v = list->as_array()[list->as_array().size() == 1 ? 0 : sample];
      out[k] = v.is_number() ? v.as_number() : std::nan("");
    }
  return out;
}

/// The distance of the drawing from the numbers of a handle at a sample; NaN where it is not assembled.
double missed(const Value& scene, const Value& handle, const Value& number, std::size_t sample) {
  const std::string& measure = handle.find("measure")->as_string();
  const auto at = place_of(scene, handle.find("point")->as_integer(), sample);
  const auto from = place_of(scene, handle.find("from")->as_integer(), sample);
  const std::array way{at[0] - from[0], at[1] - from[1], at[2] - from[2]};
  if (measure == "length") return std::abs(std::hypot(way[0], way[1], way[2]) - number.as_number());
  if (measure == "angle")
    return std::abs(std::remainder(std::atan2(way[1], way[0]) - number.as_number(), 2 * pi));
  std::array<double, 3> local = at;
  if (const auto frame = handle.find("frame")->as_integer(); frame >= 0) {
    const Value& f = scene.find("frames")->as_array()[static_cast<std::size_t>(frame)];
    const auto entry = [&](const char* key) {
      const Value::Array& list = f.find(key)->as_array();
      return list[list.size() == 1 ? 0 : sample].as_number();
    };
    const double x = at[0] - entry("x"), y = at[1] - entry("y"), angle = entry("angle");
    local = {std::cos(angle) * x + std::sin(angle) * y, std::cos(angle) * y - std::sin(angle) * x, 0};
  }
  if (measure == "x") return std::abs(local[0] - number.as_number());
  if (measure == "y") return std::abs(local[1] - number.as_number());
  double worst = 0;
  for (std::size_t k = 0; k < number.as_array().size(); ++k)
    worst = std::max(worst, std::abs(local[k] - number.as_array()[k].as_number()));
  return worst;
}

TEST(PageView, WhatIsDrawnMeasuresTheNumbersOfTheStudy) {
  struct Case {
    const char *kind, *edits;
    std::vector<std::string> keys;  // keys that the drawing has at least; "mechanism." is left out
  };
  const std::vector<Case> cases{
      {"analysis/planar.four_bar",
       R"({"edits": [{"key": "mechanism.parameters.frame_angle_deg", "value": 20},
                     {"key": "mechanism.parameters.coupler_u_mm", "value": 150},
                     {"key": "mechanism.parameters.coupler_v_mm", "value": -80},
                     {"key": "mechanism.parameters.pivot_x_mm", "value": 30}]})",
       {"parameters.crank_m", "parameters.coupler_m", "parameters.rocker_m", "parameters.ground_m",
        "parameters.frame_angle_rad", "parameters.pivot_x_m", "parameters.pivot_y_m",
        "parameters.coupler_u_m", "parameters.coupler_v_m"}},
      {"simulation/planar.four_bar", "", {"parameters.crank_m", "parameters.ground_m"}},
      {"speed_fluctuation/planar.slider_crank", "", {"parameters.crank_m", "parameters.rod_m"}},
      {"analysis/planar.slider_crank",
       R"({"edits": [{"key": "mechanism.parameters.offset_mm", "value": 12},
                     {"key": "mechanism.parameters.guide_angle_deg", "value": 30},
                     {"key": "mechanism.parameters.rod_u_mm", "value": 70},
                     {"key": "mechanism.parameters.rod_v_mm", "value": 20}]})",
       {"parameters.crank_m", "parameters.rod_m", "parameters.offset_m", "parameters.pivot_x_m",
        "parameters.pivot_y_m", "parameters.rod_u_m", "parameters.rod_v_m"}},
      {"analysis/planar.serial_arm", "", {"link[0].length_m", "link[1].length_m", "base_x_m", "base_y_m"}},
      {"analysis/parallel.delta", "", {"arm_m", "rod_m", "base_radius_m", "motion.step[0].to_m"}},
      {"analysis/parallel.hexa", "", {"arm_m", "rod_m"}},
      {"analysis/parallel.five_bar", "", {"leg[0].base_m", "leg[1].arm_m", "leg[1].rod_m"}},
      {"analysis/parallel.constant_orientation", "", {"leg[1].base_m", "leg[0].arm_m", "leg[0].rod_m"}},
      {"analysis/parallel.serial_pi_arm", "", {"base_m", "arms_m[0]", "arms_m[1]"}},
      {"analysis/parallel.pi_joint", "", {"arm_m"}},
      {"simulation/flexible.hub_link", "", {"length_m"}},
      {"simulation/flexible.arm", "", {"link[0].length_m", "link[1].length_m"}},
      {"analysis/suspension.corner",
       "",
       {"wheel.centre_m", "link[0].body_m[0]", "link[0].body_m[1]", "link[0].carrier_m", "link[2].body_m",
        "link[2].carrier_m", "spring.body_m", "spring.moving_m"}},
      {"analysis/planar.linkage", "", {"body[1].points_m.A", "body[1].centre_m", "body[2].centre_m"}},
      {"analysis/clearance.linkage", "", {"body[1].points_m.A", "body[2].points_m.P"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.kind);
    Diagnostics diagnostics;
    const study::Kind* kind = find_kind(c.kind, catalogue(), diagnostics);
    ASSERT_NE(kind, nullptr);
    const Value out = run(kind->example, c.edits);
    ASSERT_NE(out.find("view"), nullptr);
    const Value& scene = out.find("view")->find("scenes")->as_array()[0];
    std::set<std::string> keys;
    for (const Value& handle : scene.find("handles")->as_array()) {
      const std::string& key = handle.find("key")->as_string();
      SCOPED_TRACE(key);
      keys.insert(key);
      const Value* number = value_at(*out.find("canonical"), key);
      ASSERT_NE(number, nullptr);
      // Hard points are those where the suspension stands; everything else is so at all times.
      const bool design = std::string_view(c.kind) == "analysis/suspension.corner";
      const Value* second = scene.find("second");
      const std::size_t samples =
          scene.find("input")->as_array().size() * (second ? second->as_array().size() : 1);
      double least = std::numeric_limits<double>::infinity(), most = 0;
      for (std::size_t i = 0; i < samples; ++i) {
        const double distance = missed(scene, handle, *number, i);
        if (std::isnan(distance)) continue;
        least = std::min(least, distance), most = std::max(most, distance);
      }
      EXPECT_LE(design ? least : most, 1e-6);
    }
    for (const std::string& key : c.keys)
      EXPECT_TRUE(keys.contains(key) || keys.contains("mechanism." + key)) << key;
  }
}

TEST(PageView, WhatTheStudyDoesNotNumberCannotBeHeld) {
  // The designs of a balancing are drawn.
  Diagnostics diagnostics;
  const study::Kind* kind = find_kind("balancing/planar.serial_arm", catalogue(), diagnostics);
  ASSERT_NE(kind, nullptr);
  const Value out = run(kind->example);
  EXPECT_TRUE(out.find("diagnostics")->as_array().empty());
  EXPECT_TRUE(out.find("view")->find("scenes")->as_array()[0].find("handles")->as_array().empty());
}

TEST(PageView, EditsAreMadeBeforeTheRun) {
  const Value out =
      run(hoeken, R"({"edits": [{"key": "mechanism.body[1].points_m.A", "value": [0.12, 0.0]}]})");
  const Value& crank = out.find("canonical")->find("mechanism")->find("body")->as_array()[1];
  EXPECT_EQ(crank.find("points_m")->find("A")->as_array()[0].as_number(), 0.12);
  EXPECT_THAT(out.find("text")->as_string(), testing::HasSubstr("A = [120.0, 0.0]"));
}

TEST(PageView, AStudyWithErrorsHasTheirPlacesAndNoView) {
  const Value out =
      run("schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nsampel = \"hoeken\"\n");
  const Value::Array& diagnostics = out.find("diagnostics")->as_array();
  ASSERT_FALSE(diagnostics.empty());
  EXPECT_EQ(diagnostics.back().find("line")->as_integer(), 5);
  EXPECT_EQ(diagnostics.back().find("hint")->as_string(), "did you mean 'sample'?");
  EXPECT_EQ(out.find("view"), nullptr);
}

TEST(PageView, TheCatalogueHoldsWhatThereIsToBeginWith) {
  const Value out = catalogue_document();
  EXPECT_GT(out.find("examples")->as_array().size(), 80u);
  for (const Value& example : out.find("examples")->as_array())  // the gallery looks for them
    if (example.find("name")->as_string() == "tailgate") {
      EXPECT_TRUE(example.find("words")->as_string().starts_with("boot, trunk, "));
    }
  EXPECT_GT(out.find("kinds")->as_array().size(), 30u);
  EXPECT_GT(out.find("samples")->as_array().size(), 20u);
}

}  // namespace
}  // namespace linkwright::app
