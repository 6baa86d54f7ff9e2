// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/path_synthesis.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/dual.h"
#include "linkwright/planar/four_bar/kernel.h"

namespace linkwright::clearance {
namespace {

using Jet = math::Dual<clearance_length_count + 1>;

// Tracing point for the nine lengths and a crank angle; false where the loop does not close.
template <class T>
bool trace(const ClearancePathProblem& p, const T* x, const T& crank, T& px, T& py) {
  using std::cos, std::sin, std::sqrt;
  const T link = crank + T(p.phase);
  const T wx = x[1] * cos(crank) + T(p.clearance) * cos(link),
          wy = x[1] * sin(crank) + T(p.clearance) * sin(link);
  const T gx = x[0] * cos(x[8]), gy = x[0] * sin(x[8]);
  const planar::Closure<T> closure = planar::close_loop(gx, gy, wx, wy, x[2], x[3], T(sign(p.branch)));
  if (!(closure.radicand > T(0))) return false;
  const math::Vector2<T> d = planar::coupler_direction(closure, x[2]);
  const T u = x[4] * cos(x[7]), v = x[4] * sin(x[7]);
  px = x[5] + wx + d.x * u - d.y * v;
  py = x[6] + wy + d.x * v + d.y * u;
  return true;
}

double crank_angle(const ClearancePathProblem& p, std::span<const double> x, std::size_t k) {
  return p.free_timing ? x[clearance_length_count + k] : p.crank_angles[k];
}

planar::FourBar linkage_of(const ClearancePathProblem& p, std::span<const double> x) {
  return {.ground = x[0],
          .crank = x[1],
          .coupler = x[2],
          .rocker = x[3],
          .coupler_u = x[4] * std::cos(x[7]),
          .coupler_v = x[4] * std::sin(x[7]),
          .pivot_x = x[5],
          .pivot_y = x[6],
          .frame_angle = x[8],
          .branch = p.branch};
}

// Sum of squared distances; infinite where a point is not reached, with the share of such points.
double squares(const ClearancePathProblem& p, std::span<const double> x, double& missed) {
  double sum = 0;
  std::size_t misses = 0;
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    double px = 0, py = 0;
    if (!trace(p, x.data(), crank_angle(p, x, k), px, py)) {
      ++misses;
      continue;
    }
    sum += (px - p.x[k]) * (px - p.x[k]) + (py - p.y[k]) * (py - p.y[k]);
  }
  missed = static_cast<double>(misses) / static_cast<double>(p.x.size());
  return misses > 0 ? infinity : sum;
}

// Amounts of the constraints in their order; 0 = met. All are shares of the shortest link or of a turn.
struct Amounts {
  double no_assembly = 0, grashof = 0, shortest = 0, order = 0;
  double sum() const { return no_assembly + grashof + shortest + order; }
};
Amounts amounts(const ClearancePathProblem& p, std::span<const double> x, double missed) {
  Amounts out{.no_assembly = missed};
  if (p.crank_turns_fully) {
    std::array<double, 4> l{x[0], x[1], x[2], x[3]};
    std::sort(l.begin(), l.end());
    out.grashof = std::max(0.0, (l[0] + l[3] - l[1] - l[2]) / l[0]);
    out.shortest = (x[1] - l[0]) / l[0];
  }
  if (p.free_timing)
    for (std::size_t k = 1; k < p.x.size(); ++k)
      out.order += std::max(0.0, crank_angle(p, x, k - 1) - crank_angle(p, x, k));
  return out;
}
std::vector<Violation> violations(const Amounts& a) {
  std::vector<Violation> out;
  const auto add = [&](const char* reason, double amount) {
    if (amount > 0) out.push_back({reason, amount});
  };
  add("no_assembly", a.no_assembly);
  add("crank_turns_fully", a.grashof);
  add("crank_shortest", a.shortest);
  add("order", a.order);
  return out;
}

void limits(const ClearancePathProblem& p, std::vector<double>& lower, std::vector<double>& upper) {
  for (const Range& r : p.bounds) lower.push_back(r.lower), upper.push_back(r.upper);
  if (p.free_timing)
    for (const double angle : p.crank_angles)
      lower.push_back(angle - p.angle_range), upper.push_back(angle + p.angle_range);
}

const math::LeastSquaresOptions local{.max_iterations = 200,
                                      .decrease_tolerance = 0,
                                      .relative_decrease_tolerance = 1e-13,
                                      .step_tolerance = 1e-14,
                                      .cost_tolerance = 1e-30};

}  // namespace

void require_valid(const ClearancePathProblem& p) {
  LINKWRIGHT_REQUIRE(p.x.size() >= 3 && p.y.size() == p.x.size() && p.crank_angles.size() == p.x.size(),
                     "{} and {} coordinates with {} crank angles: needs 3 points at least", p.x.size(),
                     p.y.size(), p.crank_angles.size());
  for (std::size_t k = 0; k < p.x.size(); ++k)
    LINKWRIGHT_REQUIRE(std::isfinite(p.x[k]) && std::isfinite(p.y[k]) && std::isfinite(p.crank_angles[k]),
                       "point {} is ({}, {}) at {} rad", k, p.x[k], p.y[k], p.crank_angles[k]);
  for (std::size_t k = 0; k < p.bounds.size(); ++k)
    LINKWRIGHT_REQUIRE(p.bounds[k].lower <= p.bounds[k].upper &&
                           std::isfinite(p.bounds[k].lower + p.bounds[k].upper) &&
                           (k >= 4 || p.bounds[k].lower > 0),
                       "variable {} lies between {} and {}", k, p.bounds[k].lower, p.bounds[k].upper);
  LINKWRIGHT_REQUIRE(p.clearance >= 0 && std::isfinite(p.clearance) && std::isfinite(p.phase),
                     "clearance {} m, phase {} rad", p.clearance, p.phase);
  LINKWRIGHT_REQUIRE(p.angle_range >= 0, "crank angles may differ by {} rad", p.angle_range);
}

std::size_t variables(const ClearancePathProblem& p) {
  return clearance_length_count + (p.free_timing ? p.x.size() : 0);
}

ClearancePathDesign clearance_path_design(const ClearancePathProblem& p, std::span<const double> x) {
  require_valid(p);
  LINKWRIGHT_REQUIRE(x.size() == variables(p), "needs {} variables, got {}", variables(p), x.size());
  ClearancePathDesign out;
  out.model.linkage = linkage_of(p, x);
  out.model.clearance = p.clearance;
  for (std::size_t k = 0; k < p.x.size(); ++k) out.crank_angles.push_back(crank_angle(p, x, k));
  double missed = 0;
  const double sum = squares(p, x, missed), n = static_cast<double>(p.x.size());
  out.objective = std::sqrt(sum) / n;
  out.rms = std::sqrt(sum / n);
  out.violations = violations(amounts(p, x, missed));
  return out;
}

std::vector<double> path_variables(const ClearancePathProblem& p, const planar::FourBar& l) {
  std::vector<double> x{l.ground,
                        l.crank,
                        l.coupler,
                        l.rocker,
                        std::hypot(l.coupler_u, l.coupler_v),
                        l.pivot_x,
                        l.pivot_y,
                        std::atan2(l.coupler_v, l.coupler_u),
                        l.frame_angle};
  if (p.free_timing) x.insert(x.end(), p.crank_angles.begin(), p.crank_angles.end());
  return x;
}

optimise::Problem clearance_path_problem(const ClearancePathProblem& p) {
  require_valid(p);
  static constexpr const char* names[] = {"ground_m",  "crank_m",          "coupler_m",
                                          "rocker_m",  "point_distance_m", "pivot_x_m",
                                          "pivot_y_m", "point_angle_rad",  "frame_angle_rad"};
  optimise::Problem out;
  std::vector<double> lower, upper;
  limits(p, lower, upper);
  for (std::size_t k = 0; k < lower.size(); ++k)
    out.variables.push_back({k < clearance_length_count
                                 ? std::string(names[k])
                                 : "crank_angle_" + std::to_string(k - clearance_length_count + 1) + "_rad",
                             lower[k], upper[k]});
  out.evaluate = [p](const optimise::PopulationView& c, std::span<double> cost, std::span<double> violation) {
    std::vector<double> x(c.dimension);
    for (std::size_t i = 0; i < c.size; ++i) {
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = c(k, i);
      double missed = 0;
      cost[i] = std::sqrt(squares(p, x, missed)) / static_cast<double>(p.x.size());
      violation[i] = amounts(p, x, missed).sum();
    }
  };
  out.explain = [p](std::span<const double> x) {
    double missed = 0;
    squares(p, x, missed);
    return violations(amounts(p, x, missed));
  };
  return out;
}

bool clearance_path_residuals(const ClearancePathProblem& p, std::span<const double> x,
                              std::span<double> residuals, std::span<double> jacobian) {
  const std::size_t m = 2 * p.x.size();
  std::array<Jet, clearance_length_count> jets;
  for (std::size_t k = 0; k < jets.size(); ++k) jets[k] = Jet::variable(x[k], static_cast<int>(k));
  if (!jacobian.empty()) std::fill(jacobian.begin(), jacobian.end(), 0.0);
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    const double angle = crank_angle(p, x, k);
    if (jacobian.empty()) {
      double px = 0, py = 0;
      if (!trace(p, x.data(), angle, px, py)) return false;
      residuals[2 * k] = px - p.x[k];
      residuals[2 * k + 1] = py - p.y[k];
      continue;
    }
    Jet px, py;
    if (!trace(p, jets.data(), Jet::variable(angle, clearance_length_count), px, py)) return false;
    residuals[2 * k] = px.value - p.x[k];
    residuals[2 * k + 1] = py.value - p.y[k];
    for (std::size_t j = 0; j < jets.size(); ++j) {
      jacobian[j * m + 2 * k] = px.by[j];
      jacobian[j * m + 2 * k + 1] = py.by[j];
    }
    if (p.free_timing) {
      const std::size_t j = clearance_length_count + k;
      jacobian[j * m + 2 * k] = px.by[clearance_length_count];
      jacobian[j * m + 2 * k + 1] = py.by[clearance_length_count];
    }
  }
  return true;
}

math::LeastSquaresReport polish_clearance_path(const ClearancePathProblem& p, std::span<double> x) {
  require_valid(p);
  std::vector<double> lower, upper;
  limits(p, lower, upper);
  math::LeastSquaresWorkspace workspace;
  return math::minimise_least_squares(
      [&](std::span<const double> at, std::span<double> r, std::span<double> j) {
        return clearance_path_residuals(p, at, r, j);
      },
      2 * p.x.size(), x, lower, upper, local, workspace);
}

ClearancePathSynthesis synthesise_clearance_path(const ClearancePathProblem& p, int starts,
                                                 const optimise::Seed& seed, RunContext& context) {
  require_valid(p);
  std::vector<double> lower, upper;
  limits(p, lower, upper);
  const optimise::MultistartReport report = optimise::multistart_least_squares(
      [&](std::span<const double> at, std::span<double> r, std::span<double> j) {
        return clearance_path_residuals(p, at, r, j);
      },
      2 * p.x.size(), lower.size(), lower, upper,
      [&](std::size_t, RandomStream& random, std::span<double> x) {
        for (int attempt = 0; attempt < 1000; ++attempt) {
          for (std::size_t k = 0; k < x.size(); ++k)
            x[k] = k < clearance_length_count ? random.uniform(lower[k], upper[k])
                                              : p.crank_angles[k - clearance_length_count];
          double missed = 0;
          squares(p, x, missed);
          if (missed == 0) return true;
        }
        return false;
      },
      {.starts = starts, .local = local}, seed, context);
  ClearancePathSynthesis out;
  out.status = report.status;
  out.evaluations = report.evaluations;
  double best_cost = infinity, best_violation = infinity;
  for (const optimise::MultistartEnd& end : report.ends) {
    if (end.report.status == Status::infeasible) continue;
    double missed = 0;
    squares(p, end.x, missed);
    const double violation = amounts(p, end.x, missed).sum();
    if (!optimise::better(end.report.cost, violation, best_cost, best_violation)) continue;
    best_cost = end.report.cost;
    best_violation = violation;
    out.x = end.x;
  }
  if (out.x.empty()) {
    out.status = Status::infeasible;
    return out;
  }
  for (const optimise::MultistartEnd& end : report.ends)
    out.reached += end.report.cost <= best_cost * (1 + 1e-6) + 1e-24;
  out.design = clearance_path_design(p, out.x);
  if (out.status == Status::done && best_violation > 0) out.status = Status::infeasible;
  return out;
}

EquivalentCrank equivalent_crank(double crank, double clearance, double phase) {
  const double across = clearance * std::sin(phase);
  const double length = std::sqrt(crank * crank - across * across) - clearance * std::cos(phase);
  return {length, std::atan2(across, length + clearance * std::cos(phase))};
}

}  // namespace linkwright::clearance
