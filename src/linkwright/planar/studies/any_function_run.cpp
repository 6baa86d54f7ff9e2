// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/optimise/parallel.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/studies/any_machine.h"
#include "linkwright/planar/studies/any_search_tables.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/type_synthesis/curve.h"
#include "linkwright/planar/type_synthesis/found_linkage.h"
#include "linkwright/planar/type_synthesis/minimax.h"
#include "linkwright/planar/type_synthesis/title.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {
namespace {

constexpr std::size_t looked_at = 4001;  // places of the range at which the greatest error is sought

/// The errors of a machine over the whole range, closer than the samples that it was fitted to.
struct FunctionFindings {
  double greatest = 0;       ///< rad, or m
  double root_mean = 0;      ///< root mean square
  double worst_rest = 0;     ///< greatest departure from its mean while it is to rest
  std::vector<double> rest;  ///< value at which it rests, of each dwell: rad, or m
};

class FunctionReport {
 public:
  FunctionReport(const AnyStudy& s, const study::Common& common, const MachineLimits& limits,
                 TypeSearchAnswer answer)
      : s_(s),
        p_(s.function.problem),
        common_(common),
        motion_(*s.motion),
        limits_(limits),
        answer_(std::move(answer)) {}

  study::Result make(RunContext& context) {
    find_errors(context);
    refine(context);
    answer_.status = context.interruption();
    result_.status = answer_.status;
    if (answer_.status == Status::done && answer_.machines.empty()) result_.status = Status::infeasible;
    for (std::size_t i = 0; i < answer_.machines.size(); ++i) solution(i);
    machine_table();
    add_search_tables(answer_,
                      {slider() ? "structural_error_rms_m" : "structural_error_rms_rad", unit(), scale()},
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
  /// A size of the target, or a radian, in the unit of the output.
  double scale() const { return slider() ? size() : 1; }
  std::string key(const char* name) const { return fmt::format("{}_{}", name, unit()); }
  std::string label(const char* text) const { return fmt::format("{} ({})", text, unit()); }
  Measured output(double value, int digits = 3) const {
    return slider() ? millimetres(value, digits) : degrees_of(value, digits);
  }
  Measured length(double sizes) const { return millimetres(sizes * size(), 3); }

  double share_of(double turned) const { return turned / p_.input_range; }
  /// The dwell that a rotation of the crank is in, -1 for none.
  int dwell_at(double turned) const {
    for (std::size_t i = 0; i < s_.dwells.size(); ++i)
      if (std::abs(turned) >= s_.dwells[i].from - 1e-9 && std::abs(turned) <= s_.dwells[i].to + 1e-9)
        return static_cast<int>(i);
    return -1;
  }

  /// Errors of the output from the function at rotations of the crank from the beginning, those of rests from
  /// the function, too.
  std::vector<double> errors_at(const FittedMachine& m, const std::vector<double>& turned) const {
    const std::size_t n = turned.size(), padded = (n + 7) / 8 * 8;
    std::vector<double> angle(padded), px(padded), py(padded), bx(padded), by(padded), out;
    for (std::size_t k = 0; k < padded; ++k) angle[k] = m.angle[0] + turned[std::min(k, n - 1)];
    CurveTask task{.program = m.shape.program,
                   .x = m.shape.x.data(),
                   .signs = m.shape.signs,
                   .angle = angle.data(),
                   .count = padded,
                   .px = px.data(),
                   .py = py.data()};
    // A slider has one pin, and so no angle.
    if (!slider()) task.bx = bx.data(), task.by = by.data();
    compute_curve(task);
    for (std::size_t k = 0; k < n; ++k) {
      const double wanted = p_.output(share_of(turned[k]));
      out.push_back(
          slider() ? motion_.stroke.centre.real() + size() * px[k] - wanted
                   : math::wrap_angle(std::arg(std::complex<double>(bx[k], by[k])) + m.body_angle - wanted));
    }
    return out;
  }

  FunctionFindings findings_of(const FittedMachine& m) const {
    std::vector<double> turned;
    for (std::size_t k = 0; k < looked_at; ++k)
      turned.push_back(p_.input_range * static_cast<double>(k) / (looked_at - 1));
    std::vector<double> error = errors_at(m, turned);
    FunctionFindings out;
    out.rest.assign(s_.dwells.size(), 0);
    std::vector<double> count(s_.dwells.size(), 0);
    const auto reached = [&](std::size_t k) { return error[k] + p_.output(share_of(turned[k])); };
    std::vector<double> first(s_.dwells.size(), nan);
    for (std::size_t k = 0; k < looked_at; ++k)
      if (const int i = dwell_at(turned[k]); i >= 0) {
        const auto d = static_cast<std::size_t>(i);
        if (std::isnan(first[d])) first[d] = reached(k);
        out.rest[d] += slider() ? reached(k) : first[d] + math::wrap_angle(reached(k) - first[d]);
        count[d] += 1;
      }
    for (std::size_t d = 0; d < count.size(); ++d) out.rest[d] /= std::max(count[d], 1.0);
    double squares = 0;
    for (std::size_t k = 0; k < looked_at; ++k) {
      const int i = dwell_at(turned[k]);
      if (i >= 0) {
        const double apart = reached(k) - out.rest[static_cast<std::size_t>(i)];
        error[k] = slider() ? apart : math::wrap_angle(apart);
        out.worst_rest = std::max(out.worst_rest, std::abs(error[k]));
      }
      out.greatest = std::max(out.greatest, std::abs(error[k]));
      squares += error[k] * error[k];
    }
    out.root_mean = std::sqrt(squares / looked_at);
    return out;
  }

  /// Brings each machine of the list to its least greatest error where that is asked for, and sorts the list
  /// by what is asked for.
  void find_errors(RunContext& context) {
    std::vector<FoundMachine>& list = answer_.machines;
    found_.resize(list.size());
    optimise::parallel_for(list.size(), context.threads(), [&](std::size_t i) {
      found_[i] = findings_of(list[i].machine);
      if (s_.fit != FunctionFit::minimax || context.interrupted()) return;
      FoundMachine lessened = list[i];
      RunContext part;
      part.set_part_of(context);
      lessen_greatest_error(motion_, limits_, lessened.machine, part);
      lessened.measures = MachineFitter(motion_, limits_).measure(lessened.machine);
      const FunctionFindings now = findings_of(lessened.machine);
      if (lessened.measures.defect == MachineDefect::none && now.greatest < found_[i].greatest)
        list[i] = lessened, found_[i] = now;
    });
    std::vector<std::size_t> all(list.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    keep_sorted(std::move(all));
  }

  /// The error that machines are compared by.
  double error_of(const FunctionFindings& found) const {
    return s_.fit == FunctionFit::minimax ? found.greatest : found.root_mean;
  }

  /// Keeps machines of the list, sorted by their errors.
  void keep_sorted(std::vector<std::size_t> kept) {
    std::stable_sort(kept.begin(), kept.end(),
                     [&](std::size_t a, std::size_t b) { return error_of(found_[a]) < error_of(found_[b]); });
    std::vector<FoundMachine> sorted;
    std::vector<FunctionFindings> errors;
    for (const std::size_t i : kept) sorted.push_back(answer_.machines[i]), errors.push_back(found_[i]);
    answer_.machines = std::move(sorted), found_ = std::move(errors);
    keep_figures(figures_, kept);
  }

  /// Refines the list for the objectives: errors are limited over the whole range, closer than the samples.
  void refine(RunContext& context) {
    const FunctionErrorLimit limit{
        .greatest = s_.fit == FunctionFit::minimax,
        .whole_error = [&](const FittedMachine& m) { return error_of(findings_of(m)) / scale(); }};
    figures_ = refine_list(s_.refinement, motion_, search_options(s_, limits_), common_.output.samples,
                           answer_, context, limit);
    if (!figures_.refined) return;
    found_.clear();
    std::vector<std::size_t> all;
    for (const FoundMachine& found : answer_.machines)
      all.push_back(all.size()), found_.push_back(findings_of(found.machine));
    keep_sorted(std::move(all));
  }

  void solution(std::size_t i) {
    const FoundMachine& found = answer_.machines[i];
    const PointProgram& program = *found.machine.shape.program;
    const MachineMeasures& m = found.measures;
    study::Solution out;
    out.label = say("{}, greatest error {}, pair angle {}", title_of(program), output(found_[i].greatest),
                    degrees_of(m.min_pair_angle).fixed(1));
    FoundLinkage of = found_linkage(found.machine, motion_.stroke);
    if (s_.refinement.loaded) add_loads(of, loads_of(s_.refinement));
    add_link_lengths(of.linkage, out);
    out.objectives[key("structural_error")] = found_[i].greatest;
    out.objectives[key("structural_error_rms")] = found_[i].root_mean;
    if (!s_.dwells.empty()) out.objectives[key("rest_error")] = found_[i].worst_rest;
    out.objectives["least_pair_angle_rad"] = m.min_pair_angle;
    out.objectives["size_m"] = m.size * size();
    out.objectives["longest_link_m"] = m.max_length * size();
    out.classification["family"] = std::string(name_of(program.family));
    out.classification["program"] = program.name;
    out.classification["type"] = short_name_of(program);
    out.classification["links"] = program.links;
    out.classification["output"] = of.traced.substr(0, of.traced.find('.'));
    add_figures(figures_, i, out);
    out.classification["crank_begins_rad"] = found.machine.angle[0] + of.crank_angle;
    if (!slider()) out.classification["output_angle_on_link_rad"] = found.machine.body_angle;
    drawing(i, of, out);
    result_.solutions.push_back(std::move(out));
  }

  /// The output by the solver of any linkage, which knows nothing of the search.
  void drawing(std::size_t i, const FoundLinkage& of, study::Solution& out) {
    const FittedMachine& machine = answer_.machines[i].machine;
    const PlanResult planned = plan_linkage(of.linkage);
    LinkageMotion moving(planned.plan);
    const std::string body = of.traced.substr(0, of.traced.find('.'));
    int output_body = 0;
    while (of.linkage.bodies[static_cast<std::size_t>(output_body)].name != body) ++output_body;
    const FunctionStudy& f = s_.function;
    std::vector<double> x, input, crank, wanted, reached, error;
    std::vector<LinkageRecord> records;
    const int samples = common_.output.samples;
    for (int k = 0; k < samples; ++k) {
      const double share = static_cast<double>(k) / (samples - 1);
      x.push_back(f.x_from + (f.x_to - f.x_from) * share);
      input.push_back(p_.input_range * share);
      crank.push_back(machine.angle[0] + of.crank_angle + input.back());
      const InputMotion turned{crank.back(), 0, 0};
      solve_motion(planned.plan, std::span(&turned, 1), moving);
      records.push_back(record_of(of.linkage, planned.plan, moving, nullptr, crank.back()));
      const PartState<double> state = body_state(planned.plan, moving, output_body);
      const int dwell = dwell_at(input.back());
      wanted.push_back(dwell < 0 ? p_.output(share) : found_[i].rest[static_cast<std::size_t>(dwell)]);
      error.push_back(slider() ? state.origin.x - wanted.back()
                               : math::wrap_angle(std::atan2(state.direction.y, state.direction.x) +
                                                  machine.body_angle - wanted.back()));
      reached.push_back(wanted.back() + error.back());
    }
    const std::string suffix = i == 0 ? "" : fmt::format("-{}", i + 1);
    Table table{.name = "structural_error" + suffix};
    table.add("x", "x", std::move(x));
    table.add("input_rad", "rotation of the crank from the start (rad)", std::move(input));
    table.add(key("wanted"), label("wanted output"), std::move(wanted));
    table.add(key("output"), label("output"), std::move(reached));
    table.add(key("error"), label("structural error"), std::move(error));
    result_.tables.push_back(std::move(table));
    const study::AddPlot plot{result_, {.table = "structural_error" + suffix, .x = "input_rad"}};
    const std::string which = i == 0 ? "" : fmt::format(" of solution {}", i + 1);
    plot("error" + suffix, "Structural error" + which, {key("error")});
    plot("output" + suffix, "Output, and what is wanted" + which, {key("output"), key("wanted")});
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
    const auto column = [&](std::string name, std::string text, auto&& value) {
      std::vector<double> values;
      for (std::size_t i = 0; i < found_.size(); ++i) values.push_back(value(answer_.machines[i], found_[i]));
      table.add(std::move(name), std::move(text), std::move(values));
    };
    using M = const FoundMachine&;
    using F = const FunctionFindings&;
    for (const FoundMachine& found : answer_.machines)
      table.names.push_back(found.machine.shape.program->name);
    column("links", "links", [](M m, F) { return static_cast<double>(m.machine.shape.program->links); });
    column(key("structural_error"), label("greatest error"), [](M, F f) { return f.greatest; });
    column(key("structural_error_rms"), label("root mean square error"), [](M, F f) { return f.root_mean; });
    if (!s_.dwells.empty())
      column(key("rest_error"), label("greatest departure from rest"), [](M, F f) { return f.worst_rest; });
    column("least_pair_angle_rad", "least pair angle (rad)",
           [](M m, F) { return m.measures.min_pair_angle; });
    column("size_m", "larger side of the box of all pins (m)",
           [&](M m, F) { return m.measures.size * size(); });
    column("shortest_link_m", "shortest length (m)", [&](M m, F) { return m.measures.min_length * size(); });
    column("longest_link_m", "longest length (m)", [&](M m, F) { return m.measures.max_length * size(); });
    add_figure_columns(figures_, table);
    result_.tables.push_back(std::move(table));
    add_figure_plots(figures_, key("structural_error"), result_);
  }

  void findings() {
    const study::AddFact fact{result_.facts};
    fact("function", say("{}, x = {} to {}", s_.function.name, plain_number(s_.function.x_from),
                         plain_number(s_.function.x_to)));
    if (answer_.machines.empty()) {
      const FoundMachine* nearest = nearest_outside(answer_);
      report_none_found(answer_, nearest ? output(nearest->measures.error * scale()) : Measured{}, result_);
      return;
    }
    const FoundMachine& best = answer_.machines[0];
    const PointProgram& program = *best.machine.shape.program;
    const Measured greatest = output(found_[0].greatest),
                   pair = degrees_of(best.measures.min_pair_angle).fixed(1);
    result_.headline =
        say("A machine of {} links generates the function within {}, pair angles of at least {}.",
            count_of(program.links), greatest, pair);
    fact("best machine", say("{} ({})", title_of(program), program.name));
    report_greatest_error(p_, greatest, result_);
    fact("root mean square error", output(found_[0].root_mean));
    for (std::size_t d = 0; d < s_.dwells.size(); ++d)
      fact(s_.dwells.size() == 1 ? std::string("value at which the output rests")
                                 : fmt::format("value at which the output rests, dwell {}", d + 1),
           output(found_[0].rest[d], 4));
    if (!s_.dwells.empty()) fact("greatest departure from rest", output(found_[0].worst_rest));
    fact(motion_.turns ? "least pair angle over the whole turn" : "least pair angle over the range", pair);
    fact("box of the pins, larger side", length(best.measures.size));
    const auto simplest = std::min_element(
        answer_.machines.begin(), answer_.machines.end(), [](const FoundMachine& a, const FoundMachine& b) {
          return a.machine.shape.program->links < b.machine.shape.program->links;
        });
    const auto at = static_cast<std::size_t>(simplest - answer_.machines.begin());
    if (simplest->machine.shape.program->links < program.links)
      fact("best machine with the fewest links",
           say("{} links ({}), greatest error {}", count_of(simplest->machine.shape.program->links),
               short_name_of(*simplest->machine.shape.program), output(found_[at].greatest)));
    add_figure_facts(s_.refinement, figures_, *result_.table("machines"), motion_, fact);
    fact("curves computed", count_of(static_cast<double>(answer_.curves)));
  }

  const AnyStudy& s_;
  const FunctionProblem& p_;
  const study::Common& common_;
  const MotionTarget& motion_;
  const MachineLimits& limits_;
  TypeSearchAnswer answer_;
  std::vector<FunctionFindings> found_;  ///< of each machine of the list
  ListFigures figures_;
  study::Result result_;
};

}  // namespace

study::Result run_any_function_study(const AnyStudy& s, const study::Common& common, RunContext& context) {
  const MachineLimits limits = limits_of(s.limits, s.motion->stroke);
  return FunctionReport(s, common, limits, search_machines(s, limits, context)).make(context);
}

}  // namespace linkwright::planar
