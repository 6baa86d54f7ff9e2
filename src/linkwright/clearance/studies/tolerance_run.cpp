// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "linkwright/clearance/studies/tolerance.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/study/remarks.h"

namespace linkwright::clearance {
namespace {

using Kind = ToleranceQuantity::Kind;

std::vector<ToleranceQuantity> quantities_of(const planar::LinkageStudy& s, const ToleranceOutputs& o) {
  const planar::Linkage& l = s.linkage;
  std::vector<ToleranceQuantity> out;
  std::size_t first = 0;
  const auto add = [&](Kind kind, std::string key, std::string name) {
    const std::size_t size = kind == Kind::point || kind == Kind::force ? 2 : 1;
    out.push_back(
        {.kind = kind, .key = std::move(key), .name = std::move(name), .first = first, .size = size});
    first += size;
  };
  for (const planar::BodyPoint& p : o.points) {
    const planar::LinkageBody& b = l.bodies[at(p.body)];
    const std::string& point = b.points[at(p.point)].name;
    add(Kind::point, identifier(b.name) + "_" + identifier(point), b.name + "." + point);
  }
  for (const int j : o.coordinates) {
    const planar::LinkageJoint& joint = l.joints[at(j)];
    const bool turns = joint.type == planar::JointType::revolute;
    add(turns ? Kind::angle : Kind::displacement,
        identifier(joint.name) + (turns ? "_angle" : "_displacement"),
        (turns ? "angle of " : "displacement of ") + joint.name);
  }
  for (const int j : o.forces)
    add(Kind::force, identifier(l.joints[at(j)].name) + "_force", "force at " + l.joints[at(j)].name);
  if (o.drives)
    for (std::size_t k = 0; k < l.driven.size(); ++k) {
      const std::string& name = planar::input_joint(l, k).name;
      const bool turns = s.plan.rotary[k];
      // A force along one line: shown as a force, though it has one component.
      add(turns ? Kind::torque : Kind::force, identifier(name) + (turns ? "_drive_torque" : "_drive_force"),
          (turns ? "drive torque at " : "drive force at ") + name);
      if (!turns) {
        out.back().size = 1;
        --first;
      }
    }
  return out;
}

std::vector<std::string> tolerance_names(const planar::Linkage& l, const LinkageTolerances& t) {
  std::vector<std::string> out;
  for (const PinTolerance& p : t.pins) out.push_back("pin " + l.joints[at(p.joint)].name);
  for (const LengthTolerance& e : t.lengths) {
    const planar::LinkageBody& b = l.bodies[at(e.body)];
    out.push_back(
        fmt::format("length {}-{} of {}", b.points[at(e.from)].name, b.points[at(e.to)].name, b.name));
  }
  return out;
}

// The nominal linkage: what is drawn, and how near to a dead point it comes. The rows so far when the run is
// to stop.
void record_motion(const ToleranceStudy& s, ToleranceRecording& r, bool time, const RunContext& context) {
  constexpr std::size_t between_looks = 1024;
  const planar::LinkageStudy& m = s.motion;
  const bool forces_wanted = !s.outputs.forces.empty() || s.outputs.drives;
  planar::LinkageMotion motion(m.plan);
  planar::LinkageForces forces;
  std::vector<double> last, next;
  for (std::size_t i = 0; i < r.rows.inputs.size(); ++i) {
    if (i > 0 && i % between_looks == 0 && context.interrupted()) break;
    const std::vector<planar::InputMotion>& now = r.rows.inputs[i];
    next.clear();
    for (const planar::InputMotion& input : now) next.push_back(input.value);
    // General groups are followed from row to row, so that they keep their branch.
    const bool there =
        m.plan.closed_form() || last.empty() || planar::follow(m.plan, last, next, motion).arrived;
    if (there) planar::solve_motion(m.plan, now, motion);
    const bool done = there && motion.status == Status::done;
    if (done) last = next;
    if (done && forces_wanted)
      planar::solve_forces(m.linkage, m.plan, motion, r.rows.time[i], now[0].value, forces);
    if (i < r.run_length)
      r.records.push_back(planar::record_of(m.linkage, m.plan, motion,
                                            done && forces_wanted ? &forces : nullptr,
                                            time ? r.rows.time[i] : now.back().value));
    for (std::size_t g = 0; g < m.plan.groups.size() && done; ++g) {
      const planar::Group& group = m.plan.groups[g];
      if (!group.as<planar::Dyad>()) continue;
      const double angle = std::asin(std::min(1.0, std::abs(motion.groups[g].sine)));
      if (angle < r.transmission)
        r.transmission = angle, r.transmission_row = i, r.transmission_group = group.name;
    }
  }
  r.run_length = r.records.size();
}

}  // namespace

std::string unit_key(Kind kind) {
  switch (kind) {
    case Kind::point:
    case Kind::displacement:
      return "m";
    case Kind::angle:
      return "rad";
    case Kind::force:
      return "N";
    case Kind::torque:
      return "N_m";
  }
  return {};
}

std::string unit_label(Kind kind) { return kind == Kind::torque ? "N m" : unit_key(kind); }

Measured shown(Kind kind, double value) {
  return kind == Kind::force || kind == Kind::torque ? study::torque_or_force(value, kind == Kind::torque, 3)
                                                     : study::angle_or_length(value, kind == Kind::angle, 3);
}

double tolerance_range(const ToleranceStudy& s, std::size_t k) {
  const std::size_t pins = s.tolerances.pins.size();
  return k < pins ? s.tolerances.pins[k].clearance : s.tolerances.lengths[k - pins].tolerance;
}

double ToleranceRecording::root_mean_square(std::size_t sample, std::size_t q) const {
  double sum = 0;
  for (std::size_t k = 0; k < tolerances.size(); ++k) sum += mean_square(sample, q, k);
  return std::sqrt(sum);
}

double ToleranceRecording::worst(std::size_t q) const {
  return quantities[q].any ? linear[quantities[q].worst_row].worst_error[q] : nan;
}

std::vector<std::size_t> ToleranceRecording::by_share(std::size_t q) const {
  std::vector<std::size_t> order(tolerances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::size_t row = quantities[q].worst_row;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return contribution(row, q, a) > contribution(row, q, b);
  });
  return order;
}

std::string tolerance_input_key(const ToleranceStudy& s) {
  return std::holds_alternative<study::TimeSamples>(s.motion.sweep)
             ? "time_s"
             : planar::input_key(s.motion.linkage, s.motion.plan, s.motion.plan.inputs() - 1);
}

Sentence tolerance_place(const ToleranceStudy& s, const ToleranceRecording& r, std::size_t sample) {
  if (std::holds_alternative<study::TimeSamples>(s.motion.sweep))
    return at_place("time", seconds(r.rows.time[sample]));
  Sentence out;
  for (std::size_t k = 0; k < s.motion.plan.inputs(); ++k) {
    const double value = r.rows.inputs[sample][k].value;
    out += k ? ", " : "";
    out += planar::input_place(s.motion.linkage, s.motion.plan, k, value, 4);
  }
  return out;
}

ToleranceRecording record_tolerances(const ToleranceStudy& s, RunContext& context) {
  ToleranceRecording r;
  r.rows = planar::rows_of(s.motion);
  r.quantities = quantities_of(s.motion, s.outputs);
  r.tolerances = tolerance_names(s.motion.linkage, s.tolerances);
  const auto* grid = std::get_if<planar::InputGrid>(&s.motion.sweep);
  r.run_length = grid ? at(grid->inputs.back().samples) : r.rows.inputs.size();
  std::vector<planar::InputMotion> samples;
  for (const auto& row : r.rows.inputs) samples.insert(samples.end(), row.begin(), row.end());
  const planar::Linkage& l = s.motion.linkage;
  r.linear = clearance_sensitivity(l, s.tolerances, s.outputs, samples, r.rows.time, &context);
  // Interrupted: everything is reported of the samples that there are.
  r.rows.time.resize(r.linear.size());
  r.rows.inputs.resize(r.linear.size());
  r.run_length = std::min(r.run_length, r.linear.size());
  samples.resize(r.linear.size() * s.motion.plan.inputs());
  record_motion(s, r, !grid, context);
  r.random = clearance_monte_carlo(l, s.tolerances, s.outputs, samples, s.draws,
                                   static_cast<std::uint64_t>(s.seed), context, r.rows.time);
  for (std::size_t q = 0; q < r.quantities.size(); ++q) {
    ToleranceQuantity& quantity = r.quantities[q];
    for (std::size_t i = 0; i < r.linear.size(); ++i) {
      const double worst = r.linear[i].worst_error[q];
      // The first of those that are alike but for rounding, as at both ends of a full turn.
      if (std::isnan(worst) ||
          (quantity.any && worst <= r.linear[quantity.worst_row].worst_error[q] * (1 + 1e-6)))
        continue;
      quantity.worst_row = i;
      quantity.any = true;
    }
  }
  return r;
}

PathBand path_band(const ToleranceStudy& s, const ToleranceRecording& r, std::size_t point) {
  const std::size_t rows = r.linear.size(), pins = s.tolerances.pins.size(),
                    parameters = 2 * pins + s.tolerances.lengths.size(), i = r.quantities[point].first;
  const auto place = [&](std::size_t row) -> math::Vec2 {
    return {r.linear[row].values[i], r.linear[row].values[i + 1]};
  };
  PathBand band{std::vector<double>(rows, nan), std::vector<math::Vec2>(rows, {nan, nan})};
  for (std::size_t row = 0; row < rows; ++row) {
    // Neighbours along the last axis of a grid.
    const std::size_t in_run = row % r.run_length;
    std::size_t before = in_run > 0 ? row - 1 : row, after = in_run + 1 < r.run_length ? row + 1 : row;
    if (std::isnan(place(before).x)) before = row;
    if (std::isnan(place(after).x)) after = row;
    math::Vec2 way = place(after) - place(before);
    const double least = 1e-9 * s.motion.plan.size;
    // The neighbours of a point that turns back lie at one place.
    if (!(norm(way) > least)) way = place(after) - place(row);
    if (!(norm(way) > least)) continue;
    const math::Vec2 n = (1 / norm(way)) * perpendicular(way);
    const double *x = r.linear[row].derivatives.data() + i * parameters, *y = x + parameters;
    const auto across = [&](std::size_t j) { return n.x * x[j] + n.y * y[j]; };
    double error = 0;
    for (std::size_t k = 0; k < pins; ++k)
      error += s.tolerances.pins[k].clearance * std::hypot(across(2 * k), across(2 * k + 1));
    for (std::size_t k = 0; k < s.tolerances.lengths.size(); ++k)
      error += s.tolerances.lengths[k].tolerance * std::abs(across(2 * pins + k));
    band.across[row] = error;
    band.normal[row] = n;
  }
  return band;
}

study::Result run_tolerance_study(const ToleranceStudy& study, RunContext& context) {
  return report_tolerances(study, record_tolerances(study, context));
}

}  // namespace linkwright::clearance
