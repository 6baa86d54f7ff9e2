// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>

#include "linkwright/core/numbers.h"
#include "linkwright/math/path_tracker.h"
#include "linkwright/planar/exact/detail/follow.h"
#include "linkwright/planar/exact/detail/wide_number.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t n = four_bar_unknowns;
// Radius relative to the correction, and to a radius that was too small.
constexpr double first_radius = 2, wider = 6;
constexpr int max_radii = 5;

// An identity proved to this share of its size decides between two classes.
constexpr double sharp_identity = 1e-9;

template <class T, std::size_t count>
std::array<math::Complex<T>, count> with_digits_of(const std::array<DoubleDoubleComplex, count>& z) {
  std::array<math::Complex<T>, count> out;
  for (std::size_t i = 0; i < count; ++i) out[i] = math::Complex<T>(z[i]);
  return out;
}

template <class T>
math::Ball<T> data_ball(const DoubleDoubleComplex& value) {
  if constexpr (std::is_same_v<T, double>)
    return math::Ball<double>({value.re.high, value.im.high},
                              2 * (std::abs(value.re.low) + std::abs(value.im.low)));
  else
    return math::Ball<T>(math::Complex<T>(value));
}

// The columns of the inverse, as good as T makes it.
template <class T>
void invert(const std::array<math::Complex<T>, NinePoints::data>& p, const ComplexFourBar<T>& z,
            math::Complex<T> (&columns)[n][n]) {
  math::Complex<T> values[n];
  math::tracker::Lu<T, n> lu;
  NinePoints().evaluate(z.data(), p.data(), values, lu.a);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) columns[j][i] = {T(i == j ? 1.0 : 0.0), T(0.0)};
  lu.solve(columns);
}

// The operator in one scale of the unknowns.
template <class T>
std::optional<SolutionBall> certify_scaled(const math::Ball<T> (&data)[NinePoints::data],
                                           const ComplexFourBar<T>& z,
                                           const math::Complex<T> (&inverse)[n][n],
                                           const double (&scale)[n]) {
  using B = math::Ball<T>;
  B at[n], values[n], jacobian[n][n];
  for (std::size_t i = 0; i < n; ++i) at[i] = B(z[i]);
  NinePoints().evaluate(at, data, values, jacobian);
  double correction[n], largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    B sum = B(inverse[0][i]) * values[0];
    for (std::size_t j = 1; j < n; ++j) sum = sum + B(inverse[j][i]) * values[j];
    correction[i] = sum.size() / scale[i] * (1 + 1e-12);
    largest = std::max(largest, correction[i]);
  }
  if (!(largest < 1e-2)) return std::nullopt;

  double radius = first_radius * std::max(largest, 1e-300);
  for (int trial = 0; trial < max_radii && radius < 0.1; ++trial, radius *= wider) {
    for (std::size_t i = 0; i < n; ++i) at[i] = B(z[i], radius * scale[i] * (1 + 1e-12));
    NinePoints().evaluate(at, data, values, jacobian);
    bool inside = true;
    for (std::size_t i = 0; i < n && inside; ++i) {
      double row = 0;
      for (std::size_t j = 0; j < n; ++j) {
        B sum = B(inverse[0][i]) * jacobian[0][j];
        for (std::size_t k = 1; k < n; ++k) sum = sum + B(inverse[k][i]) * jacobian[k][j];
        if (i == j) sum = sum - B(math::Complex<T>(T(1.0), T(0.0)));
        row += sum.size() * scale[j] / scale[i] * (1 + 1e-12);
      }
      inside = row < 1 && (correction[i] + radius * row) * (1 + 1e-12) < radius;
    }
    if (!inside) continue;
    SolutionBall out;
    for (std::size_t i = 0; i < n; ++i) out.radius[i] = radius * scale[i] * (1 + 1e-12);
    return out;
  }
  return std::nullopt;
}

}  // namespace

template <class T>
std::optional<SolutionBall> certify(const ExactNinePoints& p, const ComplexFourBar<T>& z) {
  math::Ball<T> data[NinePoints::data];
  std::array<math::Complex<T>, NinePoints::data> middles;
  for (std::size_t i = 0; i < NinePoints::data; ++i)
    data[i] = data_ball<T>(p[i]), middles[i] = data[i].middle;
  math::Complex<T> inverse[n][n];  // column by column
  invert(middles, z, inverse);
  // Unknowns count in their own sizes, but not in less than a share of all: where one pivot is far away, a
  // pin may be known a million times as well.
  const double size = std::sqrt(squared_size(z));
  for (const double share : {1e-3, 1e-7, 1e-11}) {
    double scale[n];
    for (std::size_t i = 0; i < n; ++i)
      scale[i] = std::max(std::sqrt(static_cast<double>(math::norm(z[i]))), share * size);
    if (const auto ball = certify_scaled(data, z, inverse, scale)) return ball;
  }
  return std::nullopt;
}

template <class T>
CertifiedIdentity certified_identity(const ComplexFourBar<T>& z, const SolutionBall& ball) {
  using B = math::Ball<T>;
  B at[n];
  for (std::size_t i = 0; i < n; ++i) at[i] = B(z[i], ball.radius[i]);
  B above, below;
  NinePoints::identity_parts(at, above, below);
  const math::Complex<T> ratio = above.middle * math::inverse(below.middle);
  // |a'/b' - a/b| <= (ra + |a/b| rb) / (|b| - rb)
  const double size = std::sqrt(static_cast<double>(math::norm(ratio))),
               floor = std::sqrt(static_cast<double>(math::norm(below.middle))) * (1 - 1e-12) - below.radius;
  const ComplexNumber identity(static_cast<double>(ratio.re), static_cast<double>(ratio.im));
  if (!(floor > 0)) return {identity, infinity};
  return {identity, (above.radius + size * below.radius) / floor * (1 + 1e-9) + 1e-15 * size};
}

namespace {

// The attempts of prove_class(), sharper and sharper.
class ClassProver {
 public:
  ClassProver(const ExactNinePoints& p, bool real) : p_(p), real_(real) {}
  const std::optional<CertifiedIdentity>& best() const { return best_; }

  /// True if the identity is sharp.
  template <class T>
  bool about(const ComplexFourBar<T>& z) {
    const ComplexFourBar<T> middle = real_ ? real_four_bar(z) : z;
    if (const auto ball = certify(p_, middle)) {
      const CertifiedIdentity proof = certified_identity(middle, *ball);
      if (!best_ || proof.radius < best_->radius) best_ = proof;
    }
    return best_ && best_->radius < sharp_identity * (1 + std::sqrt(math::norm(best_->identity)));
  }

  /// The same about the three cognates of z, polished to `accuracy` with the digits of T.
  template <class T>
  bool about_cognates(const ComplexFourBar<math::DoubleDouble>& z, double accuracy, int steps) {
    const auto p = with_digits_of<T>(p_);
    ComplexFourBar<T> next = with_digits_of<T>(z);
    for (int cognate = 0; cognate < 3; ++cognate, next = next_cognate(next)) {
      ComplexFourBar<T> polished = next;
      polish(NinePoints(), p, polished, accuracy, steps);
      if (about(polished)) return true;
    }
    return false;
  }

 private:
  const ExactNinePoints& p_;
  const bool real_;
  std::optional<CertifiedIdentity> best_;
};

}  // namespace

std::optional<CertifiedIdentity> prove_class(const ExactNinePoints& p,
                                             const ComplexFourBar<math::DoubleDouble>& z, bool extended,
                                             bool real) {
  ClassProver prover(p, real);
  if (!extended && prover.about(rounded(z))) return prover.best();
  if (!prover.about_cognates<math::DoubleDouble>(z, 1e-26, 6)) prover.about_cognates<WideNumber>(z, 1e-50, 8);
  return prover.best();
}

template std::optional<SolutionBall> certify(const ExactNinePoints&, const ComplexFourBar<double>&);
template std::optional<SolutionBall> certify(const ExactNinePoints&,
                                             const ComplexFourBar<math::DoubleDouble>&);
template std::optional<SolutionBall> certify(const ExactNinePoints&, const ComplexFourBar<WideNumber>&);
template CertifiedIdentity certified_identity(const ComplexFourBar<double>&, const SolutionBall&);
template CertifiedIdentity certified_identity(const ComplexFourBar<math::DoubleDouble>&, const SolutionBall&);
template CertifiedIdentity certified_identity(const ComplexFourBar<WideNumber>&, const SolutionBall&);

}  // namespace linkwright::planar
