// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>

#include "linkwright/core/field.h"

namespace linkwright::planar {

/// Inertia of one link. The mass centre lies `centre_distance` metres from the link's own joint, at
/// `centre_angle` radians counter-clockwise from the link line.
struct LinkMass {
  double mass = 0;             ///< kg, >= 0
  double inertia = 0;          ///< kg m2 about the mass centre, >= 0
  double centre_distance = 0;  ///< m, >= 0
  double centre_angle = 0;     ///< rad
};
template <class Visitor>
void fields(Visitor&& visit, LinkMass& m) {
  visit(field::mass("mass", "mass of the link").not_negative().required(), m.mass);
  visit(field::inertia("inertia", "moment of inertia about the mass centre").not_negative().required(),
        m.inertia);
  visit(field::length("centre_distance", "distance of the mass centre from the link's own joint")
            .not_negative()
            .required(),
        m.centre_distance);
  visit(field::angle("centre_angle", "angle of the mass centre from the link line"), m.centre_angle);
}

/// A mass without extension that is fixed to a link: payload, motor, counterweight.
struct PointMass {
  double mass = 0;      ///< kg, >= 0
  double distance = 0;  ///< m from the link's own joint; negative = behind it
  double angle = 0;     ///< rad, counter-clockwise from the link line
};
template <class Visitor>
void fields(Visitor&& visit, PointMass& m) {
  visit(field::mass("mass", "mass without extension").not_negative().required(), m.mass);
  visit(field::length("distance", "from the link's own joint, negative = behind it").required(), m.distance);
  visit(field::angle("angle", "from the link line, counter-clockwise").between(-1e3, 1e3), m.angle);
}

/// All properties of its masses that affect the motion of a rigid link in the plane, in the frame of the
/// link: own joint in the origin, link line along x. Forces and torques are linear in these numbers.
struct BaseParameters {
  double mass = 0;                 ///< kg
  std::complex<double> moment{0};  ///< first moment, mass times mass centre in the frame of the link (kg m)
  double inertia = 0;              ///< about the own joint (kg m2)
};

/// The radius at which masses without extension are drawn: that of a steel disc, 20 mm thick and of 7850
/// kg/m3.
///
/// @param mass the mass (kg)
/// @returns the radius (m)
double drawn_radius(double mass);

/// Base parameters of a link with masses fixed to it.
///
/// @param link the link itself
/// @param attached masses fixed to it
/// @returns mass, first moment and inertia about the own joint
/// @throws ContractError if a mass, inertia or centre distance is negative, or anything is not finite
BaseParameters base_parameters(const LinkMass& link, std::span<const PointMass> attached = {});

/// The link and the masses fixed to it as one: the mass, the mass centre and the moment of inertia about it.
///
/// @param link the link itself
/// @param attached masses fixed to it
/// @returns the inertia of all together
/// @throws ContractError as base_parameters does
LinkMass with_attached(const LinkMass& link, std::span<const PointMass> attached);

}  // namespace linkwright::planar
