// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/exact/designs.h"
#include "linkwright/planar/exact/pivot_map.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/path/four_bar/usability.h"
#include "linkwright/planar/studies/exact_findings.h"
#include "linkwright/planar/studies/four_bar_path.h"
#include "linkwright/planar/studies/path_run.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

// Solutions with a drawing and tables of their own: so many answers, or so many of the nearest to one.
constexpr std::size_t max_exact_drawn = 15, min_exact_drawn = 6;

constexpr std::array<std::string_view, 4> severities = {"done", "order", "circuit", "branch"};

// A given pivot; the origin where none is.
std::complex<double> pivot_place(const std::optional<Range>& x, const std::optional<Range>& y) {
  return x && y ? std::complex<double>(x->lower, y->lower) : 0.0;
}

class ExactReport {
 public:
  ExactReport(const FourBarPathStudy& s, const study::Common& common)
      : p_(s.problem), parameters_(s.mechanism.parameters), common_(common) {}

  study::Result make(RunContext& context) {
    std::vector<std::complex<double>> points;
    for (std::size_t k = 0; k < p_.x.size(); ++k) points.emplace_back(p_.x[k], p_.y[k]);
    if (p_.timing != Timing::free) {
      timed(points, context);
    } else if (pivots_may_choose()) {
      region(context);
    } else if (parameters_.rocker_pivot_x || parameters_.ranges[index(FourBarParameter::pivot_x)]) {
      pivots(points, context);
    } else {
      nine(points, context);
    }
    if (outcome_ == "no_solution") {
      finish();
      return std::move(result_);
    }
    count_designs();
    judge_designs();
    show_designs();
    finish();
    return std::move(result_);
  }

 private:
  void nine(const std::vector<std::complex<double>>& points, RunContext& context) {
    found_.whole = static_cast<int>(nine_point_classes);
    found_.what = "coupler curves through the nine points";
    found_.certificates = true;
    const PointObstacle blocked = obstacle(points);
    if (blocked.kind != PointObstacle::none) {
      std::string list;
      for (const int k : blocked.points) list += fmt::format("{}{}", list.empty() ? "" : ", ", k + 1);
      result_.status = Status::infeasible;
      outcome_ = "no_solution";
      result_.headline =
          say("No four-bar passes the points: {} of them ({}) lie on a {}, which no coupler curve meets in "
              "more than six points.",
              blocked.points.size(), list, blocked.kind == PointObstacle::collinear ? "line" : "circle");
      return;
    }
    const NinePointSolutions found = solve_nine_points(points, {.cache = user_cache_folder()}, context);
    found_.stopped = found.status;
    found_.classes = static_cast<int>(found.classes.size());
    found_.certified = found.certified;
    found_.real_classes = found.real;
    found_.infinite = found.infinite;
    found_.singular = found.singular;
    found_.lost = found.lost;
    found_.completeness = found_.stopped == Status::done ? found.completeness : Completeness::incomplete;
    designs_ = exact_designs(p_, found);
    class_table(found);
  }

  std::array<const std::optional<Range>*, 4> pivot_ranges() const {
    return {&parameters_.ranges[index(FourBarParameter::pivot_x)],
            &parameters_.ranges[index(FourBarParameter::pivot_y)], &parameters_.rocker_pivot_x,
            &parameters_.rocker_pivot_y};
  }
  bool pivots_may_choose() const {
    const auto ranges = pivot_ranges();
    return std::any_of(ranges.begin(), ranges.end(),
                       [](const auto* range) { return *range && !(*range)->fixed(); });
  }

  // Five points, and pivots that may be anywhere in their ranges.
  void region(RunContext& context) {
    swept_ = true;
    PivotRanges ranges;
    for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = pivot_ranges()[i]->value();
    PivotMap map = map_pivots(p_, ranges, context);
    found_.stopped = map.status;
    found_.classes = map.finite;
    found_.lost = map.lost;
    found_.completeness =
        map.status == Status::done ? Completeness::complete_uncertified : Completeness::incomplete;
    places_ = static_cast<int>(map.places.size());
    for (const PivotMapPlace& place : map.places) places_with_answers_ += place.answers > 0;
    designs_ = std::move(map.designs);
    found_.real_classes = static_cast<int>(designs_.size());
    map_table(map);
  }

  void map_table(const PivotMap& map) {
    static constexpr std::array<const char*, 4> keys = {"pivot_x_m", "pivot_y_m", "rocker_pivot_x_m",
                                                        "rocker_pivot_y_m"},
                                                labels = {"crank pivot x (m)", "crank pivot y (m)",
                                                          "rocker pivot x (m)", "rocker pivot y (m)"};
    Table table{.name = "pivots"};
    std::array<std::vector<double>, 4> at;
    std::vector<double> real, answers, transmission;
    for (const PivotMapPlace& place : map.places) {
      const double values[] = {place.pivots[0].real(), place.pivots[0].imag(), place.pivots[1].real(),
                               place.pivots[1].imag()};
      for (std::size_t i = 0; i < at.size(); ++i) at[i].push_back(values[i]);
      real.push_back(place.real);
      answers.push_back(place.answers);
      transmission.push_back(place.transmission);
      table.status.emplace_back("done");
    }
    for (std::size_t i = 0; i < at.size(); ++i) table.add(keys[i], labels[i], std::move(at[i]));
    table.add("four_bars", "four-bars through the points", std::move(real));
    table.add("answers", "of them without defects and within the limits", std::move(answers));
    table.add("min_transmission_angle_rad", "least transmission angle of the best (rad)",
              std::move(transmission));
    result_.tables.push_back(std::move(table));
    std::vector<const char*> free;
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (map.steps[i] > 1) free.push_back(keys[i]);
    const bool plane = free.size() == 2;
    if (free.size() > 2) return;
    for (const auto& [key, title] :
         {std::pair{"min_transmission_angle_rad", "Least transmission angle of the best four-bar"},
          std::pair{"answers", "Four-bars without defects"}})
      result_.plots.push_back(
          {.name = fmt::format("pivots-{}", key[0] == 'm' ? "transmission" : "answers"),
           .title = fmt::format("{}, by the place of the pivots", title),
           .table = "pivots",
           .x = free[0],
           .y = plane ? std::vector<std::string>{free[1], key} : std::vector<std::string>{key},
           .style = plane ? study::Plot::Style::map : study::Plot::Style::line});
  }

  // Points and fixed pivots, both or one.
  void pivots(const std::vector<std::complex<double>>& points, RunContext& context) {
    const auto& crank_x = parameters_.ranges[index(FourBarParameter::pivot_x)];
    const std::complex<double> crank =
                                   pivot_place(crank_x, parameters_.ranges[index(FourBarParameter::pivot_y)]),
                               rocker = pivot_place(parameters_.rocker_pivot_x, parameters_.rocker_pivot_y);
    FourBarSolutions found;
    if (crank_x && parameters_.rocker_pivot_x) {
      found_.whole = static_cast<int>(five_point_solutions);
      found_.what = "complex solutions for five points and both pivots";
      found = solve_five_points(std::span(points).first<5>(), {crank, rocker}, context);
    } else {
      found_.whole = static_cast<int>(seven_point_solutions);
      found_.what = "complex solutions for seven points and a pivot";
      found = solve_seven_points(std::span(points).first<7>(), crank_x ? crank : rocker, context);
      if (!crank_x)
        for (TracingFourBar& bars : found.real)
          bars = {bars.rocker_pivot, bars.rocker_pin, bars.crank_pin, bars.crank_pivot};
    }
    if (found.status == Status::deadline || found.status == Status::cancelled) found_.stopped = found.status;
    found_.classes = found.finite;
    found_.real_classes = static_cast<int>(found.real.size());
    found_.infinite = found.infinite;
    found_.singular = found.singular;
    found_.lost = found.lost;
    found_.completeness = completeness_of(found_);
    designs_ = exact_designs(p_, found);
  }

  // Points with crank angles, for each sense of rotation that the study searches.
  void timed(const std::vector<std::complex<double>>& points, RunContext& context) {
    timed_ = true;
    TimedPoints target{.points = points, .turns = {}, .pivots = {}};
    if (const auto& x = parameters_.ranges[index(FourBarParameter::pivot_x)])
      target.pivots[0] = pivot_place(x, parameters_.ranges[index(FourBarParameter::pivot_y)]);
    if (parameters_.rocker_pivot_x)
      target.pivots[1] = pivot_place(parameters_.rocker_pivot_x, parameters_.rocker_pivot_y);
    for (const double sense : {1.0, -1.0}) {
      if (sense > 0 ? !p_.search_positive : !p_.search_negative) continue;
      target.turns.clear();
      for (std::size_t k = 0; k < points.size(); ++k) target.turns.push_back(sense * point_angle(p_, k));
      const TimedPointSolutions found = solve_timed_points(target, context);
      if (found.status != Status::done) found_.stopped = found.status;
      swept_ = found.swept;
      dependent_ = dependent_ || found.dependent;
      found_.classes += found.cranks;
      cranks_ += found.real_cranks;
      slides_ += found.slides;
      const int before = found_.real_classes;
      for (ExactDesign& d : exact_designs(p_, found, sense)) {
        d.curve += before;
        found_.real_classes = std::max(found_.real_classes, d.curve + 1);
        designs_.push_back(std::move(d));
      }
    }
    std::stable_sort(designs_.begin(), designs_.end(), [](const ExactDesign& a, const ExactDesign& b) {
      return severity(a.defects) < severity(b.defects);
    });
    found_.completeness =
        found_.stopped == Status::done ? Completeness::complete_uncertified : Completeness::incomplete;
  }

  void class_table(const NinePointSolutions& found) {
    Table table{.name = "classes"};
    std::vector<double> number, real, certified, digits, size, free;
    for (std::size_t i = 0; i < found.classes.size(); ++i) {
      const CurveClass& curve = found.classes[i];
      double squares = 0;
      for (const auto& value : curve.four_bar) squares += std::norm(value);
      number.push_back(static_cast<double>(i + 1));
      real.push_back(curve.real);
      certified.push_back(curve.certified);
      digits.push_back(curve.extended ? 32 : 16);
      size.push_back(std::sqrt(squares));
      free.push_back(
          static_cast<double>(std::count_if(designs_.begin(), designs_.end(), [&](const ExactDesign& d) {
            return d.curve == static_cast<int>(i) && d.defects.empty();
          })));
      table.status.emplace_back("done");
    }
    table.add("class", "class", std::move(number));
    table.add("real", "real (1 = yes)", std::move(real));
    table.add("certified", "certified (1 = yes)", std::move(certified));
    table.add("digits", "digits of the solution", std::move(digits));
    table.add("norm_m", "norm of its smallest four-bar (m)", std::move(size));
    table.add("defect_free", "four-bars without defects", std::move(free));
    result_.tables.push_back(std::move(table));
  }

  // Removes designs that the study rules out by branch and sense; those that meet its limits come first.
  void count_designs() {
    std::erase_if(designs_, [&](const ExactDesign& d) {
      const bool open = d.design.linkage.branch == Branch::open, positive = d.design.sense > 0;
      return !(open ? p_.search_open : p_.search_crossed) ||
             !(positive ? p_.search_positive : p_.search_negative);
    });
    std::stable_partition(designs_.begin(), designs_.end(), [](const ExactDesign& d) { return answers(d); });
    found_.designs = static_cast<int>(designs_.size());
    const std::array<int*, 4> by_severity = {&found_.defect_free, &found_.order, &found_.circuit,
                                             &found_.branch};
    for (const ExactDesign& d : designs_) ++*by_severity[at(severity(d.defects))];
    found_.answers = static_cast<std::size_t>(std::count_if(designs_.begin(), designs_.end(), answers));
    design_table();
  }

  // Without defects and inside the limits of the study.
  static bool answers(const ExactDesign& d) { return d.defects.empty() && d.design.violations.empty(); }

  void design_table() {
    Table table{.name = "designs"};
    std::vector<std::vector<double>> columns;
    std::vector<double> number, curve, rotates, transmission;
    FourBar first;
    std::vector<std::string> keys;
    fields([&](const Field& field, double&) { keys.push_back(si_key(field.key, field.dimension)); }, first);
    columns.resize(keys.size());
    for (std::size_t i = 0; i < designs_.size(); ++i) {
      const ExactDesign& d = designs_[i];
      number.push_back(static_cast<double>(i + 1));
      curve.push_back(d.curve + 1);
      rotates.push_back(classify(d.design.linkage).crank_rotates_fully);
      transmission.push_back(severity(d.defects) < 2 ? path_transmission(p_, d.design).used : nan);
      FourBar linkage = d.design.linkage;
      std::size_t j = 0;
      fields([&](const Field&, double& value) { columns[j++].push_back(value); }, linkage);
      table.status.emplace_back(severities[at(severity(d.defects))]);
    }
    table.add("design", "design", std::move(number));
    table.add("class",
              found_.certificates ? "class"
              : timed_            ? "coupler curve"
                                  : "solution",
              std::move(curve));
    for (std::size_t j = 0; j < keys.size(); ++j) table.add(keys[j], keys[j], std::move(columns[j]));
    table.add("crank_rotates_fully", "the crank rotates fully (1 = yes)", std::move(rotates));
    table.add("min_transmission_angle_rad", "least transmission angle on the path (rad)",
              std::move(transmission));
    result_.tables.push_back(std::move(table));
  }

  void judge_designs() {
    const ExactVerdict verdict = judge(found_);
    result_.status = verdict.status;
    outcome_ = swept_ && verdict.status == Status::done ? "done" : verdict.outcome;
    const std::string best =
        designs_.empty() ? std::string() : fmt::format("a {}", called(designs_[0].design));
    if (swept_ && !timed_ && found_.answers > 0)
      result_.headline = say("{} The best of {} that differ is {}.", region_text(), found_.answers, best);
    else
      result_.headline = (timed_   ? timed_text()
                          : swept_ ? region_text()
                                   : found_text(found_)) +
                         " " + answer_text(found_, timed_ || swept_ ? "these" : "their", best);
  }

  Sentence region_text() const {
    return say(
        "At {} of {} places of the pivots four-bars pass the {} points in one motion and in their order.",
        places_with_answers_, places_, p_.x.size());
  }

  Sentence timed_text() const {
    if (swept_)
      return say(
          "Infinitely many four-bars pass the {} points at their crank angles; {} that differ are listed.",
          p_.x.size(), designs_.size());
    return say(
        "{} of {} cranks that hold the {} points at their angles {} real; {} four-bars on {} coupler "
        "curves have them.",
        cranks_, found_.classes, p_.x.size(), cranks_ == 1 ? "is" : "are", designs_.size(),
        found_.real_classes);
  }

  // The answers, and where they are few those that another order of the points would make one; without either
  // the nearest.
  void show_designs() {
    std::size_t shown = std::min(found_.answers, max_exact_drawn);
    while (shown < std::min(designs_.size(), min_exact_drawn) &&
           (severity(designs_[shown].defects) < 2 || found_.answers == 0))
      ++shown;
    std::vector<PathDesign> drawn;
    for (std::size_t i = 0; i < shown; ++i) {
      const ExactDesign& d = designs_[i];
      drawn.push_back(d.design);
      add_exact_solution<FourBarPathKind>(result_, p_, d, FourBarPathKind::label(p_, d.design),
                                          common_.output.samples);
      result_.solutions.back().classification["class"] = d.curve + 1;
    }
    add_design_tables<FourBarPathKind>(result_, p_, drawn, common_.output.samples);
  }

  void finish() {
    using Verdict = study::Fact::Verdict;
    Table table{.name = "counts"};
    table.status = {"done"};
    const auto add = [&](const char* key, const char* label, int value) {
      table.add(key, label, {static_cast<double>(value)});
    };
    if (timed_ && !swept_) {
      add("cranks", "cranks at their angles, complex ones with them", found_.classes);
      add("real_cranks", "real cranks", cranks_);
      add("slides", "couplers led by a slide instead of a rocker", slides_);
    } else if (swept_ && !timed_) {
      add("places", "places of the pivots", places_);
      add("places_with_answers", "places with a four-bar that answers", places_with_answers_);
      add("classes", "finite solutions of all places", found_.classes);
    } else if (!timed_) {
      add("classes", found_.certificates ? "classes of coupler curves" : "finite solutions", found_.classes);
    }
    if (found_.certificates) add("certified", "with a certificate", found_.certified);
    add("real_classes",
        found_.certificates ? "real classes"
        : timed_            ? "coupler curves"
                            : "real solutions",
        found_.real_classes);
    add_design_counts(table, found_);
    if (!timed_) add_path_counts(table, found_);
    result_.tables.insert(result_.tables.begin(), std::move(table));

    result_.statistics["method"] = "exact";
    result_.statistics["outcome"] = outcome_;
    result_.statistics["completeness"] = outcome_ == "no_solution" ? std::string_view("no_solution")
                                         : swept_                  ? std::string_view("sample")
                                                                   : name_of(found_.completeness);
    const study::AddFact fact{result_.facts};
    if (outcome_ == "no_solution") return;
    if (swept_ && !timed_) {
      fact("places of the pivots", say("{}", places_));
      fact("places with an answer", say("{}", places_with_answers_),
           places_with_answers_ > 0 ? Verdict::good : Verdict::bad);
    } else if (timed_) {
      fact("found", swept_ ? say("a sample of {} four-bars", designs_.size())
                           : say("{} real cranks of {}", cranks_, found_.classes));
    } else
      fact("found",
           found_.certificates ? say("{} of {} classes of four-bars, {} certified", found_.classes,
                                     found_.whole, found_.certified)
                               : say("{} of {} solutions", found_.classes, found_.whole),
           found_.completeness == Completeness::incomplete ? Verdict::bad : Verdict::plain);
    if (!swept_) fact(timed_ ? "coupler curves" : "real", say("{}", found_.real_classes));
    if (!swept_ || timed_) add_design_facts(fact, found_);
    if (found_.answers > 0) result_.facts.push_back(transmission_fact(p_, designs_[0].design));
    add_path_facts(fact, found_);
    const study::AddWarning warn{result_.diagnostics};
    if (found_.certificates && found_.completeness == Completeness::complete)
      fact("evidence",
           "each class is proved to be a solution and different from the others; that there are no more than "
           "1442 is a numerical result, not a theorem");
    if (found_.defect_free == 0) {
      std::vector<std::vector<int>> orders;
      for (const ExactDesign& d : designs_) orders.push_back(passing_order(p_, d));
      offer_order(warn, found_, orders);
    }
    if (dependent_ && found_.answers == 0)
      warn("the points and crank angles depend on each other: infinitely many cranks hold them",
           "move a point, or change a crank angle");
    warn_of_missing_solutions(warn, found_);
  }

  const PathProblem& p_;
  const FourBarPathParameters& parameters_;
  const study::Common& common_;
  study::Result result_;
  ExactFindings found_;
  std::vector<ExactDesign> designs_;
  bool timed_ = false, swept_ = false, dependent_ = false;
  int cranks_ = 0, slides_ = 0;               // solutions for points with timing
  int places_ = 0, places_with_answers_ = 0;  // places of pivots that may be chosen
  std::string outcome_;
};

}  // namespace

study::Result FourBarPathKind::run_exact(const FourBarPathStudy& s, const study::Common& common,
                                         RunContext& context) {
  return ExactReport(s, common).make(context);
}

}  // namespace linkwright::planar
