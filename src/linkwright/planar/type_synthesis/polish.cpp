// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/polish.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/dimension_limits.h"
#include "linkwright/planar/type_synthesis/detail/turn_measurer.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t samples = stroke_samples;
constexpr std::size_t limit_angles = 48;  // grid of the pair angles during the polish
constexpr std::size_t limit_minima = 16;  // minima of the pair angle over the turn that a polish heeds
constexpr double margin =
    0.05 * pi / 180;  // the polish keeps this much more of the pair angle than it promises
constexpr double nearly_kept = 4e-4, far_from_kept = 0.05;  // what a polish may miss of its limits
constexpr double spare_where_met = 0.01;  // error after a stage that is small where many machines have none
// A sample within its tolerance has no error. It keeps this part of its derivative, so that a step does not
// throw it out, and hardly keeps others from moving.
constexpr double held_within_tolerance = 0.1;
constexpr double rounding_of_tolerance = 1e-9;  // the polish ends at the edge of a tolerance
constexpr double open_rest = 0.02;              // an open stroke leaves this much of a turn (rad)

using Samples = std::array<double, samples>;

/// Brings a sequence into ascending order with the least sum of squared changes (pool adjacent violators).
void restore_order(std::span<double> v) {
  std::array<double, samples> mean;
  std::array<std::size_t, samples> count;
  std::size_t pools = 0;
  for (const double value : v) {
    mean[pools] = value, count[pools] = 1, ++pools;
    while (pools > 1 && mean[pools - 2] > mean[pools - 1]) {
      const double a = static_cast<double>(count[pools - 2]), b = static_cast<double>(count[pools - 1]);
      mean[pools - 2] = (a * mean[pools - 2] + b * mean[pools - 1]) / (a + b);
      count[pools - 2] += count[pools - 1];
      --pools;
    }
  }
  for (std::size_t i = 0, k = 0; i < pools; ++i)
    for (std::size_t c = 0; c < count[i]; ++c) v[k++] = mean[i];
}

}  // namespace

struct MachineFitter::Memory {
  Memory(const MotionTarget& wanted, const MachineLimits& kept)
      : target(wanted),
        limits(kept),
        tolerant(target.has_tolerance()),
        dimensions(kept),
        turn(target),
        rows(column_length() * (max_machine_parameters + 3)) {}

  MotionTarget target;
  MachineLimits limits;
  bool tolerant = false;  // some samples have a tolerance
  std::int64_t curves = 0;
  DimensionLimits dimensions;
  TurnMeasurer turn;
  double min_quality = 0;
  double phase = 0;  // of the grid of pair angles; each polish begins with the same

  struct Curve {
    alignas(64) Samples angle, x, y, tx, ty;
    alignas(64) Samples bx, by, rate;  ///< of the traced bar
    alignas(64) Samples ex, ey, ea;    ///< errors of place and of angle (rad)
    double body_angle = 0;
    double squares = 0;
  };
  Curve now, next;
  std::vector<double> rows;  ///< of the residuals' derivatives, then the residuals
  /// Directions of the residuals of each sample: along the place, and the angle as a length.
  struct Direction {
    alignas(64) Samples x, y, a;
  };
  std::array<Direction, 3> directions;
  alignas(64) std::array<double, limit_angles> limit_angle, quality, worst;
  LimitRows limit_rows, pivot_rows;

  /// Residuals of a sample: normal to the curve where the time is free, else both coordinates; and the angle.
  std::size_t residuals() const {
    return !target.placed() ? 1u : (target.timed ? 2u : 1u) + (target.oriented ? 1u : 0u);
  }
  std::size_t column_length() const { return residuals() * target.count; }
  /// Unknowns beside the parameters: the start of the crank and the angle of the body on its bar.
  int extra_unknowns() const { return (target.timed ? 1 : 0) + (target.oriented ? 1 : 0); }
  std::size_t count() const { return target.count; }

  const PointProgram& program_of(const MachineShape& shape) {
    dimensions.set_program(*shape.program);
    return *shape.program;
  }

  CurveTask task_of(const PointProgram& p, const double* x, unsigned signs, Curve& c) const {
    CurveTask task{.program = &p,
                   .x = x,
                   .signs = signs,
                   .angle = c.angle.data(),
                   .count = count(),
                   .px = c.x.data(),
                   .py = c.y.data(),
                   .tx = c.tx.data(),
                   .ty = c.ty.data()};
    if (target.oriented) task.bx = c.bx.data(), task.by = c.by.data(), task.rate = c.rate.data();
    return task;
  }

  void compute(const PointProgram& p, const double* x, unsigned signs, Curve& c) {
    ++curves;
    compute_curve(task_of(p, x, signs, c));
    double sum = 0;
    for (std::size_t k = 0; k < count(); ++k) {
      double ex = c.x[k] - target.x[k], ey = c.y[k] - target.y[k];
      if (tolerant && target.tolerance[k] > 0) {
        const double distance = std::hypot(ex, ey);
        const double beyond = distance > target.tolerance[k] ? 1 - target.tolerance[k] / distance : 0;
        ex *= beyond, ey *= beyond;
      }
      c.ex[k] = ex, c.ey[k] = ey;
      if (target.oriented) c.ea[k] = angle_error(c, k);
    }
    for (const RestingSamples& rest : target.rests)
      subtract_mean(rest, target.placed() ? c.ex.data() : c.ea.data());
    for (std::size_t k = 0; k < count(); ++k) {
      double square = target.placed() ? c.ex[k] * c.ex[k] + c.ey[k] * c.ey[k] : 0;
      if (target.oriented) {
        const double across = target.angle_length * c.ea[k];
        square += across * across;
      }
      sum += target.weight[k] * square;
    }
    c.squares = sum;
  }

  bool rests_at(std::size_t k) const {
    return std::any_of(target.rests.begin(), target.rests.end(),
                       [k](const RestingSamples& rest) { return k >= rest.first && k < rest.end; });
  }

  /// Where the output rests, its value is free: the mean of what it does there.
  static void subtract_mean(const RestingSamples& rest, double* values) {
    double mean = 0;
    for (std::size_t k = rest.first; k < rest.end; ++k) mean += values[k];
    mean /= static_cast<double>(rest.end - rest.first);
    for (std::size_t k = rest.first; k < rest.end; ++k) values[k] -= mean;
  }

  double angle_error(const Curve& c, std::size_t k) const {
    return std::arg(std::complex<double>(c.bx[k], c.by[k]) * std::polar(1.0, c.body_angle - target.angle[k]));
  }

  /// Speed of the body by angle, as that of a point.
  double turning(const Curve& c, std::size_t k) const {
    return target.oriented ? target.angle_length * c.rate[k] : 0;
  }
  double speed_squared(const Curve& c, std::size_t k) const {
    const double speed = c.tx[k] * c.tx[k] + c.ty[k] * c.ty[k], w = turning(c, k);
    return target.oriented ? speed + w * w : speed;
  }
  double mean_speed_squared(const Curve& c) const {
    double mean = 0;
    for (std::size_t k = 0; k < count(); ++k) mean += speed_squared(c, k);
    return mean / static_cast<double>(count());
  }

  /// One Gauss-Newton step of each crank angle towards the closest point, in the order of the stroke. Returns
  /// the largest change.
  double advance(Curve& c, double sense) const {
    const double mean = mean_speed_squared(c);
    Samples all;
    const std::span<double> forward(all.data(), count());
    for (std::size_t k = 0; k < count(); ++k) {
      // The closest point is that of the whole distance, whatever the tolerance leaves of it.
      double along = c.tx[k] * (c.x[k] - target.x[k]) + c.ty[k] * (c.y[k] - target.y[k]);
      if (target.oriented) along += turning(c, k) * target.angle_length * c.ea[k];
      const double change = -along / (speed_squared(c, k) + 4e-4 * mean);
      forward[k] = sense * (c.angle[k] + std::clamp(change, -0.12, 0.12));
    }
    restore_order(forward);
    const double most = target.stroke.closed ? 2 * pi : 2 * pi - open_rest;
    if (const double turned = forward.back() - forward.front(); turned > most) {
      const double centre = 0.5 * (forward.back() + forward.front());
      for (double& f : forward) f = centre + (f - centre) * (most / turned);
    }
    double largest = 0;
    for (std::size_t k = 0; k < count(); ++k) {
      largest = std::max(largest, std::abs(sense * forward[k] - c.angle[k]));
      c.angle[k] = sense * forward[k];
    }
    return largest;
  }

  /// The minima of the quality on the grid that are below the limit, each at the vertex of the parabola
  /// through three angles; number of them.
  std::size_t minima_below(const PointProgram& p, const double* x, unsigned signs,
                           std::array<double, limit_minima>& angle, std::array<double, limit_minima>& least,
                           std::array<double, limit_minima>& where) {
    std::size_t count = 0;
    const double step = target.turns ? 2 * pi / limit_angles : limit_angle[1] - limit_angle[0];
    for (std::size_t k = 0; k < limit_angles && count < limit_minima; ++k) {
      const bool end = !target.turns && (k == 0 || k + 1 == limit_angles);
      const double before = quality[k == 0 ? (end ? k + 1 : limit_angles - 1) : k - 1],
                   after = quality[k + 1 == limit_angles ? (end ? k - 1 : 0) : k + 1];
      if (quality[k] > before || (end ? quality[k] > after : quality[k] >= after)) continue;
      const double offset = end ? 0 : 0.5 * (before - after) / (before - 2 * quality[k] + after);
      if (!(quality[k] - 0.5 * std::abs(before - after) * std::abs(offset) < min_quality)) continue;
      angle[count] = limit_angle[k] + offset * step;
      ++count;
    }
    if (count == 0) return 0;
    std::fill(angle.begin() + static_cast<std::ptrdiff_t>(count), angle.end(), angle[0]);
    compute_curve({.program = &p,
                   .x = x,
                   .signs = signs,
                   .angle = angle.data(),
                   .count = limit_minima,
                   .quality = least.data(),
                   .worst = where.data()});
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count; ++k)
      if (least[k] < min_quality)
        angle[kept] = angle[k], least[kept] = least[k], where[kept] = where[k], ++kept;
    return kept;
  }

  /// Limits that are not kept, with their gradients where they are wanted; the sum of squares.
  double limit_squares(const PointProgram& p, const double* x, unsigned signs, double weight,
                       bool with_rows) {
    const auto n = static_cast<std::size_t>(p.parameters);
    limit_rows.clear(with_rows), pivot_rows.clear(with_rows);
    ++curves;
    compute_curve({.program = &p,
                   .x = x,
                   .signs = signs,
                   .angle = limit_angle.data(),
                   .count = limit_angles,
                   .quality = quality.data(),
                   .worst = worst.data()});
    std::array<double, limit_minima> angle, least, where;
    const std::size_t found = minima_below(p, x, signs, angle, least, where);
    for (std::size_t k = 0; k < found; ++k)
      if (LimitRow* row = limit_rows.add(weight * (min_quality - least[k]))) {
        quality_gradient(p, {x, n}, signs, angle[k], static_cast<int>(where[k]), {row->gradient.data(), n});
        for (std::size_t i = 0; i < n; ++i) row->gradient[i] *= -weight;
      }
    dimensions.add_lengths({x, n}, weight, limit_rows);
    dimensions.add_pivots({x, n}, weight, pivot_rows);
    return limit_rows.squares + pivot_rows.squares;
  }

  double mean_tolerance() const {
    if (!tolerant) return 0;
    return std::accumulate(target.tolerance.begin(), target.tolerance.end(), 0.0) / samples;
  }

  /// The scale of a machine whose output is an angle, where nothing else gives it.
  void scale_freely(std::span<double> x) const {
    if (!target.placed() && limits.ground_pivots.empty() && !limits.ground_box) dimensions.scale_freely(x);
  }

  /// Root of the squares of what is missing at the limits and their margin.
  double missed_limits(const FittedMachine& m) {
    cover_samples(m.angle);
    return std::sqrt(limit_squares(program_of(m.shape), m.shape.x.data(), m.shape.signs, 1, false));
  }

  /// The grid of pair angles over the samples, where the crank does not turn.
  void cover_samples(const Samples& angle) {
    if (target.turns) return;
    target.cover_used_part(angle, limit_angle);
  }

  void move_grid() {
    if (!target.turns) return;
    phase += 0.382 * 2 * pi / limit_angles;
    if (phase > 2 * pi / limit_angles) phase -= 2 * pi / limit_angles;
    for (std::size_t k = 0; k < limit_angles; ++k)
      limit_angle[k] = phase + 2 * pi * static_cast<double>(k) / limit_angles;
  }

  /// The normals of the curve.
  void find_normals() {
    const double mean = mean_speed_squared(now);
    Direction& d = directions[0];
    for (std::size_t k = 0; k < count(); ++k) {
      const double ex = now.ex[k], ey = now.ey[k];
      const double speed = now.tx[k] * now.tx[k] + now.ty[k] * now.ty[k];
      double ax = -now.ty[k], ay = now.tx[k], length = std::sqrt(speed);
      // Where the curve nearly stands it has no normal: the residual itself is what is left.
      if (speed < 1e-6 * mean) ax = ex, ay = ey, length = std::hypot(ex, ey);
      double by = length > 0 ? std::sqrt(target.weight[k]) / length : 0;
      if (tolerant && target.tolerance[k] > 0 && ex == 0 && ey == 0) by *= held_within_tolerance;
      d.x[k] = ax * by, d.y[k] = ay * by;
    }
  }

  /// Two normals of the motion of a body, whose angle counts as a third length.
  void find_body_normals() {
    const double mean = mean_speed_squared(now), w = target.angle_length;
    for (std::size_t k = 0; k < count(); ++k) {
      using Vector3 = std::array<double, 3>;
      const double root = std::sqrt(target.weight[k]);
      Vector3 first{now.ex[k], now.ey[k], w * now.ea[k]}, second{};
      if (const double speed = speed_squared(now, k); speed >= 1e-6 * mean && speed > 0) {
        const double by = 1 / std::sqrt(speed);
        const Vector3 t{by * now.tx[k], by * now.ty[k], by * turning(now, k)};
        first = {-t[1], t[0], 0};
        if (std::hypot(t[0], t[1]) < 1e-3) first = {1 - t[0] * t[0], -t[0] * t[1], -t[0] * t[2]};
        second = {t[1] * first[2] - t[2] * first[1], t[2] * first[0] - t[0] * first[2],
                  t[0] * first[1] - t[1] * first[0]};
      }
      const auto set = [&](Direction& d, const Vector3& v) {
        const double length = std::hypot(v[0], v[1], v[2]), by = length > 0 ? root / length : 0;
        d.x[k] = by * v[0], d.y[k] = by * v[1], d.a[k] = by * v[2] * w;
      };
      set(directions[0], first), set(directions[1], second);
    }
  }

  /// Both coordinates, and the angle; none inside the tolerance.
  void find_axes() {
    for (std::size_t k = 0; k < count(); ++k) {
      const double root = std::sqrt(target.weight[k]);
      const double of_place = target.tolerance[k] > 0 && now.ex[k] == 0 && now.ey[k] == 0 ? 0 : root;
      directions[0].x[k] = directions[1].y[k] = of_place;
      directions[0].y[k] = directions[1].x[k] = directions[0].a[k] = directions[1].a[k] = 0;
      directions[2].x[k] = directions[2].y[k] = 0, directions[2].a[k] = root * target.angle_length;
    }
  }

  /// The angle alone.
  void find_angles() {
    directions[0].x.fill(0), directions[0].y.fill(0);
    for (std::size_t k = 0; k < count(); ++k)
      directions[0].a[k] = std::sqrt(target.weight[k]) * target.angle_length;
  }

  /// Rows of the residuals by all unknowns, and the residuals as the last row.
  void residual_rows(const PointProgram& p, const double* x, unsigned signs) {
    if (!target.placed())
      find_angles();
    else if (target.timed)
      find_axes();
    else if (target.oriented)
      find_body_normals();
    else
      find_normals();
    ++curves;
    const std::size_t stride = column_length();
    for (std::size_t r = 0; r < residuals(); ++r) {
      const Direction& d = directions[r];
      double* out = rows.data() + r * count();
      CurveTask task = task_of(p, x, signs, now);
      task.nx = d.x.data(), task.ny = d.y.data(), task.na = target.oriented ? d.a.data() : nullptr;
      task.rows = out, task.stride = stride;
      compute_curve(task);
      double* column = out + static_cast<std::size_t>(p.parameters) * stride;
      if (target.timed) {
        for (std::size_t k = 0; k < count(); ++k) {
          column[k] = d.x[k] * now.tx[k] + d.y[k] * now.ty[k];
          if (target.oriented) column[k] += d.a[k] * now.rate[k];
        }
        column += stride;
      }
      if (target.oriented) {
        std::copy_n(d.a.begin(), count(), column);
        column += stride;
      }
      for (std::size_t k = 0; k < count(); ++k) {
        column[k] = d.x[k] * now.ex[k] + d.y[k] * now.ey[k];
        if (target.oriented) column[k] += d.a[k] * now.ea[k];
      }
    }
    // Residuals of a resting output are their differences from their mean, and so are all derivatives.
    const auto columns = static_cast<std::size_t>(p.parameters + extra_unknowns());
    for (const RestingSamples& rest : target.rests)
      for (std::size_t c = 0; c < columns; ++c) subtract_mean(rest, rows.data() + c * stride);
  }

  static constexpr int max_unknowns = max_machine_parameters + 2;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_unknowns, max_unknowns>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_unknowns, 1>;

  /// Normal equations of residuals and limits.
  void normal_equations(const PointProgram& p, Matrix& a, Vector& b) {
    const int n = p.parameters + extra_unknowns();
    std::array<double, (max_unknowns + 1) * (max_unknowns + 2) / 2> sums;
    compute_products({.rows = rows.data(),
                      .stride = column_length(),
                      .count = column_length(),
                      .columns = static_cast<std::size_t>(n) + 1,
                      .out = sums.data()});
    a.resize(n, n), b.resize(n);
    const double* from = sums.data();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) a(i, j) = *from++;
    for (int i = 0; i < n; ++i) b(i) = *from++;
    add_limits(p, limit_rows, a, b), add_limits(p, pivot_rows, a, b);
  }

  static void add_limits(const PointProgram& p, const LimitRows& limits, Matrix& a, Vector& b) {
    for (std::size_t r = 0; r < limits.count; ++r) {
      const LimitRow& row = limits.rows[r];
      for (int i = 0; i < p.parameters; ++i) {
        const double g = row.gradient[static_cast<std::size_t>(i)];
        for (int j = 0; j <= i; ++j) a(i, j) += g * row.gradient[static_cast<std::size_t>(j)];
        b(i) += g * row.value;
      }
    }
  }

  /// Levenberg-Marquardt steps with one weight of the limits; the error at the end.
  double descend(FittedMachine& m, double weight, int iterations) {
    const PointProgram& p = program_of(m.shape);
    std::vector<double>& x = m.shape.x;
    std::array<double, max_machine_parameters> trial;
    double damping = 1e-3;
    int small_steps = 0;
    const int n = p.parameters + extra_unknowns();
    now.angle = m.angle, now.body_angle = m.body_angle;
    compute(p, x.data(), m.shape.signs, now);
    Matrix a, factor;
    Vector b, step;
    for (int i = 0; i < iterations && small_steps < 3; ++i) {
      move_grid(), cover_samples(now.angle);
      double cost = now.squares + limit_squares(p, x.data(), m.shape.signs, weight, true);
      residual_rows(p, x.data(), m.shape.signs);
      normal_equations(p, a, b);
      bool better = false;
      for (int attempt = 0; attempt < 6 && !better; ++attempt) {
        factor = a;
        for (int k = 0; k < n; ++k) factor(k, k) += damping * a(k, k) + 1e-12;
        step = b;
        const Eigen::LLT<Eigen::Ref<Matrix>, Eigen::Lower> cholesky(factor);
        if (cholesky.info() == Eigen::Success) {
          cholesky.solveInPlace(step);
          for (int k = 0; k < p.parameters; ++k)
            trial[static_cast<std::size_t>(k)] = x[static_cast<std::size_t>(k)] - step(k);
          next.angle = now.angle, next.body_angle = now.body_angle;
          if (target.oriented) next.body_angle -= step(n - 1);
          if (target.timed)
            for (double& angle : next.angle) angle -= step(p.parameters);
          for (int pass = 0; pass < 2 && !target.timed; ++pass) {
            compute(p, trial.data(), m.shape.signs, next);
            advance(next, m.sense);
          }
          compute(p, trial.data(), m.shape.signs, next);
          cover_samples(next.angle);
          const double found = next.squares + limit_squares(p, trial.data(), m.shape.signs, weight, false);
          better = found < cost;
          if (better) small_steps = cost - found < 1e-5 * cost ? small_steps + 1 : 0;
        }
        damping = better ? std::max(damping * 0.3, 1e-10) : damping * 5;
      }
      if (!better) break;
      std::copy_n(trial.begin(), x.size(), x.begin());
      std::swap(now, next);
    }
    save(m);
    return m.error;
  }

  void save(FittedMachine& m) const {
    m.angle = now.angle, m.body_angle = now.body_angle;
    std::fill(m.angle.begin() + static_cast<std::ptrdiff_t>(count()), m.angle.end(), now.angle[count() - 1]);
    m.error = std::sqrt(now.squares / target.total_weight);
  }

  void meet_points(FittedMachine& machine, MachineMeasures& out);
};

MachineFitter::MachineFitter(const MotionTarget& target, const MachineLimits& limits)
    : memory_(std::make_unique<Memory>(target, limits)) {
  const double sine = std::sin(std::min(limits.min_pair_angle + margin, pi / 2));
  memory_->min_quality = sine * sine;
}
MachineFitter::~MachineFitter() = default;
MachineFitter::MachineFitter(MachineFitter&&) noexcept = default;

std::int64_t MachineFitter::curves() const { return memory_->curves + memory_->turn.curves(); }

double MachineFitter::turn_body(FittedMachine& machine) {
  Memory& m = *memory_;
  const PointProgram& p = m.program_of(machine.shape);
  m.now.angle = machine.angle, m.now.body_angle = 0;
  m.compute(p, machine.shape.x.data(), machine.shape.signs, m.now);
  if (m.target.oriented) {
    std::complex<double> sum{};
    for (std::size_t k = 0; k < m.count(); ++k)
      if (!m.rests_at(k)) sum += m.target.weight[k] * std::polar(1.0, -m.now.ea[k]);
    m.now.body_angle = std::arg(sum);
    m.compute(p, machine.shape.x.data(), machine.shape.signs, m.now);
  }
  m.save(machine);
  return machine.error;
}

bool MachineFitter::polish(FittedMachine& machine, double best) {
  Memory& m = *memory_;
  m.phase = 0;
  // Within the tolerance no machine is better than another by its error.
  const double spare = m.target.met > 0 ? spare_where_met : 0.3 * m.mean_tolerance();
  if (!(m.descend(machine, 1, 25) <= 1.6 * best + spare)) return false;
  if (!(m.descend(machine, 4, 40) <= 1.15 * best + spare)) return false;
  m.descend(machine, 30, 80);
  // A machine that stays far from the stroke pulls harder at its limits than that.
  for (const double weight : {150.0, 750.0, 3750.0}) {
    const double missed = m.missed_limits(machine);
    if (missed < nearly_kept || missed > far_from_kept) break;
    m.descend(machine, weight, 40);
  }
  m.dimensions.meet_pivots(machine.shape.x);
  m.scale_freely(machine.shape.x);
  return true;
}

void MachineFitter::Memory::meet_points(FittedMachine& machine, MachineMeasures& out) {
  const PointProgram& p = program_of(machine.shape);
  const double* x = machine.shape.x.data();
  now.angle = machine.angle, now.body_angle = machine.body_angle;
  compute(p, x, machine.shape.signs, now);
  for (int i = 0; i < 60 && !target.timed; ++i) {
    next = now;
    const double change = advance(next, machine.sense);
    compute(p, x, machine.shape.signs, next);
    if (!(next.squares <= now.squares)) break;
    std::swap(now, next);
    if (change < 1e-9) break;
  }
  save(machine);
  out.error = machine.error;
  double squares = 0, turned = 0;
  for (std::size_t k = 0; k < count(); ++k) {
    const bool of_points = target.output == MachineOutput::point;
    const double ex = of_points ? now.x[k] - target.x[k] : now.ex[k],
                 ey = of_points ? now.y[k] - target.y[k] : now.ey[k];
    out.largest_deviation = std::max(out.largest_deviation, std::hypot(ex, ey));
    squares += target.share[k] * (ex * ex + ey * ey);
    if (const double t = target.tolerance[k]; t > 0)
      if (const double beyond = std::hypot(ex, ey) - t; beyond > rounding_of_tolerance * t)
        out.beyond_tolerance = std::max(out.beyond_tolerance, beyond);
    if (!target.oriented) continue;
    out.largest_rotation = std::max(out.largest_rotation, std::abs(now.ea[k]));
    turned += target.share[k] * now.ea[k] * now.ea[k];
  }
  out.distance = std::sqrt(squares / target.total_weight);
  out.rotation = std::sqrt(turned / target.total_weight);
  out.span = std::abs(machine.angle[count() - 1] - machine.angle[0]);
  if (!target.stroke.closed) return;
  if (out.span > 2 * pi + 1e-9) out.defect = MachineDefect::order;
  out.span = 2 * pi;
}

ErrorModel MachineFitter::error_model(const FittedMachine& machine, bool hold_pivots) {
  Memory& m = *memory_;
  const PointProgram& p = m.program_of(machine.shape);
  const std::vector<double>& x = machine.shape.x;
  m.now.angle = machine.angle, m.now.body_angle = machine.body_angle;
  m.compute(p, x.data(), machine.shape.signs, m.now);
  m.residual_rows(p, x.data(), machine.shape.signs);
  m.limit_rows.clear(true), m.pivot_rows.clear(true);
  if (hold_pivots && !m.limits.ground_pivots.empty()) m.dimensions.add_pivots(x, 30, m.pivot_rows);
  // Rows of a box, which are not met, are no part of the error.
  for (std::size_t r = 0; r < m.pivot_rows.count; ++r)
    if (LimitRow& row = m.pivot_rows.rows[r]; std::abs(row.value) > 1e-9) row.value = 0, row.gradient.fill(0);
  Memory::Matrix a;
  Memory::Vector b;
  m.normal_equations(p, a, b);
  ErrorModel out;
  const auto n = static_cast<std::size_t>(a.rows());
  const double by = 1 / m.target.total_weight;
  out.unknowns = n, out.squares = by * m.now.squares;
  out.gradient.resize(n), out.matrix.resize(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    out.gradient[i] = by * b(static_cast<Eigen::Index>(i));
    for (std::size_t j = 0; j <= i; ++j)
      out.matrix[i * n + j] = out.matrix[j * n + i] =
          by * a(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }
  return out;
}

void MachineFitter::output_errors(const FittedMachine& machine, std::vector<double>& errors,
                                  std::vector<double>& derivatives) {
  Memory& m = *memory_;
  const PointProgram& p = m.program_of(machine.shape);
  const double* x = machine.shape.x.data();
  m.now.angle = machine.angle, m.now.body_angle = machine.body_angle;
  m.compute(p, x, machine.shape.signs, m.now);
  m.residual_rows(p, x, machine.shape.signs);
  // The first direction is that of the travel, or the angle.
  const std::size_t stride = m.column_length(), n = m.count();
  const auto unknowns = static_cast<std::size_t>(p.parameters + m.extra_unknowns());
  errors.resize(n), derivatives.resize(n * unknowns);
  for (std::size_t c = 0; c < unknowns; ++c)
    std::copy_n(m.rows.data() + c * stride, n, derivatives.data() + c * n);
  std::copy_n(m.rows.data() + unknowns * stride, n, errors.data());
}

void MachineFitter::move(FittedMachine& machine, std::span<const double> change) {
  Memory& m = *memory_;
  const PointProgram& p = m.program_of(machine.shape);
  for (std::size_t i = 0; i < machine.shape.x.size(); ++i) machine.shape.x[i] += change[i];
  if (m.target.timed)
    for (double& angle : machine.angle) angle += change[static_cast<std::size_t>(p.parameters)];
  if (m.target.oriented) machine.body_angle += change.back();
  m.dimensions.meet_pivots(machine.shape.x);
  m.scale_freely(machine.shape.x);
}

MachineMeasures MachineFitter::measure(FittedMachine& machine) {
  Memory& m = *memory_;
  MachineMeasures out;
  m.meet_points(machine, out);
  m.turn.measure(machine, out);
  m.dimensions.measure_lengths(machine.shape.x, out);
  const auto require = [&](bool kept, MachineDefect defect) {
    if (!kept && out.defect == MachineDefect::none) out.defect = defect;
  };
  const bool must_close = machine.shape.program->group >= 0 && m.target.turns;
  require(!must_close || out.min_pair_angle > 0, MachineDefect::no_turn);
  require(out.min_pair_angle >= m.limits.min_pair_angle, MachineDefect::pair_angle);
  require(out.min_length >= m.limits.min_length * (1 - 1e-3), MachineDefect::short_link);
  require(out.max_length <= m.limits.max_length * (1 + 1e-3), MachineDefect::long_link);
  require(m.dimensions.pivots_in_box(machine.shape.x), MachineDefect::ground_box);
  require(m.dimensions.pivots_as_given(machine.shape.x), MachineDefect::ground_pivots);
  require(!m.target.dense || m.turn.stays_near(machine, out.largest_deviation), MachineDefect::excursion);
  return out;
}

}  // namespace linkwright::planar
