// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "linkwright/clearance/four_bar_clearance.h"
#include "support/published.h"

/// Linkages of the reference figures, and those figures.
namespace linkwright::clearance {

inline const Value& reference(std::string_view id) {
  return test::published_case("clearance-joint.json", id);
}
inline const Value& computed(std::string_view id) { return test::at(reference(id), "computed"); }

/// The linkage that the inputs of a case describe.
inline ClearanceFourBar published_four_bar(std::string_view id) {
  const Value& inputs = test::at(reference(id), "inputs");
  const Value& design = test::at(inputs, "design");
  const auto lengths = test::numbers(test::at(design, "L1_L2_L3_L4_m"));
  const double distance = test::number_at(design, "AP_m"), angle = test::number_at(design, "beta_rad");
  ClearanceFourBar model;
  model.linkage = {.ground = lengths.at(0),
                   .crank = lengths.at(1),
                   .coupler = lengths.at(2),
                   .rocker = lengths.at(3),
                   .coupler_u = distance * std::cos(angle),
                   .coupler_v = distance * std::sin(angle),
                   .pivot_x = test::number_at(design, "x0_m"),
                   .pivot_y = test::number_at(design, "y0_m"),
                   .frame_angle = test::number_at(design, "theta1_rad")};
  model.clearance = test::number_at(inputs, "r_m");
  if (inputs.find("mass")) {
    const auto mass = [&](const char* key) { return test::number_at(inputs, std::string("mass.") + key); };
    model.coupler = {mass("m3_kg"), mass("I3_kgm2"), {mass("u3_m"), mass("v3_m")}};
    model.rocker = {mass("m4_kg"), mass("I4_kgm2"), {mass("u4_m"), mass("v4_m")}};
  }
  model.gravity = {0, inputs.find("g_m_s2") ? -test::number_at(inputs, "g_m_s2") : 0};
  return model;
}
inline double crank_speed(std::string_view id) {
  return test::number_at(test::at(reference(id), "inputs"), "crank_speed_rad_s");
}

}  // namespace linkwright::clearance
