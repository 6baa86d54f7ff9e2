#include "linkwright/planar/path/checkpoint.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/tolerance.h"

namespace linkwright::planar {
namespace {

// Far more than a search makes, and few enough that the sum over the seeds of a study is an integer.
constexpr std::int64_t most_evaluations = std::int64_t{1} << 46;
// Crank angles are unwrapped over a turn, from a start angle that the study may have put anywhere sensible.
constexpr double largest_angle = 1e6;
constexpr std::size_t linkage_numbers = 11;  // before the crank angles

std::vector<double> numbers_of(const PathDesign& d) {
  const FourBar& l = d.linkage;
  std::vector<double> numbers = {sign(l.branch), l.ground,  l.crank,   l.coupler,     l.rocker, l.coupler_u,
                                 l.coupler_v,    l.pivot_x, l.pivot_y, l.frame_angle, d.sense};
  numbers.insert(numbers.end(), d.angles.begin(), d.angles.end());
  return numbers;
}

PathDesign design_of(const std::vector<double>& v, const PathProblem& problem, std::string_view what) {
  if (v.size() != linkage_numbers + problem.x.size())
    throw CheckpointError(fmt::format("{}: a design has {} numbers, must be {}", what, v.size(),
                                      linkage_numbers + problem.x.size()));
  const auto is_sign = [](double x) { return x == 1 || x == -1; };
  const auto is_length = [](double x) { return x >= shortest_link && x <= longest_link; };
  const auto is_place = [](double x) { return std::abs(x) <= longest_link; };
  const auto is_angle = [](double x) { return std::abs(x) <= largest_angle; };
  if (!is_sign(v[0]) || !std::all_of(v.begin() + 1, v.begin() + 5, is_length) ||
      !std::all_of(v.begin() + 5, v.begin() + 9, is_place) || !is_angle(v[9]) || !is_sign(v[10]) ||
      !std::all_of(v.begin() + linkage_numbers, v.end(), is_angle))
    throw CheckpointError(fmt::format("{}: a design is not a four-bar", what));
  const FourBar linkage{.ground = v[1],
                        .crank = v[2],
                        .coupler = v[3],
                        .rocker = v[4],
                        .coupler_u = v[5],
                        .coupler_v = v[6],
                        .pivot_x = v[7],
                        .pivot_y = v[8],
                        .frame_angle = v[9],
                        .branch = v[0] > 0 ? Branch::open : Branch::crossed};
  return measure(problem, linkage, v[10], {v.begin() + linkage_numbers, v.end()});
}

}  // namespace

Value kept(const PathSeedRun& run) {
  Value value;
  value["feasible"] = run.status == Status::done;
  value["evaluations"] = run.evaluations;
  value["designs"] = Value::array();
  for (const PathDesign& design : run.designs) value["designs"].push_back(pack_numbers(numbers_of(design)));
  std::vector<double> best;
  Value::Array evaluations;
  for (const SearchPoint& point : run.history) {
    evaluations.emplace_back(point.evaluations);
    best.push_back(point.best);
  }
  value["history_evaluations"] = Value(std::move(evaluations));
  value["history_best"] = pack_numbers(best);
  return value;
}

PathSeedRun restored(const Value& value, const PathProblem& problem, std::string_view what) {
  PathSeedRun run;
  const Value& feasible = kept_member(value, "feasible", what);
  const Value& designs = kept_member(value, "designs", what);
  const Value& evaluations = kept_member(value, "history_evaluations", what);
  const std::vector<double> best = unpack_numbers(kept_member(value, "history_best", what), what);
  if (!feasible.is_bool() || !designs.is_array() || !evaluations.is_array() ||
      evaluations.as_array().size() != best.size())
    throw CheckpointError(fmt::format("{}: is not what a seed came to", what));
  run.status = feasible.as_bool() ? Status::done : Status::infeasible;
  run.evaluations = kept_integer(value, "evaluations", 0, most_evaluations, what);
  for (const Value& design : designs.as_array())
    run.designs.push_back(design_of(unpack_numbers(design, what), problem, what));
  for (std::size_t i = 0; i < best.size(); ++i) {
    const Value& at = evaluations.as_array()[i];
    if (!at.is_integer() || at.as_integer() < 0 || !std::isfinite(best[i]))
      throw CheckpointError(fmt::format("{}: entry {} of its history is not a number", what, i));
    run.history.push_back({at.as_integer(), best[i]});
  }
  return run;
}

}  // namespace linkwright::planar
