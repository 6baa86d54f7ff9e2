// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <complex>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/planar/dyads/dyad.h"
#include "support/published.h"

namespace linkwright::planar::test {

using Complex = std::complex<double>;

inline const Value& synthesis_case(std::string_view id) {
  return linkwright::test::published_case("motion-function-synthesis.json", id);
}

inline Complex complex_at(const Value& value, std::string_view key) {
  const auto& parts = linkwright::test::at(value, key).as_array();
  return {parts[0].as_number(), parts[1].as_number()};
}

inline std::vector<BodyPose> poses_of(const Value& list) {
  std::vector<BodyPose> out;
  for (const Value& pose : list.as_array())
    out.push_back({{linkwright::test::number_at(pose, "x_m"), linkwright::test::number_at(pose, "y_m")},
                   linkwright::test::number_at(pose, "angle_rad")});
  return out;
}
inline std::vector<BodyPose> stored_poses(std::string_view id) {
  return poses_of(linkwright::test::at(synthesis_case(id), "inputs.poses"));
}

/// A dyad as the published cases list it.
inline GuidingDyad listed_dyad(const Value& value) {
  GuidingDyad out;
  const std::string type = linkwright::test::at(value, "type").as_string();
  out.type = type == "RR" ? GuidingDyadType::rr : type == "PR" ? GuidingDyadType::pr : GuidingDyadType::rp;
  if (value.find("fixed_pivot_m")) out.fixed = complex_at(value, "fixed_pivot_m");
  if (value.find("moving_pivot_in_body_m")) out.moving = complex_at(value, "moving_pivot_in_body_m");
  if (value.find("length_m")) out.length = linkwright::test::number_at(value, "length_m");
  if (value.find("line_normal")) out.normal = complex_at(value, "line_normal");
  if (value.find("line_normal_in_body")) out.normal = complex_at(value, "line_normal_in_body");
  if (value.find("line_offset_m")) out.offset = linkwright::test::number_at(value, "line_offset_m");
  return out;
}

/// The distance of two dyads of one type, relative to their size; a line has two normals.
inline double apart(const GuidingDyad& a, const GuidingDyad& b) {
  if (a.type != b.type) return infinity;
  const double size = 1 + std::abs(a.fixed) + std::abs(a.moving) + a.length;
  const double line = std::min(std::abs(a.normal - b.normal) + std::abs(a.offset - b.offset),
                               std::abs(a.normal + b.normal) + std::abs(a.offset + b.offset));
  return (std::abs(a.fixed - b.fixed) + std::abs(a.moving - b.moving) + std::abs(a.length - b.length) +
          line) /
         size;
}

/// The index of the dyad next to `wanted`, and how far it is.
struct Nearest {
  int index = -1;
  double distance = infinity;
};
template <class GuidingDyads>
Nearest nearest(const GuidingDyads& dyads, const GuidingDyad& wanted) {
  Nearest out;
  int k = 0;
  for (const GuidingDyad& dyad : dyads) {
    if (apart(wanted, dyad) < out.distance) out = {k, apart(wanted, dyad)};
    ++k;
  }
  return out;
}

/// Places normally distributed, rotations anywhere.
inline std::vector<BodyPose> random_poses(int count, std::uint32_t individual) {
  RandomStream random({.seed = 20260101, .individual = individual});
  std::vector<BodyPose> out;
  for (int j = 0; j < count; ++j) {
    const double x = random.normal(), y = random.normal();
    out.push_back({{x, y}, random.uniform(-pi, pi)});
  }
  return out;
}

}  // namespace linkwright::planar::test
