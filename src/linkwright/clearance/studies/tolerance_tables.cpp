// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "linkwright/clearance/studies/tolerance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/columns.h"

namespace linkwright::clearance {
namespace {

using Kind = ToleranceQuantity::Kind;

class Tabler {
 public:
  Tabler(const ToleranceStudy& s, const ToleranceRecording& r, const std::vector<PathBand>& bands,
         double scale)
      : s_(s), r_(r), bands_(bands), scale_(scale) {}

  std::vector<Table> tables() {
    errors();
    values();
    band();
    for (std::size_t q = 0; q < quantities(); ++q) budget(q);
    draws();
    return std::move(tables_);
  }

 private:
  std::size_t quantities() const { return r_.quantities.size(); }
  const planar::Linkage& linkage() const { return s_.motion.linkage; }
  bool over_time() const { return std::holds_alternative<study::TimeSamples>(s_.motion.sweep); }

  void add_inputs(Table& table) const {
    if (over_time()) table.add("time_s", "time (s)", r_.rows.time);
    for (std::size_t k = 0; k < s_.motion.plan.inputs(); ++k) {
      std::vector<double> values;
      for (const auto& row : r_.rows.inputs) values.push_back(row[k].value);
      table.add(planar::input_key(linkage(), s_.motion.plan, k),
                planar::input_label(linkage(), s_.motion.plan, k), std::move(values));
    }
  }
  void finish(Table table) {
    for (const SensitivitySample& row : r_.linear) table.status.emplace_back(to_string(row.status));
    tables_.push_back(std::move(table));
  }
  template <class F>
  std::vector<double> column(F&& of) const {
    std::vector<double> out;
    for (std::size_t row = 0; row < r_.samples(); ++row) out.push_back(of(row));
    return out;
  }
  // A column of the random linkages, if there are any.
  template <class F>
  std::vector<double> drawn(F&& of) const {
    return column([&](std::size_t row) {
      return r_.random.samples[row].assembled > 0 ? of(r_.random.samples[row]) : nan;
    });
  }

  void errors() {
    Table table{.name = "errors"};
    add_inputs(table);
    for (std::size_t q = 0; q < quantities(); ++q) {
      const ToleranceQuantity& quantity = r_.quantities[q];
      const auto add = [&](const char* key, const char* label, std::vector<double> values) {
        table.add(quantity.key + key + unit_key(quantity.kind),
                  fmt::format("{} {} ({})", quantity.name, label, unit_label(quantity.kind)),
                  std::move(values));
      };
      add("_worst_", "error, worst case",
          column([&](std::size_t row) { return r_.linear[row].worst_error[q]; }));
      if (quantity.kind == Kind::point)
        add("_across_", "error across its path, worst case", bands_[q].across);
      add("_rms_", "error, root mean square",
          column([&](std::size_t row) { return r_.root_mean_square(row, q); }));
      add("_drawn_", "error, largest of the random linkages",
          drawn([&](const MonteCarloSample& m) { return m.worst_error[q]; }));
    }
    table.add("assembled", "random linkages that assemble",
              column([&](std::size_t row) { return double(r_.random.samples[row].assembled); }));
    finish(std::move(table));
  }

  void values() {
    Table table{.name = "values"};
    add_inputs(table);
    for (const ToleranceQuantity& quantity : r_.quantities)
      for (std::size_t c = 0; c < quantity.size; ++c) {
        const std::size_t i = quantity.first + c;
        const std::string axis = quantity.size == 1 ? ""
                                 : c == 0           ? "_x"
                                                    : "_y",
                          spoken = quantity.size == 1 ? ""
                                   : c == 0           ? " x"
                                                      : " y";
        const auto add = [&](const char* key, const char* label, std::vector<double> values) {
          if (quantity.kind == Kind::angle && std::string_view(key) == "_") math::unwrap_angles(values);
          table.add(quantity.key + axis + key + unit_key(quantity.kind),
                    fmt::format("{}{}{} ({})", quantity.name, spoken, label, unit_label(quantity.kind)),
                    std::move(values));
        };
        const auto linear = [&](auto&& of) {
          return column([&](std::size_t row) { return of(r_.linear[row]); });
        };
        const auto apart = [&](double side) {
          std::vector<double> out = linear([&](const SensitivitySample& l) { return l.values[i]; });
          if (quantity.kind == Kind::angle) math::unwrap_angles(out);
          for (std::size_t row = 0; row < r_.samples(); ++row) out[row] += side * r_.linear[row].worst[i];
          return out;
        };
        const auto error = [&](std::vector<double> MonteCarloSample::*of) {
          std::vector<double> out = drawn([&](const MonteCarloSample& m) { return (m.*of)[i]; });
          for (std::size_t row = 0; row < r_.samples(); ++row) out[row] -= r_.linear[row].values[i];
          return out;
        };
        add("_", "", linear([&](const SensitivitySample& l) { return l.values[i]; }));
        add("_lower_", " least, worst case", apart(-1));
        add("_upper_", " most, worst case", apart(1));
        add("_worst_", " error, worst case", linear([&](const SensitivitySample& l) { return l.worst[i]; }));
        add("_deviation_", " standard deviation, first order",
            linear([&](const SensitivitySample& l) { return l.deviation[i]; }));
        add("_drawn_deviation_", " standard deviation of the random linkages",
            drawn([&](const MonteCarloSample& m) { return m.deviation[i]; }));
        add("_drawn_mean_", " mean error of the random linkages", error(&MonteCarloSample::mean));
        add("_drawn_least_", " least error of the random linkages", error(&MonteCarloSample::least));
        add("_drawn_most_", " largest error of the random linkages", error(&MonteCarloSample::most));
      }
    finish(std::move(table));
  }

  // Paths and the edges of their bands, enlarged.
  void band() {
    if (bands_.empty()) return;
    Table table{.name = "band"};
    add_inputs(table);
    for (std::size_t p = 0; p < bands_.size(); ++p) {
      const ToleranceQuantity& quantity = r_.quantities[p];
      for (const auto& [side, key, label] :
           {std::tuple{0.0, "", ""}, std::tuple{1.0, "_left", ", worst case to the left"},
            std::tuple{-1.0, "_right", ", worst case to the right"}})
        for (std::size_t c = 0; c < 2; ++c) {
          const char axis = c == 0 ? 'x' : 'y';
          table.add(fmt::format("{}{}_{}_m", quantity.key, key, axis),
                    fmt::format("{}{}{} {} (m)", quantity.name, label,
                                side == 0 ? "" : fmt::format(", drawn {:g} x", scale_), axis),
                    column([&, side = side](std::size_t row) {
                      const double n = c == 0 ? bands_[p].normal[row].x : bands_[p].normal[row].y;
                      return r_.linear[row].values[quantity.first + c] +
                             (side == 0 ? 0 : side * scale_ * bands_[p].across[row] * n);
                    }));
        }
    }
    finish(std::move(table));
  }

  void budget(std::size_t q) {
    const ToleranceQuantity& quantity = r_.quantities[q];
    if (!quantity.any) return;
    const std::size_t row = quantity.worst_row;
    const std::vector<std::size_t> order = r_.by_share(q);
    Table table{.name = "budget_" + quantity.key};
    const auto add = [&](std::string key, std::string label, auto&& of) {
      std::vector<double> values;
      for (const std::size_t k : order) values.push_back(of(k));
      table.add(std::move(key), std::move(label), std::move(values));
    };
    for (const std::size_t k : order) table.names.push_back(r_.tolerances[k]);
    const double variance = std::pow(r_.root_mean_square(row, q), 2), all = r_.worst(q);
    const auto part = [](double of, double total) { return total > 0 ? of / total : 0; };
    const std::string unit = unit_key(quantity.kind), label = unit_label(quantity.kind);
    const bool length = quantity.kind == Kind::point || quantity.kind == Kind::displacement;
    add("tolerance_m", "tolerance (m)", [&](std::size_t k) { return tolerance_range(s_, k); });
    add("worst_" + unit,
        fmt::format("contribution to the worst case at {} ({})", to_string(tolerance_place(s_, r_, row)),
                    label),
        [&](std::size_t k) { return r_.contribution(row, q, k); });
    add("worst_share", "share of the worst case",
        [&](std::size_t k) { return part(r_.contribution(row, q, k), all); });
    add("mean_square_share", "share of the mean square",
        [&](std::size_t k) { return part(r_.mean_square(row, q, k), variance); });
    add(length ? "gain" : "gain_" + unit + "_per_m",
        fmt::format("change of the worst case by the tolerance ({})", length ? "m per m" : label + " per m"),
        [&](std::size_t k) { return r_.contribution(row, q, k) / tolerance_range(s_, k); });
    tables_.push_back(std::move(table));

    Table over{.name = "contributions_" + quantity.key};
    add_inputs(over);
    for (const std::size_t k : order)
      over.add(identifier(r_.tolerances[k]) + "_" + unit,
               fmt::format("contribution of {} ({})", r_.tolerances[k], label),
               column([&](std::size_t i) { return r_.contribution(i, q, k); }));
    finish(std::move(over));
  }

  void draws() {
    if (r_.random.draws == 0) return;
    Table table{.name = "draws"};
    for (std::size_t q = 0; q < quantities(); ++q) {
      const ToleranceQuantity& quantity = r_.quantities[q];
      std::vector<double> values;
      for (std::size_t d = 0; d < at(r_.random.draws); ++d)
        values.push_back(r_.random.largest[d * quantities() + q]);
      table.add(
          quantity.key + "_" + unit_key(quantity.kind),
          fmt::format("{} largest error over the motion ({})", quantity.name, unit_label(quantity.kind)),
          std::move(values));
    }
    std::vector<double> missed(r_.random.missed.begin(), r_.random.missed.end());
    for (const double m : missed) table.status.emplace_back(m > 0 ? "no_assembly" : "done");
    table.add("missed", "samples where it does not assemble", std::move(missed));
    tables_.push_back(std::move(table));
  }

  const ToleranceStudy& s_;
  const ToleranceRecording& r_;
  const std::vector<PathBand>& bands_;
  double scale_;
  std::vector<Table> tables_;
};

}  // namespace

std::vector<Table> tolerance_tables(const ToleranceStudy& study, const ToleranceRecording& recording,
                                    const std::vector<PathBand>& bands, double scale) {
  return Tabler(study, recording, bands, scale).tables();
}

}  // namespace linkwright::clearance
