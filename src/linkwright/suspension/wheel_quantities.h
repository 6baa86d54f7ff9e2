#pragma once

#include <array>
#include <string_view>

#include "linkwright/core/field.h"
#include "linkwright/suspension/wheel_parameters.h"

namespace linkwright::suspension {

/// The numbers of WheelParameters by name, for curves, targets and bands. `_at_height` and `_at_spring` say
/// what the steering axis holds.
enum class WheelQuantity {
  toe,
  camber,
  spin,
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
  support_tangent,
  support_tangent_free,
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
};
constexpr std::array<EnumName<WheelQuantity>, 44> names(WheelQuantity) {
  using enum WheelQuantity;
  return {
      {{toe, "toe", "toe angle"},
       {camber, "camber", "camber angle"},
       {spin, "spin", "turn of the carrier about the wheel's axis"},
       {contact_x, "contact_x", "contact point, forward"},
       {contact_y, "contact_y", "contact point, to the left"},
       {contact_z, "contact_z", "contact point, upward"},
       {track, "track", "track of a symmetric axle"},
       {half_track_change, "half_track_change", "contact point outboard of that at the reference"},
       {wheelbase_change, "wheelbase_change", "contact point forward of that at the reference"},
       {recession, "recession", "wheel centre forward of that at the reference"},
       {toe_by_travel, "toe_by_travel", "bump steer"},
       {camber_by_travel, "camber_by_travel", "camber gain"},
       {roll_centre_height, "roll_centre_height", "roll centre above the ground, wheel held by the carrier"},
       {roll_centre_height_geometric, "roll_centre_height_geometric",
        "the same by the contact point's own path"},
       {front_centre_y, "front_centre_y", "instant centre seen from the front"},
       {front_centre_z, "front_centre_z", "its height"},
       {side_centre_x, "side_centre_x", "instant centre seen from the side"},
       {side_centre_z, "side_centre_z", "its height"},
       {front_swing_arm, "front_swing_arm", "from the contact point to the front centre"},
       {side_swing_arm, "side_swing_arm", "from the contact point to the side centre"},
       {side_swing_angle, "side_swing_angle", "of that arm above the ground"},
       {support_tangent, "support_tangent",
        "forward per upward motion at the contact, wheel held by the carrier"},
       {support_tangent_free, "support_tangent_free", "the same, wheel free to turn"},
       {spring_length, "spring_length", "length of the spring"},
       {motion_ratio, "motion_ratio", "compression of the spring per wheel-centre height"},
       {toe_by_rack, "toe_by_rack", "toe per rack displacement"},
       {caster_at_height, "caster_at_height", "caster, wheel-centre height held"},
       {inclination_at_height, "inclination_at_height",
        "steering-axis inclination, wheel-centre height held"},
       {trail_at_height, "trail_at_height", "trail along x, wheel-centre height held"},
       {scrub_at_height, "scrub_at_height", "scrub along y, wheel-centre height held"},
       {wheel_trail_at_height, "wheel_trail_at_height", "trail along the wheel, wheel-centre height held"},
       {wheel_scrub_at_height, "wheel_scrub_at_height", "scrub across the wheel, wheel-centre height held"},
       {caster_offset_at_height, "caster_offset_at_height",
        "axis ahead of the wheel centre, wheel-centre height held"},
       {kingpin_offset_at_height, "kingpin_offset_at_height",
        "axis inboard of the wheel centre, wheel-centre height held"},
       {axis_pitch_at_height, "axis_pitch_at_height",
        "pitch of the steering screw, wheel-centre height held"},
       {caster_at_spring, "caster_at_spring", "caster, spring held"},
       {inclination_at_spring, "inclination_at_spring", "steering-axis inclination, spring held"},
       {trail_at_spring, "trail_at_spring", "trail along x, spring held"},
       {scrub_at_spring, "scrub_at_spring", "scrub along y, spring held"},
       {wheel_trail_at_spring, "wheel_trail_at_spring", "trail along the wheel, spring held"},
       {wheel_scrub_at_spring, "wheel_scrub_at_spring", "scrub across the wheel, spring held"},
       {caster_offset_at_spring, "caster_offset_at_spring", "axis ahead of the wheel centre, spring held"},
       {kingpin_offset_at_spring, "kingpin_offset_at_spring",
        "axis inboard of the wheel centre, spring held"},
       {axis_pitch_at_spring, "axis_pitch_at_spring", "pitch of the steering screw, spring held"}}};
}

/// "m", "rad", "rad/m", "m/rad" or "1".
std::string_view unit_of(WheelQuantity quantity);

/// The number of a set of parameters, or of derivatives of one; NaN where there is no such axis.
double value_of(const WheelParameters& parameters, WheelQuantity quantity);

/// Whether it is one that a position shows without motion, see Extent::at_rest.
bool at_rest(WheelQuantity quantity);

}  // namespace linkwright::suspension
