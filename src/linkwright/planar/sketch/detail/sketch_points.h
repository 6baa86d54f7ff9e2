// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/drawing/drawing.h"
#include "linkwright/planar/sketch/sketch.h"

// Lines and points of a drawing, before they are links and joints.
namespace linkwright::planar::sketching {

using Place = std::complex<double>;

/// A place in messages: "(40, 90) mm".
std::string shown_place(Place at);

/// A straight or curved line with two ends, or the line of a slide.
struct Segment {
  Place from, to;
  bool straight = true;
};

/// The order of places from left to right, and of those on one vertical from below.
inline bool left_below(Place a, Place b) {
  return a.real() < b.real() || (a.real() == b.real() && a.imag() < b.imag());
}

/// The distance of a place from a straight line between two ends (m).
double distance(Place p, Place a, Place b);

/// The pieces of an open polyline between its corners, where its direction turns by more than 15 degrees;
/// points of a curve are no corners.
std::vector<Segment> pieces_of(const DrawnShape& shape);

/// The turn of direction at a corner (rad), 0 to pi.
double turn_at(Place before, Place at, Place after);

/// Turns above this are corners (rad); smaller ones are points of a curve.
inline constexpr double least_corner = 0.26;

/// Points that are one within the tolerance, by union of neighbours, so that their order does not matter.
class Nodes {
 public:
  void add(Place at) { raw_.push_back(at); }

  /// Joins places within the tolerance, and those within ten times the tolerance with a question each.
  void join(double tolerance, std::vector<SketchQuestion>& questions);

  /// The point of a place that was added.
  std::size_t at(Place place) const;
  const std::vector<Place>& places() const { return places_; }

 private:
  std::size_t root(std::size_t i);
  template <class Meet>
  void near(double distance, Meet meet);
  void unite(double tolerance);
  void unite_asked(double tolerance, std::vector<SketchQuestion>& questions);

  std::vector<Place> raw_, places_;
  std::vector<std::size_t> group_, group_of_raw_;
};

/// The name of a point by its place in the order from left to right: "A" to "Z", then "A2".
std::string letter_of(std::size_t index);

/// The point of a name; none if there is none.
std::optional<std::size_t> point_named(const Sketch& sketch, std::string_view name);

/// Names bodies by their points, joints after theirs, gears and belts by their centres.
void name_sketch(Sketch& sketch);

}  // namespace linkwright::planar::sketching
