// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/type_synthesis/machine_objectives.h"
#include "linkwright/planar/type_synthesis/search.h"

namespace linkwright::planar {

/// An objective of the refinement of found machines.
struct MachineObjective {
  MachineQuantity quantity{};
  double weight = 1;                  ///< among the others, where all are refined together; > 0
  std::optional<double> reference{};  ///< value that counts as 1; none: that of the machine as found
  double at_most = infinity;          ///< times its reference
};

struct RefineOptions {
  std::vector<MachineObjective> objectives;  ///< one at least
  MachineLimits limits;                      ///< those of the search
  MachineLoads loads;
  double length_tolerance = 0;  ///< of lengths and coordinates, three standard deviations (m)
  /// The error may grow by the larger of these: a share of itself, and a share of the size of the stroke.
  /// With a tolerance of the target, machines within it stay within it. The size of an angle is a radian.
  double error_growth = 0.1, error_share = 1e-3;
  /// The greatest error of a function is limited, not its root mean square.
  bool greatest = false;
  /// The limited error of a function over its whole range, closer than the samples, in sizes or rad; may grow
  /// as that of the samples. None: the samples alone are compared. Called from several threads.
  std::function<double(const FittedMachine&)> whole_error = {};
  int starts = 2;  ///< for each machine and aim: the machine itself, then changes of it; >= 1
  std::uint64_t seed = 1;
  std::size_t max_solutions = 12;
};

/// A machine of the refined list.
struct RefinedMachine {
  FoundMachine found;
  std::vector<double> values;  ///< of the objectives, in the unit of each
  std::size_t from = 0;        ///< machine of the list from which it comes
  /// Objective for which it was refined, or their number for all together; none: as it was found.
  std::optional<std::size_t> aim;
};

struct RefineAnswer {
  Status status = Status::done;
  /// Not worse than another one in links, error, pair angle and objectives; by error.
  std::vector<RefinedMachine> machines;
  std::vector<std::vector<double>> as_found;  ///< objectives of the machines of the list
  std::int64_t descents = 0, steps = 0;       ///< starts of a refinement, and steps that improved a machine
};

/// Refines machines of a list for further objectives, each alone and all together by their weights, without
/// giving up the path or the function: by steps that are the optimum of a convex model, in which objectives
/// and limits are linear and the error is quadratic. The result depends on list, options and seed alone, not
/// on threads.
///
/// @param target what the machines were fitted to
/// @param list machines within the limits, measured
/// @param options objectives, limits, loads
/// @param context may end it early: machines that are not refined by then stay as found
/// @returns the new list; machines as found are in it where no refined one is better in every respect
RefineAnswer refine_machines(const MotionTarget& target, const std::vector<FoundMachine>& list,
                             const RefineOptions& options, RunContext& context);

}  // namespace linkwright::planar
