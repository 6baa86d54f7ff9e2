#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/suspension/direct/synthesis.h"
#include "linkwright/suspension/studies/guide.h"
#include "linkwright/suspension/studies/values.h"
#include "linkwright/suspension/wheel/guide_columns.h"

// The synthesis of a wheel suspension from what its wheel is to do: what its file holds, how it is read, run
// and reported.
namespace linkwright::suspension {

/// One curve of `[[target.curve]]` as read; what its numbers measure depends on the quantity.
struct CurveForm {
  const GuideColumn* column = nullptr;
  TargetMeasure measure = TargetMeasure::value;
  std::string objective;               ///< curves of one objective count together
  std::vector<double> travels, racks;  ///< m, one for each value
  std::vector<double> values;          ///< SI
  ToleranceRule tolerance;             ///< SI
  double weight = 1;
};

/// `[[design]]`: a point that may lie in a box around where it is, or the length of a link.
struct DesignForm {
  std::string point;
  std::optional<Edges> box;
  std::vector<Axis> given;
  std::string link;
  std::optional<Range> length;
};
template <class Visitor>
void fields(Visitor&& visit, DesignForm& d) {
  visit(Field{.key = "point", .summary = "of a link: \"tie rod.body\", \"lower wishbone.body_2\""}, d.point);
  visit(Field{.key = "box",
              .summary = "edge of the box around the point, or its three edges",
              .dimension = Dimension::length,
              .minimum = 0,
              .maximum = 1e3},
        d.box);
  visit(Field{.key = "given", .summary = "coordinates that stay as they are"}, d.given);
  visit(Field{.key = "link", .summary = "a US link whose length is a design variable"}, d.link);
  visit(Field{.key = "length",
              .summary = "its range",
              .dimension = Dimension::length,
              .minimum = 1e-6,
              .maximum = 1e3},
        d.length);
}

namespace guide_fields {
constexpr Field size(std::string_view key, std::string_view summary, bool required = false) {
  return {.key = key,
          .summary = summary,
          .dimension = Dimension::length,
          .minimum = 0,
          .maximum = 1e3,
          .required = required};
}
template <class Visitor, class Box>
void box(Visitor&& visit, Box& b) {
  visit(place("x", "its range along x", true), b.x);
  visit(place("y", "its range along y", true), b.y);
  visit(place("z", "its range along z", true), b.z);
}
}  // namespace guide_fields

/// `[[constraint]]`.
struct LengthConstraint {
  std::string link;
  std::optional<double> min, max;
};
template <class Visitor>
void fields(Visitor&& visit, LengthConstraint& c) {
  visit(Field{.key = "link", .summary = "name of the link", .required = true}, c.link);
  visit(guide_fields::size("min", "least distance of its points"), c.min);
  visit(guide_fields::size("max", "greatest distance of its points"), c.max);
}
constexpr Word choice_word(const LengthConstraint&) { return {"link_length", "how long a link may be"}; }

struct LinkClearanceConstraint {
  std::string first, second;
  double min = 0;
};
template <class Visitor>
void fields(Visitor&& visit, LinkClearanceConstraint& c) {
  visit(Field{.key = "first", .summary = "name of a link", .required = true}, c.first);
  visit(Field{.key = "second", .summary = "name of another one", .required = true}, c.second);
  visit(guide_fields::size("min", "minimum distance of their lines: both radii and the clearance", true),
        c.min);
}
constexpr Word choice_word(const LinkClearanceConstraint&) {
  return {"link_clearance", "distance between two links at all positions of the targets"};
}

struct TyreClearanceConstraint {
  std::string link;
  double inner_diameter = 0, width = 0, min = 0;
  std::optional<double> outer_diameter;
};
template <class Visitor>
void fields(Visitor&& visit, TyreClearanceConstraint& c) {
  visit(Field{.key = "link", .summary = "name of the link", .required = true}, c.link);
  visit(guide_fields::size("inner_diameter", "of the tyre, inside which the rim leaves space", true),
        c.inner_diameter);
  visit(guide_fields::size("outer_diameter", "of the tyre; default: tyre_diameter of the wheel"),
        c.outer_diameter);
  visit(guide_fields::size("width", "of the tyre", true), c.width);
  visit(guide_fields::size("min", "least distance of the link's line", true), c.min);
}
constexpr Word choice_word(const TyreClearanceConstraint&) {
  return {"tyre_clearance", "distance between a link and the tyre"};
}

struct BoxClearanceConstraint {
  std::string link;
  Range x, y, z;
  double min = 0;
};
template <class Visitor>
void fields(Visitor&& visit, BoxClearanceConstraint& c) {
  visit(Field{.key = "link", .summary = "name of the link", .required = true}, c.link);
  guide_fields::box(visit, c);
  visit(guide_fields::size("min", "least distance of the link's line"), c.min);
}
constexpr Word choice_word(const BoxClearanceConstraint&) {
  return {"box_clearance", "distance between a link and a box of the body"};
}

struct KeepOutConstraint {
  std::string point;
  Range x, y, z;
};
template <class Visitor>
void fields(Visitor&& visit, KeepOutConstraint& c) {
  visit(Field{.key = "point", .summary = "of a link: \"tie rod.body\"", .required = true}, c.point);
  guide_fields::box(visit, c);
}
constexpr Word choice_word(const KeepOutConstraint&) {
  return {"keep_out", "a box that a point stays out of"};
}

struct DirectConstraint {
  std::variant<LengthConstraint, LinkClearanceConstraint, TyreClearanceConstraint, BoxClearanceConstraint,
               KeepOutConstraint>
      limit;
};
template <class Visitor>
void fields(Visitor&& visit, DirectConstraint& c) {
  visit(Field{.key = "type", .summary = "what is limited", .required = true}, c.limit);
}

struct RecommendedDirect {
  DirectOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, RecommendedDirect& r) {
  visit(Field{.key = "goal", .summary = "what is minimised"}, r.options.goal);
  visit(Field{.key = "starts", .summary = "local searches from random places", .minimum = 1, .maximum = 1e6},
        r.options.starts);
  visit(Field{.key = "refined",
              .summary = "best ends that are refined for the goal",
              .minimum = 1,
              .maximum = 1e4},
        r.options.refined);
  visit(Field{.key = "evaluations", .summary = "of a local search, at most", .minimum = 1, .maximum = 1e7},
        r.options.evaluations);
}
constexpr Word choice_word(const RecommendedDirect&) {
  return {"recommended", "least squares with exact gradients from many starts, then the goal"};
}
struct PublishedDirect {
  DirectOptions options;
  int population = 50, generations = 5000;
};
template <class Visitor>
void fields(Visitor&& visit, PublishedDirect& p) {
  visit(Field{.key = "goal", .summary = "what is minimised"}, p.options.goal);
  visit(Field{.key = "population", .summary = "members", .minimum = 4, .maximum = 1e6}, p.population);
  visit(Field{.key = "generations", .summary = "at most", .minimum = 1, .maximum = 1e7}, p.generations);
}
constexpr Word choice_word(const PublishedDirect&) {
  return {"differential_evolution", "with the settings of Poznanovic 2016: F 0.6, CR 0.9"};
}
struct DirectOptimiser {
  std::variant<RecommendedDirect, PublishedDirect> method;
  std::optional<std::string> objective;  ///< objective of the goal `one`
};
template <class Visitor>
void fields(Visitor&& visit, DirectOptimiser& o) {
  visit(Field{.key = "method", .summary = "how designs are searched"}, o.method);
  visit(Field{.key = "objective", .summary = "the one that the goal `one` makes small"}, o.objective);
}

/// A synthesis as read.
struct DirectStudy {
  GuideDescription description;
  std::vector<CurveForm> curves;
  std::vector<DirectConstraint> constraints;
  DirectOptimiser optimiser;
  Driver lock = Driver::wheel_centre_z;  ///< coordinate held while the steering axis is found
  DirectTask task;                       ///< task that follows from the above
  study::DisplayUnits units;             ///< units of its messages
};

/// "synthesis" of "suspension.corner" for "wheel_parameters".
study::Kind direct_kind();

/// Reads the tables of the study and writes them into the canonical one; nothing when there are problems,
/// which go to the reader.
std::optional<DirectStudy> read_direct_study(study::ObjectReader& document, const study::Common& common,
                                             Value& canonical);

/// Runs it over the seeds and reports.
study::Result run_direct_study(const DirectStudy& study, const study::Common& common, RunContext& context);

}  // namespace linkwright::suspension
