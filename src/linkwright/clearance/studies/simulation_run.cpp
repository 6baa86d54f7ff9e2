// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/clearance/studies/simulation_rows.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"

namespace linkwright::clearance {
namespace {

using planar::InputMotion;

// A motion that repeats itself after more periods than this counts as one that does not.
constexpr int max_periods = 8;

std::vector<math::MotionCurve> curves_of(const ClearanceStudy& s) {
  std::vector<math::MotionCurve> out;
  for (const planar::InputDrive& c : s.drives)
    if (c.law) out.emplace_back(*c.law);
  return out;
}
bool all_driven(const ClearanceStudy& s) {
  return std::all_of(s.drives.begin(), s.drives.end(), [](const auto& c) { return c.law.has_value(); });
}
std::vector<InputMotion> inputs_at(const std::vector<math::MotionCurve>& curves, double t) {
  std::vector<InputMotion> out;
  for (const math::MotionCurve& curve : curves) {
    const math::Motion m = curve(t);
    out.push_back({m.value, m.rate, m.acceleration});
  }
  return out;
}
// Value of the first input, which loads may depend on.
double first_of(std::span<const InputMotion> inputs) { return inputs.empty() ? 0 : inputs[0].value; }
// The part of a section's state that has to come back, scaled: for pins in free flight also their distance
// from the circle.
std::vector<double> section_state(const ClearanceStudy& s, const RecordedRow& row, double fastest) {
  std::vector<double> out;
  for (std::size_t k = 0; k < row.pins.size(); ++k) {
    const PinInstant& p = row.pins[k];
    const bool link = s.model == PinModel::continuous;
    const std::complex<double> way = link ? std::polar(1.0, p.angle) : p.eccentricity / s.clearance_of(k);
    const std::complex<double> rate =
        link ? std::complex<double>(p.angle_rate * s.period / (2 * pi)) : p.rate / fastest;
    out.insert(out.end(), {way.real(), way.imag(), rate.real(), rate.imag()});
  }
  return out;
}

class Recorder {
 public:
  Recorder(const ClearanceStudy& s, RunContext& context)
      : s_(s),
        context_(context),
        same_(1e-12 * std::max({std::abs(s.from), std::abs(s.to()), s.to() - s.from})),
        rows_(s, out_, [this](RecordedRow&& row) { return keep(std::move(row)); }) {
    for (const planar::InputDrive& c : s_.drives)
      start_.push_back(c.law ? math::MotionCurve(*c.law)(s_.from).value : c.value);
    for (const ContactJoint& c : s_.contacts) contact_numbers_.push_back(c.joint);
  }

  ClearanceRecording run() {
    out_.from = s_.from;
    if (prepare()) {
      if (s_.periodic())
        find_regime();
      else
        once();
    }
    without_clearance();
    paths();
    return std::move(out_);
  }

 private:
  // ---- times --------------------------------------------------------------------------------------------

  // Rows of a transient, and sections; both in one run: a section within rounding of a row is that row.
  void set_times() {
    std::vector<double> rows, sections;
    const double to = s_.to();
    for (int i = 0; i < s_.samples; ++i)
      rows.push_back(i + 1 == s_.samples ? to : s_.from + (to - s_.from) * i / (s_.samples - 1));
    for (int k = 0; k < ClearanceRecording::max_sections && s_.period > 0 && s_.from + k * s_.period <= to;
         ++k)
      sections.push_back(s_.from + k * s_.period);
    for (std::size_t i = 0, k = 0; i < rows.size() || k < sections.size();) {
      const double row = i < rows.size() ? rows[i] : infinity;
      const double section = k < sections.size() ? sections[k] : infinity;
      times_.push_back(std::abs(row - section) <= same_ ? row : std::min(row, section));
      is_row_.push_back(row <= times_.back());
      is_section_.push_back(section <= times_.back() + same_);
      i += is_row_.back();
      k += is_section_.back();
    }
  }
  // The same of so many periods, each with all samples.
  void set_times(int periods) {
    times_.clear();
    is_section_.clear();
    const int each = s_.samples - 1;
    for (int i = 0; i <= periods * each; ++i) {
      times_.push_back(s_.from + s_.period * (double(i) / each));
      is_section_.push_back(i % each == 0);
    }
    is_row_.assign(times_.size(), true);
  }

  // ---- rows ---------------------------------------------------------------------------------------------

  // Rows that have no position are left out.
  bool keep(RecordedRow&& row) {
    const auto found = std::lower_bound(times_.begin(), times_.end(), row.time - same_);
    const auto now = static_cast<std::size_t>(std::min(found, times_.end() - 1) - times_.begin());
    if (is_section_[now]) out_.sections.push_back({.time = row.time, .status = row.status, .pins = row.pins});
    if (is_row_[now]) out_.rows.push_back(std::move(row));
    return !is_section_[now] || !searching_ || !repeats();
  }
  // True if the last section repeats an earlier one; then the motion is known. Drops old rows.
  bool repeats() {
    double fastest = 1e-300;
    for (std::size_t k = 0; k < s_.pins(); ++k)
      fastest = std::max(fastest, s_.clearance_of(k) * 2 * pi / s_.period);
    for (const RecordedRow& row : out_.sections)
      for (const PinInstant& p : row.pins) fastest = std::max(fastest, std::abs(p.rate));
    std::vector<std::vector<double>> states;
    const std::size_t first =
        out_.sections.size() - std::min<std::size_t>(out_.sections.size(), max_periods + 1);
    for (std::size_t i = first; i < out_.sections.size(); ++i)
      states.push_back(section_state(s_, out_.sections[i], fastest));
    ClearanceRegime& regime = *out_.regime;
    regime.turns = repeating_period(states, s_.periodic()->tolerance, max_periods);
    regime.waited = static_cast<int>(out_.sections.size()) - 1;
    const std::size_t apart = at(std::max(regime.turns, 1));
    if (states.size() > apart) {
      regime.change = 0;
      for (std::size_t i = 0; i < states.back().size(); ++i)
        regime.change =
            std::max(regime.change, std::abs(states.back()[i] - states[states.size() - 1 - apart][i]));
    }
    drop_rows(out_.sections.back().time - (regime.turns > 0 ? regime.turns : max_periods) * s_.period);
    return regime.turns > 0;
  }
  void drop_rows(double before) {
    const auto first = std::find_if(out_.rows.begin(), out_.rows.end(),
                                    [&](const RecordedRow& row) { return row.time >= before - same_; });
    out_.rows.erase(out_.rows.begin(), first);
  }

  // ---- the moving linkages ------------------------------------------------------------------------------

  bool prepare() {
    if (s_.model != PinModel::contact) {
      starts_ = started();
      cleared_ = with_clearance(s_.linkage, starts_, start_);
      if (cleared_.status != Status::done) return fail(cleared_.status, cleared_.message);
      rows_.expect(cleared_, starts_);
    }
    if (s_.model != PinModel::continuous) {
      // The same linkage as that of the simulation, to which the forces of the contacts are added here, too.
      open_ = open_linkage(s_.linkage, contact_numbers_, start_);
      if (open_.status != Status::done) return fail(open_.status, open_.message);
      rows_.expect(open_);
    }
    rows_.choose_columns();
    return true;
  }
  bool fail(Status status, const std::string& message) {
    out_.status = status;
    out_.message = message;
    return false;
  }
  planar::SimulationOptions continuous_options() const {
    return {.relative_tolerance = s_.relative_tolerance,
            .absolute_tolerance = 0.1 * s_.relative_tolerance,
            .max_steps = s_.max_steps};
  }

  void simulate() {
    if (s_.model == PinModel::continuous)
      with_continuous_contact();
    else if (s_.model == PinModel::contact)
      with_contacts();
    else
      with_both();
  }
  template <class Run>
  void take(const Run& run) {
    out_.largest_drift = run.largest_drift;
    out_.peak_energy = run.peak_energy;
    out_.steps = run.steps;
    out_.evaluations = run.evaluations;
    out_.time = run.time;
  }
  void with_contacts() {
    const ContactRun run = simulate_contact(
        s_.linkage, s_.contacts, s_.drives, times_,
        {.tolerance = s_.relative_tolerance,
         .max_steps = s_.max_steps,
         .stop_when_hopeless = s_.periodic() == nullptr},
        [&](const ContactRow& row) { return rows_.add(row); }, &context_);
    fail(run.status, run.message);
    take(run);
    out_.events = run.events;
    out_.contacts = run.totals;
  }
  void with_continuous_contact() {
    const JointClearanceRun run = simulate_joint_clearance(
        s_.linkage, starts_, s_.drives, times_, continuous_options(),
        [&](const JointClearanceRow& row) { return rows_.add(row); }, &context_, AtSeparation::go_on,
        s_.periodic() ? AtHopeless::go_on : AtHopeless::stop);
    fail(run.status, run.message);
    take(run.simulation);
    out_.validity = run.joints;
  }
  void with_both() {
    std::vector<AutomaticPin> pins;
    for (std::size_t k = 0; k < starts_.size(); ++k)
      pins.push_back({s_.contacts[k], starts_[k].angle, starts_[k].rate});
    const AutomaticContactRun run = simulate_automatic_contact(
        s_.linkage, pins, s_.drives, times_,
        {.tolerance = s_.relative_tolerance,
         .max_steps = s_.max_steps,
         .stop_when_hopeless = s_.periodic() == nullptr},
        {.continuous = [&](const JointClearanceRow& row) { return rows_.add(row); },
         .contact = [&](const ContactRow& row) { return rows_.add(row); }},
        &context_);
    fail(run.status, run.message);
    take(run);
    out_.events = run.contact.events;
    out_.contacts = run.contact.totals;
    out_.validity = run.continuous.joints;
    out_.switched = run.switched;
    out_.parted = run.pin;
    out_.switched_inputs = run.inputs;
  }

  // ---- runs ---------------------------------------------------------------------------------------------

  void once() {
    set_times();
    simulate();
  }
  void clear() {
    out_.rows.clear();
    out_.sections.clear();
    out_.events.clear();
    out_.contacts.clear();
    out_.switched = nan;
    out_.parted = -1;
  }
  // Continuous contact has its periodic motion found by shooting, whether or not the motion from the start
  // would settle on it. Of pins that may part it counts where it keeps contact and is not unstable. All
  // others continue period after period until a section repeats.
  void find_regime() {
    out_.regime.emplace();
    const std::vector<JointClearance> given = starts_;
    if (s_.model != PinModel::contact && shoot()) return;
    starts_ = given;
    clear();
    set_times(s_.periodic()->max_turns);
    searching_ = true;
    simulate();
    const ClearanceRegime& regime = *out_.regime;
    if (regime.turns == 0) {
      // Keeps the end of the run: the last complete period, and the one that was begun.
      if (!out_.sections.empty()) drop_rows(out_.sections.back().time - s_.period);
      if (out_.status == Status::done)
        fail(Status::not_converged,
             fmt::format(
                 "the motion did not become periodic within {} turns: the last one changed it by {:.3g}, "
                 "more than the tolerance {:.3g}",
                 s_.periodic()->max_turns, regime.change, s_.periodic()->tolerance));
    }
    // Contacts of the regime alone.
    if (regime.turns > 0 && !out_.rows.empty()) {
      out_.from = out_.rows.front().time;
      std::erase_if(out_.events, [&](const ContactEvent& e) { return e.end <= out_.from + same_; });
      out_.contacts.assign(s_.pins(), {});
      for (const ContactEvent& e : out_.events) out_.contacts[at(e.joint)].add(e, out_.from, out_.time);
    }
  }
  // false: there is no such motion, or pins part on it.
  bool shoot() {
    // Multipliers are known to some thousandths of what differences leave.
    planar::SimulationOptions options = continuous_options();
    options.relative_tolerance = std::min(options.relative_tolerance, 1e-10);
    options.absolute_tolerance = 0.01 * options.relative_tolerance;
    JointOrbit orbit =
        find_joint_orbit(s_.linkage, starts_, s_.drives, s_.from, s_.period, options, &context_);
    const bool found = orbit.status == Status::done;
    const bool interrupted = orbit.status == Status::cancelled || orbit.status == Status::deadline;
    if (interrupted) fail(orbit.status, orbit.message);
    const bool unstable = orbit.stability == OrbitStability::unstable;
    for (std::size_t k = 0; k < starts_.size(); ++k) {
      starts_[k].angle = orbit.start[k].angle;
      starts_[k].rate = orbit.start[k].rate;
    }
    out_.regime->orbit = std::move(orbit);
    if (interrupted) return true;
    if (!found || (unstable && s_.model == PinModel::automatic)) return false;
    set_times(1);
    simulate();
    if (s_.model == PinModel::automatic && !std::isnan(out_.switched)) return false;
    out_.regime->turns = 1;
    out_.regime->change = out_.regime->orbit->residual;
    return true;
  }

  // ---- start of continuous contact ----------------------------------------------------------------------

  // Direction in which the force of the ideal joint presses the pin at a time, first body's point to
  // second's.
  bool pressed_directions(double t, std::vector<double>& directions) {
    planar::LinkageMotion motion(s_.plan);
    std::vector<InputMotion> inputs;
    for (const planar::InputDrive& c : s_.drives) {
      InputMotion now{c.value, c.rate, 0};
      if (c.law) {
        const math::Motion m = math::MotionCurve(*c.law)(t);
        now = {m.value, m.rate, m.acceleration};
      }
      inputs.push_back(now);
    }
    planar::solve_motion(s_.plan, inputs, motion);
    if (motion.status != Status::done) return false;
    planar::solve_forces(s_.linkage, s_.plan, motion, t, first_of(inputs), forces_);
    if (forces_.status != Status::done) return false;
    directions.clear();
    for (const ContinuousPin& pin : s_.continuous)
      directions.push_back(math::angle_of(-forces_.joints[at(pin.clearance.joint)].force));
    return true;
  }
  std::vector<JointClearance> started() {
    std::vector<JointClearance> out;
    for (const ContinuousPin& pin : s_.continuous) out.push_back(pin.clearance);
    std::vector<double> now, before, after;
    if (!pressed_directions(s_.from, now)) return out;
    // The rate by differences: free joints have none that would be known.
    const double step = 1e-6 * (s_.periodic() ? s_.period : s_.to() - s_.from);
    const bool known = all_driven(s_) && pressed_directions(s_.from - step, before) &&
                       pressed_directions(s_.from + step, after);
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (!s_.continuous[k].angle_given) out[k].angle = now[k];
      if (!s_.continuous[k].rate_given)
        out[k].rate = known ? math::angle_difference(after[k], before[k]) / (2 * step) : 0;
    }
    return out;
  }

  // ---- the ideal linkage --------------------------------------------------------------------------------

  void add_ideal(double t, Status status, std::span<const InputMotion> inputs,
                 const planar::LinkageMotion& motion) {
    RecordedRow row{.time = t, .status = status, .inputs = {inputs.begin(), inputs.end()}};
    if (status == Status::done && s_.quantities.dynamic())
      planar::solve_forces(s_.linkage, s_.plan, motion, t, first_of(inputs), forces_);
    const planar::LinkageInstant instant{t, row.inputs, &motion, &forces_};
    for (const planar::LinkageColumn& c : out_.columns)
      row.values.push_back(status == Status::done ? c.value(instant) : nan);
    for (const planar::BodyPoint& p : s_.traces)  // places of the traced points, which are no columns
      places_.push_back(status == Status::done
                            ? number(planar::point_motion(s_.linkage, s_.plan, motion, p).position)
                            : std::complex<double>(nan, nan));
    out_.ideal.push_back(std::move(row));
  }
  void without_clearance() {
    std::vector<double> times;
    for (const RecordedRow& row : out_.rows) times.push_back(row.time);
    if (times.empty()) return;
    if (all_driven(s_)) {
      const auto curves = curves_of(s_);
      planar::LinkageMotion motion(s_.plan);
      for (const double t : times) {
        const std::vector<InputMotion> inputs = inputs_at(curves, t);
        planar::solve_motion(s_.plan, inputs, motion);
        add_ideal(t, motion.status, inputs, motion);
      }
    } else if (times.size() > 1) {
      planar::simulate(
          s_.linkage, s_.plan, s_.drives, times, {},
          [&](const planar::SimulationInstant& i) {
            add_ideal(i.time, i.status, i.inputs, *i.motion);
            return true;
          },
          &context_);
    }
  }
  // Paths as lines: finer than the rows where a law says what is between them.
  void paths() {
    out_.ideal_paths.resize(s_.traces.size());
    if (s_.traces.empty() || out_.ideal.empty()) return;
    if (!all_driven(s_)) {
      for (std::size_t i = 0; i < places_.size(); ++i)
        out_.ideal_paths[i % s_.traces.size()].push_back(places_[i]);
      return;
    }
    const auto curves = curves_of(s_);
    planar::LinkageMotion motion(s_.plan);
    // One period says all of the drives.
    const double reached = out_.rows.back().time;
    const double to = s_.period > 0 ? std::min(reached, s_.from + s_.period) : reached;
    constexpr int count = 4000;
    for (int i = 0; i <= count; ++i) {
      planar::solve_position(s_.plan, inputs_at(curves, s_.from + (to - s_.from) * i / count), motion);
      if (motion.status != Status::done) continue;
      for (std::size_t k = 0; k < s_.traces.size(); ++k)
        out_.ideal_paths[k].push_back(
            number(planar::point_motion(s_.linkage, s_.plan, motion, s_.traces[k]).position));
    }
  }

  const ClearanceStudy& s_;
  RunContext& context_;
  double same_ = 0;  // s
  ClearanceRecording out_;
  ClearanceRows rows_;
  std::vector<double> start_;         // values of the inputs
  std::vector<int> contact_numbers_;  // joints
  std::vector<JointClearance> starts_;
  ClearedLinkage cleared_;
  OpenLinkage open_;
  std::vector<double> times_;
  std::vector<bool> is_row_, is_section_;
  bool searching_ = false;  // for a section that repeats
  std::vector<std::complex<double>> places_;
  planar::LinkageForces forces_;
};

}  // namespace

ClearanceRecording record_clearance(const ClearanceStudy& study, RunContext& context) {
  return Recorder(study, context).run();
}

study::Result run_clearance_study(const ClearanceStudy& study, RunContext& context) {
  return report_clearance(study, record_clearance(study, context));
}

}  // namespace linkwright::clearance
