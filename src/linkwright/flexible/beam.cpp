// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/flexible/chain.h"

namespace linkwright::flexible {

double Beam::shear_stiffness() const {
  return theory == Theory::timoshenko ? shear_modulus * area * shear_coefficient : infinity;
}

double Beam::rotary_inertia() const {
  return theory == Theory::euler_bernoulli ? 0 : density * second_moment;
}

double Beam::frequency_scale() const {
  return std::sqrt(bending_stiffness() / (density * area)) / (length * length);
}

std::optional<std::string> problem(const Beam& b) {
  struct Item {
    const char* name;
    double value;
    const char* unit;
  };
  for (const Item& i : {Item{"length", b.length, "m"}, Item{"density", b.density, "kg/m3"},
                        Item{"area", b.area, "m2"}, Item{"second moment of area", b.second_moment, "m4"},
                        Item{"modulus of elasticity", b.elastic_modulus, "Pa"}})
    if (!(i.value > 0 && std::isfinite(i.value)))
      return fmt::format("{} = {} {}: it must be positive", i.name, i.value, i.unit);
  if (b.theory == Theory::timoshenko)
    for (const Item& i :
         {Item{"shear modulus", b.shear_modulus, " Pa"}, Item{"shear coefficient", b.shear_coefficient, ""}})
      if (!(i.value > 0 && std::isfinite(i.value)))
        return fmt::format("{} = {}{}: a Timoshenko beam needs a positive one", i.name, i.value, i.unit);
  for (const Item& i :
       {Item{"tip mass", b.tip_mass, "kg"}, Item{"inertia of the tip mass", b.tip_inertia, "kg m2"},
        Item{"hub radius", b.hub_radius, "m"}, Item{"hub inertia", b.hub_inertia, "kg m2"},
        Item{"mass damping", b.mass_damping, "1/s"}, Item{"stiffness damping", b.stiffness_damping, "s"},
        Item{"hub stiffness", b.hub_stiffness, "N m"}, Item{"hub damping", b.hub_damping, "N m s"}})
    if (!(i.value >= 0 && std::isfinite(i.value)))
      return fmt::format("{} = {} {}: it must not be negative", i.name, i.value, i.unit);
  if (!std::isfinite(b.gravity)) return fmt::format("gravity = {} m/s2: it must be finite", b.gravity);
  return {};
}

}  // namespace linkwright::flexible
