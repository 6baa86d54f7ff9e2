#include "linkwright/math/vector3.h"

namespace linkwright::math {

Mat3 turn_about(const Vec3& turn) {
  const double square = dot(turn, turn);
  // sin(a)/a and (1 - cos(a))/a^2; below 1e-2 their series to the last digit.
  double sine, versed;
  if (square < 1e-4) {
    sine = 1 - square / 6 * (1 - square / 20 * (1 - square / 42));
    versed = 0.5 * (1 - square / 12 * (1 - square / 30 * (1 - square / 56)));
  } else {
    const double angle = std::sqrt(square), half = std::sin(angle / 2);
    sine = std::sin(angle) / angle;
    versed = 2 * half * half / square;
  }
  const auto [x, y, z] = turn;
  return {{Vec3{1 - versed * (y * y + z * z), versed * x * y - sine * z, versed * x * z + sine * y},
           Vec3{versed * x * y + sine * z, 1 - versed * (x * x + z * z), versed * y * z - sine * x},
           Vec3{versed * x * z - sine * y, versed * y * z + sine * x, 1 - versed * (x * x + y * y)}}};
}

Mat3 rectified(const Mat3& m) {
  // m (3 - m^T m) / 2: one step of Newton's method for the polar factor.
  const Mat3 square = transposed(m) * m;
  Mat3 factor;
  for (int i = 0; i < 3; ++i) factor.row[i] = 1.5 * Mat3{}.row[i] - 0.5 * square.row[i];
  return m * factor;
}

}  // namespace linkwright::math
