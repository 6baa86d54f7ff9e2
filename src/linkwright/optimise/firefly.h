// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// The move of a firefly i towards a brighter one j at a distance r: in the unit cube, x_i += beta (x_j -
/// x_i) + alpha_t (rho - 1/2) with beta = beta_min + (beta_0 - beta_min) exp(-gamma r^2) (Boskovic 2018, Eq.
/// (2.133), with beta_min = 0), rho uniform in the unit cube, and alpha_t = alpha (1e-4 / 0.9)^(t / T) in
/// iteration t = 0 ... T - 1 (the decay of the code published by Yang; it goes on falling after T
/// iterations).
///
/// The publication prints one number 0.2 for the attraction. It may have meant beta_min, as in the code
/// published by Yang where beta_0 = 1: `yang_attraction`, which is mostly better, is that reading.
struct FireflyMove {
  double randomness = 0.5;      ///< alpha
  double absorption = 1;        ///< gamma
  double attraction = 0.2;      ///< beta_0: at distance 0
  double attraction_least = 0;  ///< beta_min: far away
};
inline constexpr FireflyMove yang_attraction = {.attraction = 1, .attraction_least = 0.2};

template <class Visitor>
void fields(Visitor&& visit, FireflyMove& o) {
  visit(field::entry("randomness",
                     "width alpha of the random part of a move at first, as a fraction of that of the box")
            .not_negative(),
        o.randomness);
  visit(field::entry("absorption", "gamma: how quickly attraction falls with distance").not_negative(),
        o.absorption);
  visit(field::entry("attraction",
                     "attraction beta_0 at distance 0; 1 with attraction_least 0.2 is mostly better")
            .between(0, 2),
        o.attraction);
  visit(field::entry("attraction_least", "attraction beta_min far away").between(0, 2), o.attraction_least);
}

/// Firefly algorithm (Yang 2009; Boskovic 2018, Algorithm 2.3): each firefly in turn moves towards every
/// brighter one, at once and in place, and is evaluated after every move, better or not. The brightest stays.
/// Candidates are clipped to the box. Defaults of Boskovic 2018, Table 2.5.
///
/// Every move starts from what the last one came to, so candidates are asked for one at a time, about
/// population (population - 1) / 2 of them a generation; only runs with several seeds make use of threads.
struct FireflyOptions {
  int population = 40;
  int generations = 501;  ///< the first population included: T = 500 iterations
  FireflyMove move = {};
};
template <class Visitor>
void fields(Visitor&& visit, FireflyOptions& o) {
  visit(field::entry("population", "fireflies").between(2, 1e4), o.population);
  visit(field::entry("generations", "generations, the first included; randomness decays over them")
            .between(1, 1e9),
        o.generations);
  fields(visit, o.move);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const FireflyOptions& options,
                                          const Seed& seed, std::size_t objectives = 1);

}  // namespace linkwright::optimise
