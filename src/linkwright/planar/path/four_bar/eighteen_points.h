// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

/// A design as a publication prints it, for the path it was made for.
struct PublishedPathDesign {
  std::string label;           ///< source, "Boskovic 2018"
  FourBar linkage;             ///< the four-bar as printed, or corrected
  double start_angle = 0;      ///< rad
  double published_error = 0;  ///< sum of squared distances (m2) as printed
  std::string verdict;         ///< "reproduced", "corrected" or "not reproduced"
  std::string note;            ///< reason for the verdict
};

/// The closed path of 18 points with 20 degree crank steps: Boskovic 2018, Eqs. (4.28)-(4.30), bounds
/// included. The source prints lengths without unit; they are read as metres.
///
/// @returns the problem
PathProblem eighteen_points();

/// The six designs of Boskovic 2018, Table 4.1, branch open, sense +1, and a seventh entry: the design of
/// Cabrera 2007 with its shifted columns corrected. Verdicts from re-evaluation.
///
/// @returns the designs with the errors as printed
std::vector<PublishedPathDesign> eighteen_point_designs();

}  // namespace linkwright::planar
