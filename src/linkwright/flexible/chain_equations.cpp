// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/chain_equations.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"

namespace linkwright::flexible {

namespace {

double stiffness(const Chain& chain, const Cell& cell, std::size_t coordinate) {
  if (cell.hinge && coordinate != turn) return 0;
  if (coordinate == slide) return cell.shear;
  if (coordinate == turn) return cell.bending;
  return chain.extensible ? cell.axial : 0;
}

}  // namespace

ChainEquations::ChainEquations(const Chain& chain)
    : chain_(&chain),
      linearised_(chain.kinematics == Kinematics::source_linearised),
      node_(chain.cells.size() + 1),
      joint_(chain.cells.size()),
      motor_(chain.cells.size()),
      locked_(chain.cells.size()),
      residual_(coordinates_per_cell * chain.cells.size()),
      border_column_(residual_.size()),
      border_row_(residual_.size()),
      border_change_(residual_.size()) {
  LINKWRIGHT_REQUIRE(!chain.cells.empty(), "a chain without cells");
  const Cell& first =
      *std::find_if(chain.cells.begin(), chain.cells.end(), [](const Cell& c) { return !c.hinge; });
  // The couple that bends the link by 1e-8 of its length, so that a link at rest has a scale too. No more: in
  // a stiff link that would be more than the forces that move it.
  natural_moment_ = 1e-8 * first.bending * first.length / chain.length();
  natural_force_ = natural_moment_ / chain.length();
}

void ChainEquations::move(const ChainState& state) {
  const double hub = state.rate;
  math::Vec2 direction{1, 0};
  Node& root = node_.front();
  root.z = {chain_->hub_radius, 0};
  root.v = hub * perpendicular(root.z);
  root.a = state.acceleration * perpendicular(root.z) - hub * hub * root.z;
  root.drift = {};
  root.angle = 0;
  root.rate = hub;
  root.acceleration = state.acceleration;
  for (std::size_t s = 0; s < joint_.size(); ++s) {
    const Node& in = node_[s];
    Node& out = node_[s + 1];
    Joint& j = joint_[s];
    const double* v = &state.v[coordinates_per_cell * s];
    const double* a = &state.a[coordinates_per_cell * s];
    j.step = joint_step(chain_->kinematics, chain_->cells[s], &state.q[coordinates_per_cell * s]);
    const JointStep& step = j.step;
    j.mean = rotate(step.half, direction);
    direction = rotate(step.half, j.mean);

    // Delta = R(beta) d + R(theta) f, seen from the hub's axes; beta' and beta'' are against the ground.
    const bool hub_axis = chain_->kinematics == Kinematics::hub_axis;
    const double rate = in.rate + v[turn] / 2, acceleration = in.acceleration + a[turn] / 2;
    math::Vec2 d1{step.by_turn * v[turn] + step.by_slide * v[slide], 0}, f1, f2;
    math::Vec2 d2{step.by_turn * a[turn] + step.by_slide * a[slide] + step.by_turn_twice * v[turn] * v[turn] +
                      step.by_slide_twice * v[slide] * v[slide],
                  0};
    if (hub_axis) {
      f1 = {v[extension], v[slide]};
      f2 = {a[extension], a[slide]};
    } else {
      d1 += math::Vec2{v[extension], v[slide]};
      d2 += math::Vec2{a[extension], a[slide]};
    }
    const math::Vec2 d = step.along, f = step.across;
    const math::Vec2 relative = d1 + (rate - hub) * perpendicular(d);
    out.z = in.z + rotate(j.mean, d) + f;
    out.drift = in.drift + rotate(j.mean, relative) + f1;
    out.v = in.v + rotate(j.mean, d1 + rate * perpendicular(d)) + f1 + hub * perpendicular(f);
    out.a = in.a +
            rotate(j.mean,
                   d2 + 2 * rate * perpendicular(d1) + acceleration * perpendicular(d) - rate * rate * d) +
            f2 + 2 * hub * perpendicular(f1) + state.acceleration * perpendicular(f) - hub * hub * f;
    out.angle = in.angle + step.turn_by;
    out.rate = in.rate + v[turn];
    out.acceleration = in.acceleration + a[turn];

    j.by_angle = rotate(j.mean, perpendicular(d));
    j.by[turn] = rotate(j.mean, math::Vec2{step.by_turn, 0} + 0.5 * perpendicular(d));
    j.by[slide] = hub_axis ? math::Vec2{0, 1} : rotate(j.mean, {step.by_slide, 1});
    j.by[extension] = hub_axis ? math::Vec2{1, 0} : j.mean;
  }
}

// The printed velocities need two sums that are no position: x holds W = sum of the slides, y the deflection.
void ChainEquations::move_linearised(const ChainState& state) {
  node_.front() = {.rate = state.rate, .acceleration = state.acceleration};
  for (std::size_t s = 0; s < joint_.size(); ++s) {
    const Node& in = node_[s];
    Node& out = node_[s + 1];
    Joint& j = joint_[s];
    const double l = chain_->cells[s].length;
    const auto sum = [&](math::Vec2 before, const double* x, double angle) {
      return before + math::Vec2{x[slide], x[slide] + l * angle + l / 2 * x[turn]};
    };
    j.step = joint_step(chain_->kinematics, chain_->cells[s], &state.q[coordinates_per_cell * s]);
    j.mean = {1, 0};
    out.z = sum(in.z, &state.q[coordinates_per_cell * s], in.angle);
    out.drift = out.v = sum(in.v, &state.v[coordinates_per_cell * s], in.rate - state.rate);
    out.a = sum(in.a, &state.a[coordinates_per_cell * s], in.acceleration - state.acceleration);
    out.angle = in.angle + j.step.turn_by;
    out.rate = in.rate + state.v[coordinates_per_cell * s + turn];
    out.acceleration = in.acceleration + state.a[coordinates_per_cell * s + turn];
    j.by_angle = {0, l};
    j.by = {math::Vec2{1, 1}, math::Vec2{0, l / 2}, math::Vec2{}};
  }
}

// From forces and couples at the nodes to residuals, with springs and dampers.
void ChainEquations::project(const ChainState& state) {
  math::Vec2 outer;
  double couple = 0, max_force = 0, max_moment = 0;
  for (std::size_t s = joint_.size(); s-- > 0;) {
    Joint& j = joint_[s];
    const Cell& cell = chain_->cells[s];
    outer += j.force;
    couple += j.couple;
    j.outer = outer;
    const double* q = &state.q[coordinates_per_cell * s];
    const double* v = &state.v[coordinates_per_cell * s];
    double* r = &residual_[coordinates_per_cell * s];
    const double damped = chain_->stiffness_damping;
    const double elastic = cell.hinge ? 0 : cell.shear * (q[slide] + damped * v[slide]);
    const double bending = cell.hinge ? cell.bending * q[turn] + cell.damping * v[turn]
                                      : cell.bending * (q[turn] + damped * v[turn]) + cell.damping * v[turn];
    r[slide] = dot(outer, j.by[slide]) + elastic;
    r[turn] = dot(outer, j.by[turn]) + couple + bending;
    r[extension] = chain_->extensible
                       ? dot(outer, j.by[extension]) + cell.axial * (q[extension] + damped * v[extension])
                       : 0;
    max_force = std::max({max_force, std::abs(outer.x) + std::abs(outer.y), std::abs(elastic)});
    max_moment = std::max({max_moment, std::abs(bending), std::abs(couple)});
    if (cell.hinge) {
      r[slide] = r[extension] = 0;
      if (locked_[s]) {
        motor_[s] = r[turn];
        r[turn] = 0;
      } else {
        r[turn] -= motor_[s];
      }
    }
    couple += dot(outer, j.by_angle);
  }
  force_scale_ = natural_force_ + max_force;
  moment_scale_ = natural_moment_ + max_moment;
}

void ChainEquations::balance(const ChainState& state, const TipLoad& load) {
  load_ = load;
  gravity_ = rotate_inverse(math::unit(state.angle), math::Vec2{0, -chain_->gravity});
  math::Vec2 force;
  double moment = 0;
  const math::Vec2 weld{chain_->hub_radius, 0};
  for (std::size_t s = 0; s < joint_.size(); ++s) {
    const Node& node = node_[s + 1];
    const Cell& cell = chain_->cells[s];
    Joint& j = joint_[s];
    j.force = cell.mass * (node.a - gravity_);
    j.couple = cell.inertia * node.acceleration;
    if (s + 1 == joint_.size()) {
      j.force = j.force - load.force;
      j.couple -= load.couple;
    }
    force += j.force;
    moment += cross(node.z - weld, j.force) + j.couple;
    if (chain_->mass_damping > 0) {  // acts between link and hub, so it is internal to the whole
      j.force += chain_->mass_damping * cell.mass * node.drift;
      j.couple += chain_->mass_damping * cell.inertia * (node.rate - state.rate);
    }
  }
  forces_.reaction = force + chain_->root_mass * (node_.front().a - gravity_);
  forces_.moment = moment + chain_->root_inertia * state.acceleration;
  forces_.torque = chain_->hub_inertia * state.acceleration + forces_.moment +
                   chain_->hub_radius * forces_.reaction.y + chain_->hub_stiffness * state.angle +
                   chain_->hub_damping * state.rate;
}

void ChainEquations::balance_linearised(const ChainState& state) {
  const double hub = state.rate, turned_by = state.acceleration, r = chain_->hub_radius;
  double x = r, axial = 0, across = 0, lateral = 0, hub_row = 0;
  for (std::size_t s = 0; s < joint_.size(); ++s) {
    const Node& node = node_[s + 1];
    const Cell& cell = chain_->cells[s];
    Joint& j = joint_[s];
    const double m = cell.mass, slides = node.z.x;
    x += cell.length;
    const double eta = node.a.y + x * turned_by;
    j.force = {-hub * hub * m * slides, m * eta};
    j.couple = cell.inertia * node.acceleration;
    axial -= m * (turned_by * slides + hub * node.v.x + hub * (hub * x + node.v.y));
    across += m * (eta - hub * hub * slides);
    lateral += m * eta;
    hub_row += m * (x * eta + slides * slides * turned_by + 2 * hub * slides * node.v.x) + j.couple;
  }
  const Cell& first = chain_->cells.front();
  forces_.reaction = {axial - chain_->root_mass * hub * hub * r, across + chain_->root_mass * turned_by * r};
  forces_.moment =
      first.length / 2 * lateral + chain_->root_inertia * turned_by - first.bending * state.q[turn];
  forces_.torque = (chain_->hub_inertia + chain_->root_inertia + chain_->root_mass * r * r) * turned_by +
                   hub_row + chain_->hub_stiffness * state.angle + chain_->hub_damping * hub;
}

const ChainForces& ChainEquations::evaluate(const ChainState& state, const TipLoad& load) {
  hub_rate_ = state.rate;
  if (linearised_) {
    move_linearised(state);
    balance_linearised(state);
    joint_.back().force = joint_.back().force - math::Vec2{0, load.force.y};
    joint_.back().couple -= load.couple;
  } else {
    move(state);
    balance(state, load);
  }
  project(state);
  return forces_;
}

double ChainEquations::relative_residual() const {
  double force = 0, couple = 0;
  for (std::size_t i = 0; i < residual_.size(); ++i) {
    double& most = i % coordinates_per_cell == turn ? couple : force;
    most = std::isnan(residual_[i]) ? INFINITY : std::max(most, std::abs(residual_[i]));
  }
  return std::max(force / force_scale_, couple / moment_scale_);
}

math::Vec2 ChainEquations::tip() const {
  return linearised_ ? math::Vec2{chain_->hub_radius + chain_->length(), node_.back().z.y} : node_.back().z;
}

ChainEnergy ChainEquations::energy(const ChainState& state) const {
  const Chain& c = *chain_;
  const double hub = state.rate,
               root = c.hub_inertia + c.root_inertia + c.root_mass * c.hub_radius * c.hub_radius;
  ChainEnergy out;
  out.angular_momentum = root * hub;
  double twice = root * hub * hub, x = c.hub_radius;
  double height = c.root_mass * c.hub_radius * std::sin(state.angle);
  for (std::size_t s = 0; s < joint_.size(); ++s) {
    const Node& node = node_[s + 1];
    const Cell& cell = c.cells[s];
    x += cell.length;
    if (linearised_) {
      const math::Vec2 v{-hub * node.z.x, hub * x + node.v.y};
      twice += cell.mass * dot(v, v);
      out.angular_momentum += cell.mass * (x * v.y - node.z.x * v.x);
    } else {
      twice += cell.mass * dot(node.v, node.v);
      out.angular_momentum += cell.mass * cross(node.z, node.v);
      height += cell.mass * (std::sin(state.angle) * node.z.x + std::cos(state.angle) * node.z.y);
    }
    twice += cell.inertia * node.rate * node.rate;
    out.angular_momentum += cell.inertia * node.rate;
    const double relative = node.rate - hub;
    out.loss +=
        c.mass_damping * (cell.mass * dot(node.drift, node.drift) + cell.inertia * relative * relative);
    for (std::size_t i = 0; i < coordinates_per_cell; ++i) {
      const double k = stiffness(c, cell, i), q = state.q[coordinates_per_cell * s + i],
                   v = state.v[coordinates_per_cell * s + i];
      out.potential += k * q * q / 2;
      if (!cell.hinge) out.loss += c.stiffness_damping * k * v * v;
      if (i == turn) out.loss += cell.damping * v * v;
    }
  }
  out.kinetic = twice / 2;
  out.potential += c.hub_stiffness * state.angle * state.angle / 2 + c.gravity * height;
  out.loss += c.hub_damping * hub * hub;
  return out;
}

std::vector<SectionForce> ChainEquations::sections() const {
  LINKWRIGHT_REQUIRE(!linearised_, "source_linearised has no forces inside the link");
  std::vector<SectionForce> out(joint_.size() + 2);
  double position = chain_->length(), couple = 0, moment = 0;  // moment of the forces about O
  math::Vec2 force;
  // Outside of the tip mass only the load is left.
  const double angle = node_.back().angle;
  const math::Vec2 load = rotate_inverse({std::cos(angle), std::sin(angle)}, load_.force);
  out.back() = {.position = position, .axial = load.x, .shear = load.y, .moment = load_.couple};
  for (std::size_t s = joint_.size(); s-- > 0;) {
    const Node& node = node_[s + 1];
    const Cell& cell = chain_->cells[s];
    force += joint_[s].force;
    moment += cross(node.z, joint_[s].force);
    couple += joint_[s].couple;
    const math::Vec2 middle = 0.5 * (node_[s].z + node.z);
    const math::Vec2 along = rotate_inverse(joint_[s].mean, force);
    out[s + 1] = {.position = position - cell.length / 2,
                  .axial = -along.x,
                  .shear = -along.y,
                  .moment = -(moment - cross(middle, force) + couple)};
    position -= cell.length;
  }
  out.front() = {
      .position = 0, .axial = -forces_.reaction.x, .shear = -forces_.reaction.y, .moment = -forces_.moment};
  return out;
}

}  // namespace linkwright::flexible
