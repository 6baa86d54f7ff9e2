// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/planar/drawing/drawing.h"
#include "linkwright/planar/linkage/linkage.h"

// A linkage from the lines and circles of a drawing, where bars and plates are bodies and ends that meet are
// pins, or from a file of the program Linkage.
namespace linkwright::planar {

/// The kinds of bodies that a sketch is read as.
enum class SketchBodyType {
  ground,  ///< everything that is drawn on the layer "ground", or what was assumed to be fixed
  bar,     ///< a line
  plate,   ///< a closed polyline, or three lines that make a triangle on a layer of their own
  block,   ///< what slides on a line of the layer "slide"
  wheel    ///< a circle of the layer "gear" that no bar or plate carries
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

/// A pair of gears of a sketch.
struct SketchGear {
  std::string name;                     ///< "gear AB", by the centres of its wheels
  std::array<std::size_t, 2> bodies{};  ///< indices of the wheels
  std::array<std::size_t, 2> points{};  ///< indices of their centres
  std::array<double, 2> radii{};        ///< of the pitch circles (m); 0: the ratio alone is known
  double ratio = 0;  ///< rotation of the second wheel over that of the first, seen from what carries both
};

/// A pulley of a belt.
struct SketchPulley {
  std::size_t body = 0;     ///< index of the body that turns with it
  std::size_t point = 0;    ///< index of its centre
  double radius = 0;        ///< m
  bool is_outside = false;  ///< the back of the belt runs over it
};

/// A closed belt of a sketch, by its pulleys in the order in which it runs.
struct SketchBelt {
  std::string name;  ///< "belt AB", by the centres
  std::vector<SketchPulley> pulleys;
};

/// A joint that a drive moves.
struct SketchDrive {
  std::size_t joint = 0;  ///< its index
  double speed = 0;       ///< rad/s or m/s; 0: not known
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
  std::vector<SketchGear> gears;
  std::vector<SketchBelt> belts;
  std::vector<SketchDrive> drives;
  std::vector<std::size_t> driven;        ///< indices of points on the layer "drive"
  std::vector<std::size_t> traced;        ///< indices of points on the layer "trace"
  std::vector<SketchQuestion> questions;  ///< in the order in which they arose
  std::vector<std::string> left_out;      ///< what was drawn but not understood, a sentence each
};

/// What an end on the middle of another line is, where no circle is drawn.
enum class SketchEnd {
  weld,    ///< it is welded to that line
  pin,     ///< it turns about that place
  nothing  ///< it only lies over it
};
constexpr std::array<EnumName<SketchEnd>, 3> names(SketchEnd) {
  return {{{SketchEnd::weld, "weld"}, {SketchEnd::pin, "pin"}, {SketchEnd::nothing, "nothing"}}};
}

/// Answers to what a drawing leaves open; what is not answered is asked and assumed.
struct SketchAnswers {
  std::optional<SketchEnd> ends;    ///< ends on the middle of other lines
  std::vector<std::string> ground;  ///< names of fixed points of a drawing without a ground
  std::vector<std::string> driven;  ///< names of points whose joints have drives
};

/// The number of joints of a type.
std::size_t count(const Sketch& sketch, JointType type);

/// The mobility by Gruebler's count: 3 (bodies - 1) - 2 (pins + slides) - 3 welds - pairs of gears - (pulleys
/// - 1) of each belt.
int mobility(const Sketch& sketch);

/// Ends, corners and circles of links in the largest drawing that is read as a linkage.
inline constexpr std::size_t most_sketch_places = 2000;

/// Reads the shapes of a drawing as a linkage. The layers (or groups of SVG) "ground", "slide", "gear",
/// "belt", "drive", "trace" and "construction" say what their shapes are; shapes of other layers are links.
/// Ends within the tolerance are one point, and those within ten times the tolerance, about which there is a
/// question. Circles of the layer "gear" that touch are a pair of gears, carried by the body that has points
/// at both centres; lines of the layer "belt" that touch its circles are the strands of closed belts. The
/// order of the shapes does not matter.
/// @param shapes shapes of the drawing
/// @param tolerance largest distance of ends that meet (m)
/// @param answers answers to questions that arise while it is read
/// @returns the linkage as it is drawn; without links, or with more than `most_sketch_places`, one without
///   bodies
/// @throws ContractError if the tolerance is not positive
Sketch sketched_linkage(const std::vector<DrawnShape>& shapes, double tolerance,
                        const SketchAnswers& answers = {});

/// The first point of the answers that a sketch does not have.
/// @param sketch sketch as it was read
/// @param answers answers with names of points
/// @returns its name; nothing if there is none
std::optional<std::string> unknown_point(const Sketch& sketch, const SketchAnswers& answers);

/// True for the text of a file of the program Linkage (".linkage2").
bool is_linkage_file(std::string_view text);

/// Reads a file of the program Linkage: connectors are points, links are bodies, anchors lie on the ground,
/// connectors that slide have a block, an actuator is a barrel with a rod, ratios are pairs of gears. Links
/// that are fastened to each other are one body. Its coordinates are millimetres.
/// @param text text in UTF-8 for which `is_linkage_file` is true
/// @param file name of the file in diagnostics
/// @param diagnostics receives the error, with its line where there is one
/// @returns the linkage, none with one error in `diagnostics` where the file cannot be read
std::optional<Sketch> read_linkage_file(std::string_view text, const std::string& file,
                                        Diagnostics& diagnostics);

/// Answers what a study needs to know and the drawing does not say: without a ground the two lowest free
/// ends, else the two lowest pins are fixed; without a drive the shortest bar at the ground is driven. Each
/// is a question with its assumption. `sketch.drives` has a drive afterwards where any joint can be driven.
/// @param sketch sketch with at least one body
/// @param answers names of points for which `unknown_point` finds nothing; those of the ground count where
/// the
///   sketch has none
void complete(Sketch& sketch, const SketchAnswers& answers = {});

/// The study of a linkage, in the words of a file: its bodies and joints as they are drawn, one drive over
/// the range in which it assembles or a grid of several, questions as comments.
/// @param sketch completed sketch
/// @param title title of the study
/// @returns a study in TOML
std::string sketch_study(const Sketch& sketch, const std::string& title);

}  // namespace linkwright::planar
