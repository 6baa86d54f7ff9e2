#pragma once

#include <array>
#include <complex>
#include <cstddef>

#include "linkwright/core/random.h"
#include "linkwright/math/complex.h"
#include "linkwright/planar/exact/detail/curve_equation.h"

/// The systems of equations of exact path synthesis, as math/path_tracker.h takes them. The first half of the
/// unknowns and of the data are places, the second half their conjugates, in the same order.
namespace linkwright::planar {

using ComplexNumber = math::Complex<double>;
inline ComplexNumber complex_number(const std::complex<double>& z) { return {z.real(), z.imag()}; }
inline std::complex<double> standard_complex(const ComplexNumber& z) { return {z.re, z.im}; }

template <class System>
using SystemData = std::array<ComplexNumber, System::data>;
template <class System>
using SystemPoint = std::array<ComplexNumber, System::unknowns>;
template <class T = double>
using ComplexFourBar = std::array<math::Complex<T>, four_bar_unknowns>;

/// Another four-bar with the same coupler curve (Roberts-Chebyshev): its pivots are the first one's third and
/// first. Applied three times it gives back the first. Not finite where the pins x and y coincide.
template <class T>
LINKWRIGHT_KERNEL ComplexFourBar<T> next_cognate(const ComplexFourBar<T>& z) {
  ComplexFourBar<T> out;
  for (std::size_t half = 0; half < 8; half += 4) {
    const math::Complex<T>&x = z[half + pin_x], &a = z[half + pivot_a], &y = z[half + pin_y],
          &b = z[half + pivot_b];
    const math::Complex<T> share = math::inverse(x - y);
    out[half + pin_x] = (x - a) * y * share;
    out[half + pivot_a] = (b * x - a * y) * share;
    out[half + pin_y] = a - x;
    out[half + pivot_b] = a;
  }
  return out;
}

/// Sum of the squares of the unknowns.
template <class T, std::size_t n>
LINKWRIGHT_KERNEL double squared_size(const std::array<math::Complex<T>, n>& z) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += static_cast<double>(math::norm(z[i]));
  return sum;
}

/// Replaces a four-bar by its cognate with the smallest numbers; true if that is below `share` of its own.
template <class T>
LINKWRIGHT_KERNEL bool take_smaller_cognate(ComplexFourBar<T>& z, double share) {
  const ComplexFourBar<T> second = next_cognate(z), third = next_cognate(second);
  const double own = squared_size(z), other = squared_size(second), last = squared_size(third);
  const ComplexFourBar<T>& best = last < other || !(other == other) ? third : second;
  if (!(squared_size(best) < share * share * own)) return false;
  z = best;
  return true;
}

/// What identities of solutions are made of, the same in every program.
struct RandomForms {
  static constexpr std::size_t count = 4;
  std::array<ComplexNumber, count> d, D, above, below;
};
const RandomForms& random_forms();

/// A number of two doubles as a C: a complex number of another scalar, or a ball about one.
template <class C>
LINKWRIGHT_KERNEL C from_double(const ComplexNumber& value) {
  if constexpr (requires(C c) { c.middle; })
    return C(decltype(C().middle)(value));
  else
    return C(value);
}

/// The curve passes eight points beside the first. Data: d_1..d_8, D_1..D_8.
struct NinePoints {
  static constexpr std::size_t unknowns = four_bar_unknowns, others = 8, data = 2 * others;
  static constexpr double largest_chart = 20;

  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, C* values, C (*jacobian)[unknowns]) const {
    C by_d, by_D;
    for (std::size_t j = 0; j < others; ++j) {
      const CurveEquation<C> curve(z, p[j], p[others + j]);
      values[j] = curve.value;
      curve.gradient(z, p[j], p[others + j], jacobian[j], by_d, by_D);
    }
  }
  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, const C* rate, C* values, C (*jacobian)[unknowns],
                                  C* values_rate) const {
    C by_d, by_D;
    for (std::size_t j = 0; j < others; ++j) {
      const CurveEquation<C> curve(z, p[j], p[others + j]);
      values[j] = curve.value;
      curve.gradient(z, p[j], p[others + j], jacobian[j], by_d, by_D);
      values_rate[j] = by_d * rate[j] + by_D * rate[others + j];
    }
  }
  template <class T>
  LINKWRIGHT_KERNEL bool better_chart(ComplexFourBar<T>& z) const {
    return take_smaller_cognate(z, 0.4);
  }

  /// Data and solution of the same points for this four-bar.
  static void put(const ComplexFourBar<>& four_bar, const ComplexNumber* d, const ComplexNumber* D,
                  SystemData<NinePoints>& p, SystemPoint<NinePoints>& z) {
    z = four_bar;
    for (std::size_t j = 0; j < others; ++j) p[j] = d[j], p[others + j] = D[j];
  }
  /// A number that tells solutions apart and that all six four-bars of a class share: the ratio of two random
  /// linear forms in the coefficients of their curve.
  static ComplexNumber identity(const SystemPoint<NinePoints>& z);
  /// The two forms, of any complex number that is made from a ComplexNumber.
  template <class C>
  static void identity_parts(const C* z, C& above, C& below) {
    const RandomForms& forms = random_forms();
    above = below = C();
    for (std::size_t m = 0; m < RandomForms::count; ++m) {
      const C value = CurveEquation<C>(z, from_double<C>(forms.d[m]), from_double<C>(forms.D[m])).value;
      above = above + from_double<C>(forms.above[m]) * value;
      below = below + from_double<C>(forms.below[m]) * value;
    }
  }
  /// The one of the three cognates with the smallest numbers.
  static void settle(SystemPoint<NinePoints>& z) { take_smaller_cognate(z, 0.95); }
};

/// The same, with a random linear form of the curve's coefficients added to the last equation, times the last
/// but one number of the data: the hyperplanes of the trace test. The last number is not used.
struct NinePointsTrace {
  static constexpr std::size_t unknowns = four_bar_unknowns, others = 8, data = 2 * others + 2, forms = 16;
  static constexpr double largest_chart = NinePoints::largest_chart;
  /// Values of the curve at generic points (d, D), weighted.
  struct Form {
    std::array<ComplexNumber, forms> d, D, weight;
  };
  const Form* form;

  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, C* values, C (*jacobian)[unknowns]) const {
    C unused;
    NinePoints().evaluate(z, p, values, jacobian);
    add_form(z, p, values, jacobian, unused);
  }
  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, const C* rate, C* values, C (*jacobian)[unknowns],
                                  C* values_rate) const {
    C form_value;
    NinePoints().evaluate(z, p, rate, values, jacobian, values_rate);
    add_form(z, p, values, jacobian, form_value);
    values_rate[others - 1] = values_rate[others - 1] + rate[2 * others] * form_value;
  }
  template <class T>
  LINKWRIGHT_KERNEL bool better_chart(ComplexFourBar<T>& z) const {
    return take_smaller_cognate(z, 0.4);
  }

 private:
  template <class C>
  LINKWRIGHT_KERNEL void add_form(const C* z, const C* p, C* values, C (*jacobian)[unknowns], C& sum) const {
    C by_d, by_D, gradient[unknowns];
    const C& s = p[2 * others];
    sum = C();
    for (std::size_t m = 0; m < forms; ++m) {
      const C d(form->d[m]), D(form->D[m]), weight(form->weight[m]);
      const CurveEquation<C> curve(z, d, D);
      curve.gradient(z, d, D, gradient, by_d, by_D);
      sum = sum + weight * curve.value;
      const C factor = s * weight;
      for (std::size_t i = 0; i < unknowns; ++i)
        jacobian[others - 1][i] = jacobian[others - 1][i] + factor * gradient[i];
    }
    values[others - 1] = values[others - 1] + s * sum;
  }
};

/// The curve of a four-bar with given fixed pivots passes four points beside the first. Unknowns: x, y, X, Y;
/// data: d_1..d_4, a, b, D_1..D_4, A, B.
struct FivePointsTwoPivots {
  static constexpr std::size_t unknowns = 4, others = 4, half = others + 2, data = 2 * half;
  static constexpr double largest_chart = 1e150;  // there is but one

  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, C* values, C (*jacobian)[unknowns]) const {
    C unused[unknowns];
    evaluate(z, p, p, values, jacobian, unused);
  }
  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, const C* rate, C* values, C (*jacobian)[unknowns],
                                  C* values_rate) const {
    C four_bar[four_bar_unknowns], by_z[four_bar_unknowns], by_d, by_D;
    fill(four_bar, z, p);
    for (std::size_t j = 0; j < others; ++j) {
      const CurveEquation<C> curve(four_bar, p[j], p[half + j]);
      curve.gradient(four_bar, p[j], p[half + j], by_z, by_d, by_D);
      values[j] = curve.value;
      jacobian[j][0] = by_z[pin_x], jacobian[j][1] = by_z[pin_y];
      jacobian[j][2] = by_z[pin_X], jacobian[j][3] = by_z[pin_Y];
      values_rate[j] = by_d * rate[j] + by_D * rate[half + j] + by_z[pivot_a] * rate[others] +
                       by_z[pivot_b] * rate[others + 1] + by_z[pivot_A] * rate[half + others] +
                       by_z[pivot_B] * rate[half + others + 1];
    }
  }
  template <class T>
  LINKWRIGHT_KERNEL bool better_chart(std::array<math::Complex<T>, unknowns>&) const {
    return false;
  }

  /// The four-bar of a solution and its data.
  template <class C>
  LINKWRIGHT_KERNEL static void fill(C* four_bar, const C* z, const C* p) {
    four_bar[pin_x] = z[0], four_bar[pin_y] = z[1], four_bar[pin_X] = z[2], four_bar[pin_Y] = z[3];
    four_bar[pivot_a] = p[others], four_bar[pivot_b] = p[others + 1];
    four_bar[pivot_A] = p[half + others], four_bar[pivot_B] = p[half + others + 1];
  }
  static void put(const ComplexFourBar<>& four_bar, const ComplexNumber* d, const ComplexNumber* D,
                  SystemData<FivePointsTwoPivots>& p, SystemPoint<FivePointsTwoPivots>& z) {
    z = {four_bar[pin_x], four_bar[pin_y], four_bar[pin_X], four_bar[pin_Y]};
    for (std::size_t j = 0; j < others; ++j) p[j] = d[j], p[half + j] = D[j];
    p[others] = four_bar[pivot_a], p[others + 1] = four_bar[pivot_b];
    p[half + others] = four_bar[pivot_A], p[half + others + 1] = four_bar[pivot_B];
  }
  static ComplexNumber identity(const SystemPoint<FivePointsTwoPivots>& z);
  static void settle(SystemPoint<FivePointsTwoPivots>&) {}
};

/// A complex number whose parts are normal with a mean square of 1/2.
ComplexNumber random_complex(RandomStream& stream);

}  // namespace linkwright::planar
