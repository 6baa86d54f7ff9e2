// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/path_systems.h"

#include <cmath>

namespace linkwright::planar {
namespace {

RandomForms draw_forms() {
  RandomForms out;
  RandomStream stream({.seed = 1442});
  for (std::size_t m = 0; m < RandomForms::count; ++m)
    for (ComplexNumber* value : {&out.d[m], &out.D[m], &out.above[m], &out.below[m]})
      *value = random_complex(stream);
  return out;
}

}  // namespace

const RandomForms& random_forms() {
  static const RandomForms forms = draw_forms();
  return forms;
}

ComplexNumber random_complex(RandomStream& stream) {
  const double re = stream.normal(), im = stream.normal();
  return {re * std::sqrt(0.5), im * std::sqrt(0.5)};
}

ComplexNumber NinePoints::identity(const SystemPoint<NinePoints>& z) {
  ComplexNumber above, below;
  identity_parts(z.data(), above, below);
  return above * math::inverse(below);
}

}  // namespace linkwright::planar
