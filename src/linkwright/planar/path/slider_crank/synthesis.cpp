#include "linkwright/planar/path/slider_crank/synthesis.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/optimise/pareto.h"
#include "linkwright/planar/path/slider_crank/fit.h"
#include "linkwright/planar/path/slider_crank/projection.h"
#include "linkwright/planar/path/slider_crank/starts.h"

namespace linkwright::planar {
namespace {

using P = SliderParameter;

// Local searches per side and sense when the options leave it open.
constexpr int slider_separable_starts = 30, slider_joint_starts = 160;
constexpr int slider_tries_per_separable_start = 6;  // random ratios of which the best starts a search
constexpr int mechanisms_per_joint_start = 48;       // random curves of which the best match starts a search
constexpr std::size_t slider_finished_starts =
    48;                                     // of the searched ones, how many get their constraints met
constexpr std::size_t followed_starts = 6;  // ... and how many are followed along a front

bool better_design(const SliderPathDesign& a, const SliderPathDesign& b) {
  return optimise::better(a.error, total_violation(a), b.error, total_violation(b));
}

struct SliderCandidate {
  SliderCrankMechanism mechanism;
  double sense = 1;
  std::vector<double> angles;
  double merit = 0;  // error (m2), with soft constraint violations
};

// The problem without what the separable form cannot see; the constrained finish puts it back.
SliderPathProblem relax(SliderPathProblem p) {
  if (p.free_timing || SliderPathProjection::applies(p)) return p;
  const auto free = derive_slider_bounds(p.x, p.y);
  const auto open = [&](P j) { p.bounds[index(j)] = free[index(j)]; };
  for (P j : {P::rod, P::offset, P::point_distance, P::point_angle}) open(j);
  if (p.bounds[index(P::pivot_x)].fixed() != p.bounds[index(P::pivot_y)].fixed())
    for (P j : {P::pivot_x, P::pivot_y}) open(j);
  for (P j : {P::start_angle, P::guide_angle})
    if (!p.bounds[index(j)].fixed()) open(j);
  return p;
}

// Share of the path's length at each point; of a closed path its last piece counts.
std::vector<double> path_fractions(const SliderPathProblem& p) {
  const std::size_t n = p.x.size();
  std::vector<double> out{0};
  for (std::size_t k = 1; k <= n; ++k)
    out.push_back(out.back() +
                  (k == n && !p.closed ? 0 : std::hypot(p.x[k % n] - p.x[k - 1], p.y[k % n] - p.y[k - 1])));
  const double length = out.back();
  out.resize(n);
  for (double& f : out) f /= length;
  return out;
}

// Searches on one side and in one sense, by the separable form.
class SeparableSearch {
 public:
  SeparableSearch(const SliderPathProblem& relaxed, SliderSide side, double sense)
      : projection_(relaxed, side, sense), size_(path_size(relaxed)), residual_(projection_.residuals()) {
    local_.step_clip = 2;
    local_.damping = math::Damping::identity;
    local_.decrease_tolerance = 1e-13;
  }

  SliderPathProjection& projection() { return projection_; }

  // Best of a few random unknowns; empty when none evaluates.
  std::vector<double> start(RandomStream& stream, std::int64_t& evaluations) {
    std::vector<double> best;
    double lowest = infinity;
    for (int attempt = 0; attempt < slider_tries_per_separable_start; ++attempt) {
      std::vector<double> q = projection_.random(stream);
      ++evaluations;
      if (!projection_.evaluate(q, residual_, {})) continue;
      double sum = 0;
      for (double r : residual_) sum += r * r;
      if (sum < lowest) lowest = sum, best = std::move(q);
    }
    return best;
  }

  // Error (m2) at the end of a local search from q; infinite when q does not evaluate.
  double descend(std::vector<double>& q, std::int64_t& evaluations) {
    // In units of the path, or the damping would act differently on small and on large ones.
    const auto function = [&](std::span<const double> at, std::span<double> r, std::span<double> jacobian) {
      if (!projection_.evaluate(at, r, jacobian)) return false;
      for (double& value : r) value /= size_;
      for (double& value : jacobian) value /= size_;
      return true;
    };
    const auto report = math::minimise_least_squares(function, residual_.size(), q, local_, workspace_);
    evaluations += report.evaluations;
    return report.status == Status::infeasible ? infinity : 2 * report.cost * size_ * size_;
  }

 private:
  SliderPathProjection projection_;
  double size_;
  std::vector<double> residual_;
  math::LeastSquaresWorkspace workspace_;
  math::LeastSquaresOptions local_;
};

class SliderSearch {
 public:
  SliderSearch(const SliderPathProblem& problem, const PathSynthesisOptions& options, RunContext& context)
      : problem_(problem), options_(options), context_(context), relaxed_(relax(problem)) {}

  SliderPathSynthesis path() {
    std::uint32_t combination = 0;
    for (const auto& [side, sense] : ways()) {
      if (stopped()) break;
      finish_candidates(problem_.free_timing ? joint(side, sense, combination, problem_.stroke)
                                             : separable(side, sense, combination),
                        sense);
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
    const auto all = ways();
    for (const auto& [side, sense] : all) {
      if (stopped()) break;
      share_ = {static_cast<double>(combination) / static_cast<double>(all.size()),
                1.0 / static_cast<double>(all.size())};
      if (problem_.free_timing)
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
  struct Way {
    SliderSide side;
    double sense;
  };
  std::vector<Way> ways() const {
    std::vector<Way> out;
    for (double sense : {1.0, -1.0})
      for (SliderSide side : {SliderSide::forward, SliderSide::backward})
        if ((sense > 0 ? problem_.search_positive : problem_.search_negative) &&
            (side == SliderSide::forward ? problem_.search_forward : problem_.search_backward))
          out.push_back({side, sense});
    return out;
  }

  bool stopped() {
    if (out_.status == Status::done) out_.status = context_.interruption();
    return out_.status != Status::done;
  }
  bool any_feasible() const {
    return std::any_of(out_.designs.begin(), out_.designs.end(),
                       [](const SliderPathDesign& d) { return d.violations.empty(); });
  }
  int starts(int usual) const { return options_.starts > 0 ? options_.starts : usual; }
  RandomStream stream(std::uint32_t combination, std::size_t start, std::uint32_t part = 0) const {
    return RandomStream({.seed = options_.seed,
                         .run = combination,
                         .generation = part,
                         .individual = static_cast<std::uint32_t>(start)});
  }
  double best_so_far() const { return out_.history.empty() ? infinity : out_.history.back().best; }
  void tell(double fraction) {
    if (options_.progress)
      context_.report(
          {.stage = "recommended", .fraction = share_.from + share_.width * fraction, .best = best_so_far()});
  }
  void note(double feasible_error) {
    if (feasible_error < best_so_far()) out_.history.push_back({out_.evaluations, feasible_error});
  }

  void keep(SliderPathDesign design) {
    for (SliderPathDesign& other : out_.designs) {
      if (other.sense != design.sense || !same_mechanism(other.mechanism, design.mechanism)) continue;
      if (better_design(design, other)) other = std::move(design);
      return;
    }
    out_.designs.push_back(std::move(design));
  }

  std::vector<SliderCandidate> separable(SliderSide side, double sense, std::uint32_t combination) {
    SeparableSearch search(relaxed_, side, sense);
    std::vector<SliderCandidate> found;
    const int count = starts(slider_separable_starts);
    for (int start = 0; start < count && !stopped(); ++start) {
      RandomStream random = stream(combination, static_cast<std::size_t>(start));
      std::vector<double> q = search.start(random, out_.evaluations);
      if (q.empty() || !std::isfinite(search.descend(q, out_.evaluations))) continue;
      const SliderPathDesign design = search.projection().design(problem_, q);
      if (design.violations.empty()) note(design.error);
      found.push_back({design.mechanism, sense, design.angles, design.error});
      tell(static_cast<double>(start + 1) / count);
    }
    return found;
  }

  // Starts of free timing by turns: a random curve laid on the path, and the best mechanism of a random
  // timing, for which the separable form knows more.
  std::vector<SliderCandidate> joint(SliderSide side, double sense, std::uint32_t combination,
                                     const Range& stroke) {
    SliderPathMatcher matcher(problem_, side, sense);
    const std::vector<double> along = path_fractions(problem_);
    SliderPathFitter fitter(problem_, sense);
    fitter.limit_stroke(stroke);
    const double size = path_size(problem_);
    std::vector<SliderCandidate> found;
    const int count = starts(slider_joint_starts);
    for (int start = 0; start < count && !stopped(); ++start) {
      RandomStream random = stream(combination, static_cast<std::size_t>(start));
      const auto match = start % 2 == 0 ? matcher.best_of(mechanisms_per_joint_start, random)
                                        : timed(side, sense, stroke, along, random);
      if (!match) continue;
      const SliderPathFit fit =
          fitter.fit(match->mechanism, match->angles, {.iterations = 80, .passes = 1, .decrease = 1e-6});
      out_.evaluations += fit.evaluations;
      if (!std::isfinite(fit.error)) continue;
      found.push_back(
          {fit.mechanism, sense, fit.angles, fit.error + size * size * fit.violation * fit.violation});
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
    p.free_timing = false;
    p.stroke = stroke;
    p.bounds[index(P::start_angle)] = {0, 2 * pi};
    p.offsets.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      const double share = by_length * along[k] + (1 - by_length) * static_cast<double>(k) / last,
                   u = 2 * pi * share;
      p.offsets[k] = whole * (share + (once * (std::sin(u + first) - std::sin(first)) +
                                       twice * (std::sin(2 * u + second) - std::sin(second))) /
                                          (2 * pi));
    }
    SeparableSearch search(relax(p), side, sense);
    std::vector<double> q = search.start(random, out_.evaluations);
    if (q.empty() || !std::isfinite(search.descend(q, out_.evaluations))) return std::nullopt;
    SliderPathDesign design = search.projection().design(p, q);
    SliderPathDesign measured = measure(problem_, design.mechanism, sense, design.angles);
    if (measured.violations.empty() && (!spare_ || better_design(measured, *spare_)))
      spare_ = std::move(measured);
    return SliderPathStart{design.mechanism, std::move(design.angles), design.error};
  }

  // The design of a local search, measured. Where it did not come to meet the constraints, the best mechanism
  // at its crank angles may: the separable form holds stroke and rotation exactly.
  SliderPathDesign settled(const SliderPathProblem& problem, const SliderPathFit& fit, double sense) {
    SliderPathDesign design = measure(problem, fit.mechanism, sense, fit.angles);
    if (!problem.free_timing || design.violations.empty()) return design;
    SliderPathProblem p = problem;
    p.free_timing = false;
    p.bounds[index(P::start_angle)] = {0, 2 * pi};
    p.offsets.clear();
    for (const double angle : fit.angles) p.offsets.push_back(sense * (angle - fit.angles[0]));
    SeparableSearch search(relax(p), fit.mechanism.branch, sense);
    std::vector<double> q = search.projection().unknowns(fit.mechanism.parameters, fit.angles[0]);
    if (!std::isfinite(search.descend(q, out_.evaluations))) return design;
    const SliderPathDesign at_angles = search.projection().design(p, q);
    SliderPathDesign other = measure(problem, at_angles.mechanism, sense, at_angles.angles);
    return better_design(other, design) ? other : design;
  }

  // The distinct ones, best first, at most `most`.
  static std::vector<SliderCandidate> distinct(std::vector<SliderCandidate> found, std::size_t most) {
    std::sort(found.begin(), found.end(),
              [](const SliderCandidate& a, const SliderCandidate& b) { return a.merit < b.merit; });
    std::vector<SliderCandidate> taken;
    for (SliderCandidate& candidate : found) {
      if (taken.size() >= most) break;
      if (std::none_of(taken.begin(), taken.end(), [&](const SliderCandidate& c) {
            return same_mechanism(c.mechanism, candidate.mechanism);
          }))
        taken.push_back(std::move(candidate));
    }
    return taken;
  }

  // Those that meet everything are taken as they are, the others go through the constrained search, as does
  // what the separable form has brought to points that are gates or have tolerances.
  void finish_candidates(std::vector<SliderCandidate> found, double sense) {
    SliderPathFitter fitter(problem_, sense);
    for (const SliderCandidate& candidate : distinct(std::move(found), slider_finished_starts)) {
      if (!problem_.free_timing) {
        SliderPathDesign design = measure(problem_, candidate.mechanism, sense, candidate.angles);
        if (design.violations.empty() && !has_bands(problem_)) {
          keep(std::move(design));
          continue;
        }
      }
      if (stopped() && !out_.designs.empty()) break;
      const SliderPathFit fit =
          fitter.fit(candidate.mechanism, candidate.angles, {.iterations = 200, .passes = 30});
      out_.evaluations += fit.evaluations;
      if (!std::isfinite(fit.error)) continue;
      SliderPathDesign design = settled(problem_, fit, sense);
      if (design.violations.empty()) note(design.error);
      keep(std::move(design));
    }
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
    SeparableSearch search(relaxed_, side, sense);
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
        RandomStream random =
            stream(combination, static_cast<std::size_t>(start), static_cast<std::uint32_t>(i) + 1);
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
            fitter.fit(design.mechanism, design.angles, {.iterations = 200, .passes = 30});
        out_.evaluations += fit.evaluations;
        if (std::isfinite(fit.error)) take(measure(here, fit.mechanism, sense, fit.angles), best[i]);
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
          fitter.fit(candidate.mechanism, candidate.angles, {.iterations = 200, .passes = 30});
      out_.evaluations += fit.evaluations;
      if (!std::isfinite(fit.error)) return;
      SliderPathDesign design = settled(here, fit, sense);
      candidate.mechanism = design.mechanism;
      candidate.angles = design.angles;
      take(std::move(design), best[i]);
    };
    for (std::size_t i = 0; i < strokes.size(); ++i)
      for (SliderCandidate& candidate : followed)
        if (!stopped()) fit_at(i, candidate);
    for (std::size_t i = strokes.size() - 1; i-- > 0;) {
      if (stopped() || best[i + 1].angles.empty() || best[i + 1].sense != sense) continue;
      SliderCandidate neighbour{best[i + 1].mechanism, sense, best[i + 1].angles, 0};
      fit_at(i, neighbour);
    }
  }

  SliderPathSynthesis finish() {
    if (spare_ && !any_feasible()) out_.designs.push_back(std::move(*spare_));
    rank(out_.designs);
    if (any_feasible())
      std::erase_if(out_.designs, [](const SliderPathDesign& d) { return !d.violations.empty(); });
    if (out_.designs.size() > static_cast<std::size_t>(options_.max_solutions))
      out_.designs.resize(static_cast<std::size_t>(options_.max_solutions));
    if (out_.status == Status::done && !any_feasible()) out_.status = Status::infeasible;
    return std::move(out_);
  }

  const SliderPathProblem& problem_;
  const PathSynthesisOptions& options_;
  RunContext& context_;
  const SliderPathProblem relaxed_;
  struct {
    double from = 0, width = 1;
  } share_;  // of the progress, that the search under way has
  SliderPathSynthesis out_;
  std::optional<SliderPathDesign> spare_;  // the best start that meets the constraints
};

}  // namespace

SliderPathSynthesis synthesise_slider_path(const SliderPathProblem& problem,
                                           const PathSynthesisOptions& options, RunContext& context) {
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
