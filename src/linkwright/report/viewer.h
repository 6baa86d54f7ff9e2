// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace linkwright::report {

/// Style sheet of every report.
std::string_view report_css();
/// Script and style sheet of the viewer; both empty when it was not built (LINKWRIGHT_REPORT_VIEWER=OFF).
std::string_view viewer_js();
std::string_view viewer_css();
/// Script that unpacks the data of a report and starts the viewer; empty when the viewer is.
std::string_view boot_js();
/// Script that draws scenes in space, for reports that have one; empty when the viewer is.
std::string_view space_js();

}  // namespace linkwright::report
