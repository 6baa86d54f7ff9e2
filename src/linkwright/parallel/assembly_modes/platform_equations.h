// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>

#include "linkwright/math/vector3.h"

/// The equations of a platform on six legs of constant length between ball joints (6-SPS), as polynomials.
///
/// The platform is placed by eight homogeneous numbers x = (e, h), Study's parameters: a quaternion e of the
/// rotation, n = e . e, and a quaternion h across it with the platform point p = h conj(e) / n. As
/// (p + R b - a) e = h + e b - a e, a leg between a and b of squared length s asks for
///
///     |h + w|^2 - s n = 0, w = e b - a e,
///
/// and all poses for e . h = 0: seven quadratic equations in projective space. Over complex numbers (a^2 is
/// a . a, never |a|^2) they have 40 solutions with n other than 0, which is the greatest number of assembly
/// modes (Ronga and Vust 1995; Wampler 1996, who uses these coordinates). Seen from the joints of the first
/// leg its w is 0; taken off the other equations it leaves
///
///     h . h - s_1 n = 0,    w_i . (w_i + 2 h) - (s_i - s_1) n = 0,
///
/// which stay apart also where e is small: some of the 40 solutions of common robots are nearly there.
namespace linkwright::parallel {

using Complex = std::complex<double>;

inline constexpr std::size_t max_solutions = 40;

/// Six complex numbers, one for each leg; whole operations, so that they run in SIMD registers.
struct Six {
  double re[6]{}, im[6]{};
};

/// Joints of the legs at the base and at the platform, seen from those of the first leg, so that its are 0;
/// squared length of the first leg, and by how much those of the others are greater. These are the numbers
/// that may be continued to another platform, also through complex values.
struct PlatformLegs {
  std::array<Six, 3> base, platform;
  Six square;
};

/// first + factor * second, number by number.
PlatformLegs sum(const PlatformLegs& first, double factor, const PlatformLegs& second);

/// The same platform in other units of length: lengths times `factor`, which may be complex.
PlatformLegs scaled(const PlatformLegs& legs, Complex factor);

/// (e, h): scalar part first.
using PlatformPoint = std::array<Complex, 8>;

/// Squares that make `point` (with e . h = 0) a solution.
Six squares_through(const PlatformLegs& legs, const PlatformPoint& point);

double length(const PlatformPoint& point);
PlatformPoint normalised(const PlatformPoint& point);
/// The solution of scaled(legs, factor) that belongs to one of `legs`.
PlatformPoint scaled(const PlatformPoint& point, Complex factor);

/// Sine of the angle between two points as lines through 0: 0 = the same solution, 1 at most.
double distance(const PlatformPoint& a, const PlatformPoint& b);
PlatformPoint conjugate(const PlatformPoint& point);

/// Matrix of eight columns of complex numbers and its factors L U = P A.
struct Eight {
  double re[8][8], im[8][8];  ///< [column][row]
};
class EightLu {
 public:
  /// False where a pivot is 0 or not finite.
  bool factor(const Eight& matrix);
  void solve(PlatformPoint& right) const;

 private:
  Eight lu_;
  int swapped_[8];
  double inverse_re_[8], inverse_im_[8];
};

/// The eight functions (six legs, e . h, and conj(chart) . (x - chart), which takes one point of each line)
/// and their Jacobian at x.
struct PlatformValues {
  PlatformPoint value;
  Eight jacobian;
};
void evaluate(const PlatformLegs& legs, const PlatformPoint& x, const PlatformPoint& chart,
              PlatformValues& out);

/// Terms of the power series of the solution that goes through x at `from`, on the path to `from` + `rate`:
/// x(t) = sum of term[k] t^k with conj(x) . x(t) constant. All are found with the one factorised Jacobian at
/// x, as the equations are quadratic.
inline constexpr int series_order = 8;
using PlatformSeries = std::array<PlatformPoint, series_order + 1>;
void expand(const PlatformLegs& legs, const PlatformLegs& rate, const PlatformPoint& x, const EightLu& lu,
            PlatformSeries& out);

}  // namespace linkwright::parallel
