// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/math/motion_law.h"
#include "linkwright/math/spline.h"
#include "linkwright/math/vector2.h"

/// @file
/// The path of a point in the plane, step by step, and its motion in time. Plain data in SI units; the drives
/// that make a linkage follow it are in inverse.h. Laws of time are those of drives (math/motion_law.h).
namespace linkwright::planar {

/// The law of time of a step from rest to rest, or at constant speed.
enum class PathLaw {
  polynomial_345,  ///< from rest to rest by 10 x^3 - 15 x^4 + 6 x^5
  cycloidal,       ///< from rest to rest with a sine as acceleration
  constant_speed   ///< uniform motion: the speed jumps at the ends of the step
};
constexpr std::array<EnumName<PathLaw>, 3> names(PathLaw) {
  return {{{PathLaw::polynomial_345, "polynomial_345", "from rest to rest by 10 x^3 - 15 x^4 + 6 x^5"},
           {PathLaw::cycloidal, "cycloidal", "from rest to rest with a sine as acceleration"},
           {PathLaw::constant_speed, "constant_speed",
            "uniform motion: the speed jumps at the ends of the step"}}};
}

/// x and y, global (m).
using PathPlace = std::array<double, 2>;

/// The time that a step takes: one of both.
struct PathPace {
  std::optional<double> duration;  ///< s, > 0
  std::optional<double> speed;     ///< m/s, the largest of the step, > 0
};
/// Straight to a place, or on the spot if only the angle changes.
struct PathLine {
  PathPlace to{};               ///< m
  std::optional<double> angle;  ///< rad, of the body at the end; absent: it stays
  PathPace pace;                ///< time that the step takes
};
/// Along the circle through a place to a place.
struct PathArc {
  PathPlace through{},          ///< m
      to{};                     ///< m
  std::optional<double> angle;  ///< rad, of the body at the end; absent: it stays
  PathPace pace;                ///< time that the step takes
};
/// Along a smooth curve through places: a quintic spline over the length of its chords.
struct PathCurve {
  std::vector<PathPlace> points;  ///< m, those after the place where the step begins
  std::optional<double> angle;    ///< rad, of the body at the end; absent: it stays
  PathPace pace;                  ///< time that the step takes
};
/// Rest.
struct PathDwell {
  double duration = 0;  ///< s
};
/// Places in time, joined by splines over the time. The first place is where the step begins.
struct PathTable {
  std::string file;               ///< CSV where the rest comes from; may be empty
  std::vector<double> times;      ///< s, increasing; the step lasts from the first to the last
  std::vector<PathPlace> points;  ///< m, one for each time
  std::vector<double> angles;     ///< rad, of the body, one for each time; empty: it stays
  math::TableCurve curve = math::TableCurve::quintic;  ///< degree of the splines
  math::TableEnds ends = math::TableEnds::rest;        ///< conditions at the first and the last time
};
/// One step of the path.
struct PathStep {
  /// The kind of step with its numbers.
  std::variant<PathLine, PathArc, PathCurve, PathDwell, PathTable> form;
};
/// Steps that follow each other.
struct PointPath {
  std::vector<PathStep> steps;            ///< in their order
  PathLaw law = PathLaw::polynomial_345;  ///< law of time of lines, arcs and curves
};

/// The reason why a path is not a motion.
struct PointPathProblem {
  int step = 0;          ///< from 0
  std::string_view key;  ///< key of the wrong field, without unit
  std::string message;   ///< message with the step by number and kind: "step 3 (arc): ..."
  std::string hint;      ///< says how to fix it; may be empty
};

/// The first problem of a path.
///
/// @param path the path
/// @param start place where it begins (m)
/// @returns the problem; nothing if there is none
std::optional<PointPathProblem> problem(const PointPath& path, math::Vec2 start);

/// The target at an instant: place and angle, and how they move.
struct PathState {
  math::Vec2 position{0, 0},     ///< m, global
      velocity{0, 0},            ///< m/s
      acceleration{0, 0};        ///< m/s2
  double angle = 0,              ///< rad
      speed = 0,                 ///< rad/s
      angular_acceleration = 0;  ///< rad/s2
  double length = 0;             ///< m of the path run through so far
  int step = 0;                  ///< index of the step
};

/// A path that is ready to be evaluated.
class PointPathMotion {
 public:
  /// Prepares a path.
  ///
  /// @param path the path
  /// @param start place where it begins (m)
  /// @param angle angle of the body there (rad)
  /// @throws ContractError with the text of `problem` if there is one
  PointPathMotion(const PointPath& path, math::Vec2 start, double angle);

  /// The target at an instant; at the end of a step that of the next one.
  ///
  /// @param time time (s) from 0 to the duration
  /// @returns place, angle and rates
  PathState operator()(double time) const;
  /// @returns time that the path takes (s)
  double duration() const { return duration_; }
  /// @returns length of the path (m)
  double length() const { return length_; }
  /// The share of the path run through: that of its length, or of its time where it has no length.
  ///
  /// @param time time (s) from 0 to the duration
  /// @returns 0 to 1
  double share(double time) const;
  /// @returns times at which the steps begin, and the end (s)
  std::vector<double> breaks() const;

 private:
  struct Straight {
    math::Vec2 from, along;  // unit vector
  };
  struct Round {
    math::Vec2 centre;
    double radius, from, sense;
  };
  // Splines over a parameter, with the length up to each of its places.
  struct Smooth {
    math::PiecewisePolynomial x, y;
    std::vector<double> places, lengths;
  };
  struct Timed {
    math::MotionCurve x, y;
    std::optional<math::MotionCurve> angle;
    double start;
    std::vector<double> places, lengths;
  };
  struct Piece {
    double start = 0, duration = 0, before = 0, length = 0;
    math::Vec2 at;
    double angle = 0, turn = 0;
    std::variant<std::monostate, Straight, Round, Smooth, Timed> shape;
    std::optional<math::MotionCurve> law;  // share of the step over its time
  };
  static PathState on(const Piece& piece, double time);

  std::vector<Piece> pieces_;
  double duration_ = 0, length_ = 0;
};

// ---------------------------------------------------------------------------------------------------------------

/// The word for a line in study files. @returns word and meaning
constexpr Word choice_word(const PathLine&) { return {"line", "straight to a place, or a turn on the spot"}; }
/// The word for an arc in study files. @returns word and meaning
constexpr Word choice_word(const PathArc&) { return {"arc", "along the circle through a place to a place"}; }
/// The word for a curve in study files. @returns word and meaning
constexpr Word choice_word(const PathCurve&) { return {"curve", "along a smooth curve through places"}; }
/// The word for a rest in study files. @returns word and meaning
constexpr Word choice_word(const PathDwell&) { return {"dwell", "rest"}; }
/// The word for a table in study files. @returns word and meaning
constexpr Word choice_word(const PathTable&) { return {"table", "smooth curve through places in time"}; }

/// Calls `visit(field, member)` for the fields of every step that moves by the law of the path.
///
/// @param visit the function to call
/// @param step the step whose members are passed
template <class Visitor, class Step>
void moving_step_fields(Visitor&& visit, Step& step) {
  visit(field::angle("angle", "angle of the body at the end, where it is followed; absent: it stays"),
        step.angle);
  visit(field::time("duration", "time that the step takes").positive(), step.pace.duration);
  visit(field::speed("speed", "largest speed of the step, instead of its duration").positive(),
        step.pace.speed);
}
template <class Visitor>
void fields(Visitor&& visit, PathLine& s) {
  visit(field::length("to", "end").required(), s.to);
  moving_step_fields(visit, s);
}
template <class Visitor>
void fields(Visitor&& visit, PathArc& s) {
  visit(field::length("through", "place on the circle between both ends").required(), s.through);
  visit(field::length("to", "end").required(), s.to);
  moving_step_fields(visit, s);
}
template <class Visitor>
void fields(Visitor&& visit, PathCurve& s) {
  visit(field::length("points", "places that it goes through, the last one its end").required(), s.points);
  moving_step_fields(visit, s);
}
template <class Visitor>
void fields(Visitor&& visit, PathDwell& s) {
  visit(field::time("duration", "duration of the rest").positive().required(), s.duration);
}
template <class Visitor>
void fields(Visitor&& visit, PathTable& s) {
  visit(field::entry("file",
                     "CSV with time_s, x_mm, y_mm and, if the body is turned, angle_deg, in place of "
                     "the lists"),
        s.file);
  visit(field::time("times", "increasing times"), s.times);
  visit(field::length("points", "place at each time"), s.points);
  visit(field::angle("angles", "angle of the body at each time, where it is followed"), s.angles);
  visit(field::entry("curve", "degree of the curve between the rows"), s.curve);
  visit(field::entry("ends", "what holds at the first and last row"), s.ends);
}
template <class Visitor>
void fields(Visitor&& visit, PathStep& s) {
  visit(field::entry("type", "kind of step").required(), s.form);
}
template <class Visitor>
void fields(Visitor&& visit, PointPath& p) {
  visit(field::entry("law", "law of time of lines, arcs and curves"), p.law);
  visit(field::entry("step", "steps of the path, in order").required(), p.steps);
}

}  // namespace linkwright::planar
