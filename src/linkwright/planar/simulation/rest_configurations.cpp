// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/rest_configurations.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/math/dense.h"
#include "linkwright/planar/simulation/static_forces.h"

namespace linkwright::planar {
namespace {

constexpr double same_place = 1e-6;  // rad, or sizes of the linkage
constexpr std::size_t max_found = 200;

using Numbers = std::vector<double>;

class RestNewton {
 public:
  RestNewton(const Linkage& linkage, const LinkagePlan& plan, const RestGrid& grid)
      : forces_(linkage, plan, grid.free),
        grid_(grid),
        counted_(!linkage.torsion_springs.empty() || !linkage.counted_pins.empty()),
        all_(grid.inputs) {
    for (const std::size_t k : grid.free) {
      rotary_.push_back(plan.rotary[k]);
      unit_.push_back(plan.rotary[k] ? 1 : plan.size);
    }
  }

  std::size_t count() const { return unit_.size(); }
  double reach(std::size_t j) const { return rotary_[j] ? pi : 4 * unit_[j]; }

  bool solve(const Numbers& x) {
    for (std::size_t j = 0; j < x.size(); ++j) all_[grid_.free[j]] = x[j];
    if (forces_.solve(all_) != Status::done) return false;
    scale_ = std::max(scale_, forces_.scale);
    return true;
  }

  // A zero of the forces that is none of the known ones; nothing where the method does not come to one.
  std::optional<Numbers> search(Numbers x, const std::vector<Numbers>& known) {
    constexpr int max_steps = 80, max_halvings = 8;
    constexpr double longest = 0.5;  // units of an input
    if (!solve(x)) return std::nullopt;
    for (int i = 0; i < max_steps; ++i) {
      std::optional<Numbers> step = newton_step(x);
      if (!step) return std::nullopt;
      const double share = deflation(x, *step, known);
      double size = 0;
      for (std::size_t j = 0; j < x.size(); ++j) {
        (*step)[j] *= share;
        size = std::max(size, std::abs((*step)[j]) / unit_[j]);
      }
      if (!std::isfinite(size)) return std::nullopt;
      double part = std::min(1.0, longest / size);
      Numbers next = x;
      for (int h = 0; h <= max_halvings; ++h, part /= 2) {
        for (std::size_t j = 0; j < x.size(); ++j) next[j] = x[j] + part * (*step)[j];
        if (solve(next)) break;
        if (h == max_halvings) return std::nullopt;
      }
      x = next;
      if (size < 1e-9) return polished(std::move(x), known);
    }
    return std::nullopt;
  }

  RestConfiguration described(Numbers x) {
    RestConfiguration out;
    const std::size_t n = count();
    out.stiffness.resize(n * n);
    for (std::size_t k = 0; k < n; ++k) {
      const Numbers slope = slopes(x, k, 1e-3 * unit_[k], true);
      for (std::size_t j = 0; j < n; ++j) out.stiffness[j * n + k] = -slope[j];
    }
    solve(x);
    out.masses = forces_.masses();
    out.dampings = forces_.dampings();
    out.potential = forces_.potential();
    out.values = std::move(x);
    classify(out);
    return out;
  }

  double distance(const Numbers& a, const Numbers& b) const {
    double out = 0;
    for (std::size_t j = 0; j < a.size(); ++j) out = std::max(out, std::abs(apart(a[j], b[j], j)));
    return out;
  }
  // Within the reach of the search; angles of linkages without torsion springs repeat after a turn.
  std::optional<Numbers> within_reach(Numbers x) const {
    for (std::size_t j = 0; j < x.size(); ++j) {
      if (rotary_[j] && !counted_) x[j] = math::wrap_angle(x[j]);
      if (std::abs(x[j]) > reach(j) * (1 + 1e-9)) return std::nullopt;
    }
    return x;
  }

 private:
  // The difference of two values of a free input, in its units.
  double apart(double a, double b, std::size_t j) const {
    return rotary_[j] && !counted_ ? math::wrap_angle(a - b) : (a - b) / unit_[j];
  }

  // Derivatives of all forces by one free input, from exact forces beside the place.
  Numbers slopes(const Numbers& x, std::size_t k, double h, bool fourth_order) {
    Numbers out(count(), nan), moved = x;
    const auto at_side = [&](double by) {
      moved[k] = x[k] + by;
      return solve(moved) ? forces_.force : Numbers(count(), nan);
    };
    const Numbers above = at_side(h), below = at_side(-h);
    for (std::size_t j = 0; j < count(); ++j) out[j] = (above[j] - below[j]) / (2 * h);
    if (!fourth_order) return out;
    const Numbers far_above = at_side(2 * h), far_below = at_side(-2 * h);
    for (std::size_t j = 0; j < count(); ++j)
      out[j] = (4 * out[j] - (far_above[j] - far_below[j]) / (4 * h)) / 3;
    return out;
  }

  std::optional<Numbers> newton_step(const Numbers& x) {
    const std::size_t n = count();
    if (!solve(x)) return std::nullopt;
    Numbers right = forces_.force, matrix(n * n);
    for (std::size_t k = 0; k < n; ++k) {
      const Numbers slope = slopes(x, k, 1e-4 * unit_[k], false);
      for (std::size_t j = 0; j < n; ++j) matrix[k * n + j] = -slope[j];  // column by column
    }
    for (const double a : matrix)
      if (!std::isfinite(a)) return std::nullopt;
    return math::linear_fit(matrix, n, right);
  }

  // By how much the step of Newton's method changes when the forces are divided by the distances to the known
  // places (deflation).
  double deflation(const Numbers& x, const Numbers& step, const std::vector<Numbers>& known) const {
    double along = 0;  // derivative of the logarithm of the factor in the direction of the step
    for (const Numbers& root : known) {
      double squared = 0, rate = 0;
      for (std::size_t j = 0; j < x.size(); ++j) {
        const double d = apart(x[j], root[j], j);
        squared += d * d;
        rate += 2 * d * step[j] / unit_[j];
      }
      if (squared > 0) along -= rate / (squared * (squared + 1));  // of 1 + 1 / squared
    }
    const double left = 1 - along;
    return left != 0 ? 1 / left : 1;
  }

  // Without deflation to rounding.
  std::optional<Numbers> polished(Numbers x, const std::vector<Numbers>& known) {
    for (int i = 0; i < 4; ++i) {
      const std::optional<Numbers> step = newton_step(x);
      if (!step) return std::nullopt;
      for (std::size_t j = 0; j < x.size(); ++j) x[j] += (*step)[j];
      if (!solve(x)) return std::nullopt;
    }
    for (const double q : forces_.force)
      if (!(std::abs(q) <= 1e-9 * scale_)) return std::nullopt;
    for (const Numbers& root : known)
      if (distance(x, root) < same_place) return std::nullopt;
    return x;
  }

  static bool symmetric(const Numbers& matrix, std::size_t n) {
    double largest = 0, skew = 0;
    for (const double a : matrix) largest = std::max(largest, std::abs(a));
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < j; ++k)
        skew = std::max(skew, std::abs(matrix[j * n + k] - matrix[k * n + j]));
    return skew <= 1e-7 * largest;
  }

  void classify(RestConfiguration& c) const {
    const std::size_t n = count();
    Numbers one(n * n);
    for (std::size_t j = 0; j < n; ++j) one[j * n + j] = 1;
    const Numbers mass = math::symmetric_eigenvalues(c.masses, one);
    const bool massive = mass.front() > 1e-12 * mass.back();
    const bool conservative = symmetric(c.stiffness, n);
    const bool damped =
        std::any_of(c.dampings.begin(), c.dampings.end(), [](double d) { return std::abs(d) > 0; });
    constexpr double zero = 1e-8;
    if (conservative) {
      for (std::size_t j = 0; j < n; ++j)
        for (std::size_t k = 0; k < j; ++k)
          c.stiffness[j * n + k] = c.stiffness[k * n + j] =
              (c.stiffness[j * n + k] + c.stiffness[k * n + j]) / 2;
      const Numbers values = math::symmetric_eigenvalues(c.stiffness, massive ? c.masses : one);
      const double largest = std::max(std::abs(values.front()), std::abs(values.back()));
      c.kind = values.front() > zero * largest    ? RestKind::stable
               : values.front() < -zero * largest ? RestKind::unstable
                                                  : RestKind::marginal;
      if (!damped && massive) {
        for (const double v : values)
          if (v > zero * largest) c.vibrations.emplace_back(0, std::sqrt(v));
        return;
      }
    }
    if (!massive) return;
    // Columns of M^-1 K and M^-1 C.
    Numbers state(4 * n * n);
    for (std::size_t k = 0; k < n; ++k) {
      state[k * 2 * n + n + k] = 1;
      for (const bool damping : {false, true}) {
        const Numbers& matrix = damping ? c.dampings : c.stiffness;
        Numbers column(n);
        for (std::size_t j = 0; j < n; ++j) column[j] = -matrix[j * n + k];
        const Numbers solved = math::solve_symmetric(c.masses, column);
        for (std::size_t j = 0; j < n; ++j) state[(n + j) * 2 * n + (damping ? n : 0) + k] = solved[j];
      }
    }
    std::complex<double> worst = -infinity;
    double largest = 0;
    for (const std::complex<double> value : math::eigenvectors(state, false).values) {
      largest = std::max(largest, std::abs(value));
      if (value.real() > worst.real()) worst = value;
      if (value.imag() > 1e-9 * std::abs(value)) c.vibrations.push_back(value);
    }
    std::sort(c.vibrations.begin(), c.vibrations.end(),
              [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
    if (conservative) return;
    c.kind = worst.real() <= 1e-7 * largest            ? RestKind::stable
             : std::abs(worst.imag()) > 1e-6 * largest ? RestKind::flutter
                                                       : RestKind::unstable;
  }

  StaticForces forces_;
  const RestGrid& grid_;
  bool counted_;      // torsion springs count turns
  double scale_ = 0;  // of the forces, the largest so far
  Numbers all_, unit_;
  std::vector<bool> rotary_;
};

// Starts along each free input: some hundreds in all.
int starts_along(std::size_t free, int asked) {
  if (asked > 0) return asked;
  constexpr int few[] = {24, 12, 8, 5, 4};
  return free <= std::size(few) ? few[free - 1] : 3;
}

// The search without rigid stops.
RestConfigurations open_search(const Linkage& linkage, const LinkagePlan& plan, const RestGrid& grid,
                               const RunContext* context) {
  RestConfigurations out;
  RestNewton newton(linkage, plan, grid);
  const std::size_t n = newton.count();
  const int along = starts_along(n, grid.starts);
  std::vector<int> index(n, 0);
  std::vector<Numbers> known;
  bool assembled = false;
  for (bool going_on = true; going_on;) {
    if (context && (out.status = context->interruption()) != Status::done) break;
    Numbers start(n);
    for (std::size_t j = 0; j < n; ++j) start[j] = newton.reach(j) * (2 * (index[j] + 0.45) / along - 1);
    ++out.starts;
    assembled = newton.solve(start) || assembled;
    while (known.size() < max_found) {
      const std::optional<Numbers> root = newton.search(start, known);
      const std::optional<Numbers> inside = root ? newton.within_reach(*root) : std::nullopt;
      if (!inside) break;
      known.push_back(*inside);
    }
    std::size_t j = 0;
    while (j < n && ++index[j] == along) index[j++] = 0;
    going_on = j < n;
  }
  for (const Numbers& root : known) out.found.push_back(newton.described(root));
  std::sort(out.found.begin(), out.found.end(), [](const RestConfiguration& a, const RestConfiguration& b) {
    return a.potential != b.potential ? a.potential < b.potential : a.values < b.values;
  });
  if (out.status == Status::done && !assembled) out.status = Status::no_assembly;
  return out;
}

// A linkage with rigid stops on its free inputs: each of these is free, or held by one of its stops.
class StoppedSearch {
 public:
  StoppedSearch(const Linkage& linkage, const RestGrid& grid) : l_(linkage), open_(linkage), grid_(grid) {
    std::erase_if(open_.stops, [](const JointStop& s) { return !s.stiffness; });
    PlanResult planned = plan_linkage(open_);
    LINKWRIGHT_REQUIRE(planned.problems.empty(), "the linkage cannot be planned without its {} stops",
                       l_.stops.size());
    plan_ = std::move(planned.plan);
    stops_.resize(grid.free.size());
    for (std::size_t k = 0; k < l_.stops.size(); ++k) {
      if (l_.stops[k].stiffness) continue;
      std::size_t j = 0;
      while (j < grid.free.size() && l_.driven[grid.free[j]] != l_.stops[k].joint) ++j;
      LINKWRIGHT_REQUIRE(j < grid.free.size(), "stop {} is rigid, and its joint is not a free input", k);
      stops_[j].push_back(k);
    }
  }

  RestConfigurations run(const RunContext* context) {
    RestConfigurations out{.status = Status::no_assembly};
    std::vector<int> held(stops_.size(), -1);  // index into the stops of the input; -1: free
    for (bool going_on = true; going_on;) {
      const RestConfigurations part = search_held(held, context);
      out.starts += part.starts;
      if (part.status == Status::done || out.status == Status::no_assembly) out.status = part.status;
      for (const RestConfiguration& c : part.found)
        if (auto rest = completed(c, held)) out.found.push_back(*std::move(rest));
      if (part.status != Status::done && part.status != Status::no_assembly) break;
      std::size_t j = 0;
      while (j < held.size() && ++held[j] == static_cast<int>(stops_[j].size())) held[j++] = -1;
      going_on = j < held.size();
    }
    std::sort(out.found.begin(), out.found.end(), [](const RestConfiguration& a, const RestConfiguration& b) {
      return a.potential != b.potential ? a.potential < b.potential : a.values < b.values;
    });
    return out;
  }

 private:
  const JointStop& stop(std::size_t input, int which) const { return l_.stops[stops_[input][at(which)]]; }

  RestConfigurations search_held(const std::vector<int>& held, const RunContext* context) {
    RestGrid grid{.inputs = grid_.inputs, .free = {}, .starts = grid_.starts};
    for (std::size_t j = 0; j < held.size(); ++j)
      if (held[j] < 0)
        grid.free.push_back(grid_.free[j]);
      else
        grid.inputs[grid_.free[j]] = stop(j, held[j]).limit;
    if (!grid.free.empty()) return open_search(open_, plan_, grid, context);
    StaticForces forces(open_, plan_, grid_.free);
    RestConfigurations out{.starts = 1};
    out.status = forces.solve(grid.inputs) == Status::done ? Status::done : Status::no_assembly;
    if (out.status == Status::done)
      out.found.push_back({.kind = RestKind::at_end, .potential = forces.potential()});
    return out;
  }

  // With the values of all free inputs and the efforts of the stops; nothing where a stop would have to pull,
  // or another one is passed.
  std::optional<RestConfiguration> completed(const RestConfiguration& found, const std::vector<int>& held) {
    constexpr double near = 1e-9;
    RestConfiguration out = found;
    std::vector<double> all = grid_.inputs;
    out.values.clear();
    std::size_t next = 0;
    for (std::size_t j = 0; j < held.size(); ++j) {
      double value = held[j] < 0 ? found.values[next++] : stop(j, held[j]).limit;
      const bool rotary = plan_.rotary[grid_.free[j]];
      const auto passes = [&](double v) {
        return std::any_of(stops_[j].begin(), stops_[j].end(), [&](std::size_t k) {
          return l_.stops[k].side * (v - l_.stops[k].limit) < -near * (rotary ? 1 : plan_.size);
        });
      };
      // Angles that were found may be a turn away from the range between two stops.
      if (rotary && held[j] < 0 && stops_[j].size() == 2 && passes(value))
        value += passes(value + full_turn) ? -full_turn : full_turn;
      if (passes(value)) return std::nullopt;
      all[grid_.free[j]] = value;
      out.values.push_back(value);
    }
    StaticForces forces(open_, plan_, grid_.free);
    if (forces.solve(all) != Status::done) return std::nullopt;
    out.stops.assign(l_.stops.size(), 0.0);
    for (std::size_t j = 0; j < held.size(); ++j) {
      if (held[j] < 0) continue;
      const double effort = -stop(j, held[j]).side * forces.force[j];
      if (!(effort > near * forces.scale)) return std::nullopt;
      out.stops[stops_[j][at(held[j])]] = effort;
    }
    return out;
  }

  const Linkage& l_;
  Linkage open_;  // without rigid stops
  LinkagePlan plan_;
  const RestGrid& grid_;
  std::vector<std::vector<std::size_t>> stops_;  // of each free input: its rigid stops
};

}  // namespace

RestConfigurations rest_configurations(const Linkage& linkage, const LinkagePlan& plan, const RestGrid& grid,
                                       const RunContext* context) {
  LINKWRIGHT_REQUIRE(plan.closed_form() && grid.inputs.size() == plan.inputs() && !grid.free.empty(),
                     "{} values and {} free inputs of a linkage with {} inputs, which needs closed forms",
                     grid.inputs.size(), grid.free.size(), plan.inputs());
  const bool is_stopped = std::any_of(linkage.stops.begin(), linkage.stops.end(),
                                      [](const JointStop& s) { return !s.stiffness; });
  if (is_stopped) return StoppedSearch(linkage, grid).run(context);
  RestConfigurations out = open_search(linkage, plan, grid, context);
  for (RestConfiguration& c : out.found) c.stops.assign(linkage.stops.size(), 0.0);
  return out;
}

}  // namespace linkwright::planar
