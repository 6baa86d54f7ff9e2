// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_fit.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/dense.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/suspension/indirect/link_fit_direct.h"
#include "linkwright/suspension/indirect/link_fit_projected.h"

namespace linkwright::suspension {
namespace {

constexpr int projected_iterations = 150, direct_iterations = 60, final_iterations = 500;
constexpr double exact_cost = 1e-31;     // errors of some 1e-16 m at each position
constexpr double largest_damping = 1e3;  // steps a thousand times shorter: what they gain is rounding
constexpr double polished_rms = 1e-14;   // m: nothing left to gain
constexpr double rounded_rms = 1e-12;    // m: what exact positions leave
// Number of further searches for a link whose errors vanish to rounding: where positions determine a link
// poorly, places within the tolerance lie far from the link itself; a link whose errors vanish to rounding is
// looked for in so many searches more.
constexpr int further_starts = 32;

struct Errors {
  double rms = infinity, largest = rms;
};

/// One search for a link, with its memory.
class Search {
 public:
  Search(const LinkMotion& motion, const LinkCoordinates& unknowns)
      : motion_(motion), unknowns_(unknowns), projection_(motion, unknowns.middle(), unknowns.columns()) {
    rows_ = error_rows(unknowns.middle().type, motion.size());
    errors_.resize(rows_);
    for (const int place : projection_.unknowns()) {
      lower_.push_back(unknowns.lower(place));
      upper_.push_back(unknowns.upper(place));
    }
    for (const int place : unknowns.free()) {
      all_lower_.push_back(unknowns.lower(place));
      all_upper_.push_back(unknowns.upper(place));
    }
  }

  bool can_project() const { return projection_.applicable(); }
  std::int64_t evaluations() const { return evaluations_; }

  Errors errors(const CornerLink& link) {
    Errors e;
    if (!structural_errors(motion_, link, errors_, unknowns_.columns(), {})) return e;
    const std::size_t n = motion_.size(),
                      parts = rows_ / (static_cast<std::size_t>(error_count(link.type)) * n);
    double sum = 0;
    e.largest = 0;
    for (std::size_t i = 0; i < rows_; i += parts) {
      double square = 0;
      for (std::size_t k = 0; k < parts; ++k) square += errors_[i + k] * errors_[i + k];
      sum += square;
      e.largest = std::max(e.largest, std::sqrt(square));
    }
    const std::size_t places = rows_ / parts;
    e.rms = std::sqrt(sum / static_cast<double>(places));
    return e;
  }

  /// Variable projection from `link`, whose eliminated points do not matter; as a polish it continues to
  /// rounding, across bounds.
  bool project(CornerLink& link, bool polish) {
    x_.clear();
    for (const int place : projection_.unknowns()) x_.push_back(unknowns_.get(link, place));
    math::LeastSquaresOptions o;
    o.max_iterations = polish ? final_iterations : projected_iterations;
    o.lambda0 = polish ? 1e-9 : 1e-3;
    o.lambda_success = 0.1;
    o.lambda_max = largest_damping;
    o.decrease_tolerance = 0;
    o.relative_decrease_tolerance = polish ? 1e-8 : 1e-5;
    o.cost_tolerance = exact_cost;
    const auto function = [&](std::span<const double> x, std::span<double> r, std::span<double> j) {
      return projection_.evaluate(x, r, j);
    };
    const auto report = math::minimise_least_squares(
        function, projection_.rows(), x_, polish ? std::span<const double>() : lower_,
        polish ? std::span<const double>() : upper_, o, workspace_);
    evaluations_ += report.evaluations;
    if (report.status == Status::infeasible || !projection_.evaluate(x_, workspace_residuals(), {}))
      return false;
    link = projection_.link();
    return true;
  }

  /// All unknowns within the boxes.
  bool fit(CornerLink& link, int iterations) {
    if (unknowns_.free().empty()) return true;  // a given link is what it is
    x_.clear();
    for (const int place : unknowns_.free()) x_.push_back(unknowns_.get(link, place));
    math::LeastSquaresOptions o;
    o.max_iterations = iterations;
    o.lambda_success = 0.1;
    o.lambda_max = largest_damping;
    o.decrease_tolerance = 0;
    o.relative_decrease_tolerance = 1e-5;
    o.cost_tolerance = exact_cost;
    CornerLink trial = link;
    const auto place_all = [&](CornerLink& to, std::span<const double> x) {
      for (std::size_t j = 0; j < x.size(); ++j) unknowns_.set(to, unknowns_.free()[j], x[j]);
    };
    const auto function = [&](std::span<const double> x, std::span<double> r, std::span<double> j) {
      place_all(trial, x);
      return structural_errors(motion_, trial, r, unknowns_.columns(), j);
    };
    const auto report =
        math::minimise_least_squares(function, rows_, x_, all_lower_, all_upper_, o, workspace_);
    evaluations_ += report.evaluations;
    if (report.status == Status::infeasible) return false;
    place_all(link, x_);
    return true;
  }

 private:
  std::span<double> workspace_residuals() {
    scratch_.resize(projection_.rows());
    return scratch_;
  }

  const LinkMotion& motion_;
  const LinkCoordinates& unknowns_;
  LinkProjection projection_;
  std::size_t rows_ = 0;
  std::vector<double> errors_, lower_, upper_, all_lower_, all_upper_, x_, scratch_;
  math::LeastSquaresWorkspace workspace_;
  std::int64_t evaluations_ = 0;
};

/// Gathers what searches for a link end in.
class LinkSearch {
 public:
  LinkSearch(const CarrierTargets& targets, const LinkTask& task, const LinkFitOptions& options,
             std::span<const CornerLink> known, const LinkMotion& motion)
      : origin_(targets.wheel.centre),
        options_(options),
        unknowns_(task, origin_),
        search_(motion, unknowns_) {
    for (const CornerLink& link : known)
      if (link.type == task.type && link.moved_by_rack == task.moved_by_rack)
        known_.push_back(shifted(link, -origin_));
    fit_.link = unknowns_.middle();
  }

  const LinkCoordinates& unknowns() const { return unknowns_; }
  bool found() const {
    return fit_.rms <= rounded_rms || (first_exact_ >= 0 && fit_.starts >= first_exact_ + further_starts);
  }

  /// Takes a link as it is.
  void take(const CornerLink& link) {
    link_ = link;
    consider();
  }
  /// Searches from a link: by projection first if so wanted.
  void start(const CornerLink& from, bool project) {
    ++fit_.starts;
    link_ = from;
    if (project && search_.can_project()) {
      if (!search_.project(link_, false) || !unknowns_.inside(link_)) return;
      consider();
      if (found()) return;
    }
    if (search_.fit(link_, direct_iterations)) consider();
  }
  LinkFit finish(RunContext& context) {
    if (fit_.starts > 0 && std::isfinite(fit_.rms) && fit_.rms > options_.tolerance) {
      link_ = fit_.link;
      if (search_.fit(link_, final_iterations)) consider();
    }
    const Status interruption = context.interruption();
    if (std::isfinite(fit_.rms))
      fit_.status = fit_.rms <= options_.tolerance ? Status::done : Status::not_converged;
    if (fit_.status != Status::done && interruption != Status::done) fit_.status = interruption;
    fit_.evaluations = search_.evaluations();
    fit_.link = shifted(fit_.link, origin_);
    return fit_;
  }

 private:
  bool is_known(const CornerLink& link) const {
    return std::any_of(known_.begin(), known_.end(), [&](const CornerLink& other) {
      return largest_distance(other, link) <= options_.same_point;
    });
  }
  void consider() {  // takes link_ if it is the best so far
    if (!unknowns_.inside(link_)) return;
    Errors e = search_.errors(link_);
    const bool exact = e.rms <= options_.tolerance;
    if (exact && e.rms > polished_rms && search_.can_project()) {
      const CornerLink before = link_;
      Errors after;
      if (search_.project(link_, true) && unknowns_.inside(link_)) after = search_.errors(link_);
      if (after.rms < e.rms)
        e = after;
      else
        link_ = before;
    }
    if (exact && is_known(link_)) {
      ++fit_.duplicates;
      return;
    }
    if (e.rms < fit_.rms) {
      fit_.rms = e.rms;
      fit_.largest = e.largest;
      fit_.link = link_;
    }
    if (exact && first_exact_ < 0) first_exact_ = fit_.starts;
  }

  Vec3 origin_;
  LinkFitOptions options_;
  LinkCoordinates unknowns_;
  Search search_;
  std::vector<CornerLink> known_;
  CornerLink link_;
  LinkFit fit_;
  int first_exact_ = -1;
};

LinkMotion motion_for(const CarrierTargets& targets, const LinkTask& task, const LinkFitOptions& options) {
  LINKWRIGHT_REQUIRE(options.starts >= 1 && options.tolerance > 0 && options.same_point >= 0,
                     "{} starts, tolerance {} m, same point within {} m", options.starts, options.tolerance,
                     options.same_point);
  LinkMotion motion = link_motion(targets, task.moved_by_rack, targets.wheel.centre);
  LINKWRIGHT_REQUIRE(motion.size() >= 1, "link '{}': no position besides the reference", task.name);
  return motion;
}

}  // namespace

LinkFit fit_link(const CarrierTargets& targets, const LinkTask& task, const LinkFitOptions& options,
                 std::span<const CornerLink> known, std::uint64_t seed, RunContext& context,
                 std::uint32_t run) {
  const LinkMotion motion = motion_for(targets, task, options);
  LinkSearch search(targets, task, options, known, motion);
  const LinkCoordinates& unknowns = search.unknowns();
  if (unknowns.free().empty()) {
    search.take(unknowns.middle());
    return search.finish(context);
  }
  // The first start always runs.
  for (int s = 0; s < options.starts && !search.found() && (s == 0 || !context.interrupted()); ++s) {
    RandomStream random({seed, run, 0, static_cast<std::uint32_t>(s)});
    CornerLink link = unknowns.middle();
    for (const int place : unknowns.free())
      LinkCoordinates::set(link, place, random.uniform(unknowns.lower(place), unknowns.upper(place)));
    search.start(link, s % 2 == 0);
  }
  return search.finish(context);
}

LinkFit fit_link_from(std::span<const CornerLink> starts, const CarrierTargets& targets, const LinkTask& task,
                      const LinkFitOptions& options, std::span<const CornerLink> known, RunContext& context) {
  const LinkMotion motion = motion_for(targets, task, options);
  LinkSearch search(targets, task, options, known, motion);
  for (const CornerLink& start : starts) {
    const CornerLink link = shifted(start, -targets.wheel.centre);
    if (search.found() || context.interrupted()) break;
    if (link.type == task.type && search.unknowns().inside(link)) search.start(link, false);
  }
  return search.finish(context);
}

LinkConditioning conditioning(const CarrierTargets& targets, const LinkTask& task, const CornerLink& link) {
  const LinkMotion motion = link_motion(targets, task.moved_by_rack, targets.wheel.centre);
  const LinkCoordinates unknowns(task, targets.wheel.centre);
  LINKWRIGHT_REQUIRE(link.type == task.type && link.body.size() == task.body.size() &&
                         link.carrier.size() == task.carrier.size(),
                     "link '{}': {} with {} and {} points for a task of type {}", task.name,
                     name_of(link.type), link.body.size(), link.carrier.size(), name_of(task.type));
  const std::size_t rows = error_rows(task.type, motion.size()), n = unknowns.free().size();
  std::vector<double> errors(rows), jacobian(rows * n);
  LinkConditioning found;
  found.weakest = unknowns.middle();
  for (Vec3& p : found.weakest.body) p = {};
  for (Vec3& p : found.weakest.carrier) p = {};
  if (n == 0 || rows == 0 ||
      !structural_errors(motion, shifted(link, -targets.wheel.centre), errors, unknowns.columns(), jacobian))
    return found;
  const math::SingularVectors svd = math::singular_vectors(jacobian, n);
  found.singular_values = svd.values;
  found.singular_values.resize(n, 0.0);
  for (std::size_t k = 0; k < n; ++k)
    LinkCoordinates::set(found.weakest, unknowns.free()[k], svd.right[(n - 1) * n + k]);
  return found;
}

double fewest_positions(int unknowns, int equations, int pose_parameters, bool lengths_given) {
  LINKWRIGHT_REQUIRE(unknowns >= 0 && equations >= 0 && pose_parameters >= 0 && pose_parameters <= 6,
                     "{} unknowns, {} equations, {} pose parameters", unknowns, equations, pose_parameters);
  const int gained = equations + pose_parameters - 6;
  if (gained <= 0) return infinity;
  return static_cast<double>(unknowns) / gained + (lengths_given ? 0 : 1);
}

}  // namespace linkwright::suspension
