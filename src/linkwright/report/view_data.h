// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/value.h"
#include "linkwright/report/html.h"

namespace linkwright::report {

/// The data that the viewer draws and result.json does not hold: title, facts, scenes (coordinates rounded to
/// nine digits), plots, comparisons, text of the study.
Value view_data(const ReportInput& input);

}  // namespace linkwright::report
