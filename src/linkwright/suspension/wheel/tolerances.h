// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/suspension/corner/design_numbers.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/wheel/quantities.h"

/// The scatter of the curves of a wheel suspension whose points are made within tolerances.
namespace linkwright::suspension {

/// A number of the design, made within plus or minus `tolerance` (m, rad, 1), at least 0.
struct TolerancedNumber {
  DesignNumber number;
  double tolerance = 0;
};

struct ToleranceTask {
  Suspension suspension;
  std::vector<TolerancedNumber> numbers;
  Driver driver = Driver::wheel_centre_z;
  std::vector<CornerInput> inputs;  ///< positions of the curves, in the order of a path
  std::vector<WheelQuantity> curves;
};

/// The distribution of numbers within their tolerances.
enum class Scatter { uniform, normal };
constexpr std::array<EnumName<Scatter>, 2> names(Scatter) {
  return {{{Scatter::uniform, "uniform", "anywhere within the tolerance alike"},
           {Scatter::normal, "normal", "normally, the tolerance being three standard deviations"}}};
}

struct MonteCarlo {
  int samples = 0;  ///< designs drawn and solved; 0 = none
  Scatter scatter = Scatter::normal;
  std::uint64_t seed = 1;
};

/// A curve at a position, in the unit of the quantity. NaN where there is no position or no such value.
struct Band {
  double nominal = 0;
  double worst_case = 0;  ///< plus and minus: all numbers at the bad ends of their tolerances, to first order
  double root_sum_square = 0;  ///< plus and minus: tolerances of independent numbers, to first order
  /// Statistics of the designs drawn; NaN without any.
  double mean = 0, standard_deviation = 0, least = 0, greatest = 0;
  int solved = 0;              ///< designs drawn that have a value here
  std::vector<double> shares;  ///< [number]: derivative times tolerance, whose sizes add up to the worst case
};

struct ToleranceBands {
  /// done; no_assembly or singular: a position of the nominal design is missing, its bands are NaN;
  /// deadline, cancelled: fewer samples than asked for.
  Status status = Status::done;
  std::vector<std::vector<Band>> bands;  ///< [curve][position]
  int samples = 0;                       ///< drawn
};

/// The bands by exact derivatives and, if asked for, by designs drawn at random and solved, on
/// RunContext::threads() threads and in the pieces of its checkpoint. Every sample has random numbers of its
/// own, so that results are the same bits for any number of threads. Throws ContractError for tolerances
/// below 0 or not finite, numbers that the suspension does not have, and no inputs or curves.
ToleranceBands tolerance_bands(const ToleranceTask& task, const MonteCarlo& monte_carlo, RunContext& context);

}  // namespace linkwright::suspension
