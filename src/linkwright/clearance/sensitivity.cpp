// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/sensitivity.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/checkpoint.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/differences.h"
#include "linkwright/optimise/pieces.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/quality.h"

namespace linkwright::clearance {
namespace {

using planar::InputMotion, planar::JointType, planar::Linkage, planar::LinkageMotion, planar::LinkagePlan;

void require_valid(const Linkage& l, const LinkageTolerances& t, const ToleranceOutputs& o,
                   std::size_t samples, std::size_t times) {
  const auto joint = [&](int j) -> const planar::LinkageJoint& {
    LINKWRIGHT_REQUIRE(j >= 0 && at(j) < l.joints.size(), "there is no joint {} among {}", j,
                       l.joints.size());
    return l.joints[at(j)];
  };
  for (const PinTolerance& p : t.pins) {
    LINKWRIGHT_REQUIRE(joint(p.joint).type == JointType::revolute, "joint '{}' is not a revolute joint",
                       joint(p.joint).name);
    LINKWRIGHT_REQUIRE(p.clearance >= 0 && std::isfinite(p.clearance), "joint '{}': clearance {} m",
                       joint(p.joint).name, p.clearance);
  }
  for (const LengthTolerance& e : t.lengths) {
    LINKWRIGHT_REQUIRE(e.body >= 0 && at(e.body) < l.bodies.size(), "there is no body {} among {}", e.body,
                       l.bodies.size());
    const planar::LinkageBody& b = l.bodies[at(e.body)];
    LINKWRIGHT_REQUIRE(e.from >= 0 && e.to >= 0 && at(std::max(e.from, e.to)) < b.points.size() &&
                           b.points[at(e.from)].at != b.points[at(e.to)].at,
                       "body '{}': points {} and {} have no distance", b.name, e.from, e.to);
    LINKWRIGHT_REQUIRE(e.tolerance >= 0 && std::isfinite(e.tolerance), "body '{}': tolerance {} m", b.name,
                       e.tolerance);
  }
  for (const planar::BodyPoint& p : o.points)
    LINKWRIGHT_REQUIRE(p.body >= 0 && at(p.body) < l.bodies.size() && p.point >= 0 &&
                           at(p.point) < l.bodies[at(p.body)].points.size(),
                       "there is no point {} of body {}", p.point, p.body);
  for (const int j : o.coordinates)
    LINKWRIGHT_REQUIRE(joint(j).type == JointType::revolute || joint(j).type == JointType::prismatic,
                       "joint '{}' has no coordinate", joint(j).name);
  for (const int j : o.forces) joint(j);
  LINKWRIGHT_REQUIRE(!l.driven.empty() && samples % l.driven.size() == 0, "{} motions for {} inputs", samples,
                     l.driven.size());
  LINKWRIGHT_REQUIRE(times == 0 || times * l.driven.size() == samples, "{} times for {} samples", times,
                     samples / l.driven.size());
}

// The linkage with offsets of its pins, in the frames of their first bodies, and errors of its lengths: pairs
// of numbers for pins, then one a length.
Linkage changed(const Linkage& l, const LinkageTolerances& t, std::span<const double> by) {
  Linkage out = l;
  for (std::size_t k = 0; k < t.lengths.size(); ++k) {
    const LengthTolerance& e = t.lengths[k];
    std::vector<planar::LinkagePoint>& points = out.bodies[at(e.body)].points;
    const std::complex<double> way =
        l.bodies[at(e.body)].points[at(e.to)].at - l.bodies[at(e.body)].points[at(e.from)].at;
    points[at(e.to)].at += by[2 * t.pins.size() + k] * way / std::abs(way);
  }
  for (std::size_t k = 0; k < t.pins.size(); ++k) {
    planar::LinkageJoint& j = out.joints[at(t.pins[k].joint)];
    planar::LinkageBody& body = out.bodies[at(j.first.body)];
    // A point of its own: other joints may use the same one.
    planar::LinkagePoint moved = body.points[at(j.first.point)];
    moved.name += " of " + j.name + " " + std::to_string(k);
    moved.at += std::complex<double>(by[2 * k], by[2 * k + 1]);
    j.first.point = static_cast<int>(body.points.size());
    body.points.push_back(moved);
  }
  return out;
}

// Solves a linkage at all samples, each from the nominal motion there, so that it stays in its assembly mode.
class Solver {
 public:
  // Fewer samples than given when the run is to stop; those below `between_looks` always.
  Solver(const Linkage& l, const ToleranceOutputs& o, std::span<const InputMotion> samples,
         std::span<const double> times, const RunContext* context)
      : outputs_(o), samples_(samples), times_(times), forces_wanted_(!o.forces.empty() || o.drives) {
    planar::PlanResult result = planar::plan_linkage(l);
    LINKWRIGHT_REQUIRE(result.problems.empty(), "the linkage cannot be planned: {}",
                       to_string(result.problems.front().message));
    plan_ = std::move(result.plan);
    const std::size_t inputs = plan_.inputs();
    LinkageMotion motion(plan_);
    std::vector<double> before;
    constexpr std::size_t between_looks = 1024;
    for (std::size_t s = 0; s * inputs < samples.size(); ++s) {
      if (context && s > 0 && s % between_looks == 0 && context->interrupted()) break;
      const auto now = samples.subspan(s * inputs, inputs);
      std::vector<double> values;
      for (const InputMotion& m : now) values.push_back(m.value);
      if (!plan_.closed_form() && s > 0) planar::follow(plan_, before, values, motion);
      planar::solve_motion(plan_, now, motion);
      before = values;
      status_.push_back(motion.status);
      parts_.push_back(motion.parts);
      modes_ = motion.modes;
      values_.emplace_back();
      if (motion.status == Status::done) values_.back() = read(l, plan_, motion, s, {});
    }
  }

  std::size_t samples() const { return status_.size(); }
  Status status(std::size_t s) const { return status_[s]; }
  const std::vector<double>& values(std::size_t s) const { return values_[s]; }
  /// Direction of the frame of a body in the nominal motion.
  math::Vec2 direction(std::size_t s, int body) const {
    const planar::BodyOnPart& on = plan_.bodies[at(body)];
    return math::rotate(parts_[s][at(on.part)].direction, on.turn);
  }
  double size() const { return plan_.size; }

  /// Values of another linkage of the same structure at the samples first, ..., last - 1, empty where there
  /// are none; no sample at all when the run is to stop.
  std::vector<std::vector<double>> of(const Linkage& l, std::size_t first, std::size_t last,
                                      const RunContext* context = nullptr) const {
    constexpr std::size_t between_looks = 64;
    const planar::PlanResult other = planar::plan_linkage(l);
    std::vector<std::vector<double>> out(last - first);
    if (!other.problems.empty()) return out;
    LinkageMotion motion(other.plan);
    motion.modes = modes_;
    const std::size_t inputs = plan_.inputs();
    for (std::size_t s = first; s < last; ++s) {
      if (context && s % between_looks == between_looks - 1 && context->interrupted()) return {};
      if (status_[s] != Status::done) continue;
      motion.parts = parts_[s];
      const auto now = samples_.subspan(s * inputs, inputs);
      planar::solve_motion(other.plan, now, motion);
      if (motion.status == Status::done) out[s - first] = read(l, other.plan, motion, s, values_[s]);
    }
    return out;
  }

 private:
  std::vector<double> read(const Linkage& l, const LinkagePlan& plan, const LinkageMotion& motion,
                           std::size_t sample, std::span<const double> near) const {
    std::vector<double> out;
    for (const planar::BodyPoint& p : outputs_.points) {
      const auto place = planar::point_motion(l, plan, motion, p).position;
      out.push_back(place.x);
      out.push_back(place.y);
    }
    for (const int j : outputs_.coordinates) {
      const double value = planar::joint_motion(l, plan, motion, j).value;
      const bool turns = l.joints[at(j)].type == JointType::revolute;
      out.push_back(turns && !near.empty()
                        ? near[out.size()] + math::angle_difference(value, near[out.size()])
                        : value);
    }
    if (forces_wanted_) {
      planar::LinkageForces forces;
      planar::solve_forces(l, plan, motion, times_.empty() ? 0 : times_[sample],
                           samples_[sample * plan.inputs()].value, forces);
      for (const int j : outputs_.forces) {
        out.push_back(forces.joints[at(j)].force.x);
        out.push_back(forces.joints[at(j)].force.y);
      }
      if (outputs_.drives) out.insert(out.end(), forces.drives.begin(), forces.drives.end());
    }
    return out;
  }

  const ToleranceOutputs& outputs_;
  std::span<const InputMotion> samples_;
  std::span<const double> times_;
  bool forces_wanted_;
  LinkagePlan plan_;
  std::vector<Status> status_;
  std::vector<std::vector<planar::PartState<double>>> parts_;
  std::vector<double> modes_;
  std::vector<std::vector<double>> values_;
};

// Error of a quantity of `size` values, 1 or 2, whose derivatives are `rows`: in the worst direction n the
// tolerances together reach the sum of c |J' n| over pins and t |j' n| over lengths, and their extreme errors
// add up to a vector whose direction is no worse than n. From a coarse search that climbs to the top.
void worst_error(const LinkageTolerances& t, const double* rows, std::size_t parameters, std::size_t size,
                 double* contributions, double* total) {
  const std::size_t pins = t.pins.size();
  const auto along = [&](const math::Vec2& n, std::size_t j) {
    return n.x * rows[j] + (size == 2 ? n.y * rows[parameters + j] : 0);
  };
  // The extreme errors for a direction, summed up; the part of each in that direction.
  const auto extreme = [&](const math::Vec2& n) {
    math::Vec2 sum{0, 0};
    const auto add = [&](std::size_t j, double by) {
      sum.x += by * rows[j];
      if (size == 2) sum.y += by * rows[parameters + j];
    };
    for (std::size_t k = 0; k < pins; ++k) {
      const double a = along(n, 2 * k), b = along(n, 2 * k + 1), slope = std::hypot(a, b);
      contributions[k] = t.pins[k].clearance * slope;
      if (!(slope > 0)) continue;
      add(2 * k, t.pins[k].clearance * a / slope);
      add(2 * k + 1, t.pins[k].clearance * b / slope);
    }
    for (std::size_t k = 0; k < t.lengths.size(); ++k) {
      const double a = along(n, 2 * pins + k);
      contributions[pins + k] = t.lengths[k].tolerance * std::abs(a);
      add(2 * pins + k, std::copysign(t.lengths[k].tolerance, a));
    }
    return sum;
  };
  math::Vec2 best{1, 0}, sum = extreme(best);
  if (size == 2) {
    constexpr int directions = 32;  // directions in half a turn: the other half is the same
    for (int i = 1; i < directions; ++i) {
      const math::Vec2 n = math::unit(pi * i / directions), s = extreme(n);
      if (dot(n, s) > dot(best, extreme(best))) best = n, sum = s;
    }
    for (int i = 0; i < 100 && norm(sum) > 0; ++i) {
      const math::Vec2 next = (1 / norm(sum)) * sum;
      const bool there = norm(next - best) < 1e-9;  // the error is stationary: right to rounding
      best = next;
      sum = extreme(best);
      if (there) break;
    }
    extreme(best);
  }
  *total = 0;
  for (std::size_t k = 0; k < pins + t.lengths.size(); ++k) *total += contributions[k];
}

// Values of each quantity: two of a vector.
std::vector<std::size_t> quantity_sizes(const Linkage& l, const ToleranceOutputs& o) {
  std::vector<std::size_t> out(o.points.size(), 2);
  out.insert(out.end(), o.coordinates.size(), 1);
  out.insert(out.end(), o.forces.size(), 2);
  if (o.drives) out.insert(out.end(), l.driven.size(), 1);
  return out;
}

}  // namespace

std::size_t value_count(const Linkage& l, const ToleranceOutputs& o) {
  return 2 * o.points.size() + o.coordinates.size() + 2 * o.forces.size() + (o.drives ? l.driven.size() : 0);
}

std::size_t quantity_count(const Linkage& l, const ToleranceOutputs& o) {
  return o.points.size() + o.coordinates.size() + o.forces.size() + (o.drives ? l.driven.size() : 0);
}

std::vector<SensitivitySample> clearance_sensitivity(const Linkage& l, const LinkageTolerances& t,
                                                     const ToleranceOutputs& o,
                                                     std::span<const InputMotion> samples,
                                                     std::span<const double> times,
                                                     const RunContext* context) {
  require_valid(l, t, o, samples.size(), times.size());
  const Solver solver(l, o, samples, times, context);
  const std::size_t pins = t.pins.size(), parameters = 2 * pins + t.lengths.size(),
                    values = value_count(l, o);
  const std::vector<std::size_t> sizes = quantity_sizes(l, o);
  std::vector<SensitivitySample> out(solver.samples());
  for (std::size_t s = 0; s < out.size(); ++s) {
    out[s].status = solver.status(s);
    out[s].values = solver.values(s);
    out[s].values.resize(values, nan);
    out[s].derivatives.assign(values * parameters, nan);
  }
  const double h = math::difference_step(solver.size());
  std::vector<double> by(parameters, 0.0);
  // Block by block of samples, so that whole samples are there when the run is to stop.
  constexpr std::size_t solved_between_looks = 4096;
  const std::size_t block =
      std::max<std::size_t>(1, solved_between_looks / std::max<std::size_t>(1, parameters));
  for (std::size_t first = 0; first < out.size(); first += block) {
    if (context && first > 0 && context->interrupted()) {
      out.resize(first);
      break;
    }
    const std::size_t last = std::min(out.size(), first + block);
    for (std::size_t j = 0; j < parameters; ++j) {
      by[j] = h;
      const auto more = solver.of(changed(l, t, by), first, last);
      by[j] = -h;
      const auto less = solver.of(changed(l, t, by), first, last);
      by[j] = 0;
      for (std::size_t s = first; s < last; ++s) {
        const std::vector<double>&above = more[s - first], &below = less[s - first];
        if (out[s].status != Status::done) continue;
        if (above.empty() || below.empty()) {
          out[s].status = Status::infeasible;
          continue;
        }
        for (std::size_t i = 0; i < values; ++i)
          out[s].derivatives[i * parameters + j] = (above[i] - below[i]) / (2 * h);
      }
    }
  }
  for (std::size_t s = 0; s < out.size(); ++s) {
    SensitivitySample& now = out[s];
    // From the frames of the first bodies to the global one.
    for (std::size_t k = 0; k < pins && now.status == Status::done; ++k) {
      const math::Vec2 d = solver.direction(s, l.joints[at(t.pins[k].joint)].first.body);
      for (std::size_t i = 0; i < values; ++i) {
        double* pair = &now.derivatives[i * parameters + 2 * k];
        const math::Vec2 global = math::rotate(d, math::Vec2{pair[0], pair[1]});
        pair[0] = global.x, pair[1] = global.y;
      }
    }
    for (std::size_t i = 0; i < values; ++i) {
      const double* row = now.derivatives.data() + i * parameters;  // there may be none
      double worst = 0, variance = 0;
      for (std::size_t k = 0; k < pins; ++k) {
        const double change = t.pins[k].clearance * std::hypot(row[2 * k], row[2 * k + 1]);
        worst += change;
        variance += change * change / 2;
      }
      for (std::size_t k = 0; k < t.lengths.size(); ++k) {
        const double change = t.lengths[k].tolerance * std::abs(row[2 * pins + k]);
        worst += change;
        variance += change * change / 3;
      }
      now.worst.push_back(worst);
      now.deviation.push_back(std::sqrt(variance));
    }
    const std::size_t tolerances = pins + t.lengths.size();
    now.worst_error.resize(sizes.size());
    now.contributions.resize(sizes.size() * tolerances);
    now.mean_squares.resize(sizes.size() * tolerances);
    for (std::size_t q = 0, i = 0; q < sizes.size(); i += sizes[q++]) {
      const double* rows = now.derivatives.data() + i * parameters;
      worst_error(t, rows, parameters, sizes[q], now.contributions.data() + q * tolerances,
                  &now.worst_error[q]);
      for (std::size_t k = 0; k < tolerances; ++k) {
        const bool pin = k < pins;
        double squares = 0;
        for (std::size_t r = 0; r < sizes[q]; ++r) {
          const double* row = rows + r * parameters + (pin ? 2 * k : pins + k);
          squares += row[0] * row[0] + (pin ? row[1] * row[1] : 0);
        }
        const double range = pin ? t.pins[k].clearance : t.lengths[k - pins].tolerance;
        now.mean_squares[q * tolerances + k] = range * range * squares / (pin ? 2 : 3);
      }
    }
  }
  return out;
}

namespace {

/// The statistics of some draws. Deviations are Welford's sums of squares until all pieces are together.
struct DrawnPiece {
  int draws = 0;
  std::vector<MonteCarloSample> samples;
  std::vector<int> missed;
  std::vector<double> largest;

  DrawnPiece(std::size_t count, std::size_t values, std::size_t quantities)
      : samples(count, {.assembled = 0,
                        .mean = std::vector<double>(values, 0),
                        .deviation = std::vector<double>(values, 0),
                        .least = std::vector<double>(values, infinity),
                        .most = std::vector<double>(values, -infinity),
                        .worst_error = std::vector<double>(quantities, 0)}) {}
};

template <class Sample, class Visit>
void each_list(Sample& s, Visit&& visit) {
  for (auto* list : {&s.mean, &s.deviation, &s.least, &s.most, &s.worst_error}) visit(*list);
}

Value kept(const DrawnPiece& piece) {
  std::vector<double> numbers;
  for (const MonteCarloSample& s : piece.samples) {
    numbers.push_back(s.assembled);
    each_list(s, [&](const auto& list) { numbers.insert(numbers.end(), list.begin(), list.end()); });
  }
  numbers.insert(numbers.end(), piece.missed.begin(), piece.missed.end());
  numbers.insert(numbers.end(), piece.largest.begin(), piece.largest.end());
  return pack_numbers(numbers);
}

/// `piece` has the room, `draws` is what it must hold.
void restore(DrawnPiece& piece, const Value& value, std::string_view what, int draws,
             std::size_t quantities) {
  const std::vector<double> numbers = unpack_numbers(value, what);
  std::size_t wanted = at(draws) * (1 + quantities);
  for (MonteCarloSample& s : piece.samples) {
    ++wanted;
    each_list(s, [&](const auto& list) { wanted += list.size(); });
  }
  if (numbers.size() != wanted)
    throw CheckpointError(fmt::format("{}: holds {} numbers, must be {}", what, numbers.size(), wanted));
  auto next = numbers.begin();
  const auto count = [&](std::size_t most) {
    const double n = *next++;
    if (!(n >= 0 && n <= static_cast<double>(most) && n == std::floor(n)))
      throw CheckpointError(fmt::format("{}: {} is not a number of linkages", what, n));
    return static_cast<int>(n);
  };
  for (MonteCarloSample& s : piece.samples) {
    s.assembled = count(at(draws));
    each_list(s, [&](auto& list) {
      std::copy_n(next, list.size(), list.begin());
      next += static_cast<std::ptrdiff_t>(list.size());
    });
  }
  for (int d = 0; d < draws; ++d) piece.missed.push_back(count(piece.samples.size()));
  piece.largest.assign(next, numbers.end());
  piece.draws = draws;
}

/// Puts statistics of two sets of draws together (Chan, Golub and LeVeque 1979).
void join(MonteCarloSample& all, const MonteCarloSample& more) {
  if (more.assembled == 0) return;
  const double a = all.assembled, b = more.assembled, n = a + b;
  for (std::size_t i = 0; i < all.mean.size(); ++i) {
    const double off = more.mean[i] - all.mean[i];
    all.mean[i] += off * b / n;
    all.deviation[i] += more.deviation[i] + off * off * a * b / n;
    all.least[i] = std::min(all.least[i], more.least[i]);
    all.most[i] = std::max(all.most[i], more.most[i]);
  }
  for (std::size_t q = 0; q < all.worst_error.size(); ++q)
    all.worst_error[q] = std::max(all.worst_error[q], more.worst_error[q]);
  all.assembled += more.assembled;
}

}  // namespace

MonteCarloResult clearance_monte_carlo(const Linkage& l, const LinkageTolerances& t,
                                       const ToleranceOutputs& o, std::span<const InputMotion> samples,
                                       int draws, std::uint64_t seed, RunContext& context,
                                       std::span<const double> times) {
  require_valid(l, t, o, samples.size(), times.size());
  LINKWRIGHT_REQUIRE(draws >= 1, "needs 1 draw at least, got {}", draws);
  const Solver solver(l, o, samples, times, &context);
  const std::size_t pins = t.pins.size(), values = value_count(l, o);
  const std::vector<std::size_t> sizes = quantity_sizes(l, o);
  const std::size_t rows = samples.size() / l.driven.size();
  // Number of pieces: as many as threads and machines can use, if their statistics fit into memory.
  constexpr double max_bytes = 1e8;
  const double bytes = static_cast<double>(sizeof(double) * rows * (4 * values + sizes.size() + 1));
  const int max_pieces = static_cast<int>(std::clamp(max_bytes / bytes, 8.0, 1024.0));
  const int size = (draws + max_pieces - 1) / max_pieces;
  const auto count = at((draws + size - 1) / size);
  const auto draws_of = [&](std::size_t k) { return std::min(size, draws - static_cast<int>(k) * size); };
  std::vector<std::optional<DrawnPiece>> pieces(count);
  const auto name = [](std::size_t k) { return fmt::format("linkages {}", k + 1); };

  const auto draw = [&](DrawnPiece& piece, int index) {
    RandomStream random({.seed = seed, .individual = static_cast<std::uint32_t>(index)});
    std::vector<double> by(2 * pins + t.lengths.size());
    for (std::size_t k = 0; k < pins; ++k) {
      const double angle = random.uniform(0, 2 * pi);
      by[2 * k] = t.pins[k].clearance * std::cos(angle);
      by[2 * k + 1] = t.pins[k].clearance * std::sin(angle);
    }
    for (std::size_t k = 0; k < t.lengths.size(); ++k)
      by[2 * pins + k] = t.lengths[k].tolerance * random.uniform(-1, 1);
    const auto drawn = solver.of(changed(l, t, by), 0, solver.samples(), &context);
    if (drawn.empty()) return false;
    piece.missed.push_back(0);
    piece.largest.resize(piece.largest.size() + sizes.size(), 0);
    double* largest = piece.largest.data() + at(piece.draws) * sizes.size();
    ++piece.draws;
    for (std::size_t s = 0; s < drawn.size(); ++s) {
      if (drawn[s].empty()) {
        if (solver.status(s) == Status::done) ++piece.missed.back();
        continue;
      }
      MonteCarloSample& now = piece.samples[s];
      ++now.assembled;
      for (std::size_t i = 0; i < values; ++i) {  // Welford's sums
        const double value = drawn[s][i], off = value - now.mean[i];
        now.mean[i] += off / now.assembled;
        now.deviation[i] += off * (value - now.mean[i]);
        now.least[i] = std::min(now.least[i], value);
        now.most[i] = std::max(now.most[i], value);
      }
      for (std::size_t q = 0, i = 0; q < sizes.size(); i += sizes[q++]) {
        const double first = drawn[s][i] - solver.values(s)[i],
                     error = sizes[q] == 2 ? std::hypot(first, drawn[s][i + 1] - solver.values(s)[i + 1])
                                           : std::abs(first);
        now.worst_error[q] = std::max(now.worst_error[q], error);
        largest[q] = std::max(largest[q], error);
      }
    }
    return true;
  };

  const optimise::PieceLoop loop = optimise::for_each_piece(
      count, context, "monte_carlo", name,
      [&](std::size_t k) {
        DrawnPiece& piece = pieces[k].emplace(rows, values, sizes.size());
        for (int d = 0; d < draws_of(k) && !context.interrupted(); ++d)
          if (!draw(piece, static_cast<int>(k) * size + d)) break;
        return infinity;
      },
      [&](std::size_t k) { return pieces[k]->draws == draws_of(k) ? kept(*pieces[k]) : Value(); },
      [&](std::size_t k, const Value& value) {
        restore(pieces[k].emplace(rows, values, sizes.size()), value, name(k), draws_of(k), sizes.size());
        return infinity;
      });
  MonteCarloResult out;
  out.samples = DrawnPiece(rows, values, sizes.size()).samples;
  for (const std::optional<DrawnPiece>& piece : pieces) {
    if (!piece) continue;
    out.draws += piece->draws;
    out.missed.insert(out.missed.end(), piece->missed.begin(), piece->missed.end());
    out.largest.insert(out.largest.end(), piece->largest.begin(), piece->largest.end());
    for (std::size_t s = 0; s < rows; ++s) join(out.samples[s], piece->samples[s]);
  }
  if (out.draws < draws) out.status = loop.status;
  for (MonteCarloSample& s : out.samples)
    for (double& d : s.deviation) d = s.assembled > 1 ? std::sqrt(d / (s.assembled - 1)) : 0;
  return out;
}

}  // namespace linkwright::clearance
