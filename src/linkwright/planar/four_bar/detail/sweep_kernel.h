// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "linkwright/core/kernels.h"
#include "linkwright/planar/four_bar/sweep.h"

/// @file
/// The part of a sweep of four-bars that is compiled for each instruction set.
namespace linkwright::planar {

/// Constants of a machine in the order of the kernel's rows: ground direction, ground, crank, coupler,
/// rocker, sign of the branch, base parameters of crank, coupler and rocker.
inline constexpr std::size_t four_bar_constants = 19;

/// The task of a kernel.
struct FourBarSweepTask {
  FourBarWanted wanted;               ///< rows that are kept
  bool over_machines = false;         ///< registers hold machines, else angles
  double gravity = 0;                 ///< m/s2, along -y
  const double* constants = nullptr;  ///< `four_bar_constants` rows, `width` numbers each
  std::size_t width = 1;              ///< length of a row of constants: `lanes` over machines, else 1
  std::size_t lanes = 0;   ///< length of a row, a multiple of 8: the last machine or angle is repeated
  std::size_t begin = 0;   ///< first lane that this call fills, a multiple of 8
  std::size_t end = 0;     ///< the lane after the last one, a multiple of 8
  std::size_t angles = 0;  ///< number of rows of a kind: 1, or angles where registers hold machines
  // Over `lanes`, the angle from the global x axis; over machines, cosine and sine of the crank angle.
  const double *angle = nullptr,  ///< over `lanes`: angle of the crank from the global x axis (rad)
      *cosine = nullptr,          ///< over machines: cosine of the crank angle
          *sine = nullptr;        ///< over machines: its sine
  const double *rate = nullptr,   ///< rates, as many as `angle` or `cosine`
      *acceleration = nullptr;    ///< accelerations, likewise
  double* data = nullptr;         ///< row r at angle i begins at data[(first[r] + i * rows) * lanes]
  std::size_t rows = 0;           ///< number of rows that are kept
  std::array<std::size_t, four_bar_row_count> first{};  ///< place of each row among those that are kept
  double* good = nullptr;  ///< `lanes` numbers an angle: 1 where the result holds, else 0
};

/// A function that fills the lanes of the rows from `begin` to `end` and returns true if all samples are
/// good. Compiled once for each instruction set; all but the baseline need the machine to have the
/// instructions.
using FourBarSweepKernel = bool(const FourBarSweepTask&);
/// The kernel for any machine.
FourBarSweepKernel four_bar_sweep_baseline,
    four_bar_sweep_avx2,    ///< the kernel for AVX2
    four_bar_sweep_avx512;  ///< the kernel for AVX-512
/// The kernels of the sweep. @returns one for each instruction set
KernelSet<FourBarSweepKernel> four_bar_sweep_kernels();

}  // namespace linkwright::planar
