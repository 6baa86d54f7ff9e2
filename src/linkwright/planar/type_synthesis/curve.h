// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/kernels.h"
#include "linkwright/planar/type_synthesis/program.h"

namespace linkwright::planar {

/// Most points of a program, and most of its parameters: ten links.
inline constexpr std::size_t max_steps = 16, max_machine_parameters = 28;

/// The crank pin stays this far from a sleeve, in cranks: rods that run through their sleeve faster are no
/// machines.
inline constexpr double sleeve_clearance = 0.3;

/// Samples of a curve at crank angles: arrays of as many numbers, a multiple of 8. Null arrays are not
/// computed.
struct CurveTask {
  const PointProgram* program = nullptr;
  const double* x = nullptr;
  unsigned signs = 0;
  const double* angle = nullptr;        ///< crank angles (rad), |angle| <= 1e5
  std::size_t count = 0;                ///< a multiple of 8
  double *px = nullptr, *py = nullptr;  ///< traced point
  double *tx = nullptr, *ty = nullptr;  ///< its derivative by the crank angle
  double *bx = nullptr, *by = nullptr;  ///< from the first pin of the traced bar to its second
  double* rate = nullptr;               ///< angular speed of the traced bar at unit speed of the crank
  double* quality =
      nullptr;  ///< least squared sine of all pair angles; negative where a pair does not assemble
  double* worst = nullptr;  ///< index of the step that has it
  /// Rows of the derivative of nx px + ny py, and of na times the angle of the traced bar where there is na,
  /// by the parameters at constant crank angle, `stride` numbers apart.
  const double *nx = nullptr, *ny = nullptr, *na = nullptr;
  double* rows = nullptr;
  std::size_t stride = 0;
  double* points =
      nullptr;  ///< all points in the machine's own plane: x of step 0, y of step 0, ..., `count` apart
};

/// Sums over `count` samples, a multiple of 8: products of all pairs of `columns` rows, `stride` numbers
/// apart, into the lower triangle (row by row) of `out`.
struct ProductsTask {
  const double* rows = nullptr;
  std::size_t stride = 0, count = 0, columns = 0;
  double* out = nullptr;
};

/// The kernels, once an instruction set.
struct CurveKernel {
  void (*curve)(const CurveTask&);
  void (*products)(const ProductsTask&);
};
extern const CurveKernel machine_curve_baseline, machine_curve_avx2, machine_curve_avx512;
KernelSet<const CurveKernel> machine_curve_kernels();

/// Runs the widest kernel that the processor has.
void compute_curve(const CurveTask& task);
void compute_products(const ProductsTask& task);

/// Gradient of the squared sine of the pair angle of one step, or of its counterpart for slides and sleeves,
/// by all parameters at one crank angle: `gradient` has as many entries as the program has parameters.
/// Returns the value.
double quality_gradient(const PointProgram& program, std::span<const double> x, unsigned signs, double angle,
                        int step, std::span<double> gradient);

}  // namespace linkwright::planar
