// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "linkwright/suspension/corner/suspension.h"
#include "linkwright/suspension/indirect/link_fit_motion.h"

namespace linkwright::suspension {

/// The columns of a Jacobian for the coordinates of a link's points, in the order body points, carrier
/// points, x, y, z of each; -1 = the coordinate is given.
using LinkColumns = std::span<const int>;

/// Rows of `structural_errors`: one a distance and position, three a position for SP, S and each point of R,
/// whose squares add up to the square of one structural error.
std::size_t error_rows(LinkType type, std::size_t positions);

/// Structural errors (m) of a link over a motion: |q - p0| - |p1 - p0| for every distance that is to stay
/// (Poznanovic 2016, eq (55)), q the place of p1; for SP the offset of p0 from the line of the strut as the
/// carrier sees it, of length (56); for S and R q - p.
///
/// `jacobian` is empty or holds their derivatives, column-major, for the coordinates that `columns` names.
/// False when points coincide that must not.
bool structural_errors(const LinkMotion& motion, const CornerLink& link, std::span<double> errors,
                       LinkColumns columns, std::span<double> jacobian);

}  // namespace linkwright::suspension
