// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/flexible/beam.h"
#include "linkwright/flexible/vec2.h"

/// The flexible link as rigid bars that slide and turn in elastic joints (Boskovic 2018, (3.1)-(3.4)).
namespace linkwright::flexible {

/// The motion of the joints of the chain.
enum class Kinematics {
  /// Slides act across the mean direction of two bars, and the chain is shortened as the cubic line through
  /// them is: fourth order in the length of a cell, no spurious instability with two divisions or more.
  chord_consistent,
  /// Slides keep the hub's eta (Boskovic 2018, (3.6)-(3.9)), differentiated exactly. Second order, and above
  /// a
  /// spurious speed the straight link is unstable (critical_speed).
  hub_axis,
  /// Velocities linearised as printed ((3.11)-(3.15)), which know no stiffening by the speed. For comparison
  /// with the source only.
  source_linearised,
};
constexpr std::array<EnumName<Kinematics>, 3> names(Kinematics) {
  return {{{Kinematics::chord_consistent, "chord_consistent", "slides across the mean direction of two bars"},
           {Kinematics::hub_axis, "hub_axis", "slides along eta of the hub"},
           {Kinematics::source_linearised, "source_linearised", "velocities linearised as printed"}}};
}

/// Cell s = 1, 2, ... reaches from node s - 1 to node s: half a bar, the joint, half a bar. Node s has the
/// masses.
struct Cell {
  double length = 0;      ///< l (m)
  double shortening = 0;  ///< c2: e = l delta^2 / 12 - c2 w^2 / l (chord_consistent)
  double shear = 0;       ///< k_L: force for each metre of slide (N/m)
  double bending = 0;     ///< k_R: couple for each radian between the bars (N m)
  double axial = 0;       ///< k_A: force for each metre of extension (N/m); used if the chain is extensible
  double mass = 0;        ///< mass of node s (kg)
  double inertia = 0;     ///< moment of inertia of node s (kg m2)
  double damping = 0;     ///< damping of the rotation, beside that of the link's material (N m s)
  /// A joint between two links: of no length, turns only, about `bending` and `damping` (links.h).
  bool hinge = false;
};

/// A hub with a chain. Node 0 sits at O1, at (hub_radius, 0).
struct Chain {
  Kinematics kinematics = Kinematics::chord_consistent;
  double hub_radius = 0;    ///< m
  double hub_inertia = 0;   ///< about O, without node 0 (kg m2)
  double root_mass = 0;     ///< m_0 (kg)
  double root_inertia = 0;  ///< J_0 (kg m2)
  std::vector<Cell> cells;
  bool extensible = false;
  double mass_damping = 0, stiffness_damping = 0;  ///< see Beam
  double hub_stiffness = 0, hub_damping = 0, gravity = 0;

  double length() const;
};

/// Coordinates of the chain: three for each cell, from the hub outwards: slide w (m), turn delta of the outer
/// bar against the inner one (rad), extension u (m, 0 unless the chain is extensible). At 3 s + slide etc.
/// for the cell with index s = 0, 1, ...
inline constexpr std::size_t coordinates_per_cell = 3;
inline constexpr std::size_t slide = 0, turn = 1, extension = 2;

/// Motion of hub and chain at an instant.
struct ChainState {
  double angle = 0, rate = 0, acceleration = 0;  ///< theta and its derivatives (rad, rad/s, rad/s2)
  std::vector<double> q, v, a;                   ///< coordinates, their rates and accelerations
};

/// At rest, undeformed.
ChainState state_at_rest(const Chain& chain);

/// The chain of `divisions` n >= 1, odd or even: 2n cells of length L / (2n), the masses of Simpson's rule.
/// Under loads at its nodes the straight chain bends exactly as the beam does, for every n.
///
/// Throws ContractError with the text of `problem`, for n < 1, and where source_linearised is to have
/// gravity, damping or springs along the link, which the printed equations do not know.
Chain discretise(const Beam& beam, int divisions, Kinematics kinematics = Kinematics::chord_consistent);

/// The positions of the nodes, in axes of the hub, from O.
struct ChainShape {
  std::vector<Vec2> node;     ///< nodes 0, 1, ..., N (m)
  std::vector<double> angle;  ///< angles of the bars, against the hub (rad)
};
ChainShape shape(const Chain& chain, std::span<const double> q);

/// Largest |delta| between two bars of a link (rad): beyond 0.5 the cells are too long for this curvature.
double largest_kink(const Chain& chain, std::span<const double> q);
inline constexpr double kink_limit = 0.5;
/// Beyond it the chain folds and shows nothing of the link any more.
inline constexpr double fold_limit = 1;

}  // namespace linkwright::flexible
