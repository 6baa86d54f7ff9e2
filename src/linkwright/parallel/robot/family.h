// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/parallel/robot/robot.h"

/// Families of robots with equal legs, given by a few dimensions, and what each dimension changes: exact
/// derivatives for a search of dimensions.
namespace linkwright::parallel {

enum class RobotFamily { delta, hexa, five_bar };
constexpr std::array<EnumName<RobotFamily>, 3> names(RobotFamily) {
  return {{{RobotFamily::delta, "delta", "three arms and rod pairs, three translations"},
           {RobotFamily::hexa, "hexa", "six arms and rods, all six motions"},
           {RobotFamily::five_bar, "five_bar", "two arms and rods in a plane (5R)"}}};
}

/// One dimension of a family.
struct FamilyDimension {
  std::string_view name;     ///< without unit: "arm"
  std::string_view summary;  ///< for people
  bool is_angle = false;     ///< rad, else m
};

inline constexpr int max_dimensions = 7;

/// Dimensions of a family, in the order in which designs have them. The last three are the arm l, the rod L
/// and the offset, the distance from the base to the near side of a region that is to be served (of a DELTA
/// or HEXA below the arms' pivots, of a five-bar ahead of them).
std::span<const FamilyDimension> dimensions(RobotFamily family);

/// Derivatives of a leg by one dimension.
struct LegRate {
  Vec3 base{}, platform{};
  double arm = 0, rod = 0;
};

/// A robot of a family, with derivatives of its legs.
struct DesignedRobot {
  Robot robot;
  int count = 0;                                                   ///< dimensions
  std::array<std::array<LegRate, max_legs>, max_dimensions> by{};  ///< [dimension][leg]
  Vec3 ahead{};       ///< unit direction from the base to the region
  double offset = 0;  ///< m; dimension count - 1
  int assembly = 1;   ///< sign of det Jx where the platform is on the side of the region, elbows out
  /// Sign of det C (constraint.h) of a DELTA where its constraint index counts as positive.
  int constraint = 1;
  /// Arms of equal legs have equal positions at equal outward angles, which are measured from the outward
  /// direction, positive towards the region: outward = alpha where this is 1, pi - alpha where it is -1.
  std::array<int, max_legs> sense{1, 1, 1, 1, 1, 1};

  int arm() const { return count - 3; }
  int rod() const { return count - 2; }
};

/// `values`: one a dimension. Throws ContractError for another number of them.
DesignedRobot design(RobotFamily family, std::span<const double> values);

/// Working mode in which all elbows point outwards.
WorkingMode elbows_out(RobotFamily family);

/// alpha of a leg for an outward angle (rad), and the other way round; in (-pi, pi].
double arm_angle_of(const DesignedRobot& designed, int leg, double outward);

}  // namespace linkwright::parallel
