// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "linkwright/planar/drawing/detail/lines.h"

namespace linkwright::planar::drawing {

/// The lines that an SVG file draws, as `svg_file_line` reads them. Throws Fault.
/// @param has_unit receives false where the page has no such size
std::vector<Line> svg_file_lines(std::string_view text, bool& has_unit);

/// The one line that an SVG file draws, in mm with the y axis upwards: with the transforms of its groups and
/// the scale of the page. Only sizes in mm, cm, in and the like scale it; numbers alone are mm. Throws Fault.
/// @param has_unit receives false where the page has no such size
Line svg_file_line(std::string_view text, bool& has_unit);

}  // namespace linkwright::planar::drawing
