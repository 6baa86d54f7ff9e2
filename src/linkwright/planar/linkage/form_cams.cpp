// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/detail/form_parts.h"

namespace linkwright::planar {
namespace {

// A cam, whose values are lengths or angles as its follower slides or turns.
struct CamReading {
  const CamMemberForm& form;
  FormNames& names;
  bool rotary = false;

  std::optional<double> value(std::string_view key, const FollowerValueForm& v) const {
    if (rotary ? v.length : v.angle)
      names.problem(std::string(key),
                    fmt::format("the follower of cam '{}' {}, and has {} in {}", form.name,
                                rotary ? "turns" : "slides", key, rotary ? "mm" : "deg"),
                    fmt::format("write {}_{}", key, rotary ? "deg" : "mm"));
    return rotary ? v.angle : v.length;
  }
  CamSegment segment(const CamSegmentForm& f) const {
    CamSegment s{.law = f.law, .over = f.over, .to = 0, .conditions = {}};
    const std::optional<double> to = value("to", f.to);
    if (f.law == CamLaw::dwell && to)
      names.problem("segment", fmt::format("a dwell of cam '{}' has an end value", form.name),
                    "a dwell stays where the segment before it ends: leave it out");
    if (f.law != CamLaw::dwell && !to)
      names.problem("segment", fmt::format("a segment of cam '{}' has no end value", form.name),
                    rotary ? "write to_deg = 20" : "write to_mm = 20");
    s.to = to.value_or(0);
    SegmentConditions& c = s.conditions;
    c.start_rate = value("start_rate", f.start_rate);
    c.start_acceleration = value("start_acceleration", f.start_acceleration);
    c.start_jerk = value("start_jerk", f.start_jerk);
    c.end_rate = value("end_rate", f.end_rate);
    c.end_acceleration = value("end_acceleration", f.end_acceleration);
    c.end_jerk = value("end_jerk", f.end_jerk);
    const bool has_conditions = c.start_rate || c.start_acceleration || c.start_jerk || c.end_rate ||
                                c.end_acceleration || c.end_jerk;
    if (f.law != CamLaw::polynomial && has_conditions)
      names.problem("segment", fmt::format("the law '{}' has its own conditions at the ends", name_of(f.law)),
                    "write law = \"polynomial\", or leave them out");
    return s;
  }
  CamProgramme programme() const {
    CamProgramme p{.start = value("start", form.start).value_or(0), .is_sector = form.sector};
    for (const CamSegmentForm& s : form.segments) p.segments.push_back(segment(s));
    if (form.table) {
      const auto& [angles, lengths, turned] = *form.table;
      const auto &values = rotary ? turned : lengths, &others = rotary ? lengths : turned;
      if (!values || others || values->size() != angles.size())
        names.problem(
            "table",
            fmt::format("the table of cam '{}' has {} values for {} angles", form.name,
                        values ? values->size() : 0, angles.size()),
            rotary ? "give one of values_deg for each angle" : "give one of values_mm for each angle");
      p.table = CamTable{angles, values.value_or(std::vector<double>())};
    }
    if (p.segments.empty() && !p.table)
      names.problem("segment", fmt::format("cam '{}' has no programme", form.name),
                    "write [[mechanism.cam.segment]] with law, over_deg and to_mm or to_deg");
    if (!form.sector) return p;
    p.angle = 0;
    for (const CamSegment& s : p.segments) p.angle += s.over;
    if (p.table && !p.table->angles.empty()) p.angle = p.table->angles.back();
    return p;
  }
};

FollowerValueForm value_form(const std::optional<double>& value, bool rotary) {
  FollowerValueForm out;
  (rotary ? out.angle : out.length) = value;
  return out;
}

}  // namespace

LinkageCam cam_of(const Linkage& l, const CamMemberForm& f, FormNames& names) {
  LinkageCam c{.name = f.name,
               .turns = names.joint("turns", f.turns),
               .moves = names.joint("moves", f.moves),
               .contact = names.point("contact", f.contact),
               .face = f.follower,
               .roller_radius = f.roller_radius.value_or(0),
               .base_radius = f.base_radius,
               .face_direction = f.face_direction.value_or(0),
               .form = f.form,
               .is_clockwise = f.sense == Rotation::clockwise,
               .phase = f.phase};
  if (f.form == CamForm::conjugate && !f.second_contact)
    names.problem("second_contact", fmt::format("conjugate cam '{}' has one roller", f.name),
                  "name the centre of the roller that runs on its second disc");
  if (f.form != CamForm::conjugate && (f.second_contact || f.second_roller_radius))
    names.problem("second_contact", fmt::format("cam '{}' is not conjugate, and has a second roller", f.name),
                  "write form = \"conjugate\", or leave the second roller out");
  if (f.second_contact) c.second_contact = names.point("second_contact", *f.second_contact);
  if (f.second_contact) c.second_roller_radius = f.second_roller_radius.value_or(c.roller_radius);
  if (f.roller_radius && f.follower != FollowerFace::roller)
    names.problem("roller_radius", fmt::format("a {} follower has no roller", name_of(f.follower)),
                  "leave the radius out");
  if (f.face_direction && f.follower != FollowerFace::flat)
    names.problem("face_direction", fmt::format("a {} follower has no face", name_of(f.follower)),
                  "leave its direction out");
  if (c.moves < 0) return c;
  const CamReading reading{f, names, l.joints[static_cast<std::size_t>(c.moves)].type == JointType::revolute};
  c.programme = reading.programme();
  return c;
}

CamMemberForm form_of(const LinkageCam& c, const Linkage& l) {
  const auto point = [&l](const BodyPoint& p) {
    const LinkageBody& body = l.bodies[static_cast<std::size_t>(p.body)];
    return body.name + "." + body.points[static_cast<std::size_t>(p.point)].name;
  };
  const bool rotary = l.joints[static_cast<std::size_t>(c.moves)].type == JointType::revolute;
  CamMemberForm f{.name = c.name,
                  .turns = l.joints[static_cast<std::size_t>(c.turns)].name,
                  .moves = l.joints[static_cast<std::size_t>(c.moves)].name,
                  .follower = c.face,
                  .contact = point(c.contact)};
  if (c.form == CamForm::conjugate)
    f.second_contact = point(c.second_contact), f.second_roller_radius = c.second_roller_radius;
  if (c.face == FollowerFace::roller) f.roller_radius = c.roller_radius;
  if (c.face == FollowerFace::flat) f.face_direction = c.face_direction;
  f.base_radius = c.base_radius;
  f.form = c.form;
  f.sense = c.is_clockwise ? Rotation::clockwise : Rotation::counterclockwise;
  f.phase = c.phase;
  f.start = value_form(c.programme.start, rotary);
  f.sector = c.programme.is_sector;
  for (const CamSegment& s : c.programme.segments) {
    const SegmentConditions& e = s.conditions;
    CamSegmentForm& out = f.segments.emplace_back();
    out.law = s.law, out.over = s.over;
    if (s.law != CamLaw::dwell) out.to = value_form(s.to, rotary);
    out.start_rate = value_form(e.start_rate, rotary), out.end_rate = value_form(e.end_rate, rotary);
    out.start_acceleration = value_form(e.start_acceleration, rotary);
    out.end_acceleration = value_form(e.end_acceleration, rotary);
    out.start_jerk = value_form(e.start_jerk, rotary), out.end_jerk = value_form(e.end_jerk, rotary);
  }
  if (const auto& table = c.programme.table) {
    f.table = CamTableForm{table->angles, {}, {}};
    (rotary ? f.table->follower_angles : f.table->lengths) = table->values;
  }
  return f;
}

}  // namespace linkwright::planar
