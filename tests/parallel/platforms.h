// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/random.h"
#include "linkwright/math/vector3.h"
#include "linkwright/parallel/assembly_modes/platform_paths.h"
#include "parallel/random_vector.h"

/// Platforms on six legs for tests of their polynomials.
namespace linkwright::parallel {

inline PlatformLegs complex_platform(std::uint32_t number) { return random_platform(4711, number); }

/// A point with e . h = 0.
inline PlatformPoint complex_point(std::uint32_t number) {
  RandomStream random({4712, number});
  PlatformPoint x;
  for (Complex& c : x) {
    const double re = random.normal(), im = random.normal();
    c = {re, im};
  }
  x[7] = -(x[0] * x[4] + x[1] * x[5] + x[2] * x[6]) / x[3];
  return x;
}

/// A real platform at a pose, made by vectors: rotation about a vector, rods as long as they come out.
struct PlacedPlatform {
  PlatformLegs legs{};
  PlatformPoint point;
  double rotation_square;  ///< n of the point
};
inline PlacedPlatform placed_platform(std::uint32_t number) {
  using math::Vec3;
  RandomStream random({4713, number});
  const Vec3 turn = random_vector(random, 1), p = random_vector(random, 1);
  const auto rotation = math::turn_about(turn);
  PlacedPlatform out;
  double first = 0;
  for (int i = 0; i < 6; ++i) {
    const Vec3 a = i == 0 ? Vec3{} : random_vector(random, 1),
               b = i == 0 ? Vec3{} : random_vector(random, 0.5);
    const double base[] = {a.x, a.y, a.z}, platform[] = {b.x, b.y, b.z};
    for (int k = 0; k < 3; ++k) {
      out.legs.base[k].re[i] = base[k];
      out.legs.platform[k].re[i] = platform[k];
    }
    const Vec3 rod = p + rotation * b - a;
    if (i == 0) first = dot(rod, rod);
    out.legs.square.re[i] = i == 0 ? first : dot(rod, rod) - first;
  }
  // e of any length, h = p e.
  const double angle = norm(turn), size = 0.7;
  const double w = size * std::cos(angle / 2);
  const Vec3 v = (size * std::sin(angle / 2) / angle) * turn;
  const Vec3 h = w * p + cross(p, v);
  out.point = {w, v.x, v.y, v.z, -dot(p, v), h.x, h.y, h.z};
  out.rotation_square = size * size;
  return out;
}

}  // namespace linkwright::parallel
