// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/csv.h"
#include "linkwright/core/memory.h"
#include "linkwright/parameter_study/studies/sweep.h"
#include "linkwright/parameter_study/studies/templates.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/memory.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/study.h"

namespace linkwright::parameter_study {
namespace {

constexpr int usual_steps = 11;
constexpr std::size_t max_parameters = 64;
constexpr double max_trials = 1e7;

const Field sampling_field = field::entry("method", "which values are tried");

/// True if a value can be one of a list: a number, a word, true or false.
bool is_plain(const Value& value) {
  return value.is_string() || value.is_bool() || (value.is_number() && std::isfinite(value.as_number()));
}

/// The study in the study, as it is written: from its file or from the table itself. Null where that has been
/// reported.
Value inner_document(study::ObjectReader& table, const study::Common& common, ParameterStudy& s) {
  std::string file;
  if (!table(field::entry("file", "file of the study"), file)) {
    table.members();
    s.name = table.document().file();
    s.folder = common.folder;
    if (table.has("file")) return {};
    Value document = table.value();
    if (!document.find("schema")) document["schema"] = study::schema_version;
    return document;
  }
  const auto text = study::read_beside(table, "file", common.folder, file);
  if (!text) return {};
  const std::filesystem::path path = common.folder / file;
  s.name = path.string();
  s.folder = path.parent_path();
  Diagnostics problems;
  Value document = study::read_text(*text, study::syntax_of(path, *text), s.name, problems);
  for (const Diagnostic& problem : problems) table.unreadable("file", study::in_file(problem));
  return problems.empty() ? document : Value();
}

/// True if a study can run; problems are reported at their position.
bool check_study(study::ObjectReader& table, const Value& document, const ParameterStudy& s,
                 std::span<const study::Kind> kinds) {
  Diagnostics problems;
  const bool good = study::prepare(document, s.name, s.folder, kinds, problems).has_value();
  for (Diagnostic& problem : problems) {
    if (problem.severity != Diagnostic::Severity::error) continue;
    if (table.has("file")) {
      table.unreadable("file", study::in_file(problem));
    } else {
      problem.key = "study" + (problem.key.empty() ? "" : "." + problem.key);
      table.document().error(std::move(problem));
    }
  }
  return good;
}

/// The values of a parameter are given in one form only, and make sense.
void check_values(study::ObjectReader& reader, const Parameter& p) {
  if (reader.has("values")) {
    if (reader.has("min") || reader.has("max") || reader.has("steps"))
      reader.error("values", "a parameter has a range or a list of values", "keep one of them");
  } else if (!reader.has("min") || !reader.has("max")) {
    reader.error(reader.has("min") ? "max" : "min", "the range is not complete",
                 "write min and max, or values = [20, 25, 30]");
  } else if (p.min && p.max && !(*p.min < *p.max)) {
    reader.error("max", fmt::format("is {}, must be more than min, which is {}", *p.max, *p.min));
  } else if (p.min && p.spacing == Spacing::logarithmic && !(*p.min > 0)) {
    reader.error("min", fmt::format("is {}: equal ratios begin above 0", *p.min),
                 "raise it, or write spacing = \"linear\"");
  }
}

std::size_t length_of_list(const Parameter& p) { return p.values ? p.values->values.size() : 0; }

/// The value of a parameter at a share of its range. Of a list: `even`, 0 and 1 are the first and the last,
/// else each has an equal share.
double value_at(const Parameter& p, double share, bool even) {
  const std::size_t length = length_of_list(p);
  if (length == 0) {
    if (share == 0) return *p.min;
    if (share == 1) return *p.max;
    return p.spacing == Spacing::logarithmic ? *p.min * std::pow(*p.max / *p.min, share)
                                             : *p.min + share * (*p.max - *p.min);
  }
  const auto n = static_cast<double>(length);
  const double place = even ? std::round(share * (n - 1)) : std::min(std::floor(share * n), n - 1);
  return p.words.empty() ? p.values->values[static_cast<std::size_t>(place)].as_number() : place;
}

/// The parameters of a list are those that are there, and the columns that are not.
Parameter& parameter_of(ParameterStudy& s, const std::string& key) {
  for (Parameter& p : s.parameters)
    if (p.key == key) return p;
  s.parameters.emplace_back().key = key;
  return s.parameters.back();
}

void trials_of_file(study::ObjectReader& sampling, const study::Common& common, const std::string& file,
                    ParameterStudy& s) {
  const auto text = study::read_beside(sampling, "file", common.folder, file);
  if (!text) return;
  Diagnostics problems;
  const auto table = read_csv(*text, (common.folder / file).string(), problems);
  for (const Diagnostic& problem : problems) sampling.unreadable("file", study::in_file(problem));
  if (!table) return;
  for (const Column& column : table->columns) parameter_of(s, column.key);
  for (const Parameter& p : s.parameters)
    if (!table->find(p.key)) {
      sampling.error("file", fmt::format("'{}' has no column '{}'", file, p.key),
                     "its columns are called as the keys of the parameters");
      return;
    }
  s.trials.dimension = s.parameters.size();
  for (std::size_t i = 0; i < table->rows(); ++i)
    for (const Parameter& p : s.parameters) {
      const double value = table->find(p.key)->values[i];
      if (!std::isfinite(value)) {
        sampling.error("file", fmt::format("'{}': trial {} has no {}", file, i + 1, p.key), "fill it in");
        return;
      }
      s.trials.coordinates.push_back(value);
    }
}

void trials_of_rows(study::ObjectReader& sampling, const std::vector<PlainList>& rows, ParameterStudy& s) {
  const std::size_t n = s.parameters.size();
  s.trials.dimension = n;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::vector<Value>& row = rows[i].values;
    if (row.size() != n)
      return sampling.error(
          "trials", fmt::format("trial {} has {} values, there are {} parameters", i + 1, row.size(), n),
          "give each parameter one, in their order");
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<Value>& words = s.parameters[j].words;
      if (row[j].is_number() && words.empty()) {
        s.trials.coordinates.push_back(row[j].as_number());
        continue;
      }
      if (words.empty() && i > 0)
        return sampling.error("trials",
                              fmt::format("trial {} has a word for '{}', those before it have numbers", i + 1,
                                          s.parameters[j].key),
                              "give a parameter numbers or words in all trials");
      const auto found = std::find(words.begin(), words.end(), row[j]);
      s.trials.coordinates.push_back(static_cast<double>(found - words.begin()));
      if (found == words.end()) words.push_back(row[j]);
    }
  }
}

void read_list(study::ObjectReader& sampling, const study::Common& common, const ListSampling& list,
               ParameterStudy& s) {
  const bool by_file = sampling.has("file"), by_rows = sampling.has("trials");
  if (by_file == by_rows)
    return sampling.error(
        by_file ? "trials" : "file", by_file ? "the trials are in a file or here" : "the trials are missing",
        by_file ? "keep one of them"
                : "write file = \"trials.csv\" or trials = [[20, 90], [25, 80]], a row a trial");
  if (by_file ? !list.file : !list.trials) return;  // reported already
  if (by_file)
    trials_of_file(sampling, common, *list.file, s);
  else
    trials_of_rows(sampling, list.trials->rows, s);
  if (s.trials.count() == 0 && !sampling.document().has_errors())
    sampling.error(by_file ? "file" : "trials", "there are no trials", "give one row at least");
}

/// The number of trials of a sampling, before any is made.
double trials_asked(const ParameterStudy& s) {
  const auto n = static_cast<double>(s.parameters.size());
  if (const auto* a = std::get_if<LatinHypercubeSampling>(&s.sampling)) return a->samples;
  if (const auto* a = std::get_if<SobolSampling>(&s.sampling)) return a->samples;
  if (const auto* a = std::get_if<MorrisSampling>(&s.sampling)) return a->trajectories * (n + 1);
  if (const auto* a = std::get_if<SaltelliSampling>(&s.sampling)) return a->samples * (n + 2);
  double product = 1;
  for (const Parameter& p : s.parameters)
    product *= length_of_list(p) > 0 ? static_cast<double>(length_of_list(p)) : p.steps.value_or(usual_steps);
  return product;
}

Points points_of(const ParameterStudy& s) {
  const std::size_t n = s.parameters.size();
  if (const auto* a = std::get_if<LatinHypercubeSampling>(&s.sampling))
    return latin_hypercube(static_cast<std::size_t>(a->samples), n, a->seed);
  if (const auto* a = std::get_if<SobolSampling>(&s.sampling))
    return sobol_sequence(static_cast<std::size_t>(a->samples), n);
  if (const auto* a = std::get_if<MorrisSampling>(&s.sampling))
    return morris_trajectories(static_cast<std::size_t>(a->trajectories), n,
                               static_cast<std::size_t>(a->levels), a->seed);
  if (const auto* a = std::get_if<SaltelliSampling>(&s.sampling))
    return saltelli_points(static_cast<std::size_t>(a->samples), n);
  std::vector<std::size_t> levels;
  for (const Parameter& p : s.parameters)
    levels.push_back(length_of_list(p) > 0 ? length_of_list(p)
                                           : static_cast<std::size_t>(p.steps.value_or(usual_steps)));
  return grid(levels);
}

/// Makes the trials of all samplings but lists.
void make_trials(study::ObjectReader& document, ParameterStudy& s) {
  auto table = document.table("sampling");
  study::ObjectReader& where = table ? *table : document;
  const double count = trials_asked(s);
  if (count > max_trials)
    return where.error("samples", fmt::format("{:.3g} trials, at most {:.3g} are made", count, max_trials),
                       "take fewer steps or samples");
  if (!study::require_memory(
          where, "samples",
          study::table_bytes(count, static_cast<double>(s.parameters.size() + s.measures.size())),
          fmt::format("{:.0f} trials", count), "take fewer steps or samples"))
    return;
  if (const auto* a = std::get_if<MorrisSampling>(&s.sampling); a && a->levels % 2 != 0)
    return where.error("levels", fmt::format("is {}, must be even", a->levels));
  const bool even =
      std::holds_alternative<GridSampling>(s.sampling) || std::holds_alternative<MorrisSampling>(s.sampling);
  s.trials = points_of(s);
  for (std::size_t i = 0; i < s.trials.coordinates.size(); ++i)
    s.trials.coordinates[i] = value_at(s.parameters[i % s.trials.dimension], s.trials.coordinates[i], even);
}

/// True if the study knows the key of a parameter; problems of its first value are reported at the parameter.
void check_key(study::ObjectReader& where, const ParameterStudy& s, std::size_t j,
               std::span<const study::Kind> kinds) {
  const std::string& key = s.parameters[j].key;
  ParameterStudy alone = s;
  alone.parameters = {s.parameters[j]};
  alone.trials = {1, {s.trials.at(0, j)}};
  Diagnostics problems;
  Value document = s.study;
  const study::Override change{key, key, value_of(alone, 0, 0)};
  if (!study::parse_path(key) || !study::apply_override(document, change, problems)) {
    const bool none = problems.empty();
    where.error(
        "key", none ? fmt::format("'{}' is not the path of a key", key) : to_string(problems.front().message),
        none ? "write it like mechanism.link[0].length_mm" : to_string(problems.front().hint));
    return;
  }
  study::prepare(document, s.name, s.folder, kinds, problems);
  for (const Diagnostic& problem : problems)
    if (problem.severity == Diagnostic::Severity::error && problem.key == key &&
        problem.message == "unknown key")
      where.error("key", fmt::format("the study has no key '{}'", key), to_string(problem.hint));
}

void read_measures(study::ObjectReader& document, ParameterStudy& s) {
  const Field list = field::entry("measure", "numbers of each result");
  for (study::ObjectReader& reader : document.tables(list)) {
    Measure& measure = s.measures.emplace_back();
    reader(field::entry("quantity").required(), measure.request.quantity);
    reader(field::entry("name"), measure.name);
    study::read_row(reader, measure.request);
    if (std::any_of(measure.name.begin(), measure.name.end(), [](char c) {
          return !(c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'));
        }))
      reader.error("name", fmt::format("'{}' has other characters than letters, digits and _", measure.name),
                   "it becomes the name of a column");
  }
  if (s.measures.empty() && !document.has("measure"))
    document.missing(list,
                     "write [[measure]] with quantity = \"motion.transmission_angle_deg.min\", for example");
}

void read_parameters(study::ObjectReader& document, ParameterStudy& s) {
  const Field list = field::entry("parameter", "what is changed");
  for (study::ObjectReader& reader : document.tables(list)) {
    Parameter& p = s.parameters.emplace_back();
    reader.read(p);
    if (p.values && !std::all_of(p.values->values.begin(), p.values->values.end(),
                                 [](const Value& v) { return v.is_number(); }))
      p.words = p.values->values;
    for (std::size_t j = 0; j + 1 < s.parameters.size(); ++j)
      if (!p.key.empty() && s.parameters[j].key == p.key)
        reader.error("key", fmt::format("'{}' is changed twice", p.key), "keep one of them");
    if (!s.listed()) {
      check_values(reader, p);
      continue;
    }
    for (const char* key : {"min", "max", "steps", "values"})
      if (reader.has(key))
        reader.error(key, "the trials are a list, which has the values", fmt::format("remove {}", key));
  }
  if (s.parameters.empty() && !s.listed() && !document.has("parameter"))
    document.missing(list, "write [[parameter]] with key, min and max");
  const std::size_t most =
      std::holds_alternative<SaltelliSampling>(s.sampling) ? max_parameters / 2 : max_parameters;
  if (s.parameters.size() > most)
    document.error("parameter",
                   fmt::format("{} parameters, at most {} are changed", s.parameters.size(), most));
}

/// The study with everything it needs in it: a list in a file is copied here.
Value write_study(const ParameterStudy& s) {
  Value out;
  out["study"] = s.study;
  out["parameter"] = Value::array();
  for (const Parameter& p : s.parameters) out["parameter"].push_back(study::write_fields(p));
  Sampling sampling = s.sampling;
  if (s.listed()) {
    PlainRows trials;
    for (std::size_t i = 0; i < s.trials.count(); ++i) {
      PlainList& row = trials.rows.emplace_back();
      for (std::size_t j = 0; j < s.parameters.size(); ++j) row.values.push_back(value_of(s, i, j));
    }
    sampling = ListSampling{{}, std::move(trials)};
  }
  study::ObjectWriter{out["sampling"]}(sampling_field, sampling);
  out["measure"] = Value::array();
  for (const Measure& m : s.measures) {
    Value one;
    one["quantity"] = m.request.quantity;
    if (!m.name.empty()) one["name"] = m.name;
    for (const auto& [key, value] : m.request.at) one["at"][key] = value;
    out["measure"].push_back(std::move(one));
  }
  return out;
}

study::Prepared prepare_sweep(study::ObjectReader& document, const study::Common& common,
                              std::span<const study::Kind> kinds) {
  ParameterStudy s;
  bool runs = false;
  if (auto table = document.table(field::entry("study").required())) {
    s.study = inner_document(*table, common, s);
    runs = !s.study.is_null() && check_study(*table, s.study, s, kinds);
  }
  auto sampling = document.table("sampling");
  if (sampling) (*sampling)(sampling_field, s.sampling);
  read_parameters(document, s);
  read_measures(document, s);
  if (s.listed()) {
    read_list(*sampling, common, std::get<ListSampling>(s.sampling), s);
  } else if (!document.document().has_errors()) {
    make_trials(document, s);
  }
  if (runs && s.trials.count() > 0 && !document.document().has_errors()) {
    std::vector<study::ObjectReader> readers = document.tables("parameter");
    for (std::size_t j = 0; j < s.parameters.size(); ++j)
      check_key(j < readers.size() ? readers[j] : *sampling, s, j, kinds);
  }
  study::Prepared prepared;
  prepared.canonical = write_study(s);
  prepared.run = [s = std::move(s), kinds](RunContext& context) {
    return run_parameter_study(s, kinds, context);
  };
  return prepared;
}

Value any_table() {
  Value schema;
  schema["type"] = "object";
  return schema;
}

void describe(study::SchemaWriter& document) {
  document.property(field::entry("study", "the study that is run: all its tables, or its file").required(),
                    any_table());
  document.property(field::entry("parameter", "a key that is changed"),
                    study::schema_array(study::schema_fields<Parameter>()));
  study::SchemaWriter sampling;
  sampling(sampling_field, Sampling{});
  document.property(field::entry("sampling", "which values are tried"), std::move(sampling).finish());
  Value measure, text, number;
  text["type"] = "string";
  measure["type"] = "object";
  measure["properties"]["quantity"] = text;
  measure["properties"]["quantity"]["description"] =
      "as in [[check]]: best.<key>, statistics.<key>, <table>.<column>.<statistic>";
  measure["properties"]["name"] = text;
  measure["properties"]["name"]["description"] = "of its column; default: made of the quantity";
  measure["properties"]["at"]["type"] = "object";
  measure["properties"]["at"]["additionalProperties"]["type"] = "number";
  measure["required"].push_back(Value("quantity"));
  measure["additionalProperties"] = false;
  document.property(field::entry("measure", "a number of each result").required(),
                    study::schema_array(std::move(measure)));
}

}  // namespace

bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field&,
                PlainList& member) {
  const Value& list = *found.value;
  if (list.is_array() && !list.as_array().empty() &&
      std::all_of(list.as_array().begin(), list.as_array().end(), is_plain)) {
    member.values = list.as_array();
    return true;
  }
  reader.problem(found, "must be a list of numbers or words",
                 "write it like [20, 25, 30] or [\"open\", \"crossed\"]");
  return false;
}
Value write_value(const PlainList& member) { return Value(Value::Array(member.values)); }
Value schema_value(const Field&, const PlainList&) {
  Value one;
  for (const char* type : {"number", "string", "boolean"}) one["type"].push_back(Value(type));
  return study::schema_array(std::move(one));
}

bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                PlainRows& member) {
  if (!found.value->is_array()) {
    reader.problem(found, "must be a list of rows", "write it like [[20, 90], [25, 80]], a row a trial");
    return false;
  }
  const Value::Array& rows = found.value->as_array();
  bool good = true;
  for (std::size_t i = 0; i < rows.size(); ++i)
    good = read_value(reader, {&rows[i], nullptr, fmt::format("{}[{}]", found.path, i)}, field,
                      member.rows.emplace_back()) &&
           good;
  return good;
}
Value write_value(const PlainRows& member) {
  Value out = Value::array();
  for (const PlainList& row : member.rows) out.push_back(write_value(row));
  return out;
}
Value schema_value(const Field& field, const PlainRows&) {
  return study::schema_array(schema_value(field, PlainList{}));
}

Value value_of(const ParameterStudy& s, std::size_t trial, std::size_t parameter) {
  constexpr double largest_integer = 9007199254740992;  // 2^53: below, whole numbers are exact
  const double value = s.trials.at(trial, parameter);
  const std::vector<Value>& words = s.parameters[parameter].words;
  if (!words.empty()) return words[static_cast<std::size_t>(value)];
  // Counts are written as such.
  if (value == std::floor(value) && std::abs(value) < largest_integer)
    return static_cast<std::int64_t>(value);
  return value;
}

Value document_of(const ParameterStudy& s, std::size_t trial) {
  Value document = s.study;
  Diagnostics none;
  for (std::size_t j = 0; j < s.parameters.size(); ++j)
    study::apply_override(document, {{}, s.parameters[j].key, value_of(s, trial, j)}, none);
  return document;
}

study::Kind sweep_kind(std::span<const study::Kind> kinds) {
  study::Kind kind;
  kind.kind = "sweep";
  kind.summary = "a study over some of its keys: grids, samples, sensitivity";
  kind.example = templates::sweep();
  kind.schema = describe;
  kind.prepare = [kinds](study::ObjectReader& document, const study::Common& common) {
    return prepare_sweep(document, common, kinds);
  };
  return kind;
}

}  // namespace linkwright::parameter_study
