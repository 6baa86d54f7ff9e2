// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/simulation/simulation.h"

// Flexible bodies of a linkage: couplers, rods, rockers. A slender uniform beam between two points of a body
// is replaced by rigid pieces that are pinned to each other, with a torsion spring at each pin (the rigid
// finite elements of Boskovic 2018, chapter 3, without the transverse slides of their joints).
//
// A beam of length L is divided into n cells of length l = L / n. The bending of a cell is gathered in its
// middle, in a spring of k = E I / l (Eq. (3.3)) with a damper of k times the retardation time beside it
// (Kelvin and Voigt: stress E (strain + time d(strain)/dt)). Pieces reach from spring to spring: n - 1 of
// length l and, at the ends, two of l / 2. They do not stretch or shear.
//
// Statics: a spring turns by the mean bending moment of its cell as the midpoint rule has it, so deflections
// have an error of order 1 / n^2: that of the tip of a cantilever under a force at its tip is 1 - 1 / (4 n^2)
// of P L^3 / (3 E I), that of the middle of a beam on two pins under a force there (n even) 1 - 1 / n^2 of
// P L^3 / (48 E I). The slides of the source would fix that and double the unknowns.
//
// Masses: pieces are uniform bars with their own moment of inertia. The beam that does not bend then has the
// mass, mass centre and moment of inertia of the rigid bar exactly, and the frequencies of a beam on two pins
// have an error of order 1 / n^4 only: with s = sin(j pi / (2 n)) the j-th is
//   w_j^2 = (E I / (density area l^4)) 16 s^4 / (1 - 2 s^2 / 3),
// about (j pi / (2 n))^4 / 90 of itself below that of the beam. Point masses at the ends of the cells, as the
// source has them (Simpson's weights, Eq. (3.1)), have the same whole, but without the slides frequencies
// with an error of order 1 / n^2 only: for n = 4 the first is 2.8 % too high, with bars 0.03 % too low.
namespace linkwright::planar {

/// A flexible body of a linkage, as a uniform Euler-Bernoulli beam. Its mass is density area L along the
/// line between its ends: it takes the place of `BodyMass`, while attached masses stay.
struct ElasticBody {
  int body = 0;                ///< body of the linkage
  double elastic_modulus = 0;  ///< Pa, > 0
  double second_moment = 0;    ///< second moment of area about the axis of bending, m4, > 0
  double area = 0;             ///< area of the section, m2, > 0
  double density = 0;          ///< kg/m3, > 0
  int segments = 4;            ///< cells, each with a spring in its middle: 1 to 64
  double damping = 0;          ///< retardation time of the material, s, >= 0
  double fibre_distance = 0;   ///< distance of the outermost fibre from the axis of bending, m, >= 0
  /// Points of the body where the beam ends; -1: where its joints are, which must be two places.
  int from = -1, to = -1;
};

/// The pieces that an elastic body was cut into.
struct ElasticPieces {
  ElasticBody beam;   ///< beam with `from` and `to` filled in
  double length = 0;  ///< L, m
  /// Bodies of the new linkage, from `from` to `to`: segments + 1, the first is the old one.
  std::vector<int> bodies;
  std::vector<int> joints;                  ///< between them, with a spring each: segments
  std::vector<int> springs;                 ///< torsion springs of the new linkage, one a joint
  std::vector<std::complex<double>> nodes;  ///< ends of the cells, segments + 1: one a piece, in its frame, m
};

/// A linkage with flexible bodies.
struct ElasticLinkage {
  /// done; infeasible with `problems`; else that of the rigid linkage, which has no place at the inputs.
  Status status = Status::done;
  Diagnostics problems;
  Linkage linkage;                    ///< bodies and joints of the rigid linkage keep their indices
  LinkagePlan plan;                   ///< drives of the rigid linkage first, then the joints of `free`
  std::vector<ElasticPieces> pieces;  ///< one an elastic body
  /// Values and rates of the inputs that were added, at the inputs given, with no body bent: where they start
  /// from. They are free: drives without a law.
  std::vector<InputDrive> free;
};

/// Replaces bodies of a linkage by flexible beams, starting unbent where the rigid linkage is with the given
/// inputs (values and rates), which also choose the assembly modes. Frames of the pieces lie on that of the
/// body when it is unbent; its points, forces, springs and attached masses go to the piece nearest to them.
/// Torques and torsion springs act on the piece at the joint that joins the two bodies they are between.
///
/// Added inputs of a body that is placed by a drive, or ends freely: the joints between its pieces. Of a body
/// in a dyad: its outer joint and the joints from there on but for the last, so that the last piece takes the
/// place of the body in the dyad and all stays in closed form. In general groups, the joints between its
/// pieces, with Newton's method on all of them.
///
/// The fastest vibration of the pieces, about 0.7 n^2 times the first, bounds the steps of `simulate`:
/// explicit methods for few segments without damping, `bdf` where damping makes that vibration die out at
/// once.
///
/// An evaluation of the equations of motion takes a time that goes with the number of segments from 9 free
/// inputs on (LinkageElimination): 2.7 times as long for 16 as for 4, and 4 times as long again for 64. Steps
/// get shorter by the square of that number, which is what limits it.
///
/// Problems have the key "elastic_body.<name>" or are those of `plan_linkage`. Throws ContractError when the
/// number of inputs is not that of the drives.
ElasticLinkage with_elastic_bodies(const Linkage& linkage, std::span<const ElasticBody> bodies,
                                   std::span<const InputMotion> inputs);

/// The bending of a beam at one instant.
struct BentBody {
  /// Deflections of the nodes from the straight line from the straight line from the first to the last, m:
  /// positive to its left. segments + 1, with 0 at both ends.
  std::vector<double> deflections;
  double middle = 0;   ///< deflection of the middle of the beam from that line, m
  double largest = 0;  ///< deflection of the node with the largest size, m
  /// Bending moments at the springs, that of their dampers included, N m: positive bends the beam to the left
  /// (anticlockwise) from `from` to `to`. One a segment, in the middle of its cell.
  std::vector<double> moments;
  /// Normal forces there, along the mean of the two pieces, N: positive pulls. Empty without joint forces.
  std::vector<double> normal_forces;
  double bending_stress = 0;  ///< Pa, >= 0: largest |moment| fibre_distance / second_moment
  /// Pa, >= 0: largest |moment| fibre_distance / second_moment + |normal force| / area; without joint forces
  /// that of bending alone.
  double stress = 0;
  int spring = 0;    ///< index of the spring at that section
  double place = 0;  ///< position of that spring along the unbent beam, from `from`, m
};
/// `motion` is that of `elastic.plan`, velocities included; pieces that of one of its bodies; `forces`, which
/// may be null, those of `elastic.linkage` with that motion.
BentBody bent_body(const ElasticLinkage& elastic, const ElasticPieces& pieces, const LinkageMotion& motion,
                   const LinkageForces* forces = nullptr);

/// The errors of so many segments, for a beam on two pins that is loaded by its own mass.
struct SegmentErrors {
  /// Share of the largest bending moment that no spring takes, as each sits in the middle of its cell: the
  /// larger one of a load that is the same all along and of one that grows from zero at an end. Moments at
  /// the springs are exact.
  double moment = 0;
  double frequency = 0;  ///< by what share the first frequency is too low
};
SegmentErrors segment_errors(int segments);
/// True if one of them matters: more than a tenth of the moment, or a twentieth of the frequency.
bool too_few_segments(int segments);
/// Least number from which on none does.
int enough_segments();

/// First frequency of the beam on two pins, by itself: pi^2 sqrt(E I / (density area L^4)), rad/s.
double first_frequency(const ElasticBody& beam, double length);
/// Its highest in pieces: (n / L)^2 sqrt(48 E I / (density area)) (see above, j = n), rad/s; what bounds
/// explicit steps.
double highest_frequency(const ElasticBody& beam, double length);

}  // namespace linkwright::planar
