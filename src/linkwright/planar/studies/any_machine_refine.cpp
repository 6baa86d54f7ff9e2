// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/any_machine_refine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "linkwright/math/angles.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {
namespace {

/// Key and label of the column of a quantity, its name in facts, and whether the search has the column too.
struct FigureColumn {
  std::string stem, unit, label, unit_label;
  bool of_search = false;
  std::string key() const { return stem + unit; }
  std::string key_before() const { return stem + "_before" + unit; }
};
FigureColumn figure_column(MachineQuantity quantity, MachineOutput output) {
  const bool angle = output == MachineOutput::angle;
  switch (quantity) {
    case MachineQuantity::peak_joint_force:
      return {"peak_joint_force", "_N", "peak joint force", " (N)"};
    case MachineQuantity::drive_torque:
      return {"drive_torque", "_N_m", "peak drive torque", " (N m)"};
    case MachineQuantity::size:
      return {"size", "_m", "larger side of the box of all pins", " (m)", true};
    case MachineQuantity::peak_acceleration:
      if (output != MachineOutput::point)
        return {"peak_acceleration", angle ? "_rad" : "_m",
                "peak acceleration of the output at unit crank speed", angle ? " (rad)" : " (m)"};
      return {"peak_acceleration", "_share", "peak acceleration at unit crank speed",
              ", of the size of the stroke", true};
    case MachineQuantity::tolerance_90:
      return {"tolerance_90", angle ? "_rad" : "_m",
              "error that nine of ten machines keep with their tolerances", angle ? " (rad)" : " (m)"};
  }
  return {};
}

Measured measured_figure(MachineQuantity quantity, MachineOutput output, double value) {
  switch (quantity) {
    case MachineQuantity::peak_joint_force:
      return newtons(value);
    case MachineQuantity::drive_torque:
      return newton_metres(value);
    case MachineQuantity::size:
      return millimetres(value);
    case MachineQuantity::tolerance_90:
      break;
    case MachineQuantity::peak_acceleration:
      if (output == MachineOutput::point) return plain_number(value);
      break;
  }
  return output == MachineOutput::angle ? degrees_of(value, 4) : millimetres(value);
}

/// Figures of one machine; what the refinement knows alone is given.
std::vector<double> figures_of(const AnyRefinementStudy& s, const MotionTarget& target, int samples,
                               std::span<const MachineQuantity> quantities, const FoundMachine& found,
                               std::span<const double> given) {
  PeakForces peaks;
  if (std::any_of(quantities.begin(), quantities.end(), needs_loads)) {
    FoundLinkage linkage = found_linkage(found.machine, target.stroke);
    add_loads(linkage, loads_of(s));
    peaks = peak_forces(linkage, s.loads.crank_speed, design_rows(target, found.machine, linkage, samples));
  }
  std::vector<double> out;
  for (std::size_t q = 0; q < quantities.size(); ++q) switch (quantities[q]) {
      case MachineQuantity::peak_joint_force:
        out.push_back(peaks.joint_force);
        break;
      case MachineQuantity::drive_torque:
        out.push_back(peaks.drive_torque);
        break;
      case MachineQuantity::size:
        out.push_back(found.measures.size * target.stroke.size);
        break;
      case MachineQuantity::peak_acceleration:
        out.push_back(!target.is_function() ? found.measures.peak_acceleration
                      : q < given.size()    ? given[q]
                                            : nan);
        break;
      case MachineQuantity::tolerance_90:
        out.push_back(q < given.size() ? given[q] : nan);
        break;
    }
  return out;
}

/// Range of the output of a function, in sizes or rad.
double output_range(const MotionTarget& target) {
  const auto& values = target.placed() ? target.x : target.angle;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

RefineOptions options_of(const AnyRefinementStudy& s, const MotionTarget& target,
                         const TypeSearchOptions& search) {
  RefineOptions out;
  for (const AnyObjective& o : s.objectives)
    out.objectives.push_back({.quantity = o.quantity,
                              .weight = o.weight,
                              .reference = o.reference,
                              .at_most = o.at_most.value_or(infinity)});
  out.limits = search.limits;
  out.loads = loads_of(s);
  out.length_tolerance = s.refinement.length_tolerance.value_or(1e-3 * target.stroke.size);
  out.error_growth = s.refinement.error_growth, out.error_share = s.refinement.error_share;
  if (target.is_function()) out.error_share *= output_range(target);
  out.starts = s.refinement.starts;
  out.seed = search.seed, out.max_solutions = search.max_solutions;
  return out;
}

void find_least(ListFigures& figures, const std::vector<FoundMachine>& machines,
                const std::vector<std::vector<double>>& values) {
  for (std::size_t q = 0; q < figures.quantities.size(); ++q) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < values.size(); ++i)
      if (!(values[i][q] >= values[best][q])) best = i;
    figures.least_found.push_back(values[best][q]);
    figures.least_found_name.push_back(machines[best].machine.shape.program->name);
  }
}

}  // namespace

AnyRefinementStudy read_refinement(study::ObjectReader& document, bool function) {
  AnyRefinementStudy s;
  s.function = function;
  const auto read = [](study::ObjectReader& table, auto form, auto& out) {
    table.read(form);
    out = form;
  };
  if (function) s.refinement = AnyFunctionRefinement();
  document(field::entry("objective"), s.objectives);
  std::vector<study::ObjectReader> entries = document.tables("objective");
  bool forces = false;
  for (std::size_t k = 0; k < s.objectives.size() && k < entries.size(); ++k) {
    forces = forces || needs_loads(s.objectives[k].quantity);
    for (std::size_t i = 0; i < k; ++i)
      if (s.objectives[i].quantity == s.objectives[k].quantity)
        entries[k].error("quantity",
                         fmt::format("{} is an objective already", name_of(s.objectives[k].quantity)),
                         "keep one of them");
  }
  if (auto table = document.table("machine")) {
    function ? read(*table, AnyFunctionLoads(), s.loads) : read(*table, AnyLoads(), s.loads);
    s.loaded = true;
  }
  s.loaded = s.loaded || forces;
  if (auto table = document.table("environment")) {
    table->read(s.environment);
    if (!s.loaded)
      table->warning("gravity", "the machines have no masses, so that gravity does nothing",
                     "add [machine], or an objective of forces");
  }
  if (auto table = document.table("refinement")) {
    function ? read(*table, AnyFunctionRefinement(), s.refinement)
             : read(*table, AnyRefinement(), s.refinement);
    if (!document.has("objective"))
      document.warning("refinement", "there is nothing to refine for", "add [[objective]] with a quantity");
  }
  return s;
}

void write_refinement(const AnyRefinementStudy& s, Value& canonical) {
  if (!s.objectives.empty()) {
    canonical["objective"] = study::ObjectWriter::to_value(s.objectives);
    AnyFunctionRefinement of_function;
    static_cast<AnyRefinement&>(of_function) = s.refinement;
    canonical["refinement"] =
        s.function ? study::write_fields(of_function) : study::write_fields(s.refinement);
  }
  if (!s.loaded) return;
  AnyFunctionLoads of_function;
  static_cast<AnyLoads&>(of_function) = s.loads;
  canonical["machine"] = s.function ? study::write_fields(of_function) : study::write_fields(s.loads);
  canonical["environment"] = study::write_fields(s.environment);
}

void describe_refinement(study::SchemaWriter& document, bool function) {
  document.property(field::entry("objective", "what the machines of the list are refined for"),
                    study::schema_array(study::schema_fields<AnyObjective>()));
  document.property(
      field::entry("refinement", "how far machines may change for their objectives"),
      function ? study::schema_fields<AnyFunctionRefinement>() : study::schema_fields<AnyRefinement>());
  document.property(field::entry("machine", "masses, speed and load of the machines"),
                    function ? study::schema_fields<AnyFunctionLoads>() : study::schema_fields<AnyLoads>());
  document.property(field::entry("environment", "what acts from outside"),
                    study::schema_fields<Environment>());
}

MachineLoads loads_of(const AnyRefinementStudy& s) {
  return {.mass_per_metre = s.loads.mass_per_metre,
          .crank_speed = s.loads.crank_speed,
          .force = {s.loads.force[0], s.loads.force[1]},
          .torque = s.loads.torque,
          .gravity = s.environment.gravity};
}

std::array<double, 2> drive_range(const MotionTarget& target, const FittedMachine& machine) {
  const auto s = static_cast<std::size_t>(machine.shape.program->scale());
  const double turned = std::arg(std::complex<double>(machine.shape.x[s], machine.shape.x[s + 1]));
  const double from = math::wrap_angle(machine.angle.front() + turned);
  return {from, from + machine.angle[target.count - 1] - machine.angle.front()};
}

std::vector<double> design_rows(const MotionTarget& target, const FittedMachine& machine,
                                const FoundLinkage& linkage, int samples) {
  std::vector<double> out;
  if (!target.turns) {
    const auto [first, last] = drive_range(target, machine);
    for (int k = 0; k < samples; ++k) out.push_back(first + (last - first) * k / (samples - 1));
    return out;
  }
  const double from = machine.angle.front() + linkage.crank_angle;
  for (int k = 0; k < samples; ++k) out.push_back(from + machine.sense * 2 * pi * k / (samples - 1));
  return out;
}

ListFigures refine_list(const AnyRefinementStudy& s, const MotionTarget& target,
                        const TypeSearchOptions& search, int samples, TypeSearchAnswer& answer,
                        RunContext& context, const FunctionErrorLimit& of_function) {
  ListFigures out;
  out.output = target.output;
  out.refined = !s.objectives.empty();
  for (const AnyObjective& o : s.objectives) out.quantities.push_back(o.quantity);
  if (!out.refined && s.loaded)
    out.quantities = {MachineQuantity::peak_joint_force, MachineQuantity::drive_torque};
  if (out.quantities.empty() || answer.machines.empty()) return out;
  const std::vector<FoundMachine> found = answer.machines;
  RefineAnswer refined;
  RefineOptions options = options_of(s, target, search);
  options.greatest = of_function.greatest, options.whole_error = of_function.whole_error;
  if (out.refined) refined = refine_machines(target, found, options, context);
  std::vector<std::vector<double>> as_found;
  for (std::size_t i = 0; i < found.size(); ++i)
    as_found.push_back(
        figures_of(s, target, samples, out.quantities, found[i],
                   out.refined ? std::span<const double>(refined.as_found[i]) : std::span<const double>()));
  find_least(out, found, as_found);
  if (!out.refined) {
    out.values = as_found;
    return out;
  }
  answer.machines.clear();
  for (RefinedMachine& m : refined.machines) {
    out.values.push_back(m.aim ? figures_of(s, target, samples, out.quantities, m.found, m.values)
                               : as_found[m.from]);
    out.before.push_back(as_found[m.from]);
    out.aim.push_back(m.aim);
    answer.machines.push_back(std::move(m.found));
  }
  out.descents = refined.descents, out.steps = refined.steps;
  return out;
}

void keep_figures(ListFigures& figures, std::span<const std::size_t> kept) {
  const auto keep = [&](auto& rows) {
    if (rows.empty()) return;
    auto all = std::move(rows);
    rows.clear();
    for (const std::size_t i : kept) rows.push_back(all[i]);
  };
  keep(figures.values), keep(figures.before), keep(figures.aim);
}

void load_design(const AnyRefinementStudy& s, Value& design) {
  if (!s.loaded) return;
  Value& drive = design["drive"].as_array()[0];
  std::erase_if(drive.as_object(), [](const Value::Member& m) { return m.key.starts_with("speed"); });
  drive["speed_rad_per_s"] = s.loads.crank_speed;
  design["environment"] = study::write_fields(s.environment);
  for (const char* quantity : {"reactions", "drive"}) design["output"]["quantities"].push_back(quantity);
}

void add_figure_columns(const ListFigures& figures, Table& machines) {
  const auto column = [&](const std::vector<std::vector<double>>& rows, std::size_t q) {
    std::vector<double> out;
    for (const std::vector<double>& row : rows) out.push_back(row[q]);
    return out;
  };
  for (std::size_t q = 0; q < figures.quantities.size() && !figures.values.empty(); ++q) {
    const FigureColumn what = figure_column(figures.quantities[q], figures.output);
    if (!what.of_search) machines.add(what.key(), what.label + what.unit_label, column(figures.values, q));
    if (figures.refined)
      machines.add(what.key_before(), what.label + ", before it was refined" + what.unit_label,
                   column(figures.before, q));
  }
  if (!figures.refined || figures.values.empty()) return;
  std::vector<double> aim;
  for (const auto& a : figures.aim) aim.push_back(a ? static_cast<double>(*a + 1) : 0);
  machines.add("refined_for", "number of the objective it was refined for; 0: as found, one more: all",
               std::move(aim));
}

void add_figures(const ListFigures& figures, std::size_t machine, study::Solution& solution) {
  if (machine >= figures.values.size()) return;
  for (std::size_t q = 0; q < figures.quantities.size(); ++q) {
    const FigureColumn what = figure_column(figures.quantities[q], figures.output);
    solution.objectives[what.key()] = figures.values[machine][q];
    if (figures.refined) solution.objectives[what.key_before()] = figures.before[machine][q];
  }
  if (!figures.refined) return;
  const auto& aim = figures.aim[machine];
  solution.classification["refined_for"] = !aim ? std::string("nothing")
                                           : *aim < figures.quantities.size()
                                               ? std::string(name_of(figures.quantities[*aim]))
                                               : std::string("all");
}

void add_figure_facts(const AnyRefinementStudy& s, const ListFigures& figures, const Table& machines,
                      const MotionTarget& target, const study::AddFact& fact) {
  for (std::size_t q = 0; q < figures.quantities.size() && !figures.values.empty(); ++q) {
    const MachineQuantity quantity = figures.quantities[q];
    std::size_t best = 0;
    for (std::size_t i = 1; i < figures.values.size(); ++i)
      if (figures.values[i][q] < figures.values[best][q]) best = i;
    const Measured now = measured_figure(quantity, figures.output, figures.values[best][q]);
    const std::string label = figure_column(quantity, figures.output).label + ", lowest of all machines";
    if (figures.refined)
      fact(label, say("{} by machine {} ({}), {} before the refinement ({})", now,
                      count_of(static_cast<double>(best + 1)), machines.names[best],
                      measured_figure(quantity, figures.output, figures.least_found[q]),
                      figures.least_found_name[q]))
          .number = now;
    else
      fact(label,
           say("{} by machine {} ({})", now, count_of(static_cast<double>(best + 1)), machines.names[best]));
  }
  if (s.loaded)
    fact("masses and speed",
         say("{} for each metre of a bar, crank at {}", measured("kg", s.loads.mass_per_metre),
             measured("rpm", s.loads.crank_speed)));
  if (!figures.refined) return;
  if (std::find(figures.quantities.begin(), figures.quantities.end(), MachineQuantity::tolerance_90) !=
      figures.quantities.end())
    fact("tolerance of lengths and coordinates",
         say("{}, three standard deviations",
             millimetres(s.refinement.length_tolerance.value_or(1e-3 * target.stroke.size))));
  const double share = s.refinement.error_share;
  const Sentence growth = percent(s.refinement.error_growth, 3);
  if (target.is_function()) {
    const double least = share * output_range(target) * target.error_unit();
    fact("error a machine may gain by the refinement",
         least > 0 ? say("{} of its own, at least {}", growth,
                         target.placed() ? millimetres(least, 3) : degrees_of(least, 3))
                   : say("{} of its own", growth));
    return;
  }
  fact("error a machine may gain by the refinement",
       target.has_tolerance_everywhere()
           ? say("{} of its own", percent(s.refinement.error_growth, 3))
           : say("{} of its own, at least {}", percent(s.refinement.error_growth, 3),
                 millimetres(s.refinement.error_share * target.stroke.size, 3)));
}

void add_figure_plots(const ListFigures& figures, std::string_view error_key, study::Result& result) {
  if (!figures.refined) return;
  const study::AddPlot plot{
      result, {.table = "machines", .x = std::string(error_key), .style = study::Plot::Style::points}};
  for (const MachineQuantity quantity : figures.quantities) {
    const FigureColumn what = figure_column(quantity, figures.output);
    std::string title = what.label + " over the error";
    title[0] = static_cast<char>(title[0] - 'a' + 'A');
    plot(std::string("trade-off-") + std::string(name_of(quantity)), title, {what.key_before(), what.key()});
  }
}

}  // namespace linkwright::planar
