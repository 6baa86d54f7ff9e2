// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/table.h"
#include "linkwright/planar/linkage/motion.h"

namespace linkwright::planar {

/// The quality of the force transmission of a dyad at one position: the angle, folded to [0, pi/2], between
/// what its two joints other than the pin at `GroupState::reference` let that pin move along. pi/2 = best, 0
/// = dead point.
///   RRR: the transmission angle between the two links at the inner pin;
///   RRP: the angle between the link and the normal of the slide;
///   RPR: the angle between the slide and the normal of the line from the outer pin of the second body to
///        that of the first;
///   PRP, RPP: the angle between the two slides.
/// Its complement is the pressure angle at the slide. Of a general group the same name means the arc
/// sine of its smallest over its largest pivot. pi/2 for drivers and gears, NaN where not assembled.
double transmission_angle(const LinkagePlan& plan, const LinkageMotion& motion, std::size_t group);
/// pi/2 - transmission_angle: between the force on the slide's body, without friction, and the slide.
double pressure_angle(const LinkagePlan& plan, const LinkageMotion& motion, std::size_t group);

/// Extremes of the transmission angle of one group, and the value of the input where they are.
struct TransmissionRange {
  std::size_t group = 0;
  double minimum = 0, minimum_at = 0;
  double maximum = 0, maximum_at = 0;
  std::size_t missing = 0;  ///< samples at which the group does not assemble
};
/// ... of every dyad of the plan while one input runs from `from` to `to` and the others stay as given:
/// `samples` >= 2 positions, the extremes between them refined until the input is known to 1e-8 of its range.
/// The modes are those of `motion`.
std::vector<TransmissionRange> transmission_ranges(const LinkagePlan& plan, std::span<const double> inputs,
                                                   int input, double from, double to, std::size_t samples,
                                                   LinkageMotion& motion);

/// Coordinate of a joint and how it changes: revolute, the angle of the second frame from the first in (-pi,
/// pi]; prismatic and pin in slot, the displacement of the second point along the slide; gear, the angle of
/// the second frame from the carrier; fixed, zero. rad or m, per second.
struct JointMotion {
  double value = 0, rate = 0, acceleration = 0;
};
JointMotion joint_motion(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                         int joint);

/// Motion of the body as it looks from the frame of the reference.
PartState<double> relative_motion(const PartState<double>& reference, const PartState<double>& body);

/// The change of the distance between the centre of a pinion and the pitch line of its rack, which should be
/// the radius of the pinion.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion
/// @param joint index of the rack
/// @returns distance to the left of the pitch line less the radius (m)
double off_pitch_line(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                      int joint);

/// Ratios between an input and a joint at a position, the other inputs at rest, without friction, mass and
/// springs.
struct Advantage {
  /// Rate of the joint over that of the input: rad or m of the joint a rad or m of the input.
  double rate_ratio = 0;
  /// Force or torque that the joint can hold over that of the drive: 1 / rate_ratio; infinite where the joint
  /// is at rest.
  double force_ratio = 0;
};
/// After solve_position; the velocities in `motion` become those of a unit rate of the input. NaN unless the
/// motion is done.
Advantage advantage(const Linkage& linkage, const LinkagePlan& plan, int input, int joint,
                    LinkageMotion& motion);

/// The point where two bodies have the same velocity, by the velocities in the motion.
struct InstantCentre {
  enum class Kind { point, at_infinity, undetermined };
  /// at_infinity: the bodies turn alike, and `direction` points to the centre (in both directions);
  /// undetermined: they do not move against each other at these velocities.
  Kind kind = Kind::undetermined;
  int first = 0, second = 0;   ///< bodies
  math::Vec2 position{0, 0};   ///< global, m
  math::Vec2 direction{0, 0};  ///< unit vector
};
InstantCentre instant_centre(const LinkagePlan& plan, const LinkageMotion& motion, int first, int second);
/// The instant centres of all n (n - 1) / 2 pairs of bodies. By the theorem of Aronhold and Kennedy the three
/// centres of any three bodies lie on a line.
std::vector<InstantCentre> instant_centres(const LinkagePlan& plan, const LinkageMotion& motion);

/// Second-order geometry of the motion of a body as seen from a reference body, by the velocities and
/// accelerations in the motion; global coordinates at this instant. Independent of the speed along the motion
/// but for the acceleration pole.
struct PoleGeometry {
  bool turns = false;          ///< else the rest is NaN: the bodies do not turn against each other
  math::Vec2 pole;             ///< instant centre P
  math::Vec2 inflection_pole;  ///< W: PW is the diameter of the inflection circle
  math::Vec2 circle_centre;  ///< centre of the inflection circle: its points pass inflections of their paths
  double circle_radius = 0;  ///< m
  math::Vec2 acceleration_pole;  ///< point of the body without acceleration
};
PoleGeometry pole_geometry(const LinkagePlan& plan, const LinkageMotion& motion, int body, int reference = 0);

/// Curvature of the path of a point (1/m), positive when it turns left; NaN where the point is at rest.
double path_curvature(const PointMotion& point);

/// The fixed and the moving centrode of a body against a reference body while one input runs: columns
/// `input_rad` or `input_m`, `fixed_x_m`, `fixed_y_m` (in the frame of the reference) and `moving_x_m`,
/// `moving_y_m` (in the frame of the body); NaN and the status where there is no pole: "at_infinity",
/// "undetermined", or that of the motion. The body rolls on the reference with these curves.
Table centrodes(const LinkagePlan& plan, std::span<const double> inputs, int input, double from, double to,
                std::size_t samples, int body, int reference, LinkageMotion& motion);

}  // namespace linkwright::planar
