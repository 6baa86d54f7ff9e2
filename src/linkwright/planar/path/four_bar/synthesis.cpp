#include "linkwright/planar/path/four_bar/synthesis.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/planar/four_bar/cognates.h"
#include "linkwright/planar/path/four_bar/fit.h"
#include "linkwright/planar/path/four_bar/free_timing.h"
#include "linkwright/planar/path/four_bar/projection.h"
#include "linkwright/planar/path/four_bar/starts.h"
#include "linkwright/planar/path/four_bar/usability.h"
#include "linkwright/planar/path/targets.h"

namespace linkwright::planar {
namespace {

// Local searches per kind, branch and sense when the options leave it open; free timing has its own.
constexpr int separable_starts = 20;
constexpr int tries_per_separable_start = 6;  // random ratios of which the best starts a search
constexpr std::size_t finished_starts =
    24;  // of the searched ones, how many get their constraints met exactly

struct Candidate {
  FourBar linkage;
  double sense = 1;
  std::vector<double> angles;
  double merit = 0;  // error (m2), with soft constraint violations
};

bool better_design(const PathDesign& a, const PathDesign& b) {
  return optimise::better(a.error, total_violation(a), b.error, total_violation(b));
}

// Adds a design, or takes it in the place of the same linkage where it is better.
void keep_distinct(std::vector<PathDesign>& designs, PathDesign design) {
  for (PathDesign& other : designs) {
    if (other.sense != design.sense || !same_linkage(other.linkage, design.linkage)) continue;
    if (better_design(design, other)) other = std::move(design);
    return;
  }
  designs.push_back(std::move(design));
}

class Search {
 public:
  Search(const PathProblem& problem, const PathSynthesisOptions& options, RunContext& context)
      : problem_(problem),
        options_(options),
        context_(context),
        relaxed_(problem.timing == Timing::free ? problem : relax(problem)) {}

  PathSynthesis run() {
    if (problem_.timing == Timing::free) {
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
    for (double sense : {1.0, -1.0}) {
      if (!(sense > 0 ? problem_.search_positive : problem_.search_negative)) continue;
      for (Branch branch : {Branch::open, Branch::crossed}) {
        if (!(branch == Branch::open ? problem_.search_open : problem_.search_crossed)) continue;
        // With prescribed timing the cognate on the other branch has the same error, so one branch is enough,
        // unless a better candidate failed on bounds or other limits that its cognate need not fail on.
        if (branch == Branch::crossed && problem_.search_open && lowest_feasible() <= lowest_failed_)
          continue;
        for (RatioKind kind : kinds) {
          if (stopped()) return finish();
          search_separable(kind, branch, sense, combination++);
        }
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

  bool stopped() {
    if (out_.status == Status::done) out_.status = context_.interruption();
    return out_.status != Status::done;
  }

  bool any_feasible() const {
    return std::any_of(out_.designs.begin(), out_.designs.end(),
                       [](const PathDesign& d) { return d.violations.empty(); });
  }

  double lowest_feasible() const {
    double lowest = infinity;
    for (const PathDesign& d : out_.designs)
      if (d.violations.empty()) lowest = std::min(lowest, d.error);
    return lowest;
  }

  int starts(int usual) const { return options_.starts > 0 ? options_.starts : usual; }

  double best_so_far() const { return out_.history.empty() ? infinity : out_.history.back().best; }

  void tell(double fraction) {
    if (options_.progress)
      context_.report({.stage = "recommended", .fraction = fraction, .best = best_so_far()});
  }

  void note(double feasible_error) {
    if (feasible_error < best_so_far()) out_.history.push_back({out_.evaluations, feasible_error});
  }

  void keep(PathDesign design) { keep_distinct(out_.designs, std::move(design)); }

  void search_separable(RatioKind kind, Branch branch, double sense, std::uint32_t combination) {
    PathProjection projection(relaxed_, kind, branch, sense);
    const std::size_t n = projection.variables(), m = projection.residuals();
    math::LeastSquaresWorkspace workspace;
    math::LeastSquaresOptions local;
    local.step_clip = 2;
    local.damping = math::Damping::identity;
    const double size = path_size(problem_);
    local.decrease_tolerance = 1e-13;
    std::vector<double> residual(m);
    // In units of the path, or the damping would act differently on small and on large ones.
    const auto function = [&](std::span<const double> q, std::span<double> r, std::span<double> jacobian) {
      if (!projection.evaluate(q, r, jacobian)) return false;
      for (double& value : r) value /= size;
      for (double& value : jacobian) value /= size;
      return true;
    };
    std::vector<Candidate> found;
    const int count = starts(separable_starts);
    for (int start = 0; start < count && !stopped(); ++start) {
      RandomStream stream(
          {.seed = options_.seed, .run = combination, .individual = static_cast<std::uint32_t>(start)});
      std::vector<double> best;
      double lowest = infinity;
      for (int attempt = 0; attempt < tries_per_separable_start; ++attempt) {
        std::vector<double> q = random_ratios(kind, n, stream);
        ++out_.evaluations;
        if (!projection.evaluate(q, residual, {})) continue;
        double sum = 0;
        for (double r : residual) sum += r * r;
        if (sum < lowest) lowest = sum, best = std::move(q);
      }
      if (best.empty()) continue;
      out_.evaluations += math::minimise_least_squares(function, m, best, local, workspace).evaluations;
      const PathDesign design = projection.design(problem_, best);
      if (design.violations.empty()) note(design.error);
      found.push_back({design.linkage, sense, design.angles, design.error});
      tell(static_cast<double>(start + 1) / count);
    }
    finish_candidates(std::move(found), sense);
  }

  // Distinct candidates, best first: those that meet everything are taken as they are, the others go through
  // the constrained search.
  void finish_candidates(std::vector<Candidate> found, double sense) {
    std::sort(found.begin(), found.end(),
              [](const Candidate& a, const Candidate& b) { return a.merit < b.merit; });
    PathFitter fitter(problem_, sense);
    std::vector<FourBar> taken;
    for (const Candidate& candidate : found) {
      if (taken.size() >= finished_starts) break;
      if (std::any_of(taken.begin(), taken.end(),
                      [&](const FourBar& l) { return same_linkage(l, candidate.linkage); }))
        continue;
      taken.push_back(candidate.linkage);
      PathDesign design = measure(problem_, candidate.linkage, sense, candidate.angles);
      if (design.violations.empty() && !has_bands(problem_)) {
        keep(std::move(design));
        continue;
      }
      if (!design.violations.empty()) lowest_failed_ = std::min(lowest_failed_, candidate.merit);
      if (stopped() && !out_.designs.empty()) break;
      const PathFit fit = fitter.fit(candidate.linkage, candidate.angles, {.iterations = 200, .passes = 30});
      out_.evaluations += fit.evaluations;
      if (!std::isfinite(fit.error)) continue;
      design = measure(problem_, fit.linkage, sense, fit.angles);
      if (design.violations.empty()) note(design.error);
      keep(std::move(design));
    }
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
    rank(out_.designs);
    if (any_feasible())
      std::erase_if(out_.designs, [](const PathDesign& d) { return !d.violations.empty(); });
    if (out_.status == Status::done && !any_feasible()) out_.status = Status::infeasible;
    return std::move(out_);
  }

  const PathProblem& problem_;
  const PathSynthesisOptions& options_;
  RunContext& context_;
  const PathProblem relaxed_;
  double lowest_failed_ = infinity;  // error of a candidate beyond some limit
  PathSynthesis out_;
};

// Whether the best design, or the best one whose crank turns fully, has no drawbacks: then no search under
// limits has anything to add.
bool best_turning_is_usable(const PathProblem& problem, const std::vector<PathDesign>& ranked) {
  if (drawbacks(problem, ranked[0]).empty()) return true;
  for (const PathDesign& design : ranked) {
    const std::vector<Drawback> found = drawbacks(problem, design);
    if (std::none_of(found.begin(), found.end(),
                     [](const Drawback& d) { return d.kind == DrawbackKind::locks; }))
      return found.empty();
  }
  return false;
}

// The best design without drawbacks, gone on from under no more than what keeps them away; false where there
// is none. Free timing has searched under limits and is likely to have one.
bool improve_usable(const PathProblem& problem, PathSynthesis& answer) {
  const auto found = std::find_if(answer.designs.begin(), answer.designs.end(), [&](const PathDesign& d) {
    return d.violations.empty() && drawbacks(problem, d).empty();
  });
  if (problem.timing != Timing::free || found == answer.designs.end()) return false;
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
    if (problem.timing == Timing::free && carried_on++ < carried_beyond_limits) {
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
