// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/arm.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/flexible/simulation.h"
#include "linkwright/flexible/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/remarks.h"

namespace linkwright::flexible {
namespace {

// The cut of a link with the largest bending moment, of all samples.
struct Worst {
  double moment = 0, position = 0, time = 0;
};
struct Recording {
  Table table{.name = "motion"};
  std::vector<Worst> worst;  // one a link
};

Recording record(const ArmStudy& s, const ArmChain& arm, const Simulation& run) {
  const std::vector<ArmLinkForm>& links = s.mechanism.links;
  Recording out;
  out.worst.resize(links.size());
  Table& table = out.table;
  const auto add = [&](std::string key, std::string label) {
    table.add(std::move(key), std::move(label));
    return table.columns.size() - 1;
  };
  const auto push = [&](std::size_t column, double value) { table.columns[column].values.push_back(value); };

  const std::size_t first = add("time_s", "time (s)");
  add("hub_angle_rad", "angle of the hub (rad)");
  add("hub_speed_rad_per_s", "speed of the hub (rad/s)");
  add("tip_x_m", "tip, x (m)");
  add("tip_y_m", "tip, y (m)");
  add("rigid_tip_x_m", "tip of the rigid arm, x (m)");
  add("rigid_tip_y_m", "tip of the rigid arm, y (m)");
  add("tip_along_m", "tip against the rigid arm, along the last link (m)");
  add("tip_across_m", "tip against the rigid arm, across the last link (m)");
  add("hub_torque_N_m", "torque on the hub (N m)");
  add("hub_force_x_N", "force of the hub on the first link, x (N)");
  add("hub_force_y_N", "force of the hub on the first link, y (N)");
  add("hub_moment_N_m", "couple of the hub on the first link (N m)");
  // By link: columns of its joint, then of its bending.
  std::vector<std::size_t> joint(links.size()), bending(links.size()), motor(links.size());
  std::size_t motors = 0, hinge = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const std::string& name = links[k].name;
    if (links[k].hinge) {
      joint[k] = add(name + "_angle_rad", "angle of the hinge of " + name + " (rad)");
      add(name + "_speed_rad_per_s", "speed of the hinge of " + name + " (rad/s)");
      add(name + "_force_x_N", "force in the hinge on " + name + ", x (N)");
      add(name + "_force_y_N", "force in the hinge on " + name + ", y (N)");
      if (!std::holds_alternative<FreeForm>(s.drives[++hinge])) {
        motor[k] = ++motors;
        add(name + "_torque_N_m", "torque of the drive on " + name + " (N m)");
      }
    } else if (k > 0) {
      joint[k] = add(name + "_weld_axial_N", "tension in the weld of " + name + " (N)");
      add(name + "_weld_shear_N", "shear force in the weld of " + name + " (N)");
      add(name + "_weld_moment_N_m", "bending moment in the weld of " + name + " (N m)");
    }
    bending[k] = add(name + "_bending_moment_N_m", "largest bending moment in " + name + " (N m)");
    if (links[k].fibre_distance)
      add(name + "_bending_stress_Pa", "largest bending stress in " + name + " (Pa)");
  }
  const std::size_t energies = add("kinetic_energy_J", "kinetic energy (J)");
  add("potential_energy_J", "potential energy (J)");
  add("work_J", "work of the drives (J)");
  add("dissipated_J", "dissipated energy (J)");
  add("energy_balance_J", "energy less work since the start (J)");

  ChainEquations equations(arm.chain);
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    const Sample& sample = run.samples[i];
    const ChainState& state = run.states[i];
    equations.evaluate(state);
    const math::Vec2 hub{std::cos(state.angle), std::sin(state.angle)};
    const math::Vec2 tip = rotate(hub, shape(arm.chain, state.q).node.back());
    const math::Vec2 rigid = rotate(hub, shape(arm.chain, bent(arm.chain, state.q, 0)).node.back());
    const TipDisplacement moved = tip_displacement(arm.chain, state.q);
    const math::Vec2 reaction = rotate(hub, {sample.reaction_xi, sample.reaction_eta});
    std::size_t column = first;
    for (const double value :
         {sample.time, sample.angle, sample.rate, tip.x, tip.y, rigid.x, rigid.y, moved.along, moved.across,
          sample.torque, reaction.x, reaction.y, sample.moment})
      push(column++, value);
    const std::vector<math::Vec2> forces = hinge_forces(arm, equations, state);
    hinge = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      const std::vector<SectionForce> cuts = link_sections(arm, k, equations, state);
      if (const auto cell = arm.links[k].hinge) {
        push(joint[k], state.q[coordinates_per_cell * *cell + turn]);
        push(joint[k] + 1, state.v[coordinates_per_cell * *cell + turn]);
        push(joint[k] + 2, forces[hinge].x);
        push(joint[k] + 3, forces[hinge++].y);
        if (motor[k] > 0) push(joint[k] + 4, run.hinge_torques[i][motor[k] - 1]);
      } else if (k > 0) {
        push(joint[k], cuts.front().axial);
        push(joint[k] + 1, cuts.front().shear);
        push(joint[k] + 2, cuts.front().moment);
      }
      const SectionForce& most =
          *std::max_element(cuts.begin(), cuts.end(), [](const SectionForce& a, const SectionForce& b) {
            return std::abs(a.moment) < std::abs(b.moment);
          });
      const double moment = std::abs(most.moment);
      push(bending[k], moment);
      if (links[k].fibre_distance)
        push(bending[k] + 1, bending_stress(links[k].beam, moment, *links[k].fibre_distance));
      if (moment > out.worst[k].moment) out.worst[k] = {moment, most.position, sample.time};
    }
    column = energies;
    for (const double value : {sample.kinetic, sample.potential, sample.work, sample.dissipated,
                               sample.energy_balance() - run.samples.front().energy_balance()})
      push(column++, value);
  }
  return out;
}

std::vector<ChainPlot> plots_of(const ArmStudy& s) {
  std::vector<std::string> angles{"hub_angle_rad"}, speeds{"hub_speed_rad_per_s"}, torques, moments, stresses,
      hinge_forces;
  if (!std::holds_alternative<FreeForm>(s.drives[0])) torques.push_back("hub_torque_N_m");
  for (const ArmLinkForm& link : s.mechanism.links) {
    if (link.hinge) {
      angles.push_back(link.name + "_angle_rad");
      speeds.push_back(link.name + "_speed_rad_per_s");
      torques.push_back(link.name + "_torque_N_m");
      hinge_forces.push_back(link.name + "_force_x_N");
      hinge_forces.push_back(link.name + "_force_y_N");
    }
    moments.push_back(link.name + "_bending_moment_N_m");
    stresses.push_back(link.name + "_bending_stress_Pa");
  }
  return {
      {"tip", "Tip against the rigid arm, across and along the last link", {"tip_across_m", "tip_along_m"}},
      {"angles", "Angles of hub and hinges", angles},
      {"speeds", "Speeds of hub and hinges", speeds},
      {"torques", "Torques of the drives", torques},
      {"moments", "Largest bending moment in each link", moments},
      {"stresses", "Largest bending stress in each link", stresses},
      {"hub-force", "Force of the hub on the first link", {"hub_force_x_N", "hub_force_y_N"}},
      {"hinge-forces", "Forces in the hinges on the outer links", hinge_forces},
      {"energy", "Energies", {"kinetic_energy_J", "potential_energy_J", "work_J", "dissipated_J"}},
      {"balance", "Energy audit: kinetic + potential + dissipated - work", {"energy_balance_J"}}};
}

// Forces and torques of the hinges, as arrows.
void add_hinges(const ArmStudy& s, const ArmChain& arm, const Table& table, study::Scene& scene) {
  for (std::size_t k = 0; k < arm.links.size(); ++k) {
    if (!arm.links[k].hinge) continue;
    const std::string& name = s.mechanism.links[k].name;
    const int point = static_cast<int>(1 + arm.links[k].root);
    scene.vectors.push_back({"hinge on " + name, study::Scene::Quantity::force, "N", point,
                             table.find(name + "_force_x_N")->values, table.find(name + "_force_y_N")->values,
                             name});
    if (const Column* torque = table.find(name + "_torque_N_m"))
      scene.moments.push_back({"drive of " + name, "N m", point, torque->values, {}});
  }
}

}  // namespace

ChainStudy arm_chain_study(const ArmStudy& s) {
  ChainStudy out;
  out.arm = [form = s.mechanism](int times) {
    std::vector<ArmLink> links;
    for (const ArmLinkForm& l : form.links) {
      ArmLink link{.beam = l.beam, .divisions = times * l.divisions, .hinge = {}};
      if (l.hinge) link.hinge = l.hinge->joint;
      link.beam.extensible = form.hub.extensible;
      link.beam.mass_damping = form.hub.mass_damping;
      link.beam.stiffness_damping = form.hub.stiffness_damping;
      if (links.empty()) {
        link.beam.hub_radius = form.hub.hub_radius;
        link.beam.hub_inertia = form.hub.hub_inertia;
        link.beam.hub_stiffness = form.hub.hub_stiffness;
        link.beam.hub_damping = form.hub.hub_damping;
        link.beam.gravity = form.hub.gravity;
      }
      links.push_back(link);
    }
    return arm_chain(links);
  };
  for (const ArmLinkForm& link : s.mechanism.links) out.names.push_back(link.name);
  for (const DriveLaw& law : s.drives) out.drives.push_back(joint_drive(law, s.simulation.end));
  out.simulation = s.simulation;
  out.shaping = s.shaping;
  out.samples = s.samples;
  out.table = [s](const ArmChain& arm, const Simulation& run) { return record(s, arm, run).table; };
  out.tip = {"tip_across_m", "tip_along_m"};
  out.plots = plots_of(s);
  return out;
}

study::Result run_arm_study(const ArmStudy& s, RunContext& context) {
  ChainRun run = run_chain(arm_chain_study(s), context);
  study::Result& result = run.result;
  const Table& motion = result.tables.front();
  const std::vector<Worst> worst = record(s, run.arm, run.simulation).worst;
  std::vector<study::Fact> facts;
  const study::AddFact fact{facts};

  double peak = 0, when = 0;
  for (std::size_t i = 0; i < motion.rows(); ++i) {
    const double off =
        std::hypot(motion.find("tip_along_m")->values[i], motion.find("tip_across_m")->values[i]);
    if (off > peak) peak = off, when = motion.find("time_s")->values[i];
  }
  fact("largest displacement of the tip against the rigid arm",
       say("{} at {}", millimetres(peak), at_place("time", seconds(when))));
  if (!std::holds_alternative<FreeForm>(s.drives[0]))
    fact("largest torque on the hub", newton_metres(largest_of(motion, "hub_torque_N_m")));
  Table sections{.name = "sections", .names = {}, .columns = {}, .status = {}};
  sections.add("bending_moment_N_m", "largest bending moment (N m)");
  sections.add("bending_stress_Pa", "largest bending stress (Pa)");
  sections.add("position_m", "where: from the root of the link (m)");
  sections.add("time_s", "when (s)");
  std::string max_stressed;
  double max_stress = 0;
  for (std::size_t k = 0; k < worst.size(); ++k) {
    const ArmLinkForm& link = s.mechanism.links[k];
    const Worst& w = worst[k];
    if (link.hinge && motion.find(link.name + "_torque_N_m"))
      fact("largest torque in the hinge of " + link.name,
           newton_metres(largest_of(motion, link.name + "_torque_N_m")));
    const Sentence from = say("{} from", at_place("position", millimetres(w.position)));
    const Sentence where =
        say("{} its root, at {}", w.position == 0 ? "at" : from, at_place("time", seconds(w.time)));
    double stress = nan;
    if (link.fibre_distance) {
      stress = bending_stress(link.beam, w.moment, *link.fibre_distance);
      if (stress > max_stress) max_stress = stress, max_stressed = link.name;
      fact("largest bending stress of " + link.name, say("{}, {}", measured("MPa", stress), where));
    } else {
      fact("largest bending moment of " + link.name, say("{}, {}", newton_metres(w.moment), where));
    }
    sections.names.push_back(link.name);
    std::size_t column = 0;
    for (const double value : {w.moment, stress, w.position, w.time})
      sections.columns[column++].values.push_back(value);
  }
  if (!result.scenes.empty()) add_hinges(s, run.arm, motion, result.scenes.front());
  result.facts.insert(result.facts.begin(), facts.begin(), facts.end());
  result.headline = result.status == Status::done
                        ? say("The tip leaves that of the rigid arm by up to {}{}.", millimetres(peak),
                              max_stressed.empty()
                                  ? Sentence()
                                  : say("; {} bends most, by {}", max_stressed, measured("MPa", max_stress)))
                        : headline_of_end(run.simulation);
  result.tables.push_back(std::move(sections));
  return std::move(result);
}

study::Kind arm_kind() {
  study::Kind kind;
  kind.kind = "simulation";
  kind.mechanism = "flexible.arm";
  kind.summary =
      "arm of elastic links in series, hinged or welded: motion, torques, joint forces, stress, frequencies, "
      "input shaping";
  kind.example = templates::simulation_arm();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "hub and links").required(), study::schema_fields<ArmForm>());
    document.property(field::entry("drive", "what turns hub and hinges").required(),
                      study::schema_array(study::schema_fields<ArmDriveForm>()));
    document.property(field::entry("shaping", "input shaping of all drives that cancels a vibration"),
                      study::schema_fields<ShapingForm>());
    document.property(field::entry("simulation", "how it is followed in time").required(),
                      study::schema_fields<SimulationForm>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_arm_study(document, common, prepared.canonical))
      prepared.run = [s = *std::move(s)](RunContext& context) { return run_arm_study(s, context); };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::flexible
