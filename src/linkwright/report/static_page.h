// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/report/html.h"

namespace linkwright::report {

/// The report as plain HTML sections with drawings, for print and for browsers without scripts. Long tables
/// are thinned and say so.
std::string static_page(const ReportInput& input);

}  // namespace linkwright::report
