// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/simulation/coordinates.h"
#include "linkwright/planar/studies/elastic.h"

namespace linkwright::planar {
namespace {

class ElasticRecorder {
 public:
  ElasticRecorder(const LinkageSimulationStudy& s, RunContext& context) : s_(s), context_(context) {
    for (int i = 0; i < s.samples; ++i)
      times_.push_back(i + 1 == s.samples ? s.to : s.from + (s.to - s.from) * i / (s.samples - 1));
    std::vector<InputMotion> start;
    for (const InputMotion& i : inputs_at(s.drives, s.from - s.settle)) start.push_back(i);
    out_.elastic = with_elastic_bodies(s.linkage, s.elastic, start);
  }

  ElasticRecording run() {
    rigid_rows();
    if (out_.elastic.status == Status::done) {
      choose_columns();
      choose_errors();
      integrate();
      tables();
    }
    return std::move(out_);
  }

 private:
  const std::string& name_of_beam(const ElasticPieces& p) const {
    return s_.linkage.bodies[at(p.beam.body)].name;
  }

  // ---- the rigid linkage --------------------------------------------------------------------------------

  void rigid_rows() {
    rigid_columns_ = driven_columns(s_.linkage, s_.plan, s_.quantities, s_.traces, s_.drives);
    rigid_values_.resize(rigid_columns_.size());
    if (std::any_of(s_.drives.begin(), s_.drives.end(), [](const InputDrive& c) { return !c.law; })) {
      // The same route, but steps that suit a motion without vibrations.
      SimulationOptions options = s_.options;
      options.method = math::OdeMethod::explicit_runge_kutta_8;
      const auto route = s_.route == SimulationRoute::free_joints ? simulate : simulate_all_coordinates;
      const SimulationReport r = route(
          s_.linkage, s_.plan, s_.drives, times_, options,
          [&](const SimulationInstant& now) {
            return add_rigid(now.time, now.inputs, *now.motion, now.status), true;
          },
          &context_);
      out_.rigid_message = r.message;
      return;
    }
    LinkageMotion motion(s_.plan);
    std::vector<double> from, to;
    for (const double t : times_) {
      const std::vector<InputMotion> inputs = inputs_at(s_.drives, t);
      to.clear();
      for (const InputMotion& i : inputs) to.push_back(i.value);
      if (!from.empty()) follow(s_.plan, from, to, motion);
      solve_motion(s_.plan, inputs, motion);
      if (motion.status != Status::done) {
        out_.rigid_message = say("at {}: {}", seconds(t, 6), assembly_gap_text(s_.plan, motion, 0, to[0]));
        return;
      }
      from = to;
      add_rigid(t, inputs, motion, Status::done);
    }
  }
  void add_rigid(double time, std::span<const InputMotion> inputs, const LinkageMotion& motion,
                 Status status) {
    const bool dynamic = s_.quantities.dynamic() && status == Status::done;
    if (dynamic) solve_forces(s_.linkage, s_.plan, motion, time, inputs[0].value, forces_);
    const LinkageInstant instant{time, {inputs.begin(), inputs.end()}, &motion, &forces_};
    for (std::size_t c = 0; c < rigid_columns_.size(); ++c)
      rigid_values_[c].push_back(status == Status::done ? rigid_columns_[c].value(instant) : nan);
    rigid_records_.push_back(record_of(s_.linkage, s_.plan, motion, nullptr, time));
    rigid_times_.push_back(time);
    for (const InputMotion& i : inputs) out_.largest_rate = std::max(out_.largest_rate, std::abs(i.rate));
  }

  // ---- columns ------------------------------------------------------------------------------------------

  // Chooses the columns of the rigid linkage, each as the elastic one has it: traced points on the piece that
  // they are on, flexible bodies as their lines.
  void choose_columns() {
    std::vector<BodyPoint> moved;
    std::vector<std::pair<std::string, std::string>> renamed;
    for (const BodyPoint& t : s_.traces) {
      moved.push_back(on_piece(t));
      const auto prefix = [](const LinkageBody& b) { return identifier(b.name) + "_"; };
      const LinkageBody& body = s_.linkage.bodies[at(t.body)];
      const std::string point = identifier(body.points[at(t.point)].name) + "_";
      renamed.emplace_back(prefix(out_.elastic.linkage.bodies[at(moved.back().body)]) + point,
                           prefix(body) + point);
    }
    const auto all = linkage_columns(out_.elastic.linkage, out_.elastic.plan, s_.quantities, moved);
    for (const LinkageColumn& rigid : rigid_columns_) {
      if (auto line = line_column(rigid)) {
        columns_.push_back(*line);
        continue;
      }
      for (const LinkageColumn& c : all) {
        bool same = c.key == rigid.key;
        for (const auto& [now, before] : renamed)
          same = same || (c.key.starts_with(now) && rigid.key == before + c.key.substr(now.size()));
        if (!same) continue;
        columns_.push_back(c);
        columns_.back().key = rigid.key;
        columns_.back().label = rigid.label;
        break;
      }
    }
    values_.resize(columns_.size());
  }
  BodyPoint on_piece(const BodyPoint& p) const {
    for (const ElasticPieces& pieces : out_.elastic.pieces) {
      if (pieces.beam.body != p.body) continue;
      const std::string& name = s_.linkage.bodies[at(p.body)].points[at(p.point)].name;
      for (const int b : pieces.bodies)
        if (const int k = point_index(out_.elastic.linkage.bodies[at(b)], name); k >= 0) return {b, k};
    }
    return p;
  }
  std::optional<LinkageColumn> line_column(const LinkageColumn& rigid) const {
    for (std::size_t e = 0; e < out_.elastic.pieces.size(); ++e) {
      const std::string key = identifier(name_of_beam(out_.elastic.pieces[e])) + "_";
      const auto value = [&](std::string_view what) -> std::function<double(const PartState<double>&)> {
        if (what == "angle_rad") return [](const auto& s) { return angle_of(s.direction); };
        if (what == "x_m") return [](const auto& s) { return s.origin.x; };
        if (what == "y_m") return [](const auto& s) { return s.origin.y; };
        if (what == "speed_rad_per_s") return [](const auto& s) { return s.speed; };
        if (what == "acceleration_rad_per_s2") return [](const auto& s) { return s.angular_acceleration; };
        return {};
      };
      if (!rigid.key.starts_with(key)) continue;
      const auto of = value(std::string_view(rigid.key).substr(key.size()));
      if (!of) continue;
      return LinkageColumn{rigid.key, rigid.label,
                           [this, e, of](const LinkageInstant& i) {
                             return of(chord_state(out_.elastic, out_.elastic.pieces[e], *i.motion));
                           },
                           rigid.angle};
    }
    return {};
  }

  // Bodies that turn on the ground and slides on it, but for those that a drive moves, and traced points.
  void choose_errors() {
    const Linkage& l = s_.linkage;
    for (int j = 0; j < static_cast<int>(l.joints.size()); ++j) {
      const LinkageJoint& joint = l.joints[at(j)];
      const bool first = s_.plan.bodies[at(joint.first.body)].part == 0,
                 second = s_.plan.bodies[at(joint.second.body)].part == 0;
      if (first == second || std::find(l.driven.begin(), l.driven.end(), j) != l.driven.end()) continue;
      const int body = first ? joint.second.body : joint.first.body;
      const std::string& name = l.bodies[at(body)].name;
      if (joint.type == JointType::revolute)
        out_.errors.push_back({identifier(name) + "_angle_error_rad",
                               name + " angle error (rad)",
                               OutputError::Of::angle,
                               body,
                               {}});
      else if (joint.type == JointType::prismatic)
        out_.errors.push_back({identifier(joint.name) + "_displacement_error_m",
                               joint.name + " displacement error (m)",
                               OutputError::Of::displacement,
                               j,
                               {}});
    }
    for (int t = 0; t < static_cast<int>(s_.traces.size()); ++t) {
      const LinkageBody& b = l.bodies[at(s_.traces[at(t)].body)];
      const std::string& p = b.points[at(s_.traces[at(t)].point)].name;
      out_.errors.push_back({identifier(b.name) + "_" + identifier(p) + "_error_m",
                             b.name + "." + p + " path error (m)",
                             OutputError::Of::path,
                             t,
                             {}});
    }
  }
  double error(const OutputError& e, const ElasticRecord& bent, const LinkageMotion& motion,
               const LinkageRecord& rigid) const {
    if (rigid.bodies.empty() || bent.record.bodies.empty()) return nan;
    if (e.of == OutputError::Of::angle)
      return math::wrap_angle(angle_of(
          rotate_inverse(rigid.bodies[at(e.index)].direction, bent.record.bodies[at(e.index)].direction)));
    if (e.of == OutputError::Of::displacement) {
      const LinkageJoint& j = s_.linkage.joints[at(e.index)];
      const bool first = s_.plan.bodies[at(j.first.body)].part == 0;
      const int body = first ? j.second.body : j.first.body;
      const BodyPoint& there = first ? j.second : j.first;
      const math::Vec2 p = math::vec(s_.linkage.bodies[at(body)].points[at(there.point)].at);
      const math::Vec2 along = rotate(rigid.bodies[at(j.first.body)].direction, math::unit(j.slide_first));
      const double way =
          dot(along, point_on(bent.record.bodies[at(body)], p) - point_on(rigid.bodies[at(body)], p));
      return first ? way : -way;
    }
    const BodyPoint &t = s_.traces[at(e.index)], on = on_piece(t);
    const std::complex<double> p = place_of(s_.linkage, t);
    return norm(point_motion(out_.elastic.plan, motion, on.body, p).position -
                point_on(rigid.bodies[at(t.body)], math::vec(p)));
  }

  // ---- motion -------------------------------------------------------------------------------------------

  void integrate() {
    inputs_.resize(3 * s_.plan.inputs());
    out_.beams.resize(out_.elastic.pieces.size());
    std::vector<InputDrive> drives = s_.drives;
    drives.insert(drives.end(), out_.elastic.free.begin(), out_.elastic.free.end());
    const auto route = s_.route == SimulationRoute::free_joints ? simulate : simulate_all_coordinates;
    std::vector<double> times = times_;
    if (s_.settle > 0) times.insert(times.begin(), s_.from - s_.settle);
    out_.report = route(
        out_.elastic.linkage, out_.elastic.plan, drives, times, s_.options,
        [&](const SimulationInstant& now) {
          if (now.time >= s_.from) add(now);
          return true;
        },
        &context_);
  }
  void add(const SimulationInstant& now) {
    const bool done = now.status == Status::done;
    if (done) solve_forces(out_.elastic.linkage, out_.elastic.plan, now, forces_);
    const bool known = done && forces_.status == Status::done;
    out_.times.push_back(now.time);
    statuses_.emplace_back(to_string(done ? forces_.status : now.status));
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k) {
      inputs_[3 * k].push_back(now.inputs[k].value);
      inputs_[3 * k + 1].push_back(now.inputs[k].rate);
      inputs_[3 * k + 2].push_back(now.inputs[k].acceleration);
    }
    kinetic_.push_back(now.kinetic);
    potential_.push_back(now.potential);
    work_.push_back(now.work);
    drift_.push_back(now.drift);
    for (std::size_t e = 0; e < out_.beams.size(); ++e) add_beam(e, now, done, known);
    const LinkageInstant instant{now.time, {now.inputs.begin(), now.inputs.end()}, now.motion, &forces_};
    for (std::size_t c = 0; c < columns_.size(); ++c)
      values_[c].push_back(known ? columns_[c].value(instant) : nan);
    out_.records.push_back(
        elastic_record(s_.linkage, out_.elastic, *now.motion, known ? &forces_ : nullptr, now.time));
    const auto row = std::lower_bound(rigid_times_.begin(), rigid_times_.end(), now.time);
    const bool beside = row != rigid_times_.end() && *row == now.time;
    for (std::size_t i = 0; i < out_.errors.size(); ++i)
      out_.errors[i].values.push_back(
          beside && done ? error(out_.errors[i], out_.records.back(), *now.motion,
                                 rigid_records_[static_cast<std::size_t>(row - rigid_times_.begin())])
                         : nan);
  }
  void add_beam(std::size_t e, const SimulationInstant& now, bool done, bool known) {
    const ElasticPieces& p = out_.elastic.pieces[e];
    BentBody bent;
    if (done) bent = bent_body(out_.elastic, p, *now.motion, known ? &forces_ : nullptr);
    const auto put = [&](std::vector<double>& to, double value) { to.push_back(done ? value : nan); };
    BeamRows& to = out_.beams[e];
    put(to.middle, bent.middle);
    put(to.largest, bent.largest);
    put(to.moment, done ? bent.moments[at(bent.spring)] : nan);
    put(to.normal, known ? bent.normal_forces[at(bent.spring)] : nan);
    put(to.bending, bent.bending_stress);
    put(to.stress, bent.stress);
    put(to.place, bent.place);
  }

  // ---- what is reported
  // -------------------------------------------------------------------------------------

  std::string beam_key(std::size_t e) const { return identifier(name_of_beam(out_.elastic.pieces[e])); }

  void tables() {
    Table table{.name = "motion"};
    table.add("time_s", "time (s)", out_.times);
    add_input_columns(table, s_.linkage, s_.plan, inputs_);
    for (std::size_t e = 0; e < out_.beams.size(); ++e) {
      const std::string key = beam_key(e), &name = name_of_beam(out_.elastic.pieces[e]);
      const BeamRows& v = out_.beams[e];
      table.add(key + "_middle_deflection_m", name + " deflection in the middle (m)", v.middle);
      table.add(key + "_largest_deflection_m", name + " largest deflection (m)", v.largest);
      table.add(key + "_bending_moment_N_m", name + " bending moment at the worst section (N m)", v.moment);
      table.add(key + "_normal_force_N", name + " normal force at the worst section (N)", v.normal);
      table.add(key + "_bending_stress_Pa", name + " largest bending stress (Pa)", v.bending);
      table.add(key + "_stress_Pa", name + " largest stress, bending and normal force (Pa)", v.stress);
      table.add(key + "_stress_place_m", name + " place of the worst section (m)", v.place);
    }
    for (std::size_t i = 0; i < out_.errors.size(); ++i)
      table.add(out_.errors[i].key, out_.errors[i].label, out_.errors[i].values);
    table.add("kinetic_energy_J", "kinetic energy (J)", kinetic_);
    table.add("potential_energy_J", "potential energy of weight, springs and bending (J)", potential_);
    table.add("work_J", "work of drives, loads and damping (J)", work_);
    table.add("energy_drift_J", "energy drift (J)", drift_);
    const auto add_all = [](Table& to, const std::vector<LinkageColumn>& columns,
                            std::vector<std::vector<double>>& values) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        unwrap(columns[c], values[c]);
        to.add(columns[c].key, columns[c].label, std::move(values[c]));
      }
    };
    add_all(table, columns_, values_);
    table.status = statuses_;
    out_.motion = std::move(table);
    Table rigid{.name = "rigid"};
    rigid.add("time_s", "time (s)", rigid_times_);
    add_all(rigid, rigid_columns_, rigid_values_);
    out_.rigid = std::move(rigid);
  }
  const LinkageSimulationStudy& s_;
  RunContext& context_;
  ElasticRecording out_;
  std::vector<double> times_, rigid_times_, kinetic_, potential_, work_, drift_;
  std::vector<LinkageColumn> columns_, rigid_columns_;
  std::vector<std::vector<double>> values_, rigid_values_, inputs_;
  std::vector<std::string> statuses_;
  std::vector<LinkageRecord> rigid_records_;
  LinkageForces forces_;
};

}  // namespace

study::Result run_elastic_simulation(const LinkageSimulationStudy& study, RunContext& context) {
  return report_elastic_simulation(study, ElasticRecorder(study, context).run());
}

}  // namespace linkwright::planar
