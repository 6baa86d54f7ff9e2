// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/chains/graph.h"

namespace linkwright::planar {

using LinkCycle = std::vector<int>;

/// The loops of a chain that is drawn without crossings, each as its links in order, counter-clockwise.
struct ChainEmbedding {
  LinkCycle border;               ///< around the whole drawing
  std::vector<LinkCycle> meshes;  ///< the loops inside that enclose no link
};

/// All cycles of a graph, the longest first.
std::vector<LinkCycle> cycles(const ChainGraph& graph);

/// Draws a graph without cut vertex by adding paths to faces (Demoucron, Malgrange and Pertuiset 1964). The
/// border is the longest cycle that can be one and goes through `link` (-1 = any); nothing if the graph is
/// not planar.
std::optional<ChainEmbedding> embedding(const ChainGraph& graph, int link = -1);

/// True if the links stay connected when any one of them is removed.
bool is_two_connected(const ChainGraph& graph);

}  // namespace linkwright::planar
