// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "linkwright/core/field.h"
#include "linkwright/core/random.h"

namespace linkwright::optimise {

/// The point from which a Levy flight starts.
enum class LevyForm {
  plain,            ///< y = x + step L
  best_difference,  ///< y = x + step L (x - x_best) N(0, 1), of the code published by Yang and Deb
};
constexpr std::array<EnumName<LevyForm>, 2> names(LevyForm) {
  return {{{LevyForm::plain, "plain", "a step of its own in every variable"},
           {LevyForm::best_difference, "best_difference",
            "a step in proportion to the distance from the best so far (code of Yang and Deb)"}}};
}

/// Levy flights with the heavy-tailed steps of Mantegna (1994): Boskovic 2018, Eq. (2.130), in the unit cube,
/// that is in parts of the width of the box. The exponent is not printed there.
struct LevyFlight {
  double exponent = 1.5;  ///< beta_L
  double step = 0.01;     ///< alpha_c
  LevyForm form = LevyForm::plain;
};
template <class Visitor>
void fields(Visitor&& visit, LevyFlight& o) {
  visit(field::entry("levy_exponent", "exponent beta_L of the Levy steps; smaller has heavier tails")
            .between(0.3, 1.99),
        o.exponent);
  visit(
      field::entry("levy_step", "factor of the Levy steps, as a fraction of the width of the box").positive(),
      o.step);
  visit(field::entry("levy", "form of the Levy flights"), o.form);
}

/// Standard deviation sigma of the numerator of a Levy step: 0.696575 for the exponent 1.5.
double levy_scale(double exponent);

/// One Levy step L = a / |b|^(1 / exponent), a ~ N(0, scale^2), b ~ N(0, 1). Finite; two normal numbers.
double levy_step(RandomStream& random, double exponent, double scale);

}  // namespace linkwright::optimise
