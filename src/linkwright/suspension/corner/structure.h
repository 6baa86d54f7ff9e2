// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "linkwright/suspension/corner/position.h"

namespace linkwright::suspension {

/// The links of a wheel suspension by type, as in "SR-3US".
using Structure = std::vector<LinkType>;

struct ParsedStructure {
  Structure structure;
  std::string problem;  ///< empty, or what is wrong with the name and what is allowed
};

/// Reads a name: link types joined by '-', each with a count before it when there are several. "SS" stays SS.
ParsedStructure parse_structure(std::string_view name);

/// The name of a structure: types in the order R, RR, S, RS, SR, SP, US, equal ones counted; SS counts as US.
std::string structure_name(const Structure& structure);
Structure structure_of(const Suspension& suspension);

/// Freedoms of the carrier that a link takes away (table 3-1; US 1, RS, SR and SP 2, S 3, RR 4, R 5), and
/// numbers that place it in space (table 5-1).
int constraints(LinkType type);
int design_parameters(LinkType type);

/// Freedoms that the count leaves the carrier: 6 less the constraints of links and of `couplers` (one each).
/// One is needed; steering is a second input that moves body points and takes none.
int mobility(const Structure& structure, int couplers = 0);

/// The twelve basic wheel suspensions (chapter 3; its text says thirteen, its table has twelve): all sets of
/// links with one freedom, at most one strut, and no ball joint beside a link that would be left free to turn
/// about the line through both (S with RS, SR or SP). Fewest links first.
std::vector<Structure> basic_structures();

/// The motion that the equations hold least at a place: smallest singular value of their Jacobian, turns
/// taken as lengths at the tyre's radius, and its direction (m, rad). Near 0 at a fold, and where links lose
/// rank.
struct WeakMotion {
  double singular_value = 0;
  Vec3 shift, turn;
};
WeakMotion weakest_motion(const CornerPlan& plan, const CornerPlace& place, double rack, Driver driver);

/// Checks that the suspension moves as a wheel suspension must: everything of `check`, then the count of
/// freedoms, then the rank of the constraints with the height of the wheel centre held, at the reference
/// position. A rank loss is an error that names what is left free; a suspension within `poor_rank` of one (in
/// metres a radian, turns taken at the tyre's radius) gets a warning. With prescribed lengths the reference
/// is no position, and the rank there is a suspension only.
Diagnostics check_structure(const Suspension& suspension);

inline constexpr double poor_rank = 0.01;  ///< singular value, see weakest_motion

}  // namespace linkwright::suspension
