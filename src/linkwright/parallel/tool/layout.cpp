// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/layout.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {
namespace {

// Nearer points are one, in m and rad.
constexpr double least_way = 1e-9, min_turn = 1e-12;
// The length of a line between its corners that is only rounding, m.
constexpr double layout_rounding = 1e-12;
// Directions that differ by less are one.
constexpr double least_corner = 1e-6;
// Sharper corners turn back so nearly that a rounding would be all but a stop.
constexpr double sharpest_corner = 170 * pi / 180;
// A rotation may be written in degrees with six digits after the point.
constexpr double rotation_tolerance = 1e-7;

Vec3 vector(const Coordinates& c) { return {c[0], c[1], c[2]}; }
bool finite(const Coordinates& c) { return finite(vector(c)); }
std::string shown(const Vec3& p) { return fmt::format("({:g}, {:g}, {:g}) m", p.x, p.y, p.z); }

double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

// Lays step after step from where the tool is. Each function returns false when there is a problem.
class Layer {
 public:
  Layer(const ToolPath& path, const Pose& start) : path_(path), here_(start), starts_(path.steps.size()) {}

  ToolLayout all() {
    if (!finite(here_.position) || !finite(here_.rotation.row[0]) || !finite(here_.rotation.row[1]) ||
        !finite(here_.rotation.row[2])) {
      out_.problem = ToolProblem{-1, {}, "the start is not finite", {}};
    } else if (!(path_.corner >= 0) || !std::isfinite(path_.corner)) {
      out_.problem =
          ToolProblem{-1, "corner", fmt::format("corner is {:g} m, must be at least 0 m", path_.corner), {}};
    } else if (path_.steps.empty()) {
      out_.problem = ToolProblem{-1, "step", "the path has no steps", "give at least one"};
    } else {
      for (step_ = 0; step_ < static_cast<int>(path_.steps.size()); ++step_)
        if (!std::visit([&](const auto& s) { return lay(s); }, path_.steps[step_].form)) break;
    }
    for (ToolRun& run : out_.runs)
      std::erase_if(run.parts, [](const ToolPart& part) { return part.curve.length <= layout_rounding; });
    out_.end = here_;
    return std::move(out_);
  }

 private:
  bool fail(std::string_view key, const std::string& message, std::string hint = {}) {
    return fail_at(step_, key, message, std::move(hint));
  }
  bool fail_at(int step, std::string_view key, const std::string& message, std::string hint) {
    out_.problem = ToolProblem{step, key, step_name(path_, step) + ": " + message, std::move(hint)};
    return false;
  }

  template <class Step>
  bool sound(const Step& s) {
    if (s.speed && (!(*s.speed > 0) || !std::isfinite(*s.speed)))
      return fail("speed", fmt::format("speed is {:g} m/s, must be more than 0 and finite", *s.speed));
    if (s.rotation && !finite(*s.rotation)) return fail("rotation", "rotation is not finite");
    if constexpr (requires { s.to; })
      if (!finite(s.to)) return fail("to", "to is not finite");
    return true;
  }
  bool sound_dwell(std::string_view key, double dwell) {
    if (dwell >= 0 && std::isfinite(dwell)) return true;
    return fail(key, fmt::format("{} is {:g} s, must be at least 0 s", key, dwell));
  }

  // From here to the orientation that a step asks for.
  Vec3 turn_to(const std::optional<Coordinates>& rotation) const {
    if (!rotation) return {};
    const Vec3 turn = turn_of(math::turn_about(vector(*rotation)) * transposed(here_.rotation));
    return norm(turn) > min_turn ? turn : Vec3{};
  }

  ToolRun& begin() {
    out_.runs.push_back({.step = step_, .start = here_, .parts = {}});
    joins_ = false;
    return out_.runs.back();
  }

  // Takes a curve to `to` into the run before it, if the two join, or begins a run.
  template <class Step>
  bool append(ToolCurve curve, const Vec3& to, const Step& s) {
    const Vec3 turn = turn_to(s.rotation);
    const bool turns = norm(turn) > 0;
    const Vec3 direction = curve.tangent;
    if (joins_ && !turns) {
      ToolRun& run = out_.runs.back();
      ToolPart& last = run.parts.back();
      const Vec3 before = end_direction(last.curve);
      const double angle = angle_between(before, direction);
      const bool lines = last.curve.form == ToolCurve::Form::straight && curve.form == last.curve.form;
      if (angle <= least_corner) {
        joins_ = path_.blend || (lines && path_.corner > 0);
      } else if (lines && path_.corner > 0 && angle <= sharpest_corner) {
        if (!shorten_end(last) || !shorten_start(curve)) return false;
        ToolPart corner{rounded(here_.position, before, direction, path_.corner), last.step, last.speed};
        if (s.speed) corner.speed = std::min(corner.speed, *s.speed);
        run.parts.push_back(corner);
      } else {
        joins_ = false;
      }
    } else {
      joins_ = false;
    }
    if (!joins_) begin();
    ToolPart part{std::move(curve), step_};
    if (s.speed) part.speed = *s.speed;
    out_.runs.back().parts.push_back(part);
    out_.runs.back().turn = turn;
    joins_ = !turns;
    arrive(to, s.rotation);
    return true;
  }
  void arrive(const Vec3& to, const std::optional<Coordinates>& rotation) {
    here_.position = to;
    if (rotation) here_.rotation = math::turn_about(vector(*rotation));
  }

  // Corners take their reach off the lines that they join.
  bool shorten_end(ToolPart& part) {
    if (!shorten(part.curve, part.step)) return false;
    part.curve.to = part.curve.to - path_.corner * part.curve.tangent;
    return true;
  }
  bool shorten_start(ToolCurve& curve) {
    if (!shorten(curve, step_)) return false;
    curve.from = curve.from + path_.corner * curve.tangent;
    return true;
  }
  bool shorten(ToolCurve& curve, int step) {
    if (curve.length >= path_.corner - layout_rounding) {
      curve.length = std::max(0.0, curve.length - path_.corner);
      return true;
    }
    const double whole = norm(vector(std::get<ToolLine>(path_.steps[step].form).to) - starts_[step]);
    const int corners = curve.length < whole - layout_rounding ? 2 : 1;
    return fail_at(step, "to",
                   fmt::format("the line is {:g} m long, the {} {:g} m of it", whole,
                               corners == 2 ? "corners at its ends need" : "corner at its end needs",
                               corners * path_.corner),
                   fmt::format("make corner at most {:g} m", whole / corners));
  }

  bool lay(const ToolLine& s) {
    if (!sound(s)) return false;
    const Vec3 from = here_.position, to = vector(s.to);
    starts_[step_] = from;
    if (norm(to - from) > least_way) return append(straight(from, to), to, s);
    const Vec3 turn = turn_to(s.rotation);
    if (norm(turn) == 0)
      return fail("to", fmt::format("the line has no length: the tool is already at {}", shown(from)),
                  "give another end, another rotation, or a dwell");
    begin().turn = turn;
    out_.runs.back().parts.push_back({{.from = from, .to = from, .length = norm(turn)}, step_});
    arrive(from, s.rotation);
    return true;
  }

  bool lay(const ToolArc& s) {
    if (!sound(s)) return false;
    if (!finite(s.through)) return fail("through", "through is not finite");
    const Vec3 from = here_.position, to = vector(s.to), a = vector(s.through) - from, b = to - from;
    if (norm(b) <= least_way)
      return fail("to", "the arc ends where it begins", "for a full circle take a circle");
    const Vec3 across = cross(a, b);
    if (norm(across) <= 1e-9 * std::max(dot(a, a), dot(b, b)))
      return fail("through",
                  fmt::format("the points {}, {} and {} of the arc are on one line", shown(from),
                              shown(vector(s.through)), shown(to)),
                  "move the point through which it goes, or take a line");
    // Centre of the circle through 0, a and b.
    const Vec3 centre = from + (1 / (2 * dot(across, across))) * cross(dot(a, a) * b - dot(b, b) * a, across);
    const Vec3 axis = unit(across), arm = from - centre;
    double angle = std::atan2(dot(axis, cross(arm, to - centre)), dot(arm, to - centre));
    if (angle <= 0) angle += 2 * pi;
    return append(circular(from, centre, axis, angle), to, s);
  }

  bool lay(const ToolCircle& s) {
    if (!sound(s)) return false;
    if (!finite(s.centre)) return fail("centre", "centre is not finite");
    if (!std::isfinite(s.angle) || std::abs(s.angle) < least_corner)
      return fail("angle", fmt::format("angle is {:g} rad, must be finite and not 0", s.angle));
    const double size = norm(vector(s.axis));
    if (!(size > 0) || !std::isfinite(size)) return fail("axis", "axis must be a direction, not 0");
    const Vec3 axis = (std::copysign(1 / size, s.angle)) * vector(s.axis), centre = vector(s.centre);
    const Vec3 arm = here_.position - centre;
    if (norm(arm - dot(arm, axis) * axis) <= least_way)
      return fail("centre", fmt::format("the tool is on the axis, at {}", shown(here_.position)),
                  "move the centre, or begin elsewhere");
    const ToolCurve curve = circular(here_.position, centre, axis, std::abs(s.angle));
    return append(curve, end_of(curve), s);
  }

  bool lay(const PickAndPlace& s) {
    if (!sound(s) || !sound_dwell("dwell", s.dwell) || !sound_dwell("back_dwell", s.back_dwell)) return false;
    if (!(s.height > 0) || !std::isfinite(s.height))
      return fail("height", fmt::format("height is {:g} m, must be more than 0 m", s.height));
    if (s.back_dwell > 0 && !s.back)
      return fail("back_dwell", "back_dwell is the dwell after the return, but there is no return",
                  "set back = true, or give dwell");
    if (!(s.corner > 0 && s.corner <= 1))
      return fail("corner", fmt::format("corner is {:g}, must be more than 0 and at most 1", s.corner),
                  "for sharp corners take three lines");
    const double size = norm(vector(s.up));
    if (!(size > 0) || !std::isfinite(size)) return fail("up", "up must be a direction, not 0");
    const Vec3 up = (1 / size) * vector(s.up), from = here_.position, to = vector(s.to);
    const Vec3 way = to - from - dot(to - from, up) * up;
    if (norm(way) <= least_way)
      return fail("to", fmt::format("{} and {} lie above each other", shown(from), shown(to)),
                  "take a line, or another direction up");
    const Pose home = here_;
    gate(from, to, up, s, turn_to(s.rotation));
    arrive(to, s.rotation);
    if (s.dwell > 0) begin().dwell = s.dwell;
    if (s.back) {
      const Vec3 turn = turn_of(home.rotation * transposed(here_.rotation));
      gate(to, from, up, s, norm(turn) > min_turn ? turn : Vec3{});
      here_ = home;
    }
    if (s.back_dwell > 0) begin().dwell = s.back_dwell;
    return true;
  }
  void gate(const Vec3& from, const Vec3& to, const Vec3& up, const PickAndPlace& s, const Vec3& turn) {
    const double top = std::max(dot(from, up), dot(to, up)) + s.height;
    const Vec3 first = from + (top - dot(from, up)) * up, second = to + (top - dot(to, up)) * up;
    const Vec3 across = unit(second - first);
    const double lift = norm(first - from), lower = norm(second - to), way = norm(second - first);
    const double reach = s.corner * std::min({lift, lower, way / 2});
    ToolRun& run = begin();
    run.turn = turn;
    const auto add = [&](const ToolCurve& curve) {
      run.parts.push_back({curve, step_});
      if (s.speed) run.parts.back().speed = *s.speed;
    };
    const auto line = [&](const Vec3& a, const Vec3& b, double length) {
      if (length > layout_rounding) add(straight(a, b));
    };
    line(from, first - reach * up, lift - reach);
    add(rounded(first, up, across, reach));
    line(first + reach * across, second - reach * across, way - 2 * reach);
    add(rounded(second, across, -up, reach));
    line(second - reach * up, to, lower - reach);
  }

  bool lay(const ToolDwell& s) {
    if (!sound_dwell("duration", s.duration)) return false;
    begin().dwell = s.duration;
    return true;
  }

  bool lay(const ToolTable& s) {
    if (!s.file.empty() && s.times.empty())
      return fail("file", fmt::format("the file '{}' has not been read", s.file));
    const std::size_t n = s.times.size();
    if (n < 2) return fail("times", fmt::format("{} rows, needs at least 2", n));
    if (s.points.size() != n)
      return fail("points", fmt::format("{} points for {} times", s.points.size(), n));
    if (!s.rotations.empty() && s.rotations.size() != n)
      return fail("rotations", fmt::format("{} rotations for {} times", s.rotations.size(), n),
                  "give one for each time, or none");
    for (std::size_t i = 0; i < n; ++i) {
      if (!std::isfinite(s.times[i]) || !finite(s.points[i]) ||
          (!s.rotations.empty() && !finite(s.rotations[i])))
        return fail("times", fmt::format("row {} is not finite", i + 1));
      if (i > 0 && !(s.times[i] > s.times[i - 1]))
        return fail("times", fmt::format("times must increase, but row {} with {:g} s follows {:g} s", i + 1,
                                         s.times[i], s.times[i - 1]));
    }
    const Vec3 first = vector(s.points.front());
    if (norm(first - here_.position) > least_way)
      return fail(
          "points",
          fmt::format("the first point is {}, but the tool is at {}", shown(first), shown(here_.position)),
          "put a line to the first point before it");
    if (!s.rotations.empty() && norm(turn_of(math::turn_about(vector(s.rotations.front())) *
                                             transposed(here_.rotation))) > rotation_tolerance)
      return fail("rotations", "the first rotation is not that of the tool",
                  "put a line with this rotation before it");
    begin().table = &s;
    arrive(vector(s.points.back()), s.rotations.empty() ? std::nullopt : std::optional(s.rotations.back()));
    return true;
  }

  const ToolPath& path_;
  Pose here_;
  ToolLayout out_;
  int step_ = 0;
  bool joins_ = false;        // true if the last run is of lines and arcs without a turn
  std::vector<Vec3> starts_;  // starts of the lines, by step
};

}  // namespace

ToolLayout lay_out(const ToolPath& path, const Pose& start) { return Layer(path, start).all(); }

}  // namespace linkwright::parallel
