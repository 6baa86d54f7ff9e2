// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/fit.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/path/detail/multipliers.h"
#include "linkwright/planar/path/slider_crank/detail/kernel.h"

namespace linkwright::planar {
namespace {

using P = SliderParameter;
using Complex = std::complex<double>;
constexpr std::size_t count = slider_parameter_count;

// Rows of the constraints; the order rows follow, one a point.
constexpr std::size_t rod_rows = 0, stroke_rows = 4, order_rows = 6;

// Points are met one after the other with at least this much crank rotation between them (rad).
constexpr double min_step = 1e-4;
// Longest step: angles in rad, lengths of links as a share of the length.
constexpr double max_turn = 0.5, max_change = 0.6;

std::array<double, count> regular_terms(double size) {
  std::array<double, count> out{};
  for (std::size_t j = 0; j < count; ++j) out[j] = is_angle(P(j)) ? 1e-14 : 1e-14 / (size * size);
  return out;
}

}  // namespace

SliderPathFitter::SliderPathFitter(const SliderPathProblem& problem, double sense)
    : problem_(problem),
      sense_(sense),
      size_(path_size(problem)),
      stroke_(problem.stroke),
      equations_(regular_terms(size_), problem.x.size(), problem.free_timing()) {
  require_valid(problem);
  for (std::size_t j = 0; j < count; ++j) {
    variable_[j] = !problem.bounds[j].fixed() && !(P(j) == P::start_angle && problem.free_timing());
    lower_[j] = problem.bounds[j].lower;
    upper_[j] = problem.bounds[j].upper;
    // An angle that may take any direction has no bounds.
    if (is_angle(P(j)) && upper_[j] - lower_[j] >= 2 * pi * (1 - 1e-9)) {
      lower_[j] = -infinity;
      upper_[j] = infinity;
    }
    if (is_length(P(j))) lower_[j] = std::min(upper_[j], std::max(lower_[j], 1e-9 * size_));
  }
  angles_.resize(problem.x.size());
  trial_angles_ = angles_;
  multipliers_.resize(order_rows + problem.x.size());
  values_.resize(order_rows + problem.x.size());
}

double SliderPathFitter::crank_angle(const Shared& q, const std::vector<double>& angles,
                                     std::size_t k) const {
  return problem_.free_timing() ? angles[k] : q[index(P::start_angle)] + sense_ * problem_.angles[k];
}

void SliderPathFitter::add_constraint(std::size_t row, double value, const Shared& gradient, bool derivatives,
                                      double& merit, std::size_t point, double by_angle) {
  values_[row] = value;
  const double c = value + multipliers_[row] / penalty_;
  if (c <= 0) return;
  merit += 0.5 * penalty_ * c * c;
  if (derivatives) equations_.add_row(penalty_, c, gradient, point, by_angle);
}

// |offset - L2 sin phi| <= L3 sin alpha: with a crank that turns fully for every phase, which is linear; else
// at the extremes of the arc.
void SliderPathFitter::limit_rod(const Shared& q, const std::vector<double>& angles, bool derivatives,
                                 double& merit) {
  const double crank = q[index(P::crank)], rod = q[index(P::rod)], offset = q[index(P::offset)];
  const double sine = std::sin(problem_.max_pressure_angle), w = 1 / size_;
  Shared by{};
  if (problem_.crank_rotates_fully) {
    for (const double side : {1.0, -1.0}) {
      by[index(P::crank)] = w;
      by[index(P::rod)] = -sine * w;
      by[index(P::offset)] = side * w;
      add_constraint(rod_rows + (side > 0 ? 0 : 1), w * (crank + side * offset - sine * rod), by, derivatives,
                     merit);
    }
    return;
  }
  if (problem_.max_pressure_angle >= pi / 2) return;  // constraints of assembly at the points are met there
  struct Extreme {
    double sine, cosine;  // functions of the phase
    std::size_t point;
  };
  Extreme highest{-infinity, 0, 0}, lowest{infinity, 0, 0};
  double low = infinity, high = -infinity;
  for (std::size_t k = 0; k < problem_.x.size(); ++k) {
    const double phase = crank_angle(q, angles, k) - q[index(P::guide_angle)], s = std::sin(phase);
    low = std::min(low, phase);
    high = std::max(high, phase);
    if (s > highest.sine) highest = {s, std::cos(phase), k};
    if (s < lowest.sine) lowest = {s, std::cos(phase), k};
  }
  if (2 * pi * std::floor((high - 0.5 * pi) / (2 * pi)) + 0.5 * pi >= low) highest = {1, 0, 0};
  if (2 * pi * std::floor((high - 1.5 * pi) / (2 * pi)) + 1.5 * pi >= low) lowest = {-1, 0, 0};
  std::size_t row = rod_rows;
  for (const Extreme& e : {highest, lowest}) {
    const double value = (offset - crank * e.sine) / rod, by_phase = -crank * e.cosine / rod;
    for (const double side : {1.0, -1.0}) {
      by[index(P::crank)] = -side * e.sine / rod;
      by[index(P::rod)] = -side * value / rod;
      by[index(P::offset)] = side / rod;
      by[index(P::guide_angle)] = -side * by_phase;
      by[index(P::start_angle)] = problem_.free_timing() ? 0 : side * by_phase;
      add_constraint(row++, side * value - sine, by, derivatives, merit, e.point,
                     problem_.free_timing() ? side * by_phase : 0);
    }
  }
}

// Outer dead point s1, inner one s2, stroke s1 - s2 <= limit as (s1 - limit)|s1 - limit| <= s2^2: smooth also
// where s2 = 0, which is where a mechanism stands that just turns fully.
void SliderPathFitter::limit_way(const Shared& q, bool derivatives, double& merit) {
  const double crank = q[index(P::crank)], rod = q[index(P::rod)], offset = q[index(P::offset)];
  const double sum = rod + crank, difference = rod - crank;
  const double outer = std::sqrt(std::max(1e-300, (sum - offset) * (sum + offset)));
  const double w = 1 / (size_ * size_);
  const auto limit = [&](std::size_t row, double stroke, double side) {
    const double beyond = outer - stroke, slope = 2 * std::abs(beyond) / outer;
    const double value = beyond * std::abs(beyond) - (difference - offset) * (difference + offset);
    Shared by{};
    by[index(P::crank)] = side * w * (slope * sum + 2 * difference);
    by[index(P::rod)] = side * w * (slope * sum - 2 * difference);
    by[index(P::offset)] = side * w * (2 * offset - slope * offset);
    add_constraint(row, side * w * value, by, derivatives, merit);
  };
  if (stroke_.upper < infinity) limit(stroke_rows, stroke_.upper, 1);
  if (stroke_.lower > 0) limit(stroke_rows + 1, stroke_.lower, -1);
}

void SliderPathFitter::keep_order(const std::vector<double>& angles, bool derivatives, double& merit) {
  const std::size_t n = angles.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    double value = min_step - sense_ * (angles[next] - angles[k]);
    // The last row closes the turn: a closed path leaves room for one more step, an open one stays within
    // one.
    if (next == 0) value = (problem_.closed ? min_step : 0) - 2 * pi - sense_ * (angles[0] - angles[n - 1]);
    const std::size_t row = order_rows + k;
    values_[row] = value;
    const double c = value + multipliers_[row] / penalty_;
    if (c <= 0) continue;
    merit += 0.5 * penalty_ * c * c;
    if (derivatives) equations_.add_step(penalty_, c, k, -sense_);
  }
}

bool SliderPathFitter::evaluate(const Shared& q, const std::vector<double>& angles, bool derivatives,
                                double& merit) {
  ++evaluations_;
  if (derivatives) equations_.clear();
  const double crank = q[index(P::crank)], rod = q[index(P::rod)], offset = q[index(P::offset)];
  const double distance = q[index(P::point_distance)], w = 1 / size_;
  const Complex guide = std::polar(1.0, q[index(P::guide_angle)]), i(0, 1);
  const Complex toward = guide * std::polar(1.0, q[index(P::point_angle)]),
                pivot(q[index(P::pivot_x)], q[index(P::pivot_y)]);
  double sum = 0;
  for (std::size_t k = 0; k < problem_.x.size(); ++k) {
    const double phase = crank_angle(q, angles, k) - q[index(P::guide_angle)];
    const double c = std::cos(phase), s = std::sin(phase);
    const RodClosure<double> closure = close_rod(crank * s, offset, 1 / rod);
    if (!(closure.radicand > 0)) return false;
    const math::Vec2 direction = rod_direction(closure, side_);
    const Complex v(direction.x, direction.y), arm = distance * toward * v,
                                               pin = crank * guide * Complex(c, s);
    const Complex point = pivot + pin + arm;
    const TargetMiss miss = target_miss(problem_, k, point.real(), point.imag());
    const Complex off(w * miss.x, w * miss.y);
    sum += std::norm(off);
    if (!derivatives) continue;
    // theta3 - delta changes by d sine / cosine.
    const Complex turned = i * arm / direction.x;
    const Complex by_phase = i * pin - crank * c / rod * turned;
    std::array<Complex, count> by;
    by[index(P::crank)] = guide * Complex(c, s) - s / rod * turned;
    by[index(P::rod)] = -closure.sine / rod * turned;
    by[index(P::point_distance)] = toward * v;
    by[index(P::point_angle)] = i * arm;
    by[index(P::guide_angle)] = i * (pin + arm) - by_phase;
    by[index(P::offset)] = turned / rod;
    by[index(P::pivot_x)] = 1;
    by[index(P::pivot_y)] = i;
    by[index(P::start_angle)] = problem_.free_timing() ? 0 : by_phase;
    Shared x_by{}, y_by{};
    const auto missed_by = [&](const Complex& moved) {
      return Complex(w * (miss.xx * moved.real() + miss.xy * moved.imag()),
                     w * (miss.xy * moved.real() + miss.yy * moved.imag()));
    };
    for (std::size_t j = 0; j < count; ++j) {
      const Complex column = missed_by(by[j]);
      x_by[j] = column.real(), y_by[j] = column.imag();
    }
    const Complex own = problem_.free_timing() ? missed_by(by_phase) : 0;
    equations_.add_point(k, off.real(), off.imag(), x_by, y_by, own.real(), own.imag());
  }
  error_ = sum * size_ * size_;
  merit = 0.5 * sum;
  limit_rod(q, angles, derivatives, merit);
  limit_way(q, derivatives, merit);
  if (problem_.free_timing()) keep_order(angles, derivatives, merit);
  return std::isfinite(merit);
}

double SliderPathFitter::descend(const PathFitOptions& options) {
  double merit = infinity;
  if (!evaluate(q_, angles_, true, merit)) return infinity;
  double lambda = 1e-2;
  for (int iteration = 0; iteration < options.iterations && lambda < 1e10; ++iteration) {
    const Shared& gradient = equations_.gradient();
    for (std::size_t j = 0; j < count; ++j)
      held_[j] =
          !variable_[j] || (q_[j] <= lower_[j] && gradient[j] > 0) || (q_[j] >= upper_[j] && gradient[j] < 0);
    if (!equations_.solve(lambda, held_)) {
      lambda *= 10;
      continue;
    }
    const Shared& step = equations_.step();
    double shrink = 1;
    const auto limit = [&](double size, double longest) {
      if (std::abs(size) * shrink > longest) shrink = longest / std::abs(size);
    };
    for (const P j : {P::crank, P::rod}) limit(step[index(j)], max_change * q_[index(j)]);
    for (const P j : {P::point_angle, P::guide_angle, P::start_angle}) limit(step[index(j)], max_turn);
    if (problem_.free_timing())
      for (const double turn : equations_.angle_step()) limit(turn, max_turn);
    for (std::size_t j = 0; j < count; ++j)
      trial_q_[j] = variable_[j] ? std::clamp(q_[j] + shrink * step[j], lower_[j], upper_[j]) : q_[j];
    if (problem_.free_timing())
      for (std::size_t k = 0; k < angles_.size(); ++k)
        trial_angles_[k] = angles_[k] + shrink * equations_.angle_step()[k];
    double trial = infinity;
    const double error_before = error_;
    if (evaluate(trial_q_, trial_angles_, false, trial) && trial < merit) {
      const double decrease = merit - trial;
      q_ = trial_q_;
      std::swap(angles_, trial_angles_);
      evaluate(q_, angles_, true, merit);
      lambda = std::max(lambda * 0.2, 1e-15);
      if (decrease <= options.decrease * merit || merit < 1e-30) break;
    } else {
      error_ = error_before;
      lambda *= 4;
    }
  }
  return merit;
}

SliderPathFit SliderPathFitter::fit(const SliderCrankMechanism& start, const std::vector<double>& angles,
                                    const PathFitOptions& options) {
  LINKWRIGHT_REQUIRE(angles.size() == problem_.x.size(), "{} angles for {} points", angles.size(),
                     problem_.x.size());
  const SliderCrankForm& f = start.parameters;
  side_ = sign(start.branch);
  evaluations_ = 0;
  q_ = {f.crank,
        f.rod,
        std::hypot(f.rod_u, f.rod_v),
        f.rod_u == 0 && f.rod_v == 0 ? 0 : std::atan2(f.rod_v, f.rod_u),
        f.guide_angle,
        f.offset,
        f.pivot_x,
        f.pivot_y,
        problem_.free_timing() ? 0 : angles[0] - sense_ * problem_.angles[0]};
  for (std::size_t j = 0; j < count; ++j) {
    if (is_angle(P(j)) && std::isfinite(lower_[j]) && variable_[j])
      q_[j] -= 2 * pi * std::floor((q_[j] - lower_[j]) / (2 * pi));
    if (variable_[j])
      q_[j] = std::clamp(q_[j], lower_[j], upper_[j]);
    else if (!(P(j) == P::start_angle && problem_.free_timing()))
      q_[j] = problem_.bounds[j].lower;
  }
  angles_ = angles;
  penalty_ = options.penalty;

  SliderPathFit out;
  out.violation = minimise_by_multipliers(
      options.passes, multipliers_, values_, penalty_, [&] { return descend(options); },
      [&] {
        double merit = 0;
        evaluate(q_, angles_, false, merit);
      });
  out.error = std::isfinite(out.violation) ? error_ : infinity;
  const Complex point = std::polar(1.0, q_[index(P::point_angle)]) * q_[index(P::point_distance)];
  out.linkage.branch = start.branch;
  out.linkage.parameters = {.crank = q_[index(P::crank)],
                            .rod = q_[index(P::rod)],
                            .offset = q_[index(P::offset)],
                            .guide_angle = q_[index(P::guide_angle)],
                            .pivot_x = q_[index(P::pivot_x)],
                            .pivot_y = q_[index(P::pivot_y)],
                            .rod_u = point.real(),
                            .rod_v = point.imag()};
  out.angles = angles_;
  if (!problem_.free_timing())
    for (std::size_t k = 0; k < angles_.size(); ++k) out.angles[k] = crank_angle(q_, angles_, k);
  out.evaluations = evaluations_;
  return out;
}

}  // namespace linkwright::planar
