// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/sentence.h"

namespace linkwright::study {

/// A mechanism in motion as it is to be drawn: points over samples of the input, bodies and joints that refer
/// to them. Lengths in metres; plane x right, y up, or, when points have a z, space with z up. Reports, SVG
/// and DXF draw this and know no mechanism.
struct Scene {
  /// A point of the drawing: one entry a sample, or a single entry for a point that does not move. NaN =
  /// without a place. Whether the mechanism is assembled its status says; without status, that all points
  /// have one.
  struct Point {
    std::string name;            ///< "A"
    std::vector<double> x,       ///< m
        y;                       ///< m
    std::vector<double> z = {};  ///< like x and y; empty = 0
  };
  /// Looks of a body. Spring, damper and guide run from each of their points to the next; they are symbols of
  /// constant width.
  enum class BodyStyle {
    ground,  ///< the fixed body
    bar,     ///< a line through its points
    plate,   ///< the polygon of its points
    spring,  ///< a zigzag
    damper,  ///< a cylinder with its piston
    guide,   ///< a thin line hatched on its right
    axis,    ///< thin dash-dotted line beyond both of its points, about which something turns; no body
    /// Dashed line with its length between two points that ought to be one: it has places only where the
    /// mechanism does not assemble.
    gap
  };
  /// A body, which moves with its points.
  struct Body {
    std::string name;                  ///< "crank"
    std::vector<int> points;           ///< indices of points; a plate is the polygon of them
    BodyStyle style = BodyStyle::bar;  ///< looks of the body
    /// Index in `runs`; those behind the first are ghosts: thin dashed lines in the run's colour.
    int run = 0;
  };
  /// Looks of a joint.
  enum class JointStyle {
    ground_pivot,  ///< a pin on the fixed body
    pivot,         ///< a pin between moving bodies
    tracer         ///< a point that is followed
  };
  /// A joint, drawn at a point.
  struct Joint {
    std::string name;                      ///< "O2"
    int point = 0;                         ///< index of the point
    JointStyle style = JointStyle::pivot;  ///< looks of the joint
  };
  /// The path of a point.
  struct Trace {
    int point = 0;        ///< index of the point
    std::string name;     ///< name of the path
    bool closed = false;  ///< true if its last sample joins the first
    int run = 0;          ///< like that of a body
  };
  /// Points that were to be reached, and where the mechanism comes instead; error whiskers join the two.
  struct Target {
    std::string name;                    ///< name of the targets
    std::vector<double> x,               ///< m, one for each target point
        y;                               ///< m
    std::vector<double> achieved_x,      ///< m, one for each target point
        achieved_y;                      ///< m
    std::vector<double> achieved_input;  ///< value of the input there
    bool closed = false;                 ///< true if the last target point joins the first
  };
  /// A circle that turns about its centre, such as the pitch circle of a gear; its radius is the distance of
  /// the two points, and a mark at the rim shows the turning.
  struct Circle {
    std::string name;  ///< "sun wheel"
    int centre = 0;    ///< index of a point
    int rim = 0;       ///< index of a point that turns with the body
  };
  /// A wheel of a spatial scene, about the line from its centre to another point.
  struct Disc {
    std::string name;   ///< "left wheel"
    int centre = 0;     ///< index of a point
    int axis = 0;       ///< index of a point on its axis
    double radius = 0;  ///< m
    double width = 0;   ///< m, along the axis
  };
  /// The quantity that arrows show; those of one quantity are shown together and have one scale.
  enum class Quantity {
    force,        ///< forces, and couples with them
    velocity,     ///< velocities of points
    acceleration  ///< accelerations of points
  };
  /// An arrow that starts at a point. Components along x and y: one entry a sample, or a single entry when
  /// constant; NaN = unknown. All vectors of one quantity have one unit.
  struct Vector {
    std::string name;                     ///< "ground on crank at O1"
    Quantity quantity = Quantity::force;  ///< what it shows
    std::string unit;                     ///< "N", "m/s", "m/s2"
    int point = 0;                        ///< index of the point
    std::vector<double> x,                ///< component along x, in `unit`
        y;                                ///< component along y
    std::string symbol = {};              ///< written at the tip: "F1"; empty = nothing
    std::vector<double> z = {};           ///< like x and y; empty = 0
  };
  /// A couple, drawn as an arc about a point: counter-clockwise positive, longer for a larger value. It is
  /// shown with the forces.
  struct Moment {
    std::string name;           ///< "drive torque"
    std::string unit;           ///< "N m"
    int point = 0;              ///< index of the point
    std::vector<double> value;  ///< one entry a sample, or a single one; NaN = unknown
    std::string symbol = {};    ///< written at the arc: "M"; empty = nothing
  };

  /// The position of a body's coordinate system: one entry a sample, or a single entry for a body that does
  /// not move.
  struct Frame {
    std::vector<double> x,  ///< m, of its origin
        y,                  ///< m, of its origin
        angle;              ///< rad, counter-clockwise
  };
  /// A number, or a list of coordinates, of the study that a drawn point or target shows. With these numbers
  /// measured again at a place, the mechanism is at the same input where it was, but for that point.
  struct Handle {
    /// What a number of the study measures.
    enum class Measure {
      place,   ///< the coordinates of the point in the frame (m), a list
      x,       ///< one of them
      y,       ///< the other
      length,  ///< distance of the point from another one (m)
      angle    ///< direction to the point from another one, up to a constant (rad)
    };
    std::string key;                   ///< "mechanism.body[1].points_m.A"
    Measure measure = Measure::place;  ///< what the number measures
    int frame = -1;     ///< index of the frame in which the coordinates are; -1 = that of the drawing
    int point = -1;     ///< index of the point, or
    int target = -1;    ///< ... of the target
    int index = 0;      ///< and of the point in it
    int from = -1;      ///< index of the other point of a length or an angle; -1 = the origin
    bool held = false;  ///< true if a length is held: its direction is that of the input, or given otherwise
  };

  std::string name;           ///< identifies it: "solution-1"
  Sentence title;             ///< title: "2: double rocker"; empty = the name of the study
  std::string input_key;      ///< "crank_angle_rad"; one in seconds ("time_s") is played in real time
  std::string input_label;    ///< "crank angle"
  std::vector<double> input;  ///< one value a sample, monotonous, in radians, metres or seconds
  /// A second input, such as the rack beside the travel; empty = none. Samples are then a grid: all of
  /// `input` with the first value of `second`, then with the next one.
  std::string second_key;
  std::string second_label;         ///< "rack"; empty = none
  std::vector<double> second;       ///< its values, in radians, metres or seconds
  std::vector<std::string> status;  ///< one a sample; empty = done where all points have a place
  /// Names of the mechanisms that are drawn over each other, as curves of diagrams are coloured: the first is
  /// the mechanism itself, the others are its ghosts. Empty = it is alone.
  std::vector<std::string> runs;
  std::vector<Point> points;    ///< all places; bodies and joints refer to them by index
  std::vector<Body> bodies;     ///< bodies
  std::vector<Joint> joints;    ///< joints
  std::vector<Trace> traces;    ///< paths
  std::vector<Target> targets;  ///< points to be reached
  std::vector<Circle> circles;  ///< circles
  std::vector<Disc> discs;      ///< wheels
  std::vector<Vector> vectors;  ///< arrows
  std::vector<Frame> frames;    ///< coordinate systems of bodies, for handles
  std::vector<Handle> handles;  ///< points that can be dragged
  std::vector<Moment> moments;  ///< couples

  /// @returns number of samples: of the input, or of the grid of both inputs
  std::size_t samples() const { return input.size() * (second.empty() ? 1 : second.size()); }
  /// @returns true if points have a z
  bool spatial() const {
    return std::any_of(points.begin(), points.end(), [](const Point& p) { return !p.z.empty(); });
  }
};

constexpr std::array<EnumName<Scene::Handle::Measure>, 5> names(Scene::Handle::Measure) {
  using Measure = Scene::Handle::Measure;
  return {{{Measure::place, "place"},
           {Measure::x, "x"},
           {Measure::y, "y"},
           {Measure::length, "length"},
           {Measure::angle, "angle"}}};
}
constexpr std::array<EnumName<Scene::BodyStyle>, 8> names(Scene::BodyStyle) {
  using Style = Scene::BodyStyle;
  return {{{Style::ground, "ground"},
           {Style::bar, "bar"},
           {Style::plate, "plate"},
           {Style::spring, "spring"},
           {Style::damper, "damper"},
           {Style::guide, "guide"},
           {Style::axis, "axis"},
           {Style::gap, "gap"}}};
}
constexpr std::array<EnumName<Scene::JointStyle>, 3> names(Scene::JointStyle) {
  using Style = Scene::JointStyle;
  return {{{Style::ground_pivot, "ground_pivot"}, {Style::pivot, "pivot"}, {Style::tracer, "tracer"}}};
}
/// In the order in which they are listed.
constexpr std::array<EnumName<Scene::Quantity>, 3> names(Scene::Quantity) {
  using Quantity = Scene::Quantity;
  return {{{Quantity::force, "force"},
           {Quantity::velocity, "velocity"},
           {Quantity::acceleration, "acceleration"}}};
}

}  // namespace linkwright::study
