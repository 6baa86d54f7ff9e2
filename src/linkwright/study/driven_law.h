// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <variant>

#include "linkwright/core/field.h"
#include "linkwright/math/motion_law.h"

// Motion laws as files hold them: with the units of the joint that they drive.
namespace linkwright::study {

enum class JointKind { rotary, linear };

/// A law in a file: `from_deg`, `speed_rpm` for a rotary joint, `from_mm`, `speed_m_per_s` for a linear one.
template <JointKind kind, class Law>
struct Driven : Law {};

template <JointKind kind>
using DrivenLaw = std::variant<Driven<kind, math::ConstantSpeed>, Driven<kind, math::CycloidalMotion>,
                               Driven<kind, math::Polynomial345>, Driven<kind, math::EndConditions>,
                               Driven<kind, math::MotionTable>, Driven<kind, math::HarmonicMotion>>;
/// Members of a study: visit(field::entry("law", ...), law) reads the word and, beside it, the law's keys.
using RotaryLaw = DrivenLaw<JointKind::rotary>;
using LinearLaw = DrivenLaw<JointKind::linear>;

/// Any of them, for the schema of joints that may be either.
template <class Rotary, class Linear>
struct EitherLaw;
template <class... Rotary, class... Linear>
struct EitherLaw<std::variant<Rotary...>, std::variant<Linear...>> {
  using type = std::variant<Rotary..., Linear...>;
};
using AnyLaw = EitherLaw<RotaryLaw, LinearLaw>::type;

/// The law itself.
template <JointKind kind>
math::MotionLaw motion_law(const DrivenLaw<kind>& law) {
  return std::visit(
      []<class Law>(const Driven<kind, Law>& l) { return math::MotionLaw(static_cast<const Law&>(l)); }, law);
}

constexpr Word choice_word(const math::ConstantSpeed&) { return {"constant_speed", "uniform motion"}; }
constexpr Word choice_word(const math::CycloidalMotion&) {
  return {"cycloidal", "from rest to rest with a sine as acceleration"};
}
constexpr Word choice_word(const math::Polynomial345&) {
  return {"polynomial_345", "from rest to rest by a polynomial without acceleration at its ends"};
}
constexpr Word choice_word(const math::EndConditions&) {
  return {"polynomial", "polynomial through given values, speeds, accelerations and jerks at its ends"};
}
constexpr Word choice_word(const math::MotionTable&) {
  return {"table", "smooth curve through values in time"};
}
constexpr Word choice_word(const math::HarmonicMotion&) {
  return {"harmonic", "reciprocating motion, a sine of time"};
}
template <JointKind kind, class Law>
constexpr Word choice_word(const Driven<kind, Law>& law) {
  return choice_word(static_cast<const Law&>(law));
}

namespace motion_fields {

// Dimension of the derivative of that order by time.
constexpr Dimension dimension(JointKind kind, int order) {
  constexpr Dimension rotary[] = {Dimension::angle, Dimension::speed_angular, Dimension::acceleration_angular,
                                  Dimension::jerk_angular};
  constexpr Dimension linear[] = {Dimension::length, Dimension::speed, Dimension::acceleration,
                                  Dimension::jerk};
  return kind == JointKind::rotary ? rotary[order] : linear[order];
}

// Beyond it the digits of a double no longer separate neighbouring positions.
inline constexpr double most = 1e9;

constexpr Field value(JointKind kind, std::string_view key, std::string_view summary, bool required = false,
                      int order = 0) {
  return field::of(dimension(kind, order), key, summary).between(-most, most).required(required);
}

template <class Visitor, class Law>
void interval(Visitor&& visit, Law& law) {
  visit(field::time("start", "time when the motion begins"), law.start);
  visit(field::time("duration", "time that the motion takes").at_least(1e-9).required(), law.duration);
}

template <class Visitor>
void list(Visitor&& visit, JointKind kind, math::ConstantSpeed& law) {
  visit(value(kind, "from", "position at time 0"), law.from);
  visit(value(kind, "speed", "constant rate", true, 1), law.rate);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, math::CycloidalMotion& law) {
  visit(value(kind, "from", "position before", true), law.from);
  visit(value(kind, "to", "position after", true), law.to);
  interval(visit, law);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, math::Polynomial345& law) {
  visit(value(kind, "from", "position before", true), law.from);
  visit(value(kind, "to", "position after", true), law.to);
  interval(visit, law);
  visit(field::entry("higher_coefficients",
                     "free coefficients of x^6, x^7, ... as shares of the stroke; n of them make the "
                     "law of degree 5 + n")
            .between(-1e6, 1e6),
        law.higher);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, math::EndConditions& law) {
  visit(value(kind, "from", "position at the start", true), law.from);
  visit(value(kind, "to", "position at the end"), law.to);
  interval(visit, law);
  visit(value(kind, "start_speed", "rate at the start", false, 1), law.start_rate);
  visit(value(kind, "start_acceleration", "acceleration at the start", false, 2), law.start_acceleration);
  visit(value(kind, "start_jerk", "jerk at the start", false, 3), law.start_jerk);
  visit(value(kind, "end_speed", "rate at the end", false, 1), law.end_rate);
  visit(value(kind, "end_acceleration", "acceleration at the end", false, 2), law.end_acceleration);
  visit(value(kind, "end_jerk", "jerk at the end", false, 3), law.end_jerk);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, math::MotionTable& law) {
  visit(field::time("times", "increasing times").between(-most, most).required(), law.times);
  visit(value(kind, "values", "position at each time", true), law.values);
  visit(field::entry("curve", "degree of the curve between the rows"), law.curve);
  visit(field::entry("ends", "what holds at the first and last row"), law.ends);
}
template <class Visitor>
void list(Visitor&& visit, JointKind kind, math::HarmonicMotion& law) {
  visit(value(kind, "centre", "middle position"), law.centre);
  visit(value(kind, "amplitude", "largest distance from the middle", true), law.amplitude);
  visit(field::frequency("frequency", "oscillations per time").between(0, most).required(), law.frequency);
  visit(field::angle("phase", "0: through the middle, forwards, at time 0").between(-most, most), law.phase);
}

}  // namespace motion_fields

template <class Visitor, JointKind kind, class Law>
void fields(Visitor&& visit, Driven<kind, Law>& law) {
  motion_fields::list(visit, kind, static_cast<Law&>(law));
}

/// Evenly spaced times from `from` to `to`, ends included.
struct TimeSamples {
  double from = 0;  ///< s
  double to = 0;    ///< s
  int samples = 0;
};
template <class Visitor>
void fields(Visitor&& visit, TimeSamples& t) {
  visit(field::time("from", "first time"), t.from);
  visit(field::time("to", "last time").required(), t.to);
  visit(field::entry("samples", "number of times, both ends included").between(2, 100000).required(),
        t.samples);
}

}  // namespace linkwright::study
