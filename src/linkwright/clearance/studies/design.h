// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/clearance/mass_synthesis.h"
#include "linkwright/clearance/path_synthesis.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/population_methods.h"
#include "linkwright/planar/studies/environment.h"
#include "linkwright/planar/studies/path_points.h"
#include "linkwright/study/run_seeds.h"

// The synthesis of a four-bar whose crank pin has clearance (Varedi et al. 2014): what its file holds, how it
// is read, run and reported.
namespace linkwright::clearance {

/// The aim of a design study: its `target.type`.
enum class DesignTarget {
  lengths,  ///< "path_points": lengths for a path, the clearance link at a presumed phase
  masses,   ///< "phase": masses that make the clearance link keep its phase
  both      ///< "path_points_and_phase"
};

/// The stages that find lengths and masses when a study asks for both.
enum class DesignStages { in_turn, at_once };
constexpr std::array<EnumName<DesignStages>, 2> names(DesignStages) {
  return {{{DesignStages::in_turn, "in_turn", "lengths for the presumed phase, then masses that keep it"},
           {DesignStages::at_once, "at_once", "then both together, for the path on the periodic motion"}}};
}

/// `[mechanism.parameters]`, in the order of ClearanceLength.
struct DesignLengthsForm {
  std::array<std::optional<Range>, clearance_length_count> ranges;
};
template <class Visitor>
void fields(Visitor&& visit, DesignLengthsForm& p) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, clearance_length_count> keys = {
      {{"ground", "length of the ground link"},
       {"crank", "length of the crank"},
       {"coupler", "length of the coupler"},
       {"rocker", "length of the rocker"},
       {"point_distance", "tracing point: distance from the bush of the coupler"},
       {"pivot_x", "crank pivot, x"},
       {"pivot_y", "crank pivot, y"},
       {"point_angle", "tracing point: direction from the line of the coupler, counter-clockwise"},
       {"frame_angle", "direction of the ground link"}}};
  for (std::size_t k = 0; k < keys.size(); ++k) {
    Field field = field::of(k < index(ClearanceLength::point_angle) ? Dimension::length : Dimension::angle,
                            keys[k].first, keys[k].second);
    if (k <= index(ClearanceLength::point_distance)) field.minimum = 0;
    field.exclusive_minimum = k <= index(ClearanceLength::rocker);
    visit(field, p.ranges[k]);
  }
}

/// `[mechanism.mass.coupler]` and `[mechanism.mass.rocker]`.
struct DesignMassForm {
  std::array<std::optional<Range>, 4> ranges;  ///< mass, u, v, inertia
};
template <class Visitor>
void fields(Visitor&& visit, DesignMassForm& m) {
  visit(field::mass("mass", "mass").positive(), m.ranges[0]);
  visit(field::length("centre_u", "mass centre along the link, from its first joint"), m.ranges[1]);
  visit(field::length("centre_v", "mass centre to the left of that line"), m.ranges[2]);
  visit(field::inertia("inertia", "about the mass centre").positive(), m.ranges[3]);
}
struct DesignMassesForm {
  DesignMassForm coupler, rocker;
};
template <class Visitor>
void fields(Visitor&& visit, DesignMassesForm& m) {
  visit(field::entry("coupler", "from the clearance joint to the rocker"), m.coupler);
  visit(field::entry("rocker", "from its pivot to the coupler"), m.rocker);
}

struct DesignDampingForm {
  double coupler = 0, rocker = 0, link = 0;
};
template <class Visitor>
void fields(Visitor&& visit, DesignDampingForm& d) {
  const auto damping = [&](std::string_view key, std::string_view summary, double& value) {
    visit(field::damping_angular(key, summary).not_negative(), value);
  };
  damping("coupler", "viscous torque against the turning of the coupler", d.coupler);
  damping("rocker", "... of the rocker", d.rocker);
  damping("link", "... of the clearance link", d.link);
}

/// `[mechanism]`.
struct DesignMechanismForm {
  DesignTarget target = DesignTarget::both;
  planar::Branch branch = planar::Branch::open;
  double clearance = 0;
  bool crank_rotates_fully = true;
  DesignLengthsForm parameters;
  DesignMassesForm mass;
  DesignDampingForm damping;
};
template <class Visitor>
void fields(Visitor&& visit, DesignMechanismForm& m) {
  visit(field::entry("branch", "assembly mode"), m.branch);
  visit(field::length("clearance", "of the crank pin: radius of the bush less radius of the pin")
            .positive()
            .at_most(1e6)
            .required(),
        m.clearance);
  if (m.target != DesignTarget::masses)
    visit(field::entry("crank_rotates_fully", "the crank rotates fully and is the shortest link"),
          m.crank_rotates_fully);
  visit(field::entry("parameters", "lengths: fixed numbers, or { min, max } for design variables")
            .required(m.target == DesignTarget::masses),
        m.parameters);
  if (m.target == DesignTarget::lengths) return;
  visit(field::entry("mass", "masses: numbers, or { min, max }").required(), m.mass);
  visit(field::entry("damping", "viscous torques"), m.damping);
}

/// `[drive]`.
struct DesignDriveForm {
  double speed = 0, start_angle = 0;
};
template <class Visitor>
void fields(Visitor&& visit, DesignDriveForm& d) {
  visit(field::speed_angular("speed", "of the crank, which rotates uniformly; counter-clockwise positive")
            .required(),
        d.speed);
  visit(field::angle("start_angle", "direction of the crank where the turn begins").between(-1e3, 1e3),
        d.start_angle);
}

/// `target.timing`. Crank angles are absolute, from the x axis.
struct DesignTimingForm {
  double start = 0;
  std::optional<double> step, free_within;
  std::optional<std::vector<double>> angles;
};
template <class Visitor>
void fields(Visitor&& visit, DesignTimingForm& t) {
  visit(field::angle("start", "crank angle of the first point"), t.start);
  visit(field::angle("step", "crank rotation from point to point"), t.step);
  visit(field::angle("angles", "or the crank angle of each point"), t.angles);
  visit(field::angle("free_within",
                     "each angle may deviate by this much in either direction; if absent it is prescribed")
            .positive()
            .at_most(3.2),
        t.free_within);
}

/// `[target]`.
struct DesignTargetForm : planar::PathPointsForm {
  DesignTarget target = DesignTarget::both;
  double phase = 0;
  int samples = 72;
  DesignStages stages = DesignStages::in_turn;
  DesignTimingForm timing;
};
template <class Visitor>
void fields(Visitor&& visit, DesignTargetForm& t) {
  visit(field::angle("phase", "wanted angle of the clearance link ahead of the crank").between(-3.2, 3.2),
        t.phase);
  if (t.target != DesignTarget::lengths)
    visit(field::entry("samples", "points of the turn at which the phase is compared").between(8, 10000),
          t.samples);
  if (t.target == DesignTarget::masses) return;
  if (t.target == DesignTarget::both)
    visit(field::entry("stages", "how lengths and masses are found"), t.stages);
  visit(field::entry("timing", "crank angles of the points").required(), t.timing);
  fields(visit, static_cast<planar::PathPointsForm&>(t));
}

/// `[reference]`: a design that the answer is compared with.
struct DesignReferenceForm {
  DesignTarget target = DesignTarget::both;
  std::string label = "reference";
  DesignLengthsForm parameters;
  DesignMassesForm mass;
};
template <class Visitor>
void fields(Visitor&& visit, DesignReferenceForm& r) {
  visit(field::entry("label", "its name in the report"), r.label);
  if (r.target != DesignTarget::masses)
    visit(field::entry("parameters", "its lengths").required(), r.parameters);
  if (r.target != DesignTarget::lengths) visit(field::entry("mass", "its masses").required(), r.mass);
}

/// `[optimiser]`.
struct RecommendedDesign {
  int starts = 12;
};
template <class Visitor>
void fields(Visitor&& visit, RecommendedDesign& r) {
  visit(field::entry("starts", "local searches of each stage").between(1, 1e6), r.starts);
}
constexpr Word choice_word(const RecommendedDesign&) {
  return {"recommended", "least squares from many starts; of masses on the periodic motion"};
}
/// The population methods minimise the objectives of the source: the misfit of the path, and the misfit of
/// the phase over the first turn. Violated constraints cost a constant, Eq. (23).
using DesignMethod = optimise::MethodChoice<optimise::Constraints::penalty, RecommendedDesign>;
struct DesignOptimiser {
  DesignMethod method;
};
template <class Visitor>
void fields(Visitor&& visit, DesignOptimiser& o) {
  visit(field::entry("method", "how designs are searched"), o.method);
}

/// A design: variables of both problems.
struct ClearanceDesignValues {
  std::vector<double> lengths;  ///< lengths of clearance_path_design; if lengths are fixed, only the nine
  std::vector<double> masses;   ///< masses of with_masses; empty = none
};

/// A study as read.
struct ClearanceDesignStudy {
  DesignTarget target = DesignTarget::both;
  DesignStages stages = DesignStages::in_turn;
  ClearancePathProblem path;  ///< without points when lengths are no design variables
  ClearanceMassProblem mass;  ///< its model has the fixed lengths when only masses are designed
  bool closed = false;        ///< the points go round with the crank
  DesignMethod method;
  std::optional<ClearanceDesignValues> reference;
  std::string reference_label;
  int samples = 361;  ///< rows of a turn

  bool has_path() const { return target != DesignTarget::masses; }
  bool has_masses() const { return target != DesignTarget::lengths; }
  double phase() const { return has_masses() ? mass.phase : path.phase; }  ///< wanted, or presumed
};

/// The answer of a seed.
struct ClearanceDesignAnswer {
  Status status = Status::infeasible;
  ClearanceDesignValues best;
  double cost = infinity;       ///< see cost_name; infinite when infeasible
  int starts = 0, reached = 0;  ///< counts of the last stage that has them
  std::int64_t evaluations = 0;
  std::vector<optimise::GenerationLog> log;
};
using ClearanceDesignRuns = study::SeedRuns<ClearanceDesignAnswer>;

/// A finished seed as a checkpoint saves it, and the same seed, to the bit. Throws
/// CheckpointError, naming `what`, for everything that `kept` cannot have made.
Value kept(const ClearanceDesignAnswer& answer);
ClearanceDesignAnswer restored(const Value& value, const ClearanceDesignStudy& study, std::string_view what);

/// The cost by which the seeds are compared: key and words.
struct CostName {
  std::string_view key, words;
};
CostName cost_name(const ClearanceDesignStudy& study);

/// "synthesis" of "clearance.four_bar" for "path_points", "phase" and "path_points_and_phase".
std::vector<study::Kind> clearance_design_kinds();

std::optional<ClearanceDesignStudy> read_clearance_design(study::ObjectReader& document,
                                                          const study::Common& common, DesignTarget target,
                                                          Value& canonical);
study::Result run_clearance_design(const ClearanceDesignStudy& study, const study::Common& common,
                                   RunContext& context);

// ---- between running and reporting
// -----------------------------------------------------------------------------

/// One instant of the turn that a design is shown on.
struct DesignRow {
  double crank = 0;  ///< rad, not wrapped
  double time = 0;   ///< s; without masses the crank angle over 1 rad/s
  LinkState link;
  ClearanceInstant instant;  ///< without masses only the position
};
/// The performance of a design.
struct DesignMeasures {
  ClearanceFourBar model;
  // The path, where there is one.
  ClearancePathDesign presumed;  ///< design with the clearance link at the presumed phase
  /// Places of the tracing point at the targets: on the turn of the rows, or, without masses, with the
  /// presumed phase.
  std::vector<std::complex<double>> reached;
  double rms = 0, largest = 0;  ///< m, of these
  double anywhere = 0;          ///< m: largest distance with the pin anywhere in its bush
  // The motion, where there are masses.
  ClearanceMassDesign motion;
  bool repeats = false;  ///< the rows are of the orbit; else of the turn that starts with the wanted phase
  ClearanceRun run;      ///< over the turn
  double least_at = 0;   ///< rad: crank angle of the least tension
  double work_mean = 0;  ///< mean of sin(phase) weighted by the tension
  std::vector<DesignRow> rows;
};
/// Looks at `context`, if there is one, while the motion is integrated: an interruption leaves the rows so
/// far.
DesignMeasures measure_design(const ClearanceDesignStudy& study, const ClearanceDesignValues& values,
                              const RunContext* context = nullptr);

/// Phase of a row, within half a turn of the wanted one.
double phase_of(const ClearanceDesignStudy& study, const DesignRow& row);
/// Targets and where the tracing point comes; `before` may be null.
Table design_points(const ClearanceDesignStudy& study, const DesignMeasures& design,
                    const DesignMeasures* before);
Table design_turn(const ClearanceDesignStudy& study, const DesignMeasures& design, std::string name);
/// All that a simulation of the design asks for: "linkage-points", "linkage-masses", "linkage-start".
std::vector<Table> design_linkage_tables(const ClearanceDesignStudy& study, const DesignMeasures& design);
/// The tables of a study of the design: a simulation of its turn, pin and bush touching always; of lengths
/// alone an analysis of what the clearance does to the path. There must be rows.
Value design_study(const ClearanceDesignStudy& study, const DesignMeasures& design);
/// The design in motion over its turn, the clearance drawn enlarged.
study::Scene design_scene(const ClearanceDesignStudy& study, const DesignMeasures& design);

study::Result report_clearance_design(const ClearanceDesignStudy& study, const study::Common& common,
                                      const ClearanceDesignRuns& runs, const RunContext& context);

}  // namespace linkwright::clearance
