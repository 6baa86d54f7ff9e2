// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/any_machine_layouts.h"

#include <fmt/core.h>

#include <utility>
#include <vector>

#include "linkwright/planar/type_synthesis/layouts.h"
#include "linkwright/planar/type_synthesis/place.h"

namespace linkwright::planar {

std::optional<Table> layout_table(const std::vector<FoundMachine>& machines, const MotionTarget& target) {
  Table table{.name = "layouts"};
  std::vector<double> number;
  std::vector<MachineLayout> layouts;
  for (std::size_t i = 0; i < machines.size(); ++i)
    for (MachineLayout& layout :
         layouts_of(machines[i].machine, target.stroke, used_part(target, machines[i].machine))) {
      table.names.push_back(fmt::format("machine {}, cognate {}", i + 1,
                                        layout.same_timing ? "of the same timing" : "driven as its coupler"));
      number.push_back(static_cast<double>(i + 1));
      layouts.push_back(std::move(layout));
    }
  if (layouts.empty()) return std::nullopt;
  const auto column = [&](const char* key, const char* label, auto&& value) {
    std::vector<double> values;
    for (const MachineLayout& layout : layouts) values.push_back(value(layout, layout.linkage));
    table.add(key, label, std::move(values));
  };
  using L = const MachineLayout&;
  using F = const FourBar&;
  table.add("machine", "machine of the list that it traces the curve of", std::move(number));
  column("same_timing", "its crank turns as that of the machine: 1; its input turns as the coupler: 0",
         [](L l, F) { return l.same_timing ? 1.0 : 0.0; });
  column("pivot_x_m", "x of the pivot of its input (m)", [](L, F f) { return f.pivot_x; });
  column("pivot_y_m", "y of the pivot of its input (m)", [](L, F f) { return f.pivot_y; });
  column("rocker_pivot_x_m", "x of the pivot of its rocker (m)",
         [](L, F f) { return rocker_pivot(f).real(); });
  column("rocker_pivot_y_m", "y of the pivot of its rocker (m)",
         [](L, F f) { return rocker_pivot(f).imag(); });
  column("ground_m", "length of its ground link (m)", [](L, F f) { return f.ground; });
  column("crank_m", "length of its input (m)", [](L, F f) { return f.crank; });
  column("coupler_m", "length of its coupler (m)", [](L, F f) { return f.coupler; });
  column("rocker_m", "length of its rocker (m)", [](L, F f) { return f.rocker; });
  column("coupler_u_m", "traced point along its coupler (m)", [](L, F f) { return f.coupler_u; });
  column("coupler_v_m", "traced point across its coupler, to the left (m)",
         [](L, F f) { return f.coupler_v; });
  column("crossed", "it begins on the crossed branch: 1, on the open one: 0",
         [](L, F f) { return f.branch == Branch::crossed ? 1.0 : 0.0; });
  column("least_pair_angle_rad",
         target.turns ? "least angle of coupler and rocker over the whole turn (rad)"
                      : "least angle of coupler and rocker over the range of the drive (rad)",
         [](L l, F) { return l.min_pair_angle; });
  column("size_m", "larger side of the box of all pins (m)", [](L l, F) { return l.size; });
  column("largest_deviation_m", "largest distance from the curve of the machine (m)",
         [](L l, F) { return l.apart; });
  return table;
}

}  // namespace linkwright::planar
