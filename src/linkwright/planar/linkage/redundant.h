// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/planar/linkage/motion.h"

/// @file
/// Linkages that move although they have a joint too many, since their dimensions agree: coupled wheels, a
/// parallelogram with a middle crank. The plan leaves out the direction of a pin that closes nothing, and the
/// joint forces are those of least squares.
namespace linkwright::planar {

/// The equations of the joints of a linkage in one position. Lengths count in sizes of the linkage.
struct ConstraintRank {
  int coordinates = 0;  ///< three a moving body
  int equations = 0;    ///< those of all joints, without drives
  int rank = 0;         ///< number of independent equations
  int freedoms() const { return coordinates - rank; }
  int redundant() const { return equations - rank; }
  /// Forces in the joints that balance each other, of length one each: `redundant` lists of one number an
  /// equation.
  std::vector<std::vector<double>> self_stress;
  std::vector<int> joint;                     ///< index of the joint, one an equation
  std::vector<int> joints_in_stress() const;  ///< joints that take part in a self-stress, rising
};

/// Counts the equations of pins, slides, slots and welds; nothing for linkages with gears, racks or belts, or
/// without joints. Joints of `as_pins` count as pins, whatever their type.
std::optional<ConstraintRank> constraint_rank(const Linkage& linkage, double size,
                                              std::span<const PartState<double>> bodies,
                                              std::span<const int> as_pins = {});

/// A linkage with a pin that keeps its distance by the dimensions alone.
struct RelaxedLinkage {
  Linkage linkage;       ///< the pin `joint` is a pin in a slot along the direction that closes nothing
  LinkagePlan plan;      ///< plan of it
  int joint = -1;        ///< index of that joint
  ConstraintRank drawn;  ///< the equations in the drawn position
};
/// Finds a pin whose one direction can be left out so that the linkage has a plan and the pin stays closed as
/// the linkage moves. The start poses of all bodies must be given.
///
/// @returns the linkage; nothing if there is none, with the reason in `why` where the linkage locks
std::optional<RelaxedLinkage> relax_redundant(const Linkage& linkage, std::string& why);

/// By how far the left-out direction of the pin is open, m.
double relaxed_gap(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, int joint);

/// The rule by which redundant joints share forces that balance each other.
enum class RedundantForces {
  least_squares,  ///< least sum of the squares of all joint forces
  compliance      ///< least energy of joints and bars that give way
};
constexpr std::array<EnumName<RedundantForces>, 2> names(RedundantForces) {
  return {{{RedundantForces::least_squares, "least_squares", "least sum of the squares of all joint forces"},
           {RedundantForces::compliance, "compliance", "least energy of joints and bars that give way"}}};
}

/// True if every self-stress of the drawing meets a joint or bar that gives way, so that the rule
/// `compliance` determines all forces.
bool gives_way(const Linkage& drawn, const ConstraintRank& rank);

/// A self-stress of the drawing as forces in its joints, one a joint, whose squares sum to one.
std::vector<JointReaction> self_stress_forces(const Linkage& drawn, const ConstraintRank& rank,
                                              std::size_t stress);

/// Changes the joint forces by parts that balance themselves, so that they follow the rule.
void spread_forces(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, int joint,
                   RedundantForces rule, LinkageForces& forces);

}  // namespace linkwright::planar
