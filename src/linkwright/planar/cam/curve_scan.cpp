// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/curve_scan.h"

#include <algorithm>
#include <cmath>

#include "linkwright/math/minimum.h"
#include "linkwright/math/zero.h"

namespace linkwright::planar {
namespace {

// Samples of a turn, and of each part of a programme at least.
constexpr int samples_of_turn = 720, samples_of_part = 48;
// Share of an extreme by which equal ones differ by rounding.
constexpr double same_extreme = 1e-13;

// Places within one part that bracket its extremes and zeros, with the values there.
struct PartSamples {
  std::vector<double> angles, values;
};

// A quantity in one part of a programme.
struct PartQuantity {
  const ProgrammeCurve& curve;
  CamQuantity quantity;
  std::size_t part;

  double from() const { return curve.breaks()[part]; }
  double to() const { return curve.breaks()[part + 1]; }
  double operator()(double angle) const {
    const double value = quantity(curve.part(part, angle), angle);
    return std::isfinite(value) ? value : infinity;
  }

  PartSamples samples() const {
    const double width = to() - from();
    const int n = std::max(samples_of_part, static_cast<int>(std::ceil(samples_of_turn * width / (2 * pi))));
    PartSamples out;
    for (int k = 0; k <= n; ++k) {
      out.angles.push_back(k == n ? to() : from() + width * k / n);
      out.values.push_back((*this)(out.angles.back()));
    }
    return out;
  }

  // The derivative by a rule of fourth order, whose error is far below that of differences of two values.
  double slope(double angle, double step) const {
    return ((*this)(angle - 2 * step) - (*this)(angle + 2 * step) +
            8 * ((*this)(angle + step) - (*this)(angle - step))) /
           (12 * step);
  }

  // The least value near a sample that is lower than its neighbours.
  CamExtreme refine(double left, double middle, double right) const {
    const math::Minimum rough = math::minimum_about([this](double x) { return (*this)(x); }, left, middle,
                                                    right, {.absolute = 1e-7, .relative = 0, .sections = 80});
    CamExtreme best{rough.value, rough.at};
    const double step = std::min(1e-3, (to() - from()) / 400);
    const double low = std::max(rough.at - step, from() + 2 * step),
                 high = std::min(rough.at + step, to() - 2 * step);
    if (!(low < high)) return best;
    const auto slope_at = [&](double x) { return slope(x, step); };
    if (!(slope_at(low) < 0 && slope_at(high) > 0)) return best;
    const double place = math::zero_between(slope_at, low, high), value = (*this)(place);
    // The two values differ by rounding alone where the place is that of the same extreme.
    if (value <= best.value + same_extreme * std::abs(best.value))
      best = {std::min(value, best.value), place};
    return best;
  }
};

std::size_t parts_of(const ProgrammeCurve& curve) { return curve.breaks().size() - 1; }

bool is_lower_than_neighbours(const std::vector<double>& values, std::size_t i) {
  return values[i] < values[i - 1] && values[i] <= values[i + 1];
}

// Samples and refined extremes of both kinds, in their order.
PartSamples samples_with_extremes(const PartQuantity& f) {
  const PartSamples raw = f.samples();
  const auto negative = [&f](const math::Motion& m, double angle) { return -f.quantity(m, angle); };
  const PartQuantity mirrored{f.curve, negative, f.part};
  std::vector<double> mirrored_values;
  for (const double v : raw.values) mirrored_values.push_back(-v);
  PartSamples out;
  for (std::size_t i = 0; i < raw.angles.size(); ++i) {
    const bool is_inner = i > 0 && i + 1 < raw.angles.size();
    const bool is_low = is_inner && is_lower_than_neighbours(raw.values, i),
               is_high = is_inner && is_lower_than_neighbours(mirrored_values, i);
    double angle = raw.angles[i];
    if (is_low) angle = f.refine(raw.angles[i - 1], angle, raw.angles[i + 1]).angle;
    if (is_high) angle = mirrored.refine(raw.angles[i - 1], angle, raw.angles[i + 1]).angle;
    out.angles.push_back(angle);
    out.values.push_back(f(angle));
  }
  return out;
}

}  // namespace

CamExtreme least_over(const ProgrammeCurve& curve, CamQuantity quantity, EqualPlaces equal) {
  CamExtreme best{infinity, curve.breaks().front()};
  const auto offer = [&](const CamExtreme& found) {
    if (!std::isfinite(found.value)) return;
    const double rounding = std::isfinite(best.value) ? same_extreme * std::abs(best.value) : 0;
    if (found.value < (equal == EqualPlaces::first ? best.value - rounding : best.value + rounding))
      best = {std::min(found.value, best.value), found.angle};
  };
  for (std::size_t part = 0; part < parts_of(curve); ++part) {
    const PartQuantity f{curve, quantity, part};
    const PartSamples s = f.samples();
    for (std::size_t i = 0; i < s.angles.size(); ++i)
      if (i > 0 && i + 1 < s.angles.size() && is_lower_than_neighbours(s.values, i))
        offer(f.refine(s.angles[i - 1], s.angles[i], s.angles[i + 1]));
      else
        offer({s.values[i], s.angles[i]});
  }
  return best;
}

CamExtreme greatest_over(const ProgrammeCurve& curve, CamQuantity quantity) {
  const CamExtreme least =
      least_over(curve, [quantity](const math::Motion& m, double angle) { return -quantity(m, angle); });
  return {-least.value, least.angle};
}

std::vector<CamRange> negative_ranges(const ProgrammeCurve& curve, CamQuantity quantity) {
  std::vector<CamRange> out;
  bool is_open = false;
  for (std::size_t part = 0; part < parts_of(curve); ++part) {
    const PartQuantity f{curve, quantity, part};
    const PartSamples s = samples_with_extremes(f);
    for (std::size_t i = 0; i < s.angles.size(); ++i) {
      const bool is_negative = s.values[i] < 0;
      if (is_negative == is_open) {
        if (is_open) out.back().to = s.angles[i];
        continue;
      }
      double edge = s.angles[i];
      if (i > 0 && std::isfinite(s.values[i]) && std::isfinite(s.values[i - 1]))
        edge = math::zero_between([&f](double x) { return f(x); }, s.angles[i - 1], s.angles[i]);
      if (is_negative)
        out.push_back({edge, s.angles[i]});
      else
        out.back().to = edge;
      is_open = is_negative;
    }
  }
  const double first = curve.breaks().front(), last = curve.breaks().back();
  const bool is_turn = last - first > 2 * pi - 1e-9;
  if (is_turn && out.size() > 1 && out.front().from == first && out.back().to == last) {
    out.back().to += out.front().to - first;
    out.erase(out.begin());
  }
  return out;
}

}  // namespace linkwright::planar
