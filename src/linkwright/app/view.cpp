// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/view.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/edit.h"
#include "linkwright/app/examples.h"
#include "linkwright/app/result_json.h"
#include "linkwright/app/samples.h"
#include "linkwright/core/units.h"
#include "linkwright/report/drawing.h"
#include "linkwright/report/view_data.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/result_units.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::app {
namespace {

// One unit for all lengths of a report also where the study has none, as with built-in linkages.
study::DisplayUnits page_units(const study::Study& study, const study::Result& result) {
  study::DisplayUnits units = study::shown_units(study.common.output.units, study.common.units);
  constexpr double hall = 10;  // m: what is larger is given in metres
  double largest = 0;
  for (const study::Scene& scene : result.scenes) largest = std::max(largest, report::extent(scene));
  if (!units.chosen(Dimension::length) && largest > 0) {
    units.choose(*split_unit(largest < hall ? "length_mm" : "length_m"));
    units.follow();
  }
  return units;
}

Value diagnostics_document(const Diagnostics& diagnostics) {
  Value out = Value::array();
  for (const Diagnostic& d : diagnostics) {
    Value v = Value::object();
    v["severity"] = d.severity == Diagnostic::Severity::error ? "error" : "warning";
    if (d.position.line > 0) {
      v["line"] = d.position.line;
      v["column"] = d.position.column;
    }
    if (!d.key.empty()) v["key"] = d.key;
    v["message"] = to_string(d.message);
    if (!d.hint.empty()) v["hint"] = to_string(d.hint);
    out.push_back(std::move(v));
  }
  return out;
}

std::vector<Edit> read_edits(std::string_view text, Diagnostics& diagnostics) {
  std::vector<Edit> out;
  const Value asked = study::read_text(text, study::Syntax::json, "edits", diagnostics);
  if (const Value* items = asked.find("edits"); items && items->is_array())
    for (const Value& item : items->as_array())
      if (const Value* key = item.find("key"), *value = item.find("value"); key && value && key->is_string())
        out.push_back({key->as_string(), *value});
  return out;
}

/// Leaves the handles whose numbers the study has. What a search draws are its designs, of which the study
/// has but the targets.
void keep_handles(study::Result& result, const study::Study& study) {
  constexpr std::array as_given{"analysis", "simulation", "speed_fluctuation"};
  const bool drawn_as_given = std::find(as_given.begin(), as_given.end(), study.kind->kind) != as_given.end();
  for (study::Scene& scene : result.scenes)
    std::erase_if(scene.handles, [&](const study::Scene::Handle& handle) {
      return (handle.target < 0 && !drawn_as_given) || !has_key(study.canonical, handle.key);
    });
}

}  // namespace

report::ReportInput report_input(const study::Study& study, const study::Result& shown, std::string command,
                                 std::string result_json) {
  return {.result = shown,
          .units = page_units(study, shown),
          .study_toml = study::to_toml(study.canonical),
          .title = study::title_of(study),
          .source = study.common.source,
          .tool = fmt::format("linkwright {}", version()),
          .command = std::move(command),
          .result_json = std::move(result_json)};
}

View run_text(std::string_view text, std::string_view edits, const std::string& folder, RunContext& context,
              Sharing sharing) {
  Diagnostics diagnostics;
  const auto start = RunContext::Clock::now();
  Value out = Value::object();
  const std::string now =
      edits.empty() ? std::string(text) : edited(text, read_edits(edits, diagnostics), diagnostics);
  out["text"] = now;
  const Value document = study::read_text(now, study::syntax_of({}, now), page_text, diagnostics);
  std::optional<study::Study> study;
  if (!has_errors(diagnostics)) study = study::prepare(document, page_text, folder, catalogue(), diagnostics);
  out["diagnostics"] = diagnostics_document(diagnostics);
  View view;
  if (!study) {
    view.json = study::to_json(out);
    return view;
  }
  ShardCheckpoint checkpoint(sharing.shard, checkpoint_owner(*study));
  Diagnostics refused;  // problems of handles that cannot be reused and are computed again
  for (const std::string& kept : sharing.kept) checkpoint.take(kept, refused);
  checkpoint.set_hand_on(std::move(sharing.hand_on));
  checkpoint.set_leaves(std::move(sharing.leaves));
  context.set_checkpoint(sharing.shard.count > 1 || !sharing.kept.empty() ? &checkpoint : nullptr);
  study::Result result;
  try {
    result = study::run_study(*study, context);
  } catch (const LeftToOthers&) {
    out["left_to_others"] = true;
    view.json = study::to_json(out);
    return view;
  }
  context.set_checkpoint(nullptr);
  keep_handles(result, *study);
  const study::Result shown = presented(*study, std::move(result));
  report::ReportInput input = report_input(*study, shown, {}, {});
  input.lists = NumberLists(view.numbers);
  out["canonical"] = study->canonical;
  out["view"] = report::view_data(input);
  out["result"] = result_json(*study, shown, {}, input.lists);
  out["seconds"] = std::chrono::duration<double>(RunContext::Clock::now() - start).count();
  view.json = study::to_json(out);
  return view;
}

Value catalogue_document() {
  Value out = Value::object();
  out["version"] = version();
  out["kinds"] = Value::array();
  for (const study::Kind& kind : catalogue()) {
    Value v = Value::object();
    v["name"] = study::name_of(kind);
    v["summary"] = kind.summary;
    v["group"] = group_of(kind.kind, kind.mechanism, kind.target);
    v["template"] = kind.example;
    out["kinds"].push_back(std::move(v));
  }
  out["examples"] = Value::array();
  for (const Example& example : examples()) {
    Value v = Value::object();
    v["name"] = example.name;
    v["title"] = example.title;
    v["group"] = example.group;
    v["words"] = example.words;
    v["text"] = example.text;
    v["beside"] = Value::object();
    for (const EmbeddedFile& file : example.beside) v["beside"][file.path] = file.text;
    out["examples"].push_back(std::move(v));
  }
  out["samples"] = Value::array();
  for (const Sample& sample : samples()) {
    Value v = Value::object();
    v["name"] = sample.name;
    v["summary"] = sample.summary;
    v["group"] = sample.group;
    v["mechanisms"] = Value::array();
    for (const std::string& mechanism : sample.mechanisms) v["mechanisms"].push_back(mechanism);
    out["samples"].push_back(std::move(v));
  }
  return out;
}

Value schema_document(std::string_view kind) {
  for (const study::Kind& known : catalogue())
    if (study::name_of(known) == kind) return study::schema_of(known);
  return {};
}

}  // namespace linkwright::app
