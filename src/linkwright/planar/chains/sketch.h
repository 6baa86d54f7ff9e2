// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/math/vector2.h"
#include "linkwright/planar/chains/graph.h"

namespace linkwright::planar {

/// A drawing of a chain: bars for binary links, polygons for the others. Lengths are in the usual length of a
/// bar; the ground, or the link with most joints on the border, lies at the bottom.
struct ChainSketch {
  std::vector<math::Vec2> joints;       ///< a place for each of joints_of()
  std::vector<std::vector<int>> links;  ///< joints of each link, in their order around it
  int crossings = 0;                    ///< sides of different links that cross; 0 of planar graphs
};

/// Places joints by the means of their neighbours (Tutte 1963) within a convex border, on the graph whose
/// vertices are the joints and whose sides are those of the links, so that no links cross; small steps
/// that keep it so then bring bars to one length and polygons to regular ones.
ChainSketch sketch(const ChainGraph& graph, std::optional<int> ground = {});

/// Number of pairs of sides of different links that cross.
int crossings(const ChainSketch& drawn);

}  // namespace linkwright::planar
