// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// Accelerations of the free inputs through the joint forces: with the accelerations a that all parts have
/// while the free inputs have none,
///   M da - J^T lambda = loads - M a,   J da = 0,
/// one row of J a joint equation, prescribed drives among them. Parts and joints are put in an order
/// (Cuthill and McKee) in which a joint is near its parts, so that the matrix is a band, as narrow for a
/// long chain as for a short one: an evaluation takes a time that goes with the number of parts, where the
/// mass matrix of the free inputs takes the cube of it. Both have the same answer but for rounding.
class LinkageElimination {
 public:
  /// True if it knows all joints of the plan: it has no gears.
  static bool takes(const LinkagePlan& plan);
  /// `free` as of LinkageDynamics. The plan must outlive this.
  LinkageElimination(const LinkagePlan& plan, const std::vector<bool>& free);

  /// `needed`: wrench of every part about its origin that its motion needs beyond the loads on it. False when
  /// a free input moves no mass or the joints are at a dead point.
  bool solve(const LinkageMotion& motion, std::span<const Wrench<double>> needed);

  /// Acceleration of a free input at the last `solve`, rad/s2 or m/s2.
  double acceleration(std::size_t input) const;
  /// Torque or force of a prescribed drive at the last `solve`, on the second body of its joint.
  double drive(std::size_t input) const;

 private:
  struct Row {
    const PlanJoint* joint;
    int input;  // input of its drive; -1 = none
    bool prescribed;
    std::size_t place;  // place of its first unknown
    int rows() const { return prescribed ? 3 : 2; }
  };
  struct Part {
    std::size_t place = 0;  // place of its first unknown
    double mass = 0;        // a share of the reference
    double turning = 1;     // inertia about the mass centre / (mass length^2)
    double length = 1;      // length that makes rotations comparable to displacements
    math::Vec2 local{0, 0};
    math::Vec2 centre{0, 0};  // mass centre, global
  };
  void order();
  const LinkagePlan& plan_;
  std::vector<Row> joints_;
  std::vector<Part> parts_;
  std::vector<std::size_t> joint_of_input_;
  double reference_ = 1;  // mass
  std::size_t width_ = 0;
  std::vector<double> matrix_, x_;
  const LinkageMotion* motion_ = nullptr;
};

}  // namespace linkwright::planar
