// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/curve.h"
#include "linkwright/planar/linkage/detail/joint_rows.h"
#include "linkwright/planar/linkage/detail/pair_rows.h"

namespace linkwright::planar {

inline constexpr std::size_t part_index(int i) { return static_cast<std::size_t>(i); }

// A place on the curve; velocities and speeds of the parts are the derivatives by the length along the curve.
struct CurveNode {
  double along = 0, value = 0, slope = 0;  // slope: of the value
  std::vector<PartState<double>> parts;
};

// A determinant by its logarithm, since it is very large or very small.
struct Determinant {
  double sign;  // +1 or -1
  double log;   // of its size
};

// The joint equations of the groups that take part, over the displacement of their parts (origins over the
// linkage's size, angles) and of the value (times `unit`). The length of a displacement is the root of the
// mean square over the parts and the square of the value's.
class CurveEquations {
 public:
  CurveEquations(const LinkagePlan& plan, InputLine line) : plan_(plan), line_(std::move(line)) {
    std::vector<bool> takes(plan.groups.size(), false);
    for (std::size_t k = plan.groups.size(); k-- > 0;) {
      takes[k] = takes[k] || !traits_of(plan.groups[k]).closed_form;
      if (!takes[k]) continue;
      const auto needs = [&](int part) {
        const int g = plan.group_of_part[part_index(part)];
        if (part > 0 && g != static_cast<int>(k)) takes[part_index(g)] = true;
      };
      for (const PlanJoint& j : plan.groups[k].joints) needs(j.before.part), needs(j.after.part);
      for (const PlanGear& gear : plan.groups[k].gears) {
        needs(gear.part);
        for (const AngleShare& s : gear.angle.shares) needs(s.part);
      }
      for (const PlanPair& pair : plan.groups[k].pairs)
        for (const int p : parts_of(pair)) needs(p);
    }
    column_.assign(plan.parts.size(), -1);
    for (std::size_t k = 0; k < takes.size(); ++k) {
      if (!takes[k]) continue;
      groups_.push_back(static_cast<int>(k));
      for (const int p : plan.groups[k].parts) {
        column_[part_index(p)] = static_cast<int>(3 * parts_.size());
        parts_.push_back(p);
      }
    }
    n_ = static_cast<Eigen::Index>(3 * parts_.size());
    for (std::size_t i = 0; i < line_.direction.size(); ++i)
      unit_ = std::max(unit_, std::abs(line_.direction[i]) / (plan.rotary[i] ? 1 : plan.size));
    if (unit_ == 0) unit_ = 1;
    inputs_.resize(line_.base.size());
    residual_.resize(n_);
    jacobian_.resize(n_, n_ + 1);
    bordered_.resize(n_ + 1, n_ + 1);
    right_.resize(n_ + 1);
  }

  const LinkagePlan& plan() const { return plan_; }
  const std::vector<int>& parts() const { return parts_; }
  const std::vector<int>& groups() const { return groups_; }
  std::span<const InputMotion> inputs() const { return inputs_; }
  Eigen::Index size() const { return n_; }
  double unit() const { return unit_; }
  double weight() const { return 1.0 / static_cast<double>(parts_.size()); }
  double largest_residual() const { return residual_.cwiseAbs().maxCoeff(); }
  const Eigen::VectorXd& residual() const { return residual_; }

  void put(double value) {
    for (std::size_t i = 0; i < inputs_.size(); ++i)
      inputs_[i].value = line_.base[i] + value * line_.direction[i];
  }
  // The rounding error of the residuals.
  double rounding(const CurveNode& y) const {
    double reach = plan_.size;
    for (const int p : parts_) reach = std::max(reach, norm(y.parts[part_index(p)].origin));
    return 64 * tolerance::epsilon * reach / plan_.size;
  }

  void evaluate(const CurveNode& y, bool derivatives) {
    put(y.value);
    if (derivatives) jacobian_.setZero();
    Eigen::Index row = 0;
    for (const int k : groups_) {
      const Group& g = plan_.groups[part_index(k)];
      const GearTrain* train = g.as<GearTrain>();
      for (const PlanJoint& j : g.joints) {
        const InputMotion* input = j.input >= 0 && !train ? &inputs_[part_index(j.input)] : nullptr;
        const JointRows r = joint_rows(j, input != nullptr, y.parts);
        const auto f = joint_residuals(j, r, input, y.parts, plan_.size);
        for (int e = 0; e < r.count; ++e, ++row) {
          residual_[row] = f[part_index(e)] / plan_.size;
          if (derivatives) derive(row, j, r, r.rows[part_index(e)], y);
        }
        if (derivatives && input)
          jacobian_(row - 1, n_) -=
              sense(j) * line_.direction[part_index(j.input)] / unit_ / (j.slide ? plan_.size : 1);
      }
      if (train)
        for (std::size_t i = 0; i < g.parts.size(); ++i)
          turn(train->angles[i], g.parts[i], y, row++, derivatives);
      else
        for (const PlanGear& gear : g.gears) turn(gear.angle, gear.part, y, row++, derivatives);
      for (const PlanPair& pair : g.pairs) hold(pair, y, row++, derivatives);
    }
  }

  // Moves a place by a displacement.
  void move(CurveNode& y, const Eigen::VectorXd& z) const {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      PartState<double>& part = y.parts[part_index(parts_[i])];
      const auto c = static_cast<Eigen::Index>(3 * i);
      part.origin = part.origin + plan_.size * math::Vec2{z[c], z[c + 1]};
      part.direction = renormalised(rotate(part.direction, math::unit(z[c + 2])));
    }
    y.value += z[n_] / unit_;
  }
  double product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
    return weight() * a.head(n_).dot(b.head(n_)) + a[n_] * b[n_];
  }
  double length(const Eigen::VectorXd& a) const { return std::sqrt(product(a, a)); }
  Eigen::VectorXd tangent(const CurveNode& y) const {
    Eigen::VectorXd t(n_ + 1);
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const PartState<double>& part = y.parts[part_index(parts_[i])];
      const auto c = static_cast<Eigen::Index>(3 * i);
      t[c] = part.velocity.x / plan_.size, t[c + 1] = part.velocity.y / plan_.size, t[c + 2] = part.speed;
    }
    t[n_] = y.slope * unit_;
    return t;
  }
  void set_tangent(CurveNode& y, const Eigen::VectorXd& t) const {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      PartState<double>& part = y.parts[part_index(parts_[i])];
      const auto c = static_cast<Eigen::Index>(3 * i);
      part.velocity = plan_.size * math::Vec2{t[c], t[c + 1]};
      part.speed = t[c + 2];
    }
    y.slope = t[n_] / unit_;
  }

  // Factors of the equations at y, bordered by a direction.
  void factorise(const CurveNode& y, const Eigen::VectorXd& direction) {
    evaluate(y, true);
    bordered_.topRows(n_) = jacobian_;
    bordered_.row(n_).head(n_) = weight() * direction.head(n_).transpose();
    bordered_(n_, n_) = direction[n_];
    lu_.compute(bordered_);
  }
  // Brings y onto the curve within the plane through it at right angles to `direction`. Returns how far it
  // moved, NaN when it does not get there.
  double correct(CurveNode& y, const Eigen::VectorXd& direction) {
    Eigen::VectorXd total = Eigen::VectorXd::Zero(n_ + 1);
    const double rounding_level = rounding(y);
    double last_step = 1, last = infinity;
    for (int i = 0; i < 20; ++i) {
      factorise(y, direction);
      const double largest = largest_residual();
      if (!std::isfinite(largest)) return nan;
      if (largest <= rounding_level && (i > 0 || largest == 0)) return length(total);
      if (largest <= 1e3 * rounding_level && largest > 0.25 * last) return length(total);
      last = largest;
      right_.head(n_) = -residual_;
      right_[n_] = -product(direction, total);
      const Eigen::VectorXd step = lu_.solve(right_);
      const double s = length(step);
      // Newton's method far from converging would lead anywhere.
      if (!(s <= 0.3) || (i > 0 && s > 0.5 * last_step && s > 1e-9)) return nan;
      last_step = s;
      move(y, step);
      total += step;
    }
    return nan;
  }
  // Tangent at y, where the factors are of y, along `direction`.
  Eigen::VectorXd tangent_along(const Eigen::VectorXd& direction) {
    right_.setZero();
    right_[n_] = 1;
    Eigen::VectorXd t = lu_.solve(right_);
    t /= length(t);
    return product(t, direction) < 0 ? Eigen::VectorXd(-t) : t;
  }
  // The determinant of the factors.
  Determinant determinant() const {
    const auto& lu = lu_.matrixLU();
    const auto& order = lu_.permutationP().indices();
    bool negative = false;
    double log = 0;
    for (Eigen::Index i = 0; i < lu.rows(); ++i) {
      negative ^= lu(i, i) < 0;
      log += std::log(std::abs(lu(i, i)));
      for (Eigen::Index k = 0; k < i; ++k) negative ^= order[k] > order[i];
    }
    return {negative ? -1.0 : 1.0, log};
  }

  // Least squares of the residuals over displacements: at a fixed value, or of the value as well with the
  // least displacement. Returns the largest residual.
  double settle(CurveNode& y, bool fixed_value) {
    const Eigen::Index m = fixed_value ? n_ : n_ + 1;
    double damping = fixed_value ? 1e-3 : 0;
    evaluate(y, true);
    double square = residual_.squaredNorm();
    for (int i = 0; i < 100; ++i) {
      if (largest_residual() <= rounding(y)) break;
      const Eigen::MatrixXd j = jacobian_.leftCols(m);
      Eigen::VectorXd step = Eigen::VectorXd::Zero(n_ + 1);
      if (fixed_value) {
        Eigen::MatrixXd normal = j.transpose() * j;
        normal.diagonal().array() += damping;
        step.head(m) = -Eigen::PartialPivLU<Eigen::MatrixXd>(normal).solve(j.transpose() * residual_);
      } else {
        Eigen::VectorXd spread = Eigen::VectorXd::Constant(m, 1 / weight());
        spread[n_] = 1;
        const Eigen::MatrixXd scaled = j * spread.asDiagonal();
        const Eigen::MatrixXd normal = scaled * j.transpose();
        step.head(m) = -(scaled.transpose() * Eigen::PartialPivLU<Eigen::MatrixXd>(normal).solve(residual_));
      }
      const double s = length(step);
      if (!std::isfinite(s)) return nan;
      if (s > 0.3) step *= 0.3 / s;
      CurveNode next = y;
      move(next, step);
      evaluate(next, true);
      const double now = residual_.squaredNorm();
      if (fixed_value && !(now < square)) {
        damping *= 10;
        if (damping > 1e6) break;
        evaluate(y, true);
        continue;
      }
      damping *= 0.3;
      const bool small = s < 1e-12 || (fixed_value && square - now < 1e-14 * square);
      y = std::move(next);
      square = now;
      if (small) break;
    }
    evaluate(y, true);
    return largest_residual();
  }

 private:
  void derive(Eigen::Index row, const PlanJoint& j, const JointRows& r, const JointEquation& e,
              const CurveNode& y) {
    for (const auto& [part, side] : {std::pair{j.after.part, 1.0}, std::pair{j.before.part, -1.0}}) {
      const int c = column_[part_index(part)];
      if (c < 0) continue;
      const math::Vec2 arm = r.point - y.parts[part_index(part)].origin;
      jacobian_(row, c) += side * e.force.x;
      jacobian_(row, c + 1) += side * e.force.y;
      jacobian_(row, c + 2) += side * (e.moment + cross(arm, e.force) / plan_.size);
    }
  }
  void turn(const DrivenAngle& angle, int part, const CurveNode& y, Eigen::Index row, bool derivatives) {
    residual_[row] = angle_residual(angle, part, inputs_, y.parts);
    if (!derivatives) return;
    const auto add = [&](int p, double share) {
      if (const int c = column_[part_index(p)]; c >= 0) jacobian_(row, c + 2) += share;
    };
    add(part, 1);
    for (const AngleShare& s : angle.shares) add(s.part, -s.share);
    for (std::size_t i = 0; i < angle.gains.size(); ++i)
      jacobian_(row, n_) -= angle.gains[i] * line_.direction[i] / unit_;
  }

  // A rack or strand. Angles that the inputs alone give take no part in the derivatives by the angle.
  void hold(const PlanPair& pair, const CurveNode& y, Eigen::Index row, bool derivatives) {
    const auto by_inputs = [&](int part) -> const DrivenAngle* {
      const auto& turned = plan_.turned[part_index(part)];
      return turned && turned->shares.empty() ? &*turned : nullptr;
    };
    const PairRow r =
        pair_row(pair, y.parts, [&](int part) { return pair_angle(plan_, inputs_, y.parts, {}, part); });
    residual_[row] = less_turns(r, [&](int part) { return !by_inputs(part); }) / plan_.size;
    if (!derivatives) return;
    for (const PairShare& s : r.shares) {
      double turning = s.moment;
      if (const DrivenAngle* angle = by_inputs(s.part)) {
        turning -= s.turning;
        for (std::size_t i = 0; i < angle->gains.size(); ++i)
          jacobian_(row, n_) += s.turning / plan_.size * angle->gains[i] * line_.direction[i] / unit_;
      }
      const int c = column_[part_index(s.part)];
      if (c < 0) continue;
      jacobian_(row, c) += s.force.x;
      jacobian_(row, c + 1) += s.force.y;
      jacobian_(row, c + 2) += turning / plan_.size;
    }
  }

  const LinkagePlan& plan_;
  InputLine line_;
  std::vector<int> groups_, parts_, column_;
  Eigen::Index n_ = 0;
  double unit_ = 0;
  std::vector<InputMotion> inputs_;
  Eigen::VectorXd residual_, right_;
  Eigen::MatrixXd jacobian_, bordered_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace linkwright::planar
