// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/detail/machine_list.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace linkwright::planar {
namespace {

bool has_less_error(const FoundMachine& a, const FoundMachine& b) {
  return a.measures.error < b.measures.error;
}

/// The same machine up to what the polish leaves open.
bool is_alike(const FoundMachine& a, const FoundMachine& b) {
  return std::abs(a.measures.error - b.measures.error) <= 2e-3 * b.measures.error + 1e-7 &&
         std::abs(a.measures.size - b.measures.size) <= 0.01 * b.measures.size;
}

/// Adds what another search did in a family, which began when `curves` were computed already.
void add_report(FamilyReport& sum, const FamilyReport& next, std::int64_t curves) {
  if (next.error < sum.error) sum.error = next.error, sum.best_at = curves + next.best_at;
  sum.polished += next.polished, sum.hops += next.hops, sum.grown += next.grown;
  sum.curves += next.curves;
}

}  // namespace

bool dominates(const FoundMachine& a, const FoundMachine& b) {
  const auto& m = a.measures;
  const auto& n = b.measures;
  const int la = a.machine.shape.program->links, lb = b.machine.shape.program->links;
  // Few poses are met by many machines to rounding, which is no difference.
  constexpr double negligible = 1e-6;
  return la <= lb && std::max(m.error, negligible) <= std::max(n.error, negligible) &&
         m.min_pair_angle >= n.min_pair_angle && m.size <= n.size &&
         m.peak_acceleration <= n.peak_acceleration;
}

void insert_machine(std::vector<FoundMachine>& list, const FoundMachine& found, std::size_t most,
                    bool archive) {
  for (const FoundMachine& other : list)
    if (archive ? dominates(other, found)
                : is_alike(other, found) && other.measures.error <= found.measures.error)
      return;
  std::erase_if(list, [&](const FoundMachine& other) {
    return archive ? dominates(found, other) : is_alike(found, other);
  });
  list.insert(std::upper_bound(list.begin(), list.end(), found, has_less_error), found);
  if (list.size() > most) list.pop_back();
}

std::vector<FoundMachine> chosen_of_family(const std::vector<FoundMachine>& archive) {
  std::vector<FoundMachine> chosen;
  for (const FoundMachine& found : archive) {
    const bool close = found.measures.error <= 2 * archive.front().measures.error + 0.002;
    const bool different = std::all_of(chosen.begin(), chosen.end(), [&](const FoundMachine& c) {
      return found.measures.min_pair_angle > c.measures.min_pair_angle + 0.09 ||
             found.measures.size < 0.7 * c.measures.size ||
             found.measures.peak_acceleration < 0.6 * c.measures.peak_acceleration;
    });
    if (chosen.size() < 2 && close && different) chosen.push_back(found);
  }
  return chosen;
}

std::vector<FoundMachine> chosen_of_all(const std::vector<FoundMachine>& all, std::size_t most) {
  std::vector<FoundMachine> out;
  for (const FoundMachine& found : all)
    if (std::none_of(all.begin(), all.end(),
                     [&](const FoundMachine& other) { return &other != &found && dominates(other, found); }))
      out.push_back(found);
  std::stable_sort(out.begin(), out.end(), has_less_error);
  if (out.size() > most) out.resize(most);
  return out;
}

TypeSearchAnswer merged_answers(const MotionTarget& target, std::span<const TypeSearchAnswer> answers,
                                std::size_t max_solutions) {
  if (answers.empty()) return {};
  TypeSearchAnswer out = answers[0];
  for (const TypeSearchAnswer& next : answers.subspan(1)) {
    for (std::size_t i = 0; i < out.families.size(); ++i)
      add_report(out.families[i], next.families[i], out.curves);
    for (const TypeSearchPoint& point : next.progress) {
      const bool better = std::none_of(
          out.progress.begin(), out.progress.end(),
          [&](const TypeSearchPoint& p) { return p.family == point.family && p.error <= point.error; });
      if (better)
        out.progress.push_back(
            {.curves = out.curves + point.curves, .family = point.family, .error = point.error});
    }
    out.curves += next.curves;
  }
  std::vector<FoundMachine> all, outside;
  for (const FamilyReport& f : out.families) {
    std::vector<FoundMachine> archive, others;
    for (const TypeSearchAnswer& answer : answers) {
      for (const FoundMachine& found : answer.machines)
        if (found.machine.shape.program->family == f.family)
          insert_machine(archive, found, answer.machines.size() * answers.size(), true);
      for (const FoundMachine& found : answer.outside)
        if (found.machine.shape.program->family == f.family) others.push_back(found);
    }
    const std::vector<FoundMachine> chosen = chosen_of_family(archive);
    all.insert(all.end(), chosen.begin(), chosen.end());
    // A family may be within the limits, and its machines dominated by others.
    if (!std::isfinite(f.error) && !others.empty())
      outside.push_back(*std::min_element(others.begin(), others.end(), has_less_error));
  }
  out.machines = chosen_of_all(all, max_solutions), out.outside = std::move(outside);
  if (target.dense)
    for (FoundMachine& found : out.machines)
      if (!std::isfinite(found.chamfer)) found.chamfer = chamfer_of(target, found.machine);
  return out;
}

}  // namespace linkwright::planar
