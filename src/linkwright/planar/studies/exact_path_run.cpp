#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/exact/designs.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/path/usability.h"
#include "linkwright/planar/studies/exact_path.h"
#include "linkwright/planar/studies/path_scene.h"
#include "linkwright/planar/studies/path_solution.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

// Solutions with a drawing and tables of their own: so many answers, or so many of the nearest to one.
constexpr std::size_t most_exact_drawn = 15, least_exact_drawn = 6;

constexpr std::array<std::string_view, 4> severities = {"done", "order", "circuit", "branch"};

struct ExactCounts {
  int classes = 0, certified = 0, real_classes = 0, infinite = 0, singular = 0, lost = 0;
  int designs = 0, defect_free = 0, order = 0, circuit = 0, branch = 0;
};

class ExactReport {
 public:
  ExactReport(const PathStudy& s, const study::Common& common)
      : p_(s.problem), parameters_(s.mechanism.parameters), common_(common) {}

  study::Result make(RunContext& context) {
    std::vector<std::complex<double>> points;
    for (std::size_t k = 0; k < p_.x.size(); ++k) points.emplace_back(p_.x[k], p_.y[k]);
    if (p_.timing != Timing::free) {
      timed(points, context);
    } else if (parameters_.rocker_pivot_x) {
      five(points, context);
    } else {
      nine(points, context);
    }
    if (outcome_ == "no_solution") {
      finish();
      return std::move(result_);
    }
    count_designs();
    judge();
    show_designs();
    finish();
    return std::move(result_);
  }

 private:
  void nine(const std::vector<std::complex<double>>& points, RunContext& context) {
    whole_ = static_cast<int>(nine_point_classes);
    what_ = "coupler curves through the nine points";
    const PointObstacle blocked = obstacle(points);
    if (blocked.kind != PointObstacle::none) {
      std::string list;
      for (const int k : blocked.points) list += fmt::format("{}{}", list.empty() ? "" : ", ", k + 1);
      result_.status = Status::infeasible;
      outcome_ = "no_solution";
      result_.headline = fmt::format(
          "No four-bar passes the points: {} of them ({}) lie on a {}, which no coupler curve meets in "
          "more than six points.",
          blocked.points.size(), list, blocked.kind == PointObstacle::collinear ? "line" : "circle");
      return;
    }
    const NinePointSolutions found = solve_nine_points(points, {.cache = user_cache_folder()}, context);
    stopped_ = found.status;
    counts_.classes = static_cast<int>(found.classes.size());
    counts_.certified = found.certified;
    counts_.real_classes = found.real;
    counts_.infinite = found.infinite;
    counts_.singular = found.singular;
    counts_.lost = found.lost;
    completeness_ = stopped_ == Status::done ? found.completeness : Completeness::incomplete;
    designs_ = exact_designs(p_, found);
    class_table(found);
  }

  void five(const std::vector<std::complex<double>>& points, RunContext& context) {
    certificates_ = false;
    whole_ = static_cast<int>(five_point_solutions);
    what_ = "complex solutions for five points and both pivots";
    const std::complex<double> crank(parameters_.ranges[index(FourBarParameter::pivot_x)]->lower,
                                     parameters_.ranges[index(FourBarParameter::pivot_y)]->lower),
        rocker(parameters_.rocker_pivot_x->lower, parameters_.rocker_pivot_y->lower);
    const FivePointSolutions found =
        solve_five_points(std::span(points).first<5>(), {crank, rocker}, context);
    if (found.status == Status::deadline || found.status == Status::cancelled) stopped_ = found.status;
    counts_.classes = found.finite;
    counts_.real_classes = static_cast<int>(found.real.size());
    counts_.infinite = found.infinite;
    counts_.singular = found.singular;
    counts_.lost = found.lost;
    completeness_ = stopped_ != Status::done || found.lost > 0 ? Completeness::incomplete
                    : found.finite == whole_                   ? Completeness::complete_uncertified
                                                               : Completeness::special_target;
    designs_ = exact_designs(p_, found);
  }

  // Points with crank angles, for each sense of rotation that the study searches.
  void timed(const std::vector<std::complex<double>>& points, RunContext& context) {
    certificates_ = false;
    timed_ = true;
    const auto pivot = [](const std::optional<Range>& x, const std::optional<Range>& y) {
      return x && y ? std::optional(std::complex<double>(x->lower, y->lower)) : std::nullopt;
    };
    TimedPoints target{.points = points,
                       .turns = {},
                       .pivots = {pivot(parameters_.ranges[index(FourBarParameter::pivot_x)],
                                        parameters_.ranges[index(FourBarParameter::pivot_y)]),
                                  pivot(parameters_.rocker_pivot_x, parameters_.rocker_pivot_y)}};
    for (const double sense : {1.0, -1.0}) {
      if (sense > 0 ? !p_.search_positive : !p_.search_negative) continue;
      target.turns.clear();
      for (std::size_t k = 0; k < points.size(); ++k) target.turns.push_back(sense * point_angle(p_, k));
      const TimedPointSolutions found = solve_timed_points(target, context);
      if (found.status != Status::done) stopped_ = found.status;
      swept_ = found.swept;
      dependent_ = dependent_ || found.dependent;
      counts_.classes += found.cranks;
      cranks_ += found.real_cranks;
      slides_ += found.slides;
      const int before = counts_.real_classes;
      for (ExactDesign& d : exact_designs(p_, found, sense)) {
        d.curve += before;
        counts_.real_classes = std::max(counts_.real_classes, d.curve + 1);
        designs_.push_back(std::move(d));
      }
    }
    std::stable_sort(designs_.begin(), designs_.end(),
                     [](const ExactDesign& a, const ExactDesign& b) { return severity(a) < severity(b); });
    completeness_ = stopped_ == Status::done ? Completeness::complete_uncertified : Completeness::incomplete;
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

  // Those that the study rules out by branch and sense go; those that meet its limits come first.
  void count_designs() {
    std::erase_if(designs_, [&](const ExactDesign& d) {
      const bool open = d.design.linkage.branch == Branch::open, positive = d.design.sense > 0;
      return !(open ? p_.search_open : p_.search_crossed) ||
             !(positive ? p_.search_positive : p_.search_negative);
    });
    std::stable_partition(designs_.begin(), designs_.end(), [](const ExactDesign& d) { return answers(d); });
    counts_.designs = static_cast<int>(designs_.size());
    const std::array<int*, 4> by_severity = {&counts_.defect_free, &counts_.order, &counts_.circuit,
                                             &counts_.branch};
    for (const ExactDesign& d : designs_) ++*by_severity[at(severity(d))];
    answers_ = static_cast<std::size_t>(std::count_if(designs_.begin(), designs_.end(), answers));
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
      transmission.push_back(severity(d) < 2 ? path_transmission(p_, d.design).used : nan);
      FourBar linkage = d.design.linkage;
      std::size_t j = 0;
      fields([&](const Field&, double& value) { columns[j++].push_back(value); }, linkage);
      table.status.emplace_back(severities[at(severity(d))]);
    }
    table.add("design", "design", std::move(number));
    table.add("class", certificates_ ? "class" : timed_ ? "coupler curve" : "solution", std::move(curve));
    for (std::size_t j = 0; j < keys.size(); ++j) table.add(keys[j], keys[j], std::move(columns[j]));
    table.add("crank_rotates_fully", "the crank rotates fully (1 = yes)", std::move(rotates));
    table.add("min_transmission_angle_rad", "least transmission angle on the path (rad)",
              std::move(transmission));
    result_.tables.push_back(std::move(table));
  }

  void judge() {
    const bool complete = completeness_ != Completeness::incomplete;
    if (stopped_ != Status::done) {
      result_.status = stopped_;
      outcome_ = to_string(stopped_);
    } else if (!complete) {
      result_.status = Status::not_converged;
      outcome_ = name_of(completeness_);
    } else if (answers_ > 0) {
      outcome_ = swept_ ? "done" : name_of(completeness_);
    } else {
      result_.status = Status::infeasible;
      outcome_ = counts_.classes == 0        ? "no_solution"
                 : counts_.real_classes == 0 ? "no_real_solution"
                                             : "all_defective";
    }
    result_.headline = found_text() + " " + answer_text();
  }

  // "All 1442 coupler curves through the nine points, each with a certificate; 64 are real."
  std::string found_text() const {
    if (swept_)
      return fmt::format(
          "Infinitely many four-bars pass the {} points at their crank angles; {} that differ are listed.",
          p_.x.size(), designs_.size());
    if (timed_)
      return fmt::format(
          "{} of {} cranks that hold the {} points at their angles {} real; {} four-bars on {} coupler "
          "curves have them.",
          cranks_, counts_.classes, p_.x.size(), cranks_ == 1 ? "is" : "are", designs_.size(),
          counts_.real_classes);
    const std::string real =
        fmt::format("{} of them {} real", counts_.real_classes, counts_.real_classes == 1 ? "is" : "are");
    switch (completeness_) {
      case Completeness::complete:
        return fmt::format("All {} {}, each certified; {}.", whole_, what_, real);
      case Completeness::complete_uncertified:
        return certificates_ ? fmt::format("All {} {}, {} of them certified; {}.", whole_, what_,
                                           counts_.certified, real)
                             : fmt::format("All {} {}; {}.", whole_, what_, real);
      case Completeness::special_target:
        return fmt::format(
            "{} of the {} {} that points in general have: these are special, the others lie at infinity "
            "or coincide; {}.",
            counts_.classes, whole_, what_, real);
      case Completeness::incomplete:
        return fmt::format("{} of {} {}, others may be missing; {}.", counts_.classes, whole_, what_, real);
    }
    return {};
  }

  std::string answer_text() const {
    if (designs_.empty()) return "There is no four-bar to build.";
    const char* pass = "in one motion and in their order";
    if (answers_ > 0) {
      const auto free = static_cast<std::size_t>(counts_.defect_free);
      return fmt::format("{} of {} {} four-bars {} the points {}{}; the best is a {}.", free, whose(),
                         designs_.size(), free == 1 ? "passes" : "pass", pass,
                         free == answers_
                             ? std::string()
                             : fmt::format(", {} of them within the limits of the study", answers_),
                         called(designs_[0].design));
    }
    if (counts_.defect_free > 0)
      return fmt::format("None of the {} four-bars that pass the points {} keeps the limits of the study.",
                         counts_.defect_free, pass);
    return fmt::format(
        "None of {} {} four-bars passes the points {}: {} change branch on the way, {} circuit, {} "
        "meet them in another order.",
        whose(), designs_.size(), pass, counts_.branch, counts_.circuit, counts_.order);
  }

  const char* whose() const { return timed_ ? "these" : "their"; }

  // The answers, and where they are few those that another order of the points would make one; without either
  // the nearest.
  void show_designs() {
    std::size_t shown = std::min(answers_, most_exact_drawn);
    while (shown < std::min(designs_.size(), least_exact_drawn) &&
           (severity(designs_[shown]) < 2 || answers_ == 0))
      ++shown;
    std::vector<PathDesign> drawn;
    for (std::size_t i = 0; i < shown; ++i) {
      const ExactDesign& d = designs_[i];
      drawn.push_back(d.design);
      study::Solution solution = path_solution(p_, d.design, i + 1, common_.output.samples);
      for (study::Parameter& parameter : solution.parameters)
        parameter.lower = -infinity, parameter.upper = infinity;
      solution.classification["class"] = d.curve + 1;
      solution.defects = Value::array();
      for (const Defect& defect : d.defects)
        solution.defects.push_back(fmt::format("{}: {}", name_of(defect.kind), defect.text));
      if (d.defects.empty())
        for (const auto& violation : d.design.violations)
          solution.defects.push_back(
              fmt::format("violates {} by {:.3g}", violation.reason, violation.amount));
      result_.scenes.push_back(path_scene(p_, d.design, solution.scene,
                                          fmt::format("{}: {}", i + 1, solution.label),
                                          common_.output.samples));
      result_.solutions.push_back(std::move(solution));
    }
    add_design_tables(result_, p_, drawn, common_.output.samples);
  }

  void finish() {
    using Verdict = study::Fact::Verdict;
    Table table{.name = "counts"};
    table.status = {"done"};
    const auto add = [&](const char* key, const char* label, int value) {
      table.add(key, label, {static_cast<double>(value)});
    };
    if (timed_ && !swept_) {
      add("cranks", "cranks at their angles, complex ones with them", counts_.classes);
      add("real_cranks", "real cranks", cranks_);
      add("slides", "couplers led by a slide instead of a rocker", slides_);
    } else if (!timed_) {
      add("classes", certificates_ ? "classes of coupler curves" : "finite solutions", counts_.classes);
    }
    if (certificates_) add("certified", "with a certificate", counts_.certified);
    add("real_classes",
        certificates_ ? "real classes"
        : timed_      ? "coupler curves"
                      : "real solutions",
        counts_.real_classes);
    add("designs", "four-bars with their driver", counts_.designs);
    add("defect_free", "without defects", counts_.defect_free);
    add("order_defects", "that meet the points in another order", counts_.order);
    add("circuit_defects", "that change circuit", counts_.circuit);
    add("branch_defects", "that change branch", counts_.branch);
    if (!timed_) {
      add("infinite", "paths that end at infinity", counts_.infinite);
      add("singular", "paths that end where solutions meet", counts_.singular);
      add("lost", "paths that were lost", counts_.lost);
    }
    result_.tables.insert(result_.tables.begin(), std::move(table));

    result_.statistics["method"] = "exact";
    result_.statistics["outcome"] = outcome_;
    result_.statistics["completeness"] = outcome_ == "no_solution" ? std::string_view("no_solution")
                                         : swept_                  ? std::string_view("sample")
                                                                   : name_of(completeness_);
    const study::AddFact fact{result_.facts};
    if (outcome_ == "no_solution") return;
    if (timed_) {
      fact("found", swept_ ? fmt::format("a sample of {} four-bars", designs_.size())
                           : fmt::format("{} real cranks of {}", cranks_, counts_.classes));
    } else
      fact("found",
           certificates_ ? fmt::format("{} of {} classes of four-bars, {} certified", counts_.classes, whole_,
                                       counts_.certified)
                         : fmt::format("{} of {} solutions", counts_.classes, whole_),
           completeness_ == Completeness::incomplete ? Verdict::bad : Verdict::plain);
    if (!swept_) fact(timed_ ? "coupler curves" : "real", fmt::format("{}", counts_.real_classes));
    fact("four-bars with their driver", fmt::format("{}", counts_.designs));
    fact("without defects", fmt::format("{}", counts_.defect_free),
         counts_.defect_free > 0 ? Verdict::good : Verdict::bad);
    fact("with defects",
         fmt::format("{} branch, {} circuit, {} order", counts_.branch, counts_.circuit, counts_.order));
    if (answers_ > 0) result_.facts.push_back(transmission_fact(p_, designs_[0].design));
    if (counts_.infinite + counts_.singular + counts_.lost > 0)
      fact("paths without a solution", fmt::format("{} to infinity, {} where solutions meet, {} lost",
                                                   counts_.infinite, counts_.singular, counts_.lost));
    const study::AddWarning warn{result_.diagnostics};
    if (certificates_ && completeness_ == Completeness::complete)
      fact("evidence",
           "each class is proved to be a solution and different from the others; that there are no more than "
           "1442 is a numerical result, not a theorem");
    if (completeness_ == Completeness::special_target)
      warn(fmt::format("the points are special: {} of {} solutions lie at infinity or coincide",
                       whole_ - counts_.classes, whole_),
           "mirror-symmetric points, points on a line or on a grid are such; move one of them a little to "
           "see the rest");
    if (counts_.defect_free == 0) offer_order(warn);
    if (dependent_ && answers_ == 0)
      warn("the points and crank angles depend on each other: infinitely many cranks hold them",
           "move a point, or change a crank angle");
    if (stopped_ == Status::done && counts_.lost > 0)
      warn(fmt::format("{} paths were lost: four-bars may be missing", counts_.lost),
           "move a point a little and compare");
  }

  // Designs that only meet the points in another order: the order that most of them have.
  void offer_order(const study::AddWarning& warn) const {
    std::map<std::vector<int>, int> orders;
    for (const ExactDesign& d : designs_)
      if (const std::vector<int> order = passing_order(p_, d); !order.empty()) ++orders[order];
    if (orders.empty()) return;
    const auto best = std::max_element(orders.begin(), orders.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    std::string list;
    for (const int k : best->first) list += fmt::format("{}{}", list.empty() ? "" : ", ", k + 1);
    warn(fmt::format("in the order {} {} of these four-bars would pass the points in one motion", list,
                     best->second),
         "write the points in that order if it will do");
  }

  const PathProblem& p_;
  const PathParameters& parameters_;
  const study::Common& common_;
  study::Result result_;
  Status stopped_ = Status::done;
  Completeness completeness_ = Completeness::incomplete;
  ExactCounts counts_;
  std::vector<ExactDesign> designs_;
  std::size_t answers_ = 0;
  int whole_ = 0;
  bool certificates_ = true;
  bool timed_ = false, swept_ = false, dependent_ = false;
  int cranks_ = 0, slides_ = 0;
  const char* what_ = "";
  std::string outcome_;
};

}  // namespace

study::Result run_exact_path_study(const PathStudy& s, const study::Common& common, RunContext& context) {
  return ExactReport(s, common).make(context);
}

}  // namespace linkwright::planar
