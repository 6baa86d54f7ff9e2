#include "linkwright/planar/path/slider_crank_checkpoint.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/checkpoint.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/search_record.h"

namespace linkwright::planar {
namespace {

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
  require_numbers(v, mechanism_numbers + problem.x.size(), what);
  if (!is_kept_sign(v[0]) || !is_kept_sign(v[1]) || !is_kept_length(v[2]) || !is_kept_length(v[3]) ||
      !is_kept_place(v[4]) || !is_kept_angle(v[5]) ||
      !std::all_of(v.begin() + 6, v.begin() + mechanism_numbers, is_kept_place) ||
      !std::all_of(v.begin() + mechanism_numbers, v.end(), is_kept_angle))
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
  std::vector<std::vector<double>> designs;
  for (const SliderPathDesign& design : run.designs) designs.push_back(numbers_of(design));
  return kept({run.status, run.evaluations, run.history}, designs);
}

SliderPathSynthesis restored(const Value& value, const SliderPathProblem& problem, std::string_view what) {
  SliderPathSynthesis run;
  SearchRecord record = restored(value, what, [&](const std::vector<double>& numbers) {
    run.designs.push_back(design_of(numbers, problem, what));
  });
  run.status = record.status;
  run.evaluations = record.evaluations;
  run.history = std::move(record.history);
  return run;
}

}  // namespace linkwright::planar
