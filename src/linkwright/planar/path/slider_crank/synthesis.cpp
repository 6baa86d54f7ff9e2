// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/synthesis.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/optimise/pareto.h"
#include "linkwright/planar/path/curve_overlay.h"
#include "linkwright/planar/path/search.h"
#include "linkwright/planar/path/slider_crank/fit.h"
#include "linkwright/planar/path/slider_crank/projection.h"
#include "linkwright/planar/path/slider_crank/starts.h"

namespace linkwright::planar {
namespace {

using P = SliderParameter;

// Local searches per side and sense when the options leave it open.
constexpr int slider_separable_starts = 30, slider_joint_starts = 160;
constexpr int mechanisms_per_joint_start = 48;      // random curves of which the best match starts a search
constexpr std::size_t slider_finished_starts = 48;  // searched starts that get their constraints met
constexpr std::size_t followed_starts = 6;          // starts that are followed along a front

using SliderCandidate = PathCandidate<SliderCrankMechanism>;

// The problem without what the separable form cannot see; the constrained finish puts it back.
SliderPathProblem relax(SliderPathProblem p) {
  if (p.free_timing() || SliderPathProjection::applies(p)) return p;
  const auto free = derive_slider_bounds(p.x, p.y);
  const auto open = [&](P j) { p.bounds[index(j)] = free[index(j)]; };
  for (P j : {P::rod, P::offset, P::point_distance, P::point_angle}) open(j);
  if (p.bounds[index(P::pivot_x)].fixed() != p.bounds[index(P::pivot_y)].fixed())
    for (P j : {P::pivot_x, P::pivot_y}) open(j);
  for (P j : {P::start_angle, P::guide_angle})
    if (!p.bounds[index(j)].fixed()) open(j);
  return p;
}

SeparableSearch<SliderPathProjection> separable_form(const SliderPathProblem& relaxed, SliderSide side,
                                                     double sense) {
  return SeparableSearch(SliderPathProjection(relaxed, side, sense), path_size(relaxed));
}

class SliderSearch : PathSearch<SliderCrankPath> {
 public:
  SliderSearch(const SliderPathProblem& problem, const PathSynthesisOptions& options, RunContext& context)
      : PathSearch(problem, options, context), relaxed_(relax(problem)) {}

  SliderPathSynthesis path() {
    std::uint32_t combination = 0;
    for (const auto& [side, sense] : crank_searches(problem_)) {
      if (stopped()) break;
      finish_candidates<SliderPathFitter>(
          problem_.free_timing() ? joint(side, sense, combination, problem_.stroke)
                                 : separable(separable_form(relaxed_, side, sense), sense, combination,
                                             starts(slider_separable_starts)),
          slider_finished_starts, sense,
          [&](const SliderPathFit& fit, double turning) { return settled(problem_, fit, turning); });
      ++combination;
    }
    return finish();
  }

  SliderPathSynthesis front(std::span<const double> asked) {
    std::vector<double> strokes(asked.begin(), asked.end());
    std::sort(strokes.rbegin(), strokes.rend());
    std::vector<SliderPathDesign> best(strokes.size());
    for (SliderPathDesign& d : best) d.error = infinity;
    std::uint32_t combination = 0;
    const auto all = crank_searches(problem_);
    for (const auto& [side, sense] : all) {
      if (stopped()) break;
      share_ = {static_cast<double>(combination) / static_cast<double>(all.size()),
                1.0 / static_cast<double>(all.size())};
      if (problem_.free_timing())
        follow_joint(side, sense, combination++, strokes, best);
      else
        follow_separable(side, sense, combination++, strokes, best);
    }
    for (SliderPathDesign& d : best)
      if (!d.angles.empty()) out_.designs.push_back(std::move(d));
    if (any_feasible())
      out_.designs = slider_front_of(std::move(out_.designs));
    else
      rank(out_.designs);
    if (out_.status == Status::done && !any_feasible()) out_.status = Status::infeasible;
    return std::move(out_);
  }

 private:
  // Starts of free timing by turns: a random curve laid on the path, and the best mechanism of a random
  // timing, for which the separable form knows more.
  std::vector<SliderCandidate> joint(SliderSide side, double sense, std::uint32_t combination,
                                     const Range& stroke) {
    SliderPathMatcher matcher(problem_, side, sense);
    const std::vector<double> along = path_fractions(problem_.x, problem_.y, problem_.closed);
    SliderPathFitter fitter(problem_, sense);
    fitter.limit_stroke(stroke);
    const double size = path_size(problem_);
    std::vector<SliderCandidate> found;
    const int count = starts(slider_joint_starts);
    for (int start = 0; start < count && !stopped(); ++start) {
      RandomStream random = stream(combination, start);
      const auto match = start % 2 == 0 ? matcher.best_of(mechanisms_per_joint_start, random)
                                        : timed(side, sense, stroke, along, random);
      if (!match) continue;
      const SliderPathFit fit =
          fitter.fit(match->linkage, match->angles, {.iterations = 80, .passes = 1, .decrease = 1e-6});
      out_.evaluations += fit.evaluations;
      if (!std::isfinite(fit.error)) continue;
      found.push_back(
          {fit.linkage, sense, fit.angles, fit.error + size * size * fit.violation * fit.violation});
      if (fit.violation <= tolerance::feasibility) note(fit.error);
      tell(static_cast<double>(start + 1) / count);
    }
    return found;
  }

  // The best mechanism of a random timing: crank angles that rise along the path with its length or with the
  // number of its points, or between, and swing about that once and twice; over the turn, or over a part of
  // it where the path is open.
  std::optional<SliderPathStart> timed(SliderSide side, double sense, const Range& stroke,
                                       const std::vector<double>& along, RandomStream& random) {
    const std::size_t n = problem_.x.size();
    const bool turn = problem_.closed && problem_.crank_rotates_fully;
    const double whole = 2 * pi * (turn ? 1 : random.uniform(0.1, 0.97)), by_length = random.uniform(),
                 once = random.uniform(0, 0.5), twice = random.uniform(0, 0.12),
                 first = random.uniform(0, 2 * pi), second = random.uniform(0, 2 * pi),
                 last = static_cast<double>(problem_.closed ? n : n - 1);
    SliderPathProblem p = problem_;
    p.timing = Timing::increments;
    p.stroke = stroke;
    p.bounds[index(P::start_angle)] = {0, 2 * pi};
    p.angles.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      const double share = by_length * along[k] + (1 - by_length) * static_cast<double>(k) / last,
                   u = 2 * pi * share;
      p.angles[k] = whole * (share + (once * (std::sin(u + first) - std::sin(first)) +
                                      twice * (std::sin(2 * u + second) - std::sin(second))) /
                                         (2 * pi));
    }
    auto search = separable_form(relax(p), side, sense);
    std::vector<double> q = search.start(random, out_.evaluations);
    if (q.empty() || !std::isfinite(search.descend(q, out_.evaluations))) return std::nullopt;
    SliderPathDesign design = search.projection().design(p, q);
    SliderPathDesign measured = measure(problem_, design.linkage, sense, design.angles);
    if (measured.violations.empty() && (!spare_ || better_design(measured, *spare_)))
      spare_ = std::move(measured);
    return SliderPathStart{design.linkage, std::move(design.angles), design.error};
  }

  // The design of a local search, measured. Where it did not come to meet the constraints, the best mechanism
  // at its crank angles may: the separable form holds stroke and rotation exactly.
  SliderPathDesign settled(const SliderPathProblem& problem, const SliderPathFit& fit, double sense) {
    SliderPathDesign design = measure(problem, fit.linkage, sense, fit.angles);
    if (!problem.free_timing() || design.violations.empty()) return design;
    SliderPathProblem p = problem;
    p.timing = Timing::increments;
    p.bounds[index(P::start_angle)] = {0, 2 * pi};
    p.angles.clear();
    for (const double angle : fit.angles) p.angles.push_back(sense * (angle - fit.angles[0]));
    auto search = separable_form(relax(p), fit.linkage.branch, sense);
    std::vector<double> q = search.projection().unknowns(fit.linkage.parameters, fit.angles[0]);
    if (!std::isfinite(search.descend(q, out_.evaluations))) return design;
    const SliderPathDesign at_angles = search.projection().design(p, q);
    SliderPathDesign other = measure(problem, at_angles.linkage, sense, at_angles.angles);
    return better_design(other, design) ? other : design;
  }

  Range limited(double stroke) const { return {std::min(problem_.stroke.lower, stroke), stroke}; }
  SliderPathProblem limited_problem(double stroke) const {
    SliderPathProblem p = problem_;
    p.stroke = limited(stroke);
    return p;
  }
  static void take(SliderPathDesign design, SliderPathDesign& best) {
    if (best.angles.empty() || better_design(design, best)) best = std::move(design);
  }

  void follow_separable(SliderSide side, double sense, std::uint32_t combination,
                        const std::vector<double>& strokes, std::vector<SliderPathDesign>& best) {
    auto search = separable_form(relaxed_, side, sense);
    SliderPathFitter fitter(problem_, sense);
    const std::size_t n = strokes.size();
    std::vector<std::vector<double>> at(n);
    std::vector<double> error(n, infinity);
    const auto from = [&](std::size_t i, std::vector<double> q) {
      if (q.empty()) return;
      const double found = search.descend(q, out_.evaluations);
      if (found < error[i]) error[i] = found, at[i] = std::move(q);
    };
    const int count = starts(slider_separable_starts);
    for (std::size_t i = 0; i < n; ++i) {
      search.projection().limit_stroke(limited(strokes[i]));
      for (int start = 0; start < count && !stopped(); ++start) {
        RandomStream random = stream(combination, start, static_cast<std::uint32_t>(i) + 1);
        from(i, search.start(random, out_.evaluations));
      }
      if (i > 0) from(i, at[i - 1]);
      tell(static_cast<double>(i + 1) / static_cast<double>(n));
    }
    for (std::size_t i = n; i-- > 0;) {
      search.projection().limit_stroke(limited(strokes[i]));
      if (i + 1 < n) from(i, at[i + 1]);
      if (at[i].empty()) continue;
      const SliderPathProblem here = limited_problem(strokes[i]);
      SliderPathDesign design = search.projection().design(here, at[i]);
      if (!design.violations.empty() || has_bands(problem_)) {
        fitter.limit_stroke(here.stroke);
        const SliderPathFit fit =
            fitter.fit(design.linkage, design.angles, {.iterations = 200, .passes = 30});
        out_.evaluations += fit.evaluations;
        if (std::isfinite(fit.error)) take(measure(here, fit.linkage, sense, fit.angles), best[i]);
      }
      take(std::move(design), best[i]);
    }
  }

  void follow_joint(SliderSide side, double sense, std::uint32_t combination,
                    const std::vector<double>& strokes, std::vector<SliderPathDesign>& best) {
    std::vector<SliderCandidate> followed =
        distinct(joint(side, sense, combination, limited(strokes.front())), followed_starts);
    SliderPathFitter fitter(problem_, sense);
    const auto fit_at = [&](std::size_t i, SliderCandidate& candidate) {
      const SliderPathProblem here = limited_problem(strokes[i]);
      fitter.limit_stroke(here.stroke);
      const SliderPathFit fit =
          fitter.fit(candidate.linkage, candidate.angles, {.iterations = 200, .passes = 30});
      out_.evaluations += fit.evaluations;
      if (!std::isfinite(fit.error)) return;
      SliderPathDesign design = settled(here, fit, sense);
      candidate.linkage = design.linkage;
      candidate.angles = design.angles;
      take(std::move(design), best[i]);
    };
    for (std::size_t i = 0; i < strokes.size(); ++i)
      for (SliderCandidate& candidate : followed)
        if (!stopped()) fit_at(i, candidate);
    for (std::size_t i = strokes.size() - 1; i-- > 0;) {
      if (stopped() || best[i + 1].angles.empty() || best[i + 1].sense != sense) continue;
      SliderCandidate neighbour{best[i + 1].linkage, sense, best[i + 1].angles, 0};
      fit_at(i, neighbour);
    }
  }

  SliderPathSynthesis finish() {
    if (spare_ && !any_feasible()) out_.designs.push_back(std::move(*spare_));
    SliderPathSynthesis out = PathSearch::finish();
    keep_first(problem_, out.designs, static_cast<std::size_t>(options_.max_solutions));
    return out;
  }

  const SliderPathProblem relaxed_;
  std::optional<SliderPathDesign> spare_;  // the best start that meets the constraints
};

}  // namespace

SliderPathSynthesis synthesise_path(const SliderPathProblem& problem, const PathSynthesisOptions& options,
                                    RunContext& context) {
  require_valid(problem);
  LINKWRIGHT_REQUIRE(options.starts >= 0 && options.max_solutions >= 1, "starts {}, max_solutions {}",
                     options.starts, options.max_solutions);
  return SliderSearch(problem, options, context).path();
}

SliderPathSynthesis synthesise_slider_front(const SliderPathProblem& problem, std::span<const double> strokes,
                                            const PathSynthesisOptions& options, RunContext& context) {
  require_valid(problem);
  LINKWRIGHT_REQUIRE(options.starts >= 0 && !strokes.empty(), "starts {}, {} strokes", options.starts,
                     strokes.size());
  LINKWRIGHT_REQUIRE(problem.crank_rotates_fully, "the stroke is that of a full turn");
  for (const double stroke : strokes)
    LINKWRIGHT_REQUIRE(stroke > 0 && std::isfinite(stroke), "a stroke of {}", stroke);
  return SliderSearch(problem, options, context).front(strokes);
}

std::vector<SliderPathDesign> slider_front_of(std::vector<SliderPathDesign> designs) {
  std::erase_if(designs, [](const SliderPathDesign& d) { return !d.violations.empty(); });
  std::stable_sort(designs.begin(), designs.end(), [](const SliderPathDesign& a, const SliderPathDesign& b) {
    return a.error != b.error ? a.error < b.error : a.stroke < b.stroke;
  });
  std::vector<SliderPathDesign> out;
  // A stroke, or an error, that is less by rounding alone is the same.
  for (SliderPathDesign& d : designs) {
    if (!out.empty() && !optimise::less_by_more_than_rounding(d.stroke, out.back().stroke)) continue;
    while (!out.empty() && !optimise::less_by_more_than_rounding(out.back().error, d.error)) out.pop_back();
    out.push_back(std::move(d));
  }
  return out;
}

}  // namespace linkwright::planar
