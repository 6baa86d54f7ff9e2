// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "linkwright/planar/drawing/detail/lines.h"

namespace linkwright::planar::drawing {

/// The lines of an ASCII DXF drawing, in mm; a drawing without $INSUNITS is in mm. Throws Fault.
/// @param has_unit receives false where the drawing names no unit
std::vector<Line> dxf_file_lines(std::string_view text, bool& has_unit);

/// The one line of an ASCII DXF drawing, in mm; a drawing without $INSUNITS is in mm. Throws Fault.
/// @param has_unit receives false where the drawing names no unit
Line dxf_file_line(std::string_view text, bool& has_unit);

}  // namespace linkwright::planar::drawing
