// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/dynamics.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/strut.h"

namespace linkwright::planar {
namespace {

// Free inputs from which on the joint forces are the cheaper route (measured).
constexpr std::size_t many_inputs = 9;

struct Springy {
  double stretch, rate;  // from the free length or angle
};
Springy state_of(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                 const LinearSpring& s) {
  const auto point = [&](const BodyPoint& p) { return point_motion(l, plan, motion, p); };
  const PointMotion a = point(s.first), b = point(s.second);
  const math::Vec2 way = b.position - a.position;
  const double length = norm(way);
  if (length == 0) return {0, 0};  // the same as in applied_loads
  return {length - s.free_length, dot(way, b.velocity - a.velocity) / length};
}
Springy state_of(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                 const TorsionSpring& s) {
  const auto k = static_cast<std::size_t>(&s - l.torsion_springs.data());
  return {motion.twists[k] - s.free_angle,
          body_state(plan, motion, s.second).speed - body_state(plan, motion, s.first).speed};
}

double power_of(const LinkagePlan& plan, const LinkageMotion& motion, const AppliedLoad& load) {
  const PartState<double>& s = motion.parts[at(plan.bodies[at(load.body)].part)];
  return dot(load.force, velocity_at(s, load.point)) + load.torque * s.speed;
}

}  // namespace

double kinetic_energy(const LinkagePlan& plan, const LinkageMotion& motion) {
  double sum = 0;
  for (std::size_t p = 1; p < plan.parts.size(); ++p) {
    const PartMass& m = plan.masses[p];
    const PartState<double>& s = motion.parts[p];
    const math::Vec2 arm = rotate(s.direction, m.moment);
    sum += m.mass * dot(s.velocity, s.velocity) / 2 + s.speed * cross(arm, s.velocity) +
           m.inertia * s.speed * s.speed / 2;
  }
  return sum;
}

double potential_energy(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion) {
  return potential_energy(l, plan, motion, motion.twists);
}
double potential_energy(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                        std::span<const double> twists) {
  const math::Vec2 gravity = math::vec(l.gravity);
  double sum = 0;
  for (std::size_t p = 1; p < plan.parts.size(); ++p) {
    const PartState<double>& s = motion.parts[p];
    sum -= dot(gravity, plan.masses[p].mass * s.origin + rotate(s.direction, plan.masses[p].moment));
  }
  for (const LinearSpring& s : l.springs) {
    const double stretch = state_of(l, plan, motion, s).stretch;
    sum += s.stiffness * stretch * stretch / 2;
  }
  for (std::size_t k = 0; k < l.torsion_springs.size(); ++k) {
    const double angle = twists[k] - l.torsion_springs[k].free_angle;
    sum += l.torsion_springs[k].stiffness * angle * angle / 2;
  }
  for (const Strut& s : l.struts)
    if (stores_energy(s)) sum += stored_energy(s, span_of(l, plan, motion, s.first, s.second).length);
  return sum;
}

double lasting_power(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                     std::span<const AppliedLoad> loads) {
  double sum = 0;
  for (const AppliedLoad& load : loads) sum += power_of(plan, motion, load);
  for (const LinearSpring& s : l.springs) {
    const Springy now = state_of(l, plan, motion, s);
    sum += s.stiffness * now.stretch * now.rate;
  }
  for (const TorsionSpring& s : l.torsion_springs) {
    const Springy now = state_of(l, plan, motion, s);
    sum += s.stiffness * now.stretch * now.rate;
  }
  for (const Strut& s : l.struts) {
    if (!stores_energy(s)) continue;
    const Span span = span_of(l, plan, motion, s.first, s.second);
    sum -= push_of(s, l, plan, motion, span, 0, 0) * span.rate;  // neither time nor input matter
  }
  return sum;
}

AccelerationRoute cheaper_route(const Linkage& linkage, const LinkagePlan& plan, std::size_t free) {
  const bool friction = std::any_of(linkage.joints.begin(), linkage.joints.end(), has_friction);
  return free < many_inputs || friction || !linkage.stops.empty() || !LinkageElimination::takes(plan)
             ? AccelerationRoute::mass_matrix
             : AccelerationRoute::joint_forces;
}

LinkageDynamics::LinkageDynamics(const Linkage& linkage, const LinkagePlan& plan, std::vector<bool> free,
                                 AccelerationRoute route)
    : motion(plan), linkage_(linkage), plan_(plan) {
  LINKWRIGHT_REQUIRE(free.size() == plan.inputs(), "the linkage has {} inputs, got {}", plan.inputs(),
                     free.size());
  LINKWRIGHT_REQUIRE(plan.has_masses, "motion under forces needs the mass of every body: '{}' has none",
                     plan.massless[0]);
  for (std::size_t k = 0; k < free.size(); ++k) {
    if (free[k]) free_.push_back(k);
    all_.push_back(k);
  }
  is_free_ = free;
  prescribed_ = free_.size() < free.size();
  friction_ = std::any_of(linkage.joints.begin(), linkage.joints.end(), has_friction);
  const auto damped = [](const auto& s) { return s.damping != 0; };
  damped_ = std::any_of(linkage.springs.begin(), linkage.springs.end(), damped) ||
            std::any_of(linkage.torsion_springs.begin(), linkage.torsion_springs.end(), damped) ||
            !linkage.struts.empty();
  lasting_ =
      friction_ || damped_ || !linkage.forces.empty() || !linkage.torques.empty() || !linkage.stops.empty();
  unit_.resize(free.size());
  bias_.resize(free.size());
  unit_rates_.resize(free.size() * plan.parts.size());
  needed_.resize(plan.parts.size());
  if (route == AccelerationRoute::joint_forces) {
    LINKWRIGHT_REQUIRE(!friction_, "joint forces are wanted of a linkage with friction");
    elimination_.emplace(plan, free);
    return;
  }
  mass_.resize(free_.size() * free_.size());
  factor_ = mass_;
  right_.resize(free_.size());
}

// Velocities of the parts for a unit rate of one input each: of the free ones, and where drives do work of
// the prescribed ones as well.
void LinkageDynamics::unit_velocities(std::span<const InputMotion> inputs) {
  std::copy(inputs.begin(), inputs.end(), unit_.begin());
  for (InputMotion& u : unit_) u.rate = 0;
  for (const std::size_t k : prescribed_ ? all_ : free_) {
    unit_[k].rate = 1;
    solve_velocity(plan_, unit_, motion);
    unit_[k].rate = 0;
    PartRate* rates = &unit_rates_[k * plan_.parts.size()];
    for (std::size_t p = 1; p < plan_.parts.size(); ++p)
      rates[p] = {motion.parts[p].velocity, motion.parts[p].speed};
  }
}

// Velocities are proportional to the rate of an only input, and those of its unit rate are in `motion`.
void LinkageDynamics::scale_velocities(double rate) {
  for (std::size_t p = 1; p < plan_.parts.size(); ++p) {
    PartState<double>& part = motion.parts[p];
    part.velocity = rate * part.velocity;
    part.speed *= rate;
  }
  for (GroupState<double>& g : motion.groups) g.rate_x *= rate, g.rate_y *= rate, g.rate_zero *= rate;
}

// Cholesky's factor of the mass matrix; false when a free input moves no mass.
bool LinkageDynamics::factorise() {
  const std::size_t n = free_.size();
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t k = 0; k <= j; ++k) {
      double sum = mass_[j * n + k];
      for (std::size_t i = 0; i < k; ++i) sum -= factor_[j * n + i] * factor_[k * n + i];
      if (j == k) {
        // Beyond rounding, what is left of the diagonal is the inertia of this freedom by itself.
        if (!(sum > 1e-14 * mass_[j * n + j])) return false;
        factor_[j * n + j] = std::sqrt(sum);
      } else {
        factor_[j * n + k] = sum / factor_[k * n + k];
      }
    }
  return true;
}
void LinkageDynamics::resolve(std::span<double> right) const {
  const std::size_t n = free_.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) right[j] -= factor_[j * n + k] * right[k];
    right[j] /= factor_[j * n + j];
  }
  for (std::size_t j = n; j-- > 0;) {
    for (std::size_t k = j + 1; k < n; ++k) right[j] -= factor_[k * n + j] * right[k];
    right[j] /= factor_[j * n + j];
  }
}

// Joint forces and accelerations depend on each other by friction. The forces that drives at the free
// joints would have to give measure the error of the accelerations.
Status LinkageDynamics::settle_friction(double time, std::span<InputMotion> inputs) {
  solve_acceleration(plan_, inputs, motion);
  const auto answer = [&](std::span<const double> drives) {
    for (std::size_t j = 0; j < free_.size(); ++j) right_[j] = -drives[free_[j]];
    resolve(right_);
    for (std::size_t j = 0; j < free_.size(); ++j) inputs[free_[j]].acceleration += right_[j];
    solve_acceleration(plan_, inputs, motion);
  };
  solve_forces(linkage_, plan_, motion, time, inputs[0].value, forces_, answer, states ? &*states : nullptr);
  if (forces_.status != Status::done) return forces_.status;
  power = lasting_power(linkage_, plan_, motion, forces_.loads);
  friction_power = 0;  // its loads come after those of needed_wrenches
  for (std::size_t i = loads_.size(); i < forces_.loads.size(); ++i)
    friction_power -= power_of(plan_, motion, forces_.loads[i]);
  for (const std::size_t k : all_)
    if (!is_free_[k]) power += forces_.drives[k] * inputs[k].rate;
  return std::isfinite(power) ? Status::done : Status::not_converged;
}

void LinkageDynamics::needed_wrenches(double time, double input) {
  loads_.clear();
  applied_loads(linkage_, plan_, motion, time, input, loads_);
  const math::Vec2 gravity = math::vec(linkage_.gravity);
  for (std::size_t p = 1; p < plan_.parts.size(); ++p)
    needed_[p] = needed_wrench(plan_.masses[p], motion.parts[p], gravity);
  for (const AppliedLoad& load : loads_) {
    const int p = plan_.bodies[at(load.body)].part;
    needed_[at(p)] = needed_[at(p)] - shifted(Wrench<double>{load.force, load.torque},
                                              load.point - motion.parts[at(p)].origin);
  }
}

// Accelerations of the free inputs by their mass matrix, and the power of the prescribed drives.
bool LinkageDynamics::solve_masses(std::span<InputMotion> inputs) {
  const std::size_t parts = plan_.parts.size(), n = free_.size();
  const auto virtual_power = [&](std::size_t k) {
    const PartRate* rates = &unit_rates_[k * parts];
    double sum = 0;
    for (std::size_t p = 1; p < parts; ++p)
      sum += dot(needed_[p].force, rates[p].velocity) + needed_[p].moment * rates[p].speed;
    return sum;
  };
  const auto coupling = [&](std::size_t j, std::size_t k) {
    const PartRate *a = &unit_rates_[j * parts], *b = &unit_rates_[k * parts];
    double sum = 0;
    for (std::size_t p = 1; p < parts; ++p) {
      const PartMass& m = plan_.masses[p];
      const math::Vec2 arm = rotate(motion.parts[p].direction, m.moment);
      sum += m.mass * dot(a[p].velocity, b[p].velocity) + a[p].speed * cross(arm, b[p].velocity) +
             b[p].speed * cross(arm, a[p].velocity) + m.inertia * a[p].speed * b[p].speed;
    }
    return sum;
  };
  for (std::size_t j = 0; j < n; ++j) {
    right_[j] = -virtual_power(free_[j]);
    for (std::size_t k = 0; k <= j; ++k) mass_[j * n + k] = mass_[k * n + j] = coupling(free_[j], free_[k]);
  }
  if (!factorise()) return false;
  resolve(right_);
  for (std::size_t j = 0; j < n; ++j) inputs[free_[j]].acceleration = right_[j];
  if (prescribed_ && !friction_)
    for (const std::size_t k : all_) {
      if (is_free_[k]) continue;
      double force = virtual_power(k);
      for (const std::size_t j : free_) force += coupling(k, j) * inputs[j].acceleration;
      power += force * inputs[k].rate;
    }
  return true;
}

void LinkageDynamics::power_of_loads() {
  if (damped_)
    power += lasting_power(linkage_, plan_, motion, loads_);
  else if (lasting_)  // the work of springs is in their potential energy; their loads come first, two each
    for (std::size_t i = 2 * (linkage_.springs.size() + linkage_.torsion_springs.size()); i < loads_.size();
         ++i)
      power += power_of(plan_, motion, loads_[i]);
}

Status LinkageDynamics::solve(double time, std::span<InputMotion> inputs) {
  LINKWRIGHT_REQUIRE(inputs.size() == plan_.inputs(), "the linkage has {} inputs, got {}", plan_.inputs(),
                     inputs.size());
  for (const std::size_t k : free_) inputs[k].acceleration = 0;
  const auto failed = [&](Status status) {
    for (const std::size_t k : free_) inputs[k].acceleration = nan;
    return status;
  };
  power = 0;
  solve_position(plan_, inputs, motion);
  if (motion.status != Status::done) return failed(motion.status);
  if (!elimination_) unit_velocities(inputs);
  if (!elimination_ && plan_.inputs() == 1)
    scale_velocities(inputs[0].rate);
  else
    solve_velocity(plan_, inputs, motion);
  without_value = load_without_value(linkage_, plan_, motion, time);
  if (without_value) return failed(Status::limit_reached);
  solve_acceleration(plan_, inputs, motion);
  needed_wrenches(time, inputs[0].value);
  if (elimination_) {
    if (!elimination_->solve(motion, needed_)) return failed(Status::singular);
    for (const std::size_t k : all_)
      if (is_free_[k])
        inputs[k].acceleration = elimination_->acceleration(k);
      else
        power += elimination_->drive(k) * inputs[k].rate;
  } else if (!solve_masses(inputs)) {
    return failed(Status::singular);
  }
  if (friction_) {
    const Status settled = settle_friction(time, inputs);
    return settled == Status::done ? settled : failed(settled);
  }
  power_of_loads();
  return Status::done;
}

}  // namespace linkwright::planar
