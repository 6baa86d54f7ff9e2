// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/detail/slot_track.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/gauss.h"

namespace linkwright::planar {
namespace {
constexpr int samples_between = 16;  // two given points
}  // namespace

SlotTrack::SlotTrack(const CurvedSlot& slot) : closed_(slot.is_closed()) {
  if (slot.radius > 0) {
    centre_ = math::vec(slot.centre), radius_ = slot.radius;
    from_ = slot.from, to_ = slot.to;
    length_ = radius_ * std::abs(to_ - from_);
    return;
  }
  std::vector<double> u{0}, x, y;
  std::vector<std::complex<double>> points = slot.points;
  if (closed_) points.push_back(points.front());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0) u.push_back(u.back() + std::abs(points[i] - points[i - 1]));
    x.push_back(points[i].real()), y.push_back(points[i].imag());
  }
  const auto ends = closed_ ? math::SplineEnds::periodic : math::SplineEnds::natural;
  x_ = math::interpolating_spline(u, x, math::SplineDegree::quintic, ends);
  y_ = math::interpolating_spline(u, y, math::SplineDegree::quintic, ends);
  to_ = u.back();
  const int count = samples_between * static_cast<int>(u.size() - 1);
  for (int i = 0; i <= count; ++i) samples_.push_back(evaluate(to_ * i / count).at);
  ways_ = {0};
  for (int i = 0; i < count; ++i) {
    ways_.push_back(ways_.back() + length_between(to_ * i / count, to_ * (i + 1) / count));
  }
  length_ = ways_.back();
}

SlotTrack::CurvePoint SlotTrack::evaluate(double u) const {
  if (radius_ > 0) {
    const math::Vec2 out = math::unit(u);
    return {centre_ + radius_ * out, radius_ * perpendicular(out), -radius_ * out};
  }
  const auto x = math::evaluate(x_, u), y = math::evaluate(y_, u);
  return {{x[0], y[0]}, {x[1], y[1]}, {x[2], y[2]}};
}

double SlotTrack::length_between(double u, double v) const {
  return math::gauss_integral([this](double at) { return norm(evaluate(at).first); }, u, v);
}

double SlotTrack::way_at(double u) const {
  if (radius_ > 0) return radius_ * std::abs(u - from_);
  const std::size_t count = ways_.size() - 1;
  const double step = to_ / static_cast<double>(count);
  const auto before = std::min(count - 1, static_cast<std::size_t>(std::max(0.0, u / step)));
  return ways_[before] + length_between(step * static_cast<double>(before), u);
}

SlotPlace SlotTrack::place(double u) const {
  const CurvePoint p = evaluate(u);
  const double speed = norm(p.first), sense = to_ < from_ ? -1 : 1;
  return {.way = way_at(u),
          .at = p.at,
          .tangent = (sense / speed) * p.first,
          .curvature = sense * cross(p.first, p.second) / (speed * speed * speed)};
}

double SlotTrack::start_of_search(const math::Vec2& point) const {
  std::size_t best = 0;
  double least = infinity;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const math::Vec2 way = samples_[i] - point;
    if (const double square = dot(way, way); square < least) least = square, best = i;
  }
  return to_ * static_cast<double>(best) / static_cast<double>(samples_.size() - 1);
}

SlotPlace SlotTrack::nearest(const math::Vec2& point) const {
  double u = 0;
  if (radius_ > 0) {
    const double middle = (from_ + to_) / 2, angle = angle_of(point - centre_);
    u = angle - full_turn * std::round((angle - middle) / full_turn);
    if (!closed_) u = std::clamp(u, std::min(from_, to_), std::max(from_, to_));
  } else {
    // Newton's method on the derivative of the squared distance, between the samples beside the nearest one.
    const double step = to_ / static_cast<double>(samples_.size() - 1);
    u = start_of_search(point);
    double low = u - step, high = u + step;
    if (!closed_) low = std::max(low, 0.0), high = std::min(high, to_);
    for (int i = 0; i < 50; ++i) {
      const double wrapped = closed_ ? u - to_ * std::floor(u / to_) : u;
      const CurvePoint p = evaluate(wrapped);
      const math::Vec2 way = p.at - point;
      const double slope = dot(way, p.first), bend = dot(p.first, p.first) + dot(way, p.second);
      (slope > 0 ? high : low) = u;
      double next = bend > 0 ? u - slope / bend : (low + high) / 2;
      if (!(next >= low && next <= high)) next = (low + high) / 2;
      const bool done = std::abs(next - u) <= 1e-15 * to_;
      u = next;
      if (done) break;
    }
    if (closed_) u -= to_ * std::floor(u / to_);
  }
  SlotPlace out = place(u);
  if (closed_) return out;
  // Only an end is nearest to what lies beyond it.
  const double along = dot(out.tangent, point - out.at), margin = 1e-9 * length_;
  if (out.way <= margin && along < 0) out.beyond = -along, out.way += along;
  if (out.way >= length_ - margin && along > 0) out.beyond = along, out.way += along;
  if (out.beyond > 0) out.curvature = 0;
  return out;
}

std::vector<math::Vec2> SlotTrack::points(int count) const {
  std::vector<math::Vec2> out;
  const int last = closed_ ? count : count - 1;
  for (int i = 0; i < count; ++i) out.push_back(evaluate(from_ + (to_ - from_) * i / last).at);
  return out;
}

}  // namespace linkwright::planar
