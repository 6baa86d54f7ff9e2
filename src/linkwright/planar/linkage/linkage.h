// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/cam/programme.h"

namespace linkwright::planar {

/// A named point of a body, in the frame of the body (m).
struct LinkagePoint {
  std::string name;         ///< unique on its body
  std::complex<double> at;  ///< in the frame of the body, m
};

/// A mass that sits at a point of a body: a counterweight, a payload.
struct AttachedMass {
  std::string name;         ///< unique on its body
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
  std::string name;                    ///< unique in the linkage
  std::vector<LinkagePoint> points;    ///< points that joints, springs, forces and traces name
  std::optional<BodyMass> mass;        ///< without what is attached; nothing where it is not given
  std::vector<AttachedMass> attached;  ///< masses fixed to the body
  /// Axial stiffness between its two pins (N/m), by which redundant joint forces are divided; 0: it is rigid.
  double stiffness = 0;
  /// The approximate pose of the body at the start: gives the assembly mode of its group, and is where a
  /// search starts. Not needed for groups whose mode is given.
  std::optional<math::Pose> start;
};

/// The type of a joint between two bodies.
enum class JointType {
  revolute,     ///< a pin: the two points coincide
  prismatic,    ///< the second body slides along a line of the first, without turning against it
  pin_in_slot,  ///< a point of the second body lies on a line of the first
  fixed,        ///< the second body is welded to the first
  gear,         ///< the second body turns `ratio` times as fast as the first, both seen from the carrier
  rack,         ///< the first body, a pinion, rolls on a line of the second
  screw,        ///< of files: a prismatic joint with LinkageJoint::screw
  geneva        ///< of files: a gear with LinkageJoint::geneva
};
constexpr std::array<EnumName<JointType>, 8> names(JointType) {
  return {{{JointType::revolute, "revolute", "the two points coincide"},
           {JointType::prismatic, "prismatic", "the second body slides along a line of the first"},
           {JointType::pin_in_slot, "pin_in_slot", "a point of the second body lies on a line of the first"},
           {JointType::fixed, "fixed", "the second body is welded to the first"},
           {JointType::gear, "gear", "the second body turns `ratio` times as fast as the first"},
           {JointType::rack, "rack", "the first body is a pinion on the rack of the second"},
           {JointType::screw, "screw", "a slide that a spindle with a thread drives"},
           {JointType::geneva, "geneva", "a pin of the first body turns the slotted wheel of the second"}}};
}

/// True for the joints whose force is that of teeth.
///
/// @param type the type of a joint
/// @returns true for gears and racks
constexpr bool has_teeth(JointType type) { return type == JointType::gear || type == JointType::rack; }

/// A point of a body, by index.
struct BodyPoint {
  int body = 0;   ///< index into Linkage::bodies
  int point = 0;  ///< index into the points of that body
};

/// The angles of two wheels that are not circular, both seen from their carrier: a smooth curve through the
/// rows gives the second by the first.
struct RatioCurve {
  std::vector<double> first;   ///< rising, over one turn, after which the curve repeats, or a sector (rad)
  std::vector<double> second;  ///< rising or falling, as many (rad)
};

/// The slots of the wheel of a Geneva drive.
struct GenevaSlots {
  int count = 4;          ///< number of slots, at least 3
  bool internal = false;  ///< the crank turns within the wheel, which turns with it; else against it
};

/// The pin of a Geneva drive, a point of the first body, in the slots of its wheel, the second body.
struct Geneva {
  GenevaSlots slots;  ///< slots of the wheel
  /// Direction of a slot in the frame of the wheel (rad); nothing: as the bodies are turned where all their
  /// angles are 0, which is a drawing.
  std::optional<double> slot = {};
};

/// The middle line of a curved slot, in the frame of its body: a smooth curve through points, or an arc.
struct CurvedSlot {
  /// Points that the curve passes through (m), at least 3; empty: it is an arc.
  std::vector<std::complex<double>> points;
  bool closed = false;          ///< the curve through the points returns to the first one
  std::complex<double> centre;  ///< of the arc, m
  double radius = 0;            ///< of the arc, m, > 0; 0: the curve has points
  // Directions from the centre of the arc (rad), at most a turn apart, which makes it a circle. It runs
  // clockwise where the end is below the beginning.
  double from = 0,     ///< direction of the beginning
      to = full_turn;  ///< direction of the end

  /// @returns true for a circle and for a closed curve, which have no ends
  bool is_closed() const { return radius > 0 ? std::abs(to - from) >= full_turn * (1 - 1e-12) : closed; }
};

/// The screw that drives a slide. Its spindle turns by 2 pi for each lead of the displacement.
struct Screw {
  double lead = 0;             ///< displacement by turn, m, > 0
  double pitch_diameter = 0;   ///< m, > 0 where there is friction
  double friction = 0;         ///< coefficient on the flanks, >= 0
  double flank_angle = 0;      ///< whole angle between the flanks, rad, 0 to less than pi
  double spindle_inertia = 0;  ///< kg m2, >= 0
  bool left_hand = false;      ///< a positive turn moves the nut backward
};

/// The curve along which a coefficient of friction falls with the speed v from its value at rest, mu_s, to
/// that of fast motion, mu.
enum class FrictionFall {
  stribeck,   ///< mu + (mu_s - mu) exp(-(v / v_s)^2)
  hyperbolic  ///< mu + (mu_s - mu) / (1 + v / v_s)
};
constexpr std::array<EnumName<FrictionFall>, 2> names(FrictionFall) {
  return {{{FrictionFall::stribeck, "stribeck", "the difference falls as exp(-(v / speed)^2)"},
           {FrictionFall::hyperbolic, "hyperbolic", "the difference falls as 1 / (1 + v / speed)"}}};
}

/// A joint between two bodies. Its coordinate is what a drive prescribes: of a revolute joint the angle of
/// the frame of the second body from that of the first (rad, counter-clockwise), of a prismatic joint the
/// displacement of the second point from the first along the slide (m). Its reaction is the force (and
/// moment) of the first body on the second.
struct LinkageJoint {
  std::string name;                      ///< unique in the linkage
  JointType type = JointType::revolute;  ///< decides which of the members below are used
  BodyPoint first,                       ///< point of the first body
      second;                            ///< point of the second body
  /// Direction of the slide or slot (rad) in the frame of the first body; it stays parallel to
  /// `slide_second`. For `fixed` the angle of the second frame from the first is slide_first - slide_second.
  double slide_first = 0,
         slide_second = 0;  ///< the same direction in the frame of the second body (rad)
  /// gear: (second - carrier) = ratio (first - carrier) + phase for the angles of the frames; the points are
  /// not used. Negative ratio: external teeth.
  double ratio = 1;
  double phase = 0;  ///< rad
  /// gear of wheels that are not circular, instead of `ratio`: (second - carrier) = curve(first - carrier) +
  /// phase
  std::optional<RatioCurve> curve = {};
  /// gear of a pin and slots, instead of `ratio`; `first` is the pin, `second` the axis of the wheel
  std::optional<Geneva> geneva = {};
  /// gear: share of the rolling power, seen from the carrier, that the driven wheel gets, more than 0 up to 1
  double efficiency = 1;
  int carrier = 0;  ///< body that carries both axes
  /// rack: distance of the centre of the pinion, `first`, from the pitch line, which runs through `second` in
  /// the direction `slide_second` (m): positive where the centre lies to the left of that direction. The
  /// pinion is turned by `phase` against the body of the rack where its centre is beside `second`.
  double radius = 0;
  /// gear, rack: pressure angle of the teeth (rad), 0 to less than 1.5. Radii of a gear follow from the
  /// distance of the two pins on the carrier and the ratio.
  double pressure_angle = pi / 9;
  /// prismatic: the screw that drives it. The drive prescribes the displacement; the motion of the spindle
  /// and its torque follow.
  std::optional<Screw> screw = {};
  /// pin_in_slot: the curve of the slot in the frame of the first body, on which the second point lies,
  /// instead of a line. Its coordinate is the length of the curve from its beginning.
  std::optional<CurvedSlot> slot = {};
  /// Coefficient of Coulomb friction, >= 0: of a pin, coefficient times pin radius times force; of a slide or
  /// slot, coefficient times normal force, which a guide of length > 0 takes as two forces at its ends.
  double friction = 0;
  double pin_radius = 0;    ///< m, >= 0
  double guide_length = 0;  ///< m, >= 0
  /// Coefficient of friction of the joint at rest, >= `friction`; 0: the same as in motion.
  double friction_static = 0;
  /// Friction that no joint force changes, as of a brake, a clutch or a seal: torque of a pin (N m), force of
  /// a slide or slot (N), >= 0. It adds to that of the coefficients.
  double friction_effort = 0;
  /// Speed with which the coefficient falls from that at rest to that of motion (m/s; of a pin at its rim);
  /// 0: it falls at once.
  double friction_speed = 0;
  /// Speeds of sliding (m/s, from 0 on, rising) of a table of coefficients, instead of `friction` and of the
  /// curve; straight lines between, and the last value beyond. `friction_static` is not below the first one.
  std::vector<double> friction_speeds = {};
  std::vector<double> friction_values = {};             ///< coefficients at these speeds
  FrictionFall friction_fall = FrictionFall::stribeck;  ///< curve along which the coefficient falls
  double compliance = 0;  ///< m/N, by which redundant joint forces are divided; 0: it is rigid
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
enum class AssemblyMode {
  plus,  ///< left, or forward
  minus  ///< right, or backward
};
constexpr std::array<EnumName<AssemblyMode>, 2> names(AssemblyMode) {
  return {{{AssemblyMode::plus, "plus", "left, or forward"},
           {AssemblyMode::minus, "minus", "right, or backward"}}};
}

/// The sign of an assembly mode, as LinkagePlan has it.
///
/// @param mode the mode
/// @returns +1 for plus, -1 for minus
constexpr double sign(AssemblyMode mode) { return mode == AssemblyMode::plus ? 1.0 : -1.0; }
/// The assembly mode that is given for a pair of bodies.
struct DyadMode {
  int first = 0,                           ///< index of the first body
      second = 0;                          ///< index of the second body
  AssemblyMode mode = AssemblyMode::plus;  ///< see AssemblyMode
};

/// A spring with a damper beside it between two points: pulls with stiffness (length - free_length) +
/// damping d(length)/dt.
struct LinearSpring {
  std::string name;        ///< unique among the springs
  BodyPoint first,         ///< one end
      second;              ///< the other end, on another body
  double stiffness = 0;    ///< N/m, >= 0
  double free_length = 0;  ///< m, >= 0
  double damping = 0;      ///< N s/m, >= 0
};

/// Turns two bodies towards `free_angle` between their frames (second from first): torque on the second
/// -stiffness (angle - free_angle) - damping (speed difference). The angle has its turns, see PlanTwist, and
/// so may the free angle.
struct TorsionSpring {
  std::string name;       ///< unique among the torsion springs
  int first = 0,          ///< index of the body from which the angle counts
      second = 0;         ///< index of the body that the torque acts on
  double stiffness = 0;   ///< N m/rad, >= 0
  double free_angle = 0;  ///< rad
  double damping = 0;     ///< N m s/rad, >= 0
};

/// The argument of a force, torque or strut.
enum class LoadArgument {
  constant,  ///< nothing: the factor is 1
  input,     ///< coordinate of the first joint with a drive (rad or m)
  time,      ///< time (s)
  x,         ///< x of the point, global (m)
  y,         ///< y of the point, global (m)
  /// of a torque: angular speed of its body against the body it comes from (rad/s), as of a motor; of a
  /// strut: speed at which it becomes longer (m/s)
  speed,
  length  ///< of a strut: distance of its ends (m)
};
constexpr std::array<EnumName<LoadArgument>, 7> names(LoadArgument) {
  return {{{LoadArgument::constant, "constant", "nothing"},
           {LoadArgument::input, "input", "the coordinate of the first joint with a drive"},
           {LoadArgument::time, "time", "the time"},
           {LoadArgument::x, "x", "x of the point, global"},
           {LoadArgument::y, "y", "y of the point, global"},
           {LoadArgument::speed, "speed",
            "of a torque: angular speed of its body against the body it comes from, as of a motor; of a "
            "strut: speed at which it becomes longer"},
           {LoadArgument::length, "length", "of a strut: distance of its ends"}}};
}

/// The strength of a load: a factor that is 1, or interpolated linearly in a table and held at its ends, or
/// repeated.
struct LoadFactor {
  LoadArgument against = LoadArgument::constant;  ///< quantity that the table depends on
  std::vector<double> argument;                   ///< rising; rad, m, s or rad/s
  std::vector<double> factor;                     ///< as many as arguments
  /// After which change of the argument the table repeats; 0: never. Not given: a table of whole turns of a
  /// first input that turns repeats after these turns, any other never.
  std::optional<double> period = {};
};

/// The period of a load factor.
///
/// @param factor the factor
/// @param turns true if the first input turns
/// @returns the change of the argument after which the table repeats; 0 if it never does
double period_of(const LoadFactor& factor, bool turns);

/// The factor of a load.
///
/// @param factor the factor, not that of a constant load
/// @param argument value of the quantity that its table depends on
/// @param turns true if the first input turns
/// @returns the factor there
double factor_at(const LoadFactor& factor, double argument, bool turns);
struct Linkage;

/// Names of the forces, torques and struts whose tables depend on the first input and hold an end value
/// somewhere in an interval of it.
///
/// @param linkage the linkage with its forces and torques
/// @param turns true if the first input turns
/// @param low lower end of the interval of the first input (rad or m)
/// @param high upper end of the interval (rad or m)
/// @returns the names; empty if every table covers the interval
std::vector<std::string> loads_held(const Linkage& linkage, bool turns, double low, double high);

/// Formulas of a load instead of its table; a study file reads them.
struct LoadFormula;

/// True if formulas name such a quantity: the time, or a speed.
///
/// @param formula the formulas
/// @param argument time or speed
/// @returns true if they do
bool formula_goes_by(const LoadFormula& formula, LoadArgument argument);

/// The first load whose formula names the coordinate or rate of a joint, for computations that renumber
/// joints.
///
/// @param linkage the linkage
/// @returns its name; empty if there is none
std::string load_by_joint(const Linkage& linkage);

/// True if a force, torque or strut goes by a quantity, by its table or by its formula.
///
/// @param load the load
/// @param argument time or speed; what else tables go by, formulas never do
/// @returns true if it does
template <class Load>
bool goes_by(const Load& load, LoadArgument argument) {
  return load.factor.against == argument || (load.formula && formula_goes_by(*load.formula, argument));
}

/// A force on a point of a body, in the global frame or turning with the body.
struct PointForce {
  std::string name;            ///< unique among the forces
  BodyPoint point;             ///< where the force acts
  std::complex<double> force;  ///< N, at factor 1
  /// true: its direction is given in the frame of the body; false: in the global frame
  bool turns_with_body = false;
  LoadFactor factor;  ///< factor of the force
  /// Formulas of its components, instead of `force` and `factor`.
  std::shared_ptr<const LoadFormula> formula = {};
};

/// A torque on a body by the ground, or by another body, on which the opposite torque acts.
struct BodyTorque {
  std::string name;   ///< unique among the torques
  int body = 0;       ///< index of the body that it acts on
  int from = 0;       ///< index of the body that exerts it
  double torque = 0;  ///< N m, counter-clockwise positive
  LoadFactor factor;  ///< factor of the torque
  /// Formula of the torque, instead of `torque` and `factor`.
  std::shared_ptr<const LoadFormula> formula = {};
};

/// A gas spring: its force rises linearly as it becomes shorter.
struct GasSpring {
  double extended_force = 0;   ///< N, at the extended length, > 0
  double extended_length = 0;  ///< m, of the distance of its ends, > stroke
  double stroke = 0;           ///< m, by which it can become shorter, > 0
  double progression = 1;      ///< force at the end of the stroke as a multiple of the extended one, >= 1
};

/// A cylinder: pushes with pressure times the area of its bore, less back pressure times the area about its
/// rod. Its pressures are constant, or those of the two formulas of its strut.
struct Cylinder {
  double bore = 0;           ///< m, > rod
  double rod = 0;            ///< m, >= 0
  double pressure = 0;       ///< Pa, on the side of the bore
  double back_pressure = 0;  ///< Pa, on the side of the rod
};

/// A force between two points along the line through them, positive where it pushes them apart. strut.h has
/// its law.
struct Strut {
  std::string name;                       ///< unique among the struts
  BodyPoint first,                        ///< one end
      second;                             ///< the other end, on another body
  double force = 0;                       ///< N, at factor 1, of a strut without gas and cylinder
  LoadFactor factor;                      ///< factor of the force
  std::optional<GasSpring> gas = {};      ///< law of a gas spring instead
  std::optional<Cylinder> cylinder = {};  ///< law of a cylinder instead
  /// Formula of the force instead; two of the pressures of a cylinder.
  std::shared_ptr<const LoadFormula> formula = {};
};

/// A stop of a pin, slide or slot: its coordinate cannot pass a value. Rigid, it throws the joint back with a
/// share of its speed; with a stiffness it gives way. Its effort is 0 or pushes the joint back.
struct JointStop {
  int joint = 0;           ///< index of the joint
  double limit = 0;        ///< value of the coordinate at the stop (rad or m)
  double side = 1;         ///< +1: the coordinate is the limit at least; -1: at most
  double restitution = 0;  ///< speed after an impact by that before, 0 to 1; of a rigid stop
  /// N m/rad or N/m, > 0, of a stop that gives way; nothing: it is rigid
  std::optional<double> stiffness = {};
  double damping = 0;  ///< N m s/rad or N s/m, >= 0, of a stop that gives way
  double arm = 0;  ///< distance of the stop of a pin from its axis, where its force is asked for (m); 0: not
};

/// A wheel of a belt, or an end of a rope.
struct BeltWheel {
  BodyPoint centre;   ///< centre of the wheel on the body that turns with it
  double radius = 0;  ///< m, 0 for the end of a rope
  double side = 1;    ///< +1: the wheel lies to the left of the running belt, -1: to the right
};

/// A belt, chain or rope that does not stretch or slip, over wheels in the order in which it runs.
struct Belt {
  std::string name;               ///< unique among the belts
  std::vector<BeltWheel> wheels;  ///< two or more
  bool closed = true;             ///< it runs back to the first wheel; a rope does not
  /// The mean tension of the strands of a closed belt (N). Nothing: strands have the differences of their
  /// tensions about a mean of 0.
  std::optional<double> tension = {};
  /// Body on which the centres of all wheels of a closed belt have a pin. Their distances then stay, and the
  /// belt is a gear. -1: every strand keeps its own equation.
  int carrier = -1;
};

/// The contour of a cam.
enum class CamForm {
  outside,   ///< a disc, on which the follower is pressed
  groove,    ///< a slot with two flanks between which a roller runs
  conjugate  ///< two discs side by side, each with a roller of the follower
};
constexpr std::array<EnumName<CamForm>, 3> names(CamForm) {
  return {{{CamForm::outside, "outside", "a disc, on which the follower is pressed"},
           {CamForm::groove, "groove", "a slot with two flanks between which a roller runs"},
           {CamForm::conjugate, "conjugate", "two discs side by side, each with a roller of the follower"}}};
}

/// A cam as a member of a linkage: the coordinate of one joint, from where the follower touches the base
/// circle, is the programme of the angle of another. One body, which both joints have, carries cam and
/// follower; the contour of the cam follows from its programme and from the motion of the follower.
struct LinkageCam {
  std::string name;  ///< unique among the cams
  int turns = -1;    ///< joint on which the cam turns, revolute
  int moves = -1;    ///< joint whose coordinate the programme gives, revolute or prismatic
  /// Centre of the roller, edge, or a point of the flat face, on the body that touches the cam.
  BodyPoint contact;
  FollowerFace face = FollowerFace::roller;  ///< part of the follower that touches the cam
  double roller_radius = 0;                  ///< of a roller, m, > 0
  /// Distance of the contour from the centre where the programme is 0 (m); nothing: as the start poses show
  /// the follower, which is then where its programme is 0.
  std::optional<double> base_radius;
  BodyPoint second_contact;         ///< conjugate: centre of the roller on the second disc, on the same body
  double second_roller_radius = 0;  ///< conjugate: radius of that roller, m, > 0
  double face_direction = 0;        ///< direction of a flat face in the frame of its body (rad)
  CamForm form = CamForm::outside;  ///< contour of the cam
  bool is_clockwise = false;  ///< the programme goes over the clockwise angle of the cam from its carrier
  double phase = 0;           ///< angle of the programme where that of the joint is 0 (rad)
  CamProgramme programme;     ///< coordinate of the moved joint from the base circle

  /// @returns +1 for a programme over the counter-clockwise angle, -1 for one over the clockwise angle
  double sense() const { return is_clockwise ? -1 : 1; }
  /// @returns the radius of the roller; 0 of an edge and of a flat face
  double roller() const { return face == FollowerFace::roller ? roller_radius : 0; }
};

/// Any planar linkage: plain data. bodies[0] is the ground. Make indices with `body_index` and `point_index`.
struct Linkage {
  std::vector<LinkageBody> bodies;   ///< the ground first
  std::vector<LinkageJoint> joints;  ///< joints between the bodies
  std::vector<int> driven;           ///< joints with a drive, in the order of the inputs
  /// assembly modes that are given; other pairs take theirs from the start poses
  std::vector<DyadMode> modes;
  std::vector<LinearSpring> springs;           ///< springs with dampers
  std::vector<TorsionSpring> torsion_springs;  ///< torsion springs
  std::vector<PointForce> forces;              ///< forces on points
  std::vector<BodyTorque> torques;             ///< torques on bodies
  std::vector<Strut> struts;                   ///< forces between two points
  std::vector<Belt> belts;                     ///< belts, chains and ropes
  std::vector<LinkageCam> cams;                ///< cams with their followers
  std::vector<JointStop> stops;                ///< stops of joints
  std::vector<int> counted_pins;               ///< pins whose angles formulas name, with their turns
  std::complex<double> gravity{0, -9.81};      ///< m/s2, acceleration of free fall
  std::complex<double> moment_centre;          ///< shaking moments are about this place, global (m)
};

/// Index of a body by its name.
///
/// @param linkage the linkage
/// @param name name of the body
/// @returns index into Linkage::bodies; -1 if there is none of that name
int body_index(const Linkage& linkage, std::string_view name);

/// Index of a point by its name.
///
/// @param body the body that has the point
/// @param name name of the point
/// @returns index into LinkageBody::points; -1 if there is none of that name
int point_index(const LinkageBody& body, std::string_view name);

/// The place of a point in the frame of its body.
///
/// @param linkage the linkage
/// @param point a point of it
/// @returns its coordinates (m)
std::complex<double> place_of(const Linkage& linkage, const BodyPoint& point);

/// Index of a joint by its name.
///
/// @param linkage the linkage
/// @param name name of the joint
/// @returns index into Linkage::joints; -1 if there is none of that name
int joint_index(const Linkage& linkage, std::string_view name);

/// Characteristic length of a linkage.
///
/// @param linkage the linkage
/// @returns the largest distance between two points that joints or slides use on one body, or between joint
///   points of the ground (m); 1 if there is none
double size_of(const Linkage& linkage);

/// The first rack, belt, cam or gear of wheels that are not circular, for computations that do not take them.
///
/// @param linkage the linkage
/// @returns its kind and name, as "rack 'teeth'"; empty if there is none
std::string first_rolling_pair(const Linkage& linkage);

/// The name of a stop in columns and messages.
///
/// @param linkage the linkage
/// @param stop index of the stop
/// @returns the name of its joint and its side, as "O lower stop"
std::string stop_name(const Linkage& linkage, std::size_t stop);

/// True if a joint has friction, by a coefficient or by an effort of its own.
///
/// @param joint the joint
/// @returns true if it has
inline bool has_friction(const LinkageJoint& joint) {
  return joint.friction > 0 || joint.friction_static > 0 || joint.friction_effort > 0 ||
         !joint.friction_values.empty();
}

/// True if a joint loses power: by friction, or by the efficiency of a gear.
///
/// @param joint the joint
/// @returns true if it does
inline bool loses_power(const LinkageJoint& joint) { return has_friction(joint) || joint.efficiency < 1; }

/// Checks the description by itself: indices, names given twice, numbers that are not finite, negative
/// masses, links of no length, springs between a body and itself, tables that do not rise. Keys of the
/// diagnostics are "joint.<name>", "body.<name>" and so on. Its mobility is examined by `plan_linkage`.
///
/// @param linkage the linkage
/// @returns errors; empty if there are none
Diagnostics check(const Linkage& linkage);

}  // namespace linkwright::planar
