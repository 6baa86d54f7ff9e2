// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/planar/simulation/elastic_body.h"
#include "linkwright/planar/studies/linkage.h"

// The simulation of a linkage under forces: what its file holds, how it is read, run and reported.
namespace linkwright::planar {

/// In which coordinates the equations of motion are written.
enum class SimulationRoute { free_joints, all_coordinates };
constexpr std::array<EnumName<SimulationRoute>, 2> names(SimulationRoute) {
  return {{{SimulationRoute::free_joints, "free_joints",
            "those of the free joints: closes exactly, ends at dead points of the joint"},
           {SimulationRoute::all_coordinates, "all_coordinates",
            "places of all bodies with joint forces, projected onto the joints after every step: passes dead "
            "points"}}};
}

/// A simulation as read.
struct LinkageSimulationStudy {
  Linkage linkage;
  LinkagePlan plan;
  std::vector<InputDrive> drives;  ///< one an input
  double from = 0, to = 1;         ///< s
  int samples = 401;
  SimulationRoute route = SimulationRoute::free_joints;
  SimulationOptions options;
  std::vector<BodyPoint> traces;
  LinkageQuantities quantities;
  std::vector<ElasticBody> elastic;        ///< flexible bodies; empty = none
  std::string method_reason;               ///< says why the method was taken; empty: the file names it
  double settle = 0;                       ///< s: elastic bodies move so long before `from`, without rows
  std::optional<double> deflection_scale;  ///< scale of deflections in drawings; absent: chosen
  int scene_samples = 361;  ///< largest number of samples in drawings of elastic bodies, approximately
};

/// "simulation" of "planar.linkage" and of its shorthands.
study::Kind linkage_simulation_kind();
study::Kind four_bar_simulation_kind();
study::Kind slider_crank_simulation_kind();

/// Integrates and reports. Rows up to where the motion ends are kept, whatever ends it.
study::Result run_linkage_simulation(const LinkageSimulationStudy& study, RunContext& context);

// ---- shared with other simulations of linkages
// ------------------------------------------------------------------

/// Numbers of a joint that is free, as those of `linkage.h`.
template <class Visitor>
void joint_fields(Visitor&& visit, bool rotary, InputDrive& c) {
  visit(drive_field(rotary, 0, "start", "of a free joint: position at the start"), c.value);
  visit(drive_field(rotary, 1, "start_speed", "of a free joint: rate at the start"), c.rate);
}

/// `[[drive]]` of a simulation, one drive an input: a law, or free with what it starts from. Inputs of
/// samples and shorthands that the file does not name are free. The tables are written into `canonical`;
/// problems go to the reader.
std::vector<InputDrive> read_input_drives(study::ObjectReader& document,
                                          const LinkageDescription& description, Value::Array& canonical);
void describe_input_drives(study::SchemaWriter& document);

/// Columns of a linkage without those of drives where a joint is free: there is no drive to be of interest.
std::vector<LinkageColumn> driven_columns(const Linkage& linkage, const LinkagePlan& plan,
                                          const LinkageQuantities& quantities,
                                          const std::vector<BodyPoint>& traces,
                                          std::span<const InputDrive> drives);
/// Adds coordinate, speed and acceleration of every input: values[3 k], [3 k + 1], [3 k + 2] of input k.
void add_input_columns(Table& table, const Linkage& linkage, const LinkagePlan& plan,
                       const std::vector<std::vector<double>>& values);

}  // namespace linkwright::planar
