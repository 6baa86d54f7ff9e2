// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/continuum.h"

#include <array>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/zero.h"

namespace linkwright::flexible {

namespace {

using Minors = std::array<double, 6>;
using Matrix6 = std::array<std::array<double, 6>, 6>;

// Rows of the pairs of components (y, psi, M, V).
constexpr int first[6] = {0, 0, 0, 1, 1, 2}, second[6] = {1, 2, 3, 2, 3, 3};

// Row of a pair i < j.
constexpr int row[4][4] = {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}};

Matrix6 product(const Matrix6& a, const Matrix6& b) {
  Matrix6 out{};
  for (int i = 0; i < 6; ++i)
    for (int k = 0; k < 6; ++k)
      for (int j = 0; j < 6; ++j) out[i][j] += a[i][k] * b[k][j];
  return out;
}

// exp(a) up to a positive factor: its Taylor series after halving, then squares.
Matrix6 exponential(Matrix6 a) {
  double norm = 0;
  for (const auto& line : a)
    for (const double x : line) norm = std::max(norm, std::abs(x));
  int halvings = 0;
  for (; norm > 0.1; norm /= 2) ++halvings;
  const double scale = std::ldexp(1.0, -halvings);
  Matrix6 term{}, sum{};
  for (int i = 0; i < 6; ++i) {
    for (double& x : a[i]) x *= scale;
    term[i][i] = sum[i][i] = 1;
  }
  for (int k = 1; k <= 14; ++k) {  // (6 * 0.1)^14 / 14! < 1e-14
    term = product(term, a);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) sum[i][j] += term[i][j] *= 1.0 / k;
  }
  for (; halvings > 0; --halvings) {
    sum = product(sum, sum);
    double most = 0;
    for (const auto& line : sum)
      for (const double x : line) most = std::max(most, std::abs(x));
    for (auto& line : sum)
      for (double& x : line) x /= most;
  }
  return sum;
}

// The rest of the tip mass's balance of force and moment, as a determinant; z^4 = rho A omega^2 L^4 / E I.
double determinant(const Beam& beam, Hub hub, double z) {
  const double length = beam.length, bending = beam.bending_stiffness();
  const double k = z * z * z * z, mass = beam.mass();
  const double shear = bending / (beam.shear_stiffness() * length * length);
  const double rotary = beam.rotary_inertia() / (beam.density * beam.area * length * length);
  // y' = psi + s V, psi' = M, M' = -V - r k psi, V' = -k y; lengths by L, M by E I / L, V by E I / L^2.
  double a[4][4] = {{0, 1, 0, shear}, {0, 0, 1, 0}, {0, -rotary * k, 0, -1}, {-k, 0, 0, 0}};
  Matrix6 b{};
  for (int r = 0; r < 6; ++r)
    for (int side = 0; side < 2; ++side)
      for (int m = 0; m < 4; ++m) {
        const int i = side ? first[r] : m, j = side ? m : second[r];
        const double factor = side ? a[second[r]][m] : a[first[r]][m];
        if (i == j || factor == 0) continue;
        b[r][row[i][j]] += i < j ? factor : -factor;
      }
  // Two solutions at the hub: by V alone, and by what stands with psi or M.
  std::array<double, 4> u{}, v{};
  if (hub == Hub::driven) {
    u = {0, 0, 1, 0};
    v = {0, 0, 0, 1};
  } else {
    const double radius = beam.hub_radius / length;
    const double inertia = beam.hub_inertia / (mass * length * length);
    const double spring = beam.hub_stiffness * length / bending;
    u = {radius, 1, spring - inertia * k, 0};  // M + r_H V = (spring - J_H omega^2) theta
    v = {0, 0, -radius, 1};
  }
  Minors start{}, end{};
  for (int r = 0; r < 6; ++r) start[r] = u[first[r]] * v[second[r]] - u[second[r]] * v[first[r]];
  const Matrix6 carried = exponential(b);
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) end[r] += carried[r][c] * start[c];
  const double tip = beam.tip_mass / mass * k;
  const double turning = beam.tip_inertia / (mass * length * length) * k;
  const auto p = [&](int i, int j) { return end[row[i][j]]; };
  // (V - tip y) and (M - turning psi) of both solutions.
  return -p(2, 3) - turning * -p(1, 3) - tip * p(0, 2) + tip * turning * p(0, 1);
}

}  // namespace

std::vector<double> continuum_frequencies(const Beam& beam, int count, Hub hub) {
  const auto found = problem(beam);
  LINKWRIGHT_REQUIRE(!found, "{}", *found);
  LINKWRIGHT_REQUIRE(count >= 1, "{} frequencies", count);
  const auto f = [&](double z) { return determinant(beam, hub, z); };
  // Roots of a slender beam lie pi apart in z; shear and a heavy tip draw them together.
  const double step = 0.05;
  std::vector<double> out;
  double z = step, value = f(z);
  while (int(out.size()) < count) {
    const double next = z + step, next_value = f(next);
    if ((value < 0) != (next_value < 0)) {
      const double root = math::zero_between(f, z, next);
      out.push_back(root * root * beam.frequency_scale());
    }
    z = next;
    value = next_value;
  }
  return out;
}

std::vector<double> axial_frequencies(const Beam& beam, int count) {
  const auto found = problem(beam);
  LINKWRIGHT_REQUIRE(!found, "{}", *found);
  LINKWRIGHT_REQUIRE(count >= 1, "{} frequencies", count);
  const double tip = beam.tip_mass / beam.mass();
  const double unit = std::sqrt(beam.elastic_modulus / beam.density) / beam.length;
  std::vector<double> out;
  for (int k = 0; k < count; ++k) {
    // One zero in each of these quarters, without a tip mass at its end: a little more has no other.
    const double from = k * pi, to = from + pi / 2 + 0.1;
    out.push_back(
        unit * math::zero_between([&](double z) { return std::cos(z) - z * tip * std::sin(z); }, from, to));
  }
  return out;
}

double tip_deflection(const Beam& beam, double force) {
  const double l = beam.length;
  return force * (l * l * l / (3 * beam.bending_stiffness()) + l / beam.shear_stiffness());
}

}  // namespace linkwright::flexible
