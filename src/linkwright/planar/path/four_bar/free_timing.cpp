// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/free_timing.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/four_bar/assignment.h"
#include "linkwright/planar/path/four_bar/fit.h"
#include "linkwright/planar/path/four_bar/starts.h"
#include "linkwright/planar/path/search.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

constexpr int usual_starts = 40;           // local searches per kind, branch and sense
constexpr int linkages_per_start = 48;     // random curves of which the best match starts a search
constexpr std::size_t coarse_points = 28;  // most points that take part in the starts
constexpr std::size_t continued = 24;      // starts per kind, branch and sense that go on to their end
constexpr std::size_t chains = 4;          // number of those in each sense that the search hops from
constexpr int hops_per_start = 2;          // hops of a chain, for each start per kind, branch and sense
constexpr std::size_t finished = 16;       // answers that go on to all points

// Random streams of the chains, beyond those of the kinds, branches and senses.
constexpr std::uint32_t first_chain = 1000;

// Local searches: of a start, of a hop, with all points, to the end.
constexpr PathFitOptions start_search{.iterations = 60, .passes = 1, .decrease = 1e-5};
constexpr PathFitOptions continued_search{.iterations = 200, .passes = 30, .decrease = 1e-9};
constexpr PathFitOptions hop_search{.iterations = 60, .passes = 3, .decrease = 1e-6};
constexpr PathFitOptions full_search{.iterations = 100, .passes = 30, .decrease = 1e-9};
// Long narrow valleys need many steps, of O(points) each.
PathFitOptions last_search(std::size_t points) {
  return {
      .iterations = std::clamp(static_cast<int>(60000 / points), 400, 3000), .passes = 30, .decrease = 1e-12};
}

// Every so many-th target, so that about `count` are left.
PathProblem thinned(const PathProblem& p, std::size_t count) {
  const std::size_t n = p.x.size();
  if (n <= count) return p;
  PathProblem out = p;
  const auto thin = [&](std::vector<double>& values) {
    if (values.empty()) return;
    std::vector<double> kept(count);
    for (std::size_t i = 0; i < count; ++i)
      kept[i] = values[p.closed ? i * n / count : i * (n - 1) / (count - 1)];
    values = std::move(kept);
  };
  for (auto* values : {&out.x, &out.y, &out.gate_x, &out.gate_y, &out.tolerance}) thin(*values);
  return out;
}

// Merit: mean squared miss as a share of the squared size, with soft violations.
using TimedCandidate = PathCandidate<FourBar>;

bool alike(const TimedCandidate& a, const TimedCandidate& b) {
  if (a.sense != b.sense || a.linkage.branch != b.linkage.branch) return false;
  if (std::abs(a.merit - b.merit) > 1e-3 * std::max(a.merit, b.merit)) return false;
  const auto near = [](double x, double y) { return std::abs(x - y) <= 0.05 * std::max(x, y); };
  return near(a.linkage.ground, b.linkage.ground) && near(a.linkage.crank, b.linkage.crank) &&
         near(a.linkage.coupler, b.linkage.coupler) && near(a.linkage.rocker, b.linkage.rocker);
}

class TimingSearch : PathSearch<FourBarPath> {
 public:
  TimingSearch(const PathProblem& problem, const PathSynthesisOptions& options, RunContext& context)
      : PathSearch(problem, options, context), coarse_(thinned(problem, coarse_points)) {}

  PathSynthesis run() {
    start();
    finish();
    return std::move(out_);
  }

 private:
  int count() const { return starts(usual_starts); }

  TimedCandidate fitted(PathFitter& fitter, const PathProblem& problem, const FourBar& start,
                        const std::vector<double>& angles, double sense, const PathFitOptions& how) {
    const PathFit fit = fitter.fit(start, angles, how);
    out_.evaluations += fit.evaluations;
    TimedCandidate c{fit.linkage, sense, fit.angles, infinity};
    if (!std::isfinite(fit.error)) return c;
    const double size = path_size(problem_);
    c.merit =
        fit.error / (size * size * static_cast<double>(problem.x.size())) + fit.violation * fit.violation;
    // The error of a thinned path says nothing about all points.
    if (&problem == &problem_ && fit.violation <= tolerance::feasibility) note(fit.error);
    return c;
  }

  void start() {
    std::vector<RatioKind> kinds = {RatioKind::crank_rocker, RatioKind::double_crank};
    if (!problem_.crank_rotates_fully) kinds = {RatioKind::any};
    const auto all_searches = crank_searches(problem_);
    const int all = count() * static_cast<int>(all_searches.size() * kinds.size());
    std::uint32_t combination = 0;
    int told = 0;
    for (const auto& [branch, sense] : all_searches) {
      PathFitter fitter(coarse_, sense);
      PathMatcher matcher(coarse_, branch, sense);
      for (RatioKind kind : kinds) {
        std::vector<TimedCandidate> found;
        for (int start = 0; start < count() && !stopped(); ++start) {
          RandomStream random = stream(combination, start);
          const auto match = matcher.best_of(linkages_per_start, kind, random);
          if (match) {
            TimedCandidate c = fitted(fitter, coarse_, match->linkage, match->angles, sense, start_search);
            if (std::isfinite(c.merit)) found.push_back(std::move(c));
          }
          tell(0.7 * ++told / all);
        }
        for (TimedCandidate& start : distinct(std::move(found), continued)) {
          if (stopped() && !found_.empty()) break;
          TimedCandidate c = fitted(fitter, coarse_, start.linkage, start.angles, sense, continued_search);
          found_.push_back(std::isfinite(c.merit) ? std::move(c) : std::move(start));
        }
        ++combination;
      }
    }
  }

  // Best first, each kind of answer once, `most` at most.
  static std::vector<TimedCandidate> distinct(std::vector<TimedCandidate> all, std::size_t most) {
    std::stable_sort(all.begin(), all.end(),
                     [](const TimedCandidate& a, const TimedCandidate& b) { return a.merit < b.merit; });
    std::vector<TimedCandidate> out;
    for (TimedCandidate& c : all) {
      if (out.size() == most) break;
      if (std::none_of(out.begin(), out.end(), [&](const TimedCandidate& o) { return alike(o, c); }))
        out.push_back(std::move(c));
    }
    return out;
  }

  // A linkage near another one, laid on the path: link ratios and tracing point changed by about `share`, the
  // crank angles moved along, scale and place fitted to them. Nothing when it does not assemble.
  std::optional<TimedCandidate> hop_from(const TimedCandidate& c, double share, RandomStream& stream) const {
    FourBar l = c.linkage;
    l.ground *= std::exp(share * stream.normal());
    l.coupler *= std::exp(share * stream.normal());
    l.rocker *= std::exp(share * stream.normal());
    const Complex point = Complex(l.coupler_u, l.coupler_v) / l.coupler;
    const double reach = share * std::max(0.3, std::abs(point));
    const double du = reach * stream.normal(), dv = reach * stream.normal();
    l.coupler_u += l.coupler * du;
    l.coupler_v += l.coupler * dv;
    const double turn = share * stream.normal(), stretch = 1 + 0.5 * share * stream.uniform(-1, 1);
    std::vector<double> angles = c.angles;
    const double middle = 0.5 * (angles.front() + angles.back());
    for (double& angle : angles) angle = middle + turn + (problem_.closed ? 1 : stretch) * (angle - middle);

    l.pivot_x = l.pivot_y = l.frame_angle = 0;
    const std::size_t n = angles.size();
    std::vector<Complex> z(n);
    Complex mean = 0, target = 0;
    for (std::size_t k = 0; k < n; ++k) {
      z[k] = position(l, angles[k]).coupler_point;
      if (std::isnan(z[k].real())) return std::nullopt;
      mean += z[k];
      target += Complex(coarse_.x[k], coarse_.y[k]);
    }
    mean /= static_cast<double>(n);
    target /= static_cast<double>(n);
    Complex product = 0;
    double square = 0;
    for (std::size_t k = 0; k < n; ++k) {
      product += std::conj(z[k] - mean) * (Complex(coarse_.x[k], coarse_.y[k]) - target);
      square += std::norm(z[k] - mean);
    }
    const Complex a = product / square;
    const double scale = std::abs(a);
    if (!(scale > 1e-9 && scale < 1e9)) return std::nullopt;
    for (double FourBar::*m : {&FourBar::ground, &FourBar::crank, &FourBar::coupler, &FourBar::rocker,
                               &FourBar::coupler_u, &FourBar::coupler_v})
      l.*m *= scale;
    const Complex pivot = target - a * mean;
    l.pivot_x = pivot.real();
    l.pivot_y = pivot.imag();
    l.frame_angle = std::arg(a);
    return TimedCandidate{l, c.sense, std::move(angles), infinity};
  }

  void finish() {
    PathFitter coarse_forth(coarse_, 1), coarse_back(coarse_, -1), full_forth(problem_, 1),
        full_back(problem_, -1);
    const auto coarse = [&](double sense) -> PathFitter& { return sense > 0 ? coarse_forth : coarse_back; };
    const auto full = [&](double sense) -> PathFitter& { return sense > 0 ? full_forth : full_back; };

    const int hops = hops_per_start * count();
    std::vector<TimedCandidate> best = distinct(std::move(found_), 2 * finished);
    std::uint32_t chain = 0;
    std::size_t forth = 0, back = 0;
    for (std::size_t i = 0; i < best.size(); ++i) {
      TimedCandidate& c = best[i];
      if (++(c.sense > 0 ? forth : back) > chains) continue;
      ++chain;
      for (int hop = 0; hop < hops && !stopped(); ++hop) {
        RandomStream random = stream(first_chain + chain, hop);
        const double share = 0.02 * std::exp(random.uniform(0, 3.5));
        const auto start = hop_from(c, share, random);
        if (!start) continue;
        TimedCandidate other =
            fitted(coarse(c.sense), coarse_, start->linkage, start->angles, c.sense, hop_search);
        if (other.merit < c.merit * (1 - 1e-6)) c = std::move(other);
        tell(0.7 + 0.2 * (chain - 1 + static_cast<double>(hop) / hops) / (2 * chains));
      }
    }
    best = distinct(std::move(best), finished);
    // To all points.
    std::vector<PathDesign> designs;
    for (const TimedCandidate& c : best) {
      if (stopped() && !out_.designs.empty()) break;
      std::vector<double> angles = c.angles;
      if (angles.size() != problem_.x.size()) {
        const auto assigned = assign_crank_angles(problem_, c.linkage, c.sense, c.angles[0]);
        if (!assigned) continue;
        angles = assigned->angles;
      }
      const TimedCandidate all = fitted(full(c.sense), problem_, c.linkage, angles, c.sense, full_search);
      if (!std::isfinite(all.merit)) continue;
      out_.designs.push_back(measure(problem_, all.linkage, c.sense, all.angles));
    }
    rank(out_.designs);
    const std::size_t most = static_cast<std::size_t>(options_.max_solutions);
    for (std::size_t i = 0; i < std::min(most, out_.designs.size()) && !stopped(); ++i) {
      out_.designs[i] = polish_free_timing(problem_, std::move(out_.designs[i]), out_.evaluations);
      if (out_.designs[i].violations.empty()) note(out_.designs[i].error);
      tell(0.95);
    }
  }

  const PathProblem coarse_;
  std::vector<TimedCandidate> found_;
};

// A problem and those with more limits, each searched by itself in the same way, and each going on from the
// best that those with one limit more have come to: so none of them has a better answer than the problem.
class LadderOfLimits {
 public:
  LadderOfLimits(const PathProblem& problem, const PathSynthesisOptions& options, RunContext& context)
      : problem_(problem), options_(options), context_(context) {}

  PathSynthesis run() { return answer(problem_.crank_rotates_fully, false); }

 private:
  // The answer with or without the full turn of the crank; `transmits` adds the usual transmission angle.
  PathSynthesis& answer(bool turns, bool transmits) {
    const auto [entry, fresh] = answers_.try_emplace({turns, transmits});
    PathSynthesis& out = entry->second;
    if (!fresh) {
      out.evaluations = 0;  // counted already
      return out;
    }
    PathProblem limited = problem_;
    limited.crank_rotates_fully = turns;
    if (transmits) limited.min_transmission_angle = usual_transmission;
    PathSynthesisOptions options = options_;
    options.progress = options.progress && answers_.size() == 1;
    out = TimingSearch(limited, options, context_).run();
    if (!turns) throw_if_interrupted(limited, answer(true, transmits), out);
    if (!transmits && problem_.min_transmission_angle < usual_transmission)
      throw_if_interrupted(limited, answer(turns, true), out);
    rank(out.designs);
    return out;
  }

  void throw_if_interrupted(const PathProblem& problem, const PathSynthesis& limited, PathSynthesis& out) {
    if (limited.status == Status::deadline || limited.status == Status::cancelled)
      out.status = limited.status;
    out.evaluations += limited.evaluations;
    std::size_t carried_on = 0;
    for (const PathDesign& found : limited.designs) {
      PathDesign design = measure(problem, found.linkage, found.sense, found.angles);
      if (carried_on++ < carried_beyond_limits && out.status == Status::done)
        out.designs.push_back(polish_free_timing(problem, design, out.evaluations));
      out.designs.push_back(std::move(design));
    }
    for (const PathDesign& design : out.designs)
      if (design.violations.empty() && (out.history.empty() || design.error < out.history.back().best))
        out.history.push_back({out.evaluations, design.error});
  }

  const PathProblem& problem_;
  const PathSynthesisOptions& options_;
  RunContext& context_;
  std::map<std::pair<bool, bool>, PathSynthesis> answers_;
};

}  // namespace

PathSynthesis search_free_timing(const PathProblem& problem, const PathSynthesisOptions& options,
                                 RunContext& context) {
  require_valid(problem);
  LINKWRIGHT_REQUIRE(problem.free_timing(), "the timing is {}", name_of(problem.timing));
  return LadderOfLimits(problem, options, context).run();
}

PathDesign polish_free_timing(const PathProblem& problem, PathDesign design, std::int64_t& evaluations) {
  LINKWRIGHT_REQUIRE(problem.free_timing(), "the timing is {}", name_of(problem.timing));
  PathFitter fitter(problem, design.sense);
  const auto better = [](const PathDesign& a, const PathDesign& b) {
    const double va = total_violation(a), vb = total_violation(b);
    return optimise::better(a.error, va, b.error, vb) &&
           (va != vb || a.error < b.error * (1 - tolerance::equal_cost));
  };
  const auto search = [&](const std::vector<double>& angles) {
    const PathFit fit = fitter.fit(design.linkage, angles, last_search(problem.x.size()));
    evaluations += fit.evaluations;
    if (!std::isfinite(fit.error)) return false;
    PathDesign found = measure(problem, fit.linkage, design.sense, fit.angles);
    if (!better(found, design)) return false;
    design = std::move(found);
    return true;
  };
  search(design.angles);
  constexpr int max_rounds = 20;
  for (int round = 0; round < max_rounds; ++round) {
    const auto assigned = assign_crank_angles(problem, design.linkage, design.sense, design.angles[0]);
    if (!assigned || !search(assigned->angles)) break;
  }
  return design;
}

}  // namespace linkwright::planar
