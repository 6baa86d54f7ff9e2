// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "linkwright/core/run_context.h"
#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

/// Number of designs of a search under limits that are continued without the limits, the best first.
inline constexpr std::size_t carried_beyond_limits = 2;

/// The transmission angle that is usually asked for (rad, 30 degrees).
inline constexpr double usual_transmission = 0.5235987755982988;

/// The search of `synthesise_path` for free timing: designs of which some may violate constraints, best
/// first, with the history of the search. A problem without the full turn of the crank or the usual
/// transmission angle as limits is searched under each of them and under both as well, by the same seed, and
/// goes on from the best designs of those searches: what is found under such a limit is found without it.
///
/// Starts are random linkages whose curve is laid on a thinned path, and a local search each; the best go on
/// to all points. From the best of those the search hops: it changes the linkage at random, lays it on the
/// path again and keeps what is better (Wales and Doye 1997). In the end the crank angles are assigned anew
/// over all ways to meet the targets in order, and the search goes on from there, until neither helps.
PathSynthesis search_free_timing(const PathProblem& problem, const PathSynthesisOptions& options,
                                 RunContext& context);

/// The last part of it alone: assigns crank angles and searches locally, in turn, until neither improves the
/// design. Never returns a worse one.
PathDesign polish_free_timing(const PathProblem& problem, PathDesign design, std::int64_t& evaluations);

}  // namespace linkwright::planar
