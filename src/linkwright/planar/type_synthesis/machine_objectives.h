// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/planar/type_synthesis/machine_loads.h"
#include "linkwright/planar/type_synthesis/polish.h"

namespace linkwright::planar {

/// A property that a found machine is refined for; less is better.
enum class MachineQuantity {
  peak_joint_force,   ///< N
  drive_torque,       ///< N m
  size,               ///< m
  peak_acceleration,  ///< at unit crank speed, in sizes of the stroke; of the output of a function m or rad
  tolerance_90,       ///< m, or rad where the output is an angle
};
constexpr std::array<EnumName<MachineQuantity>, 5> names(MachineQuantity) {
  return {{{MachineQuantity::peak_joint_force, "peak_joint_force",
            "largest force in any joint over the turn of the crank"},
           {MachineQuantity::drive_torque, "drive_torque", "largest torque of the drive, without its sign"},
           {MachineQuantity::size, "size", "larger side of the box of all pins over the turn"},
           {MachineQuantity::peak_acceleration, "peak_acceleration",
            "largest acceleration of the traced point, or of the output, at unit crank speed"},
           {MachineQuantity::tolerance_90, "tolerance_90",
            "root mean square error that nine of ten machines keep, made with tolerances of their lengths"}}};
}

/// True for quantities that depend on masses and loads.
constexpr bool needs_loads(MachineQuantity quantity) {
  return quantity == MachineQuantity::peak_joint_force || quantity == MachineQuantity::drive_torque;
}

/// Values of which a quantity is the largest, such as the forces of all joints at all crank angles.
struct QuantityTerms {
  std::vector<double> values;
  std::size_t series = 1;  ///< values of one row over the turn, one row after the other
  /// Of a quantity that contains the error, whose only term it is: its square less the squared error.
  std::optional<double> beside_error = {};
  bool ends = false;  ///< rows end at both sides instead of going around a turn

  double largest() const;
};

/// Changes of the parameters of a machine with each length and coordinate that is made: that of the crank,
/// then one a parameter of the machine's own plane. Its place and turn are not made.
///
/// @param shape the machine, in sizes of the stroke
/// @returns for each dimension the parameters that change and their derivatives by it
std::vector<std::vector<std::pair<std::size_t, double>>> dimension_effects(const MachineShape& shape);

/// The root mean square error that nine of ten machines keep whose lengths and coordinates are independent
/// and normally distributed. The squared error is a quadratic form of them, squares + 2 gradient.d + d.matrix
/// d; its quantile is that of the shifted gamma distribution with the same first three cumulants.
///
/// @param shape the machine, in sizes
/// @param model its error by its unknowns
/// @param tolerance of every length and coordinate, three standard deviations, in sizes
/// @returns the error, in sizes
double tolerance_90(const MachineShape& shape, const ErrorModel& model, double tolerance);

/// Evaluates quantities of one machine after the other, over the turn of its crank, or over the used part of
/// it where it need not turn. Make one a thread.
class MachineObjectives {
 public:
  /// @param target what machines are fitted to; lives as long
  /// @param quantities what is evaluated
  /// @param loads for forces
  /// @param tolerance of lengths for `tolerance_90`, three standard deviations (m)
  MachineObjectives(const MotionTarget& target, std::vector<MachineQuantity> quantities,
                    const MachineLoads& loads, double tolerance);

  /// The terms of each quantity; false where the machine has no answer.
  ///
  /// @param machine with its crank angles
  /// @param fitter of the same target
  /// @param out receives one entry a quantity
  bool evaluate(const FittedMachine& machine, MachineFitter& fitter, std::vector<QuantityTerms>& out);

 private:
  void choose_angles(const FittedMachine& machine);
  void trace(const FittedMachine& machine);
  void size_terms(const FittedMachine& machine, QuantityTerms& out) const;
  void acceleration_terms(const FittedMachine& machine, QuantityTerms& out) const;
  void output_acceleration_terms(QuantityTerms& out) const;
  void tolerance_terms(const FittedMachine& machine, MachineFitter& fitter, QuantityTerms& out) const;

  static constexpr std::size_t traced_angles = 720, force_angles = 180;

  const MotionTarget& target_;
  std::vector<MachineQuantity> quantities_;
  MachineLoads loads_;
  double tolerance_;
  std::vector<double> angle_, force_angle_, tx_, ty_, bx_, by_, rate_, points_;
  ForceSamples forces_;
};

}  // namespace linkwright::planar
