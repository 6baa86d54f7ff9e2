// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/study/study.h"

namespace linkwright::app {

/// One of the results to be compared.
struct Compared {
  std::string name;  ///< name in the comparison
  study::Study study;
  study::Result result;
};

/// The input of a comparison, before it has run: a study file; or the study in a result.json, or in that of a
/// folder, which gives the same result again, bit for bit. Problems are appended to `diagnostics`, also that
/// a result was stopped before its end, which cannot be had again.
struct ComparisonInput {
  study::Study study;
  std::filesystem::path folder;  ///< folder of the results, with a checkpoint perhaps; empty for a study file
};
std::optional<ComparisonInput> load_compared(const std::filesystem::path& path,
                                             std::span<const study::Kind> kinds, Diagnostics& diagnostics);

/// A name for each: the title where no other study has it, else the path.
std::vector<std::string> names_of(std::span<const std::filesystem::path> paths,
                                  std::span<const study::Study* const> studies);

/// One result made of two or more of one kind: facts and objectives side by side, diagrams over each other as
/// `compare_diagrams` puts them, and, where the inputs of the scenes agree, the others as ghosts behind the
/// first mechanism. The tables hold what is drawn, "figures" the numbers of facts and objectives; those that
/// end in "-differences" are each minus the first.
study::Result compare(std::span<const Compared> all);

/// A study that represents the comparison where results are written: its canonical form holds all studies
/// under `compare`.
study::Study comparison_study(std::span<const Compared> all);

}  // namespace linkwright::app
