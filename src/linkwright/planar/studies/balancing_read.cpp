// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/closing_row.h"
#include "linkwright/planar/studies/balancing.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/serial_arm.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/study.h"

namespace linkwright::planar {
namespace {

// Tables of an analysis, those of them where numbers may be open first.
constexpr std::array<std::string_view, 5> table_keys = {"mechanism", "drive", "environment", "sweep",
                                                        "trace"};

// Every candidate is evaluated at all rows.
constexpr std::size_t max_rows = 20000;

// Adds the limit that keeps inertias physical: the radius of gyration of a link about its own joint, without
// what is attached to it, is at most the distance of its material that is furthest away. Constant over the
// rows.
void add_gyration(Table& table, const std::string& link, double mass, double inertia,
                  std::complex<double> centre) {
  const double radius = mass > 0 ? std::sqrt(inertia / mass + std::norm(centre)) : 0;
  table.add(identifier(link) + "_gyration_radius_m", link + " radius of gyration about its own joint (m)",
            std::vector<double>(table.rows(), radius));
}
void add_gyration(Table& table, const std::string& link, const LinkMass& m) {
  add_gyration(table, link, m.mass, m.inertia, m.centre_distance);
}

Table linkage_columns_of(study::ObjectReader& document, const study::Common& common, LinkageType type,
                         std::span<const std::string> columns) {
  const auto s = read_linkage_study(document, common, type, nullptr);
  if (!s || document.document().has_errors()) return {};
  if (const std::size_t rows = rows_of(*s).time.size(); rows > max_rows) {
    document.error(
        "sweep", fmt::format("has {} rows, a balancing evaluates at most {} of each design", rows, max_rows),
        "take fewer samples; some hundred are enough");
    return {};
  }
  Table table = linkage_table(*s, columns);
  for (std::size_t b = 1; b < s->linkage.bodies.size(); ++b)
    if (const LinkageBody& body = s->linkage.bodies[b]; body.mass)
      add_gyration(table, body.name, body.mass->mass, body.mass->inertia, body.mass->centre);
  return table;
}

constexpr std::array<BalancedMechanism, 4> mechanisms = {{
    {"planar.four_bar", templates::balancing_four_bar, four_bar_kind,
     [](study::ObjectReader& document, const study::Common& common, std::span<const std::string> columns) {
       return linkage_columns_of(document, common, LinkageType::four_bar, columns);
     }},
    {"planar.linkage", templates::balancing_linkage, linkage_kind,
     [](study::ObjectReader& document, const study::Common& common, std::span<const std::string> columns) {
       return linkage_columns_of(document, common, LinkageType::linkage, columns);
     }},
    {"planar.slider_crank", templates::balancing_slider_crank, slider_crank_kind,
     [](study::ObjectReader& document, const study::Common& common, std::span<const std::string> columns) {
       return linkage_columns_of(document, common, LinkageType::slider_crank, columns);
     }},
    {"planar.serial_arm", templates::balancing_serial_arm, serial_arm_kind,
     [](study::ObjectReader& document, const study::Common& common, std::span<const std::string>) {
       const SerialArmStudy s = read_serial_arm_study(document, common);
       if (document.document().has_errors()) return Table();
       Table table = serial_arm_table(s);
       const SerialArm arm = serial_arm(s.mechanism);
       for (std::size_t k = 0; k < arm.links.size(); ++k)
         add_gyration(table, s.mechanism.links[k].name, arm.links[k].body);
       return table;
     }},
}};

// All quantities, and no more of the rest than an analysis needs.
study::Common plain(const study::Common& common) {
  study::Common out;
  out.folder = common.folder;
  return out;
}

// The `type` of a mechanism is read by the study module in a whole document.
void know_type(study::ObjectReader& root) {
  std::string type;
  if (auto mechanism = root.table("mechanism")) (*mechanism)(field::entry("type"), type);
}

void check_quantities(study::ObjectReader& document, std::string_view list,
                      const std::vector<std::string>& quantities, const Table& table) {
  std::vector<std::string_view> known;
  for (const Column& c : table.columns) known.push_back(c.key);
  std::vector<study::ObjectReader> entries = document.tables(list);
  for (std::size_t k = 0; k < quantities.size() && k < entries.size(); ++k) {
    if (table.find(quantities[k])) continue;
    entries[k].error(
        "quantity", fmt::format("the analysis has no column '{}'", quantities[k]),
        did_you_mean(quantities[k], known, fmt::format("columns are: {}", fmt::join(known, ", "))));
  }
}

// The row of the initial design without an answer, "" if all have one.
std::string first_bad_row(const Table& table) {
  for (std::size_t r = 0; r < table.status.size(); ++r)
    if (table.status[r] != "done")
      return fmt::format("{} at {} = {:.6g}", table.status[r], table.columns[0].key,
                         table.columns[0].values[r]);
  return {};
}

void read_goals(study::ObjectReader& document, BalancingStudy& s) {
  document(field::entry("objective", "what is minimised").required(), s.objectives);
  if (s.objectives.empty() && document.has("objective"))
    document.error("objective", "no objective is given", "add [[objective]]");
  std::vector<BalancingLimit> limits;
  document(field::entry("constraint", "what must hold"), limits);
  std::vector<study::ObjectReader> entries = document.tables("constraint");
  for (std::size_t k = 0; k < limits.size() && k < entries.size(); ++k) {
    const BalancingLimit& c = limits[k];
    if (!c.at_least && !c.at_most)
      entries[k].error("quantity", "the constraint has no limit", "add at_least or at_most");
    else if (c.at_least && c.at_most && *c.at_least > *c.at_most)
      entries[k].error("at_least",
                       fmt::format("is {}, more than at_most, which is {}", *c.at_least, *c.at_most));
  }
  s.constraints = std::move(limits);
}

// Reads the tables as an analysis does, with all its checks; false when there are errors.
bool read_design(study::ObjectReader& document, const study::Common& common, const BalancingStudy& s,
                 const Value& tables, std::string_view remark) {
  Diagnostics problems;
  study::DocumentReader reader(tables, document.document().file(), problems);
  study::ObjectReader root = reader.root();
  know_type(root);
  s.mechanism->analysis().prepare(root, plain(common));
  reader.finish([&] { return study::schema_of(s.mechanism->analysis()); });
  const bool good = !has_errors(problems);
  for (Diagnostic& d : problems) {
    d.message += remark;
    document.document().error(std::move(d));
  }
  return good;
}

// The initial design: its columns for the checks of names, and its problems; and whether numbers may take the
// values that they are given room for.
void check_initial(study::ObjectReader& document, const study::Common& common, BalancingStudy& s) {
  if (!read_design(document, common, s, s.designed.tables, "")) return;
  bool good = true;
  for (const study::DesignVariable& n : s.designed.numbers)
    for (const auto& [value, remark] : {std::pair{n.lower, " (at the min of a design variable)"},
                                        {n.upper, " (at the max of a design variable)"}}) {
      Value tables = s.designed.tables;
      study::put(tables, {&n, 1}, {&value, 1});
      good = read_design(document, common, s, tables, remark) && good;
    }
  if (!good) return;
  Diagnostics problems;
  study::DocumentReader reader(s.designed.tables, document.document().file(), problems);
  study::ObjectReader root = reader.root();
  const Table table = s.mechanism->table(root, plain(common), {});
  for (const Diagnostic& d : problems)
    if (d.severity == Diagnostic::Severity::error)
      document.document().report(d.severity, d.position, d.key, to_string(d.message), to_string(d.hint));
  if (table.columns.empty()) return;
  std::vector<std::string> quantities;
  for (const BalancingGoal& o : s.objectives) quantities.push_back(o.quantity);
  check_quantities(document, "objective", quantities, table);
  quantities.clear();
  for (const BalancingLimit& c : s.constraints) quantities.push_back(c.quantity);
  check_quantities(document, "constraint", quantities, table);
  if (const std::string bad = first_bad_row(table); !bad.empty()) {
    document.error("mechanism", fmt::format("the initial design has no answer everywhere: {}", bad),
                   "answers are compared with it; give initial values that assemble over the whole sweep");
    return;
  }
  std::vector<study::ObjectReader> entries = document.tables("objective");
  for (std::size_t k = 0; k < s.objectives.size() && k < entries.size(); ++k) {
    const BalancingGoal& o = s.objectives[k];
    const Column* column = table.find(o.quantity);
    if (column && !o.reference && !(measure(o.measure, column->values, has_closing_row(table)) > 0))
      entries[k].error("quantity",
                       fmt::format("'{}' of the initial design is {:.3g}, which cannot be what counts as 1",
                                   o.quantity, measure(o.measure, column->values, has_closing_row(table))),
                       "give reference = a value in the unit of the column");
  }
}

}  // namespace

BalancingStudy read_balancing_study(study::ObjectReader& document, const study::Common& common) {
  BalancingStudy s;
  std::string type;
  if (auto mechanism = document.table("mechanism")) (*mechanism)(field::entry("type"), type);
  auto known = std::find_if(mechanisms.begin(), mechanisms.end(),
                            [&](const BalancedMechanism& m) { return m.type == type; });
  // A wrong type has been reported; without any that is near there is nothing to read the rest by.
  if (known == mechanisms.end()) {
    std::vector<std::string_view> types;
    for (const BalancedMechanism& m : mechanisms) types.push_back(m.type);
    const std::string_view nearest = nearest_word(type, types);
    known = std::find_if(mechanisms.begin(), mechanisms.end(),
                         [&](const BalancedMechanism& m) { return m.type == nearest; });
    if (known == mechanisms.end()) return s;
  }
  s.mechanism = &*known;
  s.designed = study::take_designed(document, table_keys);
  read_goals(document, s);
  if (auto optimiser = document.table("optimiser")) {
    optimiser->read(s.optimiser);
    if (const auto bad = problem(s.optimiser, s.objectives.size()))
      optimiser->error("method", bad->message, bad->hint);
  }
  constexpr std::size_t max_numbers = 200;
  if (s.designed.numbers.size() > max_numbers)
    document.error("mechanism", fmt::format("{} design variables, at most {} are possible",
                                            s.designed.numbers.size(), max_numbers));
  else
    check_initial(document, common, s);
  if (s.designed.numbers.empty() && !document.document().has_errors())
    document.error("mechanism", "there is no design variable: every number is fixed",
                   "write { min = ..., max = ..., initial = ... } instead of a number");
  return s;
}

namespace {

study::Prepared prepare(study::ObjectReader& document, const study::Common& common) {
  BalancingStudy s = read_balancing_study(document, common);
  study::Prepared prepared;
  // Tables stay as written: what is open in them has no other form.
  for (std::string_view key : table_keys)
    if (const Value* table = document.value().find(key)) prepared.canonical[key] = *table;
  prepared.canonical["objective"] = study::ObjectWriter::to_value(s.objectives);
  if (!s.constraints.empty()) prepared.canonical["constraint"] = study::ObjectWriter::to_value(s.constraints);
  prepared.canonical["optimiser"] = study::write_fields(s.optimiser);
  std::erase_if(s.constraints, [](const BalancingLimit& c) { return !c.enabled; });
  prepared.run = [s = std::move(s), common](RunContext& context) {
    return run_balancing_study(s, common, context);
  };
  return prepared;
}

// A table that the analysis describes; any number in it may be open.
void describe_table(study::SchemaWriter& document, std::string_view key, bool array, bool required) {
  Value table;
  table["type"] = "object";
  table["description"] = "as in the analysis; any number may be { min, max, initial }";
  document.property(field::entry(key, "as in the analysis").required(required),
                    array ? study::schema_array(std::move(table)) : std::move(table));
}

study::Kind kind_of(const BalancedMechanism& mechanism) {
  const study::Kind analysis = mechanism.analysis();
  study::Kind kind;
  kind.kind = "balancing";
  kind.mechanism = mechanism.type;
  kind.summary = "least joint forces, shaking forces or drive torques by masses, lengths or motion laws";
  kind.seeded = true;
  kind.example = mechanism.example();
  const bool many_drives = mechanism.type != std::string_view("planar.four_bar");
  kind.schema = [many_drives](study::SchemaWriter& document) {
    describe_table(document, "mechanism", false, true);
    describe_table(document, "drive", many_drives, false);
    describe_table(document, "environment", false, false);
    describe_table(document, "sweep", false, false);
    if (many_drives) describe_table(document, "trace", true, false);
    document.property(field::entry("objective", "what is minimised").required(),
                      study::schema_array(study::schema_fields<BalancingGoal>()));
    document.property(field::entry("constraint", "what must hold"),
                      study::schema_array(study::schema_fields<BalancingLimit>()));
    document.property(field::entry("optimiser", "how designs are searched"),
                      study::schema_fields<BalancingOptimiser>());
  };
  kind.prepare = prepare;
  return kind;
}

}  // namespace

std::span<const BalancedMechanism> balanced_mechanisms() { return mechanisms; }

std::vector<study::Kind> balancing_kinds() {
  std::vector<study::Kind> out;
  for (const BalancedMechanism& mechanism : mechanisms) out.push_back(kind_of(mechanism));
  return out;
}

bool closes(const BalancingStudy& s) {
  std::vector<double> x;
  for (const study::DesignVariable& n : s.designed.numbers) x.push_back(n.initial);
  return has_closing_row(design_table(s, x, {}));
}

Value design_tables(const BalancingStudy& s, std::span<const double> x) {
  Value tables = s.designed.tables;
  study::put(tables, s.designed.numbers, x);
  return tables;
}

Table design_table(const BalancingStudy& s, std::span<const double> x, std::span<const std::string> columns) {
  const Value tables = design_tables(s, x);
  Diagnostics problems;
  study::DocumentReader reader(tables, {}, problems);
  study::ObjectReader root = reader.root();
  return s.mechanism->table(root, {}, columns);
}

study::Result design_analysis(const BalancingStudy& s, const study::Common& common, std::span<const double> x,
                              RunContext& context) {
  const Value tables = design_tables(s, x);
  Diagnostics problems;
  study::DocumentReader reader(tables, {}, problems);
  study::ObjectReader root = reader.root();
  const study::Prepared prepared = s.mechanism->analysis().prepare(root, plain(common));
  return prepared.run && !reader.has_errors() ? prepared.run(context) : study::Result();
}

}  // namespace linkwright::planar
