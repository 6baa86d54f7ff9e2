// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <tuple>
#include <utility>

#include "linkwright/core/random.h"
#include "linkwright/math/complex.h"
#include "linkwright/planar/exact/detail/curve_equation.h"

/// The systems of equations of exact path synthesis, as math/path_tracker.h takes them. Of the unknowns the
/// first `places` are places, so many after them their conjugates in the same order, what is left the square
/// of a direction; of the data the first half are places, the second half their conjugates.
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

/// The four-bar of the conjugate data; a real one is its own.
template <class T>
ComplexFourBar<T> conjugate_four_bar(const ComplexFourBar<T>& z) {
  ComplexFourBar<T> out;
  for (std::size_t i = 0; i < 4; ++i) out[i] = math::conj(z[i + 4]), out[i + 4] = math::conj(z[i]);
  return out;
}

/// The mean of a four-bar and its conjugate: one that is its own conjugate, exactly.
template <class T>
ComplexFourBar<T> real_four_bar(const ComplexFourBar<T>& z) {
  const ComplexFourBar<T> other = conjugate_four_bar(z);
  ComplexFourBar<T> out;
  for (std::size_t i = 0; i < 4; ++i) {
    out[i] = T(0.5) * (z[i] + other[i]);
    out[i + 4] = math::conj(out[i]);
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

/// The linear forms that make the identities of solutions, the same in every program.
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
  static constexpr std::size_t others = 8, half = others, data = 2 * half;
  static constexpr std::size_t places = 4, unknowns = 2 * places;
  static constexpr double largest_chart = 20;
  using Bars = ComplexFourBar<>;

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
                  const ComplexNumber*, SystemData<NinePoints>& p, SystemPoint<NinePoints>& z) {
    z = four_bar;
    for (std::size_t j = 0; j < others; ++j) p[j] = d[j], p[others + j] = D[j];
  }
  /// A number that distinguishes solutions and that all six four-bars of a class share: the ratio of two
  /// random linear forms in the coefficients of their curve.
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

/// A number that distinguishes solutions: a random linear form of the unknowns.
template <std::size_t n>
ComplexNumber form_of_unknowns(const std::array<ComplexNumber, n>& z) {
  const RandomForms& forms = random_forms();
  static_assert(n <= 2 * RandomForms::count);
  ComplexNumber sum;
  for (std::size_t i = 0; i < n; ++i)
    sum = sum + (i < RandomForms::count ? forms.above[i] : forms.below[i - RandomForms::count]) * z[i];
  return sum;
}

/// The curve of a four-bar with `given` fixed pivots, 1 (the crank's) or 2, passes 8 - 2 `given` points
/// beside the first. Unknowns: x, y, b unless it is given, X, Y, B; data: d_1.., a, b if it is given, D_1..,
/// A, B.
template <std::size_t given>
struct PointsAndPivots {
  static constexpr std::size_t others = 8 - 2 * given, half = others + given, data = 2 * half;
  static constexpr std::size_t places = 4 - given, unknowns = 2 * places;
  static constexpr double largest_chart = 1e150;  // there is but one
  using Bars = ComplexFourBar<>;

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
      for (std::size_t i = 0; i < places; ++i) {
        jacobian[j][i] = by_z[unknown[i]];
        jacobian[j][places + i] = by_z[unknown[i] + pin_X];
      }
      C sum = by_d * rate[j] + by_D * rate[half + j];
      for (std::size_t k = 0; k < given; ++k) sum = sum + by_z[pivot[k]] * rate[others + k];
      for (std::size_t k = 0; k < given; ++k) sum = sum + by_z[pivot[k] + pin_X] * rate[half + others + k];
      values_rate[j] = sum;
    }
  }
  template <class T>
  LINKWRIGHT_KERNEL bool better_chart(std::array<math::Complex<T>, unknowns>&) const {
    return false;
  }

  /// The four-bar of a solution and its data.
  template <class C>
  LINKWRIGHT_KERNEL static void fill(C* four_bar, const C* z, const C* p) {
    for (std::size_t i = 0; i < places; ++i)
      four_bar[unknown[i]] = z[i], four_bar[unknown[i] + pin_X] = z[places + i];
    for (std::size_t k = 0; k < given; ++k)
      four_bar[pivot[k]] = p[others + k], four_bar[pivot[k] + pin_X] = p[half + others + k];
  }
  static void put(const Bars& four_bar, const ComplexNumber* d, const ComplexNumber* D, const ComplexNumber*,
                  SystemData<PointsAndPivots>& p, SystemPoint<PointsAndPivots>& z) {
    for (std::size_t i = 0; i < places; ++i)
      z[i] = four_bar[unknown[i]], z[places + i] = four_bar[unknown[i] + pin_X];
    for (std::size_t j = 0; j < others; ++j) p[j] = d[j], p[half + j] = D[j];
    for (std::size_t k = 0; k < given; ++k)
      p[others + k] = four_bar[pivot[k]], p[half + others + k] = four_bar[pivot[k] + pin_X];
  }
  static ComplexNumber identity(const SystemPoint<PointsAndPivots>& z) { return form_of_unknowns(z); }
  static void settle(SystemPoint<PointsAndPivots>&) {}

 private:
  static constexpr FourBarUnknown unknown[] = {pin_x, pin_y, pivot_b}, pivot[] = {pivot_a, pivot_b};
};
using FivePointsTwoPivots = PointsAndPivots<2>;
using SevenPointsOnePivot = PointsAndPivots<1>;

/// A body that two dyads lead is at `poses` places, none or more, beside the first in given rotations, and
/// its origin passes `unknowns` - 2 `poses` points. Unknowns: those of its linkage; data: d of the poses and
/// points in this order, D, then e^(i gamma) of the poses; what is more than there are is not used.
template <template <class> class Curve, class BarsOfSystem>
struct PosesAndPoints {
  static constexpr std::size_t unknowns = std::tuple_size_v<BarsOfSystem>, places = unknowns / 2;
  static constexpr std::size_t others = unknowns, half = others, max_poses = 3, data = 2 * half + max_poses;
  static constexpr double largest_chart = 1e150;  // there is but one
  using Bars = BarsOfSystem;

  std::size_t poses = 0;

  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, C* values, C (*jacobian)[unknowns]) const {
    C unused[unknowns];
    evaluate(z, p, p, values, jacobian, unused);
  }
  template <class C>
  LINKWRIGHT_KERNEL void evaluate(const C* z, const C* p, const C* rate, C* values, C (*jacobian)[unknowns],
                                  C* values_rate) const {
    const C one(ComplexNumber(1, 0)), none;
    std::size_t row = 0;
    const auto add = [&](std::size_t j, const C& value, const typename TwoDyads<C>::Partials& by,
                         const C& by_turn) {
      C by_d, by_D;
      values[row] = value;
      Curve<C>::chain(by, z, p[j], p[half + j], jacobian[row], by_d, by_D);
      values_rate[row] = by_d * rate[j] + by_D * rate[half + j] + by_turn;
      ++row;
    };
    for (std::size_t j = 0; j < unknowns - poses; ++j) {
      const Curve<C> curve(z, p[j], p[half + j]);
      if (j >= poses) {
        add(j, curve.value, curve.partials(), none);
        continue;
      }
      const C& turn = p[2 * half + j];
      const C back = math::inverse(turn), g = turn - one, G = back - one;
      const C slope = rate[2 * half + j], back_slope = -(back * back) * slope;
      add(j, curve.p1 * g + curve.q1 * G - curve.r1, {g, G, -one, none, none, none},
          curve.p1 * slope + curve.q1 * back_slope);
      add(j, curve.p2 * g + curve.q2 * G - curve.r2, {none, none, none, g, G, -one},
          curve.p2 * slope + curve.q2 * back_slope);
    }
  }
  template <class T>
  LINKWRIGHT_KERNEL bool better_chart(std::array<math::Complex<T>, unknowns>&) const {
    return false;
  }

  static void put(const Bars& bars, const ComplexNumber* d, const ComplexNumber* D,
                  const ComplexNumber* turns, SystemData<PosesAndPoints>& p, SystemPoint<PosesAndPoints>& z) {
    z = bars;
    for (std::size_t j = 0; j < others; ++j) p[j] = d[j], p[half + j] = D[j];
    for (std::size_t j = 0; j < max_poses; ++j) p[2 * half + j] = turns[j];
  }
  /// The same for both orders of two dyads of one type.
  static ComplexNumber identity(const SystemPoint<PosesAndPoints>& z) {
    const ComplexNumber own = form_of_unknowns(z);
    if constexpr (unknowns == four_bar_unknowns) {
      SystemPoint<PosesAndPoints> swapped = z;
      for (const std::size_t first : {pin_x, pin_X})
        for (const std::size_t i : {first, first + 1}) std::swap(swapped[i], swapped[i + 2]);
      return own * form_of_unknowns(swapped);
    } else {
      return own;
    }
  }
  static void settle(SystemPoint<PosesAndPoints>&) {}
};
using FourBarPoses = PosesAndPoints<CurveEquation, ComplexFourBar<>>;
using ComplexSliderCrank = std::array<ComplexNumber, slider_crank_unknowns>;
using SliderPoses = PosesAndPoints<SliderCurveEquation, ComplexSliderCrank>;
using InvertedPoses = PosesAndPoints<InvertedCurveEquation, ComplexSliderCrank>;

/// One thing for each system.
#define LINKWRIGHT_FOR_EACH_PATH_SYSTEM(make)                                                \
  make(NinePoints) make(NinePointsTrace) make(FivePointsTwoPivots) make(SevenPointsOnePivot) \
      make(FourBarPoses) make(SliderPoses) make(InvertedPoses)

/// e^(i gamma) of the turn of a real body at a point that its dyads allow.
inline std::complex<double> real_turn(const TwoDyads<ComplexNumber>& dyads) {
  // 1 + gt / delta without the division
  const std::complex<double> turn = standard_complex((dyads.gt + dyads.delta) * math::conj(dyads.delta));
  return turn / std::abs(turn);
}

/// A complex number whose parts are normal with a mean square of 1/2.
ComplexNumber random_complex(RandomStream& stream);

}  // namespace linkwright::planar
