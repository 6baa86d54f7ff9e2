// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>

#include "linkwright/math/function_ref.h"
#include "linkwright/planar/cam/disc_cam.h"

// The contour of a cam from the motion of its follower, whatever guides that. Places are from the centre of
// the cam in the frame of the ground, derivatives are by the angle of the cam, >= 0 in its sense.
namespace linkwright::planar {

// The motion of the centre of a roller or of an edge. `lever` is its travel by unit of the programme, in the
// direction in which it rises.
struct RollerPath {
  std::complex<double> place, rate, acceleration, lever;
};
// The motion of a flat face: the angle of its outward normal, the distance of the face from the centre of the
// cam, and the derivatives of both.
struct FacePath {
  math::Motion normal, distance;
};

// The contour at an angle of a cam that turns in a sense, +1 or -1. Of a face neither the place along it nor
// the lever is known here: contact and lever are left as they are.
CamState roller_contour(const RollerPath& path, double roller, double sense, double angle);
CamState face_contour(const FacePath& path, double sense, double angle);

// The contour at a motion of the programme and an angle of the cam.
using CamContour = math::FunctionRef<CamState(const math::Motion&, double)>;

// The extremes of a contour: `roller` is the radius of the roller or 0, `is_flat` is true of a flat face, and
// `size` is the length by which a gouge is judged.
CamExtremes contour_extremes(CamContour contour, double roller, bool is_flat, double size,
                             const ProgrammeCurve& curve);

}  // namespace linkwright::planar
