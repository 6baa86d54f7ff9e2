// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/parallel/robot/robot.h"

/// The size of a ball around a pose in which nothing is singular: bounds instead of samples. Poses on both
/// sides of a singularity may look alike, and a path may cross two between any two instants.
namespace linkwright::parallel {

/// The working mode and these signs are the mark of a pose: poses of different marks cannot be joined without
/// a singularity. Equal marks prove nothing yet.
struct Marks {
  int assembly = 0;    ///< sign of det Jx
  int constraint = 0;  ///< sign of det C of a DELTA, see constraint.h; 1 for other robots
  friend bool operator==(const Marks&, const Marks&) = default;
};

/// Least singular value of the rods' rows below which a path has come to a singularity of type 2.
inline constexpr double rods_floor = 1e-3;

/// The data of a pose that the bounds need.
struct RegularAt {
  bool reached = false;
  int leg = -1;      ///< from 0: the first that cannot reach
  double reach = 0;  ///< least (rho^2 - c^2) / L^2 of the legs: below 0 beyond reach, 0 = arm and rod aligned
  Marks marks;       ///< 0 where the legs do not reach
  /// Least singular value of the rows s/L (in the plane their two parts, of a HEXA [s/L, (R b) x s/(L
  /// length)]): 0 in a singularity of type 2.
  double rods = 0;
  double constraint = 1;  ///< chi of a DELTA, see constraint.h; 1 for other robots
  struct Leg {
    double square = 0;      ///< q^2 = rho^2 - c^2 = (s . u')^2 (m2)
    double rho = 0, c = 0;  ///< m, see joint_seen
    double away = 0;        ///< pivot to platform joint (m)
  };
  std::array<Leg, max_legs> legs{};
};
/// `length` (m) makes the turning of a HEXA comparable, see `quality`. Allocates nothing.
RegularAt regular_at(const Robot& robot, const Pose& pose, const WorkingMode& mode, double length);

/// `rods` of a pose with any arm angles.
double min_rods(const Robot& robot, const Jacobians& at, double length);

/// The largest change of `rods` and `constraint` within a displacement of the pose, on the path no arm and
/// rod aligned; nothing where that cannot be said: the displacement is too large. With q = s . u' of a leg, r
/// the displacement of its platform joint,
///     q^2 >= q0^2 - r [2 (rho + r) + 2/l (|c| + r/l (v + r/2)) (v + r)],  |d(s/L)|, |d(t x s/L)| <= r / |q|,
/// as ds is the oblique projection of dg along u', of norm L/|q|; singular values move by no more than the
/// Frobenius norm of the change.
std::optional<double> change_within(const Robot& robot, const RegularAt& at, const Displaced& by,
                                    double length);

/// Within this distance of the pose (m; the platform not turned) nothing is singular: the legs reach, no arm
/// and rod are aligned, `rods` and `constraint` stay above half of their floors. 0 for a pose that does not
/// reach.
double clear_radius(const Robot& robot, const RegularAt& at, double length);

}  // namespace linkwright::parallel
