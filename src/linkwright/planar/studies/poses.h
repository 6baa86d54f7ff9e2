// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/planar/dyads/designs.h"
#include "linkwright/planar/exact/mixed_poses.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"

// Linkages that lead a body through poses: what their file holds, how it is read, run and reported.
namespace linkwright::planar {

/// One `[[target.pose]]`.
struct PoseForm {
  double x = 0, y = 0;
  std::optional<double> angle;
  double weight = 1;
  bool exact = false;
};
template <class Visitor>
void fields(Visitor&& visit, PoseForm& p) {
  visit(field::length("x", "origin of the body, x").required(), p.x);
  visit(field::length("y", "origin of the body, y").required(), p.y);
  visit(
      field::angle("angle", "rotation of the body; left out: a point that its origin passes at any rotation"),
      p.angle);
  visit(field::entry("weight", "of the errors of this pose next to the others (least_squares)").positive(),
        p.weight);
  visit(field::entry("exact", "met exactly, the others as near as can be (least_squares); four at most"),
        p.exact);
}

struct PivotLineForm {
  std::array<double, 2> point{};
  double direction = 0;
};
template <class Visitor>
void fields(Visitor&& visit, PivotLineForm& l) {
  visit(field::length("point", "on the line [x, y]").required(), l.point);
  visit(field::angle("direction", "of the line").required(), l.direction);
}

struct PivotRegionForm {
  std::array<double, 2> min{}, max{};
};
template <class Visitor>
void fields(Visitor&& visit, PivotRegionForm& r) {
  visit(field::length("min", "least coordinates [x, y]").required(), r.min);
  visit(field::length("max", "greatest coordinates [x, y]").required(), r.max);
}

/// One `[[mechanism.pivot]]`: what is known of the pivots of a dyad.
struct PivotForm {
  int dyad = 1;
  std::optional<std::array<double, 2>> fixed, moving;
  std::optional<PivotLineForm> fixed_on_line, moving_on_line;
  std::optional<PivotRegionForm> fixed_in_region, moving_in_region;
};
template <class Visitor>
void fields(Visitor&& visit, PivotForm& p) {
  visit(field::entry("dyad", "which of the two dyads").between(1, 2).required(), p.dyad);
  visit(field::length("fixed", "its pivot on the ground [x, y]"), p.fixed);
  visit(field::length("moving", "its pivot on the body, in the frame of the body [x, y]"), p.moving);
  visit(field::entry("fixed_on_line", "a line that its pivot on the ground lies on"), p.fixed_on_line);
  visit(field::entry("moving_on_line",
                     "a line of the body that its pivot on the body lies on, in the frame of the body"),
        p.moving_on_line);
  visit(field::entry("fixed_in_region", "a rectangle that its pivot on the ground lies in"),
        p.fixed_in_region);
  visit(field::entry("moving_in_region",
                     "a rectangle of the body that its pivot on the body lies in, in the frame of the body"),
        p.moving_in_region);
}

struct PoseMechanism {
  std::vector<GuidingDyadType> dyads = {GuidingDyadType::rr, GuidingDyadType::pr, GuidingDyadType::rp};
  std::vector<PivotForm> pivots;
  std::optional<bool> crank_rotates_fully;
};
template <class Visitor>
void fields(Visitor&& visit, PoseMechanism& m) {
  visit(field::entry("dyads", "what may join the body to the ground"), m.dyads);
  visit(field::entry("pivot", "pivots that are given, or lie on given lines or in regions"), m.pivots);
  visit(field::entry("crank_rotates_fully", "true leaves out linkages whose driven link does not turn round"),
        m.crank_rotates_fully);
}

/// The way in which the poses are met.
enum class PoseFitting { automatic, exact, least_squares };
constexpr std::array<EnumName<PoseFitting>, 3> names(PoseFitting) {
  return {
      {{PoseFitting::automatic, "automatic",
        "exactly up to five poses; more, or with points or poses that are marked exact, by least squares"},
       {PoseFitting::exact, "exact",
        "every pose is met: two to five poses; or, by four-bars, 4 poses and 2 points, 3 and 4, 2 and 6, by "
        "slider-cranks, inverted or not, 4 and 1, 3 and 3, 2 and 5"},
       {PoseFitting::least_squares, "least_squares", "as near as can be: five poses and more"}}};
}

struct PoseTarget {
  PoseFitting fit = PoseFitting::automatic;
  std::vector<PoseForm> poses;
  std::optional<std::string> file;
  std::optional<double> angle_length;
};
template <class Visitor>
void fields(Visitor&& visit, PoseTarget& t) {
  visit(field::entry("fit", "how the poses are met"), t.fit);
  visit(field::entry("pose", "places of the body in their order"), t.poses);
  visit(field::entry("file", "CSV file with columns x_mm, y_mm, angle_deg (any units) instead of poses"),
        t.file);
  visit(field::length(
            "angle_length",
            "what a rotation error of a radian counts as (least_squares); default: the root mean square "
            "distance of the places from their middle")
            .positive(),
        t.angle_length);
}

struct PoseSearch {
  int max_solutions = 12;
};
template <class Visitor>
void fields(Visitor&& visit, PoseSearch& s) {
  visit(field::entry("max_solutions", "how many linkages are listed").between(1, 100), s.max_solutions);
}

struct PoseStudy {
  PoseMechanism mechanism;
  PoseTarget target;
  PoseSearch search;
  PoseProblem problem;  ///< problem that follows from the above
  bool mixed = false;   ///< points among the poses, weights, or poses that are marked exact
  std::vector<MixedPoseLinkage> exact_linkages;  ///< linkages that meet them exactly, where they are mixed
};

/// The poses of a file beside the study, which its key "file" names; nothing where that has been reported.
std::vector<PoseForm> poses_of_file(study::ObjectReader& target, const study::Common& common,
                                    const std::string& file);

/// "synthesis" of "planar.four_bar" for "poses".
study::Kind pose_kind();

/// Reads the tables of the study; problems go to the reader.
PoseStudy read_pose_study(study::ObjectReader& document, const study::Common& common);

study::Result run_pose_study(const PoseStudy& study, const study::Common& common, RunContext& context);

}  // namespace linkwright::planar
