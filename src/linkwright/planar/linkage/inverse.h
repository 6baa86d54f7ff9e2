// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/sentence.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/point_path.h"

/// @file
/// The other direction of motion: the drives that take a point of a linkage along a path. The drives are
/// found by Newton's method on the positions of the plan, their rates and accelerations exactly from the
/// Jacobian, whose columns are the velocities for unit rates of the drives.
namespace linkwright::planar {

/// The coordinates of the target that are followed; as many drives follow them.
enum class FollowedCoordinates {
  point,  ///< x and y of the point
  x,      ///< x of the point alone: y follows from the linkage
  y,      ///< y of the point alone: x follows from the linkage
  angle,  ///< angle of the body alone
  pose    ///< x and y of the point and the angle of the body
};
constexpr std::array<EnumName<FollowedCoordinates>, 5> names(FollowedCoordinates) {
  return {
      {{FollowedCoordinates::point, "point", "x and y of the point: two drives"},
       {FollowedCoordinates::x, "x", "x of the point alone, y follows from the linkage: one drive"},
       {FollowedCoordinates::y, "y", "y of the point alone, x follows from the linkage: one drive"},
       {FollowedCoordinates::angle, "angle", "the angle of the body alone: one drive"},
       {FollowedCoordinates::pose, "pose", "x and y of the point and the angle of the body: three drives"}}};
}
/// The number of drives that follow.
///
/// @param followed coordinates that are followed
/// @returns 1 to 3
constexpr std::size_t drives_of(FollowedCoordinates followed) {
  return followed == FollowedCoordinates::point ? 2 : followed == FollowedCoordinates::pose ? 3 : 1;
}

/// The point that follows a path, and the drives that take it along.
struct FollowedPoint {
  int body = 0;                                               ///< index of the body
  std::complex<double> at;                                    ///< the point in the frame of the body (m)
  FollowedCoordinates followed = FollowedCoordinates::point;  ///< coordinates that are followed
  std::vector<std::size_t> drives;                            ///< indices of the inputs that follow
};

/// Least singular value of the Jacobian below which a position is singular. Lengths and slides count in sizes
/// of the linkage, angles in radians.
inline constexpr double singular_path = 1e-6;

/// Places a linkage so that a point is at a target. Use one again and again, along a path: each place is
/// searched from the last one.
class LinkageInverse {
 public:
  /// @param plan the plan of the linkage, which must outlive this
  /// @param point the point and its drives
  /// @throws ContractError if there are not as many drives as followed coordinates, or one does not exist
  LinkageInverse(const LinkagePlan& plan, FollowedPoint point);

  /// Finds the values of the drives that follow, by Newton's method from those in `inputs`.
  ///
  /// @param target the target
  /// @param inputs one an input; values of the other drives are kept, those that follow receive theirs if
  ///   done
  /// @returns done; no_assembly where no position was found
  Status place(const PathState& target, std::span<InputMotion> inputs);

  /// Rates and accelerations of the drives that follow, after `place`; those of the other drives are given.
  ///
  /// @param target the target
  /// @param inputs receives rates and accelerations
  /// @returns done; singular where the target asks for rates that the Jacobian does not have
  Status rates(const PathState& target, std::span<InputMotion> inputs);

  /// The present place of the point and angle of its body.
  ///
  /// @returns place, angle and rates of the last position
  PathState state() const;

  /// @returns determinant of the Jacobian at the last place, without dimension
  double determinant() const { return determinant_; }
  /// @returns least singular value of the Jacobian there, without dimension
  double least() const { return least_; }
  /// @returns least over greatest singular value of the Jacobian there
  double conditioning() const { return conditioning_; }
  /// The largest change of a drive between two places, in radians or sizes of the linkage.
  ///
  /// @param a inputs of one place
  /// @param b inputs of the other
  /// @returns the largest change
  double distance(std::span<const InputMotion> a, std::span<const InputMotion> b) const;

  LinkageMotion motion;  ///< the last position

 private:
  bool assemble(std::span<const InputMotion> inputs);
  void residual(const PathState& target, std::span<double> out) const;
  void jacobian();
  std::vector<double> velocity_rows() const;

  const LinkagePlan& plan_;
  FollowedPoint point_;
  std::vector<double> jacobian_, scale_;
  std::vector<InputMotion> trial_, unit_;
  double determinant_ = 0, least_ = 0, conditioning_ = 0;
};

/// A position on the path.
struct PathRow {
  double time = 0;                  ///< s
  std::vector<InputMotion> inputs;  ///< all inputs
  bool singular = false;            ///< rates and forces are not determined
  double conditioning = 0;          ///< least over greatest singular value of the Jacobian
};

/// The drives along a path, as far as it is reached.
struct PathDrives {
  Status status = Status::done;  ///< done; no_assembly at the start; limit_reached where the path ends early
  std::vector<PathRow> rows;     ///< those at the times asked for, up to the end of what is reached
  double end = 0;                ///< time at which it ends (s)
  double share = 1;              ///< share of the path that is reached
  PathState last;                ///< the target at the end
  /// The reason why it ends: "boom and stick are stretched"; empty if it is reached to its end.
  Sentence reason;
};

/// The start of a path: the drives there, reached from a known position.
///
/// @param plan the plan of the linkage
/// @param point the point and its drives
/// @param from known or approximate values of all inputs
/// @param to the inputs at the start: values of the drives that do not follow
/// @param target the target at the start
/// @returns the inputs; nothing if the target is not reached
std::optional<std::vector<InputMotion>> path_start(const LinkagePlan& plan, const FollowedPoint& point,
                                                   std::span<const InputMotion> from,
                                                   std::span<const InputMotion> to, const PathState& target);

/// Follows a path on the mode of assembly, and the side of singular positions, where it begins.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param point the point and its drives
/// @param path the path
/// @param laws motion of the other drives; nothing of those that follow
/// @param start all inputs at the start, from path_start
/// @param times times of the rows (s), rising from 0
/// @returns the rows, and where and why the path ends
PathDrives follow_path(const Linkage& linkage, const LinkagePlan& plan, const FollowedPoint& point,
                       const PointPathMotion& path, std::span<const std::optional<math::MotionCurve>> laws,
                       std::span<const InputMotion> start, std::span<const double> times);

}  // namespace linkwright::planar
