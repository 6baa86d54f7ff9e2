// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/turn_measurer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/type_synthesis/curve.h"

namespace linkwright::planar {
namespace {

/// Distance of a point from the straight line between two others.
double distance_from_side(std::complex<double> point, std::complex<double> from, std::complex<double> to) {
  const std::complex<double> side = to - from, away = point - from;
  const double square = std::norm(side);
  const double part = square > 0 ? std::clamp((std::conj(side) * away).real() / square, 0.0, 1.0) : 0.0;
  return std::abs(away - part * side);
}

}  // namespace

TurnMeasurer::TurnMeasurer(const MotionTarget& target) : target_(target) {
  for (std::size_t k = 0; k < measured_angles; ++k)
    angle_[k] = 2 * pi * static_cast<double>(k) / measured_angles;
  if (!target.dense) return;
  for (const PolylinePlace& place :
       equal_step_places(target.stroke.polyline, target.stroke.closed, stroke_samples))
    side_of_sample_.push_back(place.side);
  side_of_sample_.push_back(target.stroke.polyline.size() - 1);
}

double TurnMeasurer::least_quality(const FittedMachine& machine) const {
  const auto least = std::min_element(quality_.begin(), quality_.end());
  double quality = *least, centre = angle_[static_cast<std::size_t>(least - quality_.begin())],
         half = target_.turns ? 2 * pi / measured_angles : std::abs(angle_[1] - angle_[0]);
  const double first = target_.turns ? -infinity : std::min(angle_.front(), angle_.back()),
               last = target_.turns ? infinity : std::max(angle_.front(), angle_.back());
  for (int zoom = 0; zoom < 4; ++zoom, half /= 3.5) {
    std::array<double, 8> angle, q, where;
    for (std::size_t k = 0; k < 8; ++k)
      angle[k] = std::clamp(centre + half * (static_cast<double>(k) - 3.5) / 3.5, first, last);
    compute_curve({.program = machine.shape.program,
                   .x = machine.shape.x.data(),
                   .signs = machine.shape.signs,
                   .angle = angle.data(),
                   .count = 8,
                   .quality = q.data(),
                   .worst = where.data()});
    const auto i = static_cast<std::size_t>(std::min_element(q.begin(), q.end()) - q.begin());
    if (q[i] < quality) quality = q[i], centre = angle[i];
  }
  return quality;
}

void TurnMeasurer::measure(const FittedMachine& machine, MachineMeasures& out) {
  const PointProgram& p = *machine.shape.program;
  const double* x = machine.shape.x.data();
  ++curves_;
  if (!target_.turns) target_.cover_used_part(machine.angle, angle_);
  compute_curve({.program = &p,
                 .x = x,
                 .signs = machine.shape.signs,
                 .angle = angle_.data(),
                 .count = measured_angles,
                 .px = x_.data(),
                 .py = y_.data(),
                 .tx = tx_.data(),
                 .ty = ty_.data(),
                 .quality = quality_.data(),
                 .worst = worst_.data(),
                 .points = points_.data()});
  const double quality = least_quality(machine);
  out.min_pair_angle = quality > 0 ? std::asin(std::sqrt(quality)) : 0;
  const auto s = static_cast<std::size_t>(p.scale());
  out.size = box_of_pins(p, std::complex<double>(x[s], x[s + 1]));
  // The acceleration of the output of a function is given by the function.
  if (target_.output == MachineOutput::point)
    out.peak_acceleration =
        target_.turns ? peak_acceleration(machine, out.span) : peak_acceleration_of_part(machine);
}

/// Larger side of the box of all pins over the turn; the ground pin of the crank is the origin of the
/// machine's plane.
double TurnMeasurer::box_of_pins(const PointProgram& p, std::complex<double> scale) const {
  double left = 0, right = 0, bottom = 0, top = 0;
  for (std::size_t i = 0; i < p.steps.size(); ++i) {
    if (p.steps[i].operation == PointOperation::sleeve) continue;
    const double *px = points_.data() + 2 * i * measured_angles, *py = px + measured_angles;
    for (std::size_t k = 0; k < measured_angles; ++k) {
      const std::complex<double> at = scale * std::complex<double>(px[k], py[k]);
      left = std::min(left, at.real()), right = std::max(right, at.real());
      bottom = std::min(bottom, at.imag()), top = std::max(top, at.imag());
    }
  }
  return std::max(right - left, top - bottom);
}

/// Of the traced point at unit crank speed; an open stroke asks for nothing outside its own part of the turn.
double TurnMeasurer::peak_acceleration(const FittedMachine& machine, double span) const {
  const double from = machine.sense > 0 ? machine.angle.front() : machine.angle.back();
  double peak = 0;
  for (std::size_t k = 0; k < measured_angles; ++k) {
    const double ahead = angle_[k] - from;
    if (!target_.stroke.closed && ahead - 2 * pi * std::floor(ahead / (2 * pi)) > span) continue;
    const std::size_t a = (k + measured_angles - 1) % measured_angles, b = (k + 1) % measured_angles;
    peak = std::max(peak, std::hypot(tx_[b] - tx_[a], ty_[b] - ty_[a]));
  }
  return peak * measured_angles / (4 * pi);
}

/// The same where the crank does not turn.
double TurnMeasurer::peak_acceleration_of_part(const FittedMachine& machine) const {
  const double first = machine.angle[0], last = machine.angle[target_.count - 1];
  const double step = std::abs(angle_[1] - angle_[0]);
  double peak = 0;
  for (std::size_t k = 1; k + 1 < measured_angles && step > 0; ++k)
    if ((angle_[k] - first) * (angle_[k] - last) <= 0)
      peak = std::max(peak, std::hypot(tx_[k + 1] - tx_[k - 1], ty_[k + 1] - ty_[k - 1]));
  return step > 0 ? peak / (2 * step) : 0;
}

/// True if a point is as near as that to the stroke between a sample and the next one: to its own corners and
/// bends there, which may be sharper than the straight side between the two samples.
bool TurnMeasurer::is_near_stroke(std::complex<double> point, std::size_t sample, double allowed) const {
  const std::vector<std::complex<double>>& drawn = target_.stroke.polyline;
  const std::size_t next = (sample + 1) % stroke_samples;
  std::complex<double> from{target_.x[sample], target_.y[sample]};
  for (std::size_t i = side_of_sample_[sample]; i < side_of_sample_[sample + 1]; ++i) {
    if (distance_from_side(point, from, drawn[i + 1]) <= allowed) return true;
    from = drawn[i + 1];
  }
  return distance_from_side(point, from, {target_.x[next], target_.y[next]}) <= allowed;
}

/// True if the curve stays near the stroke between the points, too: near the straight side between two
/// samples, or near the stroke itself where that leaves it.
bool TurnMeasurer::stays_near(const FittedMachine& machine, double largest_deviation) {
  constexpr std::size_t between = 3 * stroke_samples;
  alignas(64) std::array<double, between> angle, bx, by;
  const std::size_t sides = target_.stroke.closed ? stroke_samples : stroke_samples - 1;
  for (std::size_t k = 0; k < stroke_samples; ++k) {
    const double from = machine.angle[k];
    const double to = k + 1 < stroke_samples  ? machine.angle[k + 1]
                      : target_.stroke.closed ? machine.angle[0] + machine.sense * 2 * pi
                                              : from;
    for (std::size_t i = 0; i < 3; ++i)
      angle[3 * k + i] = from + (to - from) * 0.25 * static_cast<double>(i + 1);
  }
  ++curves_;
  compute_curve({.program = machine.shape.program,
                 .x = machine.shape.x.data(),
                 .signs = machine.shape.signs,
                 .angle = angle.data(),
                 .count = between,
                 .px = bx.data(),
                 .py = by.data()});
  const double allowed = 3 * largest_deviation + 0.02;
  for (std::size_t k = 0; k < 3 * sides; ++k) {
    const std::size_t i = k / 3, j = (i + 1) % stroke_samples;
    const std::complex<double> at(bx[k], by[k]);
    if (!(distance_from_side(at, {target_.x[i], target_.y[i]}, {target_.x[j], target_.y[j]}) <= allowed) &&
        !is_near_stroke(at, i, allowed))
      return false;
  }
  return true;
}

}  // namespace linkwright::planar
