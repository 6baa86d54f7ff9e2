#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/study/kind.h"
#include "linkwright/suspension/compliance/springs.h"
#include "linkwright/suspension/guide/hard_points.h"
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
  return {{{MovedBy::rack, "rack", "its body points move along the rack"}}};
}

namespace guide_fields {
constexpr Field place(std::string_view key, std::string_view summary, bool required = false) {
  return {.key = key,
          .summary = summary,
          .dimension = Dimension::length,
          .minimum = -1e3,
          .maximum = 1e3,
          .required = required};
}
}  // namespace guide_fields

struct WheelForm {
  std::optional<PointsForm> centre;
  std::string point;  ///< hard point instead of `centre`
  double toe = 0, camber = 0;
  double tyre_diameter = 0.6;
  std::optional<double> rim_diameter;
};
template <class Visitor>
void fields(Visitor&& visit, WheelForm& w) {
  visit(guide_fields::place("centre", "wheel centre at the reference"), w.centre);
  visit(Field{.key = "point", .summary = "name of the hard point at the wheel centre"}, w.point);
  const auto angle = [](std::string_view key, std::string_view summary) {
    return Field{
        .key = key, .summary = summary, .dimension = Dimension::angle, .minimum = -1.5, .maximum = 1.5};
  };
  visit(angle("toe", "at the reference, > 0: front of the wheel towards the vehicle"), w.toe);
  visit(angle("camber", "at the reference, > 0: top of the wheel away from the vehicle"), w.camber);
  visit(Field{.key = "tyre_diameter",
              .summary = "of the tyre as it stands",
              .dimension = Dimension::length,
              .minimum = 0.01,
              .maximum = 100,
              .required = true},
        w.tyre_diameter);
  visit(Field{.key = "rim_diameter",
              .summary = "where toe is measured as a length, between the front and the rear edge of the rim",
              .dimension = Dimension::length,
              .minimum = 0.01,
              .maximum = 100},
        w.rim_diameter);
}

struct GuideLinkForm {
  std::string name;
  LinkType type = LinkType::US;
  std::optional<PointsForm> body, carrier;
  std::vector<std::string> points;  ///< hard points, those of the body first
  std::optional<double> length;
  std::optional<MovedBy> moved_by;
  std::optional<std::array<double, 3>> cross_axis;
};
template <class Visitor>
void fields(Visitor&& visit, GuideLinkForm& l) {
  visit(Field{.key = "name", .summary = "of the link, for messages and tables"}, l.name);
  visit(Field{.key = "type", .summary = "joint at the body, joint at the carrier", .required = true}, l.type);
  visit(guide_fields::place("body", "points at the body: one, or two on the axis of a hinge"), l.body);
  visit(guide_fields::place("carrier", "points at the carrier: one, or two on the axis of a hinge"),
        l.carrier);
  visit(Field{.key = "points",
              .summary = "names of hard points instead of body and carrier, those of the body first"},
        l.points);
  visit(Field{.key = "length",
              .summary = "of a US or SS link, instead of the distance of its points",
              .dimension = Dimension::length,
              .minimum = 1e-6,
              .maximum = 1e3},
        l.length);
  visit(Field{.key = "moved_by", .summary = "what moves its body points"}, l.moved_by);
  visit(Field{.key = "cross_axis",
              .summary = "of a US link: direction of the axis of its universal joint that is fixed in the "
                         "body; default: level "
                         "and across the link. What is fixed to the link off its line turns with it",
              .minimum = -1e6,
              .maximum = 1e6},
        l.cross_axis);
}

struct GuideCouplerForm {
  std::string name;
  std::string first;
  std::optional<double> fraction;
  std::optional<Range> offset;
  std::optional<PointsForm> first_point;
  std::string second;
  std::optional<PointsForm> point;
};
template <class Visitor>
void fields(Visitor&& visit, GuideCouplerForm& c) {
  visit(Field{.key = "name", .summary = "of the coupler"}, c.name);
  visit(Field{.key = "first", .summary = "name of the US link that it begins on", .required = true}, c.first);
  visit(Field{.key = "fraction",
              .summary = "its place on that link as a share of the length, from the body",
              .minimum = 0,
              .maximum = 1},
        c.fraction);
  visit(Field{.key = "offset",
              .summary = "its place on that link as a distance from the body, instead of fraction",
              .dimension = Dimension::length,
              .minimum = 0,
              .maximum = 1e3},
        c.offset);
  visit(guide_fields::place("first_point", "its point on that link, off the line too, instead of fraction"),
        c.first_point);
  visit(Field{.key = "second", .summary = "name of the SR link that it ends on", .required = true}, c.second);
  visit(guide_fields::place("point", "its point on that link", true), c.point);
}

struct GuideSpringForm {
  std::optional<PointsForm> body, moving;
  std::vector<std::string> points;
  std::string attached_to = "carrier";
  std::optional<double> stiffness;
  double preload = 0;
};
template <class Visitor>
void fields(Visitor&& visit, GuideSpringForm& s) {
  visit(guide_fields::place("body", "its end at the body"), s.body);
  visit(guide_fields::place("moving", "its other end"), s.moving);
  visit(Field{.key = "points", .summary = "names of two hard points instead of both"}, s.points);
  visit(Field{.key = "attached_to", .summary = "\"carrier\" or the name of a link"}, s.attached_to);
  visit(Field{.key = "stiffness",
              .summary = "of the spring, for wheel rates and compliance",
              .dimension = Dimension::stiffness,
              .minimum = 0,
              .maximum = 1e12},
        s.stiffness);
  visit(Field{.key = "preload",
              .summary = "force with which it pushes its ends apart at the reference",
              .dimension = Dimension::force,
              .minimum = -1e9,
              .maximum = 1e9},
        s.preload);
}

/// Named points beside the mechanism, in their own frame.
struct HardPointsForm {
  std::optional<std::string> file;
  PointUnit unit = PointUnit::mm;
  PointFrame frame;
  std::vector<std::pair<std::string, std::array<double, 3>>> points;
};
template <class Visitor>
void fields(Visitor&& visit, HardPointsForm& h) {
  visit(Field{.key = "file", .summary = "list of points: CSV with name,x_mm,y_mm,z_mm, or plain text"},
        h.file);
  visit(Field{.key = "unit", .summary = "of a plain text list"}, h.unit);
  visit(Field{.key = "x", .summary = "where the x axis of the points points to"}, h.frame.x);
  visit(Field{.key = "y", .summary = "where their y axis points to"}, h.frame.y);
  visit(Field{.key = "z", .summary = "where their z axis points to"}, h.frame.z);
  std::array<double, 3> origin{h.frame.origin.x, h.frame.origin.y, h.frame.origin.z};
  visit(guide_fields::place("origin", "their origin in the vehicle's frame: x forward, y left, z up"),
        origin);
  h.frame.origin = {origin[0], origin[1], origin[2]};
  visit(Field{.key = "points",
              .summary = "points given here, by name",
              .dimension = Dimension::length,
              .minimum = -1e6,
              .maximum = 1e6},
        h.points);
}

struct RackForm {
  std::array<double, 3> direction{0, 1, 0};
};
template <class Visitor>
void fields(Visitor&& visit, RackForm& r) {
  visit(Field{.key = "direction",
              .summary = "of the rack, of any length; displacements along it are positive",
              .minimum = -1e6,
              .maximum = 1e6},
        r.direction);
}

struct GuideForm {
  std::string sample;
  Side side = Side::left;
  std::optional<HardPointsForm> hard_points;
  std::optional<WheelForm> wheel;
  std::vector<GuideLinkForm> links;
  std::vector<GuideCouplerForm> couplers;
  std::optional<GuideSpringForm> spring;
  RackForm rack;
};
template <class Visitor>
void fields(Visitor&& visit, GuideForm& g) {
  visit(Field{.key = "sample", .summary = "a built-in wheel suspension instead of everything else"},
        g.sample);
  visit(Field{.key = "side", .summary = "of the vehicle; a sample is mirrored for the right one"}, g.side);
  visit(Field{.key = "hard_points", .summary = "named points, and the frame they are given in"},
        g.hard_points);
  visit(Field{.key = "wheel", .summary = "the wheel at the reference"}, g.wheel);
  visit(Field{.key = "link", .summary = "links and joints between body and carrier"}, g.links);
  visit(Field{.key = "coupler", .summary = "rods between two links"}, g.couplers);
  visit(Field{.key = "spring", .summary = "between the body and the carrier or a link"}, g.spring);
  visit(Field{.key = "rack", .summary = "of the steering"}, g.rack);
}

/// The freedom that a study may leave to its points.
enum class OpenPoints { none, boxes };

/// `[mechanism]` of any study of a wheel suspension, resolved.
struct GuideDescription {
  WheelGuide guide;             ///< open coordinates at their start
  std::vector<LinkTask> links;  ///< the suspension's, with boxes; all coordinates given where none are open
  std::vector<CouplerTask> couplers;   ///< likewise
  std::optional<SpringLaw> spring;     ///< law of the spring, if its stiffness is known
  std::optional<double> rim_diameter;  ///< m, where toe is measured as a length
};

/// Reads it; nothing when there are problems, which go to the reader. A suspension without open points that
/// cannot move as a wheel suspension must is refused.
std::optional<GuideDescription> read_guide(study::ObjectReader& document, const study::Common& common,
                                           OpenPoints open);
/// The table as a canonical study holds it: coordinates in the vehicle's frame, no names of points, no files.
Value write_guide(const GuideDescription& description);
/// The same of a suspension that was found for it, whose coordinates are all given.
Value write_guide(GuideDescription description, const WheelGuide& found);
void describe_guide(study::SchemaWriter& document);

}  // namespace linkwright::suspension
