// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// @file
/// The influence of each parameter on a quantity.
namespace linkwright::parameter_study {

/// Points of the unit cube, one after the other: coordinate j of point i is at(i, j).
struct Points {
  std::size_t dimension = 0;        ///< number of coordinates
  std::vector<double> coordinates;  ///< point by point

  /// The number of points. @returns the number
  std::size_t count() const { return dimension == 0 ? 0 : coordinates.size() / dimension; }
  /// A coordinate of a point.
  ///
  /// @param point index of the point
  /// @param coordinate index of the coordinate
  /// @returns the coordinate, in [0, 1]
  double at(std::size_t point, std::size_t coordinate) const {
    return coordinates[point * dimension + coordinate];
  }
};

/// Dimensions for which there are Sobol sequences.
inline constexpr std::size_t max_sobol_dimensions = 3667;

/// All combinations of levels[j] values in equal steps from 0 to 1 (0.5 where there is one value); the last
/// coordinate runs fastest.
///
/// @param levels number of values of each coordinate, >= 1
/// @returns the points
/// @throws ContractError if a coordinate has no value
Points grid(const std::vector<std::size_t>& levels);

/// Latin hypercube (McKay, Beckman and Conover 1979): each coordinate falls once into each of as many equal
/// intervals as there are points, anywhere in it.
///
/// @param count number of points
/// @param dimension number of coordinates
/// @param seed seed of the random numbers
/// @returns the points
Points latin_hypercube(std::size_t count, std::size_t dimension, std::uint64_t seed);

/// The first points of a Sobol sequence (direction numbers of Joe and Kuo 2008) behind the origin, which is
/// left out.
///
/// @param count number of points
/// @param dimension number of coordinates, at most max_sobol_dimensions
/// @returns the points
/// @throws ContractError if there are more dimensions
Points sobol_sequence(std::size_t count, std::size_t dimension);

/// Trajectories of Morris (1991): from a random point of a grid each coordinate is moved once, in random
/// order, by levels / (2 (levels - 1)). Points of a trajectory follow each other, dimension + 1 of them.
///
/// @param trajectories number of trajectories
/// @param dimension number of coordinates
/// @param levels number of values of each coordinate of the grid, even, >= 2
/// @param seed seed of the random numbers
/// @returns the points
/// @throws ContractError if the number of levels is odd or less than 2
Points morris_trajectories(std::size_t trajectories, std::size_t dimension, std::size_t levels,
                           std::uint64_t seed);

/// The points of Saltelli et al. (2010) for sensitivity indices: for each row of a Sobol sequence in twice
/// the dimension, whose halves are a and b, the points a, b, and for each coordinate j the point a with
/// coordinate j of b: dimension + 2 points that follow each other.
///
/// @param samples number of rows
/// @param dimension number of coordinates
/// @returns the points
/// @throws ContractError if twice the dimension is more than max_sobol_dimensions
Points saltelli_points(std::size_t samples, std::size_t dimension);

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
