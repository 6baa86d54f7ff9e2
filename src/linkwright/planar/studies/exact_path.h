#pragma once

#include "linkwright/planar/studies/path.h"

// fit = "exact" of the path synthesis study: all four-bars through nine points, through seven with a given
// pivot, through five with both, or through three to five at given rotations of the crank.
namespace linkwright::planar {

/// Checks what a study with fit = "exact" asks for, and sets its problem up; the rest of the study has been
/// read. Problems go to the reader.
void read_exact_path(study::ObjectReader& document, study::ObjectReader& target, PathStudy& study);

/// Runs it and reports.
study::Result run_exact_path_study(const PathStudy& study, const study::Common& common, RunContext& context);

}  // namespace linkwright::planar
