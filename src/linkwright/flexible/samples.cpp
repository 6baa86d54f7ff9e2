// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/samples.h"

namespace linkwright::flexible {

Beam spin_up_beam(Theory theory) {
  return {.length = 8,
          .density = 2766.7,
          .area = 7.2968e-5,
          .second_moment = 8.2189e-9,
          .elastic_modulus = 6.8952e10,
          .shear_modulus = 6.8952e10 / 2.6,
          .shear_coefficient = 5.0 / 6,
          .tip_mass = 0.085,
          .theory = theory};
}

Beam torque_beam(Theory theory) {
  return {.length = 1.8,
          .density = 2766,
          .area = 2.5e-4,
          .second_moment = 1.3021e-10,
          .elastic_modulus = 6.9e10,
          .shear_modulus = 6.9e10 / 2.6,
          .shear_coefficient = 5.0 / 6,
          .tip_mass = 0.085,
          .hub_radius = 0.05,
          .hub_inertia = 0.30,
          .theory = theory};
}

Beam kane_beam() {
  // Any E gives the same motion as long as E I, E A and rho A do.
  return {.length = 10,
          .density = 3000,
          .area = 4e-4,
          .second_moment = 2e-7,
          .elastic_modulus = 7e10,
          .theory = Theory::euler_bernoulli,
          .extensible = true};
}

}  // namespace linkwright::flexible
