// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/four_bar/fit.h"
#include "linkwright/planar/path/four_bar/free_timing.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/four_bar/projection.h"
#include "linkwright/planar/path/four_bar/usability.h"
#include "linkwright/planar/path/mechanism.h"
#include "linkwright/planar/path/search.h"

namespace linkwright::planar {
namespace {

// Local searches per kind, branch and sense when the options leave it open; free timing has its own.
constexpr int separable_starts = 20;
// Searched starts that get their constraints met exactly.
constexpr std::size_t finished_starts = 24;

class Search : PathSearch<FourBarPath> {
 public:
  Search(const PathProblem& problem, const PathSynthesisOptions& options, RunContext& context)
      : PathSearch(problem, options, context), relaxed_(problem.free_timing() ? problem : relax(problem)) {}

  PathSynthesis run() {
    if (problem_.free_timing()) {
      PathSynthesis found = search_free_timing(problem_, options_, context_);
      std::vector<PathDesign> designs;
      std::swap(designs, found.designs);
      out_ = std::move(found);
      for (PathDesign& design : designs) keep(std::move(design));
      return finish();
    }
    std::vector<RatioKind> kinds = {RatioKind::crank_rocker, RatioKind::double_crank};
    if (!problem_.crank_rotates_fully) kinds = {RatioKind::any};
    std::uint32_t combination = 0;
    for (const auto& [branch, sense] : crank_searches(problem_)) {
      // The cognate on the other branch has the same error for prescribed timing, so one branch is enough,
      // unless a better candidate failed on bounds or other limits that its cognate need not fail on.
      if (branch == Branch::crossed && problem_.search_open && lowest_feasible() <= lowest_failed_) continue;
      for (RatioKind kind : kinds) {
        if (stopped()) return finish();
        SeparableSearch search(PathProjection(relaxed_, kind, branch, sense), path_size(problem_));
        finish_candidates<PathFitter>(
            separable(std::move(search), sense, combination++, starts(separable_starts)), finished_starts,
            sense, [&](const PathFit& fit, double turning) {
              return measure(problem_, fit.linkage, turning, fit.angles);
            });
      }
    }
    return finish();
  }

 private:
  // The problem without the fixed values that the separable form cannot see; the constrained finish puts them
  // back.
  static PathProblem relax(PathProblem p) {
    if (PathProjection::applies(p)) return p;
    using P = FourBarParameter;
    const auto free = derive_bounds(p.x, p.y);
    for (P j : {P::ground, P::crank, P::coupler, P::rocker, P::coupler_u, P::coupler_v, P::start_angle})
      p.bounds[index(j)] = free[index(j)];
    if (p.bounds[index(P::pivot_x)].fixed() != p.bounds[index(P::pivot_y)].fixed())
      for (P j : {P::pivot_x, P::pivot_y}) p.bounds[index(j)] = free[index(j)];
    return p;
  }

  double lowest_feasible() const {
    double lowest = infinity;
    for (const PathDesign& d : out_.designs)
      if (d.violations.empty()) lowest = std::min(lowest, d.error);
    return lowest;
  }

  // The cognates with the same timing are answers as good; they may meet limits that the original does not.
  void add_cognates() {
    const std::vector<PathDesign> originals = out_.designs;
    for (const PathDesign& design : originals)
      for (const Cognate& cognate : cognates(design.linkage, design.angles[0])) {
        if (!cognate.same_timing) continue;
        if (!(cognate.linkage.branch == Branch::open ? problem_.search_open : problem_.search_crossed))
          continue;
        PathDesign other = measure(problem_, cognate.linkage, design.sense, design.angles);
        if (other.violations.empty()) keep(std::move(other));
      }
  }

  PathSynthesis finish() {
    add_cognates();
    return PathSearch::finish();
  }

  const PathProblem relaxed_;
};

// True if the best design, or the best one whose crank turns fully, has no drawbacks: then no search under
// limits has anything to add.
bool best_turning_is_usable(const PathProblem& problem, const std::vector<PathDesign>& ranked) {
  if (weaknesses(problem, ranked[0]).empty()) return true;
  for (const PathDesign& design : ranked) {
    const std::vector<Weakness> found = weaknesses(problem, design);
    if (std::none_of(found.begin(), found.end(),
                     [](const Weakness& d) { return d.kind == DrawbackKind::locks; }))
      return found.empty();
  }
  return false;
}

// The best design without drawbacks, gone on from under no more than what keeps them away; false where there
// is none. Free timing has searched under limits and is likely to have one.
bool improve_usable(const PathProblem& problem, PathSynthesis& answer) {
  const auto found = std::find_if(answer.designs.begin(), answer.designs.end(), [&](const PathDesign& d) {
    return d.violations.empty() && weaknesses(problem, d).empty();
  });
  if (!problem.free_timing() || found == answer.designs.end()) return false;
  const PathProblem usable = usable_problem(problem);
  const PathDesign on = polish_free_timing(
      usable, measure(usable, found->linkage, found->sense, found->angles), answer.evaluations);
  keep_distinct(answer.designs, measure(problem, on.linkage, on.sense, on.angles));
  rank(answer.designs);
  return true;
}

// The best design has drawbacks: looks for the best one without them. What that search finds is allowed in
// the first one, too, which goes on from there: so a limit of this kind never improves the answer.
void add_usable(const PathProblem& problem, const PathSynthesisOptions& options, RunContext& context,
                PathSynthesis& answer) {
  const PathProblem usable = usable_problem(problem);
  PathSynthesisOptions quiet = options;
  quiet.progress = false;
  PathSynthesis more = Search(usable, quiet, context).run();
  if (more.status != Status::infeasible) answer.status = more.status;
  answer.evaluations += more.evaluations;
  std::size_t carried_on = 0;
  for (const PathDesign& found : more.designs) {
    if (!found.violations.empty()) break;
    PathDesign design = measure(problem, found.linkage, found.sense, found.angles);
    if (problem.free_timing() && carried_on++ < carried_beyond_limits) {
      // One limit after the other: so the search with the full turn alone is part of the one without it.
      PathProblem turning = problem;
      turning.crank_rotates_fully = true;
      PathDesign on = polish_free_timing(turning, measure(turning, found.linkage, found.sense, found.angles),
                                         answer.evaluations);
      if (!problem.crank_rotates_fully) {
        on = measure(problem, on.linkage, on.sense, on.angles);
        keep_distinct(answer.designs, on);
        on = polish_free_timing(problem, std::move(on), answer.evaluations);
      }
      if (on.violations.empty() && (answer.history.empty() || on.error < answer.history.back().best))
        answer.history.push_back({answer.evaluations, on.error});
      keep_distinct(answer.designs, std::move(on));
    }
    keep_distinct(answer.designs, std::move(design));
  }
  rank(answer.designs);
}

}  // namespace

PathSynthesis synthesise_path(const PathProblem& problem, const PathSynthesisOptions& options,
                              RunContext& context) {
  require_valid(problem);
  LINKWRIGHT_REQUIRE(options.starts >= 0 && options.max_solutions >= 1, "starts {}, max_solutions {}",
                     options.starts, options.max_solutions);
  PathSynthesis answer = Search(problem, options, context).run();
  if (answer.status == Status::done && !best_turning_is_usable(problem, answer.designs) &&
      !improve_usable(problem, answer))
    add_usable(problem, options, context, answer);
  keep_first(problem, answer.designs, static_cast<std::size_t>(options.max_solutions));
  return answer;
}

}  // namespace linkwright::planar
