// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/suspension/indirect/corner_errors.h"
#include "linkwright/suspension/indirect/link_task.h"

namespace linkwright::suspension {

/// The rule by which the absolute structural errors of all equations and positions become one objective (m).
enum class ErrorTotal {
  mean,  ///< over equations and positions without the reference, P (N - 1): Poznanovic 2016, eq (57)
  sum,   ///< sum of all absolute errors
};
constexpr std::array<EnumName<ErrorTotal>, 2> names(ErrorTotal) {
  return {{{ErrorTotal::mean, "mean", "mean over equations and positions"}, {ErrorTotal::sum, "sum", "sum"}}};
}

/// The objective of one link over the free coordinates of its boxes, for population methods. Arguments as in
/// fit_link.
optimise::Problem link_problem(const CarrierTargets& targets, const LinkTask& task,
                               ErrorTotal total = ErrorTotal::mean);

/// The objective of a given link.
double link_objective(const CarrierTargets& targets, const CornerLink& link,
                      ErrorTotal total = ErrorTotal::mean);

/// The objective of several links and couplers over all their unknowns, see CornerErrors: the mean or the sum
/// of all their errors. Where the dyad that determines the carrier pitch cannot be assembled the violation is
/// what it misses by (m).
optimise::Problem suspension_problem(const CarrierTargets& targets, std::span<const LinkTask> links,
                                     std::span<const CouplerTask> couplers = {},
                                     CarrierPitchTechnique technique = CarrierPitchTechnique::each,
                                     double largest_carrier_pitch = 0.5, ErrorTotal total = ErrorTotal::mean);

/// Differential evolution with the settings of the source: five members an unknown, F = 0.6, CR = 0.9, until
/// all members are within 1e-5 m of the best (1e-4 m for thirty unknowns or more).
struct EvolutionOptions {
  optimise::DifferentialEvolutionOptions method;
  double spread = 0;  ///< m: the end; 0 = as the source has it
  CarrierPitchTechnique technique = CarrierPitchTechnique::each;
  double largest_carrier_pitch = 0.5;  ///< rad: bound of the unknown carrier pitches
  bool progress = false;               ///< report to the run context
  std::string checkpoint;              ///< see optimise::MinimiseOptions
};

/// The result of a common search for links and couplers.
struct Evolution {
  Status status = Status::done;  ///< status of the search: done, infeasible, deadline, cancelled
  std::vector<CornerLink> links;
  std::vector<Coupler> couplers;  ///< links counted as in the tasks
  CarrierTargets targets;         ///< targets with the carrier pitches found
  std::vector<ErrorTotals> link_errors, coupler_errors;
  double objective = 0;  ///< m: mean of all errors
  int generations = 0;
  std::int64_t evaluations = 0;
};
Evolution evolve_links(const CarrierTargets& targets, std::span<const LinkTask> links,
                       std::span<const CouplerTask> couplers, const EvolutionOptions& options,
                       const optimise::Seed& seed, RunContext& context);

}  // namespace linkwright::suspension
