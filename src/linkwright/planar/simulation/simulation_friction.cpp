#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

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
  if (!(square > 1e-12)) return false;  // the joint stands still whatever moves
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

bool Simulation::holds(double t) {
  const std::size_t k = dynamics_.free()[0];
  const double value = inputs_[k].value;
  for (const double sense : {1.0, -1.0}) {
    inputs_[k] = {value, sense * 1e-9, 0};
    // Where there is no answer it cannot move in this sense.
    if (solve(t).status == Status::done && !(inputs_[k].acceleration * sense < 0)) return false;
  }
  return true;
}

}  // namespace linkwright::planar
