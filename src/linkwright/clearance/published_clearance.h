// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/clearance/four_bar_clearance_motion.h"

// The example of Varedi, Daniali, Dardel and Fathi 2014 (Sharif Journal of Mechanical Engineering 30-3, 2/2).
// Neither the clearance nor speed, weight, start or target path are printed; the clearance of 1 mm was
// inferred: with it the second design comes closest to the path of the first one.
namespace linkwright::clearance {

struct ClearancePathProblem;  // clearance/path_synthesis.h
struct ClearanceMassProblem;  // clearance/mass_synthesis.h

/// Table 1, made without clearance, with the masses of Table 2 (mass centres read as metres), no weight.
ClearanceFourBar published_design_1();
/// Table 1, made with clearance, with the masses of Table 3.
ClearanceFourBar published_design_2();

/// The clearance (m) with which design 2, its clearance link 10 degrees ahead of the crank, comes closest to
/// the path of design 1 without clearance, at equal crank angles: what the 1 mm is inferred from.
double inferred_clearance();

/// First stage: the path of design 1 without clearance at even steps of its crank (36, from 0), a phase of 10
/// degrees, and bounds of our own.
ClearancePathProblem published_path_problem();
/// Second stage: the phase of 10 degrees for design 2 at 10 rad/s without weight, and bounds of our own.
ClearanceMassProblem published_mass_problem();

/// A published statement beside what is computed here.
struct ClearanceComparison {
  std::string quantity;   ///< quantity with its unit
  std::string published;  ///< value in the source, in words where it prints no number
  double ours = 0;
  std::string verdict;  ///< "reproduced", "corrected" or "not reproduced"
  std::string note;
};
/// Recomputes all of them; takes some hundredths of a second.
std::vector<ClearanceComparison> compare_with_published_clearance();

}  // namespace linkwright::clearance
