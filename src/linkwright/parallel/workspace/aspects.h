// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "linkwright/parallel/workspace/workspace.h"

/// Aspects of a workspace, its singularity-free components: passing at both ends of a path says nothing of
/// what lies between.
namespace linkwright::parallel {

/// The rule that makes nodes neighbours: along an axis, or also across faces and corners of a cell.
enum class Neighbours { along_axes, diagonal_too };
constexpr std::array<EnumName<Neighbours>, 2> names(Neighbours) {
  return {{{Neighbours::along_axes, "along_axes", "6 in space, 4 in the plane"},
           {Neighbours::diagonal_too, "diagonal_too", "26 in space, 8 in the plane"}}};
}

/// Aspects: sets of nodes joined by regular edges.
struct WorkspaceAspects {
  Status status = Status::done;      ///< cancelled or deadline: the rest is not to be used
  std::vector<std::int32_t> aspect;  ///< number of each node's aspect; -1 outside the set
  std::vector<std::size_t> size;     ///< nodes of each aspect; numbered in the order of their first nodes
  int home = -1;                     ///< aspect of the node nearest to home; -1: that one is not in the set
  std::size_t home_node = 0;
  std::size_t edges = 0;  ///< between neighbours of the set
  /// Edges that are singular between their ends, or so nearly that nothing else is shown.
  std::size_t closed = 0;

  /// Nodes that can be reached from home, and all of the set.
  std::size_t reachable() const { return home < 0 ? 0 : size[static_cast<std::size_t>(home)]; }
  std::size_t all() const;
};

/// `set`: nodes of the map that count, for example passing(map); all must be within reach of the legs.
///
/// An edge is open when nothing on all of it is singular: the legs reach, no arm and rod are aligned, the
/// rods hold the platform, and the parallelograms of a DELTA keep it from turning. The clear radii of both
/// ends (regular_ball.h) show it nearly always, else first_trouble (path_trouble.h). (The bounds are exact;
/// they are evaluated in rounded numbers.)
///
/// Limits of drives, joints and indices are those of the nodes alone: between two nodes that pass they may be
/// exceeded by what a step of the grid makes of them.
struct WorkspaceAspectsTask {
  PoseConditions conditions;  ///< conditions of the map
  Mat3 rotation{};            ///< rotation of the map
  Vec3 home;                  ///< m
  Neighbours neighbours = Neighbours::along_axes;
};
WorkspaceAspects workspace_aspects(const WorkspaceMap& map, const NodeSet& set,
                                   const WorkspaceAspectsTask& task, const RunContext& context);

/// Nodes of one aspect.
NodeSet nodes_of(const WorkspaceAspects& aspects, int aspect);

}  // namespace linkwright::parallel
