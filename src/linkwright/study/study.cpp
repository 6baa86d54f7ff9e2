// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <thread>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/units.h"
#include "linkwright/study/bind_output_units.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/design.h"
#include "linkwright/study/memory.h"
#include "linkwright/study/renamed.h"
#include "linkwright/study/result_units.h"
#include "linkwright/study/trade_words.h"

namespace linkwright::study {
namespace {

const Field kind_field = field::entry("kind", "what the study does").required();
const Field type_field = field::entry("type").required();
const Field schema_field = field::entry("schema", "version of the study grammar");
const Field title_field = field::entry("title", "one line for people");
const Field source_field = field::entry("source", "where the numbers come from");
const Field output_field = field::entry("output", "what is written, and where");
const Field quantities_field = field::entry("quantities", "what is computed; all when absent");
const Field seeds_field = field::entry("seeds", "one run for each seed");
const Field check_field = field::entry("check", "makes the study a regression test");

/// `[optimiser] seed`, the short form of seeds.
struct OneSeed {
  std::optional<std::int64_t> seed;
};
template <class Visitor>
void fields(Visitor&& visit, OneSeed& one) {
  visit(field::entry("seed", "the only seed, instead of seeds").not_negative(), one.seed);
}

void read_seeds(ObjectReader& optimiser, Seeds& seeds) {
  optimiser(seeds_field, seeds);
  OneSeed one;
  optimiser.read(one);
  if (!one.seed) return;
  if (optimiser.has("seeds"))
    optimiser.error("seed", "stands beside seeds", "keep one of them");
  else
    seeds = {*one.seed, 1};
}

/// Keeps the kinds whose `part` is the word at a key. A misspelt word is an error, and the reading continues
/// with the word that was probably meant, so that the other problems of the file are found too.
void choose(std::vector<const Kind*>& kinds, std::string Kind::*part, ObjectReader& table,
            const Field& field) {
  std::vector<Word> words;
  std::vector<std::string_view> names;
  for (const Kind* kind : kinds) {
    const std::string& name = kind->*part;
    if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) continue;
    words.push_back({name, {}});
    names.push_back(name);
  }
  std::string_view chosen;
  if (const auto index = table.word(field, words)) {
    chosen = names[*index];
  } else if (const Value* value = table.value().find(field.key); value && value->is_string()) {
    chosen = meant_word(value->as_string(), names);
  }
  std::erase_if(kinds, [&](const Kind* kind) { return kind->*part != chosen; });
}

const Kind* find_kind(ObjectReader& root, std::span<const Kind> all) {
  std::vector<const Kind*> kinds;
  for (const Kind& kind : all) kinds.push_back(&kind);
  choose(kinds, &Kind::kind, root, kind_field);
  if (kinds.empty()) return nullptr;
  if (kinds.front()->mechanism.empty()) return kinds.front();

  std::optional<ObjectReader> mechanism = root.table(field::entry("mechanism").required());
  if (!mechanism) return nullptr;
  choose(kinds, &Kind::mechanism, *mechanism, type_field);

  const auto no_target =
      std::find_if(kinds.begin(), kinds.end(), [](const Kind* k) { return k->target.empty(); });
  const bool some_target =
      std::any_of(kinds.begin(), kinds.end(), [](const Kind* k) { return !k->target.empty(); });
  if (!some_target || (no_target != kinds.end() && !root.has("target")))
    return no_target == kinds.end() ? nullptr : *no_target;
  std::optional<ObjectReader> target = root.table(field::entry("target").required());
  if (!target) return nullptr;
  choose(kinds, &Kind::target, *target, type_field);
  return kinds.empty() ? nullptr : kinds.front();
}

void read_output(ObjectReader& root, const Kind* kind, Output& output) {
  auto table = root.table(output_field);
  if (!table) return;
  table->read(output);
  if (std::any_of(output.dir.begin(), output.dir.end(),
                  [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    table->error("dir", "has a special character in it, which a backslash in double quotes makes",
                 "use / in paths, or single quotes");
  if (output.parts && output.parts->width && output.parts->pin_diameter &&
      !(*output.parts->width > *output.parts->pin_diameter))
    table->error("parts", "the pins are as wide as the links", "make pin_diameter smaller than width");
  if (!kind) {
    table->members();
    return;
  }
  if (kind->quantities.empty()) return;
  (*table)(quantities_field, output.quantities);
  std::vector<std::string_view> allowed;
  for (const Word& word : kind->quantities) allowed.push_back(word.name);
  for (const std::string& quantity : output.quantities) {
    if (std::find(allowed.begin(), allowed.end(), quantity) != allowed.end()) continue;
    table->error("quantities", fmt::format("'{}' is none of: {}", quantity, fmt::join(allowed, ", ")),
                 did_you_mean(quantity, allowed));
  }
}

void read_schema_version(ObjectReader& root) {
  std::int64_t version = 0;
  if (!root.has(schema_field))
    root.missing(schema_field, fmt::format("add schema = {}", schema_version));
  else if (root(schema_field, version) && version != schema_version)
    root.error("schema", fmt::format("is {}, must be {}", version, schema_version),
               "this program reads studies of that version");
}

/// A table with `key` put before the members it has.
void put_first(Value& table, std::string_view key, Value value) {
  if (table.is_null()) table = Value::object();
  if (Value* found = table.find(key))
    *found = std::move(value);
  else
    table.as_object().insert(table.as_object().begin(), {std::string(key), std::move(value), {}});
}

Value canonical(const Kind& kind, const Common& common, Value own) {
  Value all;
  all["schema"] = schema_version;
  all["kind"] = kind.kind;
  if (!common.title.empty()) all["title"] = common.title;
  if (!common.source.empty()) all["source"] = common.source;
  if (own.is_null()) own = Value::object();
  if (!kind.mechanism.empty()) put_first(own["mechanism"], "type", kind.mechanism);
  if (!kind.target.empty()) put_first(own["target"], "type", kind.target);
  if (kind.seeded) own["optimiser"]["seeds"] = write_fields(common.seeds);
  for (Value::Member& member : own.as_object()) all[member.key] = std::move(member.value);
  all["output"] = write_fields(common.output);
  if (!common.output.quantities.empty())
    all["output"]["quantities"] = ObjectWriter::to_value(common.output.quantities);
  if (!common.checks.empty()) all["check"] = write_checks(common.checks);
  return all;
}

Value constant(std::string_view word) {
  Value schema;
  schema["const"] = word;
  return schema;
}

/// Adds a key that the study module reads to a table that the domain describes.
void add_property(Value& document, std::string_view table, std::string_view key, Value schema,
                  bool required) {
  Value& described = document["properties"][table];
  if (described.is_null()) described["type"] = "object";
  put_first(described["properties"], key, std::move(schema));
  if (required) described["required"].push_back(Value(key));
}

/// Two columns of one name would hide each other in plots, checks and spreadsheets.
void make_unique(Table& table, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (Column& column : table.columns) {
    if (names.insert(column.key).second) continue;
    const auto parts = split_unit(column.key);
    const std::string base = parts ? std::string(parts->base) : column.key;
    const std::string unit = parts ? "_" + std::string(parts->unit->suffix) : std::string();
    int number = 2;
    while (!names.insert(fmt::format("{}_{}{}", base, number, unit)).second) ++number;
    const std::string key = fmt::format("{}_{}{}", base, number, unit);
    diagnostics.push_back(
        {.severity = Diagnostic::Severity::warning,
         .key = table.name + "." + column.key,
         .message = fmt::format("two columns have this name; that of '{}' is now {}", column.label, key),
         .hint = "give bodies, joints and points names that differ in letters and digits"});
    column.key = key;
  }
}

/// Ranges { min, max } in a value: unknowns, for all that the study module knows.
std::size_t ranges_in(const Value& value) {
  std::size_t out = 0;
  if (value.is_object()) {
    out += value.find("min") != nullptr && value.find("max") != nullptr;
    for (const Value::Member& member : value.as_object()) out += ranges_in(member.value);
  } else if (value.is_array()) {
    for (const Value& element : value.as_array()) out += ranges_in(element);
  }
  return out;
}

/// Every kind with an optimiser has these keys; seeds run at once on all threads.
void require_room_for_candidates(ObjectReader& root, const Value& document, const Common& common) {
  constexpr std::size_t usual_unknowns = 10;
  const Value* optimiser = document.find("optimiser");
  if (!optimiser || !optimiser->is_object()) return;
  const std::size_t unknowns = std::max(usual_unknowns, ranges_in(document));
  const double at_once =
      std::min<double>(common.seeds.count, std::max(1u, std::thread::hardware_concurrency()));
  for (const char* key : {"population", "candidates"}) {
    const Value* count = optimiser->find(key);
    if (!count || !count->is_integer()) continue;
    if (auto table = root.table("optimiser"))
      require_memory(
          *table, key,
          at_once * population_bytes(static_cast<double>(count->as_integer()), static_cast<double>(unknowns)),
          fmt::format("{} candidates of {} unknowns{}", count->as_integer(), unknowns,
                      at_once > 1 ? fmt::format(", {:.0f} seeds at once", at_once) : std::string()),
          "take fewer candidates");
  }
}

}  // namespace

std::optional<Study> prepare(const Value& given, const std::string& file, const std::filesystem::path& folder,
                             std::span<const Kind> kinds, Diagnostics& diagnostics) {
  LINKWRIGHT_REQUIRE(given.is_object(), "a study is a table, got {}", given.type_name());
  const Value document = with_todays_names(given, file, diagnostics);
  DocumentReader reader(document, file, diagnostics);
  ObjectReader root = reader.root();
  Study study;
  Common& common = study.common;
  common.folder = folder;
  common.units = units_of(document);
  read_schema_version(root);
  root(title_field, common.title);
  root(source_field, common.source);
  study.kind = find_kind(root, kinds);
  read_output(root, study.kind, common.output);
  common.checks = read_checks(root);
  Prepared prepared;
  if (study.kind) {
    reader.explain(study.kind->absent);
    if (study.kind->seeded)
      if (auto optimiser = root.table("optimiser")) read_seeds(*optimiser, common.seeds);
    if (study.kind->seeded) require_room_for_candidates(root, document, common);
    prepared = study.kind->prepare(root, common);
  } else {
    // Without a kind it is not known what else is allowed here.
    root.members();
    for (const char* name : {"mechanism", "target"})
      if (root.is_table(field::entry(name))) root.table(name)->members();
  }
  reader.finish([&] { return study.kind ? schema_of(*study.kind) : Value(); });
  if (reader.has_errors() || !study.kind) return std::nullopt;
  LINKWRIGHT_REQUIRE(prepared.run != nullptr, "the kind '{}' accepted '{}' but cannot run it",
                     name_of(*study.kind), file);
  study.canonical = canonical(*study.kind, common, std::move(prepared.canonical));
  study.run = std::move(prepared.run);
  study.tables = std::move(prepared.tables);
  return study;
}

std::string title_of(const Study& study) {
  return study.common.title.empty() ? name_of(*study.kind) : study.common.title;
}

Result run_study(const Study& study, RunContext& context) {
  Result result;
  try {
    result = study.run(context);
  } catch (const Interrupted& why) {
    result.status = why.status();
    result.headline = "Interrupted before there was anything to report.";
  }
  for (Scene& scene : result.scenes)
    if (scene.title.empty()) scene.title = title_of(study);
  for (Table& table : result.tables) make_unique(table, result.diagnostics);
  if (!result.solutions.empty())
    complete_designs(result, title_of(study), shown_units({}, study.common.units));
  for (const CheckRequest& check : study.common.checks) result.checks.push_back(evaluate(check, result));
  return result;
}

Value schema_of(const Kind& kind) {
  SchemaWriter writer;
  Value version;
  version["const"] = schema_version;
  Field required_schema = schema_field;
  required_schema.is_required = true;
  writer.property(required_schema, std::move(version));
  writer.property(kind_field, constant(kind.kind));
  Value text;
  text["type"] = "string";
  writer.property(title_field, text);
  writer.property(source_field, text);
  if (kind.schema) kind.schema(writer);

  Value output = schema_fields<Output>();
  if (!kind.quantities.empty()) {
    Value::Array words;
    for (const Word& word : kind.quantities) {
      words.push_back(constant(word.name));
      if (!word.summary.empty()) words.back()["description"] = word.summary;
    }
    Value one;
    one["oneOf"] = Value(std::move(words));
    output["properties"]["quantities"] = schema_array(std::move(one));
  }
  writer.property(output_field, std::move(output));
  Value check = schema_fields<CheckRequest>();
  Value at;
  at["type"] = "object";
  at["additionalProperties"]["type"] = "number";
  check["properties"]["at"] = std::move(at);
  writer.property(check_field, schema_array(std::move(check)));

  Value document;
  document["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  document["title"] = name_of(kind);
  document["description"] = kind.summary;
  for (const Absent& absent : kind.absent) {
    Value one;
    one["key"] =
        absent.word.empty() ? std::string(absent.key) : fmt::format("{} = \"{}\"", absent.key, absent.word);
    one["reason"] = absent.reason;
    document["absent"].push_back(std::move(one));
  }
  Value own = std::move(writer).finish();
  for (Value::Member& member : own.as_object()) document[member.key] = std::move(member.value);
  if (!kind.mechanism.empty()) add_property(document, "mechanism", "type", constant(kind.mechanism), true);
  if (!kind.target.empty()) add_property(document, "target", "type", constant(kind.target), true);
  if (kind.seeded) {
    add_property(document, "optimiser", "seeds", schema_fields<Seeds>(), false);
    add_property(document, "optimiser", "seed", schema_fields<OneSeed>()["properties"]["seed"], false);
  }
  return document;
}

Value schema_of(std::span<const Kind> kinds) {
  Value::Array all;
  for (const Kind& kind : kinds) {
    all.push_back(schema_of(kind));
    std::erase_if(all.back().as_object(),
                  [](const Value::Member& member) { return member.key == "$schema"; });
  }
  Value document;
  document["$schema"] = "https://json-schema.org/draft/2020-12/schema";
  document["title"] = "linkwright study";
  document["anyOf"] = Value(std::move(all));
  return document;
}

std::string name_of(const Kind& kind) {
  std::string name = kind.kind;
  for (const std::string& part : {kind.mechanism, kind.target})
    if (!part.empty()) name += "/" + part;
  return name;
}

std::string schema_file(std::string_view kind) {
  std::string out(kind);
  std::replace(out.begin(), out.end(), '/', '-');
  return out + ".schema.json";
}

}  // namespace linkwright::study
