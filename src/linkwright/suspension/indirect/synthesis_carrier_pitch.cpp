// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/synthesis_carrier_pitch.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/suspension/indirect/link_fit_motion.h"

namespace linkwright::suspension {
namespace {

constexpr std::size_t polished_starts = 10;  // more starts gain little if errors stay above the tolerance
constexpr int tries_of_a_start = 500;        // random rods that leave the dyad apart are drawn again

void require_options(const CarrierPitchFitOptions& o) {
  LINKWRIGHT_REQUIRE(
      o.starts >= 1 && o.iterations >= 1 && o.final_iterations >= 1 && o.tolerance > 0 &&
          o.largest_carrier_pitch > 0 && o.distinct_links >= 0,
      "{} starts, {} and {} iterations, tolerance {} m, carrier pitch of at most {} rad, links {} m apart",
      o.starts, o.iterations, o.final_iterations, o.tolerance, o.largest_carrier_pitch, o.distinct_links);
}

/// A search for everything, with its memory.
class JointSearch {
 public:
  JointSearch(CornerErrors& problem, const CarrierPitchFitOptions& options)
      : problem_(problem), options_(options) {
    // The valleys are long, narrow and curved: metres of coordinates, micrometres of errors.
    local_.damping = math::Damping::identity;
    local_.geodesic_acceleration = true;
    local_.lambda0 = 1e-3;
    local_.lambda_success = 0.2;
    local_.decrease_tolerance = 0;
    local_.cost_tolerance = half_rows() * options.tolerance * options.tolerance;
    errors_.resize(problem.rows());
  }

  /// Searches from x; takes the end if it is the best so far. The root mean square there (m), infinite where
  /// nothing can be computed.
  double run(std::vector<double>& x, bool to_the_end, CarrierPitchFit& fit) {
    local_.max_iterations = to_the_end ? options_.final_iterations : options_.iterations;
    local_.relative_decrease_tolerance = to_the_end ? 1e-9 : 1e-7;
    const auto function = [&](std::span<const double> at, std::span<double> r, std::span<double> j) {
      return problem_.evaluate(at, r, j);
    };
    const auto report = math::minimise_least_squares(function, problem_.rows(), x, problem_.lower(),
                                                     problem_.upper(), local_, workspace_);
    fit.evaluations += report.evaluations;
    return report.status != Status::infeasible ? take(x, fit) : infinity;
  }
  double take(std::span<const double> x, CarrierPitchFit& fit) {
    if (!problem_.evaluate(x, errors_, {})) return infinity;
    const double rms = problem_.totals(errors_).rms();
    if (!(rms < fit.rms)) return rms;
    const std::vector<CornerLink> links = problem_.links();
    for (std::size_t a = 0; a < links.size(); ++a)
      for (std::size_t b = a + 1; b < links.size(); ++b)
        if (links[a].type == links[b].type && links[a].moved_by_rack == links[b].moved_by_rack &&
            largest_distance(links[a], links[b]) <= options_.distinct_links) {
          ++fit.refused;
          return infinity;
        }
    fit.rms = rms;
    fit.largest = problem_.totals(errors_).largest;
    fit.links = links;
    fit.couplers = problem_.couplers();
    fit.targets = problem_.targets();
    fit.link_errors.clear();
    fit.coupler_errors.clear();
    for (std::size_t l = 0; l < fit.links.size(); ++l)
      fit.link_errors.push_back(problem_.link_totals(l, errors_));
    for (std::size_t k = 0; k < fit.couplers.size(); ++k)
      fit.coupler_errors.push_back(problem_.coupler_totals(k, errors_));
    return rms;
  }
  bool can_begin(std::span<const double> x) { return problem_.evaluate(x, errors_, {}); }

 private:
  double half_rows() const { return static_cast<double>(problem_.rows()) / 2; }

  CornerErrors& problem_;
  CarrierPitchFitOptions options_;
  math::LeastSquaresOptions local_;
  math::LeastSquaresWorkspace workspace_;
  std::vector<double> errors_;
};

}  // namespace

CarrierPitchFit fit_with_unknown_carrier_pitch(const CarrierTargets& targets, std::span<const LinkTask> tasks,
                                               const CarrierPitchFitOptions& options, std::uint64_t seed,
                                               RunContext& context, std::span<const CouplerTask> couplers) {
  require_options(options);
  CornerErrors problem(targets, tasks, couplers, options.technique, options.largest_carrier_pitch);
  const std::size_t n = problem.unknowns();
  LINKWRIGHT_REQUIRE(n > 0, "nothing is unknown");
  JointSearch search(problem, options);
  CarrierPitchFit fit;
  fit.targets = targets;
  std::vector<double> x(n);
  const auto report = [&](double starts_done) {
    if (options.progress)
      context.report({.stage = "all links",
                      .fraction = starts_done / (options.starts + 1),
                      .best = fit.links.empty() ? nan : fit.rms});
  };
  // Each start as far as it takes to rank them, then one after the other to its end, the best first, until
  // one is good enough: which of them ends best, in narrow valleys cut off by limits, their ranks do not
  // show.
  struct End {
    double rms;
    std::vector<double> x;
  };
  std::vector<End> ends;
  for (int s = 0; s < options.starts && !(fit.rms <= options.tolerance); ++s) {
    RandomStream random({seed, 0, 0, static_cast<std::uint32_t>(s)});
    for (int tries = 0; tries < tries_of_a_start; ++tries) {
      for (std::size_t j = 0; j < n; ++j)
        x[j] = j < n - problem.carrier_pitch_unknowns()
                   ? random.uniform(problem.lower()[j], problem.upper()[j])
                   : 0;
      if (search.can_begin(x)) break;
    }
    ++fit.starts;
    if (const double rms = search.run(x, false, fit); std::isfinite(rms)) ends.push_back({rms, x});
    report(s + 1);
    if (context.interrupted()) break;
  }
  std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.rms < b.rms; });
  if (ends.size() > polished_starts) ends.resize(polished_starts);
  for (std::size_t k = 0; k < ends.size() && !(fit.rms <= options.tolerance) && !context.interrupted(); ++k) {
    search.run(ends[k].x, true, fit);
    report(options.starts + static_cast<double>(k + 1) / static_cast<double>(ends.size()));
  }
  if (!fit.links.empty()) fit.status = fit.rms <= options.tolerance ? Status::done : Status::not_converged;
  if (fit.status != Status::done && context.interrupted()) fit.status = context.interruption();
  return fit;
}

CarrierPitchFit fit_together(const CarrierTargets& targets, std::span<const LinkTask> tasks,
                             std::span<const CouplerTask> couplers, std::span<const CornerLink> start,
                             std::span<const Coupler> coupler_start, const CarrierPitchFitOptions& options) {
  require_options(options);
  CornerErrors problem(targets, tasks, couplers, options.technique, options.largest_carrier_pitch);
  LINKWRIGHT_REQUIRE(problem.unknowns() > 0, "nothing is unknown");
  LINKWRIGHT_REQUIRE(start.size() == tasks.size() && coupler_start.size() == couplers.size(),
                     "{} links and {} couplers to start {} and {} from", start.size(), coupler_start.size(),
                     tasks.size(), couplers.size());
  JointSearch search(problem, options);
  CarrierPitchFit fit;
  fit.targets = targets;
  fit.starts = 1;
  std::vector<double> x(problem.unknowns());
  problem.start_from(start, coupler_start, x);
  search.take(x, fit);
  search.run(x, true, fit);
  if (!fit.links.empty()) fit.status = fit.rms <= options.tolerance ? Status::done : Status::not_converged;
  return fit;
}

}  // namespace linkwright::suspension
