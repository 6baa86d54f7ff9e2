// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "linkwright/planar/linkage/elimination.h"
#include "linkwright/planar/linkage/friction.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/strut.h"

namespace linkwright::planar {

/// Energy of motion, J. After solve_velocity.
double kinetic_energy(const LinkagePlan& plan, const LinkageMotion& motion);
/// Energy of weight, springs and struts, J: zero for masses at the global origin and springs at their free
/// lengths and angles; of struts see stored_energy.
double potential_energy(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion);
/// The same with other twists of the torsion springs (rad, one a spring) than those of the motion.
double potential_energy(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                        std::span<const double> twists);
/// Power of the loads at the present motion, W, without what weight and springs take or give back.
double lasting_power(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                     std::span<const AppliedLoad> loads);

/// The route to the accelerations of free inputs, both with the same answer: by their mass matrix, or by the
/// joint forces of all parts (LinkageElimination), which many free inputs make cheaper.
enum class AccelerationRoute { mass_matrix, joint_forces };
/// The cheaper one where there is a choice: joint_forces from 9 free inputs on, and neither for gears nor for
/// friction or stops.
AccelerationRoute cheaper_route(const Linkage& linkage, const LinkagePlan& plan, std::size_t free);

/// Equations of motion of a linkage in the coordinates of its free inputs: inputs that no drive prescribes,
/// so that forces move them. For each of them, virtual work with the velocities v_j, w_j that a unit of its
/// rate gives the parts makes one equation,
///   sum over k of M_jk a_k + h_j = 0,
///   M_jk = sum over parts of m v_j.v_k + w_j (s x v_k) + w_k (s x v_j) + I w_j w_k,
///   h_j = sum over parts of F.v_j + N w_j,
/// with mass m, first moment s and inertia I of the part about its origin, and the wrench (F, N) that the
/// part needs beyond its loads when the free inputs have no acceleration (Kane's equations; compare Boskovic
/// 2018, Eq. (2.21)). Everything hangs on the inputs in closed form, so that nothing can drift apart.
///
/// Holds all memory: use it again and again (per thread); nothing is allocated after the first `solve`, but
/// for friction.
class LinkageDynamics {
 public:
  /// `free` says of each input whether forces move it. Throws ContractError when its length is not the number
  /// of inputs, a body has no mass (see LinkagePlan::massless), or joint_forces are wanted of a linkage with
  /// gears or friction. Linkage and plan must outlive this.
  LinkageDynamics(const Linkage& linkage, const LinkagePlan& plan, std::vector<bool> free,
                  AccelerationRoute route = AccelerationRoute::mass_matrix);

  /// Fills in the accelerations of the free inputs at values and rates of all inputs and accelerations of the
  /// prescribed ones. Loads that depend on an input take the first one, free or not.
  ///
  /// Returns done; the status of the position when it is not done (accelerations are NaN); singular when a
  /// free input moves no mass; self_locking when friction jams the linkage (see settle_friction);
  /// limit_reached when a gas spring is beyond its stroke.
  Status solve(double time, std::span<InputMotion> inputs);

  /// Positions and velocities of the last `solve`; set `motion.modes` to change assembly modes. Accelerations
  /// are there after solve_acceleration with the inputs that `solve` filled in.
  LinkageMotion motion;
  double power = 0;  ///< W at the last `solve`: of the prescribed drives and lasting_power of the loads
  LoadWithoutValue without_value = {};  ///< load that had no value at the last `solve`
  /// States of the joints with friction, which `solve` takes and fills in; nothing: the signs of their rates.
  std::optional<FrictionStates> states;
  /// W: what friction takes at the last `solve`.
  double friction_power = 0;
  /// Joint forces at the last `solve` of a linkage with friction.
  const LinkageForces& forces() const { return forces_; }
  /// M_jk over the free inputs at the last `solve`, row by row (kg m2, kg m or kg); empty by the
  /// route of the joint forces.
  std::span<const double> inertia() const { return mass_; }
  /// Indices of the free inputs.
  std::span<const std::size_t> free() const { return free_; }

 private:
  struct PartRate {
    math::Vec2 velocity;
    double speed;
  };
  void unit_velocities(std::span<const InputMotion> inputs);
  void scale_velocities(double rate);
  bool factorise();
  void resolve(std::span<double> right) const;
  Status settle_friction(double time, std::span<InputMotion> inputs);
  void needed_wrenches(double time, double input);
  bool solve_masses(std::span<InputMotion> inputs);
  void power_of_loads();

  const Linkage& linkage_;
  const LinkagePlan& plan_;
  std::vector<std::size_t> free_, all_;
  std::vector<bool> is_free_;
  bool prescribed_, friction_, damped_, lasting_;
  std::vector<InputMotion> unit_, bias_;
  std::vector<PartRate> unit_rates_;  // parts of an input after those of the input before
  std::vector<AppliedLoad> loads_;
  std::vector<Wrench<double>> needed_;
  std::vector<double> mass_, factor_, right_;
  LinkageForces forces_;
  std::optional<LinkageElimination> elimination_;
};

}  // namespace linkwright::planar
