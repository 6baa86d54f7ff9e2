// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/sentence.h"
#include "linkwright/planar/path/mechanism.h"

namespace linkwright::planar {

/// The reason why a linkage does not trace the points in one motion.
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
  Sentence text;  ///< points are numbered from 1
};

/// The motion of a design along a path.
struct PathMotion {
  const PathTask& task;
  const std::vector<double>& angles;
  double sense;
  std::vector<TracedPoint> points;  ///< at the angles
  bool turns_fully;
  std::function<std::optional<CrankInterval>(double angle)> reach;
  MechanismWords words;
};
std::vector<Defect> defects(const PathMotion& motion);

/// "point 3 (crank angle 40 deg)"
Sentence point_text(const std::vector<double>& angles, std::size_t k);

/// Defects of a design along the path, by closed-form criteria: whether it assembles at the points and
/// between them, whether its branches meet at one, and the cyclic sum of the crank angle steps. Empty = the
/// mechanism traces the points in one motion.
template <class Problem>
requires PathMechanism<MechanismOf<Problem>> std::vector<Defect> defects(
    const Problem& problem, const typename MechanismOf<Problem>::Design& design) {
  using M = MechanismOf<Problem>;
  std::vector<TracedPoint> points;
  for (const double angle : design.angles) points.push_back(M::trace(design.linkage, angle));
  return defects(PathMotion{problem, design.angles, design.sense, std::move(points),
                            M::turn(design.linkage).full(),
                            [&](double angle) { return M::reach(design.linkage, angle); }, M::words});
}

}  // namespace linkwright::planar
