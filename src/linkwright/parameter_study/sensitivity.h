// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/parameter_study/sampling.h"

// The influence of each parameter on a quantity.
namespace linkwright::parameter_study {

/// Elementary effects of one parameter (Morris 1991): changes of the quantity for the parameter's whole
/// range.
struct ElementaryEffects {
  double mean = 0;      ///< mu
  double mean_abs = 0;  ///< mu* of Campolongo, Cariboni and Saltelli 2007: the influence
  double sd = 0;        ///< sigma: bends and interactions; NaN with fewer than two effects
  std::size_t count = 0;
};

/// Elementary effects from the points of `morris_trajectories` and the quantity at each; steps with a NaN at
/// one end are left out. One entry a parameter; NaN where there is no effect at all.
std::vector<ElementaryEffects> elementary_effects(const Points& trajectories, std::span<const double> values);

/// Variance-based indices of one parameter.
struct SobolIndices {
  double first = 0;         ///< share of the variance that the parameter has by itself
  double total = 0;         ///< ... with all that it has together with others
  double first_margin = 0;  ///< half of the 95 % confidence interval, from resampled rows
  double total_margin = 0;
};

/// The indices of all parameters, and what they are of.
struct SobolDecomposition {
  std::vector<SobolIndices> parameters;
  double variance = 0;
  std::size_t used = 0;  ///< samples without a NaN
};

/// Sobol indices from the values at the points of `saltelli_points`: first-order indices by Saltelli et al.
/// 2010 (table 2, b), total ones by Jansen 1999 (table 2, f). Samples with a NaN among their dimension + 2
/// values are left out. The margins come from `resamples` bootstrap samples, drawn with `seed`. NaN where
/// fewer than two samples are left or the quantity does not vary.
SobolDecomposition sobol_indices(std::span<const double> values, std::size_t dimension, std::size_t resamples,
                                 std::uint64_t seed);

}  // namespace linkwright::parameter_study
