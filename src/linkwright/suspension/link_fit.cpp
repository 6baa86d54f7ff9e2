#include "linkwright/suspension/link_fit.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/suspension/link_fit_direct.h"
#include "linkwright/suspension/link_fit_projected.h"

namespace linkwright::suspension {
namespace {

constexpr double in_box = 1e-9;  // m: a point this far outside is at the bound
constexpr int projected_iterations = 150, direct_iterations = 60, final_iterations = 500;
constexpr double exact_cost = 1e-31;     // errors of some 1e-16 m at each position
constexpr double largest_damping = 1e3;  // steps a thousand times shorter: what they gain is rounding
constexpr double polished_rms = 1e-14;   // m: nothing left to gain
constexpr double rounded_rms = 1e-12;    // m: what exact positions leave
// Where positions determine a link poorly, places within the tolerance lie far from the link itself; a link
// whose errors vanish to rounding is looked for in so many searches more.
constexpr int further_starts = 32;

double component(const Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

/// The unknown coordinates of a link: boxes and columns, coordinates taken from `origin`.
struct Unknowns {
  GuideLink middle;  ///< of the boxes
  std::vector<int> columns;
  std::vector<double> lower, upper;  ///< of all twelve coordinates or less
  std::vector<int> free;             ///< coordinate of each column

  Unknowns(const LinkTask& task, const Vec3& origin) {
    middle.name = task.name;
    middle.type = task.type;
    middle.moved_by_rack = task.moved_by_rack;
    const auto add = [&](const std::vector<PointBox>& boxes, std::vector<Vec3>& to) {
      for (const PointBox& box : boxes) {
        for (int k = 0; k < 3; ++k) {
          const double low = component(box.lower, k), high = component(box.upper, k);
          LINKWRIGHT_REQUIRE(std::isfinite(low) && std::isfinite(high) && low <= high,
                             "link '{}': box from {} to {} m", task.name, low, high);
          columns.push_back(low < high ? static_cast<int>(free.size()) : -1);
          if (low < high) free.push_back(static_cast<int>(lower.size()));
          lower.push_back(low - component(origin, k));
          upper.push_back(high - component(origin, k));
        }
        to.push_back(0.5 * (box.lower + box.upper) - origin);
      }
    };
    add(task.body, middle.body);
    add(task.carrier, middle.carrier);
  }

  double get(const GuideLink& link, int place) const {
    const std::size_t point = static_cast<std::size_t>(place) / 3;
    const Vec3& p = point < link.body.size() ? link.body[point] : link.carrier[point - link.body.size()];
    return component(p, place % 3);
  }
  void set(GuideLink& link, int place, double value) const {
    const std::size_t point = static_cast<std::size_t>(place) / 3;
    Vec3& p = point < link.body.size() ? link.body[point] : link.carrier[point - link.body.size()];
    (place % 3 == 0 ? p.x : place % 3 == 1 ? p.y : p.z) = value;
  }
  bool inside(const GuideLink& link) const {
    for (std::size_t i = 0; i < lower.size(); ++i) {
      const double value = get(link, static_cast<int>(i));
      if (!(value >= lower[i] - in_box && value <= upper[i] + in_box)) return false;
    }
    return true;
  }
};

struct Errors {
  double rms = std::numeric_limits<double>::infinity(), largest = rms;
};

/// One search for a link, with its memory.
class Search {
 public:
  Search(const LinkMotion& motion, const Unknowns& unknowns)
      : motion_(motion), unknowns_(unknowns), projection_(motion, unknowns.middle, unknowns.columns) {
    rows_ = error_rows(unknowns.middle.type, motion.size());
    errors_.resize(rows_);
    for (const int place : projection_.unknowns()) {
      lower_.push_back(unknowns.lower[place]);
      upper_.push_back(unknowns.upper[place]);
    }
    for (const int place : unknowns.free) {
      all_lower_.push_back(unknowns.lower[place]);
      all_upper_.push_back(unknowns.upper[place]);
    }
  }

  bool can_project() const { return projection_.applicable(); }
  std::int64_t evaluations() const { return evaluations_; }

  Errors errors(const GuideLink& link) {
    Errors e;
    if (!structural_errors(motion_, link, errors_, unknowns_.columns, {})) return e;
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
    e.rms = std::sqrt(sum / static_cast<double>(rows_ / parts));
    return e;
  }

  /// Variable projection from `link`, whose eliminated points do not matter; as a polish it goes on to
  /// rounding, across bounds.
  bool project(GuideLink& link, bool polish) {
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
  bool fit(GuideLink& link, int iterations) {
    x_.clear();
    for (const int place : unknowns_.free) x_.push_back(unknowns_.get(link, place));
    math::LeastSquaresOptions o;
    o.max_iterations = iterations;
    o.lambda_success = 0.1;
    o.lambda_max = largest_damping;
    o.decrease_tolerance = 0;
    o.relative_decrease_tolerance = 1e-5;
    o.cost_tolerance = exact_cost;
    GuideLink trial = link;
    const auto place_all = [&](GuideLink& to, std::span<const double> x) {
      for (std::size_t j = 0; j < x.size(); ++j) unknowns_.set(to, unknowns_.free[j], x[j]);
    };
    const auto function = [&](std::span<const double> x, std::span<double> r, std::span<double> j) {
      place_all(trial, x);
      return structural_errors(motion_, trial, r, unknowns_.columns, j);
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
  const Unknowns& unknowns_;
  LinkProjection projection_;
  std::size_t rows_ = 0;
  std::vector<double> errors_, lower_, upper_, all_lower_, all_upper_, x_, scratch_;
  math::LeastSquaresWorkspace workspace_;
  std::int64_t evaluations_ = 0;
};

void move(GuideLink& link, const Vec3& by) {
  for (Vec3& p : link.body) p += by;
  for (Vec3& p : link.carrier) p += by;
}

void require_points(LinkType type, std::size_t body, std::size_t carrier, const std::string& name) {
  LINKWRIGHT_REQUIRE(
      static_cast<int>(body) == body_points(type) && static_cast<int>(carrier) == carrier_points(type),
      "link '{}' of type {} needs {} points on the body and {} on the carrier, got {} and {}", name,
      name_of(type), body_points(type), carrier_points(type), body, carrier);
}

}  // namespace

PointBox box_around(const Vec3& centre, double edge) {
  const Vec3 half{edge / 2, edge / 2, edge / 2};
  return {centre - half, centre + half};
}

LinkFit fit_link(const CarrierTargets& targets, const LinkTask& task, const LinkFitOptions& options,
                 std::span<const GuideLink> known, std::uint64_t seed, std::uint32_t run) {
  require_points(task.type, task.body.size(), task.carrier.size(), task.name);
  LINKWRIGHT_REQUIRE(options.starts >= 1 && options.tolerance > 0 && options.same_point >= 0,
                     "{} starts, tolerance {} m, same point within {} m", options.starts, options.tolerance,
                     options.same_point);
  const LinkMotion motion = link_motion(targets, task.moved_by_rack, targets.wheel.centre);
  LINKWRIGHT_REQUIRE(motion.size() >= 1, "link '{}': no position besides the reference", task.name);
  const Unknowns unknowns(task, targets.wheel.centre);
  Search search(motion, unknowns);

  LinkFit fit;
  fit.link = unknowns.middle;
  GuideLink link;
  const auto is_known = [&](const GuideLink& found) {
    for (GuideLink other : known) {
      if (other.type != task.type || other.moved_by_rack != task.moved_by_rack) continue;
      move(other, -targets.wheel.centre);
      if (largest_distance(other, found) <= options.same_point) return true;
    }
    return false;
  };
  int first_exact = -1;
  const auto consider = [&] {  // takes `link` if it is the best so far
    if (!unknowns.inside(link)) return;
    Errors e = search.errors(link);
    const bool exact = e.rms <= options.tolerance;
    if (exact && e.rms > polished_rms && search.can_project()) {
      const GuideLink before = link;
      Errors after;
      if (search.project(link, true) && unknowns.inside(link)) after = search.errors(link);
      if (after.rms < e.rms)
        e = after;
      else
        link = before;
    }
    if (exact && is_known(link)) {
      ++fit.duplicates;
      return;
    }
    if (e.rms < fit.rms) {
      fit.rms = e.rms;
      fit.largest = e.largest;
      fit.link = link;
    }
    if (exact && first_exact < 0) first_exact = fit.starts;
  };
  const auto found = [&] {
    return fit.rms <= rounded_rms || (first_exact >= 0 && fit.starts >= first_exact + further_starts);
  };

  const int starts = unknowns.free.empty() ? 0 : options.starts;
  if (starts == 0) {
    link = unknowns.middle;
    consider();
  }
  for (int s = 0; s < starts && !found(); ++s) {
    RandomStream random({seed, run, 0, static_cast<std::uint32_t>(s)});
    link = unknowns.middle;
    for (const int place : unknowns.free)
      unknowns.set(link, place, random.uniform(unknowns.lower[place], unknowns.upper[place]));
    ++fit.starts;
    if (s % 2 == 0 && search.can_project()) {
      if (!search.project(link, false) || !unknowns.inside(link)) continue;
      consider();
      if (found()) break;
    }
    if (search.fit(link, direct_iterations)) consider();
  }
  if (starts > 0 && std::isfinite(fit.rms) && fit.rms > options.tolerance) {
    link = fit.link;
    if (search.fit(link, final_iterations)) consider();
  }
  if (std::isfinite(fit.rms))
    fit.status = fit.rms <= options.tolerance ? Status::done : Status::not_converged;
  fit.evaluations = search.evaluations();
  move(fit.link, targets.wheel.centre);
  return fit;
}

LinkConditioning conditioning(const CarrierTargets& targets, const LinkTask& task, const GuideLink& link) {
  require_points(task.type, link.body.size(), link.carrier.size(), task.name);
  require_points(task.type, task.body.size(), task.carrier.size(), task.name);
  const LinkMotion motion = link_motion(targets, task.moved_by_rack, targets.wheel.centre);
  const Unknowns unknowns(task, targets.wheel.centre);
  GuideLink shifted = link;
  move(shifted, -targets.wheel.centre);
  const std::size_t rows = error_rows(task.type, motion.size()), n = unknowns.free.size();
  std::vector<double> errors(rows), jacobian(rows * n);
  LinkConditioning found;
  found.weakest = unknowns.middle;
  for (Vec3& p : found.weakest.body) p = {};
  for (Vec3& p : found.weakest.carrier) p = {};
  if (n == 0 || rows == 0 || !structural_errors(motion, shifted, errors, unknowns.columns, jacobian))
    return found;
  const Eigen::Map<const Eigen::MatrixXd> j(jacobian.data(), static_cast<Eigen::Index>(rows),
                                            static_cast<Eigen::Index>(n));
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(j, Eigen::ComputeFullV);
  found.singular_values.assign(n, 0.0);
  for (Eigen::Index k = 0; k < svd.singularValues().size(); ++k)
    found.singular_values[k] = svd.singularValues()[k];
  for (std::size_t k = 0; k < n; ++k)
    unknowns.set(found.weakest, unknowns.free[k],
                 svd.matrixV()(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(n) - 1));
  return found;
}

double fewest_positions(int unknowns, int equations, int pose_parameters, bool lengths_given) {
  LINKWRIGHT_REQUIRE(unknowns >= 0 && equations >= 0 && pose_parameters >= 0 && pose_parameters <= 6,
                     "{} unknowns, {} equations, {} pose parameters", unknowns, equations, pose_parameters);
  const int gained = equations + pose_parameters - 6;
  if (gained <= 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(unknowns) / gained + (lengths_given ? 0 : 1);
}

}  // namespace linkwright::suspension
