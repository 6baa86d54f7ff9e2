// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/studies/linkage.h"

// The rows of a linkage study, the columns of its table, and how both are filled.
namespace linkwright::planar {

/// True if the linkage is driven over time, not over a grid of inputs.
bool over_time(const LinkageStudy& s);

/// Columns of the table: time or not, inputs, quantities.
std::vector<LinkageColumn> columns_of(const LinkageStudy& s);

/// Solves the rows of a study one after the other. Rows of one input in closed form follow their branch
/// through change points; more than 64 combinations of modes are not listed.
class RowSolver {
 public:
  RowSolver(const LinkageStudy& s, const LinkageRows& rows);

  /// Fills `now`; the status says what of it holds.
  Status solve(std::size_t r);

  LinkageMotion motion;
  LinkageForces forces;
  LinkageInstant now;
  bool passed = false;  ///< true if the row is at a change point that the branch passes or ends at
  std::optional<InputLimits> limits;  ///< ranges of the one input
  std::optional<BranchPath> branch;

 private:
  bool at_change() const;
  void forget_rates();
  void check_redundant();
  void find_circuit(double low, double high);
  bool on_other_circuit(double value) const;

  const LinkageStudy& s_;
  const LinkageRows& rows_;
  LinkageAssembly assembly_;
  std::optional<InputLimits> circuits_;  ///< limits, if rows may be on another circuit than `circuit_`
  int circuit_ = 0;
};

}  // namespace linkwright::planar
