// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/vector3.h"

#include <algorithm>
#include <array>

namespace linkwright::math {

Vec3 turn_of(const Mat3& rotation) {
  const auto& [a, b, c] = rotation.row;
  // The largest of the four squares of Euler parameters times four; the others follow from it by division.
  const std::array<double, 4> squares = {1 + a.x + b.y + c.z, 1 + a.x - b.y - c.z, 1 - a.x + b.y - c.z,
                                         1 - a.x - b.y + c.z};
  const Vec3 odd{c.y - b.z, a.z - c.x, b.x - a.y}, even{c.y + b.z, a.z + c.x, b.x + a.y};
  double w = 0;
  Vec3 v;
  switch (std::max_element(squares.begin(), squares.end()) - squares.begin()) {
    case 0:
      w = squares[0], v = odd;
      break;
    case 1:
      w = odd.x, v = {squares[1], even.z, even.y};
      break;
    case 2:
      w = odd.y, v = {even.z, squares[2], even.x};
      break;
    default:
      w = odd.z, v = {even.y, even.x, squares[3]};
  }
  // (w, v) is a multiple of (cos, sin n) of half the angle.
  if (w < 0) w = -w, v = -v;
  const double sine = norm(v);
  return sine == 0 ? Vec3{} : (2 * std::atan2(sine, w) / sine) * v;
}

Mat3 rectified(const Mat3& m) {
  // m (3 - m^T m) / 2: one step of Newton's method for the polar factor.
  const Mat3 square = transposed(m) * m;
  Mat3 factor;
  for (int i = 0; i < 3; ++i) factor.row[i] = 1.5 * Mat3{}.row[i] - 0.5 * square.row[i];
  return m * factor;
}

}  // namespace linkwright::math
