// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "linkwright/planar/cam/programme.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/function/dead_centres.h"
#include "linkwright/study/kind.h"

// Quick-return linkages: crank-rockers by swing angle and time ratio, slider-cranks by stroke and time ratio;
// what their file holds, how it is read, run and reported.
namespace linkwright::planar {

/// The sense in which the rocker turns during the slow stroke.
enum class SlowSwing { with_crank, against_crank };
constexpr std::array<EnumName<SlowSwing>, 2> names(SlowSwing) {
  return {{{SlowSwing::with_crank, "with_crank", "the rocker turns as the crank does"},
           {SlowSwing::against_crank, "against_crank", "it turns the other way"}}};
}
/// The direction in which the slider moves during the slow stroke.
enum class SlowStroke { outward, inward };
constexpr std::array<EnumName<SlowStroke>, 2> names(SlowStroke) {
  return {{{SlowStroke::outward, "outward", "away from the crank"},
           {SlowStroke::inward, "inward", "towards the crank"}}};
}

struct SwingMechanism {
  std::optional<double> ground, crank, coupler, rocker;
  double largest_ratio = 10;
  Branch branch = Branch::open;
  Rotation rotation = Rotation::counterclockwise;
};
/// Lengths that may be given, and how long the coupler (rod) may be.
template <class Visitor, class Length>
void stroke_length_field(Visitor&& visit, std::string_view key, std::string_view summary, Length& value) {
  visit(field::length(key, summary).between(1e-6, 1e6), value);
}
template <class Visitor>
void fields(Visitor&& visit, SwingMechanism& m) {
  stroke_length_field(visit, "ground",
                      "length of the ground link; one length is the scale, two settle the linkage", m.ground);
  stroke_length_field(visit, "crank", "length of the crank, instead or besides", m.crank);
  stroke_length_field(visit, "coupler", "length of the coupler, likewise", m.coupler);
  stroke_length_field(visit, "rocker", "length of the rocker, likewise", m.rocker);
  visit(field::entry("largest_coupler_ratio", "longest coupler, in cranks, that may be chosen")
            .above(1)
            .at_most(1e3),
        m.largest_ratio);
  visit(field::entry("branch", "side of the rocker, seen from the crank"), m.branch);
  visit(field::entry("rotation", "of the crank"), m.rotation);
}
struct StrokeMechanism {
  std::optional<double> crank, rod;
  double largest_ratio = 10;
  Rotation rotation = Rotation::counterclockwise;
};
template <class Visitor>
void fields(Visitor&& visit, StrokeMechanism& m) {
  stroke_length_field(visit, "crank", "length of the crank; default: the one that transmits best", m.crank);
  stroke_length_field(visit, "rod", "length of the rod instead", m.rod);
  visit(field::entry("largest_rod_ratio", "longest rod, in cranks, that may be chosen").above(1).at_most(1e3),
        m.largest_ratio);
  visit(field::entry("rotation", "of the crank"), m.rotation);
}

template <class Visitor>
void time_ratio_fields(Visitor&& visit, std::optional<double>& time_ratio, std::optional<double>& imbalance) {
  visit(field::entry("time_ratio", "time of the slow stroke over that of the quick one, 1 or more")
            .between(1, 1e3),
        time_ratio);
  visit(field::angle("imbalance_angle",
                     "instead: the crank turns by 180 degrees and this during the slow stroke")
            .between(0, 3.12413936106985),
        imbalance);
}
struct SwingTarget {
  double swing = 0;
  std::optional<double> time_ratio, imbalance;
  std::optional<SlowSwing> slow;
};
template <class Visitor>
void fields(Visitor&& visit, SwingTarget& t) {
  visit(field::angle("swing_angle", "of the rocker between its dead centres")
            .between(1e-3, 3.12413936106985)
            .required(),
        t.swing);
  time_ratio_fields(visit, t.time_ratio, t.imbalance);
  visit(field::entry("slow_stroke", "sense of the slow stroke; default: the better one"), t.slow);
}
struct StrokeTarget {
  double stroke = 0;
  std::optional<double> time_ratio, imbalance;
  SlowStroke slow = SlowStroke::outward;
};
template <class Visitor>
void fields(Visitor&& visit, StrokeTarget& t) {
  visit(field::length("stroke", "of the slider between its dead centres").between(1e-6, 1e6).required(),
        t.stroke);
  time_ratio_fields(visit, t.time_ratio, t.imbalance);
  visit(field::entry("slow_stroke", "sense of the slow stroke"), t.slow);
}

/// A length that is given.
struct GivenLength {
  StrokeLength which = StrokeLength::ground;
  double length = 0;  ///< m
};
/// The question: for a crank-rocker one or both senses of the slow stroke, for a slider-crank one.
struct SwingStudy {
  bool slider = false;
  double swing = 0;                  ///< rad; 0 of a slider
  double imbalance = 0;              ///< rad, >= 0
  std::vector<Strokes> senses;       ///< senses that are possible
  std::array<GivenLength, 2> given;  ///< the scale, and the length that determines the linkage
  bool settled = false;              ///< true if the second one is given
  double largest_ratio = 10;
  Branch branch = Branch::open;
  Rotation rotation = Rotation::counterclockwise;
};

/// The crank (in couplers) of a study: by the given lengths, or of the largest transmission angle; nothing
/// when there is none.
std::optional<double> chosen_crank(const SwingStudy& study, const Strokes& strokes);

/// "synthesis" of "planar.four_bar" for "swing", and of "planar.slider_crank" for "stroke".
study::Kind swing_kind();
study::Kind stroke_kind();

study::Result run_swing_study(const SwingStudy& study, const study::Common& common, RunContext& context);

}  // namespace linkwright::planar
