// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/belt_run.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/linkage/screw.h"
#include "linkwright/planar/linkage/smooth_branch.h"
#include "linkwright/planar/linkage/strut.h"
#include "linkwright/planar/studies/linkage_cams.h"
#include "linkwright/planar/studies/linkage_drives.h"
#include "linkwright/planar/studies/linkage_holding.h"
#include "linkwright/planar/studies/linkage_path.h"
#include "linkwright/planar/studies/linkage_rows.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

// Below it a dyad is said to transmit force badly: reactions grow like the reciprocal of its sine.
constexpr double poor_transmission = 5 * pi / 180;
constexpr double work_rounding = 1e-12;  // share of the absolute work

// Rows without an answer, by why they have none and by the group that stops there.
class Failures {
 public:
  struct One {
    Status status = Status::done;
    int group = -1;
    long rows = 0;
    std::size_t first = 0;
    double gap = 0;  // m, largest
  };
  void add(Status status, const LinkageMotion& motion, std::size_t row) {
    if (status == Status::done) return;
    const int group =
        status == Status::no_assembly || status == Status::singular ? std::max(motion.failed_group, -1) : -1;
    auto one = std::find_if(all_.begin(), all_.end(),
                            [&](const One& f) { return f.status == status && f.group == group; });
    if (one == all_.end()) one = all_.insert(all_.end(), {.status = status, .group = group, .first = row});
    ++one->rows;
    if (status == Status::no_assembly) one->gap = std::max(one->gap, motion.gap);
  }
  // In the order in which they are reported.
  std::vector<One> sorted() const {
    std::vector<One> out;
    for (const Status s : {Status::singular, Status::no_assembly, Status::other_circuit,
                           Status::limit_reached, Status::self_locking, Status::not_converged})
      std::copy_if(all_.begin(), all_.end(), std::back_inserter(out),
                   [&](const One& f) { return f.status == s; });
    return out;
  }

 private:
  std::vector<One> all_;
};

class Runner {
 public:
  Runner(const LinkageStudy& s, RunContext& context)
      : s_(s),
        context_(context),
        columns_(columns_of(s)),
        rows_(rows_of(s)),
        solver_(s, rows_),
        limits_(solver_.limits),
        branch_(solver_.branch) {}

  study::Result run() {
    modes_ = solver_.motion.modes;
    evaluate();
    finish_table();
    if (runs_against_the_sweep()) std::reverse(recorded_.begin(), recorded_.end());
    result_.scenes.push_back(
        linkage_scene(s_.linkage, s_.plan, recorded_, s_.traces, scene_input_key(), scene_input_label()));
    if (s_.quantities.dynamic()) add_mass_centres(result_.scenes[0], s_.linkage, s_.plan, recorded_);
    if (limits_) add_limits(s_, *limits_, result_);
    if (s_.plan.inputs() == 1 && !over_time()) add_quality(s_, branch_, result_);
    plots();
    facts();
    add_cams(s_, result_);
    if (s_.holding) add_holding_facts(s_, result_);
    add_drives(s_, history_, result_);
    warnings();
    headline();
    if (s_.path) add_path(s_, rows_, result_);
    return std::move(result_);
  }

 private:
  bool over_time() const { return planar::over_time(s_); }
  // The scene shows the rows along the last axis of a grid, with the other inputs at their first value.
  std::size_t shown_rows() const {
    if (over_time()) return rows_.inputs.size();
    return at(std::get<InputGrid>(s_.sweep).inputs.back().samples);
  }
  // The scene is played in the order of its rows: as the drive runs, whatever the order of the sweep.
  bool runs_against_the_sweep() const {
    if (over_time() || scene_axis() >= s_.drives.size()) return false;
    const InputSamples& axis = std::get<InputGrid>(s_.sweep).inputs[scene_axis()];
    return s_.drives[scene_axis()].rate * (axis.to - axis.from) < 0;
  }
  std::size_t scene_axis() const { return s_.plan.inputs() - 1; }
  std::string scene_input_key() const {
    return over_time() ? "time_s" : input_key(s_.linkage, s_.plan, scene_axis());
  }
  std::string scene_input_label() const {
    return over_time() ? "time"
                       : input_joint(s_.linkage, scene_axis()).name +
                             (s_.plan.rotary[scene_axis()] ? " angle" : " displacement");
  }
  Sentence where(std::size_t row) const {
    if (over_time()) return at_place("time", seconds(rows_.time[row]));
    Sentence out;
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k)
      out += (k ? ", " : "") + Sentence(input_place(s_.linkage, s_.plan, k, rows_.inputs[row][k].value, 6));
    return out;
  }

  void evaluate() {
    const LinkageMotion& motion = solver_.motion;
    const LinkageForces& forces = solver_.forces;
    const bool dynamic = s_.quantities.dynamic();
    values_.assign(columns_.size(), {});
    for (auto& v : values_) v.reserve(rows_.inputs.size());
    for (std::size_t r = 0; r < rows_.inputs.size(); ++r) {
      const Status status = solver_.solve(r);
      const LinkageInstant& now = solver_.now;
      passed_.push_back(solver_.passed);
      for (std::size_t c = 0; c < columns_.size(); ++c) values_[c].push_back(value_of(columns_[c], now));
      statuses_.push_back(status);
      if (r < shown_rows())
        recorded_.push_back(record(dynamic, over_time() ? now.time : now.inputs[scene_axis()].value));
      collect(r, motion, forces, dynamic && status == Status::done);
      if (status == Status::done) history_.add(s_, now, dynamic, solver_.motion);
      if (r % 256 == 255 && context_.interrupted()) {
        interruption_ = context_.interruption();
        break;
      }
    }
  }

  LinkageRecord record(bool dynamic, double input) {
    return solver_.motion.status == Status::no_assembly
               ? open_record_of(s_.linkage, s_.plan, solver_.now.inputs, solver_.motion, input)
               : record_of(s_.linkage, s_.plan, solver_.motion, dynamic ? &solver_.forces : nullptr, input);
  }

  void collect(std::size_t r, const LinkageMotion& motion, const LinkageForces& forces, bool dynamic) {
    if (motion.status == Status::no_assembly && nearest_.least(motion.gap, r))
      nearest_group_ = motion.failed_group;
    if (!passed_.back()) failures_.add(statuses_.back(), motion, r);
    if (motion.status != Status::done || passed_.back()) return;
    if (!without_value_ && statuses_.back() == Status::limit_reached)
      without_value_ = load_without_value(s_.linkage, s_.plan, motion, solver_.now.time);
    closure_.largest(motion.closure_residual, r);
    for (std::size_t g = 0; g < s_.plan.groups.size(); ++g) {
      const GroupTraits traits = traits_of(s_.plan.groups[g]);
      if (!traits.closes_loop || !traits.closed_form) continue;
      if (transmission_.least(std::asin(std::min(1.0, std::abs(motion.groups[g].sine))), r)) weakest_ = g;
    }
    for (std::size_t j = 0; j < s_.linkage.joints.size(); ++j)
      if (s_.linkage.joints[j].type == JointType::rack) {
        racks_.resize(s_.linkage.joints.size());
        racks_[j].largest(off_pitch_line(s_.linkage, s_.plan, motion, static_cast<int>(j)), r);
      }
    if (!dynamic) return;
    strands_.resize(forces.strands.size());
    for (std::size_t k = 0; k < strands_.size(); ++k) strands_[k].least(forces.strands[k].tangential, r);
    drives_.resize(s_.plan.inputs());
    for (std::size_t k = 0; k < drives_.size(); ++k) drives_[k].largest(forces.drives[k], r);
    joints_.resize(forces.joints.size());
    for (std::size_t j = 0; j < joints_.size(); ++j) joints_[j].largest(norm(forces.joints[j].force), r);
    shaking_.largest(norm(forces.shaking_force), r);
    power_.largest(std::max({std::abs(forces.drive_power), std::abs(forces.kinetic_power),
                             std::abs(forces.weight_power), std::abs(forces.load_power)}),
                   r);
    balance_.largest(forces.drive_power + forces.weight_power + forces.load_power - forces.kinetic_power, r);
  }

  void finish_table() {
    Table table{.name = "sweep"};
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      unwrap(columns_[c], values_[c]);
      table.add(columns_[c].key, columns_[c].label, std::move(values_[c]));
    }
    for (Status s : statuses_) table.status.emplace_back(to_string(s));
    auto bad = statuses_.begin();
    while (bad != statuses_.end() &&
           (*bad == Status::done || passed_[static_cast<std::size_t>(bad - statuses_.begin())]))
      ++bad;
    result_.status = interruption_ != Status::done ? interruption_
                     : bad != statuses_.end()      ? *bad
                                                   : Status::done;
    result_.tables.push_back(std::move(table));
    if (s_.redundant) self_stress_table();
  }

  // What play or an error of make can add to the joint forces: forces that balance each other, in the
  // drawing.
  void self_stress_table() {
    Table table{.name = "self_stress"};
    const auto& stresses = s_.redundant->stresses;
    std::vector<std::size_t> joints;
    for (std::size_t j = 0; j < s_.linkage.joints.size(); ++j)
      if (std::any_of(stresses.begin(), stresses.end(), [&](const std::vector<JointReaction>& s) {
            return norm(s[j].force) > 1e-9 || std::abs(s[j].moment) > 1e-9 * s_.plan.size;
          }))
        joints.push_back(j);
    for (const std::size_t j : joints) table.names.push_back(s_.linkage.joints[j].name);
    for (std::size_t k = 0; k < stresses.size(); ++k) {
      const std::string key = fmt::format("stress_{}_", k + 1), words = fmt::format("self-stress {} ", k + 1);
      const auto add = [&](const char* part, Dimension dimension, const auto& of) {
        std::vector<double> values;
        for (const std::size_t j : joints) values.push_back(of(stresses[k][j]));
        table.add({key + part, words + part, dimension}, std::move(values));
      };
      add("x", Dimension::none, [](const JointReaction& r) { return r.force.x; });
      add("y", Dimension::none, [](const JointReaction& r) { return r.force.y; });
      add("lever", Dimension::length, [](const JointReaction& r) { return r.moment; });
    }
    result_.tables.push_back(std::move(table));
  }

  std::vector<std::string> columns_ending(std::string_view ending, std::size_t most) const {
    std::vector<std::string> out;
    for (const LinkageColumn& c : columns_)
      if (c.key.ends_with(ending) && out.size() < most) out.push_back(c.key);
    return out;
  }
  void plots() {
    const bool linked = over_time() || s_.plan.inputs() == 1;
    const study::AddPlot add{
        result_, {.table = "sweep", .x = scene_input_key(), .scene = linked ? "motion" : std::string()}};
    const auto plot = [&](std::string name, std::string title, std::vector<std::string> y,
                          study::Plot::Style style = study::Plot::Style::line) {
      add(std::move(name), std::move(title), std::move(y), linked ? style : study::Plot::Style::points);
    };
    const LinkageQuantities& q = s_.quantities;
    if (q.drive) {
      plot("torque", "Drive torque", columns_ending("_drive_torque_N_m", 6));
      plot("drive-force", "Drive force", columns_ending("_drive_force_N", 6));
      plot("drive-power", "Power of each drive", columns_ending("_drive_power_W", 6));
    }
    if (q.reactions) {
      std::vector<std::string> sizes;
      for (const LinkageJoint& j : s_.linkage.joints)
        if (!has_teeth(j.type)) sizes.push_back(identifier(j.name) + "_N");
      plot("reactions", "Joint forces", sizes);
    }
    if (q.reactions) plot("contact-force", "Contact forces of the cams", columns_ending("_contact_N", 6));
    if (q.shaking) {
      plot("shaking-force", "Shaking force", {"shaking_force_x_N", "shaking_force_y_N", "shaking_force_N"});
      plot("shaking-moment", "Shaking moment about " + moment_centre_name(s_.linkage),
           {"shaking_moment_N_m", "shaking_moment_with_drive_N_m"});
      if (linked)
        plot("shaking-polar", "Shaking force, polar", {"shaking_force_x_N", "shaking_force_y_N"},
             study::Plot::Style::polar);
    }
    if (q.reactions && linked) {
      std::vector<std::string> pairs;
      for (const LinkageJoint& j : s_.linkage.joints)
        if (!has_teeth(j.type)) {
          pairs.push_back(identifier(j.name) + "_x_N");
          pairs.push_back(identifier(j.name) + "_y_N");
        }
      plot("reactions-polar", "Joint forces, polar", pairs, study::Plot::Style::polar);
    }
    if (q.transmission_angle)
      plot("transmission", "Transmission angles", columns_ending("_transmission_angle_rad", 8));
    if (q.position) {
      std::vector<std::string> angles, ways = columns_ending("_displacement_m", 8);
      for (const LinkageColumn& c : columns_)
        if (c.angle && angles.size() < 8) angles.push_back(c.key);
      plot("angles", "Angles of the bodies", angles);
      if (s_.plan.inputs() == 1 && !s_.plan.rotary[0] && !ways.empty()) ways.erase(ways.begin());
      plot("displacements", "Displacements of the slides", ways);
      std::vector<std::string> paths;
      for (const BodyPoint& t : s_.traces) {
        const LinkageBody& b = s_.linkage.bodies[at(t.body)];
        const std::string key = identifier(b.name) + "_" + identifier(b.points[at(t.point)].name);
        paths.push_back(key + "_x_m");
        paths.push_back(key + "_y_m");
      }
      if (linked) plot("paths", "Paths of the traced points", paths, study::Plot::Style::polar);
    }
    if (q.rates) {
      std::vector<std::string> speeds, accelerations;
      for (const LinkageBody& b : s_.linkage.bodies)
        if (&b != &s_.linkage.bodies[0] && speeds.size() < 8) {
          speeds.push_back(identifier(b.name) + "_speed_rad_per_s");
          accelerations.push_back(identifier(b.name) + "_acceleration_rad_per_s2");
        }
      plot("drive-speeds", "Speeds of the drives that turn", columns_ending("_drive_speed_rad_per_s", 6));
      plot("drive-slides", "Speeds of the drives that slide", columns_ending("_drive_speed_m_per_s", 6));
      plot("speeds", "Angular speeds", speeds);
      plot("accelerations", "Angular accelerations", accelerations);
    }
    if (q.power)
      plot("power", "Power", {"drive_power_W", "weight_power_W", "load_power_W", "kinetic_power_W"});
  }

  // The joint with the largest force; past the end when there is none.
  std::size_t strongest() const {
    std::size_t most = joints_.size();
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (joints_[j].any() && (most == joints_.size() || joints_[j].value > joints_[most].value)) most = j;
    return most;
  }

  void facts() {
    using Verdict = study::Fact::Verdict;
    const study::AddFact fact{result_.facts};
    if (s_.four_bar) {
      const FourBarClass c = classify(s_.four_bar->linkage);
      fact("type", c.circuits == 0
                       ? "cannot be assembled: one link is longer than the others together"
                       : fmt::format("{}, {}", in_words(c.type), name_of(s_.four_bar->linkage.branch)));
    }
    fact("degrees of freedom", say("{}, {} driven", mobility(s_.linkage), s_.plan.inputs()));
    if (s_.redundant)
      fact("redundant constraints",
           say("{}: {} equations of rank {}", s_.redundant->equations - s_.redundant->rank,
               s_.redundant->equations, s_.redundant->rank));
    if (s_.redundant && s_.quantities.reactions)
      fact("redundant joint forces", s_.redundant->rule == RedundantForces::compliance
                                         ? "by the compliance of bars and joints"
                                         : "by least squares");
    std::string order;
    for (const Group& g : s_.plan.groups)
      order += fmt::format("{}{} ({}{})", order.empty() ? "" : " → ", g.name, traits_of(g).name,
                           traits_of(g).has_modes ? g.mode > 0 ? ", plus" : ", minus" : "");
    fact("solved in this order", order);
    if (limits_) {
      fact("range of the input", assembly_range_text(*limits_, modes_)).number =
          study::angle_or_length(assembly_range(*limits_, modes_), limits_->rotary, 6);
      if (s_.plan.closed_form()) fact("circuits", say("{} over all assembly modes", limits_->circuits));
    }
    std::string general;
    for (const Group& g : s_.plan.groups)
      if (!traits_of(g).closed_form) general += (general.empty() ? "" : ", ") + g.name;
    if (!general.empty() && s_.quantities.transmission_angle)
      fact("transmission angle", fmt::format("not given of {}: only a dyad has one", general));
    for (std::size_t k = 0; k < drives_.size(); ++k)
      if (s_.quantities.drive && drives_[k].any())
        fact(fmt::format("largest drive {} at {}", s_.plan.rotary[k] ? "torque" : "force",
                         input_joint(s_.linkage, k).name),
             say("{} at {}", study::torque_or_force(drives_[k].value, s_.plan.rotary[k], 5),
                 where(drives_[k].row)));
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k)
      if (const auto& screw = input_joint(s_.linkage, k).screw; screw && screw->friction > 0) {
        const ScrewThread thread = thread_of(*screw);
        fact(fmt::format("efficiency of {}", input_joint(s_.linkage, k).name),
             say("{} against the load; margin of self-locking {}{}", plain_number(thread.efficiency, 4),
                 plain_number(thread.margin, 4),
                 thread.margin > 1 ? "" : ": the load turns the spindle back"));
      }
    for (const Belt& belt : s_.linkage.belts)
      if (!statuses_.empty() && statuses_[0] == Status::done) fact_of_belt(belt, fact);
    facts_of_turn(fact);
    if (s_.quantities.dynamic()) report_assumed_masses(s_.linkage, result_);
    if (s_.quantities.reactions && strongest() < joints_.size())
      fact("largest joint force", say("{} at {}, {}", newtons(joints_[strongest()].value, 5),
                                      s_.linkage.joints[strongest()].name, where(joints_[strongest()].row)));
    if (s_.quantities.shaking && shaking_.any())
      fact("largest shaking force", say("{} at {}", newtons(shaking_.value, 5), where(shaking_.row)));
    if (transmission_.any())
      fact("minimum transmission angle",
           say("{} of {} at {}", degrees_of(transmission_.value).fixed(1), s_.plan.groups[weakest_].name,
               where(transmission_.row)),
           transmission_.value < poor_transmission ? Verdict::bad : Verdict::plain);
    if (closure_.any()) fact("closure residual", metres(closure_.value, 2));
    if (s_.quantities.dynamic() && power_.any() && power_.value > 0)
      fact("power balance",
           say("within {} of the largest power", plain_number(std::abs(balance_.value / power_.value), 2)));
  }

  // The length of a belt and its wraps in the first position.
  void fact_of_belt(const Belt& belt, const study::AddFact& fact) const {
    std::vector<std::complex<double>> centres;
    std::vector<double> radii;
    for (const BeltWheel& wheel : belt.wheels) {
      const PartState<double>& body = recorded_.front().bodies[at(wheel.centre.body)];
      centres.push_back(number(point_on(body, math::vec(place_of(s_.linkage, wheel.centre)))));
      radii.push_back(wheel.side * wheel.radius);
    }
    const BeltRun run = belt_run(centres, radii, belt.closed);
    Sentence wraps;
    for (std::size_t i = 0; i < belt.wheels.size(); ++i)
      if (belt.wheels[i].radius > 0)
        wraps +=
            (wraps.empty() ? "" : ", ") +
            say("{} {}", s_.linkage.bodies[at(belt.wheels[i].centre.body)].name, degrees_of(run.wraps[i], 5));
    fact(fmt::format("length of {}", belt.name),
         say("{}, wraps {}", s_.units.measured(run.length, Dimension::length), wraps));
    const bool spread = belt.closed && belt.carrier >= 0 && !belt.tension;
    if (s_.quantities.reactions && spread)
      fact(fmt::format("tension of {}", belt.name),
           "not given: strands have its differences about a mean of 0");
  }

  // The least tension of each belt; a rope cannot push, nor can a belt.
  void slack_strands(const study::AddWarning& warn) const {
    for (std::size_t k = 0; k < strands_.size(); ++k) {
      const PlanStrand& strand = s_.plan.strands[k];
      const Belt& belt = s_.linkage.belts[at(strand.belt)];
      if (!strands_[k].any() || !(strands_[k].value < 0) || (strand.preloaded && !belt.tension)) continue;
      const Sentence what =
          say("strand {}-{} of '{}' becomes slack at {}", s_.linkage.bodies[at(strand.first)].name,
              s_.linkage.bodies[at(strand.second)].name, belt.name, where(strands_[k].row));
      if (strand.preloaded)
        warn(say("{}: it needs a tension of {}, and has {}", what,
                 newtons(*belt.tension - strands_[k].value, 5), newtons(*belt.tension, 5)),
             "raise tension_N");
      else
        warn(say("{}: it would have to push with {}", what, newtons(-strands_[k].value, 5)),
             "load it so that it pulls, or use a link");
    }
  }
  // Facts of one drive over whole turns of its joint: mean square of the torque, and its work, which is 0 at
  // constant speed without friction and losses.
  void facts_of_turn(const study::AddFact& fact) const {
    if (!s_.quantities.drive || over_time() || s_.plan.inputs() != 1 || !s_.plan.rotary[0]) return;
    const InputSamples& axis = std::get<InputGrid>(s_.sweep).inputs[0];
    const double turns = (axis.to - axis.from) / full_turn;
    const Column* torque =
        result_.tables[0].find(identifier(input_joint(s_.linkage, 0).name) + "_drive_torque_N_m");
    if (!torque || std::abs(turns) < 0.5 || std::abs(turns - std::round(turns)) > 1e-9 ||
        result_.status != Status::done)
      return;
    const double step = (axis.to - axis.from) / (axis.samples - 1);
    double squares = 0, work = 0, moved = 0;
    for (std::size_t i = 1; i < torque->values.size(); ++i) {
      const double a = torque->values[i - 1], b = torque->values[i];
      if (std::isnan(a) || std::isnan(b)) return;
      squares += b * b;
      work += (a + b) / 2 * step;
      moved += (std::abs(a) + std::abs(b)) / 2 * std::abs(step);
    }
    const double rms = std::sqrt(squares / static_cast<double>(torque->values.size() - 1));
    fact("drive torque, root mean square", newton_metres(rms, 5));
    if (s_.drives[0].acceleration == 0)
      fact("net work of the drive per revolution",
           say("{} ({} absolute)", measured("J", std::abs(work) < work_rounding * moved ? 0 : work, 2),
               measured("J", moved)));
  }

  void warnings() {
    const study::AddWarning warn{result_.diagnostics};
    for (std::size_t j = 0; j < racks_.size(); ++j)
      if (racks_[j].any() && std::abs(racks_[j].value) > 1e-9 * s_.plan.size)
        warn(say("the centre of the pinion of '{}' leaves its distance from the pitch line by {}, the most "
                 "at {}",
                 s_.linkage.joints[j].name, s_.units.measured(std::abs(racks_[j].value), Dimension::length),
                 where(racks_[j].row)),
             "guide the rack parallel to its direction");
    slack_strands(warn);
    if (s_.quantities.reactions && !s_.plan.torque_gears.empty())
      warn(fmt::format("joint forces leave out the forces of the teeth of {}",
                       fmt::join(s_.plan.torque_gears, ", of ")),
           "give each wheel one pin on the carrier, at the centres of the wheels");
    for (const int j : s_.plan.redundant_gears)
      warn(fmt::format(
               "gear '{}' repeats what the other gears say; its force is not determined without stiffness",
               s_.linkage.joints[at(j)].name),
           "joint forces leave it out: the other gears carry all of the load");
    // Change points have messages of their own.
    for (const Failures::One& f : failures_.sorted()) {
      const Status s = f.status;
      const std::string group = f.group >= 0 ? s_.plan.groups[at(f.group)].name : std::string();
      const Sentence place =
          say("{} of {} positions, the first at {}", f.rows, statuses_.size(), where(f.first));
      if (s == Status::singular && group.empty())
        warn(
            say("{} are at a singular place of the path: speeds and forces are not determined there", place));
      else if (s == Status::singular)
        warn(say("{} are at a dead point of {}: speeds and forces are not determined there", place, group));
      else if (s == Status::no_assembly)
        warn(f.gap > 0 ? say("{} do not assemble: {} cannot close, the gap is up to {}", place, group,
                             s_.units.measured(f.gap, Dimension::length))
                       : say("{} do not assemble", place),
             assembled_ranges());
      else if (s == Status::other_circuit)
        warn(say("{} are on another circuit: the linkage does not come there from {} without being taken "
                 "apart",
                 place, s_.plan.drawn_inputs.empty() ? "the first position" : "the drawn position"),
             "sweep.range = \"assembled\" sweeps what it comes to; sweep.circuits = \"all\" counts these "
             "positions as well");
      else if (s == Status::self_locking)
        warn(
            say("{} lock by friction: no force of the drive, however large, keeps the linkage moving", place),
            "less friction, or a position farther from the dead point, frees it");
      else if (s == Status::limit_reached && without_value_)
        warn(say("{} have no forces: {}", place, without_value_text(without_value_)),
             without_value_.strut && without_value_.strut->gas
                 ? "end the sweep there, or take a longer gas spring"
                 : "end the sweep there, or change the formula");
      else
        warn(say("{} have no answer ({})", place, to_string(s)),
             s == Status::limit_reached ? "a limit of the motion lies before them" : "");
    }
    change_points(warn);
    if (s_.quantities.dynamic() && s_.plan.inputs() > 0) {
      const auto [low, high] =
          std::minmax_element(rows_.inputs.begin(), rows_.inputs.end(),
                              [](const auto& a, const auto& b) { return a[0].value < b[0].value; });
      warn_of_held_loads(s_.linkage, s_.plan, (*low)[0].value, (*high)[0].value, warn);
    }
    if (transmission_.any() && transmission_.value < poor_transmission)
      warn(say("the transmission angle of {} falls to {} at {}: near a dead point forces grow without bound",
               s_.plan.groups[weakest_].name, degrees_of(transmission_.value).fixed(2),
               where(transmission_.row)));
  }
  // The ranges in which the linkage assembles: exactly for one input in closed form, else nothing.
  Sentence assembled_ranges() const {
    return limits_ ? "it " + assembly_range_text(*limits_, modes_) + ends_of_ranges() : Sentence();
  }
  // Says which group stops the motion at which end, if several could.
  Sentence ends_of_ranges() const {
    const auto loops = std::count_if(s_.plan.groups.begin(), s_.plan.groups.end(),
                                     [](const Group& g) { return traits_of(g).closes_loop; });
    if (loops < 2) return {};
    Sentence out;
    for (const InputRange& r : limits_->ranges) {
      if (!std::equal(modes_.begin(), modes_.end(), r.modes.begin(), r.modes.end()) || r.full_turn) continue;
      for (const RangeEnd* end : {&r.from, &r.to}) {
        if (end->kind != EndKind::limit) continue;
        std::string groups;
        for (const int g : end->groups) groups += (groups.empty() ? "" : ", ") + s_.plan.groups[at(g)].name;
        const double value = limits_->rotary ? math::wrap_angle(end->value) : end->value;
        out += say("{}at {} by {}", out.empty() ? "; stopped " : ", ",
                   study::angle_or_length(value, limits_->rotary, 4), groups);
      }
    }
    return out;
  }
  // True if the rows reach that input, of an angle in any of its turns.
  bool passes(double value) const {
    const InputSamples& axis = std::get<InputGrid>(s_.sweep).inputs[0];
    const double low = std::min(axis.from, axis.to) - 1e-6, high = std::max(axis.from, axis.to) + 1e-6;
    if (!limits_->rotary) return low <= value && value <= high;
    return value + full_turn * std::ceil((low - value) / full_turn) <= high;
  }
  // Positions where the branch is a choice.
  void change_points(const study::AddWarning& warn) const {
    if (!branch_) return;
    for (std::size_t r = 0; r < statuses_.size(); ++r)
      if (passed_[r] && statuses_[r] == Status::singular) {
        warn(s_.at_change_point == AtChangePoint::keep_sign
                 ? say("at {} the motion has a kink: the row holds the position alone", where(r))
                 : say("at {} the joint forces grow without bound: the row holds what stays finite",
                       where(r)));
        break;
      }
    std::vector<double> reported;
    for (const RangeEnd& end : branch_->change_points) {
      const double value = limits_->rotary ? math::wrap_angle(end.value) : end.value;
      if (!passes(value)) continue;
      if (std::any_of(reported.begin(), reported.end(), [&](double t) { return std::abs(t - value) < 1e-6; }))
        continue;
      reported.push_back(value);
      std::string groups;
      for (int g : end.groups) groups += (groups.empty() ? "" : ", ") + s_.plan.groups[at(g)].name;
      warn(say("change point at {}: the assembly modes of {} coincide there, and the linkage can continue in "
               "either",
               study::angle_or_length(value, limits_->rotary, 6), groups),
           s_.at_change_point == AtChangePoint::smooth
               ? "the rows continue smoothly; sweep.at_change_point = \"keep_sign\" takes the other branch"
           : s_.at_change_point == AtChangePoint::keep_sign
               ? "the rows take the branch with a kink; sweep.at_change_point = \"smooth\" is the other"
               : "the rows end there");
    }
  }

  // The range of a sweep over all inputs for which the linkage assembles; empty for others.
  Sentence range_in_words() const {
    const InputGrid* grid = std::get_if<InputGrid>(&s_.sweep);
    if (!grid || !grid->assembled) return {};
    const std::string& joint = grid->inputs[0].joint;
    if (grid->assembled->full_turn) return say("{} rotates fully", joint);
    const auto end = [&](const RangeEnd& e) { return study::angle_or_length(e.value, s_.plan.rotary[0], 4); };
    return say("{} moves from {} to {}, where the linkage assembles", joint, end(grid->assembled->from),
               end(grid->assembled->to));
  }

  void headline() {
    const auto good = std::count(statuses_.begin(), statuses_.end(), Status::done);
    if (good == 0) {
      const bool open =
          std::all_of(statuses_.begin(), statuses_.end(), [](Status s) { return s == Status::no_assembly; });
      result_.headline =
          open && nearest_group_ >= 0 && nearest_.any() && nearest_.value > 0
              ? say("The linkage assembles nowhere in the sweep: {} cannot close, a gap of {} is left at {}.",
                    s_.plan.groups[at(nearest_group_)].name,
                    s_.units.measured(nearest_.value, Dimension::length), where(nearest_.row))
              : "No position of the sweep has an answer: the linkage does not assemble or is at "
                "dead points.";
      return;
    }
    Sentence text;
    if (s_.quantities.drive && !drives_.empty() && drives_[0].any())
      text = say("The drive {} reaches {} at {}", s_.plan.rotary[0] ? "torque" : "force",
                 study::torque_or_force(drives_[0].value, s_.plan.rotary[0], 5), where(drives_[0].row));
    if (s_.quantities.reactions && strongest() < joints_.size())
      text += say("{} {} at joint {}", text.empty() ? "The joint forces reach" : " and the joint forces",
                  newtons(joints_[strongest()].value, 5), s_.linkage.joints[strongest()].name);
    if (text.empty()) text = range_in_words();
    if (text.empty()) text = say("{} of {} positions computed", good, statuses_.size());
    result_.headline = text + ".";
    if (good != static_cast<std::ptrdiff_t>(statuses_.size()) && s_.quantities.dynamic())
      result_.headline += say(" {} of {} positions have no answer.",
                              static_cast<std::ptrdiff_t>(statuses_.size()) - good, statuses_.size());
  }

  const LinkageStudy& s_;
  RunContext& context_;
  std::vector<LinkageColumn> columns_;
  LinkageRows rows_;
  RowSolver solver_;
  const std::optional<InputLimits>& limits_;
  const std::optional<BranchPath>& branch_;
  std::vector<std::vector<double>> values_;
  std::vector<Status> statuses_;
  std::vector<bool> passed_;  // rows at change points that hold what is known there
  std::vector<LinkageRecord> recorded_;
  DriveHistory history_;
  Status interruption_ = Status::done;
  Failures failures_;
  study::Extreme nearest_, closure_, transmission_, shaking_, power_, balance_;
  std::vector<study::Extreme> drives_, joints_, racks_, strands_;
  LoadWithoutValue without_value_ = {};  // the first one
  std::size_t weakest_ = 0;
  int nearest_group_ = -1;
  std::vector<double> modes_;
  study::Result result_;
};

}  // namespace

study::Result run_linkage_study(const LinkageStudy& study, RunContext& context) {
  return Runner(study, context).run();
}

}  // namespace linkwright::planar
