#include "linkwright/optimise/optimiser.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/random.h"

namespace linkwright::optimise {

Optimiser::Optimiser(std::span<const Variable> variables, std::size_t population, const Seed& seed)
    : seed_(seed), candidates_(variables.size(), population) {
  LINKWRIGHT_REQUIRE(!variables.empty(), "a problem needs variables");
  // Indices are drawn from 32 random bits, and half of the streams are kept for other uses.
  LINKWRIGHT_REQUIRE(population < (1u << 31), "population {}", population);
  for (const Variable& v : variables) {
    LINKWRIGHT_REQUIRE(std::isfinite(v.lower) && std::isfinite(v.upper) && v.lower <= v.upper,
                       "bounds of '{}': {} to {}", v.name, v.lower, v.upper);
    lower_.push_back(v.lower);
    upper_.push_back(v.upper);
  }
  told_cost_.assign(shape().stride, 0.0);
  told_violation_.assign(shape().stride, 0.0);
  best_.reserve(dimension());
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
  const std::size_t n = round_;
  LINKWRIGHT_REQUIRE(asked_, "nothing was asked");
  LINKWRIGHT_REQUIRE(cost.size() == n && violation.size() == n,
                     "{} costs and {} violations for {} candidates", cost.size(), violation.size(), n);
  improved_ = equalled_ = false;
  double best_cost = best_cost_, best_violation = best_violation_;
  for (std::size_t i = 0; i < n; ++i) {
    LINKWRIGHT_REQUIRE(!std::isnan(cost[i]) && violation[i] >= 0, "candidate {}: cost {}, violation {}", i,
                       cost[i], violation[i]);
    if (better(cost[i], violation[i], best_cost, best_violation)) {
      best_cost = cost[i];
      best_violation = violation[i];
      best_candidate_ = i;
      improved_ = true;
    }
    equalled_ |= cost[i] == best_cost_ && violation[i] == best_violation_;
  }
  if (best_.empty()) improved_ = true;  // even if every cost is infinite
  if (improved_) {
    best_cost_ = cost[best_candidate_];
    best_violation_ = violation[best_candidate_];
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

void Optimiser::visit_population(Population& population, StateVisitor visit) {
  for (std::size_t j = 0; j < dimension(); ++j)
    visit({population.row(j), population.size()}, lower_[j], upper_[j]);
}

void Optimiser::visit_all(StateVisitor visit) {
  visit({&best_cost_, 1}, -infinity, infinity);
  visit({&best_violation_, 1}, 0, infinity);
  for (std::size_t j = 0; j < best_.size(); ++j) visit({&best_[j], 1}, lower_[j], upper_[j]);
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
