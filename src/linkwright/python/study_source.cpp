// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/python/study_source.h"

#include <utility>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/result_json.h"

namespace linkwright::python {

std::optional<study::Study> prepared(const StudySource& source, Diagnostics& diagnostics) {
  auto study = study::prepare(source.document, source.file, source.folder, app::catalogue(), diagnostics);
  study::name_overrides(diagnostics, source.changes);
  return study;
}

std::shared_ptr<const FinishedRun> finished(const StudySource& source, study::Study study,
                                            const Diagnostics& remarks, RunContext& context) {
  auto run = std::make_shared<FinishedRun>();
  run->study = std::move(study);
  run->file = source.file;
  run->outcome = app::run_and_record(run->study, context);
  study::Result& result = run->outcome.result;
  result.diagnostics.insert(result.diagnostics.begin(), remarks.begin(), remarks.end());
  if (source.from_file && source.changes.empty()) run->outcome.command = "linkwright run " + source.file;
  run->shown = app::presented(run->study, result);
  return run;
}

}  // namespace linkwright::python
