// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/optimise/pagmo_bridge.h"
#include "linkwright/planar/path/slider_crank/synthesis.h"
#include "linkwright/planar/studies/path.h"
#include "linkwright/study/remarks.h"

// Path synthesis of the slider-crank.
namespace linkwright::planar {

/// The side of the crank pin on which the slider is searched.
enum class SliderSideChoice { any, forward, backward };
constexpr std::array<EnumName<SliderSideChoice>, 3> names(SliderSideChoice) {
  return {{{SliderSideChoice::any, "any", "on both sides"},
           {SliderSideChoice::forward, "forward", "ahead of the crank pin along the guide direction"},
           {SliderSideChoice::backward, "backward", "behind the crank pin"}}};
}

constexpr std::array<ParameterWords, slider_parameter_count> words(SliderParameter) {
  return {{{"length of the crank O-A", "crank length"},
           {"length of the rod A-B", "rod length"},
           {"distance of the tracing point C from the crank pin A", "tracing point, distance from crank pin"},
           {"direction of A->C from the rod A->B", "tracing point, angle from rod"},
           {"direction of the guide", "guide direction"},
           {"of the guide line from O, along the left normal of its direction", "offset of the guide"},
           {"crank pivot O, x", "crank pivot x"},
           {"crank pivot O, y", "crank pivot y"},
           {"crank angle at the first point, from the x axis (equal_steps, increments)", "start angle"}}};
}

/// The point that traces.
enum class SliderTracingPoint { rod };
constexpr std::array<EnumName<SliderTracingPoint>, 1> names(SliderTracingPoint) {
  return {{{SliderTracingPoint::rod, "rod", "point C of the rod, at point_distance and point_angle from A"}}};
}

/// The criterion by which points are met.
enum class SliderPathFit { least_squares, exact };
constexpr std::array<EnumName<SliderPathFit>, 2> names(SliderPathFit) {
  return {{{SliderPathFit::least_squares, "least_squares",
            "as near as the slider-cranks that a search finds come"},
           {SliderPathFit::exact, "exact", "exactly, by all slider-cranks that pass them: eight points"}}};
}

/// The quantity that is minimised; both together give a front.
enum class SliderObjectiveType { sum_squared_distance, stroke };
constexpr std::array<EnumName<SliderObjectiveType>, 2> names(SliderObjectiveType) {
  return {{{SliderObjectiveType::sum_squared_distance, "path.sum_squared_distance",
            "sum over the points of the squared distance (Boskovic 2018, Eqs. (4.14), (4.18))"},
           {SliderObjectiveType::stroke, "slider.stroke",
            "stroke of the slider over a full turn, in addition to the path: a front (Boskovic 2018, Eqs. "
            "(4.17)-(4.19))"}}};
}

struct PressureLimit {
  double max = 0;
};
template <class Visitor>
void fields(Visitor&& visit, PressureLimit& l) {
  visit(field::angle("max", "greatest angle between rod and guide, over the turn or the arc")
            .positive()
            .at_most(1.5707963267948966)
            .required(),
        l.max);
}
constexpr Word choice_word(const PressureLimit&) {
  return {"pressure_angle", "greatest angle between rod and guide"};
}

struct StrokeLimit {
  std::optional<double> min, max;
};
template <class Visitor>
void fields(Visitor&& visit, StrokeLimit& l) {
  visit(field::length("min", "least stroke").not_negative(), l.min);
  visit(field::length("max", "greatest stroke").positive(), l.max);
}
constexpr Word choice_word(const StrokeLimit&) {
  return {"stroke",
          "difference of the slider's extreme positions over a full turn; with both objectives the range of "
          "the front"};
}

/// `method = "nsga2"` and `"moead"`: fronts by methods of pagmo.
template <class Options>
struct FrontMethod {
  Options options;
  optimise::FrontOptions front;
};
template <class Visitor, class Options>
void fields(Visitor&& visit, FrontMethod<Options>& m) {
  fields(visit, m.options);
  fields(visit, m.front);
}
constexpr Word choice_word(const FrontMethod<optimise::Nsga2Options>&) {
  return {"nsga2", "a front by sorting and crowding, by pagmo (Deb et al. 2002)"};
}
constexpr Word choice_word(const FrontMethod<optimise::MoeadOptions>&) {
  return {"moead", "a front by decomposition, by pagmo (Li and Zhang 2009)"};
}

/// Population methods work on the nine-unknown problem. Violated constraints cost a constant, as Boskovic
/// 2018, Eqs. (4.14), (4.18) have it, unless the study says otherwise.
using SliderPathMethod =
    optimise::MethodChoice<optimise::Constraints::penalty, Recommended, FrontMethod<optimise::Nsga2Options>,
                           FrontMethod<optimise::MoeadOptions>>;
struct SliderPathOptimiser {
  int front = 15;  ///< points of a front
  SliderPathMethod method;
};
template <class Visitor>
void fields(Visitor&& visit, SliderPathOptimiser& o) {
  visit(field::entry("front", "points of the front, when there are two objectives").between(2, 1000),
        o.front);
  visit(field::entry("method", "how designs are searched"), o.method);
}

struct SliderPathKind;
using SliderPathStudy = PathStudy<SliderPathKind>;

/// What is peculiar to the path synthesis of slider-cranks.
struct SliderPathKind : SliderCrankPath {
  using BranchChoice = SliderSideChoice;
  using Parameters = PathParameters<SliderParameter, slider_parameter_count>;
  using TracingPoint = SliderTracingPoint;
  using Fit = SliderPathFit;
  using Objective = SliderObjectiveType;
  using Constraint = PathConstraint<PressureLimit, StrokeLimit>;
  using Optimiser = SliderPathOptimiser;
  static constexpr std::string_view key = "planar.slider_crank", the_mechanism = "the slider-crank",
                                    summary =
                                        "slider-crank with an inclined, offset guide whose rod point traces "
                                        "a path, also with a short stroke",
                                    branch_summary = "where the slider is searched";
  static std::string_view example();
  static std::span<const study::Absent> absent();
  static auto bounds(const std::vector<double>& x, const std::vector<double>& y) {
    return derive_slider_bounds(x, y);
  }
  static void set_limit(study::ObjectReader& document, const PressureLimit& limit,
                        SliderPathProblem& problem);
  static void set_limit(study::ObjectReader& document, const StrokeLimit& limit, SliderPathProblem& problem);
  /// Checks and sets up what follows from all tables.
  static void complete(study::ObjectReader& document, const study::DisplayUnits& units,
                       SliderPathStudy& study);
  static void read_exact(study::ObjectReader& document, study::ObjectReader& target, SliderPathStudy& study);
  static study::Result run_exact(const SliderPathStudy& study, const study::Common& common,
                                 RunContext& context);

  static constexpr bool one_branch_is_enough = false;
  static constexpr std::size_t max_drawn = 15;
  static bool shows_start(const SliderPathProblem& problem);

  static optimise::Problem population_problem(const SliderPathStudy& study,
                                              const CrankSearch<SliderSide>& search, bool several,
                                              optimise::MinimiseOptions& minimise);
  static Value analysis_form(const SliderCrankMechanism& linkage);
  static study::Scene scene(SliderCrankMechanism mechanism, const std::vector<double>& crank_angles);
  static Table motion(const SliderCrankMechanism& linkage, const std::vector<double>& crank_angles);
  static std::vector<MotionPlot> motion_plots();
  static Sentence label(const SliderPathProblem& problem, const SliderPathDesign& design);
  /// Its objectives and classification, beside what every mechanism has.
  static void classify_design(const SliderPathProblem& problem, const SliderPathDesign& design,
                              Value active_bounds, study::Solution& out);
  static void add_cognates(study::Result& result, const SliderPathDesign& best);
  static void add_published(study::Result& result, const SliderPathStudy& study,
                            const std::vector<SliderPathDesign>& designs);
  static Sentence headline(const SliderPathStudy& study, const std::vector<SliderPathDesign>& designs,
                           const PathErrors& errors);
  static void add_facts(study::Result& result, const SliderPathStudy& study,
                        const std::vector<SliderPathDesign>& designs);
  static void add_warnings(study::Result& result, const SliderPathProblem& problem,
                           const SliderPathDesign& best);
  static Sentence caution(const SliderPathProblem&, const std::vector<SliderPathDesign>&) { return {}; }

  // Fronts of path and stroke.
  static std::vector<SliderPathDesign> front_of(std::vector<SliderPathDesign> designs);
  static std::vector<SliderPathDesign> front_of_seeds(std::vector<SliderPathDesign> designs);
  /// The front that begins with the best design of the path alone.
  static SliderPathSynthesis follow_front(const SliderPathStudy& study, SliderPathSynthesis best,
                                          const PathSynthesisOptions& options, RunContext& context);
  /// Shortfall of the front of each seed: the share of the area dominated by the front of all seeds that it
  /// misses. The worst of both objectives on that front, a tenth further, is the point from which it is
  /// counted.
  static std::vector<double> shortfalls(const PathRuns<SliderPathKind>& runs,
                                        const std::vector<SliderPathDesign>& designs);
  static void add_front(study::Result& result, const SliderPathProblem& problem,
                        const std::vector<SliderPathDesign>& designs);
};

extern template study::Result run_path_study(const SliderPathStudy&, const study::Common&, RunContext&);
study::Kind slider_path_kind();

/// A pressure angle (rad) beyond this, 75 degrees, moves the slider badly.
inline constexpr double steep_pressure = 75 * pi / 180;
study::Fact pressure_fact(double pressure);
void warn_of_pressure(const study::AddWarning& warn, double pressure);

}  // namespace linkwright::planar
