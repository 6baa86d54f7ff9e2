// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "linkwright/planar/link_mass.h"
#include "linkwright/planar/linkage/form.h"
#include "linkwright/planar/linkage/linkage.h"

// The slider-crank by its parameters: a shorthand for a linkage.
namespace linkwright::planar {

/// `[mechanism.parameters]` of planar.slider_crank; Boskovic 2018, Eqs. (4.7)-(4.11) in joint coordinates:
/// crank O-A, rod A-B, slider B on a guide.
struct SliderCrankForm {
  double crank = 0, rod = 0;
  /// Offset of the guide line from the crank pivot, along the left normal of its direction.
  double offset = 0;
  double guide_angle = 0;  ///< direction of the guide
  double pivot_x = 0, pivot_y = 0;
  double rod_u = 0, rod_v = 0;  ///< tracing point on the rod, from A along A->B and along its left normal
};
struct SliderCrankMass : LinkMass {
  std::vector<PointMass> attached;
};
struct SliderCrankMasses {
  SliderCrankMass crank, rod;
  double slider = 0;
};

enum class SliderSide { forward, backward };
constexpr std::array<EnumName<SliderSide>, 2> names(SliderSide) {
  return {{{SliderSide::forward, "forward", "the slider ahead of the crank pin along the guide direction"},
           {SliderSide::backward, "backward", "the slider behind the crank pin"}}};
}
/// `[mechanism.gas_pressure]`: what pushes the slider as a piston towards the crank.
struct GasPressure {
  double bore = 0;               ///< diameter of the piston, m
  std::vector<double> crank;     ///< rising angles of the crank, rad, 0 with crank and guide in line
  std::vector<double> pressure;  ///< above that on the other side of the piston, Pa, as many
};
struct SliderCrankMechanism {
  SliderSide branch = SliderSide::forward;
  SliderCrankForm parameters;
  std::optional<SliderCrankMasses> masses;
  std::optional<GasPressure> gas = {};
};
/// The linkage of it, with bodies crank, rod and slider and joints O (driven), A, B and guide.
Linkage slider_crank(const SliderCrankMechanism& mechanism);

template <class Visitor>
void fields(Visitor&& visit, SliderCrankForm& s) {
  const auto link = [&](std::string_view key, std::string_view summary, double& value) {
    visit(field::length(key, summary).at_least(1e-9).required(), value);
  };
  link("crank", "length of the crank O-A", s.crank);
  link("rod", "length of the rod A-B", s.rod);
  visit(field::length("offset", "of the guide line from O, along the left normal of its direction"),
        s.offset);
  visit(field::angle("guide_angle", "direction of the guide"), s.guide_angle);
  visit(field::length("pivot_x", "crank pivot O, x"), s.pivot_x);
  visit(field::length("pivot_y", "crank pivot O, y"), s.pivot_y);
  visit(field::length("rod_u", "tracing point C of the rod, along A->B"), s.rod_u);
  visit(field::length("rod_v", "tracing point C of the rod, along the left normal of A->B"), s.rod_v);
}
template <class Visitor>
void fields(Visitor&& visit, SliderCrankMass& m) {
  fields(visit, static_cast<LinkMass&>(m));
  visit(field::entry("attached", "masses fixed to it: counterweights"), m.attached);
}
template <class Visitor>
void fields(Visitor&& visit, SliderCrankMasses& m) {
  visit(field::entry("crank", "own joint O").required(), m.crank);
  visit(field::entry("rod", "own joint A").required(), m.rod);
  visit(field::mass("slider", "mass of the slider").not_negative().required(), m.slider);
}

template <class Visitor>
void fields(Visitor&& visit, GasPressure& g) {
  visit(field::length("bore", "diameter of the piston").positive().required(), g.bore);
  visit(
      field::angle("crank",
                   "rising angles of the crank from the outer dead centre of a guide without offset; a table "
                   "of whole turns repeats, such as 720 deg of a four-stroke engine")
          .required(),
      g.crank);
  visit(field::pressure("pressure", "pressure at each of them, above that on the other side of the piston")
            .required(),
        g.pressure);
}
template <class Visitor>
void fields(Visitor&& visit, SliderCrankMechanism& m) {
  visit(field::entry("branch", "assembly mode"), m.branch);
  visit(field::entry("parameters", "the linkage in numbers").required(), m.parameters);
  visit(field::entry("mass", "masses of the links; only forces and torques need them"), m.masses);
  visit(field::entry("gas_pressure", "pressure of the gas on the slider, which is a piston"), m.gas);
}

}  // namespace linkwright::planar
