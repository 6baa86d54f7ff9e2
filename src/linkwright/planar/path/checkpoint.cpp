// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/checkpoint.h"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {
namespace {

// Far more than a search makes, and few enough that the sum over the seeds of a study is an integer.
constexpr std::int64_t max_evaluations = std::int64_t{1} << 46;
// Crank angles are unwrapped over a turn, from a start angle that the study may have put anywhere sensible.
constexpr double largest_angle = 1e6;

}  // namespace

Value saved_record(const SearchRecord& record, const std::vector<std::vector<double>>& designs) {
  Value value;
  value["feasible"] = record.status == Status::done;
  value["evaluations"] = record.evaluations;
  value["designs"] = Value::array();
  for (const std::vector<double>& design : designs) value["designs"].push_back(pack_numbers(design));
  std::vector<double> best;
  Value::Array evaluations;
  for (const SearchPoint& point : record.history) {
    evaluations.emplace_back(point.evaluations);
    best.push_back(point.best);
  }
  value["history_evaluations"] = Value(std::move(evaluations));
  value["history_best"] = pack_numbers(best);
  return value;
}

SearchRecord load_record(const Value& value, std::string_view what,
                         const std::function<void(const std::vector<double>&)>& design) {
  SearchRecord record;
  const Value& feasible = load_member(value, "feasible", what);
  const Value& designs = load_member(value, "designs", what);
  const Value& evaluations = load_member(value, "history_evaluations", what);
  const std::vector<double> best = unpack_numbers(load_member(value, "history_best", what), what);
  if (!feasible.is_bool() || !designs.is_array() || !evaluations.is_array() ||
      evaluations.as_array().size() != best.size())
    throw CheckpointError(fmt::format("{}: is not what a seed came to", what));
  record.status = feasible.as_bool() ? Status::done : Status::infeasible;
  record.evaluations = load_integer(value, "evaluations", 0, max_evaluations, what);
  for (const Value& numbers : designs.as_array()) design(unpack_numbers(numbers, what));
  for (std::size_t i = 0; i < best.size(); ++i) {
    const Value& at = evaluations.as_array()[i];
    if (!at.is_integer() || at.as_integer() < 0 || !std::isfinite(best[i]))
      throw CheckpointError(fmt::format("{}: entry {} of its history is not a number", what, i));
    record.history.push_back({at.as_integer(), best[i]});
  }
  return record;
}

bool is_saved_sign(double x) { return x == 1 || x == -1; }
bool is_saved_angle(double x) { return std::abs(x) <= largest_angle; }
bool is_kept(const Field& field, double x) {
  if (field.dimension == Dimension::angle) return is_saved_angle(x);
  return std::abs(x) <= max_link && (field.minimum < 0 || x >= shortest_link);
}

}  // namespace linkwright::planar
