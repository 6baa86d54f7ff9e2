#include "linkwright/flexible/hub_link_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linkwright/flexible/modes.h"
#include "linkwright/math/angles.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::flexible {
namespace {

constexpr const char* scene_name = "motion";
/// Divisions of the comparison are at most these.
constexpr int most_divisions = 400;

HubMotion turn_at(const TurnForm& f, double time) {
  const double x = std::clamp(time / f.duration, 0.0, 1.0);
  if (time < 0 || time > f.duration) return {x > 0 ? f.angle : 0, 0, 0};
  const double rate = f.angle / f.duration;
  return {f.angle * x * x * x * (10 + x * (-15 + 6 * x)), rate * 30 * x * x * (1 - x) * (1 - x),
          rate / f.duration * 60 * x * (1 - x) * (1 - 2 * x)};
}

/// Whether the hub's angle is given, and not a torque.
bool given_motion(const HubDriveForm& d) {
  return std::holds_alternative<SpinUpForm>(d.law) || std::holds_alternative<TurnForm>(d.law);
}

std::vector<double> breaks_of(const HubDriveForm& d) {
  return std::visit(
      [](const auto& f) -> std::vector<double> {
        using F = std::decay_t<decltype(f)>;
        if constexpr (std::is_same_v<F, SpinUpForm> || std::is_same_v<F, SinePulseForm>)
          return {f.law.duration};
        else if constexpr (std::is_same_v<F, TurnForm>)
          return {f.duration};
        else
          return {};
      },
      d.law);
}

HubMotion motion_at(const HubDriveForm& d, double time) {
  if (const auto* spin = std::get_if<SpinUpForm>(&d.law)) return spin->law(time);
  return turn_at(std::get<TurnForm>(d.law), time);
}
double torque_at(const HubDriveForm& d, double time) {
  const auto* pulse = std::get_if<SinePulseForm>(&d.law);
  return pulse ? pulse->law(time) : 0;
}

Simulation simulate(const HubLinkStudy& s, const Chain& chain, std::span<const Impulse> impulses,
                    bool keep_states, const RunContext& context) {
  const std::vector<double> breaks =
      impulses.empty() ? breaks_of(s.drive) : shaped_breaks(breaks_of(s.drive), impulses);
  const SimulationOptions options{.end = s.simulation.end,
                                  .output_interval = s.simulation.end / (s.samples - 1),
                                  .step = s.simulation.step,
                                  .breaks = breaks,
                                  .extrapolate = s.simulation.extrapolate || s.simulation.tolerance,
                                  .tolerance = s.simulation.tolerance.value_or(0),
                                  .keep_states = keep_states,
                                  .context = &context};
  const auto motion = [&](double t) { return motion_at(s.drive, t); };
  const auto torque = [&](double t) { return torque_at(s.drive, t); };
  if (given_motion(s.drive)) {
    const auto shaped_motion = [&](double t) { return shaped(motion, impulses, t); };
    return impulses.empty() ? simulate_motion(chain, motion, options)
                            : simulate_motion(chain, shaped_motion, options);
  }
  Start start;
  if (const auto* free = std::get_if<FreeForm>(&s.drive.law))
    start = {.angle = free->angle, .rate = free->speed};
  const auto late_torque = [&](double t) { return shaped_torque(torque, impulses, t); };
  return impulses.empty() ? simulate_torque(chain, torque, options, start)
                          : simulate_torque(chain, late_torque, options, start);
}

Table modes_table(const std::vector<Mode>& found) {
  Table table{.name = "modes"};
  std::vector<double> number, rate, hertz;
  for (std::size_t i = 0; i < found.size(); ++i) {
    number.push_back(static_cast<double>(i + 1));
    rate.push_back(found[i].frequency);
    hertz.push_back(found[i].frequency / (2 * std::numbers::pi));
  }
  table.add("mode", "mode", number);
  table.add("frequency_rad_per_s", "frequency (rad/s)", rate);
  table.add("frequency_Hz", "frequency (Hz)", hertz);
  return table;
}

/// Nodes of the link in the plane, deflections to scale.
study::Scene scene_of(const Simulation& run, const Chain& chain) {
  study::Scene scene;
  scene.name = scene_name;
  scene.title = "hub and link";
  scene.input_key = "time_s";
  scene.input_label = "time";
  const std::size_t nodes = chain.cells.size() + 1;
  std::vector<study::Scene::Point> link(nodes);
  study::Scene::Point straight{"where the rigid link has its tip", {}, {}};
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    const ChainState& state = run.states[i];
    scene.input.push_back(run.samples[i].time);
    const double c = std::cos(state.angle), s = std::sin(state.angle);
    const ChainShape at = shape(chain, state.q);
    const auto put = [&](study::Scene::Point& to, double x, double y) {
      to.x.push_back(c * x - s * y);
      to.y.push_back(s * x + c * y);
    };
    for (std::size_t k = 0; k < nodes; ++k) put(link[k], at.node[k].x, at.node[k].y);
    put(straight, chain.hub_radius + chain.length(), 0);
  }
  scene.points.push_back({"O", {0}, {0}});
  std::vector<int> line{0};
  link.front().name = "weld";
  link.back().name = "tip";
  for (auto& p : link) {
    line.push_back(static_cast<int>(scene.points.size()));
    scene.points.push_back(std::move(p));
  }
  const int rigid = static_cast<int>(scene.points.size());
  scene.points.push_back(std::move(straight));
  for (std::size_t k = 0; k + 1 < line.size(); ++k)
    if (k > 0 || chain.hub_radius > 0)
      scene.bodies.push_back({k == 0 ? "hub" : "link", {line[k], line[k + 1]}, study::Scene::BodyStyle::bar});
  scene.bodies.push_back({"rigid link", {0, rigid}, study::Scene::BodyStyle::axis});
  scene.joints = {{"O", 0, study::Scene::JointStyle::ground_pivot},
                  {"tip", line.back(), study::Scene::JointStyle::tracer}};
  scene.traces = {{line.back(), "path of the tip", false}};
  return scene;
}

double largest_after(const Simulation& run, double time, double Sample::*what) {
  double out = 0;
  for (const Sample& s : run.samples)
    if (s.time >= time) out = std::max(out, std::abs(s.*what));
  return out;
}

void add_plots(study::Result& result) {
  const auto plot = [&](const char* name, const char* title, std::vector<std::string> y) {
    std::erase_if(y, [&](const std::string& key) { return !result.tables.front().find(key); });
    if (!y.empty())
      result.plots.push_back({.name = name,
                              .title = title,
                              .table = "motion",
                              .x = "time_s",
                              .y = std::move(y),
                              .scene = scene_name});
  };
  plot("tip", "Displacement of the tip, across and along the link", {"tip_eta_m", "tip_xi_m"});
  plot("hub", "Angle of the hub", {"hub_angle_rad"});
  plot("rate", "Speed of the hub", {"hub_speed_rad_per_s"});
  plot("torque", "Torque of the drive", {"torque_N_m"});
  plot("weld-force", "Force at the weld", {"reaction_xi_N", "reaction_eta_N"});
  plot("weld-moment", "Moment at the weld", {"moment_N_m"});
  plot("stress", "Largest bending stress", {"bending_stress_Pa"});
  plot("energy", "Energies", {"kinetic_energy_J", "potential_energy_J", "work_J", "dissipated_J"});
  plot("balance", "Energy audit: kinetic + potential + dissipated - work", {"energy_balance_J"});
}

std::string millimetres(double metres) { return fmt::format("{:.4g} mm", 1e3 * metres); }

std::optional<HubLinkStudy> read_study(study::ObjectReader& document, const study::Common& common,
                                       Value& canonical) {
  HubLinkStudy s;
  s.samples = common.output.samples;
  auto mechanism = document.table(Field{.key = "mechanism", .summary = {}, .required = true});
  auto drive = document.table(Field{.key = "drive", .summary = {}, .required = true});
  auto simulation = document.table(Field{.key = "simulation", .summary = {}, .required = true});
  if (mechanism) mechanism->read(s.mechanism);
  if (drive) drive->read(s.drive);
  if (simulation) simulation->read(s.simulation);
  if (!mechanism || !drive || !simulation || document.document().has_errors()) return std::nullopt;
  if (const auto wrong = problem(s.mechanism.beam)) {
    mechanism->error("", *wrong);
    return std::nullopt;
  }
  const Beam& b = s.mechanism.beam;
  if (s.simulation.kinematics == Kinematics::source_linearised &&
      (b.gravity > 0 || b.mass_damping > 0 || b.stiffness_damping > 0 || b.extensible)) {
    simulation->error("kinematics", "the printed equations know neither gravity nor damping nor stretching",
                      "take chord_consistent");
    return std::nullopt;
  }
  if (s.simulation.end / s.simulation.step > 1e7) {
    simulation->error("step", fmt::format("makes {:.3g} steps, at most 1e7 are allowed",
                                          s.simulation.end / s.simulation.step));
    return std::nullopt;
  }
  if (s.drive.shaping && std::holds_alternative<FreeForm>(s.drive.law)) {
    drive->error("shaping", "there is no drive to be shaped", "leave it out");
    return std::nullopt;
  }
  canonical["mechanism"] = study::write_fields(s.mechanism);
  canonical["drive"] = study::write_fields(s.drive);
  canonical["simulation"] = study::write_fields(s.simulation);
  return s;
}

}  // namespace

study::Result run_hub_link(const HubLinkStudy& s, RunContext& context) {
  study::Result result;
  const Beam& beam = s.mechanism.beam;
  const Chain chain = discretise(beam, s.simulation.divisions, s.simulation.kinematics);
  const Hub hub = given_motion(s.drive) ? Hub::driven : Hub::free;
  const int count =
      std::min<int>(s.simulation.modes + (hub == Hub::free), 2 * static_cast<int>(chain.cells.size()));
  const auto found = modes(chain, count, {.hub = hub});

  std::vector<Impulse> impulses;
  ShapedMode shaped_mode;
  if (s.drive.shaping) {
    const ShapingForm& f = *s.drive.shaping;
    // A free hub has its rotation as first mode.
    const std::size_t which =
        static_cast<std::size_t>(f.mode - 1 + (hub == Hub::free && found[0].frequency == 0));
    shaped_mode = {f.frequency ? 2 * std::numbers::pi * *f.frequency
                               : modes(chain, static_cast<int>(which) + 1, {.hub = hub})[which].frequency,
                   f.damping};
    impulses = flexible::impulses(f.shaper, shaped_mode);
  }
  const Simulation run = simulate(s, chain, impulses, true, context);
  result.status = run.status;
  Table motion = table_of(run.samples);
  motion.name = "motion";
  if (s.mechanism.fibre_distance) {
    std::vector<double> stress;
    for (const Sample& at : run.samples)
      stress.push_back(bending_stress(beam, at.bending_moment, *s.mechanism.fibre_distance));
    motion.add("bending_stress_Pa", "largest bending stress (Pa)", std::move(stress));
  }
  result.tables.push_back(std::move(motion));
  result.tables.push_back(modes_table(found));
  add_plots(result);

  const auto fact = [&](std::string label, std::string text,
                        study::Fact::Verdict verdict = study::Fact::Verdict::plain) {
    result.facts.push_back({std::move(label), std::move(text), verdict});
  };
  const double peak = largest_after(run, 0, &Sample::tip_eta);
  fact("largest displacement of the tip across the link", millimetres(peak));
  std::string frequencies;
  for (const Mode& m : found)
    if (m.frequency > 0)
      frequencies +=
          fmt::format("{}{:.4g}", frequencies.empty() ? "" : ", ", m.frequency / (2 * std::numbers::pi));
  fact("frequencies at rest", frequencies + " Hz");
  if (s.mechanism.fibre_distance)
    fact("largest bending stress",
         fmt::format("{:.4g} MPa", 1e-6 * bending_stress(beam, largest_after(run, 0, &Sample::bending_moment),
                                                         *s.mechanism.fibre_distance)));
  fact("largest torque of the drive", fmt::format("{:.4g} N m", largest_after(run, 0, &Sample::torque)));
  double drift = 0, energy = 0;
  if (!run.samples.empty()) {
    const double start = run.samples.front().energy_balance();
    for (const Sample& at : run.samples) {
      drift = std::max(drift, std::abs(at.energy_balance() - start));
      energy = std::max(energy, std::abs(at.kinetic) + std::abs(at.potential));
    }
  }
  fact("drift of the energy audit",
       fmt::format("{:.2g} J ({:.1g} of the peak)", drift, energy > 0 ? drift / energy : 0.0));
  if (run.error > 0) fact("change of the tip by the last halving of the step", millimetres(run.error));
  const auto breaks = breaks_of(s.drive);
  const double quiet = breaks.empty() ? 0 : breaks.back();
  if (!breaks.empty() && quiet < s.simulation.end)
    fact("vibration of the tip after the drive", [&] {
      const double from = impulses.empty() ? quiet : quiet + impulses.back().time;
      double low = 1e300, high = -1e300;
      for (const Sample& at : run.samples)
        if (at.time >= from) low = std::min(low, at.tip_eta), high = std::max(high, at.tip_eta);
      return high >= low ? millimetres(high - low) + " from peak to peak" : std::string("beyond the end");
    }());
  if (!impulses.empty()) {
    const Simulation plain = simulate(s, chain, {}, false, context);
    Table other = table_of(plain.samples);
    other.name = "unshaped";
    for (study::Plot& p : result.plots)
      if (std::all_of(p.y.begin(), p.y.end(), [&](const std::string& key) { return other.find(key); }))
        p.baseline = "unshaped";
    result.tables.push_back(std::move(other));
    fact("shaped for", fmt::format("{:.4g} Hz by {}: the drive takes {:.4g} s longer",
                                   shaped_mode.frequency / (2 * std::numbers::pi),
                                   name_of(s.drive.shaping->shaper), impulses.back().time));
  }
  if (s.simulation.compare_divisions && 2 * s.simulation.divisions <= most_divisions &&
      run.status == Status::done) {
    const Simulation finer = simulate(
        s, discretise(beam, 2 * s.simulation.divisions, s.simulation.kinematics), impulses, false, context);
    double difference = 0;
    for (std::size_t i = 0; i < std::min(finer.samples.size(), run.samples.size()); ++i)
      difference = std::max(difference, std::abs(finer.samples[i].tip_eta - run.samples[i].tip_eta));
    if (finer.status == Status::done)
      fact(fmt::format("change of the tip with {} divisions", 2 * s.simulation.divisions),
           millimetres(difference));
  }
  for (const std::string& warning : run.warnings)
    result.diagnostics.push_back({Diagnostic::Severity::warning, {}, {}, "simulation", warning, {}});
  if (run.status != Status::done)
    result.diagnostics.push_back(
        {Diagnostic::Severity::warning, {}, {}, "simulation", run.message, "the samples so far are kept"});
  if (!run.states.empty()) result.scenes.push_back(scene_of(run, chain));
  result.headline = run.status == Status::done
                        ? fmt::format("The tip leaves the line of the hub by up to {}.", millimetres(peak))
                        : fmt::format("Ended at {:.4g} s: {}.",
                                      run.samples.empty() ? 0.0 : run.samples.back().time, run.message);
  return result;
}

study::Kind hub_link_kind() {
  study::Kind kind;
  kind.kind = "simulation";
  kind.mechanism = "flexible.hub_link";
  kind.summary =
      "hub with an elastic link and a tip mass: motion, weld forces, stress, frequencies, input shaping";
  kind.example = R"(# linkwright study: an elastic link on a hub that is turned by half a turn
schema = 1
kind   = "simulation"
title  = "Elastic arm, half a turn"

[mechanism]
type                = "flexible.hub_link"
length_m            = 1.8
density_kg_per_m3   = 2766
area_mm2            = 250.0            # 100 x 2.5 mm
second_moment_mm4   = 130.21
elastic_modulus_GPa = 69.0
tip_mass_kg         = 0.085
hub_radius_mm       = 50.0
hub_inertia_kg_m2   = 0.30
fibre_distance_mm   = 1.25             # for the stress

[drive]
law        = "turn"                    # or spin_up, sine_torque, none
angle_deg  = 180.0
duration_s = 2.0

[drive.shaping]                        # leave it out to see the vibration
shaper = "zv"

[simulation]
end_s     = 5.0
step_s    = 0.005
divisions = 4
)";
  kind.schema = [](study::SchemaWriter& document) {
    document.property(Field{.key = "mechanism", .summary = "hub and link", .required = true},
                      study::schema_fields<HubLinkForm>());
    document.property(Field{.key = "drive", .summary = "what turns the hub", .required = true},
                      study::schema_fields<HubDriveForm>());
    document.property(Field{.key = "simulation", .summary = "how it is followed in time", .required = true},
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
