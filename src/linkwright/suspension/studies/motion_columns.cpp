// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/motion_columns.h"

#include <algorithm>
#include <array>

#include "linkwright/core/units.h"
#include "linkwright/suspension/corner/position.h"

namespace linkwright::suspension {
namespace {

constexpr std::array springs_and_bars{
    CornerColumn{"wheel_rate_N_per_m", "wheel rate (N/m)", "wheel_rate", {}, {}, {}},
    CornerColumn{"wheel_force_N", "force of the spring at the wheel centre (N)", "wheel_force", {}, {}, {}},
    CornerColumn{"spring_force_N", "force of the spring (N)", "spring_force", {}, {}, {}},
    CornerColumn{"motion_ratio_by_travel", "motion ratio by travel (1/m)", "progression", {}, {}, {}},
    CornerColumn{"damper_length_by_travel", "damper length by travel", "damper_ratio", {}, {}, {}},
    CornerColumn{"wheel_damping_N_s_per_m", "damping at the wheel centre (N s/m)", "damping", {}, {}, {}},
    CornerColumn{"anti_roll_bar_wheel_rate_N_per_m",
                 "rate of the anti-roll bar at each wheel, opposite travel (N/m)",
                 "bar",
                 {},
                 {},
                 {}},
    CornerColumn{
        "torsion_bar_wheel_rate_N_per_m", "wheel rate of the torsion bar (N/m)", "torsion_bar", {}, {}, {}},
};

std::optional<MotionQuantity> of_spring(const CornerDescription& d, MotionMeasure measure, std::string& why) {
  if (!d.spring) {
    why = d.suspension.spring ? "the stiffness of the spring is not known" : "there is no spring";
    return std::nullopt;
  }
  return MotionQuantity{.measure = measure, .law = *d.spring};
}

/// The damper, or the spring that it is in line with.
std::optional<MotionQuantity> of_damper(const CornerDescription& d, MotionMeasure measure, std::string& why) {
  const auto& damper = d.springs.damper;
  if (!damper) why = "there is no damper";
  if (damper && measure == MotionMeasure::ratio_squared && !damper->damping)
    why = "the damper has no damping that is one number";
  if (!why.empty()) return std::nullopt;
  MotionQuantity out{.measure = measure};
  if (measure == MotionMeasure::ratio_squared) out.factor = *damper->damping;
  if (damper->element) {
    out.part = MotionPart::element;
    out.index = *damper->element;
  }
  return out;
}

std::optional<MotionQuantity> of_bar(const CornerDescription& d, std::string& why) {
  const auto& bar = d.springs.anti_roll_bar;
  if (!bar) why = "there is no anti-roll bar";
  if (bar && bar->post_top) why = "it is one of U bars, and the bar is a T";
  if (!why.empty()) return std::nullopt;
  return MotionQuantity{.part = MotionPart::rocker,
                        .index = bar->rocker,
                        .measure = MotionMeasure::ratio_squared,
                        .factor = 2 * bar->stiffness};
}

/// A torsion bar winds up as the wheel rises from the reference.
std::optional<MotionQuantity> of_torsion_bar(const CornerDescription& d, std::string& why) {
  const auto& bar = d.springs.torsion_bar;
  if (!bar) {
    why = "there is no torsion bar";
    return std::nullopt;
  }
  const MotionPlan plan = prepare_motions(d.suspension, {});
  const CornerPosition reference = reference_position(plan.plan);
  const bool backwards = reference.status == Status::done &&
                         motion_derivatives(plan, reference).motions.elements.at(bar->element).ratio < 0;
  return MotionQuantity{.part = MotionPart::element,
                        .index = bar->element,
                        .measure = MotionMeasure::wheel_rate,
                        .factor = backwards ? 1.0 : -1.0,
                        .law = bar->law};
}

}  // namespace

std::span<const CornerColumn> motion_columns() { return springs_and_bars; }

const CornerColumn* motion_column(std::string_view base) {
  const auto at = std::find_if(springs_and_bars.begin(), springs_and_bars.end(), [&](const CornerColumn& c) {
    const auto parts = split_unit(c.key);
    return base == (parts ? parts->base : c.key);
  });
  return at == springs_and_bars.end() ? nullptr : &*at;
}

std::optional<MotionQuantity> motion_quantity(const CornerDescription& d, const CornerColumn& column,
                                              std::string& why) {
  const std::string_view group = column.group;
  if (group == "wheel_rate") return of_spring(d, MotionMeasure::wheel_rate, why);
  if (group == "wheel_force") return of_spring(d, MotionMeasure::wheel_force, why);
  if (group == "spring_force") return of_spring(d, MotionMeasure::spring_force, why);
  if (group == "damper_ratio") return of_damper(d, MotionMeasure::ratio, why);
  if (group == "damping") return of_damper(d, MotionMeasure::ratio_squared, why);
  if (group == "bar") return of_bar(d, why);
  if (group == "torsion_bar") return of_torsion_bar(d, why);
  if (!d.suspension.spring) {
    why = "there is no spring";
    return std::nullopt;
  }
  return MotionQuantity{.measure = MotionMeasure::ratio_by_travel, .factor = -1};
}

}  // namespace linkwright::suspension
