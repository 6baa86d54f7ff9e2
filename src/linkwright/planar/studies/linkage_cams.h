// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/planar/studies/linkage.h"

// What a study of a linkage tells of its cams.
namespace linkwright::planar {

/// Adds for each cam the table of its contour, facts of its pressure angle, radii, undercut and lift-off, and
/// warnings. The first table of the result has the columns of the study.
void add_cams(const LinkageStudy& study, study::Result& result);

}  // namespace linkwright::planar
