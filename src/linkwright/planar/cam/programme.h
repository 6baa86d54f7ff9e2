// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/motion_law.h"

/// @file
/// Motion programmes of cams: the motion of a follower over the angle of its cam, segment by segment. A value
/// is a lift (m) or an angle (rad) of the follower; its derivatives are by radians of the cam.
namespace linkwright::planar {

/// A sense of rotation.
enum class Rotation {
  counterclockwise,  ///< counter-clockwise
  clockwise          ///< clockwise
};
constexpr std::array<EnumName<Rotation>, 2> names(Rotation) {
  return {{{Rotation::counterclockwise, "counterclockwise"}, {Rotation::clockwise, "clockwise"}}};
}

/// The part of a follower that touches the cam.
enum class FollowerFace {
  roller,  ///< a roller
  knife,   ///< an edge, as a roller without radius
  flat     ///< a straight face
};
constexpr std::array<EnumName<FollowerFace>, 3> names(FollowerFace) {
  return {{{FollowerFace::roller, "roller", "a roller"},
           {FollowerFace::knife, "knife", "an edge, as a roller without radius"},
           {FollowerFace::flat, "flat", "a straight face"}}};
}

/// The law of a segment between its end values.
enum class CamLaw {
  dwell,               ///< the follower rests
  constant_speed,      ///< a straight line; its speed jumps at dwells
  harmonic,            ///< half a cosine; its acceleration jumps at dwells
  cycloidal,           ///< a sine as acceleration
  polynomial_345,      ///< 10 x^3 - 15 x^4 + 6 x^5
  polynomial_4567,     ///< 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7: no jerk at the ends
  modified_trapezoid,  ///< acceleration of quarter sines and constant parts
  modified_sine,       ///< acceleration of a fast sine at the ends and a slow one between them
  polynomial           ///< least degree that meets the conditions given at either end
};
constexpr std::array<EnumName<CamLaw>, 9> names(CamLaw) {
  return {
      {{CamLaw::dwell, "dwell", "the follower rests"},
       {CamLaw::constant_speed, "constant_speed", "a straight line; its speed jumps at dwells"},
       {CamLaw::harmonic, "harmonic", "half a cosine; its acceleration jumps at dwells"},
       {CamLaw::cycloidal, "cycloidal", "a sine as acceleration"},
       {CamLaw::polynomial_345, "polynomial_345", "10 x^3 - 15 x^4 + 6 x^5"},
       {CamLaw::polynomial_4567, "polynomial_4567", "4-5-6-7 polynomial: no jerk at the ends"},
       {CamLaw::modified_trapezoid, "modified_trapezoid", "acceleration of quarter sines and constant parts"},
       {CamLaw::modified_sine, "modified_sine",
        "acceleration of a fast sine at the ends and a slow one between them"},
       {CamLaw::polynomial, "polynomial", "polynomial through the conditions given at either end"}}};
}

/// A law from 0 to 1 over x from 0 to 1.
/// @param law any law but `polynomial`, which has no form of its own
/// @param x share of the segment, in [0, 1]; at a step inside the segment the value to the right counts
/// @returns S and its first three derivatives by x; zeros for a dwell
/// @throws ContractError for `polynomial`, and for x outside [0, 1]
math::Motion normalised_motion(CamLaw law, double x);

/// A condition on the derivatives at the ends of a segment whose law is `polynomial`; by radians of the cam.
struct SegmentConditions {
  std::optional<double> start_rate,  ///< m/rad or rad/rad
      start_acceleration,            ///< m/rad2 or rad/rad2
      start_jerk;                    ///< m/rad3 or rad/rad3
  std::optional<double> end_rate,    ///< m/rad or rad/rad
      end_acceleration,              ///< m/rad2 or rad/rad2
      end_jerk;                      ///< m/rad3 or rad/rad3
};

/// A part of a programme, from the value at which the one before it ends.
struct CamSegment {
  CamLaw law = CamLaw::dwell;    ///< the law
  double over = 0;               ///< angle of the cam (rad), > 0
  double to = 0;                 ///< value at the end (m or rad); unused by a dwell
  SegmentConditions conditions;  ///< used by `polynomial` alone
};

/// A smooth curve through rows: a quintic spline, periodic over a full turn and natural over a sector.
struct CamTable {
  std::vector<double> angles;  ///< rad, increasing, the first is 0 and the last the angle of the programme
  std::vector<double> values;  ///< m or rad, one for each angle
};

/// A motion programme.
struct CamProgramme {
  double start = 0;        ///< value at angle 0 (m or rad)
  double angle = 2 * pi;   ///< angle that the programme covers (rad), in (0, 2 pi]
  bool is_sector = false;  ///< true if the cam stops at the ends; false if it turns and the programme repeats
  std::vector<CamSegment> segments;  ///< in their order; empty with a table
  std::optional<CamTable> table;     ///< rows in place of segments
};

/// A kind of finding about a programme.
enum class ProgrammeIssue {
  no_motion,             ///< there are neither segments nor a table, or a number is not usable
  segments_do_not_fill,  ///< `size` is the angle that is missing (rad), negative if there is too much
  does_not_close,        ///< `size` is the end value less the start value (m or rad)
  jump_of_value,         ///< `size` is the step of the value (m or rad)
  jump_of_rate,          ///< `size` is the step of the first derivative (per rad)
  jump_of_acceleration,  ///< `size` is the step of the second derivative (per rad2)
  jump_of_jerk           ///< `size` is the step of the third derivative (per rad3)
};
constexpr std::array<EnumName<ProgrammeIssue>, 7> names(ProgrammeIssue) {
  return {{{ProgrammeIssue::no_motion, "no_motion"},
           {ProgrammeIssue::segments_do_not_fill, "segments_do_not_fill"},
           {ProgrammeIssue::does_not_close, "does_not_close"},
           {ProgrammeIssue::jump_of_value, "jump_of_value"},
           {ProgrammeIssue::jump_of_rate, "jump_of_rate"},
           {ProgrammeIssue::jump_of_acceleration, "jump_of_acceleration"},
           {ProgrammeIssue::jump_of_jerk, "jump_of_jerk"}}};
}

/// The weight of a finding.
enum class ProgrammeSeverity {
  error,    ///< no cam can do that
  warning,  ///< a cam can, but with shocks
  note      ///< worth knowing
};

/// A finding about a programme.
struct ProgrammeFinding {
  ProgrammeIssue issue = ProgrammeIssue::no_motion;       ///< what it is
  ProgrammeSeverity severity = ProgrammeSeverity::error;  ///< its weight
  double angle = 0;                                       ///< angle of the cam where it is (rad)
  double size = 0;                                        ///< see ProgrammeIssue
  std::size_t part = 0;  ///< index of the segment that begins there, or of the row of the table
};

/// A programme that is ready to be evaluated.
class ProgrammeCurve {
 public:
  /// Prepares a programme.
  /// @param programme a programme whose numbers are usable: `findings` has no `no_motion`
  /// @throws ContractError if the programme has no motion
  explicit ProgrammeCurve(const CamProgramme& programme);

  /// The motion at an angle of the cam. At a step the value to the right counts. A programme of a turning cam
  /// repeats; that of a sector rests at its ends.
  /// @param angle angle of the cam (rad), finite
  /// @returns value and its derivatives by radians of the cam
  math::Motion operator()(double angle) const;

  /// @returns the angles at which parts begin, and the end of the last one (rad)
  const std::vector<double>& breaks() const { return breaks_; }

  /// The motion of one part, ends included.
  /// @param part index of the part, less than breaks().size() - 1
  /// @param angle angle of the cam (rad) in that part
  /// @returns value and its derivatives by radians of the cam
  math::Motion part(std::size_t part, double angle) const;

 private:
  // A law between two values, or a curve over the angle of the cam.
  struct Piece {
    CamLaw law = CamLaw::dwell;
    double from = 0, to = 0;
    std::optional<math::MotionCurve> curve;
  };
  std::vector<double> breaks_;
  std::vector<Piece> pieces_;
  bool is_sector_ = false;
};

/// Checks a programme: segments that do not fill its angle (to 1e-9 rad), an end that is not the start,
/// and steps of the value and its derivatives, where 1e-9 of the largest size of each is no step.
/// @param programme the programme
/// @returns the findings in the order of their angles; errors of the whole programme come first
std::vector<ProgrammeFinding> findings(const CamProgramme& programme);

}  // namespace linkwright::planar
