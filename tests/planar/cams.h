// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "linkwright/core/numbers.h"
#include "linkwright/planar/cam/disc_cam.h"
#include "support/published.h"

// Cams and programmes that several tests share.
namespace linkwright::planar::test {
using namespace linkwright::test;

constexpr double degree = pi / 180;

inline const Value& computed_cam(const char* id) {
  return at(published_case("planar-machines.json", id), "computed");
}

inline ProgrammeCurve rise_only() {
  return ProgrammeCurve(
      {.angle = 120 * degree, .is_sector = true, .segments = {{CamLaw::cycloidal, 120 * degree, 0.02, {}}}});
}

inline ProgrammeCurve rise_dwell_return(CamLaw rise, CamLaw fall, double stroke) {
  return ProgrammeCurve({.segments = {{rise, 120 * degree, stroke, {}},
                                      {CamLaw::dwell, 60 * degree, 0, {}},
                                      {fall, 120 * degree, 0, {}},
                                      {CamLaw::dwell, 60 * degree, 0, {}}}});
}

inline DiscCam roller_cam(double offset = 0.008) {
  return {.base_radius = 0.04, .roller_radius = 0.01, .offset = offset};
}

inline DiscCam oscillating_roller() {
  return {.motion = FollowerMotion::oscillating,
          .base_radius = 0.032,
          .roller_radius = 0.008,
          .pivot = 0.08,
          .arm = 0.065};
}
inline ProgrammeCurve oscillating_programme() {
  return ProgrammeCurve({.segments = {{CamLaw::polynomial_345, 110 * degree, 20 * degree, {}},
                                      {CamLaw::dwell, 50 * degree, 0, {}},
                                      {CamLaw::modified_sine, 120 * degree, 0, {}},
                                      {CamLaw::dwell, 80 * degree, 0, {}}}});
}

inline DiscCam oscillating_flat() {
  return {.motion = FollowerMotion::oscillating,
          .face = FollowerFace::flat,
          .base_radius = 0.09 * std::sin(12 * degree) + 0.012,
          .pivot = 0.09,
          .face_offset = 0.012};
}
inline ProgrammeCurve flat_programme() {
  return ProgrammeCurve({.segments = {{CamLaw::cycloidal, 140 * degree, 15 * degree, {}},
                                      {CamLaw::dwell, 40 * degree, 0, {}},
                                      {CamLaw::cycloidal, 140 * degree, 0, {}},
                                      {CamLaw::dwell, 40 * degree, 0, {}}}});
}

}  // namespace linkwright::planar::test
