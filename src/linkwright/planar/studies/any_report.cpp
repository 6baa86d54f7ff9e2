// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/any_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/type_synthesis/title.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {

AnyReport::AnyReport(const AnyStudy& study, const study::Common& common)
    : s_(study),
      common_(common),
      motion_(*study.motion),
      limits_(limits_of(study.limits, study.motion->stroke)) {}

study::Result AnyReport::make(RunContext& context) {
  answer_ = search_machines(s_, common_, limits_, context, result_);
  look_at_machines(context, false);
  figures_ = refine_list(s_.refinement, motion_, search_options(s_, common_, limits_), common_.output.samples,
                         answer_, context, error_limit());
  if (figures_.refined) look_at_machines(context, true);
  answer_.status = context.interruption();
  result_.status = answer_.status;
  if (answer_.status == Status::done && answer_.machines.empty()) result_.status = Status::infeasible;
  for (std::size_t i = 0; i < answer_.machines.size(); ++i) add_solution(i);
  add_machine_table();
  add_search_tables(answer_, search_error(), result_);
  if (figures_.refined) {
    result_.statistics["refinements"] = figures_.descents;
    result_.statistics["refinement_steps"] = figures_.steps;
  }
  add_findings();
  return std::move(result_);
}

void AnyReport::keep(std::span<const std::size_t> kept) {
  std::vector<FoundMachine> machines;
  for (const std::size_t i : kept) machines.push_back(answer_.machines[i]);
  answer_.machines = std::move(machines);
  keep_figures(figures_, kept);
}

std::string AnyReport::suffix_of(std::size_t i) { return i == 0 ? std::string() : fmt::format("-{}", i + 1); }

void AnyReport::add_solution(std::size_t i) {
  const FoundMachine& found = answer_.machines[i];
  const PointProgram& program = *found.machine.shape.program;
  const MachineMeasures& m = found.measures;
  study::Solution out;
  out.label = label_of(i);
  FoundLinkage of = found_linkage(found.machine, motion_.stroke);
  if (s_.refinement.loaded) add_loads(of, loads_of(s_.refinement));
  add_link_lengths(of.linkage, out);
  out.classification["family"] = std::string(name_of(program.family));
  out.classification["program"] = program.name;
  out.classification["type"] = short_name_of(program);
  out.classification["links"] = program.links;
  describe(i, of, out);
  out.objectives["least_pair_angle_rad"] = m.min_pair_angle;
  out.objectives["size_m"] = m.size * size();
  out.objectives["longest_link_m"] = m.max_length * size();
  if (const std::string limit = limited_by(found); !limit.empty()) out.classification["limited_by"] = limit;
  add_figures(figures_, i, out);
  draw(i, of, out);
  result_.solutions.push_back(std::move(out));
}

/// The limits that a machine has come to.
std::string AnyReport::limited_by(const FoundMachine& found) const {
  const MachineMeasures& m = found.measures;
  std::vector<std::string> out;
  if (m.min_pair_angle < limits_.min_pair_angle + 0.01) out.emplace_back("least_pair_angle");
  if (m.max_length > limits_.max_length * 0.995) out.emplace_back("longest_link");
  if (m.min_length < limits_.min_length * 1.01) out.emplace_back("shortest_link");
  if (const auto& box = limits_.ground_box) {
    const MachineShape& shape = found.machine.shape;
    double inside = infinity;
    for (const GroundPivot& pivot : ground_pivots(*shape.program)) {
      const std::complex<double> at = place_of(pivot, *shape.program, shape.x);
      inside = std::min({inside, at.real() - box->left, box->right - at.real(), at.imag() - box->bottom,
                         box->top - at.imag()});
    }
    if (inside < 0.01) out.emplace_back("ground_box");
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

/// The machine by the solver of any linkage, which knows nothing of the search.
void AnyReport::draw(std::size_t i, const FoundLinkage& of, study::Solution& out) {
  const PlanResult planned = plan_linkage(of.linkage);
  LinkageMotion moving(planned.plan);
  const int body = body_index(of.linkage, std::string_view(of.traced).substr(0, of.traced.find('.')));
  const std::vector<double> crank = crank_angles(i, of);
  std::vector<LinkageRecord> records;
  std::vector<PartState<double>> states;
  for (const double angle : crank) {
    const InputMotion input{angle, 0, 0};
    solve_motion(planned.plan, std::span(&input, 1), moving);
    records.push_back(record_of(of.linkage, planned.plan, moving, nullptr, angle));
    states.push_back(body_state(planned.plan, moving, body));
  }
  study::Scene scene = linkage_scene(of.linkage, planned.plan, records, {point_named(of.linkage, of.traced)},
                                     "crank_angle_rad", "crank angle");
  scene.name = fmt::format("solution-{}", i + 1);
  scene.title = say("{}: {}", count_of(static_cast<double>(i + 1)), out.label);
  add_motion(i, of, crank, states, scene);
  out.scene = scene.name;
  result_.scenes.push_back(std::move(scene));
  out.study = motion_study(of.linkage, true, crank, of.traced);
  load_design(s_.refinement, out.study);
}

void AnyReport::add_machine_table() {
  if (answer_.machines.empty()) return;
  Table table{.name = "machines"};
  for (const FoundMachine& found : answer_.machines) table.names.push_back(found.machine.shape.program->name);
  using M = const MachineMeasures&;
  table.add("links", "links", column_of([&](std::size_t i) {
              return static_cast<double>(answer_.machines[i].machine.shape.program->links);
            }));
  add_columns(table);
  table.add("least_pair_angle_rad", "least pair angle (rad)",
            measures_of([](M m) { return m.min_pair_angle; }));
  table.add("size_m", "larger side of the box of all pins (m)",
            measures_of([&](M m) { return m.size * size(); }));
  table.add("shortest_link_m", "shortest length (m)",
            measures_of([&](M m) { return m.min_length * size(); }));
  table.add("longest_link_m", "longest length (m)", measures_of([&](M m) { return m.max_length * size(); }));
  add_last_columns(table);
  add_figure_columns(figures_, table);
  result_.tables.push_back(std::move(table));
  add_figure_plots(figures_, compared_by(), result_);
}

/// The machine with the fewest links, where that is not the best one.
void AnyReport::add_simplest(const study::AddFact& fact) const {
  const auto& list = answer_.machines;
  const auto links = [](const FoundMachine& m) { return m.machine.shape.program->links; };
  const auto simplest =
      std::min_element(list.begin(), list.end(),
                       [&](const FoundMachine& a, const FoundMachine& b) { return links(a) < links(b); });
  if (links(*simplest) >= links(list[0])) return;
  fact("best machine with the fewest links",
       say("{} links ({}), {}", count_of(links(*simplest)), short_name_of(*simplest->machine.shape.program),
           error_in_words(static_cast<std::size_t>(simplest - list.begin()))));
}

void AnyReport::add_findings() {
  const study::AddFact fact{result_.facts};
  introduce(fact);
  if (answer_.machines.empty()) {
    const FoundMachine* nearest = nearest_outside(answer_);
    report_none_found(answer_, nearest ? error_outside(nearest->measures) : Measured{}, result_);
    return;
  }
  const FoundMachine& best = answer_.machines[0];
  const PointProgram& program = *best.machine.shape.program;
  fact("best machine", say("{} ({})", title_of(program), program.name));
  const Measured pair_angle = degrees_of(best.measures.min_pair_angle).fixed(1);
  tell_of_best(fact, count_of(program.links), pair_angle);
  const std::string over = motion_.turns ? "over the whole turn" : "over the range";
  fact("least pair angle " + over, pair_angle);
  fact("box of the pins " + over + ", larger side", length(best.measures.size));
  add_simplest(fact);
  add_figure_facts(s_.refinement, figures_, *result_.table("machines"), motion_, fact);
  fact("curves computed", count_of(static_cast<double>(answer_.curves)));
  add_remarks(fact);
}

}  // namespace linkwright::planar
