// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/study/kind.h"
#include "linkwright/study/result.h"

// Results in the units of people.
namespace linkwright::study {

/// The result with its numbers in these units: headline, facts and remarks, tables with their diagrams,
/// solutions, changes, troubles, statistics and titles of scenes. The drawings of scenes stay.
Result in_units(Result result, const DisplayUnits& units);

/// In which units people are shown a study: those that it lists for its files, else those of its own keys.
/// Micrometres are then replaced by millimetres: they are for tolerances, not for whole mechanisms.
DisplayUnits shown_units(const OutputUnits& choice, const DisplayUnits& study);

}  // namespace linkwright::study
