// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/pivot_map.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/path/four_bar/usability.h"

namespace linkwright::planar {
namespace {

double at_step(const Range& range, std::size_t step, std::size_t steps) {
  if (steps < 2) return range.lower;
  return range.lower +
         (range.upper - range.lower) * static_cast<double>(step) / static_cast<double>(steps - 1);
}

struct LookedAt {
  PivotMapPlace place;
  std::vector<ExactDesign> best;  // the best answer, or the nearest to one
  int finite = 0, lost = 0;
  bool done = false;
};

LookedAt look_at(const PathProblem& problem, const std::vector<std::complex<double>>& points,
                 const std::array<std::complex<double>, 2>& pivots, RunContext& context) {
  LookedAt out;
  out.place = {pivots, 0, 0, nan};
  out.done = true;
  if (pivots[0] == pivots[1]) return out;
  const FourBarSolutions solutions = solve_five_points(std::span(points).first<5>(), pivots, context);
  out.done = !context.interrupted();
  out.finite = solutions.finite;
  out.lost = solutions.lost;
  std::vector<ExactDesign> designs = exact_designs(problem, solutions);
  out.place.real = static_cast<int>(designs.size());
  const auto answers = [](const ExactDesign& d) { return d.defects.empty() && d.design.violations.empty(); };
  std::stable_partition(designs.begin(), designs.end(), answers);
  out.place.answers = static_cast<int>(std::count_if(designs.begin(), designs.end(), answers));
  if (designs.empty()) return out;
  if (out.place.answers > 0) out.place.transmission = path_transmission(problem, designs[0].design).used;
  out.best.push_back(std::move(designs[0]));
  return out;
}

}  // namespace

std::size_t places_of_range(std::size_t free_ranges) {
  constexpr std::size_t places[] = {1, 401, 21, 8, 5};
  return places[free_ranges];
}

PivotMap map_pivots(const PathProblem& problem, const PivotRanges& ranges, RunContext& context) {
  LINKWRIGHT_REQUIRE(problem.x.size() == 5, "{} points", problem.x.size());
  std::vector<std::complex<double>> points;
  for (std::size_t k = 0; k < problem.x.size(); ++k) points.emplace_back(problem.x[k], problem.y[k]);
  const auto free = static_cast<std::size_t>(
      std::count_if(ranges.begin(), ranges.end(), [](const Range& range) { return !range.fixed(); }));
  PivotMap out;
  std::size_t count = 1;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    out.steps[i] = ranges[i].fixed() ? 1 : places_of_range(free);
    count *= out.steps[i];
  }
  std::vector<LookedAt> places(count);
  std::atomic<std::size_t> done{0};
  optimise::parallel_for(count, context.threads(), [&](std::size_t which) {
    if (context.interrupted()) return;
    std::array<double, 4> at;
    for (std::size_t i = 4, rest = which; i-- > 0; rest /= out.steps[i])
      at[i] = at_step(ranges[i], rest % out.steps[i], out.steps[i]);
    RunContext alone;  // the loop over places is interrupted, not a place
    alone.set_threads(1);
    places[which] = look_at(problem, points, {{{at[0], at[1]}, {at[2], at[3]}}}, alone);
    context.report({"places of the pivots", static_cast<double>(++done) / static_cast<double>(count), nan});
  });
  out.status = context.interruption();
  std::vector<std::pair<double, ExactDesign>> best;
  for (LookedAt& p : places) {
    if (!p.done) continue;
    out.finite += p.finite;
    out.lost += p.lost;
    for (ExactDesign& d : p.best) best.emplace_back(p.place.transmission, std::move(d));
    out.places.push_back(p.place);
  }
  // Answers by their transmission angle, then the nearest to one.
  std::stable_sort(best.begin(), best.end(), [](const auto& a, const auto& b) {
    const bool answer = !std::isnan(a.first), other = !std::isnan(b.first);
    if (answer != other) return answer;
    return answer ? a.first > b.first : severity(a.second.defects) < severity(b.second.defects);
  });
  for (auto& [transmission, design] : best) out.designs.push_back(std::move(design));
  out.designs = designs_that_differ(problem, std::move(out.designs));
  return out;
}

}  // namespace linkwright::planar
