// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// @file
/// Sample points for the parameters of a study: points of the unit cube [0, 1]^n, which the study maps to the
/// ranges of its parameters.
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

}  // namespace linkwright::parameter_study
