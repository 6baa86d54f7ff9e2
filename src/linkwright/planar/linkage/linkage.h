// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/pose.h"

namespace linkwright::planar {

/// A named point of a body, in the frame of the body (m).
struct LinkagePoint {
  std::string name;
  std::complex<double> at;
};

/// A mass that sits at a point of a body: a counterweight, a payload.
struct AttachedMass {
  std::string name;
  double mass = 0;          ///< kg, >= 0
  std::complex<double> at;  ///< in the frame of the body, m
};

/// Mass of a body without what is attached to it.
struct BodyMass {
  double mass = 0;              ///< kg, >= 0
  double inertia = 0;           ///< kg m2 about the mass centre, >= 0
  std::complex<double> centre;  ///< mass centre in the frame of the body, m
  bool assumed = false;         ///< inertia or centre was left out and is that of a uniform body
};

/// A rigid body. Where its frame lies is the user's choice; body 0 of a linkage is the ground, whose frame is
/// the global one.
struct LinkageBody {
  std::string name;
  std::vector<LinkagePoint> points;
  std::optional<BodyMass> mass;
  std::vector<AttachedMass> attached;
  /// The approximate pose of the body at the start: gives the assembly mode of its group, and is where a
  /// search starts. Not needed for groups whose mode is given.
  std::optional<math::Pose> start;
};

enum class JointType { revolute, prismatic, pin_in_slot, fixed, gear };
constexpr std::array<EnumName<JointType>, 5> names(JointType) {
  return {{{JointType::revolute, "revolute", "the two points coincide"},
           {JointType::prismatic, "prismatic", "the second body slides along a line of the first"},
           {JointType::pin_in_slot, "pin_in_slot", "a point of the second body lies on a line of the first"},
           {JointType::fixed, "fixed", "the second body is welded to the first"},
           {JointType::gear, "gear", "the second body turns `ratio` times as fast as the first"}}};
}

/// A point of a body, by index.
struct BodyPoint {
  int body = 0;
  int point = 0;
};

/// A joint between two bodies. Its coordinate is what a drive prescribes: of a revolute joint the angle of
/// the frame of the second body from that of the first (rad, counter-clockwise), of a prismatic joint the
/// displacement of the second point from the first along the slide (m). Its reaction is the force (and
/// moment) of the first body on the second.
struct LinkageJoint {
  std::string name;
  JointType type = JointType::revolute;
  BodyPoint first, second;
  /// Direction of the slide or slot (rad) in the frame of the first and of the second body: they stay
  /// parallel. For `fixed` the angle of the second frame from the first is slide_first - slide_second.
  double slide_first = 0, slide_second = 0;
  /// gear: (second - carrier) = ratio (first - carrier) + phase for the angles of the frames; the points are
  /// not used. Negative ratio: external teeth.
  double ratio = 1;
  double phase = 0;  ///< rad
  int carrier = 0;   ///< body that carries both axes
  /// gear: of its teeth (rad), 0 to less than pi/2. Radii follow from the distance of the two pins on the
  /// carrier and the ratio.
  double pressure_angle = pi / 9;
  /// Coulomb friction: of a pin, coefficient times pin radius times force; of a slide or slot, coefficient
  /// times normal force, which a guide of length > 0 takes as two forces at its ends.
  double friction = 0;      ///< coefficient, >= 0
  double pin_radius = 0;    ///< m, >= 0
  double guide_length = 0;  ///< m, >= 0
};

/// The assembly mode of a pair of bodies, one of two. The bodies are those of a dyad: `first` and `second`
/// are joined to each other, and each to bodies that are placed before them.
///   three pins (RRR): plus = the inner pin lies to the left of the line from the outer pin of `first` to
///   that of `second`;
///   pin on a slide (RRP, the slide at the outer end of either body): plus = the inner pin lies forward, in
///   the direction of the slide in its ground-side body, of the foot of the perpendicular from the outer pin;
///   slide between two pins (RPR): plus = `second`'s pin lies forward of `first`'s, along the slide direction
///   of `first`.
/// Of two bodies with a drive between them that hold an arm (a cylinder that raises a boom) `first` is one of
/// the two and `second` the arm; as three pins: plus = the pin of the arm at the driven bodies lies to the
/// left of the line from the other pin of the driven bodies to that of the arm.
enum class AssemblyMode { plus, minus };
constexpr std::array<EnumName<AssemblyMode>, 2> names(AssemblyMode) {
  return {{{AssemblyMode::plus, "plus", "left, or forward"},
           {AssemblyMode::minus, "minus", "right, or backward"}}};
}
constexpr double sign(AssemblyMode mode) { return mode == AssemblyMode::plus ? 1.0 : -1.0; }
struct DyadMode {
  int first = 0, second = 0;
  AssemblyMode mode = AssemblyMode::plus;
};

/// A spring with a damper beside it between two points: pulls with stiffness (length - free_length) +
/// damping d(length)/dt.
struct LinearSpring {
  std::string name;
  BodyPoint first, second;
  double stiffness = 0;    ///< N/m
  double free_length = 0;  ///< m
  double damping = 0;      ///< N s/m
};

/// Turns two bodies towards `free_angle` between their frames (second from first): torque on the second
/// -stiffness (angle - free_angle) - damping (speed difference). The angle has its turns, see PlanTwist, and
/// so may the free angle.
struct TorsionSpring {
  std::string name;
  int first = 0, second = 0;
  double stiffness = 0;   ///< N m/rad
  double free_angle = 0;  ///< rad
  double damping = 0;     ///< N m s/rad
};

/// The argument of a force or torque.
enum class LoadArgument { constant, input, time, x, y, speed };
constexpr std::array<EnumName<LoadArgument>, 6> names(LoadArgument) {
  return {{{LoadArgument::constant, "constant", "nothing"},
           {LoadArgument::input, "input", "the coordinate of the first joint with a drive"},
           {LoadArgument::time, "time", "the time"},
           {LoadArgument::x, "x", "x of the point, global"},
           {LoadArgument::y, "y", "y of the point, global"},
           {LoadArgument::speed, "speed",
            "of a torque: angular speed of its body against the body it comes from, as of a motor"}}};
}

/// The strength of a load: a factor that is 1, or interpolated linearly in a table and held at its ends, or
/// repeated.
struct LoadFactor {
  LoadArgument against = LoadArgument::constant;
  std::vector<double> argument;  ///< rising; rad, m, s or rad/s
  std::vector<double> factor;
  /// After which change of the argument the table repeats; 0: never. Not given: a table of whole turns of a
  /// first input that turns repeats after these turns, any other never.
  std::optional<double> period = {};
};
/// The period of a factor (0: none); `turns`: whether the first input turns.
double period_of(const LoadFactor& factor, bool turns);
struct Linkage;
/// Names of the forces and torques that go by the first input and keep the last value of their tables
/// somewhere from `low` to `high` of it.
std::vector<std::string> loads_held(const Linkage& linkage, bool turns, double low, double high);

/// A force on a point of a body, in the global frame or turning with the body.
struct PointForce {
  std::string name;
  BodyPoint point;
  std::complex<double> force;  ///< N
  bool turns_with_body = false;
  LoadFactor factor;
};

/// A torque on a body by the ground, or by another body, on which the opposite torque acts.
struct BodyTorque {
  std::string name;
  int body = 0;
  int from = 0;       ///< body that exerts it
  double torque = 0;  ///< N m, counter-clockwise positive
  LoadFactor factor;
};

/// Any planar linkage: plain data. bodies[0] is the ground. Make indices with `body_index` and `point_index`.
struct Linkage {
  std::vector<LinkageBody> bodies;
  std::vector<LinkageJoint> joints;
  std::vector<int> driven;  ///< joints with a drive, in the order of the inputs
  std::vector<DyadMode> modes;
  std::vector<LinearSpring> springs;
  std::vector<TorsionSpring> torsion_springs;
  std::vector<PointForce> forces;
  std::vector<BodyTorque> torques;
  std::complex<double> gravity{0, -9.81};  ///< m/s2, acceleration of free fall
  std::complex<double> moment_centre;      ///< shaking moments are about this place, global (m)
};

/// Index by name; -1 when there is none.
int body_index(const Linkage& linkage, std::string_view name);
int point_index(const LinkageBody& body, std::string_view name);
int joint_index(const Linkage& linkage, std::string_view name);

/// Characteristic length: the largest distance between two points that joints or slides use on one body, or
/// between joint points of the ground (m); 1 when there is none.
double size_of(const Linkage& linkage);

/// Checks the description by itself: indices, names given twice, numbers that are not finite, negative
/// masses, links of no length, springs between a body and itself, tables that do not rise. Keys are
/// "joint.<name>", "body.<name>" and so on. Whether it moves as it should is asked of `plan_linkage`.
Diagnostics check(const Linkage& linkage);

}  // namespace linkwright::planar
