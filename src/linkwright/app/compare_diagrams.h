// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/app/compare.h"

namespace linkwright::app {

/// True if the numbers are the same to nine digits of the largest of them.
bool same_values(const std::vector<double>& a, const std::vector<double>& b);

/// Diagrams of several results over each other, and the tables that they draw.
struct ComparedDiagrams {
  std::vector<Table> tables;
  std::vector<Table> differences;  ///< each minus the first, where the inputs are the same
  std::vector<study::Plot> plots;
};

/// One diagram for each column that all of two or more results have; in each the curve of a result has the
/// same place, and so the same colour. Curves of the same inputs are columns side by side, of others rows of
/// each. A bundle over a second input is compared at the value next to zero that all have. Maps stand side by
/// side, with their difference where the places agree; histograms lie over each other. A diagram stays linked
/// to its scene if that is one of `scenes`; diagrams of other scenes are left out.
ComparedDiagrams compare_diagrams(std::span<const Compared> all, std::span<const std::string> scenes);

}  // namespace linkwright::app
