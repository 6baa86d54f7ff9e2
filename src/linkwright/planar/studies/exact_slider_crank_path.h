#pragma once

#include "linkwright/planar/studies/slider_crank_path.h"

// fit = "exact" of the path synthesis of slider-cranks: all of them through eight points.
namespace linkwright::planar {

/// Checks what a study with fit = "exact" asks for, and sets its problem up; the rest of the study has been
/// read. Problems go to the reader.
void read_exact_slider_path(study::ObjectReader& document, study::ObjectReader& target,
                            SliderPathStudy& study);

/// Runs it and reports.
study::Result run_exact_slider_path_study(const SliderPathStudy& study, const study::Common& common,
                                          RunContext& context);

}  // namespace linkwright::planar
