// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/projection.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/path/slider_crank/detail/kernel.h"

namespace linkwright::planar {
namespace {

using Complex = std::complex<double>;
using P = SliderParameter;
// Columns closer to the span of the earlier ones than this are dropped: the unknown does not matter there.
constexpr double slider_rank_tolerance = 1e-10;
constexpr double largest_ratio = 1e6;
// The crank vanishes only for targets that need no motion of the crank pin; it stays a mechanism.
constexpr double min_crank = 1e-9;

// sum conj(x_k) y_k
Complex inner(const std::vector<double>& xr, const std::vector<double>& xi, const double* yr,
              const double* yi) {
  double re = 0, im = 0;
  for (std::size_t k = 0; k < xr.size(); ++k) {
    re += xr[k] * yr[k] + xi[k] * yi[k];
    im += xr[k] * yi[k] - xi[k] * yr[k];
  }
  return {re, im};
}
// y -= c x
void subtract(double* yr, double* yi, Complex c, const std::vector<double>& xr,
              const std::vector<double>& xi) {
  for (std::size_t k = 0; k < xr.size(); ++k) {
    yr[k] -= c.real() * xr[k] - c.imag() * xi[k];
    yi[k] -= c.real() * xi[k] + c.imag() * xr[k];
  }
}
Complex mean(const double* re, const double* im, std::size_t n) {
  Complex sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += Complex(re[k], im[k]);
  return sum / static_cast<double>(n);
}
void shift(double* re, double* im, std::size_t n, Complex by) {
  for (std::size_t k = 0; k < n; ++k) re[k] -= by.real(), im[k] -= by.imag();
}
// Brings a column to unit length; 0 when there is nothing left of it.
double normalise(std::vector<double>& re, std::vector<double>& im) {
  double square = 0;
  for (std::size_t k = 0; k < re.size(); ++k) square += re[k] * re[k] + im[k] * im[k];
  // The columns began as unit vectors.
  const bool there = square > slider_rank_tolerance * slider_rank_tolerance * static_cast<double>(re.size());
  const double length = there ? std::sqrt(square) : 0, scale = there ? 1 / length : 0;
  for (std::size_t k = 0; k < re.size(); ++k) re[k] *= scale, im[k] *= scale;
  return length;
}

}  // namespace

bool SliderPathProjection::applies(const SliderPathProblem& p) {
  const auto fixed = [&](P j) { return p.bounds[index(j)].fixed(); };
  const auto whole = [&](P j) {
    const Range& r = p.bounds[index(j)];
    return r.fixed() || r.upper - r.lower >= 2 * pi * (1 - 1e-9);
  };
  return !p.free_timing() && !fixed(P::rod) && !fixed(P::offset) && !fixed(P::point_distance) &&
         !fixed(P::point_angle) && fixed(P::pivot_x) == fixed(P::pivot_y) && whole(P::start_angle) &&
         whole(P::guide_angle);
}

SliderPathProjection::SliderPathProjection(const SliderPathProblem& p, SliderSide side, double sense)
    : side_(sign(side)),
      sense_(sense),
      size_(path_size(p)),
      sine_(std::sin(p.max_pressure_angle)),
      turns_(p.crank_rotates_fully),
      x_(p.x),
      y_(p.y) {
  require_valid(p);
  LINKWRIGHT_REQUIRE(applies(p), "the unknowns of this problem are not free");
  LINKWRIGHT_REQUIRE(sense == 1 || sense == -1, "sense must be +1 or -1, got {}", sense);
  const auto range = [&](P j) { return p.bounds[index(j)]; };
  crank_ = range(P::crank), rod_ = range(P::rod), offset_ = range(P::offset);
  pivot_fixed_ = range(P::pivot_x).fixed();
  guide_fixed_ = range(P::guide_angle).fixed();
  start_fixed_ = range(P::start_angle).fixed();
  phase_fixed_ = guide_fixed_ && start_fixed_;
  guide_ = range(P::guide_angle).lower;
  start_ = range(P::start_angle).lower;
  limit_stroke(p.stroke);
  const std::size_t n = x_.size();
  if (pivot_fixed_) {
    pivot_ = {range(P::pivot_x).lower, range(P::pivot_y).lower};
    shift(x_.data(), y_.data(), n, pivot_);
  }
  for (const double offset : p.angles) {
    offset_x_.push_back(std::cos(sense * offset));
    offset_y_.push_back(std::sin(sense * offset));
  }
  for (auto* v : {&ux_, &uy_, &vx_, &vy_, &qux_, &quy_, &qvx_, &qvy_}) v->resize(n);
  rest_.resize(2 * n);
}

void SliderPathProjection::limit_stroke(const Range& stroke) {
  LINKWRIGHT_REQUIRE(stroke.lower >= 0 && stroke.lower <= stroke.upper && stroke.upper > 0,
                     "the stroke is limited to {} to {}", stroke.lower, stroke.upper);
  LINKWRIGHT_REQUIRE(turns_ || (stroke.lower == 0 && stroke.upper == infinity),
                     "the stroke is limited, but the crank need not rotate fully");
  stroke_ = stroke;
}

bool SliderPathProjection::ratios(std::span<const double> q) {
  if (turns_) {
    const double a = std::exp(q[0]), b = std::exp(q[1]);
    rho_ = (1 + 0.5 * (a + b)) / sine_;
    eta_ = 0.5 * (b - a);
  } else {
    rho_ = std::exp(q[0]);
    eta_ = q[1];
  }
  phase_ = phase_fixed_ ? start_ - guide_ : q[2];
  return rho_ > 0 && rho_ < largest_ratio && std::abs(eta_) < largest_ratio;
}

bool SliderPathProjection::limits(Length& low, Length& high) const {
  low = {std::max(crank_.lower, min_crank * size_), 0, 0};
  high = {crank_.upper, 0, 0};
  const auto at_least = [&](const Length& l) {
    if (l.value > low.value) low = l;
  };
  const auto at_most = [&](const Length& l) {
    if (l.value < high.value) high = l;
  };
  const auto over_rho = [&](double length) { return Length{length / rho_, -length / (rho_ * rho_), 0}; };
  at_least(over_rho(rod_.lower));
  at_most(over_rho(rod_.upper));
  // The offset is eta |a|: between its bounds, whichever sign eta has.
  const auto over_eta = [&](double length) { return Length{length / eta_, 0, -length / (eta_ * eta_)}; };
  const double near = eta_ >= 0 ? offset_.lower : offset_.upper,
               far = eta_ >= 0 ? offset_.upper : offset_.lower;
  const double toward = eta_ >= 0 ? 1 : -1;
  if (toward * far < 0 || (eta_ == 0 && toward * near > 0)) return false;
  if (toward * near > 0) at_least(over_eta(near));
  if (eta_ != 0) at_most(over_eta(far));
  if (stroke_.lower > 0 || stroke_.upper < infinity) {
    const double outer = std::sqrt((rho_ + 1 - eta_) * (rho_ + 1 + eta_));
    // A mechanism on the edge of turning fully has an inner dead point at the foot of its pivot.
    const double inner = std::sqrt(std::max(1e-300, (rho_ - 1 - eta_) * (rho_ - 1 + eta_)));
    const double s = 4 * rho_ / (outer + inner);
    const double by_rho = (1 + rho_) / outer - (rho_ - 1) / inner, by_eta = eta_ / inner - eta_ / outer;
    const auto over_stroke = [&](double stroke) {
      return Length{stroke / s, -stroke / (s * s) * by_rho, -stroke / (s * s) * by_eta};
    };
    at_least(over_stroke(stroke_.lower));
    if (stroke_.upper < infinity) at_most(over_stroke(stroke_.upper));
  }
  return low.value <= high.value;
}

bool SliderPathProjection::project(std::span<const double> q) {
  Length low, high;
  if (!ratios(q) || !limits(low, high)) return false;
  const std::size_t n = x_.size();
  const double start_x = std::cos(phase_), start_y = std::sin(phase_), inverse = 1 / rho_;
  bool assembles = true;
  for (std::size_t k = 0; k < n; ++k) {
    qux_[k] = ux_[k] = start_x * offset_x_[k] - start_y * offset_y_[k];
    quy_[k] = uy_[k] = start_x * offset_y_[k] + start_y * offset_x_[k];
    const RodClosure<double> c = close_rod(uy_[k], eta_, inverse);
    assembles &= c.radicand > 0;
    const math::Vec2 v = rod_direction(c, side_);
    qvx_[k] = vx_[k] = v.x;
    qvy_[k] = vy_[k] = v.y;
  }
  if (!assembles) return false;

  double *rx = rest_.data(), *ry = rest_.data() + n;
  std::copy(x_.begin(), x_.end(), rx);
  std::copy(y_.begin(), y_.end(), ry);
  Complex mean_p, mean_u, mean_v;
  if (!pivot_fixed_) {
    mean_p = mean(rx, ry, n);
    mean_u = mean(ux_.data(), uy_.data(), n);
    mean_v = mean(vx_.data(), vy_.data(), n);
    shift(rx, ry, n, mean_p);
    shift(qux_.data(), quy_.data(), n, mean_u);
    shift(qvx_.data(), qvy_.data(), n, mean_v);
  }
  const double length_v = normalise(qvx_, qvy_);
  const Complex u_on_v = inner(qvx_, qvy_, qux_.data(), quy_.data());
  subtract(qux_.data(), quy_.data(), u_on_v, qvx_, qvy_);
  const double length_u = normalise(qux_, quy_);
  const Complex p_on_v = inner(qvx_, qvy_, rx, ry);
  subtract(rx, ry, p_on_v, qvx_, qvy_);
  const Complex p_on_u = inner(qux_, quy_, rx, ry);

  // The best a, then the nearest one that is allowed.
  const Complex best = length_u > 0 ? p_on_u / length_u : 0;
  const double guide = guide_fixed_ ? guide_ : start_ - phase_;
  if (guide_fixed_ || start_fixed_) {
    ray_ = std::polar(1.0, guide);
    const double along = (std::conj(ray_) * best).real();
    const double length = std::clamp(along, low.value, high.value);
    along_ = length == along ? Along::ray : Along::none;
    active_ = along < low.value ? low : high;
    a_ = length * ray_;
  } else {
    const double free = std::abs(best), length = std::clamp(free, low.value, high.value);
    along_ = length == free ? Along::plane : Along::circle;
    active_ = free < low.value ? low : high;
    a_ = free > 0 ? best * (length / free) : Complex(length);
  }
  subtract(rx, ry, a_ * length_u, qux_, quy_);
  b_ = length_v > 0 ? (p_on_v - a_ * u_on_v) / length_v : 0;
  p_ = pivot_fixed_ ? pivot_ : mean_p - a_ * mean_u - b_ * mean_v;
  return true;
}

bool SliderPathProjection::evaluate(std::span<const double> q, std::span<double> residual,
                                    std::span<double> jacobian) {
  if (!project(q)) return false;
  const std::size_t n = x_.size(), m = 2 * n;
  std::copy(rest_.begin(), rest_.end(), residual.begin());
  if (jacobian.empty()) return true;

  // d(rho, eta) / dq.
  double chain[2][2] = {{rho_, 0}, {0, 1}};
  if (turns_) {
    const double a = 0.5 * std::exp(q[0]), b = 0.5 * std::exp(q[1]);
    chain[0][0] = a / sine_, chain[0][1] = -a;
    chain[1][0] = b / sine_, chain[1][1] = b;
  }
  const double length = std::abs(a_), inverse = 1 / rho_;
  const Complex direction = length > 0 ? a_ / length : Complex(1);
  const bool held = along_ == Along::circle || along_ == Along::none;
  Complex stretched[2] = {};  // da/dq where a lies on an end of its interval
  if (held)
    for (int i = 0; i < 2; ++i)
      stretched[i] = direction * (active_.by_rho * chain[i][0] + active_.by_eta * chain[i][1]);
  for (std::size_t k = 0; k < n; ++k) {
    const Complex u(ux_[k], uy_[k]), turned = b_ * Complex(-vy_[k], vx_[k]);  // d(b v) / d theta3
    const double by_sine = 1 / vx_[k];
    const double by_rho = -vy_[k] * inverse * by_sine, by_eta = inverse * by_sine;
    for (std::size_t i = 0; i < 2; ++i) {
      const Complex d = (by_rho * chain[i][0] + by_eta * chain[i][1]) * turned + stretched[i] * u;
      jacobian[i * m + k] = -d.real();
      jacobian[i * m + n + k] = -d.imag();
    }
    if (phase_fixed_) continue;
    // The guide turns back as the phase advances where crank angles are given: the crank pins stay.
    Complex d = -ux_[k] * inverse * by_sine * turned;
    if (!start_fixed_) d += Complex(0, 1) * a_ * u;
    jacobian[2 * m + k] = -d.real();
    jacobian[2 * m + n + k] = -d.imag();
  }
  // Take away what the linear unknowns make good.
  for (std::size_t i = 0; i < variables(); ++i) {
    double *re = &jacobian[i * m], *im = re + n;
    if (!pivot_fixed_) shift(re, im, n, mean(re, im, n));
    subtract(re, im, inner(qvx_, qvy_, re, im), qvx_, qvy_);
    if (along_ == Along::none) continue;
    Complex on_u = inner(qux_, quy_, re, im);
    if (along_ != Along::plane) {
      const Complex way = along_ == Along::ray ? ray_ : Complex(0, 1) * direction;
      on_u = (std::conj(way) * on_u).real() * way;
    }
    subtract(re, im, on_u, qux_, quy_);
  }
  return true;
}

SliderPathProjection::Recovered SliderPathProjection::recover(std::span<const double> q) {
  LINKWRIGHT_REQUIRE(project(q), "q is not a slider-crank that reaches its guide at every point");
  Recovered out;
  const double crank = std::abs(a_);
  double guide = guide_fixed_ ? guide_ : start_fixed_ ? start_ - phase_ : std::arg(a_);
  if (!guide_fixed_) guide -= 2 * pi * std::floor(guide / (2 * pi));
  const Complex point = b_ * std::polar(1.0, -guide);
  out.linkage.branch = side_ > 0 ? SliderSide::forward : SliderSide::backward;
  out.linkage.parameters = {.crank = crank,
                            .rod = rho_ * crank,
                            .offset = eta_ * crank,
                            .guide_angle = guide,
                            .pivot_x = p_.real(),
                            .pivot_y = p_.imag(),
                            .rod_u = point.real(),
                            .rod_v = point.imag()};
  out.start = start_fixed_ ? start_ : phase_ + guide;
  if (!start_fixed_) out.start -= 2 * pi * std::floor(out.start / (2 * pi));
  return out;
}

SliderPathDesign SliderPathProjection::design(const SliderPathProblem& problem, std::span<const double> q) {
  const Recovered found = recover(q);
  std::vector<double> angles;
  for (const double offset : problem.angles) angles.push_back(found.start + sense_ * offset);
  return measure(problem, found.linkage, sense_, std::move(angles));
}

std::vector<double> SliderPathProjection::unknowns(const SliderCrankForm& f, double start) const {
  const double rho = f.rod / f.crank, eta = f.offset / f.crank;
  std::vector<double> q;
  if (turns_) {
    constexpr double least = 1e-12;
    q = {std::log(std::max(least, sine_ * rho - 1 - eta)), std::log(std::max(least, sine_ * rho - 1 + eta))};
  } else {
    q = {std::log(rho), eta};
  }
  if (!phase_fixed_) q.push_back(start - f.guide_angle);
  return q;
}

std::vector<double> SliderPathProjection::random(RandomStream& stream) const {
  std::vector<double> q(variables());
  q[0] = turns_ ? stream.uniform(-3, 3) : stream.uniform(-1.5, 1.5);
  q[1] = turns_ ? stream.uniform(-3, 3) : stream.uniform(-1, 1);
  if (!phase_fixed_) q[2] = stream.uniform(0, 2 * pi);
  return q;
}

}  // namespace linkwright::planar
