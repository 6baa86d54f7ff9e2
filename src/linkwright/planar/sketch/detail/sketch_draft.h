// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "linkwright/planar/sketch/detail/sketch_points.h"
#include "linkwright/planar/sketch/sketch.h"

// A sketch in the making: bodies by the nodes at which they have points, before pins join them.
namespace linkwright::planar::sketching {

/// A circle of the layer "gear" or "belt".
struct DrawnWheel {
  Place centre;
  double radius = 0;
  std::string layer;
  std::size_t node = 0, body = 0;
};

struct SketchDraft {
  double tolerance = 0;  ///< largest distance of ends that meet, m
  Sketch out;
  Nodes nodes;
  std::vector<std::vector<std::size_t>> members;  ///< bodies that have a point at each node
  std::vector<std::vector<Segment>> edges;        ///< of each body
  std::vector<SketchJoint> welds;
  std::map<std::size_t, std::vector<std::size_t>> slide_owners, welded;  ///< bodies by node
  std::vector<DrawnWheel> wheels, pulleys;
  std::vector<Segment> strands;

  std::size_t add_body(SketchBodyType type, std::vector<Segment> edges_of_body);
  void join(std::size_t body, std::size_t node);
  bool has(std::size_t node, std::size_t body) const;
  /// The ground; made where the drawing has none.
  std::size_t ground();
};

/// Wheels that touch are a pair of gears on the body that has points at both centres. A wheel belongs to the
/// bar or plate at its centre that carries none of its pairs; without one it is a body of its own, or the
/// ground on a layer such as "gear ground".
void add_gears(SketchDraft& d);

/// Lines that touch two circles of the layer "belt" are strands; those that close a ring around circles are a
/// belt, on the body that has points at all centres. Its pulleys belong to bodies as wheels of gears do.
void add_belts(SketchDraft& d);

}  // namespace linkwright::planar::sketching
