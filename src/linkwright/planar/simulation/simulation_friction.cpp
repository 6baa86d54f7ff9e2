// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/simulation/detail/simulation_run.h"

// Friction in a simulation: joints that slide, stick and lock.
namespace linkwright::planar {
namespace {

// So many steps that take so small a share of the time are looked at for friction that locks.
constexpr long jam_steps = 100;
constexpr double jam_share = 1e-5;
// Events that follow each other this closely (share of the span) are counted, and so many end the run.
constexpr double quick_share = 1e-12;
constexpr long most_quick_events = 200;
constexpr std::size_t kept_events = 10000;

// A sticking joint is at its limit from this share of what it can bear on; there a decision counts on less,
// so that it begins to slide.
constexpr double at_limit_share = 1 - 1e-9, reserve_at_limit = 1 - 1e-6;
constexpr double rounding_share = 1e-12;
// A rate is zero below this share of the largest one of the joint.
constexpr double zero_rate = 1e-10;
// Share of the largest joint force that a normal force passes zero by before it is another flank.
constexpr double flank_share = 1e-11;

}  // namespace

double Simulation::rate_of(int joint) const { return joint_motion(l_, plan_, dynamics_.motion, joint).rate; }

std::vector<double> Simulation::shares_of(int joint) {
  std::vector<InputMotion> one = inputs_;
  for (InputMotion& i : one) i.rate = i.acceleration = 0;
  std::vector<double> out;
  for (const std::size_t k : dynamics_.free()) {
    one[k].rate = 1;
    solve_velocity(plan_, one, dynamics_.motion);
    out.push_back(rate_of(joint));
    one[k].rate = 0;
  }
  return out;
}

Status Simulation::solve_here(double t) {
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  const Status status = solve_pressed(t);
  if (status != Status::done) restore();
  return status;
}

bool Simulation::any_sticks() const {
  return dynamics_.states && std::any_of(rubbing_.begin(), rubbing_.end(), [&](const Rubbing& r) {
           return dynamics_.states->senses[at(r.joint)] == 0;
         });
}

bool Simulation::start_friction(double t) {
  const auto moved_by_inputs = [&](int joint) {
    const std::vector<double> shares = shares_of(joint);
    return std::any_of(shares.begin(), shares.end(), [](double s) { return std::abs(s) > 1e-12; });
  };
  // A joint may be at its dead point just here: a place beside it tells, too.
  std::vector<bool> moved(l_.joints.size(), laws_.empty());
  if (!laws_.empty()) {
    const std::vector<InputMotion> here = inputs_;
    for (const double aside : {0.0, 0.01}) {
      inputs_ = here;
      for (const std::size_t k : dynamics_.free())
        inputs_[k].value += aside * (plan_.rotary[k] ? 1 : plan_.size);
      solve_position(plan_, inputs_, dynamics_.motion);
      if (dynamics_.motion.status != Status::done) continue;
      for (std::size_t j = 0; j < l_.joints.size(); ++j)
        moved[j] = moved[j] || (has_friction(l_.joints[j]) && moved_by_inputs(static_cast<int>(j)));
    }
    inputs_ = here;
    restore();
  }
  solve_position(plan_, inputs_, dynamics_.motion);
  if (dynamics_.motion.status != Status::done) return true;  // the start itself says why
  solve_velocity(plan_, inputs_, dynamics_.motion);
  FrictionStates& states = dynamics_.states.emplace(l_.joints.size());
  std::vector<bool> stops;
  for (std::size_t j = 0; j < l_.joints.size(); ++j) {
    const LinkageJoint& joint = l_.joints[j];
    if (!has_friction(joint) || !moved[j]) continue;
    const bool slide = joint.type != JointType::revolute;
    Rubbing r{.joint = static_cast<int>(j),
              .slide = slide && joint.guide_length == 0 &&
                       (friction_at_rest(joint) > 0 || !joint.friction_values.empty())};
    const double rate = rate_of(r.joint);
    r.largest = std::abs(rate);
    states.senses[j] = rate > 0 ? 1 : -1;
    stops.push_back(std::abs(rate) <= 1e-12 * (slide ? plan_.size : 1));
    rubbing_.push_back(r);
  }
  decide(t, stops);
  report_.friction_events.clear();
  report_.friction_event_count = 0;
  keep_states(t);
  stuck_ = resting_ && (options_.stop_at_rest || !may_be_freed(t));
  if (!resting_) return true;
  for (const std::size_t k : dynamics_.free())
    if (laws_.empty()) inputs_[k].rate = 0;
  return true;
}

bool Simulation::place_at(double t, std::span<const double> y, bool forces) {
  put(t, y);
  if (forces) return solve_here(t) == Status::done;
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  solve_position(plan_, inputs_, dynamics_.motion);
  const bool placed = dynamics_.motion.status == Status::done;
  if (placed)
    solve_velocity(plan_, inputs_, dynamics_.motion);
  else
    restore();
  return placed;
}

void Simulation::friction_values(double t, std::span<const double> y, std::span<double> values) {
  const FrictionStates& states = *dynamics_.states;
  const bool forces =
      any_sticks() || std::any_of(rubbing_.begin(), rubbing_.end(), [](const Rubbing& r) { return r.slide; });
  const bool placed = place_at(t, y, forces);
  double largest = 0;
  if (forces && placed)
    for (const JointReaction& r : dynamics_.forces().joints) largest = std::max(largest, norm(r.force));
  for (std::size_t i = 0; i < rubbing_.size(); ++i) {
    Rubbing& r = rubbing_[i];
    const std::size_t j = at(r.joint);
    // Where they are not known they stay what they were.
    const auto keep = [placed](double& last, double value) {
      if (placed && std::isfinite(value)) last = value;
      return last;
    };
    values[2 * i] = keep(r.stays, states.senses[j] == 0 ? 1 + r.margin - states.shares[j] : rate_of(r.joint));
    values[2 * i + 1] =
        r.slide ? keep(r.stays_flank, r.flank * states.normals[j] / largest + flank_share) : 1;
  }
}

bool Simulation::decide(double t, const std::vector<bool>& stops) {
  FrictionStates& states = *dynamics_.states;
  const std::vector<double> before = states.senses;
  for (std::size_t i = 0; i < rubbing_.size(); ++i)
    if (stops[i]) states.senses[at(rubbing_[i].joint)] = 0;
  states.decide = true;
  const Status status = solve_here(t);
  states.decide = false;
  std::fill(states.reserve.begin(), states.reserve.end(), 1.0);
  if (status != Status::done) {
    for (std::size_t i = 0; i < rubbing_.size(); ++i) {  // as it was; what follows says why it cannot go on
      double& sense = states.senses[at(rubbing_[i].joint)];
      if (stops[i]) sense = before[at(rubbing_[i].joint)];
    }
    return false;
  }
  for (const Rubbing& r : rubbing_) {
    const double was = before[at(r.joint)], sense = states.senses[at(r.joint)];
    if (was == sense) continue;
    note_friction(t, r.joint,
                  sense == 0 ? FrictionChange::sticks
                  : was == 0 ? FrictionChange::slips
                             : FrictionChange::reverses);
  }
  return true;
}

void Simulation::keep_states(double t) {
  const FrictionStates& states = *dynamics_.states;
  for (Rubbing& r : rubbing_) {
    const double share = states.shares[at(r.joint)], normal = states.normals[at(r.joint)];
    r.margin = rounding_share + (share > 1 ? share - 1 : 0);
    if (r.slide && std::isfinite(normal)) r.flank = normal < 0 ? -1 : 1;
  }
  const bool rests = states.held > 0 && states.held == dynamics_.free().size() && !any_closed();
  if (rests && !resting_) resting_since_ = t;
  if (!rests && resting_) end_rest(t);
  resting_ = rests;
}

void Simulation::rub_after_impact(double t, std::span<double> y, bool decided) {
  put(t, y);
  FrictionStates& states = *dynamics_.states;
  if (solve_here(t) != Status::done) return;
  std::vector<bool> stops(rubbing_.size(), false);
  for (std::size_t i = 0; i < rubbing_.size(); ++i) {
    Rubbing& r = rubbing_[i];
    const double rate = rate_of(r.joint), sense = rate > 0 ? 1 : -1, was = states.senses[at(r.joint)];
    r.largest = std::max(r.largest, std::abs(rate));
    stops[i] = std::abs(rate) <= zero_rate * r.largest;
    if (stops[i] && !decided) states.senses[at(r.joint)] = nan;
    if (stops[i] || was == sense) continue;
    states.senses[at(r.joint)] = sense;
    note_friction(t, r.joint, was == 0 ? FrictionChange::slips : FrictionChange::reverses);
  }
  if (!decided) return;
  decide(t, stops);
  if (any_sticks()) still(t, y);
  keep_states(t);
}

void Simulation::note_friction(double t, int joint, FrictionChange change) {
  ++report_.friction_event_count;
  if (report_.friction_events.size() >= kept_events) return;
  double value = joint_motion(l_, plan_, dynamics_.motion, joint).value;
  for (std::size_t k = 0; k < l_.driven.size(); ++k)
    if (l_.driven[k] == joint) value = inputs_[k].value;
  report_.friction_events.push_back({t, joint, change, value, dynamics_.states->senses[at(joint)]});
}

math::OdeAction Simulation::friction_event(double t, std::span<const std::size_t> which,
                                           std::span<double> y) {
  put(t, y);
  FrictionStates& states = *dynamics_.states;
  if (solve_here(t) != Status::done) return math::OdeAction::restart;
  if (t - event_time_ > quick_share * std::max(span_, std::abs(t))) quick_events_ = 0, event_time_ = t;
  std::vector<bool> stops(rubbing_.size(), false);
  bool gives_way = false, decides = false;
  for (const std::size_t event : which) {
    Rubbing& r = rubbing_[event / 2];
    const std::size_t j = at(r.joint);
    if (++quick_events_ > most_quick_events) {
      chattering_ = r.joint;
      return math::OdeAction::stop;
    }
    if (event % 2 == 1) {  // the other flank: the size of its friction has a corner
      r.flank = -r.flank;
      ++report_.friction_event_count;
      if (report_.friction_events.size() < kept_events)
        report_.friction_events.push_back({t, r.joint, FrictionChange::changes_flank,
                                           joint_motion(l_, plan_, dynamics_.motion, r.joint).value,
                                           states.senses[j]});
      continue;
    }
    decides = true;
    if (states.senses[j] == 0) {
      gives_way = true;
      states.reserve[j] = reserve_at_limit;
    } else {
      stops[event / 2] = true;
    }
  }
  if (!decides) return math::OdeAction::restart;
  for (std::size_t i = 0; i < rubbing_.size(); ++i) {
    Rubbing& r = rubbing_[i];
    const std::size_t j = at(r.joint);
    const double rate = std::abs(rate_of(r.joint));
    r.largest = std::max(r.largest, rate);
    if (states.senses[j] != 0)
      stops[i] = stops[i] || rate <= zero_rate * r.largest;
    else if (gives_way && states.shares[j] >= at_limit_share)
      states.reserve[j] = reserve_at_limit;
  }
  if (!decide(t, stops)) return math::OdeAction::restart;
  if (any_sticks()) still(t, y);
  keep_states(t);
  stuck_ = resting_ && (options_.stop_at_rest || !may_be_freed(t));
  return stuck_ ? math::OdeAction::stop : math::OdeAction::restart;
}

void Simulation::still(double t, std::span<double> y) {
  constexpr int passes = 30;
  put(t, y);
  const auto free = dynamics_.free();
  std::span<double> rates = y.subspan(free.size(), free.size());
  if (dynamics_.states->held == free.size() && laws_.empty()) {
    std::fill(rates.begin(), rates.end(), 0.0);
    return;
  }
  std::vector<int> others;
  for (const Rubbing& r : rubbing_) {
    if (dynamics_.states->senses[at(r.joint)] != 0) continue;
    bool input = false;
    for (std::size_t i = 0; i < free.size(); ++i)
      if (l_.driven[free[i]] == r.joint) rates[i] = 0, input = true;
    if (!input) others.push_back(r.joint);
  }
  if (others.empty()) return;
  put(t, y);
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  solve_position(plan_, inputs_, dynamics_.motion);
  if (dynamics_.motion.status != Status::done) return restore();
  std::vector<std::vector<double>> shares;
  std::vector<double> bias;
  for (const int joint : others) {
    shares.push_back(shares_of(joint));
    for (std::size_t i = 0; i < free.size(); ++i)
      if (dynamics_.states->senses[at(l_.driven[free[i]])] == 0) shares.back()[i] = 0;
    std::vector<InputMotion> prescribed = inputs_;
    for (const std::size_t k : free) prescribed[k].rate = 0;
    solve_velocity(plan_, prescribed, dynamics_.motion);
    bias.push_back(rate_of(joint));
  }
  for (int pass = 0; pass < passes; ++pass)
    for (std::size_t s = 0; s < others.size(); ++s) {
      double rate = bias[s], square = 0;
      for (std::size_t i = 0; i < free.size(); ++i)
        rate += shares[s][i] * rates[i], square += shares[s][i] * shares[s][i];
      if (square < 1e-16) continue;
      for (std::size_t i = 0; i < free.size(); ++i) rates[i] -= rate * shares[s][i] / square;
    }
}

void Simulation::still_inputs() {
  const bool rests = resting_ && laws_.empty();
  for (const std::size_t k : dynamics_.free())
    if (rests || dynamics_.states->senses[at(l_.driven[k])] == 0) inputs_[k].acceleration = 0;
}

const LinkageForces* Simulation::forces_with_friction(double t) {
  const std::vector<InputMotion> here = inputs_;
  if (solve_here(t) == Status::done) held_ = dynamics_.forces();
  inputs_ = here;
  return &held_;
}

bool Simulation::jams(double t) {
  if (++steps_ % jam_steps != 0) return false;
  const bool creeps = t - window_ < jam_share * span_;
  window_ = t;
  jammed_ = creeps && locks_ahead(t);
  return jammed_;
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

bool Simulation::may_be_freed(double t) const {
  const auto changes = [&](const auto& load) {
    const LoadFactor& f = load.factor;
    return goes_by(load, LoadArgument::time) &&
           (f.argument.empty() || period_of(f, false) > 0 || t < f.argument.back());
  };
  return !laws_.empty() || std::any_of(l_.forces.begin(), l_.forces.end(), changes) ||
         std::any_of(l_.torques.begin(), l_.torques.end(), changes) ||
         std::any_of(l_.struts.begin(), l_.struts.end(), changes);
}

void Simulation::end_rest(double t) {
  FrictionRests& rests = report_.rests;
  if (++rests.count == 1) rests.first_from = resting_since_, rests.first_to = t;
  rests.total += t - resting_since_;
}

}  // namespace linkwright::planar
