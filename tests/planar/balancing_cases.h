// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "linkwright/planar/balancing/four_bar.h"
#include "planar/reactions_cases.h"

namespace linkwright::test {}
namespace linkwright::planar::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// Keys of the sixteen numbers in the reference file, in the order of FourBarNumber.
inline constexpr std::array<std::string_view, four_bar_number_count> design_keys = {
    "L1_m",  "L2_m",  "L3_m",       "L4_m",       "alpha1_rad", "alpha2_rad", "alpha3_rad", "m1_kg",
    "m2_kg", "m3_kg", "J_C1_kg_m2", "J_C2_kg_m2", "J_C3_kg_m2", "d1_m",       "d2_m",       "d3_m"};

inline FourBarNumbers numbers_of(const Value& design) {
  FourBarNumbers out;
  for (std::size_t j = 0; j < out.size(); ++j) out[j] = number_at(design, design_keys[j]);
  return out;
}
inline FourBarMachine machine_of(const Value& design) { return four_bar_machine(numbers_of(design)); }

/// Component of a quantity of the reference file.
inline FourBarComponent component(std::string_view quantity) {
  using C = FourBarComponent;
  constexpr std::array<FourBarComponent, 13> components = {C::O1_x,
                                                           C::O1_y,
                                                           C::O2_x,
                                                           C::O2_y,
                                                           C::O3_x,
                                                           C::O3_y,
                                                           C::O4_x,
                                                           C::O4_y,
                                                           C::drive_torque,
                                                           C::shaking_force_x,
                                                           C::shaking_force_y,
                                                           C::shaking_moment_with_drive,
                                                           C::shaking_moment};
  for (std::size_t q = 0; q < components.size(); ++q)
    if (quantity_names[q] == quantity) return components[q];
  throw std::runtime_error(fmt::format("no component {}", quantity));
}

}  // namespace linkwright::planar::test
