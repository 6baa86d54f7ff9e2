// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/coupler_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/dense.h"
#include "linkwright/math/least_squares.h"

namespace linkwright::suspension {
namespace {

/// The point at distance l from the body point of the first link, seen from the second one: from + l along.
struct Track {
  std::vector<Eigen::Vector3d> from, along;  ///< the reference first
  Mat3 frame;  ///< orientation of the second link in the reference pose, axes as rows
  Vec3 origin;

  std::size_t size() const { return from.size(); }
  Eigen::Vector3d at(std::size_t i, double l) const { return from[i] + l * along[i]; }
};

/// Axes of the second link (59)-(64).
Mat3 link_frame(const Vec3& ball, const Vec3& hinge, const Vec3& other) {
  const Vec3 y = math::unit(other - hinge), z = math::unit(cross(ball - hinge, other - hinge));
  return {{cross(y, z), y, z}};
}

Track coupler_track(const CarrierTargets& targets, const CornerLink& first, const CornerLink& second) {
  Track track;
  const auto add = [&](const Mat3& rotation, const Vec3& centre, double rack) {
    const auto moved = [&](const Vec3& p) { return centre + rotation * (p - targets.wheel.centre); };
    const auto body = [&](const CornerLink& link) {
      return link.moved_by_rack ? link.body[0] + rack * targets.rack_direction : link.body[0];
    };
    const Vec3 hinge = moved(second.carrier[0]);
    const Mat3 frame = link_frame(body(second), hinge, moved(second.carrier[1]));
    const Vec3 from = frame * (body(first) - hinge),
               along = frame * math::unit(moved(first.carrier[0]) - body(first));
    track.from.emplace_back(from.x, from.y, from.z);
    track.along.emplace_back(along.x, along.y, along.z);
    if (track.size() == 1) track.frame = frame, track.origin = hinge;
  };
  add({}, targets.wheel.centre, 0);
  for (const CarrierTarget& pose : targets.poses) {
    add(target_rotation(targets, pose), pose.centre, pose.rack);
  }
  return track;
}

/// Centre of the sphere nearest to the track for an offset, the residuals of the linear problem, and their
/// derivative.
struct Sphere {
  Eigen::Vector3d centre;
  Eigen::VectorXd residual, derivative;
};

Eigen::Vector3d fitted(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return Eigen::Vector3d(math::linear_fit(math::numbers(a), 3, math::numbers(b)).data());
}

Sphere fit_sphere(const Track& track, double l) {
  const auto n = static_cast<Eigen::Index>(track.size());
  Eigen::MatrixXd a(n, 3), da(n, 3);
  Eigen::VectorXd b(n), db(n);
  const Eigen::Vector3d t0 = track.at(0, l), u0 = track.along[0];
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d t = track.at(static_cast<std::size_t>(i), l),
                          u = track.along[static_cast<std::size_t>(i)];
    a.row(i) = (t - t0).transpose();
    da.row(i) = (u - u0).transpose();
    b[i] = (t - t0).dot(t + t0) / 2;
    db[i] = t.dot(u) - t0.dot(u0);
  }
  Sphere s;
  s.centre = fitted(a, b);
  s.residual = b - a * s.centre;
  const Eigen::VectorXd change = db - da * s.centre;
  // (I - Q Q') (db - dA y) - A+' dA' e
  const Eigen::Vector3d turned = da.transpose() * s.residual;
  const Eigen::Matrix3d normal = a.transpose() * a;
  const std::vector<double> inner = math::solve_symmetric(math::numbers(normal), math::numbers(turned));
  s.derivative = change - a * fitted(a, change) - a * Eigen::Vector3d(inner.data());
  return s;
}

/// The point of the box (m, vehicle frame) whose sphere is nearest to the track for an offset: least squares
/// with limits, exact by trying which coordinates are at one.
Vec3 best_in_box(const Track& track, double l, const PointBox& box) {
  const auto n = static_cast<Eigen::Index>(track.size());
  Eigen::MatrixXd a(n, 3);
  Eigen::VectorXd b(n);
  const Eigen::Vector3d t0 = track.at(0, l);
  Eigen::Matrix3d frame;  // coordinates of the link's frame from those of the vehicle
  for (int k = 0; k < 3; ++k)
    frame.row(k) << track.frame.row[k].x, track.frame.row[k].y, track.frame.row[k].z;
  const Eigen::Vector3d origin(track.origin.x, track.origin.y, track.origin.z);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d t = track.at(static_cast<std::size_t>(i), l);
    a.row(i) = (t - t0).transpose() * frame;
    b[i] = (t - t0).dot(t + t0) / 2 + a.row(i).dot(origin);
  }
  const Eigen::Vector3d lower(box.lower.x, box.lower.y, box.lower.z),
      upper(box.upper.x, box.upper.y, box.upper.z);
  Eigen::Vector3d best = 0.5 * (lower + upper);
  double least = infinity;
  for (int sides = 0; sides < 27; ++sides) {  // each coordinate free, at its lower, at its upper limit
    const std::array side{sides % 3, sides / 3 % 3, sides / 9};
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    std::array<int, 3> free{};
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      if (side[static_cast<std::size_t>(k)] == 0)
        free[static_cast<std::size_t>(count++)] = k;
      else
        point[k] = side[static_cast<std::size_t>(k)] == 1 ? lower[k] : upper[k];
    }
    if (count > 0) {
      Eigen::MatrixXd columns(n, count);
      for (int k = 0; k < count; ++k) columns.col(k) = a.col(free[static_cast<std::size_t>(k)]);
      const Eigen::VectorXd rest = b - a * point;
      const std::vector<double> at =
          math::linear_fit(math::numbers(columns), static_cast<std::size_t>(count), math::numbers(rest));
      for (std::size_t k = 0; k < at.size(); ++k) point[free[k]] = at[k];
    }
    if ((point - lower).minCoeff() < 0 || (upper - point).minCoeff() < 0) continue;
    const double square = (b - a * point).squaredNorm();
    if (square < least) least = square, best = point;
  }
  return {best.x(), best.y(), best.z()};
}

bool inside(const PointBox& box, const Vec3& p, double by) {
  return p.x >= box.lower.x - by && p.x <= box.upper.x + by && p.y >= box.lower.y - by &&
         p.y <= box.upper.y + by && p.z >= box.lower.z - by && p.z <= box.upper.z + by;
}

/// Errors |t_i - y| - |t_0 - y| over the offset and the point, for a search within bounds.
bool coupler_errors(const Track& track, std::span<const double> x, std::span<double> errors,
                    std::span<double> jacobian) {
  const Vec3 y = track.frame * (Vec3{x[1], x[2], x[3]} - track.origin);
  const Eigen::Vector3d centre(y.x, y.y, y.z);
  const Eigen::Vector3d d0 = track.at(0, x[0]) - centre;
  const double l0 = d0.norm();
  if (!(l0 > 0)) return false;
  const std::size_t m = track.size() - 1;
  for (std::size_t i = 0; i < m; ++i) {
    const Eigen::Vector3d d = track.at(i + 1, x[0]) - centre;
    const double l = d.norm();
    if (!(l > 0)) return false;
    errors[i] = (d - d0).dot(d + d0) / (l + l0);
    if (jacobian.empty()) continue;
    const Eigen::Vector3d g = d0 / l0 - d / l;
    jacobian[i] = d.dot(track.along[i + 1]) / l - d0.dot(track.along[0]) / l0;
    const Vec3 row = g.x() * track.frame.row[0] + g.y() * track.frame.row[1] + g.z() * track.frame.row[2];
    jacobian[m + i] = row.x, jacobian[2 * m + i] = row.y, jacobian[3 * m + i] = row.z;
  }
  return true;
}

constexpr int offsets_tried = 24;
constexpr double box_slack = 1e-9;   // m
constexpr double exact_rms = 1e-14;  // m: nothing left to gain

}  // namespace

CouplerFit fit_coupler(const CarrierTargets& targets, std::span<const CornerLink> links,
                       const CouplerTask& task, double tolerance) {
  const auto link = [&](int index, LinkType type, LinkType same) -> const CornerLink& {
    LINKWRIGHT_REQUIRE(index >= 0 && index < static_cast<int>(links.size()), "coupler '{}': link {} of {}",
                       task.name, index, links.size());
    const CornerLink& found = links[static_cast<std::size_t>(index)];
    LINKWRIGHT_REQUIRE(found.type == type || found.type == same,
                       "coupler '{}': link {} is of type {}, needs {}", task.name, index, name_of(found.type),
                       name_of(type));
    return found;
  };
  const CornerLink& first = link(task.first, LinkType::US, LinkType::SS);
  const CornerLink& second = link(task.second, LinkType::SR, LinkType::SR);
  const double rod = norm(first.carrier[0] - first.body[0]), length = std::min(rod, task.max_offset);
  LINKWRIGHT_REQUIRE(task.min_offset >= 0 && task.min_offset < length,
                     "coupler '{}': offset of at least {} m and at most {} m on a link of {} m", task.name,
                     task.min_offset, task.max_offset, rod);
  const Track track = coupler_track(targets, first, second);
  LINKWRIGHT_REQUIRE(track.size() >= 5, "coupler '{}': needs four positions besides the reference, got {}",
                     task.name, track.size() - 1);

  CouplerFit fit;
  fit.coupler = {.name = task.name, .first = task.first, .second = task.second};
  // The best of a row of offsets, then Gauss-Newton with the exact derivative.
  double offset = length, least = infinity;
  for (int k = 0; k < offsets_tried; ++k) {
    const double l = task.min_offset + (length - task.min_offset) * (k + 0.5) / offsets_tried;
    const double square = fit_sphere(track, l).residual.squaredNorm();
    if (square < least) least = square, offset = l;
  }
  math::LeastSquaresOptions options;
  options.decrease_tolerance = 0;
  options.cost_tolerance = 1e-34;
  math::LeastSquaresWorkspace workspace;
  const auto n = static_cast<std::size_t>(track.size());
  math::minimise_least_squares(
      [&](std::span<const double> x, std::span<double> r, std::span<double> j) {
        const Sphere s = fit_sphere(track, x[0]);
        std::copy(s.residual.begin(), s.residual.end(), r.begin());
        if (!j.empty()) std::copy(s.derivative.begin(), s.derivative.end(), j.begin());
        return true;
      },
      n, {&offset, 1}, {&task.min_offset, 1}, {&length, 1}, options, workspace);
  const Eigen::Vector3d centre = fit_sphere(track, offset).centre;
  std::array x{offset, 0.0, 0.0, 0.0};
  const auto set_point = [&](const Vec3& p) { x[1] = p.x, x[2] = p.y, x[3] = p.z; };
  const Mat3 back = transposed(track.frame);
  set_point(track.origin + back * Vec3{centre.x(), centre.y(), centre.z()});
  const auto errors = [&] {
    std::vector<double> e(n - 1);
    fit.rms = fit.largest = infinity;
    if (!coupler_errors(track, x, e, {})) return;
    double square = 0;
    fit.largest = 0;
    for (const double v : e) square += v * v, fit.largest = std::max(fit.largest, std::abs(v));
    fit.rms = std::sqrt(square / static_cast<double>(e.size()));
  };
  errors();
  if (!(fit.rms <= tolerance) || !inside(task.point, {x[1], x[2], x[3]}, box_slack)) {
    const std::array lower{task.min_offset, task.point.lower.x, task.point.lower.y, task.point.lower.z};
    const std::array upper{length, task.point.upper.x, task.point.upper.y, task.point.upper.z};
    options.max_iterations = 500;
    const auto search = [&] {
      math::minimise_least_squares([&](std::span<const double> at, std::span<double> r,
                                       std::span<double> j) { return coupler_errors(track, at, r, j); },
                                   n - 1, x, lower, upper, options, workspace);
      errors();
    };
    search();
    // A search within limits ends where a limit and the valley meet, which need not be the best place of the
    // box: begin at the best point for each offset, too.
    CouplerFit best = fit;
    std::array best_x = x;
    for (int k = 0; k <= offsets_tried && !(best.rms <= exact_rms); ++k) {
      x[0] = task.min_offset + (length - task.min_offset) * k / offsets_tried;
      set_point(best_in_box(track, x[0], task.point));
      search();
      if (fit.rms < best.rms) best = fit, best_x = x;
    }
    fit = best, x = best_x;
  }
  if (!std::isfinite(fit.rms)) return fit;
  fit.status = fit.rms <= tolerance ? Status::done : Status::not_converged;
  fit.offset = x[0];
  fit.coupler.fraction = x[0] / rod;
  fit.coupler.point = {x[1], x[2], x[3]};
  return fit;
}

}  // namespace linkwright::suspension
