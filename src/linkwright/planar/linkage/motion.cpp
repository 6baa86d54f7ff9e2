// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/motion.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/detail/pair_rows.h"
#include "linkwright/planar/linkage/general.h"
#include "linkwright/planar/linkage/triangle.h"
#include "linkwright/planar/loop_gap.h"

namespace linkwright::planar {
namespace {

// By how much (m) a dyad that was placed cannot close; 0 when it does.
double gap_of(const Group& g, const Dyad& dyad, const LinkageMotion& m, const GroupState<double>& s) {
  if (s.radicand > 0) return 0;
  const math::Vec2 a = point_on(m.parts[at(g.joints[0].before.part)], g.joints[0].before.at);
  const math::Vec2 b = point_on(m.parts[at(g.joints[2].after.part)], g.joints[2].after.at);
  switch (dyad.type) {
    case DyadType::rrr:
      return loop_gap(norm(b - a), dyad.first.length, dyad.second.length);
    case DyadType::rrp: {
      const double length = dyad.first.length, away = std::sqrt(dyad.first.square - s.radicand);
      return away <= length * (1 + tolerance::closure) ? 0 : away - length;
    }
    case DyadType::rpr: {
      const double offset = std::abs(dyad.first.vector.y - dyad.second.vector.y), distance = norm(b - a);
      return distance >= offset * (1 - tolerance::closure) ? 0 : offset - distance;
    }
    case DyadType::prp:
    case DyadType::rpp:
      return 0;
  }
  return 0;
}

// The error of closure that rounding left: the inner joint seen from both parts.
double closure_of(const Group& g, const LinkageMotion& m) {
  const PlanJoint& inner = g.joints[1];
  const PartState<double>&before = m.parts[at(inner.before.part)], &after = m.parts[at(inner.after.part)];
  const math::Vec2 apart = point_on(after, inner.after.at) - point_on(before, inner.before.at);
  return inner.slide ? std::abs(cross(rotate(before.direction, inner.before.direction), apart)) : norm(apart);
}

void forget(PartState<double>& part) { part = {{nan, nan}, {nan, nan}, {nan, nan}, nan, {nan, nan}, nan}; }

// The angle of a part that loops turn, with its turns.
double counted_angle(LinkageMotion& m, int part) {
  const double now = angle_of(m.parts[at(part)].direction);
  double& last = m.loop_angles[at(part)];
  return last = std::isnan(last) ? now : now + full_turn * std::round((last - now) / full_turn);
}
// The sum of what inputs and other parts give to an angle, its speed or its acceleration.
template <class Input, class Part>
double sum_of(const DrivenAngle& angle, std::span<const InputMotion> inputs, const Input& input,
              const Part& part) {
  double sum = 0;
  for (std::size_t i = 0; i < inputs.size(); ++i) sum += angle.gains[i] * input(inputs[i]);
  for (const AngleShare& s : angle.shares) sum += s.share * part(s.part);
  return sum;
}

void place_train(const Group& g, const GearTrain& train, std::span<const InputMotion> inputs,
                 LinkageMotion& motion) {
  for (std::size_t k = 0; k < g.parts.size(); ++k) {
    const PlanJoint& j = g.joints[k];
    PartState<double>& part = motion.parts[at(g.parts[k])];
    part.direction = math::unit(train.angles[k].angle + sum_of(
                                                            train.angles[k], inputs,
                                                            [](const InputMotion& i) { return i.value; },
                                                            [&](int p) { return counted_angle(motion, p); }));
    part.origin = point_on(motion.parts[at(j.before.part)], j.before.at) - rotate(part.direction, j.after.at);
  }
}
void train_velocity(const Group& g, const GearTrain& train, std::span<const InputMotion> inputs,
                    LinkageMotion& motion) {
  for (std::size_t k = 0; k < g.parts.size(); ++k) {
    const PlanJoint& j = g.joints[k];
    const PartState<double>& base = motion.parts[at(j.before.part)];
    PartState<double>& part = motion.parts[at(g.parts[k])];
    part.speed = sum_of(
        train.angles[k], inputs, [](const InputMotion& i) { return i.rate; },
        [&](int p) { return motion.parts[at(p)].speed; });
    const math::Vec2 pin = point_on(base, j.before.at);
    part.velocity = velocity_at(base, pin) - part.speed * perpendicular(pin - part.origin);
  }
}
void train_acceleration(const Group& g, const GearTrain& train, std::span<const InputMotion> inputs,
                        LinkageMotion& motion) {
  for (std::size_t k = 0; k < g.parts.size(); ++k) {
    const PlanJoint& j = g.joints[k];
    const PartState<double>& base = motion.parts[at(j.before.part)];
    PartState<double>& part = motion.parts[at(g.parts[k])];
    part.angular_acceleration = sum_of(
        train.angles[k], inputs, [](const InputMotion& i) { return i.acceleration; },
        [&](int p) { return motion.parts[at(p)].angular_acceleration; });
    const math::Vec2 pin = point_on(base, j.before.at), arm = pin - part.origin;
    part.acceleration = acceleration_at(base, pin) - part.angular_acceleration * perpendicular(arm) +
                        (part.speed * part.speed) * arm;
  }
}

// A part on one joint, whose angle or displacement its pair determines by an equation that is linear in it.
void place_follower(const LinkagePlan& plan, const Group& g, std::span<const InputMotion> inputs,
                    LinkageMotion& motion) {
  const PlanJoint& j = g.joints[0];
  const PlanPair& pair = g.pairs[0];
  const PartState<double>& base = motion.parts[at(j.before.part)];
  PartState<double>& part = motion.parts[at(g.parts[0])];
  for (const int p : parts_of(pair))
    if (p != g.parts[0] && !(plan.turned[at(p)] && plan.turned[at(p)]->shares.empty()))
      counted_angle(motion, p);
  const math::Vec2 pin = point_on(base, j.before.at), along = rotate(base.direction, j.before.direction);
  part.direction = j.slide ? rotate(along, conjugate(j.after.direction)) : math::Vec2{1, 0};
  part.origin = pin - rotate(part.direction, j.after.at);
  const PairRow row = pair_row(pair, motion.parts, [&](int p) {
    if (p == g.parts[0] && !j.slide) return 0.0;
    return pair_angle(plan, inputs, motion.parts, motion.loop_angles, p);
  });
  const PairShare& share = *std::find_if(row.shares.begin(), row.shares.end(),
                                         [&](const PairShare& s) { return s.part == g.parts[0]; });
  if (j.slide) {
    part.origin = part.origin - (row.residual / dot(share.force, along)) * along;
  } else {
    part.direction = math::unit(-row.residual / share.turning);
    part.origin = pin - rotate(part.direction, j.after.at);
  }
}

void require_inputs(const LinkagePlan& plan, std::span<const InputMotion> inputs) {
  LINKWRIGHT_REQUIRE(inputs.size() == plan.inputs(), "the linkage has {} inputs, got {}", plan.inputs(),
                     inputs.size());
  for (const InputMotion& i : inputs)
    LINKWRIGHT_REQUIRE(std::isfinite(i.value + i.rate + i.acceleration),
                       "input {} with rate {} and acceleration {} must be finite", i.value, i.rate,
                       i.acceleration);
}

// Groups that are solved: all, or those before the one that failed.
std::size_t solved(const LinkagePlan& plan, const LinkageMotion& motion) {
  return motion.failed_group < 0 ? plan.groups.size() : at(motion.failed_group);
}

}  // namespace

LinkageMotion::LinkageMotion(const LinkagePlan& plan)
    : parts(plan.parts.size()),
      groups(plan.groups.size()),
      twists(plan.twists.size(), nan),
      loop_angles(plan.parts.size(), nan) {
  parts[0] = {{0, 0}, {1, 0}, {0, 0}, 0, {0, 0}, 0};
  for (const Group& g : plan.groups) {
    modes.push_back(g.mode);
    if (const GeneralGroup* general_group = g.as<GeneralGroup>())
      for (std::size_t i = 0; i < g.parts.size(); ++i) {
        const math::Pose pose = general_group->start.empty() ? math::Pose{} : general_group->start[i];
        parts[at(g.parts[i])].origin = {pose.x, pose.y};
        parts[at(g.parts[i])].direction = math::unit(pose.angle);
      }
    general.push_back(traits_of(g).has_matrix ? general_group_memory(plan, g) : GeneralGroupPointer());
  }
}

void mark_failed(const LinkagePlan& plan, LinkageMotion& motion, std::size_t group, Status status) {
  motion.status = status;
  motion.failed_group = static_cast<int>(group);
  // General groups keep their place: the next search starts from it. A group at a dead point has its place,
  // too, but no rates.
  for (std::size_t g = group; g < plan.groups.size(); ++g) {
    const bool keeps = !traits_of(plan.groups[g]).closed_form || (status == Status::singular && g == group);
    for (int p : plan.groups[g].parts) {
      PartState<double>& part = motion.parts[at(p)];
      const math::Vec2 origin = part.origin, direction = part.direction;
      forget(part);
      if (keeps) part.origin = origin, part.direction = direction;
    }
  }
}

PartState<double> body_state(const LinkagePlan& plan, const LinkageMotion& motion, int body) {
  const BodyOnPart& on = plan.bodies[at(body)];
  PartState<double> s = motion.parts[at(on.part)];
  if (on.same_frame) return s;
  const math::Vec2 origin = point_on(s, on.origin);
  s.velocity = velocity_at(s, origin);
  s.acceleration = acceleration_at(s, origin);
  s.direction = rotate(s.direction, on.turn);
  s.origin = origin;
  return s;
}

PointMotion point_motion(const LinkagePlan& plan, const LinkageMotion& motion, int body,
                         std::complex<double> there) {
  const PartState<double> s = body_state(plan, motion, body);
  const math::Vec2 p = point_on(s, math::vec(there));
  return {p, velocity_at(s, p), acceleration_at(s, p)};
}

PointMotion point_motion(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                         const BodyPoint& point) {
  return point_motion(plan, motion, point.body, place_of(linkage, point));
}

PointMotion point_motion(const Linkage& linkage, const LinkagePlan& plan, const LinkageMotion& motion,
                         std::string_view point) {
  return point_motion(linkage, plan, motion, point_named(linkage, point));
}

void solve_position(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion) {
  require_inputs(plan, inputs);
  motion.status = Status::done;
  motion.failed_group = -1;
  motion.gap = motion.closure_residual = 0;
  PartState<double>* parts = motion.parts.data();
  for (std::size_t k = 0; k < plan.groups.size(); ++k) {
    const Group& g = plan.groups[k];
    GroupState<double>& state = motion.groups[k];
    const Status status = by_kind(
        g,
        [&](const Driver&) {
          place_driver(g, inputs[at(g.joints[0].input)].value, parts);
          return Status::done;
        },
        [&](const GearTrain& train) {
          place_train(g, train, inputs, motion);
          return Status::done;
        },
        [&](const Follower&) {
          place_follower(plan, g, inputs, motion);
          // One step of Newton's method makes the matrix for the rates.
          return place_general(plan, g, inputs, motion, *motion.general[k]);
        },
        [&](const Dyad& dyad) {
          for_dyad(dyad.type, [&](auto type) { place_dyad(type, g, dyad, motion.modes[k], parts, state); });
          if ((motion.gap = gap_of(g, dyad, motion, state)) > 0) return Status::no_assembly;
          if (!(std::abs(state.sine) >= tolerance::toggle_angle)) return Status::singular;
          motion.closure_residual = std::max(motion.closure_residual, closure_of(g, motion));
          return Status::done;
        },
        [&](const Triangle& triangle) {
          const double value = inputs[at(g.joints[1].input)].value;
          place_triangle(g, triangle, value, motion.modes[k], motion.parts, state);
          if (!(state.radicand > 0) && (motion.gap = triangle_gap(g, triangle, value, motion.parts)) > 0)
            return Status::no_assembly;
          if (!(std::abs(state.sine) >= tolerance::toggle_angle)) return Status::singular;
          // One step of Newton's method makes the matrix for the rates.
          return place_general(plan, g, inputs, motion, *motion.general[k]);
        },
        [&](const GeneralGroup&) {
          const Status placed = place_general(plan, g, inputs, motion, *motion.general[k]);
          state.sine = determinant_sign(*motion.general[k]) * conditioning(*motion.general[k]);
          return placed;
        });
    if (status != Status::done) return mark_failed(plan, motion, k, status);
  }
  if (!plan.twists.empty()) count_turns(plan, inputs, motion);
}

void count_turns(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion) {
  for (std::size_t k = 0; k < plan.twists.size(); ++k) {
    const PlanTwist& t = plan.twists[k];
    if (t.counted) {
      motion.twists[k] = t.angle;
      for (std::size_t i = 0; i < t.gains.size(); ++i) motion.twists[k] += t.gains[i] * inputs[i].value;
      continue;
    }
    const math::Vec2 &a = motion.parts[at(t.first)].direction, &b = motion.parts[at(t.second)].direction;
    const double now = angle_of(rotate_inverse(a, rotate(b, t.turn)));
    if (std::isnan(now)) continue;
    const double last =
        std::isnan(motion.twists[k]) ? t.free - full_turn * std::round(t.free / full_turn) : motion.twists[k];
    motion.twists[k] = now + full_turn * std::round((last - now) / full_turn);
  }
}

void solve_velocity(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion) {
  for (std::size_t k = 0; k < solved(plan, motion); ++k) {
    const Group& g = plan.groups[k];
    const auto by_matrix = [&] { general_velocity(plan, g, inputs, motion, *motion.general[k]); };
    by_kind(
        g, [&](const Driver&) { drive_velocity(g, inputs[at(g.joints[0].input)].rate, motion.parts.data()); },
        [&](const GearTrain& train) { train_velocity(g, train, inputs, motion); },
        [&](const Follower&) { by_matrix(); },
        [&](const Dyad& dyad) {
          for_dyad(dyad.type,
                   [&](auto type) { dyad_velocity(type, g, motion.parts.data(), motion.groups[k]); });
        },
        [&](const Triangle&) { by_matrix(); }, [&](const GeneralGroup&) { by_matrix(); });
  }
}

void solve_acceleration(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion) {
  for (std::size_t k = 0; k < solved(plan, motion); ++k) {
    const Group& g = plan.groups[k];
    const auto by_matrix = [&] { general_acceleration(plan, g, inputs, motion, *motion.general[k]); };
    by_kind(
        g,
        [&](const Driver&) {
          const InputMotion& i = inputs[at(g.joints[0].input)];
          drive_acceleration(g, i.rate, i.acceleration, motion.parts.data());
        },
        [&](const GearTrain& train) { train_acceleration(g, train, inputs, motion); },
        [&](const Follower&) { by_matrix(); },
        [&](const Dyad& dyad) {
          for_dyad(dyad.type,
                   [&](auto type) { dyad_acceleration(type, g, motion.parts.data(), motion.groups[k]); });
        },
        [&](const Triangle&) { by_matrix(); }, [&](const GeneralGroup&) { by_matrix(); });
  }
}

void solve_motion(const LinkagePlan& plan, std::span<const InputMotion> inputs, LinkageMotion& motion) {
  solve_position(plan, inputs, motion);
  solve_velocity(plan, inputs, motion);
  solve_acceleration(plan, inputs, motion);
}

}  // namespace linkwright::planar
