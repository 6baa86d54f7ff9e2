// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/point_path.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/gauss.h"

namespace linkwright::planar {
namespace {

using math::Vec2;

Vec2 vec_of(const PathPlace& p) { return {p[0], p[1]}; }

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

// Largest rate of a law that runs from 0 to 1 in a unit of time.
double peak_rate(PathLaw law) {
  return law == PathLaw::polynomial_345 ? 15.0 / 8 : law == PathLaw::cycloidal ? 2.0 : 1.0;
}
math::MotionLaw unit_law(PathLaw law, double duration) {
  switch (law) {
    case PathLaw::polynomial_345:
      return math::Polynomial345{.to = 1, .duration = duration};
    case PathLaw::cycloidal:
      return math::CycloidalMotion{.to = 1, .duration = duration};
    case PathLaw::constant_speed:
      break;
  }
  return math::ConstantSpeed{.rate = 1 / duration};
}

struct Circle {
  Vec2 centre;
  double radius, from, turn;  // signed angle from the first place over the second to the third
};
std::optional<Circle> circle_through(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 u = b - a, w = c - a;
  const double twice = 2 * cross(u, w), size = std::max(norm(u), norm(w));
  if (!(std::abs(twice) > 1e-9 * size * size) || norm(c - b) == 0) return std::nullopt;
  const double uu = dot(u, u), ww = dot(w, w);
  const Vec2 to_centre{(w.y * uu - u.y * ww) / twice, (u.x * ww - w.x * uu) / twice};
  const Vec2 centre = a + to_centre;
  const double from = std::atan2(-to_centre.y, -to_centre.x);
  const double to = std::atan2(c.y - centre.y, c.x - centre.x);
  double turn = math::wrap_angle(to - from);
  if (twice > 0 && turn < 0) turn += full_turn;
  if (twice < 0 && turn > 0) turn -= full_turn;
  return Circle{centre, norm(to_centre), from, turn};
}

constexpr int panels = 16;  // panels of a piece of a spline, for its length

// Lengths at places so dense that the integral between two of them is exact to rounding.
template <class Speed>
void measure_lengths(std::span<const double> knots, Speed&& speed, std::vector<double>& places,
                     std::vector<double>& lengths) {
  places = {knots[0]}, lengths = {0};
  for (std::size_t i = 1; i < knots.size(); ++i)
    for (int k = 1; k <= panels; ++k) {
      const double to = knots[i - 1] + (knots[i] - knots[i - 1]) * k / panels;
      lengths.push_back(lengths.back() + math::gauss_integral(speed, places.back(), to));
      places.push_back(to);
    }
}
template <class Speed>
double length_of_place(double place, const std::vector<double>& places, const std::vector<double>& lengths,
                       Speed&& speed) {
  const auto after = std::upper_bound(places.begin(), places.end(), place);
  if (after == places.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - places.begin()) - 1;
  return lengths[i] + (place > places[i] ? math::gauss_integral(speed, places[i], place) : 0);
}
template <class Speed>
double place_of_length(double length, const std::vector<double>& places, const std::vector<double>& lengths,
                       Speed&& speed) {
  if (length <= 0) return places.front();
  if (length >= lengths.back()) return places.back();
  const auto i =
      static_cast<std::size_t>(std::upper_bound(lengths.begin(), lengths.end(), length) - lengths.begin()) -
      1;
  double place =
      places[i] + (places[i + 1] - places[i]) * (length - lengths[i]) / (lengths[i + 1] - lengths[i]);
  for (int k = 0; k < 20; ++k) {
    const double step = (length - length_of_place(place, places, lengths, speed)) / speed(place);
    place = std::clamp(place + step, places[i], places[i + 1]);
    if (std::abs(step) <= 1e-15 * places.back()) break;
  }
  return place;
}

struct Chords {
  std::vector<double> at, x, y;
};
Chords chords_of(const PathCurve& curve, Vec2 start) {
  Chords out{{0}, {start.x}, {start.y}};
  for (const PathPlace& p : curve.points) {
    out.at.push_back(out.at.back() + std::hypot(p[0] - out.x.back(), p[1] - out.y.back()));
    out.x.push_back(p[0]), out.y.push_back(p[1]);
  }
  return out;
}

math::MotionTable coordinate(const PathTable& table, std::vector<double> values) {
  return {.times = table.times, .values = std::move(values), .curve = table.curve, .ends = table.ends};
}
std::vector<double> coordinates_of(const PathTable& table, std::size_t k) {
  std::vector<double> out;
  for (const PathPlace& p : table.points) out.push_back(p[k]);
  return out;
}

std::string name_of_step(const PathStep& step, std::size_t index) {
  return fmt::format("step {} ({})", index + 1,
                     std::visit([](const auto& s) { return choice_word(s).name; }, step.form));
}

// The end of a step that begins at `start`.
Vec2 end_of(const PathStep& step, Vec2 start) {
  return std::visit(
      Overloaded{[](const PathLine& s) { return vec_of(s.to); },
                 [](const PathArc& s) { return vec_of(s.to); },
                 [&](const PathCurve& s) { return s.points.empty() ? start : vec_of(s.points.back()); },
                 [&](const PathDwell&) { return start; },
                 [&](const PathTable& s) { return s.points.empty() ? start : vec_of(s.points.back()); }},
      step.form);
}

struct Wrong {
  std::string_view key;
  std::string message, hint;
};
std::optional<Wrong> pace_problem(const PathPace& pace, bool moves) {
  if (pace.duration && pace.speed) return Wrong{"speed", "has a duration and a speed", "leave one out"};
  if (!pace.duration && !pace.speed)
    return Wrong{"", "has no duration", "give duration_s, or speed_mm_per_s for its largest speed"};
  if (pace.speed && !moves)
    return Wrong{"speed", "has a speed, but its end is where it begins", "give duration_s instead"};
  return std::nullopt;
}

std::optional<Wrong> table_problem(const PathTable& s, Vec2 start, bool first, bool alone) {
  if (s.times.empty() && s.points.empty())
    return Wrong{"", "has no places", "give times_s and points_mm, or a file"};
  if (s.times.size() != s.points.size())
    return Wrong{"points", fmt::format("has {} places for {} times", s.points.size(), s.times.size()),
                 "give one place for each time"};
  if (!s.angles.empty() && s.angles.size() != s.times.size())
    return Wrong{"angles", fmt::format("has {} angles for {} times", s.angles.size(), s.times.size()),
                 "give one angle for each time"};
  for (std::size_t k = 0; k < 2; ++k)
    if (const auto wrong = math::problem(math::MotionLaw(coordinate(s, coordinates_of(s, k)))))
      return Wrong{wrong->key == "values" ? "points" : wrong->key, wrong->message, wrong->hint};
  if (!s.angles.empty())
    if (const auto wrong = math::problem(math::MotionLaw(coordinate(s, s.angles))))
      return Wrong{wrong->key == "values" ? "angles" : wrong->key, wrong->message, wrong->hint};
  if (!alone && s.ends != math::TableEnds::rest)
    return Wrong{"ends", "moves at its ends, but other steps begin or end there at rest",
                 "write ends = \"rest\", or make it the only step"};
  const Vec2 off = vec_of(s.points.front()) - start;
  if (!first && norm(off) > 1e-9 + 1e-6 * norm(start))
    return Wrong{
        "points",
        fmt::format("begins at ({:.6g}, {:.6g}) mm, the step before it ends at ({:.6g}, {:.6g}) mm",
                    1e3 * s.points.front()[0], 1e3 * s.points.front()[1], 1e3 * start.x, 1e3 * start.y),
        "begin the table there, or add a line to its first place"};
  return std::nullopt;
}

std::optional<Wrong> step_problem(const PathStep& step, Vec2 start, bool first, bool alone) {
  return std::visit(
      Overloaded{[&](const PathLine& s) { return pace_problem(s.pace, norm(vec_of(s.to) - start) > 0); },
                 [&](const PathArc& s) {
                   if (!circle_through(start, vec_of(s.through), vec_of(s.to)))
                     return std::optional(Wrong{"through", "has its three places on a straight line",
                                                "give a place on the arc between both ends, or a line"});
                   return pace_problem(s.pace, true);
                 },
                 [&](const PathCurve& s) {
                   if (s.points.size() < 2)
                     return std::optional(Wrong{"points", "needs two or more places after its beginning",
                                                "write a line for a single one"});
                   const Chords c = chords_of(s, start);
                   for (std::size_t i = 1; i < c.at.size(); ++i)
                     if (!(c.at[i] > c.at[i - 1]))
                       return std::optional(
                           Wrong{"points", fmt::format("has place {} twice in a row", i), "leave one out"});
                   return pace_problem(s.pace, true);
                 },
                 [](const PathDwell& s) {
                   return s.duration > 0 ? std::nullopt
                                         : std::optional(Wrong{"duration", "takes no time", "leave it out"});
                 },
                 [&](const PathTable& s) { return table_problem(s, start, first, alone); }},
      step.form);
}

}  // namespace

std::optional<PointPathProblem> problem(const PointPath& path, Vec2 start) {
  for (std::size_t i = 0; i < path.steps.size(); ++i) {
    if (auto wrong = step_problem(path.steps[i], start, i == 0, path.steps.size() == 1))
      return PointPathProblem{static_cast<int>(i), wrong->key,
                              fmt::format("{}: {}", name_of_step(path.steps[i], i), wrong->message),
                              wrong->hint};
    start = end_of(path.steps[i], start);
  }
  return std::nullopt;
}

PointPathMotion::PointPathMotion(const PointPath& path, Vec2 start, double angle) {
  const auto wrong = problem(path, start);
  LINKWRIGHT_REQUIRE(!wrong, "{}", wrong->message);
  for (const PathStep& step : path.steps) {
    Piece piece{.start = duration_, .before = length_, .at = start, .angle = angle};
    const auto moving = [&](const PathPace& pace, const std::optional<double>& to) {
      piece.duration = pace.duration ? *pace.duration : piece.length * peak_rate(path.law) / *pace.speed;
      piece.turn = to ? *to - angle : 0;
      piece.law.emplace(unit_law(path.law, piece.duration));
    };
    std::visit(
        Overloaded{[&](const PathLine& s) {
                     const Vec2 way = vec_of(s.to) - start;
                     piece.length = norm(way);
                     if (piece.length > 0) piece.shape = Straight{start, (1 / piece.length) * way};
                     moving(s.pace, s.angle);
                   },
                   [&](const PathArc& s) {
                     const Circle c = *circle_through(start, vec_of(s.through), vec_of(s.to));
                     piece.length = c.radius * std::abs(c.turn);
                     piece.shape = Round{c.centre, c.radius, c.from, c.turn > 0 ? 1.0 : -1.0};
                     moving(s.pace, s.angle);
                   },
                   [&](const PathCurve& s) {
                     const Chords c = chords_of(s, start);
                     const bool closed = c.x.front() == c.x.back() && c.y.front() == c.y.back();
                     const auto ends = closed ? math::SplineEnds::periodic : math::SplineEnds::natural;
                     using enum math::SplineDegree;
                     Smooth smooth{math::interpolating_spline(c.at, c.x, quintic, ends),
                                   math::interpolating_spline(c.at, c.y, quintic, ends),
                                   {},
                                   {}};
                     measure_lengths(
                         c.at,
                         [&](double u) {
                           return std::hypot(math::evaluate(smooth.x, u)[1], math::evaluate(smooth.y, u)[1]);
                         },
                         smooth.places, smooth.lengths);
                     piece.length = smooth.lengths.back();
                     piece.shape = std::move(smooth);
                     moving(s.pace, s.angle);
                   },
                   [&](const PathDwell& s) { piece.duration = s.duration; },
                   [&](const PathTable& s) {
                     Timed timed{math::MotionCurve(math::MotionLaw(coordinate(s, coordinates_of(s, 0)))),
                                 math::MotionCurve(math::MotionLaw(coordinate(s, coordinates_of(s, 1)))),
                                 {},
                                 s.times.front(),
                                 {},
                                 {}};
                     if (!s.angles.empty()) timed.angle.emplace(math::MotionLaw(coordinate(s, s.angles)));
                     measure_lengths(
                         s.times, [&](double t) { return std::hypot(timed.x(t).rate, timed.y(t).rate); },
                         timed.places, timed.lengths);
                     piece.duration = s.times.back() - s.times.front();
                     piece.length = timed.lengths.back();
                     piece.turn = s.angles.empty() ? 0 : s.angles.back() - angle;
                     piece.shape = std::move(timed);
                   }},
        step.form);
    start = end_of(step, start);
    angle += piece.turn;
    duration_ += piece.duration;
    length_ += piece.length;
    pieces_.push_back(std::move(piece));
  }
}

PathState PointPathMotion::on(const Piece& piece, double time) {
  const double t = std::clamp(time - piece.start, 0.0, piece.duration);
  const math::Motion share = piece.law ? (*piece.law)(t) : math::Motion{};
  const double s = piece.length * share.value, v = piece.length * share.rate,
               a = piece.length * share.acceleration;
  PathState out{.position = piece.at,
                .angle = piece.angle + piece.turn * share.value,
                .speed = piece.turn * share.rate,
                .angular_acceleration = piece.turn * share.acceleration,
                .length = piece.before + s};
  std::visit(Overloaded{[](std::monostate) {},
                        [&](const Straight& line) {
                          out.position = line.from + s * line.along;
                          out.velocity = v * line.along;
                          out.acceleration = a * line.along;
                        },
                        [&](const Round& arc) {
                          const double at = arc.from + arc.sense * s / arc.radius;
                          const Vec2 outward{std::cos(at), std::sin(at)};
                          const Vec2 along = arc.sense * Vec2{-outward.y, outward.x};
                          out.position = arc.centre + arc.radius * outward;
                          out.velocity = v * along;
                          out.acceleration = a * along - (v * v / arc.radius) * outward;
                        },
                        [&](const Smooth& smooth) {
                          const auto speed = [&](double u) {
                            return std::hypot(math::evaluate(smooth.x, u)[1], math::evaluate(smooth.y, u)[1]);
                          };
                          const double u = place_of_length(s, smooth.places, smooth.lengths, speed);
                          const auto x = math::evaluate(smooth.x, u), y = math::evaluate(smooth.y, u);
                          const Vec2 first{x[1], y[1]}, second{x[2], y[2]};
                          const double square = dot(first, first);
                          const Vec2 along = (1 / std::sqrt(square)) * first;
                          const Vec2 bend = (1 / square) * (second - dot(second, along) * along);
                          out.position = {x[0], y[0]};
                          out.velocity = v * along;
                          out.acceleration = a * along + (v * v) * bend;
                        },
                        [&](const Timed& timed) {
                          const double at = timed.start + t;
                          const math::Motion x = timed.x(at), y = timed.y(at);
                          out.position = {x.value, y.value};
                          out.velocity = {x.rate, y.rate};
                          out.acceleration = {x.acceleration, y.acceleration};
                          out.length += length_of_place(at, timed.places, timed.lengths, [&](double u) {
                            return std::hypot(timed.x(u).rate, timed.y(u).rate);
                          });
                          if (!timed.angle) return;
                          const math::Motion turned = (*timed.angle)(at);
                          out.angle = turned.value, out.speed = turned.rate;
                          out.angular_acceleration = turned.acceleration;
                        }},
             piece.shape);
  return out;
}

PathState PointPathMotion::operator()(double time) const {
  std::size_t i = 0;
  while (i + 1 < pieces_.size() && time >= pieces_[i + 1].start) ++i;
  PathState out = on(pieces_[i], time);
  out.step = static_cast<int>(i);
  return out;
}

double PointPathMotion::share(double time) const {
  const double share = length_ > 0 ? (*this)(time).length / length_ : time / duration_;
  return std::clamp(share, 0.0, 1.0);
}

std::vector<double> PointPathMotion::breaks() const {
  std::vector<double> out;
  for (const Piece& p : pieces_) out.push_back(p.start);
  out.push_back(duration_);
  return out;
}

}  // namespace linkwright::planar
