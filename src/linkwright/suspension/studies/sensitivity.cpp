// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "linkwright/core/units.h"
#include "linkwright/study/design_variables.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/corner/hard_points.h"
#include "linkwright/suspension/studies/values.h"
#include "linkwright/suspension/wheel/derivatives.h"

namespace linkwright::suspension {
namespace {

const std::vector<std::string> default_quantities{"toe", "camber", "half_track_change", "roll_centre_height"};
/// Curves in a diagram of sensitivities.
constexpr std::size_t max_curves = 6;
constexpr std::size_t max_travels = 1000;

std::string unit_of_column(const CornerColumn& c) {
  const auto parts = split_unit(c.key);
  return parts ? readable_unit(parts->unit->suffix) : "1";
}
/// Suffix of a key for the quantity by metre: angles by length have a unit of their own.
std::string by_metre(const CornerColumn& c) {
  const auto parts = split_unit(c.key);
  return parts && parts->dimension == Dimension::angle ? "_rad_per_m" : "";
}

void complete_quantities(study::ObjectReader& table, std::vector<std::string>& quantities,
                         const Suspension& suspension) {
  if (quantities.empty()) quantities = default_quantities;
  const Driver lock = suspension.spring ? Driver::spring : Driver::wheel_centre_z;
  std::vector<std::string> known;
  for (const CornerColumn& c : corner_columns())
    if (quantity_of(c, lock)) known.push_back(study::base_of(c.key));
  for (const std::string& q : quantities) {
    if (std::find(known.begin(), known.end(), q) != known.end()) {
      if (const std::string why = why_missing(suspension, *corner_column(q)); !why.empty())
        table.error("quantities", fmt::format("this suspension has no '{}': {}", q, why));
      continue;
    }
    const std::vector<std::string_view> words(known.begin(), known.end());
    table.error("quantities",
                fmt::format("there is no quantity '{}'; there are: {}", q, fmt::join(known, ", ")),
                did_you_mean(q, words));
  }
}

/// The positions of a travel sweep that are reached, and their travels.
struct Way {
  std::vector<double> travels;
  std::vector<CornerPosition> positions;
};
Way solve_way(const CornerPlan& plan, const SensitivityInputs& inputs) {
  Way out;
  const std::size_t step = (inputs.travels.size() + max_travels - 1) / max_travels;
  const CornerPosition reference = reference_position(plan, inputs.travel);
  if (reference.status != Status::done) return out;
  CornerPosition last = reference;
  for (std::size_t i = 0; i < inputs.travels.size(); i += step) {
    CornerPosition p = solve_position(plan, inputs.travel, {inputs.travels[i], inputs.rack}, last);
    if (p.status != Status::done)
      p = solve_position(plan, inputs.travel, {inputs.travels[i], inputs.rack}, reference);
    if (p.status != Status::done) continue;
    out.travels.push_back(inputs.travels[i]);
    out.positions.push_back(p);
    last = out.positions.back();
  }
  return out;
}

Suspension made_as(Parts parts, const Suspension& suspension) {
  return parts == Parts::as_built ? as_built(suspension) : suspension;
}

}  // namespace

void complete_sensitivity(study::ObjectReader& document, SensitivityForm& form,
                          const Suspension& suspension) {
  auto table = document.table("sensitivity");
  complete_quantities(*table, form.quantities, suspension);
}

void complete_tolerances(study::ObjectReader& document, TolerancesForm& form, const Suspension& suspension) {
  auto table = document.table("tolerances");
  complete_quantities(*table, form.quantities, suspension);
  if (form.points.empty() && !(form.tolerance > 0))
    table->error("tolerance", "no point has a tolerance", "write tolerance_mm = 0.5");
  std::vector<study::ObjectReader> tables = table->tables("point");
  std::vector<std::string> known;
  if (form.parts == Parts::as_built && !suspension.couplers.empty()) {
    table->error("parts", "a coupler is on a link of this suspension, whose place depends on the length",
                 "take parts = \"as_drawn\"");
    return;
  }
  const Suspension made = made_as(form.parts, suspension);
  for (const DesignNumber& n : hard_points(made)) known.push_back(label(made, n));
  for (std::size_t i = 0; i < form.points.size() && i < tables.size(); ++i) {
    const std::string& asked = form.points[i].coordinate;
    if (std::any_of(known.begin(), known.end(),
                    [&](const std::string& k) { return k == asked || k.starts_with(asked + "_"); }))
      continue;
    const std::vector<std::string_view> words(known.begin(), known.end());
    tables[i].error("coordinate", fmt::format("no point or coordinate is called '{}'", asked),
                    did_you_mean(asked, words, fmt::format("there are: {}", fmt::join(known, ", "))));
  }
}

void add_sensitivity(study::Result& result, const Suspension& suspension, const SensitivityForm& form,
                     const SensitivityInputs& inputs) {
  const DerivativePlan plan = prepare_derivatives(suspension, hard_points(suspension));
  const Way way = solve_way(plan.plan, inputs);
  if (way.positions.empty())
    return study::AddWarning{result.diagnostics}("no sensitivities: no position of the sweep is reached");
  std::vector<std::string> names;
  for (const DesignNumber& n : plan.numbers) names.push_back(label(suspension, n));
  std::vector<WheelDerivatives> derivatives;
  for (const CornerPosition& p : way.positions) derivatives.push_back(wheel_derivatives(plan, p));
  const std::size_t middle = next_to_zero(way.travels);

  Table here{.name = "sensitivity"};
  here.names = names;
  std::vector<Table> over_travel;
  for (const std::string& q : form.quantities) {
    const CornerColumn& column = *corner_column(q);
    const WheelQuantity quantity = *quantity_of(column, inputs.lock);
    const auto by = [&](std::size_t position, std::size_t number) {
      return value_of(derivatives[position].by[number], quantity);
    };
    std::vector<double> values;
    for (std::size_t k = 0; k < names.size(); ++k) values.push_back(by(middle, k));
    here.add(q + "_by_point" + by_metre(column),
             fmt::format("{} by coordinate ({} per m)", words_of(column), unit_of_column(column)), values);

    Table table{.name = "sensitivity-" + q};
    table.add("travel_m", "travel (m)", way.travels);
    std::vector<double> largest(names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      std::vector<double> curve;
      for (std::size_t i = 0; i < way.positions.size(); ++i) {
        curve.push_back(by(i, k));
        if (std::abs(curve.back()) > largest[k]) largest[k] = std::abs(curve.back());
      }
      table.add(plain_name(names[k]) + by_metre(column),
                fmt::format("by {} ({} per m)", names[k], unit_of_column(column)), std::move(curve));
    }
    std::vector<std::size_t> order(names.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return largest[a] > largest[b]; });
    std::vector<std::string> y;
    for (std::size_t k = 0; k < std::min(order.size(), max_curves); ++k)
      y.push_back(table.columns[1 + order[k]].key);
    result.plots.push_back(
        {.name = table.name,
         .title = fmt::format("{} by hard points over travel: the {} largest", words_of(column), y.size()),
         .table = table.name,
         .x = "travel_m",
         .y = std::move(y),
         .scene = "travel"});
    over_travel.push_back(std::move(table));
    const std::size_t first = order.front();
    result.facts.push_back({fmt::format("{} is most sensitive to", words_of(column)), names[first]});
  }
  result.tables.push_back(std::move(here));
  for (Table& t : over_travel) result.tables.push_back(std::move(t));
}

void add_tolerances(study::Result& result, const Suspension& drawn, const TolerancesForm& form,
                    const SensitivityInputs& inputs, RunContext& context) {
  const Suspension suspension = made_as(form.parts, drawn);
  ToleranceTask task{
      .suspension = suspension, .numbers = {}, .driver = inputs.travel, .inputs = {}, .curves = {}};
  std::vector<std::string> names;
  for (const DesignNumber& n : hard_points(suspension)) {
    const std::string name = label(suspension, n);
    const bool coordinate = n.kind != DesignKind::coupler_fraction &&
                            (form.parts == Parts::as_drawn ||
                             (n.kind != DesignKind::length && n.kind != DesignKind::rocker_length));
    double tolerance = coordinate ? form.tolerance : 0;
    for (const PointTolerance& p : form.points)
      if (name == p.coordinate || name.starts_with(p.coordinate + "_")) tolerance = p.tolerance;
    if (!(tolerance > 0)) continue;
    task.numbers.push_back({n, tolerance});
    names.push_back(name);
  }
  const Way way = solve_way(prepare_suspension(suspension), inputs);
  if (way.positions.empty() || task.numbers.empty())
    return study::AddWarning{result.diagnostics}(
        "no tolerance bands: no position of the sweep is reached, or no point has a tolerance");
  for (const double travel : way.travels) task.inputs.push_back({travel, inputs.rack});
  for (const std::string& q : form.quantities)
    task.curves.push_back(*quantity_of(*corner_column(q), inputs.lock));
  const ToleranceBands bands = tolerance_bands(task, form.monte_carlo, context);
  if (result.status == Status::done && bands.status != Status::done) result.status = bands.status;

  Table shares{.name = "tolerance_shares"};
  shares.names = names;
  for (std::size_t c = 0; c < form.quantities.size(); ++c) {
    const CornerColumn& column = *corner_column(form.quantities[c]);
    const std::string key(column.key), words(words_of(column));
    Table table{.name = "band-" + form.quantities[c]};
    const auto add = [&](std::string prefix, std::string text, auto&& value) {
      std::vector<double> values;
      for (const Band& b : bands.bands[c]) values.push_back(value(b));
      table.add(prefix + key, fmt::format("{}, {} ({})", words, text, unit_of_column(column)),
                std::move(values));
    };
    table.add("travel_m", "travel (m)", way.travels);
    add("", "nominal", [](const Band& b) { return b.nominal; });
    add("worst_lower_", "worst case, lower", [](const Band& b) { return b.nominal - b.worst_case; });
    add("worst_upper_", "worst case, upper", [](const Band& b) { return b.nominal + b.worst_case; });
    add("rss_lower_", "root sum square, lower", [](const Band& b) { return b.nominal - b.root_sum_square; });
    add("rss_upper_", "root sum square, upper", [](const Band& b) { return b.nominal + b.root_sum_square; });
    if (form.monte_carlo.samples > 0) {
      add("mean_", "mean of the designs drawn", [](const Band& b) { return b.mean; });
      add("deviation_", "standard deviation of the designs drawn",
          [](const Band& b) { return b.standard_deviation; });
      add("least_", "least of the designs drawn", [](const Band& b) { return b.least; });
      add("greatest_", "greatest of the designs drawn", [](const Band& b) { return b.greatest; });
    }
    result.plots.push_back({.name = table.name,
                            .title = fmt::format("{} over travel with tolerances of the hard points", words),
                            .table = table.name,
                            .x = "travel_m",
                            .y = {key},
                            .scene = "travel",
                            .bands = {{"worst_lower_" + key, "worst_upper_" + key, "worst case"},
                                      {"rss_lower_" + key, "rss_upper_" + key, "root sum square"}}});
    if (form.monte_carlo.samples > 0) {
      result.plots.back().y.push_back("least_" + key);
      result.plots.back().y.push_back("greatest_" + key);
    }
    std::vector<double> largest(names.size());
    for (const Band& b : bands.bands[c])
      for (std::size_t k = 0; k < names.size() && k < b.shares.size(); ++k)
        if (std::abs(b.shares[k]) > largest[k]) largest[k] = std::abs(b.shares[k]);
    shares.add(key,
               fmt::format("largest change of {} by this coordinate's tolerance ({})", words,
                           unit_of_column(column)),
               std::move(largest));
    result.tables.push_back(std::move(table));
  }
  result.tables.push_back(std::move(shares));
}

}  // namespace linkwright::suspension
