// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/redundant.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numeric>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/math/dense.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

using math::Vec2;

constexpr double redundant_rank = 1e-9, stress_rounding = 1e-6, closed_gap = 1e-10;

// One equation: x, y and turn of the first body and of the second.
struct ConstraintRow {
  int joint, first, second;
  std::array<double, 3> of_first, of_second;
};

// The equation of the second body's point along a direction of the first one's frame, at a place.
ConstraintRow along(int joint, const LinkageJoint& j, std::span<const PartState<double>> bodies, Vec2 place,
                    Vec2 direction, double size) {
  const Vec2 a = place - bodies[at(j.first.body)].origin, b = place - bodies[at(j.second.body)].origin;
  return {joint,
          j.first.body,
          j.second.body,
          {-direction.x, -direction.y, -cross(a, direction) / size},
          {direction.x, direction.y, cross(b, direction) / size}};
}

std::optional<std::vector<ConstraintRow>> rows_of_joints(const Linkage& l, double size,
                                                         std::span<const PartState<double>> bodies,
                                                         std::span<const int> as_pins) {
  if (!l.belts.empty() || !l.cams.empty()) return std::nullopt;
  std::vector<ConstraintRow> out;
  for (int k = 0; k < static_cast<int>(l.joints.size()); ++k) {
    const LinkageJoint& j = l.joints[at(k)];
    if (has_teeth(j.type) || j.slot) return std::nullopt;
    const PartState<double>& second = bodies[at(j.second.body)];
    const Vec2 place = point_on(second, math::vec(place_of(l, j.second)));
    const Vec2 slide = rotate(bodies[at(j.first.body)].direction, math::unit(j.slide_first));
    const bool pin = j.type == JointType::revolute || j.type == JointType::fixed ||
                     std::find(as_pins.begin(), as_pins.end(), k) != as_pins.end();
    if (pin) {
      out.push_back(along(k, j, bodies, place, {1, 0}, size));
      out.push_back(along(k, j, bodies, place, {0, 1}, size));
    } else {
      out.push_back(along(k, j, bodies, place, perpendicular(slide), size));
    }
    if (j.type == JointType::prismatic || j.type == JointType::fixed)
      out.push_back({k, j.first.body, j.second.body, {0, 0, -1}, {0, 0, 1}});
  }
  return out;
}

std::vector<PartState<double>> drawn_bodies(const Linkage& l) {
  std::vector<PartState<double>> out;
  for (std::size_t b = 0; b < l.bodies.size(); ++b) {
    PartState<double> state{{0, 0}, {1, 0}, {0, 0}, 0, {0, 0}, 0};
    if (b > 0 && !l.bodies[b].start) return {};
    if (b > 0) {
      state.origin = {l.bodies[b].start->x, l.bodies[b].start->y};
      state.direction = math::unit(l.bodies[b].start->angle);
    }
    out.push_back(state);
  }
  return out;
}

}  // namespace

std::vector<int> ConstraintRank::joints_in_stress() const {
  std::vector<int> out;
  for (const std::vector<double>& stress : self_stress)
    for (std::size_t i = 0; i < stress.size(); ++i)
      if (std::abs(stress[i]) > stress_rounding) out.push_back(joint[i]);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::optional<ConstraintRank> constraint_rank(const Linkage& l, double size,
                                              std::span<const PartState<double>> bodies,
                                              std::span<const int> as_pins) {
  const auto rows = rows_of_joints(l, size, bodies, as_pins);
  if (!rows || rows->empty() || l.bodies.size() < 2) return std::nullopt;
  ConstraintRank out{.coordinates = 3 * (static_cast<int>(l.bodies.size()) - 1),
                     .equations = static_cast<int>(rows->size())};
  // Transposed: one column an equation, so that the null space is that of forces which balance each other.
  const auto n = at(out.coordinates), m = rows->size();
  std::vector<double> matrix(n * m, 0.0);
  for (std::size_t c = 0; c < m; ++c) {
    const ConstraintRow& row = (*rows)[c];
    for (std::size_t k = 0; k < 3; ++k) {
      if (row.first > 0) matrix[c * n + 3 * (at(row.first) - 1) + k] += row.of_first[k];
      if (row.second > 0) matrix[c * n + 3 * (at(row.second) - 1) + k] += row.of_second[k];
    }
    out.joint.push_back(row.joint);
  }
  const math::SingularVectors found = math::singular_vectors(matrix, m);
  const double greatest = found.values.empty() ? 0 : found.values.front();
  for (const double value : found.values) out.rank += value > redundant_rank * greatest ? 1 : 0;
  for (std::size_t k = at(out.rank); k < m; ++k)
    out.self_stress.emplace_back(found.right.begin() + static_cast<std::ptrdiff_t>(k * m),
                                 found.right.begin() + static_cast<std::ptrdiff_t>((k + 1) * m));
  return out;
}

double relaxed_gap(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, int joint) {
  const auto place = [&](const BodyPoint& p) { return point_motion(l, plan, motion, p).position; };
  return norm(place(l.joints[at(joint)].second) - place(l.joints[at(joint)].first));
}

namespace {

// The greatest gap of the pin at steps of the inputs about the drawing, both ways; infinite where it does not
// assemble.
double gap_in_motion(const Linkage& l, const LinkagePlan& plan, int joint) {
  if (plan.drawn_inputs.empty()) return infinity;
  LinkageMotion motion(plan);
  double worst = 0;
  for (std::size_t k = 0; k < plan.inputs(); ++k)
    for (const double step : {0.0, 1e-3, 2e-3, 3e-3, -1e-3, -2e-3, -3e-3}) {
      std::vector<InputMotion> inputs;
      for (const double value : plan.drawn_inputs) inputs.push_back({value, 0, 0});
      inputs[k].value += step * (plan.rotary[k] ? 1 : plan.size);
      solve_position(plan, inputs, motion);
      if (motion.status != Status::done) return infinity;
      worst = std::max(worst, relaxed_gap(l, plan, motion, joint));
    }
  return worst;
}

}  // namespace

std::optional<RelaxedLinkage> relax_redundant(const Linkage& linkage, std::string& why) {
  const std::vector<PartState<double>> bodies = drawn_bodies(linkage);
  if (bodies.empty()) return std::nullopt;
  const double size = size_of(linkage);
  auto rank = constraint_rank(linkage, size, bodies);
  if (!rank || rank->redundant() == 0) return std::nullopt;
  const std::vector<int> candidates = rank->joints_in_stress();
  double least = infinity;
  // Those that close loops last come first.
  for (auto k = candidates.rbegin(); k != candidates.rend(); ++k) {
    const LinkageJoint& pin = linkage.joints[at(*k)];
    const bool is_driven =
        std::find(linkage.driven.begin(), linkage.driven.end(), *k) != linkage.driven.end();
    if (pin.type != JointType::revolute || is_driven || pin.friction > 0) continue;
    for (const bool swapped : {false, true}) {
      const BodyPoint slot = swapped ? pin.second : pin.first, other = swapped ? pin.first : pin.second;
      for (const LinkageJoint& beside : linkage.joints) {
        if (&beside == &pin || slot.body == 0) continue;
        const BodyPoint* near = beside.first.body == slot.body    ? &beside.first
                                : beside.second.body == slot.body ? &beside.second
                                                                  : nullptr;
        if (!near) continue;
        const std::vector<LinkagePoint>& points = linkage.bodies[at(slot.body)].points;
        const std::complex<double> way = points[at(slot.point)].at - points[at(near->point)].at;
        if (std::abs(way) < 1e-9 * size) continue;
        RelaxedLinkage out{.linkage = linkage, .joint = *k, .drawn = *rank};
        LinkageJoint& relaxed = out.linkage.joints[at(*k)];
        relaxed.type = JointType::pin_in_slot;
        relaxed.first = slot, relaxed.second = other;
        relaxed.slide_first = std::arg(way), relaxed.slide_second = 0;
        PlanResult planned = plan_linkage(out.linkage);
        if (!planned.problems.empty()) continue;
        out.plan = std::move(planned.plan);
        const double gap = gap_in_motion(out.linkage, out.plan, *k);
        if (gap <= closed_gap * size) return out;
        if (gap < least) {
          least = gap;
          why = fmt::format(
              "the linkage cannot move: with the drive 0.003 away from the drawing (rad, or sizes of the "
              "linkage) "
              "joint '{}' would be open by {:.4g} mm",
              pin.name, 1e3 * gap);
        }
      }
    }
  }
  return std::nullopt;
}

namespace {

// The force or moment of one equation: its joint and direction, or the moment of the joint.
struct StressRow {
  int joint = 0;
  Vec2 direction{0, 0};
  bool is_moment = false;
};

std::vector<StressRow> stress_rows(const Linkage& l, std::span<const PartState<double>> bodies,
                                   const ConstraintRank& rank, int as_pin) {
  std::vector<StressRow> out;
  while (out.size() < rank.joint.size()) {
    const int k = rank.joint[out.size()];
    const LinkageJoint& j = l.joints[at(k)];
    if (j.type == JointType::revolute || j.type == JointType::fixed || k == as_pin) {
      out.push_back({k, {1, 0}});
      out.push_back({k, {0, 1}});
    } else {
      const Vec2 slide = rotate(bodies[at(j.first.body)].direction, math::unit(j.slide_first));
      out.push_back({k, perpendicular(slide)});
    }
    if (j.type == JointType::prismatic || j.type == JointType::fixed) out.push_back({k, {0, 0}, true});
  }
  return out;
}

// The axial force of a bar by the rows: half of what each of its two pins pulls. Nothing for a body with
// another number of pins.
std::vector<double> axial_row(const Linkage& l, std::span<const PartState<double>> bodies,
                              const std::vector<StressRow>& rows, int body) {
  std::vector<int> pins;
  for (int k = 0; k < static_cast<int>(l.joints.size()); ++k)
    if (l.joints[at(k)].first.body == body || l.joints[at(k)].second.body == body) pins.push_back(k);
  if (pins.size() != 2) return {};
  const auto place = [&](int joint) {
    const LinkageJoint& j = l.joints[at(joint)];
    return point_on(bodies[at(body)], math::vec(place_of(l, j.first.body == body ? j.first : j.second)));
  };
  const Vec2 way = place(pins[1]) - place(pins[0]);
  if (!(norm(way) > 0)) return {};
  const Vec2 along = (1 / norm(way)) * way;
  std::vector<double> out(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].is_moment || (rows[i].joint != pins[0] && rows[i].joint != pins[1])) continue;
    const double on_body = l.joints[at(rows[i].joint)].second.body == body ? 1 : -1;
    const double pulls = rows[i].joint == pins[1] ? 1 : -1;
    out[i] = on_body * pulls / 2 * dot(along, rows[i].direction);
  }
  return out;
}

double dot_of(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

// Twice the energy of pairs of forces, by the rule.
class StressEnergy {
 public:
  StressEnergy(const Linkage& l, std::span<const PartState<double>> bodies,
               const std::vector<StressRow>& rows, RedundantForces rule)
      : weights_(rows.size(), 1.0) {
    if (rule == RedundantForces::least_squares) return;
    for (std::size_t i = 0; i < rows.size(); ++i) weights_[i] = l.joints[at(rows[i].joint)].compliance;
    for (int b = 1; b < static_cast<int>(l.bodies.size()); ++b) {
      if (!(l.bodies[at(b)].stiffness > 0)) continue;
      std::vector<double> row = axial_row(l, bodies, rows, b);
      if (!row.empty()) bars_.emplace_back(std::move(row), 1 / l.bodies[at(b)].stiffness);
    }
  }
  double operator()(const std::vector<double>& a, const std::vector<double>& b) const {
    double sum = 0;
    for (std::size_t i = 0; i < weights_.size(); ++i) sum += weights_[i] * a[i] * b[i];
    for (const auto& [row, compliance] : bars_) sum += compliance * dot_of(row, a) * dot_of(row, b);
    return sum;
  }
  // The matrix of the energy over the self-stresses.
  std::vector<double> matrix(const std::vector<std::vector<double>>& stresses) const {
    std::vector<double> out;
    for (const auto& a : stresses)
      for (const auto& b : stresses) out.push_back((*this)(a, b));
    return out;
  }

 private:
  std::vector<double> weights_;
  std::vector<std::pair<std::vector<double>, double>> bars_;  // axial forces and compliances (m/N)
};

}  // namespace

bool gives_way(const Linkage& drawn, const ConstraintRank& rank) {
  const std::vector<PartState<double>> bodies = drawn_bodies(drawn);
  const StressEnergy energy(drawn, bodies, stress_rows(drawn, bodies, rank, -1), RedundantForces::compliance);
  const std::vector<double> matrix = energy.matrix(rank.self_stress);
  const std::vector<double> values = math::singular_vectors(matrix, rank.self_stress.size()).values;
  return !values.empty() && values.back() > 1e-9 * values.front();
}

std::vector<JointReaction> self_stress_forces(const Linkage& drawn, const ConstraintRank& rank,
                                              std::size_t stress) {
  const std::vector<StressRow> rows = stress_rows(drawn, drawn_bodies(drawn), rank, -1);
  std::vector<JointReaction> out(drawn.joints.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    JointReaction& r = out[at(rows[i].joint)];
    if (rows[i].is_moment)
      r.moment = rank.self_stress[stress][i] * size_of(drawn);
    else
      r.force = r.force + rank.self_stress[stress][i] * rows[i].direction;
  }
  return out;
}

void spread_forces(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion, int joint,
                   RedundantForces rule, LinkageForces& forces) {
  if (forces.status != Status::done) return;
  std::vector<PartState<double>> bodies;
  for (int b = 0; b < static_cast<int>(l.bodies.size()); ++b) bodies.push_back(body_state(plan, motion, b));
  const int pins[] = {joint};
  const auto rank = constraint_rank(l, plan.size, bodies, pins);
  if (!rank || rank->self_stress.empty()) return;
  // The forces of the joints in the order of the equations; moments by the size.
  const std::vector<StressRow> rows = stress_rows(l, bodies, *rank, joint);
  std::vector<double> now;
  for (const StressRow& row : rows) {
    const JointReaction& r = forces.joints[at(row.joint)];
    now.push_back(row.is_moment ? r.moment / plan.size : dot(row.direction, r.force));
  }
  const StressEnergy energy(l, bodies, rows, rule);
  std::vector<double> right;
  for (const std::vector<double>& stress : rank->self_stress) right.push_back(-energy(stress, now));
  const std::vector<double> shares = math::solve_symmetric(energy.matrix(rank->self_stress), right);
  for (std::size_t k = 0; k < shares.size(); ++k)
    for (std::size_t i = 0; i < rows.size(); ++i) {
      JointReaction& r = forces.joints[at(rows[i].joint)];
      const double change = shares[k] * rank->self_stress[k][i];
      if (rows[i].is_moment)
        r.moment += change * plan.size;
      else
        r.force = r.force + change * rows[i].direction;
    }
}

}  // namespace linkwright::planar
