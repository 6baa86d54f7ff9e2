// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/core/table.h"
#include "linkwright/study/result.h"

namespace linkwright::report {

/// A diagram of the table as a complete SVG 1.1 document (UTF-8, no scripts, nothing loaded), in the units of
/// the table. Values that are missing interrupt lines; columns that the table does not have are left out, and
/// a diagram without any value says so. Polar diagrams have equal axes and mark the origin. A group column
/// gives one curve for each of its values; bands lie behind the curves (of groups: where the first that has
/// values has them), and so do the curves of `baseline`, if there is one. Maps are drawn by map_svg().
std::string plot_svg(const study::Plot& plot, const Table& table, const Table* baseline = nullptr);

}  // namespace linkwright::report
