// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/particle_swarm.h"

#include <algorithm>
#include <vector>

#include "linkwright/core/random.h"

namespace linkwright::optimise {
namespace {

class ParticleSwarm final : public Optimiser {
 public:
  ParticleSwarm(std::span<const Variable> variables, const ParticleSwarmOptions& options, const Seed& seed)
      : Optimiser(variables, static_cast<std::size_t>(options.population), seed),
        options_(options),
        velocity_(dimension(), population()),
        own_best_(dimension(), population()),
        own_cost_(population(), infinity),
        own_violation_(population(), infinity) {
    for (std::size_t j = 0; j < dimension(); ++j)
      limit_.push_back(options_.velocity_limit * (upper_[j] - lower_[j]));
  }

  PopulationView members() const override { return candidates_.view(); }

 private:
  void propose(const GenerationKey& key) override {
    const double passed = std::min(1.0, key.generation / (options_.generations - 1.0));
    const double inertia = options_.inertia_start - (options_.inertia_start - options_.inertia_end) * passed;
    for (std::size_t i = 0; i < population(); ++i) {
      const auto individual = static_cast<std::uint32_t>(i);
      if (key.generation == 1) {
        // Streams of individuals from 2^31 on are free: the moves use those below.
        RandomStream start({key.seed, key.run, key.generation, individual | 0x80000000u});
        for (std::size_t j = 0; j < dimension(); ++j) velocity_(j, i) = start.uniform(-limit_[j], limit_[j]);
      }
      RandomStream random({key.seed, key.run, key.generation, individual});
      for (std::size_t j = 0; j < dimension(); ++j) {
        const double own = options_.own_attraction * random.uniform();
        const double all = options_.swarm_attraction * random.uniform();
        double &x = candidates_(j, i), &v = velocity_(j, i);
        v = inertia * v + own * (own_best_(j, i) - x) + all * (best()[j] - x);
        v = std::clamp(v, -limit_[j], limit_[j]);
        x += v;
        if (x < lower_[j] || x > upper_[j]) {
          const double bound = x < lower_[j] ? lower_[j] : upper_[j];
          const bool reflect = options_.bounds == SwarmBounds::reflect;
          x = reflect ? std::clamp(bound + (bound - x), lower_[j], upper_[j]) : bound;
          v = reflect ? -v : 0;
        }
      }
    }
  }

  void accept(const double* cost, const double* violation) override {
    for (std::size_t i = 0; i < population(); ++i) {
      // The first place is the best so far, whatever it costs.
      if (generation() > 0 && !better(cost[i], violation[i], own_cost_[i], own_violation_[i])) continue;
      own_cost_[i] = cost[i];
      own_violation_[i] = violation[i];
      for (std::size_t j = 0; j < dimension(); ++j) own_best_(j, i) = candidates_(j, i);
    }
  }

  void visit_state(StateVisitor visit) override {
    visit_population(candidates_, visit);
    for (std::size_t j = 0; j < dimension(); ++j)
      visit({velocity_.row(j), population()}, -limit_[j], limit_[j]);
    visit_population(own_best_, visit);
    visit(own_cost_, -infinity, infinity);
    visit(own_violation_, 0, infinity);
  }

  ParticleSwarmOptions options_;
  Population velocity_, own_best_;
  std::vector<double> own_cost_, own_violation_;
  std::vector<double> limit_;  ///< largest velocity, one a variable
};

}  // namespace

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const ParticleSwarmOptions& options, const Seed& seed) {
  require_in_range("particle_swarm", options);
  return std::make_unique<ParticleSwarm>(variables, options, seed);
}

}  // namespace linkwright::optimise
