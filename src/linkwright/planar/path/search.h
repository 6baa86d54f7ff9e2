// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/core/run_context.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/planar/path/local_fit.h"
#include "linkwright/planar/path/mechanism.h"
#include "linkwright/planar/path/task.h"

// The parts of the search that path syntheses of all mechanisms share.
namespace linkwright::planar {

/// Local searches by the separable form of a problem, in its few nonlinear unknowns.
template <class Projection>
class SeparableSearch {
 public:
  explicit SeparableSearch(Projection projection, double size)
      : projection_(std::move(projection)), size_(size), residual_(projection_.residuals()) {
    local_.step_clip = 2;
    local_.damping = math::Damping::identity;
    local_.decrease_tolerance = 1e-13;
  }

  Projection& projection() { return projection_; }

  /// Best of a few random unknowns; empty when none evaluates.
  std::vector<double> start(RandomStream& stream, std::int64_t& evaluations) {
    constexpr int tries = 6;
    std::vector<double> best;
    double lowest = infinity;
    for (int attempt = 0; attempt < tries; ++attempt) {
      std::vector<double> q = projection_.random(stream);
      ++evaluations;
      if (!projection_.evaluate(q, residual_, {})) continue;
      double sum = 0;
      for (double r : residual_) sum += r * r;
      if (sum < lowest) lowest = sum, best = std::move(q);
    }
    return best;
  }

  /// Error (m2) at the end of a local search from q; infinite when q does not evaluate.
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
  Projection projection_;
  double size_;
  std::vector<double> residual_;
  math::LeastSquaresWorkspace workspace_;
  math::LeastSquaresOptions local_;
};

/// A linkage on its way to a design.
template <class Linkage>
struct PathCandidate {
  Linkage linkage;
  double sense = 1;
  std::vector<double> angles;
  double merit = infinity;  ///< less is better: the error, with soft violations of the constraints
};

/// A search for designs: its answer so far, random streams, progress, and how candidates become designs.
template <PathMechanism M>
class PathSearch {
 protected:
  using Problem = typename M::Problem;
  using Design = typename M::Design;

  using Candidate = PathCandidate<typename M::Linkage>;

  PathSearch(const Problem& problem, const PathSynthesisOptions& options, RunContext& context)
      : problem_(problem), options_(options), context_(context) {}

  bool stopped() {
    if (out_.status == Status::done) out_.status = context_.interruption();
    return out_.status != Status::done;
  }
  bool any_feasible() const {
    return std::any_of(out_.designs.begin(), out_.designs.end(),
                       [](const Design& d) { return d.violations.empty(); });
  }
  int starts(int usual) const { return options_.starts > 0 ? options_.starts : usual; }
  RandomStream stream(std::uint32_t combination, int start, std::uint32_t part = 0) const {
    return RandomStream({.seed = options_.seed,
                         .run = combination,
                         .generation = part,
                         .individual = static_cast<std::uint32_t>(start)});
  }
  double best_so_far() const { return out_.history.empty() ? infinity : out_.history.back().best; }
  void tell(double fraction) {
    if (options_.progress)
      context_.report({.stage = "recommended",
                       .fraction = std::min(1.0, share_.from + share_.width * fraction),
                       .best = best_so_far()});
  }
  void note(double feasible_error) {
    if (feasible_error < best_so_far()) out_.history.push_back({out_.evaluations, feasible_error});
  }
  void keep(Design design) { keep_distinct(out_.designs, std::move(design)); }

  // Ends of local searches by the separable form, in a sense.
  template <class Projection>
  std::vector<Candidate> separable(SeparableSearch<Projection> search, double sense,
                                   std::uint32_t combination, int count) {
    std::vector<Candidate> found;
    for (int start = 0; start < count && !stopped(); ++start) {
      RandomStream random = stream(combination, start);
      std::vector<double> q = search.start(random, out_.evaluations);
      if (q.empty() || !std::isfinite(search.descend(q, out_.evaluations))) continue;
      const Design design = search.projection().design(problem_, q);
      if (design.violations.empty()) note(design.error);
      found.push_back({design.linkage, sense, design.angles, design.error});
      tell(static_cast<double>(start + 1) / count);
    }
    return found;
  }

  // The distinct ones, best first, at most `most`.
  static std::vector<Candidate> distinct(std::vector<Candidate> found, std::size_t most) {
    std::sort(found.begin(), found.end(),
              [](const Candidate& a, const Candidate& b) { return a.merit < b.merit; });
    std::vector<Candidate> taken;
    for (Candidate& candidate : found) {
      if (taken.size() >= most) break;
      if (std::none_of(taken.begin(), taken.end(),
                       [&](const Candidate& c) { return same_linkage(c.linkage, candidate.linkage); }))
        taken.push_back(std::move(candidate));
    }
    return taken;
  }

  // Designs of prescribed timing that meet everything are taken as they are. The others go through the
  // constrained search, as do those that the separable form has brought to points that are gates or have
  // tolerances; settled(fit, sense) is the design that comes of that.
  template <class Fitter, class Settled>
  void finish_candidates(std::vector<Candidate> found, std::size_t most, double sense, Settled&& settled) {
    Fitter fitter(problem_, sense);
    for (const Candidate& candidate : distinct(std::move(found), most)) {
      if (!problem_.free_timing()) {
        Design design = measure(problem_, candidate.linkage, sense, candidate.angles);
        if (design.violations.empty() && !has_bands(problem_)) {
          keep(std::move(design));
          continue;
        }
        if (!design.violations.empty()) lowest_failed_ = std::min(lowest_failed_, candidate.merit);
      }
      if (stopped() && !out_.designs.empty()) break;
      const auto fit = fitter.fit(candidate.linkage, candidate.angles, {.iterations = 200, .passes = 30});
      out_.evaluations += fit.evaluations;
      if (!std::isfinite(fit.error)) continue;
      Design design = settled(fit, sense);
      if (design.violations.empty()) note(design.error);
      keep(std::move(design));
    }
  }

  // Ranked; infeasible designs only where there are no others.
  PathAnswer<M> finish() {
    rank(out_.designs);
    if (any_feasible()) std::erase_if(out_.designs, [](const Design& d) { return !d.violations.empty(); });
    if (out_.status == Status::done && !any_feasible()) out_.status = Status::infeasible;
    return std::move(out_);
  }

  const Problem& problem_;
  const PathSynthesisOptions& options_;
  RunContext& context_;
  struct {
    double from = 0, width = 1;
  } share_;                          // share of the progress that belongs to the search under way
  double lowest_failed_ = infinity;  // error of a candidate beyond some limit
  PathAnswer<M> out_;
};

}  // namespace linkwright::planar
