// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/dense.h"
#include "linkwright/planar/linkage/stop.h"
#include "linkwright/planar/simulation/detail/simulation_run.h"

// Rigid stops in a simulation: impacts, and joints that stay on their stops while these have to push.
namespace linkwright::planar {
namespace {

// Impacts that come to their end within this share of the time of the simulation are passed.
constexpr double passed_share = 1e-7;
// A rate of a gap is zero below this share of the largest one so far.
constexpr double zero_gap_rate = 1e-9;
// A closed stop may pull with this share of its largest effort, which is rounding.
constexpr double pull_share = 1e-11;
constexpr std::size_t kept_stop_events = 10000;
// Of a stop that gives way, LinkageMotion::stops says that its joint touches it.
constexpr double touching = 1;
// A stop moves its joint less than this share of what it would without friction: friction holds it.
constexpr double held_share = 1e-7;
// So many events of stops at one time end the run.
constexpr int most_events_at_once = 100;

double largest_of(std::span<const double> values) {
  double out = 0;
  for (const double v : values) out = std::max(out, std::abs(v));
  return out;
}

// What `matrix` z + `offset` has left.
std::vector<double> gaps_of(std::span<const double> matrix, std::span<const double> offset,
                            std::span<const double> z) {
  std::vector<double> out(offset.begin(), offset.end());
  const std::size_t n = offset.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k) out[i] += matrix[i * n + k] * z[k];
  return out;
}

// The solution z >= 0, w = matrix z + offset >= 0, z w = 0 of a symmetric positive semidefinite matrix. Few
// unknowns: all choices of the positive ones are tried. Many: they are improved one at a time, which
// converges, to fewer digits.
std::vector<double> complementary(std::span<const double> matrix, std::span<const double> offset) {
  constexpr std::size_t few = 10;
  constexpr double rounding = 1e-11;
  const std::size_t n = offset.size();
  const double scale = largest_of(offset);
  std::vector<double> z(n, 0.0);
  for (std::size_t choice = 0; n <= few && choice < (std::size_t{1} << n); ++choice) {
    std::vector<std::size_t> in;
    for (std::size_t k = 0; k < n; ++k)
      if (choice >> k & 1) in.push_back(k);
    std::vector<double> part, right;
    for (const std::size_t k : in) {
      right.push_back(-offset[k]);
      for (const std::size_t i : in) part.push_back(matrix[i * n + k]);
    }
    std::fill(z.begin(), z.end(), 0.0);
    if (!in.empty()) {
      const std::vector<double> found = math::least_norm(part, in.size(), right, 1e-12).x;
      for (std::size_t i = 0; i < in.size(); ++i) z[in[i]] = found[i];
    }
    const std::vector<double> w = gaps_of(matrix, offset, z);
    const double least = -rounding * largest_of(z);
    bool good = true;
    for (std::size_t k = 0; k < n; ++k) {
      const bool positive = choice >> k & 1;
      good = good && z[k] >= least && (positive ? std::abs(w[k]) : -w[k]) <= rounding * scale;
    }
    if (!good) continue;
    for (double& v : z) v = std::max(v, 0.0);
    return z;
  }
  std::fill(z.begin(), z.end(), 0.0);
  for (int pass = 0; pass < 100000; ++pass) {
    double change = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (!(matrix[k * n + k] > 0)) continue;
      double w = offset[k];
      for (std::size_t i = 0; i < n; ++i) w += matrix[k * n + i] * z[i];
      const double next = std::max(0.0, z[k] - w / matrix[k * n + k]);
      change = std::max(change, std::abs(next - z[k]));
      z[k] = next;
    }
    if (change <= 1e-15 * largest_of(z)) break;
  }
  return z;
}

}  // namespace

Status Simulation::gap_accelerations(double t, std::span<const std::size_t> stops, std::vector<double>& out) {
  const Status status = dynamics_.solve(t, inputs_);
  if (status != Status::done) return status;
  solve_acceleration(plan_, inputs_, dynamics_.motion);
  out.clear();
  for (const std::size_t k : stops) out.push_back(stop_motion(l_, plan_, dynamics_.motion, k).acceleration);
  return status;
}

Status Simulation::measure_stops(double t, std::span<const std::size_t> stops,
                                 std::vector<double>& accelerations, std::vector<double>& matrix) {
  std::vector<double>& efforts = dynamics_.motion.stops;
  const std::size_t n = stops.size();
  matrix.assign(n * n, 0.0);
  Status status = gap_accelerations(t, stops, accelerations);
  std::vector<double> more;
  for (std::size_t k = 0; k < n && status == Status::done; ++k) {
    const double before = efforts[stops[k]], step = std::max(before, 1.0);
    efforts[stops[k]] += step;
    status = gap_accelerations(t, stops, more);
    efforts[stops[k]] = before;
    for (std::size_t i = 0; i < n && status == Status::done; ++i)
      matrix[i * n + k] = (more[i] - accelerations[i]) / step;
    // Where friction holds the joint as well its stop moves nothing, but for rounding.
    if (std::abs(matrix[k * n + k]) > held_share * contacts_[stops[k]].mobility) continue;
    for (std::size_t i = 0; i < n; ++i) matrix[i * n + k] = matrix[k * n + i] = 0;
  }
  return status == Status::done ? gap_accelerations(t, stops, accelerations) : status;
}

Status Simulation::solve_pressed(double t) {
  constexpr int passes = 30, refinements = 2;
  std::vector<double>& efforts = dynamics_.motion.stops;
  efforts.resize(contacts_.size(), 0.0);
  std::vector<std::size_t> closed;
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (rigid(k) && contacts_[k].closed)
      closed.push_back(k);
    else
      efforts[k] = contacts_[k].closed ? touching : 0;
  }
  if (closed.empty()) return dynamics_.solve(t, inputs_);
  const std::size_t n = closed.size();
  if (dynamics_.states && dynamics_.states->decide) {  // at the efforts that they are, before these change
    const Status decided = dynamics_.solve(t, inputs_);
    if (decided != Status::done) return decided;
    dynamics_.states->decide = false;
  }
  std::vector<double> accelerations, matrix;
  Status status = measure_stops(t, closed, accelerations, matrix);
  // Without friction the accelerations are affine in the efforts.
  for (int pass = 0; pass < passes && status == Status::done; ++pass) {
    double terms = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k)
        terms = std::max(terms, std::abs(matrix[i * n + k] * efforts[closed[k]]));
    if (largest_of(accelerations) <= 1e-13 * terms || (pass >= refinements && !friction_)) return status;
    if (pass > 0 && pass % 5 == 0) status = measure_stops(t, closed, accelerations, matrix);
    std::vector<double> columns(n * n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) columns[k * n + i] = matrix[i * n + k];
    const std::vector<double> change = math::least_norm(columns, n, accelerations, 1e-12).x;
    if (largest_of(change) == 0) return status;
    for (std::size_t i = 0; i < n; ++i) efforts[closed[i]] -= change[i];
    if (status == Status::done) status = gap_accelerations(t, closed, accelerations);
  }
  return status;
}

void Simulation::stop_values(double t, std::span<const double> y, std::span<double> values) {
  const bool placed = place_at(t, y, any_closed());
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    Contact& c = contacts_[k];
    if (placed) {
      const StopMotion now = stop_motion(l_, plan_, dynamics_.motion, k);
      const double push = rigid(k) ? 0 : -*l_.stops[k].stiffness * now.gap - l_.stops[k].damping * now.rate;
      if (!c.closed)
        c.stays = rigid(k) || now.gap >= 0 ? now.gap : -push;
      else
        c.stays = rigid(k) ? dynamics_.motion.stops[k] + pull_share * (1 + c.most_effort) : push;
    }
    values[k] = c.stays;
  }
}

std::vector<double> Simulation::gap_rates(double t, std::span<const std::size_t> stops,
                                          std::span<const double> y, double& energy) {
  put(t, y);
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  solve_position(plan_, inputs_, dynamics_.motion);
  solve_velocity(plan_, inputs_, dynamics_.motion);
  energy = kinetic_energy(plan_, dynamics_.motion);
  std::vector<double> out;
  for (const std::size_t k : stops) out.push_back(stop_motion(l_, plan_, dynamics_.motion, k).rate);
  return out;
}

bool Simulation::impact(double t, std::span<const std::size_t> stops, std::span<const double> restitutions,
                        std::span<double> y) {
  const std::size_t n = dynamics_.free().size(), m = stops.size();
  double energy = 0;
  const std::vector<double> before = gap_rates(t, stops, y, energy);
  std::vector<std::vector<double>> rows, answers;  // rates of the gaps by the inputs, and what impulses give
  put(t, y);
  solve_here(t);
  const std::vector<double> masses(dynamics_.inertia().begin(), dynamics_.inertia().end());
  for (std::size_t i = 0; i < m; ++i) {
    const JointStop& stop = l_.stops[stops[i]];
    rows.push_back(shares_of(stop.joint));
    double square = 0;
    for (double& share : rows.back()) share *= stop.side, square += share * share;
    if (square < 1e-20 && before[i] < 0) {
      pressed_ = static_cast<int>(stops[i]);
      return false;
    }
    answers.push_back(math::solve_symmetric(masses, rows.back()));
  }
  std::vector<double> matrix(m * m), offset;
  for (std::size_t i = 0; i < m; ++i) {
    offset.push_back(before[i] + restitutions[i] * std::min(before[i], 0.0));
    for (std::size_t k = 0; k < m; ++k)
      for (std::size_t f = 0; f < n; ++f) matrix[i * m + k] += rows[i][f] * answers[k][f];
    contacts_[stops[i]].mobility = matrix[i * m + i];
  }
  const std::vector<double> impulses = complementary(matrix, offset);
  for (std::size_t k = 0; k < m; ++k)
    for (std::size_t f = 0; f < n; ++f) y[n + f] += impulses[k] * answers[k][f];
  return true;
}

double Simulation::end_of_impacts(double t, std::size_t stop, double after, std::span<const double> y) {
  put(t, y);
  if (solve_here(t) != Status::done) return infinity;
  solve_acceleration(plan_, inputs_, dynamics_.motion);
  const double back = -stop_motion(l_, plan_, dynamics_.motion, stop).acceleration,
               restitution = l_.stops[stop].restitution;
  // Each flight takes 2 v / a and the next one begins with the restitution times v: a geometric series.
  return back > 0 && restitution < 1 ? t + 2 * after / back / (1 - restitution) : infinity;
}

void Simulation::close_stops(double t, std::span<const std::size_t> stops, std::span<double> y) {
  for (const std::size_t k : stops) contacts_[k].closed = false;
  put(t, y);
  dynamics_.motion.stops.resize(contacts_.size(), 0.0);
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (rigid(k) && !contacts_[k].closed) dynamics_.motion.stops[k] = 0;
  if (branch_) branch_->set_modes(inputs_[0].value, dynamics_.motion);
  std::vector<double> accelerations, matrix;
  if (measure_stops(t, stops, accelerations, matrix) != Status::done) return restore();
  const std::vector<double> efforts = complementary(matrix, accelerations),
                            left = gaps_of(matrix, accelerations, efforts);
  const double zero = 1e-12 * largest_of(accelerations);
  for (std::size_t i = 0; i < stops.size(); ++i) {
    contacts_[stops[i]].closed =
        efforts[i] > 0 || (std::abs(left[i]) <= zero && matrix[i * stops.size() + i] > 0);
    dynamics_.motion.stops[stops[i]] = efforts[i];
    contacts_[stops[i]].most_effort = std::max(contacts_[stops[i]].most_effort, efforts[i]);
  }
  hold_on_stops(t, y);
}

math::OdeAction Simulation::stop_event(double t, std::span<const std::size_t> which, std::span<double> y) {
  stops_at_once_ = t - stopped_at_ <= 1e-12 * std::max(span_, std::abs(t)) ? stops_at_once_ + 1 : 0;
  stopped_at_ = t;
  if (stops_at_once_ > most_events_at_once) {
    chattering_ = l_.stops[which.front()].joint;
    return math::OdeAction::stop;
  }
  std::vector<std::size_t> touched;
  std::vector<bool> was_closed;
  bool is_rigid = false;
  for (const Contact& c : contacts_) was_closed.push_back(c.closed);
  for (std::size_t k = 0; k < contacts_.size(); ++k)
    if (rigid(k) && was_closed[k]) touched.push_back(k);
  for (const std::size_t k : which) {
    is_rigid = is_rigid || rigid(k);
    if (rigid(k) && !was_closed[k]) touched.push_back(k);
    if (rigid(k)) continue;
    double energy = 0;
    const double rate = gap_rates(t, std::span(&k, 1), y, energy).front();
    contacts_[k].closed = !was_closed[k];
    note_stop({t, k, was_closed[k] ? StopChange::leaves : StopChange::rests, rate, rate, 0});
  }
  if (!is_rigid) return math::OdeAction::restart;
  double energy = 0, left = 0;
  const std::vector<double> before = gap_rates(t, touched, y, energy);
  std::vector<double> restitutions, start(y.begin(), y.end());
  for (std::size_t i = 0; i < touched.size(); ++i) {
    Contact& c = contacts_[touched[i]];
    c.largest = std::max(c.largest, std::abs(before[i]));
    restitutions.push_back(was_closed[touched[i]] ? 0 : l_.stops[touched[i]].restitution);
  }
  const bool hits = std::any_of(before.begin(), before.end(), [](double v) { return v < 0; });
  if (!impact(t, touched, restitutions, y)) return math::OdeAction::stop;
  // A joint that is an input is exactly at its stop.
  for (std::size_t f = 0; f < dynamics_.free().size(); ++f)
    for (const std::size_t k : touched)
      if (l_.driven[dynamics_.free()[f]] == l_.stops[k].joint) y[f] = start[f] = l_.stops[k].limit;
  std::vector<double> after = gap_rates(t, touched, y, left), ends(touched.size(), t);
  const auto stands = [&](std::size_t i) {
    return std::abs(after[i]) <= zero_gap_rate * contacts_[touched[i]].largest;
  };
  bool passes = false;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    if (stands(i) || after[i] < 0 || was_closed[touched[i]]) continue;
    const double end = end_of_impacts(t, touched[i], after[i], y);
    if (!(end - t <= passed_share * span_)) continue;
    restitutions[i] = 0, ends[i] = end;
    passes = true;
  }
  if (passes) {
    std::copy(start.begin(), start.end(), y.begin());
    impact(t, touched, restitutions, y);
    after = gap_rates(t, touched, y, left);
  }
  kinks_ += left - energy;
  std::vector<std::size_t> standing;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    contacts_[touched[i]].closed = false;
    if (stands(i)) standing.push_back(touched[i]);
  }
  // What stops hold needs no friction: joints at rest have none while it is found what is closed.
  if (friction_ && hits) rub_after_impact(t, y, standing.empty());
  if (!standing.empty()) close_stops(t, standing, y);
  if (friction_ && !standing.empty()) rub_after_impact(t, y, true);
  double lost = energy - left;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    const std::size_t k = touched[i];
    const bool closed = contacts_[k].closed;
    if ((closed && was_closed[k]) || (!closed && !was_closed[k] && before[i] >= 0)) continue;
    const StopChange change = closed          ? StopChange::rests
                              : was_closed[k] ? StopChange::leaves
                                              : StopChange::hits;
    note_stop({ends[i], k, change, before[i], after[i], change == StopChange::leaves ? 0 : lost});
    if (change != StopChange::leaves) lost = 0;
  }
  return math::OdeAction::restart;
}

void Simulation::hold_on_stops(double t, std::span<double> y) {
  constexpr int passes = 30;
  const auto free = dynamics_.free();
  const std::size_t n = free.size();
  std::vector<std::size_t> others;
  std::vector<bool> fixed(n, false);
  for (std::size_t k = 0; k < contacts_.size(); ++k) {
    if (!contacts_[k].closed) continue;
    bool input = false;
    for (std::size_t f = 0; f < n; ++f)
      if (l_.driven[free[f]] == l_.stops[k].joint) {
        y[f] = l_.stops[k].limit, y[n + f] = 0;
        fixed[f] = input = true;
      }
    if (!input) others.push_back(k);
  }
  if (others.empty()) return;
  double energy = 0;
  // One step of Newton's method for the places, which are off by rounding and the error of a step.
  for (const bool places : {true, false}) {
    std::vector<double> wrong = gap_rates(t, others, y, energy);
    if (dynamics_.motion.status != Status::done) return restore();
    if (places)
      for (std::size_t i = 0; i < others.size(); ++i)
        wrong[i] = stop_motion(l_, plan_, dynamics_.motion, others[i]).gap;
    std::vector<std::vector<double>> rows;
    for (const std::size_t k : others) {
      rows.push_back(shares_of(l_.stops[k].joint));
      for (std::size_t f = 0; f < n; ++f) rows.back()[f] *= fixed[f] ? 0 : l_.stops[k].side;
    }
    const std::span<double> state = y.subspan(places ? 0 : n, n);
    std::vector<double> change(n, 0.0);
    for (int pass = 0; pass < (others.size() == 1 ? 1 : passes); ++pass)
      for (std::size_t i = 0; i < others.size(); ++i) {
        double left = wrong[i], square = 0;
        for (std::size_t f = 0; f < n; ++f) left += rows[i][f] * change[f], square += rows[i][f] * rows[i][f];
        if (square < 1e-16) continue;
        for (std::size_t f = 0; f < n; ++f) change[f] -= left * rows[i][f] / square;
      }
    for (std::size_t f = 0; f < n; ++f) state[f] += change[f];
  }
}

void Simulation::note_stop(StopEvent event) {
  ++report_.stop_event_count;
  if (report_.stop_events.size() < kept_stop_events) report_.stop_events.push_back(event);
}

}  // namespace linkwright::planar
