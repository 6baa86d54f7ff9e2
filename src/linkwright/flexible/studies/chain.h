// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/flexible/arm.h"
#include "linkwright/flexible/modes.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/studies/drive.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/remarks.h"

// The common part of simulations of one link and of arms: their options, how they run and what they report.
namespace linkwright::flexible {

enum class StartForm { undeformed, equilibrium };
constexpr std::array<EnumName<StartForm>, 2> names(StartForm) {
  return {{{StartForm::undeformed, "undeformed", "straight links"},
           {StartForm::equilibrium, "equilibrium", "links bent by their weight, with hub and hinges held"}}};
}

/// `[simulation]`.
struct SimulationForm {
  double end = 0, step = 0.005;
  int modes = 3;
  StartForm start = StartForm::undeformed;
  bool extrapolate = true;
  std::optional<double> tolerance;
  bool compare_divisions = true;
  std::optional<double> deflection_scale;
};
template <class Visitor>
void fields(Visitor&& visit, SimulationForm& s) {
  visit(field::time("end", "end of the simulated time").positive().required(), s.end);
  visit(field::time("step", "longest step of the integration").positive(), s.step);
  visit(field::entry("start", "how the links are at time 0"), s.start);
  visit(field::entry("extrapolate", "repeat with half the step and extrapolate"), s.extrapolate);
  visit(field::length("tolerance", "halve the step until the tip moves by no more").positive(), s.tolerance);
  visit(field::entry("modes", "frequencies in the table of modes").between(1, 20), s.modes);
  visit(field::entry("compare_divisions", "repeat with twice the divisions and report the difference"),
        s.compare_divisions);
  visit(field::entry("deflection_scale",
                     "how many times as large the scene draws the bending; default: to scale where it can "
                     "be seen, else 2, 5, 10, ... times")
            .positive()
            .at_most(1e9),
        s.deflection_scale);
}

struct ChainPlot {
  const char* name;
  const char* title;
  std::vector<std::string> columns;  ///< columns of the table "motion"; missing ones are left out
};

/// A simulation as read: a chain with what turns it.
struct ChainStudy {
  std::function<ArmChain(int)> arm;  ///< chain with that many times the divisions
  std::vector<std::string> names;    ///< names of the links
  std::vector<JointDrive> drives;    ///< drive of the hub, then one a hinge
  SimulationForm simulation;
  std::optional<ShapingForm> shaping;
  int samples = 361;
  std::function<Table(const ArmChain&, const Simulation&)> table;  ///< "motion"
  std::array<std::string, 2> tip;  ///< columns: displacement of the tip across the link and along it
  std::vector<ChainPlot> plots;
};

/// Says what is wrong with the times, with the keys of `[simulation]`.
void check_times(const SimulationForm& form, study::ObjectReader& simulation);
/// Says why the drives cannot be shaped, with the keys of the table that holds `shaping`.
void check_shaping(const ChainStudy& study, study::ObjectReader& parent);

/// The run that the report of a kind adds to.
struct ChainRun {
  ArmChain arm;
  Simulation simulation;  ///< simulation with states
  study::Result result;   ///< tables "motion", "modes" and, of a shaped one, "unshaped"; plots, facts, scene
};
/// Integrates; what was reached is kept, whatever ends it.
ChainRun run_chain(const ChainStudy& study, RunContext& context);

/// Largest |value| of a column, 0 of an empty one and of one that the table does not have.
double largest_of(const Table& table, std::string_view key);
/// Angular frequencies (rad/s) as "12.3, 45.6 Hz".
Sentence in_hertz(const std::vector<double>& frequencies);
/// "Ended at 1.2 s: ..." of a run that is not done.
Sentence headline_of_end(const Simulation& run);

/// True if the states of a chain of so many cells at all samples, and the drawing of them, have room in
/// memory; an error at `output.samples` if not.
bool fits_memory(study::ObjectReader& document, int samples, int cells);

}  // namespace linkwright::flexible
