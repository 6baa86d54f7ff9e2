// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/core/table.h"
#include "linkwright/study/result.h"

namespace linkwright::report {

/// A diagram of style `map` as a complete SVG 1.1 document, in the units of the table: places as cells
/// coloured by their class of value (colour_scale.h), one map for each group, up to three a row, all with the
/// same axes and the one bar of colours below. Cells are as large as the smallest distance of two places
/// along x and y; of several values at one place the last is drawn. Places without a value are pale. Of more
/// than 12 groups 12 are drawn, the first and the last among them. With `logarithmic_y` the colours follow
/// the logarithm of the value, and values that are not positive count as missing.
std::string map_svg(const study::Plot& plot, const Table& table);

}  // namespace linkwright::report
