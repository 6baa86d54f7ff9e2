// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include "linkwright/planar/drawing/drawing.h"
#include "linkwright/planar/linkage/linkage.h"

// A linkage from the lines and circles of a drawing: bars and plates are bodies, ends that meet are pins.
namespace linkwright::planar {

/// The kinds of bodies that a sketch is read as.
enum class SketchBodyType {
  ground,  ///< everything that is drawn on the layer "ground", or what was assumed to be fixed
  bar,     ///< a line
  plate,   ///< a closed polyline, or three lines that make a triangle on a layer of their own
  block    ///< what slides on a line of the layer "slide"
};

/// A point of a sketch at which something was drawn.
struct SketchPoint {
  std::string name;         ///< "A", from left to right
  std::complex<double> at;  ///< m, y upwards
};

/// A body of a sketch.
struct SketchBody {
  SketchBodyType type = SketchBodyType::bar;
  std::string name;                 ///< by its points: "AB"; "ground"
  std::vector<std::size_t> points;  ///< indices of its points, in alphabetical order
};

/// A joint of two bodies of a sketch at a point of both: revolute, prismatic or fixed.
struct SketchJoint {
  JointType type = JointType::revolute;
  std::string name;                   ///< after its point: "A"
  std::size_t first = 0, second = 0;  ///< indices of the bodies
  std::size_t point = 0;              ///< index of the point
  double direction = 0;               ///< prismatic: of the line (rad)
};

/// Something that the drawing leaves open, with what was assumed.
struct SketchQuestion {
  std::string text;     ///< "no circle lies on a layer called drive: which pin is driven?"
  std::string assumed;  ///< "A, whose bar is the shortest at the ground"
};

/// A drawing as a linkage.
struct Sketch {
  std::vector<SketchPoint> points;
  std::vector<SketchBody> bodies;
  std::vector<SketchJoint> joints;
  std::vector<std::size_t> driven;        ///< indices of points on the layer "drive"
  std::vector<std::size_t> traced;        ///< indices of points on the layer "trace"
  std::vector<SketchQuestion> questions;  ///< in the order in which they arose
  std::vector<std::string> left_out;      ///< what was drawn but not understood, a sentence each
};

/// The number of joints of a type.
std::size_t count(const Sketch& sketch, JointType type);

/// The mobility by Gruebler's count: 3 (bodies - 1) - 2 (pins + slides) - 3 welds.
int mobility(const Sketch& sketch);

/// Ends, corners and circles of links in the largest drawing that is read as a linkage.
inline constexpr std::size_t most_sketch_places = 2000;

/// Reads the shapes of a drawing as a linkage. The layers (or groups of SVG) "ground", "slide", "drive",
/// "trace" and "construction" say what their shapes are; shapes of other layers are links. Ends within the
/// tolerance are one point, and those within ten times the tolerance, about which there is a question. The
/// order of the shapes does not matter.
/// @param shapes shapes of the drawing
/// @param tolerance largest distance of ends that meet (m)
/// @returns the linkage as it is drawn; without links, or with more than `most_sketch_places`, one without
///   bodies
/// @throws ContractError if the tolerance is not positive
Sketch sketched_linkage(const std::vector<DrawnShape>& shapes, double tolerance);

/// Answers what a study needs to know and the drawing does not say: without a ground the two lowest free
/// ends, else the two lowest pins are fixed; without a drive the shortest bar at the ground is driven. Each
/// is a question with its assumption.
/// @param sketch sketch with at least one body
/// @returns the joint that is driven, the last index + 1 where there is none
std::size_t complete(Sketch& sketch);

/// The study of a linkage, in the words of a file: its bodies and joints as they are drawn, the drive over
/// the range in which it assembles, questions as comments.
/// @param sketch completed sketch
/// @param driven joint that is driven
/// @param title title of the study
/// @returns a study in TOML
std::string sketch_study(const Sketch& sketch, std::size_t driven, const std::string& title);

}  // namespace linkwright::planar
