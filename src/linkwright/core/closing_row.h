// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/table.h"

namespace linkwright {

/// True if the last row of a table repeats the first one: the sweep of a period with both its ends (0 and 360
/// deg), or the time of one. Means and root mean squares over the period count one of the two.
///
/// The first column is what the rows are over: whole turns when it is an angle ("..._rad"), any span of time
/// ("..._s"); every other column repeats itself within 1e-9 of the largest value of its unit, angles but for
/// whole turns.
/// Rows over anything else, fewer than three, and rows without an answer do not close.
bool has_closing_row(const Table& table);

}  // namespace linkwright
