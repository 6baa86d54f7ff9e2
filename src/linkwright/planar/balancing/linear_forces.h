// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/planar/four_bar/sweep.h"
#include "linkwright/planar/link_mass.h"
#include "linkwright/planar/linkage/plan.h"
#include "linkwright/planar/serial_arm/serial_arm.h"

// Forces of a mechanism whose geometry and motion are given, as functions of the masses of its links: they
// are linear in the base parameters (Boskovic 2018, Eqs. (2.33)-(2.36), (2.112)-(2.129), and any planar
// linkage likewise).
namespace linkwright::planar {

/// Base parameters of a link in this order: mass (kg), first moment x and y (kg m), inertia about the own
/// joint (kg m2), all in the frame of the link.
inline constexpr std::size_t base_parameter_count = 4;

/// One component of a force or a moment over the samples of a motion:
/// value_i = constant_i + sum over p of factors[p n + i] parameter_p, n samples, four parameters a link.
struct LinearComponent {
  std::string name;  ///< key of the column that the analysis has for it: "O1_x_N", "shaking_moment_N_m"
  std::vector<double> factors;
  std::vector<double> constant;  ///< part of the masses that are not open, of springs and loads
};

/// All components over a motion.
struct LinearForces {
  /// Status of the first sample without an answer (`failed_sample`), where the components are NaN; else done.
  Status status = Status::done;
  std::size_t failed_sample = 0;
  std::size_t samples = 0;
  bool closes = false;             ///< the last sample is the first one again: means count it once
  std::vector<std::string> links;  ///< links whose masses are open
  std::vector<LinkMass> initial;   ///< their masses as they are, one a link
  std::vector<LinearComponent> components;
};

/// The component of this name; or, for the name of a magnitude ("O1_N", "shaking_force_N"), its x and y.
/// Throws ContractError that lists the names when there is none.
std::vector<const LinearComponent*> quantity(const LinearForces& forces, std::string_view name);

/// The quantity at all samples for these base parameters, one a link; of a magnitude the root of the sum of
/// squares.
std::vector<double> values(const LinearForces& forces, std::string_view name,
                           std::span<const BaseParameters> links);

/// A four-bar: links crank, coupler and rocker; columns of the analysis of reactions. `crank` as for
/// FourBarSweep. Throws ContractError as FourBarSweep does.
LinearForces linear_forces(const FourBarMachine& machine, double gravity, const SweepInput& crank);

/// A serial arm: all its links ("link1", "link2", ...), without what is attached to them, which stays;
/// columns "O1_x_N", "O1_y_N", "link1_torque_absolute_N_m", "link1_torque_joint_N_m", ... `motion` holds the
/// absolute angles of all links at the first sample, then at the second, and so on. Gravity along -y (m/s2).
///
/// Throws ContractError as `elements` does, and unless every sample has one motion a link.
LinearForces linear_forces(const SerialArm& arm, std::span<const math::Motion> motion, double gravity);

/// Any planar linkage: the named bodies, without what is attached to them, which stays. Columns as in its
/// analysis: forces and moments of joints, drives, shaking. Springs, dampers, forces and torques go into the
/// constants. `inputs` holds the motion of all inputs at the first sample, then at the second; `times` (s)
/// one a sample, or is empty for 0. Own joint of a body is the origin of its frame, its link line the x axis.
///
/// Throws ContractError for a body without mass that is not among the open ones, friction and pressure
/// angles of gears (which are not linear), the ground or a body given twice, spans of wrong length, and a
/// linkage that does not fit the plan.
LinearForces linear_forces(const Linkage& linkage, const LinkagePlan& plan, std::span<const int> bodies,
                           std::span<const InputMotion> inputs, std::span<const double> times = {});

}  // namespace linkwright::planar
