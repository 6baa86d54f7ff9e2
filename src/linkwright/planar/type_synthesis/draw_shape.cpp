// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/draw_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/detail/link_group.h"
#include "linkwright/planar/type_synthesis/detail/program_kernel.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t angles = 32;
using Points = std::array<std::complex<double>, angles>;
constexpr double min_quality = 0.0194;  // sin^2 of 8 degrees

std::complex<double> normal_pair(RandomStream& random, double scale) {
  const double re = random.normal();
  return scale * std::complex<double>(re, random.normal());
}

/// Distance of a ground pivot from that of the crank: outside the circle of the crank, where it rocks, or
/// within.
double draw_pivot(RandomStream& random, double nearest_outside, double farthest_inside) {
  if (random.uniform() < 0.8) return nearest_outside + 2 * std::exp(random.normal());
  return random.uniform(0.05, farthest_inside);
}

/// The same on both sides of the circle alike, for cranks that need not turn.
double draw_any_pivot(RandomStream& random) { return 1.3 * std::exp(0.8 * random.normal()); }

/// Draws the steps of one shape, one after the other, with their points at 32 crank angles.
class ShapeDrawer {
 public:
  ShapeDrawer(MachineShape& shape, RandomStream& random, std::optional<CrankPart> part)
      : shape_(shape), p_(*shape.program), random_(random), part_(part) {}

  bool draw(std::size_t first) {
    for (std::size_t i = 0; i < p_.steps.size(); ++i)
      if (!draw_step(i, i >= first)) return false;
    return true;
  }

 private:
  const Points& at(int i) const { return points_[static_cast<std::size_t>(i)]; }
  double* values(const PointStep& step) { return shape_.x.data() + step.parameter; }
  bool rocks() const { return part_ && part_->rocks; }

  /// Two parameters as one complex number, drawn with this spread.
  std::complex<double> complex_parameter(double* v, bool drawn, double spread) {
    if (drawn) {
      const std::complex<double> value = normal_pair(random_, spread);
      v[0] = value.real(), v[1] = value.imag();
    }
    return {v[0], v[1]};
  }
  double spread(bool drawn, double scale, double power) {
    return drawn ? scale * std::exp(power * random_.normal()) : 1;
  }

  double side_of(const PointStep& step, bool drawn) {
    if (step.sign < 0) return 1;
    const unsigned bit = 1u << static_cast<unsigned>(step.sign);
    if (drawn) shape_.signs = random_.uniform() < 0.5 ? shape_.signs | bit : shape_.signs & ~bit;
    return (shape_.signs & bit) != 0 ? -1 : 1;
  }

  bool draw_step(std::size_t i, bool drawn) {
    const PointStep& step = p_.steps[i];
    double* v = values(step);
    Points& f = points_[i];
    const double side = side_of(step, drawn);
    switch (step.operation) {
      case PointOperation::crank_pin:
        for (std::size_t k = 0; k < angles; ++k) f[k] = turned(k, 1);
        return true;
      case PointOperation::ground_on_axis:
        if (drawn) v[0] = rocks() ? draw_any_pivot(random_) : draw_pivot(random_, 1, 1);
        f.fill(v[0]);
        return true;
      case PointOperation::ground:
        f.fill(complex_parameter(v, drawn, spread(drawn, 2, 0.7)));
        return true;
      case PointOperation::crank_plate: {
        const std::complex<double> c = complex_parameter(v, drawn, spread(drawn, 1, 0.7));
        for (std::size_t k = 0; k < angles; ++k) f[k] = c * points_[0][k];
        return true;
      }
      case PointOperation::plate: {
        const Points &from = at(step.first), &to = at(step.second);
        const std::complex<double> c =
            complex_parameter(v, drawn, spread(drawn, 2 / std::max(std::abs(to[0] - from[0]), 1e-3), 0.7));
        for (std::size_t k = 0; k < angles; ++k) f[k] = from[k] + c * (to[k] - from[k]);
        return true;
      }
      case PointOperation::pair:
        return draw_pair(step, drawn, side, f);
      case PointOperation::slide:
        return draw_slide(step, drawn, f);
      case PointOperation::sleeve:
        return draw_sleeve(step, drawn, side, f);
      case PointOperation::geared_crank: {
        const std::complex<double> pivot = complex_parameter(v, drawn, spread(drawn, 2, 0.7));
        const std::complex<double> crank = complex_parameter(v + 2, drawn, spread(drawn, 1, 0.5));
        for (std::size_t k = 0; k < angles; ++k) f[k] = pivot + crank * turned(k, p_.gear_ratio);
        return true;
      }
      case PointOperation::group_point: {
        if (static_cast<int>(i) == p_.group && !draw_group(drawn)) return false;
        const bool pin = static_cast<int>(i) < p_.group + 4;
        const std::complex<double> c = complex_parameter(v, drawn && !pin, spread(drawn && !pin, 2, 0.7));
        const Points &from = at(step.first),
                     &turn = link_group::is_on_crank(p_, step) ? of_crank_ : of_ground_;
        for (std::size_t k = 0; k < angles; ++k) f[k] = from[k] + turn[k] * c;
        return true;
      }
    }
    return true;
  }

  double crank_angle(std::size_t k) const {
    if (part_) return part_->from + part_->range * static_cast<double>(k) / (angles - 1);
    return 2 * pi * static_cast<double>(k) / angles;
  }
  std::complex<double> turned(std::size_t k, double ratio) const {
    if (part_) return std::polar(1.0, ratio * crank_angle(k));
    return std::polar(1.0, ratio * 2 * pi * static_cast<double>(k) / angles);
  }

  bool draw_pair(const PointStep& step, bool drawn, double side, Points& f) {
    const Points &from = at(step.first), &to = at(step.second);
    double* v = values(step);
    if (drawn) {
      double low = infinity, high = 0;
      for (std::size_t k = 0; k < angles; ++k) {
        const double r = std::abs(to[k] - from[k]);
        low = std::min(low, r), high = std::max(high, r);
      }
      const double sum = high * (1.02 + 0.35 * std::exp(random_.normal())),
                   difference = 0.98 * low * random_.uniform(-1, 1);
      v[0] = 0.5 * (sum + difference), v[1] = 0.5 * (sum - difference);
    }
    for (std::size_t k = 0; k < angles; ++k) {
      const std::complex<double> d = to[k] - from[k];
      const double r2 = std::norm(d), cosine = (v[0] * v[0] + v[1] * v[1] - r2) / (2 * v[0] * v[1]);
      const double quality = 1 - cosine * cosine;
      if (!(quality >= min_quality)) return false;
      f[k] = from[k] + d *
                           std::complex<double>(0.5 * (r2 + v[0] * v[0] - v[1] * v[1]),
                                                side * v[0] * v[1] * std::sqrt(quality)) /
                           r2;
    }
    return true;
  }

  bool draw_slide(const PointStep& step, bool drawn, Points& f) {
    const Points& from = at(step.first);
    double* v = values(step);
    if (drawn) {
      v[1] = 1.5 * random_.normal();
      double highest = 1 + std::abs(v[1]);
      if (rocks()) {
        highest = 0;
        for (const auto& p : from) highest = std::max(highest, std::abs(v[1] - p.imag()));
      }
      v[0] = highest * (1.02 + 0.5 * std::exp(random_.normal()));
    }
    for (std::size_t k = 0; k < angles; ++k) {
      const double sine = (v[1] - from[k].imag()) / v[0], quality = 1 - sine * sine;
      if (!(quality >= min_quality)) return false;
      f[k] = {from[k].real() + v[0] * std::sqrt(quality), v[1]};
    }
    return true;
  }

  bool draw_sleeve(const PointStep& step, bool drawn, double side, Points& f) {
    const Points& from = at(step.first);
    double* v = values(step);
    if (drawn) {
      v[0] = rocks() ? draw_any_pivot(random_) : draw_pivot(random_, 1.32, 0.65);
      v[1] = std::abs(v[0] - 1) * 0.5 * random_.normal();
    }
    for (std::size_t k = 0; k < angles; ++k) {
      const std::complex<double> d = v[0] - from[k];
      const double r2 = std::norm(d);
      if (!(1 - (v[1] * v[1] + sleeve_clearance * sleeve_clearance) / r2 >= min_quality)) return false;
      f[k] = from[k] + d * std::complex<double>(side * std::sqrt(r2 - v[1] * v[1]), v[1]) / r2;
    }
    return true;
  }

  /// The pins of a group of four links at crank angle zero, and the directions of its two links over the
  /// turn.
  bool draw_group(bool drawn) {
    for (int k = 0; k < 4; ++k)
      complex_parameter(values(p_.steps[static_cast<std::size_t>(p_.group + k)]), drawn,
                        spread(drawn, 2, 0.7));
    const double* v = shape_.x.data() + link_group::first_parameter(p_);
    const link_group::GroupTurn turn = link_group::follow_turn(v);
    if (part_) return draw_part_of_group(turn);
    if (!turn.closes()) return false;
    static_assert(link_group::GroupTurn::intervals % angles == 0);
    for (std::size_t k = 0; k < angles; ++k) {
      const auto& node = turn.nodes[k * (link_group::GroupTurn::intervals / angles)];
      link_group::GroupState<double> g;
      of_ground_[k] = std::polar(1.0, node.a), of_crank_[k] = std::polar(1.0, node.b);
      g.ax = of_ground_[k].real(), g.ay = of_ground_[k].imag();
      g.bx = of_crank_[k].real(), g.by = of_crank_[k].imag();
      const std::complex<double> u = turned(k, 1);
      link_group::evaluate(v, turn.squares, u.real(), u.imag(), g);
      link_group::measure(turn.side, g);
      if (!(g.quality >= min_quality)) return false;
    }
    return true;
  }

  /// The same over a part of the turn. Crank angle zero, at which a group assembles by its parameters, has to
  /// be reached from there without a gap, and is where the part lies.
  bool draw_part_of_group(const link_group::GroupTurn& turn) {
    program_kernel::ProgramState<double> s;
    s.turn = &turn;
    for (std::size_t k = 0; k < angles; ++k) {
      const std::complex<double> u = turned(k, 1);
      s.ux = u.real(), s.uy = u.imag();
      double quality;
      program_kernel::group_forward<false>(p_, shape_.x.data(), crank_angle(k), s, quality);
      if (!(quality >= min_quality)) return false;
      of_ground_[k] = {s.group.ax, s.group.ay}, of_crank_[k] = {s.group.bx, s.group.by};
    }
    return true;
  }

  MachineShape& shape_;
  const PointProgram& p_;
  RandomStream& random_;
  std::optional<CrankPart> part_;
  std::array<Points, max_steps> points_;
  Points of_ground_, of_crank_;  ///< directions of the links of a group
};

}  // namespace

bool draw_shape(MachineShape& shape, std::size_t first, RandomStream& random, std::optional<CrankPart> part) {
  const PointProgram& p = *shape.program;
  shape.x.resize(static_cast<std::size_t>(p.parameters));
  double* place = shape.x.data() + p.place();
  place[0] = place[1] = place[3] = 0, place[2] = 1;
  return ShapeDrawer(shape, random, part).draw(first);
}

}  // namespace linkwright::planar
