// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/zero.h"
#include "linkwright/planar/simulation/detail/simulation_run.h"

// The behaviour of a simulation at change points: passes them smoothly, or turns onto the other branch.
namespace linkwright::planar {
namespace {

constexpr std::size_t kept_passages = 1000;

}  // namespace

Simulation::Answer Simulation::interpolated(double t, double centre, double x) {
  const ChangeZone::Weights weights = ChangeZone::interpolation(x);
  const double value = inputs_[0].value;
  double acceleration = 0;
  Answer out;
  for (std::size_t i = 0; i < ChangeZone::nodes.size() && out.status == Status::done; ++i) {
    inputs_[0].value = centre + ChangeZone::nodes[i] * branch_->half_width();
    branch_->set_modes(inputs_[0].value, dynamics_.motion);
    out.status = dynamics_.solve(t, inputs_);
    acceleration += weights[i] * inputs_[0].acceleration;
    out.power += weights[i] * dynamics_.power;
    out.inertia += weights[i] * first_inertia();
    out.friction_power += weights[i] * dynamics_.friction_power;
  }
  inputs_[0].value = value;
  inputs_[0].acceleration = acceleration;
  return out;
}

double Simulation::interpolated_potential() {
  const InputMotion here = inputs_[0];
  const SmoothBranch::Near near = branch_->nearest(here.value);
  const ChangeZone::Weights weights =
      ChangeZone::interpolation((here.value - near.value) / branch_->half_width());
  double sum = 0;
  for (std::size_t i = 0; i < ChangeZone::nodes.size(); ++i) {
    inputs_[0].value = near.value + ChangeZone::nodes[i] * branch_->half_width();
    sum += weights[i] * potential_energy(l_, plan_, placed());
  }
  inputs_[0] = here;
  placed();
  return sum;
}

void Simulation::neighbours(double value) {
  below_ = -infinity;
  above_ = infinity;
  if (!branch_ || !branch_->has_change_points()) return;
  const SmoothBranch::Near down = branch_->next(value, -1), up = branch_->next(value, 1);
  if (down.end) below_ = down.value;
  if (up.end) above_ = up.value;
}

void Simulation::note_passage(ChangePassage passage) {
  ++report_.passage_count;
  changed_at_ = passage.value;
  if (report_.passages.size() < kept_passages) report_.passages.push_back(std::move(passage));
}

void Simulation::note_passages(double from, const InputMotion& before) {
  if (!branch_->has_change_points() || options_.at_change_point != AtChangePoint::smooth) return;
  const InputMotion& now = inputs_[0];
  const double sense = now.value > before.value ? 1 : -1, span = last_time_ - from;
  double value = before.value;
  while (true) {
    const SmoothBranch::Near next = branch_->next(value, sense);
    if (!next.end || (next.value - now.value) * sense > 0) return;
    value = next.value;
    const auto yet_before = [&](double s) {
      const double r = 1 - s;
      const double there = before.value * r * r * (1 + 2 * s) + now.value * s * s * (1 + 2 * r) +
                           span * s * r * (r * before.rate - s * now.rate);
      return (there - value) * sense < 0;
    };
    const double share = math::bisect(yet_before, 0, 1, {.halvings = 50}).inside;
    note_passage({from + span * share, value, next.end->groups, 0});
  }
}

std::vector<PartState<double>> Simulation::unit_motion(double value) {
  std::vector<PartState<double>> sum(plan_.parts.size());
  for (PartState<double>& s : sum) s = {{0, 0}, {0, 0}, {0, 0}, 0, {0, 0}, 0};
  const ChangeZone::Weights weights = ChangeZone::interpolation(0);
  for (std::size_t i = 0; i < ChangeZone::nodes.size(); ++i) {
    const InputMotion there{value + ChangeZone::nodes[i] * branch_->half_width(), 1, 0};
    branch_->set_modes(there.value, dynamics_.motion);
    solve_motion(plan_, std::span(&there, 1), dynamics_.motion);
    if (dynamics_.motion.status != Status::done) return {};
    for (std::size_t p = 1; p < sum.size(); ++p) {
      const PartState<double>& s = dynamics_.motion.parts[p];
      sum[p].origin = sum[p].origin + weights[i] * s.origin;
      sum[p].direction = sum[p].direction + weights[i] * s.direction;
      sum[p].velocity = sum[p].velocity + weights[i] * s.velocity;
      sum[p].speed += weights[i] * s.speed;
    }
  }
  return sum;
}

std::optional<double> Simulation::kink(double value, double sense, double& rate) {
  const std::vector<PartState<double>> before = unit_motion(value);
  branch_->set_modes(value - sense * branch_->half_width(), dynamics_.motion);
  const std::vector<double> kept = dynamics_.motion.modes;
  branch_.emplace(plan_, value + sense * branch_->half_width(), kept);
  if (branch_->path().status != Status::done) return {};
  const std::vector<PartState<double>> after = unit_motion(value);
  if (before.empty() || after.empty()) return {};
  for (std::size_t p = 1; p < before.size(); ++p)
    if (norm(after[p].origin - before[p].origin) > 1e-6 * plan_.size ||
        norm(after[p].direction - before[p].direction) > 1e-6)
      return {};
  const auto inertia = [&](const std::vector<PartState<double>>& a, const std::vector<PartState<double>>& b) {
    double sum = 0;
    for (std::size_t p = 1; p < a.size(); ++p) {
      const PartMass& m = plan_.masses[p];
      const math::Vec2 arm = rotate(before[p].direction, m.moment);
      sum += m.mass * dot(a[p].velocity, b[p].velocity) + a[p].speed * cross(arm, b[p].velocity) +
             b[p].speed * cross(arm, a[p].velocity) + m.inertia * a[p].speed * b[p].speed;
    }
    return sum;
  };
  const double new_rate = rate * inertia(before, after) / inertia(after, after);
  const double lost =
      (inertia(before, before) * rate * rate - inertia(after, after) * new_rate * new_rate) / 2;
  rate = new_rate;
  return lost;
}

}  // namespace linkwright::planar
