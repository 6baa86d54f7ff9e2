// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/as_linkage.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/slider_crank.h"
#include "linkwright/planar/studies/function.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;

// A pair angle below this passes force badly (rad).
constexpr double flat_generator = 0.35;
constexpr std::size_t max_generators = 8;

bool whole(const FunctionDesign& d) { return d.assembles && d.other_branch == 0; }

class FunctionReport {
 public:
  FunctionReport(const FunctionStudy& s, const study::Common& common, FunctionAnswer answer)
      : s_(s), p_(s.problem), common_(common), answer_(std::move(answer)) {}

  study::Result make() {
    const bool any = !answer_.designs.empty() && whole(answer_.designs[0]);
    result_.status = answer_.status != Status::done ? answer_.status
                     : any                          ? Status::done
                                                    : Status::infeasible;
    int good = 0;
    for (const FunctionDesign& d : answer_.designs) good += whole(d);
    for (std::size_t i = 0; i < std::min(answer_.designs.size(), max_generators); ++i)
      if (!any || whole(answer_.designs[i])) solution(answer_.designs[i], i + 1);
    result_.statistics["generators"] = static_cast<int>(answer_.designs.size());
    result_.statistics["defect_free"] = good;
    if (p_.fit != FunctionFit::points) result_.statistics["starts"] = answer_.starts;
    result_.statistics["outcome"] = any                       ? "done"
                                    : answer_.designs.empty() ? "no_real_solution"
                                                              : "all_defective";
    findings(any, good);
    return std::move(result_);
  }

 private:
  std::string unit() const { return p_.slider ? "m" : "rad"; }
  Measured amount(double value) const { return p_.slider ? length_by_size(value) : degrees_of(value); }
  double scale() const { return s_.mechanism.ground; }

  void solution(const FunctionDesign& d, std::size_t number) {
    study::Solution out;
    const FunctionGenerator& g = d.generator;
    out.label =
        say("{}, greatest error {}", p_.slider ? "slider-crank" : "four-bar", amount(d.greatest_error));
    const auto add = [&](std::string key, std::string label, double value) {
      out.parameters.push_back({std::move(key), std::move(label), value, -infinity, infinity});
    };
    if (!p_.slider) add("ground_m", "ground link", scale());
    add("crank_m", "crank", std::abs(g.a) * scale());
    add(p_.slider ? "rod_m" : "coupler_m", p_.slider ? "rod" : "coupler", g.c * scale());
    if (!p_.slider) add("rocker_m", "rocker", std::abs(g.b) * scale());
    add("input_start_rad", "direction of the crank at the start", std::arg(g.a));
    if (p_.slider) {
      add("slider_start_m", "place of the slider at the start", g.b.real());
      add("offset_m", "offset of the guide", g.b.imag());
    } else {
      add("output_start_rad", "direction of the rocker at the start", std::arg(g.b));
    }
    out.objectives["structural_error_" + unit()] = d.greatest_error;
    out.objectives["structural_error_rms_" + unit()] = d.rms_error;
    out.objectives["least_pair_angle_rad"] = d.pair_angle;
    out.classification["assembles"] = d.assembles;
    if (!d.assembles) out.defects.push_back("circuit: does not assemble over the whole range");
    if (d.other_branch > 0)
      out.defects.push_back(
          say("branch: {} of the precision points are on the other branch", d.other_branch));
    tables(d, out, number);
    result_.solutions.push_back(std::move(out));
  }

  // Error over the range, drawing and study of a generator.
  void tables(const FunctionDesign& d, study::Solution& out, std::size_t number) {
    const FunctionGenerator& g = d.generator;
    const std::string suffix = number == 1 ? "" : fmt::format("-{}", number);
    const int samples = common_.output.samples;
    Table table;
    table.name = "structural_error" + suffix;
    std::vector<double> x, input, wanted, output, error;
    for (int k = 0; k < samples; ++k) {
      const double share = static_cast<double>(k) / (samples - 1);
      const std::optional<double> off = structural_error(p_, g, share);
      x.push_back(s_.x_from + (s_.x_to - s_.x_from) * share);
      input.push_back(p_.input_range * share);
      wanted.push_back(p_.output(share));
      error.push_back(off.value_or(nan));
      output.push_back(wanted.back() + error.back());
    }
    const std::string with_unit = fmt::format(" ({})", unit());
    table.add("x", "x", std::move(x));
    table.add("input_rad", "rotation of the crank from the start (rad)", input);
    table.add("wanted_" + unit(), "wanted output" + with_unit, std::move(wanted));
    table.add("output_" + unit(), "output" + with_unit, std::move(output));
    table.add("error_" + unit(), "structural error" + with_unit, std::move(error));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{result_, {.table = "structural_error" + suffix, .x = "x"}};
    plot("error" + suffix, "Structural error", {"error_" + unit()});
    plot("output" + suffix, "Output, and what is wanted", {"output_" + unit(), "wanted_" + unit()});
    if (!whole(d)) return;
    std::vector<double> crank = std::move(input);
    for (double& angle : crank) angle += std::arg(g.a);
    if (p_.slider) {
      const SliderCrankMechanism mechanism{g.branch > 0 ? SliderSide::forward : SliderSide::backward,
                                           {.crank = std::abs(g.a), .rod = g.c, .offset = g.b.imag()},
                                           {}};
      scene(slider_crank(mechanism), crank, out, number);
      out.study = motion_study("planar.slider_crank", study::write_fields(mechanism), crank, crank);
    } else {
      FourBarMechanism mechanism;
      mechanism.linkage = {.ground = scale(),
                           .crank = std::abs(g.a) * scale(),
                           .coupler = g.c * scale(),
                           .rocker = std::abs(g.b) * scale(),
                           .branch = g.branch > 0 ? Branch::open : Branch::crossed};
      scene(linkage_of(mechanism), crank, out, number);
      out.study = motion_study("planar.four_bar", study::write_fields(mechanism), crank, crank);
    }
  }

  void scene(const Linkage& linkage, const std::vector<double>& crank, study::Solution& out,
             std::size_t number) {
    const PlanResult planned = plan_linkage(linkage);
    if (!planned.problems.empty()) return;
    LinkageMotion motion(planned.plan);
    std::vector<LinkageRecord> records;
    for (const double angle : crank) {
      const InputMotion input{angle, 0, 0};
      solve_motion(planned.plan, std::span(&input, 1), motion);
      records.push_back(record_of(linkage, planned.plan, motion, nullptr, angle));
    }
    study::Scene scene = linkage_scene(linkage, planned.plan, records, {}, "crank_angle_rad", "crank angle");
    scene.name = fmt::format("solution-{}", number);
    scene.title = say("{}: {}", number, out.label);
    out.scene = scene.name;
    result_.scenes.push_back(std::move(scene));
  }

  void findings(bool any, int good) {
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    const char* what = p_.slider ? "slider-crank" : "four-bar";
    fact("function", say("{}, x = {} to {}", s_.name, at_place("x_from", plain_number(s_.x_from)),
                         at_place("x_to", plain_number(s_.x_to))));
    if (p_.fit == FunctionFit::points) {
      fact("precision points", say("{}", p_.at.size()));
      fact("generators through them", say("{}, {} over the whole range", answer_.designs.size(), good),
           good > 0 ? Verdict::plain : Verdict::bad);
    }
    if (!any) {
      result_.headline =
          answer_.status != Status::done ? Sentence("Stopped before a generator was found.")
          : answer_.designs.empty()
              ? say("No {} meets all precision points: there is no real solution.", what)
              : say("None of {} {}s through the precision points stays on one branch over the whole range.",
                    answer_.designs.size(), what);
      if (answer_.status == Status::done)
        warn("target", fmt::format("no {} generates the function at these points", what),
             "move the points, change the ranges, or write fit = \"minimax\"");
      return;
    }
    const FunctionDesign& best = answer_.designs[0];
    const Measured pair = degrees_of(best.pair_angle).fixed(1);
    result_.headline = say("A {} generates {} within {}, least pair angle {}.", what, s_.name,
                           amount(best.greatest_error), pair);
    report_greatest_error(p_, amount(best.greatest_error), result_);
    fact("root mean square error", amount(best.rms_error));
    fact("least pair angle", pair, best.pair_angle < flat_generator ? Verdict::bad : Verdict::plain);
    if (best.pair_angle < p_.min_pair_angle) {
      warn("mechanism",
           say("no {} was found with a pair angle of {} over the range", what,
               degrees_of(p_.min_pair_angle, 3)),
           "take smaller ranges, or a six-bar: mechanism type = \"planar.six_bar\"");
      return;
    }
    if (best.pair_angle < flat_generator)
      warn(say("the pair angle falls to {}: the linkage is near a dead point there", pair),
           "take smaller ranges, or another of the solutions");
  }

  const FunctionStudy& s_;
  const FunctionProblem& p_;
  const study::Common& common_;
  const FunctionAnswer answer_;
  study::Result result_;
};

}  // namespace

void report_greatest_error(const FunctionProblem& problem, const Measured& greatest, study::Result& result) {
  double least = problem.output(0), most = least;
  for (int k = 1; k <= 100; ++k) {
    const double output = problem.output(0.01 * k);
    least = std::min(least, output);
    most = std::max(most, output);
  }
  const double share = greatest.si / (most - least);
  const bool follows = share <= 0.1;
  study::AddFact{result.facts}("greatest structural error", greatest,
                               follows ? study::Fact::Verdict::good : study::Fact::Verdict::bad);
  if (!follows)
    study::AddWarning{result.diagnostics}(
        say("the greatest error is {} of what the output moves: the function is not followed",
            percent(share).fixed(0)),
        problem.fit == FunctionFit::points ? "write fit = \"minimax\", or move the precision points"
                                           : "take smaller ranges");
}

study::Result run_function_study(const FunctionStudy& s, const study::Common& common, RunContext& context) {
  return FunctionReport(s, common, find_generators(s.problem, context)).make();
}

}  // namespace linkwright::planar
