// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "linkwright/parallel/robot/family.h"

/// Indices of poses of a designed robot, with exact derivatives by its dimensions.
namespace linkwright::parallel {

/// The indices to be measured.
struct DexterityMeasures {
  double length = 1;        ///< m, makes the turning of a HEXA comparable, see jacobians.h
  bool output = false;      ///< output indices, too
  bool constraint = false;  ///< true for the constraint index of a DELTA, too
};

/// Indices of one pose. `by[j]` are derivatives by dimension j.
///
/// The conditioning has a sign, that of det Jx relative to the assembly of the family: it goes through 0
/// where the rods do not hold the platform (type 2), and a robot does not get to the poses beyond.
///
/// The constraint index (constraint.h) has the sign of det C relative to that of the design: it goes through
/// 0 where the platform is free to turn, smoothly as long as one singular value does.
///
/// Beyond reach indices continue as numbers below 0 that say how far: of a leg that cannot reach, the square
/// of the input index is that of an imaginary one, (rho^2 - c^2) / L^2 < 0, and conditioning and constraint
/// are the least of these squares. Derivatives are those of these numbers. Where two singular values cross,
/// the conditioning has a kink, and the derivative is that of one side.
template <class T>
struct PoseDexterity {
  T conditioning;  ///< LCI: least over largest singular value of J, with the sign of the assembly
  std::array<T, max_legs> input_square;  ///< (s . u' / L)^2: square of the input transmission index
  std::array<T, max_legs> cosine, sine;  ///< in proportion to those of the outward angle of the arm
  std::array<T, max_legs> side;          ///< |sine| of the rod's swing out of the plane of the arm
  std::array<T, max_legs> output;        ///< output transmission index, 0 beyond reach
  T constraint;                          ///< chi with its sign; 1 where it is not measured
  std::array<T, max_dimensions> conditioning_by, constraint_by;
  std::array<std::array<T, max_dimensions>, max_legs> input_square_by, angle_by, side_by, output_by;
};

/// At a place local to the region (see prescribed_region.h), with derivatives. Allocates nothing.
void measure(const DesignedRobot& designed, const WorkingMode& mode, const DexterityMeasures& what,
             const Vec3& place, const Mat3& rotation, PoseDexterity<double>& out);

/// Places of one orientation, as many as `x` has numbers.
struct PoseSet {
  std::vector<double> x, y, z;  ///< local to the region (m)
  Mat3 rotation{};
  std::size_t size() const { return x.size(); }
};

/// Indices of all poses of a set, values alone: [pose] or [leg][pose].
struct SetDexterity {
  std::vector<double> conditioning, constraint;  ///< the latter where it was asked for
  std::array<std::vector<double>, max_legs> input_square, cosine, sine, side, output;
  /// Derivatives, where they were asked for.
  std::array<std::vector<double>, max_dimensions> conditioning_by;
};
/// Allocates only where `out` is smaller than before. The bits of a pose do not depend on the others.
void measure(const DesignedRobot& designed, const WorkingMode& mode, const DexterityMeasures& what,
             const PoseSet& poses, bool derivatives, SetDexterity& out);

}  // namespace linkwright::parallel
