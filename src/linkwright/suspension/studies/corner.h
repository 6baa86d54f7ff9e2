// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/result.h"
#include "linkwright/suspension/compliance/damper_law.h"
#include "linkwright/suspension/compliance/springs.h"
#include "linkwright/suspension/corner/hard_point_list.h"
#include "linkwright/suspension/corner/hard_points.h"
#include "linkwright/suspension/indirect/synthesis.h"

// The mechanism, which all studies of wheel suspensions read alike, with its points as coordinates, as names
// out of a list of hard points, or as boxes in which they are to be found.
namespace linkwright::suspension {

/// A point in a file: where it is, or where it begins and the box that it may lie in.
struct PointForm {
  Vec3 at;       ///< m
  PointBox box;  ///< m; a given coordinate has equal limits
};
/// A point all of whose coordinates are given (m).
PointForm given(const Vec3& at);

/// The points of one end of a link: [x, y, z] with numbers or { min, max, initial }; or a table { near, box,
/// offset, given }, near a place or the name of a hard point; or an array of two of these.
struct PointsForm {
  std::vector<PointForm> points;
};
bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                PointsForm& member);
Value write_value(const PointsForm& member);
Value schema_value(const Field& field, const PointsForm& member);

enum class Axis { x, y, z };
constexpr std::array<EnumName<Axis>, 3> names(Axis) {
  return {{{Axis::x, "x"}, {Axis::y, "y"}, {Axis::z, "z"}}};
}
/// Edges of a box along the axes (m): one number for all, or one each.
struct Edges {
  std::array<double, 3> of{};
};
bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                Edges& member);
Value write_value(const Edges& member);
Value schema_value(const Field& field, const Edges& member);
/// The box around a place, its middle shifted by `offset`; coordinates that are given stay as the place has
/// them.
PointBox box_of(const Vec3& near, const Edges& edges, const Vec3& offset, std::span<const Axis> given);

enum class MovedBy { rack };
constexpr std::array<EnumName<MovedBy>, 1> names(MovedBy) {
  return {{{MovedBy::rack, "rack", "its body points move along the rack, or with the centre link"}}};
}

struct WheelForm {
  std::optional<PointsForm> centre;
  std::string point;  ///< hard point instead of `centre`
  double toe = 0, camber = 0;
  double tyre_diameter = 0.6;
  std::optional<double> rim_diameter;
};
template <class Visitor>
void fields(Visitor&& visit, WheelForm& w) {
  visit(field::length("centre", "wheel centre at the reference"), w.centre);
  visit(field::entry("point", "name of the hard point at the wheel centre"), w.point);
  const auto angle = [](std::string_view key, std::string_view summary) {
    return field::angle(key, summary).between(-1.5, 1.5);
  };
  visit(angle("toe", "at the reference, > 0: front of the wheel towards the vehicle"), w.toe);
  visit(angle("camber", "at the reference, > 0: top of the wheel away from the vehicle"), w.camber);
  visit(field::length("tyre_diameter", "of the tyre as it stands").between(0.01, 100).required(),
        w.tyre_diameter);
  visit(field::length("rim_diameter",
                      "where toe is measured as a length, between the front and the rear edge of the rim")
            .between(0.01, 100),
        w.rim_diameter);
}

struct CornerLinkForm {
  std::string name;
  LinkType type = LinkType::US;
  std::optional<PointsForm> body, carrier;
  std::vector<std::string> points;  ///< hard points, those of the body first
  std::optional<double> length;
  std::optional<MovedBy> moved_by;
  std::optional<std::array<double, 3>> cross_axis;
};
template <class Visitor>
void fields(Visitor&& visit, CornerLinkForm& l) {
  visit(field::entry("name", "of the link, for messages and tables"), l.name);
  visit(field::entry("type", "joint at the body, joint at the carrier").required(), l.type);
  visit(field::length("body", "points at the body: one, or two on the axis of a hinge"), l.body);
  visit(field::length("carrier", "points at the carrier: one, or two on the axis of a hinge"), l.carrier);
  visit(field::entry("points", "names of hard points instead of body and carrier, those of the body first"),
        l.points);
  visit(
      field::length("length", "of a US or SS link, instead of the distance of its points").between(1e-6, 1e3),
      l.length);
  visit(field::entry("moved_by", "what moves its body points"), l.moved_by);
  visit(field::entry("cross_axis",
                     "of a US link: direction of the axis of its universal joint that is fixed in the "
                     "body; default: level "
                     "and across the link. What is fixed to the link off its line turns with it")
            .between(-1e6, 1e6),
        l.cross_axis);
}

struct CornerCouplerForm {
  std::string name;
  std::string first;
  std::optional<double> fraction;
  std::optional<Range> offset;
  std::optional<PointsForm> first_point;
  std::string second;
  std::optional<PointsForm> point;
};
template <class Visitor>
void fields(Visitor&& visit, CornerCouplerForm& c) {
  visit(field::entry("name", "of the coupler"), c.name);
  visit(field::entry("first", "name of the US link that it begins on").required(), c.first);
  visit(field::entry("fraction", "its place on that link as a share of the length, from the body")
            .between(0, 1),
        c.fraction);
  visit(field::length("offset", "its place on that link as a distance from the body, instead of fraction")
            .between(0, 1e3),
        c.offset);
  visit(field::length("first_point", "its point on that link, off the line too, instead of fraction"),
        c.first_point);
  visit(field::entry("second", "name of the SR link that it ends on").required(), c.second);
  visit(field::length("point", "its point on that link").required(), c.point);
}

struct RockerForm {
  std::string name;
  std::optional<PointsForm> axis, rod;
  std::vector<std::string> points;
  std::string driven_by;
  std::optional<double> rod_length;
};
template <class Visitor>
void fields(Visitor&& visit, RockerForm& r) {
  visit(field::entry("name", "of the rocker, for messages and tables"), r.name);
  visit(
      field::length("axis", "two points of its axis; its angle is right-handed from the first to the second"),
      r.axis);
  visit(field::length("rod", "push- or pullrod: its end on the part that drives it, its end on the rocker"),
        r.rod);
  visit(field::entry("points", "names of four hard points instead: axis, rod"), r.points);
  visit(field::entry("driven_by", "\"carrier\", or the name of a link or of a rocker before it").required(),
        r.driven_by);
  visit(field::length("rod_length", "of the rod, instead of the distance of its ends").between(1e-6, 1e3),
        r.rod_length);
}

/// A characteristic: points given here or in a file.
struct CharacteristicForm {
  std::optional<std::string> file;
  std::vector<double> compression, force;
};
template <class Visitor>
void fields(Visitor&& visit, CharacteristicForm& c) {
  visit(field::entry("file", "CSV with the columns compression_mm and force_N"), c.file);
  visit(field::length("compression", "ascending, of the spring from its free length, of the stop itself"),
        c.compression);
  visit(field::force("force", "at these compressions"), c.force);
}

/// The force of a spring.
struct SpringLawForm {
  std::optional<double> stiffness;
  double preload = 0;
  std::optional<double> free_length;
  std::optional<CharacteristicForm> curve;
};
template <class Visitor>
void fields(Visitor&& visit, SpringLawForm& s) {
  visit(field::stiffness("stiffness", "of the spring, for wheel rates and compliance").not_negative(),
        s.stiffness);
  visit(field::force("preload", "force with which it pushes its ends apart at the reference"), s.preload);
  visit(field::length("free_length", "its length without force, instead of the preload").between(1e-3, 1e3),
        s.free_length);
  visit(field::entry("curve", "its force over its compression, instead of the stiffness"), s.curve);
}

struct CornerSpringForm {
  std::optional<PointsForm> body, moving;
  std::vector<std::string> points;
  std::string attached_to = "carrier", body_attached_to = "body";
  SpringLawForm law;
};
template <class Visitor>
void fields(Visitor&& visit, CornerSpringForm& s) {
  visit(field::length("body", "its end at the body"), s.body);
  visit(field::length("moving", "its other end"), s.moving);
  visit(field::entry("points", "names of two hard points instead of both"), s.points);
  visit(field::entry("attached_to", "\"carrier\", or the name of a link or a rocker"), s.attached_to);
  visit(field::entry("body_attached_to", "part that holds its first end, if that is not the body"),
        s.body_attached_to);
  fields(visit, s.law);
}

/// Between both wheels: its other end is the counterpart of the moving one.
struct HeaveSpringForm {
  std::optional<PointsForm> moving;
  std::vector<std::string> points;
  std::string attached_to;
  SpringLawForm law;
};
template <class Visitor>
void fields(Visitor&& visit, HeaveSpringForm& s) {
  visit(field::length("moving", "its end at this wheel; the other one is its counterpart at the other wheel"),
        s.moving);
  visit(field::entry("points", "name of a hard point instead"), s.points);
  visit(field::entry("attached_to", "\"carrier\", or the name of a link or a rocker").required(),
        s.attached_to);
  fields(visit, s.law);
}

/// The force of a damper over the speed of its ends: points given here or in a file.
struct DamperCurveForm {
  std::optional<std::string> file;
  std::vector<double> speed, force;
};
template <class Visitor>
void fields(Visitor&& visit, DamperCurveForm& c) {
  visit(field::entry("file", "CSV with the columns speed_m_per_s and force_N"), c.file);
  visit(field::speed("speed", "ascending, by which its ends approach each other: < 0 in extension"), c.speed);
  visit(field::force("force", "at these speeds, with their sign"), c.force);
}

struct DamperForm {
  std::optional<PointsForm> body, moving;
  std::vector<std::string> points;
  std::string attached_to = "carrier", body_attached_to = "body";
  std::optional<double> damping;
  std::optional<DamperCurveForm> curve;
};
template <class Visitor>
void fields(Visitor&& visit, DamperForm& d) {
  visit(field::length("body", "its end at the body; without ends it has those of the spring"), d.body);
  visit(field::length("moving", "its other end"), d.moving);
  visit(field::entry("points", "names of two hard points instead of both"), d.points);
  visit(field::entry("attached_to", "\"carrier\", or the name of a link or a rocker"), d.attached_to);
  visit(field::entry("body_attached_to", "part that holds its first end, if that is not the body"),
        d.body_attached_to);
  visit(field::damping("damping", "force by speed").not_negative(), d.damping);
  visit(field::entry("curve", "its force over its speed, instead of the damping"), d.curve);
}

struct TorsionBarForm {
  std::string attached_to;
  double stiffness = 0, preload = 0;
};
template <class Visitor>
void fields(Visitor&& visit, TorsionBarForm& t) {
  visit(field::entry("attached_to", "rocker, or link hinged to the body, about whose axis it is twisted")
            .required(),
        t.attached_to);
  visit(field::stiffness_angular("stiffness", "moment by twist").not_negative().required(), t.stiffness);
  visit(field::torque("preload", "moment at the reference, > 0: it pushes the wheel down"), t.preload);
}

/// The shape of an anti-roll bar.
enum class BarShape { U, T };
constexpr std::array<EnumName<BarShape>, 2> names(BarShape) {
  return {{{BarShape::U, "U", "two arms, each with a droplink, on a bar that is twisted between them"},
           {BarShape::T, "T",
            "a crossbar with both droplinks on a post in the middle, which tilts freely and is twisted"}}};
}

struct AntiRollBarForm {
  BarShape shape = BarShape::U;
  std::optional<PointsForm> axis, droplink;
  std::vector<std::string> points;
  std::string attached_to;
  double stiffness = 0;
};
template <class Visitor>
void fields(Visitor&& visit, AntiRollBarForm& a) {
  visit(field::entry("shape", "U or T"), a.shape);
  visit(field::length("axis",
                      "two points of its axis; angles are right-handed from the first to the second. Of a T "
                      "bar the foot and the top of its post"),
        a.axis);
  visit(field::length("droplink", "its end on the part that moves it, its end on the bar's arm"), a.droplink);
  visit(field::entry("points", "names of four hard points instead: axis, droplink"), a.points);
  visit(field::entry("attached_to", "\"carrier\", or the name of a link or a rocker: what the droplink is on")
            .required(),
        a.attached_to);
  visit(field::stiffness_angular("stiffness", "moment by twist between the ends of both arms, or of the post")
            .not_negative(),
        a.stiffness);
}

enum class StopPlace { spring, damper };
constexpr std::array<EnumName<StopPlace>, 2> names(StopPlace) {
  return {{{StopPlace::spring, "spring"}, {StopPlace::damper, "damper"}}};
}
struct StopForm {
  std::optional<StopPlace> on;
  double clearance = 0;
  std::optional<double> stiffness;
  std::optional<CharacteristicForm> curve;
  std::optional<double> solid_at;
};
template <class Visitor>
void fields(Visitor&& visit, StopForm& s) {
  visit(field::entry("on", "what it is on; default: the damper where there is one"), s.on);
  visit(field::length("clearance", "change of that length from the reference until it engages")
            .not_negative()
            .required(),
        s.clearance);
  visit(field::stiffness("stiffness", "of the stop").not_negative(), s.stiffness);
  visit(field::entry("curve", "its force over its own compression, instead of the stiffness"), s.curve);
  visit(field::length("solid_at", "its own compression at which it bottoms").positive(), s.solid_at);
}

/// Named points beside the mechanism, in their own frame.
struct HardPointsForm {
  std::optional<std::string> file, names;
  PointUnit unit = PointUnit::mm;
  PointFrame frame;
  std::vector<std::pair<std::string, std::array<double, 3>>> points;
};
template <class Visitor>
void fields(Visitor&& visit, HardPointsForm& h) {
  visit(field::entry("file", "list of points: CSV with name,x_mm,y_mm,z_mm, or plain text"), h.file);
  visit(field::entry(
            "names",
            "file with lines \"name in the study = name in the list\"; an analysis proposes one that is "
            "not there yet"),
        h.names);
  visit(field::entry("unit", "of a plain text list"), h.unit);
  visit(field::entry("x", "where the x axis of the points points to"), h.frame.x);
  visit(field::entry("y", "where their y axis points to"), h.frame.y);
  visit(field::entry("z", "where their z axis points to"), h.frame.z);
  std::array<double, 3> origin{h.frame.origin.x, h.frame.origin.y, h.frame.origin.z};
  visit(field::length("origin", "their origin in the vehicle's frame: x forward, y left, z up"), origin);
  h.frame.origin = {origin[0], origin[1], origin[2]};
  visit(field::length("points", "points given here, by name").between(-1e6, 1e6), h.points);
}

struct RackForm {
  std::array<double, 3> direction{0, 1, 0};
};
template <class Visitor>
void fields(Visitor&& visit, RackForm& r) {
  visit(field::entry("direction", "of the rack, of any length; displacements along it are positive")
            .between(-1e6, 1e6),
        r.direction);
}

/// `[mechanism.steering_linkage]`: points straight ahead, the same for both wheels.
struct SteeringLinkageForm {
  std::array<double, 3> axis{0, 0, 1};
  std::array<double, 3> pitman_pivot{}, pitman_joint{}, idler_pivot{}, idler_joint{};
  double box_ratio = 0;
};
template <class Visitor>
void fields(Visitor&& visit, SteeringLinkageForm& s) {
  visit(field::entry("axis", "direction of both shafts, of any length").between(-1e6, 1e6), s.axis);
  const auto point = [](std::string_view key, std::string_view summary) {
    return field::length(key, summary).between(-1e6, 1e6).required();
  };
  visit(point("pitman_pivot", "a point of the shaft of the Pitman arm"), s.pitman_pivot);
  visit(point("pitman_joint", "joint of the Pitman arm and the centre link"), s.pitman_joint);
  visit(point("idler_pivot", "a point of the shaft of the idler arm"), s.idler_pivot);
  visit(point("idler_joint", "joint of the idler arm and the centre link"), s.idler_joint);
  visit(field::entry("box_ratio", "turn of the steering wheel by that of the Pitman arm; 0 = not known")
            .between(0, 1e3),
        s.box_ratio);
}

struct CornerForm {
  std::string sample;
  Side side = Side::left;
  std::optional<HardPointsForm> hard_points;
  std::optional<WheelForm> wheel;
  std::vector<CornerLinkForm> links;
  std::vector<CornerCouplerForm> couplers;
  std::vector<RockerForm> rockers;
  std::optional<CornerSpringForm> spring;
  std::optional<DamperForm> damper;
  std::optional<HeaveSpringForm> heave_spring;
  std::optional<TorsionBarForm> torsion_bar;
  std::optional<AntiRollBarForm> anti_roll_bar;
  std::optional<StopForm> bump_stop, rebound_stop;
  RackForm rack;
  std::optional<SteeringLinkageForm> steering_linkage;
};
template <class Visitor>
void fields(Visitor&& visit, CornerForm& g) {
  visit(field::entry("sample", "a built-in wheel suspension instead of everything else"), g.sample);
  visit(field::entry("side", "of the vehicle; a sample is mirrored for the right one"), g.side);
  visit(field::entry("hard_points", "named points, and the frame they are given in"), g.hard_points);
  visit(field::entry("wheel", "the wheel at the reference"), g.wheel);
  visit(field::entry("link", "links and joints between body and carrier"), g.links);
  visit(field::entry("coupler", "rods between two links"), g.couplers);
  visit(field::entry("rocker", "rockers (bell cranks) that push- or pullrods drive"), g.rockers);
  visit(field::entry("spring", "between the body and the carrier, a link or a rocker"), g.spring);
  visit(field::entry("damper", "where it is not in line with the spring, and its damping"), g.damper);
  visit(field::entry("heave_spring", "third spring, between the rockers or links of both wheels"),
        g.heave_spring);
  visit(field::entry("torsion_bar", "spring that a rocker or a hinged link twists"), g.torsion_bar);
  visit(field::entry("anti_roll_bar", "U or T bar with droplinks, this wheel's arm"), g.anti_roll_bar);
  visit(field::entry("bump_stop", "engages as the spring or damper is compressed"), g.bump_stop);
  visit(field::entry("rebound_stop", "engages as the spring or damper is extended"), g.rebound_stop);
  visit(field::entry("rack", "of the steering"), g.rack);
  visit(field::entry("steering_linkage",
                     "Pitman arm, idler arm and centre link, which move the tie rods instead of a rack"),
        g.steering_linkage);
}

/// The freedom that a study may leave to its points.
enum class OpenPoints { none, boxes };

/// The damper: the element that it is, none where it is in line with the spring.
struct DamperDescription {
  std::optional<std::size_t> element;
  std::optional<double> damping;     ///< N s/m
  std::optional<DamperCurve> curve;  ///< replaces the damping
};
/// A torsion bar: its element, and moment by twist with the moment at the reference that pushes the wheel
/// down.
struct TorsionBarDescription {
  std::size_t element = 0;
  SpringLaw law;  ///< N m/rad, N m
};
/// A spring between both wheels: its element.
struct HeaveSpringDescription {
  std::size_t element = 0;
  SpringLaw law;  ///< N/m, N
};
/// An anti-roll bar: its arm is a rocker. The rocker of a T bar is its tilt, about the lateral axis through
/// the foot of the post, as long as both wheels travel equally.
struct AntiRollBarDescription {
  std::size_t rocker = 0;
  double stiffness = 0;               ///< N m/rad between the ends of its arms, or of the post
  std::optional<Vec3> post_top = {};  ///< top of the post of a T bar, m
};
struct StopDescription {
  StopPlace on = StopPlace::spring;
  StopLaw law;
};

/// Parts that spring and damp the wheel beside the spring itself.
struct SpringParts {
  std::optional<DamperDescription> damper;
  std::optional<HeaveSpringDescription> heave_spring;
  std::optional<TorsionBarDescription> torsion_bar;
  std::optional<AntiRollBarDescription> anti_roll_bar;
  std::optional<StopDescription> bump_stop, rebound_stop;
};

/// The list of hard points that a study reads.
struct CornerList {
  std::string file;  ///< name of its file without folder
  HardPointList list;
};

/// `[mechanism]` of any study of a wheel suspension, resolved.
struct CornerDescription {
  Suspension suspension;        ///< open coordinates at their start
  std::vector<LinkTask> links;  ///< the suspension's, with boxes; all coordinates given where none are open
  std::vector<CouplerTask> couplers;   ///< likewise
  std::optional<SpringLaw> spring;     ///< law of the spring, if it is known
  SpringParts springs;                 ///< damper, bars and stops
  std::optional<double> rim_diameter;  ///< m, where toe is measured as a length
  std::optional<CornerList> list;      ///< list that points were read from
  PointFrame frame;                    ///< frame of named points, the vehicle's where there are none
  PointUnit unit = PointUnit::mm;      ///< unit of named points
};

/// Reads it; nothing when there are problems, which go to the reader. A suspension without open points that
/// cannot move as a wheel suspension must is refused.
///
/// @param proposed if given, it receives the file of names that the study calls for and that is not there
/// yet; nothing is returned then, and what the mechanism is stays open
std::optional<CornerDescription> read_suspension(study::ObjectReader& document, const study::Common& common,
                                                 OpenPoints open,
                                                 std::optional<study::ResultFile>* proposed = nullptr);
/// The table as a canonical study holds it: coordinates in the vehicle's frame, no names of points, no files.
Value write_suspension(const CornerDescription& description);
/// The same of a suspension that was found for it, whose coordinates are all given.
Value write_suspension(CornerDescription description, const Suspension& found);
void describe_suspension(study::SchemaWriter& document);

}  // namespace linkwright::suspension
