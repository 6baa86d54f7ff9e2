// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/studies/environment.h"
#include "linkwright/planar/type_synthesis/refine.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/remarks.h"

// The refinement of the machines that a search over types has found, and their masses and loads: what the
// files hold, how it is read, run and reported.
namespace linkwright::planar {

struct AnyObjective {
  MachineQuantity quantity{};
  double weight = 1;
  std::optional<double> reference, at_most;
};
template <class Visitor>
void fields(Visitor&& visit, AnyObjective& o) {
  visit(field::entry("quantity", "property of a machine that is to be small").required(), o.quantity);
  visit(field::entry("weight", "how much it counts among the others").positive().at_most(1e9), o.weight);
  visit(field::entry(
            "reference",
            "value that counts as 1, in the unit of its column; default: that of the machine as it was found")
            .positive(),
        o.reference);
  visit(field::entry("at_most", "the objective may be at most this many times its reference").not_negative(),
        o.at_most);
}

struct AnyLoads {
  double mass_per_metre = 1;
  double crank_speed = 2 * pi;
  std::array<double, 2> force{};
  double torque = 0;  ///< on the output link of a function
};
template <class Visitor>
void fields(Visitor&& visit, AnyLoads& l) {
  visit(field::mass("mass_per_metre", "mass of a bar or plate by its largest extent, for each metre")
            .positive()
            .at_most(1e6),
        l.mass_per_metre);
  visit(field::speed_angular("crank_speed", "constant speed of the crank").between(0, 1e5), l.crank_speed);
  visit(field::force("force", "constant force [x, y] on the traced point, in the global frame"), l.force);
}

struct AnyFunctionLoads : AnyLoads {};
template <class Visitor>
void fields(Visitor&& visit, AnyFunctionLoads& l) {
  visit(field::mass("mass_per_metre", "mass of a bar or plate by its largest extent, for each metre")
            .positive()
            .at_most(1e6),
        l.mass_per_metre);
  visit(field::speed_angular("crank_speed", "constant speed of the crank").between(0, 1e5), l.crank_speed);
  visit(field::force("force", "constant force [x, y] on the pin of the slider, or of the output link"),
        l.force);
  visit(field::torque("torque", "constant torque on the output link, counter-clockwise positive"), l.torque);
}

struct AnyRefinement {
  double error_growth = 0.1, error_share = 1e-3;
  std::optional<double> length_tolerance;
  int starts = 2;
};
template <class Visitor>
void fields(Visitor&& visit, AnyRefinement& r) {
  visit(
      field::entry("error_growth", "share of its error by which that of a machine may grow").between(0, 100),
      r.error_growth);
  visit(
      field::entry("error_share",
                   "part of the stroke's size by which it may grow where that is more; not with a tolerance")
          .between(0, 1),
      r.error_share);
  visit(
      field::length("length_tolerance",
                    "of every length and coordinate, for tolerance_90: three standard deviations; default: a "
                    "thousandth of the stroke's size")
          .positive(),
      r.length_tolerance);
  visit(field::entry("starts", "for each machine and aim: the machine itself, then changes of it")
            .between(1, 100),
        r.starts);
}

/// The error of a function may be so small that no share of its range is small.
struct AnyFunctionRefinement : AnyRefinement {
  AnyFunctionRefinement() { error_share = 0; }
};
template <class Visitor>
void fields(Visitor&& visit, AnyFunctionRefinement& r) {
  visit(
      field::entry("error_growth",
                   "share of its error by which that of a machine may grow: of the greatest error, or of the "
                   "root mean square, as fit says")
          .between(0, 100),
      r.error_growth);
  visit(
      field::entry("error_share",
                   "part of the output's range by which it may grow where that is more; of a quick return at "
                   "least 1e-4")
          .between(0, 1),
      r.error_share);
  visit(
      field::length("length_tolerance",
                    "of every length and coordinate, for tolerance_90: three standard deviations; default: a "
                    "thousandth of the distance of crank and output, or of the root mean square travel")
          .positive(),
      r.length_tolerance);
  visit(field::entry("starts", "for each machine and aim: the machine itself, then changes of it")
            .between(1, 100),
        r.starts);
}

/// What a study asks for beyond the path or the function.
struct AnyRefinementStudy {
  bool function = false;  ///< machines generate a function
  std::vector<AnyObjective> objectives;
  AnyLoads loads;
  Environment environment;
  AnyRefinement refinement;
  bool loaded = false;  ///< masses and loads belong to the machines
};

/// Reads `[[objective]]`, `[refinement]`, `[machine]` and `[environment]`; problems go to the reader.
AnyRefinementStudy read_refinement(study::ObjectReader& document, bool function);
/// Writes them into the canonical study where the study has them.
void write_refinement(const AnyRefinementStudy& study, Value& canonical);
void describe_refinement(study::SchemaWriter& document, bool function);

/// The error of a function that a refinement limits, as `RefineOptions` has it.
struct FunctionErrorLimit {
  bool greatest = false;
  std::function<double(const FittedMachine&)> whole_error = {};
};

/// Figures of the machines of a list beside those of the search.
struct ListFigures {
  MachineOutput output = MachineOutput::point;  ///< what of the machines is compared
  std::vector<MachineQuantity> quantities;
  std::vector<std::vector<double>> values;      ///< of each machine, by the analysis of any linkage
  std::vector<std::vector<double>> before;      ///< of the machine from which each was refined
  std::vector<std::optional<std::size_t>> aim;  ///< objective, or their number for all; none: as found
  std::vector<double> least_found;              ///< least of all machines before the refinement
  std::vector<std::string> least_found_name;    ///< and whose it is
  std::int64_t descents = 0, steps = 0;
  bool refined = false;  ///< there are objectives
};

/// The loads of a study as the refinement takes them.
MachineLoads loads_of(const AnyRefinementStudy& study);

/// Crank angles of a machine at the first and the last sample of an open target, in the global frame (rad);
/// the first is in (-pi, pi].
std::array<double, 2> drive_range(const MotionTarget& target, const FittedMachine& machine);

/// Crank angles of the rows of the study of a machine: a turn in its sense from the first point on, or the
/// range of a drive that rocks.
std::vector<double> design_rows(const MotionTarget& target, const FittedMachine& machine,
                                const FoundLinkage& linkage, int samples);

/// Refines the machines of an answer where objectives are given, and evaluates the figures of its list.
ListFigures refine_list(const AnyRefinementStudy& study, const MotionTarget& target,
                        const TypeSearchOptions& search, int samples, TypeSearchAnswer& answer,
                        RunContext& context, const FunctionErrorLimit& of_function = {});

/// Keeps the machines of a list with these numbers, in this order.
void keep_figures(ListFigures& figures, std::span<const std::size_t> kept);

/// Gives the study of a machine speed, gravity and the quantities of forces; its linkage has the masses.
void load_design(const AnyRefinementStudy& study, Value& design);

/// Columns of the table of machines, figures of a solution, facts, diagrams and counts.
void add_figure_columns(const ListFigures& figures, Table& machines);
void add_figures(const ListFigures& figures, std::size_t machine, study::Solution& solution);
void add_figure_facts(const AnyRefinementStudy& study, const ListFigures& figures, const Table& machines,
                      const MotionTarget& target, const study::AddFact& fact);
void add_figure_plots(const ListFigures& figures, std::string_view error_key, study::Result& result);

}  // namespace linkwright::planar
