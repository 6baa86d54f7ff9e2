// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/designs.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/dyads/family.h"
#include "linkwright/planar/dyads/pose_fit.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

// Directions of the lines by which one condition, and two, are swept.
constexpr DyadSweep pose_sweep{.one = 120, .two = 18};
// Links and pivots nearer than this, times the size, are one.
constexpr double no_link = 1e-6;
// Swept designs whose four pivots are not this far apart in all, times the size, are one.
constexpr double same_swept = 0.6;
// The same of designs that were fitted from different starts.
constexpr double same_fitted = 1e-4;
// Sets of five poses from which a fit is started where nothing else is free of defects.
constexpr int random_starts = 120;
// Spread of the rotations at points from which a fit is started (rad).
constexpr double random_rotation = 0.4;
// Starts farther than this from the poses, times the size, are not fitted.
constexpr double near_start = 0.5;

bool wanted(const PoseProblem& p, const GuidingDyad& dyad) {
  return std::find(p.types.begin(), p.types.end(), dyad.type) != p.types.end();
}

// All dyads of one prescription that are allowed.
std::vector<GuidingDyad> family(const PoseProblem& p, std::size_t which, PoseAnswer& answer) {
  DyadFamily found = dyad_family(p.poses, p.pivots[which], pose_sweep);
  answer.solutions += found.solutions;
  answer.outside += found.outside;
  answer.dependent = answer.dependent || found.dependent;
  std::erase_if(found.dyads, [&](const GuidingDyad& dyad) { return !wanted(p, dyad); });
  return std::move(found.dyads);
}

// Two dyads that hold the body: not one twice, nor two that turn it about one point or shift it along one
// line.
bool makes_linkage(const GuidingDyad& a, const GuidingDyad& b, double size) {
  const bool pivots = a.type != GuidingDyadType::rp && b.type != GuidingDyadType::rp;
  if (pivots && std::abs(a.moving - b.moving) <= no_link * size) return false;
  const bool grounds = a.type != GuidingDyadType::pr && b.type != GuidingDyadType::pr;
  return !(grounds && std::abs(a.fixed - b.fixed) <= no_link * size);
}

double link_ratio(const GuidingDyad& a, const GuidingDyad& b) {
  if (a.type != GuidingDyadType::rr || b.type != GuidingDyadType::rr) return nan;
  const auto [least, most] =
      std::minmax({a.length, b.length, std::abs(a.moving - b.moving), std::abs(a.fixed - b.fixed)});
  return most / least;
}

bool better(const PoseDesign& a, const PoseDesign& b) {
  const bool fa = a.passage.defect == PoseDefect::none, fb = b.passage.defect == PoseDefect::none;
  if (fa != fb) return fa;
  if (a.cost != b.cost) return a.cost < b.cost;
  return a.passage.pair_angle > b.passage.pair_angle;
}

double distance_between(const PoseDesign& a, const PoseDesign& b) {
  const auto apart = [](const GuidingDyad& x, const GuidingDyad& y) {
    return x.type != y.type ? infinity
                            : std::abs(x.fixed - y.fixed) + std::abs(x.moving - y.moving) +
                                  std::abs(x.length - y.length) + std::abs(x.offset - y.offset);
  };
  return apart(a.driver, b.driver) + apart(a.other, b.other);
}

class Finder {
 public:
  Finder(const PoseProblem& problem, RunContext& context)
      : p_(problem), context_(context), size_(size_of_motion(problem.poses)) {}

  PoseAnswer find() {
    if (p_.exact)
      exact();
    else
      near();
    return sorted();
  }

  PoseAnswer of_pairs(std::span<const GuidedPair> pairs) {
    out_.pairs = static_cast<int>(pairs.size());
    const auto in = [&](const GuidingDyad& a, const GuidingDyad& b) {
      return in_regions(a, p_.pivots[0]) && in_regions(b, p_.pivots[1]);
    };
    for (const GuidedPair& pair : pairs) {
      if (!in(pair.first, pair.second) && !in(pair.second, pair.first))
        ++out_.outside;
      else if (wanted(p_, pair.first) && wanted(p_, pair.second))
        both(pair.first, pair.second, pair.poses, 0);
    }
    out_.status = context_.interruption();
    return sorted();
  }

 private:
  PoseAnswer sorted() {
    std::stable_sort(out_.designs.begin(), out_.designs.end(), better);
    thin();
    return std::move(out_);
  }

  void exact() {
    std::array<std::vector<GuidingDyad>, 2> families;
    const bool alike = !prescribes(p_.pivots[0]) && !prescribes(p_.pivots[1]);
    families[0] = family(p_, 0, out_);
    if (!alike) families[1] = family(p_, 1, out_);
    out_.swept = freedoms(p_, 0) > 0 || freedoms(p_, 1) > 0;
    if (out_.swept) out_.solutions = 0;
    out_.dyads = families[0];
    if (!alike) out_.dyads.insert(out_.dyads.end(), families[1].begin(), families[1].end());
    const std::vector<GuidingDyad>&first = families[0], &second = alike ? families[0] : families[1];
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (stopped(static_cast<double>(i) / static_cast<double>(first.size()))) return;
      for (std::size_t j = alike ? i + 1 : 0; j < second.size(); ++j) both(first[i], second[j], p_.poses, 0);
    }
  }

  void near() {
    const DyadFit fit = fit_dyads(p_.poses);
    out_.misfit = fit.misfit;
    out_.dyads = fit.dyads;
    pairs(fit.dyads);
    // The algebraic start is one; where it ends with a defect, or is unusable because rotations are missing,
    // five poses at a time give others: those that are met exactly and random ones, points at random
    // rotations.
    const std::size_t n = p_.poses.size();
    std::vector<std::size_t> exact, others;
    for (std::size_t k = 0; k < n; ++k) (demand_of(k).exact ? exact : others).push_back(k);
    const bool mixed = std::any_of(p_.demands.begin(), p_.demands.end(),
                                   [](const PoseDemand& d) { return d.exact || !d.angle; });
    for (int start = 0; start < random_starts && (mixed || out_.free == 0 || out_.designs.empty()); ++start) {
      if (stopped(static_cast<double>(start) / random_starts)) return;
      RandomStream random({.seed = 1, .individual = static_cast<std::uint32_t>(start)});
      std::vector<std::size_t> order = exact;
      std::vector<std::size_t> left = others;
      for (std::size_t k = 0; order.size() < 5; ++k) {
        std::swap(left[k], left[k + random.below(static_cast<std::uint32_t>(left.size() - k))]);
        order.push_back(left[k]);
      }
      std::vector<BodyPose> five;
      for (const std::size_t k : order) {
        five.push_back(p_.poses[k]);
        if (!demand_of(k).angle) five.back().angle += random_rotation * random.normal();
      }
      const GuidingDyads dyads = solve_dyads(five);
      pairs({dyads.real().begin(), dyads.real().end()});
    }
  }

  PoseDemand demand_of(std::size_t k) const { return p_.demands.empty() ? PoseDemand{} : p_.demands[k]; }

  // Fits every pair of dyads to the poses.
  void pairs(const std::vector<GuidingDyad>& dyads) {
    for (std::size_t i = 0; i < dyads.size(); ++i)
      for (std::size_t j = i + 1; j < dyads.size(); ++j) {
        const GuidingDyad &a = dyads[i], &b = dyads[j];
        if (context_.interrupted()) return;
        if (!wanted(p_, a) || !wanted(p_, b) || !makes_linkage(a, b, size_)) continue;
        if (spread_of(a) > near_start * size_ || spread_of(b) > near_start * size_) continue;
        const double length = p_.angle_length > 0 ? p_.angle_length : size_;
        PoseFit fit = fit_pair(p_.poses, a, b, length, p_.demands);
        ++out_.starts;
        if (!fit.converged || !makes_linkage(fit.first, fit.second, size_)) continue;
        both(fit.first, fit.second, fit.reached, fit.cost);
      }
  }

  // Spread over the poses whose rotation is known.
  double spread_of(const GuidingDyad& dyad) const {
    if (p_.demands.empty()) return spread(dyad, p_.poses);
    std::vector<BodyPose> poses;
    for (std::size_t k = 0; k < p_.poses.size(); ++k)
      if (demand_of(k).angle) poses.push_back(p_.poses[k]);
    return poses.empty() ? 0 : spread(dyad, poses);
  }

  // The linkage of two dyads by either drive.
  void both(const GuidingDyad& a, const GuidingDyad& b, const std::vector<BodyPose>& reached, double cost) {
    if (!makes_linkage(a, b, size_)) return;
    for (const bool turned : {false, true}) {
      PoseDesign design;
      design.driver = turned ? b : a;
      design.other = turned ? a : b;
      design.passage = passage(reached, design.driver, design.other);
      if (p_.drive_turns && !design.passage.drive_turns) {
        ++out_.swinging;
        continue;
      }
      ++out_.tried;
      ++out_.defects[static_cast<std::size_t>(design.passage.defect)];
      if (design.passage.defect == PoseDefect::none) ++out_.free;
      design.cost = cost;
      design.link_ratio = link_ratio(a, b);
      design.reached = reached;
      if (p_.exact) {
        for (const BodyPose& pose : reached)
          design.distance = std::max({design.distance, std::abs(gap(a, pose)), std::abs(gap(b, pose))});
      } else {
        for (std::size_t k = 0; k < reached.size(); ++k) {
          design.distance = std::max(design.distance, std::abs(reached[k].origin - p_.poses[k].origin));
          if (demand_of(k).angle)
            design.rotation =
                std::max(design.rotation, std::abs(math::wrap_angle(reached[k].angle - p_.poses[k].angle)));
        }
      }
      // Many designs of a sweep have the same defect: a few show which.
      if (out_.swept && design.passage.defect != PoseDefect::none && kept_defective_++ >= p_.max_designs)
        continue;
      out_.designs.push_back(std::move(design));
    }
  }

  void thin() {
    const double apart = size_ * (out_.swept ? same_swept : p_.exact ? 0 : same_fitted);
    std::vector<PoseDesign> kept;
    for (PoseDesign& design : out_.designs) {
      if (kept.size() == static_cast<std::size_t>(p_.max_designs)) break;
      if (std::none_of(kept.begin(), kept.end(),
                       [&](const PoseDesign& k) { return distance_between(k, design) < apart; }))
        kept.push_back(std::move(design));
    }
    out_.designs = std::move(kept);
  }

  bool stopped(double fraction) {
    out_.status = context_.interruption();
    if (out_.status != Status::done) return true;
    context_.report({"linkages", fraction, nan});
    return false;
  }

  const PoseProblem& p_;
  RunContext& context_;
  const double size_;
  int kept_defective_ = 0;
  PoseAnswer out_;
};

}  // namespace

int freedoms(const PoseProblem& problem, std::size_t dyad) {
  return open_numbers(problem.poses.size(), problem.pivots[dyad]);
}

PoseAnswer find_pose_designs(const PoseProblem& problem, RunContext& context) {
  for (const std::size_t dyad : {std::size_t{0}, std::size_t{1}})
    LINKWRIGHT_REQUIRE(
        !problem.exact || (freedoms(problem, dyad) >= 0 && freedoms(problem, dyad) <= max_open_numbers),
        "dyad {} has {} freedoms", dyad + 1, freedoms(problem, dyad));
  LINKWRIGHT_REQUIRE(problem.exact || problem.poses.size() >= 5, "{} poses", problem.poses.size());
  LINKWRIGHT_REQUIRE(problem.demands.empty() || problem.demands.size() == problem.poses.size(), "{} demands",
                     problem.demands.size());
  LINKWRIGHT_REQUIRE(std::count_if(problem.demands.begin(), problem.demands.end(),
                                   [](const PoseDemand& d) { return d.exact; }) <= max_exact_demands,
                     "more than {} poses are to be met exactly", max_exact_demands);
  return Finder(problem, context).find();
}

PoseAnswer pose_designs_of(const PoseProblem& problem, std::span<const GuidedPair> pairs,
                           RunContext& context) {
  return Finder(problem, context).of_pairs(pairs);
}

}  // namespace linkwright::planar
