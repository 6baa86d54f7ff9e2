// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/coordinates.h"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

using Index = Eigen::Index;

// A point and a direction of a joint on a part, in the frame of the part.
struct Side {
  int part = 0;
  math::Vec2 at{0, 0}, direction{1, 0};
};

// One equation: the slip of the second side against the first in a direction, or their turn.
enum class RowType { x, y, across, along, turn, gear };
struct Equation {
  RowType type;
  Side first, second;
  int law = -1;                  // index of the input that prescribes its value; -1: zero
  int carrier = 0;               // gear
  double ratio = 1, offset = 0;  // gear; turn of the angles when the equation is met, or the value zero
};

class Coordinates {
 public:
  Coordinates(const Linkage& l, const LinkagePlan& plan, std::span<const InputDrive> drives,
              const SimulationOptions& options, const SimulationOutput& output)
      : l_(l),
        plan_(plan),
        drives_(drives),
        options_(options),
        output_(output),
        motion_(plan),
        rows_(plan),
        inputs_(plan.inputs()) {
    LINKWRIGHT_REQUIRE(plan.has_masses, "motion under forces needs the mass of every body: '{}' has none",
                       plan.massless[0]);
    LINKWRIGHT_REQUIRE(options.method != math::OdeMethod::adams, "method {} takes no projection",
                       name_of(options.method));
    for (const LinkageJoint& j : l.joints)
      LINKWRIGHT_REQUIRE(!has_friction(j), "joint '{}' has friction, which all coordinates do not take",
                         j.name);
    LINKWRIGHT_REQUIRE(first_rolling_pair(l).empty(), "all coordinates do not take {}",
                       first_rolling_pair(l));
    column_.assign(plan.parts.size(), -1);
    for (const BodyOnPart& b : plan.bodies)
      if (b.part != 0 && column_[at(b.part)] < 0) {
        column_[at(b.part)] = static_cast<int>(3 * parts_.size());
        parts_.push_back(b.part);
      }
    bool any_free = false;
    for (std::size_t k = 0; k < drives.size(); ++k) {
      laws_.push_back(drives[k].law ? std::optional<math::MotionCurve>(*drives[k].law) : std::nullopt);
      inputs_[k] = {drives[k].value, drives[k].rate, 0};
      any_free = any_free || !drives[k].law;
    }
    LINKWRIGHT_REQUIRE(any_free, "{} inputs, and none of them is free", drives.size());
  }

  SimulationReport run(std::span<const double> times, const RunContext* context) {
    if (!start(times.front())) return std::move(report_);
    const std::size_t n = size();
    std::vector<double> y(2 * n + 1, 0.0);
    for (const int p : parts_) {
      const PartState<double>& s = motion_.parts[at(p)];
      double* place = &y[at(column_[at(p)])];
      place[0] = s.origin.x, place[1] = s.origin.y, place[2] = angle_of(s.direction);
      place[n] = s.velocity.x, place[n + 1] = s.velocity.y, place[n + 2] = s.speed;
    }
    equations(y);
    put(y);
    twists_ = motion_.twists;
    for (std::size_t k = 0; k < twists_.size(); ++k) twists_[k] -= turned(k);
    start_kinetic_ = kinetic_energy(plan_, motion_);
    start_potential_ = potential_energy(l_, plan_, motion_);
    std::vector<double> tolerances;
    for (std::size_t i = 0; i < 2 * n; ++i)
      tolerances.push_back(options_.absolute_tolerance * (i % 3 == 2 ? 1 : plan_.size));
    tolerances.push_back(1e30);  // the work follows from the motion
    math::OdeHooks hooks{.output_times = times, .context = context};
    hooks.output = [&](double t, std::span<const double> now) { return show(t, now); };
    hooks.project = [&](double t, std::span<double> now) { return project(t, now); };
    const math::OdeReport ode = integrate_by_pieces(
        [&](double t, std::span<const double> now, std::span<double> rate) { return slope(t, now, rate); }, y,
        times.front(), times.back(), breaks_of(l_, drives_, times.front(), times.back()),
        {.method = options_.method,
         .relative_tolerance = options_.relative_tolerance,
         .absolute_tolerances = tolerances,
         .max_steps = options_.max_steps},
        hooks);
    report_.steps = ode.steps;
    report_.evaluations = ode.evaluations;
    report_.time = ode.t;
    if (ode.status != Status::done) {
      report_.status = ode.status;
      report_.message = say("ended at {}: {}", seconds(ode.t, 6), ode.message);
    }
    return std::move(report_);
  }

 private:
  std::size_t size() const { return 3 * parts_.size(); }

  bool start(double t) {
    report_.time = t;
    prescribe(t);
    if (!plan_.closed_form()) {
      // The mode that the drawing shows, wherever the motion starts.
      InputReach reach;
      for (const InputMotion& i : inputs_) reach.low.push_back(i.value), reach.high.push_back(i.value);
      LinkageAssembly(plan_, reach, AtChangePoint::stop).place(inputs_, motion_);
    }
    if (motion_.status == Status::done) solve_motion(plan_, inputs_, motion_);
    if (motion_.status == Status::done) return true;
    report_.status = motion_.status;
    report_.group = motion_.failed_group;
    report_.message = "the start does not work: " + assembly_gap_text(plan_, motion_, 0, inputs_[0].value);
    return false;
  }
  void prescribe(double t) {
    for (std::size_t k = 0; k < laws_.size(); ++k)
      if (laws_[k]) {
        const math::Motion m = (*laws_[k])(t);
        inputs_[k] = {m.value, m.rate, m.acceleration};
      }
  }

  Side side(const BodyPoint& p, double angle) const {
    const BodyOnPart& on = plan_.bodies[at(p.body)];
    const math::Vec2 local = math::vec(place_of(l_, p));
    return {on.part, on.origin + rotate(on.turn, local), rotate(on.turn, math::unit(angle))};
  }
  // All equations of the joints; turns are measured from where they are at the start.
  void equations(std::span<const double> y) {
    const auto angle = [&](int part) { return part == 0 ? 0.0 : y[at(column_[at(part)]) + 2]; };
    for (std::size_t k = 0; k < l_.joints.size(); ++k) {
      const LinkageJoint& j = l_.joints[k];
      const std::vector<int>& redundant = plan_.redundant_gears;
      if (j.type == JointType::fixed ||
          std::find(redundant.begin(), redundant.end(), static_cast<int>(k)) != redundant.end())
        continue;
      Equation e{RowType::x, {}, {}};
      if (j.type == JointType::gear) {
        e.type = RowType::gear;
        e.first.part = plan_.bodies[at(j.first.body)].part;
        e.second.part = plan_.bodies[at(j.second.body)].part;
        e.carrier = plan_.bodies[at(j.carrier)].part;
        e.ratio = j.ratio;
        e.offset = angle(e.second.part) - e.ratio * angle(e.first.part) - (1 - e.ratio) * angle(e.carrier);
        equations_.push_back(e);
        continue;
      }
      e.first = side(j.first, j.slide_first);
      e.second = side(j.second, j.slide_second);
      e.offset = angle(e.second.part) - angle(e.first.part);
      const auto add = [&](RowType type) {
        e.type = type;
        equations_.push_back(e);
      };
      if (j.type == JointType::revolute) {
        add(RowType::x), add(RowType::y);
      } else {
        add(RowType::across);
        if (j.type == JointType::prismatic) add(RowType::turn);
      }
    }
    for (std::size_t k = 0; k < laws_.size(); ++k) {
      const LinkageJoint& j = l_.joints[at(l_.driven[k])];
      Equation e{plan_.rotary[k] ? RowType::turn : RowType::along, side(j.first, j.slide_first),
                 side(j.second, j.slide_second), static_cast<int>(k)};
      e.offset = angle(e.second.part) - angle(e.first.part) - inputs_[k].value;
      coordinate_.push_back(e);
      if (laws_[k]) equations_.push_back(e);
    }
    const auto n = static_cast<Index>(size()), m = static_cast<Index>(equations_.size());
    matrix_.resize(n + m, n + m);
    right_.resize(n + m);
  }

  void put(std::span<const double> y) {
    const std::size_t n = size();
    for (const int p : parts_) {
      const double* place = &y[at(column_[at(p)])];
      PartState<double>& s = motion_.parts[at(p)];
      s = {{place[0], place[1]}, math::unit(place[2]), {place[n], place[n + 1]}, place[n + 2], {0, 0}, 0};
    }
    angles_ = y;
    for (std::size_t k = 0; k < twists_.size(); ++k) motion_.twists[k] = twists_[k] + turned(k);
  }
  // The angles of the state count their turns by themselves.
  double turned(std::size_t spring) const {
    const PlanTwist& t = plan_.twists[spring];
    return angle(t.second) - angle(t.first);
  }
  double angle(int part) const { return part == 0 ? 0.0 : angles_[at(column_[at(part)]) + 2]; }
  const PartState<double>& part(int p) const { return motion_.parts[at(p)]; }

  struct Geometry {
    math::Vec2 point, apart, along, force{0, 0};
    double moment = 0;
  };
  Geometry geometry(const Equation& e) const {
    Geometry g;
    g.point = point_on(part(e.second.part), e.second.at);
    g.apart = g.point - point_on(part(e.first.part), e.first.at);
    g.along = rotate(part(e.first.part).direction, e.first.direction);
    if (e.type == RowType::x) g.force = {1, 0};
    if (e.type == RowType::y) g.force = {0, 1};
    if (e.type == RowType::across) g.force = perpendicular(g.along);
    if (e.type == RowType::along) g.force = g.along;
    if (e.type == RowType::turn) g.moment = 1;
    return g;
  }
  // Value of an equation's quantity, its rate, and its acceleration when the parts have those that they have.
  double residual(const Equation& e) const {
    const double wanted = e.law >= 0 ? inputs_[at(e.law)].value : 0;
    if (e.type == RowType::gear)
      return angle(e.second.part) - e.ratio * angle(e.first.part) - (1 - e.ratio) * angle(e.carrier) -
             e.offset;
    if (e.type == RowType::turn) return angle(e.second.part) - angle(e.first.part) - e.offset - wanted;
    const Geometry g = geometry(e);
    return dot(g.force, g.apart) - wanted;
  }
  double rate(const Equation& e) const {
    const PartState<double>&first = part(e.first.part), &second = part(e.second.part);
    if (e.type == RowType::gear)
      return second.speed - e.ratio * first.speed - (1 - e.ratio) * part(e.carrier).speed;
    if (e.type == RowType::turn) return second.speed - first.speed;
    const Geometry g = geometry(e);
    return dot(g.force, velocity_at(second, g.point) - velocity_at(first, g.point));
  }
  double acceleration(const Equation& e) const {
    const PartState<double>&first = part(e.first.part), &second = part(e.second.part);
    if (e.type == RowType::gear)
      return second.angular_acceleration - e.ratio * first.angular_acceleration -
             (1 - e.ratio) * part(e.carrier).angular_acceleration;
    if (e.type == RowType::turn) return second.angular_acceleration - first.angular_acceleration;
    const Geometry g = geometry(e);
    double a = dot(g.force, acceleration_at(second, g.point) - acceleration_at(first, g.point));
    if (e.type == RowType::across)  // Coriolis
      a -= 2 * first.speed * dot(g.along, velocity_at(second, g.point) - velocity_at(first, g.point));
    return a;
  }

  // Mass matrix and joint equations at the present places, factorised.
  bool factorise() {
    const auto n = static_cast<Index>(size());
    matrix_.setZero();
    for (const int p : parts_) {
      const PartMass& m = plan_.masses[at(p)];
      const math::Vec2 s = rotate(part(p).direction, m.moment);
      const Index c = column_[at(p)];
      matrix_(c, c) = matrix_(c + 1, c + 1) = m.mass;
      matrix_(c, c + 2) = matrix_(c + 2, c) = -s.y;
      matrix_(c + 1, c + 2) = matrix_(c + 2, c + 1) = s.x;
      matrix_(c + 2, c + 2) = m.inertia;
    }
    Index row = n;
    for (const Equation& e : equations_) {
      const auto add = [&](int p, const math::Vec2& force, double moment) {
        if (p == 0) return;
        const Index c = column_[at(p)];
        for (const auto& [i, value] :
             {std::pair{c, force.x}, std::pair{c + 1, force.y}, std::pair{c + 2, moment}}) {
          matrix_(row, i) += value;
          matrix_(i, row) += value;
        }
      };
      if (e.type == RowType::gear) {
        add(e.second.part, {0, 0}, 1);
        add(e.first.part, {0, 0}, -e.ratio);
        add(e.carrier, {0, 0}, -(1 - e.ratio));
      } else {
        const Geometry g = geometry(e);
        for (const auto& [p, sign] : {std::pair{e.second.part, 1.0}, std::pair{e.first.part, -1.0}})
          add(p, sign * g.force, sign * (g.moment + cross(g.point - part(p).origin, g.force)));
      }
      ++row;
    }
    lu_.compute(matrix_);
    return std::isfinite(lu_.matrixLU().diagonal().sum());
  }

  bool slope(double t, std::span<const double> y, std::span<double> out) {
    prescribe(t);
    put(y);
    read_inputs();
    if (!factorise()) return false;
    const std::size_t n = size();
    loads_.clear();
    applied_loads(l_, plan_, motion_, t, inputs_[0].value, loads_);
    right_.setZero();
    for (const int p : parts_) {
      const Wrench<double> w = needed_wrench(plan_.masses[at(p)], part(p), math::vec(l_.gravity));
      const Index c = column_[at(p)];
      right_[c] -= w.force.x, right_[c + 1] -= w.force.y, right_[c + 2] -= w.moment;
    }
    for (const AppliedLoad& load : loads_) {
      const int p = plan_.bodies[at(load.body)].part;
      if (p == 0) continue;
      const Wrench<double> w = shifted(Wrench<double>{load.force, load.torque}, load.point - part(p).origin);
      const Index c = column_[at(p)];
      right_[c] += w.force.x, right_[c + 1] += w.force.y, right_[c + 2] += w.moment;
    }
    auto row = static_cast<Index>(n);
    for (const Equation& e : equations_)
      right_[row++] = (e.law >= 0 ? inputs_[at(e.law)].acceleration : 0) - acceleration(e);
    solution_ = lu_.solve(right_);
    if (!solution_.allFinite()) return false;
    for (std::size_t i = 0; i < n; ++i) out[i] = y[n + i], out[n + i] = solution_[static_cast<Index>(i)];
    out[2 * n] = lasting_power(l_, plan_, motion_, loads_);
    row = static_cast<Index>(n);
    for (const Equation& e : equations_) {  // the solution holds minus the forces of the joints
      if (e.law >= 0) out[2 * n] -= solution_[row] * inputs_[at(e.law)].rate;
      ++row;
    }
    return true;
  }
  // Values and rates of the free joints at the present state.
  void read_inputs() {
    for (std::size_t k = 0; k < laws_.size(); ++k) {
      if (laws_[k]) continue;
      Equation e = coordinate_[k];
      e.law = -1;
      inputs_[k] = {residual(e), rate(e), acceleration(e)};
    }
  }

  // Newton's method on the places, then velocities, both by the least change in the metric of the masses.
  bool project(double t, std::span<double> y) {
    prescribe(t);
    const std::size_t n = size();
    const auto rows = static_cast<Index>(equations_.size());
    for (int iteration = 0; iteration < 4; ++iteration) {
      put(y);
      if (!factorise()) return false;
      right_.setZero();
      double worst = 0;
      for (Index i = 0; i < rows; ++i) {
        const double r = residual(equations_[static_cast<std::size_t>(i)]);
        right_[static_cast<Index>(n) + i] = -r;
        worst = std::max(worst, std::abs(r));
      }
      if (worst <= 1e-14 * std::max(plan_.size, 1.0)) break;
      solution_ = lu_.solve(right_);
      if (!solution_.allFinite()) return false;
      for (std::size_t i = 0; i < n; ++i) y[i] += solution_[static_cast<Index>(i)];
    }
    put(y);
    right_.setZero();
    for (Index i = 0; i < rows; ++i) {
      const Equation& e = equations_[static_cast<std::size_t>(i)];
      right_[static_cast<Index>(n) + i] = (e.law >= 0 ? inputs_[at(e.law)].rate : 0) - rate(e);
    }
    solution_ = lu_.solve(right_);
    if (!solution_.allFinite()) return false;
    for (std::size_t i = 0; i < n; ++i) y[n + i] += solution_[static_cast<Index>(i)];
    return true;
  }

  bool show(double t, std::span<const double> y) {
    std::vector<double> state(y.begin(), y.end()), slopes(y.size());
    if (!project(t, state) || !slope(t, state, slopes)) return true;
    const std::size_t n = size();
    for (const int p : parts_) {
      const double* a = &slopes[n + at(column_[at(p)])];
      motion_.parts[at(p)].acceleration = {a[0], a[1]};
      motion_.parts[at(p)].angular_acceleration = a[2];
    }
    read_inputs();
    SimulationInstant now{.time = t, .inputs = inputs_, .motion = &rows_};
    now.kinetic = kinetic_energy(plan_, motion_);
    now.potential = potential_energy(l_, plan_, motion_);
    now.work = state.back();
    now.drift = (now.kinetic - start_kinetic_) + (now.potential - start_potential_) - now.work;
    report_.largest_drift = std::max(report_.largest_drift, std::abs(now.drift));
    report_.peak_energy = std::max(
        {report_.peak_energy, now.kinetic, std::abs(now.potential - start_potential_), std::abs(now.work)});
    report_.time = t;
    place_groups();
    now.status = rows_.status == Status::done ? Status::done : Status::singular;
    return !output_ || output_(now);
  }
  // Sets the state of the groups' closure, in the modes of the present positions; places show; places and
  // motion of the parts are those of the state.
  void place_groups() {
    if (!plan_.closed_form()) rows_.parts = motion_.parts;
    for (std::size_t g = 0; g < plan_.groups.size(); ++g) {
      if (!traits_of(plan_.groups[g]).has_modes) continue;
      double nearest = infinity, best = 1;
      for (const double mode : {1.0, -1.0}) {
        rows_.modes[g] = mode;
        solve_position(plan_, inputs_, rows_);
        double apart = 0;
        for (const int p : plan_.groups[g].parts)
          if (column_[at(p)] >= 0)
            apart += norm(rows_.parts[at(p)].direction - part(p).direction) * plan_.size +
                     norm(rows_.parts[at(p)].origin - part(p).origin);
        if (apart < nearest) nearest = apart, best = mode;
      }
      rows_.modes[g] = best;
    }
    solve_motion(plan_, inputs_, rows_);
    for (const int p : parts_) rows_.parts[at(p)] = motion_.parts[at(p)];
  }

  const Linkage& l_;
  const LinkagePlan& plan_;
  std::span<const InputDrive> drives_;
  const SimulationOptions& options_;
  const SimulationOutput& output_;
  LinkageMotion motion_, rows_;  // motions of the state; of the rows, with groups
  std::vector<InputMotion> inputs_;
  std::vector<std::optional<math::MotionCurve>> laws_;
  std::vector<int> parts_, column_;  // parts that carry bodies; first coordinate of a part, -1 of others
  std::vector<Equation> equations_, coordinate_;
  std::span<const double> angles_;
  // Twists of the torsion springs, less the angles between their bodies in the state.
  std::vector<double> twists_;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_, solution_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  std::vector<AppliedLoad> loads_;
  double start_kinetic_ = 0, start_potential_ = 0;
  SimulationReport report_;
};

}  // namespace

SimulationReport simulate_all_coordinates(const Linkage& linkage, const LinkagePlan& plan,
                                          std::span<const InputDrive> drives, std::span<const double> times,
                                          const SimulationOptions& options, const SimulationOutput& output,
                                          const RunContext* context) {
  LINKWRIGHT_REQUIRE(drives.size() == plan.inputs(), "the linkage has {} inputs, got {}", plan.inputs(),
                     drives.size());
  LINKWRIGHT_REQUIRE(times.size() >= 2 && times.front() < times.back(), "no interval of time: {} times",
                     times.size());
  return Coordinates(linkage, plan, drives, options, output).run(times, context);
}

}  // namespace linkwright::planar
