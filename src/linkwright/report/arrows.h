// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "linkwright/report/drawing.h"
#include "linkwright/study/scene.h"

/// Length and position of the arrows of a scene in the drawing.
namespace linkwright::report {

/// One scale for all vectors of a quantity, the same at every sample.
struct ArrowScale {
  double metres_per_unit = 0;  ///< length of an arrow in the drawing for a value of 1; 0 = no arrow to draw
  double key_value = 0;        ///< value of the arrow in the key: 1, 2 or 5 times a power of ten
  std::string unit;            ///< "N"
};

/// The scale at which the largest arrow is a quarter of the scene's size. Where single samples stand out, as
/// near a dead point, three times the median over the samples of the largest arrow takes the place of the
/// largest, and some arrows are longer.
ArrowScale arrow_scale(const study::Scene& scene, study::Scene::Quantity quantity);

/// A value along x, y and, in space, z.
struct Components {
  double x = 0, y = 0, z = 0;
  double size() const;
};

/// Value of a vector at a sample: its only entry when constant, NaN when it is not known.
Components components(const study::Scene::Vector& vector, std::size_t sample);

/// Value of a couple at a sample, likewise.
double value(const study::Scene::Moment& moment, std::size_t sample);

/// Largest size of the couples of a scene over its samples; 0 when none is known.
double largest_moment(const study::Scene& scene);

/// Angle (rad, counter-clockwise positive) of the arc of a couple whose value is `share` of the largest, -1
/// to 1: up to 5/6 of a turn, at least 1/12 so that the sign shows, 0 for 0.
double arc_turn(double share);

/// The tip of an arrow in the drawing; NaN when the point or the value is not known.
Place tip(const study::Scene& scene, const study::Scene::Vector& vector, std::size_t sample,
          const ArrowScale& scale);

}  // namespace linkwright::report
