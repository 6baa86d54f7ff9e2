// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/optimise/cone_programme.h"
#include "linkwright/planar/type_synthesis/detail/dimension_limits.h"
#include "linkwright/planar/type_synthesis/refine.h"

namespace linkwright::planar {

/// What a descent makes small: the sum of weights times the ratios of the objectives to their references.
struct DescentAim {
  std::vector<double> weight;      ///< one an objective, 0 = free
  std::vector<double> reference;   ///< likewise, > 0
  std::vector<double> at_most;     ///< largest ratio
  double max_error = infinity;     ///< in sizes
  bool within_tolerance = false;   ///< the points stay within the tolerance of the target
  double max_greatest = infinity;  ///< of the errors of a function at its samples, in sizes or rad
  double max_whole = infinity;     ///< of the error over the whole range of a function
};

/// The greatest error of the output of a function at its samples, in sizes or rad.
inline double greatest_error(const MotionTarget& target, const MachineMeasures& measures) {
  return target.placed() ? measures.largest_deviation : measures.largest_rotation;
}

/// Descents of machines for further objectives, one after the other; make one a thread.
class MachineDescent {
 public:
  MachineDescent(const MotionTarget& target, const RefineOptions& options);

  /// Refines a measured machine; false where it has no values or the run is interrupted before the first.
  ///
  /// @param aim what is made small
  /// @param found receives the refined machine
  /// @param values receives its objectives
  /// @param context may end it early
  bool descend(const DescentAim& aim, FoundMachine& found, std::vector<double>& values, RunContext& context);

  /// Values of a measured machine; empty where it has none.
  std::vector<double> values_of(const FittedMachine& machine);

  MachineFitter& fitter() { return fitter_; }

  /// True for a measured machine without defects whose errors are as small as they are to be.
  bool keeps_errors(const DescentAim& aim, const FoundMachine& found) const;
  std::int64_t steps() const { return steps_; }

 private:
  /// A number that a step changes linearly: a term of an objective, or a limit that is to stay above zero.
  struct Row {
    std::size_t group = 0;    ///< objective, or their number for limits
    std::size_t index = 0;    ///< in its terms
    bool with_error = false;  ///< the squared error is added to it, and the root is the objective
    double value = 0;
    std::vector<double> gradient;
  };

  /// The squared error by changes in shares of `by`.
  struct ScaledError {
    std::vector<double> by;
    double squares = 0;
    Eigen::VectorXd gradient;  ///< half of it
    Eigen::MatrixXd matrix;
  };

  void evaluate_limits(const FittedMachine& machine, std::vector<double>& out);
  void choose_rows(const DescentAim& aim);
  bool is_held(std::size_t unknown, const FittedMachine& machine) const;
  bool linearise(const DescentAim& aim, const FittedMachine& machine);
  ScaledError scaled_error(const FittedMachine& machine);
  static double error_parts(const ScaledError& error, double radius, std::vector<optimise::Affine>& parts);
  static optimise::Affine linear_part(const Row& row, double factor, const ScaledError& error, double radius);
  optimise::Cone error_cone(const Row& row, const DescentAim& aim, const ScaledError& error, double radius,
                            std::optional<std::size_t> ratio);
  optimise::ConeProgramme programme(const DescentAim& aim, const ScaledError& error, double radius);
  void add_greatest(const DescentAim& aim, const ScaledError& error, double radius,
                    std::vector<optimise::Cone>& cones) const;
  bool propose(const DescentAim& aim, const ScaledError& error, double radius, RunContext& context);
  bool return_to_path(const DescentAim& aim, FittedMachine& machine);
  bool lessen_greatest(const DescentAim& aim, FittedMachine& machine, RunContext& context);
  bool moved(const DescentAim& aim, double part, FoundMachine& found, RunContext& context);
  bool improve(const DescentAim& aim, double& radius, FoundMachine& found, std::vector<double>& values,
               RunContext& context);
  double cost(const DescentAim& aim, std::span<const double> values) const;
  bool within_bounds(const DescentAim& aim, std::span<const double> values,
                     std::span<const double> before) const;
  static std::vector<double> largest(const std::vector<QuantityTerms>& terms);

  const MotionTarget& target_;
  const RefineOptions& options_;
  MachineFitter fitter_;
  MachineObjectives objectives_;
  DimensionLimits dimensions_;
  std::int64_t steps_ = 0;
  std::vector<QuantityTerms> terms_, moved_terms_;
  std::vector<double> limits_, moved_limits_;
  std::vector<Row> rows_;
  std::vector<double> change_;  ///< of all unknowns
  /// Errors of the output of a function and their derivatives, where the greatest is limited.
  std::vector<double> errors_, derivatives_;
  double predicted_ = 0;  ///< cost after the change, by the model
};

}  // namespace linkwright::planar
