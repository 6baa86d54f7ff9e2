// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/core/status.h"
#include "linkwright/math/sincos.h"
#include "linkwright/parallel/pi_joint/kernel.h"

/// Active Pi-joint: a parallelogram driven by the length of its diagonal (Milutinovic et al. 2014, equation
/// numbers in parentheses). m, rad.
///
///                 A       O = (0, 0), B = (0, b)  pivots in the base
///               ,/|       OC, BA                  arms, length a, angle theta from +x
///      B     ,-/  |       CA                      coupler, length b, does not turn
///      | ,-'  /   |       OA                      telescopic diagonal, length d: the drive
///      |    /     C
///      |  /   ,-'
///      |/ ,-'             phi = direction of the diagonal from +x
///      O                  mu = angle between diagonal and arm, gamma = between diagonal and base
///
/// A point of the coupler moves as if it sat on a link of length a about O, but the coupler keeps its
/// orientation. All formulas are those of the parallelogram: at theta = +-pi/2, where the pivots lie on a
/// line, the joint could also continue as an antiparallelogram.
namespace linkwright::parallel {

struct PiJoint {
  double arm = 0;    ///< a > 0 (m)
  double ratio = 0;  ///< k = b / a > 0
};

/// b: length of the base between the pivots and of the coupler (m).
inline double base_length(const PiJoint& joint) { return joint.ratio * joint.arm; }

/// Says what keeps it from being a Pi-joint, with the value; nothing if it is one. The functions below do not
/// ask again.
std::optional<std::string> problem(const PiJoint& joint);

/// For the functions of an angle: theta in [-pi/2, pi/2], ends included.
inline PiTerms<double> pi_terms(const PiJoint& joint, double angle) {
  double sine = 0, cosine = 0;
  math::sincos_of_any(0.5 * angle + pi / 4, sine, cosine);
  return pi_terms(joint.arm, joint.ratio, sine, cosine);
}

/// d, (2), accurate at all angles: |a - b| at -pi/2 and a + b at pi/2 (m).
inline double diagonal(const PiJoint& joint, double angle) { return pi_diagonal(pi_terms(joint, angle)); }

/// J = dd/dtheta, (7) (m): rate of the diagonal per rate of the angle, torque per force of the diagonal, and
/// a sin(mu). At least 0; 0 at +-pi/2, except for k = 1, where it tends to a at -pi/2.
inline double jacobian(const PiJoint& joint, double angle) {
  const PiTerms<double> t = pi_terms(joint, angle);
  return t.root == 0 ? joint.arm : pi_jacobian(t);
}

/// J' = dJ/dtheta (m).
inline double jacobian_slope(const PiJoint& joint, double angle) {
  const PiTerms<double> t = pi_terms(joint, angle);
  return t.root == 0 ? 0 : pi_jacobian_slope(t);
}

/// theta for a given diagonal.
struct PiAngle {
  /// done, or no_assembly where the diagonal is outside |a - b| ... a + b by more than rounding.
  Status status = Status::done;
  double angle = nan;  ///< theta in [-pi/2, pi/2]; NaN when not done
  double gap = 0;      ///< error of the diagonal, too long (> 0) or too short (< 0) (m)
};
/// (3)-(5) as half angles. Its error grows towards both limits of the diagonal, where the joint is singular:
/// rounding of d by eps d moves theta by eps d / J.
PiAngle angle_of(const PiJoint& joint, double diagonal);

/// Angles of the triangle O, A, B. The source draws phi and mu without a formula; these are the ones that
/// agree with its text, and sin(mu) = J / a.
struct PiAngles {
  double diagonal_direction = 0;  ///< phi, in [-pi/2, pi/2]
  double transmission = 0;        ///< mu = phi - theta, in [0, pi]; at most asin(k) for k < 1
  double base = 0;                ///< gamma = pi/2 - phi, in [0, pi]
};
PiAngles angles(const PiJoint& joint, double angle);

/// Derivatives of phi by theta.
struct PiDirectionSlopes {
  double slope = 0;      ///< phi'
  double curvature = 0;  ///< phi''
};
PiDirectionSlopes direction_slopes(const PiJoint& joint, double angle);

/// A length or angle with its derivatives by time (m or rad, per s, per s2).
struct PiMotion {
  double value = 0, rate = 0, acceleration = 0;
};

/// Motion of d for one of theta: (6) and (18)-(20) corrected, d'' = J theta'' + J' theta'^2.
PiMotion diagonal_motion(const PiJoint& joint, const PiMotion& angle);

/// Motion of phi for one of theta.
PiMotion direction_motion(const PiJoint& joint, const PiMotion& angle);

/// Motion of theta for one of d, (8).
struct PiAngleMotion {
  /// done; no_assembly: nothing is known; singular: the angle is known, but at +-pi/2 (within
  /// tolerance::toggle_angle) the diagonal does not determine its rates.
  Status status = Status::done;
  PiMotion motion;  ///< NaN for what is not known
};
PiAngleMotion angle_motion(const PiJoint& joint, const PiMotion& diagonal);

}  // namespace linkwright::parallel
