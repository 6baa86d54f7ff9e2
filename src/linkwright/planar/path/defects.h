#pragma once

#include <array>
#include <string>
#include <vector>

#include "linkwright/planar/path/four_bar/problem.h"

namespace linkwright::planar {

/// What keeps a linkage from tracing the points in one motion.
enum class DefectKind {
  assembly,  ///< it does not assemble at a point
  branch,    ///< it passes or touches a toggle at a point: the branch is not determined there
  circuit,   ///< between two points the crank would have to cross angles at which it does not assemble
  order,     ///< the points are not met in their order within one turn
};
constexpr std::array<EnumName<DefectKind>, 4> names(DefectKind) {
  return {{{DefectKind::assembly, "assembly"},
           {DefectKind::branch, "branch"},
           {DefectKind::circuit, "circuit"},
           {DefectKind::order, "order"}}};
}

struct Defect {
  DefectKind kind;
  std::string text;  ///< with point numbers (from 1) and angles in degrees
};

/// Defects of a design along the path, by closed-form criteria: the sign of L3 L4 sin(theta4 - theta3) at the
/// points, the input limits between them, and the cyclic sum of the crank angle steps. Empty = the linkage
/// traces the points in one motion.
std::vector<Defect> defects(const PathProblem& problem, const PathDesign& design);

}  // namespace linkwright::planar
