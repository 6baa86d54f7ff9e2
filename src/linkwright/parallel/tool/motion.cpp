// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/dual.h"
#include "linkwright/math/zero.h"
#include "linkwright/parallel/tool/layout.h"
#include "linkwright/parallel/tool/timing.h"

namespace linkwright::parallel {
namespace {

using math::Vector3;

// Index of the last of the `count` items that begins at or before x; 0 if there is none.
template <class Begin>
std::size_t last_from(std::size_t count, double x, Begin&& begin) {
  std::size_t low = 0;
  while (count > 1) {
    const std::size_t half = count / 2;
    if (begin(low + half) <= x) low += half;
    count -= half;
  }
  return low;
}

// Angular velocity (seen from the base) of the rotation with the vector r that changes at the rate v.
template <class T>
Vector3<T> angular_velocity(const Vector3<T>& r, const Vector3<T>& v) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T square = dot(r, r);
  // (1 - cos a) / a^2 and (a - sin a) / a^3; below 1e-2 their series to the last digit.
  T versed, rest;
  if (square < 1e-4) {
    versed = 0.5 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56)));
    rest = (1 - square / 20 * (1 - square / 42 * (1 - square / 72))) / 6;
  } else {
    const T angle = sqrt(square), half = sin(angle / 2);
    versed = 2 * half * half / square;
    rest = (angle - sin(angle)) / (square * angle);
  }
  const Vector3<T> once = cross(r, v);
  return v + versed * once + rest * cross(r, once);
}

// The rotation vectors of a table, each the one of its rotation that is nearest to that before it: a turn may
// continue beyond half a turn.
std::vector<Vec3> unwound(const std::vector<Coordinates>& rotations) {
  std::vector<Vec3> out;
  for (const Coordinates& c : rotations) {
    Vec3 r{c[0], c[1], c[2]};
    if (!out.empty()) {
      const Vec3 before = out.back();
      const double size = norm(r), size_before = norm(before);
      if (size > 1e-12 || size_before > 1e-12) {
        const Vec3 axis = size > 1e-12 ? (1 / size) * r : (1 / size_before) * before;
        r = r + full_turn * std::round((dot(before, axis) - dot(r, axis)) / full_turn) * axis;
      }
    }
    out.push_back(r);
  }
  return out;
}

std::array<math::PiecewisePolynomial, 3> splines(const std::vector<double>& times,
                                                 const std::vector<Vec3>& points) {
  std::array<math::PiecewisePolynomial, 3> out;
  std::vector<double> values(points.size());
  for (int k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = k == 0 ? points[i].x : k == 1 ? points[i].y : points[i].z;
    out[k] = math::interpolating_spline(times, values, math::SplineDegree::quintic, math::SplineEnds::rest);
  }
  return out;
}

// Value and derivatives of three splines.
std::array<Vec3, 4> at(const std::array<math::PiecewisePolynomial, 3>& s, double t) {
  const auto x = evaluate(s[0], t), y = evaluate(s[1], t), z = evaluate(s[2], t);
  std::array<Vec3, 4> out;
  for (int k = 0; k < 4; ++k) out[k] = {x[k], y[k], z[k]};
  return out;
}

// Bound of the length of a curve between two times with no knot between them: |v| from its Taylor series
// about the middle, whose rest is the third derivative, a parabola within the hull of its Bezier points.
double way_bound(const std::array<math::PiecewisePolynomial, 3>& s, double a, double b) {
  const double h = (b - a) / 2;
  const auto first = at(s, a), middle = at(s, (a + b) / 2), last = at(s, b);
  const Vec3 control = 2 * middle[3] - 0.5 * (first[3] + last[3]);
  const double jerk = std::max({norm(first[3]), norm(control), norm(last[3])});
  return 2 * h * (norm(middle[1]) + h * (norm(middle[2]) + h * jerk / 2));
}

}  // namespace

std::optional<ToolProblem> problem(const ToolPath& path, const ToolLimits& limits, const Pose& start) {
  if (auto bad = problem(limits)) return bad;
  return lay_out(path, start).problem;
}

ToolMotion::ToolMotion(const ToolPath& path, const ToolLimits& limits, const Pose& start) {
  const auto bad_limits = problem(limits);
  LINKWRIGHT_REQUIRE(!bad_limits, "{}", bad_limits->message);
  const ToolLayout layout = lay_out(path, start);
  LINKWRIGHT_REQUIRE(!layout.problem, "{}", layout.problem->message);
  for (std::size_t i = 0; i < path.steps.size(); ++i) names_.push_back(step_name(path, static_cast<int>(i)));

  for (const ToolRun& from : layout.runs) {
    Run run{.step = from.step,
            .start = duration_,
            .duration = from.dwell,
            .first_piece = pieces_.size(),
            .first_phase = phases_.size(),
            .law = path.law,
            .position = from.start.position,
            .rotation = from.start.rotation,
            .turn = from.turn};
    for (const ToolPart& part : from.parts) {
      pieces_.push_back({part.curve, part.step, run.length});
      run.length += part.curve.length;
    }
    run.end_piece = pieces_.size();
    if (!from.parts.empty()) {
      const ToolTiming timing = timed(from, path.law, limits);
      phases_.insert(phases_.end(), timing.phases.begin(), timing.phases.end());
      run.duration = timing.duration;
    } else if (from.table) {
      Spline spline;
      std::vector<double> times;
      for (double t : from.table->times) times.push_back(t - from.table->times.front());
      std::vector<Vec3> points;
      for (const Coordinates& c : from.table->points) points.push_back({c[0], c[1], c[2]});
      // The same up to the tolerance of the check; so the motion is continuous to the last digit.
      points.front() = from.start.position;
      spline.position = splines(times, points);
      spline.turns = !from.table->rotations.empty();
      if (spline.turns) spline.rotation = splines(times, unwound(from.table->rotations));
      run.duration = times.back();
      run.spline = static_cast<int>(splines_.size());
      splines_.push_back(std::move(spline));
    }
    run.end_phase = phases_.size();
    duration_ += run.duration;
    runs_.push_back(run);
  }
  end_ = {.position = layout.end.position, .rotation = layout.end.rotation};
}

const ToolMotion::Run& ToolMotion::run_at(double t) const {
  return runs_[last_from(runs_.size(), t, [&](std::size_t i) { return runs_[i].start; })];
}

const ToolMotion::Piece& ToolMotion::piece_at(const Run& run, double length) const {
  const Piece* pieces = pieces_.data() + run.first_piece;
  return pieces[last_from(run.end_piece - run.first_piece, length,
                          [&](std::size_t i) { return pieces[i].offset; })];
}

Progress ToolMotion::progress(const Run& run, double time) const {
  if (run.law == TimeLaw::double_s) {
    const JerkPhase* phases = phases_.data() + run.first_phase;
    const JerkPhase& phase = phases[last_from(run.end_phase - run.first_phase, time,
                                              [&](std::size_t i) { return phases[i].start; })];
    return after(phase, time - phase.start);
  }
  const double T = run.duration, rate = run.length / T;
  const Progress x = shape(run.law, time / T);
  return {run.length * x.length, rate * x.speed, rate / T * x.acceleration, rate / (T * T) * x.jerk};
}

ToolState ToolMotion::along(const Run& run, double time) const {
  const Progress p = progress(run, time);
  const double s = std::clamp(p.length, 0.0, run.length);
  const Piece& piece = piece_at(run, s);
  const CurvePoint point = point_at(piece.curve, std::min(s - piece.offset, piece.curve.length));
  const auto [velocity, acceleration, jerk] = moved(point, p);
  ToolState out{.position = point.position,
                .velocity = velocity,
                .acceleration = acceleration,
                .jerk = jerk,
                .rotation = run.rotation};
  if (run.turn != Vec3{}) {
    out.rotation = math::turn_about((s / run.length) * run.turn) * run.rotation;
    out.angular_velocity = (p.speed / run.length) * run.turn;
    out.angular_acceleration = (p.acceleration / run.length) * run.turn;
  }
  return out;
}

ToolState ToolMotion::on(const Spline& spline, const Run& run, double time) const {
  const auto p = at(spline.position, time);
  ToolState out{
      .position = p[0], .velocity = p[1], .acceleration = p[2], .jerk = p[3], .rotation = run.rotation};
  if (spline.turns) {
    const auto r = at(spline.rotation, time);
    // The angular acceleration is the derivative by time, in one direction of dual numbers.
    const auto moving = [](const Vec3& a, const Vec3& rate) {
      using Dual = math::Dual<1>;
      return Vector3<Dual>{{Dual(a.x) + rate.x * Dual::variable(0, 0)},
                           {Dual(a.y) + rate.y * Dual::variable(0, 0)},
                           {Dual(a.z) + rate.z * Dual::variable(0, 0)}};
    };
    const auto w = angular_velocity(moving(r[0], r[1]), moving(r[1], r[2]));
    out.rotation = math::turn_about(r[0]);
    out.angular_velocity = {w.x.value, w.y.value, w.z.value};
    out.angular_acceleration = {w.x.by[0], w.y.by[0], w.z.by[0]};
  }
  return out;
}

ToolState ToolMotion::operator()(double t) const {
  if (t < 0) return {.position = runs_.front().position, .rotation = runs_.front().rotation};
  if (t >= duration_) return end_;
  const Run& run = run_at(t);
  const double time = std::clamp(t - run.start, 0.0, run.duration);
  if (run.end_piece > run.first_piece) return along(run, time);
  if (run.spline >= 0) return on(splines_[run.spline], run, time);
  return {.position = run.position, .rotation = run.rotation};
}

int ToolMotion::piece_at(double t) const {
  const Run& run = run_at(std::min(t, duration_));
  if (run.end_piece == run.first_piece) return run.step;
  const double time = std::clamp(t - run.start, 0.0, run.duration);
  return piece_at(run, std::clamp(progress(run, time).length, 0.0, run.length)).step;
}

Sentence ToolMotion::where(double t) const {
  return say("{} at {}", names_[piece_at(t)], at_place("time", seconds(t, 6)));
}

double ToolMotion::length_at(const Run& run, double t) const {
  if (t >= run.start + run.duration) return run.length;
  return std::clamp(progress(run, std::max(0.0, t - run.start)).length, 0.0, run.length);
}

std::optional<double> ToolMotion::share_at(double t) const {
  const Run& run = run_at(std::min(t, duration_));
  if (run.end_piece == run.first_piece) return {};
  const double length = length_at(run, t);
  const int step = piece_at(run, length).step;
  double first = -1, last = 0;
  for (std::size_t i = run.first_piece; i < run.end_piece; ++i) {
    if (pieces_[i].step != step) continue;
    if (first < 0) first = pieces_[i].offset;
    last = pieces_[i].offset + pieces_[i].curve.length;
  }
  return (length - first) / (last - first);
}

Sentence ToolMotion::where_exactly(double t) const {
  const auto share = share_at(t);
  return where(t) + (share ? say(", {} of its path", at_place("path", percent(*share))) : Sentence());
}

std::vector<double> ToolMotion::breaks() const {
  std::vector<double> out{0};
  for (const Run& run : runs_) {
    out.push_back(run.start);
    out.push_back(run.start + run.duration);
    for (std::size_t i = run.first_phase; i < run.end_phase; ++i) out.push_back(run.start + phases_[i].start);
    for (std::size_t i = run.first_piece + 1; i < run.end_piece; ++i) {
      const auto missing = [&](double time) { return progress(run, time).length - pieces_[i].offset; };
      if (missing(0) < 0 && missing(run.duration) > 0)
        out.push_back(run.start + math::zero_between(missing, 0, run.duration));
    }
    if (run.spline >= 0)
      for (const double knot : splines_[run.spline].position[0].knots) out.push_back(run.start + knot);
  }
  std::sort(out.begin(), out.end());
  // Breaks that are one but for rounding.
  std::vector<double> apart{0};
  for (const double t : out)
    if (t - apart.back() > 1e-12 * duration_ && t < duration_) apart.push_back(t);
  if (apart.size() > 1 && duration_ - apart.back() <= 1e-12 * duration_) apart.pop_back();
  if (duration_ > 0) apart.push_back(duration_);
  return apart;
}

Displaced ToolMotion::way(double a, double b) const {
  const Run& run = run_at(std::min(a + (b - a) / 2, duration_));
  if (run.spline >= 0) {
    const Spline& spline = splines_[run.spline];
    const double from = a - run.start, to = b - run.start;
    // The angular velocity is at most as large as the rate of the rotation vector.
    return {way_bound(spline.position, from, to), spline.turns ? way_bound(spline.rotation, from, to) : 0};
  }
  if (run.end_piece == run.first_piece) return {};
  const double length = length_at(run, b) - length_at(run, a);
  // On the spot the length is the angle of the turn.
  const bool moves = pieces_[run.first_piece].curve.tangent != Vec3{};
  return {moves ? length : 0, run.length > 0 ? norm(run.turn) * length / run.length : 0};
}

std::vector<ToolMotion::Sample> ToolMotion::samples(double dt) const {
  LINKWRIGHT_REQUIRE(dt > 0, "the interval is {} s, must be more than 0 s", dt);
  constexpr double most = 1e7;
  LINKWRIGHT_REQUIRE(duration_ / dt < most, "{} s in intervals of {} s are too many samples", duration_, dt);
  std::vector<Sample> out;
  // An interval that divides the duration up to rounding does so.
  const auto whole = static_cast<std::size_t>(std::ceil(duration_ / dt * (1 - 1e-12)));
  for (std::size_t i = 0; i < whole; ++i) {
    const double t = static_cast<double>(i) * dt;
    out.push_back({t, (*this)(t)});
  }
  out.push_back({duration_, end_});
  return out;
}

}  // namespace linkwright::parallel
