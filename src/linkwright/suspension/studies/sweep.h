// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "linkwright/suspension/studies/adjust.h"
#include "linkwright/suspension/studies/axle.h"
#include "linkwright/suspension/studies/compliance.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/studies/data_sheet.h"
#include "linkwright/suspension/studies/lists.h"
#include "linkwright/suspension/studies/overlays.h"
#include "linkwright/suspension/studies/packaging.h"
#include "linkwright/suspension/studies/sensitivity.h"
#include "linkwright/suspension/studies/springs.h"
#include "linkwright/suspension/wheel/parameters.h"

// The analysis of a wheel suspension over wheel travel and rack: what its file holds, how it is read, run and
// reported.
namespace linkwright::suspension {

struct TravelValues {
  Driver coordinate = Driver::wheel_centre_z;
  LengthValues values;
};
template <class Visitor>
void fields(Visitor&& visit, TravelValues& t) {
  visit(field::entry("coordinate", "what travels, as a change from the reference"), t.coordinate);
  fields(visit, t.values);
}

struct GridSweep {
  TravelValues travel;
  std::optional<LengthValues> rack;
};
template <class Visitor>
void fields(Visitor&& visit, GridSweep& s) {
  visit(field::entry("travel", "values of the wheel's travel").required(), s.travel);
  visit(field::entry("rack", "values of the rack; default: centred"), s.rack);
}
constexpr Word choice_word(const GridSweep&) { return {"grid", "every travel with every rack displacement"}; }

struct CornerSweep {
  std::variant<GridSweep> type;
  std::optional<Driver> steering_lock;
  bool assemblies = false;
};
template <class Visitor>
void fields(Visitor&& visit, CornerSweep& s) {
  visit(field::entry("type", "which positions are taken"), s.type);
  visit(field::entry("steering_lock",
                     "what is held constant while steering, for the steering axis: spring, "
                     "wheel_centre_z or contact_z; default: the spring if there is one"),
        s.steering_lock);
  visit(field::entry("assemblies", "table of the other assembly modes of the suspension"), s.assemblies);
}

/// Another suspension whose curves are laid beside those of the study.
struct OtherDesign {
  std::string name;
  CornerDescription description;
};

/// An analysis as read.
struct SweepStudy {
  CornerDescription description;
  Driver travel = Driver::wheel_centre_z;
  std::vector<double> travels, racks;         ///< m, ascending
  Driver lock = Driver::wheel_centre_z;       ///< coordinate held while the steering axis is found
  std::vector<std::string> quantities;        ///< empty = all that the suspension has
  bool assemblies = false;                    ///< the other assembly modes are looked for
  bool drawn = true;                          ///< true if a scene is wanted: a grid may have many positions
  std::optional<CornerDescription> baseline;  ///< another suspension, whose curves are laid behind
  std::vector<OtherDesign> others;            ///< suspensions to compare with, any number
  std::vector<Measurement> measured;          ///< curves of a rig
  RideForm ride;
  std::optional<VehicleForm> vehicle;
  std::optional<AxleForm> axle;
  std::optional<CornerDescription> other_wheel;  ///< of the axle; none: the mirror image of the suspension
  std::optional<ComplianceForm> compliance;
  std::optional<PackagingForm> packaging;
  std::optional<AdjustForm> adjust;
  std::optional<SensitivityForm> sensitivity;
  std::optional<TolerancesForm> tolerances;
  std::vector<ListForm> lists;
  std::optional<DataSheetForm> data_sheet;
};

/// "analysis" of "suspension.corner".
study::Kind sweep_kind();

/// Reads the tables of the study and writes them into the canonical one; nothing when there are problems,
/// which go to the reader, or when a file of names is proposed (read_suspension).
std::optional<SweepStudy> read_sweep_study(study::ObjectReader& document, const study::Common& common,
                                           Value& canonical,
                                           std::optional<study::ResultFile>* proposed = nullptr);

/// Columns that are quantities of the study, whether its suspension has them or not, else all that it has.
std::vector<const CornerColumn*> columns_of(const SweepStudy& study);

/// Positions of a grid: for each rack all travels. Each rack is gone to at the travel next to zero, and the
/// travels outwards from there, each from the one before; a position that is not reached keeps its reason.
struct GridPositions {
  std::size_t first_travel = 0, travels = 0;  ///< range of the positions among the travels of the study
  std::vector<CornerPosition> positions;      ///< [rack * travels + travel]
  std::vector<WheelParameters> wheels;        ///< likewise; singular where there is no position
};
/// Interrupted: the racks so far; in the first of them the travels so far, about the one next to zero.
GridPositions solve_grid(const CornerPlan& plan, Driver travel, std::span<const double> travels,
                         std::span<const double> racks, const RunContext* context = nullptr);

/// The table `sweep` of a suspension at these travels and racks (m, ascending), with the columns of its
/// springs.
Table sweep_columns_at(const SweepStudy& study, std::vector<double> travels, std::vector<double> racks,
                       const RunContext& context);

/// The tables of an analysis of a suspension that was found for a description, over these values (m); with
/// the rack centred alone where it does not reach all of their combinations.
Value sweep_of_found(const CornerDescription& description, const Suspension& found, Driver travel,
                     std::vector<double> travels, std::vector<double> racks, Driver steering_lock);

/// Evaluates the grid and reports. Rows without a position hold NaN and their status; the status of the
/// result is then the first of these. Cancelled or out of time: the positions so far (solve_grid).
study::Result run_sweep_study(const SweepStudy& study, RunContext& context);
/// The table of its grid without rows.
Table empty_sweep_table(const SweepStudy& study);

}  // namespace linkwright::suspension
