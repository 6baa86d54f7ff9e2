// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/dyads/pose_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/least_squares.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t count_of(GuidingDyadType type) { return type == GuidingDyadType::rr ? 5 : 4; }

void numbers_of(const GuidingDyad& d, double* x) {
  const Complex pivot = d.type == GuidingDyadType::pr ? d.moving : d.fixed;
  *x++ = pivot.real();
  *x++ = pivot.imag();
  if (d.type == GuidingDyadType::rr) {
    *x++ = d.moving.real();
    *x++ = d.moving.imag();
    *x = d.length;
  } else {
    *x++ = std::arg(d.normal);
    *x = d.offset;
  }
}

GuidingDyad with_numbers(GuidingDyad d, const double* x) {
  (d.type == GuidingDyadType::pr ? d.moving : d.fixed) = {x[0], x[1]};
  if (d.type == GuidingDyadType::rr) {
    d.moving = {x[2], x[3]};
    d.length = x[4];
  } else {
    d.normal = std::polar(1.0, x[2]);
    d.offset = x[3];
  }
  return d;
}

// The pose of the body nearest to a given pose with both gaps closed. With J the slopes of the gaps by the
// pose in lengths and J J' = L L', the displacement there is J' lambda; `miss` = L' lambda has its length,
// and moves with the gaps by L^-1.
struct Nearest2 {
  BodyPose reached;
  std::array<double, 2> miss{};
  double l00 = 1, l10 = 0, l11 = 1;
  GapSlopes first, second;
};

std::optional<Nearest2> nearest_pose(const GuidingDyad& a, const GuidingDyad& b, const BodyPose& pose,
                                     double length) {
  Nearest2 out;
  out.reached = pose;
  const auto row = [&](const GapSlopes& s) {
    return std::array<double, 3>{s.pose[0] * length, s.pose[1] * length, s.pose[2]};
  };
  for (int step = 0; step < 30; ++step) {
    out.first = gap_slopes(a, out.reached);
    out.second = gap_slopes(b, out.reached);
    const auto p = row(out.first), q = row(out.second);
    // Least |x - pose| with both gaps closed to first order (lengths in units of `length`).
    const std::array<double, 3> off = {(pose.origin.real() - out.reached.origin.real()) / length,
                                       (pose.origin.imag() - out.reached.origin.imag()) / length,
                                       pose.angle - out.reached.angle};
    double pp = 0, pq = 0, qq = 0, po = 0, qo = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      pp += p[i] * p[i];
      pq += p[i] * q[i];
      qq += q[i] * q[i];
      po += p[i] * off[i];
      qo += q[i] * off[i];
    }
    const double det = pp * qq - pq * pq;
    if (!(det > 1e-14 * pp * qq)) return std::nullopt;
    const double r = out.first.gap + po, s = out.second.gap + qo;
    const double u = (qq * r - pq * s) / det, v = (pp * s - pq * r) / det;
    double moved = 0;
    std::array<double, 3> to;
    for (std::size_t i = 0; i < 3; ++i) {
      to[i] = off[i] - u * p[i] - v * q[i];
      moved = std::max(moved, std::abs(to[i]));
    }
    out.reached.origin += length * Complex(to[0], to[1]);
    out.reached.angle += to[2];
    out.l00 = std::sqrt(pp);
    out.l10 = pq / out.l00;
    out.l11 = std::sqrt(det / pp);
    out.miss = {out.l00 * u + out.l10 * v, out.l11 * v};
    if (!std::isfinite(moved)) return std::nullopt;
    if (moved < 1e-13) return out;
  }
  return std::nullopt;
}

// Likewise for a point: the rotation is free, and one combination of the gaps does without it. `miss` has one
// number, which moves with that combination.
struct NearestPoint {
  BodyPose reached;
  double miss = 0, of_first = 0, of_second = 0;  // slopes of the miss by both gaps
  GapSlopes first, second;
};

std::optional<NearestPoint> nearest_point(const GuidingDyad& a, const GuidingDyad& b, const BodyPose& point,
                                          double length) {
  NearestPoint out;
  out.reached = point;
  for (int step = 0; step < 60; ++step) {
    out.first = gap_slopes(a, out.reached);
    out.second = gap_slopes(b, out.reached);
    const double pa = out.first.pose[2], qa = out.second.pose[2], turning = std::hypot(pa, qa);
    if (!(turning > 0)) return std::nullopt;
    const auto without = [&](double p, double q) { return (qa * p - pa * q) / turning; };
    const auto with = [&](double p, double q) { return (pa * p + qa * q) / turning; };
    const double rx = without(out.first.pose[0], out.second.pose[0]),
                 ry = without(out.first.pose[1], out.second.pose[1]), size = std::hypot(rx, ry);
    if (!(size > 1e-9)) return std::nullopt;
    const Complex off = point.origin - out.reached.origin;
    const double miss = (without(out.first.gap, out.second.gap) + rx * off.real() + ry * off.imag()) / size;
    const Complex to = off - miss * Complex(rx, ry) / size;
    const double turn =
        -(with(out.first.gap, out.second.gap) + with(out.first.pose[0], out.second.pose[0]) * to.real() +
          with(out.first.pose[1], out.second.pose[1]) * to.imag()) /
        turning;
    out.reached.origin += to;
    out.reached.angle += std::clamp(turn, -0.5, 0.5);
    out.miss = miss / length;
    out.of_first = qa / turning / size / length;
    out.of_second = -pa / turning / size / length;
    if (!std::isfinite(turn) || !std::isfinite(miss)) return std::nullopt;
    if (std::abs(to) < 1e-13 * length && std::abs(turn) < 1e-13) return out;
  }
  return std::nullopt;
}

// Weights of poses that are met exactly, relative to others, one search after the other, before the numbers
// are moved to meet them: at once the search would follow a narrow valley.
constexpr std::array<double, 3> exact_weights = {1e2, 1e4, 1e6};

// Moves the numbers as little as can be, each in units of its own size, until the dyads hold the poses:
// Newton's method of least length, one dyad at a time. False where it does not come to that.
bool meet(std::span<const BodyPose> poses, GuidingDyad& dyad, double size) {
  if (poses.empty()) return true;
  const std::size_t count = count_of(dyad.type), m = poses.size();
  std::array<double, 5> x{}, unit{};
  numbers_of(dyad, x.data());
  for (std::size_t j = 0; j < count; ++j) unit[j] = size;
  if (dyad.type != GuidingDyadType::rr) unit[2] = 1;
  const auto residuals = [&](std::span<const double> step, std::span<double> r, std::span<double> jacobian) {
    std::array<double, 5> at = x;
    for (std::size_t j = 0; j < count; ++j) at[j] += unit[j] * step[j];
    const GuidingDyad moved = with_numbers(dyad, at.data());
    for (std::size_t k = 0; k < m; ++k) {
      const GapSlopes slopes = gap_slopes(moved, poses[k]);
      r[k] = slopes.gap / size;
      for (std::size_t j = 0; j < count && !jacobian.empty(); ++j)
        jacobian[j * m + k] = slopes.dyad[j] * unit[j] / size;
    }
    return true;
  };
  math::LeastSquaresWorkspace workspace;
  math::LeastSquaresOptions options;
  options.damping = math::Damping::identity;
  options.lambda0 = 1e-9;
  options.lambda_max = 1e12;
  options.decrease_tolerance = 0;
  options.cost_tolerance = 1e-30;
  std::vector<double> step(count, 0.0);
  const math::LeastSquaresReport report =
      math::minimise_least_squares(residuals, m, step, options, workspace);
  for (std::size_t j = 0; j < count; ++j) x[j] += unit[j] * step[j];
  dyad = with_numbers(dyad, x.data());
  return report.cost < 1e-24;
}

}  // namespace

GapSlopes gap_slopes(const GuidingDyad& dyad, const BodyPose& pose) {
  GapSlopes out;
  const Complex turn = std::polar(1.0, pose.angle), i(0, 1);
  const Complex at = pose.origin + turn * dyad.moving, arm = turn * dyad.moving;
  switch (dyad.type) {
    case GuidingDyadType::rr: {
      const Complex way = at - dyad.fixed;
      const double distance = std::abs(way);
      const Complex u = distance > 0 ? way / distance : 1.0;
      out.gap = distance - dyad.length;
      out.pose = {u.real(), u.imag(), std::real(std::conj(u) * i * arm)};
      out.dyad = {-u.real(), -u.imag(), std::real(std::conj(u) * turn), std::real(std::conj(u) * i * turn),
                  -1};
      return out;
    }
    case GuidingDyadType::pr: {
      const Complex n = dyad.normal;
      out.gap = std::real(std::conj(n) * at) - dyad.offset;
      out.pose = {n.real(), n.imag(), std::real(std::conj(n) * i * arm)};
      out.dyad = {std::real(std::conj(n) * turn), std::real(std::conj(n) * i * turn),
                  std::real(std::conj(i * n) * at), -1, 0};
      return out;
    }
    case GuidingDyadType::rp:
      break;
  }
  const Complex n = dyad.normal * turn, way = dyad.fixed - pose.origin;
  const double turning = std::real(std::conj(i * n) * way);
  out.gap = std::real(std::conj(n) * way) - dyad.offset;
  out.pose = {-n.real(), -n.imag(), turning};
  out.dyad = {n.real(), n.imag(), turning, -1, 0};
  return out;
}

PoseFit fit_pair(std::span<const BodyPose> poses, const GuidingDyad& first, const GuidingDyad& second,
                 double length, std::span<const PoseDemand> demands) {
  LINKWRIGHT_REQUIRE(poses.size() >= 3, "{} poses", poses.size());
  LINKWRIGHT_REQUIRE(length > 0 && std::isfinite(length), "length {}", length);
  LINKWRIGHT_REQUIRE(demands.empty() || demands.size() == poses.size(), "{} demands", demands.size());
  for (const PoseDemand& demand : demands)
    LINKWRIGHT_REQUIRE(demand.weight > 0 && std::isfinite(demand.weight), "weight {}", demand.weight);
  const auto demand_of = [&](std::size_t k) { return demands.empty() ? PoseDemand{} : demands[k]; };
  const std::size_t n = poses.size(), m = 2 * n;
  const std::size_t na = count_of(first.type), nb = count_of(second.type);
  std::vector<double> x(na + nb);
  numbers_of(first, x.data());
  numbers_of(second, x.data() + na);
  const bool any_exact =
      std::any_of(demands.begin(), demands.end(), [](const PoseDemand& d) { return d.exact; });
  double exact_weight = 1;
  const auto residuals = [&](std::span<const double> at, std::span<double> r, std::span<double> jacobian) {
    const GuidingDyad a = with_numbers(first, at.data()), b = with_numbers(second, at.data() + na);
    for (std::size_t k = 0; k < n; ++k) {
      const PoseDemand demand = demand_of(k);
      const double factor = std::sqrt(demand.weight * (demand.exact ? exact_weight : 1));
      if (!demand.angle) {
        const std::optional<NearestPoint> near = nearest_point(a, b, poses[k], length);
        if (!near) return false;
        r[2 * k] = factor * near->miss;
        r[2 * k + 1] = 0;
        for (std::size_t j = 0; j < na + nb && !jacobian.empty(); ++j) {
          jacobian[j * m + 2 * k] = factor * (j < na ? near->of_first * near->first.dyad[j]
                                                     : near->of_second * near->second.dyad[j - na]);
          jacobian[j * m + 2 * k + 1] = 0;
        }
        continue;
      }
      const std::optional<Nearest2> near = nearest_pose(a, b, poses[k], length);
      if (!near) return false;
      r[2 * k] = factor * near->miss[0];
      r[2 * k + 1] = factor * near->miss[1];
      if (jacobian.empty()) continue;
      for (std::size_t j = 0; j < na + nb; ++j) {
        const double ga = j < na ? near->first.dyad[j] : 0, gb = j < na ? 0 : near->second.dyad[j - na];
        const double upper = ga / near->l00;
        jacobian[j * m + 2 * k] = factor * upper;
        jacobian[j * m + 2 * k + 1] = factor * (gb - near->l10 * upper) / near->l11;
      }
    }
    return true;
  };
  math::LeastSquaresWorkspace workspace;
  math::LeastSquaresOptions options;
  options.max_iterations = 200;
  options.lambda_max = 1e12;
  options.decrease_tolerance = 1e-26;
  options.relative_decrease_tolerance = 1e-12;
  options.geodesic_acceleration = any_exact;
  math::LeastSquaresReport report;
  for (const double weight : exact_weights) {
    exact_weight = weight;
    report = math::minimise_least_squares(residuals, m, x, options, workspace);
    if (!any_exact) break;
  }
  PoseFit out;
  out.first = with_numbers(first, x.data());
  out.second = with_numbers(second, x.data() + na);
  out.converged = report.end != math::LeastSquaresEnd::start && std::isfinite(report.cost);
  std::vector<BodyPose> exact;
  for (std::size_t k = 0; k < n; ++k)
    if (demand_of(k).exact) exact.push_back(poses[k]);
  if (!meet(exact, out.first, length) || !meet(exact, out.second, length)) out.converged = false;
  // A length of the other sign is a link of the same length the other way round.
  for (GuidingDyad* dyad : {&out.first, &out.second})
    if (dyad->type == GuidingDyadType::rr && dyad->length < 0) out.converged = false;
  for (std::size_t k = 0; k < n; ++k) {
    const PoseDemand demand = demand_of(k);
    double square = 0;
    BodyPose reached = poses[k];
    if (demand.angle) {
      const std::optional<Nearest2> near = nearest_pose(out.first, out.second, poses[k], length);
      if (!near) out.converged = false;
      if (near) reached = near->reached, square = std::pow(near->miss[0], 2) + std::pow(near->miss[1], 2);
    } else {
      const std::optional<NearestPoint> near = nearest_point(out.first, out.second, poses[k], length);
      if (!near) out.converged = false;
      if (near) reached = near->reached, square = near->miss * near->miss;
    }
    out.reached.push_back(reached);
    out.cost += demand.weight * square;
  }
  return out;
}

}  // namespace linkwright::planar
