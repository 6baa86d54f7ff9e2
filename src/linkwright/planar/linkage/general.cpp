// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/general.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/linkage/detail/joint_rows.h"
#include "linkwright/planar/linkage/detail/pair_rows.h"

namespace linkwright::planar {

namespace {
using Index = Eigen::Index;

// Calls `add(part, share)` for each part in the equation of a gear: the shares of the angles sum to the
// phase.
template <class Add>
void for_angles(const PlanGear& gear, const Add& add) {
  add(gear.part, 1.0);
  for (const AngleShare& s : gear.angle.shares) add(s.part, -s.share);
}
}  // namespace

struct GeneralGroupMemory {
  std::vector<int> column;             // first column of a part, -1 of a known one
  Eigen::MatrixXd jacobian, factored;  // the last one assembled, and that of the factors
  Eigen::VectorXd residual, solution;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors;
};

namespace {

// The equation of a pair at the present places; its derivatives do not depend on the turns of the parts.
PairRow row_now(const PlanPair& pair, const LinkageMotion& motion) {
  return pair_row(pair, motion.parts, [&](int part) { return angle_of(motion.parts[at(part)].direction); });
}

// Fills the rows of the Jacobian; columns of the angles are divided by `size`, those of angle rows too, so
// that all entries are of the same order.
void assemble(const LinkagePlan& plan, const Group& g, const LinkageMotion& motion, GeneralGroupMemory& m) {
  m.jacobian.setZero();
  Index row = 0;
  for (std::size_t k = 0; k < g.joints.size(); ++k) {
    const PlanJoint& j = g.joints[k];
    const JointRows r = joint_rows(j, j.input >= 0, motion.parts);
    for (int i = 0; i < r.count; ++i, ++row) {
      const JointEquation& e = r.rows[at(i)];
      const double scale = e.moment != 0 ? plan.size : 1.0;
      for (const auto& [part, side] : {std::pair{j.after.part, 1.0}, std::pair{j.before.part, -1.0}}) {
        const int c = m.column[at(part)];
        if (c < 0) continue;
        const math::Vec2 arm = r.point - motion.parts[at(part)].origin;
        m.jacobian(row, c) += side * e.force.x;
        m.jacobian(row, c + 1) += side * e.force.y;
        m.jacobian(row, c + 2) += side * (e.moment * scale + cross(arm, e.force)) / plan.size;
      }
    }
  }
  for (const PlanGear& gear : g.gears) {
    for_angles(gear, [&](int part, double share) {
      if (m.column[at(part)] >= 0) m.jacobian(row, m.column[at(part)] + 2) += share;
    });
    ++row;
  }
  for (const PlanPair& pair : g.pairs) {
    const PairRow r = row_now(pair, motion);
    for (const PairShare& s : r.shares) {
      const int c = m.column[at(s.part)];
      if (c < 0) continue;
      m.jacobian(row, c) += s.force.x;
      m.jacobian(row, c + 1) += s.force.y;
      m.jacobian(row, c + 2) += s.moment / plan.size;
    }
    ++row;
  }
}
void factorise(const LinkagePlan& plan, const Group& g, const LinkageMotion& motion, GeneralGroupMemory& m) {
  assemble(plan, g, motion, m);
  if (m.jacobian == m.factored) return;
  m.factors.compute(m.jacobian);
  m.factored = m.jacobian;
}

// Solves with the transpose of the factorised Jacobian, from `residual` into `solution`. P J = L U, so that
// J^T x = b is U^T z = b, L^T w = z, x = P^T w; Eigen's own way allocates.
void solve_transposed(GeneralGroupMemory& m) {
  const auto& lu = m.factors.matrixLU();
  lu.triangularView<Eigen::Upper>().transpose().solveInPlace(m.residual);
  lu.triangularView<Eigen::UnitLower>().transpose().solveInPlace(m.residual);
  const auto& order = m.factors.permutationP().indices();
  for (Index i = 0; i < m.solution.size(); ++i) m.solution[i] = m.residual[order[i]];
}

}  // namespace

void GeneralGroupDelete::operator()(GeneralGroupMemory* memory) const { delete memory; }

GeneralGroupPointer general_group_memory(const LinkagePlan& plan, const Group& group) {
  GeneralGroupPointer memory(new GeneralGroupMemory);
  memory->column.assign(plan.parts.size(), -1);
  for (std::size_t i = 0; i < group.parts.size(); ++i)
    memory->column[at(group.parts[i])] = static_cast<int>(3 * i);
  const auto n = static_cast<Index>(3 * group.parts.size());
  memory->jacobian.resize(n, n);
  memory->factored = Eigen::MatrixXd::Constant(n, n, nan);
  memory->residual.resize(n);
  memory->solution.resize(n);
  memory->factors = Eigen::PartialPivLU<Eigen::MatrixXd>(n);
  return memory;
}

double determinant_sign(const GeneralGroupMemory& memory) {
  const auto& lu = memory.factors.matrixLU();
  // Inversions of the row exchanges are counted here, as Eigen allocates for their sign.
  const auto& order = memory.factors.permutationP().indices();
  bool negative = false;
  for (Index i = 0; i < lu.rows(); ++i) {
    negative ^= lu(i, i) < 0;
    for (Index k = 0; k < i; ++k) negative ^= order[k] > order[i];
  }
  return negative ? -1.0 : 1.0;
}

double conditioning(const GeneralGroupMemory& memory) {
  const auto pivots = memory.factors.matrixLU().diagonal().cwiseAbs();
  const double largest = pivots.maxCoeff();
  return largest > 0 ? pivots.minCoeff() / largest : 0.0;
}

Status place_general(const LinkagePlan& plan, const Group& g, std::span<const InputMotion> inputs,
                     LinkageMotion& motion, GeneralGroupMemory& m) {
  // Newton's method; near the solution it doubles the digits with each step, and two steps without gain at
  // the rounding level end it. Far off, a step turns no part by more than half a radian and moves none by
  // more than the linkage's size, so that the search does not leap to another branch.
  //
  // Factors are kept where they serve: at the start, when the parts still are where the last search left
  // them; and after a small step, as long as each further step gains a digit. They always end as those of the
  // last place.
  double reach = plan.size;  // far from the origin coordinates are rounded more coarsely
  for (const PlanJoint& j : g.joints)
    reach = std::max(reach, norm(point_on(motion.parts[at(j.before.part)], j.before.at)));
  const double rounding = 64 * tolerance::epsilon * reach;
  double last = infinity;
  double largest = last;
  bool small_step = false;
  for (int iteration = 0; iteration < 60; ++iteration) {
    Index row = 0;
    for (std::size_t k = 0; k < g.joints.size(); ++k) {
      const PlanJoint& j = g.joints[k];
      const InputMotion* input = j.input >= 0 ? &inputs[at(j.input)] : nullptr;
      const JointRows r = joint_rows(j, input != nullptr, motion.parts);
      const std::array<double, 3> f = joint_residuals(j, r, input, motion.parts, plan.size);
      for (int i = 0; i < r.count; ++i) m.residual[row++] = f[at(i)];
    }
    for (const PlanGear& gear : g.gears)
      m.residual[row++] = angle_residual(gear.angle, gear.part, inputs, motion.parts) * plan.size;
    for (const PlanPair& pair : g.pairs) {
      const PairRow r = pair_row(pair, motion.parts, [&](int part) {
        return pair_angle(plan, inputs, motion.parts, motion.loop_angles, part);
      });
      m.residual[row++] = less_turns(r, [&](int part) {
        const auto& turned = plan.turned[at(part)];
        return m.column[at(part)] >= 0 && !(turned && turned->shares.empty());
      });
    }
    largest = m.residual.cwiseAbs().maxCoeff();
    if (!std::isfinite(largest)) break;
    if (!(small_step && largest > rounding && largest < 0.1 * last)) factorise(plan, g, motion, m);
    if (largest <= rounding && (largest == 0 || largest > 0.25 * last || iteration > 0)) break;
    last = largest;
    m.solution = m.factors.solve(m.residual);
    double share = 1;
    for (Index i = 0; i < m.solution.size(); i += 3) {
      share = std::min(share, 0.5 * plan.size / std::max(std::abs(m.solution[i + 2]), 0.5 * plan.size));
      const double way = std::hypot(m.solution[i], m.solution[i + 1]);
      share = std::min(share, plan.size / std::max(way, plan.size));
    }
    if (!(share > 0)) {
      largest = infinity;
      break;
    }
    small_step = m.solution.cwiseAbs().maxCoeff() < 1e-3 * plan.size;
    for (int p : g.parts) {
      PartState<double>& part = motion.parts[at(p)];
      const int c = m.column[at(p)];
      part.origin = part.origin - share * math::Vec2{m.solution[c], m.solution[c + 1]};
      part.direction =
          renormalised(rotate(part.direction, math::unit(-share * m.solution[c + 2] / plan.size)));
    }
  }
  const double residual = std::isfinite(largest) ? largest : infinity;
  if (residual > 1e3 * rounding) {
    motion.gap = residual;
    return Status::not_converged;
  }
  motion.closure_residual = std::max(motion.closure_residual, residual);
  for (const PlanPair& pair : g.pairs)
    if (const auto* slot = std::get_if<SlotPair>(&pair.kind))
      if (const double beyond = place_in_slot(*slot, motion.parts).beyond; beyond > 1e3 * rounding) {
        motion.gap = beyond;
        return Status::no_assembly;
      }
  return conditioning(m) < tolerance::toggle_angle * 1e-3 ? Status::singular : Status::done;
}

void general_velocity(const LinkagePlan& plan, const Group& g, std::span<const InputMotion> inputs,
                      LinkageMotion& motion, GeneralGroupMemory& m) {
  Index row = 0;
  for (std::size_t k = 0; k < g.joints.size(); ++k) {
    const PlanJoint& j = g.joints[k];
    const bool driven = j.input >= 0;
    const JointRows r = joint_rows(j, driven, motion.parts);
    // The motion of the known parts goes to the right side.
    math::Vec2 slip{0, 0};
    double spin = 0;
    for (const auto& [part, side] : {std::pair{j.after.part, -1.0}, std::pair{j.before.part, 1.0}})
      if (m.column[at(part)] < 0) {
        slip = slip + side * velocity_at(motion.parts[at(part)], r.point);
        spin += side * motion.parts[at(part)].speed;
      }
    for (int i = 0; i < r.count; ++i) {
      const JointEquation& e = r.rows[at(i)];
      double value = dot(e.force, slip) + e.moment * spin;
      if (i == 2) value += sense(j) * inputs[at(j.input)].rate;
      m.residual[row++] = value * (e.moment != 0 ? plan.size : 1.0);
    }
  }
  for (const PlanGear& gear : g.gears) {
    double known = 0;
    for_angles(gear, [&](int part, double share) {
      if (m.column[at(part)] < 0) known += share * motion.parts[at(part)].speed;
    });
    m.residual[row++] = -known * plan.size;
  }
  for (const PlanPair& pair : g.pairs) {
    double known = 0;
    for (const PairShare& s : row_now(pair, motion).shares)
      if (m.column[at(s.part)] < 0)
        known += dot(s.force, motion.parts[at(s.part)].velocity) + s.moment * motion.parts[at(s.part)].speed;
    m.residual[row++] = -known;
  }
  m.solution = m.factors.solve(m.residual);
  for (int p : g.parts) {
    const int c = m.column[at(p)];
    motion.parts[at(p)].velocity = {m.solution[c], m.solution[c + 1]};
    motion.parts[at(p)].speed = m.solution[c + 2] / plan.size;
  }
}

void general_acceleration(const LinkagePlan& plan, const Group& g, std::span<const InputMotion> inputs,
                          LinkageMotion& motion, GeneralGroupMemory& m) {
  Index row = 0;
  for (std::size_t k = 0; k < g.joints.size(); ++k) {
    const PlanJoint& j = g.joints[k];
    const PartState<double>&before = motion.parts[at(j.before.part)], &after = motion.parts[at(j.after.part)];
    const JointRows r = joint_rows(j, j.input >= 0, motion.parts);
    // The accelerations of both fields at the point differ by the Coriolis term of a slide only; on the
    // right side are the parts of them that do not depend on unknown accelerations.
    math::Vec2 slip{0, 0};
    double spin = 0;
    for (const auto& [part, state, side] :
         {std::tuple{j.after.part, &after, -1.0}, std::tuple{j.before.part, &before, 1.0}}) {
      const math::Vec2 arm = r.point - state->origin;
      if (m.column[at(part)] < 0) {
        slip = slip + side * acceleration_at(*state, r.point);
        spin += side * state->angular_acceleration;
      } else {
        slip = slip - (side * state->speed * state->speed) * arm;
      }
    }
    if (j.slide) {
      const math::Vec2 relative = velocity_at(after, r.point) - velocity_at(before, r.point);
      slip = slip + (2 * before.speed * dot(r.along, relative)) * perpendicular(r.along);
    }
    for (int i = 0; i < r.count; ++i) {
      const JointEquation& e = r.rows[at(i)];
      double value = dot(e.force, slip) + e.moment * spin;
      if (i == 2) value += sense(j) * inputs[at(j.input)].acceleration;
      m.residual[row++] = value * (e.moment != 0 ? plan.size : 1.0);
    }
  }
  for (const PlanGear& gear : g.gears) {
    double known = 0;
    for_angles(gear, [&](int part, double share) {
      if (m.column[at(part)] < 0) known += share * motion.parts[at(part)].angular_acceleration;
    });
    m.residual[row++] = -known * plan.size;
  }
  for (const PlanPair& pair : g.pairs) {
    const PairRow r = row_now(pair, motion);
    double known = r.remainder;
    for (const PairShare& s : r.shares)
      if (m.column[at(s.part)] < 0)
        known += dot(s.force, motion.parts[at(s.part)].acceleration) +
                 s.moment * motion.parts[at(s.part)].angular_acceleration;
    m.residual[row++] = -known;
  }
  m.solution = m.factors.solve(m.residual);
  for (int p : g.parts) {
    const int c = m.column[at(p)];
    motion.parts[at(p)].acceleration = {m.solution[c], m.solution[c + 1]};
    motion.parts[at(p)].angular_acceleration = m.solution[c + 2] / plan.size;
  }
}

namespace {

// Force of the teeth that turns the second wheel with `torque`: along the tangent of the pitch circles, and
// away from the teeth of the other wheel by the pressure angle.
JointReaction mesh_force(const GearMesh& mesh, const LinkageMotion& motion, double torque) {
  const math::Vec2 first = point_on(motion.parts[at(mesh.first.part)], mesh.first.at),
                   second = point_on(motion.parts[at(mesh.second.part)], mesh.second.at);
  const math::Vec2 way = second - first;
  const math::Vec2 along = (1 / norm(way)) * way, left{-along.y, along.x};
  JointReaction out;
  out.point = first + mesh.first_radius * along;
  out.moment = torque;
  out.tangential = -torque / mesh.second_radius;
  out.separating = std::abs(out.tangential) * mesh.tangent;
  const bool external = mesh.first_radius > 0 && mesh.second_radius > 0;
  out.force = out.tangential * left + (external ? out.separating : -out.separating) * along;
  return out;
}

// The load of a strand that pulls its second wheel back with `tension`. It acts on the first one along the
// same line.
JointReaction strand_force(const StrandPair& strand, const LinkageMotion& motion, double tension) {
  const StrandLine line = strand_line(strand, motion.parts);
  return {line.second, -tension * line.along, 0, tension, 0};
}
// The load of the pin of a Geneva drive on its slot: across the slot, which leads from the axis of the wheel
// to the pin.
JointReaction pin_force(const CurvePair& pair, const LinkageMotion& motion, double torque) {
  const math::Vec2 axis = point_on(motion.parts[at(pair.second)], pair.mesh->second.at),
                   pin = point_on(motion.parts[at(pair.first)], pair.pin.at);
  const double distance = norm(pin - axis);
  JointReaction out;
  out.point = pin;
  out.moment = torque;
  out.force = torque / (distance * distance) * perpendicular(pin - axis);
  out.tangential = torque / distance;
  out.separating = 0;
  return out;
}
// The load of wheels that are not circular, which turns the second one with `torque`; their radii change. A
// locked Geneva wheel rests on the crank, with a force through its axis, as a ratio of 0 gives it.
JointReaction curve_force(const CurvePair& pair, const LinkageMotion& motion, double torque, double ratio) {
  if (pair.mesh && pair.geneva && ratio != 0) return pin_force(pair, motion, torque);
  if (!pair.mesh || std::abs(1 - ratio) < tolerance::feasibility)
    return {motion.parts[at(pair.second)].origin, {0, 0}, torque, nan, nan};
  GearMesh mesh = *pair.mesh;
  const double distance = mesh.second_radius;
  mesh.first_radius = -ratio / (1 - ratio) * distance;
  mesh.second_radius = distance / (1 - ratio);
  return mesh_force(mesh, motion, torque);
}
// The load of a pair on its second part: teeth, a strand, or the flank of a slot.
JointReaction pair_force(const PlanPair& pair, const LinkageMotion& motion, double multiplier) {
  if (const auto* curve = std::get_if<CurvePair>(&pair.kind)) {
    const PairRow row = row_now(pair, motion);
    return curve_force(*curve, motion, multiplier * curve->scale, -row.shares[0].turning / curve->scale);
  }
  if (const auto* strand = std::get_if<StrandPair>(&pair.kind))
    return strand_force(*strand, motion, multiplier);
  // What the programme of a cam exerts on the moved joint: its contact gives it another form.
  if (const auto* cam = std::get_if<CamPair>(&pair.kind))
    return {motion.parts[at(cam->moved_second.part)].origin,
            {0, 0},
            multiplier * (cam->slide ? 1 : cam->scale),
            nan,
            nan};
  if (const auto* slot = std::get_if<SlotPair>(&pair.kind)) {
    const PairRow row = row_now(pair, motion);
    return {point_on(motion.parts[at(slot->pin.part)], slot->pin.at), multiplier * row.shares[0].force, 0,
            nan, nan};
  }
  const RackPair& rack = std::get<RackPair>(pair.kind);
  const math::Vec2 along = rotate(motion.parts[at(rack.rack.part)].direction, rack.rack.direction),
                   left = perpendicular(along);
  JointReaction out;
  out.point = point_on(motion.parts[at(rack.pinion.part)], rack.pinion.at) - rack.radius * left;
  out.tangential = -multiplier;
  out.separating = std::abs(multiplier) * rack.tangent;
  out.force = out.tangential * along + (rack.radius > 0 ? -out.separating : out.separating) * left;
  return out;
}

// The multipliers of all equations, from what the parts of the group need.
void solve_multipliers(const Group& g, double size, std::span<const Wrench<double>> needed,
                       GeneralGroupMemory& m) {
  for (int p : g.parts) {
    const int c = m.column[at(p)];
    m.residual[c] = needed[at(p)].force.x;
    m.residual[c + 1] = needed[at(p)].force.y;
    m.residual[c + 2] = needed[at(p)].moment / size;
  }
  solve_transposed(m);
}

}  // namespace

void general_forces(const LinkagePlan& plan, const Group& g, const LinkageMotion& motion,
                    GeneralGroupMemory& m, std::span<Wrench<double>> needed, std::span<Wrench<double>> joints,
                    std::span<double> drives, std::span<JointReaction> gears) {
  if (g.as<GearTrain>()) factorise(plan, g, motion, m);
  solve_multipliers(g, plan.size, needed, m);
  // The torques of the gears are right already. Forces of teeth do the same work as these torques in every
  // motion, so that they change only the forces of the pins.
  const Index first_pair = m.solution.size() - static_cast<Index>(g.pairs.size());
  const Index first_gear = first_pair - static_cast<Index>(g.gears.size());
  bool teeth = false;
  const auto press = [&](const JointReaction& load, int first, int second) {
    for (const auto& [part, side] : {std::pair{second, 1.0}, {first, -1.0}})
      needed[at(part)] = needed[at(part)] - shifted(Wrench<double>{side * load.force, 0},
                                                    load.point - motion.parts[at(part)].origin);
    teeth = true;
  };
  for (std::size_t k = 0; k < g.gears.size(); ++k) {
    const PlanGear& gear = g.gears[k];
    const double torque = m.solution[first_gear + static_cast<Index>(k)] * plan.size;
    gears[k] = {motion.parts[at(gear.part)].origin, {0, 0}, torque, nan, nan};
    if (gear.strand >= 0) {
      const StrandPair& run = plan.strands[at(gear.strand)].run;
      gears[k] = strand_force(run, motion, -torque / run.second_radius);
      press(gears[k], run.first.part, run.second.part);
    } else if (gear.mesh) {
      gears[k] = mesh_force(*gear.mesh, motion, torque);
      press(gears[k], gear.mesh->first.part, gear.mesh->second.part);
    } else {
      continue;
    }
    for_angles(gear, [&](int part, double share) { needed[at(part)].moment += share * torque; });
  }
  // A pair carries its own force already, but for what presses pinion and rack apart.
  for (std::size_t k = 0; k < g.pairs.size(); ++k) {
    JointReaction& load = gears[g.gears.size() + k];
    const double multiplier = m.solution[first_pair + static_cast<Index>(k)];
    load = pair_force(g.pairs[k], motion, multiplier);
    if (const auto* curve = std::get_if<CurvePair>(&g.pairs[k].kind)) {
      if (std::isnan(load.tangential)) continue;
      press(load, curve->mesh->first.part, curve->mesh->second.part);
      for (const PairShare& s : row_now(g.pairs[k], motion).shares)
        needed[at(s.part)].moment += s.moment * multiplier;
    }
    if (!std::holds_alternative<RackPair>(g.pairs[k].kind) || !(load.separating > 0)) continue;
    const RackPair& rack = std::get<RackPair>(g.pairs[k].kind);
    JointReaction apart = load;
    const math::Vec2 along = rotate(motion.parts[at(rack.rack.part)].direction, rack.rack.direction);
    apart.force = load.force - load.tangential * along;
    press(apart, rack.pinion.part, rack.rack.part);
  }
  if (teeth) solve_multipliers(g, plan.size, needed, m);
  Index row = 0;
  for (std::size_t k = 0; k < g.joints.size(); ++k) {
    const PlanJoint& j = g.joints[k];
    const bool driven = j.input >= 0;
    const JointRows r = joint_rows(j, driven, motion.parts);
    Wrench<double> w{{0, 0}, 0};
    drives[k] = nan;
    for (int i = 0; i < r.count; ++i, ++row) {
      const JointEquation& e = r.rows[at(i)];
      const double multiplier = m.solution[row];
      w.force = w.force + multiplier * e.force;
      w.moment += multiplier * e.moment * plan.size;
      if (i == 2) drives[k] = multiplier * (e.moment != 0 ? plan.size : 1.0);
    }
    joints[k] = w;
    for (const auto& [part, side] : {std::pair{j.after.part, -1.0}, std::pair{j.before.part, 1.0}})
      if (m.column[at(part)] < 0) {
        const Wrench<double> there = shifted(w, r.point - motion.parts[at(part)].origin);
        needed[at(part)] = {needed[at(part)].force + side * there.force,
                            needed[at(part)].moment + side * there.moment};
      }
  }
  for (std::size_t k = 0; k < g.gears.size(); ++k)
    for_angles(g.gears[k], [&](int part, double share) {
      if (m.column[at(part)] < 0)
        needed[at(part)].moment -= share * m.solution[first_gear + static_cast<Index>(k)] * plan.size;
    });
  for (std::size_t k = 0; k < g.pairs.size(); ++k) {
    const double multiplier = m.solution[first_pair + static_cast<Index>(k)];
    for (const PairShare& s : row_now(g.pairs[k], motion).shares)
      if (m.column[at(s.part)] < 0) {
        needed[at(s.part)].force = needed[at(s.part)].force - multiplier * s.force;
        needed[at(s.part)].moment -= multiplier * s.moment;
      }
  }
}

}  // namespace linkwright::planar
