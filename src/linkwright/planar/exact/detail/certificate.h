// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "linkwright/math/ball.h"
#include "linkwright/planar/exact/detail/path_systems.h"

namespace linkwright::planar {

using DoubleDoubleComplex = math::Complex<math::DoubleDouble>;
/// The data of nine points, exact as a rule: differences of doubles.
using ExactNinePoints = std::array<DoubleDoubleComplex, NinePoints::data>;

/// A ball that holds exactly one solution: within `radius[i]` of each unknown.
struct SolutionBall {
  std::array<double, four_bar_unknowns> radius{};
};

/// Proof that one and only one solution, a simple one, lies near an approximate solution: the operator of
/// Krawczyk (1969) maps a polydisc about it into itself, evaluated in balls. A centre that is its own
/// conjugate so proves a real solution. nullopt: not proved, with the digits of T at least.
template <class T>
std::optional<SolutionBall> certify(const ExactNinePoints& p, const ComplexFourBar<T>& z);

/// The identity (NinePoints::identity) of the solution in a ball: within `radius`, infinite where nothing is
/// known.
struct CertifiedIdentity {
  ComplexNumber identity;
  double radius = 0;
};
template <class T>
CertifiedIdentity certified_identity(const ComplexFourBar<T>& z, const SolutionBall& ball);

/// The identity of the class near `z`, certified with as many digits as that takes: those of doubles, unless
/// they are known not to do (`extended`), twice as many, four times as many, about each of the three
/// cognates. Where no identity is sharp enough to distinguish classes, the sharpest; nullopt where none is
/// certified. `real`: the certificate is of a real class.
std::optional<CertifiedIdentity> prove_class(const ExactNinePoints& p,
                                             const ComplexFourBar<math::DoubleDouble>& z, bool extended,
                                             bool real);

}  // namespace linkwright::planar
