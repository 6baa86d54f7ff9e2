// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// The treatment of a particle that leaves the box, component by component.
enum class SwarmBounds {
  clip,     ///< it stops at the bound: its velocity is 0 there
  reflect,  ///< it is mirrored at the bound, its velocity reversed
};
constexpr std::array<EnumName<SwarmBounds>, 2> names(SwarmBounds) {
  return {{{SwarmBounds::clip, "clip", "stop at the bound"},
           {SwarmBounds::reflect, "reflect", "mirror at the bound, reverse the velocity"}}};
}

/// Particle swarm (Kennedy and Eberhart 1995) with linearly decreasing inertia (Shi and Eberhart 1998): each
/// component of a particle moves by
///
///     V <- rho V + c1 r1 (best of its own - X) + c2 r2 (best of all - X),   |V| <= limit (upper - lower)
///     X <- X + V,   rho = inertia_start - (inertia_start - inertia_end) i / i_max
///
/// with new r1, r2 uniform on [0, 1) for every component, i = 1 ... i_max the number of the move,
/// i_max = generations - 1. Best of all is that of the last whole generation. Velocities are at first uniform
/// within the limit; the limit is needed, as c1 + c2 = 4 diverges with inertias near 1.
struct ParticleSwarmOptions {
  int population = 40;
  int generations = 500;        ///< also the length of the schedule of the inertia; it stays low afterwards
  double own_attraction = 2;    ///< c1
  double swarm_attraction = 2;  ///< c2
  double inertia_start = 0.9;
  double inertia_end = 0.4;
  double velocity_limit = 0.2;  ///< largest move in one generation over the range of the variable
  SwarmBounds bounds = SwarmBounds::clip;
};
template <class Visitor>
void fields(Visitor&& visit, ParticleSwarmOptions& o) {
  visit(field::entry("population", "particles").between(1, 1e6), o.population);
  visit(field::entry("generations", "generations, the first included; the inertia falls over them")
            .between(1, 1e9),
        o.generations);
  visit(field::entry("own_attraction", "factor c1 of the way to the best place of the particle itself")
            .between(0, 10),
        o.own_attraction);
  visit(field::entry("swarm_attraction", "factor c2 of the way to the best place of all").between(0, 10),
        o.swarm_attraction);
  visit(field::entry("inertia_start", "share of the velocity that is kept, at first").between(0, 2),
        o.inertia_start);
  visit(field::entry("inertia_end", "the same at the end").between(0, 2), o.inertia_end);
  visit(field::entry("velocity_limit", "largest move in one generation over the range of the variable")
            .positive()
            .at_most(1),
        o.velocity_limit);
  visit(field::entry("bounds", "what becomes of a particle that leaves the box"), o.bounds);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const ParticleSwarmOptions& options, const Seed& seed);

}  // namespace linkwright::optimise
