// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/random.h"
#include "linkwright/math/vector3.h"

namespace linkwright::parallel {

/// Each coordinate within +-size; drawn x first.
inline math::Vec3 random_vector(RandomStream& random, double size) {
  const double x = random.uniform(-size, size), y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

}  // namespace linkwright::parallel
