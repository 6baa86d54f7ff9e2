// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <string_view>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/balancing/four_bar.h"

namespace linkwright::planar {
namespace {

using C = FourBarComponent;

FourBarBalancing problem(const std::array<Range, four_bar_number_count>& bounds,
                         const std::vector<FourBarComponent>& components) {
  FourBarBalancing out{.bounds = bounds, .crank_speed = 10 * pi};
  for (const FourBarComponent c : components) out.objectives.push_back({.component = c});
  set_references(out, balancing_original());
  return out;
}

PublishedBalancing published(std::string_view name, FourBarBalancing problem, const FourBarNumbers& design) {
  return {name, std::move(problem), four_bar_machine(design)};
}

}  // namespace

FourBarMachine balancing_original() {
  return four_bar_machine(FourBarNumbers{0.1, 0.4, 0.32, 0.6, 0, 0, 0, 0.36, 1.296, 1.046, 0.000413, 0.0187,
                                         0.00985, 0.05, 0.2, 0.16});
}

std::vector<PublishedBalancing> published_balancings() {
  const Range inertia1{2e-4, 6e-3}, inertia2{0.02, 0.07}, angle{0, 2 * pi};
  const std::array<Range, four_bar_number_count> table_2_2 = {{{0.05, 0.13},
                                                               {0.2, 0.6},
                                                               {0.2, 0.5},
                                                               {0.4, 0.7},
                                                               {0, 6},
                                                               {0, 3},
                                                               {1e-5, 2},
                                                               {0, 3},
                                                               {0.8, 1.6},
                                                               {0.5, 1.5},
                                                               inertia1,
                                                               inertia2,
                                                               {0.008, 0.018},
                                                               {0.02, 0.1},
                                                               {0.01, 0.4},
                                                               {0.05, 0.25}}};
  const std::array<Range, four_bar_number_count> table_2_4 = {{{0.08, 0.12},
                                                               {0.32, 0.48},
                                                               {0.256, 0.384},
                                                               {0.48, 0.72},
                                                               angle,
                                                               angle,
                                                               angle,
                                                               {0.01, 3},
                                                               {0.8, 1.6},
                                                               {0.5, 1.5},
                                                               inertia1,
                                                               inertia2,
                                                               {0.008, 0.018},
                                                               {0.001, 0.1},
                                                               {0.001, 0.4},
                                                               {0.001, 0.32}}};
  std::array<Range, four_bar_number_count> table_2_6 = table_2_4;
  table_2_6[index(FourBarNumber::crank)].lower = 0.04;
  table_2_6[index(FourBarNumber::coupler)].upper = 0.68;
  table_2_6[index(FourBarNumber::rocker)].lower = 0.1;
  table_2_6[index(FourBarNumber::coupler_mass)].lower = 0.6;
  table_2_6[index(FourBarNumber::rocker_inertia)].lower = 0.006;
  table_2_6[index(FourBarNumber::rocker_centre_distance)].lower = 0.0005;

  const std::vector<FourBarComponent> joints = {C::O1_x, C::O1_y, C::O2_x, C::O2_y,
                                                C::O3_x, C::O3_y, C::O4_x, C::O4_y};
  std::vector<FourBarComponent> joints_and_torque = joints;
  joints_and_torque.push_back(C::drive_torque);
  const std::vector<FourBarComponent> shaking = {C::shaking_force_x, C::shaking_force_y,
                                                 C::shaking_moment_with_drive};
  const std::vector<FourBarComponent> ground = {
      C::O1_x,           C::O1_y,        C::O4_x, C::O4_y, C::shaking_force_x, C::shaking_force_y,
      C::shaking_moment, C::drive_torque};
  return {published("sp-fa", problem(table_2_2, ground),
                    {0.05476, 0.6, 0.47172, 0.6696, 3.09, 2.89, 0.036, 1, 1.21, 0.5, 0.005301, 0.0242,
                     0.00994, 0.0743, 0.01026, 0.25}),
          published("case1", problem(table_2_4, joints),
                    {0.08, 0.48, 0.256, 0.568, 3.197, 1.799, 2.482, 1.535, 0.8, 0.819, 0.003063, 0.05575,
                     0.008001, 0.048, 0.041, 0.002}),
          published("case2", problem(table_2_4, joints_and_torque),
                    {0.08, 0.48, 0.256, 0.607, 2.982, 0.947, 1.583, 1.721, 0.831, 0.857, 0.00267, 0.02122,
                     0.008002, 0.0535, 0.048, 0.01}),
          published("case3", problem(table_2_4, shaking),
                    {0.08, 0.427, 0.256, 0.557, 3.144, 3.951, 1.984, 1, 1.01, 0.532, 0.004515, 0.02191,
                     0.010101, 0.082, 0.007, 0.001}),
          published("case3x", problem(table_2_6, shaking),
                    {0.064, 0.518, 0.174, 0.584, 3.223, 5.543, 2.876, 1.04, 0.847, 0.56, 0.0023214, 0.0356,
                     0.01632, 0.0527, 0.0804, 0.00057})};
}

PublishedBalancing published_balancing(std::string_view name) {
  for (PublishedBalancing& p : published_balancings())
    if (p.name == name) return std::move(p);
  LINKWRIGHT_REQUIRE(false, "no published balancing is named {}", name);
}

}  // namespace linkwright::planar
