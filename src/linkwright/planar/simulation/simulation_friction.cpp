// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/math/zero.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/simulation/detail/simulation_run.h"

// Friction in a simulation: joints that stick, chatter or lock.
namespace linkwright::planar {
namespace {

// Friction chatters when a joint turns round in a tenth of so many steps, and these take so small a share of
// the time.
constexpr long chatter_steps = 100;
constexpr double chatter_share = 1e-5;

}  // namespace

bool Simulation::chatters(double t) {
  if (senses_.empty()) {
    senses_.assign(l_.joints.size(), 0.0);
    turns_.assign(l_.joints.size(), 0);
    window_ = t;
  }
  solve(t);
  const double largest = fastest();
  largest_rate_ = std::max(largest_rate_, largest);
  for (std::size_t j = 0; j < l_.joints.size(); ++j) {
    if (l_.joints[j].friction == 0) continue;
    const double rate = joint_motion(l_, plan_, dynamics_.motion, static_cast<int>(j)).rate;
    const double sense = rate > 0 ? 1 : rate < 0 ? -1 : 0;
    turns_[j] += senses_[j] * sense < 0;
    senses_[j] = sense;
  }
  if (++steps_ % chatter_steps != 0) return false;
  const auto most = std::max_element(turns_.begin(), turns_.end());
  const bool creeps = t - window_ < chatter_share * span_, still = creeps && *most >= chatter_steps / 10;
  jammed_ = creeps && !still && locks_ahead(t);
  if (still) {
    chattering_ = static_cast<int>(most - turns_.begin());
    rests_ = largest < 1e-5 * largest_rate_;
  }
  window_ = t;
  std::fill(turns_.begin(), turns_.end(), 0);
  return still || jammed_;
}

bool Simulation::locks_ahead(double t) {
  const std::vector<InputMotion> here = inputs_;
  for (const std::size_t k : dynamics_.free())
    inputs_[k].value += std::copysign(1e-6 * (plan_.rotary[k] ? 1 : plan_.size), inputs_[k].rate);
  const bool locks = solve(t).status == Status::self_locking;
  inputs_ = here;
  restore();
  return locks;
}

double Simulation::fastest() const {
  double largest = 0;
  for (const std::size_t k : dynamics_.free()) largest = std::max(largest, std::abs(inputs_[k].rate));
  return largest;
}

void Simulation::rubbing_rates(double t, std::span<const double> y) {
  put(t, y);
  LinkageMotion& motion = dynamics_.motion;
  solve_position(plan_, inputs_, motion);
  if (motion.status != Status::done) return restore();
  solve_velocity(plan_, inputs_, motion);
  for (std::size_t i = 0; i < rubbing_.size(); ++i)
    rates_[i] = joint_motion(l_, plan_, motion, rubbing_[i]).rate;
}

bool Simulation::sticks(double t, int joint) {
  const std::vector<InputMotion> here = inputs_;
  LinkageMotion& motion = dynamics_.motion;
  const auto rate_of = [&](std::span<const InputMotion> inputs) {
    solve_velocity(plan_, inputs, motion);
    return joint_motion(l_, plan_, motion, joint).rate;
  };
  solve_position(plan_, here, motion);
  const double rate = rate_of(here);
  std::vector<double> share;
  double square = 0;
  for (const std::size_t k : dynamics_.free()) {
    std::vector<InputMotion> one = here;
    for (InputMotion& i : one) i.rate = 0;
    one[k].rate = 1;
    share.push_back(rate_of(one));
    square += share.back() * share.back();
  }
  if (!(square > 1e-12)) return false;  // the joint is at rest whatever moves
  bool stopped = true;
  for (const double sense : {1.0, -1.0}) {
    inputs_ = here;
    const double wanted = sense * 1e-9 - rate;
    for (std::size_t i = 0; i < share.size(); ++i)
      inputs_[dynamics_.free()[i]].rate += wanted * share[i] / square;
    if (solve(t).status != Status::done) continue;  // it cannot move in this sense
    solve_motion(plan_, inputs_, motion);
    stopped = stopped && joint_motion(l_, plan_, motion, joint).acceleration * sense < 0;
  }
  inputs_ = here;
  return stopped;
}

Simulation::Push Simulation::push_from_rest(double t) {
  const std::vector<InputMotion> here = inputs_;
  const bool resting = std::exchange(resting_, false);
  Push most{-1, 0};  // without an answer it cannot move in this sense
  for (const double sense : {1.0, -1.0}) {
    inputs_ = here;
    free_input() = {free_input().value, sense * slowest(), 0};
    if (solve(t).status != Status::done) continue;
    const double acceleration = free_input().acceleration * sense;
    if (most.sense == 0 || acceleration > most.acceleration) most = {acceleration, sense};
  }
  resting_ = resting;
  inputs_ = here;
  return most;
}

bool Simulation::may_be_freed(double t) const {
  const auto changes = [&](const auto& load) {
    const LoadFactor& f = load.factor;
    return f.against == LoadArgument::time && (period_of(f, false) > 0 || t < f.argument.back());
  };
  return !laws_.empty() || std::any_of(l_.forces.begin(), l_.forces.end(), changes) ||
         std::any_of(l_.torques.begin(), l_.torques.end(), changes) ||
         std::any_of(l_.struts.begin(), l_.struts.end(), changes);
}

math::OdeAction Simulation::come_to_rest(double t, std::span<double> y) {
  resting_ = true;
  resting_since_ = t;
  y[1] = 0;
  stuck_ = !may_be_freed(t);
  return stuck_ ? math::OdeAction::stop : math::OdeAction::restart;
}

void Simulation::set_free(double t, std::span<double> y) {
  const double sense = push_from_rest(t).sense;
  end_rest(t);
  resting_ = false;
  y[1] = sense * slowest();
}

void Simulation::end_rest(double t) {
  FrictionRests& rests = report_.rests;
  if (++rests.count == 1) rests.first_from = resting_since_, rests.first_to = t;
  rests.total += t - resting_since_;
}

Simulation::Answer Simulation::solve_at_rest(double t) {
  free_input() = {free_input().value, 0, 0};
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  solve_motion(plan_, inputs_, dynamics_.motion);
  Answer answer{dynamics_.motion.status, 0, first_inertia()};
  if (answer.status != Status::done || laws_.empty()) return answer;
  const LinkageForces& forces = forces_at_rest(t);
  answer.status = forces.status;
  answer.power = lasting_power(l_, plan_, dynamics_.motion, forces.loads);
  for (const auto& law : laws_) answer.power += forces.drives[law.input] * inputs_[law.input].rate;
  return answer;
}

const LinkageForces& Simulation::forces_at_rest(double t) {
  if (!yielding_) yielding_.emplace(l_);
  const std::vector<InputMotion> here = inputs_;
  const std::size_t k = dynamics_.free()[0];
  LinkageMotion& motion = dynamics_.motion;
  for (InputMotion& i : inputs_) i.rate = 0;
  inputs_[k].rate = 1;
  solve_velocity(plan_, inputs_, motion);
  std::vector<int> holding;
  for (std::size_t j = 0; j < l_.joints.size(); ++j)
    if (l_.joints[j].friction > 0 && joint_motion(l_, plan_, motion, static_cast<int>(j)).rate != 0)
      holding.push_back(static_cast<int>(j));
  inputs_ = here;

  // The force that a drive of the free input would have to add, with a part of the friction.
  const auto missing = [&](double part, double sense) {
    for (const int j : holding) yielding_->joints[at(j)].friction = part * l_.joints[at(j)].friction;
    inputs_[k] = {here[k].value, sense * slowest(), 0};
    solve_motion(plan_, inputs_, motion);
    solve_forces(*yielding_, plan_, motion, t, inputs_[0].value, held_);
    return held_.drives[k];
  };
  const double without = missing(0, 0);
  if (without == 0) return held_;  // nothing pushes
  const double sense = without > 0 ? -1 : 1;
  const double with_all = missing(1, sense);
  // At the moment at which friction gives way rounding may leave it too small by a digit.
  if (held_.status == Status::done && (with_all < 0) != (without < 0)) {
    // Friction that locks holds, too.
    const auto left = [&](double part) {
      const double force = missing(part, sense);
      return held_.status == Status::done ? force : with_all;
    };
    missing(math::zero_between(left, 0, 1), sense);
  }
  inputs_ = here;
  solve_motion(plan_, inputs_, motion);
  return held_;
}

}  // namespace linkwright::planar
