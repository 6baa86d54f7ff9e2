// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/core/table.h"
#include "linkwright/planar/exact/nine_points.h"
#include "linkwright/planar/studies/path_points.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/result.h"

// The findings of exact synthesis, for any mechanism.
namespace linkwright::planar {

/// The number of solutions of an exact synthesis, and their properties as mechanisms.
struct ExactFindings {
  std::string_view mechanism = "four-bar";
  const char* what = "";  ///< the solutions, as "coupler curves through the nine points"
  int whole = 0;          ///< so many have points in general
  bool certificates = false;
  Status stopped = Status::done;  ///< deadline or cancelled
  Completeness completeness = Completeness::incomplete;
  int classes = 0, certified = 0, real_classes = 0, infinite = 0, singular = 0, lost = 0;
  int designs = 0, defect_free = 0, order = 0, circuit = 0, branch = 0;
  std::size_t answers = 0;  ///< without defects and within the limits of the study
};

/// Reports points that repeat another one, not only the one before, and warns of points that lie close
/// together far from the origin (m).
void check_exact_points(study::ObjectReader& target, const char* key, const std::vector<double>& x,
                        const std::vector<double>& y);

/// Reports gates and tolerances, of which exact synthesis knows none; `instead`: what to use for them. False
/// where the targets are gates.
bool check_exact_targets(study::ObjectReader& target, const PathTargetForm& form, const PathTargets& targets,
                         std::string_view instead);

/// The completeness of the set of a solver without certificates.
Completeness completeness_of(const ExactFindings& findings);

/// "All 1442 coupler curves through the nine points, each certified; 64 of them are real."
Sentence found_text(const ExactFindings& findings);

/// Says how many of the mechanisms pass the points in one motion; `whose`: "their" or "these", `best`: what
/// the first one is called.
Sentence answer_text(const ExactFindings& findings, const char* whose, const Sentence& best);

/// Status of a result and the outcome in a word.
struct ExactVerdict {
  Status status = Status::done;
  std::string_view outcome;
};
ExactVerdict judge(const ExactFindings& findings);

/// The numbers of defects and of ends of paths, beside what the study puts before them.
void add_design_counts(Table& counts, const ExactFindings& findings);
void add_path_counts(Table& counts, const ExactFindings& findings);

/// Facts about the mechanisms, and about paths without a solution.
void add_design_facts(const study::AddFact& fact, const ExactFindings& findings);
void add_path_facts(const study::AddFact& fact, const ExactFindings& findings);

/// Offers another order of the points if it would make answers: the order that most mechanisms pass them in;
/// each has its own, from 0, or none.
void offer_order(const study::AddWarning& warn, const ExactFindings& findings,
                 const std::vector<std::vector<int>>& orders);

/// Warns of special points and of lost paths.
void warn_of_missing_solutions(const study::AddWarning& warn, const ExactFindings& findings);

}  // namespace linkwright::planar
