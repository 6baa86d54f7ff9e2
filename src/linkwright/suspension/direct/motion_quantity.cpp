// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/direct/motion_quantity.h"

namespace linkwright::suspension {
namespace {

/// The length that the law compresses, counted from the drawing; an angle counts by the factor.
TravelRates compressed(const MotionQuantity& q, const MotionRates& at) {
  switch (q.part) {
    case MotionPart::spring:
      return {at.spring.value - at.spring_drawn, at.spring.ratio, at.spring.by_travel};
    case MotionPart::element:
    case MotionPart::rocker: {
      const TravelRates& of =
          q.part == MotionPart::element ? at.elements.at(q.index) : at.rockers.at(q.index);
      return {q.factor * of.value, q.factor * of.ratio, q.factor * of.by_travel};
    }
  }
  return {};
}

const TravelRates& rates_of(const MotionQuantity& q, const MotionRates& at) {
  return q.part == MotionPart::spring    ? at.spring
         : q.part == MotionPart::element ? at.elements.at(q.index)
                                         : at.rockers.at(q.index);
}

}  // namespace

double value_of(const MotionQuantity& q, const MotionRates& at) {
  const TravelRates &l = rates_of(q, at), pressed = compressed(q, at);
  switch (q.measure) {
    case MotionMeasure::ratio:
      return q.factor * l.ratio;
    case MotionMeasure::ratio_by_travel:
      return q.factor * l.by_travel;
    case MotionMeasure::ratio_squared:
      return q.factor * l.ratio * l.ratio;
    case MotionMeasure::spring_force:
      return force_of(q.law, -pressed.value).force;
    case MotionMeasure::wheel_force:
      return -force_of(q.law, -pressed.value).force * pressed.ratio;
    case MotionMeasure::wheel_rate: {
      const SpringForce f = force_of(q.law, -pressed.value);
      return f.stiffness * pressed.ratio * pressed.ratio - f.force * pressed.by_travel;
    }
  }
  return WheelParameters::missing;
}

double derivative_of(const MotionQuantity& q, const MotionRates& at, const MotionRates& by) {
  const TravelRates &l = rates_of(q, at), &dl = rates_of(q, by);
  const TravelRates pressed = compressed(q, at), change = compressed(q, by);
  switch (q.measure) {
    case MotionMeasure::ratio:
      return q.factor * dl.ratio;
    case MotionMeasure::ratio_by_travel:
      return q.factor * dl.by_travel;
    case MotionMeasure::ratio_squared:
      return 2 * q.factor * l.ratio * dl.ratio;
    default:
      break;
  }
  const SpringForce f = force_of(q.law, -pressed.value);
  const double force = -f.stiffness * change.value, stiffness = -f.bend * change.value;
  if (q.measure == MotionMeasure::spring_force) return force;
  if (q.measure == MotionMeasure::wheel_force) return -force * pressed.ratio - f.force * change.ratio;
  return stiffness * pressed.ratio * pressed.ratio + 2 * f.stiffness * pressed.ratio * change.ratio -
         force * pressed.by_travel - f.force * change.by_travel;
}

}  // namespace linkwright::suspension
