// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/robot/drives.h"

/// Forces at rest, and the displacements that they cause. Weights are in dynamics.h, which at rest gives
/// their share.
namespace linkwright::parallel {

/// Force and moment that the surroundings exert on the platform, base axes. A moment counts for robots that
/// turn only: the others take it up by their parallelograms; planar robots likewise the force along z.
struct Wrench {
  Vec3 force{};   ///< N, through the platform point
  Vec3 moment{};  ///< N m, about the platform point
};

/// The forces that hold a load at rest.
struct StaticLoads {
  /// singular: type 2, and nothing holds; or the Pi-joint of `leg` is at +-90 deg, where its screw cannot
  /// hold the arm. no_assembly: the Pi-joint of `leg` cannot be there.
  Status status = Status::done;
  int leg = -1;            ///< first leg whose drive has the trouble, from 0; -1 = none
  Vector6 arm_torque{};    ///< torque of the drive on the arm, > 0 turns it forwards (N m); NaN in type 2
  Vector6 rod_force{};     ///< along the rod, of both rods of a parallelogram together, > 0 presses it (N)
  Vector6 drive_effort{};  ///< N m or N; NaN where it does not exist
};
/// tau = -J^T W through the rods: Jx^T lambda = -W, rod force lambda L, tau = Jq lambda. `drives` are those
/// of the same pose. Singular is what is within `limit` of it, in the measures of `Quality`. Allocates
/// nothing.
StaticLoads static_loads(const Robot& robot, const Jacobians& at, const DrivesAt& drives, const Wrench& load,
                         double limit = 1e-6);

/// det of the rows of Jx without dimension, as Quality::rods: 0 in a singularity of type 2.
double rods_determinant(const Robot& robot, const Jacobians& at);

/// The stiffnesses of the parts of a leg besides its drive, each infinite when left out.
struct LegStiffness {
  double rod = infinity;          ///< along, both of a parallelogram together (N/m)
  double arm_along = infinity;    ///< at the end of the arm, along it (N/m)
  double arm_bending = infinity;  ///< in its plane of motion (N/m)
  double arm_lateral = infinity;  ///< across that plane (N/m)
};
using LegStiffnesses = std::array<LegStiffness, max_legs>;

/// Stiffness of a pose without load: what loads themselves add by turning with the links is left out.
struct Stiffness {
  Status status = Status::done;  ///< singular: a leg does not yield at all (`leg`), as in type 1
  int leg = -1;                  ///< from 0
  /// K, wrench (fx ... or fx fy fz mx my mz) that shifts and turns the platform by 1 (N/m, N, N m/rad).
  Matrix6 matrix{};
  /// Eigenvalues, ascending (N/m), 0 where nothing holds (type 2, or a screw without lever); a HEXA's turning
  /// is measured by the displacement it makes at the characteristic length.
  Vector6 eigenvalue{};
  /// Unit displacement of the least eigenvalue, rotation likewise as a displacement (m).
  Vector6 softest{};
};
/// K = sum over the legs of Jx_i^T Jx_i / c_i, which is J^-T diag(j^2 k) J^-1 when the drives alone yield,
/// with the compliance of a leg to its lambda
///
///     c = Jq^2/(j^2 k) + L^2/rod + (s.u)^2/along + (s.u')^2/bending + (s.t)^2/lateral.
///
/// Allocates nothing.
Stiffness stiffness(const Robot& robot, const Drives& drives, const Jacobians& at, const DrivesAt& drives_at,
                    double characteristic_length, const LegStiffnesses& own = {}, double limit = 1e-6);

/// The displacement of the platform by a load, to first order.
struct Displacement {
  Status status = Status::done;  ///< singular: type 2, or the drive of a leg does not hold
  Vec3 shift{};                  ///< shift of the platform point (m)
  Vec3 turn{};                   ///< rad, base axes
};
/// Rigid legs stay rigid. Allocates nothing.
Displacement displacement(const Robot& robot, const Drives& drives, const Jacobians& at,
                          const DrivesAt& drives_at, const Wrench& load, const LegStiffnesses& own = {},
                          double limit = 1e-6);

}  // namespace linkwright::parallel
