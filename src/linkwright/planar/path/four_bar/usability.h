// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/planar/path/mechanism.h"

namespace linkwright::planar {

/// Least transmission angle (rad, 0 to pi/2) of a design: over what the path uses of the crank's motion - all
/// of it for a closed path, from the first point to the last for an open one - and over all of the motion, up
/// to the dead points of a crank that does not rotate fully.
struct PathTransmission {
  double used = 0, whole = 0;
};
PathTransmission path_transmission(const PathProblem& problem, const PathDesign& design);

/// The reason why a linkage that meets its problem is hard to build or to drive.
enum class DrawbackKind {
  transmission,  ///< the transmission angle falls below min_usable_transmission on the path
  crowded,       ///< two neighbouring points lie within min_usable_step of crank rotation (free timing)
  bound,         ///< a link is at a bound that follows from the size of the path, not from the study
  locks,         ///< the crank does not rotate fully: at both ends of its motion the linkage locks
};
struct Weakness {
  DrawbackKind kind;
  Sentence text;  ///< part of a sentence
};

inline constexpr double min_usable_transmission = 0.08726646259971647;  ///< rad, 5 degrees

/// Least crank rotation between two neighbouring points (rad): one degree, or a tenth of an even share of the
/// turn when there are more than 36 points.
double min_usable_step(const PathProblem& problem);

/// Drawbacks of a design; empty = usable.
std::vector<Weakness> weaknesses(const PathProblem& problem, const PathDesign& design);

/// The same problem with limits that keep the drawbacks away: what it allows, the problem allows.
PathProblem usable_problem(PathProblem problem);

/// Leaves the first `most` of ranked designs. Where none of those is usable and a later one is, it takes the
/// last place, unless there is only one.
void keep_first(const PathProblem& problem, std::vector<PathDesign>& ranked, std::size_t most);

}  // namespace linkwright::planar
