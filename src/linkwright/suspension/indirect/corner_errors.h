// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/field.h"
#include "linkwright/suspension/corner/carrier_poses.h"
#include "linkwright/suspension/indirect/link_fit_motion.h"
#include "linkwright/suspension/indirect/link_task.h"
#include "linkwright/suspension/indirect/pose_completion.h"

namespace linkwright::suspension {

/// The values of the carrier pitch at positions that do not prescribe it (Poznanovic 2016, section 5.3.5).
enum class CarrierPitchTechnique { each, quadratic, dyad };
constexpr std::array<EnumName<CarrierPitchTechnique>, 3> names(CarrierPitchTechnique) {
  return {{{CarrierPitchTechnique::each, "each", "an unknown of its own at each position"},
           {CarrierPitchTechnique::quadratic, "quadratic",
            "a quadratic of the wheel travel with another coefficient above than below the reference"},
           {CarrierPitchTechnique::dyad, "dyad", "what the first US link makes it, in closed form"}}};
}

/// Sums of the structural errors of a link, a coupler or all of them (m).
struct ErrorTotals {
  double sum = 0, square = 0, largest = 0;
  int count = 0;  ///< equations times positions
  double mean() const { return count > 0 ? sum / count : 0; }
  double rms() const;
  void add(double error);
  void add(const ErrorTotals& other);
};

/// Structural errors of several links and couplers together, over all their unknowns: coordinates, offsets of
/// couplers, and values of missing carrier pitches. For searches that cannot take the links one by one,
/// since they share the carrier pitches or a coupler. One object serves one thread.
class CornerErrors {
 public:
  /// Throws ContractError for tasks that LinkCoordinates refuses, couplers on links that are not there or of
  /// other types, a dyad without a US link, a quadratic for positions with the rack moved.
  CornerErrors(const CarrierTargets& targets, std::span<const LinkTask> links,
               std::span<const CouplerTask> couplers = {},
               CarrierPitchTechnique technique = CarrierPitchTechnique::each,
               double largest_carrier_pitch = 0.5);

  std::size_t unknowns() const { return lower_.size(); }
  std::span<const double> lower() const { return lower_; }
  std::span<const double> upper() const { return upper_; }
  const std::vector<std::string>& unknown_names() const { return names_; }
  /// Carrier pitches come last among the unknowns, after coordinates and offsets.
  std::size_t carrier_pitch_unknowns() const { return carrier_pitch_unknowns_; }
  std::size_t rows() const { return rows_; }

  /// Errors, as structural_errors has them link by link, then those of the couplers, distance from 34 to 14
  /// less that at the reference (59)-(64); `jacobian` is empty or their exact derivatives, column-major.
  /// False where points coincide that must not, or the dyad cannot be assembled: see shortfall.
  bool evaluate(std::span<const double> x, std::span<double> errors, std::span<double> jacobian);

  /// Links for the last x, in the frame of the vehicle.
  std::vector<CornerLink> links() const;
  std::vector<Coupler> couplers() const;
  double offset(std::size_t coupler) const { return couplers_[coupler].offset; }
  CarrierTargets targets() const;
  double shortfall() const { return shortfall_; }  ///< m: by what the dyad misses, over all positions

  /// The unknowns of given links and couplers, carrier pitches of the targets left out; moved into the
  /// bounds.
  void start_from(std::span<const CornerLink> links, std::span<const Coupler> couplers,
                  std::span<double> x) const;

  /// Figures of errors: of link j, of coupler j, of all.
  ErrorTotals link_totals(std::size_t link, std::span<const double> errors) const;
  ErrorTotals coupler_totals(std::size_t coupler, std::span<const double> errors) const;
  ErrorTotals totals(std::span<const double> errors) const;

 private:
  struct LinkPart {
    LinkCoordinates coordinates;
    CornerLink link;  ///< counted from the wheel centre
    std::size_t first_unknown = 0, first_row = 0, rows = 0;
  };
  struct CouplerPart {
    CouplerTask task;
    double offset = 0;
    Vec3 point;  ///< counted from the wheel centre
    std::size_t first_row = 0;
    std::array<int, 4> columns{};  ///< columns of offset and point, -1 = given
  };
  struct Pose {
    std::size_t target = 0;
    Mat3 before, after, rate;  ///< rotation = before * turn_y(carrier pitch) * after
    bool open = false;
    double travel = 0;
  };

  // Parts of the constructor, in this order; each adds its unknowns and rows.
  void add_poses();
  std::size_t add_unknown(std::string name, double lower, double upper);
  void add_link(const LinkTask& task, bool alone);
  void add_coupler(const CouplerTask& task, std::span<const LinkTask> links);
  void add_carrier_pitches(double largest_carrier_pitch);

  bool place(std::span<const double> x, bool rates);
  bool set_dyad_carrier_pitches();
  void add_carrier_pitch_derivatives(std::span<double> jacobian);
  bool evaluate_coupler(const CouplerPart& part, std::span<double> errors, std::span<double> jacobian);
  void add_carrier_pitch(std::size_t pose, std::size_t row, double derivative,
                         std::span<double> jacobian) const;
  const LinkMotion& motion(const CornerLink& link) const { return motions_[link.moved_by_rack ? 1 : 0]; }

  CarrierTargets targets_;
  CarrierPitchTechnique technique_;
  std::vector<LinkPart> links_;
  std::vector<CouplerPart> couplers_;
  std::vector<Pose> poses_;
  /// Motions of links that the rack does not move, and of those that it moves.
  std::array<LinkMotion, 2> motions_;
  std::vector<double> carrier_pitches_;  ///< carrier pitches of all targets
  std::vector<double> lower_, upper_;
  std::vector<std::string> names_;
  std::size_t rows_ = 0, carrier_pitch_unknowns_ = 0, first_carrier_pitch_ = 0;
  int dyad_ = -1;
  std::vector<SettlingStep> settling_;  ///< order in which the carrier pitches of the dyad are determined
  double shortfall_ = 0;
  std::vector<double> scratch_;
  struct CarrierPitchColumn {
    std::size_t column;
    double derivative;
  };
  std::vector<std::vector<CarrierPitchColumn>> carrier_pitch_columns_;  ///< columns of each pose
};

}  // namespace linkwright::suspension
