// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/optimise/problem.h"

namespace linkwright::optimise {
namespace {

constexpr std::uint64_t seed = 0x123456789abcdef0;
const GenerationKey key = {seed, 3, 17};

struct Case {
  std::size_t dimension, size;
};
constexpr Case cases[] = {{10, 30}, {1, 4}, {7, 5}, {9, 17}, {4, 1001}};

RandomStream stream(std::size_t individual) {
  return RandomStream({key.seed, key.run, key.generation, static_cast<std::uint32_t>(individual)});
}

Population random_population(const Case& c, double lower, double upper) {
  Population population(c.dimension, c.size);
  RandomStream random({.seed = 5});
  for (std::size_t j = 0; j < c.dimension; ++j)
    for (std::size_t i = 0; i < c.size; ++i) population(j, i) = random.uniform(lower, upper);
  return population;
}

KernelShape shape_of(const Population& p) { return {p.dimension(), p.size(), p.view().stride}; }

/// k-th number of those in [0, ...) that are not taken.
std::uint32_t pass_over(std::uint32_t k, std::vector<std::uint32_t> taken) {
  std::sort(taken.begin(), taken.end());
  for (const std::uint32_t t : taken) k += k >= t;
  return k;
}

std::uint32_t scaled(std::uint32_t bits, std::size_t count) {
  return static_cast<std::uint32_t>(std::uint64_t{bits} * count >> 32);
}

/// The same step from the definition in kernels.h, one candidate and one word of its stream at a time.
void plain_differential_evolution(const DifferentialEvolutionStep& s, Population& trial) {
  const std::size_t n = s.shape.size;
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random = stream(i);
    const auto self = static_cast<std::uint32_t>(i);
    const std::uint32_t r1 = pass_over(scaled(random.bits(), n - 1), {self});
    const std::uint32_t r2 = pass_over(scaled(random.bits(), n - 2), {self, r1});
    const std::uint32_t r3 = pass_over(scaled(random.bits(), n - 3), {self, r1, r2});
    EXPECT_TRUE(r1 < n && r2 < n && r3 < n && r1 != self && r2 != self && r3 != self && r1 != r2 &&
                r1 != r3 && r2 != r3);
    const std::uint32_t always = scaled(random.bits(), s.shape.dimension);
    for (std::uint32_t skipped = 4; skipped < s.crossover_word; ++skipped) random.bits();
    for (std::size_t j = 0; j < s.shape.dimension; ++j) {
      const double* x = s.population + j * s.shape.stride;
      double v = x[r1] + s.scale[i] * (x[r2] - x[r3]);
      if (v < s.lower[j])
        v = 0.5 * (x[r1] + s.lower[j]);
      else if (v > s.upper[j])
        v = 0.5 * (x[r1] + s.upper[j]);
      const bool crossed = random.bits() <= s.crossover[i] * 4294967295.0;
      trial(j, i) = crossed || j == always ? v : x[i];
    }
  }
}

TEST(Kernels, BaselineIsAlwaysThereAndTheBestIsOneOfThem) {
  EXPECT_NE(kernel_set().baseline, nullptr);
  EXPECT_EQ(&kernels(), runnable(kernel_set()).back().run);
}

TEST(Kernels, DifferentialEvolutionIsTheSameBitsAsItsDefinition) {
  for (const Case& c : cases)
    for (const std::uint32_t word : {4u, 8u}) {
      const Population population = random_population(c, -1, 2);
      const std::vector<double> lower(c.dimension, -1), upper(c.dimension, 2);
      const std::size_t stride = population.view().stride;
      std::vector<double> scale(stride), crossover(stride);
      for (std::size_t i = 0; i < stride; ++i) {
        scale[i] = 0.3 + 0.001 * static_cast<double>(i % 700);
        crossover[i] = static_cast<double>(i % 5) / 4;  // 0 and 1, too
      }
      Population expected(c.dimension, c.size);
      DifferentialEvolutionStep step = {
          shape_of(population), key,          population.row(0), nullptr, lower.data(),
          upper.data(),         scale.data(), crossover.data(),  word};
      plain_differential_evolution(step, expected);
      for (const auto& [k, name] : runnable(kernel_set())) {
        Population trial(c.dimension, c.size);
        step.trial = trial.row(0);
        k->differential_evolution(step);
        for (std::size_t j = 0; j < c.dimension; ++j)
          for (std::size_t i = 0; i < c.size; ++i) {
            ASSERT_EQ(trial(j, i), expected(j, i)) << name << " variable " << j << " candidate " << i;
            ASSERT_TRUE(trial(j, i) >= -1 && trial(j, i) <= 2);
          }
      }
    }
}

TEST(Kernels, SelfAdaptationIsTheSameBitsAsItsDefinition) {
  const std::size_t size = 1001, stride = 1008;
  const std::vector<double> scale(stride, 0.5), crossover(stride, 0.9);
  for (const auto& [k, name] : runnable(kernel_set())) {
    std::vector<double> new_scale(stride), new_crossover(stride);
    k->self_adaptation({size, key, scale.data(), crossover.data(), new_scale.data(), new_crossover.data(),
                        0.1, 0.9, 0.25, 0.5});
    int scales = 0, crossovers = 0;
    for (std::size_t i = 0; i < size; ++i) {
      RandomStream random = stream(i);
      for (int skipped = 0; skipped < 4; ++skipped) random.bits();
      const double u0 = random.bits() * 0x1p-32, u1 = random.bits() * 0x1p-32, u2 = random.bits() * 0x1p-32,
                   u3 = random.bits() * 0x1p-32;
      ASSERT_EQ(new_scale[i], u1 < 0.25 ? 0.1 + 0.9 * u0 : 0.5) << name << " " << i;
      ASSERT_EQ(new_crossover[i], u3 < 0.5 ? u2 : 0.9) << name << " " << i;
      scales += u1 < 0.25;
      crossovers += u3 < 0.5;
    }
    // Binomial: five standard deviations, of 13.7 and 15.8.
    EXPECT_NEAR(scales, 250, 69);
    EXPECT_NEAR(crossovers, 500, 79);
  }
}

TEST(Kernels, GreyWolfIsTheSameBitsAsItsDefinition) {
  for (const Case& c : cases)
    for (const bool printed : {false, true}) {
      const Population pack = random_population(c, -4, 3);
      std::vector<double> lower(c.dimension, -4), upper(c.dimension, 3);
      std::vector<double> leaders[3];
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < c.dimension; ++j) leaders[k].push_back(pack(j, k));
      const double a = 1.3;
      for (const auto& [kernel, name] : runnable(kernel_set())) {
        Population moved(c.dimension, c.size);
        std::memcpy(moved.row(0), pack.row(0), c.dimension * pack.view().stride * sizeof(double));
        kernel->grey_wolf({shape_of(pack),
                           key,
                           moved.row(0),
                           lower.data(),
                           upper.data(),
                           {leaders[0].data(), leaders[1].data(), leaders[2].data()},
                           a,
                           printed});
        for (std::size_t i = 0; i < c.size; ++i) {
          RandomStream random = stream(i);
          for (std::size_t j = 0; j < c.dimension; ++j) {
            double sum = 0;
            for (const auto& leader : leaders) {
              const double r1 = random.bits() * 0x1p-32, r2 = random.bits() * 0x1p-32;
              const double x = leader[j] - a * (2 * r1 - 1) * std::abs(2 * r2 * leader[j] - pack(j, i));
              sum += printed ? std::abs(x) : x;
            }
            ASSERT_EQ(moved(j, i), std::clamp(sum / 3, -4.0, 3.0))
                << name << " variable " << j << " wolf " << i;
          }
        }
      }
    }
}

TEST(Kernels, SelectFollowsTheFeasibilityRules) {
  struct Duel {
    double trial_cost, trial_violation, cost, violation;
    bool taken;
  };
  const std::vector<Duel> duels = {{1, 0, 2, 0, true},
                                   {2, 0, 1, 0, false},
                                   {1, 0, 1, 0, true},  // equal: the trial
                                   {9, 0, 1, 3, true},
                                   {1, 3, 9, 0, false},  // feasible before infeasible
                                   {9, 1, 1, 3, true},
                                   {1, 3, 9, 1, false},  // less violated
                                   {1, 3, 2, 3, true},
                                   {2, 3, 1, 3, false},  // equally violated: by cost
                                   {1, 0, infinity, infinity, true},
                                   {infinity, 5, infinity, infinity, true},
                                   {infinity, 5, 1, 0, false},
                                   {infinity, 5, infinity, 5, true}};
  const std::size_t size = duels.size(), stride = 16;
  for (const auto& [k, name] : runnable(kernel_set())) {
    std::vector<double> trial_cost(stride), trial_violation(stride), cost(stride), violation(stride);
    std::vector<std::uint64_t> chosen(stride);
    for (std::size_t i = 0; i < size; ++i) {
      trial_cost[i] = duels[i].trial_cost;
      trial_violation[i] = duels[i].trial_violation;
      cost[i] = duels[i].cost;
      violation[i] = duels[i].violation;
    }
    k->select(size, trial_cost.data(), trial_violation.data(), cost.data(), violation.data(), chosen.data());
    Population from(2, size), to(2, size);
    for (std::size_t i = 0; i < size; ++i) from(0, i) = from(1, i) = 1 + static_cast<double>(i);
    k->copy_chosen(shape_of(from), chosen.data(), from.row(0), to.row(0));
    for (std::size_t i = 0; i < size; ++i) {
      const Duel& d = duels[i];
      EXPECT_EQ(chosen[i], d.taken ? ~std::uint64_t{0} : 0) << name << " duel " << i;
      EXPECT_EQ(cost[i], d.taken ? d.trial_cost : d.cost) << i;
      EXPECT_EQ(violation[i], d.taken ? d.trial_violation : d.violation) << i;
      EXPECT_EQ(to(1, i), d.taken ? 1 + static_cast<double>(i) : 0) << i;
    }
  }
}

}  // namespace
}  // namespace linkwright::optimise
