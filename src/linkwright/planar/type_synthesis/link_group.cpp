// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/link_group.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace linkwright::planar::link_group {
namespace {

constexpr std::size_t half = GroupTurn::intervals / 2;
constexpr double interval = 2 * pi / GroupTurn::intervals;
constexpr double min_sine = 1e-3;   // of a group that is followed
constexpr double converged = 3e-5;  // a step of Newton's method after which a node is near enough
constexpr double same_position = 1e-6;

/// A group that is followed from one crank angle to the next.
class Follower {
 public:
  Follower(const double* v, const GroupTurn& turn) : v_(v), squares_(turn.squares), side_(turn.side) {}

  /// The position at crank angle `angle` near rotations that are expected there; false where none is within
  /// `reach` on the same branch. Rates are by the crank angle.
  bool solve_at(double angle, double a, double b, double reach, GroupTurn::Node& out) const {
    GroupState<double> g;
    double ux, uy;
    math::sincos(angle, uy, ux);
    math::sincos(a, g.ay, g.ax);
    math::sincos(b, g.by, g.bx);
    double moved_a = 0, moved_b = 0;
    for (int i = 0; i < 8; ++i) {
      evaluate(v_, squares_, ux, uy, g);
      double step_a, step_b;
      newton_step(g, 1.0, reach, step_a, step_b);
      moved_a += step_a, moved_b += step_b;
      if (!(std::max(std::abs(moved_a), std::abs(moved_b)) <= reach)) return false;
      if (std::max(std::abs(step_a), std::abs(step_b)) > converged) continue;
      rates(ux, uy, g);
      out = {a + moved_a, b + moved_b, g.da, g.db};
      const double rows =
          (g.by_a[0] * g.by_a[0] + g.by_b[0] * g.by_b[0]) * (g.by_a[1] * g.by_a[1] + g.by_b[1] * g.by_b[1]);
      return g.determinant * side_ > 0 && g.determinant * g.determinant > min_sine * min_sine * rows;
    }
    return false;
  }

  /// From one node to the next: at once, else in small steps.
  bool advance(double from, double by, const GroupTurn::Node* before, const GroupTurn::Node& at,
               GroupTurn::Node& out) const {
    double a = at.a + by * at.da, b = at.b + by * at.db;
    // The cubic through both values and rates.
    if (before) {
      a = 5 * before->a - 4 * at.a + by * (2 * before->da + 4 * at.da);
      b = 5 * before->b - 4 * at.b + by * (2 * before->db + 4 * at.db);
    }
    if (solve_at(from + by, a, b, 0.05, out)) return true;
    constexpr int pieces = 16;
    GroupTurn::Node now = at;
    for (int k = 0; k < pieces; ++k) {
      const double h = by / pieces;
      GroupTurn::Node next;
      if (!solve_at(from + (k + 1) * h, now.a + h * now.da, now.b + h * now.db, 0.05, next)) return false;
      now = next;
    }
    out = now;
    return true;
  }

 private:
  const double* v_;
  std::array<double, 2> squares_;
  double side_;
};

}  // namespace

GroupTurn follow_turn(const double* v) {
  GroupTurn out;
  out.squares = bar_squares(v);
  GroupState<double> g;
  g.ax = g.bx = 1, g.ay = g.by = 0;
  evaluate(v, out.squares, 1.0, 0.0, g);
  out.side = g.determinant < 0 ? -1 : 1;
  const Follower follower(v, out);
  auto& n = out.nodes;
  constexpr std::size_t last = GroupTurn::intervals;
  if (!follower.solve_at(0, 0, 0, 0.05, n[0])) {
    out.first_broken = 0;
    return out;
  }
  n[last] = n[0];
  std::size_t ahead = 0, behind = last;
  GroupTurn::Node end = n[0];  // at half a turn, from behind
  while (ahead < half && follower.advance(static_cast<double>(ahead) * interval, interval,
                                          ahead > 0 ? &n[ahead - 1] : nullptr, n[ahead], n[ahead + 1]))
    ++ahead;
  while (behind > half) {
    GroupTurn::Node next;
    if (!follower.advance(static_cast<double>(behind) * interval, -interval,
                          behind < last ? &n[behind + 1] : nullptr, n[behind], next))
      break;
    --behind;
    (behind == half ? end : n[behind]) = next;
  }
  for (GroupTurn::Node& node : n) node.da *= interval, node.db *= interval;
  out.first_broken = ahead, out.end_broken = behind;
  if (behind > half) return out;
  if (ahead < half) {
    end.da *= interval, end.db *= interval;
    n[half] = end;
    return out;
  }
  // Rotations from behind differ by whole turns.
  const double turns_a = std::round((n[half].a - end.a) / (2 * pi)) * 2 * pi,
               turns_b = std::round((n[half].b - end.b) / (2 * pi)) * 2 * pi;
  for (std::size_t i = half + 1; i <= last; ++i) n[i].a += turns_a, n[i].b += turns_b;
  const double apart = std::max(std::abs(n[half].a - end.a - turns_a), std::abs(n[half].b - end.b - turns_b));
  if (!(apart < same_position)) out.first_broken = half - 3, out.end_broken = half + 3;
  return out;
}

const GroupTurn& turn_of(const PointProgram& program, const double* x) {
  struct Kept {
    std::array<double, group_parameters> v{};
    bool filled = false;
    GroupTurn turn;
  };
  thread_local std::array<Kept, 2> kept;
  thread_local std::size_t newest = 0;
  const double* v = x + first_parameter(program);
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i].filled && std::equal(kept[i].v.begin(), kept[i].v.end(), v)) {
      newest = i;
      return kept[i].turn;
    }
  newest = 1 - newest;
  Kept& out = kept[newest];
  std::copy_n(v, group_parameters, out.v.begin());
  out.filled = true, out.turn = follow_turn(v);
  return out.turn;
}

}  // namespace linkwright::planar::link_group
