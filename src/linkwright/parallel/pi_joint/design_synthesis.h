// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/sentence.h"
#include "linkwright/optimise/optimiser.h"
#include "linkwright/parallel/pi_joint/pi_joint.h"

/// The smallest Pi-joint that does what is required over a range of its angle: its arm a, ratio k and centre
/// theta_c of the range. A joint and its mirror image, a and b exchanged, have the same diagonal; here
/// b <= a, k <= 1.
namespace linkwright::parallel {

/// The values of a joint over the range theta_c +- Delta. J has one maximum and is least at an end.
struct PiRangeValues {
  double min_jacobian = 0, greatest_jacobian = 0;  ///< J (m)
  double min_diagonal = 0, greatest_diagonal = 0;  ///< d (m)
  double min_transmission = 0;                     ///< mu, folded to [0, pi/2] (rad)
  double stroke() const { return greatest_diagonal - min_diagonal; }
  double telescoping() const { return greatest_diagonal / min_diagonal; }
};
/// The range must lie within [-pi/2, pi/2].
PiRangeValues range_values(const PiJoint& joint, double centre, double half_travel);

/// The centre with which the least J is largest, in closed form: sin(theta_c) = -k cos(Delta) for k <= 1 (1/k
/// for k > 1). Then J is b cos(Delta) at both ends and b between, and the stroke is 2 b sin(Delta).
double best_centre(const PiJoint& joint, double half_travel);

/// Largest ratio k with d_max <= telescoping d_min over +-half_travel about the best centre, in (0, 1).
double centred_ratio_limit(double half_travel, double telescoping);
/// The same for a range about 0; at most 1.
double symmetric_ratio_limit(double half_travel, double telescoping);

/// A limit that a joint can reach.
enum class PiLimit { torque, resolution, speed, transmission, stroke, telescoping, ends, ratio };
constexpr std::array<EnumName<PiLimit>, 8> names(PiLimit) {
  return {{{PiLimit::torque, "torque", "torque at the output with the force of the diagonal"},
           {PiLimit::resolution, "resolution", "turn of the output for a step of the diagonal"},
           {PiLimit::speed, "speed", "speed of the output with the rate of the diagonal"},
           {PiLimit::transmission, "transmission", "minimum transmission angle"},
           {PiLimit::stroke, "stroke", "stroke of the diagonal"},
           {PiLimit::telescoping, "telescoping", "longest to shortest diagonal"},
           {PiLimit::ends, "ends", "range of the angle within +-90 deg"},
           {PiLimit::ratio, "ratio", "coupler no longer than the arms"}}};
}

/// Each may be left at its default: not required.
struct PiRequirements {
  double half_travel = 0;         ///< Delta in (0, pi/2) (rad)
  double torque = 0;              ///< at the output, everywhere in the range (N m), with
  double force_limit = infinity;  ///< largest force of the diagonal (N)
  double speed = 0;               ///< required speed of the output (rad/s), with
  double rate_limit = infinity;   ///< largest speed of the diagonal (m/s)
  double quantum = 0;             ///< step of the diagonal (m), which makes
  double resolution = infinity;   ///< a turn of at most this (rad)
  double transmission = 0;        ///< least mu, below pi/2 (rad)
  double stroke = infinity;       ///< m
  double telescoping = infinity;  ///< d_max / d_min, above 1
  double end_margin = pi / 180;   ///< between the range and +-pi/2, above 0 (rad)
};

/// Says what keeps them from being a task, with the value; nothing if they are one. Something must ask for a
/// size: torque with a force limit, or a quantum with a resolution.
std::optional<std::string> problem(const PiRequirements& requirements);

struct PiDesign {
  PiJoint joint;
  double centre = 0;  ///< theta_c (rad)
  double size = 0;    ///< a + b (m): what is minimised
  /// By which share the requirement that is missed most is missed; 0 when all hold.
  double violation = 0;
};

/// Two requirements that no joint with the best centre meets together.
struct PiConflict {
  PiLimit low, high;
  bool of_ratio = false;  ///< limits of the ratio k; else of the base length b (m)
  /// Smallest value that the first requires, and largest that the second allows.
  double at_least = 0, at_most = 0;
};
/// For example "torque asks for a base of at least 61.5 mm, stroke allows at most 60 mm".
Sentence words_of(const PiConflict& conflict);

/// The design by limits in closed form, for the best centre: smallest b, largest k, a = b / k.
struct PiClosedForm {
  std::optional<PiDesign> design;     ///< design that meets all requirements, if there is no conflict
  std::vector<PiConflict> conflicts;  ///< all pairs
};
/// Throws ContractError for requirements with a problem.
PiClosedForm closed_form_design(const PiRequirements& requirements);

struct PiDesignOptions {
  int starts = 12;  ///< random ones, besides the closed form; at least 0
};

/// A limit that holds a design back.
struct PiActiveLimit {
  PiLimit limit;
  /// Share of the size saved per share by which the limit is loosened, at least 0; per share of sin(mu) for
  /// the transmission angle, per radian for the ends.
  double price = 0;
};

struct PiDesignReport {
  /// done; infeasible: no start met every requirement, and `best` misses them least; deadline or cancelled,
  /// with the best so far.
  Status status = Status::done;
  PiDesign best;
  PiClosedForm closed_form;
  /// The closed form is as good as the best that was found (within tolerance of 1e-7 of the size).
  bool closed_form_is_best = false;
  std::vector<PiActiveLimit> active;  ///< at the best design, dearest first; empty when it is infeasible
  /// The rest of the gradient of the logarithm of the size, relative, when those are taken into account.
  double stationarity = nan;
  int starts = 0, reached_best = 0;  ///< local searches, and those that came to the size of the best
  int evaluations = 0;
};

/// The smallest joint by sequential quadratic programming with exact derivatives, from the closed form and
/// from random starts, in some ms.
///
/// The closed form is no proof of the optimum. In 20 000 random tasks with a telescoping limit it was the
/// optimum in 79 %; in the others a range moved upwards, where the diagonal telescopes less, allows a larger
/// ratio, and saves up to 4 % of the size. Without that limit the search saves some 0.01 % by moving off the
/// ends. Conflicts of the ratio can be resolved by moving the range (in 174 of 6346 tasks without a closed
/// form), those of the base never were.
///
/// Throws ContractError for requirements with a problem.
PiDesignReport design_pi_joint(const PiRequirements& requirements, const PiDesignOptions& options,
                               const optimise::Seed& seed, RunContext& context);

}  // namespace linkwright::parallel
