// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/exact_findings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

// Far from the origin the differences of the points lose their digits.
constexpr double min_spread = 1e-9;

void add_count(Table& counts, const char* key, const std::string& label, int value) {
  counts.add(key, label, {static_cast<double>(value)});
}

}  // namespace

Completeness completeness_of(const ExactFindings& f) {
  return f.stopped != Status::done || f.lost > 0 ? Completeness::incomplete
         : f.classes == f.whole                  ? Completeness::complete_uncertified
                                                 : Completeness::special_target;
}

void check_exact_points(study::ObjectReader& target, const char* key, const std::vector<double>& x,
                        const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<std::complex<double>> points;
  double far = 0, spread = 0;
  for (std::size_t k = 0; k < n; ++k) {
    points.emplace_back(x[k], y[k]);
    far = std::max(far, std::abs(points[k]));
    spread = std::max(spread, std::abs(points[k] - points[0]));
  }
  const PointObstacle blocked = obstacle(points);
  if (blocked.kind == PointObstacle::repeated) {
    // The reader has reported neighbours already.
    if (blocked.points[1] - blocked.points[0] != 1 || x[at(blocked.points[0])] != x[at(blocked.points[1])] ||
        y[at(blocked.points[0])] != y[at(blocked.points[1])])
      target.error(key,
                   fmt::format("point {} repeats point {}", blocked.points[1] + 1, blocked.points[0] + 1),
                   "give different points");
  } else if (spread < min_spread * far) {
    target.warning(
        key,
        fmt::format("the points lie within {:.2g} of their distance from the origin: what they differ by "
                    "has few digits",
                    spread / far),
        "give them relative to a place near them");
  }
}

bool check_exact_targets(study::ObjectReader& target, const PathTargetForm& form, const PathTargets& targets,
                         std::string_view instead) {
  if (!targets.gate_x.empty()) {
    target.error(key_of(form), "fit = \"exact\" passes points, not gates",
                 fmt::format("give points, or use what searches: {}", instead));
    return false;
  }
  if (!targets.tolerance.empty())
    target.error(form.tolerance    ? "tolerance"
                 : form.tolerances ? "tolerances"
                                   : "points_file",
                 "fit = \"exact\" passes its points without tolerance",
                 fmt::format("leave it out, or use what searches: {}", instead));
  return true;
}

Sentence found_text(const ExactFindings& f) {
  const Sentence real = say("{} of them {} real", f.real_classes, f.real_classes == 1 ? "is" : "are");
  switch (f.completeness) {
    case Completeness::complete:
      return say("All {} {}, each certified; {}.", f.whole, f.what, real);
    case Completeness::complete_uncertified:
      return f.certificates ? say("All {} {}, {} of them certified; {}.", f.whole, f.what, f.certified, real)
                            : say("All {} {}; {}.", f.whole, f.what, real);
    case Completeness::special_target:
      return say("{} of {} {}: these points are special, the others lie at infinity or coincide; {}.",
                 f.classes, f.whole, f.what, real);
    case Completeness::incomplete:
      return say("{} of {} {}, others may be missing; {}.", f.classes, f.whole, f.what, real);
  }
  return {};
}

Sentence answer_text(const ExactFindings& f, const char* whose, const Sentence& best) {
  if (f.designs == 0) return say("There is no {} to build.", f.mechanism);
  const char* pass = "in one motion and in their order";
  if (f.answers > 0) {
    const auto free = static_cast<std::size_t>(f.defect_free);
    return say("{} of {} {} {}s {} the points {}{}; the best is {}.", free, whose, f.designs, f.mechanism,
               free == 1 ? "passes" : "pass", pass,
               free == f.answers ? Sentence() : say(", {} of them within the limits of the study", f.answers),
               best);
  }
  if (f.defect_free > 0)
    return say("None of the {} {}s that pass the points {} keeps the limits of the study.", f.defect_free,
               f.mechanism, pass);
  return say(
      "None of {} {} {}s passes the points {}: {} change branch on the way, {} circuit, {} meet them in "
      "another order.",
      whose, f.designs, f.mechanism, pass, f.branch, f.circuit, f.order);
}

ExactVerdict judge(const ExactFindings& f) {
  if (f.stopped != Status::done) return {f.stopped, to_string(f.stopped)};
  if (f.completeness == Completeness::incomplete) return {Status::not_converged, name_of(f.completeness)};
  if (f.answers > 0) return {Status::done, name_of(f.completeness)};
  return {Status::infeasible, f.classes == 0        ? "no_solution"
                              : f.real_classes == 0 ? "no_real_solution"
                                                    : "all_defective"};
}

void add_design_counts(Table& counts, const ExactFindings& f) {
  add_count(counts, "designs", fmt::format("{}s with their driver", f.mechanism), f.designs);
  add_count(counts, "defect_free", "without defects", f.defect_free);
  add_count(counts, "order_defects", "that meet the points in another order", f.order);
  add_count(counts, "circuit_defects", "that change circuit", f.circuit);
  add_count(counts, "branch_defects", "that change branch", f.branch);
}

void add_path_counts(Table& counts, const ExactFindings& f) {
  add_count(counts, "infinite", "paths that end at infinity", f.infinite);
  add_count(counts, "singular", "paths that end where solutions meet", f.singular);
  add_count(counts, "lost", "paths that were lost", f.lost);
}

void add_design_facts(const study::AddFact& fact, const ExactFindings& f) {
  using Verdict = study::Fact::Verdict;
  fact(fmt::format("{}s with their driver", f.mechanism), say("{}", f.designs));
  fact("without defects", say("{}", f.defect_free), f.defect_free > 0 ? Verdict::good : Verdict::bad);
  fact("with defects", say("{} branch, {} circuit, {} order", f.branch, f.circuit, f.order));
}

void add_path_facts(const study::AddFact& fact, const ExactFindings& f) {
  if (f.infinite + f.singular + f.lost > 0)
    fact("paths without a solution",
         say("{} to infinity, {} where solutions meet, {} lost", f.infinite, f.singular, f.lost));
}

void offer_order(const study::AddWarning& warn, const ExactFindings& f,
                 const std::vector<std::vector<int>>& orders) {
  std::map<std::vector<int>, int> counts;
  for (const std::vector<int>& order : orders)
    if (!order.empty()) ++counts[order];
  if (counts.empty()) return;
  const auto best = std::max_element(counts.begin(), counts.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  std::string list;
  for (const int k : best->first) list += fmt::format("{}{}", list.empty() ? "" : ", ", k + 1);
  warn(say("in the order {} {} of these {}s would pass the points in one motion", list, best->second,
           f.mechanism),
       "write the points in that order if it will do");
}

void warn_of_missing_solutions(const study::AddWarning& warn, const ExactFindings& f) {
  if (f.completeness == Completeness::special_target)
    warn(say("the points are special: {} of {} solutions lie at infinity or coincide", f.whole - f.classes,
             f.whole),
         "mirror-symmetric points, points on a line or on a grid are such; move one of them a little to see "
         "the rest");
  if (f.stopped == Status::done && f.lost > 0)
    warn(say("{} paths were lost: {}s may be missing", f.lost, f.mechanism),
         "move a point a little and compare");
}

}  // namespace linkwright::planar
