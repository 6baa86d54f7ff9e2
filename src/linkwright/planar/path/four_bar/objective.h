// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/core/kernels.h"
#include "linkwright/optimise/problem.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/mechanism.h"

namespace linkwright::planar {

/// A path problem on one branch and sense, laid out for the kernels.
struct PathObjective : TargetLayout {
  std::size_t points = 0;  ///< number of target points; the arrays repeat the last one up to a multiple of 4
  std::vector<double> ux,
      uy;  ///< prescribed timing: direction e^(i angle) of each point before the start angle is added
  double min_offset = 0, greatest_offset = 0;  ///< prescribed timing: extremes of those angles (rad)
  bool free_timing = false;                    ///< else `ux`, `uy` are used
  bool start_is_variable = false;              ///< equal steps: variable 9 is the start angle
  bool closed = true;
  double branch = 1;  ///< +1 open, -1 crossed
  double sense = 1;   ///< +1 or -1
  bool crank_rotates_fully = true;
  double max_transmission_cosine = 1;  ///< cos of the least transmission angle; 1 = no limit
  bool packaged = false;
  PackagingBox box;
  bool rocker_pivot_limited = false;
  PackagingBox rocker_pivot;  ///< sides without a limit are at +-1e300
  double size = 1;            ///< size of the path (m)
};

/// The ten-unknown problem (nine when the angles are given; 9 + points when timing is free, then every crank
/// angle is an unknown) on one branch and sense, for population methods; cost = sum of squared distances
/// (m2), evaluated by SIMD kernels. Boskovic 2018, Eqs. (4.2)-(4.4).
///
/// @param problem the problem
/// @param branch the branch that is searched
/// @param sense the sense of crank rotation, +1 or -1
/// @returns the problem for a population method
/// @throws ContractError as require_valid does
optimise::Problem path_population_problem(const PathProblem& problem, Branch branch, double sense);

PathObjective path_objective(const PathProblem& problem, Branch branch, double sense);

/// Costs (m2) and violations of a population; the variables are those of `path_population_problem`. Chooses
/// the kernel for the machine at the first call; the same bits for any split of the population.
void evaluate(const PathObjective& objective, const optimise::PopulationView& candidates,
              std::span<double> cost, std::span<double> violation);

/// Name of the instruction set in use: "avx512", "avx2" or "baseline".
const char* kernel_name();

/// Compiled once for each instruction set; all but the baseline need the machine to have the instructions.
using PathKernel = void(const PathObjective&, const optimise::PopulationView&, double* cost,
                        double* violation);
PathKernel evaluate_path_baseline, evaluate_path_avx2, evaluate_path_avx512;
KernelSet<PathKernel> path_kernels();

}  // namespace linkwright::planar
