# SPDX-License-Identifier: BSD-3-Clause
import unittest

from scratch import ScratchCase
import long_functions

SOURCE = '''// A brace { in a comment, and one in a text:
const char* brace = "{";
namespace one {
struct Point {
  double x{1.0}, y = 2.0;
  explicit Point(double at) : x{at}, y(at) {
    if (x > 0) {
      y = -x;
    }
  }
};
constexpr int limits[] = {1, 2};
template <class T>
auto larger(T a, T b) noexcept -> T {
  const auto first = [&] { return a > b; };
  return first() ? a : b;
}
int declared(int);
}  // namespace one
'''


class LongFunctions(ScratchCase):
    def test_functions_of_cpp(self):
        self.assertEqual(long_functions.functions_of_cpp(SOURCE), [(6, 10, "Point"), (13, 17, "larger")])


if __name__ == "__main__":
    unittest.main()
