// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/polish.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <span>
#include <utility>

#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/dimension_limits.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t samples = stroke_samples;
constexpr std::size_t limit_angles = 48;  // grid of the pair angles during the polish
constexpr std::size_t measured_angles = 720;
constexpr std::size_t limit_minima = 16;  // minima of the pair angle over the turn that a polish heeds
constexpr double margin =
    0.05 * pi / 180;  // the polish keeps this much more of the pair angle than it promises
constexpr double nearly_kept = 4e-4, far_from_kept = 0.05;  // what a polish may miss of its limits
constexpr double open_rest = 0.02;                          // an open stroke leaves this much of a turn (rad)

using Samples = std::array<double, samples>;

/// Brings a sequence into ascending order with the least sum of squared changes (pool adjacent violators).
void restore_order(Samples& v) {
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
  Memory(const SampledStroke& stroke, const MachineLimits& kept)
      : target(stroke), limits(kept), dimensions(kept) {}

  SampledStroke target;
  MachineLimits limits;
  std::int64_t curves = 0;
  DimensionLimits dimensions;
  double min_quality = 0;
  double phase = 0;  // of the grid of pair angles; each polish begins with the same

  struct Curve {
    alignas(64) Samples angle, x, y, tx, ty;
    double squares = 0;
  };
  Curve now, next;
  alignas(64) std::array<double, samples*(max_machine_parameters + 1)> rows;
  alignas(64) Samples nx, ny;
  alignas(64) std::array<double, limit_angles> limit_angle, quality, worst;
  LimitRows limit_rows, pivot_rows;
  alignas(64) std::array<double, measured_angles> turn_angle, turn_quality,
      turn_worst, turn_x, turn_y, turn_tx, turn_ty;
  std::vector<double> turn_points = std::vector<double>(2 * max_steps * measured_angles);

  const PointProgram& program_of(const MachineShape& shape) {
    dimensions.set_program(*shape.program);
    return *shape.program;
  }

  void compute(const PointProgram& p, const double* x, unsigned signs, Curve& c,
               double* derivatives = nullptr) {
    ++curves;
    compute_curve({.program = &p,
                   .x = x,
                   .signs = signs,
                   .angle = c.angle.data(),
                   .count = samples,
                   .px = c.x.data(),
                   .py = c.y.data(),
                   .tx = c.tx.data(),
                   .ty = c.ty.data(),
                   .nx = nx.data(),
                   .ny = ny.data(),
                   .rows = derivatives,
                   .stride = samples});
    if (derivatives) return;
    double sum = 0;
    for (std::size_t k = 0; k < samples; ++k) {
      const double ex = c.x[k] - target.x[k], ey = c.y[k] - target.y[k];
      sum += ex * ex + ey * ey;
    }
    c.squares = sum;
  }

  /// One Gauss-Newton step of each crank angle towards the closest point, in the order of the stroke. Returns
  /// the largest change.
  double advance(Curve& c, double sense) const {
    double mean = 0;
    for (std::size_t k = 0; k < samples; ++k) mean += c.tx[k] * c.tx[k] + c.ty[k] * c.ty[k];
    mean /= samples;
    Samples forward;
    for (std::size_t k = 0; k < samples; ++k) {
      const double ex = c.x[k] - target.x[k], ey = c.y[k] - target.y[k];
      const double speed = c.tx[k] * c.tx[k] + c.ty[k] * c.ty[k];
      const double change = -(c.tx[k] * ex + c.ty[k] * ey) / (speed + 4e-4 * mean);
      forward[k] = sense * (c.angle[k] + std::clamp(change, -0.12, 0.12));
    }
    restore_order(forward);
    const double most = target.closed ? 2 * pi : 2 * pi - open_rest;
    if (const double turned = forward.back() - forward.front(); turned > most) {
      const double centre = 0.5 * (forward.back() + forward.front());
      for (double& f : forward) f = centre + (f - centre) * (most / turned);
    }
    double largest = 0;
    for (std::size_t k = 0; k < samples; ++k) {
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
    for (std::size_t k = 0; k < limit_angles && count < limit_minima; ++k) {
      const double before = quality[k == 0 ? limit_angles - 1 : k - 1],
                   after = quality[k + 1 == limit_angles ? 0 : k + 1];
      if (quality[k] > before || quality[k] >= after) continue;
      const double offset = 0.5 * (before - after) / (before - 2 * quality[k] + after);
      if (!(quality[k] - 0.5 * std::abs(before - after) * std::abs(offset) < min_quality)) continue;
      angle[count] = limit_angle[k] + offset * (2 * pi / limit_angles);
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

  /// Root of the squares of what is missing at the limits and their margin.
  double missed_limits(const FittedMachine& m) {
    return std::sqrt(limit_squares(program_of(m.shape), m.shape.x.data(), m.shape.signs, 1, false));
  }

  void move_grid() {
    phase += 0.382 * 2 * pi / limit_angles;
    if (phase > 2 * pi / limit_angles) phase -= 2 * pi / limit_angles;
    for (std::size_t k = 0; k < limit_angles; ++k)
      limit_angle[k] = phase + 2 * pi * static_cast<double>(k) / limit_angles;
  }

  /// Rows of the residuals along the normals of the curve, and the residuals as the last row.
  void residual_rows(const PointProgram& p, const double* x, unsigned signs) {
    double mean = 0;
    for (std::size_t k = 0; k < samples; ++k) mean += now.tx[k] * now.tx[k] + now.ty[k] * now.ty[k];
    mean /= samples;
    double* residual = rows.data() + static_cast<std::size_t>(p.parameters) * samples;
    for (std::size_t k = 0; k < samples; ++k) {
      const double ex = now.x[k] - target.x[k], ey = now.y[k] - target.y[k];
      const double speed = now.tx[k] * now.tx[k] + now.ty[k] * now.ty[k];
      double ax = -now.ty[k], ay = now.tx[k], length = std::sqrt(speed);
      // Where the curve nearly stands it has no normal: the residual itself is what is left.
      if (speed < 1e-6 * mean) ax = ex, ay = ey, length = std::hypot(ex, ey);
      const double by = length > 0 ? 1 / length : 0;
      nx[k] = ax * by, ny[k] = ay * by;
      residual[k] = nx[k] * ex + ny[k] * ey;
    }
    compute(p, x, signs, now, rows.data());
  }

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_machine_parameters,
                               max_machine_parameters>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_machine_parameters, 1>;

  /// Normal equations of residuals and limits.
  void normal_equations(const PointProgram& p, Matrix& a, Vector& b) {
    const auto n = static_cast<std::size_t>(p.parameters);
    std::array<double, (max_machine_parameters + 1) * (max_machine_parameters + 2) / 2> sums;
    compute_products(
        {.rows = rows.data(), .stride = samples, .count = samples, .columns = n + 1, .out = sums.data()});
    a.resize(p.parameters, p.parameters), b.resize(p.parameters);
    const double* from = sums.data();
    for (int i = 0; i < p.parameters; ++i)
      for (int j = 0; j <= i; ++j) a(i, j) = *from++;
    for (int i = 0; i < p.parameters; ++i) b(i) = *from++;
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
    now.angle = m.angle;
    compute(p, x.data(), m.shape.signs, now);
    Matrix a, factor;
    Vector b, step;
    for (int i = 0; i < iterations && small_steps < 3; ++i) {
      move_grid();
      double cost = now.squares + limit_squares(p, x.data(), m.shape.signs, weight, true);
      residual_rows(p, x.data(), m.shape.signs);
      normal_equations(p, a, b);
      bool better = false;
      for (int attempt = 0; attempt < 6 && !better; ++attempt) {
        factor = a;
        for (int k = 0; k < p.parameters; ++k) factor(k, k) += damping * a(k, k) + 1e-12;
        step = b;
        const Eigen::LLT<Eigen::Ref<Matrix>, Eigen::Lower> cholesky(factor);
        if (cholesky.info() == Eigen::Success) {
          cholesky.solveInPlace(step);
          for (int k = 0; k < p.parameters; ++k)
            trial[static_cast<std::size_t>(k)] = x[static_cast<std::size_t>(k)] - step(k);
          next.angle = now.angle;
          for (int turn = 0; turn < 2; ++turn) {
            compute(p, trial.data(), m.shape.signs, next);
            advance(next, m.sense);
          }
          compute(p, trial.data(), m.shape.signs, next);
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
    m.angle = now.angle;
    m.error = std::sqrt(now.squares / samples);
    return m.error;
  }

  void meet_points(FittedMachine& machine, MachineMeasures& out);
  void measure_turn(const FittedMachine& machine, MachineMeasures& out);
  double least_quality(const FittedMachine& machine) const;
  double box_of_pins(const PointProgram& p, std::complex<double> scale) const;
  double peak_acceleration(const FittedMachine& machine, double span) const;
  bool stays_near(const FittedMachine& machine, double largest_deviation);
};

MachineFitter::MachineFitter(const SampledStroke& target, const MachineLimits& limits)
    : memory_(std::make_unique<Memory>(target, limits)) {
  const double sine = std::sin(std::min(limits.min_pair_angle + margin, pi / 2));
  memory_->min_quality = sine * sine;
  for (std::size_t k = 0; k < measured_angles; ++k)
    memory_->turn_angle[k] = 2 * pi * static_cast<double>(k) / measured_angles;
}
MachineFitter::~MachineFitter() = default;
MachineFitter::MachineFitter(MachineFitter&&) noexcept = default;

std::int64_t MachineFitter::curves() const { return memory_->curves; }

bool MachineFitter::polish(FittedMachine& machine, double best) {
  Memory& m = *memory_;
  m.phase = 0;
  if (!(m.descend(machine, 1, 25) <= 1.6 * best)) return false;
  if (!(m.descend(machine, 4, 40) <= 1.15 * best)) return false;
  m.descend(machine, 30, 80);
  // A machine that stays far from the stroke pulls harder at its limits than that.
  for (const double weight : {150.0, 750.0, 3750.0}) {
    const double missed = m.missed_limits(machine);
    if (missed < nearly_kept || missed > far_from_kept) break;
    m.descend(machine, weight, 40);
  }
  m.dimensions.meet_pivots(machine.shape.x);
  return true;
}

void MachineFitter::Memory::meet_points(FittedMachine& machine, MachineMeasures& out) {
  const PointProgram& p = program_of(machine.shape);
  const double* x = machine.shape.x.data();
  now.angle = machine.angle;
  compute(p, x, machine.shape.signs, now);
  for (int i = 0; i < 60; ++i) {
    next.angle = now.angle;
    next.tx = now.tx, next.ty = now.ty, next.x = now.x, next.y = now.y;
    const double change = advance(next, machine.sense);
    compute(p, x, machine.shape.signs, next);
    if (!(next.squares <= now.squares)) break;
    std::swap(now, next);
    if (change < 1e-9) break;
  }
  machine.angle = now.angle;
  machine.error = out.error = std::sqrt(now.squares / samples);
  for (std::size_t k = 0; k < samples; ++k)
    out.largest_deviation =
        std::max(out.largest_deviation, std::hypot(now.x[k] - target.x[k], now.y[k] - target.y[k]));
  out.span = std::abs(machine.angle.back() - machine.angle.front());
  if (!target.closed) return;
  if (out.span > 2 * pi + 1e-9) out.defect = MachineDefect::order;
  out.span = 2 * pi;
}

double MachineFitter::Memory::least_quality(const FittedMachine& machine) const {
  const auto least = std::min_element(turn_quality.begin(), turn_quality.end());
  double quality = *least, centre = turn_angle[static_cast<std::size_t>(least - turn_quality.begin())],
         half = 2 * pi / measured_angles;
  for (int zoom = 0; zoom < 4; ++zoom, half /= 3.5) {
    std::array<double, 8> angle, q, where;
    for (std::size_t k = 0; k < 8; ++k) angle[k] = centre + half * (static_cast<double>(k) - 3.5) / 3.5;
    compute_curve({.program = machine.shape.program,
                   .x = machine.shape.x.data(),
                   .signs = machine.shape.signs,
                   .angle = angle.data(),
                   .count = 8,
                   .quality = q.data(),
                   .worst = where.data()});
    const auto i = static_cast<std::size_t>(std::min_element(q.begin(), q.end()) - q.begin());
    if (q[i] < quality) quality = q[i], centre = angle[i];
  }
  return quality;
}

void MachineFitter::Memory::measure_turn(const FittedMachine& machine, MachineMeasures& out) {
  const PointProgram& p = *machine.shape.program;
  const double* x = machine.shape.x.data();
  ++curves;
  compute_curve({.program = &p,
                 .x = x,
                 .signs = machine.shape.signs,
                 .angle = turn_angle.data(),
                 .count = measured_angles,
                 .px = turn_x.data(),
                 .py = turn_y.data(),
                 .tx = turn_tx.data(),
                 .ty = turn_ty.data(),
                 .quality = turn_quality.data(),
                 .worst = turn_worst.data(),
                 .points = turn_points.data()});
  const double quality = least_quality(machine);
  out.min_pair_angle = quality > 0 ? std::asin(std::sqrt(quality)) : 0;
  dimensions.measure_lengths(machine.shape.x, out);
  const auto s = static_cast<std::size_t>(p.scale());
  out.size = box_of_pins(p, std::complex<double>(x[s], x[s + 1]));
  out.peak_acceleration = peak_acceleration(machine, out.span);
}

/// Larger side of the box of all pins over the turn; the ground pin of the crank is the origin of the
/// machine's plane.
double MachineFitter::Memory::box_of_pins(const PointProgram& p, std::complex<double> scale) const {
  double left = 0, right = 0, bottom = 0, top = 0;
  for (std::size_t i = 0; i < p.steps.size(); ++i) {
    if (p.steps[i].operation == PointOperation::sleeve) continue;
    const double *px = turn_points.data() + 2 * i * measured_angles, *py = px + measured_angles;
    for (std::size_t k = 0; k < measured_angles; ++k) {
      const std::complex<double> at = scale * std::complex<double>(px[k], py[k]);
      left = std::min(left, at.real()), right = std::max(right, at.real());
      bottom = std::min(bottom, at.imag()), top = std::max(top, at.imag());
    }
  }
  return std::max(right - left, top - bottom);
}

/// Of the traced point at unit crank speed; an open stroke asks for nothing outside its own part of the turn.
double MachineFitter::Memory::peak_acceleration(const FittedMachine& machine, double span) const {
  const double from = machine.sense > 0 ? machine.angle.front() : machine.angle.back();
  double peak = 0;
  for (std::size_t k = 0; k < measured_angles; ++k) {
    const double ahead = turn_angle[k] - from;
    if (!target.closed && ahead - 2 * pi * std::floor(ahead / (2 * pi)) > span) continue;
    const std::size_t a = (k + measured_angles - 1) % measured_angles, b = (k + 1) % measured_angles;
    peak = std::max(peak, std::hypot(turn_tx[b] - turn_tx[a], turn_ty[b] - turn_ty[a]));
  }
  return peak * measured_angles / (4 * pi);
}

/// True if the curve stays near the stroke between the points, too.
bool MachineFitter::Memory::stays_near(const FittedMachine& machine, double largest_deviation) {
  constexpr std::size_t between = 3 * samples;
  alignas(64) std::array<double, between> angle, bx, by;
  const std::size_t sides = target.closed ? samples : samples - 1;
  for (std::size_t k = 0; k < samples; ++k) {
    const double from = machine.angle[k];
    const double to = k + 1 < samples ? machine.angle[k + 1]
                      : target.closed ? machine.angle[0] + machine.sense * 2 * pi
                                      : from;
    for (std::size_t i = 0; i < 3; ++i)
      angle[3 * k + i] = from + (to - from) * 0.25 * static_cast<double>(i + 1);
  }
  ++curves;
  compute_curve({.program = machine.shape.program,
                 .x = machine.shape.x.data(),
                 .signs = machine.shape.signs,
                 .angle = angle.data(),
                 .count = between,
                 .px = bx.data(),
                 .py = by.data()});
  const double allowed = 3 * largest_deviation + 0.02;
  for (std::size_t k = 0; k < 3 * sides; ++k) {
    const std::size_t i = k / 3, j = (i + 1) % samples;
    const double dx = target.x[j] - target.x[i], dy = target.y[j] - target.y[i];
    const double vx = bx[k] - target.x[i], vy = by[k] - target.y[i], square = dx * dx + dy * dy;
    const double part = square > 0 ? std::clamp((vx * dx + vy * dy) / square, 0.0, 1.0) : 0.0;
    if (!(std::hypot(vx - part * dx, vy - part * dy) <= allowed)) return false;
  }
  return true;
}

MachineMeasures MachineFitter::measure(FittedMachine& machine) {
  Memory& m = *memory_;
  MachineMeasures out;
  m.meet_points(machine, out);
  m.measure_turn(machine, out);
  const auto require = [&](bool kept, MachineDefect defect) {
    if (!kept && out.defect == MachineDefect::none) out.defect = defect;
  };
  require(out.min_pair_angle >= m.limits.min_pair_angle, MachineDefect::pair_angle);
  require(out.min_length >= m.limits.min_length * (1 - 1e-3), MachineDefect::short_link);
  require(out.max_length <= m.limits.max_length * (1 + 1e-3), MachineDefect::long_link);
  require(m.dimensions.pivots_in_box(machine.shape.x), MachineDefect::ground_box);
  require(m.dimensions.pivots_as_given(machine.shape.x), MachineDefect::ground_pivots);
  require(m.stays_near(machine, out.largest_deviation), MachineDefect::excursion);
  return out;
}

}  // namespace linkwright::planar
