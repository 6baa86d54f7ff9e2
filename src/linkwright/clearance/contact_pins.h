// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <complex>
#include <span>
#include <vector>

#include "linkwright/clearance/contact_law.h"
#include "linkwright/clearance/open_linkage.h"

// Pins that move in their bushes: where they are, and the loads that they put on the bodies.
namespace linkwright::clearance {

enum class PinSide { first, second };
constexpr std::array<EnumName<PinSide>, 2> names(PinSide) {
  return {{{PinSide::first, "first", "the pin is on the first body of the joint, the bush on the second"},
           {PinSide::second, "second", "the pin is on the second body, the bush on the first"}}};
}

/// The position of the pin in the bush at the start: J - B, from the centre of the bush to that of the pin
/// (m, global frame), and how fast it changes (m/s). Zero: centred, with the velocities of the ideal linkage.
struct PinStart {
  std::complex<double> eccentricity{0, 0}, rate{0, 0};
};

/// A pin that has clearance.
struct ContactJoint {
  int joint = 0;           ///< revolute joint of the linkage, without drive and friction
  double clearance = 0;    ///< c, m, > 0: radius of the bush less radius of the pin
  double bush_radius = 0;  ///< m, more than the clearance; arm of friction
  ContactLaw law;
  PinSide pin = PinSide::first;
  PinStart start;
};

/// A pin in its bush at one instant.
struct PinPlace {
  math::Vec2 eccentricity{0, 0}, rate{0, 0};  ///< J - B, m and m/s, global frame
  math::Vec2 normal{1, 0};                    ///< direction of the eccentricity
  double distance = 0;                        ///< m, of the centres
  double depth = 0, depth_rate = 0;           ///< m and m/s: distance less clearance; negative in flight
  /// m/s: speed of the surface of the pin against that of the bush, anticlockwise, both spins included.
  double slip = 0;
};

/// Forces between pin and bush (N): pressing, and on the pin clockwise around the bush.
struct PinForce {
  double normal = 0, friction = 0;
};

/// The pins of an open linkage, with two forces and two torques each in the linkage. Linkage and joints must
/// outlive this.
class ContactPins {
 public:
  ContactPins(OpenLinkage& open, std::span<const ContactJoint> joints);

  std::size_t size() const { return places_.size(); }
  const PinPlace& operator[](std::size_t pin) const { return places_[pin]; }

  /// Sets the positions of pins and bushes; call after solve_velocity.
  void place(const planar::LinkageMotion& motion);

  /// Makes the forces of the places loads of the linkage: on the pin at its point of contact, and the
  /// opposite on the bush there, so that they balance.
  void press(std::span<const PinForce> forces);

  /// The acceleration of the eccentricity and of the depth (m/s2); call after solve_acceleration.
  math::Vec2 acceleration(const planar::LinkageMotion& motion, std::size_t pin) const;
  double depth_acceleration(const planar::LinkageMotion& motion, std::size_t pin) const;

  /// Direction of the eccentricity in the frame of the body that carries the bush, rad.
  double bush_angle(const planar::LinkageMotion& motion, std::size_t pin) const;

 private:
  planar::BodyPoint journal(std::size_t pin) const;
  planar::BodyPoint bush(std::size_t pin) const;

  OpenLinkage& open_;
  std::span<const ContactJoint> joints_;
  std::size_t first_force_, first_torque_;
  std::vector<PinPlace> places_;
};

}  // namespace linkwright::clearance
