// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/core/status.h"
#include "linkwright/planar/linkage/linkage.h"

// Six-bars whose output rests while the crank turns on: a point C of the coupler of a four-bar follows nearly
// a circle for a while, and a link as long as its radius joins C to the output rocker (Stephenson III).
namespace linkwright::planar {

/// Lengths in grounds: crank pivot at 0, rocker pivot at 1, the coupler pin to the left of the line from the
/// crank pin to the rocker pivot.
struct DwellLinkage {
  double crank = 0, coupler = 0, rocker = 0;
  double point_u = 0, point_v = 0;  ///< C from the crank pin, along the coupler and along its left normal
  double pivot_x = 0, pivot_y = 0;  ///< E0, pivot of the output
  double link = 0, output = 0;      ///< C to E, E0 to E
  double side = 1;                  ///< +1 = E to the left of the line from C to E0
  double middle = 0;                ///< crank angle (rad) in the middle of the dwell
};
/// The linkage with bodies crank, coupler, rocker, link and output, driven at O; `ground` in m.
Linkage linkage_of(const DwellLinkage& linkage, double ground);

struct DwellProblem {
  double dwell = 0;         ///< rad, of the crank while the output rests, in (0, 2 pi)
  double swing = 0;         ///< rad, of the output over the turn, at least; in (0, pi)
  double transmission = 0;  ///< rad, least angle of four-bar and dyad, in [0, pi/2)
  double shortest = 0.2;    ///< link, in grounds, in (0, 0.95)
  double longest = 2.5;     ///< link, and coordinate of coupler point and output pivot, in grounds; > 1
  int starts = 20000;       ///< four-bars with a coupler point that are tried
};

/// Output angle (rad) at a crank angle and cosine of the angle between link and output; nothing where it does
/// not assemble.
struct DwellOutput {
  double angle = 0, cosine = 0;
};
std::optional<DwellOutput> output_of(const DwellLinkage& linkage, double crank_angle);

struct DwellDesign {
  DwellLinkage linkage;
  double deviation = 0;       ///< rad, largest departure of the output from its middle within the dwell
  double swing = 0;           ///< rad, over the turn
  double four_bar_angle = 0;  ///< rad, least transmission angle between coupler and rocker
  double dyad_angle = 0;      ///< rad, between link and output
};
/// Nothing unless it assembles over a full turn.
std::optional<DwellDesign> assess_dwell(const DwellProblem& problem, const DwellLinkage& linkage,
                                        int samples = 1440);

struct DwellAnswer {
  Status status = Status::done;      ///< infeasible: no design meets the conditions
  std::vector<DwellDesign> designs;  ///< designs that meet them, smallest deviation first, each once
  int starts = 0, refined = 0;
};
/// Random four-bars, the circle through each stretch of their coupler curves, and the pivots of the output
/// about its centre; the best of them are refined on the motion of the output itself.
DwellAnswer find_dwells(const DwellProblem& problem, RunContext& context);

}  // namespace linkwright::planar
