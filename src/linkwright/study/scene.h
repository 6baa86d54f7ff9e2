#pragma once

#include <string>
#include <vector>

namespace linkwright::study {

/// A mechanism in motion as it is to be drawn: points over samples of the input, bodies and joints that refer
/// to them. Lengths in metres, plane x right, y up. Reports, SVG and DXF draw this and know no mechanism.
struct Scene {
  /// A point of the drawing: one entry a sample, or a single entry for a point that does not move. NaN = not
  /// assembled.
  struct Point {
    std::string name;
    std::vector<double> x, y;
  };
  enum class BodyStyle { ground, bar, plate };
  struct Body {
    std::string name;         ///< "crank"
    std::vector<int> points;  ///< indices of points; a plate is the polygon of them
    BodyStyle style = BodyStyle::bar;
  };
  enum class JointStyle { ground_pivot, pivot, tracer };
  struct Joint {
    std::string name;  ///< "O2"
    int point = 0;
    JointStyle style = JointStyle::pivot;
  };
  struct Trace {
    int point = 0;
    std::string name;
    bool closed = false;
  };
  /// Points that were to be reached, and where the mechanism comes instead; error whiskers join the two.
  struct Target {
    std::string name;
    std::vector<double> x, y;
    std::vector<double> achieved_x, achieved_y;
    std::vector<double> achieved_input;  ///< value of the input there
    bool closed = false;
  };

  std::string name;                 ///< identifies it: "solution-1"
  std::string title;                ///< for people
  std::string input_key;            ///< "crank_angle_rad"
  std::string input_label;          ///< "crank angle"
  std::vector<double> input;        ///< one value a sample, monotonous, in radians, metres or seconds
  std::vector<std::string> status;  ///< one a sample; empty = all done
  std::vector<Point> points;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Trace> traces;
  std::vector<Target> targets;

  std::size_t samples() const { return input.size(); }
};

}  // namespace linkwright::study
