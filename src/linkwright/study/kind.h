#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/value.h"
#include "linkwright/study/result.h"

namespace linkwright::study {

/// A study that has been read without errors and can run.
struct Prepared {
  Value canonical;  ///< the study with defaults filled in and SI units: what result.json stores and what is
                    ///< hashed
  std::function<Result(RunContext&)> run;
};

/// What a domain registers: one kind of study, chosen by `kind`, `mechanism.type` and `target.type` of the
/// file.
struct Kind {
  std::string kind;       ///< "synthesis"
  std::string mechanism;  ///< "planar.four_bar"
  std::string target;     ///< "path_points"; empty = the study has no target
  std::string summary;    ///< one sentence for the catalogue
  std::string example;    ///< a complete study as TOML: what `linkwright new` writes

  /// JSON Schema (2020-12) of the whole study.
  std::function<Value()> schema;
  /// Reads the document; problems are appended, all of them, not just the first. `folder` resolves relative
  /// file names.
  std::function<Prepared(const Value& document, const std::filesystem::path& folder,
                         Diagnostics& diagnostics)>
      prepare;
};

}  // namespace linkwright::study
