// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/app/run.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/value.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/result.h"
#include "linkwright/study/study.h"

namespace linkwright::python {

/// A study before it is run: its document, and what was changed since it was read.
struct StudySource {
  Value document;
  std::string file;              ///< name in messages
  std::filesystem::path folder;  ///< folder in which the files that it names are looked for
  bool from_file = false;        ///< `file` is one
  std::vector<study::Override> changes;
};

/// Prepares a study as the command line does; nothing when `diagnostics` has errors.
std::optional<study::Study> prepared(const StudySource& source, Diagnostics& diagnostics);

/// A study that was run. Tables, parameters and objectives are shown in the units that its `[output]` asks
/// for, as in result.json and CSV.
struct FinishedRun {
  study::Study study;
  app::RunOutcome outcome;
  study::Result shown;
  std::string file;
};

/// Runs a study as the command line does. `remarks`: the warnings of its reading, which become part of the
/// result.
std::shared_ptr<const FinishedRun> finished(const StudySource& source, study::Study study,
                                            const Diagnostics& remarks, RunContext& context);

}  // namespace linkwright::python
