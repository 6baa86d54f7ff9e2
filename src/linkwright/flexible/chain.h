// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/math/vector2.h"

/// @file
/// The flexible link as rigid bars that slide and turn in elastic joints (Boskovic 2018, (3.1)-(3.4)).
namespace linkwright::flexible {

/// The deformation and inertia of the cross-sections.
enum class Theory {
  euler_bernoulli,  ///< neither shear nor rotary inertia
  rayleigh,         ///< rotary inertia
  timoshenko,       ///< shear and rotary inertia
};
constexpr std::array<EnumName<Theory>, 3> names(Theory) {
  return {{{Theory::euler_bernoulli, "euler_bernoulli", "neither shear nor rotary inertia"},
           {Theory::rayleigh, "rayleigh", "rotary inertia of the cross-sections"},
           {Theory::timoshenko, "timoshenko", "shear and rotary inertia of the cross-sections"}}};
}

/// The cause of the hub's rotation.
enum class Hub {
  driven,  ///< its angle is given as a function of time
  free,    ///< a torque is given, or none
};

constexpr std::array<EnumName<Hub>, 2> names(Hub) {
  return {{{Hub::driven, "driven", "its angle is prescribed, whatever the link does"},
           {Hub::free, "free", "it turns with the link: rest, a torque, or none"}}};
}

/// The hub, the link and the mass at its tip.
struct Beam {
  double length = 0;                 ///< L (m)
  double density = 0;                ///< rho (kg/m3)
  double area = 0;                   ///< A (m2)
  double second_moment = 0;          ///< I of the cross-section (m4)
  double elastic_modulus = 0;        ///< E (Pa)
  double shear_modulus = 0;          ///< G (Pa); Timoshenko only
  double shear_coefficient = 0;      ///< k; Timoshenko only
  double tip_mass = 0;               ///< m_p (kg)
  double tip_inertia = 0;            ///< J_p (kg m2)
  double hub_radius = 0;             ///< r_H (m)
  double hub_inertia = 0;            ///< J_H about O (kg m2)
  Theory theory = Theory::rayleigh;  ///< deformation and inertia of the cross-sections
  bool extensible = false;           ///< springs E A / l along the link; else it keeps its length

  /// Damping forces of the link: mass_damping M q' + stiffness_damping K q' of its own coordinates
  /// (Rayleigh); the second alone is Kelvin and Voigt's material.
  double mass_damping = 0;       ///< 1/s
  double stiffness_damping = 0;  ///< s

  double hub_stiffness = 0;  ///< spring between ground and hub, without torque at theta = 0 (N m)
  double hub_damping = 0;    ///< damper between ground and hub (N m s)
  double gravity = 0;        ///< along -y of the ground (m/s2); x is the direction of xi at theta = 0

  /// The mass of the link, m = rho A L. @returns kg
  double mass() const { return density * area * length; }
  /// The bending stiffness E I. @returns N m2
  double bending_stiffness() const { return elastic_modulus * second_moment; }
  /// The shear stiffness G A k. @returns N; infinite without shear
  double shear_stiffness() const;
  /// The rotary inertia for each metre, rho I. @returns kg m; 0 for Euler and Bernoulli
  double rotary_inertia() const;
  /// The unit of the link's frequencies, w_s = sqrt(E I / (rho A L^4)). @returns rad/s
  double frequency_scale() const;
};

/// The reason why a description is not a beam, with the value and what is allowed.
///
/// @param beam the beam
/// @returns the reason; nothing if it is a beam
std::optional<std::string> problem(const Beam& beam);

/// The motion of the joints of the chain.
enum class Kinematics {
  /// Slides act across the mean direction of two bars, and the chain is shortened as the cubic line through
  /// them is: fourth order in the length of a cell, no spurious instability with two divisions or more.
  chord_consistent,
  /// Slides keep the hub's eta (Boskovic 2018, (3.6)-(3.9)), differentiated exactly. Second order, and above
  /// a spurious speed the straight link is unstable (critical_speed).
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
  Kinematics kinematics = Kinematics::chord_consistent;  ///< motion of the joints
  double hub_radius = 0;                                 ///< m
  double hub_inertia = 0;                                ///< about O, without node 0 (kg m2)
  double root_mass = 0;                                  ///< m_0 (kg)
  double root_inertia = 0;                               ///< J_0 (kg m2)
  std::vector<Cell> cells;                               ///< from the hub outwards
  bool extensible = false;                               ///< the cells have springs along the link
  double mass_damping = 0,                               ///< 1/s, see Beam
      stiffness_damping = 0;                             ///< s, see Beam
  double hub_stiffness = 0,                              ///< N m, see Beam
      hub_damping = 0,                                   ///< N m s, see Beam
      gravity = 0;                                       ///< m/s2, see Beam

  /// The length of the chain. @returns sum of the lengths of its cells (m)
  double length() const;
};

/// Number of coordinates of a cell: slide w (m), turn delta of the outer bar against the inner one (rad),
/// extension u (m, 0 unless the chain is extensible). The list of all coordinates runs from the hub outwards:
/// the slide of the cell with index s = 0, 1, ... is at 3 s + slide, and so on.
inline constexpr std::size_t coordinates_per_cell = 3;
/// Place of the slide among the coordinates of a cell.
inline constexpr std::size_t slide = 0,
                             turn = 1,  ///< place of the turn
    extension = 2;                      ///< place of the extension

/// Motion of hub and chain at an instant.
struct ChainState {
  double angle = 0,       ///< angle theta of the hub, rad
      rate = 0,           ///< rad/s
      acceleration = 0;   ///< rad/s2
  std::vector<double> q,  ///< coordinates, m and rad
      v,                  ///< their rates
      a;                  ///< their accelerations
};

/// The state at rest, undeformed.
///
/// @param chain the chain
/// @returns the state; all zero
ChainState state_at_rest(const Chain& chain);

/// The chain of a beam with n divisions, odd or even: 2n cells of length L / (2n), the masses of Simpson's
/// rule. Under loads at its nodes the straight chain bends exactly as the beam does, for every n.
///
/// @param beam the beam
/// @param divisions n, >= 1
/// @param kinematics motion of the joints
/// @returns the chain
/// @throws ContractError with the text of `problem`, for n < 1, and where source_linearised is to have
///   gravity, damping or springs along the link, which the printed equations do not know
Chain discretise(const Beam& beam, int divisions, Kinematics kinematics = Kinematics::chord_consistent);

/// The positions of the nodes, in axes of the hub, from O.
struct ChainShape {
  std::vector<math::Vec2> node;  ///< nodes 0, 1, ..., N (m)
  std::vector<double> angle;     ///< angles of the bars, against the hub (rad)
};

/// The shape of a chain.
///
/// @param chain the chain
/// @param q coordinates, three a cell
/// @returns nodes and angles of the bars
/// @throws ContractError unless there are three coordinates a cell
ChainShape shape(const Chain& chain, std::span<const double> q);

/// The largest angle between two bars of a link: beyond 0.5 the cells are too long for this curvature. Hinges
/// do not count.
///
/// @param chain the chain
/// @param q coordinates, three a cell
/// @returns largest |delta| (rad)
double largest_kink(const Chain& chain, std::span<const double> q);
/// The angle between two bars beyond which the cells are too long for the curvature (rad).
inline constexpr double kink_limit = 0.5;
/// The angle between two bars beyond which the chain folds and shows nothing of the link any more (rad).
inline constexpr double fold_limit = 1;

}  // namespace linkwright::flexible
