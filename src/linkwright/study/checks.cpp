// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/closing_row.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/kind.h"

namespace linkwright::study {
namespace {

/// A number that was looked for, or why it was not found.
struct Resolved {
  double value = nan;
  std::string message;
};

Resolved unknown(std::string_view what, std::string_view name, const std::vector<std::string_view>& allowed) {
  const std::string hint = did_you_mean(
      name, allowed, allowed.empty() ? "" : fmt::format("there is: {}", fmt::join(allowed, ", ")));
  return {nan, fmt::format("there is no {} '{}'{}{}", what, name, hint.empty() ? "" : "; ", hint)};
}

/// Factor from numbers under the key `from` to numbers under the key `to`; nothing when they are not the same
/// quantity. "toe_rad" to "toe_deg": 180/pi.
std::optional<double> conversion(std::string_view from, std::string_view to) {
  if (from == to) return 1.0;
  const auto a = split_unit(from), b = split_unit(to);
  if (!a || !b || a->base != b->base || a->dimension != b->dimension) return std::nullopt;
  return b->unit->from_si(a->unit->to_si(1.0));
}

const Column* find_column(const Table& table, std::string_view key, double& factor) {
  for (const Column& column : table.columns) {
    if (const auto found = conversion(column.key, key)) {
      factor = *found;
      return &column;
    }
  }
  return nullptr;
}

std::vector<std::string_view> column_keys(const Table& table) {
  std::vector<std::string_view> keys;
  for (const Column& column : table.columns) keys.push_back(column.key);
  return keys;
}

Resolved member(const Value& object, std::string_view what, std::string_view key) {
  std::vector<std::string_view> keys;
  if (object.is_object()) {
    for (const Value::Member& m : object.as_object()) {
      keys.push_back(m.key);
      const auto factor = conversion(m.key, key);
      if (!factor) continue;
      if (m.value.is_number()) return {m.value.as_number() * *factor, {}};
      if (m.value.is_bool()) return {m.value.as_bool() ? 1.0 : 0.0, {}};
      return {nan, fmt::format("'{}' is not a number", key)};
    }
  }
  return unknown(what, key, keys);
}

Resolved of_best(const Result& result, std::string_view key) {
  if (result.solutions.empty()) return {nan, "the study found no solution"};
  const Solution& best = result.solutions.front();
  Value all = Value::object();
  for (const Value* part : {&best.objectives, &best.classification}) {
    if (!part->is_object()) continue;
    for (const Value::Member& m : part->as_object()) all.as_object().push_back(m);
  }
  for (const Parameter& p : best.parameters) all.as_object().push_back({p.key, Value(p.value), {}});
  return member(all, "number of the best solution", key);
}

Resolved of_row(const Table& table, const Column& column, const CheckRequest& request) {
  const std::size_t rows = table.rows();
  std::vector<double> distance(rows, 0.0);
  std::string nearest_values;
  std::vector<std::pair<const Column*, double>> wanted;  // column and value in its unit
  for (const auto& [key, value] : request.at) {
    double factor = 1;
    const Column* where = find_column(table, key, factor);
    if (!where) return unknown("column of '" + table.name + "'", key, column_keys(table));
    wanted.emplace_back(where, value / factor);
    double low = std::abs(value / factor), high = low;
    for (double v : where->values) {
      if (std::isnan(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
    const double span = high > low ? high - low : std::max(1.0, std::abs(high));
    for (std::size_t i = 0; i < rows; ++i) {
      const double away = std::abs(where->values[i] - value / factor) / span;
      distance[i] = std::isnan(away) ? infinity : std::max(distance[i], away);
    }
  }
  const auto nearest = std::min_element(distance.begin(), distance.end());
  if (nearest == distance.end()) return {nan, fmt::format("the table '{}' has no rows", table.name)};
  const auto row = static_cast<std::size_t>(nearest - distance.begin());
  // Grids are sampled with rounding errors; anything beyond them is another row than the one that was meant.
  if (!(*nearest <= 1e-6)) {
    for (const auto& [where, value] : wanted)
      nearest_values +=
          fmt::format("{}{} = {:.9g}", nearest_values.empty() ? "" : ", ", where->key, where->values[row]);
    return {nan,
            fmt::format("the table '{}' has no such row; the nearest is {}", table.name, nearest_values)};
  }
  if (std::isnan(column.values[row]))
    return {nan, fmt::format("has no value there: {}", table.status.empty() ? "missing" : table.status[row])};
  return {column.values[row], {}};
}

Resolved statistic(const Column& column, std::string_view what, bool closes) {
  constexpr std::array<std::string_view, 7> all{"max", "min", "max_abs", "mean", "rms", "first", "last"};
  if (std::find(all.begin(), all.end(), what) == all.end())
    return unknown("statistic", what, {all.begin(), all.end()});
  std::vector<double> values;
  for (double v : column.values)
    if (!std::isnan(v)) values.push_back(v);
  if (values.empty()) return {nan, fmt::format("the column '{}' has no values", column.key)};
  if (what == "max") return {*std::max_element(values.begin(), values.end()), {}};
  if (what == "min") return {*std::min_element(values.begin(), values.end()), {}};
  if (what == "first") return {values.front(), {}};
  if (what == "last") return {values.back(), {}};
  double sum = 0, squares = 0, largest = 0;
  for (double v : values) largest = std::max(largest, std::abs(v));
  if (closes) values.pop_back();
  for (double v : values) {
    sum += v;
    squares += v * v;
  }
  const auto n = static_cast<double>(values.size());
  if (what == "max_abs") return {largest, {}};
  return {what == "mean" ? sum / n : std::sqrt(squares / n), {}};
}

Resolved of_table(const Table& table, std::string_view rest, const CheckRequest& request) {
  const std::size_t dot = rest.find('.');
  const std::string_view key = rest.substr(0, dot);
  double factor = 1;
  const Column* column = find_column(table, key, factor);
  if (!column) return unknown("column of '" + table.name + "'", key, column_keys(table));
  Resolved answer;
  if (!request.at.empty() && dot == std::string_view::npos)
    answer = of_row(table, *column, request);
  else if (request.at.empty() && dot != std::string_view::npos)
    answer = statistic(*column, rest.substr(dot + 1), has_closing_row(table));
  else if (request.at.empty() && table.rows() == 1)
    answer = statistic(*column, "last", false);
  else if (request.at.empty())
    answer.message =
        "a column has many values: add a statistic (.max, .min, .max_abs, .mean, .rms, .first, .last) or "
        "`at`";
  else
    answer.message = "a row (`at`) has no statistic";
  answer.value *= factor;
  return answer;
}

Resolved resolve(const CheckRequest& request, const Result& result) {
  const std::string_view quantity = request.quantity;
  const std::size_t dot = quantity.find('.');
  const std::string_view first = quantity.substr(0, dot);
  const std::string_view rest = dot == std::string_view::npos ? std::string_view() : quantity.substr(dot + 1);
  if (first == "best" || first == "statistics") {
    if (!request.at.empty()) return {nan, "only rows of tables are chosen by `at`"};
    return first == "best" ? of_best(result, rest)
                           : member(result.statistics, "number in the statistics", rest);
  }
  std::vector<std::string_view> allowed{"best", "statistics"};
  for (const Table& table : result.tables) {
    if (table.name == first) return of_table(table, rest, request);
    allowed.push_back(table.name);
  }
  return unknown("table", first, allowed);
}

}  // namespace

void read_row(ObjectReader& reader, CheckRequest& check) {
  auto at = reader.table("at");
  if (!at) return;
  for (const Value::Member& m : at->members()) {
    if (m.value.is_number() && std::isfinite(m.value.as_number()))
      check.at.emplace_back(m.key, m.value.as_number());
    else
      at->error(m.key, "must be a finite number: the value of a column of the table");
  }
}

std::vector<CheckRequest> read_checks(ObjectReader& document) {
  std::vector<CheckRequest> checks;
  for (ObjectReader& reader : document.tables(field::entry("check"))) {
    CheckRequest check;
    reader.read(check);
    read_row(reader, check);
    // A limit that is there but could not be read has been reported already.
    const bool equals = reader.has("equals"), limits = reader.has("at_most") || reader.has("at_least");
    if (!equals && !limits)
      reader.error("quantity", "this check has no limit", "add at_most, at_least, or equals with tolerance");
    if (equals && limits)
      reader.error("equals", "cannot be combined with at_most or at_least", "keep one of them");
    if (equals && !reader.has("tolerance"))
      reader.error("equals", "needs a tolerance", "computed numbers are never exactly equal");
    if (!equals && reader.has("tolerance"))
      reader.error("tolerance", "needs equals, which this check does not have");
    if (check.at_least && check.at_most && *check.at_least > *check.at_most)
      reader.error("at_least",
                   fmt::format("is {}, larger than at_most, which is {}", *check.at_least, *check.at_most));
    checks.push_back(std::move(check));
  }
  return checks;
}

Value write_checks(const std::vector<CheckRequest>& checks) {
  Value all = Value::array();
  for (const CheckRequest& check : checks) {
    Value one = write_fields(check);
    for (const auto& [key, value] : check.at) one["at"][key] = value;
    all.push_back(std::move(one));
  }
  return all;
}

Check evaluate(const CheckRequest& request, const Result& result) {
  Check check;
  check.quantity = request.quantity;
  for (const auto& [key, value] : request.at)
    check.at += fmt::format("{}{} = {}", check.at.empty() ? "" : ", ", key, value);
  if (request.equals)
    check.limit = fmt::format("equals {} within {}", *request.equals, request.tolerance.value_or(0));
  if (request.at_least) check.limit = fmt::format("at_least {}", *request.at_least);
  if (request.at_most)
    check.limit += fmt::format("{}at_most {}", check.limit.empty() ? "" : ", ", *request.at_most);

  Resolved answer = resolve(request, result);
  check.value = answer.value;
  check.message = std::move(answer.message);
  // NaN fails every one of these.
  check.passed = check.message.empty() && !std::isnan(check.value);
  if (request.at_most) check.passed = check.passed && check.value <= *request.at_most;
  if (request.at_least) check.passed = check.passed && check.value >= *request.at_least;
  if (request.equals)
    check.passed = check.passed && std::abs(check.value - *request.equals) <= request.tolerance.value_or(0);
  return check;
}

}  // namespace linkwright::study
