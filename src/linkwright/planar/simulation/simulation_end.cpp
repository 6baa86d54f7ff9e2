// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/stop.h"
#include "linkwright/planar/linkage/strut.h"
#include "linkwright/planar/simulation/detail/simulation_run.h"

// The end of a simulation, and the words for it.
namespace linkwright::planar {
namespace {

constexpr std::string_view jams_text = "it jams, for no finite joint forces go with motion in this sense";

Sentence place(const Linkage& l, const LinkagePlan& plan, std::size_t input, double value) {
  return say("{} at {}", l.joints[at(l.driven[input])].name,
             plan.rotary[input] ? degrees_of(value).fixed(4).spelled() : millimetres(value, 5));
}

Sentence stop_place(const Linkage& l, std::size_t stop) {
  const JointStop& s = l.stops[stop];
  return l.joints[at(s.joint)].type == JointType::revolute ? degrees_of(s.limit).fixed(4).spelled()
                                                           : millimetres(s.limit, 6);
}

}  // namespace

bool Simulation::start_stops(double t, std::span<double> y) {
  put(t, y);
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  solve_position(plan_, inputs_, dynamics_.motion);
  solve_velocity(plan_, inputs_, dynamics_.motion);
  if (const int passed = passed_stop(l_, plan_, dynamics_.motion, 1e-7); passed >= 0) {
    report_.status = Status::limit_reached;
    report_.message = say("the start does not work: '{}' is beyond its stop at {}",
                          l_.joints[at(l_.stops[at(passed)].joint)].name, stop_place(l_, at(passed)));
    return false;
  }
  std::vector<std::size_t> met;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    const StopMotion now = stop_motion(l_, plan_, dynamics_.motion, k);
    const bool pin = l_.joints[at(l_.stops[k].joint)].type == JointType::revolute;
    if (now.gap > 1e-9 * (pin ? 1 : plan_.size)) continue;
    if (rigid(k))
      met.push_back(k);
    else
      contacts_[k].closed = -*l_.stops[k].stiffness * now.gap - l_.stops[k].damping * now.rate > 0;
  }
  if (met.empty()) return true;
  if (stop_event(t, met, y) != math::OdeAction::stop) return true;
  finish({.t = t}, y);
  return false;
}

Sentence Simulation::start_message(Status status, double time) const {
  if (dynamics_.motion.failed_group >= 0)
    return "the start does not work: " + assembly_gap_text(plan_, dynamics_.motion, 0, inputs_[0].value);
  if (const LoadWithoutValue load = load_without_value(l_, plan_, dynamics_.motion, time))
    return "the start does not work: " + without_value_text(load);
  if (status == Status::singular)
    return "a free joint moves no mass, so its motion does not follow from the forces";
  if (status == Status::self_locking)
    return say("friction locks the linkage at the start, with {}: {}", stands(), jams_text);
  if (status == Status::not_converged) return "the joint forces of the start do not settle";
  return "the start does not work";
}

void Simulation::finish(const math::OdeReport& ode, std::span<const double> y) {
  report_.steps = ode.steps;
  report_.evaluations = ode.evaluations;
  report_.time = ode.t;
  put(ode.t, y);
  const Sentence where = say("{} with {}", seconds(at_limit_ ? limit_time_ : ode.t, 6), stands());
  if (resting_ && !stuck_) end_rest(ode.t);
  if (pressed_ >= 0) {
    const std::size_t stop = at(pressed_);
    const LinkageJoint& joint = l_.joints[at(l_.stops[stop].joint)];
    report_.status = Status::limit_reached;
    report_.message =
        say("the drives press '{}' on its stop at {}, after {}: end the motion there, or leave "
            "the joint free",
            joint.name, stop_place(l_, stop), seconds(ode.t, 6));
  } else if (stuck_) {
    report_.status = Status::at_rest;
    // Where no joint bears anything, there is nothing to be held.
    const std::vector<double>& shares = dynamics_.states->shares;
    const bool bears = std::any_of(shares.begin(), shares.end(), [](double share) { return share > 1e-9; });
    report_.message =
        bears ? say("friction holds the linkage at rest from {} on", where)
              : say("the linkage is at rest from {} on, and nothing acts that would move it", where);
  } else if (jammed_) {
    report_.status = Status::self_locking;
    report_.message = say("friction locks the linkage at {}: {}", where, jams_text);
  } else if (chattering_ >= 0) {
    report_.status = Status::not_converged;
    report_.message =
        say("the motion cannot be followed beyond {}: joint '{}' changes between rest and motion while no "
            "time passes",
            where, l_.joints[at(chattering_)].name);
  } else if (at_change_) {
    report_.status = Status::limit_reached;
    report_.message =
        say("the motion stops at {}: '{}' is at a change point, where it {}", where,
            plan_.groups[at(report_.group)].name,
            options_.at_change_point == AtChangePoint::stop
                ? "can continue in either assembly mode"
                : "cannot continue with the sign of its mode: that branch does not meet this one");
  } else if (at_limit_) {
    limit(where);
  } else if (ode.status == Status::limit_reached || ode.status == Status::infeasible) {
    report_.group = failed_group_;
    const bool kept = last_status_ == Status::not_converged || last_status_ == Status::self_locking;
    report_.status = kept ? last_status_ : Status::limit_reached;
    if (last_status_ == Status::self_locking)
      report_.message = say("friction locks the linkage at {}: {}", where, jams_text);
    else if (report_.group >= 0)
      limit(where);
    else if (const Sentence stroke = end_of_stroke(); !stroke.empty())
      report_.message = say("the motion ends at {}: {}", where, stroke);
    else
      report_.message = say("the motion cannot be followed beyond {}", where);
  } else if (ode.status != Status::done) {
    report_.status = ode.status;
    report_.message = say("ended at {}: {}", seconds(ode.t, 6), ode.message);
  }
}

Sentence Simulation::end_of_stroke() {
  if (const LoadWithoutValue& load = dynamics_.without_value; load && !(load.strut && load.strut->gas))
    return say("the formula of {} '{}' has no value from there on",
               load.strut   ? "strut"
               : load.force ? "force"
                            : "torque",
               load.strut   ? load.strut->name
               : load.force ? load.force->name
                            : load.torque->name);
  constexpr double near = 1e-3;  // of the stroke: the last step ends before its end
  solve_position(plan_, inputs_, dynamics_.motion);
  if (dynamics_.motion.status != Status::done) return {};
  for (const Strut& s : l_.struts) {
    if (!s.gas) continue;
    const double length = span_of(l_, plan_, dynamics_.motion, s.first, s.second).length,
                 left = s.gas->extended_length - length, slack = near * s.gas->stroke;
    if (left < slack) return say("gas spring '{}' is extended", s.name);
    if (left > s.gas->stroke - slack) return say("gas spring '{}' is at the end of its stroke", s.name);
  }
  return {};
}

void Simulation::limit(const Sentence& where) {
  report_.status = Status::limit_reached;
  report_.message =
      say("'{}' reaches its dead point at {}: the joint turns back there while the linkage continues in the "
          "other "
          "assembly mode",
          plan_.groups[at(report_.group)].name, where);
  if (at_limit_) report_.time = limit_time_;
}

Sentence Simulation::stands() const {
  Sentence out;
  for (const std::size_t k : dynamics_.free()) {
    double value = inputs_[k].value;
    if (at_limit_ && branch_) value = nearer_end().value;
    if (at_change_) value = changed_at_;
    out += (out.empty() ? "" : ", ") + place(l_, plan_, k, value);
  }
  return out;
}

}  // namespace linkwright::planar
