// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/extremes.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/scene.h"

/// The common base of SVG, DXF and HTML for drawing a scene.
namespace linkwright::report {

/// Rectangle in metres; empty while x_min > x_max.
struct Box {
  double x_min = 1, x_max = -1;
  double y_min = 1, y_max = -1;
  bool empty() const { return x_min > x_max || y_min > y_max; }
  double width() const { return x_max - x_min; }
  double height() const { return y_max - y_min; }
  /// Takes in a point; one with a NaN or infinite coordinate is left out.
  void add(double x, double y);
};

/// Smallest rectangle in x and y with every finite point of the scene, over all samples, its circles, wheels
/// and targets.
Box bounds(const study::Scene& scene);

/// Largest side of the scene over all samples (m), along z too; 0 when it has no finite point.
double extent(const study::Scene& scene);

/// A place (m), in the plane with z = 0; NaN when it does not exist.
struct Place {
  double x = 0, y = 0, z = 0;
  bool finite() const;
};

/// The position of a point at a sample: its only entry when it does not move, NaN when the sample or point is
/// not there.
Place place(const study::Scene& scene, int point, std::size_t sample);

/// Radius of a circle at a sample (m); NaN when one of its points does not exist.
double radius(const study::Scene& scene, const study::Scene::Circle& circle, std::size_t sample);

/// Colour and dash of a curve in a diagram, and of the mechanism that it belongs to where several are drawn.
struct CurveLook {
  std::string_view colour, dash;
};
CurveLook curve_look(std::size_t curve);

/// The lines of a spring (zigzag), damper (piston rod, piston, cylinder) or guide (line, hatching on its
/// right) from `a` to `b`, `width` metres across; no line for other styles and for places that are missing or
/// the same.
std::vector<std::vector<Place>> symbol_lines(study::Scene::BodyStyle style, const Place& a, const Place& b,
                                             double width);

/// True if a body is drawn by symbol_lines.
bool is_symbol(study::Scene::BodyStyle style);

/// Number of the role of each body, in the order in which roles appear; bodies of one role are drawn alike. A
/// role is the name without the side ("left tie rod") and, where legs are repeated, without their number:
/// "rod 2" when another role has a 2, too. Bodies without a name have a role each; ground, axes and symbols
/// have 0.
std::vector<std::size_t> role_numbers(const study::Scene& scene);

/// True when every point of the scene exists at the sample; in space its status alone decides, if it has one.
bool assembled(const study::Scene& scene, std::size_t sample);

/// The sample to draw when one must do: in the plane the first that is assembled; in space, and with a second
/// input, the one of these whose inputs are nearest to zero, measured by their ranges. 0 when none is.
std::size_t reference_sample(const study::Scene& scene);

/// The polyline with as few of its points as keep it within `tolerance` of all of them (Douglas and Peucker
/// 1973); its ends stay. All places must be finite.
std::vector<Place> simplified(const std::vector<Place>& line, double tolerance);

/// The largest of 1, 2, 5 times a power of ten that is not above `span / divisions`; 1 for a span of 0 or
/// NaN.
double nice_step(double span, double divisions);

/// The smallest step of an axis in degrees that is not below `span / divisions`: 1, 2 or 5 times a power of
/// ten up to 10, then parts of a turn (15, 30, 45, 90, 180, 360) and whole turns.
double degree_step(double span, double divisions);

/// Multiples of the step (> 0) from low to high, 40 at most: far from zero neighbours can be the same number.
std::vector<double> ticks(double low, double high, double step);

/// Length unit for drawings of this size: factor from metres and its symbol.
struct LengthUnit {
  double per_metre = 1;
  std::string symbol = "m";
};
/// Millimetres below one metre, else metres.
LengthUnit length_unit(double size);
/// The unit of lengths that was chosen, if any.
std::optional<LengthUnit> chosen_length(const study::DisplayUnits& units);

/// The target point that is missed most, and by how much (m).
study::Extreme worst(const study::Scene::Target& target);

}  // namespace linkwright::report
