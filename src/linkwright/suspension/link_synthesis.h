#pragma once

#include <array>
#include <cstdint>

#include "linkwright/core/run_context.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/suspension/link_fit.h"

namespace linkwright::suspension {

/// How the absolute structural errors of all equations and positions become one objective (m).
enum class ErrorTotal {
  mean,  ///< over equations and positions without the reference, P (N - 1): Poznanovic 2016, eq (57)
  sum,   ///< of all
};
constexpr std::array<EnumName<ErrorTotal>, 2> names(ErrorTotal) {
  return {{{ErrorTotal::mean, "mean", "mean over equations and positions"}, {ErrorTotal::sum, "sum", "sum"}}};
}

/// The objective of one link over the free coordinates of its boxes, for population methods. Arguments as in
/// fit_link.
optimise::Problem link_problem(const CarrierTargets& targets, const LinkTask& task,
                               ErrorTotal total = ErrorTotal::mean);

/// The objective of a given link.
double link_objective(const CarrierTargets& targets, const GuideLink& link,
                      ErrorTotal total = ErrorTotal::mean);

/// Differential evolution with the settings of the source: five members an unknown, F = 0.6, CR = 0.9, until
/// all members are within 1e-5 m of the best (1e-4 m for thirty unknowns or more), at most `generations`.
struct LinkEvolution {
  LinkFit fit;
  double objective = 0;
  int generations = 0;
};
LinkEvolution evolve_link(const CarrierTargets& targets, const LinkTask& task, std::uint64_t seed,
                          RunContext& context, int generations = 10000);

}  // namespace linkwright::suspension
