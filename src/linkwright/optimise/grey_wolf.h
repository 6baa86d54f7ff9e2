// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "linkwright/core/field.h"
#include "linkwright/optimise/optimiser.h"

namespace linkwright::optimise {

/// Grey wolf optimiser (Mirjalili, Mirjalili, Lewis 2014; Boskovic 2018, Eq. (4.20)-(4.26)): every wolf moves
/// to the mean of three points near the three best positions ever seen, with a reach `a` that falls from 2 to
/// 0 over `generations`. Candidates are clipped to the box. Defaults of Boskovic 2018: 30 wolves, 50
/// generations.
///
/// It contracts towards the origin, which flatters it on boxes centred there.
struct GreyWolfOptions {
  int population = 30;
  int generations = 50;  ///< also the length of the schedule of `a`; it stays 0 afterwards
  /// Before each move the worse half of the pack is placed again: anywhere in the box, or at alpha, beta or
  /// delta
  /// +- ((upper - lower) r + lower), a quarter of the cases each. Recalled from Saremi, Mirjalili, Mirjalili
  /// 2015; the equation is missing in Boskovic 2018. The term "+ lower" makes it depend on where the box
  /// lies.
  bool reset_worst_half = false;
  /// X_k = |X_alpha - A D|, as Eq. (4.25) of Boskovic 2018 is printed. An erratum: negative values cannot be
  /// reached.
  bool absolute_value = false;
};
template <class Visitor>
void fields(Visitor&& visit, GreyWolfOptions& o) {
  visit(field::entry("population", "wolves in the pack").between(3, 1e6), o.population);
  visit(field::entry("generations", "generations, the first included; the reach falls to 0 over them")
            .between(1, 1e9),
        o.generations);
  visit(field::entry("reset_worst_half", "place the worse half of the pack at random before each move"),
        o.reset_worst_half);
  visit(field::entry("absolute_value",
                     "absolute value of each step as printed in Boskovic 2018 Eq. (4.25), an erratum"),
        o.absolute_value);
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables, const GreyWolfOptions& options,
                                          const Seed& seed);

}  // namespace linkwright::optimise
