// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "linkwright/clearance/contact_simulation.h"

// Analyses of long contact simulations.
namespace linkwright::clearance {

/// Amplitudes by frequency.
struct Spectrum {
  std::vector<double> frequency;  ///< Hz, from 0 to half the sampling frequency
  std::vector<double> amplitude;  ///< amplitude of the cosine of that frequency; at 0 the mean
};
/// Spectrum of samples at equal intervals `interval` (s): the discrete Fourier transform of all of them. With
/// a window (Hann), amplitudes of frequencies that do not fit into the stretch leak less into others. At
/// least 2 samples; throws ContractError for fewer, an interval that is not positive, and samples that are
/// not finite.
Spectrum amplitude_spectrum(std::span<const double> samples, double interval, bool window = false);

/// State of a pin in its bush once a turn.
struct SectionPoint {
  double time = 0;
  std::complex<double> eccentricity, rate;  ///< m, m/s
};
struct PoincareSection {
  ContactRun run;
  std::vector<std::vector<SectionPoint>> joints;  ///< one a contact joint
};
/// Samples a motion of `period` (s; of the crank) at start + k period, k = from ... to, 0 <= from < to. A
/// periodic motion shows as a point, subharmonics as a few, chaos as a cloud. Arguments as in
/// simulate_contact.
PoincareSection poincare_section(const planar::Linkage& linkage, std::span<const ContactJoint> joints,
                                 std::span<const planar::InputDrive> drives, double start, double period,
                                 int from, int to, const ContactOptions& options = {},
                                 const RunContext* context = nullptr);

}  // namespace linkwright::clearance
