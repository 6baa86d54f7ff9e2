// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/linkage/plan.h"

namespace linkwright::planar {

/// Motion of a part: its origin and the direction of its x axis, and how they move. Global frame, SI.
template <class T>
struct PartState {
  math::Vector2<T> origin,        ///< m, global
      direction;                  ///< direction of the x axis, unit vector
  math::Vector2<T> velocity;      ///< velocity of the origin, m/s
  T speed;                        ///< rad/s, counter-clockwise positive
  math::Vector2<T> acceleration;  ///< acceleration of the origin, m/s2
  T angular_acceleration;         ///< rad/s2
};

/// The state of a group's closure.
template <class T>
struct GroupState {
  /// Radicand of a dyad with two modes, in m2 (RRP, RPR) or m4 (RRR): negative = it cannot be assembled, zero
  /// = the modes meet.
  T radicand;
  /// Determinant of the 2 x 2 equations over the product of the columns' lengths: the sine of the
  /// transmission angle of an RRR dyad. Zero = dead point.
  T sine;
  math::Vector2<T> reference;  ///< reference point R of the closure, global, m
  math::Vector2<T> column_x,   ///< displacement of R by a unit of the one joint
      column_y;                ///< displacement of R by a unit of the other
  T inverse;                   ///< 1 / cross(column_x, column_y)
  T rate_x,                    ///< rate of the joint of column_x
      rate_y,                  ///< rate of the joint of column_y
      rate_zero;               ///< rate of the third joint
};

/// Force and its moment about a point that is named beside it.
template <class T>
struct Wrench {
  math::Vector2<T> force;  ///< N, global
  T moment;                ///< N m
};

/// The memory of a group that is solved by a matrix.
struct GeneralGroupMemory;

/// Deletes the memory of a group.
struct GeneralGroupDelete {
  /// Deletes the memory.
  ///
  /// @param memory the memory, or null
  void operator()(GeneralGroupMemory* memory) const;
};
/// The owner of the memory of a group.
using GeneralGroupPointer = std::unique_ptr<GeneralGroupMemory, GeneralGroupDelete>;

/// Motion of a linkage at one instant, and the memory to compute it: make one a thread with its plan and use
/// it again and again; nothing is allocated after the first use. General groups start their search from the
/// positions that are in it.
class LinkageMotion {
 public:
  /// Memory for a plan, in the assembly modes of the plan and before the first position.
  ///
  /// @param plan the plan; it need not outlive the motion
  explicit LinkageMotion(const LinkagePlan& plan);

  /// done; no_assembly or singular (dead point) at `failed_group`, from which on nothing is known;
  /// not_converged as well for a general group.
  Status status = Status::done;
  int failed_group = -1;  ///< index of the group in the plan; -1 if none failed
  /// Length (m) by which the bodies of the failed group are too short or too long to close; 0 when assembled.
  double gap = 0;
  /// Largest distance (m) between the points that joints hold together, over the groups placed: what
  /// rounding, or Newton's method, left.
  double closure_residual = 0;
  /// State of each part; NaN where not known, but parts of general groups stay where they were, for the next
  /// search.
  std::vector<PartState<double>> parts;
  std::vector<GroupState<double>> groups;  ///< one a group
  /// Sign of the assembly mode in use, one a group: those of the plan unless changed.
  std::vector<double> modes;
  std::vector<GeneralGroupPointer> general;  ///< states of groups with a matrix, else null
  /// rad, one a torsion spring, then one a stop (0 of a slide), then one a counted pin, see PlanTwist; NaN
  /// before the first position
  std::vector<double> twists;
  /// Efforts of the rigid stops (N m or N, >= 0), one a stop, as those who solve for them leave them; of
  /// stops that give way 1 where they are touched, else 0. The loads of the linkage have them. Empty: rigid
  /// stops have none, and the others go by their gaps.
  std::vector<double> stops;
  /// Branches of the formulas of loads on which they go on smoothly, as those who follow a motion leave them,
  /// see LoadFormula::first_kink. Empty: those of the present motion.
  std::vector<double> branches;
  /// Angles with their turns (rad) of the parts that loops turn and gears follow, see DrivenAngle::shares;
  /// one a part, NaN before the first position and of other parts.
  std::vector<double> loop_angles;
};

/// A point of a body in the global frame: where it is and how it moves.
struct PointMotion {
  math::Vec2 position,  ///< global, m
      velocity,         ///< m/s
      acceleration;     ///< m/s2
};

/// The motion of a point of a body.
///
/// @param plan the plan of the linkage
/// @param motion the motion
/// @param body index of the body
/// @param at the point in the frame of the body (m)
/// @returns its motion in the global frame
PointMotion point_motion(const LinkagePlan& plan, const LinkageMotion& motion, int body,
                         std::complex<double> at);

/// The motion of a point of the linkage.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion
/// @param point a point of one of its bodies
/// @returns its motion in the global frame
PointMotion point_motion(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                         const BodyPoint& point);

/// The motion of a point by its name.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion
/// @param point name of the point, "body.point"
/// @returns its motion in the global frame
/// @throws ContractError if the linkage has no such point
PointMotion point_motion(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                         std::string_view point);

/// The frame of a body: origin and direction of its x axis, speeds and accelerations.
///
/// @param plan the plan of the linkage
/// @param motion the motion
/// @param body index of the body
/// @returns origin, direction and rates of its frame, global
PartState<double> body_state(const LinkagePlan& plan, const LinkageMotion& motion, int body);

/// Places all parts for the given inputs (values only). Closed forms where the plan has them; a general group
/// is searched by Newton's method from the positions in `motion`, or from its start poses at first.
///
/// @param plan the plan of the linkage
/// @param inputs one an input; only the values are used
/// @param motion receives the positions and the status
/// @throws ContractError when the number of inputs is not the plan's or one is not finite
void solve_position(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// The twists of the torsion springs at the present position of the parts; solve_position calls it.
///
/// @param plan the plan of the linkage
/// @param inputs one an input; only the values are used
/// @param motion has the positions and receives the twists
void count_turns(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Velocities for the given rates of the inputs, after solve_position.
///
/// @param plan the plan of the linkage
/// @param inputs one an input; values and rates are used
/// @param motion has the positions and receives the velocities
void solve_velocity(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Accelerations for the given accelerations of the inputs, after solve_velocity.
///
/// @param plan the plan of the linkage
/// @param inputs one an input
/// @param motion has the velocities and receives the accelerations
void solve_acceleration(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// Position, velocity and acceleration in one call.
///
/// @param plan the plan of the linkage
/// @param inputs one an input
/// @param motion receives the motion and the status
/// @throws ContractError as solve_position does
void solve_motion(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion);

/// The outcome of following a linkage from its present inputs to others.
struct FollowReport {
  bool arrived = true;  ///< the linkage is at the last inputs
  double reached = 1;   ///< share of the path that was covered, 0 to 1
};

/// Follows the linkage from its present inputs to others, so that general groups stay on their assembly mode
/// (ModeCurve; change points end the path). Plans in closed form need no path and are placed directly.
///
/// @param plan the plan of the linkage
/// @param from present values of all inputs (rad or m)
/// @param to wanted values of all inputs
/// @param motion stays at the last good position, with the status
/// @returns true if it arrived, else the share of the path that was covered
/// @throws ContractError if the numbers of inputs do not fit
FollowReport follow(const LinkagePlan& plan, std::span<const double> from, std::span<const double> to,
                    LinkageMotion& motion);

/// Marks a group, and those behind it, as not placed: positions are NaN, but those of groups without closed
/// form stay for the next search.
///
/// @param plan the plan of the linkage
/// @param motion receives the status
/// @param group index of the group that failed
/// @param status the reason
void mark_failed(const LinkagePlan& plan, LinkageMotion& motion, std::size_t group, Status status);

struct FrictionStates;

/// The load that a joint carries: force (N, global frame) and moment (N m) of its first body on its second.
/// Revolute joints and pins in slots have no moment; that of a driven joint includes the torque or force of
/// its drive. The moment of a gear is what it turns its second body with; its force is that of the teeth at
/// the pitch point, where that is known (Gear::mesh). Friction of the joint is not included: it is among the
/// loads.
struct JointReaction {
  math::Vec2 point{0, 0};  ///< position of the point of the second body, global, m
  math::Vec2 force{0, 0};  ///< N, global
  double moment = 0;       ///< N m, about `point`
  /// gear: force across the line of centres on its second body (N), positive to the left of the line from the
  /// first centre to the second; NaN where the mesh is not known. rack: force along the pitch line on the
  /// rack.
  double tangential = 0,
         separating = 0;  ///< gear, rack: force that presses the wheels apart (N); NaN likewise
};

/// A load on a body: a force at a point of the global frame and a torque.
struct AppliedLoad {
  int body = 0;            ///< index of the body
  math::Vec2 point{0, 0};  ///< global, m
  math::Vec2 force{0, 0};  ///< N, global
  double torque = 0;       ///< N m
};

/// The contact of a cam at an instant. Of a flat face it moves along the face.
struct CamContact {
  math::Vec2 point{0, 0};   ///< place of the contact on the cam, global, m
  math::Vec2 normal{0, 0};  ///< outward normal of the cam, global, unit vector
  /// Force of the cam on its follower along the normal (N); negative where the cam would have to pull, which
  /// only the other flank of a groove does. The second disc of a conjugate cam pushes instead.
  double force = 0;
  /// From the way in which the cam pushes the follower to the normal, rad, as CamState has it.
  double pressure_angle = 0;
  /// Effort on the moved joint by unit of force: cosine of the pressure angle, or m; negative where the cam
  /// pushes against the sense in which the coordinate of the joint counts.
  double lever = 0;
  bool on_second = false;  ///< conjugate: the second disc carries
};

/// Joint forces of a linkage at one instant; use one again and again.
struct LinkageForces {
  /// Status of the motion; self_locking when friction blocks it; limit_reached when a gas spring is beyond
  /// its stroke.
  Status status = Status::done;
  std::vector<JointReaction> joints;  ///< one a joint of the linkage
  /// One a strand of the plan: `tangential` is its tension (N), negative where it would have to push; the
  /// force is that on the second wheel, and acts on the first one along the same line.
  std::vector<JointReaction> strands;
  std::vector<CamContact> cams;  ///< one a cam of the linkage
  std::vector<double> drives;    ///< one an input: torque (N m) or force (N) of the first body on the second
  std::vector<AppliedLoad> loads;  ///< springs, loads, struts, friction as they acted; no weight
  /// Force of the mechanism, and of bodies welded to the ground, on the ground (N), weight included.
  math::Vec2 shaking_force{0, 0};
  /// Moment on the ground about Linkage::moment_centre (N m), with everything that acts on it.
  double shaking_moment_with_drive = 0;
  /// The same without the torques of drives that are mounted on the ground (N m).
  double shaking_moment = 0;
  double drive_power = 0;    ///< W, of all drives
  double load_power = 0;     ///< W, of springs, forces, torques and friction on the moving bodies
  double weight_power = 0;   ///< W
  double kinetic_power = 0;  ///< W: rate of the kinetic energy by velocities and accelerations
  int iterations = 0;        ///< iterations of the friction; 0 = none
  // Memory.
  std::vector<Wrench<double>> needed,      ///< memory: what the parts need
      group_joints;                        ///< memory: forces in the joints of a group
  std::vector<double> group_drives;        ///< memory: drives of a group
  std::vector<JointReaction> group_gears;  ///< memory: gears, racks and strands of a group
  std::vector<double> cam_efforts;         ///< memory: what the programmes of cams would exert
  std::vector<double> preload;             ///< memory: tension that all strands of a belt have in common
};

/// The force and the moment in a joint by its name.
///
/// @param linkage the linkage
/// @param forces its forces
/// @param joint name of the joint
/// @returns what the first body exerts on the second one
/// @throws ContractError if the linkage has no such joint
const JointReaction& joint_reaction(const Linkage& linkage, const LinkageForces& forces,
                                    std::string_view joint);

/// Forces of springs, dampers, forces, torques, struts and stops at the present motion, appended to `loads`
/// in this order, two for each spring, torque and strut.
///
/// @param linkage the linkage
/// @param plan its plan
/// @param motion its motion, velocities included
/// @param time time for load tables (s)
/// @param input value of the first input for load tables (rad or m)
/// @param loads receives the loads at its end
void applied_loads(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                   double input, std::vector<AppliedLoad>& loads);

/// A function that is given the drives (N m or N, one an input) that the accelerations in the motion ask for,
/// and changes these accelerations so that the free inputs ask for none.
using FreeAccelerations = std::function<void(std::span<const double> drives)>;

/// All joint forces, drive torques and the loads on the ground, by d'Alembert's principle along the
/// decomposition, last group first: 3 x 3 (in fact 2 x 2) equations a dyad. It needs solve_acceleration of
/// the same motion. A plan made `all_at_once` leads to the Newton-Euler equations of all bodies in one linear
/// system, the independent route. Friction of joints is that of settle_friction, with its status.
///
/// The status is that of the motion; forces are NaN unless it is done.
///
/// @param linkage the linkage, with masses and loads
/// @param plan its plan
/// @param motion its motion, accelerations included
/// @param time time for load tables (s)
/// @param input value of the first input for load tables (rad or m)
/// @param forces receives the forces; use one again and again
/// @param answer for inputs that no drive prescribes: their accelerations give way to friction; empty if all
///   are driven
/// @param states states of the joints with friction; null: the signs of their rates
///
/// @throws ContractError if a body has no mass (see LinkagePlan::massless)
void solve_forces(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                  double input, LinkageForces& forces, const FreeAccelerations& answer = {},
                  FrictionStates* states = nullptr);

}  // namespace linkwright::planar
