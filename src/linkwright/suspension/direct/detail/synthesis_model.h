// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "linkwright/suspension/direct/synthesis.h"

namespace linkwright::suspension {

/// The results of a design, for a method that uses derivatives: with respect to the design variables in parts
/// of their ranges.
struct DirectPoint {
  bool assembled = false;
  double reached = 0;
  std::vector<double> deviations, by;     ///< [row], [row][number]
  std::vector<double> limits, limits_by;  ///< [limit] excess in centimetres, [limit][number]
};

/// A task as a function of the design variables, each from 0 at its lower to 1 at its upper end.
class DirectModel {
 public:
  /// Throws ContractError as `synthesise` does.
  DirectModel(const DirectTask& task, const DirectOptions& options);

  std::size_t size() const { return task_.designed.size(); }
  std::size_t rows() const { return positions_.rows.size(); }
  std::size_t limits() const { return limits_; }
  const DirectTask& task() const { return task_; }
  const TargetPositions& positions() const { return positions_; }

  Suspension suspension(std::span<const double> u) const;
  std::vector<double> values(std::span<const double> u) const;
  std::vector<double> shares(const Suspension& suspension) const;
  /// The given design, moved into the ranges.
  std::vector<double> given() const;
  double reached(std::span<const double> u) const;

  void evaluate(std::span<const double> u, bool derivatives, DirectPoint& out) const;

 private:
  const DirectTask& task_;
  TargetPositions positions_;
  std::vector<DesignNumber> numbers_;
  std::size_t limits_ = 0;
};

}  // namespace linkwright::suspension
