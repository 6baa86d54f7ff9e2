// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/four_bar/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/kernel.h"
#include "linkwright/planar/path/detail/multipliers.h"
#include "linkwright/planar/path/task.h"

namespace linkwright::planar {
namespace {

using P = FourBarParameter;

// Rows of the constraints; the order rows follow, one a point.
constexpr std::size_t crank_rows = 0, transmission_rows = 3, packaging_rows = 7, region_rows = 11,
                      order_rows = 15;

// Largest number of times that a step is repeated because a variable would pass its bound.
constexpr int max_stops_at_bounds = 4;

// Longest step: crank and frame angles in rad, lengths as a share of the length.
constexpr double max_turn = 0.5, max_change = 0.6;

constexpr std::size_t width = four_bar_parameter_count;
static_assert(width % 2 == 0);

// matrix += a b', the lower triangle and, as numbers go in pairs, at most one entry beyond its diagonal.
void add_product(const double* a, const double* b, double* matrix) {
  using Pair [[gnu::vector_size(16)]] = double;
#pragma GCC unroll 10
  for (std::size_t i = 0; i < width; ++i) {
#pragma GCC unroll 5
    for (std::size_t j = 0; j <= i; j += 2) {
      Pair right, sum;
      std::memcpy(&right, b + j, sizeof right);
      std::memcpy(&sum, matrix + i * width + j, sizeof sum);
      sum += a[i] * right;
      std::memcpy(matrix + i * width + j, &sum, sizeof sum);
    }
  }
}

// Copies the lower triangle to the upper one.
void mirror(double* matrix) {
  for (std::size_t i = 0; i < width; ++i)
    for (std::size_t j = i + 1; j < width; ++j) matrix[i * width + j] = matrix[j * width + i];
}

}  // namespace

PathFitter::PathFitter(const PathProblem& problem, double sense)
    : problem_(problem),
      sense_(sense),
      size_(path_size(problem)),
      free_timing_(problem.timing == Timing::free),
      bands_(has_bands(problem)) {
  require_valid(problem);
  for (std::size_t j = 0; j < shared; ++j) {
    variable_[j] =
        !problem.bounds[j].fixed() && !(j == index(P::start_angle) && !starts_anywhere(problem.timing));
    lower_[j] = problem.bounds[j].lower;
    upper_[j] = problem.bounds[j].upper;
    // An angle that may take any direction has no bounds.
    if (j >= index(P::frame_angle) && upper_[j] - lower_[j] >= 2 * pi * (1 - 1e-9)) {
      lower_[j] = -infinity;
      upper_[j] = infinity;
    }
    if (j <= index(P::rocker)) lower_[j] = std::min(upper_[j], std::max(lower_[j], 1e-9 * size_));
  }
  if (problem.packaging) {
    const auto tighten = [&](P parameter, double low, double high) {
      const std::size_t j = index(parameter);
      if (!variable_[j]) return;
      lower_[j] = std::max(lower_[j], low);
      upper_[j] = std::max(lower_[j], std::min(upper_[j], high));
    };
    tighten(P::pivot_x, problem.packaging->x_min, problem.packaging->x_max);
    tighten(P::pivot_y, problem.packaging->y_min, problem.packaging->y_max);
  }
  const std::size_t points = problem.x.size();
  angles_.resize(points);
  trial_angles_ = step_angles_ = angle_gradient_ = diagonal_ = neighbour_ = angles_;
  coupling_.resize(points * shared);
  eliminated_.resize(points * (shared + 1));
  elimination_.resize(points);
  multipliers_.resize(order_rows + points);
  values_.resize(order_rows + points);
}

double PathFitter::crank_angle(const std::array<double, shared>& q, const std::vector<double>& angles,
                               std::size_t k) const {
  return free_timing_ ? angles[k] : q[index(P::start_angle)] + sense_ * point_angle(problem_, k);
}

void PathFitter::add_constraint(std::size_t row, double value, const std::array<double, shared>& gradient,
                                bool derivatives, double& merit, std::size_t point, double by_angle) {
  values_[row] = value;
  const double c = value + multipliers_[row] / penalty_;
  if (c <= 0) return;
  merit += 0.5 * penalty_ * c * c;
  if (!derivatives) return;
  for (std::size_t i = 0; i < shared; ++i) {
    if (gradient[i] == 0) continue;
    gradient_[i] += penalty_ * c * gradient[i];
    for (std::size_t j = 0; j < shared; ++j) hessian_[i * shared + j] += penalty_ * gradient[i] * gradient[j];
    if (by_angle != 0) coupling_[point * shared + i] += penalty_ * gradient[i] * by_angle;
  }
  if (by_angle == 0) return;
  angles_coupled_ = true;
  angle_gradient_[point] += penalty_ * c * by_angle;
  diagonal_[point] += penalty_ * by_angle * by_angle;
}

void PathFitter::evaluate_constraints(const std::array<double, shared>& q, const std::vector<double>& angles,
                                      bool derivatives, double& merit) {
  const double l1 = q[0], l2 = q[1], l3 = q[2], l4 = q[3];
  const auto negative = [](std::array<double, shared> g) {
    for (double& v : g) v = -v;
    return g;
  };
  if (problem_.crank_rotates_fully) {
    // Linear on either side of the change point L1 = L2.
    const double s = crank_shorter_ ? 1 : -1, w = 1 / size_;
    add_constraint(crank_rows, w * (l1 + l2 - l3 - l4), {w, w, -w, -w}, derivatives, merit);
    add_constraint(crank_rows + 1, w * (s * (l2 - l1) + l3 - l4), {-s * w, s * w, w, -w}, derivatives, merit);
    add_constraint(crank_rows + 2, w * (s * (l2 - l1) - l3 + l4), {-s * w, s * w, -w, w}, derivatives, merit);
  }
  if (problem_.min_transmission_angle > 0) {
    // |cos mu| <= cos(mu_min) at both extremes of the distance R of A and B0: for a full turn those with
    // crank and ground in line, else those of the arc from the first point to the last.
    const double limit = std::cos(problem_.min_transmission_angle), product = 2 * l3 * l4;
    struct Extreme {
      double cosine, sine;  // functions of the crank angle
      std::size_t point;
    };
    std::array<Extreme, 2> extremes = {{{1, 0, 0}, {-1, 0, 0}}};
    if (!problem_.crank_rotates_fully) {
      double low = infinity, high = -infinity;
      extremes[0].cosine = -infinity;
      extremes[1].cosine = infinity;
      for (std::size_t k = 0; k < problem_.x.size(); ++k) {
        const double angle = crank_angle(q, angles, k), c = std::cos(angle);
        low = std::min(low, angle);
        high = std::max(high, angle);
        if (c > extremes[0].cosine) extremes[0] = {c, std::sin(angle), k};
        if (c < extremes[1].cosine) extremes[1] = {c, std::sin(angle), k};
      }
      if (2 * pi * std::floor(high / (2 * pi)) >= low) extremes[0] = {1, 0, 0};
      if (2 * pi * std::floor((high - pi) / (2 * pi)) + pi >= low) extremes[1] = {-1, 0, 0};
    }
    for (std::size_t e = 0; e < 2; ++e) {
      const auto [c, s, point] = extremes[e];
      const double r2 = l1 * l1 + l2 * l2 - 2 * l1 * l2 * c;
      const double cosine = (l3 * l3 + l4 * l4 - r2) / product;
      std::array<double, shared> d = {-2 * (l1 - l2 * c) / product, -2 * (l2 - l1 * c) / product,
                                      2 * l3 / product - cosine / l3, 2 * l4 / product - cosine / l4};
      double by_angle = -2 * l1 * l2 * s / product;
      if (!free_timing_) d[index(P::start_angle)] = std::exchange(by_angle, 0.0);
      const std::size_t row = transmission_rows + 2 * e;
      add_constraint(row, cosine - limit, d, derivatives, merit, point, by_angle);
      add_constraint(row + 1, -cosine - limit, negative(d), derivatives, merit, point, -by_angle);
    }
  }
  if (problem_.packaging) evaluate_box(*problem_.packaging, packaging_rows, q, derivatives, merit);
  if (problem_.rocker_pivot) evaluate_box(*problem_.rocker_pivot, region_rows, q, derivatives, merit);
}

// The rocker pivot inside a box; the crank pivot has bounds of its own.
void PathFitter::evaluate_box(const PackagingBox& box, std::size_t row, const std::array<double, shared>& q,
                              bool derivatives, double& merit) {
  const double l1 = q[0], w = 1 / size_, c = std::cos(q[8]), s = std::sin(q[8]);
  const double bx = q[6] + l1 * c, by = q[7] + l1 * s;
  const auto keep = [&](std::size_t side, double value, double sign, std::size_t coordinate, double by_length,
                        double by_angle) {
    if (!std::isfinite(value)) return;  // no limit on this side
    std::array<double, shared> g{};
    g[0] = sign * w * by_length, g[coordinate] = sign * w, g[8] = sign * w * by_angle;
    add_constraint(row + side, w * value, g, derivatives, merit);
  };
  keep(0, bx - box.x_max, 1, 6, c, -l1 * s);
  keep(1, box.x_min - bx, -1, 6, c, -l1 * s);
  keep(2, by - box.y_max, 1, 7, s, l1 * c);
  keep(3, box.y_min - by, -1, 7, s, l1 * c);
}

void PathFitter::evaluate_order(const std::vector<double>& angles, bool derivatives, double& merit) {
  const std::size_t n = angles.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    double value = problem_.min_step - sense_ * (angles[next] - angles[k]);
    // The last row closes the turn: a closed path leaves room for one more step, an open one stays within a
    // turn.
    if (next == 0)
      value = (problem_.closed ? problem_.min_step : 0) - 2 * pi - sense_ * (angles[0] - angles[n - 1]);
    const std::size_t row = order_rows + k;
    values_[row] = value;
    const double c = value + multipliers_[row] / penalty_;
    if (c <= 0) continue;
    merit += 0.5 * penalty_ * c * c;
    if (!derivatives) continue;
    angles_coupled_ = true;
    angle_gradient_[k] += penalty_ * c * sense_;
    angle_gradient_[next] -= penalty_ * c * sense_;
    if (next != 0) {
      diagonal_[k] += penalty_;
      diagonal_[next] += penalty_;
      neighbour_[k] -= penalty_;
    } else {
      // The corner entry would break the tridiagonal form: replaced by its diagonal upper bound.
      diagonal_[k] += 2 * penalty_;
      diagonal_[0] += 2 * penalty_;
    }
  }
}

bool PathFitter::evaluate(const std::array<double, shared>& q, const std::vector<double>& angles,
                          bool derivatives, double& merit) {
  ++evaluations_;
  const std::size_t n = problem_.x.size();
  const double l1 = q[0], l2 = q[1], l3 = q[2], l4 = q[3], cu = q[4], cv = q[5];
  const double fc = std::cos(q[8]), fs = std::sin(q[8]), w = 1 / size_;
  if (derivatives) {
    hessian_.fill(0);
    along_.fill(0);
    gradient_.fill(0);
    along_gradient_.fill(0);
    angles_coupled_ = false;
    std::fill(diagonal_.begin(), diagonal_.end(), 0.0);
    std::fill(neighbour_.begin(), neighbour_.end(), 0.0);
    std::fill(angle_gradient_.begin(), angle_gradient_.end(), 0.0);
  }
  // One residual and its row of the Jacobian.
  const auto add_row = [](const double* row, double residual, double* hessian, double* gradient) {
    add_product(row, row, hessian);
    for (std::size_t i = 0; i < shared; ++i) gradient[i] += row[i] * residual;
  };
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = crank_angle(q, angles, k);
    const double ux = std::cos(angle), uy = std::sin(angle);
    const Closure<double> c = close_loop(l1, 0.0, l2 * ux, l2 * uy, l3, l4, branch_);
    if (!(c.radicand > 0)) return false;
    const math::Vec2 v = coupler_direction(c, l3);
    // Relative frame first: z = L2 u + l v.
    const double lx = cu * v.x - cv * v.y, ly = cu * v.y + cv * v.x;
    const double zx = l2 * ux + lx, zy = l2 * uy + ly;
    const double px = q[6] + fc * zx - fs * zy, py = q[7] + fs * zx + fc * zy;
    TargetMiss miss{px - problem_.x[k], py - problem_.y[k]};
    if (bands_) miss = target_miss(problem_, k, px, py);
    const double ex = w * miss.x, ey = w * miss.y;
    sum += ex * ex + ey * ey;
    if (!derivatives) continue;
    const double rx = l2 * ux + l3 * v.x - l1, ry = l2 * uy + l3 * v.y;  // rocker vector
    const double inverse = 1 / (l3 * (ry * v.x - rx * v.y));
    const double gx = -ly, gy = lx;  // d(l v) / d theta3
    const double turn[4] = {rx * inverse, -(rx * ux + ry * uy) * inverse, -(rx * v.x + ry * v.y) * inverse,
                            l4 * inverse};
    const double turn_crank = -(ry * ux - rx * uy) * l2 * inverse;
    // Columns in the relative frame, turned into the global one below.
    double jx[shared] = {
        turn[0] * gx, turn[1] * gx + ux, turn[2] * gx, turn[3] * gx, v.x, -v.y, 0, 0, -zy, 0};
    double jy[shared] = {turn[0] * gy, turn[1] * gy + uy, turn[2] * gy, turn[3] * gy, v.y, v.x, 0, 0, zx, 0};
    jx[9] = turn_crank * gx - l2 * uy;
    jy[9] = turn_crank * gy + l2 * ux;
    for (std::size_t j = 0; j < shared; ++j) {
      const double x = w * (fc * jx[j] - fs * jy[j]), y = w * (fs * jx[j] + fc * jy[j]);
      jx[j] = x;
      jy[j] = y;
    }
    jx[6] = jy[7] = w;
    if (bands_)
      for (std::size_t j = 0; j < shared; ++j) {
        const double x = jx[j], y = jy[j];
        jx[j] = miss.xx * x + miss.xy * y;
        jy[j] = miss.xy * x + miss.yy * y;
      }
    const double tx = jx[9], ty = jy[9], square = tx * tx + ty * ty;
    if (!free_timing_ || !(square > 0)) {
      if (free_timing_) std::fill_n(&coupling_[k * shared], shared, 0.0);
      add_row(jx, ex, hessian_.data(), gradient_.data());
      add_row(jy, ey, hessian_.data(), gradient_.data());
      continue;
    }
    // Along the path and across it: the crank angle of the point moves it along only.
    const double length = std::sqrt(square), dx = tx / length, dy = ty / length;
    jx[9] = jy[9] = 0;
    double along[shared], across[shared];
    for (std::size_t j = 0; j < shared; ++j) {
      along[j] = dx * jx[j] + dy * jy[j];
      across[j] = dx * jy[j] - dy * jx[j];
      coupling_[k * shared + j] = length * along[j];
    }
    diagonal_[k] = square;
    angle_gradient_[k] = tx * ex + ty * ey;
    add_row(along, dx * ex + dy * ey, along_.data(), along_gradient_.data());
    add_row(across, dx * ey - dy * ex, hessian_.data(), gradient_.data());
  }
  if (derivatives) {
    mirror(along_.data());
    mirror(hessian_.data());
    for (std::size_t i = 0; i < hessian_.size(); ++i) hessian_[i] += along_[i];
    for (std::size_t i = 0; i < shared; ++i) gradient_[i] += along_gradient_[i];
  }
  error_ = sum * size_ * size_;
  merit = 0.5 * sum;
  evaluate_constraints(q, angles, derivatives, merit);
  if (free_timing_) evaluate_order(angles, derivatives, merit);
  return std::isfinite(merit);
}

// Takes the crank angles out of the normal equations, which have a tridiagonal block: (T + lambda D) Z =
// [coupling, gradient], a -= coupling' Z, b += coupling' Z_gradient. Leaves Z in `eliminated_`.
void PathFitter::eliminate_angles(double lambda, double* a, double* b) {
  const std::size_t n = problem_.x.size(), columns = shared + 1;
  regular_ = true;
  double previous = 0;
  for (std::size_t k = 0; k < n; ++k) {
    double* row = &eliminated_[k * columns];
    for (std::size_t j = 0; j < shared; ++j) row[j] = coupling_[k * shared + j];
    row[shared] = angle_gradient_[k];
    double pivot = diagonal_[k] * (1 + lambda) + 1e-14;
    if (k > 0) {
      const double factor = neighbour_[k - 1] / previous;
      pivot -= factor * neighbour_[k - 1];
      for (std::size_t j = 0; j < columns; ++j) row[j] -= factor * eliminated_[(k - 1) * columns + j];
    }
    if (!(pivot > 0)) {
      regular_ = false;
      return;
    }
    elimination_[k] = previous = pivot;
  }
  for (std::size_t k = n; k-- > 0;) {
    double* row = &eliminated_[k * columns];
    const double inverse = 1 / elimination_[k];
    for (std::size_t j = 0; j < columns; ++j) {
      if (k + 1 < n) row[j] -= neighbour_[k] * eliminated_[(k + 1) * columns + j];
      row[j] *= inverse;
    }
    const double* coupling = &coupling_[k * shared];
    double minus[shared];
    for (std::size_t i = 0; i < shared; ++i) {
      b[i] += coupling[i] * row[shared];
      minus[i] = -coupling[i];
    }
    add_product(minus, row, a);
  }
  mirror(a);
}

bool PathFitter::solve_step(double lambda) {
  const std::size_t n = problem_.x.size(), columns = shared + 1;
  using Block = Eigen::Matrix<double, shared, shared, Eigen::RowMajor>;
  Block a = Eigen::Map<const Block>(hessian_.data());
  Eigen::Matrix<double, shared, 1> b = -Eigen::Map<const Eigen::Matrix<double, shared, 1>>(gradient_.data());
  const Eigen::Matrix<double, shared, 1> scale = a.diagonal();
  if (free_timing_ && angles_coupled_) {
    eliminate_angles(lambda, a.data(), b.data());
    if (!regular_) return false;
  } else if (free_timing_) {
    a -= Eigen::Map<const Block>(along_.data()) / (1 + lambda);
    b += Eigen::Map<const Eigen::Matrix<double, shared, 1>>(along_gradient_.data()) / (1 + lambda);
  }
  // The term that keeps the matrix regular has the units of its entry.
  for (std::size_t i = 0; i < shared; ++i)
    a(i, i) += lambda * scale[i] + (i < index(P::frame_angle) ? 1e-14 / (size_ * size_) : 1e-14);
  for (std::size_t i = 0; i < shared; ++i)
    if (!variable_[i] || held_[i]) b -= a.col(i) * held_step_[i];
  for (std::size_t i = 0; i < shared; ++i) {
    if (variable_[i] && !held_[i]) continue;
    a.row(i).setZero();
    a.col(i).setZero();
    a(i, i) = 1;
    b[i] = held_step_[i];
  }
  const Eigen::LLT<Eigen::Matrix<double, shared, shared>> cholesky(a);
  if (cholesky.info() != Eigen::Success) return false;
  const Eigen::Matrix<double, shared, 1> step = cholesky.solve(b);
  if (!step.allFinite()) return false;
  for (std::size_t i = 0; i < shared; ++i) step_q_[i] = step[i];
  if (!free_timing_) return true;
  for (std::size_t k = 0; k < n; ++k) {
    double sum = 0;
    if (angles_coupled_) {
      sum = eliminated_[k * columns + shared];
      for (std::size_t j = 0; j < shared; ++j) sum += eliminated_[k * columns + j] * step[j];
    } else {
      sum = angle_gradient_[k];
      for (std::size_t j = 0; j < shared; ++j) sum += coupling_[k * shared + j] * step[j];
      sum /= diagonal_[k] * (1 + lambda) + 1e-14;
    }
    step_angles_[k] = -sum;
  }
  return true;
}

// The share of the step, 1 at most, that keeps it within the longest one.
double PathFitter::shrink_to_longest() const {
  double shrink = 1;
  const auto limit = [&](double step, double longest) {
    if (std::abs(step) * shrink > longest) shrink = longest / std::abs(step);
  };
  for (std::size_t i = 0; i <= index(P::rocker); ++i) limit(step_q_[i], max_change * q_[i]);
  limit(step_q_[index(P::frame_angle)], max_turn);
  limit(step_q_[index(P::start_angle)], max_turn);
  if (free_timing_)
    for (double step : step_angles_) limit(step, max_turn);
  return shrink;
}

// A step whose variables stay within their bounds: one that would pass goes to its bound, and the others are
// solved for again. Clipped without that, a step along a narrow valley leaves the valley at every bound. With
// prescribed timing the step is only clipped: those searches start far beyond the bounds, where the first
// steps decide which answer is found, and a step along several bounds at once leads to worse ones.
bool PathFitter::solve_within_bounds(double lambda) {
  held_step_.fill(0);
  for (std::size_t i = 0; i < shared; ++i)
    held_[i] = (q_[i] <= lower_[i] && gradient_[i] > 0) || (q_[i] >= upper_[i] && gradient_[i] < 0);
  for (int stops = 0;; ++stops) {
    if (!solve_step(lambda)) return false;
    const double shrink = shrink_to_longest();
    bool passed = false;
    for (std::size_t i = 0; i < shared; ++i) {
      const double end = q_[i] + shrink * step_q_[i];
      if (!variable_[i] || held_[i] || (end >= lower_[i] && end <= upper_[i])) continue;
      held_[i] = passed = true;
      held_step_[i] = (end < lower_[i] ? lower_[i] : upper_[i]) - q_[i];
    }
    if (!passed || !free_timing_ || stops == max_stops_at_bounds) return true;
  }
}

double PathFitter::descend(const PathFitOptions& options) {
  double merit = infinity;
  if (!evaluate(q_, angles_, true, merit)) return infinity;
  double lambda = 1e-2;
  for (int iteration = 0; iteration < options.iterations && lambda < 1e10; ++iteration) {
    if (!solve_within_bounds(lambda)) {
      lambda *= 10;
      continue;
    }
    const double shrink = shrink_to_longest();
    for (std::size_t i = 0; i < shared; ++i)
      trial_q_[i] = variable_[i] ? std::clamp(q_[i] + shrink * step_q_[i], lower_[i], upper_[i]) : q_[i];
    if (free_timing_)
      for (std::size_t k = 0; k < angles_.size(); ++k)
        trial_angles_[k] = angles_[k] + shrink * step_angles_[k];
    double trial = infinity;
    const double error_before = error_;
    if (evaluate(trial_q_, trial_angles_, false, trial) && trial < merit) {
      const double decrease = merit - trial;
      q_ = trial_q_;
      std::swap(angles_, trial_angles_);
      trial_angles_ = angles_;
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

PathFit PathFitter::fit(const FourBar& start, const std::vector<double>& angles,
                        const PathFitOptions& options) {
  LINKWRIGHT_REQUIRE(angles.size() == problem_.x.size(), "{} angles for {} points", angles.size(),
                     problem_.x.size());
  branch_ = sign(start.branch);
  crank_shorter_ = start.crank <= start.ground;
  evaluations_ = 0;
  q_ = {start.ground,      start.crank,
        start.coupler,     start.rocker,
        start.coupler_u,   start.coupler_v,
        start.pivot_x,     start.pivot_y,
        start.frame_angle, starts_anywhere(problem_.timing) ? angles[0] : 0.0};
  for (std::size_t i = 0; i < shared; ++i) {
    if (i >= index(P::frame_angle) && std::isfinite(lower_[i]) && variable_[i])
      q_[i] -= 2 * pi * std::floor((q_[i] - lower_[i]) / (2 * pi));
    if (!variable_[i] && i != index(P::start_angle)) q_[i] = problem_.bounds[i].lower;
    if (variable_[i]) q_[i] = std::clamp(q_[i], lower_[i], upper_[i]);
  }
  if (starts_anywhere(problem_.timing) && !variable_[9]) q_[9] = problem_.bounds[9].lower;
  angles_ = angles;
  penalty_ = options.penalty;

  PathFit out;
  out.violation = minimise_by_multipliers(
      options.passes, multipliers_, values_, penalty_, [&] { return descend(options); },
      [&] {
        double merit = 0;
        evaluate(q_, angles_, false, merit);
      });
  out.error = std::isfinite(out.violation) ? error_ : infinity;
  out.linkage = {.ground = q_[0],
                 .crank = q_[1],
                 .coupler = q_[2],
                 .rocker = q_[3],
                 .coupler_u = q_[4],
                 .coupler_v = q_[5],
                 .pivot_x = q_[6],
                 .pivot_y = q_[7],
                 .frame_angle = q_[8],
                 .branch = start.branch};
  out.angles = angles_;
  if (!free_timing_)
    for (std::size_t k = 0; k < angles_.size(); ++k)
      out.angles[k] = q_[9] + sense_ * point_angle(problem_, k);
  out.evaluations = evaluations_;
  return out;
}

}  // namespace linkwright::planar
