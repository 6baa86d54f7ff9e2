// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/projection.h"

#include <Eigen/Core>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/kernel.h"

namespace linkwright::planar {
namespace {

// Columns closer to the span of the earlier ones than this are dropped: the unknown does not matter there.
constexpr double rank_tolerance = 1e-10;

using Column = Eigen::Map<Eigen::VectorXd>;
using ConstColumn = Eigen::Map<const Eigen::VectorXd>;

double dot(const double* a, const double* b, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  return ConstColumn(a, size).dot(ConstColumn(b, size));
}

void subtract(double* a, double factor, const double* b, std::size_t n) {
  const auto size = static_cast<Eigen::Index>(n);
  Column(a, size) -= factor * ConstColumn(b, size);
}

}  // namespace

std::array<double, 3> link_ratios(RatioKind kind, std::span<const double> q) {
  const double a1 = std::exp(q[0]), a2 = std::exp(q[1]), a3 = std::exp(q[2]);
  switch (kind) {
    case RatioKind::crank_rocker:
      return {1 + 0.5 * (a2 + a3), 1 + 0.5 * (a1 + a2), 1 + 0.5 * (a1 + a3)};
    case RatioKind::double_crank:
      return {1 - 0.5 * (a2 + a3), 1 + 0.5 * (a1 - a3), 1 + 0.5 * (a1 - a2)};
    case RatioKind::any:
      break;
  }
  return {a1, a2, a3};
}

std::vector<double> random_ratios(RatioKind kind, std::size_t variables, RandomStream& stream) {
  std::vector<double> q(variables);
  do {
    const double width = kind == RatioKind::any ? 1.5 : 3;
    for (std::size_t i = 0; i < 3; ++i) q[i] = stream.uniform(-width, width);
  } while (kind == RatioKind::double_crank && std::exp(q[1]) + std::exp(q[2]) >= 2);
  if (variables > 3) q[3] = stream.uniform(0, 2 * pi);
  return q;
}

std::vector<double> PathProjection::random(RandomStream& stream) const {
  return random_ratios(kind_, variables(), stream);
}

bool PathProjection::applies(const PathProblem& p) {
  const auto fixed = [&](FourBarParameter j) { return p.bounds[index(j)].fixed(); };
  using P = FourBarParameter;
  if (p.timing == Timing::free || fixed(P::ground) || fixed(P::crank) || fixed(P::coupler) ||
      fixed(P::rocker) || fixed(P::coupler_u) || fixed(P::coupler_v))
    return false;
  return fixed(P::pivot_x) == fixed(P::pivot_y) && !(starts_anywhere(p.timing) && fixed(P::start_angle));
}

PathProjection::PathProjection(const PathProblem& p, RatioKind kind, Branch branch, double sense)
    : kind_(kind), branch_(branch), sense_(sense), size_(path_size(p)), x_(p.x), y_(p.y) {
  require_valid(p);
  LINKWRIGHT_REQUIRE(applies(p), "the linear unknowns of this problem are not free");
  const auto& bounds = p.bounds;
  start_is_variable_ = starts_anywhere(p.timing);
  pivot_fixed_ = bounds[index(FourBarParameter::pivot_x)].fixed();
  frame_fixed_ = bounds[index(FourBarParameter::frame_angle)].fixed();
  frame_ = std::polar(1.0, frame_fixed_ ? bounds[index(FourBarParameter::frame_angle)].lower : 0.0);
  if (pivot_fixed_) {
    pivot_ = {bounds[index(FourBarParameter::pivot_x)].lower, bounds[index(FourBarParameter::pivot_y)].lower};
    for (std::size_t k = 0; k < x_.size(); ++k) {
      x_[k] -= pivot_.real();
      y_[k] -= pivot_.imag();
    }
  }
  for (std::size_t k = 0; k < x_.size(); ++k) {
    offset_x_.push_back(std::cos(sense * point_angle(p, k)));
    offset_y_.push_back(std::sin(sense * point_angle(p, k)));
  }
  columns_ = (pivot_fixed_ ? 0 : 2) + (frame_fixed_ ? 1 : 2) + 2;
  for (auto* v : {&ux_, &uy_, &vx_, &vy_}) v->resize(x_.size());
  rest_.resize(residuals());
  q_.resize(columns_ * residuals());
}

bool PathProjection::project(std::span<const double> q) {
  const std::size_t n = x_.size(), m = 2 * n;
  ratio_ = link_ratios(kind_, q);
  const auto [r1, r3, r4] = ratio_;
  if (!(r1 > 0 && r3 > 0 && r4 > 0 && r1 < 1e6 && r3 < 1e6 && r4 < 1e6)) return false;

  const double start_x = start_is_variable_ ? std::cos(q[3]) : 1,
               start_y = start_is_variable_ ? std::sin(q[3]) : 0;
  const double side = sign(branch_);
  bool assembles = true;
  for (std::size_t k = 0; k < n; ++k) {
    ux_[k] = start_x * offset_x_[k] - start_y * offset_y_[k];
    uy_[k] = start_x * offset_y_[k] + start_y * offset_x_[k];
    const Closure<double> c = close_loop(r1, 0.0, ux_[k], uy_[k], r3, r4, side);
    assembles &= c.radicand >= 0 && c.r2 > 0;
    const math::Vec2 v = coupler_direction(c, r3);
    vx_[k] = v.x;
    vy_[k] = v.y;
  }
  // By construction the crank rotates fully; only rounding at a change point can say otherwise.
  if (!assembles) return false;

  // Columns: [1, i,] a u [, i u], v, i v; real parts first, then imaginary parts. Modified Gram-Schmidt.
  for (std::size_t k = 0; k < n; ++k) {
    rest_[k] = x_[k];
    rest_[n + k] = y_[k];
    std::size_t c = 0;
    const auto put = [&](double re, double im) {
      q_[c * m + k] = re;
      q_[c * m + n + k] = im;
      ++c;
    };
    if (!pivot_fixed_) {
      put(1, 0);
      put(0, 1);
    }
    if (frame_fixed_) {
      put(frame_.real() * ux_[k] - frame_.imag() * uy_[k], frame_.real() * uy_[k] + frame_.imag() * ux_[k]);
    } else {
      put(ux_[k], uy_[k]);
      put(-uy_[k], ux_[k]);
    }
    put(vx_[k], vy_[k]);
    put(-vy_[k], vx_[k]);
  }
  for (std::size_t c = 0; c < columns_; ++c) {
    double* column = &q_[c * m];
    const double before = std::sqrt(dot(column, column, m));
    for (std::size_t e = 0; e < c; ++e) {
      r_[e * 6 + c] = dot(&q_[e * m], column, m);
      subtract(column, r_[e * 6 + c], &q_[e * m], m);
    }
    const double norm = std::sqrt(dot(column, column, m));
    r_[c * 6 + c] = norm;
    const double scale = norm > rank_tolerance * before ? 1 / norm : 0;
    if (scale == 0) r_[c * 6 + c] = 0;
    for (std::size_t i = 0; i < m; ++i) column[i] *= scale;
    coefficient_[c] = dot(column, rest_.data(), m);
    subtract(rest_.data(), coefficient_[c], column, m);
  }
  for (std::size_t c = columns_; c-- > 0;) {
    double sum = coefficient_[c];
    for (std::size_t e = c + 1; e < columns_; ++e) sum -= r_[c * 6 + e] * coefficient_[e];
    coefficient_[c] = r_[c * 6 + c] > 0 ? sum / r_[c * 6 + c] : 0;
  }
  return true;
}

bool PathProjection::evaluate(std::span<const double> q, std::span<double> residual,
                              std::span<double> jacobian) {
  if (!project(q)) return false;
  const std::size_t n = x_.size(), m = 2 * n;
  for (std::size_t i = 0; i < m; ++i) residual[i] = rest_[i];
  if (jacobian.empty()) return true;

  const auto [r1, r3, r4] = ratio_;
  const std::size_t first = pivot_fixed_ ? 0 : 2;
  double ax = coefficient_[first], ay = 0;
  if (frame_fixed_) {
    ay = ax * frame_.imag();
    ax *= frame_.real();
  } else {
    ay = coefficient_[first + 1];
  }
  const double bx = coefficient_[columns_ - 2], by = coefficient_[columns_ - 1];
  // d(r1, r3, r4) / dq_i, by kind.
  const double h1 = 0.5 * std::exp(q[0]), h2 = 0.5 * std::exp(q[1]), h3 = 0.5 * std::exp(q[2]);
  double chain[3][3] = {};
  switch (kind_) {
    case RatioKind::crank_rocker:
      chain[0][1] = chain[0][2] = h1;
      chain[1][0] = chain[1][1] = h2;
      chain[2][0] = chain[2][2] = h3;
      break;
    case RatioKind::double_crank:
      chain[0][1] = chain[0][2] = h1;
      chain[1][0] = chain[1][2] = -h2;
      chain[2][0] = chain[2][1] = -h3;
      break;
    case RatioKind::any:
      for (int i = 0; i < 3; ++i) chain[i][i] = ratio_[static_cast<std::size_t>(i)];
      break;
  }
  for (std::size_t k = 0; k < n; ++k) {
    // Unit crank: w = u + r3 v - r1, D = Re(conj(w) i r3 v), g = i b v; d(theta3) = [Re w, -Re(conj(w) v),
    // r4, ...] / D.
    const double wx = ux_[k] + r3 * vx_[k] - r1, wy = uy_[k] + r3 * vy_[k];
    const double inverse = 1 / (r3 * (wy * vx_[k] - wx * vy_[k]));
    const double gx = -(bx * vy_[k] + by * vx_[k]), gy = bx * vx_[k] - by * vy_[k];
    const double t1 = wx * inverse, t3 = -(wx * vx_[k] + wy * vy_[k]) * inverse, t4 = r4 * inverse;
    for (std::size_t i = 0; i < 3; ++i) {
      const double t = chain[i][0] * t1 + chain[i][1] * t3 + chain[i][2] * t4;
      jacobian[i * m + k] = -t * gx;
      jacobian[i * m + n + k] = -t * gy;
    }
    if (start_is_variable_) {
      const double t = -(wy * ux_[k] - wx * uy_[k]) * inverse;  // -Re(conj(w) i u) / D
      jacobian[3 * m + k] = ax * uy_[k] + ay * ux_[k] - t * gx;
      jacobian[3 * m + n + k] = -(ax * ux_[k] - ay * uy_[k]) - t * gy;
    }
  }
  for (std::size_t i = 0; i < variables(); ++i)
    for (std::size_t c = 0; c < columns_; ++c)
      subtract(&jacobian[i * m], dot(&q_[c * m], &jacobian[i * m], m), &q_[c * m], m);
  return true;
}

PathDesign PathProjection::design(const PathProblem& problem, std::span<const double> q) {
  LINKWRIGHT_REQUIRE(project(q), "q is not a linkage that assembles at every point");
  const std::size_t first = pivot_fixed_ ? 0 : 2;
  std::complex<double> a = frame_fixed_ ? coefficient_[first] * frame_
                                        : std::complex<double>(coefficient_[first], coefficient_[first + 1]);
  const std::complex<double> b(coefficient_[columns_ - 2], coefficient_[columns_ - 1]);
  // The crank vanishes only for targets that need no motion of the crank pin; keep it a linkage.
  double scale = frame_fixed_ ? coefficient_[first] : std::abs(a);
  const double smallest = 1e-9 * size_;
  if (!(std::abs(scale) >= smallest)) scale = smallest;
  // A fixed frame may ask for a negative scale, which is no linkage: taken positive, it fits worse than the
  // residuals say, and the measured error confirms it.
  const std::complex<double> direction = frame_fixed_ ? frame_ : (a == 0.0 ? 1.0 : a / std::abs(a));
  const std::complex<double> point = b / direction;
  FourBar l;
  l.crank = std::abs(scale);
  l.ground = ratio_[0] * l.crank;
  l.coupler = ratio_[1] * l.crank;
  l.rocker = ratio_[2] * l.crank;
  l.coupler_u = point.real();
  l.coupler_v = point.imag();
  l.pivot_x = pivot_fixed_ ? pivot_.real() : coefficient_[0];
  l.pivot_y = pivot_fixed_ ? pivot_.imag() : coefficient_[1];
  l.frame_angle =
      frame_fixed_ ? problem.bounds[index(FourBarParameter::frame_angle)].lower : std::arg(direction);
  if (l.frame_angle < 0 && !frame_fixed_) l.frame_angle += 2 * pi;
  l.branch = branch_;
  std::vector<double> angles(problem.x.size());
  double start = start_is_variable_ ? q[3] - 2 * pi * std::floor(q[3] / (2 * pi)) : 0.0;
  for (std::size_t k = 0; k < angles.size(); ++k) angles[k] = start + sense_ * point_angle(problem, k);
  return measure(problem, l, sense_, std::move(angles));
}

}  // namespace linkwright::planar
