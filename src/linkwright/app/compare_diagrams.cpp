// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/compare_diagrams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "linkwright/core/units.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/result_units.h"

namespace linkwright::app {
namespace {

using study::Plot;

bool same_number(double a, double b, double scale) {
  return std::isnan(a) ? std::isnan(b) : std::abs(a - b) <= 1e-9 * scale;
}

/// "toe_deg" of the second study -> "toe_2_deg"; the unit stays at the end.
std::string key_with(std::string_view key, std::string_view tag) {
  const auto parts = split_unit(key);
  return parts ? fmt::format("{}_{}_{}", parts->base, tag, parts->unit->suffix)
               : fmt::format("{}_{}", key, tag);
}

std::string without_unit(const std::string& label) { return label.substr(0, label.rfind(" (")); }

std::string tag(std::size_t study) { return std::to_string(study + 1); }

/// The column of a key in each table; empty if one lacks it.
std::vector<const Column*> columns(std::span<const Table> tables, const std::string& key) {
  std::vector<const Column*> found;
  for (const Table& table : tables) {
    const Column* column = table.find(key);
    if (!column) return {};
    found.push_back(column);
  }
  return found;
}

/// The rows of a table whose column has a value.
Table rows_at(const Table& table, const Column& column, double value, std::string name) {
  Table out{.name = std::move(name)};
  for (const Column& all : table.columns) out.add(all.key, all.label);
  for (std::size_t row = 0; row < column.values.size(); ++row) {
    if (column.values[row] != value) continue;
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      out.columns[k].values.push_back(table.columns[k].values[row]);
    if (!table.status.empty()) out.status.push_back(table.status[row]);
  }
  return out;
}

/// The value next to zero that all columns have; nothing if there is none.
std::optional<double> common_value(std::span<const Column* const> all) {
  std::optional<double> best;
  for (const double value : all.front()->values) {
    const bool common = !std::isnan(value) && std::all_of(all.begin(), all.end(), [&](const Column* column) {
      return std::find(column->values.begin(), column->values.end(), value) != column->values.end();
    });
    if (common && (!best || std::abs(value) < std::abs(*best))) best = value;
  }
  return best;
}

class DiagramMerger {
 public:
  DiagramMerger(std::span<const Compared> all, std::span<const std::string> scenes)
      : all_(all), scenes_(scenes) {}

  ComparedDiagrams merged() {
    for (const Plot& plot : all_.front().result.plots)
      if (plot.scene.empty() || std::find(scenes_.begin(), scenes_.end(), plot.scene) != scenes_.end())
        diagram(plot);
    return std::move(out_);
  }

 private:
  void diagram(Plot plot) {
    std::vector<Table> tables;
    for (const Compared& one : all_) {
      const Table* own = one.result.table(plot.table);
      if (!own) return;
      tables.push_back(*own);
    }
    if (!plot.group.empty() && !at_one_value(plot, tables)) return;
    plot.bands.clear();
    plot.baseline.clear();
    switch (plot.style) {
      case Plot::Style::map:
        return maps(plot, tables);
      case Plot::Style::histogram:
        return stacked(plot, tables, plot.y);
      case Plot::Style::polar:
        return curves(plot, tables, 2);
      case Plot::Style::line:
      case Plot::Style::points:
        return curves(plot, tables, 1);
    }
  }

  /// Reduces a bundle, or several maps, to the one that can be compared: all would hide each other.
  bool at_one_value(Plot& plot, std::vector<Table>& tables) const {
    const auto groups = columns(tables, plot.group);
    if (groups.empty()) return false;
    const std::optional<double> value = common_value(groups);
    if (!value) return false;
    const study::Study& study = all_.front().study;
    const auto units = study::shown_units(study.common.output.units, study.common.units);
    const auto parts = split_unit(plot.group);
    plot.title += fmt::format(", at {} {}", without_unit(groups.front()->label),
                              parts ? units.text(*value, parts->dimension) : fmt::format("{:g}", *value));
    plot.table += fmt::format("-at-{}", parts ? parts->base : std::string_view(plot.group));
    for (std::size_t i = 0; i < tables.size(); ++i)
      tables[i] = rows_at(tables[i], *groups[i], *value, plot.table);
    plot.group.clear();
    return true;
  }

  void curves(const Plot& plot, const std::vector<Table>& tables, std::size_t step) {
    std::vector<std::vector<std::string>> drawn;
    for (std::size_t k = 0; k + step <= plot.y.size(); k += step) {
      const std::vector<std::string> keys(plot.y.begin() + static_cast<std::ptrdiff_t>(k),
                                          plot.y.begin() + static_cast<std::ptrdiff_t>(k + step));
      if (std::none_of(keys.begin(), keys.end(),
                       [&](const std::string& key) { return columns(tables, key).empty(); }))
        drawn.push_back(keys);
    }
    const auto x = columns(tables, plot.x);
    const bool aligned = agree(x);
    if (!aligned && (step == 2 || x.empty())) return;
    for (const std::vector<std::string>& keys : drawn) {
      Plot own = plot;
      if (drawn.size() > 1) {
        own.name += "-" + keys.front();
        own.title += ": " + without_unit(columns(tables, keys.front()).front()->label);
      }
      if (aligned)
        side_by_side(own, tables, keys);
      else
        stacked(own, tables, keys);
    }
  }

  static bool agree(const std::vector<const Column*>& all) {
    return !all.empty() && std::all_of(all.begin(), all.end(), [&](const Column* column) {
      return same_values(all.front()->values, column->values);
    });
  }

  static Table& made(std::vector<Table>& tables, const std::string& name) {
    for (Table& table : tables)
      if (table.name == name) return table;
    tables.push_back({.name = name});
    return tables.back();
  }

  static void put(Table& table, std::string key, std::string label, std::vector<double> values) {
    if (!table.find(key)) table.add(std::move(key), std::move(label), std::move(values));
  }

  void side_by_side(Plot& plot, const std::vector<Table>& tables, const std::vector<std::string>& keys) {
    Table& table = made(out_.tables, plot.table);
    if (table.columns.empty()) table.status = worst_statuses(tables);
    const Column& x = *columns(tables, plot.x).front();
    put(table, x.key, x.label, x.values);
    plot.y.clear();
    for (std::size_t i = 0; i < all_.size(); ++i)
      for (const std::string& key : keys) {
        const Column& own = *tables[i].find(key);
        plot.y.push_back(key_with(key, tag(i)));
        put(table, plot.y.back(), fmt::format("{}: {}", all_[i].name, own.label), own.values);
      }
    for (const std::string& key : keys) differences(plot.table, tables, {plot.x}, key);
    out_.plots.push_back(std::move(plot));
  }

  /// Columns of each minus the first, over the same inputs; their keys.
  std::vector<std::string> differences(const std::string& name, const std::vector<Table>& tables,
                                       const std::vector<std::string>& inputs, const std::string& key) {
    Table& table = made(out_.differences, name + "-differences");
    if (table.columns.empty()) table.status = worst_statuses(tables);
    for (const std::string& input : inputs) {
      const Column& column = *tables.front().find(input);
      put(table, column.key, column.label, column.values);
    }
    const Column& first = *tables.front().find(key);
    std::vector<std::string> keys;
    for (std::size_t i = 1; i < tables.size(); ++i) {
      const Column& own = *tables[i].find(key);
      std::vector<double> values;
      for (std::size_t row = 0; row < own.values.size(); ++row)
        values.push_back(own.values[row] - first.values[row]);
      keys.push_back(key_with(key, tag(i) + "_minus_1"));
      put(table, keys.back(), fmt::format("{} minus {}: {}", all_[i].name, all_[0].name, own.label),
          std::move(values));
    }
    return keys;
  }

  /// A row is done where it is so in all studies.
  static std::vector<std::string> worst_statuses(const std::vector<Table>& tables) {
    std::vector<std::string> status = tables.front().status;
    for (const Table& own : tables)
      for (std::size_t row = 0; row < own.status.size() && row < status.size(); ++row)
        if (status[row] == "done") status[row] = own.status[row];
    return status;
  }

  /// The rows of all studies, one after the other, each with the number of its study.
  void stacked(Plot plot, const std::vector<Table>& tables, const std::vector<std::string>& keys) {
    plot.table += "-of-each";
    plot.group = "study";
    for (const Compared& one : all_) plot.group_names.push_back(one.name);
    plot.y = keys;
    plot.scene.clear();
    Table& table = made(out_.tables, plot.table);
    if (table.columns.empty()) {
      std::vector<double> study;
      for (std::size_t i = 0; i < tables.size(); ++i) {
        study.insert(study.end(), tables[i].rows(), static_cast<double>(i + 1));
        for (std::size_t row = 0; row < tables[i].rows(); ++row)
          table.status.push_back(tables[i].status.empty() ? "done" : tables[i].status[row]);
      }
      table.add("study", "study", std::move(study));
    }
    std::vector<std::string> all_keys = keys;
    if (!plot.x.empty()) all_keys.insert(all_keys.begin(), plot.x);
    for (const std::string& key : all_keys) {
      const auto found = columns(tables, key);
      if (found.empty()) return;
      std::vector<double> values;
      for (const Column* column : found)
        values.insert(values.end(), column->values.begin(), column->values.end());
      put(table, key, found.front()->label, std::move(values));
    }
    out_.plots.push_back(std::move(plot));
  }

  void maps(const Plot& plot, const std::vector<Table>& tables) {
    if (plot.y.size() != 2) return;
    const auto x = columns(tables, plot.x), y = columns(tables, plot.y[0]),
               value = columns(tables, plot.y[1]);
    if (x.empty() || y.empty() || value.empty()) return;
    stacked(plot, tables, plot.y);
    if (!agree(x) || !agree(y)) return;
    const auto keys = differences(plot.table, tables, {plot.x, plot.y[0]}, plot.y[1]);
    for (std::size_t i = 1; i < all_.size(); ++i) {
      Plot own = plot;
      own.name += fmt::format("-{}_minus_1", tag(i));
      own.title += fmt::format(": {} minus {}", all_[i].name, all_[0].name);
      own.table += "-differences";
      own.y[1] = keys[i - 1];
      out_.plots.push_back(std::move(own));
    }
  }

  std::span<const Compared> all_;
  std::span<const std::string> scenes_;
  ComparedDiagrams out_;
};

}  // namespace

bool same_values(const std::vector<double>& a, const std::vector<double>& b) {
  double scale = 0;
  for (const double v : a)
    if (std::isfinite(v)) scale = std::max(scale, std::abs(v));
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                            [&](double x, double y) { return same_number(x, y, scale); });
}

ComparedDiagrams compare_diagrams(std::span<const Compared> all, std::span<const std::string> scenes) {
  return DiagramMerger(all, scenes).merged();
}

}  // namespace linkwright::app
