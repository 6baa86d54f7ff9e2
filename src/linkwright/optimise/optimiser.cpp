// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/optimiser.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/random.h"
#include "linkwright/optimise/pareto.h"

namespace linkwright::optimise {

Optimiser::Optimiser(std::span<const Variable> variables, std::size_t population, const Seed& seed,
                     std::size_t objectives)
    : seed_(seed), candidates_(variables.size(), population), objectives_(objectives) {
  LINKWRIGHT_REQUIRE(!variables.empty(), "a problem needs variables");
  LINKWRIGHT_REQUIRE(objectives > 0, "a problem needs objectives");
  // Indices are drawn from 32 random bits, and half of the streams are kept for other uses.
  LINKWRIGHT_REQUIRE(population < (1u << 31), "population {}", population);
  for (const Variable& v : variables) {
    LINKWRIGHT_REQUIRE(std::isfinite(v.lower) && std::isfinite(v.upper) && v.lower <= v.upper,
                       "bounds of '{}': {} to {}", v.name, v.lower, v.upper);
    lower_.push_back(v.lower);
    upper_.push_back(v.upper);
  }
  told_cost_.assign(shape().stride * objectives, 0.0);
  told_violation_.assign(shape().stride, 0.0);
  best_.reserve(dimension());
  best_costs_.assign(objectives, infinity);
  best_lower_ = lower_;
  best_upper_ = upper_;
  if (objectives > 1) {
    column_.reserve(population);
    sums_.resize(population);
  }
}

void Optimiser::start_from(std::span<const double> x, std::span<const double> costs) {
  LINKWRIGHT_REQUIRE(generation_ == 0 && !asked_, "a design to start from comes before the first candidates");
  LINKWRIGHT_REQUIRE(x.size() == dimension() && costs.size() == objectives_,
                     "a design to start from has {} values for {} variables and {} costs for {} objectives",
                     x.size(), dimension(), costs.size(), objectives_);
  const auto finite = [](double v) { return std::isfinite(v); };
  LINKWRIGHT_REQUIRE(std::all_of(x.begin(), x.end(), finite), "a design to start from: values {}",
                     fmt::join(x, ", "));
  LINKWRIGHT_REQUIRE(std::all_of(costs.begin(), costs.end(), finite), "a design to start from: costs {}",
                     fmt::join(costs, ", "));
  best_.assign(x.begin(), x.end());
  std::copy(costs.begin(), costs.end(), best_costs_.begin());
  best_violation_ = 0;
  for (std::size_t j = 0; j < dimension(); ++j) {
    best_lower_[j] = std::min(lower_[j], x[j]);
    best_upper_[j] = std::max(upper_[j], x[j]);
  }
}

void Optimiser::begin_with(const PopulationView& members) {
  LINKWRIGHT_REQUIRE(!asked_ && generation_ == 0, "members are given before the first are asked for");
  LINKWRIGHT_REQUIRE(members.dimension == dimension() && members.size == population(),
                     "{} members of {} variables for {} of {}", members.size, members.dimension, population(),
                     dimension());
  for (std::size_t j = 0; j < dimension(); ++j)
    for (std::size_t i = 0; i < population(); ++i) {
      LINKWRIGHT_REQUIRE(!std::isnan(members(j, i)), "variable {} of member {} is not a number", j, i);
      candidates_(j, i) = std::clamp(members(j, i), lower_[j], upper_[j]);
    }
  members_given_ = true;
}

PopulationView Optimiser::ask() {
  if (!asked_ && generation_ == 0) {
    for (std::size_t i = 0; i < population() && !members_given_; ++i) {
      RandomStream random({seed_.seed, seed_.run, 0, static_cast<std::uint32_t>(i)});
      for (std::size_t j = 0; j < dimension(); ++j)
        candidates_(j, i) = std::min(random.uniform(lower_[j], upper_[j]), upper_[j]);
    }
    round_ = population();
  } else if (!asked_) {
    propose({seed_.seed, seed_.run, generation_});
    round_ = proposed();
  }
  asked_ = within_generation_ = true;
  return candidates_.view().slice(0, round_);
}

void Optimiser::tell(std::span<const double> cost, std::span<const double> violation) {
  const std::size_t n = round_, m = objectives_;
  LINKWRIGHT_REQUIRE(asked_, "nothing was asked");
  LINKWRIGHT_REQUIRE(cost.size() == n * m && violation.size() == n,
                     "{} costs and {} violations for {} candidates{}", cost.size(), violation.size(), n,
                     m == 1 ? std::string() : fmt::format(" of {} objectives", m));
  const auto costs = [&](std::size_t i) { return cost.subspan(i * m, m); };
  improved_ = equalled_ = false;
  for (std::size_t i = 0; i < n; ++i) {
    bool equal = violation[i] == best_violation_, number = true;
    for (std::size_t k = 0; k < m; ++k) {
      number &= !std::isnan(cost[i * m + k]);
      equal &= cost[i * m + k] == best_costs_[k];
    }
    LINKWRIGHT_REQUIRE(number && violation[i] >= 0, "candidate {}: cost {}, violation {}", i,
                       fmt::join(costs(i), ", "), violation[i]);
    equalled_ |= equal;
  }
  const bool first = best_.empty();
  if (!(first && m > 1 && choose_first(cost, violation)))
    for (std::size_t i = 0; i < n; ++i)
      if (takes_over(costs(i), violation[i])) take_over(i, costs(i), violation[i]);
  if (first && !improved_) take_over(0, costs(0), violation[0]);  // even if every cost is infinite
  if (improved_) {
    best_.resize(dimension());
    candidates_.get(best_candidate_, best_);
  }
  std::copy(cost.begin(), cost.end(), told_cost_.begin());
  std::copy(violation.begin(), violation.end(), told_violation_.begin());
  accept(told_cost_.data(), told_violation_.data());
  asked_ = false;
  within_generation_ = generation_ > 0 && goes_on();
  if (!within_generation_) ++generation_;
}

bool Optimiser::takes_over(std::span<const double> costs, double violation) const {
  if (objectives_ > 1 && !(violation > 0) && !(best_violation_ > 0)) return dominates(costs, best_costs_);
  return better(costs, violation, best_costs_, best_violation_);
}

void Optimiser::take_over(std::size_t candidate, std::span<const double> costs, double violation) {
  std::copy(costs.begin(), costs.end(), best_costs_.begin());
  best_violation_ = violation;
  best_candidate_ = candidate;
  improved_ = true;
}

/// The first incumbent from the first population; false if no member is feasible.
bool Optimiser::choose_first(std::span<const double> cost, std::span<const double> violation) {
  const std::size_t n = violation.size(), m = objectives_;
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (std::size_t k = 0; k < m; ++k) {
    column_.clear();
    for (std::size_t i = 0; i < n; ++i)
      if (!(violation[i] > 0)) column_.push_back(cost[i * m + k]);
    if (column_.empty()) return false;
    const auto middle = column_.begin() + static_cast<std::ptrdiff_t>(column_.size() / 2);
    std::nth_element(column_.begin(), middle, column_.end());
    const double median =
        column_.size() % 2 == 1 ? *middle : (*middle + *std::max_element(column_.begin(), middle)) / 2;
    const double unit = unit_of(median);
    for (std::size_t i = 0; i < n; ++i) sums_[i] += cost[i * m + k] / unit;
  }
  std::size_t best = n;
  for (std::size_t i = 0; i < n; ++i)
    if (!(violation[i] > 0) && (best == n || sums_[i] < sums_[best])) best = i;
  take_over(best, cost.subspan(best * m, m), 0);
  return true;
}

void Optimiser::visit_population(Population& population, StateVisitor visit) {
  for (std::size_t j = 0; j < dimension(); ++j)
    visit({population.row(j), population.size()}, lower_[j], upper_[j]);
}

void Optimiser::visit_all(StateVisitor visit) {
  visit(best_costs_, -infinity, infinity);
  visit({&best_violation_, 1}, 0, infinity);
  for (std::size_t j = 0; j < best_.size(); ++j) visit({&best_[j], 1}, best_lower_[j], best_upper_[j]);
  visit_state(visit);
}

OptimiserState Optimiser::state() const {
  LINKWRIGHT_REQUIRE(generation_ > 0 && !within_generation_,
                     "no state within a generation, nor before the first");
  OptimiserState state{.generation = generation_};
  // The list hands over what may be overwritten; here it is only read.
  const_cast<Optimiser&>(*this).visit_all([&](std::span<double> numbers, double, double) {
    state.numbers.insert(state.numbers.end(), numbers.begin(), numbers.end());
  });
  return state;
}

bool Optimiser::restore(const OptimiserState& state) {
  LINKWRIGHT_REQUIRE(!within_generation_, "a state cannot be restored within a generation");
  best_.resize(dimension());
  bool good = state.generation > 0;
  std::size_t used = 0;
  visit_all([&](std::span<double> numbers, double least, double most) {
    good = good && numbers.size() <= state.numbers.size() - used;
    if (!good) return;
    for (double& number : numbers) {
      number = state.numbers[used++];
      good = good && number >= least && number <= most;
    }
  });
  generation_ = state.generation;
  improved_ = equalled_ = false;
  return good && used == state.numbers.size();
}

}  // namespace linkwright::optimise
