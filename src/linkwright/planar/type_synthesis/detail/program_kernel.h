// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "linkwright/core/numbers.h"
#include "linkwright/math/scalar.h"
#include "linkwright/math/sincos.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/link_group.h"

// The steps of a program at one crank angle, or at as many as a register holds: forward for the points and
// their derivatives by the crank angle, and in reverse for the derivatives of one number by all parameters.
namespace linkwright::planar::program_kernel {

using std::sqrt;  // registers have their own

/// What a step leaves for the reverse pass.
template <class T>
struct StepState {
  T x, y;         ///< the point
  T dx, dy;       ///< its derivative by the crank angle
  T quality;      ///< squared sine of the pair angle
  T determinant;  ///< of pair: of the two bars; of slide: rod along the line; of sleeve: +-sqrt(R^2 - e^2)
  T bx, by;       ///< derivative by the point of a number
};

template <class T>
struct ProgramState {
  std::array<StepState<T>, max_steps> steps;
  T ux, uy;  ///< crank
  T vx, vy;  ///< geared crank
  link_group::GroupState<T> group;
  const link_group::GroupTurn* turn = nullptr;  ///< of the group, if there is one
};

/// Squared sines below this are held there, so that a pair that does not assemble keeps a direction.
inline constexpr double flat_pair = 1e-8;

template <bool with_tangent, class T>
LINKWRIGHT_KERNEL void pair_forward(const StepState<T>& p, const StepState<T>& q, const T& l1, const T& l2,
                                    const T& side, StepState<T>& f) {
  using S = math::Scalar<T>;
  const T dx = q.x - p.x, dy = q.y - p.y;
  const T r2 = S::max(dx * dx + dy * dy, T(1e-24));
  const T a = l1 * l1, b = l2 * l2, twice = T(2.0) * (l1 * l2);
  const T cosine = (a + b - r2) / twice;
  f.quality = T(1.0) - cosine * cosine;
  const T sine = sqrt(S::max(f.quality, T(flat_pair)));
  const T inverse = T(1.0) / r2;
  const T along = T(0.5) * (r2 + a - b) * inverse, across = side * (T(0.5) * (twice * sine)) * inverse;
  f.x = p.x + along * dx - across * dy;
  f.y = p.y + along * dy + across * dx;
  // (F - P) x (F - Q) = +-l1 l2 sin(mu), from the formula, so that it never vanishes.
  f.determinant = side * (T(0.5) * (twice * sine));
  if constexpr (with_tangent) {
    const T ax = f.x - p.x, ay = f.y - p.y, cx = f.x - q.x, cy = f.y - q.y;
    const T first = ax * p.dx + ay * p.dy, second = cx * q.dx + cy * q.dy, by = T(1.0) / f.determinant;
    f.dx = (first * cy - second * ay) * by;
    f.dy = (ax * second - cx * first) * by;
  }
}

template <bool with_tangent, class T>
LINKWRIGHT_KERNEL void slide_forward(const StepState<T>& p, const T& rod, const T& height, StepState<T>& f) {
  using S = math::Scalar<T>;
  const T rise = height - p.y, sine = rise / rod;
  f.quality = T(1.0) - sine * sine;
  f.determinant = rod * sqrt(S::max(f.quality, T(flat_pair)));
  f.x = p.x + f.determinant;
  f.y = height;
  if constexpr (with_tangent) {
    f.dx = p.dx + rise * p.dy / f.determinant;
    f.dy = T(0.0);
  }
}

template <bool with_tangent, class T>
LINKWRIGHT_KERNEL void sleeve_forward(const StepState<T>& p, const T& pivot, const T& offset, const T& side,
                                      StepState<T>& f) {
  using S = math::Scalar<T>;
  const T dx = pivot - p.x, dy = -p.y;
  const T r2 = S::max(dx * dx + dy * dy, T(1e-24)), inverse = T(1.0) / r2;
  f.quality = T(1.0) - (offset * offset + T(sleeve_clearance * sleeve_clearance)) * inverse;
  const T along = side * sqrt(S::max(r2 - offset * offset, T(flat_pair) * r2));
  const T zx = along * inverse, zy = offset * inverse;
  f.determinant = along;
  f.x = p.x + dx * zx - dy * zy;
  f.y = p.y + dx * zy + dy * zx;
  if constexpr (with_tangent) {
    const T ex = -p.dx, ey = -p.dy;
    const T rate = T(2.0) * (dx * ex + dy * ey);
    const T wx = T(0.5) * rate / along * inverse - zx * rate * inverse, wy = -(zy * rate * inverse);
    f.dx = p.dx + ex * zx - ey * zy + dx * wx - dy * wy;
    f.dy = p.dy + ex * zy + ey * zx + dx * wy + dy * wx;
  }
}

LINKWRIGHT_KERNEL bool any_above(double value, double limit) { return value > limit; }
template <class T>
LINKWRIGHT_KERNEL bool any_above(const T& value, double limit) {
  return any(value > T(limit));  // of the registers' own namespace
}

/// Rotations of the links of a group near crank angles, and 1 where there is a position, else 0.
LINKWRIGHT_KERNEL void group_start(const link_group::GroupTurn& turn, double angle, double& a, double& b,
                                   double& assembled) {
  assembled = link_group::interpolate(turn, angle, a, b) ? 1 : 0;
}
template <class T>
LINKWRIGHT_KERNEL void group_start(const link_group::GroupTurn& turn, const T& angle, T& a, T& b,
                                   T& assembled) {
  alignas(64) std::array<double, T::size> at, from_a, from_b, found;
  angle.store_aligned(at.data());
  for (std::size_t k = 0; k < T::size; ++k) group_start(turn, at[k], from_a[k], from_b[k], found[k]);
  a = T::load_aligned(from_a.data()), b = T::load_aligned(from_b.data());
  assembled = T::load_aligned(found.data());
}

/// The rotations of the links of a group of four, and its quality, which is negative where it has no
/// position.
template <bool with_tangent, class T>
LINKWRIGHT_KERNEL void group_forward(const PointProgram& program, const double* x, const T& angle,
                                     ProgramState<T>& s, T& quality) {
  using S = math::Scalar<T>;
  const link_group::GroupTurn& turn = *s.turn;
  const double* v = x + link_group::first_parameter(program);
  auto& g = s.group;
  T a, b, assembled;
  group_start(turn, angle, a, b, assembled);
  math::sincos(a, g.ay, g.ax);
  math::sincos(b, g.by, g.bx);
  // Two steps mostly end at rounding; where the links turn fast, more are needed.
  for (int i = 0; i < 8; ++i) {
    link_group::evaluate(v, turn.squares, s.ux, s.uy, g);
    link_group::newton_step(g, assembled, 0.05, a, b);
    if (i > 0 && !any_above(S::max(S::max(a, -a), S::max(b, -b)), 1e-8)) break;
  }
  link_group::evaluate(v, turn.squares, s.ux, s.uy, g);
  link_group::measure(turn.side, g);
  quality = S::choose(assembled == T(1.0), g.quality, T(-1.0));
  if constexpr (with_tangent) link_group::rates(s.ux, s.uy, g);
}

/// A point of a link of the group: at `c` from its hinge `p` at crank angle zero.
template <bool with_tangent, class T>
LINKWRIGHT_KERNEL void group_point_forward(const PointProgram& program, const PointStep& step,
                                           const double* c, ProgramState<T>& s, StepState<T>& f) {
  const bool on_crank = link_group::is_on_crank(program, step);
  const auto& g = s.group;
  const StepState<T>& p = s.steps[static_cast<std::size_t>(step.first)];
  const T &rx = on_crank ? g.bx : g.ax, &ry = on_crank ? g.by : g.ay;
  const T dx = rx * T(c[0]) - ry * T(c[1]), dy = rx * T(c[1]) + ry * T(c[0]);
  f.x = p.x + dx, f.y = p.y + dy;
  if constexpr (with_tangent) {
    const T& rate = on_crank ? g.db : g.da;
    f.dx = p.dx - rate * dy, f.dy = p.dy + rate * dx;
  }
}

/// All points of a program with the crank along (ux, uy). The angle itself is needed by geared cranks.
template <bool with_tangent, class T>
LINKWRIGHT_KERNEL void forward(const PointProgram& program, const double* x, unsigned signs, const T& angle,
                               ProgramState<T>& s) {
  math::sincos(angle, s.uy, s.ux);
  if (program.gear_ratio != 0) math::sincos(angle * T(program.gear_ratio), s.vy, s.vx);
  const std::size_t count = program.steps.size();
  for (std::size_t i = 0; i < count; ++i) {
    const PointStep& step = program.steps[i];
    StepState<T>& f = s.steps[i];
    const double* v = x + step.parameter;
    const T side(step.sign >= 0 && (signs >> static_cast<unsigned>(step.sign) & 1u) != 0 ? -1.0 : 1.0);
    f.quality = T(1.0);
    switch (step.operation) {
      case PointOperation::crank_pin:
        f.x = s.ux, f.y = s.uy;
        if constexpr (with_tangent) f.dx = -s.uy, f.dy = s.ux;
        break;
      case PointOperation::ground_on_axis:
        f.x = T(v[0]), f.y = T(0.0);
        if constexpr (with_tangent) f.dx = T(0.0), f.dy = T(0.0);
        break;
      case PointOperation::ground:
        f.x = T(v[0]), f.y = T(v[1]);
        if constexpr (with_tangent) f.dx = T(0.0), f.dy = T(0.0);
        break;
      case PointOperation::crank_plate:
        f.x = T(v[0]) * s.ux - T(v[1]) * s.uy;
        f.y = T(v[0]) * s.uy + T(v[1]) * s.ux;
        if constexpr (with_tangent) f.dx = -f.y, f.dy = f.x;
        break;
      case PointOperation::plate: {
        const StepState<T>&p = s.steps[static_cast<std::size_t>(step.first)],
              &q = s.steps[static_cast<std::size_t>(step.second)];
        const T cx(v[0]), cy(v[1]), dx = q.x - p.x, dy = q.y - p.y;
        f.x = p.x + cx * dx - cy * dy;
        f.y = p.y + cx * dy + cy * dx;
        if constexpr (with_tangent) {
          const T ex = q.dx - p.dx, ey = q.dy - p.dy;
          f.dx = p.dx + cx * ex - cy * ey;
          f.dy = p.dy + cx * ey + cy * ex;
        }
        break;
      }
      case PointOperation::pair:
        pair_forward<with_tangent>(s.steps[static_cast<std::size_t>(step.first)],
                                   s.steps[static_cast<std::size_t>(step.second)], T(v[0]), T(v[1]), side, f);
        break;
      case PointOperation::slide:
        slide_forward<with_tangent>(s.steps[static_cast<std::size_t>(step.first)], T(v[0]), T(v[1]), f);
        break;
      case PointOperation::sleeve:
        sleeve_forward<with_tangent>(s.steps[static_cast<std::size_t>(step.first)], T(v[0]), T(v[1]), side,
                                     f);
        break;
      case PointOperation::geared_crank:
        f.x = T(v[0]) + T(v[2]) * s.vx - T(v[3]) * s.vy;
        f.y = T(v[1]) + T(v[2]) * s.vy + T(v[3]) * s.vx;
        if constexpr (with_tangent) {
          f.dx = T(program.gear_ratio) * (T(v[1]) - f.y);
          f.dy = T(program.gear_ratio) * (f.x - T(v[0]));
        }
        break;
      case PointOperation::group_point:
        if (static_cast<int>(i) == program.group)
          group_forward<with_tangent>(program, x, angle, s, f.quality);
        group_point_forward<with_tangent>(program, step, v, s, f);
        break;
    }
  }
}

/// Least quality over the steps, and where.
template <class T>
LINKWRIGHT_KERNEL void worst_pair(const PointProgram& program, const ProgramState<T>& s, T& least, T& where) {
  using S = math::Scalar<T>;
  least = T(1.0), where = T(0.0);
  for (std::size_t i = 0; i < program.steps.size(); ++i) {
    const auto smaller = s.steps[i].quality < least;
    where = S::choose(smaller, T(static_cast<double>(i)), where);
    least = S::choose(smaller, s.steps[i].quality, least);
  }
}

template <class T>
LINKWRIGHT_KERNEL void clear_reverse(const PointProgram& program, ProgramState<T>& s) {
  for (std::size_t i = 0; i < program.steps.size(); ++i) s.steps[i].bx = T(0.0), s.steps[i].by = T(0.0);
}

/// Adds the derivative by the rotation of a link of the group, and those by the hinge and the parameters of a
/// point of it.
template <class T, class Add>
LINKWRIGHT_KERNEL void reverse_group_point(const PointProgram& program, const PointStep& step,
                                           ProgramState<T>& s, const StepState<T>& f, const T& more_x,
                                           const T& more_y, const Add& add) {
  const bool on_crank = link_group::is_on_crank(program, step);
  auto& g = s.group;
  StepState<T>& p = s.steps[static_cast<std::size_t>(step.first)];
  const T &rx = on_crank ? g.bx : g.ax, &ry = on_crank ? g.by : g.ay;
  add(step.parameter, f.bx * rx + f.by * ry + more_x);
  add(step.parameter + 1, f.by * rx - f.bx * ry + more_y);
  p.bx = p.bx + f.bx, p.by = p.by + f.by;
}

/// Derivative of a number by the rotation of the link that a point of the group is on.
template <class T>
LINKWRIGHT_KERNEL void add_rotation(const PointProgram& program, const PointStep& step, ProgramState<T>& s,
                                    const StepState<T>& f, T& by_a, T& by_b) {
  const StepState<T>& p = s.steps[static_cast<std::size_t>(step.first)];
  const T turned = f.by * (f.x - p.x) - f.bx * (f.y - p.y);
  if (link_group::is_on_crank(program, step))
    by_b = by_b + turned;
  else
    by_a = by_a + turned;
}

/// The four pins of a group, when the derivatives by the points of its links are there. The rotations depend
/// on the parameters through the equations of the bars, |T_i - S_i|^2 = L_i^2, where the lengths are those at
/// crank angle zero.
template <class T, class Add>
LINKWRIGHT_KERNEL void reverse_group(const PointProgram& program, const double* x, ProgramState<T>& s, T by_a,
                                     T by_b, const Add& add) {
  const auto first = static_cast<std::size_t>(program.group);
  auto& g = s.group;
  for (std::size_t i = first; i < first + 4; ++i)
    add_rotation(program, program.steps[i], s, s.steps[i], by_a, by_b);
  const T by = T(1.0) / g.determinant;
  const std::array<T, 2> factor{(by_a * g.by_b[1] - by_b * g.by_a[1]) * by,
                                (by_b * g.by_a[0] - by_a * g.by_b[0]) * by};
  const double* v = x + link_group::first_parameter(program);
  StepState<T>& pivot = s.steps[static_cast<std::size_t>(program.steps[first].first)];
  for (std::size_t i = 0; i < 2; ++i) {
    const T cx(v[0] + v[2 + 2 * i] - 1 - v[6 + 2 * i]), cy(v[1] + v[3 + 2 * i] - v[7 + 2 * i]);
    const T lx = factor[i] * cx, ly = factor[i] * cy, mx = factor[i] * g.dx[i], my = factor[i] * g.dy[i];
    StepState<T>&t = s.steps[first + i], &r = s.steps[first + 2 + i];
    t.bx = t.bx - mx, t.by = t.by - my;
    r.bx = r.bx + mx, r.by = r.by + my;
    reverse_group_point(program, program.steps[first + i], s, t, lx, ly, add);
    reverse_group_point(program, program.steps[first + 2 + i], s, r, -lx, -ly, add);
    pivot.bx = pivot.bx + lx, pivot.by = pivot.by + ly;
  }
}

/// From the derivatives by the points (bx, by) to those by the parameters; `add(parameter, value)` receives
/// each, some more than once. From step `last` down.
template <class T, class Add>
LINKWRIGHT_KERNEL void reverse(const PointProgram& program, const double* x, ProgramState<T>& s,
                               std::size_t last, const Add& add) {
  T by_a(0.0), by_b(0.0);  // of the rotations of the links of a group
  for (std::size_t i = last + 1; i-- > 0;) {
    const PointStep& step = program.steps[i];
    const StepState<T>& f = s.steps[i];
    const double* v = x + step.parameter;
    const int k = step.parameter;
    switch (step.operation) {
      case PointOperation::crank_pin:
        break;
      case PointOperation::ground_on_axis:
        add(k, f.bx);
        break;
      case PointOperation::ground:
        add(k, f.bx), add(k + 1, f.by);
        break;
      case PointOperation::crank_plate:
        add(k, f.bx * s.ux + f.by * s.uy);
        add(k + 1, f.by * s.ux - f.bx * s.uy);
        break;
      case PointOperation::plate: {
        StepState<T>&p = s.steps[static_cast<std::size_t>(step.first)],
        &q = s.steps[static_cast<std::size_t>(step.second)];
        const T dx = q.x - p.x, dy = q.y - p.y, cx(v[0]), cy(v[1]);
        add(k, f.bx * dx + f.by * dy);
        add(k + 1, f.by * dx - f.bx * dy);
        const T gx = cx * f.bx + cy * f.by, gy = cx * f.by - cy * f.bx;
        q.bx = q.bx + gx, q.by = q.by + gy;
        p.bx = p.bx + f.bx - gx, p.by = p.by + f.by - gy;
        break;
      }
      case PointOperation::pair: {
        StepState<T>&p = s.steps[static_cast<std::size_t>(step.first)],
        &q = s.steps[static_cast<std::size_t>(step.second)];
        const T ax = f.x - p.x, ay = f.y - p.y, cx = f.x - q.x, cy = f.y - q.y, by = T(1.0) / f.determinant;
        const T first = (f.bx * cy - f.by * cx) * by, second = (ax * f.by - ay * f.bx) * by;
        add(k, first * T(v[0])), add(k + 1, second * T(v[1]));
        p.bx = p.bx + first * ax, p.by = p.by + first * ay;
        q.bx = q.bx + second * cx, q.by = q.by + second * cy;
        break;
      }
      case PointOperation::slide: {
        StepState<T>& p = s.steps[static_cast<std::size_t>(step.first)];
        const T by = f.bx / f.determinant, rise = T(v[1]) - p.y;
        add(k, by * T(v[0])), add(k + 1, f.by - by * rise);
        p.bx = p.bx + f.bx, p.by = p.by + by * rise;
        break;
      }
      case PointOperation::sleeve: {
        StepState<T>& p = s.steps[static_cast<std::size_t>(step.first)];
        const T dx = T(v[0]) - p.x, dy = -p.y, inverse = T(1.0) / (dx * dx + dy * dy);
        const T zx = f.determinant * inverse, zy = T(v[1]) * inverse;
        const T hx = dx * f.bx + dy * f.by, hy = dx * f.by - dy * f.bx;  // derivative by z
        const T by_along = hx * inverse / f.determinant;
        const T by_r2 = T(0.5) * by_along - (hx * zx + hy * zy) * inverse;
        const T gx = zx * f.bx + zy * f.by + T(2.0) * dx * by_r2,
                gy = zx * f.by - zy * f.bx + T(2.0) * dy * by_r2;
        add(k, gx), add(k + 1, hy * inverse - by_along * T(v[1]));
        p.bx = p.bx + f.bx - gx, p.by = p.by + f.by - gy;
        break;
      }
      case PointOperation::geared_crank:
        add(k, f.bx), add(k + 1, f.by);
        add(k + 2, f.bx * s.vx + f.by * s.vy);
        add(k + 3, f.by * s.vx - f.bx * s.vy);
        break;
      case PointOperation::group_point:
        if (static_cast<int>(i) > program.group + 3) {
          add_rotation(program, step, s, f, by_a, by_b);
          reverse_group_point(program, step, s, f, T(0.0), T(0.0), add);
        } else if (static_cast<int>(i) == program.group) {
          reverse_group(program, x, s, by_a, by_b, add);
        }
        break;
    }
  }
}

/// The same of a group: its quality is d^2 / (m_1^2 m_2^2) with the rows (a_i, b_i) of the equations of the
/// bars, m_i their lengths and d their determinant.
template <class T>
LINKWRIGHT_KERNEL void reverse_group_quality(const PointProgram& program, ProgramState<T>& s) {
  const auto first = static_cast<std::size_t>(program.group);
  const auto& g = s.group;
  StepState<T>&pivot = s.steps[static_cast<std::size_t>(program.steps[first].first)],
  &crank = s.steps[static_cast<std::size_t>(program.steps[first + 2].first)];
  const T determinant = g.by_a[0] * g.by_b[1] - g.by_a[1] * g.by_b[0];
  const std::array<T, 2> square{g.by_a[0] * g.by_a[0] + g.by_b[0] * g.by_b[0],
                                g.by_a[1] * g.by_a[1] + g.by_b[1] * g.by_b[1]};
  const T by = T(2.0) * determinant / (square[0] * square[1]);
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t j = 1 - i;
    const T sign(i == 0 ? 1.0 : -1.0), share = T(2.0) * g.quality / square[i];
    const T by_a = sign * by * g.by_b[j] - share * g.by_a[i],
            by_b = -(sign * by * g.by_a[j]) - share * g.by_b[i];
    StepState<T>&t = s.steps[first + i], &r = s.steps[first + 2 + i];
    const T px = t.x - pivot.x, py = t.y - pivot.y, qx = r.x - crank.x, qy = r.y - crank.y;
    const T ex = by_b * qy - by_a * py, ey = by_a * px - by_b * qx;  // by T - S
    const T ax = by_a * g.dy[i], ay = -(by_a * g.dx[i]), cx = -(by_b * g.dy[i]), cy = by_b * g.dx[i];
    t.bx = t.bx + ex + ax, t.by = t.by + ey + ay;
    pivot.bx = pivot.bx - ax, pivot.by = pivot.by - ay;
    r.bx = r.bx - ex + cx, r.by = r.by - ey + cy;
    crank.bx = crank.bx - cx, crank.by = crank.by - cy;
  }
}

/// Adds the derivative of the quality of step `i` to the points and parameters it depends on.
template <class T, class Add>
LINKWRIGHT_KERNEL void reverse_quality(const PointProgram& program, const double* x, ProgramState<T>& s,
                                       std::size_t i, const Add& add) {
  const PointStep& step = program.steps[i];
  const double* v = x + step.parameter;
  const int k = step.parameter;
  if (step.operation == PointOperation::pair) {
    StepState<T>&p = s.steps[static_cast<std::size_t>(step.first)],
    &q = s.steps[static_cast<std::size_t>(step.second)];
    const T dx = q.x - p.x, dy = q.y - p.y, l1(v[0]), l2(v[1]);
    const T twice = T(2.0) * l1 * l2, cosine = (l1 * l1 + l2 * l2 - dx * dx - dy * dy) / twice;
    const T by_cosine = T(-2.0) * cosine, by_d = T(-2.0) / twice * by_cosine;
    add(k, by_cosine * (T(1.0) / l2 - cosine / l1)), add(k + 1, by_cosine * (T(1.0) / l1 - cosine / l2));
    q.bx = q.bx + by_d * dx, q.by = q.by + by_d * dy;
    p.bx = p.bx - by_d * dx, p.by = p.by - by_d * dy;
  } else if (step.operation == PointOperation::slide) {
    StepState<T>& p = s.steps[static_cast<std::size_t>(step.first)];
    const T sine = (T(v[1]) - p.y) / T(v[0]), by_sine = T(-2.0) * sine / T(v[0]);
    add(k, -(by_sine * sine)), add(k + 1, by_sine);
    p.by = p.by - by_sine;
  } else if (step.operation == PointOperation::sleeve) {
    StepState<T>& p = s.steps[static_cast<std::size_t>(step.first)];
    const T dx = T(v[0]) - p.x, dy = -p.y, inverse = T(1.0) / (dx * dx + dy * dy), offset(v[1]);
    const T by_r2 = (offset * offset + T(sleeve_clearance * sleeve_clearance)) * inverse * inverse;
    add(k, T(2.0) * dx * by_r2), add(k + 1, T(-2.0) * offset * inverse);
    p.bx = p.bx - T(2.0) * dx * by_r2, p.by = p.by - T(2.0) * dy * by_r2;
  } else if (step.operation == PointOperation::group_point) {
    reverse_group_quality(program, s);
  }
}

}  // namespace linkwright::planar::program_kernel
