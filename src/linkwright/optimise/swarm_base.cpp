// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/detail/swarm_base.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

namespace linkwright::optimise {

SwarmBase::SwarmBase(std::span<const Variable> variables, int population, const Seed& seed,
                     std::size_t objectives)
    : Optimiser(variables, static_cast<std::size_t>(population), seed, objectives),
      members_(dimension(), candidates_.size()),
      cost_(candidates_.size() * objectives, infinity),
      violation_(candidates_.size(), infinity) {
  for (std::size_t j = 0; j < dimension(); ++j) {
    width_.push_back(upper_[j] - lower_[j]);
    const double inverse = 1 / width_[j];
    inverse_width_.push_back(std::isfinite(inverse) ? inverse : 0);
  }
}

void SwarmBase::propose(const GenerationKey&) {
  if (made_ == Rounds::generation_over) made_ = rounds_.next();
}

void SwarmBase::accept(const double* cost, const double* violation) {
  answer_cost_ = cost;
  answer_violation_ = violation;
  if (generation() == 0)
    for (std::size_t i = 0; i < population(); ++i) replace(i, i);
  else if (made_ != Rounds::generation_over)
    made_ = rounds_.next();
}

void SwarmBase::visit_state(StateVisitor visit) {
  visit_population(members_, visit);
  visit(cost_, -infinity, infinity);
  visit(violation_, 0, infinity);
}

RandomStream SwarmBase::random(std::uint32_t use, std::size_t member) const {
  return RandomStream({seed_.seed, seed_.run, generation(), use << 30 | static_cast<std::uint32_t>(member)});
}

void SwarmBase::shuffle(std::span<std::uint32_t> order, RandomStream& random) {
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t left = order.size(); left > 1; --left)
    std::swap(order[left - 1], order[random.below(static_cast<std::uint32_t>(left))]);
}

bool SwarmBase::member_ranks_before(std::size_t a, std::size_t b) const {
  if (objectives() == 1) return member_better(a, b);
  if (violation_[a] > 0 || violation_[b] > 0) return violation_[a] < violation_[b];
  // The sums over all objectives instead of the means.
  double sum_a = 0, sum_b = 0;
  for (std::size_t k = 0; k < objectives(); ++k) {
    const double unit = unit_of(best_costs()[k]);
    sum_a += member_costs(a)[k] / unit;
    sum_b += member_costs(b)[k] / unit;
  }
  return sum_a < sum_b;
}

void SwarmBase::replace(std::size_t i, std::size_t c) {
  for (std::size_t j = 0; j < dimension(); ++j) members_(j, i) = candidates_(j, c);
  std::copy_n(answer_cost_ + c * objectives(), objectives(), &cost_[i * objectives()]);
  violation_[i] = answer_violation_[c];
}

void SwarmBase::fly(std::size_t c, std::size_t i, const LevyFlight& flight, double scale,
                    RandomStream& random) {
  for (std::size_t j = 0; j < dimension(); ++j) {
    const double x = members_(j, i);
    double step = flight.step * levy_step(random, flight.exponent, scale);
    step *= flight.form == LevyForm::plain ? width_[j] : (x - best()[j]) * random.normal();
    candidates_(j, c) = std::clamp(x + step, lower_[j], upper_[j]);
  }
}

}  // namespace linkwright::optimise
