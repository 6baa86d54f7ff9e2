// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "linkwright/planar/exact/detail/monodromy.h"
#include "linkwright/planar/exact/nine_points.h"

namespace linkwright::planar {

/// Evidence that a set of classes is complete. They are a linear section of the variety of coupler curves;
/// when one of the hyperplanes moves in parallel (s = 0, s1, 2 s1), the sum of any linear form over a
/// complete section is linear in s (trace test of Leykin, Rodriguez and Sottile 2018).
struct TraceTest {
  double first = 0, second = 0;  ///< absolute first and second difference of the sum
  double least = 0;     ///< least second difference of a single class: what a missing one would leave
  bool passed = false;  ///< second at most 1e-9 first, and no path lost
};
/// `without`: leaves out that class, which must fail; -1 = none.
TraceTest trace_test(const StartSet<NinePoints>& starts, RunContext& context, int without = -1);

/// The set of a file in `cache`, if it holds one: whatever wrote it, each of its points is a solution and no
/// two are the same.
std::optional<StartSet<NinePoints>> read_nine_point_starts(const std::filesystem::path& cache);
/// Makes the folder and the file. Silent where that fails: the set is found again the next time.
void write_nine_point_starts(const std::filesystem::path& cache, const StartSet<NinePoints>& set);

/// Generic data with all 1442 classes, found by monodromy with a fixed seed in a second or two and accepted
/// after the trace test and a certificate for each class. Kept in memory and, unless `cache` is empty, in a
/// file of that folder, where it is found again; a file that is not there, cannot be read or does not hold
/// such a set is written again, and what cannot be written is found again the next time. Its status says that
/// it was interrupted, or that the tests failed.
std::shared_ptr<const StartSet<NinePoints>> nine_point_starts(const std::filesystem::path& cache,
                                                              RunContext& context);

}  // namespace linkwright::planar
