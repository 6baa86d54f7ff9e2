#include "linkwright/suspension/wheel/quantities.h"

namespace linkwright::suspension {

std::string_view unit_of(WheelQuantity quantity) {
  using enum WheelQuantity;
  switch (quantity) {
    case toe:
    case camber:
    case carrier_pitch:
    case side_swing_angle:
    case caster_at_height:
    case inclination_at_height:
    case caster_at_spring:
    case inclination_at_spring:
    case front_view_camber:
    case arm_side_swing_angle:
    case caster_at_contact:
    case inclination_at_contact:
    case geometric_caster:
    case geometric_inclination:
      return "rad";
    case contact_x:
    case contact_y:
    case contact_z:
    case track:
    case half_track_change:
    case wheelbase_change:
    case recession:
    case roll_centre_height:
    case roll_centre_height_geometric:
    case front_centre_y:
    case front_centre_z:
    case side_centre_x:
    case side_centre_z:
    case front_swing_arm:
    case side_swing_arm:
    case spring_length:
    case trail_at_height:
    case scrub_at_height:
    case wheel_trail_at_height:
    case wheel_scrub_at_height:
    case caster_offset_at_height:
    case kingpin_offset_at_height:
    case trail_at_spring:
    case scrub_at_spring:
    case wheel_trail_at_spring:
    case wheel_scrub_at_spring:
    case caster_offset_at_spring:
    case kingpin_offset_at_spring:
    case arm_roll_centre_height:
    case arm_front_centre_y:
    case arm_front_centre_z:
    case arm_side_centre_x:
    case arm_side_centre_z:
    case arm_front_swing_arm:
    case arm_side_swing_arm:
    case trail_at_contact:
    case scrub_at_contact:
    case wheel_trail_at_contact:
    case wheel_scrub_at_contact:
    case caster_offset_at_contact:
    case kingpin_offset_at_contact:
    case geometric_trail:
    case geometric_scrub:
    case geometric_wheel_trail:
    case geometric_wheel_scrub:
    case geometric_caster_offset:
    case geometric_kingpin_offset:
      return "m";
    case toe_by_travel:
    case camber_by_travel:
    case toe_by_rack:
      return "rad/m";
    case support_tangent:
    case support_tangent_free:
    case motion_ratio:
      return "1";
    case axis_pitch_at_height:
    case axis_pitch_at_spring:
    case axis_pitch_at_contact:
    case screw_pitch:
      return "m/rad";
  }
  return {};
}

double value_of(const WheelParameters& p, WheelQuantity quantity) {
  using enum WheelQuantity;
  const auto axis = [](const std::optional<SteeringAxis>& at, double SteeringAxis::*member) {
    return at ? (*at).*member : WheelParameters::missing;
  };
  switch (quantity) {
    case toe:
      return p.angles.toe;
    case camber:
      return p.angles.camber;
    case carrier_pitch:
      return p.angles.carrier_pitch;
    case contact_x:
      return p.contact.x;
    case contact_y:
      return p.contact.y;
    case contact_z:
      return p.contact.z;
    case track:
      return p.track;
    case half_track_change:
      return p.half_track_change;
    case wheelbase_change:
      return p.wheelbase_change;
    case recession:
      return p.recession;
    case toe_by_travel:
      return p.toe_by_travel;
    case camber_by_travel:
      return p.camber_by_travel;
    case roll_centre_height:
      return p.roll_centre_height;
    case roll_centre_height_geometric:
      return p.roll_centre_height_geometric;
    case front_centre_y:
      return p.front_centre[0];
    case front_centre_z:
      return p.front_centre[1];
    case side_centre_x:
      return p.side_centre[0];
    case side_centre_z:
      return p.side_centre[1];
    case front_swing_arm:
      return p.front_swing_arm;
    case side_swing_arm:
      return p.side_swing_arm;
    case side_swing_angle:
      return p.side_swing_angle;
    case support_tangent:
      return p.support_tangent;
    case support_tangent_free:
      return p.support_tangent_free;
    case spring_length:
      return p.spring_length;
    case motion_ratio:
      return p.motion_ratio;
    case toe_by_rack:
      return p.toe_by_rack;
    case caster_at_height:
      return axis(p.axis_at_height, &SteeringAxis::caster);
    case inclination_at_height:
      return axis(p.axis_at_height, &SteeringAxis::inclination);
    case trail_at_height:
      return axis(p.axis_at_height, &SteeringAxis::trail);
    case scrub_at_height:
      return axis(p.axis_at_height, &SteeringAxis::scrub);
    case wheel_trail_at_height:
      return axis(p.axis_at_height, &SteeringAxis::wheel_trail);
    case wheel_scrub_at_height:
      return axis(p.axis_at_height, &SteeringAxis::wheel_scrub);
    case caster_offset_at_height:
      return axis(p.axis_at_height, &SteeringAxis::caster_offset);
    case kingpin_offset_at_height:
      return axis(p.axis_at_height, &SteeringAxis::kingpin_offset);
    case axis_pitch_at_height:
      return axis(p.axis_at_height, &SteeringAxis::pitch);
    case caster_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::caster);
    case inclination_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::inclination);
    case trail_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::trail);
    case scrub_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::scrub);
    case wheel_trail_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::wheel_trail);
    case wheel_scrub_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::wheel_scrub);
    case caster_offset_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::caster_offset);
    case kingpin_offset_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::kingpin_offset);
    case axis_pitch_at_spring:
      return axis(p.axis_at_spring, &SteeringAxis::pitch);
    case front_view_camber:
      return p.front_view_camber;
    case screw_pitch:
      return p.screw_pitch;
    case arm_roll_centre_height:
      return p.arms.roll_centre_height;
    case arm_front_centre_y:
      return p.arms.front[0];
    case arm_front_centre_z:
      return p.arms.front[1];
    case arm_side_centre_x:
      return p.arms.side[0];
    case arm_side_centre_z:
      return p.arms.side[1];
    case arm_front_swing_arm:
      return p.arms.front_swing_arm;
    case arm_side_swing_arm:
      return p.arms.side_swing_arm;
    case arm_side_swing_angle:
      return p.arms.side_swing_angle;
    case caster_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::caster);
    case inclination_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::inclination);
    case trail_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::trail);
    case scrub_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::scrub);
    case wheel_trail_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::wheel_trail);
    case wheel_scrub_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::wheel_scrub);
    case caster_offset_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::caster_offset);
    case kingpin_offset_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::kingpin_offset);
    case axis_pitch_at_contact:
      return axis(p.axis_at_contact, &SteeringAxis::pitch);
    case geometric_caster:
      return axis(p.geometric_axis, &SteeringAxis::caster);
    case geometric_inclination:
      return axis(p.geometric_axis, &SteeringAxis::inclination);
    case geometric_trail:
      return axis(p.geometric_axis, &SteeringAxis::trail);
    case geometric_scrub:
      return axis(p.geometric_axis, &SteeringAxis::scrub);
    case geometric_wheel_trail:
      return axis(p.geometric_axis, &SteeringAxis::wheel_trail);
    case geometric_wheel_scrub:
      return axis(p.geometric_axis, &SteeringAxis::wheel_scrub);
    case geometric_caster_offset:
      return axis(p.geometric_axis, &SteeringAxis::caster_offset);
    case geometric_kingpin_offset:
      return axis(p.geometric_axis, &SteeringAxis::kingpin_offset);
  }
  return WheelParameters::missing;
}

bool at_rest(WheelQuantity quantity) {
  return quantity <= WheelQuantity::recession || quantity == WheelQuantity::spring_length ||
         quantity == WheelQuantity::front_view_camber;
}

}  // namespace linkwright::suspension
