// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "linkwright/parallel/workspace/proven_body.h"
#include "linkwright/parallel/workspace/workspace.h"

/// Largest bodies of simple shape within what passes: what a user can be promised of a workspace.
namespace linkwright::parallel {

struct InscribedTask {
  PoseConditions conditions;  ///< conditions of the map
  Mat3 rotation{};            ///< rotation of the map
  InscribedShape shape = InscribedShape::cylinder;
  std::optional<Vec3> axis{};  ///< the cylinder's axis goes through this point; none = anywhere
  /// Height, and ratio of height and diameter, of a cylinder; at most one of both is given, 0 = free. With a
  /// height (m) the diameter grows; with a ratio of height and diameter, or neither, the volume.
  double height = 0, ratio = 0;
};

struct Inscribed {
  Status status = Status::done;  ///< infeasible: nothing fits; cancelled or deadline: the best so far
  Vec3 centre;                   ///< m
  Vec3 half;                     ///< half the extent along each axis (m); z = 0 in the plane
  double measure = 0;            ///< volume (m3) or area (m2)
  double on_grid = 0;            ///< the same of the body of nodes where the search began
  /// True if all of the body is proven free of singularities, which is done when the conditions ask for an
  /// assembly (for a DELTA also of its platform): in the assembly of the middle, with the constraint index
  /// that is asked for (less 5e-4): see proven_body.h. A body that could not be proven has been made smaller
  /// until it could.
  bool proven = false;
};

/// The largest body of the shape on the grid, whose nodes are all in `set` (for example passing(map)), grown
/// from there while points on its surface meet the conditions: a search by steps in all directions that are
/// halved down to 1e-4 of the grid's step. The points lie 1.25 deg and 1/32 of the extents apart at the end,
/// in the plane sixteen times closer than 5 deg and 1/32: between them the boundary may be crossed by some
/// 1e-4 of the size. The inside is held by the grid: a hole finer than a step of it is not seen, but for
/// singularities, of which the body is proven to be free. The search
/// is local: the best of the grid decides where it goes.
///
/// The map has nodes along two axes, x and y, or along three. Throws ContractError for tasks without sense.
Inscribed inscribed(const WorkspaceMap& map, const NodeSet& set, const InscribedTask& task,
                    const RunContext& context);

}  // namespace linkwright::parallel
