// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/any_search_tables.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/planar/type_synthesis/title.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

constexpr double kept_within = 0.01;  // of the time ratio and of the range: machines that miss them are none

class QuickReturnReport {
 public:
  QuickReturnReport(const AnyStudy& s, const study::Common& common, const MachineLimits& limits,
                    TypeSearchAnswer answer)
      : s_(s),
        wanted_(*s.quick_return),
        common_(common),
        motion_(*s.motion),
        limits_(limits),
        answer_(std::move(answer)) {}

  study::Result make(RunContext& context) {
    keep_those_that_return();
    figures_ = refine_list(s_.refinement, motion_, search_options(s_, limits_), common_.output.samples,
                           answer_, context);
    keep_those_that_return();
    answer_.status = context.interruption();
    result_.status = answer_.status;
    if (answer_.status == Status::done && answer_.machines.empty()) result_.status = Status::infeasible;
    for (std::size_t i = 0; i < answer_.machines.size(); ++i) solution(i);
    machine_table();
    add_search_tables(
        answer_, {slider() ? "dead_centre_error_m" : "dead_centre_error_rad", unit(), motion_.error_unit()},
        result_);
    if (figures_.refined) {
      result_.statistics["refinements"] = figures_.descents;
      result_.statistics["refinement_steps"] = figures_.steps;
    }
    findings();
    return std::move(result_);
  }

 private:
  bool slider() const { return motion_.output == MachineOutput::slide; }
  const char* unit() const { return slider() ? "m" : "rad"; }
  double size() const { return motion_.stroke.size; }
  const char* range_key() const { return slider() ? "stroke_m" : "swing_angle_rad"; }
  Measured output(double value, int digits = 4) const {
    return slider() ? millimetres(value, digits) : degrees_of(value, digits);
  }

  /// Machines whose output has two dead centres, with the time ratio and the range; by falling pair angle.
  void keep_those_that_return() {
    strokes_.clear();
    std::vector<std::size_t> kept;
    for (const FoundMachine& found : answer_.machines) {
      const MachineStrokes& strokes = strokes_.emplace_back(strokes_of(wanted_, motion_, found.machine));
      const double of_ratio = std::abs(strokes.time_ratio / wanted_.time_ratio - 1),
                   of_range = std::abs(strokes.range / wanted_.range - 1);
      if (strokes.extremes == 2 && of_ratio <= kept_within && of_range <= kept_within)
        kept.push_back(strokes_.size() - 1);
    }
    std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) {
      return answer_.machines[a].measures.min_pair_angle > answer_.machines[b].measures.min_pair_angle;
    });
    std::vector<FoundMachine> machines;
    std::vector<MachineStrokes> strokes;
    for (const std::size_t i : kept) machines.push_back(answer_.machines[i]), strokes.push_back(strokes_[i]);
    answer_.machines = std::move(machines), strokes_ = std::move(strokes);
    keep_figures(figures_, kept);
  }

  void solution(std::size_t i) {
    const FoundMachine& found = answer_.machines[i];
    const PointProgram& program = *found.machine.shape.program;
    const MachineMeasures& m = found.measures;
    study::Solution out;
    out.label = say("{}, time ratio {}, pair angle {}", title_of(program),
                    plain_number(strokes_[i].time_ratio), degrees_of(m.min_pair_angle).fixed(1));
    FoundLinkage of = found_linkage(found.machine, motion_.stroke);
    if (s_.refinement.loaded) add_loads(of, loads_of(s_.refinement));
    add_link_lengths(of.linkage, out);
    out.objectives["time_ratio"] = strokes_[i].time_ratio;
    out.objectives[range_key()] = std::abs(strokes_[i].range);
    out.objectives["least_pair_angle_rad"] = m.min_pair_angle;
    out.objectives["size_m"] = m.size * size();
    out.objectives["longest_link_m"] = m.max_length * size();
    out.classification["family"] = std::string(name_of(program.family));
    out.classification["program"] = program.name;
    out.classification["type"] = short_name_of(program);
    out.classification["links"] = program.links;
    out.classification["output"] = of.traced.substr(0, of.traced.find('.'));
    out.classification["slow_stroke_begins_rad"] = found.machine.angle[0] + of.crank_angle;
    add_figures(figures_, i, out);
    drawing(i, of, out);
    result_.solutions.push_back(std::move(out));
  }

  /// The output over the turn by the solver of any linkage, which knows nothing of the search.
  void drawing(std::size_t i, const FoundLinkage& of, study::Solution& out) {
    const FittedMachine& machine = answer_.machines[i].machine;
    const PlanResult planned = plan_linkage(of.linkage);
    LinkageMotion moving(planned.plan);
    const int body = body_index(of.linkage, std::string_view(of.traced).substr(0, of.traced.find('.')));
    std::vector<double> turned, crank, output;
    std::vector<LinkageRecord> records;
    const int samples = common_.output.samples;
    for (int k = 0; k < samples; ++k) {
      turned.push_back((wanted_.clockwise ? -2 : 2) * pi * k / (samples - 1));
      crank.push_back(machine.angle[0] + of.crank_angle + turned.back());
      const InputMotion input{crank.back(), 0, 0};
      solve_motion(planned.plan, std::span(&input, 1), moving);
      records.push_back(record_of(of.linkage, planned.plan, moving, nullptr, crank.back()));
      const PartState<double> state = body_state(planned.plan, moving, body);
      output.push_back(slider() ? state.origin.x : std::atan2(state.direction.y, state.direction.x));
    }
    if (!slider()) math::unwrap_angles(output);
    const double begin = output.front();
    for (double& value : output) value -= begin;
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1);
    Table table{.name = "strokes" + suffix};
    table.add("input_rad", "rotation of the crank from the beginning of the slow stroke (rad)",
              std::move(turned));
    table.add(fmt::format("output_{}", unit()), fmt::format("output ({})", unit()), std::move(output));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{result_, {.table = "strokes" + suffix, .x = "input_rad"}};
    plot("output" + suffix, i == 0 ? "Output" : fmt::format("Output of solution {}", i + 1),
         {fmt::format("output_{}", unit())});
    study::Scene scene =
        linkage_scene(of.linkage, planned.plan, records, {point_named(of.linkage, of.traced)},
                      "crank_angle_rad", "crank angle");
    scene.name = fmt::format("solution-{}", i + 1);
    scene.title = say("{}: {}", count_of(static_cast<double>(i + 1)), out.label);
    out.scene = scene.name;
    result_.scenes.push_back(std::move(scene));
    out.study = motion_study(of.linkage, true, crank, of.traced);
    load_design(s_.refinement, out.study);
  }

  void machine_table() {
    if (answer_.machines.empty()) return;
    Table table{.name = "machines"};
    const auto column = [&](const char* key, const char* label, auto&& value) {
      std::vector<double> values;
      for (std::size_t i = 0; i < strokes_.size(); ++i)
        values.push_back(value(answer_.machines[i], strokes_[i]));
      table.add(key, label, std::move(values));
    };
    using M = const FoundMachine&;
    using S = const MachineStrokes&;
    for (const FoundMachine& found : answer_.machines)
      table.names.push_back(found.machine.shape.program->name);
    column("links", "links", [](M m, S) { return static_cast<double>(m.machine.shape.program->links); });
    column("time_ratio", "time of the slow stroke over that of the quick one",
           [](M, S s) { return s.time_ratio; });
    column(range_key(), slider() ? "stroke (m)" : "swing angle (rad)",
           [](M, S s) { return std::abs(s.range); });
    column("least_pair_angle_rad", "least pair angle (rad)",
           [](M m, S) { return m.measures.min_pair_angle; });
    column("size_m", "larger side of the box of all pins (m)",
           [&](M m, S) { return m.measures.size * size(); });
    column("shortest_link_m", "shortest length (m)", [&](M m, S) { return m.measures.min_length * size(); });
    column("longest_link_m", "longest length (m)", [&](M m, S) { return m.measures.max_length * size(); });
    add_figure_columns(figures_, table);
    result_.tables.push_back(std::move(table));
    add_figure_plots(figures_, "least_pair_angle_rad", result_);
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    if (answer_.machines.empty()) {
      const FoundMachine* nearest = nearest_outside(answer_);
      report_none_found(
          answer_, nearest ? output(nearest->measures.error * motion_.error_unit()) : Measured{}, result_);
      return;
    }
    const FoundMachine& best = answer_.machines[0];
    const PointProgram& program = *best.machine.shape.program;
    const Measured pair = degrees_of(best.measures.min_pair_angle).fixed(1),
                   range = output(std::abs(strokes_[0].range));
    const Measured ratio = plain_number(strokes_[0].time_ratio);
    result_.headline =
        say("A machine of {} links returns {} times as quickly as it goes forth over {}, pair angles "
            "of at least {}.",
            count_of(program.links), ratio, range, pair);
    fact("best machine", say("{} ({})", title_of(program), program.name));
    fact("time ratio of the slow and the quick stroke", ratio);
    fact(slider() ? "stroke" : "swing angle", range);
    fact("least pair angle over the whole turn", pair);
    fact("box of the pins, larger side", millimetres(best.measures.size * size(), 3));
    add_figure_facts(s_.refinement, figures_, *result_.table("machines"), motion_, fact);
    fact("curves computed", count_of(static_cast<double>(answer_.curves)));
  }

  const AnyStudy& s_;
  const QuickReturn& wanted_;
  const study::Common& common_;
  const MotionTarget& motion_;
  const MachineLimits& limits_;
  TypeSearchAnswer answer_;
  std::vector<MachineStrokes> strokes_;  ///< of each machine of the list
  ListFigures figures_;
  study::Result result_;
};

}  // namespace

study::Result run_any_quick_return_study(const AnyStudy& s, const study::Common& common,
                                         RunContext& context) {
  const MachineLimits limits = limits_of(s.limits, s.motion->stroke);
  return QuickReturnReport(s, common, limits, search_machines(s, limits, context)).make(context);
}

}  // namespace linkwright::planar
