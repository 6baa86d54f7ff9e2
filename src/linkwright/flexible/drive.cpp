// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/flexible/simulation.h"

namespace linkwright::flexible {

HubMotion SpinUp::operator()(double time) const {
  LINKWRIGHT_REQUIRE(duration > 0, "a spin-up of {} s", duration);
  if (time >= duration) return {rate * (time - duration / 2), rate, 0};
  if (time <= 0) return {};
  const double phase = full_turn * time / duration;
  const double slope = rate / duration, period = duration / full_turn;
  return {slope * (time * time / 2 + period * period * (std::cos(phase) - 1)),
          slope * (time - period * std::sin(phase)), slope * (1 - std::cos(phase))};
}

double SinePulse::operator()(double time) const {
  LINKWRIGHT_REQUIRE(duration > 0, "a pulse of {} s", duration);
  return time >= 0 && time <= duration ? torque * std::sin(2 * pi * time / duration) : 0;
}

double TorqueTable::operator()(double time) const {
  LINKWRIGHT_REQUIRE(!times.empty() && times.size() == torques.size(), "{} times, {} torques", times.size(),
                     torques.size());
  if (!(time >= times.front() && time <= times.back())) return 0;
  const std::size_t after =
      static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (after == times.size()) return torques.back();
  const double share = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return torques[after - 1] + share * (torques[after] - torques[after - 1]);
}

}  // namespace linkwright::flexible
