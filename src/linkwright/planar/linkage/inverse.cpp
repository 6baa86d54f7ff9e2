// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/inverse.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/math/dense.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

using math::Vec2;

constexpr int newton_steps = 60, newton_halvings = 24;
constexpr double largest_step = 0.1;  // of the drives between two places, in units of the Jacobian

// Determinant of up to three rows, column by column.
double determinant_of(std::span<const double> m, std::size_t n) {
  if (n == 1) return m[0];
  if (n == 2) return m[0] * m[3] - m[2] * m[1];
  return m[0] * (m[4] * m[8] - m[7] * m[5]) - m[3] * (m[1] * m[8] - m[7] * m[2]) +
         m[6] * (m[1] * m[5] - m[4] * m[2]);
}

// The rows of a place, a velocity or an acceleration that are followed; lengths in sizes of the linkage.
std::vector<double> followed_rows(FollowedCoordinates followed, Vec2 place, double turn, double size) {
  using enum FollowedCoordinates;
  switch (followed) {
    case point:
      return {place.x / size, place.y / size};
    case x:
      return {place.x / size};
    case y:
      return {place.y / size};
    case angle:
      return {turn};
    case pose:
      break;
  }
  return {place.x / size, place.y / size, turn};
}

PathState target_between(const PathState& a, const PathState& b, double share) {
  PathState out;
  out.position = a.position + share * (b.position - a.position);
  out.angle = a.angle + share * (b.angle - a.angle);
  return out;
}

}  // namespace

LinkageInverse::LinkageInverse(const LinkagePlan& plan, FollowedPoint point)
    : motion(plan), plan_(plan), point_(std::move(point)), trial_(plan.inputs()), unit_(plan.inputs()) {
  LINKWRIGHT_REQUIRE(point_.drives.size() == drives_of(point_.followed),
                     "{} coordinates are followed by {} drives", drives_of(point_.followed),
                     point_.drives.size());
  for (const std::size_t k : point_.drives) {
    LINKWRIGHT_REQUIRE(k < plan.inputs(), "there is no input {} of {}", k, plan.inputs());
    scale_.push_back(plan.rotary[k] ? 1.0 : plan.size);
  }
  jacobian_.resize(point_.drives.size() * point_.drives.size());
}

PathState LinkageInverse::state() const {
  const PointMotion p = point_motion(plan_, motion, point_.body, point_.at);
  const PartState<double> body = body_state(plan_, motion, point_.body);
  return {.position = p.position,
          .velocity = p.velocity,
          .acceleration = p.acceleration,
          .angle = angle_of(body.direction),
          .speed = body.speed,
          .angular_acceleration = body.angular_acceleration};
}

bool LinkageInverse::assemble(std::span<const InputMotion> inputs) {
  for (const InputMotion& i : inputs)
    if (!std::isfinite(i.value)) return false;
  solve_position(plan_, inputs, motion);
  return motion.status == Status::done;
}

void LinkageInverse::residual(const PathState& target, std::span<double> out) const {
  const PathState now = state();
  const std::vector<double> rows =
      followed_rows(point_.followed, target.position - now.position,
                    std::remainder(target.angle - now.angle, full_turn), plan_.size);
  std::copy(rows.begin(), rows.end(), out.begin());
}

std::vector<double> LinkageInverse::velocity_rows() const {
  const PathState now = state();
  return followed_rows(point_.followed, now.velocity, now.speed, plan_.size);
}

// Column by column; leaves the velocities of the last unit rate in `motion`.
void LinkageInverse::jacobian() {
  const std::size_t n = point_.drives.size();
  for (std::size_t c = 0; c < n; ++c) {
    for (InputMotion& u : unit_) u.rate = u.acceleration = 0;
    unit_[point_.drives[c]].rate = scale_[c];
    solve_velocity(plan_, unit_, motion);
    const std::vector<double> rows = velocity_rows();
    std::copy(rows.begin(), rows.end(), jacobian_.begin() + static_cast<std::ptrdiff_t>(c * n));
  }
  determinant_ = determinant_of(jacobian_, n);
  const std::vector<double> values = math::singular_vectors(jacobian_, n).values;
  least_ = values.back();
  conditioning_ = values.front() > 0 ? values.back() / values.front() : 0;
}

Status LinkageInverse::place(const PathState& target, std::span<InputMotion> inputs) {
  const std::size_t n = point_.drives.size();
  trial_.assign(inputs.begin(), inputs.end());
  if (!assemble(trial_)) return Status::no_assembly;
  std::vector<double> off(n), next(n);
  residual(target, off);
  const auto size_of_rows = [](std::span<const double> v) {
    double sum = 0;
    for (const double x : v) sum += x * x;
    return std::sqrt(sum);
  };
  // Rounding of the place, and what is left in loops that are closed by a search.
  const double rounding = 64 * tolerance::epsilon * std::max(1.0, norm(target.position) / plan_.size) +
                          motion.closure_residual / plan_.size;
  double error = size_of_rows(off);
  for (int step = 0; step < newton_steps; ++step) {
    unit_.assign(trial_.begin(), trial_.end());
    jacobian();
    if (!std::isfinite(determinant_)) return Status::no_assembly;
    const std::vector<double> way = math::least_norm(jacobian_, n, off, 1e-14).x;
    double part = 1;
    bool better = false;
    for (int half = 0; half < newton_halvings && !better; ++half, part /= 2) {
      std::vector<InputMotion> to(trial_.begin(), trial_.end());
      for (std::size_t c = 0; c < n; ++c) to[point_.drives[c]].value += part * scale_[c] * way[c];
      if (!assemble(to)) continue;
      residual(target, next);
      if (!(size_of_rows(next) < error)) {
        if (error <= rounding) break;
        continue;
      }
      better = true;
      trial_ = std::move(to);
      off = next;
      error = size_of_rows(off);
    }
    if (!better) {  // back to the best place
      if (!assemble(trial_)) return Status::no_assembly;
      unit_.assign(trial_.begin(), trial_.end());
      jacobian();
      break;
    }
  }
  if (!(error <= rounding)) return Status::no_assembly;
  for (const std::size_t k : point_.drives) inputs[k].value = trial_[k].value;
  return Status::done;
}

Status LinkageInverse::rates(const PathState& target, std::span<InputMotion> inputs) {
  const std::size_t n = point_.drives.size();
  if (!(least_ >= singular_path)) return Status::singular;
  for (const std::size_t k : point_.drives) inputs[k].rate = inputs[k].acceleration = 0;
  const auto solve = [&](std::vector<double> wanted, const std::vector<double>& have) {
    for (std::size_t r = 0; r < n; ++r) wanted[r] -= have[r];
    return math::least_norm(jacobian_, n, wanted, 1e-14).x;
  };
  solve_velocity(plan_, inputs, motion);
  const std::vector<double> rate =
      solve(followed_rows(point_.followed, target.velocity, target.speed, plan_.size), velocity_rows());
  for (std::size_t c = 0; c < n; ++c) inputs[point_.drives[c]].rate = scale_[c] * rate[c];
  solve_velocity(plan_, inputs, motion);
  solve_acceleration(plan_, inputs, motion);
  const PathState now = state();
  const std::vector<double> acceleration =
      solve(followed_rows(point_.followed, target.acceleration, target.angular_acceleration, plan_.size),
            followed_rows(point_.followed, now.acceleration, now.angular_acceleration, plan_.size));
  for (std::size_t c = 0; c < n; ++c) inputs[point_.drives[c]].acceleration = scale_[c] * acceleration[c];
  return Status::done;
}

double LinkageInverse::distance(std::span<const InputMotion> a, std::span<const InputMotion> b) const {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    most = std::max(most, std::abs(a[k].value - b[k].value) / (plan_.rotary[k] ? 1.0 : plan_.size));
  return most;
}

namespace {

// Goes to a target at `to` from one at `from` in steps that keep the side of singular positions.
class PathFollower {
 public:
  using TargetAt = std::function<PathState(double, std::span<InputMotion>)>;

  PathFollower(const LinkagePlan& plan, const FollowedPoint& point, std::span<const InputMotion> start,
               TargetAt target)
      : inverse(plan, point), inputs(start.begin(), start.end()), target_(std::move(target)) {}

  LinkageInverse inverse;
  std::vector<InputMotion> inputs;  // at `now`
  double now = 0;

  bool begin(double at) {
    if (!parts_.empty()) restore();
    now = at;
    const PathState target = target_(at, inputs);
    if (inverse.place(target, inputs) != Status::done) return false;
    side_ = inverse.determinant();
    keep();
    return true;
  }

  // True if it arrives; else `now` is the last good place, closer to the end of what is reached than `least`.
  bool go(double to, double least) {
    double step = to - now;
    while (now < to) {
      const double next = now + step >= to ? to : now + step;
      if (step_to(next)) {
        step = 2 * step;
        continue;
      }
      step = (next - now) / 2;
      if (step < least) return false;
    }
    return true;
  }

  // A place near `now` on the same side; leaves `now`. Determinants that are nothing but rounding have no
  // side: a path may touch, or end at, a singular position.
  bool step_to(double next) {
    constexpr double touching = 1e-7;
    restore();
    std::vector<InputMotion> trial = inputs;
    const PathState target = target_(next, trial);
    if (inverse.place(target, trial) != Status::done) return false;
    if (inverse.distance(inputs, trial) > largest_step) return false;
    const double determinant = inverse.determinant();
    if (determinant * side_ < 0 && std::abs(determinant) > touching) return false;
    if (std::abs(side_) <= touching) side_ = determinant;
    inputs = std::move(trial);
    now = next;
    keep();
    return true;
  }

 private:
  // A trial that fails leaves groups without closed form, and turns, where the next search is not to start.
  void keep() {
    parts_ = inverse.motion.parts;
    turns_ = inverse.motion.loop_angles;
  }
  void restore() {
    inverse.motion.parts = parts_;
    inverse.motion.loop_angles = turns_;
  }

  TargetAt target_;
  double side_ = 0;
  std::vector<PartState<double>> parts_;
  std::vector<double> turns_;
};

// The end of what is reached, where the determinant vanishes as the root of the path that is left: by the
// parabola through its square at three places before the bracket, which is known to rounding.
double end_by_determinant(PathFollower follower, double end, double span) {
  const double step = 1e-5 * span;
  double at[3], square[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = end - (3 - k) * step;
    if (at[k] <= 0 || !follower.begin(at[k])) return end;
    square[k] = follower.inverse.determinant() * follower.inverse.determinant();
  }
  double root = 0;
  for (int k = 0; k < 3; ++k) {
    double share = at[k];
    for (int j = 0; j < 3; ++j)
      if (j != k) share *= square[j] / (square[j] - square[k]);
    root += share;
  }
  return std::isfinite(root) && std::abs(root - end) < 1e-2 * step ? root : end;
}

// Two bodies on pins that are in line with the point, in words. The point may be one of the second body, or
// of a body with a pin there, as a piston.
std::optional<std::string> bodies_in_line(const Linkage& l, const LinkagePlan& plan,
                                          const LinkageMotion& motion, const FollowedPoint& point) {
  const auto place = [&](const BodyPoint& p) { return point_motion(l, plan, motion, p).position; };
  const auto end_on = [](const LinkageJoint& j, int body) -> const BodyPoint* {
    if (j.type != JointType::revolute) return nullptr;
    return j.first.body == body ? &j.first : j.second.body == body ? &j.second : nullptr;
  };
  const auto other_of = [](const LinkageJoint& j, int body) {
    return j.first.body == body ? j.second.body : j.first.body;
  };
  const Vec2 tip = point_motion(plan, motion, point.body, point.at).position;
  std::vector<int> lasts{point.body};
  for (const LinkageJoint& j : l.joints)
    if (const BodyPoint* end = end_on(j, point.body); end && norm(place(*end) - tip) < 1e-9 * plan.size)
      lasts.push_back(other_of(j, point.body));
  for (const int last : lasts)
    for (const LinkageJoint& elbow : l.joints) {
      if (last == 0 || !end_on(elbow, last)) continue;
      const int other = other_of(elbow, last);
      for (const LinkageJoint& foot : l.joints) {
        if (&foot == &elbow || other == 0 || !end_on(foot, other) || !end_on(foot, 0)) continue;
        const Vec2 a = place(*end_on(foot, other)), b = place(*end_on(elbow, last));
        const Vec2 u = b - a, w = tip - b;
        if (norm(w) < 1e-9 * plan.size || std::abs(cross(u, w)) > 1e-3 * norm(u) * norm(w)) continue;
        return fmt::format("'{}' and '{}' are {}", l.bodies[at(other)].name, l.bodies[at(last)].name,
                           dot(u, w) > 0 ? "stretched" : "folded");
      }
    }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<InputMotion>> path_start(const LinkagePlan& plan, const FollowedPoint& point,
                                                   std::span<const InputMotion> from,
                                                   std::span<const InputMotion> to, const PathState& target) {
  LinkageInverse known(plan, point);
  solve_position(plan, from, known.motion);
  if (known.motion.status != Status::done) return std::nullopt;
  PathState first = known.state();
  first.angle = target.angle + std::remainder(first.angle - target.angle, full_turn);
  const auto follows = [&](std::size_t k) {
    return std::find(point.drives.begin(), point.drives.end(), k) != point.drives.end();
  };
  const std::vector<InputMotion> begin(from.begin(), from.end());
  PathFollower follower(plan, point, from, [&](double share, std::span<InputMotion> inputs) {
    for (std::size_t k = 0; k < inputs.size(); ++k)
      if (!follows(k)) inputs[k].value = begin[k].value + share * (to[k].value - begin[k].value);
    return target_between(first, target, share);
  });
  if (follower.begin(0) && follower.go(1, 1e-6)) return follower.inputs;
  // Straight to it: the way there may leave the reach.
  std::vector<InputMotion> inputs(from.begin(), from.end());
  for (std::size_t k = 0; k < inputs.size(); ++k)
    if (!follows(k)) inputs[k].value = to[k].value;
  LinkageInverse straight(plan, point);
  if (straight.place(target, inputs) != Status::done) return std::nullopt;
  return inputs;
}

PathDrives follow_path(const Linkage& linkage, const LinkagePlan& plan, const FollowedPoint& point,
                       const PointPathMotion& path, std::span<const std::optional<math::MotionCurve>> laws,
                       std::span<const InputMotion> start, std::span<const double> times) {
  PathDrives out;
  const auto target = [&](double time, std::span<InputMotion> inputs) {
    for (std::size_t k = 0; k < inputs.size(); ++k)
      if (laws[k]) {
        const math::Motion m = (*laws[k])(time);
        inputs[k] = {m.value, m.rate, m.acceleration};
      }
    return path(time);
  };
  PathFollower follower(plan, point, start, target);
  if (!follower.begin(0)) {
    out.status = Status::no_assembly;
    out.share = 0;
    out.last = path(0);
    out.reason = "the linkage does not reach the beginning of the path";
    return out;
  }
  const double duration = path.duration(), least = 1e-13 * duration;
  for (const double time : times) {
    if (!follower.go(std::min(time, duration), least)) {
      out.status = Status::limit_reached;
      break;
    }
    PathRow row{.time = time, .inputs = follower.inputs};
    row.singular = follower.inverse.rates(target(time, row.inputs), row.inputs) != Status::done;
    row.conditioning = follower.inverse.conditioning();
    out.rows.push_back(std::move(row));
  }
  out.end = follower.now;
  if (out.status == Status::limit_reached) {
    follower.begin(follower.now);
    const auto line = bodies_in_line(linkage, plan, follower.inverse.motion, point);
    const double determinant = std::abs(follower.inverse.determinant());
    if (line) {
      out.reason = *line;
    } else if (determinant < 1e-3) {
      out.reason = "the drives cannot move the point farther in the direction of the path";
    } else {
      out.reason = "the linkage does not assemble beyond it";
    }
    if (determinant < 1e-3) out.end = end_by_determinant(std::move(follower), out.end, duration);
  }
  out.share = path.share(out.end);
  out.last = path(out.end);
  return out;
}

}  // namespace linkwright::planar
