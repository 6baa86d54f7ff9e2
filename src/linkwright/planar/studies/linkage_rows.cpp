// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_rows.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/core/tolerance.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/redundant.h"
#include "linkwright/planar/linkage/scan.h"
#include "linkwright/planar/linkage/smooth_branch.h"
#include "linkwright/planar/studies/linkage_holding.h"
#include "linkwright/planar/studies/linkage_path.h"

namespace linkwright::planar {
namespace {

double sample_at(double from, double to, int samples, int i) {
  const double value = from + (to - from) * i / (samples - 1);
  // Where the range crosses zero, a sample is zero and not the rounding of its ends.
  return std::abs(value) <= 4 * tolerance::epsilon * std::max(std::abs(from), std::abs(to)) ? 0 : value;
}

}  // namespace

bool over_time(const LinkageStudy& s) { return std::holds_alternative<study::TimeSamples>(s.sweep); }

std::vector<LinkageColumn> columns_of(const LinkageStudy& s) {
  std::vector<LinkageColumn> out;
  if (over_time(s)) out.push_back({"time_s", "time (s)", [](const LinkageInstant& i) { return i.time; }});
  for (std::size_t k = 0; k < s.plan.inputs(); ++k)
    out.push_back({input_key(s.linkage, s.plan, k), input_label(s.linkage, s.plan, k),
                   [k](const LinkageInstant& i) { return i.inputs[k].value; }});
  for (LinkageColumn& c : out) c.needs = LinkageColumn::Needs::nothing;
  for (LinkageColumn& c : linkage_columns(s.linkage, s.plan, s.quantities, s.traces))
    out.push_back(std::move(c));
  if (s.path) add_drive_motion_columns(s, out);
  if (s.holding) add_holding_columns(s, out);
  return out;
}

LinkageRows rows_of(const LinkageStudy& s) {
  if (s.path) return path_rows(s);
  LinkageRows rows;
  if (const auto* times = std::get_if<study::TimeSamples>(&s.sweep)) {
    std::vector<math::MotionCurve> curves;
    for (const LinkageDrive& d : s.drives) curves.emplace_back(*d.law);
    for (int i = 0; i < times->samples; ++i) {
      rows.time.push_back(sample_at(times->from, times->to, times->samples, i));
      rows.inputs.emplace_back();
      for (const math::MotionCurve& c : curves) {
        const math::Motion m = c(rows.time.back());
        rows.inputs.back().push_back({m.value, m.rate, m.acceleration});
      }
    }
    return rows;
  }
  const InputGrid& grid = std::get<InputGrid>(s.sweep);
  std::vector<int> index(grid.inputs.size(), 0);
  while (true) {
    rows.time.push_back(0);
    rows.inputs.emplace_back();
    for (std::size_t k = 0; k < index.size(); ++k) {
      const InputSamples& a = grid.inputs[k];
      rows.inputs.back().push_back(
          {sample_at(a.from, a.to, a.samples, index[k]), s.drives[k].rate, s.drives[k].acceleration});
    }
    std::size_t k = index.size();
    while (k-- > 0)
      if (++index[k] < grid.inputs[k].samples)
        break;
      else
        index[k] = 0;
    if (k == static_cast<std::size_t>(-1)) return rows;
  }
}

RowSolver::RowSolver(const LinkageStudy& s, const LinkageRows& rows)
    : motion(s.plan),
      now{.motion = &motion, .forces = &forces},
      s_(s),
      rows_(rows),
      assembly_(s.plan, reach_of(rows.inputs), s.at_change_point, over_time(s)) {
  limits = assembly_.limits();
  const auto pairs = std::count_if(s.plan.groups.begin(), s.plan.groups.end(),
                                   [](const Group& g) { return traits_of(g).has_modes; });
  if (s.plan.inputs() != 1 || over_time(s) || !s.plan.closed_form() || pairs > 6) return;
  const InputSamples& axis = std::get<InputGrid>(s.sweep).inputs[0];
  const std::vector<double> inputs{axis.from};
  const bool turn = s.plan.rotary[0] && periodic(s.plan, 0);
  const double low = std::min(axis.from, axis.to), high = std::max(axis.from, axis.to);
  limits = turn ? input_limits(s.plan, inputs, 0, -pi, pi) : input_limits(s.plan, inputs, 0, low, high);
  const bool choice = std::any_of(limits->ranges.begin(), limits->ranges.end(), [](const InputRange& r) {
    return r.from.kind == EndKind::change_point || r.to.kind == EndKind::change_point;
  });
  if (choice)
    branch = branch_path(s.plan, inputs, 0, motion.modes, low, high, s.at_change_point);
  else if (s.circuits == CircuitRows::reached)
    find_circuit(low, high);
}

// The circuit of the drawing, or of the first row that assembles. Circuits may meet beyond the rows.
void RowSolver::find_circuit(double low, double high) {
  const std::vector<double>& drawn = s_.plan.drawn_inputs;
  if (!limits->closed) {
    const double beyond = s_.plan.rotary[0] ? full_turn : 4 * s_.plan.size;
    const double start = drawn.empty() ? low : drawn[0];
    circuits_ = input_limits(s_.plan, std::vector<double>{low}, 0, std::min(low, start) - beyond,
                             std::max(high, start) + beyond);
  } else {
    circuits_ = limits;
  }
  const InputRange* range = drawn.empty() ? nullptr : range_at(*circuits_, motion.modes, drawn[0]);
  for (std::size_t r = 0; r < rows_.inputs.size() && !range; ++r)
    range = range_at(*circuits_, motion.modes, rows_.inputs[r][0].value);
  if (range)
    circuit_ = range->circuit;
  else
    circuits_.reset();
}

bool RowSolver::on_other_circuit(double value) const {
  if (!circuits_) return false;
  const InputRange* range = range_at(*circuits_, motion.modes, value);
  return range && range->circuit != circuit_;
}

Status RowSolver::solve(std::size_t r) {
  now.time = rows_.time[r];
  now.inputs = rows_.inputs[r];
  bool there = true;
  if (branch && branch->status == Status::done)
    there = modes_at(*branch, now.inputs[0].value, motion.modes) == Status::done;
  if (!there) motion.status = Status::limit_reached;
  if (there && on_other_circuit(now.inputs[0].value)) {
    there = false;
    motion.status = Status::other_circuit;
  }
  if (there) {
    assembly_.place(now.inputs, motion);
    solve_velocity(s_.plan, now.inputs, motion);
    solve_acceleration(s_.plan, now.inputs, motion);
  }
  if (there && s_.redundant && motion.status == Status::done) check_redundant();
  const bool dynamic = s_.quantities.dynamic();
  if (dynamic) solve_forces(s_.linkage, s_.plan, motion, now.time, now.inputs[0].value, forces);
  if (dynamic && s_.redundant)
    spread_forces(s_.linkage, s_.plan, motion, s_.redundant->joint, s_.redundant->rule, forces);
  // At a change point the motion has a limit, but for the rates where it has a kink; forces may have
  // none.
  const bool kink = s_.at_change_point == AtChangePoint::keep_sign;
  passed = there && at_change() &&
           limit_at_change(s_.plan, *branch, now.inputs[0].value, now.inputs[0], motion,
                           dynamic && !kink ? &s_.linkage : nullptr, forces);
  if (passed && kink) forget_rates();
  if (rows_.path && rows_.path->rows[r].singular) motion.status = Status::singular;
  return motion.status != Status::done ? motion.status
         : passed && kink              ? Status::singular
         : dynamic                     ? forces.status
                                       : Status::done;
}

// Where the joint that is left out of the plan opens, the linkage does not assemble.
void RowSolver::check_redundant() {
  const double gap = relaxed_gap(s_.linkage, s_.plan, motion, s_.redundant->joint);
  motion.closure_residual = std::max(motion.closure_residual, gap);
  if (gap <= 1e-9 * s_.plan.size) return;
  motion.status = Status::no_assembly;
  motion.failed_group = -1;
  motion.gap = gap;
}

bool RowSolver::at_change() const {
  if (!branch || branch->status != Status::done || motion.status != Status::singular) return false;
  const auto here = [&](const RangeEnd& e) {
    const double apart = now.inputs[0].value - e.value;
    return e.kind == EndKind::change_point &&
           std::abs(limits->closed ? std::remainder(apart, 2 * pi) : apart) < 1e-6;
  };
  return here(branch->low) || here(branch->high) ||
         std::any_of(branch->change_points.begin(), branch->change_points.end(), here);
}

// Sets the rates of the moving parts to unknown; the ground is fixed, and nothing else would set its rates
// for the next row.
void RowSolver::forget_rates() {
  for (PartState<double>& s : std::span(motion.parts).subspan(1))
    s.velocity = s.acceleration = {nan, nan}, s.speed = s.angular_acceleration = nan;
}

Table linkage_table(const LinkageStudy& s, std::span<const std::string> wanted) {
  std::vector<LinkageColumn> columns = columns_of(s);
  if (!wanted.empty())
    std::erase_if(columns, [&](const LinkageColumn& c) {
      return std::find(wanted.begin(), wanted.end(), c.key) == wanted.end();
    });
  const LinkageRows rows = rows_of(s);
  RowSolver solver(s, rows);
  Table table{.name = "sweep"};
  for (const LinkageColumn& c : columns)
    table.add(c.key, c.label, std::vector<double>(rows.inputs.size(), nan));
  for (std::size_t r = 0; r < rows.inputs.size(); ++r) {
    table.status.emplace_back(to_string(solver.solve(r)));
    for (std::size_t c = 0; c < columns.size(); ++c)
      table.columns[c].values[r] = value_of(columns[c], solver.now);
  }
  for (std::size_t c = 0; c < columns.size(); ++c) unwrap(columns[c], table.columns[c].values);
  return table;
}

}  // namespace linkwright::planar
