// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/reference_beam.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/dense.h"
#include "linkwright/math/ode.h"

namespace linkwright::flexible {

namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

Vector solved_symmetric(const Matrix& matrix, const Vector& right) {
  const std::vector<double> x = math::solve_symmetric(math::numbers(matrix), math::numbers(right));
  return Eigen::Map<const Vector>(x.data(), right.size());
}

// Sum over the rows of weight times row of a times row of b.
Matrix weighted(const Matrix& a, const Vector& weight, const Matrix& b) {
  return a.transpose() * weight.asDiagonal() * b;
}

// P_0 ... P_n at x.
Vector legendre(int n, double x) {
  Vector p(n + 1);
  p[0] = 1;
  if (n > 0) p[1] = x;
  for (int k = 2; k <= n; ++k) p[k] = ((2 * k - 1) * x * p[k - 1] - (k - 1) * p[k - 2]) / k;
  return p;
}

// Their integrals from -1 to x.
Vector integrals(int n, double x) {
  const Vector p = legendre(n + 1, x);
  Vector out(n + 1);
  out[0] = x + 1;
  for (int k = 1; k <= n; ++k) out[k] = (p[k + 1] - p[k - 1]) / (2 * k + 1);
  return out;
}

// A row for each Gauss point, the tip last: values there, masses there.
struct Grid {
  Vector weight;      // weights of the integral over the link (m), points only
  Vector mass;        // kg
  Vector inertia;     // kg m2
  Matrix curvature;   // curvature by each coefficient (1), points only
  Matrix angle;       // angle by each coefficient (m)
  Matrix accumulate;  // from values at the points to their integral up to the row
  Vector root_curvature;
};

Grid grid(const Beam& beam, const ReferenceOptions& o) {
  const int n = o.points, terms = o.degree + 1;
  const double half = beam.length / 2;
  Grid g;
  g.weight.resize(n);
  g.mass.resize(n + 1);
  g.inertia.resize(n + 1);
  g.curvature.resize(n, terms);
  g.angle.resize(n + 1, terms);
  g.accumulate.resize(n + 1, n);
  Matrix values(n, n), sums(n + 1, n);
  Vector x(n);
  for (int i = 0; i < n; ++i) {
    double at = -std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 0;
    for (int k = 0; k < 8; ++k) {  // Newton's method from a start that is good to 1e-3
      const Vector p = legendre(n, at);
      slope = n * (at * p[n] - p[n - 1]) / (at * at - 1);
      at -= p[n] / slope;
    }
    x[i] = at;
    g.weight[i] = 2 / ((1 - at * at) * slope * slope) * half;
    values.row(i) = legendre(n - 1, at);
    sums.row(i) = integrals(n - 1, at);
    g.curvature.row(i) = legendre(o.degree, at);
    g.angle.row(i) = half * integrals(o.degree, at);
  }
  sums.row(n) = integrals(n - 1, 1);
  g.angle.row(n) = half * integrals(o.degree, 1);
  g.root_curvature = legendre(o.degree, -1);
  // Expands what is given at the points in Legendre's polynomials and integrates these.
  for (int j = 0; j < n; ++j)
    for (int i = 0; i <= n; ++i) {
      double sum = 0;
      for (int m = 0; m < n; ++m) sum += (2 * m + 1) / 2.0 * values(j, m) * sums(i, m);
      g.accumulate(i, j) = sum * g.weight[j];
    }
  g.mass.head(n) = beam.density * beam.area * g.weight;
  g.inertia.head(n) = beam.rotary_inertia() * g.weight;
  g.mass[n] = beam.tip_mass;
  g.inertia[n] = beam.tip_inertia;
  return g;
}

void require(const Beam& beam, const ReferenceOptions& o) {
  const auto found = problem(beam);
  LINKWRIGHT_REQUIRE(!found, "{}", *found);
  LINKWRIGHT_REQUIRE(beam.theory != Theory::timoshenko && !beam.extensible && beam.gravity == 0 &&
                         beam.mass_damping == 0 && beam.stiffness_damping == 0,
                     "the reference beam has no shear, extension, gravity or damping of its own");
  LINKWRIGHT_REQUIRE(o.degree >= 1 && o.degree <= 20 && o.points > o.degree && o.points <= 64,
                     "degree {} with {} points", o.degree, o.points);
}

// Equations of motion at an instant: y holds coefficients, theta, their rates, work.
class Elastica {
 public:
  Elastica(const Beam& beam, const ReferenceOptions& o)
      : beam_(beam), g_(grid(beam, o)), terms_(o.degree + 1), points_(o.points) {
    stiffness_ = beam.bending_stiffness() * weighted(g_.curvature, g_.weight, g_.curvature);
  }
  int size() const { return 2 * terms_ + 3; }
  int terms() const { return terms_; }

  // Driven by an acceleration of the hub, or by a torque.
  void rates(std::span<const double> y, const HubMotion* hub, double torque, std::span<double> out) {
    place(y, hub);
    accelerate(hub ? &hub->acceleration : nullptr, torque);
    for (int k = 0; k < terms_; ++k) {
      out[k] = rate_[k];
      out[terms_ + 1 + k] = acceleration_[k];
    }
    out[terms_] = turn_rate_;
    out[2 * terms_ + 1] = turn_acceleration_;
    out[2 * terms_ + 2] = torque_ * turn_rate_;
  }

  Sample sample(double t, std::span<const double> y, const HubMotion* hub, double torque) {
    place(y, hub);
    accelerate(hub ? &hub->acceleration : nullptr, torque);
    const Eigen::Index tip = points_;
    const Vector force_x = g_.mass.cwiseProduct(ax_), force_y = g_.mass.cwiseProduct(ay_);
    const Vector arm = x_.array() - beam_.hub_radius;
    Sample s{.time = t,
             .angle = hub ? hub->angle : y[terms_],
             .rate = turn_rate_,
             .acceleration = turn_acceleration_,
             .torque = torque_,
             .tip_xi = x_[tip] - beam_.hub_radius - beam_.length,
             .tip_eta = y_[tip],
             .tip_angle = angle_[tip],
             .reaction_xi = force_x.sum(),
             .reaction_eta = force_y.sum(),
             .moment = arm.dot(force_y) - y_.dot(force_x) + g_.inertia.dot(turning_)};
    s.bending_moment = std::abs(g_.root_curvature.dot(coefficients_));
    for (int i = 0; i < points_; ++i)
      s.bending_moment = std::max(s.bending_moment, std::abs(g_.curvature.row(i).dot(coefficients_)));
    s.bending_moment *= beam_.bending_stiffness();
    s.kinetic =
        0.5 * (g_.mass.dot((vx_.array().square() + vy_.array().square()).matrix()) +
               g_.inertia.dot(spin_.array().square().matrix()) + beam_.hub_inertia * turn_rate_ * turn_rate_);
    s.potential =
        0.5 * coefficients_.dot(stiffness_ * coefficients_) + 0.5 * beam_.hub_stiffness * s.angle * s.angle;
    s.work = y[2 * terms_ + 2];
    s.angular_momentum = g_.mass.dot((x_.cwiseProduct(vy_) - y_.cwiseProduct(vx_))) + g_.inertia.dot(spin_) +
                         beam_.hub_inertia * turn_rate_;
    return s;
  }

 private:
  // Directions, places and velocities of all rows, in axes of the hub, against the ground.
  void place(std::span<const double> y, const HubMotion* hub) {
    coefficients_ = Eigen::Map<const Vector>(y.data(), terms_);
    rate_ = Eigen::Map<const Vector>(y.data() + terms_ + 1, terms_);
    turn_rate_ = hub ? hub->rate : y[2 * terms_ + 1];
    turn_ = hub ? hub->angle : y[terms_];
    angle_ = g_.angle * coefficients_;
    spin_ = (g_.angle * rate_).array() + turn_rate_;
    cos_ = angle_.head(points_).array().cos();
    sin_ = angle_.head(points_).array().sin();
    const Vector spin = spin_.head(points_);
    x_ = (g_.accumulate * cos_).array() + beam_.hub_radius;
    y_ = g_.accumulate * sin_;
    vx_ = g_.accumulate * -sin_.cwiseProduct(spin);
    vy_ = (g_.accumulate * cos_.cwiseProduct(spin)).array() + beam_.hub_radius * turn_rate_;
    // By the coefficients: i e^{i phi} times their angles, accumulated.
    const Matrix angles = g_.angle.topRows(points_);
    by_x_ = g_.accumulate * (-sin_).asDiagonal() * angles;
    by_y_ = g_.accumulate * cos_.asDiagonal() * angles;
    const Vector square = spin.cwiseProduct(spin);
    ax_ = (g_.accumulate * -cos_.cwiseProduct(square)).array() - beam_.hub_radius * turn_rate_ * turn_rate_;
    ay_ = g_.accumulate * -sin_.cwiseProduct(square);
  }

  void accelerate(const double* given, double torque) {
    // The last coordinate is the hub's angle, about which all turns.
    const int n = terms_;
    Matrix bx(points_ + 1, n + 1), by(points_ + 1, n + 1), turns(points_ + 1, n + 1);
    bx.leftCols(n) = by_x_;
    by.leftCols(n) = by_y_;
    bx.col(n) = -y_;
    by.col(n) = x_;
    turns.leftCols(n) = g_.angle;
    turns.col(n).setOnes();
    Matrix mass = weighted(bx, g_.mass, bx) + weighted(by, g_.mass, by) + weighted(turns, g_.inertia, turns);
    mass(n, n) += beam_.hub_inertia;
    Vector rest = bx.transpose() * g_.mass.cwiseProduct(ax_) + by.transpose() * g_.mass.cwiseProduct(ay_);
    rest.head(n) += stiffness_ * coefficients_;
    rest[n] += beam_.hub_stiffness * turn_ + beam_.hub_damping * turn_rate_;
    Vector all(n + 1);
    if (given) {
      all[n] = *given;
      all.head(n) = -solved_symmetric(mass.topLeftCorner(n, n), rest.head(n) + *given * mass.col(n).head(n));
      torque_ = rest[n] + mass.row(n) * all;
    } else {
      rest[n] -= torque;
      all = -solved_symmetric(mass, rest);
      torque_ = torque;
    }
    acceleration_ = all.head(n);
    turn_acceleration_ = all[n];
    ax_ += bx * all;
    ay_ += by * all;
    turning_ = turns * all;
  }

  const Beam& beam_;
  Grid g_;
  int terms_, points_;
  Matrix stiffness_, by_x_, by_y_;
  Vector coefficients_, rate_, acceleration_, angle_, spin_, turning_, cos_, sin_, x_, y_, vx_, vy_, ax_, ay_;
  double turn_ = 0, turn_rate_ = 0, turn_acceleration_ = 0, torque_ = 0;
};

ReferenceMotion simulate(const Beam& beam, const AngleLaw* motion, const TorqueLaw* torque,
                         const ReferenceRun& run) {
  require(beam, run.beam);
  LINKWRIGHT_REQUIRE(run.end > 0 && run.output_interval > 0 && run.tolerance > 0,
                     "end {} s, output interval {} s, tolerance {}: all must be positive", run.end,
                     run.output_interval, run.tolerance);
  Elastica elastica(beam, run.beam);
  std::vector<double> y(elastica.size());
  ReferenceMotion out;
  HubMotion hub;
  const auto drive = [&](double t) -> const HubMotion* {
    if (!motion) return nullptr;
    hub = (*motion)(t);
    return &hub;
  };
  const auto torque_at = [&](double t) { return torque ? (*torque)(t) : 0; };

  std::vector<double> stops(run.breaks.begin(), run.breaks.end());
  stops.push_back(run.end);
  std::sort(stops.begin(), stops.end());
  out.samples.push_back(elastica.sample(0, y, drive(0), torque_at(0)));
  math::OdeWorkspace workspace;
  double from = 0;
  for (const double to : stops) {
    if (to <= from || to > run.end) continue;
    // Within a stretch the drive is smooth: its ends are seen from inside.
    const double low = std::nextafter(from, to), high = std::nextafter(to, from);
    const auto rates = [&](double t, std::span<const double> at, std::span<double> rate) {
      const double inside = std::clamp(t, low, high);
      elastica.rates(at, drive(inside), torque_at(inside), rate);
      return true;
    };
    std::vector<double> times;
    for (auto i = long(out.samples.size());; ++i) {
      const double t = double(i) * run.output_interval;
      if (t > to * (1 + 1e-12)) break;
      times.push_back(std::min(t, to));
    }
    math::OdeHooks hooks{.context = run.context};
    hooks.output_times = times;
    hooks.output = [&](double t, std::span<const double> at) {
      out.samples.push_back(elastica.sample(t, at, drive(t), torque_at(t)));
      return true;
    };
    const math::OdeOptions options{.relative_tolerance = run.tolerance,
                                   .absolute_tolerance = 1e-3 * run.tolerance,
                                   .max_steps = 10'000'000};
    const math::OdeReport report = math::integrate(rates, y, from, to, options, hooks, workspace);
    if (report.status != Status::done) {
      out.status = report.status;
      out.message = report.message;
      return out;
    }
    from = to;
  }
  return out;
}

}  // namespace

ReferenceShape reference_shape(const Beam& beam, math::Vec2 tip_force, const ReferenceOptions& options) {
  require(beam, options);
  const Grid g = grid(beam, options);
  const int n = options.points, terms = options.degree + 1;
  const Matrix stiffness = beam.bending_stiffness() * weighted(g.curvature, g.weight, g.curvature);
  const Matrix angles = g.angle.topRows(n);
  Vector a = Vector::Zero(terms);
  ReferenceShape out;
  constexpr int parts = 10;
  for (int part = 1; part <= parts; ++part) {
    const double x = tip_force.x * part / parts, y = tip_force.y * part / parts;
    bool met = false;
    for (int i = 0; i < 50 && !met; ++i) {
      const Vector angle = angles * a;
      const Vector c = angle.array().cos(), s = angle.array().sin();
      // Derivative of the load's work by the angles.
      const Vector around = g.weight.array() * (y * c.array() - x * s.array());
      const Vector along = g.weight.array() * (x * c.array() + y * s.array());
      const Vector gradient = stiffness * a - angles.transpose() * around;
      const Matrix hessian = stiffness + weighted(angles, along, angles);
      const Vector step = solved_symmetric(hessian, gradient);
      a -= step;
      met = (angles * step).cwiseAbs().maxCoeff() < 1e-13;
    }
    if (!met) out.status = Status::not_converged;
  }
  const Vector angle = angles * a;
  out.tip = {g.weight.dot(angle.array().cos().matrix()), g.weight.dot(angle.array().sin().matrix())};
  out.angle = g.angle.row(n).dot(a);
  return out;
}

std::vector<double> reference_frequencies(const Beam& beam, int count, double speed,
                                          const ReferenceOptions& options) {
  require(beam, options);
  LINKWRIGHT_REQUIRE(count >= 1 && count <= options.degree + 1, "{} frequencies of a beam with {} terms",
                     count, options.degree + 1);
  const Grid g = grid(beam, options);
  const int n = options.points;
  const Matrix angles = g.angle.topRows(n);
  const Matrix deflection = g.accumulate * angles;
  const Vector x = (g.accumulate * Vector::Ones(n)).array() + beam.hub_radius;
  const Matrix mass = weighted(deflection, g.mass, deflection);
  // The tension that the masses outside a point put there, straightens; their distance grows with the
  // deflection.
  const Vector tension = speed * speed * g.accumulate.transpose() * g.mass.cwiseProduct(x);
  const Matrix stiffness = beam.bending_stiffness() * weighted(g.curvature, g.weight, g.curvature) +
                           weighted(angles, tension, angles) - speed * speed * mass;
  const Matrix whole = mass + weighted(g.angle, g.inertia, g.angle);
  std::vector<double> out = math::symmetric_eigenvalues(math::numbers(stiffness), math::numbers(whole));
  out.resize(static_cast<std::size_t>(count));
  for (double& square : out) square = std::sqrt(std::max(square, 0.0));
  return out;
}

ReferenceMotion reference_motion(const Beam& beam, AngleLaw law, const ReferenceRun& run) {
  return simulate(beam, &law, nullptr, run);
}

ReferenceMotion reference_torque(const Beam& beam, TorqueLaw law, const ReferenceRun& run) {
  return simulate(beam, nullptr, &law, run);
}

}  // namespace linkwright::flexible
