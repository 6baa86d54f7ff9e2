// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/any_machine_refine.h"
#include "linkwright/planar/studies/function.h"
#include "linkwright/planar/studies/path_points.h"
#include "linkwright/planar/type_synthesis/quick_return.h"
#include "linkwright/planar/type_synthesis/search.h"
#include "linkwright/study/kind.h"

// The synthesis of machines of any type that trace a stroke, lead a body through poses or generate a
// function: what its files hold, how they are read, run and reported.
namespace linkwright::planar {

struct AnyMechanism {
  std::optional<std::vector<MachineFamily>> families;
  int most_links = 8;
};
template <class Visitor>
void fields(Visitor&& visit, AnyMechanism& m) {
  visit(field::entry("families", "families of machines to search; all when left out"), m.families);
  visit(
      field::entry(
          "most_links",
          "largest number of links, the ground among them; machines of ten links are grown from smaller ones")
          .between(4, 10),
      m.most_links);
}

/// A part of a stroke with a tolerance of its own.
struct AnyBandForm {
  std::optional<int> from_point, to_point;
  std::optional<double> from, to;
  double tolerance = 0;
};
template <class Visitor>
void fields(Visitor&& visit, AnyBandForm& b) {
  visit(
      field::entry("from_point", "number of the point at which the band begins, 1 for the first; default: 1")
          .at_least(1),
      b.from_point);
  visit(
      field::entry("to_point",
                   "number of the point at which it ends; default: the last. A band of a closed stroke that "
                   "ends before it begins continues past the first point")
          .at_least(1),
      b.to_point);
  visit(field::entry("from_share",
                     "instead of a point: share of the length of the stroke at which the band begins")
            .between(0, 1),
        b.from);
  visit(field::entry("to_share", "share of the length at which it ends").between(0, 1), b.to);
  visit(field::length("tolerance",
                      "half the width of the band: distances of the curve from the stroke up to this one "
                      "count as none")
            .positive()
            .required(),
        b.tolerance);
}

struct AnyTarget : PathPointsForm {
  bool closed = false;
  std::optional<double> tolerance;
  std::vector<AnyBandForm> bands;
  std::optional<std::vector<double>> weights;
  PathTiming timing;
};
template <class Visitor>
void fields(Visitor&& visit, AnyTarget& t) {
  visit(field::entry("closed",
                     "the last point is followed by the first; default: whether the last repeats the first"),
        t.closed);
  visit(field::length("tolerance", "distances of the curve from the points up to this one count as none")
            .positive(),
        t.tolerance);
  visit(field::entry(
            "band", "parts of the stroke with tolerances of their own; where they overlap, the least counts"),
        t.bands);
  visit(field::entry("weights",
                     "how much the error at each point counts, one number a point; only their proportions "
                     "matter; default: all the same"),
        t.weights);
  visit(field::entry("timing",
                     "crank rotations from the first point to the others, in either sense; angles tell the "
                     "same by their differences"),
        t.timing);
  fields(visit, static_cast<PathPointsForm&>(t));
}

struct AnyPoseForm {
  double x = 0, y = 0, angle = 0, weight = 1;
};
template <class Visitor>
void fields(Visitor&& visit, AnyPoseForm& p) {
  visit(field::length("x", "origin of the body, x").required(), p.x);
  visit(field::length("y", "origin of the body, y").required(), p.y);
  visit(field::angle("angle", "rotation of the body").required(), p.angle);
  visit(field::entry("weight", "how much its error counts; only the proportions of the weights matter")
            .not_negative(),
        p.weight);
}

struct AnyPosesTarget {
  bool closed = false;
  std::vector<AnyPoseForm> poses;
  std::optional<std::string> file;
  std::optional<double> orientation_length;
  PathTiming timing;
};
template <class Visitor>
void fields(Visitor&& visit, AnyPosesTarget& t) {
  visit(field::entry("closed", "the last pose is followed by the first"), t.closed);
  visit(field::entry("pose", "places of the body in their order"), t.poses);
  visit(field::entry("file", "CSV file with columns x_mm, y_mm, angle_deg (any units) instead of poses"),
        t.file);
  visit(field::length("orientation_length",
                      "what a rotation error of a radian counts as; default: the root mean square distance "
                      "of the path from its mean")
            .positive(),
        t.orientation_length);
  visit(field::entry("timing",
                     "crank rotations from the first pose to the others, in either sense; angles tell the "
                     "same by their differences"),
        t.timing);
}

struct DwellForm {
  double from = 0, to = 0;
};
template <class Visitor>
void fields(Visitor&& visit, DwellForm& d) {
  visit(field::angle("from", "rotation of the crank at which the output comes to rest")
            .not_negative()
            .required(),
        d.from);
  visit(field::angle("to", "rotation at which it moves on").positive().required(), d.to);
}

/// The output is an angle of a link, or the travel of a slider.
struct AnyFunctionTarget : FunctionTarget {
  AnyFunctionTarget() { fit = FunctionFit::minimax; }
  /// What the unit of output_range says, where it is known.
  std::optional<bool> slides;
  Range input;
  std::optional<Range> angle, travel;
  std::optional<double> size;
  std::optional<double> time_ratio;
  std::vector<DwellForm> dwells;
};
template <class Visitor>
void fields(Visitor&& visit, AnyFunctionTarget& t) {
  formula_fields(visit, t);
  visit(input_range_field(), t.input);
  if (!t.slides.value_or(false))
    visit(field::angle("output_range",
                       "rotation of the output link over the range, signed; of a function that ends as it "
                       "begins, from its least to its greatest value")
              .between(-6.283185307179586, 6.283185307179586),
          t.angle);
  if (t.slides.value_or(true))
    visit(field::length("output_range", "travel of a slider over the range instead, likewise"), t.travel);
  visit(field::entry("fit", "how the function is met"), t.fit);
  visit(field::entry(
            "time_ratio",
            "time of the slow stroke over that of the quick one, 1 or more, instead of a function: the "
            "output goes through its range and back once a turn, as it likes in between")
            .between(1, 100),
        t.time_ratio);
  visit(
      field::entry("dwell",
                   "parts of the crank rotation, counted from its beginning, over which the output rests at "
                   "any one value"),
      t.dwells);
  visit(field::length("size",
                      "the unit of shortest_link and longest_link, and the distance of crank and output that "
                      "is sought, where the output is an angle; default: 100 mm")
            .positive(),
        t.size);
}

struct GroundBoxForm {
  std::array<double, 2> x{}, y{};
};
template <class Visitor>
void fields(Visitor&& visit, GroundBoxForm& b) {
  visit(field::length("x", "least and greatest x").required().with_inherited_unit(), b.x);
  visit(field::length("y", "least and greatest y").required().with_inherited_unit(), b.y);
}

struct AnyLimits {
  double pair_angle = 20 * pi / 180;
  std::optional<double> shortest, longest, shortest_length, longest_length;
  std::optional<GroundBoxForm> ground_box;
  std::optional<std::vector<std::array<double, 2>>> ground_pivots;
  std::optional<double> pivot_tolerance;
};
template <class Visitor>
void fields(Visitor&& visit, AnyLimits& l) {
  visit(field::angle("least_pair_angle",
                     "of the two bars at a pin, or of a rod and the normal of its slide, over the whole turn "
                     "of the crank, or over the range of a drive that rocks")
            .between(1 * pi / 180, 70 * pi / 180),
        l.pair_angle);
  visit(field::entry("shortest_link",
                     "shortest length, in sizes of the stroke (its root mean square distance from its mean); "
                     "default: 0.05 unless a length is given")
            .between(1e-3, 1),
        l.shortest);
  visit(field::entry("longest_link",
                     "longest length, in sizes of the stroke; default: 10 unless a length is given")
            .between(1, 1000),
        l.longest);
  visit(field::length("shortest_length", "shortest length, instead of a share of the stroke").positive(),
        l.shortest_length);
  visit(field::length("longest_length", "longest length, instead of a share of the stroke").positive(),
        l.longest_length);
  visit(field::length("ground_box", "all pivots on the ground are inside"), l.ground_box);
  visit(field::length("ground_pivots",
                      "places [x, y], at each of which the machine has a pivot on the ground; it may have "
                      "more"),
        l.ground_pivots);
  visit(field::length("ground_pivot_tolerance",
                      "largest distance of a pivot from its place; default: a thousandth of the stroke's "
                      "size")
            .positive(),
        l.pivot_tolerance);
}

/// Of machines that move a point or a body: a function says by itself how far the crank turns.
struct AnyMotionLimits : AnyLimits {
  bool crank_turns = true;
};
template <class Visitor>
void fields(Visitor&& visit, AnyMotionLimits& l) {
  fields(visit, static_cast<AnyLimits&>(l));
  visit(
      field::entry("crank_turns",
                   "the crank turns fully; false: the drive rocks over the part of its rotation that an open "
                   "stroke takes, and machines need not turn"),
      l.crank_turns);
}

struct AnyOptimiser {
  std::optional<double> seconds;
  std::optional<std::int64_t> evaluations;
  int max_solutions = 12;
};
template <class Visitor>
void fields(Visitor&& visit, AnyOptimiser& o) {
  visit(field::entry("seconds",
                     "time of the search with each seed (s); default: 10 unless evaluations are given")
            .between(0.05, 86400),
        o.seconds);
  visit(field::entry("evaluations",
                     "number of curves after which the search with each seed ends: then the same result on "
                     "every number of threads")
            .between(1000, std::int64_t{1} << 50),
        o.evaluations);
  visit(field::entry("max_solutions", "largest number of machines in the list").between(1, 100),
        o.max_solutions);
}

/// Ranges of a function that the search chooses where they are not fixed: of the crank (rad) and of the
/// output (rad, or m of a slider), signed.
struct FunctionRanges {
  Range input, output;
};

struct AnyStudy {
  AnyMechanism mechanism;
  AnyMotionLimits limits;
  AnyOptimiser optimiser;
  AnyRefinementStudy refinement;
  Stroke drawn;                             ///< the stroke, or the places of the poses
  std::vector<double> angles;               ///< of the body at the poses (rad); none: a stroke
  FunctionStudy function;                   ///< the function, for such studies
  std::optional<FunctionRanges> ranges;     ///< where one of them is free
  std::optional<QuickReturn> quick_return;  ///< instead of a function
  FunctionFit fit = FunctionFit::least_squares;
  std::vector<Dwell> dwells;
  std::optional<MotionTarget> motion;  ///< what machines are fitted to; missing where problems were reported
};

/// "synthesis" of "planar.any" for "path_points", "poses" and "function".
study::Kind any_path_kind();
study::Kind any_poses_kind();
study::Kind any_function_kind();

/// The limits of a search, in sizes of the stroke from its mean.
MachineLimits limits_of(const AnyLimits& form, const SampledStroke& target);

/// What a study asks of the search with its first seed.
TypeSearchOptions search_options(const AnyStudy& study, const study::Common& common,
                                 const MachineLimits& limits);

/// The searches of a study, one for each seed, and what they come to together. A search ends as done after
/// its own time. Their outcomes go to the log of the result.
TypeSearchAnswer search_machines(const AnyStudy& study, const study::Common& common,
                                 const MachineLimits& limits, RunContext& context, study::Result& result);

study::Result run_any_study(const AnyStudy& study, const study::Common& common, RunContext& context);
study::Result run_any_function_study(const AnyStudy& study, const study::Common& common, RunContext& context);
study::Result run_any_quick_return_study(const AnyStudy& study, const study::Common& common,
                                         RunContext& context);

}  // namespace linkwright::planar
