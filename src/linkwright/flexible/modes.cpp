// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/modes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/flexible/chain_equations.h"
#include "linkwright/flexible/links.h"
#include "linkwright/math/zero.h"

namespace linkwright::flexible {

namespace {

Chain without_gravity(Chain chain) {
  chain.gravity = 0;
  chain.mass_damping = chain.stiffness_damping = chain.hub_damping = 0;
  return chain;
}

// The straight link at a speed of its hub; counts eigenvalues below others.
class Straight {
 public:
  Straight(const Chain& chain, const Vibration& about)
      : chain_(without_gravity(chain)), equations_(chain_), free_hub_(about.hub == Hub::free) {
    const double speed = about.speed;
    const bool free_hub = free_hub_;
    const std::vector<std::size_t> joints = hinges(chain);
    LINKWRIGHT_REQUIRE(about.turns.empty() || about.turns.size() == joints.size(), "{} turns of {} hinges",
                       about.turns.size(), joints.size());
    for (const std::size_t k : about.locked) {
      LINKWRIGHT_REQUIRE(k < joints.size(), "hinge {} of {} locked", k, joints.size());
      equations_.lock_turn(joints[k]);
    }
    const bool turns = speed != 0;
    LINKWRIGHT_REQUIRE(!(chain.extensible && turns && free_hub),
                       "modes of an extensible link on a free hub that turns at {} rad/s are not known",
                       speed);
    ChainState state = state_at_rest(chain_);
    if (chain_.extensible && turns) {
      const Equilibrium stretched = equilibrium(chain_, {}, {.speed = speed});
      LINKWRIGHT_REQUIRE(stretched.status == Status::done, "no steady rotation at {} rad/s", speed);
      state = stretched.state;
    }
    for (std::size_t k = 0; k < about.turns.size(); ++k) {
      LINKWRIGHT_REQUIRE(about.turns[k] == 0 || !turns, "bent hinges on a hub that turns at {} rad/s", speed);
      state.q[coordinates_per_cell * joints[k] + turn] = about.turns[k];
    }
    state.rate = speed;
    equations_.evaluate(state);
    const Cell& cell = chain_.cells.front();
    const double length = chain_.length();
    double mass = 0;
    for (const Cell& c : chain_.cells) mass += c.mass;
    unit_ = cell.bending * cell.length / (length * length * length * mass);
  }

  int below(double square) {
    // A free hinge has a mode at 0, where its pivot vanishes: it is not below.
    if (!factor(square) && square == 0) factor(-1e-18 * unit_);
    return equations_.negative();
  }
  bool factor(double square) {
    const double gyroscopic = chain_.extensible ? std::sqrt(std::max(square, 0.0)) : 0;
    return equations_.factor({.acceleration = -square, .gyroscopic = gyroscopic}, free_hub_);
  }
  // omega^2 of mode k = 1, 2, ...
  double square(int k) {
    double low = 0, high = unit_;
    if (below(0) >= k) {
      for (low = -unit_; below(low) >= k; low *= 4) high = low;
      high = high > 0 ? 0 : high;
    } else {
      for (; below(high) < k; high *= 4) low = high;
    }
    // For a rigid rotation the bracket would shrink towards 0 for ever.
    const double rounding = 1e-13, rigid = 1e-16 * unit_;
    while (high - low > rounding * std::max(std::abs(high), std::abs(low)) && std::abs(high) > rigid) {
      const double middle = low + (high - low) / 2;
      (below(middle) >= k ? high : low) = middle;
    }
    return std::abs(high) > rigid ? low + (high - low) / 2 : 0;
  }
  const Chain& chain() const { return chain_; }
  ChainEquations& equations() { return equations_; }

 private:
  Chain chain_;
  ChainEquations equations_;
  bool free_hub_;
  double unit_ = 1;
};

void require_count(const Chain& chain, int count, const Vibration& about) {
  const int most = mode_count(chain, about);
  LINKWRIGHT_REQUIRE(count >= 1 && count <= most, "mode {} of a chain that has {}", count, most);
}

}  // namespace

int mode_count(const Chain& chain, const Vibration& about) {
  // Nodes without rotary inertia have fewer frequencies than coordinates.
  int out = about.hub == Hub::free;
  for (const Cell& cell : chain.cells) {
    out += chain.extensible ? 3 : 2;
    out -= cell.hinge || cell.inertia == 0;
  }
  return out - static_cast<int>(about.locked.size());
}

int modes_below(const Chain& chain, double square, const Vibration& about) {
  return Straight(chain, about).below(square);
}

std::vector<Mode> modes(const Chain& chain, int count, const Vibration& about) {
  require_count(chain, count, about);
  Straight straight(chain, about);
  std::vector<Mode> out(count);
  for (int k = 1; k <= count; ++k) {
    const double square = straight.square(k);
    LINKWRIGHT_REQUIRE(square >= 0 || !chain.extensible || about.speed == 0,
                       "an extensible link that is unstable at {} rad/s", about.speed);
    (square >= 0 ? out[k - 1].frequency : out[k - 1].growth) = std::sqrt(std::abs(square));
  }
  return out;
}

ModeShape mode_shape(const Chain& chain, int k, const Vibration& about) {
  const bool free_hub = about.hub == Hub::free;
  LINKWRIGHT_REQUIRE(std::all_of(about.turns.begin(), about.turns.end(), [](double t) { return t == 0; }),
                     "shapes are known of links in line only");
  require_count(chain, k, about);
  Straight straight(chain, about);
  const double square = straight.square(k);
  // Beside the eigenvalue by more than the rounding of the elimination, by less than the distance to the
  // next.
  straight.factor(square == 0 ? 1e-9 * chain.cells.front().bending : square * (1 + 1e-9));
  std::vector<double> x(coordinates_per_cell * straight.chain().cells.size(), 0.0), change(x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = i % coordinates_per_cell == extension ? 0 : 1 + double(i % 7);
  double hub = free_hub ? 1 : 0;
  for (int i = 0; i < 4; ++i) {
    hub = straight.equations().solve(x, hub, change);
    double most = std::abs(hub);
    for (const double c : change) most = std::max(most, std::abs(c));
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = change[j] / most;
    hub /= most;
  }
  ModeShape out{deflection_of(straight.chain(), x), hub};
  double largest = 0;
  for (const double y : out.link.eta)
    if (std::abs(y) > std::abs(largest)) largest = y;
  if (square == 0) largest = hub;
  for (double& y : out.link.eta) y /= largest;
  for (double& angle : out.link.angle) angle /= largest;
  out.hub_angle /= largest;
  return out;
}

std::optional<double> critical_speed(const Chain& chain, double limit) {
  const auto stable = [&](double speed) { return Straight(chain, {.speed = speed}).below(0) == 0; };
  if (stable(limit)) return {};
  return math::bisect(stable, 0, limit, {.relative = 1e-12}).outside;
}

Table campbell(const Chain& chain, std::span<const double> speeds, int count, Hub hub) {
  Table out{.name = "campbell"};
  out.add("speed_rad_per_s", "speed of the hub (rad/s)", {speeds.begin(), speeds.end()});
  for (int k = 1; k <= count; ++k)
    out.add(fmt::format("mode_{}_rad_per_s", k), fmt::format("mode {} (rad/s)", k));
  for (const double speed : speeds) {
    const std::vector<Mode> found = modes(chain, count, {speed, hub});
    bool stable = true;
    for (int k = 0; k < count; ++k) {
      const bool vibrates = found[k].growth == 0;
      stable = stable && vibrates;
      out.columns[k + 1].values.push_back(vibrates ? found[k].frequency : nan);
    }
    out.status.emplace_back(to_string(stable ? Status::done : Status::singular));
  }
  return out;
}

}  // namespace linkwright::flexible
