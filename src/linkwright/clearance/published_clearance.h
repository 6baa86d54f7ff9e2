// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/clearance/four_bar_clearance_motion.h"

/// @file
/// The example of Varedi, Daniali, Dardel and Fathi 2014 (Sharif Journal of Mechanical Engineering 30-3,
/// 2/2). Neither the clearance nor speed, weight, start or target path are printed; the clearance of 1 mm was
/// inferred: with it the second design comes closest to the path of the first one.
namespace linkwright::clearance {

/// The problem of the first stage, see clearance/path_synthesis.h.
struct ClearancePathProblem;  // clearance/path_synthesis.h

/// The problem of the second stage, see clearance/mass_synthesis.h.
struct ClearanceMassProblem;  // clearance/mass_synthesis.h

/// The first design: Table 1, made without clearance, with the masses of Table 2 (mass centres read as
/// metres), no weight. @returns the model
ClearanceFourBar published_design_1();
/// The second design: Table 1, made with clearance, with the masses of Table 3. @returns the model
ClearanceFourBar published_design_2();

/// The clearance with which design 2, its clearance link 10 degrees ahead of the crank, comes closest to the
/// path of design 1 without clearance, at equal crank angles. The 1 mm is inferred from it.
///
/// @returns m
double inferred_clearance();

/// First stage: the path of design 1 without clearance at even steps of its crank (36, from 0), a phase of 10
/// degrees, and bounds of our own.
///
/// @returns the problem
ClearancePathProblem published_path_problem();

/// Second stage: the phase of 10 degrees for design 2 at 10 rad/s without weight, and bounds of our own.
///
/// @returns the problem
ClearanceMassProblem published_mass_problem();

/// A published statement beside what is computed here.
struct ClearanceComparison {
  std::string quantity;   ///< quantity with its unit
  std::string published;  ///< value in the source, in words where it prints no number
  double ours = 0;        ///< value computed here
  std::string verdict;    ///< "reproduced", "corrected" or "not reproduced"
  std::string note;       ///< remark on the difference; may be empty
};
/// Computes all published statements again; takes some hundredths of a second. @returns one entry a statement
std::vector<ClearanceComparison> compare_with_published_clearance();

}  // namespace linkwright::clearance
