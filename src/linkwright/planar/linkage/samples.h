// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/planar/linkage/linkage.h"

namespace linkwright::planar {

/// A built-in linkage with its drive, ready to be analysed: every body has its mass, and every pair with two
/// assembly modes has its mode, by name or by its start poses.
struct LinkageSample {
  std::string name;     ///< "jansen_leg"
  std::string summary;  ///< description and hint what to look at
  Linkage linkage;
  /// Inputs of the motion to look at: all inputs run from `from` to `to` (rad or m) together. The start poses
  /// are those at `from`.
  std::vector<double> from, to;
  double speed = 1;               ///< speed of the first input (rad/s or m/s)
  std::vector<BodyPoint> traces;  ///< points whose paths are worth drawing
};

/// A sample whose input turns once, in a second; the traced points as "body.point".
LinkageSample turning_sample(std::string name, std::string summary, Linkage linkage,
                             std::initializer_list<std::string_view> traces);

/// All samples, each under its own name.
std::span<const LinkageSample> linkage_samples();
/// The sample of this name; throws ContractError when there is none.
const LinkageSample& linkage_sample(std::string_view name);

// Four-bars, slider-cranks and their kin.
LinkageSample four_bar_sample();
LinkageSample slider_crank_sample();         ///< in line
LinkageSample offset_slider_crank_sample();  ///< offset, inclined guide
LinkageSample inverted_slider_crank_sample();
LinkageSample scotch_yoke_sample();
LinkageSample whitworth_sample();
/// Crank, rod and knee; the table of the ram's load rises towards the end of the stroke.
LinkageSample toggle_press_sample();
/// Hoeken's straight-line four-bar: ground : crank : coupler : rocker = 2 : 1 : 2.5 : 2.5, the pen at twice
/// the coupler.
LinkageSample hoeken_sample();
/// Chebyshev's straight-line four-bar, 4 : 5 : 2 : 5, the pen in the middle of the coupler; over the part of
/// its motion between the dead points.
LinkageSample chebyshev_sample();

// Six bars and more.
LinkageSample watt_1_sample();
LinkageSample watt_2_sample();
LinkageSample stephenson_3_sample();
/// Driven at the bar between ground and ternary link, so that the four other bodies make one group without
/// closed form: two ternary links with two bars between them.
LinkageSample stephenson_2_sample();
/// A platform on three bars, one of them on a crank (Stephenson III driven in its five-bar loop): a triad.
LinkageSample triad_sample();
/// Klann 2001, US patent 6260862, coordinates of the example leg; 1 unit = 1 m.
LinkageSample klann_leg_sample();
/// The eleven lengths that Jansen published for his Strandbeests, 1 unit = 1 cm; seven moving bodies.
LinkageSample jansen_leg_sample();
/// Peaucellier 1864: the pen P' runs on a straight line, exactly: |O P| |O P'| = arm^2 - side^2.
LinkageSample peaucellier_sample();
/// Parallelogram with two inputs: the pen copies the tracer, twice as large, about the pivot.
LinkageSample pantograph_sample();
LinkageSample geared_five_bar_sample();
/// Andrews' squeezing mechanism (Schiehlen 1990; initial-value-problem test set of Hairer and Wanner): seven
/// bodies, spring and torque as published, without gravity; driven at its crank for analysis.
LinkageSample andrews_squeezer_sample();

// Families.
/// `links` >= 1 bars of 0.4 m in a row, each driven against the one before.
LinkageSample arm_sample(int links);
/// `loops` >= 1 four-bars in a row: loops + 1 rockers and as many couplers as loops, all uniform bars of 1 m
/// and 1 kg (multibody benchmark A02), driven at the first rocker between the folded positions.
LinkageSample four_bar_chain_sample(int loops);

}  // namespace linkwright::planar
