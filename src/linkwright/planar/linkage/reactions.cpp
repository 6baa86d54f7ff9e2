// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/detail/load_formula.h"
#include "linkwright/planar/linkage/detail/pair_rows.h"
#include "linkwright/planar/linkage/friction.h"
#include "linkwright/planar/linkage/general.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/stop.h"
#include "linkwright/planar/linkage/strut.h"

namespace linkwright::planar {

double factor_at(const LoadFactor& f, double argument, bool turns) {
  if (const double period = period_of(f, turns); period > 0)
    argument -= period * std::floor((argument - f.argument.front()) / period);
  const auto above = std::upper_bound(f.argument.begin(), f.argument.end(), argument);
  if (above == f.argument.begin()) return f.factor.front();
  if (above == f.argument.end()) return f.factor.back();
  const auto i = static_cast<std::size_t>(above - f.argument.begin());
  const double share = (argument - f.argument[i - 1]) / (f.argument[i] - f.argument[i - 1]);
  return f.factor[i - 1] + share * (f.factor[i] - f.factor[i - 1]);
}

namespace {

double strength(const LoadFactor& f, bool turns, double time, double input, const math::Vec2& point,
                double speed) {
  switch (f.against) {
    case LoadArgument::constant:
      return 1;
    case LoadArgument::input:
      return factor_at(f, input, turns);
    case LoadArgument::time:
      return factor_at(f, time, turns);
    case LoadArgument::x:
      return factor_at(f, point.x, turns);
    case LoadArgument::y:
      return factor_at(f, point.y, turns);
    case LoadArgument::speed:
      return factor_at(f, speed, turns);
    case LoadArgument::length:
      break;  // of struts
  }
  return 1;
}

const PartState<double>& part_of(const LinkagePlan& plan, const LinkageMotion& motion, int body) {
  return motion.parts[at(plan.bodies[at(body)].part)];
}

// The wrench w about `about` that a plan joint puts on its part after, as the model's reaction.
void report(const PlanJoint& j, const LinkageMotion& motion, const Wrench<double>& w, const math::Vec2& about,
            LinkageForces& f) {
  if (j.joint < 0) return;
  JointReaction& r = f.joints[at(j.joint)];
  const PartPoint& second = j.reversed ? j.before : j.after;
  r.point = point_on(motion.parts[at(second.part)], second.at);
  const Wrench<double> there = shifted(w, about - r.point);
  const double side = j.reversed ? -1 : 1;
  r.force = side * there.force;
  r.moment = side * there.moment;
}

double along_drive(const PlanJoint& j, const LinkageMotion& motion, const Wrench<double>& w) {
  const double side = j.reversed ? -1 : 1;
  if (!j.slide) return side * w.moment;
  return side * dot(rotate(motion.parts[at(j.before.part)].direction, j.before.direction), w.force);
}

// From the pairs of the plan to the joints of the model.
void divide_shared_pins(const LinkagePlan& plan, LinkageForces& f) {
  for (const SharedPin& pin : plan.shared_pins) {
    for (std::size_t k = 0; k < pin.joints.size(); ++k)
      f.group_joints[k].force = f.joints[at(pin.joints[k])].force;
    for (std::size_t i = 0; i < pin.joints.size(); ++i) {
      math::Vec2 sum{0, 0};
      for (std::size_t k = 0; k < pin.joints.size(); ++k)
        sum = sum + pin.share[i][k] * f.group_joints[k].force;
      f.joints[at(pin.joints[i])].force = sum;
    }
  }
}

// A load on a part makes it need less.
void take(const LinkageMotion& motion, LinkageForces& f, int part, const Wrench<double>& load,
          const math::Vec2& point) {
  Wrench<double>& n = f.needed[at(part)];
  n = n - shifted(load, point - motion.parts[at(part)].origin);
}

// One pass over the groups, last first, with what the parts need.
void pass_groups(const LinkagePlan& plan, const LinkageMotion& motion, LinkageForces& f) {
  for (std::size_t k = plan.groups.size(); k-- > 0;) {
    const Group& g = plan.groups[k];
    const PlanJoint& j = g.joints[0];
    const auto by_matrix = [&] {
      const std::span<Wrench<double>> joints(f.group_joints.data(), g.joints.size());
      general_forces(plan, g, motion, *motion.general[k], f.needed, joints, f.group_drives, f.group_gears);
      const auto keep = [&](int joint, int strand, const JointReaction& load) {
        (joint >= 0 ? f.joints[at(joint)] : f.strands[at(strand)]) = load;
      };
      const auto keep_pair = [&](const PlanPair& pair, const JointReaction& load) {
        if (pair.cam >= 0)
          f.cam_efforts[at(pair.cam)] = load.moment;
        else
          keep(pair.joint, pair.strand, load);
      };
      for (std::size_t i = 0; i < g.gears.size(); ++i)
        keep(g.gears[i].joint, g.gears[i].strand, f.group_gears[i]);
      for (std::size_t i = 0; i < g.pairs.size(); ++i)
        keep_pair(g.pairs[i], f.group_gears[g.gears.size() + i]);
      for (std::size_t i = 0; i < g.joints.size(); ++i) {
        const PlanJoint& here = g.joints[i];
        report(here, motion, joints[i], point_on(motion.parts[at(here.after.part)], here.after.at), f);
        if (here.input >= 0) f.drives[at(here.input)] = along_drive(here, motion, joints[i]);
      }
    };
    by_kind(
        g,
        [&](const Driver&) {
          const Wrench<double> w = driver_force(g, motion.parts.data(), f.needed.data());
          report(j, motion, w, point_on(motion.parts[at(j.after.part)], j.after.at), f);
          f.drives[at(j.input)] = along_drive(j, motion, w);
        },
        [&](const GearTrain&) { by_matrix(); }, [&](const Follower&) { by_matrix(); },
        [&](const Dyad& dyad) {
          const GroupState<double>& s = motion.groups[k];
          for_dyad(dyad.type, [&](auto type) {
            dyad_forces(type, g, motion.parts.data(), s, f.needed.data(), f.group_joints.data());
          });
          for (std::size_t i = 0; i < 3; ++i) report(g.joints[i], motion, f.group_joints[i], s.reference, f);
        },
        [&](const Triangle&) { by_matrix(); }, [&](const GeneralGroup&) { by_matrix(); });
  }
  divide_shared_pins(plan, f);
}

// A pass with masses, the loads as they are, preloads and the contacts of cams.
void pass(const LinkagePlan& plan, const Linkage& linkage, const LinkageMotion& motion, LinkageForces& f) {
  const math::Vec2 gravity = math::vec(linkage.gravity);
  for (std::size_t p = 0; p < plan.parts.size(); ++p)
    f.needed[p] = needed_wrench(plan.masses[p], motion.parts[p], gravity);
  for (const AppliedLoad& load : f.loads)
    take(motion, f, plan.bodies[at(load.body)].part, {load.force, load.torque}, load.point);
  for (const PlanStrand& strand : plan.strands) {
    if (!strand.preloaded) continue;
    const StrandLine line = strand_line(strand.run, motion.parts);
    const math::Vec2 pull = f.preload[at(strand.belt)] * line.along;
    take(motion, f, strand.run.first.part, {pull, 0}, line.first);
    take(motion, f, strand.run.second.part, {-pull, 0}, line.second);
  }
  for (std::size_t k = 0; k < plan.cams.size(); ++k) {
    const CamContact& contact = f.cams[k];
    if (contact.force == 0) continue;
    const math::Vec2 push = contact.force * contact.normal;
    take(motion, f, plan.cams[k].contact.part, {push, 0}, contact.point);
    take(motion, f, plan.cams[k].cam.part, {-push, 0}, contact.point);
  }
  pass_groups(plan, motion, f);
}

// The effort on the joint that a cam moves by a load on its follower alone.
double effort_of(const LinkagePlan& plan, std::size_t cam, const LinkageMotion& motion,
                 const Wrench<double>& load, const math::Vec2& point, LinkageForces& f) {
  std::fill(f.needed.begin(), f.needed.end(), Wrench<double>{{0, 0}, 0});
  take(motion, f, plan.cams[cam].contact.part, load, point);
  pass_groups(plan, motion, f);
  return -f.cam_efforts[cam];
}

// How the contact part of a cam's follower moves by unit of the coordinate of its joint, at its point.
struct Travel {
  math::Vec2 velocity{0, 0};
  double turning = 0;
};
Travel travel_of(const LinkagePlan& plan, std::size_t cam, const LinkageMotion& motion,
                 const math::Vec2& point, LinkageForces& f) {
  const CamPair& c = plan.cams[cam];
  const bool is_second = c.contact.part == c.moved_second.part;
  const double side = is_second ? 1 : -1;
  // The moved body, if the other body of its joint carries the cam.
  if ((is_second ? c.moved_first : c.moved_second).part == c.base.part &&
      (is_second || c.contact.part == c.moved_first.part)) {
    const PartState<double>& base = motion.parts[at(c.moved_first.part)];
    if (c.slide) return {side * rotate(base.direction, c.moved_first.direction), 0};
    return {side * perpendicular(point - point_on(base, c.moved_first.at)), side};
  }
  // Else by virtual work: a load on it does the work of its effort at the joint.
  const auto effort = [&](const Wrench<double>& load) {
    return effort_of(plan, cam, motion, load, point, f);
  };
  return {{effort({{1, 0}, 0}), effort({{0, 1}, 0})}, c.is_flat ? effort({{0, 0}, 1}) : 0};
}

// Where a cam touches its follower at a point with a roller, without its force: the normal is that of the
// path of the follower in the frame of the cam.
CamContact contact_at(const LinkagePlan& plan, std::size_t k, const LinkageMotion& motion,
                      const PartPoint& touching, double roller, LinkageForces& f) {
  const CamPair& c = plan.cams[k];
  CamContact contact;
  const PartState<double>& body = motion.parts[at(touching.part)];
  const double angle = cam_angle(c, [&](int part) { return angle_of(motion.parts[at(part)].direction); });
  const double rate = programme_at(c, angle).rate;
  const math::Vec2 point = point_on(body, touching.at),
                   way = point - point_on(motion.parts[at(c.base.part)], c.base.at);
  const Travel travel = travel_of(plan, k, motion, point, f);
  // By radian of the cam, seen from it.
  const math::Vec2 path = rate * travel.velocity - c.sense * perpendicular(way);
  math::Vec2 moved = travel.velocity;
  if (c.is_flat) {
    const math::Vec2 along = rotate(body.direction, touching.direction), across = perpendicular(along);
    contact.normal = dot(across, way) < 0 ? -across : across;
    const double place = -dot(across, path) / (rate * travel.turning - c.sense);
    contact.point = point + place * along;
    moved = moved + travel.turning * place * across;
  } else {
    contact.normal = c.sense / norm(path) * perpendicular(path);
    contact.point = point - roller * contact.normal;
  }
  contact.lever = dot(contact.normal, moved);
  // The programme may count against the sense in which the cam pushes.
  if (contact.lever < 0) moved = -moved;
  contact.pressure_angle = c.sense * angle_of(rotate_inverse(moved, contact.normal));
  return contact;
}

void find_contacts(const LinkagePlan& plan, const LinkageMotion& motion, LinkageForces& f) {
  f.cams.assign(plan.cams.size(), {});
  f.cam_efforts.resize(plan.cams.size());
  for (std::size_t k = 0; k < plan.cams.size(); ++k)
    f.cams[k] = contact_at(plan, k, motion, plan.cams[k].contact, plan.cams[k].roller, f);
}

// The contact with the other disc of a conjugate cam, which carries where the present one would have to pull.
CamContact other_contact(const LinkagePlan& plan, std::size_t k, const LinkageMotion& motion,
                         const CamContact& now, LinkageForces& f) {
  const CamPair& c = plan.cams[k];
  const double effort = now.force * now.lever;
  CamContact out = now.on_second ? contact_at(plan, k, motion, c.contact, c.roller, f)
                                 : contact_at(plan, k, motion, c.second_contact, c.second_roller, f);
  out.on_second = !now.on_second;
  out.force = effort / out.lever;
  return out;
}

// The strands of a belt whose mean tension is given: those without equation take the mean of the others with
// the opposite sign, and the preload is what is then missing.
bool find_preloads(const Linkage& l, const LinkagePlan& plan, LinkageForces& f) {
  bool any = false;
  for (std::size_t b = 0; b < l.belts.size(); ++b) {
    double sum = 0;
    int count = 0;
    for (std::size_t s = 0; s < plan.strands.size(); ++s)
      if (plan.strands[s].preloaded && plan.strands[s].belt == static_cast<int>(b))
        sum += f.strands[s].tangential, ++count;
    if (count == 0) continue;
    any = true;
    f.preload[b] = l.belts[b].tension.value_or(0) - sum / count;
  }
  return any;
}
void add_preloads(const LinkagePlan& plan, const LinkageMotion& motion, LinkageForces& f) {
  for (std::size_t s = 0; s < plan.strands.size(); ++s) {
    const PlanStrand& strand = plan.strands[s];
    if (!strand.preloaded) continue;
    const StrandLine line = strand_line(strand.run, motion.parts);
    const double tension = f.strands[s].tangential + f.preload[at(strand.belt)];
    f.strands[s] = {line.second, -tension * line.along, 0, tension, 0};
  }
}

// A weld carries what the bodies on the side of its second body need beyond their other joints and loads.
void weld_forces(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, LinkageForces& f) {
  const std::size_t n = l.bodies.size();
  std::vector<Wrench<double>> needs(n, {{0, 0}, 0});  // about the global origin
  for (std::size_t b = 1; b < n; ++b) {
    const PartState<double> s = body_state(plan, motion, static_cast<int>(b));
    PartMass m;
    const auto add = [&](double mass, double inertia, const math::Vec2& c) {
      m.mass += mass;
      m.moment = m.moment + mass * c;
      m.inertia += inertia + mass * dot(c, c);
    };
    if (l.bodies[b].mass)
      add(l.bodies[b].mass->mass, l.bodies[b].mass->inertia, math::vec(l.bodies[b].mass->centre));
    for (const AttachedMass& a : l.bodies[b].attached) add(a.mass, 0, math::vec(a.at));
    needs[b] = shifted(needed_wrench(m, s, math::vec(l.gravity)), s.origin);
  }
  const auto take = [&](int body, const Wrench<double>& w, const math::Vec2& point) {
    needs[at(body)] = needs[at(body)] - shifted(w, point);
  };
  for (const AppliedLoad& load : f.loads) take(load.body, {load.force, load.torque}, load.point);
  for (std::size_t k = 0; k < l.joints.size(); ++k) {
    const LinkageJoint& j = l.joints[k];
    const JointReaction& r = f.joints[k];
    if (j.type == JointType::fixed || std::isnan(r.moment)) continue;
    if (j.type == JointType::rack || (j.type == JointType::gear && std::isfinite(r.tangential))) {
      take(j.second.body, {r.force, 0}, r.point);
      take(j.first.body, {-r.force, 0}, r.point);
    } else if (j.type == JointType::gear) {
      take(j.second.body, {{0, 0}, r.moment}, r.point);
      take(j.first.body, {{0, 0}, -j.ratio * r.moment}, r.point);
      take(j.carrier, {{0, 0}, -(1 - j.ratio) * r.moment}, r.point);
    } else {
      take(j.second.body, {r.force, r.moment}, r.point);
      take(j.first.body, {-r.force, -r.moment}, r.point);
    }
  }
  for (std::size_t s = 0; s < plan.strands.size(); ++s) {
    const JointReaction& r = f.strands[s];
    take(plan.strands[s].second, {r.force, 0}, r.point);
    take(plan.strands[s].first, {-r.force, 0}, r.point);
  }
  for (std::size_t c = 0; c < l.cams.size(); ++c) {
    const math::Vec2 push = f.cams[c].force * f.cams[c].normal;
    take(l.cams[c].contact.body, {push, 0}, f.cams[c].point);
    take(plan.cams[c].cam_body, {-push, 0}, f.cams[c].point);
  }
  for (std::size_t k = 0; k < l.joints.size(); ++k) {
    const LinkageJoint& weld = l.joints[k];
    if (weld.type != JointType::fixed) continue;
    // Bodies on the second side: reached over welds other than this one.
    std::vector<int> side{weld.second.body};
    Wrench<double> sum{{0, 0}, 0};
    bool ground = false;
    for (std::size_t i = 0; i < side.size(); ++i) {
      sum = sum + needs[at(side[i])];
      ground = ground || side[i] == 0;
      for (std::size_t o = 0; o < l.joints.size(); ++o) {
        const LinkageJoint& j = l.joints[o];
        if (o == k || j.type != JointType::fixed) continue;
        for (const auto& [here, there] :
             {std::pair{j.first.body, j.second.body}, std::pair{j.second.body, j.first.body}})
          if (here == side[i] && std::find(side.begin(), side.end(), there) == side.end())
            side.push_back(there);
      }
    }
    if (ground) {  // the other side is the one whose needs are known
      sum = {{0, 0}, 0};
      for (std::size_t b = 1; b < n; ++b)
        if (plan.bodies[b].part == plan.bodies[at(weld.second.body)].part &&
            std::find(side.begin(), side.end(), static_cast<int>(b)) == side.end())
          sum = sum - needs[b];
    }
    JointReaction& r = f.joints[k];
    r.point = point_motion(l, plan, motion, weld.second).position;
    const Wrench<double> w = shifted(sum, -r.point);
    r.force = w.force;
    r.moment = w.moment;
  }
}

void powers(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, LinkageForces& f) {
  const math::Vec2 gravity = math::vec(l.gravity);
  f.kinetic_power = f.weight_power = f.load_power = f.drive_power = 0;
  for (std::size_t p = 1; p < plan.parts.size(); ++p) {
    const PartState<double>& s = motion.parts[p];
    const Wrench<double> w = needed_wrench(plan.masses[p], s, math::Vec2{0, 0});
    f.kinetic_power += dot(w.force, s.velocity) + w.moment * s.speed;
    const math::Vec2 arm = rotate(s.direction, plan.masses[p].moment);
    f.weight_power += plan.masses[p].mass * dot(gravity, s.velocity) + cross(arm, gravity) * s.speed;
  }
  for (const AppliedLoad& load : f.loads) {
    const PartState<double>& s = part_of(plan, motion, load.body);
    f.load_power += dot(load.force, velocity_at(s, load.point)) + load.torque * s.speed;
  }
  for (std::size_t i = 0; i < l.driven.size(); ++i) {
    const LinkageJoint& j = l.joints[at(l.driven[i])];
    const PartState<double>&first = part_of(plan, motion, j.first.body),
          &second = part_of(plan, motion, j.second.body);
    double rate = second.speed - first.speed;
    if (j.type == JointType::prismatic) {
      const math::Vec2 along =
          rotate(body_state(plan, motion, j.first.body).direction, math::unit(j.slide_first));
      const math::Vec2 point = point_motion(l, plan, motion, j.second).position;
      rate = dot(along, velocity_at(second, point) - velocity_at(first, point));
    }
    f.drive_power += f.drives[i] * rate;
  }
}

void nothing(LinkageForces& f) {
  for (JointReaction& r : f.joints) r = {{nan, nan}, {nan, nan}, nan};
  for (JointReaction& r : f.strands) r = {{nan, nan}, {nan, nan}, nan, nan, nan};
  for (CamContact& c : f.cams) c = {{nan, nan}, {nan, nan}, nan, nan, nan};
  std::fill(f.drives.begin(), f.drives.end(), nan);
  f.shaking_force = {nan, nan};
  f.shaking_moment = f.shaking_moment_with_drive = nan;
  f.drive_power = f.load_power = f.weight_power = f.kinetic_power = nan;
}

}  // namespace

void applied_loads(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                   double input, std::vector<AppliedLoad>& loads) {
  for (const LinearSpring& s : l.springs) {
    const PointMotion a = point_motion(l, plan, motion, s.first), b = point_motion(l, plan, motion, s.second);
    const math::Vec2 way = b.position - a.position;
    const double length = norm(way);
    // Without a length there is no direction: as if at rest length.
    const math::Vec2 along = length > 0 ? (1 / length) * way : math::Vec2{0, 0};
    const double pull =
        s.stiffness * (length - s.free_length) + s.damping * dot(along, b.velocity - a.velocity);
    loads.push_back({s.first.body, a.position, pull * along, 0});
    loads.push_back({s.second.body, b.position, -pull * along, 0});
  }
  for (const TorsionSpring& s : l.torsion_springs) {
    const PartState<double> a = body_state(plan, motion, s.first), b = body_state(plan, motion, s.second);
    const double twist =
        motion.twists[static_cast<std::size_t>(&s - l.torsion_springs.data())] - s.free_angle;
    const double torque = -s.stiffness * twist - s.damping * (b.speed - a.speed);
    loads.push_back({s.second, b.origin, {0, 0}, torque});
    loads.push_back({s.first, a.origin, {0, 0}, -torque});
  }
  const bool turns = !plan.rotary.empty() && plan.rotary[0];
  for (const PointForce& p : l.forces) {
    const math::Vec2 there = point_motion(l, plan, motion, p.point).position;
    math::Vec2 force{0, 0};
    if (p.formula) {
      const std::array<double, 2> values = values_of(*p.formula, l, plan, motion, time);
      force = {values[0], values[1]};
    } else {
      force = strength(p.factor, turns, time, input, there, 0) * math::vec(p.force);
    }
    if (p.turns_with_body) force = rotate(body_state(plan, motion, p.point.body).direction, force);
    loads.push_back({p.point.body, there, force, 0});
  }
  for (const BodyTorque& t : l.torques) {
    const double speed = part_of(plan, motion, t.body).speed - part_of(plan, motion, t.from).speed;
    const double torque = t.formula ? values_of(*t.formula, l, plan, motion, time)[0]
                                    : t.torque * strength(t.factor, turns, time, input, {0, 0}, speed);
    loads.push_back({t.body, part_of(plan, motion, t.body).origin, {0, 0}, torque});
    loads.push_back({t.from, part_of(plan, motion, t.from).origin, {0, 0}, -torque});
  }
  for (const Strut& s : l.struts) {
    const Span span = span_of(l, plan, motion, s.first, s.second);
    const double push = push_of(s, l, plan, motion, span, time, input);
    loads.push_back({s.first.body, span.first, -push * span.along, 0});
    loads.push_back({s.second.body, span.second, push * span.along, 0});
  }
  for (std::size_t k = 0; k < l.stops.size(); ++k) add_stop_loads(l, plan, motion, k, loads);
}

const JointReaction& joint_reaction(const Linkage& linkage, const LinkageForces& forces,
                                    std::string_view joint) {
  const int found = joint_index(linkage, joint);
  LINKWRIGHT_REQUIRE(found >= 0, "the linkage has no joint '{}'", joint);
  return forces.joints[at(found)];
}

void solve_forces(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                  double input, LinkageForces& f, const FreeAccelerations& answer, FrictionStates* states) {
  LINKWRIGHT_REQUIRE(plan.has_masses, "forces need the mass of every body: '{}' has none", plan.massless[0]);
  f.status = motion.status;
  f.joints.resize(l.joints.size());
  f.drives.resize(plan.inputs());
  f.needed.resize(plan.parts.size());
  std::size_t most = 3;
  std::size_t gears = 0;
  for (const Group& g : plan.groups)
    most = std::max(most, g.joints.size()), gears = std::max(gears, g.gears.size() + g.pairs.size());
  for (const SharedPin& pin : plan.shared_pins) most = std::max(most, pin.joints.size());
  f.group_joints.resize(most);
  f.group_drives.resize(most);
  f.group_gears.resize(gears);
  for (const int j : plan.redundant_gears) f.joints[at(j)] = {{nan, nan}, {0, 0}, nan, nan, nan};
  f.strands.assign(plan.strands.size(), {});
  f.cams.assign(plan.cams.size(), {});
  f.preload.assign(l.belts.size(), 0.0);
  f.loads.clear();
  f.iterations = 0;
  if (motion.status != Status::done) return nothing(f);
  if (load_without_value(l, plan, motion, time)) {
    f.status = Status::limit_reached;
    return nothing(f);
  }
  applied_loads(l, plan, motion, time, input, f.loads);
  find_contacts(plan, motion, f);
  const auto pass_with_contacts = [&] {
    for (CamContact& contact : f.cams) contact.force = 0;
    pass(plan, l, motion, f);
    if (f.cams.empty()) return;
    // A contact does the work of the programme that it takes the place of.
    for (std::size_t k = 0; k < f.cams.size(); ++k) f.cams[k].force = f.cam_efforts[k] / f.cams[k].lever;
    for (std::size_t k = 0; k < f.cams.size(); ++k)
      if (plan.cams[k].second_roller > 0 && f.cams[k].force < 0)
        f.cams[k] = other_contact(plan, k, motion, f.cams[k], f);
    pass(plan, l, motion, f);
  };
  const auto balance = [&] {
    pass_with_contacts();
    if (find_preloads(l, plan, f)) pass_with_contacts();
    if (!answer) return;
    answer(f.drives);
    pass_with_contacts();
  };
  balance();
  if (std::any_of(l.joints.begin(), l.joints.end(), loses_power)) {
    f.status = settle_friction(l, plan, motion, balance, f, states);
    if (f.status != Status::done) return nothing(f);
  }
  add_preloads(plan, motion, f);
  f.shaking_force = -f.needed[0].force;
  f.shaking_moment_with_drive = -f.needed[0].moment - cross(math::vec(l.moment_centre), f.shaking_force);
  f.shaking_moment = f.shaking_moment_with_drive;
  for (std::size_t i = 0; i < l.driven.size(); ++i) {
    const LinkageJoint& j = l.joints[at(l.driven[i])];
    if (j.type != JointType::revolute) continue;
    if (plan.bodies[at(j.first.body)].part == 0) f.shaking_moment += f.drives[i];
    if (plan.bodies[at(j.second.body)].part == 0) f.shaking_moment -= f.drives[i];
  }
  if (std::any_of(l.joints.begin(), l.joints.end(),
                  [](const LinkageJoint& j) { return j.type == JointType::fixed; }))
    weld_forces(l, plan, motion, f);
  powers(l, plan, motion, f);
}

}  // namespace linkwright::planar
