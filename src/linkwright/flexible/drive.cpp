#include "linkwright/flexible/drive.h"

#include <cmath>
#include <numbers>

#include "linkwright/core/check.h"

namespace linkwright::flexible {

HubMotion SpinUp::operator()(double time) const {
  LINKWRIGHT_REQUIRE(duration > 0, "a spin-up of {} s", duration);
  if (time >= duration) return {rate * (time - duration / 2), rate, 0};
  if (time <= 0) return {};
  const double circle = 2 * std::numbers::pi, phase = circle * time / duration;
  const double slope = rate / duration, period = duration / circle;
  return {slope * (time * time / 2 + period * period * (std::cos(phase) - 1)),
          slope * (time - period * std::sin(phase)), slope * (1 - std::cos(phase))};
}

double SinePulse::operator()(double time) const {
  LINKWRIGHT_REQUIRE(duration > 0, "a pulse of {} s", duration);
  return time >= 0 && time <= duration ? torque * std::sin(2 * std::numbers::pi * time / duration) : 0;
}

}  // namespace linkwright::flexible
