// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/suspension/compliance/elasticity.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"

/// Elasto-kinematics: how a wheel moves under load because the joints of its links yield. Small motions of
/// the carrier and of every link as rigid bodies about a position of the rigid suspension; joints with six
/// stiffnesses or characteristics each, rigid ones exact (Lagrange multipliers).
namespace linkwright::suspension {

/// The part that carries the wheel's load. Figures differ grossly with it, so it belongs to every result:
/// with the spring active a lateral force also makes the wheel travel.
enum class Support { spring, spring_held, wheel_centre_held, contact_held };
constexpr std::array<EnumName<Support>, 4> names(Support) {
  return {{{Support::spring, "spring", "the spring with its stiffness: the wheel travels"},
           {Support::spring_held, "spring_held", "length of the spring held"},
           {Support::wheel_centre_held, "wheel_centre_held", "height of the wheel centre held"},
           {Support::contact_held, "contact_held", "height of the contact point held, as on a rig"}}};
}

/// Force (N) and moment (N m) on the carrier about the wheel centre, vehicle frame.
struct WheelLoad {
  Vec3 force, moment;
};

/// Load of a force at a point (m, vehicle frame) and of a moment on a carrier with its wheel centre at
/// `centre`.
constexpr WheelLoad load_at(const Vec3& centre, const Vec3& point, const Vec3& force,
                            const Vec3& moment = {}) {
  return {force, moment + cross(point - centre, force)};
}

/// Force at a point of the carrier (m, vehicle frame) that keeps its direction.
struct PointLoad {
  Vec3 point, force;
};

/// Force (N) and moment (N m) in a joint: on the link by the body, or on the carrier by the link (R and S: by
/// the body), at the joint's point. Vehicle frame.
struct JointForce {
  int link = 0;
  bool at_carrier = false;
  Vec3 point;
  Vec3 force, moment;
};

/// What acts on a suspension, as the columns of its answers: 0 to 5 force along and moment about x, y, z at
/// the wheel centre (N, N m), 6 the rack (m), 7 to 12 shift along and turn about x, y, z of the subframe at
/// the vehicle's origin (m, rad), 13 the force of the droplink along its line (N).
inline constexpr std::size_t elastic_inputs = 14, rack_input = 6, subframe_input = 7, droplink_input = 13;
using ElasticRow = std::array<double, elastic_inputs>;

/// Answer of a joint to unit inputs. Rows: force, moment.
struct JointTransfer {
  JointForce joint;  ///< joint and its position; its force and moment are those of the preload
  std::array<ElasticRow, 6> by{};
};

/// A suspension with elastic joints at a position. Rows and columns of matrices: x, y, z, about x, y, z.
struct Compliance {
  /// singular: see the reason.
  Status status = Status::done;
  std::string reason;  ///< empty, or what is left free or held twice
  Support support = Support::spring;
  Side side = Side::left;
  WheelAngles angles;
  Vec3 centre, contact;
  /// Motion of the wheel centre and turn of the carrier (m, rad) by force and moment there (N, N m), and the
  /// same at the contact for the point of the carrier there. Symmetric; positive definite with the spring
  /// active and all directions elastic, else semidefinite.
  Matrix6 at_centre{}, at_contact{};
  std::array<double, 6> by_rack{};  ///< motion without load by a metre of rack (m/m, rad/m)
  double rack_stiffness = 0;        ///< N/m, of the suspension against its rack without load on the wheel
  /// Motion of the carrier (rows) by unit shifts and turns of the subframe, without load; zero without one.
  Matrix6 by_subframe{};
  /// Force on the rack and force and moment on the subframe that move them, without load on the wheel: rows
  /// and columns rack, subframe.
  std::array<std::array<double, 7>, 7> ground_stiffness{};
  std::array<double, 6> by_droplink{};         ///< motion of the carrier by a newton of the droplink
  std::array<double, 7> droplink_by_ground{};  ///< of its end along it, by rack and subframe
  double droplink_compliance = 0;              ///< of its end along it, by its own force (m/N)
  std::vector<JointTransfer> joints;           ///< links in their order, joints at the body first
  /// Tension of each coupler (N), compression of the spring (N, force with which it pushes its ends apart)
  /// and upward force of a held height on the carrier (N), by unit inputs as in `JointTransfer`. NaN = none.
  std::vector<ElasticRow> couplers;
  ElasticRow spring{}, height{};
};

/// Assembles and solves the suspension at a position of its carrier, as the kinematic solver or the reference
/// gives it. Any number of links: a suspension whose rigid links would lock is what elastic joints are for.
///
/// With a `preload` (such as the static load at the contact) the turning of loaded links and of the load's
/// own arm is taken in (geometric stiffness), to first order in the forces of all joints, of which the spring
/// in its present position takes its share; needs a spring. Moments of bushings from travel before are not
/// known and not in it.
///
/// Throws ContractError for what `check` finds, and for a support that needs a spring when there is none.
Compliance solve_compliance(const Suspension& suspension, const CornerPlace& place, double rack,
                            const CornerElasticity& elasticity, Support support,
                            const std::optional<PointLoad>& preload = std::nullopt);

/// The first-order effect of a load and a rack displacement (m). Changes from the position without them.
struct ElasticResponse {
  Vec3 shift, turn;            ///< displacement of the wheel centre (m) and rotation of the carrier (rad)
  Vec3 contact_shift;          ///< m, point of the carrier at the contact
  double toe = 0, camber = 0;  ///< rad
  double spring_force = 0;     ///< N, more compression
  double height_force = 0;     ///< N, upward, of a height that is held
  std::vector<JointForce> joints;
  std::vector<double> couplers;  ///< N, more tension
};
ElasticResponse respond(const Compliance& compliance, const WheelLoad& load, double rack = 0);
/// The same by any inputs of a suspension.
ElasticResponse respond(const Compliance& compliance, const ElasticRow& inputs);

/// A load that is not small for the characteristics of the joints.
struct LoadedCompliance {
  ElasticResponse response;  ///< changes by the load, from the position without it (and with the preload)
  Compliance compliance;     ///< the answer to small further loads; its status is that of both
};

/// Equilibrium under a load, by Newton's method: motions are small, characteristics are followed.
///
/// @param load at the wheel centre, in addition to the preload
/// @returns response and compliance; without characteristics those of `respond` and `solve_compliance`
/// @throws ContractError as `solve_compliance`
LoadedCompliance solve_loaded(const Suspension& suspension, const CornerPlace& place, double rack,
                              const CornerElasticity& elasticity, Support support, const WheelLoad& load,
                              const std::optional<PointLoad>& preload = std::nullopt);

}  // namespace linkwright::suspension
