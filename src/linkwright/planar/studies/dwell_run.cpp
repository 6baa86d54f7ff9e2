// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/studies/dwell.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;

// Rows of the table of the dwell.
constexpr int rows_of_dwell = 121;
// The body that rests, in the linkage of a DwellLinkage.
constexpr int resting_body = 5;

// A six-bar moved by the solver of any linkage, which knows nothing of how it was found.
class DwellMotion {
 public:
  explicit DwellMotion(const Linkage& linkage)
      : linkage_(linkage), planned_(plan_linkage(linkage)), motion_(planned_.plan) {}

  const LinkagePlan& plan() const { return planned_.plan; }
  void place(double crank) {
    const InputMotion input{crank, 0, 0};
    solve_motion(planned_.plan, std::span(&input, 1), motion_);
  }
  LinkageRecord record(double crank) const {
    return record_of(linkage_, planned_.plan, motion_, nullptr, crank);
  }
  double output() const {
    const PartState<double> state = body_state(planned_.plan, motion_, resting_body);
    return std::atan2(state.direction.y, state.direction.x);
  }
  // Transmission angles of four-bar and dyad.
  std::vector<double> transmission() const {
    std::vector<double> out;
    for (std::size_t g = 0; g < planned_.plan.groups.size(); ++g)
      if (traits_of(planned_.plan.groups[g]).closes_loop)
        out.push_back(transmission_angle(planned_.plan, motion_, g));
    return out;
  }

 private:
  const Linkage& linkage_;
  PlanResult planned_;
  LinkageMotion motion_;
};

class DwellReport {
 public:
  DwellReport(const DwellStudy& s, const study::Common& common, DwellAnswer answer)
      : s_(s), common_(common), answer_(std::move(answer)) {}

  study::Result make() {
    result_.status = answer_.status;
    if (answer_.status == Status::done && answer_.designs[0].deviation > s_.target.tolerance)
      result_.status = Status::infeasible;
    for (std::size_t i = 0; i < answer_.designs.size(); ++i) solution(answer_.designs[i], i + 1);
    result_.statistics["starts"] = answer_.starts;
    result_.statistics["refined"] = answer_.refined;
    result_.statistics["within_tolerance"] =
        static_cast<int>(std::count_if(answer_.designs.begin(), answer_.designs.end(),
                                       [&](const auto& d) { return d.deviation <= s_.target.tolerance; }));
    findings();
    return std::move(result_);
  }

 private:
  void solution(const DwellDesign& d, std::size_t number) {
    study::Solution out;
    const DwellLinkage& l = d.linkage;
    const double ground = s_.mechanism.ground;
    out.label = say("rests within {}, least transmission angle {}", degrees_of(d.deviation, 3),
                    degrees_of(std::min(d.four_bar_angle, d.dyad_angle)).fixed(1));
    const auto add = [&](std::string key, std::string label, double value) {
      out.parameters.push_back({std::move(key), std::move(label), value, -infinity, infinity});
    };
    add("ground_m", "ground link", ground);
    add("crank_m", "crank", ground * l.crank);
    add("coupler_m", "coupler", ground * l.coupler);
    add("rocker_m", "rocker", ground * l.rocker);
    add("coupler_u_m", "coupler point along the coupler", ground * l.point_u);
    add("coupler_v_m", "coupler point along its left normal", ground * l.point_v);
    add("link_m", "link from the coupler point to the output", ground * l.link);
    add("output_m", "output rocker", ground * l.output);
    add("pivot_x_m", "pivot of the output, x", ground * l.pivot_x);
    add("pivot_y_m", "pivot of the output, y", ground * l.pivot_y);
    out.objectives["dwell_deviation_rad"] = d.deviation;
    out.objectives["swing_angle_rad"] = d.swing;
    out.objectives["least_transmission_angle_rad"] = std::min(d.four_bar_angle, d.dyad_angle);
    out.classification["four_bar_transmission_angle_rad"] = d.four_bar_angle;
    out.classification["dyad_transmission_angle_rad"] = d.dyad_angle;
    out.classification["dwell_from_rad"] = l.middle - s_.target.dwell / 2;
    out.classification["dwell_to_rad"] = l.middle + s_.target.dwell / 2;
    if (d.deviation > s_.target.tolerance)
      out.defects.push_back(say("departs by {} while it is to rest", degrees_of(d.deviation, 3)));
    motion(d, out, number);
    result_.solutions.push_back(std::move(out));
  }

  void motion(const DwellDesign& d, study::Solution& out, std::size_t number) {
    const Linkage linkage = linkage_of(d.linkage, s_.mechanism.ground);
    const std::string suffix = number == 1 ? "" : fmt::format("-{}", number);
    DwellMotion moving(linkage);
    const double begin = d.linkage.middle - s_.target.dwell / 2;
    std::vector<double> crank, angle, four_bar, dyad;
    std::vector<LinkageRecord> records;
    const int samples = common_.output.samples;
    for (int k = 0; k < samples; ++k) {
      crank.push_back(begin + 2 * pi * k / (samples - 1));
      moving.place(crank.back());
      records.push_back(moving.record(crank.back()));
      angle.push_back(moving.output());
      const std::vector<double> transmission = moving.transmission();
      four_bar.push_back(transmission[0]);
      dyad.push_back(transmission[1]);
    }
    math::unwrap_angles(angle);
    Table table;
    table.name = "motion" + suffix;
    table.add("crank_angle_rad", "crank angle (rad)", crank);
    table.add("output_angle_rad", "output angle (rad)", std::move(angle));
    table.add("four_bar_transmission_angle_rad", "between coupler and rocker (rad)", std::move(four_bar));
    table.add("dyad_transmission_angle_rad", "between link and output (rad)", std::move(dyad));
    result_.tables.push_back(std::move(table));
    dwell_table(d, moving, "dwell" + suffix);

    study::Scene scene = linkage_scene(linkage, moving.plan(), records, {point_named(linkage, "coupler.C")},
                                       "crank_angle_rad", "crank angle");
    scene.name = fmt::format("solution-{}", number);
    scene.title = say("{}: {}", number, out.label);
    out.scene = scene.name;
    result_.scenes.push_back(std::move(scene));
    const study::AddPlot plot{result_,
                              {.table = "motion" + suffix, .x = "crank_angle_rad", .scene = out.scene}};
    plot("output" + suffix, "Output angle, from the beginning of the dwell", {"output_angle_rad"});
    plot("transmission" + suffix, "Transmission angles",
         {"four_bar_transmission_angle_rad", "dyad_transmission_angle_rad"});
    const study::AddPlot rest{result_,
                              {.table = "dwell" + suffix, .x = "crank_angle_rad", .scene = out.scene}};
    rest("dwell" + suffix, "The output while it rests", {"departure_rad"});
    out.study = motion_study(linkage, true, crank, "coupler.C");
  }

  // Departures from the middle between the extremes of the output while it rests.
  void dwell_table(const DwellDesign& d, DwellMotion& moving, std::string name) {
    std::vector<double> crank, angle;
    for (int k = 0; k < rows_of_dwell; ++k) {
      const double share = static_cast<double>(k) / (rows_of_dwell - 1) - 0.5;
      crank.push_back(d.linkage.middle + s_.target.dwell * share);
      moving.place(crank.back());
      angle.push_back(moving.output());
    }
    math::unwrap_angles(angle);
    const auto [low, high] = std::minmax_element(angle.begin(), angle.end());
    const double middle = 0.5 * (*low + *high);
    for (double& a : angle) a -= middle;
    Table table;
    table.name = std::move(name);
    table.add("crank_angle_rad", "crank angle (rad)", std::move(crank));
    table.add("departure_rad", "departure of the output from its middle (rad)", std::move(angle));
    result_.tables.push_back(std::move(table));
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    if (answer_.designs.empty()) {
      result_.headline = answer_.status == Status::infeasible
                             ? "No six-bar with this swing and these transmission angles was found."
                             : "Stopped before a six-bar was found.";
      if (answer_.status == Status::infeasible)
        warn(
            "target", "no six-bar meets the conditions",
            "take a smaller swing angle or least transmission angle, or let the links be shorter and longer");
      return;
    }
    const DwellDesign& best = answer_.designs[0];
    const bool good = best.deviation <= s_.target.tolerance;
    const Measured deviation = degrees_of(best.deviation, 3), swing = degrees_of(best.swing, 3),
                   tolerance = degrees_of(s_.target.tolerance, 3);
    result_.headline = say("A six-bar rests within {} over {} of the crank and swings by {}.", deviation,
                           degrees_of(s_.target.dwell, 3), swing);
    fact("largest departure in the dwell", deviation, good ? Verdict::good : Verdict::bad);
    fact("tolerance", tolerance);
    fact("swing angle of the output", swing);
    fact("least transmission angle of the four-bar", degrees_of(best.four_bar_angle).fixed(1));
    fact("least transmission angle of the dyad", degrees_of(best.dyad_angle).fixed(1));
    fact("four-bars tried", say("{}, {} six-bars refined", answer_.starts, answer_.refined));
    if (!good)
      warn("target", say("no six-bar was found that rests within {}", tolerance),
           "take a shorter dwell, a smaller swing or transmission angle, or let the links be shorter and "
           "longer");
  }

  const DwellStudy& s_;
  const study::Common& common_;
  const DwellAnswer answer_;
  study::Result result_;
};

}  // namespace

study::Kind dwell_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "planar.six_bar";
  kind.target = "dwell";
  kind.summary = "six-bar whose output rests while the crank turns on";
  kind.example = templates::synthesis_six_bar_dwell();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "the six-bar"), study::schema_fields<DwellMechanism>());
    document.property(field::entry("target", "the dwell"), study::schema_fields<DwellTarget>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    DwellStudy s;
    if (auto table = document.table(field::entry("mechanism").required())) table->read(s.mechanism);
    if (auto table = document.table(field::entry("target").required())) table->read(s.target);
    study::Prepared prepared;
    prepared.canonical["mechanism"] = study::write_fields(s.mechanism);
    prepared.canonical["target"] = study::write_fields(s.target);
    prepared.run = [s, common](RunContext& context) { return run_dwell_study(s, common, context); };
    return prepared;
  };
  return kind;
}

study::Result run_dwell_study(const DwellStudy& s, const study::Common& common, RunContext& context) {
  const DwellProblem problem{.dwell = s.target.dwell,
                             .swing = s.target.swing,
                             .transmission = s.target.transmission,
                             .shortest = s.mechanism.shortest,
                             .longest = s.mechanism.longest};
  return DwellReport(s, common, find_dwells(problem, context)).make();
}

}  // namespace linkwright::planar
