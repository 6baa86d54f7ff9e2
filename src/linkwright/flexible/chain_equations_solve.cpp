// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/flexible/chain_equations.h"

namespace linkwright::flexible {

namespace {

// Second derivatives of force . displacement by the angle of the inner bar (0) and slide, turn, extension
// (1, 2, 3): the stiffness of a loaded joint.
struct Geometric {
  double angle_angle = 0;
  std::array<double, 3> angle_by{};
  std::array<std::array<double, 3>, 3> by_by{};
};

Geometric geometric(const JointStep& step, math::Vec2 mean, math::Vec2 force) {
  Geometric out;
  if (step.kinematics == Kinematics::source_linearised) return out;
  const math::Vec2 f = rotate_inverse(mean, force), d = step.along;
  const double around = f.y * step.by_turn;  // f . J (p_delta, 0)
  out.angle_angle = -dot(f, d);
  out.angle_by[turn] = around - 0.5 * dot(f, d);
  out.by_by[turn][turn] = f.x * step.by_turn_twice + around - 0.25 * dot(f, d);
  if (step.kinematics == Kinematics::chord_consistent) {
    out.angle_by[slide] = f.y * step.by_slide - f.x;
    out.angle_by[extension] = f.y;
    out.by_by[slide][slide] = f.x * step.by_slide_twice;
    out.by_by[slide][turn] = out.by_by[turn][slide] = 0.5 * out.angle_by[slide];
    out.by_by[turn][extension] = out.by_by[extension][turn] = 0.5 * f.y;
  }
  return out;
}

}  // namespace

// From the tip inwards: S is the stiffness that what lies outside node s shows to its displacement and angle.
template <int C>
bool ChainEquations::eliminate(const TangentScale& scale) {
  const Chain& chain = *chain_;
  const double centrifugal = hub_rate_ * hub_rate_;
  const double inertia = scale.acceleration + chain.mass_damping * scale.rate;
  const double weight_x = linearised_ ? -centrifugal : inertia - centrifugal;
  const double weight_y = linearised_ ? inertia : inertia - centrifugal;
  const double weight_xy = linearised_ ? 0 : 2 * hub_rate_ * scale.gyroscopic;
  const double damped = 1 + chain.stiffness_damping * scale.rate;

  double xx = 0, xy = 0, yy = 0, xa = 0, ya = 0, aa = 0;
  for (std::size_t s = joint_.size(); s-- > 0;) {
    const Joint& j = joint_[s];
    const Cell& cell = chain.cells[s];
    xx += weight_x * cell.mass;
    xy += weight_xy * cell.mass;
    yy += weight_y * cell.mass;
    aa += inertia * cell.inertia;

    const Geometric geo = geometric(j.step, j.mean, j.outer);
    const double a0 = j.by_angle.x, a1 = j.by_angle.y;
    double block[C][C], state[C][3];
    for (int c = 0; c < C; ++c) {
      const math::Vec2 b = j.by[c];
      const double angle = c == int(turn) ? 1 : 0;
      const double sx = xx * b.x + xy * b.y + xa * angle;
      const double sy = xy * b.x + yy * b.y + ya * angle;
      const double sa = xa * b.x + ya * b.y + aa * angle;
      for (int d = 0; d <= c; ++d)
        block[c][d] = sx * j.by[d].x + sy * j.by[d].y + (d == int(turn) ? sa : 0) + geo.by_by[c][d];
      state[c][0] = sx;
      state[c][1] = sy;
      state[c][2] = sx * a0 + sy * a1 + sa + geo.angle_by[c];
    }
    // A motion that a joint does not have is held by an infinite stiffness, whose inverse is 0.
    constexpr double held = infinity;
    block[0][0] += cell.hinge ? held : damped * cell.shear;
    block[1][1] += locked_[s] ? held : (cell.hinge ? 1 : damped) * cell.bending + scale.rate * cell.damping;
    if constexpr (C == 3) block[2][2] += cell.hinge ? held : damped * cell.axial;

    Eliminated& e = eliminated_[s];
    e.by_angle = j.by_angle;
    e.by = j.by;
    e.pivot[0] = block[0][0];
    e.lower[0] = block[1][0] / e.pivot[0];
    e.pivot[1] = block[1][1] - e.lower[0] * block[1][0];
    if constexpr (C == 3) {
      e.lower[1] = block[2][0] / e.pivot[0];
      const double rest = block[2][1] - e.lower[0] * block[2][0];
      e.lower[2] = rest / e.pivot[1];
      e.pivot[2] = block[2][2] - e.lower[1] * block[2][0] - e.lower[2] * rest;
    }
    for (int c = 0; c < C; ++c) {
      if (!(std::abs(e.pivot[c]) > 0)) return false;
      negative_ += e.pivot[c] < 0;
    }
    for (int i = 0; i < 3; ++i) {
      double g[3] = {state[0][i], state[1][i] - e.lower[0] * state[0][i], 0};
      if constexpr (C == 3) g[2] = state[2][i] - e.lower[1] * g[0] - e.lower[2] * g[1];
      for (int c = 0; c < C; ++c) g[c] /= e.pivot[c];
      if constexpr (C == 3) {
        g[1] -= e.lower[2] * g[2];
        g[0] -= e.lower[1] * g[2];
      }
      g[0] -= e.lower[0] * g[1];
      for (int c = 0; c < C; ++c) e.gain[c][i] = g[c];
    }

    const double inner_xa = xx * a0 + xy * a1 + xa, inner_ya = xy * a0 + yy * a1 + ya;
    aa += a0 * (inner_xa + xa) + a1 * (inner_ya + ya) + geo.angle_angle;
    xa = inner_xa;
    ya = inner_ya;
    for (int c = 0; c < C; ++c) {
      xx -= state[c][0] * e.gain[c][0];
      xy -= state[c][0] * e.gain[c][1];
      yy -= state[c][1] * e.gain[c][1];
      xa -= state[c][0] * e.gain[c][2];
      ya -= state[c][1] * e.gain[c][2];
      aa -= state[c][2] * e.gain[c][2];
    }
  }
  return true;
}

bool ChainEquations::factor(const TangentScale& scale, bool free_hub) {
  eliminated_.resize(joint_.size());
  negative_ = 0;
  free_hub_ = free_hub;
  const bool regular = chain_->extensible ? eliminate<3>(scale) : eliminate<2>(scale);
  return regular && (!free_hub || eliminate_hub(scale));
}

void ChainEquations::project_only(std::span<double> out) {
  math::Vec2 outer;
  double couple = 0;
  for (std::size_t s = joint_.size(); s-- > 0;) {
    const Joint& j = joint_[s];
    outer += j.force;
    couple += j.couple;
    for (std::size_t i = 0; i < coordinates_per_cell; ++i)
      out[coordinates_per_cell * s + i] = dot(outer, j.by[i]) + (i == turn ? couple : 0);
    if (!chain_->extensible) out[coordinates_per_cell * s + extension] = 0;
    couple += dot(outer, j.by_angle);
  }
}

// The hub turns the whole chain: one more row and column, of the inertia that the nodes show to it.
bool ChainEquations::eliminate_hub(const TangentScale& scale) {
  const Chain& chain = *chain_;
  const double radius = chain.hub_radius;
  double inertia = chain.hub_inertia + chain.root_inertia + chain.root_mass * radius * radius;
  double weight = chain.root_mass * radius * gravity_.x;  // stiffness of a pendulum, negative below the axis
  for (const bool row : {true, false}) {
    double x = radius;
    for (std::size_t s = 0; s < joint_.size(); ++s) {
      const Node& node = node_[s + 1];
      const Cell& cell = chain.cells[s];
      Joint& j = joint_[s];
      x += cell.length;
      if (linearised_) {
        const double speed = row ? 0 : -2 * hub_rate_ * scale.rate * node.z.x;
        j.force = cell.mass * math::Vec2{speed, scale.acceleration * x};
        if (row) inertia += cell.mass * (x * x + node.z.x * node.z.x) + cell.inertia;
      } else {
        j.force = cell.mass * (scale.acceleration * perpendicular(node.z) + perpendicular(gravity_));
        if (row) {
          inertia += cell.mass * dot(node.z, node.z) + cell.inertia;
          weight += cell.mass * dot(node.z, gravity_);
        } else {
          j.force += 2 * cell.mass * scale.rate * (perpendicular(node.drift) - hub_rate_ * node.z);
        }
      }
      j.couple = scale.acceleration * cell.inertia;
    }
    project_only(row ? border_row_ : border_column_);
  }
  substitute(border_column_, border_change_);
  corner_ = scale.acceleration * inertia + scale.rate * chain.hub_damping + chain.hub_stiffness + weight;
  for (std::size_t i = 0; i < border_row_.size(); ++i) corner_ += border_row_[i] * border_change_[i];
  negative_ += corner_ < 0;
  return std::abs(corner_) > 0;
}

template <int C>
void ChainEquations::substitute(std::span<const double> residual, std::span<double> change) {
  double x = 0, y = 0, angle = 0;
  for (std::size_t s = joint_.size(); s-- > 0;) {
    const Eliminated& e = eliminated_[s];
    double g[3] = {};
    for (int c = 0; c < C; ++c) {
      g[c] = residual[coordinates_per_cell * s + c] + e.by[c].x * x + e.by[c].y * y;
      if (c == int(turn)) g[c] += angle;
    }
    angle += e.by_angle.x * x + e.by_angle.y * y;
    for (int c = 0; c < C; ++c) {
      x -= e.gain[c][0] * g[c];
      y -= e.gain[c][1] * g[c];
      angle -= e.gain[c][2] * g[c];
    }
    g[1] -= e.lower[0] * g[0];
    if constexpr (C == 3) g[2] -= e.lower[1] * g[0] + e.lower[2] * g[1];
    for (int c = 0; c < C; ++c) g[c] /= e.pivot[c];
    if constexpr (C == 3) {
      g[1] -= e.lower[2] * g[2];
      g[0] -= e.lower[1] * g[2];
    }
    g[0] -= e.lower[0] * g[1];
    for (int c = 0; c < 3; ++c) change[coordinates_per_cell * s + c] = c < C ? g[c] : 0;
  }
  x = y = angle = 0;
  for (std::size_t s = 0; s < joint_.size(); ++s) {
    const Eliminated& e = eliminated_[s];
    double* u = &change[coordinates_per_cell * s];
    for (int c = 0; c < C; ++c) u[c] = -u[c] - e.gain[c][0] * x - e.gain[c][1] * y - e.gain[c][2] * angle;
    x += e.by_angle.x * angle;
    y += e.by_angle.y * angle;
    for (int c = 0; c < C; ++c) {
      x += e.by[c].x * u[c];
      y += e.by[c].y * u[c];
    }
    angle += u[turn];
  }
}

void ChainEquations::substitute(std::span<const double> residual, std::span<double> change) {
  if (chain_->extensible)
    substitute<3>(residual, change);
  else
    substitute<2>(residual, change);
}

double ChainEquations::solve(std::span<const double> residual, double hub_residual,
                             std::span<double> change) {
  LINKWRIGHT_REQUIRE(residual.size() == residual_.size() && change.size() == residual_.size() &&
                         eliminated_.size() == joint_.size(),
                     "{} residuals, {} changes, {} cells", residual.size(), change.size(), joint_.size());
  substitute(residual, change);
  if (!free_hub_) return 0;
  double row = hub_residual;
  for (std::size_t i = 0; i < change.size(); ++i) row += border_row_[i] * change[i];
  const double hub = -row / corner_;
  for (std::size_t i = 0; i < change.size(); ++i) change[i] += hub * border_change_[i];
  return hub;
}

}  // namespace linkwright::flexible
