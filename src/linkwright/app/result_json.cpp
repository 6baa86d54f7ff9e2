// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/result_json.h"

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/sha256.h"
#include "linkwright/core/status.h"
#include "linkwright/core/units.h"
#include "linkwright/study/answer.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/result_units.h"
#include "linkwright/study/write.h"

namespace linkwright::app {
namespace {

Value or_empty(const Value& value, Value empty) { return value.is_null() ? empty : value; }

Value to_value(const study::Solution& solution) {
  Value v;
  v["label"] = to_string(solution.label);
  v["parameters"] = Value::object();
  for (const study::Parameter& p : solution.parameters) v["parameters"][p.key] = p.value;
  v["objectives"] = or_empty(solution.objectives, Value::object());
  v["classification"] = or_empty(solution.classification, Value::object());
  v["defects"] = Value::array();
  for (const Sentence& defect : solution.defects) v["defects"].push_back(to_string(defect));
  if (!solution.study.is_null()) v["study"] = solution.study;
  return v;
}

Value to_value(const study::Check& check) {
  Value v;
  v["quantity"] = check.quantity;
  if (!check.at.empty()) v["at"] = check.at;
  v["value"] = check.value;
  v["limit"] = check.limit;
  v["passed"] = check.passed;
  if (!check.message.empty()) v["message"] = check.message;
  return v;
}

Value to_value(const study::Change& change) {
  Value v;
  v["quantity"] = change.quantity;
  v["measure"] = change.measure;
  v["before"] = change.before;
  v["after"] = change.after;
  v["change_percent"] = change.percent();
  v["objective"] = change.wanted;
  return v;
}

Value to_value(const study::Comparison& comparison) {
  Value v;
  v["item"] = comparison.item;
  v["source"] = comparison.source;
  v["published"] = comparison.published;
  v["ours"] = comparison.ours;
  v["verdict"] = comparison.verdict;
  v["note"] = comparison.note;
  return v;
}

/// Column arrays; like in CSV, `status` is the last column. Names of the rows, if they have any, stand
/// beside.
Value to_value(const Table& table, const NumberLists& lists, std::size_t max_rows) {
  const bool apart = table.rows() > max_rows;
  Value v;
  v["name"] = table.name;
  if (!apart && !table.names.empty()) {
    v["names"] = Value::array();
    for (const std::string& name : table.names) v["names"].push_back(name);
  }
  Value::Array columns, data;
  const auto describe = [&](std::string_view key, std::string_view unit, std::string_view label) {
    Value column;
    column["key"] = key;
    column["unit"] = unit;
    column["label"] = label;
    columns.push_back(std::move(column));
  };
  for (const Column& column : table.columns) {
    const auto parts = split_unit(column.key);
    describe(column.key, parts ? readable_unit(parts->unit->suffix) : std::string(), column.label);
    if (!apart) data.push_back(lists(column.values));
  }
  describe("status", "", "status");
  if (apart) {
    v["columns"] = Value(std::move(columns));
    v["rows"] = table.rows();
    v["file"] = long_table_file(table);
    return v;
  }
  Value::Array status;
  for (std::size_t row = 0; row < table.rows(); ++row)
    status.push_back(table.status.empty() ? Value("done") : Value(table.status[row]));
  data.push_back(Value(std::move(status)));
  v["columns"] = Value(std::move(columns));
  v["data"] = Value(std::move(data));
  return v;
}

Value to_value(const study::Fact& fact) {
  Value v;
  const std::string label = to_string(fact.label);
  v["key"] = fact.key.empty() ? identifier(label) : fact.key;
  v["label"] = label;
  v["text"] = to_string(fact.text);
  if (const auto number = fact.value()) {
    v["value"] = number->value();
    v["unit"] = number->unit_words();
  }
  for (const Sentence::Part& part : fact.text.parts())
    if (const auto* number = std::get_if<Measured>(&part); number && !number->place.empty())
      v["at"][number->place_key()] = number->value();
  v["verdict"] = name_of(fact.verdict);
  return v;
}

Value to_value(const std::optional<study::Trouble>& trouble) {
  if (!trouble) return Value();
  Value v;
  v["what"] = trouble->what;
  v["where"] = Value::object();
  for (const study::Trouble::Place& place : trouble->where) v["where"][place.key] = place.value;
  if (std::isfinite(trouble->share)) v["share_of_limit"] = trouble->share;
  v["why"] = to_string(trouble->why);
  return v;
}

Value to_value(const Diagnostic& diagnostic) {
  Value v;
  v["severity"] = diagnostic.severity == Diagnostic::Severity::error ? "error" : "warning";
  // The name alone: the folder differs between machines.
  if (!diagnostic.file.empty()) v["file"] = std::filesystem::path(diagnostic.file).filename().string();
  if (diagnostic.position.line > 0) {
    v["line"] = diagnostic.position.line;
    v["column"] = diagnostic.position.column;
  }
  if (!diagnostic.key.empty()) v["key"] = diagnostic.key;
  v["message"] = to_string(diagnostic.message);
  if (!diagnostic.hint.empty()) v["hint"] = to_string(diagnostic.hint);
  return v;
}

template <class T>
Value all(const std::vector<T>& items) {
  Value::Array array;
  for (const T& item : items) array.push_back(to_value(item));
  return Value(std::move(array));
}

/// The answer in short: what a program reads first.
Value answer(const study::Result& result) {
  const study::Answer answer = study::answer_of(result);
  Value v;
  v["headline"] = to_string(result.headline);
  v["verdict"] = name_of(answer.verdict);
  v["reasons"] = Value::array();
  for (const std::string& reason : answer.reasons) v["reasons"].push_back(reason);
  v["first_trouble"] = to_value(answer.first);
  v["worst_trouble"] = to_value(answer.worst);
  v["facts"] = all(result.facts);
  return v;
}

Value rounded(const Value& value) {
  if (value.is_number() && !value.is_integer()) return Value(study::six_digits(value.as_number()));
  Value out = value;
  if (value.is_array())
    for (Value& element : out.as_array()) element = rounded(element);
  if (value.is_object())
    for (Value::Member& member : out.as_object()) member.value = rounded(member.value);
  return out;
}

}  // namespace

study::Result presented(const study::Study& study, study::Result result) {
  const study::Output& output = study.common.output;
  const study::DisplayUnits units = study::chosen_units(output.units, study.common.units);
  study::Result out = study::in_units(std::move(result), units);
  if (output.digits != study::Digits::six) return out;
  const auto round = [](auto&... values) { ((values = study::six_digits(values)), ...); };
  for (Table& table : out.tables)
    for (Column& column : table.columns)
      for (double& value : column.values) round(value);
  for (study::Solution& solution : out.solutions) {
    for (study::Parameter& p : solution.parameters) round(p.value, p.lower, p.upper);
    for (Value* numbers : {&solution.objectives, &solution.classification}) *numbers = rounded(*numbers);
  }
  for (study::Change& change : out.changes) round(change.before, change.after);
  for (study::Trouble& trouble : out.troubles)
    for (study::Trouble::Place& place : trouble.where) round(place.value);
  out.statistics = rounded(out.statistics);
  return out;
}

Value result_json(const study::Study& study, const study::Result& shown, const RunRecord& run,
                  const NumberLists& lists, std::size_t max_rows) {
  Value v;
  v["schema"] = study::schema_version;
  v["tool"] = "linkwright " + std::string(version());
  v["study"] = study.canonical;
  v["study_sha256"] = sha256(study::to_json(study.canonical));
  v["status"] = to_string(shown.status);
  v["answer"] = answer(shown);
  v["checks"] = all(shown.checks);
  v["best"] = shown.solutions.empty() ? Value() : to_value(shown.solutions.front());
  v["solutions"] = all(shown.solutions);
  if (!shown.changes.empty()) v["changes"] = all(shown.changes);  // from a first design to the answer
  // Comparisons with published numbers; empty when the study cites none.
  v["comparisons"] = all(shown.comparisons);
  v["statistics"] = or_empty(shown.statistics, Value::object());
  v["log"] = or_empty(shown.log, Value::array());
  v["tables"] = Value::array();
  for (const Table& table : shown.tables) v["tables"].push_back(to_value(table, lists, max_rows));
  v["diagnostics"] = all(shown.diagnostics);
  Value& record = v["run"];
  record["started"] = run.started;
  record["seconds"] = run.seconds;
  record["host"] = run.host;
  record["threads"] = run.threads;
  return v;
}

std::string long_table_file(const Table& table) { return table.name + ".npy"; }

study::Result with_short_tables(study::Result shown, std::size_t max_rows) {
  constexpr std::size_t shown_rows = 10'000;
  for (Table& table : shown.tables) {
    const std::size_t rows = table.rows(), step = (rows + shown_rows - 1) / shown_rows;
    if (rows <= max_rows || step < 2) continue;
    const auto thin = [&](auto& values) {
      for (std::size_t i = 1; i * step < values.size(); ++i) values[i] = std::move(values[i * step]);
      values.resize((values.size() + step - 1) / step);
    };
    thin(table.names);
    thin(table.status);
    for (Column& column : table.columns) thin(column.values);
    std::erase_if(shown.plots, [&](const study::Plot& plot) {
      return plot.table == table.name && plot.style == study::Plot::Style::map;
    });
  }
  return shown;
}

Value reproduction_json(const study::Reproduction& reproduction, const std::vector<study::Comparison>& rows) {
  Value v;
  v["id"] = reproduction.id;
  v["title"] = reproduction.title;
  v["source"] = reproduction.source;
  v["notes"] = Value::array();
  for (const std::string& note : reproduction.notes) v["notes"].push_back(note);
  v["comparisons"] = all(rows);
  return v;
}

}  // namespace linkwright::app
