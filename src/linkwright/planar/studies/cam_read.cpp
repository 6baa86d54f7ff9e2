// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/math/angles.h"
#include "linkwright/planar/cam/detail/finding_words.h"
#include "linkwright/planar/studies/cam.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {

// Field lists of the values of the library, found by the namespace of these.
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, CamProgramme& p) {
  visit(drive_field(rotary, 0, "start", "value of the programme at its start, from the base circle"),
        p.start);
}
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, CamSegment& s) {
  const auto end = [&](std::string_view key, std::string_view summary, std::optional<double>& value) {
    visit(drive_field(rotary, 0, key, summary), value);
  };
  visit(drive_field(rotary, 0, "to", "value at the end, from the base circle; a dwell takes none"), s.to);
  end("start_rate", "polynomial: first derivative at the start, by radian of the cam",
      s.conditions.start_rate);
  end("start_acceleration", "polynomial: second derivative at the start, by radian of the cam squared",
      s.conditions.start_acceleration);
  end("start_jerk", "polynomial: third derivative at the start, by radian of the cam cubed",
      s.conditions.start_jerk);
  end("end_rate", "polynomial: first derivative at the end", s.conditions.end_rate);
  end("end_acceleration", "polynomial: second derivative at the end", s.conditions.end_acceleration);
  end("end_jerk", "polynomial: third derivative at the end", s.conditions.end_jerk);
}
template <class Visitor>
void fields(Visitor&& visit, CamLimits& l) {
  const double most = 1.5;
  visit(field::angle("pressure_angle", "largest pressure angle while the follower rises")
            .above(0)
            .at_most(most),
        l.pressure_angle);
  visit(field::angle("pressure_angle_return",
                     "largest pressure angle while it returns; default: that of the rise")
            .above(0)
            .at_most(most),
        l.pressure_angle_return);
  visit(
      field::length("radius_of_curvature", "least radius of the convex parts of the profile").not_negative(),
      l.radius);
}

template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, FollowerLoad& l) {
  visit(rotary ? field::inertia("inertia", "of the oscillating follower about its pivot").not_negative()
               : field::mass("mass", "of the translating follower and what moves with it").not_negative(),
        l.inertia);
  visit(rotary ? field::stiffness_angular("spring", "stiffness of the spring about the pivot").not_negative()
               : field::stiffness("spring", "stiffness of the spring along the guide").not_negative(),
        l.stiffness);
  visit(rotary ? field::torque("preload", "torque of the spring where the programme is 0")
               : field::force("preload", "force of the spring where the programme is 0"),
        l.preload);
  visit(rotary ? field::torque("load", "constant torque towards the cam")
               : field::force("load", "constant force towards the cam, such as the weight of the follower"),
        l.load);
}
namespace {

constexpr Field base_radius_field =
    field::length("base_radius", "of the profile about the cam's centre, where the programme is 0")
        .positive();
constexpr Field offset_field =
    field::length("offset", "x of the guide of a translating follower; of a flat face x of its middle");

// `[mechanism]` but for what depends on the kind of study and on the motion of the follower.
struct CamMechanism {
  FollowerMotion motion = FollowerMotion::translating;
  FollowerFace follower = FollowerFace::roller;
  Rotation sense = Rotation::counterclockwise;
  std::optional<double> roller_radius, pivot, arm, face_offset, cutter_radius;
  bool sector = false;
};
template <class Visitor>
void fields(Visitor&& visit, CamMechanism& m) {
  visit(field::entry("motion", "motion of the follower"), m.motion);
  visit(field::entry("follower", "part of the follower that touches the cam"), m.follower);
  visit(field::entry("sense", "sense in which the cam turns; the follower lies above the cam"), m.sense);
  visit(field::length("roller_radius", "of a roller").positive(), m.roller_radius);
  visit(field::length("pivot", "oscillating follower: x of its pivot, to the right of the cam's centre")
            .positive(),
        m.pivot);
  visit(field::length("arm", "oscillating roller or knife: distance from the pivot to its centre or tip")
            .positive(),
        m.arm);
  visit(field::length("face_offset",
                      "oscillating flat face: its distance from the pivot, positive away from the cam"),
        m.face_offset);
  visit(field::length("cutter_radius", "of the cutter or grinding wheel whose path is computed").positive(),
        m.cutter_radius);
  visit(field::entry("sector", "true if the cam swings back and forth over its segments instead of turning"),
        m.sector);
}

constexpr Field law_field = field::entry("law", "law of the motion in the segment").required();
constexpr Field over_field = field::angle("over", "angle of the cam in the segment").positive().required();

constexpr Field table_angles = field::angle("angles", "angles of the cam, from 0 to a full turn").required();
Field table_values(bool rotary) {
  return drive_field(rotary, 0, "values", "values of the programme at these angles", true);
}

constexpr Field speed_field = field::speed_angular("speed", "of the cam").not_negative().required();

std::string degrees_text(double angle) { return fmt::format("{:.6g}°", math::degrees(angle)); }

// Keys that the chosen follower needs, and those that it does not have.
void check_dimensions(study::ObjectReader& reader, const CamMechanism& m, bool has_offset) {
  const bool is_roller = m.follower == FollowerFace::roller, is_flat = m.follower == FollowerFace::flat,
             is_oscillating = m.motion == FollowerMotion::oscillating;
  const auto needs = [&](bool needed, const std::optional<double>& value, std::string_view key,
                         std::string_view example) {
    const Field field = field::length(key);
    if (needed && !value && !reader.has(field))
      reader.missing(field, fmt::format("write {} for {} follower", example,
                                        is_oscillating ? "an oscillating" : "a translating"));
    if (!needed && value)
      reader.error(key,
                   fmt::format("a{} {} follower has no {}", is_oscillating ? "n oscillating" : " translating",
                               name_of(m.follower), key),
                   "leave the key out");
  };
  needs(is_roller, m.roller_radius, "roller_radius", "roller_radius_mm = 10");
  needs(is_oscillating, m.pivot, "pivot", "pivot_mm = 80");
  needs(is_oscillating && !is_flat, m.arm, "arm", "arm_mm = 65");
  if (m.face_offset) needs(is_oscillating && is_flat, m.face_offset, "face_offset", "face_offset_mm = 10");
  if (is_oscillating && has_offset)
    reader.error("offset", "an oscillating follower has no offset", "place its pivot by pivot_mm instead");
}

bool read_segments(study::ObjectReader& reader, bool rotary, CamProgramme& programme, Value& canonical) {
  Value::Array written;
  bool good = true;
  for (study::ObjectReader& table : reader.tables("segment")) {
    CamSegment s;
    good = table(law_field, s.law) && good;
    good = table(over_field, s.over) && good;
    joint_fields(table, rotary, s);
    const bool has_end = table.has(rotary ? field::angle("to") : field::length("to"));
    if (s.law == CamLaw::dwell && has_end)
      table.error("to", "a dwell stays where the segment before it ends", "leave the key out");
    if (s.law != CamLaw::dwell && !has_end)
      table.error("to", "the segment has no end value", rotary ? "write to_deg = 20" : "write to_mm = 20");
    if (s.law != CamLaw::polynomial)
      for (const char* key :
           {"start_rate", "start_acceleration", "start_jerk", "end_rate", "end_acceleration", "end_jerk"})
        if (table.has(rotary ? field::angle(key) : field::length(key)))
          table.error(key, fmt::format("the law '{}' has its own conditions at the ends", name_of(s.law)),
                      "write law = \"polynomial\", or leave the key out");
    Value out;
    study::ObjectWriter writer(out);
    writer(law_field, s.law), writer(over_field, s.over);
    CamSegment copy = s;
    joint_fields(
        [&](const Field& field, auto& member) {
          if (s.law != CamLaw::dwell || field.key != "to") writer(field, member);
        },
        rotary, copy);
    written.push_back(std::move(out));
    programme.segments.push_back(std::move(s));
  }
  if (!written.empty()) canonical["segment"] = Value(std::move(written));
  return good;
}

bool read_table(study::ObjectReader& reader, bool rotary, CamProgramme& programme, Value& canonical) {
  auto table = reader.table("table");
  if (!table) return true;
  CamTable t;
  const bool good = (*table)(table_angles, t.angles) & (*table)(table_values(rotary), t.values);
  Value out;
  study::ObjectWriter writer(out);
  writer(table_angles, t.angles), writer(table_values(rotary), t.values);
  canonical["table"] = std::move(out);
  if (good && t.angles.size() != t.values.size()) {
    table->error("values", fmt::format("{} values for {} angles", t.values.size(), t.angles.size()),
                 "give one value for each angle");
    return false;
  }
  programme.table = std::move(t);
  return good;
}

void tell_finding(study::ObjectReader& reader, const ProgrammeFinding& f, bool rotary) {
  if (f.severity != ProgrammeSeverity::error) return;
  const FindingWords words = words_for(f, rotary);
  reader.error(words.key, words.message, words.hint);
}

void tell_problem(study::ObjectReader& reader, const CamStudy& s, const CamProblem& p) {
  const DiscCam& c = s.cam;
  const auto mm = [](double v) { return fmt::format("{:.6g} mm", v * 1e3); };
  switch (p.issue) {
    case CamIssue::offset_too_large:
      reader.error("offset",
                   fmt::format("the offset of {} reaches beyond the prime circle of {}", mm(c.offset),
                               mm(c.prime_radius())),
                   "take a smaller offset, or a larger base circle");
      break;
    case CamIssue::no_triangle:
      reader.error(
          "base_radius",
          c.has_pitch_curve() ? fmt::format("arm {}, pivot {} and prime circle {} make no triangle",
                                            mm(c.arm), mm(c.pivot), mm(c.prime_radius()))
                              : fmt::format("a face {} off its pivot at {} cannot touch a base circle of {}",
                                            mm(c.face_offset), mm(c.pivot), mm(c.base_radius)),
          c.has_pitch_curve()
              ? fmt::format("the prime circle, base circle and roller together, lies between {} and {}",
                            mm(std::abs(c.pivot - c.arm)), mm(c.pivot + c.arm))
              : "the difference of base radius and face offset is less than the pivot distance");
      break;
    case CamIssue::passes_centre:
      reader.error("base_radius",
                   fmt::format("the follower comes to the centre of the cam at {}", degrees_text(p.angle)),
                   "take a larger base circle, or a smaller stroke below it");
      break;
    case CamIssue::face_turns_with_cam:
      reader.error(
          "follower",
          fmt::format("at {} the face turns as fast as the cam: no cam can do that", degrees_text(p.angle)),
          "take a roller, or a longer segment");
      break;
    case CamIssue::arm_passes_line:
      reader.error(
          "arm",
          fmt::format("at {} the arm lies across the direction that the cam can push", degrees_text(p.angle)),
          "take a smaller swing, or another pivot");
      break;
  }
}

study::Prepared prepare_cam(study::ObjectReader& document, const study::Common& common, bool is_synthesis) {
  study::Prepared prepared;
  auto body = document.table(field::entry("mechanism").required());
  auto limits = document.table("limits");
  auto forces = document.table("forces");
  CamStudy s;
  CamMechanism m;
  std::optional<double> offset;
  Value mechanism = Value::object();
  bool good = body.has_value();
  if (body) {
    body->read(m);
    if (is_synthesis) {
      (*body)(offset_field, s.offset);
    } else {
      good = (*body)(base_radius_field.required(), s.cam.base_radius) && good;
      (*body)(offset_field, offset);
    }
    check_dimensions(*body, m, body->has(offset_field));
  }
  const bool rotary = m.motion == FollowerMotion::oscillating;
  s.cam.motion = m.motion, s.cam.face = m.follower, s.cam.is_clockwise = m.sense == Rotation::clockwise;
  s.cam.roller_radius = m.roller_radius.value_or(0), s.cam.offset = offset.value_or(0);
  s.cam.pivot = m.pivot.value_or(0), s.cam.arm = m.arm.value_or(0);
  s.cam.face_offset = m.face_offset.value_or(0), s.cutter_radius = m.cutter_radius;
  mechanism = study::write_fields(m);
  if (body) {
    joint_fields(*body, rotary, s.programme);
    study::ObjectWriter writer(mechanism);
    joint_fields(writer, rotary, s.programme);
    s.programme.is_sector = m.sector;
    good = read_segments(*body, rotary, s.programme, mechanism) && good;
    good = read_table(*body, rotary, s.programme, mechanism) && good;
    if (m.sector) {
      s.programme.angle = 0;
      for (const CamSegment& segment : s.programme.segments) s.programme.angle += segment.over;
      if (s.programme.table && !s.programme.table->angles.empty())
        s.programme.angle = s.programme.table->angles.back();
    }
    if (s.programme.segments.empty() && !body->has("segment") && !s.programme.table && !body->has("table"))
      body->error("", "the cam has no programme",
                  "write [[mechanism.segment]] with law, over_deg and to_mm or to_deg");
    else if (good)
      for (const ProgrammeFinding& f : findings(s.programme)) {
        if (f.severity == ProgrammeSeverity::error) good = false;
        tell_finding(*body, f, rotary);
      }
  }
  if (limits) limits->read(s.limits);
  if (is_synthesis && !s.limits.pressure_angle && s.cam.has_pitch_curve() && !s.limits.radius && limits)
    limits->error("", "there is no limit, and without one a cam has no smallest size",
                  "write pressure_angle_deg = 30, or radius_of_curvature_mm = 5");
  if (is_synthesis && !limits)
    document.missing(field::entry("limits"), "write [limits] with pressure_angle_deg = 30");
  if (forces) {
    FollowerLoad load;
    (*forces)(speed_field, load.speed);
    joint_fields(*forces, rotary, load);
    Value written;
    study::ObjectWriter writer(written);
    writer(speed_field, load.speed);
    joint_fields(writer, rotary, load);
    prepared.canonical["forces"] = std::move(written);
    s.load = load;
  }
  if (limits) prepared.canonical["limits"] = study::write_fields(s.limits);
  const bool fits = (m.follower != FollowerFace::roller || m.roller_radius) && (!rotary || m.pivot) &&
                    (!rotary || m.follower == FollowerFace::flat || m.arm);
  if (good && fits && !is_synthesis)
    if (const auto wrong = problem(s.cam, ProgrammeCurve(s.programme))) tell_problem(*body, s, *wrong);
  s.canonical = prepared.canonical;
  s.canonical["mechanism"] = mechanism;
  if (is_synthesis) {
    study::ObjectWriter writer(mechanism);
    if (!rotary) writer(offset_field, s.offset);
  } else {
    write_cam_size(s.cam, mechanism);
  }
  prepared.canonical["mechanism"] = std::move(mechanism);
  prepared.run = [s = std::move(s), common, is_synthesis](RunContext&) {
    return is_synthesis ? run_cam_synthesis(s, common) : run_cam(s, common);
  };
  return prepared;
}

void describe_cam(study::SchemaWriter& document, bool is_synthesis) {
  study::SchemaWriter mechanism, segment, table, forces;
  CamMechanism defaults;
  fields(mechanism, defaults);
  if (is_synthesis) {
    mechanism(offset_field, Range{});
  } else {
    mechanism(base_radius_field.required(), 0.0);
    mechanism(offset_field, 0.0);
  }
  describe_joint_fields<CamProgramme>(mechanism);
  segment(law_field, CamLaw::dwell);
  segment(over_field, 0.0);
  describe_joint_fields<CamSegment>(segment);
  mechanism.property(field::entry("segment", "segments of the programme, in their order"),
                     study::schema_array(std::move(segment).finish()));
  table.property(table_angles, study::schema_array(study::schema_number()));
  for (const bool rotary : {true, false}) {
    Field values = table_values(rotary);
    values.is_required = false;
    table.property(values, study::schema_array(study::schema_number()));
  }
  mechanism.property(field::entry("table", "programme as a smooth curve through rows, instead of segments"),
                     std::move(table).finish());
  document.property(field::entry("mechanism", "the cam and its follower").required(),
                    std::move(mechanism).finish());
  document.property(field::entry("limits", "limits that the cam is to meet").required(is_synthesis),
                    study::schema_fields<CamLimits>());
  forces(speed_field, 0.0);
  describe_joint_fields<FollowerLoad>(forces);
  document.property(field::entry("forces", "speed, masses and springs, for contact force and torque"),
                    std::move(forces).finish());
}

study::Kind kind_of(bool is_synthesis) {
  study::Kind kind;
  kind.kind = is_synthesis ? "synthesis" : "analysis";
  kind.mechanism = "planar.cam";
  kind.schema = [is_synthesis](study::SchemaWriter& document) { describe_cam(document, is_synthesis); };
  kind.prepare = [is_synthesis](study::ObjectReader& document, const study::Common& common) {
    return prepare_cam(document, common, is_synthesis);
  };
  return kind;
}

}  // namespace

void write_cam_size(const DiscCam& cam, Value& mechanism) {
  study::ObjectWriter writer(mechanism);
  writer(base_radius_field, cam.base_radius);
  if (cam.motion == FollowerMotion::translating) writer(offset_field, cam.offset);
}

study::Kind cam_kind() {
  study::Kind kind = kind_of(false);
  kind.summary =
      "a disc cam and its follower: profile, pressure angle, curvature, undercut, forces, lift-off";
  kind.example = templates::analysis_cam();
  return kind;
}

study::Kind cam_synthesis_kind() {
  study::Kind kind = kind_of(true);
  kind.summary = "the smallest disc cam within limits of pressure angle and curvature";
  kind.example = templates::synthesis_cam();
  return kind;
}

}  // namespace linkwright::planar
