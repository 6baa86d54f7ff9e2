// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "linkwright/planar/linkage/motion.h"

// Quick-return linkages by their dead centres: crank-rockers with a swing angle, and slider-cranks with a
// stroke, whose slow and quick strokes have a given time ratio while the crank rotates uniformly.
namespace linkwright::planar {

/// Two strokes between dead centres. At the outer one crank and coupler are in line, at the inner one they
/// overlap; the crank turns by pi + |imbalance| during the slow stroke and by pi - |imbalance| during the
/// quick one.
struct Strokes {
  double swing = 0;      ///< rad, of the rocker, in (0, pi); 0 = a slider, which is an endless rocker
  double imbalance = 0;  ///< rad; > 0: slow stroke against the crank, < 0: with it. Of a slider with the
                         ///< guide along +x and a crank that turns counter-clockwise > 0: slow inwards.
};

/// |imbalance| (rad) of a time ratio >= 1 of slow to quick stroke, and the other way.
double imbalance_of(double time_ratio);
double time_ratio_of(double imbalance);
/// The largest |imbalance| (rad), not reached: (pi + swing) / 2 with the crank, (pi - swing) / 2 against it.
double max_imbalance(double swing, bool with_crank);

/// A linkage by its lengths in couplers (rods). Dead-centre construction (Alt 1925; VDI 2130): seen from the
/// crank's axis the dead centres of B lie in directions that differ by the imbalance, as all points of one
/// circle see them. With x = crank^2, half swing u, half imbalance v:
/// rocker^2 sin^2 u = sin^2 v + x cos^2 v, ground^2 sin^2 u = sin^2(u + v) + x cos^2(u + v).
struct StrokeLinkage {
  double crank = 0;
  double rocker = 0, ground = 0;  ///< infinite of a slider
  double chord = 0;               ///< distance of the dead centres of B: the stroke of a slider
  double offset = 0;              ///< offset of a slider's guide, along the left normal of its direction
  /// Least angle between coupler and rocker (rod and normal of the guide) over the turn, 0 to pi/2.
  double transmission_angle = 0;
};

/// All linkages of two strokes: one for each length of the crank (in couplers) from `shortest` to 1, both
/// excluded, because the linkage locks there. Nothing when there is none (see max_imbalance).
///
/// Throws ContractError unless 0 <= swing < pi and |imbalance| < pi.
std::optional<double> shortest_crank(const Strokes& strokes);

/// The linkage of a crank in (shortest_crank, 1).
StrokeLinkage stroke_linkage(const Strokes& strokes, double crank);

/// The crank in (shortest_crank, 1) of the largest transmission angle. Its square x is the only positive root
/// of x^3 + 2 t x^2 - t x - t (1 + t) w = 0, t = tan^2 v, w = tan^2(u + v) (Freudenstein and Primrose 1973).
/// Without imbalance it is 0, because the angle grows with the coupler without end.
///
/// Throws ContractError when there is no linkage.
double best_crank(const Strokes& strokes);

/// The lengths of which one ratio decides the linkage.
enum class StrokeLength { crank, coupler, rocker, ground, chord };
double length_of(const StrokeLinkage& linkage, StrokeLength which);  ///< in couplers
/// The crank (in couplers) for which two lengths have this ratio; nothing when no length of the crank gives
/// it, or all do. It may lie outside of (shortest_crank, 1).
std::optional<double> crank_of_ratio(const Strokes& strokes, StrokeLength one, StrokeLength other,
                                     double ratio);

/// The least transmission angle (rad, 0 to pi/2) of the groups of a linkage that close a loop.
double min_transmission_angle(const LinkagePlan& plan, const LinkageMotion& motion);

/// Strokes of any linkage with one rotary input, by its motion over a turn.
struct SweptStrokes {
  double swing = 0;                ///< rad or m
  double rise = 0;                 ///< rad, that the input turns counter-clockwise while the output rises
  double at_low = 0, at_high = 0;  ///< inputs (rad) at the dead centres of the output
  double transmission_angle = 0;   ///< rad, least over all dyads, at the inputs looked at
};
/// The strokes of the rotation of a body, or of its place along x. Dead centres are where the rate of the
/// output changes its sign. Nothing when the linkage does not assemble over the turn, or has not two dead
/// centres.
///
/// Throws ContractError when the linkage cannot be solved, or has no single input.
std::optional<SweptStrokes> sweep_strokes(const Linkage& linkage, int body, bool slides, int samples = 720);

}  // namespace linkwright::planar
