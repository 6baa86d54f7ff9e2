#include "linkwright/math/vector3.h"

namespace linkwright::math {

Mat3 rectified(const Mat3& m) {
  // m (3 - m^T m) / 2: one step of Newton's method for the polar factor.
  const Mat3 square = transposed(m) * m;
  Mat3 factor;
  for (int i = 0; i < 3; ++i) factor.row[i] = 1.5 * Mat3{}.row[i] - 0.5 * square.row[i];
  return m * factor;
}

}  // namespace linkwright::math
