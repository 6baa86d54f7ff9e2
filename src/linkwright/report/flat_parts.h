// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "linkwright/report/drawing.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/scene.h"

// Links of a planar scene as flat parts with holes, in layers in which they pass each other.
namespace linkwright::report {

/// A part: the convex outline of its corners, wider by a radius all round, as thick as its layer.
struct FlatPart {
  std::string name;            ///< "crank"
  std::vector<Place> corners;  ///< m, convex, counter-clockwise, at the drawn pose; one: a disc
  double radius = 0;           ///< m, of the rounded corners
  std::vector<Place> holes;    ///< m, centres of the pins
  int layer = 0;               ///< 0 = the lowest, with the ground
};

/// A pin through the parts that it joins.
struct FlatPin {
  std::string name;         ///< "A"
  Place at;                 ///< m, at the drawn pose
  int first = 0, last = 0;  ///< layers of the lowest and the highest part that it joins
};

/// Flat parts of a mechanism, from below upwards.
struct FlatMechanism {
  std::vector<FlatPart> parts;
  std::vector<FlatPin> pins;
  double thickness = 0;   ///< m, of each layer
  double pin_radius = 0;  ///< m
  std::vector<std::string>
      crossed;  ///< pins that pass through a part which they do not join: "A through rocker"
};

/// The bars and plates of a planar scene as flat parts, and its fixed pivots as one. Parts that share a pin,
/// or that would touch at some sample, lie in different layers: each in the lowest one in which it touches
/// nothing and no pin passes through it, or above all others where there is none.
/// @param scene planar scene; springs, dampers, guides, wheels, and contours of cams and blocks,
///   whose corners have no names, are no parts
/// @param sample pose at which the parts are drawn
/// @param sizes widths and thickness; what is not given is chosen by the size of the scene
/// @returns the parts; none where the scene is spatial or has no body with two points
FlatMechanism flat_parts(const study::Scene& scene, std::size_t sample, const study::PartSizes& sizes);

}  // namespace linkwright::report
