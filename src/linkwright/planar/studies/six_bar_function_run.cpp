// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/function/stephenson_synthesis.h"
#include "linkwright/planar/function/watt_synthesis.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/studies/function.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;

// The output in the linkage of either generator.
constexpr int six_bar_output_body = 5;

std::complex<double> input_pin(const WattGenerator& g) { return g.first.a; }
std::complex<double> input_pin(const StephensonGenerator& g) { return g.a; }
std::complex<double> output_pin(const WattGenerator& g) { return g.second.b; }
std::complex<double> output_pin(const StephensonGenerator& g) { return g.b; }
std::string_view output_point(const WattGenerator&) { return "output.H"; }
std::string_view output_point(const StephensonGenerator&) { return "output.F"; }

using AddLength = std::function<void(std::string key, std::string label, double value)>;
void add_numbers(const WattGenerator& g, double scale, const AddLength& add) {
  const auto& [first, second] = g;
  add("ground_m", "ground link of either four-bar", scale);
  add("crank_m", "crank", std::abs(first.a) * scale);
  add("coupler_m", "coupler", first.c * scale);
  add("rocker_m", "rocker, to the coupler", std::abs(first.b) * scale);
  add("rocker_link_m", "rocker, to the link", std::abs(second.a) * scale);
  add("rocker_angle_rad", "angle between both arms of the rocker",
      math::wrap_angle(std::arg(second.a) - std::arg(first.b)));
  add("link_m", "link from the rocker to the output", second.c * scale);
}
void add_numbers(const StephensonGenerator& g, double scale, const AddLength& add) {
  add("ground_m", "ground link of the four-bar", scale);
  add("crank_m", "crank", std::abs(g.a) * scale);
  add("coupler_m", "coupler", g.coupler * scale);
  add("rocker_m", "rocker", g.rocker * scale);
  add("coupler_u_m", "pin of the link, along the coupler", g.point.real() * scale);
  add("coupler_v_m", "pin of the link, to the left of the coupler", g.point.imag() * scale);
  add("output_pivot_x_m", "pivot of the output, along the ground link", g.pivot.real() * scale);
  add("output_pivot_y_m", "pivot of the output, to its left", g.pivot.imag() * scale);
  add("link_m", "link from the coupler to the output", g.link * scale);
}

template <class Generator>
class SixBarFunctionReport {
 public:
  SixBarFunctionReport(const FunctionStudy& s, const study::Common& common, SixBarAnswer<Generator> answer)
      : s_(s), p_(s.problem), common_(common), answer_(std::move(answer)) {}

  study::Result make() {
    result_.status = answer_.status;
    for (std::size_t i = 0; i < answer_.designs.size(); ++i) solution(answer_.designs[i], i + 1);
    result_.statistics["starts"] = answer_.starts;
    if (answer_.four_bar) {
      result_.statistics["four_bar_structural_error_rad"] = answer_.four_bar->greatest_error;
      result_.statistics["four_bar_least_pair_angle_rad"] = answer_.four_bar->pair_angle;
    }
    findings();
    return std::move(result_);
  }

 private:
  void solution(const SixBarDesign<Generator>& d, std::size_t number) {
    study::Solution out;
    const double scale = s_.mechanism.ground;
    out.label = say("six-bar, greatest error {}, least pair angle {}", degrees_of(d.greatest_error, 3),
                    degrees_of(d.pair_angle).fixed(1));
    const auto add = [&](std::string key, std::string label, double value) {
      out.parameters.push_back({std::move(key), std::move(label), value, -infinity, infinity});
    };
    add_numbers(d.generator, scale, add);
    add("output_m", "output", std::abs(output_pin(d.generator)) * scale);
    add("input_start_rad", "direction of the crank at the start", std::arg(input_pin(d.generator)));
    add("output_start_rad", "direction of the output at the start", std::arg(output_pin(d.generator)));
    out.objectives["structural_error_rad"] = d.greatest_error;
    out.objectives["structural_error_rms_rad"] = d.rms_error;
    out.objectives["least_pair_angle_rad"] = d.pair_angle;
    if (d.pair_angle < s_.transmission)
      out.defects.push_back(say("transmits force badly: {}", degrees_of(d.pair_angle).fixed(1)));
    tables(d, out, number);
    result_.solutions.push_back(std::move(out));
  }

  // Error over the range by the solver of any linkage, beside that of the best four-bar; drawing and study.
  void tables(const SixBarDesign<Generator>& d, study::Solution& out, std::size_t number) {
    const std::string suffix = number == 1 ? "" : fmt::format("-{}", number);
    const Linkage linkage = linkage_of(d.generator, s_.mechanism.ground);
    const PlanResult planned = plan_linkage(linkage);
    LinkageMotion moving(planned.plan);
    Table table;
    table.name = "structural_error" + suffix;
    const int samples = common_.output.samples;
    std::vector<double> x, input, crank, wanted, output, error, of_four_bar;
    std::vector<LinkageRecord> records;
    for (int k = 0; k < samples; ++k) {
      const double share = static_cast<double>(k) / (samples - 1);
      x.push_back(s_.x_from + (s_.x_to - s_.x_from) * share);
      input.push_back(p_.input_range * share);
      crank.push_back(input.back() + std::arg(input_pin(d.generator)));
      const InputMotion turned{crank.back(), 0, 0};
      solve_motion(planned.plan, std::span(&turned, 1), moving);
      records.push_back(record_of(linkage, planned.plan, moving, nullptr, crank.back()));
      const PartState<double> state = body_state(planned.plan, moving, six_bar_output_body);
      const std::complex<double> direction(state.direction.x, state.direction.y);
      wanted.push_back(p_.output(share));
      error.push_back(
          math::wrap_angle(std::arg(direction) - std::arg(output_pin(d.generator)) - wanted.back()));
      output.push_back(wanted.back() + error.back());
      of_four_bar.push_back(
          answer_.four_bar ? structural_error(p_, answer_.four_bar->generator, share).value_or(nan) : nan);
    }
    table.add("x", "x", std::move(x));
    table.add("input_rad", "rotation of the crank from the start (rad)", std::move(input));
    table.add("wanted_rad", "wanted output (rad)", std::move(wanted));
    table.add("output_rad", "output (rad)", std::move(output));
    table.add("error_rad", "structural error (rad)", std::move(error));
    table.add("four_bar_error_rad", "structural error of the best four-bar (rad)", std::move(of_four_bar));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{result_, {.table = "structural_error" + suffix, .x = "x"}};
    const std::string of = number == 1 ? "" : fmt::format(" of solution {}", number);
    plot("error" + suffix, "Structural error" + of, {"error_rad"});
    if (number == 1 && answer_.four_bar)
      plot("four-bar", "Structural error, and that of the best four-bar",
           {"error_rad", "four_bar_error_rad"});
    plot("output" + suffix, "Output, and what is wanted" + of, {"output_rad", "wanted_rad"});
    study::Scene scene =
        linkage_scene(linkage, planned.plan, records, {point_named(linkage, output_point(d.generator))},
                      "crank_angle_rad", "crank angle");
    scene.name = fmt::format("solution-{}", number);
    scene.title = say("{}: {}", number, out.label);
    out.scene = scene.name;
    result_.scenes.push_back(std::move(scene));
    out.study = motion_study(linkage, true, crank, std::string(output_point(d.generator)));
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    fact("function", say("{}, x = {} to {}", s_.name, at_place("x_from", plain_number(s_.x_from)),
                         at_place("x_to", plain_number(s_.x_to))));
    if (answer_.designs.empty()) {
      result_.headline = answer_.status == Status::infeasible
                             ? "No six-bar was found that assembles over the range."
                             : "Stopped before a six-bar was found.";
      if (answer_.status == Status::infeasible)
        warn("target", "no six-bar generates the function",
             "take smaller ranges, or let the links be longer");
      return;
    }
    const SixBarDesign<Generator>& best = answer_.designs[0];
    const bool steep = best.pair_angle >= s_.transmission;
    const Measured greatest = degrees_of(best.greatest_error, 3), pair = degrees_of(best.pair_angle).fixed(1);
    result_.headline = say("A six-bar generates {} within {}, least pair angle {}.", s_.name, greatest, pair);
    report_greatest_error(p_, greatest, result_);
    fact("root mean square error", degrees_of(best.rms_error, 3));
    fact("least pair angle", pair, steep ? Verdict::plain : Verdict::bad);
    if (answer_.four_bar) {
      fact("greatest error of the best four-bar", degrees_of(answer_.four_bar->greatest_error, 3));
      fact("its least pair angle", degrees_of(answer_.four_bar->pair_angle).fixed(1));
    }
    if (!steep)
      warn("mechanism",
           say("no six-bar was found with a pair angle of {} over the range", degrees_of(s_.transmission, 3)),
           "take smaller ranges, or let the links be longer");
  }

  const FunctionStudy& s_;
  const FunctionProblem& p_;
  const study::Common& common_;
  const SixBarAnswer<Generator> answer_;
  study::Result result_;
};

}  // namespace

study::Result run_six_bar_function_study(const FunctionStudy& s, const study::Common& common,
                                         RunContext& context) {
  if (s.structure == SixBarStructure::stephenson_3)
    return SixBarFunctionReport(s, common, find_stephenson_generators(s.problem, s.transmission, context))
        .make();
  return SixBarFunctionReport(s, common, find_watt_generators(s.problem, s.transmission, context)).make();
}

}  // namespace linkwright::planar
