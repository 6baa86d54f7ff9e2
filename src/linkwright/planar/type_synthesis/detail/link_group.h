// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "linkwright/core/numbers.h"
#include "linkwright/math/scalar.h"
#include "linkwright/math/sincos.h"
#include "linkwright/planar/type_synthesis/program.h"

// The group of four links of a Stephenson II linkage: link A turns about the ground pivot O by alpha, link B
// about the crank pin u by beta, and two bars join the pins T1, T2 of A to the pins S1, S2 of B. Both
// rotations are counted from crank angle zero. The equations |T_i - S_i|^2 = L_i^2 have no closed form: they
// are followed from crank angle zero over the turn once for a shape, and Newton's method ends each curve.
namespace linkwright::planar::link_group {

using std::sqrt;  // registers have their own

/// The parameters of a group: O, then T1 - O, T2 - O, S1 - u and S2 - u at crank angle zero, as (re, im).
inline constexpr int group_parameters = 10;

/// Index of the first parameter of the group of a program that has one.
LINKWRIGHT_KERNEL int first_parameter(const PointProgram& program) {
  return program.steps[static_cast<std::size_t>(program.group)].parameter - 2;
}

/// True if a point of a group is on the link that is hinged at the crank pin.
LINKWRIGHT_KERNEL bool is_on_crank(const PointProgram& program, const PointStep& step) {
  return step.first != program.steps[static_cast<std::size_t>(program.group)].first;
}

/// The group at one crank angle, or at as many as a register holds.
template <class T>
struct GroupState {
  T ax, ay, bx, by;             ///< e^(i alpha), e^(i beta)
  T da, db;                     ///< derivatives of alpha and beta by the crank angle
  std::array<T, 2> dx, dy;      ///< T_i - S_i
  std::array<T, 2> by_a, by_b;  ///< derivatives of |T_i - S_i|^2 / 2 by alpha and beta
  std::array<T, 2> residual;    ///< (|T_i - S_i|^2 - L_i^2) / 2
  T determinant;                ///< of by_a and by_b
  T quality;                    ///< squared sine of the angle between the two rows
};

/// Squared sines below this are held there, so that a group at its limit keeps a direction.
inline constexpr double flat_group = 1e-8;

/// Squared lengths of the two bars.
LINKWRIGHT_KERNEL std::array<double, 2> bar_squares(const double* v) {
  std::array<double, 2> out{};
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = v[0] + v[2 + 2 * i] - 1 - v[6 + 2 * i], y = v[1] + v[3 + 2 * i] - v[7 + 2 * i];
    out[i] = x * x + y * y;
  }
  return out;
}

/// The equations of the bars and their derivatives from the directions of A and B, with the crank along
/// (ux, uy).
template <class T>
LINKWRIGHT_KERNEL void evaluate(const double* v, const std::array<double, 2>& squares, const T& ux,
                                const T& uy, GroupState<T>& g) {
  const T ox = T(v[0]) - ux, oy = T(v[1]) - uy;
  for (std::size_t i = 0; i < 2; ++i) {
    const T tx(v[2 + 2 * i]), ty(v[3 + 2 * i]), sx(v[6 + 2 * i]), sy(v[7 + 2 * i]);
    const T px = g.ax * tx - g.ay * ty, py = g.ax * ty + g.ay * tx;
    const T rx = g.bx * sx - g.by * sy, ry = g.bx * sy + g.by * sx;
    g.dx[i] = ox + px - rx, g.dy[i] = oy + py - ry;
    g.by_a[i] = px * g.dy[i] - py * g.dx[i];
    g.by_b[i] = ry * g.dx[i] - rx * g.dy[i];
    g.residual[i] = T(0.5) * (g.dx[i] * g.dx[i] + g.dy[i] * g.dy[i] - T(squares[i]));
  }
  g.determinant = g.by_a[0] * g.by_b[1] - g.by_a[1] * g.by_b[0];
}

/// Determinant and quality; `side` is the sign that the determinant has. At its limit the determinant is held
/// away from zero.
template <class T>
LINKWRIGHT_KERNEL void measure(double side, GroupState<T>& g) {
  using S = math::Scalar<T>;
  const T norms =
      (g.by_a[0] * g.by_a[0] + g.by_b[0] * g.by_b[0]) * (g.by_a[1] * g.by_a[1] + g.by_b[1] * g.by_b[1]);
  const T held = S::max(norms, T(1e-24));
  g.quality = g.determinant * g.determinant / held;
  g.determinant = T(side) * S::max(T(side) * g.determinant, sqrt(T(flat_group) * held));
}

/// The solution of by_a a + by_b b = (c0, c1).
template <class T>
LINKWRIGHT_KERNEL void solve(const GroupState<T>& g, const T& c0, const T& c1, T& a, T& b) {
  const T by = T(1.0) / g.determinant;
  a = (c0 * g.by_b[1] - c1 * g.by_b[0]) * by;
  b = (c1 * g.by_a[0] - c0 * g.by_a[1]) * by;
}

/// Turns a direction by a small angle.
template <class T>
LINKWRIGHT_KERNEL void turn_by(const T& angle, T& x, T& y) {
  const T z = angle * angle;
  const T c = T(1.0) - z * (T(0.5) - z * (T(1.0 / 24) - z * T(1.0 / 720)));
  const T s = angle * (T(1.0) - z * (T(1.0 / 6) - z * T(1.0 / 120)));
  const T moved = x * c - y * s;
  y = x * s + y * c, x = moved;
}

/// One step of Newton's method, at most `most` (rad), times `share`.
template <class T>
LINKWRIGHT_KERNEL void newton_step(GroupState<T>& g, const T& share, double most, T& a, T& b) {
  using S = math::Scalar<T>;
  solve(g, g.residual[0], g.residual[1], a, b);
  a = -(share * S::max(S::min(a, T(most)), T(-most)));
  b = -(share * S::max(S::min(b, T(most)), T(-most)));
  turn_by(a, g.ax, g.ay), turn_by(b, g.bx, g.by);
}

/// Rates of A and B at unit speed of the crank.
template <class T>
LINKWRIGHT_KERNEL void rates(const T& ux, const T& uy, GroupState<T>& g) {
  solve(g, g.dy[0] * ux - g.dx[0] * uy, g.dy[1] * ux - g.dx[1] * uy, g.da, g.db);
}

/// The rotations over the turn of the crank, followed from crank angle zero in both senses.
struct GroupTurn {
  static constexpr std::size_t intervals = 64;
  struct Node {
    double a = 0, b = 0;    ///< rotations of A and B (rad)
    double da = 0, db = 0;  ///< their derivatives by the crank angle, times an interval
  };
  std::array<Node, intervals + 1> nodes;
  std::array<double, 2> squares{};  ///< of the lengths of the bars
  double side = 1;                  ///< sign of the determinant
  /// Intervals without a position: all from `first_broken` up to `end_broken`. Where both senses end at half
  /// a turn in different positions, these are the intervals next to it.
  std::size_t first_broken = intervals, end_broken = intervals;

  bool closes() const { return first_broken == end_broken; }
};

/// Follows the group of a shape over the turn.
GroupTurn follow_turn(const double* v);

/// The same of the group of a program, the last of each thread kept.
const GroupTurn& turn_of(const PointProgram& program, const double* x);

/// Rotations near those at a crank angle, |angle| <= 1e5, by cubic interpolation; false, and the last ones
/// before it, where there is no position.
LINKWRIGHT_KERNEL bool interpolate(const GroupTurn& turn, double angle, double& a, double& b) {
  static_assert((GroupTurn::intervals & (GroupTurn::intervals - 1)) == 0);
  const double at = angle * (GroupTurn::intervals / (2 * pi));
  const std::int64_t whole = static_cast<std::int64_t>(at) - (at < 0 ? 1 : 0);
  const std::size_t j = static_cast<std::size_t>(whole) & (GroupTurn::intervals - 1);
  if (j >= turn.first_broken && j < turn.end_broken) {
    a = turn.nodes[turn.first_broken].a, b = turn.nodes[turn.first_broken].b;
    return false;
  }
  const GroupTurn::Node &p = turn.nodes[j], &q = turn.nodes[j + 1];
  const double s = at - static_cast<double>(whole), r = 1 - s;
  const double p0 = (1 + 2 * s) * r * r, p1 = s * r * r, q0 = s * s * (3 - 2 * s), q1 = -(s * s * r);
  a = p0 * p.a + p1 * p.da + q0 * q.a + q1 * q.da;
  b = p0 * p.b + p1 * p.db + q0 * q.b + q1 * q.db;
  return true;
}

}  // namespace linkwright::planar::link_group
