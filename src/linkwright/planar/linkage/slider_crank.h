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
struct SliderCrankMass {
  double mass = 0, inertia = 0, centre_distance = 0, centre_angle = 0;
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
struct SliderCrankMechanism {
  SliderSide branch = SliderSide::forward;
  SliderCrankForm parameters;
  std::optional<SliderCrankMasses> masses;
};
/// The linkage of it, with bodies crank, rod and slider and joints O (driven), A, B and guide.
Linkage slider_crank(const SliderCrankMechanism& mechanism);

template <class Visitor>
void fields(Visitor&& visit, SliderCrankForm& s) {
  using namespace linkage_fields;
  const auto link = [&](std::string_view key, std::string_view summary, double& value) {
    visit(Field{.key = key,
                .summary = summary,
                .dimension = Dimension::length,
                .minimum = 1e-9,
                .maximum = most,
                .required = true},
          value);
  };
  link("crank", "length of the crank O-A", s.crank);
  link("rod", "length of the rod A-B", s.rod);
  visit(place("offset", "of the guide line from O, along the left normal of its direction"), s.offset);
  visit(angle("guide_angle", "direction of the guide"), s.guide_angle);
  visit(place("pivot_x", "crank pivot O, x"), s.pivot_x);
  visit(place("pivot_y", "crank pivot O, y"), s.pivot_y);
  visit(place("rod_u", "tracing point C of the rod, along A->B"), s.rod_u);
  visit(place("rod_v", "tracing point C of the rod, along the left normal of A->B"), s.rod_v);
}
template <class Visitor>
void fields(Visitor&& visit, SliderCrankMass& m) {
  using namespace linkage_fields;
  visit(positive("mass", "mass of the link", Dimension::mass, true), m.mass);
  visit(positive("inertia", "moment of inertia about the mass centre", Dimension::inertia, true), m.inertia);
  visit(positive("centre_distance", "distance of the mass centre from the link's own joint",
                 Dimension::length, true),
        m.centre_distance);
  visit(angle("centre_angle", "angle of the mass centre from the link line"), m.centre_angle);
  visit(Field{.key = "attached", .summary = "masses fixed to it: counterweights"}, m.attached);
}
template <class Visitor>
void fields(Visitor&& visit, SliderCrankMasses& m) {
  using namespace linkage_fields;
  visit(Field{.key = "crank", .summary = "own joint O", .required = true}, m.crank);
  visit(Field{.key = "rod", .summary = "own joint A", .required = true}, m.rod);
  visit(positive("slider", "mass of the slider", Dimension::mass, true), m.slider);
}

template <class Visitor>
void fields(Visitor&& visit, SliderCrankMechanism& m) {
  visit(Field{.key = "branch", .summary = "assembly mode"}, m.branch);
  visit(Field{.key = "parameters", .summary = "the linkage in numbers", .required = true}, m.parameters);
  visit(Field{.key = "mass", .summary = "masses of the links; only forces and torques need them"}, m.masses);
}

}  // namespace linkwright::planar
