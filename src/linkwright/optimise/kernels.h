// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "linkwright/core/kernels.h"

/// The inner loops of the population methods, compiled once for each instruction set and chosen at run time.
/// All versions give the same bits: the random numbers are integers, and the rest is IEEE arithmetic without
/// contraction.
///
/// Random numbers are those of RandomStream({seed, run, generation, individual}): "word k" below is its k-th
/// bits().
namespace linkwright::optimise {

/// The key of the random numbers of a generation: the part of a StreamKey that a whole generation shares.
struct GenerationKey {
  std::uint64_t seed = 0;
  std::uint32_t run = 0;
  std::uint32_t generation = 0;
};

/// Rows of candidates in the layout of PopulationView. Kernels work on whole registers, that is on up to
/// seven candidates of the padding; arrays with one entry a candidate must therefore have `stride` entries,
/// too.
struct KernelShape {
  std::size_t dimension = 0, size = 0, stride = 0;
};

struct DifferentialEvolutionStep {
  KernelShape shape;
  GenerationKey key;
  const double* population = nullptr;
  double* trial = nullptr;                              ///< out
  const double *lower = nullptr, *upper = nullptr;      ///< one a variable
  const double *scale = nullptr, *crossover = nullptr;  ///< F and CR, one a candidate
  std::uint32_t crossover_word = 4;  ///< word that decides about variable 0, a multiple of 4
};

struct SelfAdaptationStep {
  std::size_t size = 0;
  GenerationKey key;
  const double *scale = nullptr, *crossover = nullptr;        ///< F and CR of the members
  double *trial_scale = nullptr, *trial_crossover = nullptr;  ///< out
  double scale_lower = 0, scale_width = 0, scale_rate = 0, crossover_rate = 0;
};

struct GreyWolfStep {
  KernelShape shape;
  GenerationKey key;
  double* pack = nullptr;  ///< in and out
  const double *lower = nullptr, *upper = nullptr;
  std::array<const double*, 3> leaders{};  ///< alpha, beta, delta: one value a variable
  double a = 0;                            ///< reach of the steps, from 2 down to 0
  bool absolute_value = false;  ///< absolute value of each X_k, as Eq. (4.25) of Boskovic 2018 is printed
};

struct Kernels {
  /// Trial vectors of rand/1/bin (Storn and Price 1997). Words 0 to 2 choose three members, distinct and not
  /// the target, word 3 the variable that is crossed in any case.
  void (*differential_evolution)(const DifferentialEvolutionStep&);

  /// New F and CR of jDE (Brest et al. 2006, Eq. (6) and (7)) from words 4 to 7.
  void (*self_adaptation)(const SelfAdaptationStep&);

  /// Moves each wolf to the mean of three points near the leaders (Mirjalili et al. 2014, Eq. (3.5) to (3.7))
  /// and into the box. Word 6 j + 2 k is r1 and the next is r2 of variable j and leader k.
  void (*grey_wolf)(const GreyWolfStep&);

  /// chosen[i] = all bits set where trial i is as good as member i or better (feasibility rules), else 0; the
  /// costs and violations of those members are overwritten.
  void (*select)(std::size_t size, const double* trial_cost, const double* trial_violation, double* cost,
                 double* violation, std::uint64_t* chosen);

  /// Copies the chosen candidates of each row.
  void (*copy_chosen)(const KernelShape& shape, const std::uint64_t* chosen, const double* from, double* to);
};

extern const Kernels loops_baseline, loops_avx2, loops_avx512;
KernelSet<const Kernels> kernel_set();
/// The widest that this processor can run.
const Kernels& kernels();

}  // namespace linkwright::optimise
