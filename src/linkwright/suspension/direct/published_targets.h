// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "linkwright/suspension/direct/synthesis.h"

/// Example 5 of Poznanovic 2016 (section 6.6), direct synthesis of a five-link front suspension, as printed:
/// facts to compare with.
namespace linkwright::suspension {

/// The body points of links 3, 4 and 5 are to be found; the rods' lengths are given. Targets are quartic
/// polynomials of travel and rack (79) at fifteen inputs, objectives in the order of their priority toe,
/// camber and relative track, with their tolerances (75). The points are at the known optimum.
DirectTask published_direct_task();

/// Boxes of 150 mm for the nine coordinates, placed at random so that they hold the optimum.
void place_published_boxes(DirectTask& task, std::uint64_t seed);

/// Medians of the objectives over the source's runs, toe, camber, track (Tab. 6-19).
inline constexpr std::array published_medians{0.9183, 0.9176, 0.3744};
/// The smallest largest deviation there is (computed; both toe and camber have it).
inline constexpr double min_largest_deviation = 0.9177826;

/// Deviations of figure 6-13, travel -0.1 to 0.1 m by 0.025: deg, deg, and relative.
inline constexpr std::array<std::array<double, 9>, 3> published_target_deviations{
    {{0.047, 0.022, -0.016, -0.013, 0.017, 0.044, 0.046, 0.014, -0.046},
     {-0.045, -0.021, -0.018, -0.02, -0.021, -0.02, -0.014, 0.005, 0.045},
     {8.7e-5, -0.00016, 0.0002, -0.00012, 0, 8.3e-5, 6.5e-5, -0.00012, -0.00052}}};

}  // namespace linkwright::suspension
