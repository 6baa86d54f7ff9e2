// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/joint_orbit.h"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/dense.h"

namespace linkwright::clearance {
namespace {

constexpr double same_ratio = 1e-9;  // periods whose ratio is that near to a whole number fit
constexpr double on_circle = 1e-5;   // error of a multiplier by differences

bool whole(double ratio) { return std::abs(ratio - std::round(ratio)) <= same_ratio * std::max(1.0, ratio); }

// Period of a law: 0 = rests; nothing = has none.
struct PeriodOf {
  bool rotary;
  std::optional<double> operator()(const math::ConstantSpeed& law) const {
    if (law.rate == 0) return 0;
    return rotary ? std::optional(full_turn / std::abs(law.rate)) : std::nullopt;
  }
  std::optional<double> operator()(const math::HarmonicMotion& law) const {
    return law.amplitude == 0 || law.frequency == 0 ? 0 : 1 / law.frequency;
  }
  std::optional<double> operator()(const math::MotionTable& law) const {
    if (law.ends != math::TableEnds::periodic) return std::nullopt;
    const double grown = law.values.back() - law.values.front();
    const bool comes_back = rotary ? std::abs(std::remainder(grown, full_turn)) <= 1e-9 : grown == 0;
    if (!comes_back) return std::nullopt;
    return law.times.back() - law.times.front();
  }
  template <class Other>
  std::optional<double> operator()(const Other& law) const {
    if constexpr (requires { law.to == law.from; })
      return law.to == law.from ? std::optional(0.0) : std::nullopt;
    else
      return std::nullopt;
  }
  std::optional<double> operator()(const math::EndConditions&) const { return std::nullopt; }
};

}  // namespace

DrivePeriod drive_period(std::span<const planar::InputDrive> drives, const std::vector<bool>& rotary) {
  LINKWRIGHT_REQUIRE(drives.size() == rotary.size(), "{} drives, {} inputs", drives.size(), rotary.size());
  std::vector<double> periods;
  double longest = 0;
  for (std::size_t k = 0; k < drives.size(); ++k) {
    const auto period = drives[k].law ? std::visit(PeriodOf{rotary[k]}, *drives[k].law) : std::nullopt;
    if (!period) return {0, static_cast<int>(k)};
    periods.push_back(*period);
    longest = std::max(longest, *period);
  }
  if (longest == 0) return {0, drives.empty() ? -1 : 0};
  constexpr int most = 60;
  DrivePeriod out;
  for (int multiple = 1; multiple <= most; ++multiple) {
    out = {multiple * longest, -1};
    for (std::size_t k = 0; k < periods.size() && out.period > 0; ++k)
      if (periods[k] > 0 && !whole(out.period / periods[k])) out = {0, static_cast<int>(k)};
    if (out.period > 0) break;
  }
  return out;
}

std::string load_against_time(const planar::Linkage& linkage) {
  for (const planar::PointForce& f : linkage.forces)
    if (goes_by(f, planar::LoadArgument::time)) return f.name;
  for (const planar::BodyTorque& m : linkage.torques)
    if (goes_by(m, planar::LoadArgument::time)) return m.name;
  for (const planar::Strut& s : linkage.struts)
    if (goes_by(s, planar::LoadArgument::time)) return s.name;
  return {};
}

JointOrbit find_joint_orbit(const planar::Linkage& linkage, std::span<const JointClearance> clearances,
                            std::span<const planar::InputDrive> drives, double start, double period,
                            const planar::SimulationOptions& options, const RunContext* context) {
  constexpr int most = 50;
  constexpr double longest_step = 0.5, converged = 1e-10, difference = 1e-5;
  LINKWRIGHT_REQUIRE(period > 0 && std::isfinite(period), "period {} s must be positive", period);
  for (const planar::InputDrive& c : drives)
    LINKWRIGHT_REQUIRE(c.law.has_value(), "{} inputs: each must follow a law", drives.size());
  const std::vector<double> times{start, start + period};
  const double pace = full_turn / period;
  const auto n = static_cast<Eigen::Index>(2 * clearances.size());
  JointOrbit orbit;

  // Angles and rates after a period; false, with status and message, when the motion ends before.
  std::vector<JointClearance> links(clearances.begin(), clearances.end());
  const auto map = [&](Eigen::VectorXd& x) {
    for (std::size_t k = 0; k < links.size(); ++k) {
      links[k].angle = x[static_cast<Eigen::Index>(2 * k)];
      links[k].rate = pace * x[static_cast<Eigen::Index>(2 * k + 1)];
    }
    const JointClearanceRun run =
        simulate_joint_clearance(linkage, links, drives, times, options, {}, context, AtSeparation::ignore);
    orbit.evaluations += run.simulation.evaluations;
    orbit.status = run.status;
    orbit.message = run.message;
    for (std::size_t k = 0; k < links.size(); ++k) {
      x[static_cast<Eigen::Index>(2 * k)] = run.end[k].angle;
      x[static_cast<Eigen::Index>(2 * k + 1)] = run.end[k].rate / pace;
    }
    return run.status == Status::done;
  };
  // Whole turns do not count.
  const auto change = [&](const Eigen::VectorXd& after, const Eigen::VectorXd& before) {
    Eigen::VectorXd out = after - before;
    for (Eigen::Index k = 0; k < n; k += 2) out[k] = math::wrap_angle(out[k]);
    return out;
  };

  Eigen::VectorXd x(n);
  for (std::size_t k = 0; k < links.size(); ++k) {
    x[static_cast<Eigen::Index>(2 * k)] = clearances[k].angle;
    x[static_cast<Eigen::Index>(2 * k + 1)] = clearances[k].rate / pace;
  }
  Eigen::MatrixXd by(n, n);
  for (;; ++orbit.iterations) {
    orbit.start.clear();
    for (Eigen::Index k = 0; k < n; k += 2) orbit.start.push_back({.angle = x[k], .rate = pace * x[k + 1]});
    Eigen::VectorXd end = x;
    if (!map(end)) return orbit;
    const Eigen::VectorXd gap = change(end, x);
    orbit.residual = gap.lpNorm<Eigen::Infinity>();
    for (Eigen::Index k = 0; k < n; ++k) {
      Eigen::VectorXd more = x, less = x;
      more[k] += difference;
      less[k] -= difference;
      if (!map(more) || !map(less)) return orbit;
      by.col(k) = change(more, less) / (2 * difference);
    }
    if (orbit.residual <= converged) break;
    const Eigen::MatrixXd left = by - Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd step = left.partialPivLu().solve(-gap);
    if (orbit.iterations == most || !step.allFinite()) {
      orbit.status = Status::not_converged;
      orbit.message =
          fmt::format("no periodic motion after {} steps of Newton's method: a period changes it by {:.3g}",
                      orbit.iterations, orbit.residual);
      return orbit;
    }
    x += std::min(1.0, longest_step / step.norm()) * step;
  }
  orbit.multipliers = math::eigenvectors(math::numbers(by), false).values;
  std::stable_sort(orbit.multipliers.begin(), orbit.multipliers.end(),
                   [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  const double size = std::abs(orbit.multipliers.front());
  orbit.stability = size > 1 + on_circle   ? OrbitStability::unstable
                    : size < 1 - on_circle ? OrbitStability::stable
                                           : OrbitStability::neutral;
  return orbit;
}

int repeating_period(std::span<const std::vector<double>> states, double tolerance, int most) {
  for (int p = 1; p <= most && static_cast<std::size_t>(p) < states.size(); ++p) {
    const std::vector<double>& last = states.back();
    const std::vector<double>& before = states[states.size() - 1 - static_cast<std::size_t>(p)];
    LINKWRIGHT_REQUIRE(last.size() == before.size(), "states of {} and {} numbers", before.size(),
                       last.size());
    double change = 0;
    for (std::size_t k = 0; k < last.size(); ++k) change = std::max(change, std::abs(last[k] - before[k]));
    if (change <= tolerance) return p;
    if (change <= 10 * tolerance) return 0;
  }
  return 0;
}

}  // namespace linkwright::clearance
