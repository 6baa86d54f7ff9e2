// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/view_data.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/report/markup.h"
#include "linkwright/report/units.h"
#include "linkwright/study/answer.h"
#include "linkwright/study/design.h"
#include "linkwright/study/extremes.h"

namespace linkwright::report {
namespace {

using study::Scene;

// Nine digits of the largest are a millionth of a pixel, and whole numbers in four bytes (packed.h).
Value coordinates(const std::vector<double>& values, const NumberLists& lists) {
  if (lists.apart()) return lists(values);
  const double largest = study::largest_size(values);
  const int decimals =
      largest > 0 && std::isfinite(largest) ? 8 - static_cast<int>(std::floor(std::log10(largest))) : 0;
  Value out = Value::array();
  // Powers of ten up to here are doubles.
  const double power = std::pow(10.0, std::clamp(decimals, 0, 22));
  for (const double v : values) out.push_back(std::nearbyint(v * power) / power + 0.0);  // no -0
  return out;
}

Value texts(const std::vector<std::string>& values) {
  Value out = Value::array();
  for (const auto& v : values) out.push_back(v);
  return out;
}

Value indices(const std::vector<int>& values) {
  Value out = Value::array();
  for (const int v : values) out.push_back(v);
  return out;
}

template <class T, class F>
Value list(const std::vector<T>& items, F&& convert) {
  Value out = Value::array();
  for (const T& item : items) {
    Value object = Value::object();
    convert(object, item);
    out.push_back(std::move(object));
  }
  return out;
}

// Arrows have a unit as text: "m/s2".
struct ArrowUnit {
  std::string symbol;
  double factor = 1;
};
ArrowUnit arrow_unit(const std::string& text, const std::vector<ShownSuffix>& units) {
  for (const ShownSuffix& s : units)
    if (readable_unit(s.suffix.substr(1)) == text) return {s.symbol, s.factor};
  return {text};
}

Value arrow_values(const std::vector<double>& values, const ArrowUnit& unit, const NumberLists& lists) {
  std::vector<double> out = values;
  for (double& v : out) v *= unit.factor;
  return coordinates(out, lists);
}

void put_handles(Value& out, const Scene& scene, const NumberLists& lists) {
  out["frames"] = list(scene.frames, [&lists](Value& o, const Scene::Frame& f) {
    o["x"] = lists(f.x);
    o["y"] = lists(f.y);
    o["angle"] = lists(f.angle);
  });
  out["handles"] = list(scene.handles, [](Value& o, const Scene::Handle& h) {
    o["key"] = h.key;
    o["measure"] = linkwright::name_of(h.measure);
    o["frame"] = h.frame;
    o["point"] = h.point;
    o["target"] = h.target;
    o["index"] = h.index;
    o["from"] = h.from;
    o["held"] = h.held;
  });
}

Value scene_data(const Scene& scene, const std::string& title, const std::vector<ShownSuffix>& units,
                 const NumberLists& lists) {
  Value out = Value::object();
  out["name"] = scene.name;
  out["title"] = title;
  out["input_key"] = scene.input_key;
  out["input_label"] = scene.input_label;
  out["input"] = lists(scene.input);
  if (!scene.second.empty()) {
    out["second_key"] = scene.second_key;
    out["second_label"] = scene.second_label;
    out["second"] = Value(scene.second);
  }
  out["status"] = texts(scene.status);
  if (!scene.runs.empty()) out["runs"] = texts(scene.runs);
  out["points"] = list(scene.points, [&lists](Value& o, const Scene::Point& p) {
    o["name"] = p.name;
    o["x"] = coordinates(p.x, lists);
    o["y"] = coordinates(p.y, lists);
    if (!p.z.empty()) o["z"] = coordinates(p.z, lists);
  });
  out["bodies"] = list(scene.bodies, [](Value& o, const Scene::Body& b) {
    o["name"] = b.name;
    o["points"] = indices(b.points);
    o["style"] = linkwright::name_of(b.style);
    if (b.run > 0) o["run"] = b.run;
  });
  out["joints"] = list(scene.joints, [](Value& o, const Scene::Joint& j) {
    o["name"] = j.name;
    o["point"] = j.point;
    o["style"] = linkwright::name_of(j.style);
  });
  out["traces"] = list(scene.traces, [](Value& o, const Scene::Trace& t) {
    o["point"] = t.point;
    o["name"] = t.name;
    o["closed"] = t.closed;
    if (t.run > 0) o["run"] = t.run;
  });
  out["targets"] = list(scene.targets, [](Value& o, const Scene::Target& t) {
    o["name"] = t.name;
    o["x"] = t.x;
    o["y"] = t.y;
    // Not rounded: their differences are the errors, which may be tiny.
    o["achieved_x"] = t.achieved_x;
    o["achieved_y"] = t.achieved_y;
    o["achieved_input"] = Value(t.achieved_input);
    o["closed"] = t.closed;
  });
  out["circles"] = list(scene.circles, [](Value& o, const Scene::Circle& c) {
    o["name"] = c.name;
    o["centre"] = c.centre;
    o["rim"] = c.rim;
  });
  if (!scene.discs.empty())
    out["discs"] = list(scene.discs, [](Value& o, const Scene::Disc& d) {
      o["name"] = d.name;
      o["centre"] = d.centre;
      o["axis"] = d.axis;
      o["radius"] = d.radius;
      o["width"] = d.width;
    });
  out["vectors"] = list(scene.vectors, [&units, &lists](Value& o, const Scene::Vector& v) {
    const ArrowUnit unit = arrow_unit(v.unit, units);
    o["name"] = v.name;
    o["quantity"] = linkwright::name_of(v.quantity);
    o["unit"] = unit.symbol;
    o["point"] = v.point;
    o["x"] = arrow_values(v.x, unit, lists);
    o["y"] = arrow_values(v.y, unit, lists);
    if (!v.z.empty()) o["z"] = arrow_values(v.z, unit, lists);
    o["symbol"] = v.symbol;
  });
  out["moments"] = list(scene.moments, [&units, &lists](Value& o, const Scene::Moment& m) {
    const ArrowUnit unit = arrow_unit(m.unit, units);
    o["name"] = m.name;
    o["unit"] = unit.symbol;
    o["point"] = m.point;
    o["value"] = arrow_values(m.value, unit, lists);
    o["symbol"] = m.symbol;
  });
  return out;
}

Value parameters_data(const std::vector<study::Parameter>& parameters) {
  return list(parameters, [](Value& o, const study::Parameter& p) {
    o["key"] = p.key;
    o["label"] = p.label;
    o["value"] = p.value;
    o["lower"] = p.lower;  // infinite = null = none
    o["upper"] = p.upper;
  });
}

/// The study files of the solutions that have one.
Value designs_data(const ReportInput& input) {
  Value out = Value::array();
  const std::vector<study::Solution>& solutions = input.result.solutions;
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    const study::Solution& s = solutions[i];
    if (s.study.is_null()) continue;
    Value design;
    design["solution"] = i;
    design["name"] = study::design_name(s, i + 1);
    design["toml"] = study::design_toml(s, i + 1, input.title, input.tool);
    out.push_back(std::move(design));
  }
  return out;
}

Value plots_data(const std::vector<study::Plot>& plots) {
  return list(plots, [](Value& o, const study::Plot& p) {
    o["name"] = p.name;
    o["title"] = p.title;
    o["table"] = p.table;
    o["x"] = p.x;
    o["y"] = texts(p.y);
    o["style"] = linkwright::name_of(p.style);
    o["logarithmic_y"] = p.logarithmic_y;
    o["scene"] = p.scene;
    if (!p.group.empty()) o["group"] = p.group;
    if (!p.group_names.empty()) o["group_names"] = texts(p.group_names);
    if (!p.bands.empty())
      o["bands"] = list(p.bands, [](Value& b, const study::Plot::Band& band) {
        b["lower"] = band.lower;
        b["upper"] = band.upper;
        b["label"] = band.label;
      });
    if (!p.baseline.empty()) o["baseline"] = p.baseline;
    if (p.upright) o["upright"] = true;
  });
}

}  // namespace

Value view_data(const ReportInput& input) {
  const study::Result& result = input.result;
  const study::DisplayUnits in_sentences = page_units(input.units);
  const auto shown = [&](const Sentence& sentence) {
    return typeset(study::in_units(sentence, in_sentences));
  };
  Value out = Value::object();
  out["title"] = input.title;
  out["source"] = input.source;
  out["tool"] = input.tool;
  out["command"] = input.command;
  out["study_toml"] = input.study_toml;
  out["status"] = to_string(result.status);
  out["headline"] = shown(result.headline);
  out["verdict"] = linkwright::name_of(study::answer_of(result).verdict);
  const std::vector<ShownSuffix> units = shown_suffixes(input.units);
  out["units"] = list(units, [](Value& o, const ShownSuffix& s) {
    o["suffix"] = s.suffix;
    o["symbol"] = s.symbol;
    o["factor"] = s.factor;
    o["key"] = s.key;
    o["steps"] = Value(Value::Array{s.from.multiply, s.from.divide, s.to.divide, s.to.multiply});
    o["by_size"] = s.by_size;
  });
  out["facts"] = list(result.facts, [&](Value& o, const study::Fact& f) {
    o["label"] = shown(f.label);
    const FactText text = fact_text(study::in_units(f.text, in_sentences));
    o["text"] = text.value;
    if (!text.rest.empty()) o["rest"] = text.rest;
    if (text.is_long) o["long"] = true;
    o["verdict"] = linkwright::name_of(f.verdict);
  });
  out["remarks"] = list(result.diagnostics, [&](Value& o, const Diagnostic& d) {
    o["message"] = shown(d.message);
    if (!d.hint.empty()) o["hint"] = shown(d.hint);
  });
  out["parameters"] = Value::array();
  out["solution_scenes"] = Value::array();
  out["solutions"] = list(result.solutions, [&](Value& o, const study::Solution& s) {
    o["label"] = shown(s.label);
    o["defects"] = Value::array();
    for (const Sentence& defect : s.defects) o["defects"].push_back(shown(defect));
  });
  for (const auto& s : result.solutions) {
    out["parameters"].push_back(parameters_data(s.parameters));
    out["solution_scenes"].push_back(s.scene);
  }
  out["designs"] = designs_data(input);
  out["files"] = list(result.files, [](Value& o, const study::ResultFile& f) {
    o["name"] = f.name;
    o["text"] = f.text;
  });
  out["scenes"] = Value::array();
  for (const auto& scene : result.scenes) {
    Value drawn = scene_data(scene, shown(scene.title), units, input.lists);
    if (input.lists.apart()) put_handles(drawn, scene, input.lists);
    out["scenes"].push_back(std::move(drawn));
  }
  out["plots"] = plots_data(result.plots);
  out["changes"] = list(result.changes, [](Value& o, const study::Change& c) {
    o["quantity"] = c.quantity;
    o["label"] = c.label;
    o["measure"] = c.measure;
    o["before"] = c.before;
    o["after"] = c.after;
    o["percent"] = c.percent();
    o["wanted"] = c.wanted;
  });
  out["comparisons"] = list(result.comparisons, [](Value& o, const study::Comparison& c) {
    o["item"] = c.item;
    o["source"] = c.source;
    o["published"] = c.published;
    o["ours"] = c.ours;
    o["verdict"] = c.verdict;
    o["note"] = c.note;
  });
  return out;
}

}  // namespace linkwright::report
