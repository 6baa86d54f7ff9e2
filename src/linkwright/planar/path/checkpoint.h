// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/field.h"
#include "linkwright/core/value.h"
#include "linkwright/planar/path/mechanism.h"
#include "linkwright/planar/path/task.h"

// A finished seed of a path synthesis (status done or infeasible) as a checkpoint keeps it: the linkages, not
// what they achieve.
namespace linkwright::planar {

Value saved_record(const SearchRecord& record, const std::vector<std::vector<double>>& designs);
/// The numbers of the designs are handed over one after the other.
SearchRecord load_record(const Value& value, std::string_view what,
                         const std::function<void(const std::vector<double>&)>& design);

/// True if a number of a saved design is 1 or -1, an angle (rad), or a value that a field of a linkage
/// allows.
bool is_saved_sign(double x);
bool is_saved_angle(double x);
bool is_kept(const Field& field, double x);

template <class M>
Value kept(const PathAnswer<M>& run) {
  std::vector<std::vector<double>> designs;
  for (typename M::Design design : run.designs) {
    std::vector<double>& numbers = designs.emplace_back();
    numbers.push_back(sign(design.linkage.branch));
    fields([&](const Field&, double& value) { numbers.push_back(value); }, M::form(design.linkage));
    numbers.insert(numbers.begin() + M::kept_sense, design.sense);
    numbers.insert(numbers.end(), design.angles.begin(), design.angles.end());
  }
  return saved_record(run, designs);
}

/// The seed that was kept, with the same bits. Its designs are measured against the problem again, so that
/// no result can be read that the linkage does not give. Throws CheckpointError, naming `what`, for
/// everything that `kept` cannot have made.
template <class Problem>
auto restored(const Value& value, const Problem& problem, std::string_view what) {
  using M = MechanismOf<Problem>;
  PathAnswer<M> run;
  static_cast<SearchRecord&>(run) = load_record(value, what, [&](std::vector<double> numbers) {
    typename M::Linkage linkage;
    std::size_t count = 2 + problem.x.size();
    fields([&](const Field&, double&) { ++count; }, M::form(linkage));
    if (numbers.size() != count)
      throw CheckpointError(
          fmt::format("{}: a design has {} numbers, must be {}", what, numbers.size(), count));
    const double sense = numbers[M::kept_sense];
    numbers.erase(numbers.begin() + M::kept_sense);
    bool possible = is_saved_sign(numbers[0]) && is_saved_sign(sense);
    linkage.branch = names(linkage.branch)[numbers[0] > 0 ? 0 : 1].value;
    std::size_t i = 1;
    fields(
        [&](const Field& field, double& number) {
          number = numbers[i++];
          possible = possible && is_kept(field, number);
        },
        M::form(linkage));
    std::vector<double> angles(numbers.begin() + static_cast<std::ptrdiff_t>(i), numbers.end());
    for (const double angle : angles) possible = possible && is_saved_angle(angle);
    if (!possible) throw CheckpointError(fmt::format("{}: a design is not a {}", what, M::words.name));
    run.designs.push_back(measure(problem, linkage, sense, std::move(angles)));
  });
  return run;
}

}  // namespace linkwright::planar
