// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/overlays.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "linkwright/core/csv.h"
#include "linkwright/core/units.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t max_measured = 20, max_measured_rows = 100000;

std::string_view base_of_key(std::string_view key) {
  const auto parts = split_unit(key);
  return parts ? parts->base : key;
}

/// A heading in small letters with one mark between its words: "Toe L [deg]" is toe_l_deg.
std::string plain_heading(std::string_view heading) {
  std::string out;
  for (const char c : heading)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '_')
      out += '_';
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out;
}

/// The column of a file with this heading, with its unit or without it; nullptr where none or several have
/// it.
const Column* headed(const Table& file, const std::string& heading) {
  const std::string plain = plain_heading(heading);
  const Column* found = nullptr;
  for (const Column& c : file.columns) {
    if (c.key == heading || plain_heading(c.key) == plain) return &c;
    if (plain_heading(base_of_key(c.key)) != plain) continue;
    if (found) return nullptr;
    found = &c;
  }
  return found;
}

/// Reads one `[[measured]]`.
class MeasurementReader {
 public:
  MeasurementReader(study::ObjectReader& table, const study::Common& common, const Table& sweep)
      : table_(table), common_(common), sweep_(sweep) {}

  Measurement read(const MeasuredForm& form) {
    Measurement out{form.name, form.travels, form.rack, {}};
    if (form.file.empty() == form.travels.empty()) {
      table_.error("file", form.file.empty() ? "is missing" : "stands beside travels",
                   "give file and the headings of its columns, or travels_mm and values");
      return out;
    }
    if (!form.file.empty() && !read_file(form, out)) return out;
    for (double& travel : out.travels) travel = form.travel_factor * travel + form.travel_offset;
    if (out.travels.size() > max_measured_rows)
      table_.error("file",
                   fmt::format("has {} rows, at most {} are allowed", out.travels.size(), max_measured_rows));
    std::vector<study::ObjectReader> tables = table_.tables("column");
    if (form.columns.empty())
      table_.error("column", "nothing is measured", "add [[measured.column]] with quantity = \"toe_deg\"");
    for (std::size_t i = 0; i < form.columns.size() && i < tables.size(); ++i)
      column(form.columns[i], tables[i], out);
    drop_incomplete(out);
    return out;
  }

 private:
  /// Rows with an empty cell are passed over.
  void drop_incomplete(Measurement& out) const {
    std::vector<bool> whole;
    for (std::size_t i = 0; i < out.travels.size(); ++i)
      whole.push_back(std::isfinite(out.travels[i]) &&
                      std::all_of(out.curves.begin(), out.curves.end(), [&](const MeasuredCurve& c) {
                        return i < c.values.size() && std::isfinite(c.values[i]);
                      }));
    const auto lost = std::count(whole.begin(), whole.end(), false);
    if (lost == 0 || table_.document().has_errors()) return;
    const auto keep = [&](std::vector<double>& values) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < whole.size(); ++i)
        if (whole[i]) values[kept++] = values[i];
      values.resize(kept);
    };
    keep(out.travels);
    for (MeasuredCurve& c : out.curves) keep(c.values);
    if (out.travels.empty())
      table_.error("file", "has no row with all these numbers", "check the headings");
    else
      table_.warning("file", fmt::format("{} row{} with empty cells {} passed over", lost,
                                         lost == 1 ? "" : "s", lost == 1 ? "is" : "are"));
  }

  bool read_file(const MeasuredForm& form, Measurement& out) {
    const auto text = study::read_beside(table_, "file", common_.folder, form.file);
    if (!text) return false;
    Diagnostics problems;
    file_ = read_csv(*text, form.file, problems);
    for (const Diagnostic& d : problems)
      if (d.severity == Diagnostic::Severity::error) table_.unreadable("file", study::in_file(d));
    if (!file_) return false;
    const Column* travel = form.travel.empty() ? nullptr : headed(*file_, form.travel);
    if (!travel) {
      no_heading(table_, "travel", form.travel);
      return false;
    }
    const auto unit = split_unit(travel->key);
    if (!unit || unit->dimension != Dimension::length) {
      table_.error("travel", fmt::format("the column '{}' has no unit of length", travel->key),
                   "write the heading in the file as \"travel [mm]\"");
      return false;
    }
    for (const double value : travel->values) out.travels.push_back(unit->unit->to_si(value));
    return true;
  }

  void no_heading(study::ObjectReader& table, std::string_view key, const std::string& heading) const {
    std::vector<std::string_view> known;
    for (const Column& c : file_->columns) known.emplace_back(c.key);
    table.no_such(key, "column of the file", heading, known);
  }

  /// The column of the table sweep that a quantity names; nullptr, with an error, if there is none.
  const Column* quantity(const MeasuredColumnForm& form, study::ObjectReader& table) const {
    for (const Column& c : sweep_.columns)
      if (c.key != "travel_m" && c.key != "rack_m" &&
          (c.key == form.quantity || base_of_key(c.key) == form.quantity ||
           base_of_key(c.key) == base_of_key(form.quantity)))
        return &c;
    std::vector<std::string_view> known;
    for (const Column& c : sweep_.columns) known.emplace_back(c.key);
    table.no_such("quantity", "column of the table sweep", form.quantity, known);
    return nullptr;
  }

  void column(const MeasuredColumnForm& form, study::ObjectReader& table, Measurement& out) const {
    const Column* of = quantity(form, table);
    if (!of) return;
    const std::vector<double>* values = &form.values;
    std::optional<UnitKey> unit = split_unit(form.quantity);
    if (file_) {
      const Column* found = form.heading.empty() ? nullptr : headed(*file_, form.heading);
      if (!found) return no_heading(table, "heading", form.heading);
      values = &found->values;
      if (const auto own = split_unit(found->key)) unit = own;
    } else if (form.values.size() != out.travels.size()) {
      return table.error(
          "values", fmt::format("has {} numbers for {} travels", form.values.size(), out.travels.size()));
    }
    const auto needed = split_unit(of->key);
    if (needed && (!unit || unit->dimension != needed->dimension))
      return table.error("quantity",
                         unit ? fmt::format("its numbers are {}, and {} is {}", describe(unit->dimension),
                                            of->key, describe(needed->dimension))
                              : std::string("the unit of its numbers is not known"),
                         "give it with the quantity, as toe_deg, or in the heading of the file");
    MeasuredCurve curve{of->key, {}, form.from_static};
    for (const double value : *values) {
      const double moved = form.factor * value + form.offset;
      curve.values.push_back(needed ? unit->unit->to_si(moved) : moved);
    }
    out.curves.push_back(std::move(curve));
  }

  study::ObjectReader& table_;
  const study::Common& common_;
  const Table& sweep_;
  std::optional<Table> file_;
};

}  // namespace

std::vector<Measurement> read_measured(study::ObjectReader& document, const study::Common& common,
                                       const Table& sweep) {
  std::vector<MeasuredForm> forms;
  document(field::entry("measured"), forms);
  std::vector<study::ObjectReader> tables = document.tables("measured");
  if (forms.size() > max_measured)
    document.error("measured",
                   fmt::format("{} measurements, at most {} are allowed", forms.size(), max_measured));
  std::vector<Measurement> out;
  for (std::size_t i = 0; i < forms.size() && i < tables.size() && i < max_measured; ++i)
    out.push_back(MeasurementReader(tables[i], common, sweep).read(forms[i]));
  return out;
}

Value write_measured(std::span<const Measurement> measured) {
  Value out = Value::array();
  for (const Measurement& m : measured) {
    MeasuredForm form{
        .name = m.name, .file = {}, .travel = {}, .travels = m.travels, .rack = m.rack, .columns = {}};
    for (const MeasuredCurve& c : m.curves)
      form.columns.push_back(
          {.quantity = c.key, .heading = {}, .values = c.values, .from_static = c.from_static});
    out.push_back(study::write_fields(form));
  }
  return out;
}

void describe_measured(study::SchemaWriter& document) {
  document.property(
      field::entry("measured", "curves that were measured on a rig, beside those of the suspension"),
      study::schema_array(study::schema_fields<MeasuredForm>()));
}

void add_overlaid(study::Result& result, std::span<const OverlaidTable> tables,
                  std::span<const std::string> quantities) {
  for (const std::string& key : quantities) {
    const std::string base(base_of_key(key));
    Table table{.name = "beside_" + base};
    std::vector<double> curve, travel, value;
    std::vector<std::string> names;
    std::string label;
    for (const OverlaidTable& one : tables) {
      const Column* column = one.table.find(key);
      if (!column) continue;
      if (label.empty()) label = column->label;
      names.push_back(one.name);
      const std::vector<double>& at = one.table.find("travel_m")->values;
      for (std::size_t i = 0; i < at.size(); ++i) {
        curve.push_back(static_cast<double>(names.size()));
        travel.push_back(at[i]);
        value.push_back(column->values[i]);
      }
    }
    if (names.size() < 2) continue;
    table.add("curve", "curve", std::move(curve));
    table.add("travel_m", "travel (m)", std::move(travel));
    table.add(key, label, std::move(value));
    result.tables.push_back(std::move(table));
    const std::string words = label.substr(0, label.find(" ("));
    study::AddPlot{result,
                   {.table = "beside_" + base, .x = "travel_m", .group = "curve", .group_names = names}}(
        "beside-" + base, fmt::format("Compared over travel: {}", words), {key});
  }
}

Table add_measured(study::Result& result, const Measurement& measured, const Table& computed,
                   const Table& at_rest, std::size_t number) {
  Table absolute{.name = measured.name}, table{.name = fmt::format("measured-{}", number)};
  absolute.add("travel_m", "travel (m)", measured.travels);
  table.add("travel_m", "travel (m)", measured.travels);
  const study::AddFact fact{result.facts};
  for (const MeasuredCurve& curve : measured.curves) {
    const Column& of = *computed.find(curve.key);
    const auto unit = split_unit(curve.key);
    std::vector<double> values = curve.values, differences(values.size());
    if (curve.from_static)
      for (double& value : values) value += at_rest.find(curve.key)->values[0];
    study::Extreme largest;
    double squares = 0, count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      differences[i] = values[i] - of.values[i];
      if (!std::isfinite(differences[i])) continue;
      largest.greatest(std::abs(differences[i]), i);
      squares += differences[i] * differences[i];
      count += 1;
    }
    const std::string base(base_of_key(curve.key));
    const auto add = [&](const char* what, const char* words, std::vector<double> column) {
      table.add(
          unit ? fmt::format("{}_{}_{}", base, what, unit->unit->suffix) : fmt::format("{}_{}", base, what),
          fmt::format("{}: {}", words, of.label), std::move(column));
    };
    absolute.add(curve.key, of.label, values);
    add("measured", "measured", std::move(values));
    add("computed", "computed at the same travel", of.values);
    add("difference", "measured less computed", std::move(differences));
    if (!largest.any()) continue;
    const auto number_of = [&](double value) {
      if (!unit) return plain_number(value, 3);
      const bool angle = unit->dimension == Dimension::angle, length = unit->dimension == Dimension::length;
      return angle    ? degrees_of(value, 3)
             : length ? millimetres(value, 3)
                      : linkwright::measured(*unit->unit, value, 3);
    };
    fact(fmt::format("{}: measured less computed, at most ({})", of.label.substr(0, of.label.find(" (")),
                     measured.name),
         say("{} at {}, root mean square {}", number_of(largest.value),
             at_place("travel", millimetres(measured.travels[largest.row], 4)),
             number_of(std::sqrt(squares / count))));
  }
  result.tables.push_back(std::move(table));
  return absolute;
}

}  // namespace linkwright::suspension
