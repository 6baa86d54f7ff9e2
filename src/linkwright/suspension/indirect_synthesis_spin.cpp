#include "linkwright/suspension/indirect_synthesis_spin.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/random.h"
#include "linkwright/math/least_squares.h"
#include "linkwright/suspension/link_fit_motion.h"

namespace linkwright::suspension {
namespace {

double& component(Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }
double component(const Vec3& a, int k) { return k == 0 ? a.x : k == 1 ? a.y : a.z; }

Vec3 transposed_times(const Mat3& m, const Vec3& a) {
  return a.x * m.row[0] + a.y * m.row[1] + a.z * m.row[2];
}

/// Rotation before * R_y(spin) * after, and its derivative.
struct SpunPose {
  Mat3 before, after, rotation, rate;
  Vec3 centre;
  double rack = 0;
  int column = -1;  ///< of its spin, -1 = given

  void spin(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    rotation = before * math::turn_y(angle) * after;
    rate = before * Mat3{{Vec3{-s, 0, c}, Vec3{0, 0, 0}, Vec3{-c, 0, -s}}} * after;
  }
};

/// Structural errors of all links over coordinates and spins.
class SpinErrors {
 public:
  SpinErrors(const CarrierTargets& targets, std::span<const LinkTask> tasks) : targets_(targets) {
    for (const LinkTask& task : tasks) {
      GuideLink link{.name = task.name, .type = task.type, .moved_by_rack = task.moved_by_rack};
      std::vector<int> columns;
      for (const bool body : {true, false})
        for (const PointBox& box : body ? task.body : task.carrier) {
          Vec3 p = 0.5 * (box.lower + box.upper);
          for (int k = 0; k < 3; ++k) {
            const double low = component(box.lower, k), high = component(box.upper, k);
            LINKWRIGHT_REQUIRE(low <= high, "link '{}': box from {} to {} m", task.name, low, high);
            columns.push_back(low < high ? static_cast<int>(lower.size()) : -1);
            if (low == high) component(p, k) = low;
            if (low < high) lower.push_back(low), upper.push_back(high);
          }
          (body ? link.body : link.carrier).push_back(p);
        }
      links.push_back(link);
      columns_.push_back(columns);
    }
    coordinates = lower.size();
    for (const CarrierTarget& pose : targets.poses) {
      SpunPose spun{.before = math::turn_z(-pose.angles.toe) * math::turn_x(-pose.angles.camber),
                    .after = math::turn_x(targets.wheel.camber) * math::turn_z(targets.wheel.toe),
                    .centre = pose.centre,
                    .rack = pose.rack};
      const bool reference = pose.rack == 0 && norm(pose.centre - targets.wheel.centre) < 1e-12 &&
                             std::abs(pose.angles.toe - targets.wheel.toe) < 1e-12 &&
                             std::abs(pose.angles.camber - targets.wheel.camber) < 1e-12;
      if (reference) {  // spin 0 by definition
        spins.push_back(0);
        places_.push_back(-1);
        continue;
      }
      spins.push_back(pose.angles.spin);
      if (std::isnan(pose.angles.spin))
        spun.column = static_cast<int>(coordinates + unknown_spins++);
      else
        spun.spin(pose.angles.spin);
      places_.push_back(spun.column);
      poses_.push_back(spun);
    }
    for (const GuideLink& link : links) rows += link.body.size() * link.carrier.size() * poses_.size();
  }

  /// Takes coordinates and spins into `links` and `spins`.
  void place(std::span<const double> x) {
    for (std::size_t l = 0; l < links.size(); ++l) {
      std::size_t c = 0;
      for (auto* points : {&links[l].body, &links[l].carrier})
        for (Vec3& p : *points)
          for (int k = 0; k < 3; ++k, ++c)
            if (columns_[l][c] >= 0) component(p, k) = x[static_cast<std::size_t>(columns_[l][c])];
    }
    for (SpunPose& pose : poses_)
      if (pose.column >= 0) pose.spin(x[static_cast<std::size_t>(pose.column)]);
    for (std::size_t i = 0; i < spins.size(); ++i)
      if (places_[i] >= 0) spins[i] = x[static_cast<std::size_t>(places_[i])];
  }

  bool evaluate(std::span<const double> x, std::span<double> errors, std::span<double> jacobian) {
    place(x);
    std::fill(jacobian.begin(), jacobian.end(), 0.0);
    std::size_t row = 0;
    const auto put = [&](const int* column, const Vec3& gradient) {
      for (int k = 0; k < 3; ++k)
        if (column[k] >= 0)
          jacobian[static_cast<std::size_t>(column[k]) * rows + row] = component(gradient, k);
    };
    for (std::size_t l = 0; l < links.size(); ++l) {
      const GuideLink& link = links[l];
      for (std::size_t b = 0; b < link.body.size(); ++b)
        for (std::size_t c = 0; c < link.carrier.size(); ++c) {
          const Vec3 r = link.carrier[c] - targets_.wheel.centre, d0 = link.carrier[c] - link.body[b];
          const double l0 = norm(d0);
          if (!(l0 > 0)) return false;
          const Vec3 u0 = (1 / l0) * d0;
          for (const SpunPose& pose : poses_) {
            Vec3 d = pose.centre + pose.rotation * r - link.body[b];
            if (link.moved_by_rack) d = d - pose.rack * targets_.rack_direction;
            const double length = norm(d);
            if (!(length > 0)) return false;
            errors[row] = dot(d - d0, d + d0) / (length + l0);
            if (!jacobian.empty()) {
              const Vec3 u = (1 / length) * d;
              put(&columns_[l][3 * b], u0 - u);
              put(&columns_[l][3 * (link.body.size() + c)], transposed_times(pose.rotation, u) - u0);
              if (pose.column >= 0)
                jacobian[static_cast<std::size_t>(pose.column) * rows + row] = dot(u, pose.rate * r);
            }
            ++row;
          }
        }
    }
    return true;
  }

  std::vector<GuideLink> links;
  std::vector<double> spins;  ///< of all positions
  std::vector<double> lower, upper;
  std::size_t coordinates = 0, unknown_spins = 0, rows = 0;

 private:
  const CarrierTargets& targets_;
  std::vector<std::vector<int>> columns_;
  std::vector<SpunPose> poses_;
  std::vector<int> places_;
};

}  // namespace

SpinFit fit_with_unknown_spin(const CarrierTargets& targets, std::span<const LinkTask> tasks,
                              const SpinFitOptions& options, std::uint64_t seed, RunContext& context) {
  LINKWRIGHT_REQUIRE(!tasks.empty(), "no link is to be found");
  for (const LinkTask& task : tasks) {
    LINKWRIGHT_REQUIRE(task.type != LinkType::SP && task.type != LinkType::S && task.type != LinkType::R,
                       "link '{}' of type {}: with unknown spin only KS, SS, RS, SR and RR links are found",
                       task.name, name_of(task.type));
    LINKWRIGHT_REQUIRE(static_cast<int>(task.body.size()) == body_points(task.type) &&
                           static_cast<int>(task.carrier.size()) == carrier_points(task.type),
                       "link '{}' of type {} has boxes for {} points on the body and {} on the carrier",
                       task.name, name_of(task.type), task.body.size(), task.carrier.size());
  }
  LINKWRIGHT_REQUIRE(
      options.starts >= 1 && options.iterations >= 1 && options.final_iterations >= 1 &&
          options.tolerance > 0 && options.largest_spin > 0 && options.distinct_links >= 0,
      "{} starts, {} and {} iterations, tolerance {} m, spin of at most {} rad, links {} m apart",
      options.starts, options.iterations, options.final_iterations, options.tolerance, options.largest_spin,
      options.distinct_links);
  SpinErrors problem(targets, tasks);
  LINKWRIGHT_REQUIRE(problem.rows > 0, "no position besides the reference");
  const std::size_t n = problem.coordinates + problem.unknown_spins;
  LINKWRIGHT_REQUIRE(n > 0, "nothing is unknown");
  problem.lower.resize(n, -options.largest_spin);
  problem.upper.resize(n, options.largest_spin);

  math::LeastSquaresOptions local;
  local.max_iterations = options.iterations;
  local.lambda0 = 1e-3;
  local.lambda_success = 0.2;
  local.decrease_tolerance = 0;
  local.relative_decrease_tolerance = 1e-7;
  const double half_rows = static_cast<double>(problem.rows) / 2;
  local.cost_tolerance = half_rows * options.tolerance * options.tolerance;
  math::LeastSquaresWorkspace workspace;
  const auto function = [&](std::span<const double> at, std::span<double> r, std::span<double> j) {
    return problem.evaluate(at, r, j);
  };

  SpinFit fit;
  fit.targets = targets;
  std::vector<double> x(n), best;
  // Each start as far as it takes to rank them, then the best one to its end.
  for (int s = 0; s <= options.starts && !(fit.rms <= options.tolerance); ++s) {
    if (s < options.starts) {
      RandomStream random({seed, 0, 0, static_cast<std::uint32_t>(s)});
      for (std::size_t j = 0; j < n; ++j)
        x[j] = j < problem.coordinates ? random.uniform(problem.lower[j], problem.upper[j]) : 0;
    } else {
      if (best.empty()) break;
      x = best;
      local.max_iterations = options.final_iterations;
      local.relative_decrease_tolerance = 1e-9;
    }
    const auto report = math::minimise_least_squares(function, problem.rows, x, problem.lower, problem.upper,
                                                     local, workspace);
    fit.starts += s < options.starts;
    fit.evaluations += report.evaluations;
    const double rms = std::sqrt(report.cost / half_rows);
    if (report.status != Status::infeasible && rms < fit.rms) {
      problem.place(x);
      bool distinct = true;
      for (std::size_t a = 0; a < problem.links.size(); ++a)
        for (std::size_t b = a + 1; b < problem.links.size(); ++b)
          distinct =
              distinct && (problem.links[a].type != problem.links[b].type ||
                           problem.links[a].moved_by_rack != problem.links[b].moved_by_rack ||
                           largest_distance(problem.links[a], problem.links[b]) > options.distinct_links);
      if (distinct) {
        fit.rms = rms;
        best = x;
        fit.links = problem.links;
        for (std::size_t i = 0; i < targets.poses.size(); ++i)
          fit.targets.poses[i].angles.spin = problem.spins[i];
        fit.largest = 0;
        for (const double e : workspace.residuals()) fit.largest = std::max(fit.largest, std::abs(e));
      } else {
        ++fit.refused;
      }
    }
    if (context.interrupted()) break;
  }
  if (fit.links.empty()) return fit;
  fit.status = fit.rms <= options.tolerance ? Status::done : Status::not_converged;
  if (fit.status != Status::done && context.interrupted()) fit.status = context.interruption();
  return fit;
}

}  // namespace linkwright::suspension
