// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/flexible/chain.h"
#include "linkwright/flexible/samples.h"
#include "support/published.h"

/// Figures of tests/published/flexible-link.json.
namespace linkwright::flexible {

inline const Value& computed(std::string_view id) {
  return test::at(test::published_case("flexible-link.json", id), "computed");
}
inline std::vector<double> figures(std::string_view id, std::string_view path) {
  return test::numbers(test::at(computed(id), path));
}

/// Short steel beam of rectangular section where shear matters, with a tip mass that has inertia.
inline Beam stub() {
  return {.length = 1,
          .density = 7800,
          .area = 0.05 * 0.2,
          .second_moment = 0.05 * 0.2 * 0.2 * 0.2 / 12,
          .elastic_modulus = 2.1e11,
          .shear_modulus = 2.1e11 / 2.6,
          .shear_coefficient = 5.0 / 6,
          .tip_mass = 2,
          .tip_inertia = 0.01,
          .theory = Theory::timoshenko};
}

}  // namespace linkwright::flexible
