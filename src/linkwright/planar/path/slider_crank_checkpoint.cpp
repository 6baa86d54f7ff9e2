#include "linkwright/planar/path/slider_crank_checkpoint.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/checkpoint.h"
#include "linkwright/planar/four_bar/four_bar.h"

namespace linkwright::planar {
namespace {

// Far more than a search makes, and few enough that the sum over the seeds of a study is an integer.
constexpr std::int64_t most_evaluations = std::int64_t{1} << 46;
// Crank angles are unwrapped over a turn, from a start angle that the study may have put anywhere sensible.
constexpr double largest_angle = 1e6;
constexpr std::size_t mechanism_numbers = 10;  // before the crank angles

std::vector<double> numbers_of(const SliderPathDesign& d) {
  const SliderCrankForm& f = d.mechanism.parameters;
  std::vector<double> numbers = {sign(d.mechanism.branch),
                                 d.sense,
                                 f.crank,
                                 f.rod,
                                 f.offset,
                                 f.guide_angle,
                                 f.pivot_x,
                                 f.pivot_y,
                                 f.rod_u,
                                 f.rod_v};
  numbers.insert(numbers.end(), d.angles.begin(), d.angles.end());
  return numbers;
}

SliderPathDesign design_of(const std::vector<double>& v, const SliderPathProblem& problem,
                           std::string_view what) {
  if (v.size() != mechanism_numbers + problem.x.size())
    throw CheckpointError(fmt::format("{}: a design has {} numbers, must be {}", what, v.size(),
                                      mechanism_numbers + problem.x.size()));
  const auto is_sign = [](double x) { return x == 1 || x == -1; };
  const auto is_length = [](double x) { return x >= shortest_link && x <= longest_link; };
  const auto is_place = [](double x) { return std::abs(x) <= longest_link; };
  const auto is_turn = [](double x) { return std::abs(x) <= largest_angle; };
  if (!is_sign(v[0]) || !is_sign(v[1]) || !is_length(v[2]) || !is_length(v[3]) || !is_place(v[4]) ||
      !is_turn(v[5]) || !std::all_of(v.begin() + 6, v.begin() + mechanism_numbers, is_place) ||
      !std::all_of(v.begin() + mechanism_numbers, v.end(), is_turn))
    throw CheckpointError(fmt::format("{}: a design is not a slider-crank", what));
  SliderCrankMechanism m;
  m.branch = v[0] > 0 ? SliderSide::forward : SliderSide::backward;
  m.parameters = {.crank = v[2],
                  .rod = v[3],
                  .offset = v[4],
                  .guide_angle = v[5],
                  .pivot_x = v[6],
                  .pivot_y = v[7],
                  .rod_u = v[8],
                  .rod_v = v[9]};
  return measure(problem, m, v[1], {v.begin() + mechanism_numbers, v.end()});
}

}  // namespace

Value kept(const SliderPathSynthesis& run) {
  Value value;
  value["feasible"] = run.status == Status::done;
  value["evaluations"] = run.evaluations;
  value["designs"] = Value::array();
  for (const SliderPathDesign& d : run.designs) value["designs"].push_back(pack_numbers(numbers_of(d)));
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

SliderPathSynthesis restored(const Value& value, const SliderPathProblem& problem, std::string_view what) {
  SliderPathSynthesis run;
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
