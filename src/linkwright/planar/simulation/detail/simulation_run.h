// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/sentence.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/smooth_branch.h"
#include "linkwright/planar/simulation/simulation.h"

namespace linkwright::planar {

/// One simulation from its start to its end. How it moves is in simulation.cpp; change points, friction and
/// what is said of its end have sources of their own.
class Simulation {
 public:
  Simulation(const Linkage& l, const LinkagePlan& plan, std::span<const InputDrive> drives,
             const SimulationOptions& options, const SimulationOutput& output, const SimulationWatch& watch);

  SimulationReport run(std::span<const double> times, const RunContext* context);

 private:
  static std::vector<bool> free_of(std::span<const InputDrive> drives) {
    std::vector<bool> free;
    for (const InputDrive& c : drives) free.push_back(!c.law);
    return free;
  }
  static std::size_t count_free(std::span<const InputDrive> drives) {
    return static_cast<std::size_t>(
        std::count_if(drives.begin(), drives.end(), [](const InputDrive& c) { return !c.law; }));
  }
  // Inertia at a single input; not used with many.
  double first_inertia() const { return dynamics_.inertia().empty() ? 0 : dynamics_.inertia()[0]; }
  bool stops_at_changes() const {
    return branch_ && branch_->has_change_points() && options_.at_change_point != AtChangePoint::smooth;
  }
  // Events of friction come after those of change points, and those of stops after them.
  std::size_t first_friction_event() const { return stops_at_changes() ? 2 : 0; }
  std::size_t first_stop_event() const { return first_friction_event() + 2 * rubbing_.size(); }
  // Events of stops are followed by the kinks of formulas, and these by what is watched.
  std::size_t first_kink_event() const { return first_stop_event() + contacts_.size(); }

  // ---- state: values and rates of the free inputs, work -------------------------------------------------

  std::vector<double> state() const;
  void put(double t, std::span<const double> y);
  // Work is held to the relative tolerance of what energies there are; without a measure it is left to the
  // steps that the motion needs.
  double work_tolerance() const;

  // ---- equations of motion ------------------------------------------------------------------------------

  struct Answer {
    Status status = Status::done;
    double power = 0, inertia = 0, friction_power = 0;
  };
  // Accelerations of the free inputs, in inputs_.
  Answer solve(double t);
  Answer interpolated(double t, double centre, double x);
  bool slope(double t, std::span<const double> y, std::span<double> rate);

  // ---- general groups: stay on the branch ---------------------------------------------------------------

  bool changed_side() const;
  void remember();
  // A search that went astray starts from the last good place again.
  void restore();

  // ---- start, steps, output -----------------------------------------------------------------------------

  bool start(double t);
  Sentence start_message(Status status, double time) const;
  // The motion where inputs_ say, accelerations included.
  const LinkageMotion& placed();
  double kinetic(double inertia) const;

  bool show(double t, std::span<const double> y);
  // Twists of the torsion springs for the audit of energies: their turns are counted by the speeds of the
  // bodies from step to step, not by the inputs that the torques go by.
  struct AuditedTwist {
    double twist, angle, rate;
  };
  std::vector<AuditedTwist> audited_twists(double t) const;
  double audited_potential(double t) const;
  // An instant for those who watch.
  const SimulationInstant& watched(double t, std::span<const double> y);
  // Exactly at a change point the parts behind it have no place of their own.
  double interpolated_potential();

  bool after_step(double t, std::span<const double> y);
  // Watches groups that come to their dead points: their sine falls to zero evenly in time. Steps are kept
  // from reaching beyond; near enough the motion ends.
  bool clear_of_limits(double t, double step);
  // True if the end of the branch that the input is nearer to is a limit of this group.
  bool ends_here(int group) const;
  const RangeEnd& nearer_end() const;

  // ---- change points ------------------------------------------------------------------------------------

  void neighbours(double value);
  // Change points between the ends of the last step, at the times of the cubic through them.
  void note_passages(double from, const InputMotion& before);
  void note_passage(ChangePassage passage);

  math::OdeAction act(double t, std::span<const std::size_t> which, std::span<double> y);

  // Velocities of the parts for a unit rate at a change point, with places and directions.
  std::vector<PartState<double>> unit_motion(double value);
  // Turns onto the other branch through a change point: the impact acts only against motion that the new
  // branch does not have, so the momentum along it stays. Returns the energy it costs; nothing when the
  // modes that keep their signs do not start at the present position.
  std::optional<double> kink(double value, double sense, double& rate);

  // ---- friction -----------------------------------------------------------------------------------------

  // The joints with friction: events are that one of them stops sliding, or that a sticking one is asked for
  // more than it can bear, and that a slide comes to lie on its other flank.
  struct Rubbing {
    int joint;
    bool slide;              // has two flanks
    double margin = 0;       // by which rounding exceeds what it can bear when it begins to stick
    double flank = 1;        // sign of the normal force of a slide
    double largest = 0;      // of its rates so far
    double stays = 1;        // last value of its event
    double stays_flank = 1;  // last value of the event of its flank
  };

  // Finds the joints with friction, and their states at the start.
  bool start_friction(double t);
  // Rates of joint `joint` for a unit rate of each free input, the others at rest.
  std::vector<double> shares_of(int joint);
  double rate_of(int joint) const;
  // Solves at the place of the inputs itself, also near change points.
  Status solve_here(double t);
  // Places the linkage at a state, with velocities, and with forces where they are asked for.
  bool place_at(double t, std::span<const double> y, bool forces);
  void friction_values(double t, std::span<const double> y, std::span<double> values);
  math::OdeAction friction_event(double t, std::span<const std::size_t> which, std::span<double> y);
  // States of the joints that stick and of those given by `stops`; reports what changes.
  bool decide(double t, const std::vector<bool>& stops);
  void note_friction(double t, int joint, FrictionChange change);
  // What is remembered of the states from here on.
  void keep_states(double t);
  // Sets the rates of sticking joints to zero, by the least change of the rates in y.
  void still(double t, std::span<double> y);
  // Sticking joints whose coordinate is a free input have exactly no acceleration.
  void still_inputs();
  bool any_sticks() const;
  // Friction that grows without bound before the place where it locks: time hardly passes any more.
  bool jams(double t);
  // True if friction locks a millionth of a radian, or of the linkage's size, further on.
  bool locks_ahead(double t);
  // True if something changes with time while the linkage is at rest.
  bool may_be_freed(double t) const;
  void end_rest(double t);
  // Joint forces of this instant, by the states of the joints.
  const LinkageForces* forces_with_friction(double t);

  // ---- stops --------------------------------------------------------------------------------------------

  // A stop: open, or closed while it has to push; one that gives way is closed while its joint touches it.
  struct Contact {
    bool closed = false;
    double stays = 1;        // last value of its event
    double largest = 0;      // of the rates of its gap so far
    double most_effort = 0;  // so far
    double mobility = 0;     // acceleration of its gap by a unit of its effort, without friction
  };
  bool rigid(std::size_t stop) const { return !l_.stops[stop].stiffness; }
  bool any_closed() const {  // of the rigid stops
    for (std::size_t k = 0; k < contacts_.size(); ++k)
      if (rigid(k) && contacts_[k].closed) return true;
    return false;
  }
  // LinkageDynamics::solve with the efforts that keep the closed stops closed.
  Status solve_pressed(double t);
  // Accelerations of the gaps of these stops under the present efforts.
  Status gap_accelerations(double t, std::span<const std::size_t> stops, std::vector<double>& out);
  // The same, and by what a unit of each of the efforts changes them, row by row.
  Status measure_stops(double t, std::span<const std::size_t> stops, std::vector<double>& accelerations,
                       std::vector<double>& matrix);
  // Stops that are met at the start; false, and the reason in the report, where one is passed.
  bool start_stops(double t, std::span<double> y);
  void stop_values(double t, std::span<const double> y, std::span<double> values);
  math::OdeAction stop_event(double t, std::span<const std::size_t> which, std::span<double> y);
  // Rates of the gaps of these stops at y; the kinetic energy as well.
  std::vector<double> gap_rates(double t, std::span<const std::size_t> stops, std::span<const double> y,
                                double& energy);
  // Rates after the impacts at these stops, by Newton's law with these restitutions. False where no free
  // joint moves one of them: a drive presses on it.
  bool impact(double t, std::span<const std::size_t> stops, std::span<const double> restitutions,
              std::span<double> y);
  // When the impacts at this stop that follow one with this rate of the gap after it come to their end (s);
  // infinity where they do not.
  double end_of_impacts(double t, std::size_t stop, double after, std::span<const double> y);
  // Decides which of these stops, whose gaps and rates are zero, are closed from here on.
  void close_stops(double t, std::span<const std::size_t> stops, std::span<double> y);
  // Joints that slide or stick after an impact; undecided, those at rest have no friction yet.
  void rub_after_impact(double t, std::span<double> y, bool decided);
  // Puts the joints of closed stops onto them, without a rate.
  void hold_on_stops(double t, std::span<double> y);
  void note_stop(StopEvent event);

  // ---- formulas -----------------------------------------------------------------------------------------

  void kink_values(double t, std::span<const double> y, std::span<double> values);
  math::OdeAction kink_event(double t, std::span<const double> y);
  // The branches of the formulas from here on, on which they stay up to the next event.
  void take_branches(double t, std::span<const double> y);
  std::vector<double> branches_at(double t, std::span<const double> y);

  // ---- end ----------------------------------------------------------------------------------------------

  void finish(const math::OdeReport& ode, std::span<const double> y);
  void limit(const Sentence& where);
  // The gas spring at whose stroke the motion ends; empty if there is none.
  Sentence end_of_stroke();
  Sentence stands() const;

  const Linkage& l_;
  const LinkagePlan& plan_;
  std::span<const InputDrive> drives_;
  const SimulationOptions& options_;
  const SimulationOutput& output_;
  const SimulationWatch& watch_;
  LinkageDynamics dynamics_;
  std::vector<InputMotion> inputs_;
  struct Law {
    std::size_t input;
    math::MotionCurve curve;
  };
  std::vector<Law> laws_;
  std::optional<SmoothBranch> branch_;
  bool friction_ = false;
  std::vector<double> last_sines_;
  std::vector<PartState<double>> good_parts_;
  std::size_t first_watched_ = 0;  // among the events
  std::vector<double> watched_;    // last values
  SimulationInstant instant_;
  std::vector<AuditedTwist> twists_;  // at the last step
  double twists_at_ = 0;              // s
  double start_kinetic_ = 0, start_potential_ = 0, kinks_ = 0;
  double last_time_ = 0;
  InputMotion last_;
  double horizon_ = infinity, limit_time_ = 0;
  double below_ = -infinity, above_ = infinity;
  double changed_at_ = 0;  // value of the input at the last change point
  bool at_limit_ = false, at_change_ = false;
  std::vector<Rubbing> rubbing_;  // joints with friction
  bool resting_ = false;          // sticking joints hold all free inputs
  bool stuck_ = false;            // for good
  double resting_since_ = 0;
  LinkageForces held_;
  std::vector<double> breaks_;
  double span_ = 1, window_ = 0;
  long steps_ = 0, quick_events_ = 0;
  double event_time_ = -infinity;
  int chattering_ = -1;            // joint
  bool jammed_ = false;            // friction locks
  std::vector<Contact> contacts_;  // one a stop
  double stopped_at_ = -infinity;  // last event of a stop, s
  int stops_at_once_ = 0;
  int pressed_ = -1;                    // stop on which a drive presses
  std::vector<double> kinks_of_loads_;  // last values, one a place at which a formula may jump or bend
  double kinked_at_ = -infinity;        // s
  int kinks_at_once_ = 0;
  Status last_status_ = Status::done;
  int failed_group_ = -1;
  SimulationReport report_;
};

}  // namespace linkwright::planar
