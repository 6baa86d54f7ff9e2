// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "linkwright/math/spline.h"
#include "linkwright/math/vector2.h"
#include "linkwright/planar/linkage/linkage.h"

// The curve of a slot: places on it by their distance along it, and the place nearest to a point.
namespace linkwright::planar {

// A place on the curve, in the frame of its body.
struct SlotPlace {
  double way = 0;            // length of the curve from its beginning, m
  math::Vec2 at{0, 0};       // m
  math::Vec2 tangent{1, 0};  // unit vector towards the end
  double curvature = 0;      // 1/m, positive where the curve turns to the left
  double beyond = 0;         // by which the point lies beyond an end, along the tangent there, m
};

class SlotTrack {
 public:
  SlotTrack() = default;
  explicit SlotTrack(const CurvedSlot& slot);

  double length() const { return length_; }
  // The place nearest to a point; beyond an end of an open curve that end, with the tangent there.
  SlotPlace nearest(const math::Vec2& point) const;
  // Points along the whole curve.
  std::vector<math::Vec2> points(int count) const;

 private:
  struct CurvePoint {
    math::Vec2 at, first, second;  // place and derivatives by the parameter
  };
  CurvePoint evaluate(double u) const;
  SlotPlace place(double u) const;
  double length_between(double u, double v) const;
  double way_at(double u) const;
  double start_of_search(const math::Vec2& point) const;

  bool closed_ = false;
  double length_ = 0, from_ = 0, to_ = 0;  // and the range of the parameter
  // An arc about a centre, whose parameter is the angle; radius 0: a spline.
  math::Vec2 centre_{0, 0};
  double radius_ = 0;
  math::PiecewisePolynomial x_, y_;
  std::vector<double> ways_;         // length up to each sample of the parameter
  std::vector<math::Vec2> samples_;  // evenly spaced in the parameter
};

}  // namespace linkwright::planar
