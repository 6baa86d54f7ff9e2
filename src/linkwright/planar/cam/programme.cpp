// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/programme.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/finite.h"

namespace linkwright::planar {
namespace {

using math::Motion;
using math::MotionCurve;

// Angles that differ by less are one (rad).
constexpr double same_angle = 1e-9;
// Share of the largest size of a derivative that counts as no step.
constexpr double same_value = 1e-9;

// A sine of acceleration A sin(w (x - x0) + phase) that starts at (x0, value, rate).
struct SinePart {
  double start, amplitude, frequency, phase, value, rate;

  Motion at(double x) const {
    const double w = frequency, u = x - start, s = std::sin(w * u + phase), c = std::cos(w * u + phase);
    return {
        value + (rate + amplitude / w * std::cos(phase)) * u - amplitude / (w * w) * (s - std::sin(phase)),
        rate - amplitude / w * (c - std::cos(phase)), amplitude * s, amplitude * w * c};
  }
};

// The first half of the law; the second one is its image in the point (1/2, 1/2).
Motion first_half_of_trapezoid(double x) {
  const double a = 8 * pi / (2 + pi);
  const SinePart rise{0, a, 4 * pi, 0, 0, 0};
  if (x < 0.125) return rise.at(x);
  const Motion begin = rise.at(0.125);
  const auto steady = [&](double u) {
    return Motion{begin.value + begin.rate * u + a / 2 * u * u, begin.rate + a * u, a, 0};
  };
  if (x < 0.375) return steady(x - 0.125);
  const Motion end = steady(0.25);
  return SinePart{0.375, a, 4 * pi, pi / 2, end.value, end.rate}.at(x);
}

Motion first_half_of_sine(double x) {
  const double a = 4 * pi * pi / (4 + pi);
  const SinePart rise{0, a, 4 * pi, 0, 0, 0};
  if (x < 0.125) return rise.at(x);
  const Motion begin = rise.at(0.125);
  return SinePart{0.125, a, 4 * pi / 3, pi / 2, begin.value, begin.rate}.at(x);
}

template <class FirstHalf>
Motion symmetric(const FirstHalf& half, double x) {
  if (x <= 0.5) return half(x);
  const Motion m = half(1 - x);
  return {1 - m.value, m.rate, -m.acceleration, m.jerk};
}

// The laws that drives follow in time, too, share their formulas.
Motion unit_motion(const math::MotionLaw& law, double x) { return MotionCurve(law)(x); }

math::MotionLaw polynomial_law(const CamSegment& segment, double angle, double from) {
  const SegmentConditions& c = segment.conditions;
  return math::EndConditions{.from = from,
                             .to = segment.to,
                             .start = angle,
                             .duration = segment.over,
                             .start_rate = c.start_rate,
                             .start_acceleration = c.start_acceleration,
                             .start_jerk = c.start_jerk,
                             .end_rate = c.end_rate,
                             .end_acceleration = c.end_acceleration,
                             .end_jerk = c.end_jerk};
}

math::MotionLaw table_law(const CamProgramme& programme) {
  return math::MotionTable{
      .times = programme.table->angles,
      .values = programme.table->values,
      .curve = math::TableCurve::quintic,
      .ends = programme.is_sector ? math::TableEnds::natural : math::TableEnds::periodic};
}

bool is_usable_table(const CamProgramme& programme) {
  const CamTable& table = *programme.table;
  return programme.segments.empty() && !math::problem(table_law(programme)) &&
         std::abs(table.angles.front()) <= same_angle;
}

bool is_usable(const CamProgramme& programme) {
  if (!std::isfinite(programme.start) || !(programme.angle > 0) || !(programme.angle <= 2 * pi + same_angle))
    return false;
  if (programme.table) return is_usable_table(programme);
  if (programme.segments.empty()) return false;
  double angle = 0, value = programme.start;
  for (const CamSegment& segment : programme.segments) {
    if (!(segment.over > 0) || !std::isfinite(segment.over) || !std::isfinite(segment.to)) return false;
    if (segment.law == CamLaw::polynomial && math::problem(polynomial_law(segment, angle, value)))
      return false;
    angle += segment.over;
    if (segment.law != CamLaw::dwell) value = segment.to;
  }
  return true;
}

std::array<double, 4> orders(const Motion& m) { return {m.value, m.rate, m.acceleration, m.jerk}; }

// The largest size of the value's change and of each derivative over the programme.
std::array<double, 4> largest_sizes(const ProgrammeCurve& curve) {
  std::array<double, 4> out{};
  const std::vector<double>& breaks = curve.breaks();
  const double first = curve.part(0, breaks[0]).value;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    for (int k = 0; k <= 16; ++k) {
      std::array<double, 4> m = orders(curve.part(i, breaks[i] + (breaks[i + 1] - breaks[i]) * k / 16));
      m[0] -= first;
      for (std::size_t order = 0; order < 4; ++order) out[order] = std::max(out[order], std::abs(m[order]));
    }
  return out;
}

void find_jumps(const Motion& left, const Motion& right, const std::array<double, 4>& sizes, double angle,
                std::size_t part, std::vector<ProgrammeFinding>& found) {
  constexpr std::array<std::pair<ProgrammeIssue, ProgrammeSeverity>, 4> kinds = {
      {{ProgrammeIssue::jump_of_value, ProgrammeSeverity::error},
       {ProgrammeIssue::jump_of_rate, ProgrammeSeverity::error},
       {ProgrammeIssue::jump_of_acceleration, ProgrammeSeverity::warning},
       {ProgrammeIssue::jump_of_jerk, ProgrammeSeverity::note}}};
  const std::array<double, 4> before = orders(left), behind = orders(right);
  for (std::size_t order = 0; order < 4; ++order)
    if (const double step = behind[order] - before[order]; std::abs(step) > same_value * sizes[order])
      found.push_back({kinds[order].first, kinds[order].second, angle, step, part});
}

}  // namespace

Motion normalised_motion(CamLaw law, double x) {
  LINKWRIGHT_REQUIRE(x >= 0 && x <= 1, "x is {}, must be between 0 and 1", x);
  LINKWRIGHT_REQUIRE(law != CamLaw::polynomial, "a polynomial has no form of its own");
  switch (law) {
    case CamLaw::constant_speed:
      return {x, 1, 0, 0};
    case CamLaw::harmonic:
      return unit_motion(
          math::HarmonicMotion{.centre = 0.5, .amplitude = 0.5, .frequency = 0.5, .phase = -pi / 2}, x);
    case CamLaw::cycloidal:
      return unit_motion(math::CycloidalMotion{.from = 0, .to = 1}, x);
    case CamLaw::polynomial_345:
      return unit_motion(math::Polynomial345{.from = 0, .to = 1}, x);
    case CamLaw::polynomial_4567:
      // With these two terms the conditions at the ends leave 35 x^4 - 84 x^5 of the first three.
      return unit_motion(math::Polynomial345{.from = 0, .to = 1, .higher = {70, -20}}, x);
    case CamLaw::modified_trapezoid:
      return symmetric(first_half_of_trapezoid, x);
    case CamLaw::modified_sine:
      return symmetric(first_half_of_sine, x);
    case CamLaw::dwell:
    case CamLaw::polynomial:
      break;
  }
  return {};
}

ProgrammeCurve::ProgrammeCurve(const CamProgramme& programme) : is_sector_(programme.is_sector) {
  LINKWRIGHT_REQUIRE(is_usable(programme), "the programme has no motion");
  if (programme.table) {
    breaks_ = {programme.table->angles.front(), programme.table->angles.back()};
    pieces_.push_back({.curve = MotionCurve(table_law(programme))});
    return;
  }
  double angle = 0, value = programme.start;
  breaks_.push_back(angle);
  for (const CamSegment& segment : programme.segments) {
    Piece piece{.law = segment.law,
                .from = value,
                .to = segment.law == CamLaw::dwell ? value : segment.to,
                .curve = std::nullopt};
    if (segment.law == CamLaw::polynomial) piece.curve.emplace(polynomial_law(segment, angle, value));
    value = piece.to;
    angle += segment.over;
    breaks_.push_back(angle);
    pieces_.push_back(std::move(piece));
  }
}

Motion ProgrammeCurve::part(std::size_t part, double angle) const {
  LINKWRIGHT_REQUIRE(part < pieces_.size(), "part {} of {}", part, pieces_.size());
  const Piece& piece = pieces_[part];
  if (piece.curve) return (*piece.curve)(angle);
  const double over = breaks_[part + 1] - breaks_[part], stroke = piece.to - piece.from;
  const Motion m = normalised_motion(piece.law, std::clamp((angle - breaks_[part]) / over, 0.0, 1.0));
  return {piece.from + stroke * m.value, stroke / over * m.rate, stroke / (over * over) * m.acceleration,
          stroke / (over * over * over) * m.jerk};
}

Motion ProgrammeCurve::operator()(double angle) const {
  LINKWRIGHT_REQUIRE(std::isfinite(angle), "the angle is {} rad, must be finite", angle);
  const double first = breaks_.front(), last = breaks_.back(), period = last - first;
  if (is_sector_ && (angle < first || angle > last)) {
    const bool is_before = angle < first;
    return {part(is_before ? 0 : pieces_.size() - 1, is_before ? first : last).value, 0, 0, 0};
  }
  if (!is_sector_) angle = std::clamp(angle - period * std::floor((angle - first) / period), first, last);
  const auto behind = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, angle);
  return part(static_cast<std::size_t>(behind - breaks_.begin()) - 1, angle);
}

std::vector<ProgrammeFinding> findings(const CamProgramme& programme) {
  if (!is_usable(programme)) return {{ProgrammeIssue::no_motion, ProgrammeSeverity::error, 0, 0, 0}};
  std::vector<ProgrammeFinding> found;
  const ProgrammeCurve curve(programme);
  const std::vector<double>& breaks = curve.breaks();
  const std::size_t parts = breaks.size() - 1;
  const double missing = programme.angle - breaks.back();
  if (std::abs(missing) > same_angle)
    found.push_back(
        {ProgrammeIssue::segments_do_not_fill, ProgrammeSeverity::error, breaks.back(), missing, parts});
  const std::array<double, 4> sizes = largest_sizes(curve);
  const Motion start = curve.part(0, breaks.front()), end = curve.part(parts - 1, breaks.back());
  const bool closes = std::abs(end.value - start.value) <= same_value * sizes[0];
  if (!programme.is_sector && !closes)
    found.push_back({ProgrammeIssue::does_not_close, ProgrammeSeverity::error, breaks.back(),
                     end.value - start.value, parts});
  // A spline is smooth across its ends, and an open programme has no motion to compare there.
  if (!programme.is_sector && closes && !programme.table)
    find_jumps(end, start, sizes, breaks.front(), 0, found);
  for (std::size_t i = 1; i < parts; ++i)
    find_jumps(curve.part(i - 1, breaks[i]), curve.part(i, breaks[i]), sizes, breaks[i], i, found);
  return found;
}

}  // namespace linkwright::planar
