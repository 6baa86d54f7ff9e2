// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "linkwright/report/drawing.h"
#include "linkwright/study/scene.h"

/// Scenes in space, and scenes with a second input, as drawings in the plane have them.
namespace linkwright::report {

/// A direction from which a spatial scene is seen in parallel projection. Vectors are of unit length and at
/// right angles: `right` and `up` on the sheet, `back` towards the eye.
struct Viewpoint {
  std::string_view name;
  std::array<double, 3> right, up, back;
};

/// Rear (y to the left, z up), side from the left (x to the left, z up) and top (y to the left, x up): so put
/// that the side is right of the rear view and the top below it in first-angle projection (ISO 5456-2).
extern const std::array<Viewpoint, 3> viewpoints;

/// The scene at one value of its second input, with the samples of its first input only; the scene itself
/// when there is no second input. `row` counts from 0.
study::Scene row_of(const study::Scene& scene, std::size_t row);

/// The scene turned so that x is right, y up and z towards the eye. Targets, circles and couples, which are
/// of the plane, are left out.
study::Scene seen_from(const study::Scene& scene, const Viewpoint& viewpoint);

/// A circle of a wheel about its axis, `share` of its radius large and `aside` (m) from its centre along the
/// axis, as `count` places; empty when the wheel does not exist at the sample.
std::vector<Place> wheel_circle(const study::Scene& scene, const study::Scene::Disc& disc, std::size_t sample,
                                double share, double aside, int count);

/// Outline of a wheel on the sheet (x, y): the convex hull of its rims; empty when it does not exist.
std::vector<Place> wheel_outline(const study::Scene& scene, const study::Scene::Disc& disc,
                                 std::size_t sample);

/// The wire of a spring from `a` to `b`, `width` metres across.
std::vector<Place> helix(const Place& a, const Place& b, double width);

/// The line of an axis: from its first to its last point and on at both ends.
std::vector<Place> beyond(std::vector<Place> places);

}  // namespace linkwright::report
