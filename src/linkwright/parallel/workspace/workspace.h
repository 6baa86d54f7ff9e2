// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/parallel/robot/pose_check.h"

/// Workspace of a parallel robot as a grid of places of its platform point at one rotation of the platform.
namespace linkwright::parallel {

/// Nodes low + step i in a box, ends included. A box without extent along an axis has one node there: planar
/// robots and slices of others.
struct WorkspaceGrid {
  Vec3 low, high;   ///< m
  double step = 0;  ///< > 0 (m)
};

/// Nodes along x, y, z. Throws ContractError for a grid without sense or of more than 1e9 nodes.
std::array<std::size_t, 3> nodes_of(const WorkspaceGrid& grid);
/// Share of a node in the measure of a set: step^axes (m3, m2 for two axes, m for one).
double cell_of(const WorkspaceGrid& grid, const std::array<std::size_t, 3>& nodes);

/// The content of a map besides the criteria.
struct WorkspaceTask {
  PoseConditions conditions;
  WorkspaceGrid grid;
  Mat3 rotation{};
  WantedIndices wanted{};
};

struct WorkspaceMap {
  Status status = Status::done;  ///< cancelled or deadline: some nodes are Criterion::open
  WorkspaceGrid grid;
  std::array<std::size_t, 3> nodes{};                       ///< along x, y, z
  int axes = 0;                                             ///< number of axes with more than one node
  double cell = 0;                                          ///< cell_of
  std::vector<Criterion> criterion;                         ///< x changes fastest, then y
  std::array<std::vector<double>, pose_index_count> index;  ///< empty where not wanted

  std::size_t count() const { return criterion.size(); }
  std::size_t number(std::size_t i, std::size_t j, std::size_t k) const {
    return i + nodes[0] * (j + nodes[1] * k);
  }
  Vec3 position(std::size_t node) const;  ///< m
};

/// Looks at every node. The result does not depend on threads. Throws ContractError for conditions with a
/// problem and for a grid without sense or of more than 1e9 nodes.
WorkspaceMap workspace(const WorkspaceTask& task, const RunContext& context);

/// A set of nodes, one number a node of a map: 1 = in it.
using NodeSet = std::vector<std::uint8_t>;

/// Nodes that pass all criteria before `first`; Criterion::open: those that pass all.
NodeSet nodes_before(const WorkspaceMap& map, Criterion first);
inline NodeSet passing(const WorkspaceMap& map) { return nodes_before(map, Criterion::open); }

/// An index over a set of nodes; NaN for an empty set. Nodes where the index is not known do not count.
struct IndexSummary {
  std::size_t count = 0;
  double least = 0, mean = 0, greatest = 0;
  std::size_t least_at = 0, greatest_at = 0;  ///< first such nodes
};
/// Summary of an index over the set; the mean of LCI is the global conditioning index (GCI).
IndexSummary summary(const WorkspaceMap& map, PoseIndex index, const NodeSet& set);

struct WorkspaceTotals {
  std::array<std::size_t, criterion_count> count{};  ///< nodes that stop at each criterion
  std::size_t passing = 0;
  double measure = 0;  ///< measure of the passing nodes: volume (m3), or area (m2)
  std::array<IndexSummary, pose_index_count> index{};  ///< over the passing nodes, of the indices in the map
};
WorkspaceTotals totals(const WorkspaceMap& map);

}  // namespace linkwright::parallel
