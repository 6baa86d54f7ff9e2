#include <algorithm>
#include <cmath>
#include <numbers>

#include "linkwright/clearance/clearance_study.h"
#include "linkwright/math/angles.h"

namespace linkwright::clearance {
namespace {

using planar::InputMotion, planar::Vec;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::vector<math::MotionCurve> curves_of(const ClearanceStudy& s) {
  std::vector<math::MotionCurve> out;
  for (const planar::InputCourse& c : s.courses)
    if (c.law) out.emplace_back(*c.law);
  return out;
}
bool all_driven(const ClearanceStudy& s) {
  return std::all_of(s.courses.begin(), s.courses.end(), [](const auto& c) { return c.law.has_value(); });
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
Vec<double> place_of(const planar::Linkage& l, const planar::LinkagePlan& plan,
                     const planar::LinkageMotion& motion, const planar::BodyPoint& p) {
  return planar::point_motion(plan, motion, p.body, l.bodies[at(p.body)].points[at(p.point)].at).position;
}

class Recorder {
 public:
  Recorder(const ClearanceStudy& s, RunContext& context) : s_(s), context_(context) {
    out_.period = even_period();
    std::vector<double> rows, sections;
    for (int i = 0; i < s.samples; ++i)
      rows.push_back(i + 1 == s.samples ? s.to : s.from + (s.to - s.from) * i / (s.samples - 1));
    for (int k = 0; out_.period > 0 && s.from + k * out_.period <= s.to; ++k)
      sections.push_back(s.from + k * out_.period);
    // Both in one run; a section within rounding of a row is that row.
    same_ = 1e-12 * std::max({std::abs(s.from), std::abs(s.to), s.to - s.from});
    for (std::size_t i = 0, k = 0; i < rows.size() || k < sections.size();) {
      const double row = i < rows.size() ? rows[i] : std::numeric_limits<double>::infinity();
      const double section = k < sections.size() ? sections[k] : std::numeric_limits<double>::infinity();
      times_.push_back(std::abs(row - section) <= same_ ? row : std::min(row, section));
      is_row_.push_back(row <= times_.back());
      is_section_.push_back(section <= times_.back() + same_);
      i += is_row_.back();
      k += is_section_.back();
    }
  }

  ClearanceRecording run() {
    out_.columns = planar::linkage_columns(s_.linkage, s_.plan, s_.quantities, s_.traces);
    // A free joint has no drive whose force would be of interest.
    std::erase_if(out_.columns, [&](const planar::LinkageColumn& c) {
      for (std::size_t k = 0; k < s_.courses.size(); ++k)
        if (!s_.courses[k].law &&
            c.key.starts_with(planar::identifier(planar::input_joint(s_.linkage, k).name) + "_drive_"))
          return true;
      return false;
    });
    if (s_.contacts.empty())
      with_continuous_contact();
    else
      with_contacts();
    without_clearance();
    paths();
    return std::move(out_);
  }

 private:
  // Time of a turn of the only drive if it turns evenly.
  double even_period() const {
    if (s_.courses.size() != 1 || !s_.courses[0].law || !s_.plan.rotary[0]) return 0;
    const auto* even = std::get_if<math::ConstantSpeed>(&*s_.courses[0].law);
    return even && even->rate != 0 ? 2 * std::numbers::pi / std::abs(even->rate) : 0;
  }

  // ---- columns of a linkage whose joints are others
  // -----------------------------------------------------------

  // Keeps the columns that the moving linkage has, too, and finds them there. What its own inputs drive are
  // columns of the other.
  void choose_columns(const planar::Linkage& l, const planar::LinkagePlan& plan) {
    const std::vector<planar::LinkageColumn> own = planar::linkage_columns(l, plan, s_.quantities, s_.traces);
    std::vector<planar::LinkageColumn> kept;
    for (const planar::LinkageColumn& c : out_.columns) {
      std::function<double(const planar::LinkageInstant&, const RecordedRow&)> value;
      for (std::size_t k = 0; k < s_.pins(); ++k) {
        const std::string key = planar::identifier(s_.linkage.joints[at(s_.joint_of(k))].name);
        if (c.key == key + "_x_N")
          value = [k](const planar::LinkageInstant&, const RecordedRow& r) { return r.pins[k].force.x; };
        else if (c.key == key + "_y_N")
          value = [k](const planar::LinkageInstant&, const RecordedRow& r) { return r.pins[k].force.y; };
        else if (c.key == key + "_N")
          value = [k](const planar::LinkageInstant&, const RecordedRow& r) { return norm(r.pins[k].force); };
      }
      for (std::size_t k = s_.courses.size(); !value && k < plan.inputs(); ++k)
        if (planar::input_key(l, plan, k) == c.key)
          value = [k](const planar::LinkageInstant& i, const RecordedRow&) { return i.inputs[k].value; };
      if (!value) {
        const auto found =
            std::find_if(own.begin(), own.end(), [&](const auto& o) { return o.key == c.key; });
        if (found == own.end()) continue;
        value = [v = found->value](const planar::LinkageInstant& i, const RecordedRow&) { return v(i); };
      }
      kept.push_back(c);
      values_.push_back(std::move(value));
    }
    out_.columns = std::move(kept);
  }

  // Completes a row: values and what the drawing needs. `joints` maps those of the linkage to those of the
  // moving one, -1 = a pin with clearance.
  void finish(RecordedRow row, const planar::LinkagePlan& plan, std::span<const InputMotion> inputs,
              const planar::LinkageMotion& motion, const std::vector<int>& joints) {
    const planar::LinkageInstant instant{row.time, {inputs.begin(), inputs.end()}, &motion, &forces_};
    for (const auto& value : values_)
      row.values.push_back(row.status == Status::done ? value(instant, row) : nan);
    row.inputs.assign(inputs.begin(), inputs.begin() + static_cast<std::ptrdiff_t>(s_.courses.size()));
    row.record.status = row.status;
    row.record.input = row.time;
    for (int b = 0; b < static_cast<int>(s_.linkage.bodies.size()); ++b)
      row.record.bodies.push_back(planar::body_state(plan, motion, b));
    if (forces_.status == Status::done && !forces_.joints.empty()) {
      for (std::size_t j = 0; j < joints.size(); ++j)
        row.record.joints.push_back(joints[j] < 0 ? planar::JointReaction() : forces_.joints[at(joints[j])]);
      for (std::size_t k = 0; k < s_.pins(); ++k)
        row.record.joints[at(s_.joint_of(k))].force = row.pins[k].force;
      row.record.drives.assign(forces_.drives.begin(),
                               forces_.drives.begin() + static_cast<std::ptrdiff_t>(s_.courses.size()));
    }
    // Rows that have no position are left out.
    const auto found = std::lower_bound(times_.begin(), times_.end(), row.time - same_);
    const auto now = static_cast<std::size_t>(std::min(found, times_.end() - 1) - times_.begin());
    if (is_section_[now]) out_.sections.push_back(row);
    if (is_row_[now]) out_.rows.push_back(std::move(row));
  }

  // ---- contact
  // ------------------------------------------------------------------------------------------------

  void with_contacts() {
    std::vector<int> taken;
    for (const ContactJoint& c : s_.contacts) taken.push_back(c.joint);
    std::vector<double> values;
    for (const planar::InputCourse& c : s_.courses)
      values.push_back(c.law ? math::MotionCurve(*c.law)(s_.from).value : c.value);
    // The same linkage as that of the simulation, to which the forces of the contacts are added here, too.
    OpenLinkage open = open_linkage(s_.linkage, taken, values);
    if (open.status != Status::done) {
      out_.status = open.status;
      out_.message = open.message;
      return;
    }
    choose_columns(open.linkage, open.plan);
    std::vector<int> joints;
    for (const planar::LinkageJoint& j : s_.linkage.joints)
      joints.push_back(planar::joint_index(open.linkage, j.name));
    for (const int j : taken) joints[at(j)] = -1;
    planar::Linkage pressed = open.linkage;
    for (const OpenLinkage::Pin& pin : open.pins)
      for (const planar::BodyPoint& side : {pin.first, pin.second}) {
        planar::LinkageBody& body = pressed.bodies[at(side.body)];
        pressed.forces.emplace_back();
        pressed.forces.back().point = {side.body, static_cast<int>(body.points.size())};
        body.points.push_back({"contact of " + pin.name, {0, 0}});
      }
    const std::size_t first_force = s_.linkage.forces.size();
    ContactOptions options{.tolerance = s_.relative_tolerance, .max_steps = s_.max_steps};
    const ContactRun run = simulate_contact(
        s_.linkage, s_.contacts, s_.courses, times_, options,
        [&](const ContactRow& c) {
          RecordedRow row{.time = c.time,
                          .kinetic = c.kinetic,
                          .potential = c.potential,
                          .elastic = c.elastic,
                          .dissipated = c.dissipated,
                          .work = c.work,
                          .drift = c.drift};
          for (std::size_t k = 0; k < c.joints.size(); ++k) {
            const ContactState& state = c.joints[k];
            const OpenLinkage::Pin& pin = open.pins[k];
            const bool pin_first = s_.contacts[k].pin == PinSide::first;
            const Vec<double> e = planar::vec(state.eccentricity);
            const Vec<double> n = norm(e) > 0 ? (1 / norm(e)) * e : Vec<double>{1, 0};
            const Vec<double> on_pin = -state.normal * n - state.friction * left(n);
            const Vec<double> where =
                place_of(open.linkage, open.plan, *c.motion, pin_first ? pin.first : pin.second) +
                (s_.contacts[k].bush_radius - s_.contacts[k].clearance) * n;
            const Vec<double> on_second = pin_first ? -on_pin : on_pin;
            for (std::size_t side = 0; side < 2; ++side) {
              planar::PointForce& force = pressed.forces[first_force + 2 * k + side];
              force.force = number(side == 0 ? -on_second : on_second);
              const planar::PartState<double> frame =
                  planar::body_state(open.plan, *c.motion, force.point.body);
              pressed.bodies[at(force.point.body)].points[at(force.point.point)].at =
                  number(unturn(frame.direction, where - frame.origin));
            }
            row.pins.push_back({.eccentricity = state.eccentricity,
                                .rate = state.rate,
                                .depth = state.depth,
                                .normal = state.normal,
                                .friction = state.friction,
                                .contact = state.contact,
                                .force = on_second});
          }
          if (s_.quantities.dynamic())
            planar::solve_forces(pressed, open.plan, *c.motion, c.time, c.inputs[0].value, forces_);
          finish(std::move(row), open.plan, c.inputs, *c.motion, joints);
          return true;
        },
        &context_);
    out_.status = run.status;
    out_.message = run.message;
    out_.time = run.time;
    out_.largest_drift = run.largest_drift;
    out_.peak_energy = run.peak_energy;
    out_.steps = run.steps;
    out_.evaluations = run.evaluations;
    out_.events = run.events;
  }

  // ---- continuous contact
  // -------------------------------------------------------------------------------------

  // Direction in which the force of the ideal joint presses the pin at a time, first body's point to
  // second's.
  bool pressed_directions(double t, std::vector<double>& directions) {
    planar::LinkageMotion motion(s_.plan);
    std::vector<InputMotion> inputs;
    for (const planar::InputCourse& c : s_.courses) {
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
      directions.push_back(planar::angle_of(-forces_.joints[at(pin.clearance.joint)].force));
    return true;
  }
  std::vector<JointClearance> started() {
    std::vector<JointClearance> out;
    for (const ContinuousPin& pin : s_.continuous) out.push_back(pin.clearance);
    std::vector<double> now, before, after;
    if (!pressed_directions(s_.from, now)) return out;
    // The rate by differences: free joints have none that would be known.
    const double step = 1e-6 * (s_.to - s_.from);
    const bool known = all_driven(s_) && pressed_directions(s_.from - step, before) &&
                       pressed_directions(s_.from + step, after);
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (!s_.continuous[k].angle_given) out[k].angle = now[k];
      if (!s_.continuous[k].rate_given)
        out[k].rate = known ? math::angle_difference(after[k], before[k]) / (2 * step) : 0;
    }
    return out;
  }

  void with_continuous_contact() {
    const std::vector<JointClearance> clearances = started();
    std::vector<double> values;
    for (const planar::InputCourse& c : s_.courses)
      values.push_back(c.law ? math::MotionCurve(*c.law)(s_.from).value : c.value);
    const ClearedLinkage cleared = with_clearance(s_.linkage, clearances, values);
    if (cleared.status != Status::done) {
      out_.status = cleared.status;
      out_.message = cleared.message;
      return;
    }
    choose_columns(cleared.linkage, cleared.plan);
    std::vector<int> joints;
    for (std::size_t j = 0; j < s_.linkage.joints.size(); ++j) joints.push_back(static_cast<int>(j));
    const planar::SimulationOptions options{.relative_tolerance = s_.relative_tolerance,
                                            .absolute_tolerance = 0.1 * s_.relative_tolerance,
                                            .max_steps = s_.max_steps};
    const JointClearanceRun run = simulate_joint_clearance(
        s_.linkage, clearances, s_.courses, times_, options,
        [&](const JointClearanceRow& c) {
          const planar::SimulationInstant& i = c.instant;
          RecordedRow row{.time = i.time,
                          .status = i.status,
                          .kinetic = i.kinetic,
                          .potential = i.potential,
                          .work = i.work,
                          .drift = i.drift};
          planar::solve_forces(cleared.linkage, cleared.plan, *i.motion, i.time, i.inputs[0].value, forces_);
          for (std::size_t k = 0; k < c.joints.size(); ++k) {
            const ClearanceState& state = c.joints[k];
            const double r = clearances[k].clearance;
            // From the bush, which the second body has, to the pin.
            const std::complex<double> e = -std::polar(r, state.angle);
            // The pin of the bar at its carrier has the number of the joint.
            const bool by_first =
                cleared.bars[k].carrier == s_.linkage.joints[at(clearances[k].joint)].first.body;
            const Vec<double> f = forces_.joints[at(clearances[k].joint)].force;
            row.pins.push_back({.eccentricity = e,
                                .rate = std::complex<double>(0, state.rate) * e,
                                .normal = state.tension,
                                .contact = state.tension > 0,
                                .angle = state.angle,
                                .angle_rate = state.rate,
                                .angle_acceleration = state.acceleration,
                                .force = by_first ? f : -f});
          }
          finish(std::move(row), cleared.plan, i.inputs, *i.motion, joints);
          return true;
        },
        &context_);
    out_.status = run.status;
    out_.message = run.message;
    out_.time = run.simulation.time;
    out_.largest_drift = run.simulation.largest_drift;
    out_.peak_energy = run.simulation.peak_energy;
    out_.steps = run.simulation.steps;
    out_.evaluations = run.simulation.evaluations;
    out_.validity = run.joints;
  }

  // ---- the ideal linkage
  // --------------------------------------------------------------------------------------

  void add_ideal(double t, Status status, std::span<const InputMotion> inputs,
                 const planar::LinkageMotion& motion) {
    RecordedRow row{.time = t, .status = status, .inputs = {inputs.begin(), inputs.end()}};
    if (status == Status::done && s_.quantities.dynamic())
      planar::solve_forces(s_.linkage, s_.plan, motion, t, first_of(inputs), forces_);
    const planar::LinkageInstant instant{t, row.inputs, &motion, &forces_};
    for (const planar::LinkageColumn& c : out_.columns)
      row.values.push_back(status == Status::done ? c.value(instant) : nan);
    for (const planar::BodyPoint& p : s_.traces)  // where they are, beside the columns
      places_.push_back(status == Status::done ? number(place_of(s_.linkage, s_.plan, motion, p))
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
          s_.linkage, s_.plan, s_.courses, times, {},
          [&](const planar::SimulationInstant& i) {
            add_ideal(i.time, i.status, i.inputs, *i.motion);
            return true;
          },
          &context_);
    }
  }
  // Paths as lines: finer than the rows where a law tells what is between them.
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
    // One turn says all of an even drive.
    const double reached = out_.rows.back().time;
    const double to = out_.period > 0 ? std::min(reached, s_.from + out_.period) : reached;
    constexpr int count = 4000;
    for (int i = 0; i <= count; ++i) {
      planar::solve_position(s_.plan, inputs_at(curves, s_.from + (to - s_.from) * i / count), motion);
      if (motion.status != Status::done) continue;
      for (std::size_t k = 0; k < s_.traces.size(); ++k)
        out_.ideal_paths[k].push_back(number(place_of(s_.linkage, s_.plan, motion, s_.traces[k])));
    }
  }

  const ClearanceStudy& s_;
  RunContext& context_;
  std::vector<double> times_;
  std::vector<bool> is_row_, is_section_;
  double same_ = 0;  // s
  std::vector<std::function<double(const planar::LinkageInstant&, const RecordedRow&)>> values_;
  std::vector<std::complex<double>> places_;
  planar::LinkageForces forces_;
  ClearanceRecording out_;
};

}  // namespace

ClearanceRecording record_clearance(const ClearanceStudy& study, RunContext& context) {
  return Recorder(study, context).run();
}

study::Result run_clearance_study(const ClearanceStudy& study, RunContext& context) {
  return report_clearance(study, record_clearance(study, context));
}

}  // namespace linkwright::clearance
