// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/math/vector3.h"
#include "linkwright/parallel/robot/robot.h"

/// @file
/// The task of a robot's tool, step by step. Plain data in SI units, axes of the base; the motion that
/// follows from it is in tool/motion.h.
namespace linkwright::parallel {

/// The law of time of a motion from rest to rest.
enum class TimeLaw {
  double_s,        ///< fastest within the limits: seven phases of constant jerk
  polynomial_345,  ///< 10 x^3 - 15 x^4 + 6 x^5: jerk in a step at the ends
  cycloidal        ///< x - sin(2 pi x) / (2 pi): a sine as acceleration
};
constexpr std::array<EnumName<TimeLaw>, 3> names(TimeLaw) {
  return {{{TimeLaw::double_s, "double_s", "fastest within the limits: seven phases of constant jerk"},
           {TimeLaw::polynomial_345, "polynomial_345", "10 x^3 - 15 x^4 + 6 x^5: jerk in a step at the ends"},
           {TimeLaw::cycloidal, "cycloidal", "x - sin(2 pi x) / (2 pi): a sine as acceleration"}}};
}

/// Largest rate and derivatives of it along a path, all more than 0; of a length, or of an angle.
struct RateLimits {
  double speed = 0,      ///< m/s or rad/s
      acceleration = 0,  ///< m/s2 or rad/s2
      jerk = 0;          ///< m/s3 or rad/s3
};

/// Length run through and its derivatives by seconds.
struct Progress {
  double length = 0,     ///< m or rad
      speed = 0,         ///< m/s or rad/s
      acceleration = 0,  ///< m/s2 or rad/s2
      jerk = 0;          ///< m/s3 or rad/s3
};

/// A time of constant jerk that begins with `at`.
struct JerkPhase {
  double start = 0,  ///< s
      duration = 0;  ///< s
  Progress at;       ///< motion at its beginning
};

/// The motion within a phase.
///
/// @param phase the phase
/// @param time time since the phase began (s)
/// @returns length and rates
Progress after(const JerkPhase& phase, double time);

/// Seven phases that follow each other: jerk +, 0, -, (cruise) 0, -, 0, +; any of them may last 0 s.
struct DoubleS {
  std::array<JerkPhase, 7> phase;  ///< the phases in their order
  double duration = 0;             ///< s
};

/// The fastest motion over a length between two speeds, both without acceleration, within the limits
/// (Biagiotti and Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 3.4). From
/// rest to rest the peak speed is in closed form, else it is a zero found to the last digit.
///
/// @param length m or rad, > 0
/// @param start_speed speed at the start, in [0, limits.speed]
/// @param end_speed speed at the end, in [0, limits.speed]
/// @param limits largest speed, acceleration and jerk
/// @returns the phases
/// @throws ContractError unless length and limits are positive, the speeds are in [0, limits.speed] and the
///   length suffices for their change
DoubleS double_s(double length, double start_speed, double end_speed, const RateLimits& limits);

/// The largest speed, at most that of the limits, that is reached over a length from another speed, both
/// without acceleration. As motions can be run backwards it is also the largest from which that speed is
/// reached.
///
/// @param speed speed at the start
/// @param length m or rad
/// @param limits largest speed, acceleration and jerk
/// @returns the speed
double reachable_speed(double speed, double length, const RateLimits& limits);

/// The shape of a law other than double_s.
///
/// @param law the law
/// @param x share of the time, in [0, 1]
/// @returns share of the length and its derivatives by x
/// @throws ContractError if the law is double_s
Progress shape(TimeLaw law, double x);

/// x, y, z in base axes.
using Coordinates = std::array<double, 3>;

/// Straight to a point, or on the spot if only the rotation changes.
struct ToolLine {
  Coordinates to{};                     ///< m
  std::optional<Coordinates> rotation;  ///< at the end: rotation vector (rad), seen from the base
  std::optional<double> speed;          ///< m/s, at most that of the limits
};

/// Along the circle through a point to a point.
struct ToolArc {
  Coordinates through{},                ///< point of the arc, m
      to{};                             ///< end, m
  std::optional<Coordinates> rotation;  ///< at the end: rotation vector (rad), seen from the base
  std::optional<double> speed;          ///< m/s, at most that of the limits
};

/// Along a circle about an axis.
struct ToolCircle {
  Coordinates centre{};                 ///< m, any point of the axis
  Coordinates axis{0, 0, 1};            ///< axis, of any length
  double angle = 0;                     ///< rad, right-handed about the axis, also more than a turn
  std::optional<Coordinates> rotation;  ///< at the end: rotation vector (rad), seen from the base
  std::optional<double> speed;          ///< m/s, at most that of the limits
};

/// The gate-shaped cycle: up, across and down to a point, the corners rounded. It begins and ends at rest.
struct PickAndPlace {
  Coordinates to{};         ///< m
  Coordinates up{0, 0, 1};  ///< upward direction, of any length
  double height = 0;        ///< m, of the path across above the higher of both ends
  /// Place where the rounding begins, in (0, 1]: share of the lower leg, or of half the path across.
  double corner = 0.5;
  bool back = false;                    ///< and the same path back
  double dwell = 0;                     ///< s, rest at `to`
  double back_dwell = 0;                ///< s, rest after the path back
  std::optional<Coordinates> rotation;  ///< at `to`: rotation vector (rad), seen from the base
  std::optional<double> speed;          ///< m/s, at most that of the limits
};

/// Rest.
struct ToolDwell {
  double duration = 0;  ///< s
};

/// Points in time, joined by a quintic spline (acceleration and jerk continuous) from rest to rest. The
/// limits do not apply to it. The first point is where the tool is.
struct ToolTable {
  std::string file;                    ///< CSV where the rest comes from (tool/table.h); may be empty
  std::vector<double> times;           ///< s, increasing; the step lasts from the first to the last
  std::vector<Coordinates> points;     ///< m
  std::vector<Coordinates> rotations;  ///< rotation vectors (rad); empty = the rotation stays
};

/// One step of the task.
struct ToolStep {
  /// The kind of step with its numbers.
  std::variant<ToolLine, ToolArc, ToolCircle, PickAndPlace, ToolDwell, ToolTable> form;
};

/// Steps that follow each other. The tool rests between two steps unless `blend` or `corner` join them; a
/// step that turns the tool always begins and ends at rest.
struct ToolPath {
  std::vector<ToolStep> steps;      ///< in their order
  TimeLaw law = TimeLaw::double_s;  ///< law of time of each run between two rests
  /// Lines, arcs and circles that continue in the same direction (within 1e-6 rad) are run through. Where the
  /// curvature changes there the acceleration has a step, within its limit; the jerk is limited on either
  /// side.
  bool blend = false;
  /// Distance from a corner between two lines at which its rounding begins (m); the tool runs through it
  /// (acceleration continuous). 0 = corners are not rounded. Reversals of more than 170 deg never are.
  double corner = 0;
};

/// Limits of the tool's motion, each of the whole vector. On each smooth piece of the path |v|, |a| and |j|
/// stay within them, curved or not, and so do the turns; see ToolCurve.
struct ToolLimits {
  double speed = 1;                   ///< m/s
  double acceleration = 10;           ///< m/s2
  double jerk = 1000;                 ///< m/s3
  double angular_speed = 10;          ///< rad/s
  double angular_acceleration = 100;  ///< rad/s2
  double angular_jerk = 10000;        ///< rad/s3
};

/// The reason why a path is not a motion.
struct ToolProblem {
  int step = -1;         ///< from 0; -1 = not of a step
  std::string_view key;  ///< key of the wrong field, without unit; empty = no field
  std::string message;   ///< message with the step by number and kind: "step 3 (arc): ..."
  std::string hint;      ///< says how to fix it; may be empty
};

/// The name of a step in messages: "step 3 (arc)" for the step of index 2.
///
/// @param path the path
/// @param step index of the step
/// @returns the name
std::string step_name(const ToolPath& path, int step);

/// The first problem of the limits.
///
/// @param limits the limits
/// @returns the problem; nothing if there is none
std::optional<ToolProblem> problem(const ToolLimits& limits);

// ---------------------------------------------------------------------------------------------------------------

/// The word for a line in study files. @returns word and meaning
constexpr Word choice_word(const ToolLine&) { return {"line", "straight to a point, or a turn on the spot"}; }
/// The word for an arc in study files. @returns word and meaning
constexpr Word choice_word(const ToolArc&) { return {"arc", "along the circle through a point to a point"}; }
/// The word for a circle in study files. @returns word and meaning
constexpr Word choice_word(const ToolCircle&) { return {"circle", "along a circle about an axis"}; }
/// The word for a gate-shaped cycle in study files. @returns word and meaning
constexpr Word choice_word(const PickAndPlace&) {
  return {"pick_and_place", "up, across and down to a point, corners rounded"};
}
/// The word for a rest in study files. @returns word and meaning
constexpr Word choice_word(const ToolDwell&) { return {"dwell", "rest"}; }
/// The word for a table in study files. @returns word and meaning
constexpr Word choice_word(const ToolTable&) { return {"table", "smooth curve through points in time"}; }

/// Calls `visit(field, member)` for the fields of every step that moves.
///
/// @param visit the function to call
/// @param step the step whose members are passed
template <class Visitor, class Step>
void step_fields(Visitor&& visit, Step& step) {
  visit(field::angle("rotation", "orientation at the end: rotation vector seen from the base"),
        step.rotation);
  visit(field::speed("speed", "largest speed of this step").positive(), step.speed);
}

template <class Visitor>
void fields(Visitor&& visit, ToolLine& s) {
  visit(field::length("to", "end").required(), s.to);
  step_fields(visit, s);
}
template <class Visitor>
void fields(Visitor&& visit, ToolArc& s) {
  visit(field::length("through", "point on the way").required(), s.through);
  visit(field::length("to", "end").required(), s.to);
  step_fields(visit, s);
}
template <class Visitor>
void fields(Visitor&& visit, ToolCircle& s) {
  visit(field::length("centre", "point of the axis").required(), s.centre);
  visit(field::entry("axis", "direction of the axis").between(-1e9, 1e9), s.axis);
  visit(field::angle("angle", "turn about the axis, right-handed; may be more than 360 deg").required(),
        s.angle);
  step_fields(visit, s);
}
template <class Visitor>
void fields(Visitor&& visit, PickAndPlace& s) {
  visit(field::length("to", "where it places").required(), s.to);
  visit(field::entry("up", "direction in which it lifts").between(-1e9, 1e9), s.up);
  visit(field::length("height", "of the way across above the higher end").positive().required(), s.height);
  visit(
      field::entry("corner", "rounded part of the lower leg (or of half the way across, if that is shorter)")
          .positive()
          .at_most(1),
      s.corner);
  visit(field::entry("back", "and the same way back"), s.back);
  visit(field::time("dwell", "rest where it places").not_negative(), s.dwell);
  visit(field::time("back_dwell", "rest after the way back").not_negative(), s.back_dwell);
  step_fields(visit, s);
}
template <class Visitor>
void fields(Visitor&& visit, ToolDwell& s) {
  visit(field::time("duration", "how long it rests").not_negative().required(), s.duration);
}
template <class Visitor>
void fields(Visitor&& visit, ToolTable& s) {
  visit(field::entry("file",
                     "CSV with time_s, x_mm, y_mm, z_mm and, if the tool turns, rotation_x_deg, ... or "
                     "roll_deg, pitch_deg, yaw_deg, in place of the lists"),
        s.file);
  visit(field::time("times", "increasing times"), s.times);
  visit(field::length("points", "place at each time"), s.points);
  visit(field::angle("rotations", "rotation vector at each time"), s.rotations);
}
template <class Visitor>
void fields(Visitor&& visit, ToolStep& s) {
  visit(field::entry("type", "what the tool does").required(), s.form);
}

template <class Visitor>
void fields(Visitor&& visit, ToolPath& p) {
  visit(field::entry("law", "how the steps are run in time"), p.law);
  visit(field::entry("blend", "do not stop between steps of the same direction"), p.blend);
  visit(field::length("corner",
                      "corners between lines are rounded, beginning this far from them; 0 = stop there")
            .not_negative(),
        p.corner);
  visit(field::entry("step", "what the tool does, in order").required(), p.steps);
}

template <class Visitor>
void fields(Visitor&& visit, ToolLimits& l) {
  visit(field::speed("speed", "largest speed").positive(), l.speed);
  visit(field::acceleration("acceleration", "largest acceleration").positive(), l.acceleration);
  visit(field::jerk("jerk", "largest jerk").positive(), l.jerk);
  visit(field::speed_angular("angular_speed", "largest angular speed of turns").positive(), l.angular_speed);
  visit(
      field::acceleration_angular("angular_acceleration", "largest angular acceleration of turns").positive(),
      l.angular_acceleration);
  visit(field::jerk_angular("angular_jerk", "largest angular jerk of turns").positive(), l.angular_jerk);
}

/// A straight line, an arc of a circle, or the rounding of a corner, whose direction turns with the length s
/// by the angle times f(s / length). For the circle f(x) = x; for the corner f(x) = 3 x^2 - 2 x^3, so that
/// the curvature is a parabola from 0 to 0: the acceleration is continuous where the corner joins straight
/// lines, and its peak is lower (1.5 times the mean) than that of a pair of clothoids (2) or of a quintic f
/// (1.875).
struct ToolCurve {
  /// The form of a curve.
  enum class Form {
    straight,  ///< straight line
    circular,  ///< arc of a circle
    corner     ///< rounding of a corner
  };
  Form form = Form::straight;  ///< form of the curve
  math::Vec3 from{};           ///< m
  math::Vec3 to{};             ///< m; of corners and straight lines
  /// Unit direction at the start; zero for a turn on the spot, whose length is an angle.
  math::Vec3 tangent{};
  math::Vec3 normal{};  ///< unit, across it, to the side that the direction turns to
  double length = 0;    ///< m
  double angle = 0;     ///< rad, from the first direction to the last
};

/// A straight line.
///
/// @param from start (m)
/// @param to end (m), another point than the start
/// @returns the curve
ToolCurve straight(const math::Vec3& from, const math::Vec3& to);

/// An arc of a circle: the turn of a point about an axis.
///
/// @param from start (m), off the axis
/// @param centre point of the axis (m)
/// @param axis direction of the axis, unit vector
/// @param angle turn about the axis (rad), right-handed, > 0
/// @returns the curve
ToolCurve circular(const math::Vec3& from, const math::Vec3& centre, const math::Vec3& axis, double angle);

/// The rounding of a corner, from `vertex` - reach `in` to `vertex` + reach `out`.
///
/// @param vertex corner (m)
/// @param in unit direction towards the corner
/// @param out unit direction away from it, at an angle in (0, pi) to the first
/// @param reach distance from the corner at which the rounding begins and ends (m)
/// @returns the curve
ToolCurve rounded(const math::Vec3& vertex, const math::Vec3& in, const math::Vec3& out, double reach);

/// A curve at one point, and how its direction turns there.
struct CurvePoint {
  math::Vec3 position;         ///< m
  math::Vec3 tangent,          ///< unit direction
      normal;                  ///< unit direction across it
  double curvature = 0;        ///< 1/m, >= 0
  double curvature_slope = 0;  ///< its derivative by the length, 1/m2
};

/// The point of a curve at a length. Corners are computed by Gauss quadrature of the direction, exact to
/// rounding.
///
/// @param curve the curve
/// @param length length from the start (m), in [0, curve.length]
/// @returns the point with its directions and curvature
CurvePoint point_at(const ToolCurve& curve, double length);
/// The motion of a point along the curve.
struct PointMotion {
  math::Vec3 velocity,  ///< m/s
      acceleration,     ///< m/s2
      jerk;             ///< m/s3
};

/// The motion in space of a point that moves along a curve.
///
/// @param at the point of the curve
/// @param along rates of the length
/// @returns velocity, acceleration and jerk
PointMotion moved(const CurvePoint& at, const Progress& along);

/// The end of a curve.
///
/// @param curve the curve
/// @returns the point (m)
math::Vec3 end_of(const ToolCurve& curve);

/// The direction of a curve at its end.
///
/// @param curve the curve
/// @returns the unit vector
math::Vec3 end_direction(const ToolCurve& curve);

/// Limits for the motion along a curve that keep the limits of the point in space. With s the length, k the
/// curvature and k' its slope,
///   acceleration^2 = s''^2 + (k s'^2)^2,  jerk^2 = (s''' - k^2 s'^3)^2 + (3 k s' s'' + k' s'^3)^2.
/// The speed is bounded such that k s'^2 is at most 0.8 of the acceleration and k^2 s'^3 at most 0.4, k' s'^3
/// at most 0.3 of the jerk for the largest k and k'; what is left is for s'' and s'''.
///
/// @param curve the curve
/// @param limits limits of the point in space
/// @returns limits of the length and its rates
RateLimits limits_along(const ToolCurve& curve, const RateLimits& limits);

/// The largest constant speed that keeps the limits; at least that of `limits_along`.
///
/// @param curve the curve
/// @param limits limits of the point in space
/// @returns the speed (m/s)
double steady_speed(const ToolCurve& curve, const RateLimits& limits);

}  // namespace linkwright::parallel
