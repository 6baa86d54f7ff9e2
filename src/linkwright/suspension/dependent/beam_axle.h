// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/suspension/corner/suspension.h"

/// @file
/// Beam axles: a beam that carries both wheels, and the links, arms and linkages between it and the body. A
/// live axle has its differential on the beam, a de Dion axle has it on the body; their kinematics are the
/// same. The beam of a twist-beam axle twists between both wheels. Frame of the vehicle: x forward, y to the
/// left, z up, y = 0 in the middle plane.
namespace linkwright::suspension {

/// A rod with a ball joint at each end: a trailing link, a diagonal link, a Panhard rod. One constraint.
struct AxleRod {
  std::string name;              ///< name for messages and tables
  Vec3 body,                     ///< joint on the body, m
      beam;                      ///< joint on the beam at the reference, m
  std::optional<double> length;  ///< m, instead of the distance of its joints at the reference
};

/// An arm with a hinge at one end and a ball joint at the other: an A-arm. The hinge has two points, the ball
/// joint one. Two constraints.
struct AxleArm {
  std::string name;        ///< name for messages and tables
  std::vector<Vec3> body,  ///< joints on the body, m
      beam;                ///< joints on the beam at the reference, m
};

/// A Watt linkage: a bellcrank that turns about its pivot, with a rod at each of its ends. One constraint.
struct AxleWatt {
  std::string name;           ///< name for messages and tables
  bool pivot_on_beam = true;  ///< false: the pivot is on the body, and the rods lead to the beam
  Vec3 pivot,                 ///< of the bellcrank at the reference, m
      axis;                   ///< direction of the pivot's axis, of any length
  std::array<Vec3, 2> crank,  ///< ends of the bellcrank at the reference, m
      ends;                   ///< other ends of the two rods at the reference, m
};

/// A sliding block or a guide: a point of the beam stays in a plane of the body. One constraint.
struct AxleGuide {
  std::string name;  ///< name for messages and tables
  Vec3 beam,         ///< the point at the reference, m
      normal;        ///< direction across the plane, of any length
};

/// A ball joint between body and beam, as the front end of a torque tube has it. Three constraints.
struct AxleBallJoint {
  std::string name;  ///< name for messages and tables
  Vec3 at;           ///< the joint at the reference, m
};

/// A twist beam: two rigid trailing arms on a cross member that is stiff but for torsion. The halves of the
/// axle twist about the axis through its shear centre, the left one by half of the angle forward, the right
/// one backward. Each arm is held by a bushing on the body. The distance of the bushings grows with the
/// square of the twist; both give way to it alike, as least energy has it. Four constraints.
struct AxleTwist {
  std::string name;            ///< name for messages and tables
  std::array<Vec3, 2> pivots;  ///< bushings of the left and of the right arm at the reference, m
  Vec3 shear_centre,           ///< of the cross member in its middle at the reference, m
      axis{0, 1, 0};           ///< direction of the cross member, of any length
};

/// A beam axle with its location: plain data.
struct BeamAxle {
  CornerWheel left,                        ///< the left wheel at the reference
      right;                               ///< the right wheel at the reference
  std::vector<AxleRod> rods;               ///< rods
  std::vector<AxleArm> arms;               ///< A-arms
  std::vector<AxleWatt> watts;             ///< Watt linkages
  std::vector<AxleGuide> guides;           ///< guides
  std::vector<AxleBallJoint> ball_joints;  ///< ball joints
  std::optional<AxleTwist> twist;          ///< the beam twists; nothing for a rigid one
};

/// The number of constraints of an axle.
///
/// @param axle the axle
/// @returns the number; heave and roll remain free with 4
int constraints_of(const BeamAxle& axle);

/// The largest number of Watt linkages: more constraints than that overdetermine an axle.
constexpr std::size_t max_axle_watts = 4;
/// The largest number of equations of an axle, those of its two inputs included.
constexpr std::size_t max_axle_equations = 6 + max_axle_watts;

/// The prescribed inputs of an axle.
enum class AxleInputs {
  heave_roll,     ///< mean rise of both contacts (m), and angle of the road against the body (rad)
  wheel_centres,  ///< rise of the left and of the right wheel centre (m)
  contacts        ///< rise of the left and of the right contact point (m)
};
constexpr std::array<EnumName<AxleInputs>, 3> names(AxleInputs) {
  return {{{AxleInputs::heave_roll, "heave_roll", "mean rise of the contacts, and roll of the body"},
           {AxleInputs::wheel_centres, "wheel_centres", "rise of each wheel centre"},
           {AxleInputs::contacts, "contacts", "rise of each contact point"}}};
}

/// The place of the beam: its reference point, which is the middle of both wheel centres at the reference,
/// its rotation from the reference, and the angles of the bellcranks.
struct BeamPlace {
  Vec3 centre;    ///< m
  Mat3 rotation;  ///< from the reference
  /// rad, of each bellcrank against the part with its pivot; the first is the twist of a beam that twists
  std::array<double, max_axle_watts> cranks{};
};

/// A motion of the beam: velocities by unit rate of an input.
struct BeamMotion {
  Vec3 velocity,                                ///< of the reference point, m/s
      turning;                                  ///< rad/s
  std::array<double, max_axle_watts> cranks{};  ///< rad/s, of each bellcrank
};

/// An axle made ready for solving: what is constant while it moves. Points of the beam are from its reference
/// point.
struct BeamAxlePlan {
  /// A distance between a point of the body and one of the beam; one of them may be on a bellcrank.
  struct Distance {
    Vec3 body, beam;    ///< m
    double length = 0;  ///< m
    int watt = -1;      ///< index of the bellcrank that carries one of both points; -1 = none
    int label = 0;      ///< index in `labels`
  };
  /// The bellcrank of a Watt linkage.
  struct Crank {
    bool on_beam = true;
    Vec3 pivot, axis;  ///< m; unit
  };
  /// A point of the beam that stays in a plane.
  struct Plane {
    Vec3 beam, normal;  ///< m; unit
    double offset = 0;  ///< m, of the plane from the origin
    int label = 0;
  };
  BeamAxle axle;
  Vec3 centre;                             ///< of the beam at the reference, m
  std::vector<Distance> distances;         ///< rods, A-arms and rods of Watt linkages
  std::vector<Crank> cranks;               ///< of the Watt linkages
  std::vector<Plane> planes;               ///< guides
  std::vector<std::array<Vec3, 2>> balls;  ///< ball joints: at the body, on the beam
  std::vector<int> ball_labels;
  std::vector<std::string> labels;  ///< "'upper link'"
  /// A cross member that twists; points are from the reference point.
  struct Twist {
    std::array<Vec3, 2> pivots;  ///< m, left, right
    Vec3 shear_centre, axis;     ///< m; unit
    int label = 0;               ///< index in `labels`
  };
  std::optional<Twist> twist;         ///< nothing for a rigid beam
  int unknowns = 6;                   ///< 6 of the beam and an angle for each bellcrank
  std::array<Vec3, 2> axes;           ///< unit, of the left and of the right wheel at the reference, outboard
  std::array<Vec3, 2> wheel_centres;  ///< left, right, from the reference point, m
  std::array<Vec3, 2> contacts;       ///< left, right, at the reference, m
};

/// Makes an axle ready.
///
/// @param axle the axle
/// @returns the plan
/// @throws ContractError if `check_beam_axle` finds anything
BeamAxlePlan prepare_beam_axle(const BeamAxle& axle);

/// The reason why an axle does not move as an axle must.
struct AxleFault {
  std::string message,  ///< empty = nothing is wrong
      hint;             ///< what to change
};

/// Checks an axle: wheels on their sides, parts with a length, four constraints, and that these are
/// independent so that heave and roll remain and nothing else.
///
/// @param axle the axle
/// @returns the first fault that is found, with the links it is about
AxleFault check_beam_axle(const BeamAxle& axle);

/// The equations of an axle at a place.
struct AxleEquations {
  /// m; first the constraints, in the last two rows the inputs.
  std::array<double, max_axle_equations> residual{};
  /// Derivatives by shift of the reference point, turning and the angles of the bellcranks.
  std::array<std::array<double, max_axle_equations>, max_axle_equations> jacobian{};
  std::array<int, max_axle_equations> label{};  ///< index in the labels of the plan; -1 = an input
};

/// Evaluates the equations of an axle.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param inputs the prescribed inputs
/// @param values their values, as `beam_inputs` gives them
/// @param out receives the equations
void evaluate(const BeamAxlePlan& plan, const BeamPlace& place, AxleInputs inputs,
              const std::array<double, 2>& values, AxleEquations& out);

/// The inputs at a place.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param inputs which inputs
/// @returns their values (m, rad); 0 at the reference, but for the roll of wheels at different heights
std::array<double, 2> beam_inputs(const BeamAxlePlan& plan, const BeamPlace& place, AxleInputs inputs);

/// The place of a point of the beam; of one that twists, on the half on its side of the shear centre.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param reference the point at the reference (m)
/// @returns the point (m)
Vec3 on_beam(const BeamAxlePlan& plan, const BeamPlace& place, const Vec3& reference);

/// The rotation of the half of the beam that carries a wheel; that of the beam itself if it is rigid.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param side the wheel
/// @returns the rotation from the reference
Mat3 half_rotation(const BeamAxlePlan& plan, const BeamPlace& place, Side side);

/// The turning of the half of the beam that carries a wheel.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param motion motion of the beam
/// @param side the wheel
/// @returns angular velocity (rad/s)
Vec3 half_turning(const BeamAxlePlan& plan, const BeamPlace& place, const BeamMotion& motion, Side side);

/// The velocity of a point that is fixed to the half of the beam with a wheel.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param motion motion of the beam
/// @param side the wheel
/// @param at the point where it is now (m)
/// @returns velocity (m/s)
Vec3 half_velocity(const BeamAxlePlan& plan, const BeamPlace& place, const BeamMotion& motion, Side side,
                   const Vec3& at);

/// The end of a bellcrank of a Watt linkage.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param watt index of the linkage
/// @param end 0 or 1
/// @returns the point (m)
Vec3 crank_end(const BeamAxlePlan& plan, const BeamPlace& place, std::size_t watt, std::size_t end);

/// The contact point of a wheel: the lowest point of its tyre, a thin disc.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param side the wheel
/// @returns the point (m)
Vec3 contact_point(const BeamAxlePlan& plan, const BeamPlace& place, Side side);

/// Constraints that the free motion next to a place depends on most, and that motion in words.
struct WeakestAxleMotion {
  double singular_value = 0;       ///< least of the equations with the inputs; 0: not determined
  std::vector<std::string> parts;  ///< labels of the constraints that depend on each other there
  std::string motion;              ///< "shifting along y", "turning about z"
};

/// The motion that the links and the inputs determine least.
///
/// @param plan the plan of the axle
/// @param place place of the beam
/// @param inputs the prescribed inputs
/// @returns the motion with what it depends on
WeakestAxleMotion weakest_motion(const BeamAxlePlan& plan, const BeamPlace& place, AxleInputs inputs);

}  // namespace linkwright::suspension
