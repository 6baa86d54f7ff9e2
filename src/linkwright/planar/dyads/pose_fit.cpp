#include "linkwright/planar/dyads/pose_fit.h"

#include <array>
#include <cmath>
#include <complex>
#include <optional>

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

// Where the body is nearest to a pose with both gaps closed. With J the slopes of the gaps by the pose in
// lengths and J J' = L L', the way there is J' lambda; `miss` = L' lambda has its length, and moves with the
// gaps by L^-1.
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
                 double length) {
  LINKWRIGHT_REQUIRE(poses.size() >= 3, "{} poses", poses.size());
  LINKWRIGHT_REQUIRE(length > 0 && std::isfinite(length), "length {}", length);
  const std::size_t n = poses.size(), m = 2 * n;
  const std::size_t na = count_of(first.type), nb = count_of(second.type);
  std::vector<double> x(na + nb);
  numbers_of(first, x.data());
  numbers_of(second, x.data() + na);
  const auto residuals = [&](std::span<const double> at, std::span<double> r, std::span<double> jacobian) {
    const GuidingDyad a = with_numbers(first, at.data()), b = with_numbers(second, at.data() + na);
    for (std::size_t k = 0; k < n; ++k) {
      const std::optional<Nearest2> near = nearest_pose(a, b, poses[k], length);
      if (!near) return false;
      r[2 * k] = near->miss[0];
      r[2 * k + 1] = near->miss[1];
      if (jacobian.empty()) continue;
      for (std::size_t j = 0; j < na + nb; ++j) {
        const double ga = j < na ? near->first.dyad[j] : 0, gb = j < na ? 0 : near->second.dyad[j - na];
        const double upper = ga / near->l00;
        jacobian[j * m + 2 * k] = upper;
        jacobian[j * m + 2 * k + 1] = (gb - near->l10 * upper) / near->l11;
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
  const math::LeastSquaresReport report = math::minimise_least_squares(residuals, m, x, options, workspace);
  PoseFit out;
  out.first = with_numbers(first, x.data());
  out.second = with_numbers(second, x.data() + na);
  out.cost = 2 * report.cost;
  out.converged = report.end != math::LeastSquaresEnd::start && std::isfinite(report.cost);
  // A length of the other sign is a link of the same length the other way round.
  for (GuidingDyad* dyad : {&out.first, &out.second})
    if (dyad->type == GuidingDyadType::rr && dyad->length < 0) out.converged = false;
  for (const BodyPose& pose : poses) {
    const std::optional<Nearest2> near = nearest_pose(out.first, out.second, pose, length);
    if (!near) out.converged = false;
    out.reached.push_back(near ? near->reached : pose);
  }
  return out;
}

}  // namespace linkwright::planar
