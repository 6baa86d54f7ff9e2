// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/input_shaping.h"

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"

namespace linkwright::flexible {

namespace {

void require(const ShapedMode& mode) {
  LINKWRIGHT_REQUIRE(mode.frequency > 0 && std::isfinite(mode.frequency), "a frequency of {} rad/s",
                     mode.frequency);
  LINKWRIGHT_REQUIRE(mode.damping >= 0 && mode.damping < 1, "a damping ratio of {}", mode.damping);
}

}  // namespace

std::vector<Impulse> impulses(Shaper shaper, const ShapedMode& mode, double remaining) {
  require(mode);
  const double root = std::sqrt(1 - mode.damping * mode.damping);
  const double half = pi / (mode.frequency * root);  // half a damped period
  const double decay = std::exp(-mode.damping * pi / root);
  std::vector<double> shares;
  switch (shaper) {
    case Shaper::zv:
      shares = {1, decay};
      break;
    case Shaper::zvd:
      shares = {1, 2 * decay, decay * decay};
      break;
    case Shaper::ei:
      LINKWRIGHT_REQUIRE(remaining > 0 && remaining < 1, "{} of the vibration to remain: between 0 and 1",
                         remaining);
      shares = {1 + remaining, 2 * (1 - remaining) * decay, (1 + remaining) * decay * decay};
      break;
  }
  double sum = 0;
  for (const double s : shares) sum += s;
  std::vector<Impulse> out;
  for (std::size_t i = 0; i < shares.size(); ++i) out.push_back({double(i) * half, shares[i] / sum});
  return out;
}

std::vector<Impulse> combined(std::span<const Impulse> first, std::span<const Impulse> second) {
  std::vector<Impulse> out;
  for (const Impulse& a : first)
    for (const Impulse& b : second) out.push_back({a.time + b.time, a.share * b.share});
  std::stable_sort(out.begin(), out.end(),
                   [](const Impulse& a, const Impulse& b) { return a.time < b.time; });
  return out;
}

double residual_vibration(std::span<const Impulse> impulses, const ShapedMode& mode) {
  require(mode);
  const double damped = mode.frequency * std::sqrt(1 - mode.damping * mode.damping);
  double last = 0, cosines = 0, sines = 0;
  for (const Impulse& i : impulses) last = std::max(last, i.time);
  for (const Impulse& i : impulses) {
    const double left = i.share * std::exp(-mode.damping * mode.frequency * (last - i.time));
    cosines += left * std::cos(damped * i.time);
    sines += left * std::sin(damped * i.time);
  }
  return std::hypot(cosines, sines);
}

HubMotion shaped(AngleLaw law, std::span<const Impulse> impulses, double time) {
  HubMotion out;
  for (const Impulse& i : impulses) {
    const HubMotion m = law(time - i.time);
    out.angle += i.share * m.angle;
    out.rate += i.share * m.rate;
    out.acceleration += i.share * m.acceleration;
  }
  return out;
}

double shaped_torque(TorqueLaw law, std::span<const Impulse> impulses, double time) {
  double out = 0;
  for (const Impulse& i : impulses)
    if (time >= i.time) out += i.share * law(time - i.time);
  return out;
}

std::vector<double> shaped_breaks(std::span<const double> breaks, std::span<const Impulse> impulses) {
  std::vector<double> out;
  for (const Impulse& i : impulses) {
    out.push_back(i.time);
    for (const double b : breaks) out.push_back(b + i.time);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace linkwright::flexible
