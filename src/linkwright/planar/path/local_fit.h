// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace linkwright::planar {

/// Options of a local search in all unknowns of a path problem.
struct PathFitOptions {
  int iterations = 60;      ///< Levenberg-Marquardt steps tried in one pass
  int passes = 1;           ///< updates of the multipliers; 1 = constraints as soft penalties only
  double decrease = 1e-12;  ///< a pass ends when a step lowers the merit by less than this share
  double penalty = 10;      ///< weight of squared constraint violations (dimensionless) in the first pass
};

/// The result of a local fit.
template <class Linkage>
struct PathFitOf {
  Linkage linkage;
  std::vector<double> angles;  ///< crank angle at each point
  double error = 0;            ///< sum of squared distances (m2); infinite when the start does not assemble
  double violation = 0;        ///< largest constraint violation, dimensionless
  std::int64_t evaluations = 0;
};

}  // namespace linkwright::planar
