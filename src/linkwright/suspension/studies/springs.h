// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/study/kind.h"
#include "linkwright/suspension/studies/axle.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/wheel/derivatives.h"

// Springs, dampers, bars and stops as they act at the wheel over its travel, and the ride that follows.
namespace linkwright::suspension {

/// `[ride]`: mass and tyre of the corner.
struct RideForm {
  Driver coordinate = Driver::wheel_centre_z;
  std::optional<double> sprung_mass, tyre_stiffness;
  std::optional<std::vector<double>> wheel_speeds;
};
template <class Visitor>
void fields(Visitor&& visit, RideForm& r) {
  visit(field::entry("coordinate", "height of the wheel that ratios and rates refer to, not the spring"),
        r.coordinate);
  visit(field::mass("sprung_mass", "that this corner carries").positive(), r.sprung_mass);
  visit(field::stiffness("tyre_stiffness", "vertical, of the tyre").positive(), r.tyre_stiffness);
  visit(field::speed("wheel_speeds",
                     "speeds of the wheel against the body for the damping, > 0 upwards; default: those at "
                     "which a damper with a curve has the speeds of its points")
            .between(-100, 100),
        r.wheel_speeds);
}

/// Reports what `[ride]` lacks.
void check_ride(study::ObjectReader& document, const RideForm& ride, const CornerDescription& description);

/// Number of columns that `add_springs` makes at most.
inline constexpr double spring_columns = 40;

/// True if the suspension has anything that `add_springs` reports.
bool has_springs(const CornerDescription& description);

/// Columns of the first table, whose rows are `positions`, with diagrams; facts about the row `stated`, if
/// there is one, the roll rates of a symmetric axle among them. Rows without a position, and those after an
/// interruption, have no values.
void add_springs(study::Result& result, const CornerDescription& description, const RideForm& ride,
                 std::span<const CornerPosition> positions, std::optional<std::size_t> stated,
                 bool symmetric_axle, const RunContext& context);

/// The table `opposite`: both wheels of the axle, the left one at these travels (m) by the
/// coordinate of `ride`, the right one at the opposite ones; what their springs and the anti-roll bar between
/// them do.
void add_opposite_travel(study::Result& result, const AxleDescription& both, const RideForm& ride,
                         std::span<const double> travels, const RunContext& context);

}  // namespace linkwright::suspension
