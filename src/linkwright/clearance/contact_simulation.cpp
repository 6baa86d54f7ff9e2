// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/contact_simulation.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "linkwright/clearance/step_pace.h"
#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/dynamics.h"

namespace linkwright::clearance {
namespace {

using planar::InputMotion;

// Largest value of a cubic through values and slopes at the ends of a step, if there is one inside.
std::optional<double> summit(double f0, double s0, double f1, double s1, double h) {
  if (!(s0 > 0 && s1 < 0)) return std::nullopt;
  const double d = (f1 - f0) / h, a = (s0 + s1 - 2 * d) / (h * h), b = (3 * d - 2 * s0 - s1) / h;
  // s0 + 2 b x + 3 a x^2 = 0, the zero where the slope falls.
  const double root = std::sqrt(std::max(b * b - 3 * a * s0, 0.0));
  const double x = s0 / (-b + root);
  return f0 + x * (s0 + x * (b + x * a));
}

class ContactMotion {
 public:
  ContactMotion(OpenLinkage& open, std::span<const ContactJoint> joints,
                std::span<const planar::InputDrive> drives, const ContactOptions& options,
                const ContactOutput& output)
      : open_(open),
        joints_(joints),
        options_(options),
        output_(output),
        original_(drives.size()),
        pins_(open, joints),
        inputs_(open.plan.inputs()),
        contact_(joints.size()),
        forces_(joints.size()) {
    std::vector<bool> free(inputs_.size(), true);
    for (std::size_t k = 0; k < drives.size(); ++k) {
      free[k] = !drives[k].law;
      if (drives[k].law)
        laws_.push_back({k, math::MotionCurve(*drives[k].law)});
      else
        inputs_[k] = {drives[k].value, drives[k].rate, 0};
    }
    dynamics_.emplace(open.linkage, open.plan, free);
  }

  ContactRun run(std::span<const double> times, const RunContext* context) {
    duration_ = times.back() - times.front();
    pace_ = StepPace(times.front(), times.back(), options_.max_steps);
    run_.totals.resize(joints_.size());
    if (!start(times.front())) return ended();
    std::vector<double> y = state();
    const std::vector<double> tolerances = absolute_tolerances();
    // Over the long steps of bdf errors of one sign add up where those of vibrations cancel.
    constexpr double bdf_share = 0.01;
    std::vector<double> bdf_tolerances = tolerances;
    for (double& tolerance : bdf_tolerances) tolerance *= bdf_share;
    std::vector<math::OdeEvent> events(joints_.size(), {.terminal = true});
    math::OdeWorkspace workspace;
    double t = times.front(), length = 0;
    std::size_t shown = 0;
    while (true) {
      const double longest = longest_step(t);
      for (std::size_t k = 0; k < joints_.size(); ++k)
        events[k].crossing = contact_[k].on ? math::OdeCrossing::falling : math::OdeCrossing::rising;
      stiff_ = stiffness() * longest > (stiff_ ? 1 : 5);
      math::OdeHooks hooks{.output_times = times.subspan(shown), .events = events, .context = context};
      // A row at an end of a stretch belongs to the next one, too.
      hooks.output = [&](double time, std::span<const double> s) { return ++shown, show(time, s); };
      hooks.step = [&](double time, std::span<const double> s) { return after_step(time, s, longest); };
      hooks.event_values = [&](double time, std::span<const double> s, std::span<double> values) {
        place(time, s);
        for (std::size_t k = 0; k < joints_.size(); ++k)
          values[k] = pins_[k].depth + (contact_[k].on ? noise_ : 0);
      };
      hooks.event = [&](double time, std::span<const std::size_t> which, std::span<double> s) {
        for (const std::size_t k : which) change(k, time, s);
        return math::OdeAction::go_on;
      };
      const math::OdeReport ode = math::integrate(
          [&](double time, std::span<const double> s, std::span<double> rate) {
            return slope(time, s, rate);
          },
          y, t, times.back(),
          {.method = stiff_ ? math::OdeMethod::bdf : options_.method,
           .relative_tolerance = std::max(options_.tolerance * (stiff_ ? bdf_share : 1), 1e-14),
           .absolute_tolerances = stiff_ ? bdf_tolerances : tolerances,
           .initial_step = std::min(length, std::min(longest, times.back() - t)),
           .max_step = longest,
           .max_steps = options_.max_steps - run_.steps},
          hooks, workspace);
      run_.steps += ode.steps;
      run_.evaluations += ode.evaluations;
      run_.time = t = ode.t;
      length = ode.end == math::OdeEnd::event ? 0 : std::abs(ode.last_step);
      if (ode.status != Status::done) {
        fail(ode);
        break;
      }
      if (hopeless_) {
        run_.status = Status::not_converged;
        run_.message = pace_.message(t);
        break;
      }
      if (ended_ || t >= times.back()) break;
      if (run_.steps >= options_.max_steps) {
        run_.status = Status::not_converged;
        use_up(t);
        break;
      }
      place(t, y);
      settle(t, y);
      remember(t);
    }
    return ended();
  }

 private:
  // ---- state: values and rates of the free inputs, work, dissipated energy ------------------------------

  std::vector<double> state() const {
    std::vector<double> y;
    for (const std::size_t k : dynamics_->free()) y.push_back(inputs_[k].value);
    for (const std::size_t k : dynamics_->free()) y.push_back(inputs_[k].rate);
    y.push_back(0);
    y.push_back(0);
    return y;
  }
  std::vector<double> absolute_tolerances() const {
    double clearance = infinity, energy = 1e-300;
    for (const ContactJoint& j : joints_) clearance = std::min(clearance, j.clearance);
    for (const planar::PartMass& m : open_.plan.masses)
      energy += m.mass * std::abs(open_.linkage.gravity) * open_.plan.size;
    energy = std::max(energy, start_kinetic_);
    std::vector<double> out;
    for (int derivative = 0; derivative < 2; ++derivative)
      for (const std::size_t k : dynamics_->free()) {
        const double way = options_.tolerance * clearance * (derivative == 0 ? 0.01 : 1);
        out.push_back(open_.plan.rotary[k] ? way / open_.plan.size : way);
      }
    // Energies get the accuracy that the steps of the motion give: they act back on nothing.
    for (int k = 0; k < 2; ++k) out.push_back(std::max(options_.tolerance * energy, 1e-15));
    return out;
  }
  void put(double t, std::span<const double> y) {
    const auto free = dynamics_->free();
    for (std::size_t i = 0; i < free.size(); ++i) inputs_[free[i]] = {y[i], y[free.size() + i], 0};
    for (const auto& [k, curve] : laws_) {
      const math::Motion m = curve(t);
      inputs_[k] = {m.value, m.rate, m.acceleration};
    }
  }
  // Places and velocities, and where the pins are in their bushes.
  Status place(double t, std::span<const double> y) {
    put(t, y);
    return place();
  }
  Status place() {
    planar::LinkageMotion& motion = dynamics_->motion;
    planar::solve_position(open_.plan, inputs_, motion);
    if (motion.status != Status::done) return motion.status;
    planar::solve_velocity(open_.plan, inputs_, motion);
    pins_.place(motion);
    return Status::done;
  }
  void press() {
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      forces_[k] = {};
      if (!contact_[k].on) continue;
      forces_[k].normal =
          normal_force(joints_[k].law, pins_[k].depth, pins_[k].depth_rate, contact_[k].event.approach);
      forces_[k].friction = friction_force(joints_[k].law, forces_[k].normal, pins_[k].slip);
    }
    pins_.press(forces_);
  }
  // Accelerations of the free inputs under the present forces, in inputs_.
  Status accelerate(double t) {
    last_status_ = dynamics_->solve(t, inputs_);
    return last_status_;
  }
  bool slope(double t, std::span<const double> y, std::span<double> rate) {
    last_status_ = place(t, y);
    if (last_status_ != Status::done) return false;
    // A pin in flight is not let out of sight: see simulate_contact.
    for (std::size_t k = 0; k < joints_.size(); ++k)
      if (!contact_[k].on && norm(pins_[k].eccentricity - contact_[k].seen) > joints_[k].clearance / 2)
        return false;
    press();
    if (accelerate(t) != Status::done) return false;
    const auto free = dynamics_->free();
    const std::size_t n = free.size();
    for (std::size_t i = 0; i < n; ++i)
      rate[i] = inputs_[free[i]].rate, rate[n + i] = inputs_[free[i]].acceleration;
    double taken = 0, lost = 0;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      const double sliding = forces_[k].friction * pins_[k].slip;
      taken += forces_[k].normal * pins_[k].depth_rate + sliding;
      if (contact_[k].on)
        lost += (forces_[k].normal - elastic_force(joints_[k].law, pins_[k].depth)) * pins_[k].depth_rate +
                sliding;
    }
    rate[2 * n] = dynamics_->power + taken;
    rate[2 * n + 1] = lost;
    return true;
  }

  // ---- contacts -----------------------------------------------------------------------------------------

  struct Contact {
    bool on = false;
    ContactEvent event;                                                     // the last one
    std::size_t number = 0;                                                 // its place in the list
    math::Vec2 seen{0, 0};                                                  // eccentricity at the last step
    double time = 0, depth = 0, depth_rate = 0, force = 0, force_rate = 0;  // then
    double mass = 0;                                                        // effective, along the normal
  };

  void begin(std::size_t k, double t, double approach) {
    Contact& c = contact_[k];
    c.on = true;
    c.event = {.joint = static_cast<int>(k),
               .start = t,
               .approach = approach,
               .angle = math::angle_of(pins_[k].eccentricity),
               .bush_angle = pins_.bush_angle(dynamics_->motion, k)};
    c.number = run_.events.size();
    // Its place in the order of the starts; what it was is known at its end.
    if (c.number < options_.max_events) run_.events.push_back(c.event);
  }
  void list(const Contact& c) {
    if (c.number < run_.events.size()) run_.events[c.number] = c.event;
    run_.totals[at(c.event.joint)].add(c.event, start_time_, run_.time);
  }
  // The run so far, with the contacts that still last at its end.
  ContactRun ended() {
    for (const Contact& c : contact_)
      if (c.on) list(c);
    return std::move(run_);
  }
  void change(std::size_t k, double t, std::span<const double> y) {
    place(t, y);
    if (contact_[k].on) {
      note(k, t);
      contact_[k].on = false;
      ContactEvent& e = contact_[k].event;
      e.end = t;
      e.separation = -pins_[k].depth_rate;
      list(contact_[k]);
    } else {
      begin(k, t, pins_[k].depth_rate);
    }
  }
  // A touch within rounding can begin or end without a crossing that shows. True when it does.
  bool slipped(std::size_t k) const {
    return contact_[k].on ? pins_[k].depth < -noise_ && pins_[k].depth_rate < 0
                          : pins_[k].depth > 0 && pins_[k].depth_rate > 0;
  }
  void settle(double t, std::span<const double> y) {
    for (std::size_t k = 0; k < joints_.size(); ++k)
      if (slipped(k)) change(k, t, y);
  }
  // The effective mass for a force between pin and bush along the normal.
  double effective_mass(std::size_t k, double t) {
    const auto with = [&](double force) {
      for (PinForce& f : forces_) f = {};
      forces_[k].normal = force;
      pins_.press(forces_);
      if (accelerate(t) != Status::done) return 0.0;
      planar::solve_acceleration(open_.plan, inputs_, dynamics_->motion);
      return dot(pins_.acceleration(dynamics_->motion, k), pins_[k].normal);
    };
    return 1 / std::max(with(0) - with(1), 1e-300);
  }
  // Largest depth and force since the last step; after place(). Forces as they are now.
  void note(std::size_t k, double t) {
    Contact& c = contact_[k];
    if (!c.on) return;
    press();
    if (accelerate(t) != Status::done) return;
    planar::solve_acceleration(open_.plan, inputs_, dynamics_->motion);
    const PinPlace& s = pins_[k];
    const ContactLaw& law = joints_[k].law;
    ContactEvent& e = c.event;
    const double approach = std::max(e.approach, min_approach), force = forces_[k].normal;
    const double stiff = s.depth > 0 ? law.exponent * elastic_force(law, s.depth) / s.depth : 0;
    const double force_rate =
        force > 0 ? stiff * s.depth_rate * (1 + damping_factor(law) * s.depth_rate / approach) +
                        elastic_force(law, s.depth) * damping_factor(law) *
                            pins_.depth_acceleration(dynamics_->motion, k) / approach
                  : 0;
    e.depth = std::max(e.depth, s.depth);
    e.force = std::max(e.force, force);
    if (t > c.time && c.time >= e.start) {
      const double h = t - c.time;
      if (const auto top = summit(c.depth, c.depth_rate, s.depth, s.depth_rate, h))
        e.depth = std::max(e.depth, *top);
      if (const auto top = summit(c.force, c.force_rate, force, force_rate, h))
        e.force = std::max(e.force, *top);
    }
    c.force = force;
    c.force_rate = force_rate;
  }
  // Notes the values with which the next step is compared; call after place().
  void remember(double t) {
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      note(k, t);
      Contact& c = contact_[k];
      c.seen = pins_[k].eccentricity;
      c.time = t;
      c.depth = pins_[k].depth;
      c.depth_rate = pins_[k].depth_rate;
      if (c.on && c.mass == 0) c.mass = effective_mass(k, t);
      if (!c.on) c.mass = 0;
    }
  }
  double longest_step(double t) {
    double longest = duration_ / 20;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      const Contact& c = contact_[k];
      if (c.on) {
        const ContactEvent& e = c.event;
        const double impact = contact_time(joints_[k].law, c.mass, e.approach);
        longest = std::min(longest, options_.contact_step * std::max(impact, t - e.start - impact));
      } else {
        const double pace = norm(pins_[k].rate);
        if (pace > 0) longest = std::min(longest, joints_[k].clearance / 4 / pace);
      }
    }
    return longest;
  }

  // Fastest rate (1/s) at which damping and friction of the contacts bring speeds to rest: beyond some per
  // step explicit formulas are unusable. Long contacts that begin slowly are so.
  double stiffness() const {
    double most = 0;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      const Contact& c = contact_[k];
      if (!c.on || !(c.mass > 0)) continue;
      const ContactLaw& law = joints_[k].law;
      const double approach = std::max(c.event.approach, min_approach);
      most = std::max(most, (elastic_force(law, c.depth) * damping_factor(law) / approach +
                             c.force * law.friction / (law.friction_whole - law.friction_from)) /
                                c.mass);
    }
    return most;
  }

  // ---- start, steps, rows -------------------------------------------------------------------------------

  /// The accelerations of a start whose pins are placed.
  bool begin_motion(double t) {
    if (run_.status == Status::done) {
      press();
      run_.status = accelerate(t);
    }
    if (run_.status != Status::done) {
      run_.message = "the start does not work: " + std::string(to_string(run_.status));
      return false;
    }
    planar::solve_acceleration(open_.plan, inputs_, dynamics_->motion);
    return true;
  }

  bool start(double t) {
    run_.time = start_time_ = t;
    noise_ = 2e-15 * open_.plan.size;
    for (std::size_t k = 0; k < inputs_.size(); ++k)
      if (k >= original_) inputs_[k] = {open_.start[k], 0, 0};
    for (const auto& [k, curve] : laws_) {
      const math::Motion m = curve(t);
      inputs_[k] = {m.value, m.rate, m.acceleration};
    }
    std::vector<PinGap> gaps;
    for (const ContactJoint& j : joints_) {
      const double sign = j.pin == PinSide::second ? 1 : -1;
      gaps.push_back({sign * j.start.eccentricity, sign * j.start.rate});
    }
    run_.status = place_pins(open_, gaps, inputs_, original_);
    if (run_.status == Status::done) run_.status = place();
    if (!begin_motion(t)) return false;
    start_kinetic_ = planar::kinetic_energy(open_.plan, dynamics_->motion);
    start_potential_ = planar::potential_energy(open_.linkage, open_.plan, dynamics_->motion);
    // Pins that press into their bushes are in contact; the others come into contact where the forces drive
    // them in.
    const double rounding = 10 * noise_;
    for (std::size_t k = 0; k < joints_.size(); ++k)
      if (pins_[k].depth > rounding) begin(k, t, std::max(pins_[k].depth_rate, 0.0));
    if (!begin_motion(t)) return false;
    std::vector<std::size_t> touching;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      const double pace = 1e-9 * (norm(pins_[k].rate) + std::abs(pins_[k].slip));
      if (!contact_[k].on && pins_[k].depth >= -rounding &&
          (pins_[k].depth_rate > pace ||
           (pins_[k].depth_rate >= -pace && pins_.depth_acceleration(dynamics_->motion, k) > 0)))
        touching.push_back(k);
    }
    for (const std::size_t k : touching) begin(k, t, std::max(pins_[k].depth_rate, 0.0));
    place();
    for (const ContactJoint& j : joints_)
      start_elastic_ += elastic_energy(j.law, pins_[at(index_of(j))].depth);
    remember(t);
    return true;
  }
  int index_of(const ContactJoint& j) const { return static_cast<int>(&j - joints_.data()); }

  bool after_step(double t, std::span<const double> y, double longest) {
    run_.time = t;
    if (options_.stop_when_hopeless && !pace_.step(t)) hopeless_ = true;
    if (hopeless_) return false;
    if (place(t, y) != Status::done) return true;
    remember(t);
    if (ended_) return false;
    for (std::size_t k = 0; k < joints_.size(); ++k)
      if (slipped(k)) return false;
    const double rate = stiffness() * longest;
    if (stiff_ ? rate < 1 : rate > 5) return false;
    // A new pace of the flight needs another length of the steps.
    const double wanted = longest_step(t);
    return wanted > longest / 2 && wanted < 4 * longest;
  }

  bool show(double t, std::span<const double> y) {
    if (place(t, y) != Status::done) return true;
    press();
    if (accelerate(t) != Status::done) return true;
    planar::solve_acceleration(open_.plan, inputs_, dynamics_->motion);
    rows_.clear();
    ContactRow row{.time = t, .inputs = inputs_, .motion = &dynamics_->motion};
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      rows_.push_back({number(pins_[k].eccentricity), number(pins_[k].rate), pins_[k].depth,
                       forces_[k].normal, forces_[k].friction, contact_[k].on});
      if (contact_[k].on) row.elastic += elastic_energy(joints_[k].law, pins_[k].depth);
    }
    row.joints = rows_;
    row.kinetic = planar::kinetic_energy(open_.plan, dynamics_->motion);
    row.potential = planar::potential_energy(open_.linkage, open_.plan, dynamics_->motion);
    const std::size_t n = dynamics_->free().size();
    row.work = y[2 * n];
    row.dissipated = y[2 * n + 1];
    row.drift = (row.kinetic - start_kinetic_) + (row.potential - start_potential_) +
                (row.elastic - start_elastic_) + row.dissipated - row.work;
    run_.largest_drift = std::max(run_.largest_drift, std::abs(row.drift));
    run_.peak_energy = std::max({run_.peak_energy, row.kinetic, row.elastic, std::abs(row.dissipated),
                                 std::abs(row.work), std::abs(row.potential - start_potential_)});
    run_.time = t;
    if (output_ && !output_(row)) ended_ = true;
    return !ended_;
  }
  void fail(const math::OdeReport& ode) {
    run_.status =
        ode.status == Status::limit_reached && last_status_ != Status::done ? last_status_ : ode.status;
    run_.message = fmt::format("ended at {:.6g} s: {}", ode.t, ode.message);
    // The integration counts its last stretch alone.
    if (ode.end == math::OdeEnd::steps) use_up(ode.t);
  }
  void use_up(double t) { run_.message = fmt::format("ended at {:.6g} s: {} steps used up", t, run_.steps); }

  OpenLinkage& open_;
  std::span<const ContactJoint> joints_;
  const ContactOptions& options_;
  const ContactOutput& output_;
  std::size_t original_;
  ContactPins pins_;
  std::vector<InputMotion> inputs_;
  std::vector<std::pair<std::size_t, math::MotionCurve>> laws_;
  std::optional<planar::LinkageDynamics> dynamics_;
  std::vector<Contact> contact_;
  std::vector<PinForce> forces_;
  std::vector<ContactState> rows_;
  double start_time_ = 0, duration_ = 0;  // s
  double start_kinetic_ = 0, start_potential_ = 0, start_elastic_ = 0;
  double noise_ = 0;  // m, rounding of the depth: a contact ends that much behind zero
  Status last_status_ = Status::done;
  bool ended_ = false, stiff_ = false, hopeless_ = false;
  StepPace pace_{0, 1, 1};
  ContactRun run_;
};

}  // namespace

void ContactTotals::add(const ContactEvent& event, double from, double to) {
  ++contacts;
  touching += (std::isnan(event.end) ? to : event.end) - std::max(event.start, from);
  approach = std::max(approach, event.approach);
  depth = std::max(depth, event.depth);
  force = std::max(force, event.force);
  if (!std::isnan(event.end)) shortest = std::min(shortest, event.end - event.start);
}

ContactRun simulate_contact(const planar::Linkage& linkage, std::span<const ContactJoint> joints,
                            std::span<const planar::InputDrive> drives, std::span<const double> times,
                            const ContactOptions& options, const ContactOutput& output,
                            const RunContext* context) {
  LINKWRIGHT_REQUIRE(drives.size() == linkage.driven.size(), "the linkage has {} inputs, got {}",
                     linkage.driven.size(), drives.size());
  LINKWRIGHT_REQUIRE(times.size() >= 2 && times.front() < times.back(), "no interval of time: {} times",
                     times.size());
  LINKWRIGHT_REQUIRE(!joints.empty(), "no joint with clearance among {}", linkage.joints.size());
  LINKWRIGHT_REQUIRE(options.tolerance > 0 && options.contact_step > 0, "tolerance {}, step in contact {}",
                     options.tolerance, options.contact_step);
  std::vector<int> numbers;
  for (const ContactJoint& j : joints) {
    LINKWRIGHT_REQUIRE(j.clearance > 0 && j.bush_radius > j.clearance,
                       "clearance {} m in a bush of {} m: must be positive and less than the radius",
                       j.clearance, j.bush_radius);
    LINKWRIGHT_REQUIRE(
        std::abs(j.start.eccentricity) < 1.5 * j.clearance && std::isfinite(std::abs(j.start.rate)),
        "pin {} m off the middle of its bush, clearance {} m", std::abs(j.start.eccentricity), j.clearance);
    require_valid(j.law);
    numbers.push_back(j.joint);
  }
  std::vector<double> values;
  for (const planar::InputDrive& c : drives)
    values.push_back(c.law ? math::MotionCurve(*c.law)(times.front()).value : c.value);
  OpenLinkage open = open_linkage(linkage, numbers, values);
  if (open.status != Status::done) return {.status = open.status, .message = open.message};
  return ContactMotion(open, joints, drives, options, output).run(times, context);
}

}  // namespace linkwright::clearance
