// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "linkwright/core/field.h"
#include "linkwright/suspension/wheel/parameters.h"

namespace linkwright::suspension {

/// The numbers of WheelParameters by name, for curves, targets and bands. `_at_height`, `_at_spring` and
/// `_at_contact` say what the steering axis holds; `geometric_` is the line through both ball joints, `arm_`
/// what the planes of the arms make.
enum class WheelQuantity {
  toe,
  camber,
  carrier_pitch,
  contact_x,
  contact_y,
  contact_z,
  track,
  half_track_change,
  wheelbase_change,
  recession,
  toe_by_travel,
  camber_by_travel,
  roll_centre_height,
  roll_centre_height_geometric,
  front_centre_y,
  front_centre_z,
  side_centre_x,
  side_centre_z,
  front_swing_arm,
  side_swing_arm,
  side_swing_angle,
  anti_pitch_tangent,
  anti_pitch_tangent_free,
  spring_length,
  motion_ratio,
  toe_by_rack,
  caster_at_height,
  inclination_at_height,
  trail_at_height,
  scrub_at_height,
  wheel_trail_at_height,
  wheel_scrub_at_height,
  caster_offset_at_height,
  kingpin_offset_at_height,
  axis_pitch_at_height,
  caster_at_spring,
  inclination_at_spring,
  trail_at_spring,
  scrub_at_spring,
  wheel_trail_at_spring,
  wheel_scrub_at_spring,
  caster_offset_at_spring,
  kingpin_offset_at_spring,
  axis_pitch_at_spring,
  front_view_camber,
  screw_pitch,
  arm_roll_centre_height,
  arm_front_centre_y,
  arm_front_centre_z,
  arm_side_centre_x,
  arm_side_centre_z,
  arm_front_swing_arm,
  arm_side_swing_arm,
  arm_side_swing_angle,
  caster_at_contact,
  inclination_at_contact,
  trail_at_contact,
  scrub_at_contact,
  wheel_trail_at_contact,
  wheel_scrub_at_contact,
  caster_offset_at_contact,
  kingpin_offset_at_contact,
  axis_pitch_at_contact,
  geometric_caster,
  geometric_inclination,
  geometric_trail,
  geometric_scrub,
  geometric_wheel_trail,
  geometric_wheel_scrub,
  geometric_caster_offset,
  geometric_kingpin_offset,
};

/// A row of the list of wheel quantities: all that reads, writes, draws or differentiates wheel parameters
/// goes by this list. A further one is a member of the parameters with its line in `for_each_number`, its
/// formula (detail/parameters_kernel.h), its name and row here, and a column (corner_columns.cpp) if tables
/// show it.
struct WheelQuantityRow {
  WheelQuantity quantity;
  std::string_view name, summary;
  std::string_view unit;                      ///< "m", "rad", "rad/m", "m/rad" or "1"
  Extent extent;                              ///< at_rest if a position shows it without motion
  double (*value)(const WheelParameters& p);  ///< NaN where there is no such axis
};

namespace wheel_quantities {
template <double WheelParameters::*member>
double number(const WheelParameters& p) {
  return p.*member;
}
template <std::optional<SteeringAxis> WheelParameters::*axis, double SteeringAxis::*member>
double axis_number(const WheelParameters& p) {
  return p.*axis ? (*(p.*axis)).*member : WheelParameters::missing;
}

using enum WheelQuantity;
inline constexpr std::array rows = std::to_array<WheelQuantityRow>({
    {toe, "toe", "toe angle", "rad", Extent::at_rest, [](const WheelParameters& p) { return p.angles.toe; }},
    {camber, "camber", "camber angle", "rad", Extent::at_rest,
     [](const WheelParameters& p) { return p.angles.camber; }},
    {carrier_pitch, "carrier_pitch", "turn of the carrier about the wheel's axis", "rad", Extent::at_rest,
     [](const WheelParameters& p) { return p.angles.carrier_pitch; }},
    {contact_x, "contact_x", "contact point, forward", "m", Extent::at_rest,
     [](const WheelParameters& p) { return p.contact.x; }},
    {contact_y, "contact_y", "contact point, to the left", "m", Extent::at_rest,
     [](const WheelParameters& p) { return p.contact.y; }},
    {contact_z, "contact_z", "contact point, upward", "m", Extent::at_rest,
     [](const WheelParameters& p) { return p.contact.z; }},
    {track, "track", "track of a symmetric axle", "m", Extent::at_rest, number<&WheelParameters::track>},
    {half_track_change, "half_track_change", "contact point outboard of that at the reference", "m",
     Extent::at_rest, number<&WheelParameters::half_track_change>},
    {wheelbase_change, "wheelbase_change", "contact point forward of that at the reference", "m",
     Extent::at_rest, number<&WheelParameters::wheelbase_change>},
    {recession, "recession", "wheel centre rearward of that at the reference", "m", Extent::at_rest,
     number<&WheelParameters::recession>},
    {toe_by_travel, "toe_by_travel", "bump steer", "rad/m", Extent::all,
     number<&WheelParameters::toe_by_travel>},
    {camber_by_travel, "camber_by_travel", "camber gain", "rad/m", Extent::all,
     number<&WheelParameters::camber_by_travel>},
    {roll_centre_height, "roll_centre_height", "roll centre above the ground, wheel held by the carrier", "m",
     Extent::all, number<&WheelParameters::roll_centre_height>},
    {roll_centre_height_geometric, "roll_centre_height_geometric", "the same by the contact point's own path",
     "m", Extent::all, number<&WheelParameters::roll_centre_height_geometric>},
    {front_centre_y, "front_centre_y", "instant centre seen from the front", "m", Extent::all,
     [](const WheelParameters& p) { return p.front_centre[0]; }},
    {front_centre_z, "front_centre_z", "its height", "m", Extent::all,
     [](const WheelParameters& p) { return p.front_centre[1]; }},
    {side_centre_x, "side_centre_x", "instant centre seen from the side", "m", Extent::all,
     [](const WheelParameters& p) { return p.side_centre[0]; }},
    {side_centre_z, "side_centre_z", "its height", "m", Extent::all,
     [](const WheelParameters& p) { return p.side_centre[1]; }},
    {front_swing_arm, "front_swing_arm", "from the contact point to the front centre", "m", Extent::all,
     number<&WheelParameters::front_swing_arm>},
    {side_swing_arm, "side_swing_arm", "from the contact point to the side centre", "m", Extent::all,
     number<&WheelParameters::side_swing_arm>},
    {side_swing_angle, "side_swing_angle", "of that arm above the ground", "rad", Extent::all,
     number<&WheelParameters::side_swing_angle>},
    {anti_pitch_tangent, "anti_pitch_tangent",
     "forward per upward motion at the contact, wheel held by the carrier", "1", Extent::all,
     number<&WheelParameters::anti_pitch_tangent>},
    {anti_pitch_tangent_free, "anti_pitch_tangent_free", "the same, wheel free to turn", "1", Extent::all,
     number<&WheelParameters::anti_pitch_tangent_free>},
    {spring_length, "spring_length", "length of the spring", "m", Extent::at_rest,
     number<&WheelParameters::spring_length>},
    {motion_ratio, "motion_ratio", "compression of the spring per wheel-centre height", "1", Extent::all,
     number<&WheelParameters::motion_ratio>},
    {toe_by_rack, "toe_by_rack", "toe per rack displacement", "rad/m", Extent::all,
     number<&WheelParameters::toe_by_rack>},
    {caster_at_height, "caster_at_height", "caster, wheel-centre height held", "rad", Extent::all,
     axis_number<&WheelParameters::axis_at_height, &SteeringAxis::caster>},
    {inclination_at_height, "inclination_at_height", "steering-axis inclination, wheel-centre height held",
     "rad", Extent::all, axis_number<&WheelParameters::axis_at_height, &SteeringAxis::inclination>},
    {trail_at_height, "trail_at_height", "trail along x, wheel-centre height held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_height, &SteeringAxis::trail>},
    {scrub_at_height, "scrub_at_height", "scrub along y, wheel-centre height held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_height, &SteeringAxis::scrub>},
    {wheel_trail_at_height, "wheel_trail_at_height", "trail along the wheel, wheel-centre height held", "m",
     Extent::all, axis_number<&WheelParameters::axis_at_height, &SteeringAxis::wheel_trail>},
    {wheel_scrub_at_height, "wheel_scrub_at_height", "scrub across the wheel, wheel-centre height held", "m",
     Extent::all, axis_number<&WheelParameters::axis_at_height, &SteeringAxis::wheel_scrub>},
    {caster_offset_at_height, "caster_offset_at_height",
     "axis ahead of the wheel centre, wheel-centre height held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_height, &SteeringAxis::caster_offset>},
    {kingpin_offset_at_height, "kingpin_offset_at_height",
     "axis inboard of the wheel centre, wheel-centre height held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_height, &SteeringAxis::kingpin_offset>},
    {axis_pitch_at_height, "axis_pitch_at_height", "pitch of the steering screw, wheel-centre height held",
     "m/rad", Extent::all, axis_number<&WheelParameters::axis_at_height, &SteeringAxis::pitch>},
    {caster_at_spring, "caster_at_spring", "caster, spring held", "rad", Extent::all,
     axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::caster>},
    {inclination_at_spring, "inclination_at_spring", "steering-axis inclination, spring held", "rad",
     Extent::all, axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::inclination>},
    {trail_at_spring, "trail_at_spring", "trail along x, spring held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::trail>},
    {scrub_at_spring, "scrub_at_spring", "scrub along y, spring held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::scrub>},
    {wheel_trail_at_spring, "wheel_trail_at_spring", "trail along the wheel, spring held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::wheel_trail>},
    {wheel_scrub_at_spring, "wheel_scrub_at_spring", "scrub across the wheel, spring held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::wheel_scrub>},
    {caster_offset_at_spring, "caster_offset_at_spring", "axis ahead of the wheel centre, spring held", "m",
     Extent::all, axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::caster_offset>},
    {kingpin_offset_at_spring, "kingpin_offset_at_spring", "axis inboard of the wheel centre, spring held",
     "m", Extent::all, axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::kingpin_offset>},
    {axis_pitch_at_spring, "axis_pitch_at_spring", "pitch of the steering screw, spring held", "m/rad",
     Extent::all, axis_number<&WheelParameters::axis_at_spring, &SteeringAxis::pitch>},
    {front_view_camber, "front_view_camber", "camber as the front view shows it", "rad", Extent::at_rest,
     number<&WheelParameters::front_view_camber>},
    {screw_pitch, "screw_pitch", "pitch of the carrier's screw by travel", "m/rad", Extent::all,
     number<&WheelParameters::screw_pitch>},
    {arm_roll_centre_height, "arm_roll_centre_height",
     "roll centre above the ground, by the planes of the arms", "m", Extent::all,
     [](const WheelParameters& p) { return p.arms.roll_centre_height; }},
    {arm_front_centre_y, "arm_front_centre_y",
     "instant centre seen from the front, by the planes of the arms", "m", Extent::all,
     [](const WheelParameters& p) { return p.arms.front[0]; }},
    {arm_front_centre_z, "arm_front_centre_z", "its height", "m", Extent::all,
     [](const WheelParameters& p) { return p.arms.front[1]; }},
    {arm_side_centre_x, "arm_side_centre_x", "instant centre seen from the side, by the planes of the arms",
     "m", Extent::all, [](const WheelParameters& p) { return p.arms.side[0]; }},
    {arm_side_centre_z, "arm_side_centre_z", "its height", "m", Extent::all,
     [](const WheelParameters& p) { return p.arms.side[1]; }},
    {arm_front_swing_arm, "arm_front_swing_arm", "from the contact point to that front centre", "m",
     Extent::all, [](const WheelParameters& p) { return p.arms.front_swing_arm; }},
    {arm_side_swing_arm, "arm_side_swing_arm", "from the contact point to that side centre", "m", Extent::all,
     [](const WheelParameters& p) { return p.arms.side_swing_arm; }},
    {arm_side_swing_angle, "arm_side_swing_angle", "of that arm above the ground", "rad", Extent::all,
     [](const WheelParameters& p) { return p.arms.side_swing_angle; }},
    {caster_at_contact, "caster_at_contact", "caster, contact height held", "rad", Extent::all,
     axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::caster>},
    {inclination_at_contact, "inclination_at_contact", "steering-axis inclination, contact height held",
     "rad", Extent::all, axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::inclination>},
    {trail_at_contact, "trail_at_contact", "trail along x, contact height held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::trail>},
    {scrub_at_contact, "scrub_at_contact", "scrub along y, contact height held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::scrub>},
    {wheel_trail_at_contact, "wheel_trail_at_contact", "trail along the wheel, contact height held", "m",
     Extent::all, axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::wheel_trail>},
    {wheel_scrub_at_contact, "wheel_scrub_at_contact", "scrub across the wheel, contact height held", "m",
     Extent::all, axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::wheel_scrub>},
    {caster_offset_at_contact, "caster_offset_at_contact",
     "axis ahead of the wheel centre, contact height held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::caster_offset>},
    {kingpin_offset_at_contact, "kingpin_offset_at_contact",
     "axis inboard of the wheel centre, contact height held", "m", Extent::all,
     axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::kingpin_offset>},
    {axis_pitch_at_contact, "axis_pitch_at_contact", "pitch of the steering screw, contact height held",
     "m/rad", Extent::all, axis_number<&WheelParameters::axis_at_contact, &SteeringAxis::pitch>},
    {geometric_caster, "geometric_caster", "caster, line through both ball joints", "rad", Extent::all,
     axis_number<&WheelParameters::geometric_axis, &SteeringAxis::caster>},
    {geometric_inclination, "geometric_inclination",
     "steering-axis inclination, line through both ball joints", "rad", Extent::all,
     axis_number<&WheelParameters::geometric_axis, &SteeringAxis::inclination>},
    {geometric_trail, "geometric_trail", "trail along x, line through both ball joints", "m", Extent::all,
     axis_number<&WheelParameters::geometric_axis, &SteeringAxis::trail>},
    {geometric_scrub, "geometric_scrub", "scrub along y, line through both ball joints", "m", Extent::all,
     axis_number<&WheelParameters::geometric_axis, &SteeringAxis::scrub>},
    {geometric_wheel_trail, "geometric_wheel_trail", "trail along the wheel, line through both ball joints",
     "m", Extent::all, axis_number<&WheelParameters::geometric_axis, &SteeringAxis::wheel_trail>},
    {geometric_wheel_scrub, "geometric_wheel_scrub", "scrub across the wheel, line through both ball joints",
     "m", Extent::all, axis_number<&WheelParameters::geometric_axis, &SteeringAxis::wheel_scrub>},
    {geometric_caster_offset, "geometric_caster_offset",
     "axis ahead of the wheel centre, line through both ball joints", "m", Extent::all,
     axis_number<&WheelParameters::geometric_axis, &SteeringAxis::caster_offset>},
    {geometric_kingpin_offset, "geometric_kingpin_offset",
     "axis inboard of the wheel centre, line through both ball joints", "m", Extent::all,
     axis_number<&WheelParameters::geometric_axis, &SteeringAxis::kingpin_offset>},
});
}  // namespace wheel_quantities

/// All of them, in the order of the enumeration.
constexpr const WheelQuantityRow& row_of(WheelQuantity quantity) {
  return wheel_quantities::rows[static_cast<std::size_t>(quantity)];
}
constexpr auto names(WheelQuantity) {
  std::array<EnumName<WheelQuantity>, wheel_quantities::rows.size()> out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const WheelQuantityRow& row = wheel_quantities::rows[i];
    out[i] = {row.quantity, row.name, row.summary};
  }
  return out;
}
static_assert([] {
  for (std::size_t i = 0; i < wheel_quantities::rows.size(); ++i)
    if (wheel_quantities::rows[i].quantity != static_cast<WheelQuantity>(i)) return false;
  return true;
}());

/// The number of a set of parameters, or of derivatives of one; NaN where there is no such axis.
inline double value_of(const WheelParameters& parameters, WheelQuantity quantity) {
  return row_of(quantity).value(parameters);
}

}  // namespace linkwright::suspension
