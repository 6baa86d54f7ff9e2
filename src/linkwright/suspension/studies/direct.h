// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/suspension/direct/synthesis.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/studies/lists.h"
#include "linkwright/suspension/studies/values.h"
#include "linkwright/suspension/wheel/corner_columns.h"

// The synthesis of a wheel suspension from what its wheel is to do: what its file holds, how it is read, run
// and reported.
namespace linkwright::suspension {

/// One curve of `[[target.curve]]` as read; what its numbers measure depends on the quantity.
struct CurveForm {
  const CornerColumn* column = nullptr;
  std::optional<MotionQuantity> motion;  ///< number of a spring, damper or bar that the column shows
  TargetMeasure measure = TargetMeasure::value;
  std::string objective;               ///< curves of one objective count together
  std::vector<double> travels, racks;  ///< m, one for each value
  std::vector<double> values;          ///< SI
  ToleranceRule tolerance;             ///< SI
  double weight = 1;
};

/// `[[design]]`: a point that may lie in a box around where it is, or the length of a link or of a rocker's
/// rod.
struct DesignForm {
  std::string point;
  std::optional<Edges> box;
  std::vector<Axis> given;
  std::string link;
  std::optional<Range> length;
};
template <class Visitor>
void fields(Visitor&& visit, DesignForm& d) {
  visit(field::entry("point",
                     "of a link, a rocker or a spring: \"tie rod.body\", \"lower wishbone.body_2\", "
                     "\"rocker.rod_2\", \"spring.moving\""),
        d.point);
  visit(field::length("box", "edge of the box around the point, or its three edges").between(0, 1e3), d.box);
  visit(field::entry("given", "coordinates that stay as they are"), d.given);
  visit(field::entry("link", "a US link whose length is a design variable"), d.link);
  visit(field::length("length", "its range").between(1e-6, 1e3), d.length);
}

/// Fields of a box.
template <class Visitor, class Box>
void box_fields(Visitor&& visit, Box& b) {
  visit(field::length("x", "its range along x").required(), b.x);
  visit(field::length("y", "its range along y").required(), b.y);
  visit(field::length("z", "its range along z").required(), b.z);
}

/// `[[constraint]]`.
struct LengthConstraint {
  std::string link;
  std::optional<double> min, max;
};
template <class Visitor>
void fields(Visitor&& visit, LengthConstraint& c) {
  visit(field::entry("link", "name of the link").required(), c.link);
  visit(field::length("min", "least distance of its points").not_negative(), c.min);
  visit(field::length("max", "greatest distance of its points").not_negative(), c.max);
}
constexpr Word choice_word(const LengthConstraint&) { return {"link_length", "how long a link may be"}; }

struct LinkClearanceConstraint {
  std::string first, second;
  double min = 0;
};
template <class Visitor>
void fields(Visitor&& visit, LinkClearanceConstraint& c) {
  visit(field::entry("first", "name of a link").required(), c.first);
  visit(field::entry("second", "name of another one").required(), c.second);
  visit(field::length("min", "minimum distance of their lines: both radii and the clearance")
            .not_negative()
            .required(),
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
  visit(field::entry("link", "name of the link").required(), c.link);
  visit(field::length("inner_diameter", "of the tyre, inside which the rim leaves space")
            .not_negative()
            .required(),
        c.inner_diameter);
  visit(field::length("outer_diameter", "of the tyre; default: tyre_diameter of the wheel").not_negative(),
        c.outer_diameter);
  visit(field::length("width", "of the tyre").not_negative().required(), c.width);
  visit(field::length("min", "least distance of the link's line").not_negative().required(), c.min);
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
  visit(field::entry("link", "name of the link").required(), c.link);
  box_fields(visit, c);
  visit(field::length("min", "least distance of the link's line").not_negative(), c.min);
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
  visit(field::entry("point", "of a link: \"tie rod.body\"").required(), c.point);
  box_fields(visit, c);
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
  visit(field::entry("type", "what is limited").required(), c.limit);
}

struct RecommendedDirect {
  DirectOptions options;
};
template <class Visitor>
void fields(Visitor&& visit, RecommendedDirect& r) {
  visit(field::entry("goal", "what is minimised"), r.options.goal);
  visit(field::entry("starts", "local searches from random places").between(1, 1e6), r.options.starts);
  visit(field::entry("refined", "best ends that are refined for the goal").between(1, 1e4),
        r.options.refined);
  visit(field::entry("evaluations", "of a local search, at most").between(1, 1e7), r.options.evaluations);
  visit(
      field::entry("priority_margin",
                   "goal \"priorities\": share by which the first objective beyond its tolerance may exceed "
                   "its least deviation, for the sake of those after it")
          .between(0, 1e3),
      r.options.priority_margin);
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
  visit(field::entry("goal", "what is minimised"), p.options.goal);
  visit(field::entry("population", "members").between(4, 1e6), p.population);
  visit(field::entry("generations", "at most").between(1, 1e7), p.generations);
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
  visit(field::entry("method", "how designs are searched"), o.method);
  visit(field::entry("objective", "the one that the goal `one` makes small"), o.objective);
}

/// A synthesis as read.
struct DirectStudy {
  CornerDescription description;
  std::vector<CurveForm> curves;
  std::vector<DirectConstraint> constraints;
  DirectOptimiser optimiser;
  Driver lock = Driver::wheel_centre_z;  ///< coordinate held while the steering axis is found
  DirectTask task;                       ///< task that follows from the above
  study::DisplayUnits units;             ///< units of its messages
  std::vector<ListForm> lists;
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
