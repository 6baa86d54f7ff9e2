// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/hub_link.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "linkwright/flexible/reference_beam.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::flexible {
namespace {

ChainStudy chain_study(const HubLinkStudy& s) {
  ChainStudy out;
  out.arm = [s](int times) {
    const ArmLink link{.beam = s.mechanism.beam, .divisions = times * s.simulation.divisions, .hinge = {}};
    return arm_chain(std::span(&link, 1), s.simulation.kinematics);
  };
  out.names = {"link"};
  out.drives = {joint_drive(s.drive.law, s.simulation.end)};
  out.simulation = static_cast<const SimulationForm&>(s.simulation);
  out.shaping = s.drive.shaping;
  out.samples = s.samples;
  out.table = [form = s.mechanism](const ArmChain&, const Simulation& run) {
    Table motion = table_of(run.samples);
    motion.name = "motion";
    if (form.fibre_distance) {
      std::vector<double> stress;
      for (const Sample& at : run.samples)
        stress.push_back(bending_stress(form.beam, at.bending_moment, *form.fibre_distance));
      motion.add("bending_stress_Pa", "largest bending stress (Pa)", std::move(stress));
    }
    return motion;
  };
  out.tip = {"tip_eta_m", "tip_xi_m"};
  out.plots = {{"tip", "Displacement of the tip, across and along the link", {"tip_eta_m", "tip_xi_m"}},
               {"hub", "Angle of the hub", {"hub_angle_rad"}},
               {"rate", "Speed of the hub", {"hub_speed_rad_per_s"}},
               {"torque", "Torque of the drive", {"torque_N_m"}},
               {"weld-force", "Force at the weld", {"reaction_xi_N", "reaction_eta_N"}},
               {"weld-moment", "Moment at the weld", {"moment_N_m"}},
               {"stress", "Largest bending stress", {"bending_stress_Pa"}},
               {"energy", "Energies", {"kinetic_energy_J", "potential_energy_J", "work_J", "dissipated_J"}},
               {"balance", "Energy audit: kinetic + potential + dissipated - work", {"energy_balance_J"}}};
  return out;
}

std::optional<HubLinkStudy> read_study(study::ObjectReader& document, const study::Common& common,
                                       Value& canonical) {
  HubLinkStudy s;
  s.samples = common.output.samples;
  auto mechanism = document.table(field::entry("mechanism").required());
  auto drive = document.table(field::entry("drive").required());
  auto simulation = document.table(field::entry("simulation").required());
  if (mechanism) mechanism->read(s.mechanism);
  if (drive) drive->read(s.drive);
  if (simulation) simulation->read(s.simulation);
  if (simulation) check_times(s.simulation, *simulation);
  const bool driven = drive && check_drive(*drive, s.drive.law);
  if (!driven || !mechanism || !drive || !simulation || document.document().has_errors()) return std::nullopt;
  if (const auto wrong = problem(s.mechanism.beam)) {
    mechanism->error("", *wrong);
    return std::nullopt;
  }
  const Beam& b = s.mechanism.beam;
  if (s.simulation.kinematics == Kinematics::source_linearised &&
      (b.gravity > 0 || b.mass_damping > 0 || b.stiffness_damping > 0 || b.extensible ||
       s.simulation.start == StartForm::equilibrium)) {
    simulation->error("kinematics",
                      "the printed equations have neither gravity nor damping nor stretching nor equilibrium",
                      "take chord_consistent");
    return std::nullopt;
  }
  if (s.simulation.compare_elastica) {
    const JointDrive how = joint_drive(s.drive.law, s.simulation.end);
    if (how.free() || s.drive.shaping || s.simulation.start == StartForm::equilibrium || b.gravity > 0 ||
        b.mass_damping > 0 || b.stiffness_damping > 0 || b.extensible || b.theory == Theory::timoshenko)
      simulation->error("compare_elastica",
                        "the elastica starts from rest, without shaping, and has no gravity, damping "
                        "of the link, stretching or shear",
                        "leave it out, or what it does not have");
  }
  check_shaping(chain_study(s), *drive);
  if (document.document().has_errors() || !fits_memory(document, s.samples, 2 * s.simulation.divisions))
    return std::nullopt;
  canonical["mechanism"] = study::write_fields(s.mechanism);
  canonical["drive"] = study::write_fields(s.drive);
  canonical["simulation"] = study::write_fields(s.simulation);
  return s;
}

/// Draws another motion of the same rows pale beside that of the result; how far their tips are apart, m.
double lay_beside(study::Result& result, Table other) {
  const auto& ours = result.tables.front().find("tip_eta_m")->values;
  const auto& theirs = other.find("tip_eta_m")->values;
  double difference = 0;
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i)
    difference = std::max(difference, std::abs(ours[i] - theirs[i]));
  for (study::Plot& plot : result.plots)
    if (plot.baseline.empty() &&
        std::all_of(plot.y.begin(), plot.y.end(), [&](const std::string& key) { return other.find(key); })) {
      plot.baseline = other.name;
      plot.title += " (pale: " + other.name + ")";
    }
  result.tables.push_back(std::move(other));
  return difference;
}

/// Compares the requested kinematics with those that are exact in the limit.
void compare_kinematics(const HubLinkStudy& s, study::Result& result, std::vector<study::Fact>& facts,
                        RunContext& context) {
  if (s.simulation.kinematics == Kinematics::chord_consistent) return;
  HubLinkStudy exact = s;
  exact.simulation.kinematics = Kinematics::chord_consistent;
  exact.simulation.compare_divisions = false;
  ChainRun run = run_chain(chain_study(exact), context);
  Table& other = run.result.tables.front();
  other.name = "chord_consistent";
  const double largest = largest_of(other, "tip_eta_m"), difference = lay_beside(result, std::move(other));
  facts.push_back({"difference of the tip from chord_consistent",
                   say("{}, {} times its largest displacement{}", millimetres(difference),
                       plain_number(difference / largest).fixed(2),
                       s.simulation.kinematics == Kinematics::source_linearised
                           ? ": the printed velocities lack the stiffening by the speed"
                           : ""),
                   study::Fact::Verdict::plain});
}

/// The same by another formulation and another integration in time. Curvatures of degree 8 and steps to 1e-7
/// are right to some 1e-6 of the length up to speeds at which the link bends by a fifth of it.
void compare_elastica(const HubLinkStudy& s, study::Result& result, std::vector<study::Fact>& facts,
                      const RunContext& context) {
  if (!s.simulation.compare_elastica) return;
  const JointDrive drive = joint_drive(s.drive.law, s.simulation.end);
  const ReferenceRun run{.end = s.simulation.end,
                         .output_interval = s.simulation.end / (s.samples - 1),
                         .tolerance = 1e-7,
                         .breaks = drive.breaks,
                         .beam = {.degree = 8, .points = 20},
                         .context = &context};
  const Beam& beam = s.mechanism.beam;
  const ReferenceMotion motion =
      drive.motion ? reference_motion(beam, drive.motion, run) : reference_torque(beam, drive.torque, run);
  if (motion.status != Status::done)
    study::AddWarning{result.diagnostics}("simulation.compare_elastica",
                                          "the elastica ended early: " + motion.message, {});
  Table other = table_of(motion.samples);
  other.name = "elastica";
  const double difference = lay_beside(result, std::move(other));
  facts.push_back(
      {"difference of the tip from an elastica", millimetres(difference), study::Fact::Verdict::plain});
}

}  // namespace

study::Result run_hub_link(const HubLinkStudy& s, RunContext& context) {
  ChainRun run = run_chain(chain_study(s), context);
  study::Result& result = run.result;
  const Table& motion = result.tables.front();
  const double peak = largest_of(motion, "tip_eta_m");
  std::vector<study::Fact> facts;
  const study::AddFact fact{facts};
  fact("largest displacement of the tip across the link", millimetres(peak));
  if (s.mechanism.fibre_distance)
    fact("largest bending stress", measured("MPa", largest_of(motion, "bending_stress_Pa")));
  fact("largest torque of the drive", newton_metres(largest_of(motion, "torque_N_m")));
  compare_kinematics(s, result, facts, context);
  compare_elastica(s, result, facts, context);
  result.facts.insert(result.facts.begin(), facts.begin(), facts.end());
  result.headline = result.status == Status::done
                        ? say("The tip leaves the line of the hub by up to {}.", millimetres(peak))
                        : headline_of_end(run.simulation);
  return std::move(result);
}

study::Kind hub_link_kind() {
  study::Kind kind;
  kind.kind = "simulation";
  kind.mechanism = "flexible.hub_link";
  kind.summary =
      "hub with an elastic link and a tip mass: motion, weld forces, stress, frequencies, input shaping";
  kind.example = templates::simulation_hub_link();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "hub and link").required(),
                      study::schema_fields<HubLinkForm>());
    document.property(field::entry("drive", "what turns the hub").required(),
                      study::schema_fields<HubDriveForm>());
    document.property(field::entry("simulation", "how it is followed in time").required(),
                      study::schema_fields<HubSimulationForm>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_study(document, common, prepared.canonical))
      prepared.run = [s = *std::move(s)](RunContext& context) { return run_hub_link(s, context); };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::flexible
