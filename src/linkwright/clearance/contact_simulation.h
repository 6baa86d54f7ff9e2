// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/clearance/contact_pins.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/planar/simulation/simulation.h"

// Joints with clearance in which pin and bush fly free, strike, press and slide: any pins of any planar
// linkage of rigid bodies.
namespace linkwright::clearance {

struct ContactOptions {
  /// In flight and impacts; contacts that are pressed together for long, whose damping makes the equations
  /// stiff, are integrated by bdf.
  math::OdeMethod method = math::OdeMethod::explicit_runge_kutta_5;
  /// Error of a step, relative; absolute: this times the clearance for the displacements of the pin.
  double tolerance = 1e-9;
  /// Longest step in contact as a share of the time that the impact would last by itself, or, where the
  /// bodies stay pressed together beyond that, of the time since then: what vibrates has the steps that its
  /// errors ask for, what has come to rest takes long ones, by bdf.
  double contact_step = 0.05;
  long max_steps = 10'000'000;
  /// Contacts that are listed, the first ones; all others count in the totals alone.
  std::size_t max_events = 100'000;
  /// Ends early, not_converged, when StepPace sees that max_steps will not do.
  bool stop_when_hopeless = false;
};

/// One contact, from the touch to the separation.
struct ContactEvent {
  int joint = 0;            ///< index into the contact joints
  double start = 0;         ///< s
  double approach = 0;      ///< m/s, rate of the depth then
  double angle = 0;         ///< rad: direction of the eccentricity then, global
  double bush_angle = 0;    ///< rad: the same in the frame of the body that carries the bush
  double end = nan;         ///< s; NaN when it was still on at the end
  double separation = nan;  ///< m/s, rate at which they part, positive
  double depth = 0;         ///< m, largest
  double force = 0;         ///< N, largest normal force
};

/// All contacts of one joint, listed or not.
struct ContactTotals {
  long contacts = 0;
  double touching = 0;         ///< s in contact
  double approach = 0;         ///< m/s, largest
  double depth = 0;            ///< m, largest
  double force = 0;            ///< N, largest
  double shortest = infinity;  ///< s, of those that ended
  void add(const ContactEvent& event, double from, double to);
};

/// State of one joint in a row.
struct ContactState {
  std::complex<double> eccentricity, rate;  ///< J - B, m and m/s
  double depth = 0;                         ///< |eccentricity| - c, m; negative in flight
  double normal = 0;                        ///< N
  double friction = 0;                      ///< N, on the pin against growing direction of the eccentricity
  bool contact = false;
};

/// One row; valid during the call that receives it.
struct ContactRow {
  double time = 0;
  std::span<const ContactState> joints;
  std::span<const planar::InputMotion> inputs;  ///< data of the open linkage
  /// Motion of the open linkage, with velocities and accelerations.
  const planar::LinkageMotion* motion = nullptr;
  double kinetic = 0, potential = 0;  ///< J; potential: weight and springs
  double elastic = 0;                 ///< J, in the contacts
  double dissipated = 0;              ///< J since the start, by damping and friction of the contacts
  double work = 0;   ///< J since the start, of prescribed drives and of other loads that store no energy
  double drift = 0;  ///< J: kinetic + potential + elastic + dissipated - work less its value at the start
};
/// false ends the simulation.
using ContactOutput = std::function<bool(const ContactRow&)>;

struct ContactRun {
  /// done; infeasible, no_assembly, singular: the start does not work; limit_reached, not_converged: the
  /// motion ends; cancelled, deadline. Rows and events so far are kept.
  Status status = Status::done;
  std::string message;                ///< says why it is not `done`; else empty
  double time = 0;                    ///< reached, s
  std::vector<ContactEvent> events;   ///< in the order of their starts, max_events at most
  std::vector<ContactTotals> totals;  ///< one a joint
  double largest_drift = 0;           ///< J, over the rows
  double peak_energy = 0;  ///< J: largest kinetic, elastic or dissipated energy, change of potential, or work
  long steps = 0, evaluations = 0;
};

/// The motion. `drives` are those of the inputs of the linkage, laws or free; a law's joint keeps its drive.
/// `times` (s, rising, two at least) are those of the rows: nothing else depends on them. Coordinates are
/// those of the open linkage, so that joints without clearance cannot drift apart.
///
/// No impact is missed: in flight a step moves the pin by half the clearance at most, and within every step
/// the depth is followed between its ends (see math::integrate); flights shorter than 1e-10 s are not
/// reported apart. A contact that begins more slowly than min_approach counts as begun with that. A start
/// whose eccentricity is the clearance up to rounding is in contact when the bodies would press into each
/// other.
///
/// Throws ContractError as open_linkage and require_valid do, for clearances and radii out of range, starts
/// outside of the bush by more than half the clearance, and as planar::simulate does.
ContactRun simulate_contact(const planar::Linkage& linkage, std::span<const ContactJoint> joints,
                            std::span<const planar::InputDrive> drives, std::span<const double> times,
                            const ContactOptions& options = {}, const ContactOutput& output = {},
                            const RunContext* context = nullptr);

}  // namespace linkwright::clearance
