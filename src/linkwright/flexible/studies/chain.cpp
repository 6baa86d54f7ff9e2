// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/flexible/statics.h"
#include "linkwright/flexible/studies/chain_scene.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/memory.h"
#include "linkwright/study/remarks.h"

namespace linkwright::flexible {
namespace {

/// Cells of the comparison are at most these.
constexpr std::size_t max_cells = 2000;
/// Steps in a period of the first vibration below which they are too few to follow it.
constexpr double fewest_steps = 20;

// The arm with its hinges turned; those of given motion do not turn in a vibration.
struct Pose {
  Pose(const ChainStudy& s, double JointDrive::*angle) {
    for (std::size_t k = 1; k < s.drives.size(); ++k) {
      turns.push_back(s.drives[k].*angle);
      if (s.drives[k].motion) locked.push_back(k - 1);
    }
    hub = s.drives[0].motion ? Hub::driven : Hub::free;
  }
  Vibration vibration() const { return {.hub = hub, .turns = turns, .locked = locked}; }

  std::vector<double> turns;
  std::vector<std::size_t> locked;
  Hub hub = Hub::driven;
};

// The first modes that vibrate, rigid motions and what has no more left out.
std::vector<Mode> vibrations(const Chain& chain, const Pose& pose, int count) {
  const int rigid = static_cast<int>(1 + pose.turns.size());
  const Vibration about = pose.vibration();
  std::vector<Mode> found = modes(chain, std::min(count + rigid, mode_count(chain, about)), about);
  std::erase_if(found, [](const Mode& m) { return m.frequency == 0 && m.growth == 0; });
  if (static_cast<int>(found.size()) > count) found.resize(static_cast<std::size_t>(count));
  return found;
}

void add_modes(Table& table, const std::string& prefix, const std::string& where,
               const std::vector<Mode>& found) {
  std::vector<double> rate, hertz;
  for (const Mode& m : found) {
    rate.push_back(m.frequency);
    hertz.push_back(m.frequency / full_turn);
  }
  table.add(prefix + "frequency_rad_per_s", "frequency" + where + " (rad/s)", rate);
  table.add(prefix + "frequency_Hz", "frequency" + where + " (Hz)", hertz);
}

Start start_of(const ChainStudy& s, const Chain& chain, study::Result& result) {
  const JointDrive& hub = s.drives[0];
  Start out{.angle = hub.angle, .rate = hub.rate, .q = {}, .v = {}};
  out.q.resize(coordinates_per_cell * chain.cells.size());
  out.v.resize(out.q.size());
  const std::vector<std::size_t> joints = hinges(chain);
  std::vector<double> turns;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    turns.push_back(s.drives[k + 1].angle);
    out.q[coordinates_per_cell * joints[k] + turn] = turns.back();
    out.v[coordinates_per_cell * joints[k] + turn] = s.drives[k + 1].rate;
  }
  if (s.simulation.start == StartForm::equilibrium) {
    const Equilibrium bent =
        equilibrium(chain, {}, {.angle = hub.angle, .speed = hub.motion ? hub.rate : 0, .turns = turns});
    if (bent.status == Status::done)
      out.q = bent.state.q;
    else
      study::AddWarning{result.diagnostics}("simulation.start",
                                            "no equilibrium was found at the start; the links start straight",
                                            "they bend too far under their weight: take more divisions");
  }
  return out;
}

Simulation simulate(const ChainStudy& s, const Chain& chain, const Start& start,
                    std::span<const Impulse> impulses, bool keep_states, const RunContext& context) {
  std::vector<double> breaks;
  std::vector<std::function<HubMotion(double)>> motions(s.drives.size());
  std::vector<std::function<double(double)>> torques(s.drives.size());
  for (std::size_t k = 0; k < s.drives.size(); ++k) {
    const JointDrive& drive = s.drives[k];
    breaks.insert(breaks.end(), drive.breaks.begin(), drive.breaks.end());
    if (impulses.empty()) {
      motions[k] = drive.motion;
      torques[k] = drive.torque;
    } else {
      if (drive.motion)
        motions[k] = [&drive, impulses](double t) { return shaped(drive.motion, impulses, t); };
      if (drive.torque)
        torques[k] = [&drive, impulses](double t) { return shaped_torque(drive.torque, impulses, t); };
    }
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  if (!impulses.empty()) breaks = shaped_breaks(breaks, impulses);

  std::vector<HingeDrive> motors;
  for (std::size_t k = 1; k < s.drives.size(); ++k) {
    if (motions[k]) motors.push_back({.hinge = k - 1, .motion = AngleLaw(motions[k])});
    if (torques[k]) motors.push_back({.hinge = k - 1, .torque = TorqueLaw(torques[k])});
  }
  const SimulationForm& form = s.simulation;
  const SimulationOptions options{.end = form.end,
                                  .output_interval = form.end / (s.samples - 1),
                                  .step = form.step,
                                  .breaks = breaks,
                                  .extrapolate = form.extrapolate || form.tolerance,
                                  .tolerance = form.tolerance.value_or(0),
                                  .hinges = motors,
                                  .keep_states = keep_states,
                                  .context = &context};
  if (motions[0]) return simulate_motion(chain, motions[0], options, start);
  if (!torques[0]) torques[0] = [](double) { return 0.0; };
  return simulate_torque(chain, torques[0], options, start);
}

// Difference of both displacements of the tip in two runs (m).
double difference(const ChainStudy& s, const Table& a, const Table& b) {
  double out = 0;
  const std::size_t rows = std::min(a.rows(), b.rows());
  for (std::size_t i = 0; i < rows; ++i)
    out = std::max(out, std::hypot(a.find(s.tip[0])->values[i] - b.find(s.tip[0])->values[i],
                                   a.find(s.tip[1])->values[i] - b.find(s.tip[1])->values[i]));
  return out;
}

void add_plots(const ChainStudy& s, bool shaped, study::Result& result) {
  const study::AddPlot add{
      result, {.table = "motion", .x = "time_s", .scene = "motion", .baseline = shaped ? "unshaped" : ""}};
  for (const ChainPlot& plot : s.plots) add(plot.name, plot.title, plot.columns);
}

// The largest change of the energies less the work.
Sentence audit(const Simulation& run) {
  double drift = 0, energy = 0;
  for (const Sample& at : run.samples) {
    drift = std::max(drift, std::abs(at.energy_balance() - run.samples.front().energy_balance()));
    energy = std::max({energy, std::abs(at.kinetic), std::abs(at.potential), std::abs(at.work)});
  }
  return say("{} ({} of the peak)", measured("J", drift, 2),
             plain_number(energy > 0 ? drift / energy : 0, 1));
}

// From peak to peak across the last link, from a time on.
Sentence vibration_after(const ChainStudy& s, const Table& motion, double from) {
  const std::vector<double>&time = motion.find("time_s")->values, &tip = motion.find(s.tip[0])->values;
  double low = INFINITY, high = -INFINITY;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (time[i] >= from) low = std::min(low, tip[i]), high = std::max(high, tip[i]);
  return high >= low ? say("{} from peak to peak", millimetres(high - low)) : "beyond the end";
}

std::optional<double> quiet_from(const ChainStudy& s) {
  double out = 0;
  for (const JointDrive& drive : s.drives) {
    if (!drive.quiet) return {};
    out = std::max(out, *drive.quiet);
  }
  return out;
}

Sentence words_of(const std::vector<Mode>& found) {
  std::vector<double> frequencies;
  for (const Mode& m : found)
    if (m.frequency > 0) frequencies.push_back(m.frequency);
  return in_hertz(frequencies);
}

}  // namespace

double largest_of(const Table& table, std::string_view key) {
  const Column* column = table.find(key);
  return column ? study::largest_size(column->values) : 0;
}

Sentence in_hertz(const std::vector<double>& frequencies) {
  Sentence out;
  for (std::size_t i = 0; i < frequencies.size(); ++i) {
    const Measured one = measured("Hz", frequencies[i] / full_turn);
    out += i + 1 < frequencies.size() ? say("{}, ", one.sharing_unit()) : one;
  }
  return out;
}

Sentence headline_of_end(const Simulation& run) {
  return say("Ended at {}: {}.", at_place("time", seconds(run.samples.empty() ? 0 : run.samples.back().time)),
             run.message);
}

void check_times(const SimulationForm& form, study::ObjectReader& simulation) {
  if (!(form.end > 0)) return;  // missing or refused, and reported as such
  if (form.step > form.end)
    simulation.error("step", fmt::format("is {} s, longer than the {} s of the motion", form.step, form.end),
                     "about a hundredth of it, and a twentieth of the period of the first vibration");
  else if (form.end / form.step > 1e7)
    simulation.error("step",
                     fmt::format("makes {:.3g} steps, at most 1e7 are allowed", form.end / form.step));
}

void check_shaping(const ChainStudy& s, study::ObjectReader& parent) {
  if (!s.shaping) return;
  if (std::all_of(s.drives.begin(), s.drives.end(), [](const JointDrive& d) { return d.free(); })) {
    parent.error("shaping", "there is no drive to be shaped", "leave it out");
  } else if (!s.shaping->frequency) {
    const Pose end(s, &JointDrive::last);
    const std::size_t there = vibrations(s.arm(1).chain, end, s.shaping->mode).size();
    if (there < static_cast<std::size_t>(s.shaping->mode))
      parent.error("shaping", fmt::format("is for mode {}, but there are {}", s.shaping->mode, there),
                   "take more divisions, or another theory of the link");
  }
}

ChainRun run_chain(const ChainStudy& s, RunContext& context) {
  ChainRun out{.arm = s.arm(1), .simulation = {}, .result = {}};
  study::Result& result = out.result;
  const Chain& chain = out.arm.chain;
  const study::AddFact fact{result.facts};
  const study::AddWarning warn{result.diagnostics};

  const Pose first(s, &JointDrive::angle), last(s, &JointDrive::last);
  const std::vector<Mode> found = vibrations(chain, first, s.simulation.modes);
  const std::vector<Mode> at_end =
      first.turns == last.turns ? found : vibrations(chain, last, s.simulation.modes);
  std::vector<Impulse> impulses;
  ShapedMode shaped_mode;
  if (s.shaping) {
    const auto mode = static_cast<std::size_t>(s.shaping->mode - 1);
    shaped_mode = {s.shaping->frequency ? full_turn * *s.shaping->frequency
                                        : vibrations(chain, last, s.shaping->mode)[mode].frequency,
                   s.shaping->damping};
    impulses = flexible::impulses(s.shaping->shaper, shaped_mode);
  }

  const Start start = start_of(s, chain, result);
  out.simulation = simulate(s, chain, start, impulses, true, context);
  const Simulation& run = out.simulation;
  result.status = run.status;
  result.tables.push_back(s.table(out.arm, run));
  Table modes_table{.name = "modes"};
  std::vector<double> number(found.size());
  for (std::size_t i = 0; i < number.size(); ++i) number[i] = static_cast<double>(i + 1);
  modes_table.add("mode", "mode", number);
  add_modes(modes_table, "", "", found);
  if (first.turns != last.turns) add_modes(modes_table, "end_", " at the end", at_end);
  result.tables.push_back(std::move(modes_table));
  add_plots(s, !impulses.empty(), result);

  fact("frequencies at rest", words_of(found));
  if (first.turns != last.turns) fact("frequencies at the end", words_of(at_end));
  fact("drift of the energy audit", audit(run));
  if (run.error > 0) fact("change of the tip by the last halving of the step", millimetres(run.error));
  const std::optional<double> drives_end = quiet_from(s);
  if (drives_end && *drives_end > 0 && *drives_end < s.simulation.end)
    fact("vibration of the tip after the drive",
         vibration_after(s, result.tables[0], *drives_end + (impulses.empty() ? 0 : impulses.back().time)));
  if (!impulses.empty()) {
    fact("shaped for",
         say("{} by {}: the drive takes {} longer", measured("Hz", shaped_mode.frequency / full_turn),
             name_of(s.shaping->shaper), seconds(impulses.back().time)));
    const Simulation plain = simulate(s, chain, start, {}, true, context);
    Table other = s.table(out.arm, plain);
    other.name = "unshaped";
    if (drives_end && *drives_end > 0 && *drives_end < s.simulation.end && plain.status == Status::done)
      fact("the same without shaping", vibration_after(s, other, *drives_end));
    result.tables.push_back(std::move(other));
  }
  if (s.simulation.compare_divisions && 2 * chain.cells.size() <= max_cells && run.status == Status::done) {
    const ArmChain fine = s.arm(2);
    study::Result unused;
    const Simulation finer =
        simulate(s, fine.chain, start_of(s, fine.chain, unused), impulses, true, context);
    if (finer.status == Status::done)
      fact("change of the tip with twice the divisions",
           millimetres(difference(s, s.table(fine, finer), result.tables[0])));
  }
  if (!found.empty() && found[0].frequency > 0 && !s.simulation.tolerance) {
    const double period = full_turn / found[0].frequency;
    if (fewest_steps * s.simulation.step > period)
      warn("simulation.step",
           fmt::format("of {:.4g} s is long: the first vibration of {:.4g} Hz has a period of {:.4g} s",
                       s.simulation.step, 1 / period, period),
           fmt::format("take {:.2g} s or less", period / fewest_steps));
  }
  for (const std::string& warning : run.warnings) warn("simulation", warning, {});
  if (run.status != Status::done) warn("simulation", run.message, "the samples so far are kept");
  if (!run.states.empty())
    result.scenes.push_back(chain_scene(out.arm, s.names, run, s.simulation.deflection_scale));
  return out;
}

bool fits_memory(study::ObjectReader& document, int samples, int cells) {
  // Position and speed of each cell as kept, its place as drawn and written.
  constexpr double kept = 6 * sizeof(double), drawn = 2;
  const double bytes = double(cells) * (samples * kept + study::table_bytes(samples, drawn));
  const std::string what = fmt::format("{} samples of {} cells", samples, cells);
  constexpr std::string_view mend = "take fewer samples or divisions";
  if (auto output = document.table("output"))
    return study::require_memory(*output, "samples", bytes, what, mend);
  return study::require_memory(document, "output", bytes, what, mend);
}

}  // namespace linkwright::flexible
