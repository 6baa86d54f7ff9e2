#include "linkwright/planar/linkage_reactions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linkwright/core/check.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage_general.h"

namespace linkwright::planar {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

double factor_at(const LoadFactor& f, double argument) {
  const auto above = std::upper_bound(f.argument.begin(), f.argument.end(), argument);
  if (above == f.argument.begin()) return f.factor.front();
  if (above == f.argument.end()) return f.factor.back();
  const auto i = static_cast<std::size_t>(above - f.argument.begin());
  const double share = (argument - f.argument[i - 1]) / (f.argument[i] - f.argument[i - 1]);
  return f.factor[i - 1] + share * (f.factor[i] - f.factor[i - 1]);
}
double strength(const LoadFactor& f, double time, double input, const Vec<double>& point, double speed) {
  switch (f.against) {
    case LoadArgument::constant:
      return 1;
    case LoadArgument::input:
      return factor_at(f, input);
    case LoadArgument::time:
      return factor_at(f, time);
    case LoadArgument::x:
      return factor_at(f, point.x);
    case LoadArgument::y:
      return factor_at(f, point.y);
    case LoadArgument::speed:
      return factor_at(f, speed);
  }
  return 1;
}

PointMotion point_of(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                     const BodyPoint& p) {
  return point_motion(plan, motion, p.body, l.bodies[at(p.body)].points[at(p.point)].at);
}

const PartState<double>& part_of(const LinkagePlan& plan, const LinkageMotion& motion, int body) {
  return motion.parts[at(plan.bodies[at(body)].part)];
}

double sign_of(double x) { return x > 0 ? 1.0 : x < 0 ? -1.0 : 0.0; }

// What the friction of a joint is proportional to, times its coefficient: N m of a pin, N of a slide.
double friction_size(const LinkageJoint& j, const JointReaction& r, const Vec<double>& along) {
  if (j.type == JointType::revolute) return j.friction * j.pin_radius * norm(r.force);
  const double normal = cross(along, r.force);
  if (j.guide_length > 0)
    return j.friction * (std::abs(normal / 2 + r.moment / j.guide_length) +
                         std::abs(normal / 2 - r.moment / j.guide_length));
  return j.friction * std::abs(normal);
}

// Joints with friction that slide, in which sense.
struct Sliding {
  std::size_t joint;
  double sense;
  Vec<double> along;  // of a slide
};
std::vector<Sliding> sliding_joints(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                                    const std::vector<JointReaction>& joints) {
  std::vector<Sliding> out;
  for (std::size_t k = 0; k < l.joints.size(); ++k) {
    const LinkageJoint& j = l.joints[k];
    if (j.friction == 0) continue;
    const PartState<double>&first = part_of(plan, motion, j.first.body),
          &second = part_of(plan, motion, j.second.body);
    if (j.type == JointType::revolute) {
      out.push_back({k, sign_of(second.speed - first.speed), {0, 0}});
    } else {
      const Vec<double> along = turn(body_state(plan, motion, j.first.body).direction, unit(j.slide_first));
      const double sliding =
          dot(along, velocity_at(second, joints[k].point) - velocity_at(first, joints[k].point));
      out.push_back({k, sign_of(sliding), along});
    }
  }
  return out;
}
// Friction of given size, as loads on both bodies.
void friction_load(const LinkageJoint& j, const Sliding& s, const Vec<double>& point, double size,
                   std::vector<AppliedLoad>& loads) {
  if (j.type == JointType::revolute) {
    const double torque = -size * s.sense;
    loads.push_back({j.second.body, point, {0, 0}, torque});
    loads.push_back({j.first.body, point, {0, 0}, -torque});
  } else {
    const Vec<double> force = (-size * s.sense) * s.along;
    loads.push_back({j.second.body, point, force, 0});
    loads.push_back({j.first.body, point, -force, 0});
  }
}

// The wrench w about `about` that a plan joint puts on its part after, as the model's reaction.
void report(const PlanJoint& j, const LinkageMotion& motion, const Wrench<double>& w,
            const Vec<double>& about, LinkageForces& f) {
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
  return side * dot(turn(motion.parts[at(j.before.part)].direction, j.before.direction), w.force);
}

// One pass over the groups, last first, with the loads as they are.
void pass(const LinkagePlan& plan, const Linkage& linkage, const LinkageMotion& motion, LinkageForces& f) {
  const Vec<double> gravity = vec(linkage.gravity);
  for (std::size_t p = 0; p < plan.parts.size(); ++p)
    f.needed[p] = needed_wrench(plan.masses[p], motion.parts[p], gravity);
  for (const AppliedLoad& load : f.loads) {
    const int part = plan.bodies[at(load.body)].part;
    Wrench<double>& n = f.needed[at(part)];
    n = n - shifted(Wrench<double>{load.force, load.torque}, load.point - motion.parts[at(part)].origin);
  }
  for (std::size_t k = plan.groups.size(); k-- > 0;) {
    const Group& g = plan.groups[k];
    const PlanJoint& j = g.joints[0];
    switch (g.type) {
      case GroupType::driver: {
        const Wrench<double> w = driver_force(g, motion.parts.data(), f.needed.data());
        report(j, motion, w, point_on(motion.parts[at(j.after.part)], j.after.at), f);
        f.drives[at(g.input)] = along_drive(j, motion, w);
        break;
      }
      case GroupType::gear: {
        const Vec<double> pin = point_on(motion.parts[at(j.after.part)], j.after.at);
        Wrench<double> w = shifted(f.needed[at(g.parts[0])], motion.parts[at(g.parts[0])].origin - pin);
        const double torque = w.moment;
        w.moment = 0;
        report(j, motion, w, pin, f);
        f.joints[at(g.gear_joint)] = {pin, {0, 0}, g.gear_backwards ? -g.ratio * torque : torque};
        Wrench<double>& base = f.needed[at(j.before.part)];
        base = base + shifted(w, pin - motion.parts[at(j.before.part)].origin);
        f.needed[at(g.turning)].moment += g.ratio * torque;
        f.needed[at(g.carrier)].moment += (1 - g.ratio) * torque;
        break;
      }
      case GroupType::triangle:
      case GroupType::general: {
        const std::span<Wrench<double>> joints(f.group_joints.data(), g.joints.size());
        general_forces(plan, g, motion, *motion.general[k], f.needed, joints, f.group_drives);
        for (std::size_t i = 0; i < g.joints.size(); ++i) {
          const PlanJoint& here = g.joints[i];
          report(here, motion, joints[i], point_on(motion.parts[at(here.after.part)], here.after.at), f);
          if (g.inputs[i] >= 0) f.drives[at(g.inputs[i])] = along_drive(here, motion, joints[i]);
        }
        break;
      }
      default: {
        const GroupState<double>& s = motion.groups[k];
        for_dyad(g.type, [&](auto type) {
          dyad_forces(type, g, motion.parts.data(), s, f.needed.data(), f.group_joints.data());
        });
        for (std::size_t i = 0; i < 3; ++i) report(g.joints[i], motion, f.group_joints[i], s.reference, f);
      }
    }
  }
}

// A weld carries what the bodies on the side of its second body need beyond their other joints and loads.
void weld_forces(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, LinkageForces& f) {
  const std::size_t n = l.bodies.size();
  std::vector<Wrench<double>> needs(n, {{0, 0}, 0});  // about the global origin
  for (std::size_t b = 1; b < n; ++b) {
    const PartState<double> s = body_state(plan, motion, static_cast<int>(b));
    PartMass m;
    const auto add = [&](double mass, double inertia, const Vec<double>& c) {
      m.mass += mass;
      m.moment = m.moment + mass * c;
      m.inertia += inertia + mass * dot(c, c);
    };
    if (l.bodies[b].mass)
      add(l.bodies[b].mass->mass, l.bodies[b].mass->inertia, vec(l.bodies[b].mass->centre));
    for (const AttachedMass& a : l.bodies[b].attached) add(a.mass, 0, vec(a.at));
    needs[b] = shifted(needed_wrench(m, s, vec(l.gravity)), s.origin);
  }
  const auto take = [&](int body, const Wrench<double>& w, const Vec<double>& point) {
    needs[at(body)] = needs[at(body)] - shifted(w, point);
  };
  for (const AppliedLoad& load : f.loads) take(load.body, {load.force, load.torque}, load.point);
  for (std::size_t k = 0; k < l.joints.size(); ++k) {
    const LinkageJoint& j = l.joints[k];
    const JointReaction& r = f.joints[k];
    if (j.type == JointType::fixed) continue;
    if (j.type == JointType::gear) {
      take(j.second.body, {{0, 0}, r.moment}, r.point);
      take(j.first.body, {{0, 0}, -j.ratio * r.moment}, r.point);
      take(j.carrier, {{0, 0}, -(1 - j.ratio) * r.moment}, r.point);
    } else {
      take(j.second.body, {r.force, r.moment}, r.point);
      take(j.first.body, {-r.force, -r.moment}, r.point);
    }
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
    r.point = point_of(l, plan, motion, weld.second).position;
    const Wrench<double> w = shifted(sum, -r.point);
    r.force = w.force;
    r.moment = w.moment;
  }
}

void powers(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, LinkageForces& f) {
  const Vec<double> gravity = vec(l.gravity);
  f.kinetic_power = f.weight_power = f.load_power = f.drive_power = 0;
  for (std::size_t p = 1; p < plan.parts.size(); ++p) {
    const PartState<double>& s = motion.parts[p];
    const Wrench<double> w = needed_wrench(plan.masses[p], s, Vec<double>{0, 0});
    f.kinetic_power += dot(w.force, s.velocity) + w.moment * s.speed;
    const Vec<double> arm = turn(s.direction, plan.masses[p].moment);
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
      const Vec<double> along = turn(body_state(plan, motion, j.first.body).direction, unit(j.slide_first));
      const Vec<double> point = point_of(l, plan, motion, j.second).position;
      rate = dot(along, velocity_at(second, point) - velocity_at(first, point));
    }
    f.drive_power += f.drives[i] * rate;
  }
}

void nothing(LinkageForces& f) {
  for (JointReaction& r : f.joints) r = {{nan, nan}, {nan, nan}, nan};
  std::fill(f.drives.begin(), f.drives.end(), nan);
  f.shaking_force = {nan, nan};
  f.shaking_moment = f.shaking_moment_with_drive = nan;
  f.drive_power = f.load_power = f.weight_power = f.kinetic_power = nan;
}

double largest_force(const LinkageForces& f) {
  double largest = 0;
  for (const JointReaction& r : f.joints)
    largest = std::max({largest, std::abs(r.force.x), std::abs(r.force.y)});
  return largest;
}

// The friction of the forces of the last pass, again and again: a contraction while friction is moderate.
bool settle_by_passes(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                      const std::vector<Sliding>& sliding, std::size_t others, LinkageForces& f) {
  double change = 1;
  for (f.iterations = 1; f.iterations <= 200; ++f.iterations) {
    const std::vector<JointReaction> before = f.joints;
    f.loads.resize(others);
    for (const Sliding& s : sliding)
      friction_load(l.joints[s.joint], s, before[s.joint].point,
                    friction_size(l.joints[s.joint], before[s.joint], s.along), f.loads);
    pass(plan, l, motion, f);
    change = 0;
    for (std::size_t k = 0; k < before.size(); ++k)
      change = std::max({change, norm(f.joints[k].force - before[k].force),
                         std::abs(f.joints[k].moment - before[k].moment) / plan.size});
    if (!(change > 1e-12 * largest_force(f))) break;
  }
  return change <= 1e-12 * largest_force(f) && std::isfinite(change);
}

// Joint forces are affine in the sizes z of the frictions, and these are functions of the forces, times their
// coefficients: z = t g(z) with t = 1. From t = 0, without friction, z is followed as the coefficients grow
// together; Newton's method takes each step. Where z goes to infinity before t = 1, or the solutions meet and
// turn back, friction blocks: no finite force of the drives keeps the motion going.
Status settle_by_growth(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                        std::vector<Sliding> sliding, std::size_t others, LinkageForces& f) {
  std::erase_if(sliding, [](const Sliding& s) { return s.sense == 0; });
  const std::size_t n = sliding.size();
  const auto forces_at = [&](const std::vector<double>& z) {
    f.loads.resize(others);
    for (std::size_t k = 0; k < n; ++k)
      friction_load(l.joints[sliding[k].joint], sliding[k], f.joints[sliding[k].joint].point, z[k], f.loads);
    pass(plan, l, motion, f);
  };
  std::vector<double> z(n, 0.0);
  forces_at(z);
  const std::vector<JointReaction> base = f.joints;
  std::vector<std::vector<JointReaction>> unit_forces;
  const double measure = largest_force(f) > 0 ? largest_force(f) : 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> one(n, 0.0);
    one[k] = measure;
    forces_at(one);
    unit_forces.push_back(f.joints);
    for (std::size_t j = 0; j < base.size(); ++j) {
      JointReaction& r = unit_forces[k][j];
      r.force = (1 / measure) * (r.force - base[j].force);
      r.moment = (r.moment - base[j].moment) / measure;
    }
  }
  const auto reaction = [&](std::size_t joint, const std::vector<double>& sizes) {
    JointReaction r = base[joint];
    for (std::size_t k = 0; k < n; ++k) {
      r.force = r.force + sizes[k] * unit_forces[k][joint].force;
      r.moment += sizes[k] * unit_forces[k][joint].moment;
    }
    return r;
  };
  const auto size_at = [&](std::size_t k, const std::vector<double>& sizes) {
    const std::size_t joint = sliding[k].joint;
    return friction_size(l.joints[joint], reaction(joint, sizes), sliding[k].along);
  };
  std::vector<double> matrix(n * n), right(n);
  // I - t dg/dz at z, by central differences of what is piecewise a norm; and its determinant by elimination.
  const auto newton = [&](double t, std::vector<double>& at_z, double& determinant) {
    for (int i = 0; i < 50; ++i) {
      double largest = measure;
      for (const double v : at_z) largest = std::max(largest, std::abs(v));
      for (std::size_t k = 0; k < n; ++k) {
        right[k] = t * size_at(k, at_z) - at_z[k];
        for (std::size_t m = 0; m < n; ++m) {
          std::vector<double> more = at_z, less = at_z;
          const double h = 1e-6 * largest;
          more[m] += h, less[m] -= h;
          matrix[k * n + m] = (k == m ? 1 : 0) - t * (size_at(k, more) - size_at(k, less)) / (2 * h);
        }
      }
      double wrong = 0;
      for (const double v : right) wrong = std::max(wrong, std::abs(v));
      determinant = 1;
      for (std::size_t c = 0; c < n; ++c) {
        std::size_t best = c;
        for (std::size_t r = c + 1; r < n; ++r)
          if (std::abs(matrix[r * n + c]) > std::abs(matrix[best * n + c])) best = r;
        if (best != c) {
          for (std::size_t m = 0; m < n; ++m) std::swap(matrix[c * n + m], matrix[best * n + m]);
          std::swap(right[c], right[best]);
          determinant = -determinant;
        }
        const double pivot = matrix[c * n + c];
        determinant *= pivot;
        if (pivot == 0) return false;
        for (std::size_t r = c + 1; r < n; ++r) {
          const double share = matrix[r * n + c] / pivot;
          for (std::size_t m = c; m < n; ++m) matrix[r * n + m] -= share * matrix[c * n + m];
          right[r] -= share * right[c];
        }
      }
      for (std::size_t c = n; c-- > 0;) {
        for (std::size_t m = c + 1; m < n; ++m) right[c] -= matrix[c * n + m] * right[m];
        right[c] /= matrix[c * n + c];
      }
      if (wrong <= 1e-14 * largest || (i > 5 && wrong <= 1e-12 * largest)) return true;
      for (std::size_t k = 0; k < n; ++k) at_z[k] += right[k];
    }
    return false;
  };
  double t = 0, step = 0.25;
  while (t < 1) {
    const double next = std::min(1.0, t + step);
    std::vector<double> trial = z;
    double determinant = 0;
    const bool good = newton(next, trial, determinant) && determinant > 0 &&
                      std::all_of(trial.begin(), trial.end(), [](double v) { return v >= 0; });
    if (good) {
      z = std::move(trial);
      t = next;
      step *= 2;
    } else if ((step *= 0.5) < 1e-9) {
      return Status::self_locking;
    }
  }
  forces_at(z);
  return Status::done;
}

}  // namespace

void applied_loads(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                   double input, std::vector<AppliedLoad>& loads) {
  for (const LinearSpring& s : l.springs) {
    const PointMotion a = point_of(l, plan, motion, s.first), b = point_of(l, plan, motion, s.second);
    const Vec<double> way = b.position - a.position;
    const double length = norm(way);
    // Without a length there is no direction: as if at rest length.
    const Vec<double> along = length > 0 ? (1 / length) * way : Vec<double>{0, 0};
    const double pull =
        s.stiffness * (length - s.free_length) + s.damping * dot(along, b.velocity - a.velocity);
    loads.push_back({s.first.body, a.position, pull * along, 0});
    loads.push_back({s.second.body, b.position, -pull * along, 0});
  }
  for (const TorsionSpring& s : l.torsion_springs) {
    const PartState<double> a = body_state(plan, motion, s.first), b = body_state(plan, motion, s.second);
    const double angle = math::wrap_angle(angle_of(unturn(a.direction, b.direction)) - s.free_angle);
    const double torque = -s.stiffness * angle - s.damping * (b.speed - a.speed);
    loads.push_back({s.second, b.origin, {0, 0}, torque});
    loads.push_back({s.first, a.origin, {0, 0}, -torque});
  }
  for (const PointForce& p : l.forces) {
    const Vec<double> there = point_of(l, plan, motion, p.point).position;
    Vec<double> force = strength(p.factor, time, input, there, 0) * vec(p.force);
    if (p.turns_with_body) force = turn(body_state(plan, motion, p.point.body).direction, force);
    loads.push_back({p.point.body, there, force, 0});
  }
  for (const BodyTorque& t : l.torques) {
    const double speed = part_of(plan, motion, t.body).speed - part_of(plan, motion, t.from).speed;
    const double torque = t.torque * strength(t.factor, time, input, {0, 0}, speed);
    loads.push_back({t.body, part_of(plan, motion, t.body).origin, {0, 0}, torque});
    loads.push_back({t.from, part_of(plan, motion, t.from).origin, {0, 0}, -torque});
  }
}

void solve_forces(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, double time,
                  double input, LinkageForces& f) {
  LINKWRIGHT_REQUIRE(plan.has_masses, "forces need the mass of every body: '{}' has none", plan.massless[0]);
  f.status = motion.status;
  f.joints.resize(l.joints.size());
  f.drives.resize(plan.inputs());
  f.needed.resize(plan.parts.size());
  std::size_t most = 3;
  for (const Group& g : plan.groups) most = std::max(most, g.joints.size());
  f.group_joints.resize(most);
  f.group_drives.resize(most);
  f.loads.clear();
  f.iterations = 0;
  if (motion.status != Status::done) return nothing(f);
  applied_loads(l, plan, motion, time, input, f.loads);
  const std::size_t others = f.loads.size();
  pass(plan, l, motion, f);
  if (std::any_of(l.joints.begin(), l.joints.end(), [](const LinkageJoint& j) { return j.friction > 0; })) {
    const std::vector<Sliding> sliding = sliding_joints(l, plan, motion, f.joints);
    if (!settle_by_passes(l, plan, motion, sliding, others, f)) {
      f.status = settle_by_growth(l, plan, motion, sliding, others, f);
      if (f.status != Status::done) return nothing(f);
    }
  }
  f.shaking_force = -f.needed[0].force;
  f.shaking_moment_with_drive = -f.needed[0].moment;
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
