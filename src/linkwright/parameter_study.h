// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @defgroup parameter_study Parameter studies
/// Samples of parameters, and what they say of a quantity that depends on them.
///
/// @code
/// using namespace linkwright::parameter_study;
/// // A quantity of two parameters, each between 0 and 1.
/// const Points points = saltelli_points(1024, 2);
/// std::vector<double> values;
/// for (std::size_t i = 0; i < points.count(); ++i) values.push_back(points.at(i, 0) + 3 * points.at(i, 1));
/// const SobolDecomposition found = sobol_indices(values, 2, 200, 1);
/// // found.parameters[1].first is about 0.9
/// @endcode

/// @namespace linkwright::parameter_study
/// Samples of parameters and the influence of each on a quantity.

#include "linkwright/parameter_study/sensitivity.h"
