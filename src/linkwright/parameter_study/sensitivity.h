// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/parameter_study/sampling.h"

/// @file
/// The influence of each parameter on a quantity.
namespace linkwright::parameter_study {

/// Elementary effects of one parameter (Morris 1991): changes of the quantity for the parameter's whole
/// range.
struct ElementaryEffects {
  double mean = 0;        ///< mu
  double mean_abs = 0;    ///< mu* of Campolongo, Cariboni and Saltelli 2007: the influence
  double sd = 0;          ///< sigma: bends and interactions; NaN with fewer than two effects
  std::size_t count = 0;  ///< number of effects
};

/// The elementary effects from the points of `morris_trajectories` and the quantity at each; steps with a NaN
/// at one end are left out.
///
/// @param trajectories points of `morris_trajectories`
/// @param values the quantity at each point
/// @returns one entry a parameter; NaN where there is no effect at all
/// @throws ContractError unless there are as many values as points, in whole trajectories
std::vector<ElementaryEffects> elementary_effects(const Points& trajectories, std::span<const double> values);

/// Variance-based indices of one parameter.
struct SobolIndices {
  double first = 0;  ///< share of the variance that the parameter has by itself
  /// Share of the variance with all that the parameter has together with others.
  double total = 0;
  double first_margin = 0;  ///< half of the 95 % confidence interval, from resampled rows
  double total_margin = 0;  ///< the same of the total index
};

/// The indices of all parameters with the variance that they divide.
struct SobolDecomposition {
  std::vector<SobolIndices> parameters;  ///< one entry a parameter
  double variance = 0;                   ///< variance of the quantity
  std::size_t used = 0;                  ///< samples without a NaN
};

/// Sobol indices from the values at the points of `saltelli_points`: first-order indices by Saltelli et al.
/// 2010 (table 2, b), total ones by Jansen 1999 (table 2, f). Samples with a NaN among their dimension + 2
/// values are left out. The margins come from bootstrap samples. NaN where fewer than two samples are left or
/// the quantity does not vary.
///
/// @param values the quantity at the points of `saltelli_points`
/// @param dimension number of parameters
/// @param resamples number of bootstrap samples
/// @param seed seed of the bootstrap samples
/// @returns the indices
/// @throws ContractError unless the values fill whole samples of dimension + 2
SobolDecomposition sobol_indices(std::span<const double> values, std::size_t dimension, std::size_t resamples,
                                 std::uint64_t seed);

}  // namespace linkwright::parameter_study
