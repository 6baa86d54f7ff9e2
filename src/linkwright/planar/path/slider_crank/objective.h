// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/core/kernels.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/problem.h"
#include "linkwright/planar/path/slider_crank/problem.h"

namespace linkwright::planar {

/// A path problem of the slider-crank on one side and sense, laid out for the kernels.
struct SliderPathObjective : TargetLayout {
  std::size_t points = 0;
  std::vector<double> ux, uy;  ///< prescribed timing: direction of the offset of each point, sense included
  double min_offset = 0, greatest_offset = 0;  ///< extremes of those offsets (rad)
  bool free_timing = false;
  bool closed = true;
  double side = 1;   ///< +1 forward, -1 backward
  double sense = 1;  ///< +1 or -1
  bool crank_rotates_fully = true;
  double max_pressure_sine = 1;  ///< 1 = no limit
  double min_stroke = 0, greatest_stroke = infinity;
  double size = 1;           ///< size of the path (m)
  bool with_stroke = false;  ///< two costs a candidate: error and stroke over their scales
  SliderPathScales scales{};
};

SliderPathObjective slider_path_objective(const SliderPathProblem& problem, SliderSide side, double sense);

/// Costs (m2; or error and stroke over their scales, candidate after candidate) and violations of a
/// population. Chooses the kernel for the machine at the first call; the same bits for any split of the
/// population.
void evaluate(const SliderPathObjective& objective, const optimise::PopulationView& candidates,
              std::span<double> cost, std::span<double> violation);

/// Name of the instruction set in use: "avx512", "avx2" or "baseline".
const char* slider_path_kernel_name();

/// Compiled once for each instruction set; all but the baseline need the machine to have the instructions.
using SliderPathKernel = void(const SliderPathObjective&, const optimise::PopulationView&, double* cost,
                              double* violation);
SliderPathKernel evaluate_slider_path_baseline, evaluate_slider_path_avx2, evaluate_slider_path_avx512;
KernelSet<SliderPathKernel> slider_path_kernels();

}  // namespace linkwright::planar
