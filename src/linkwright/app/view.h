// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/app/shard.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/value.h"
#include "linkwright/report/html.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/result.h"
#include "linkwright/study/study.h"

// Everything that a page asks of the program: the text of a study in, all that the page shows out. Nothing is
// kept between calls.
namespace linkwright::app {

/// The input of the report of a study. `shown` is a result as it is presented(), which must outlive it.
report::ReportInput report_input(const study::Study& study, const study::Result& shown, std::string command,
                                 std::string result_json);

/// A document in JSON and its lists of numbers, which are separate (core/number_lists.h).
struct View {
  std::string json;
  std::vector<double> numbers;
};

/// The terms on which a run is shared with other runs of the same text and edits.
struct Sharing {
  Shard shard;
  std::vector<std::string> kept;                         ///< checkpoints that earlier runs have handed on
  std::function<void(const std::string&)> hand_on = {};  ///< receives what this one keeps
  std::function<void()> leaves = {};  ///< called, once, when the run leaves something to the others
};

/// Changes the text of a study (edited()), reads, runs and presents it. `edits`: a document with the list
/// `edits` of `key` and `value`, or empty. Files that the study names are looked for in `folder`. `document`:
/// `text` as it is now, `diagnostics` of it (severity, line, column, key, message, hint); without errors also
/// `canonical`, the study with all defaults in SI units, `view` and `result`, which are what a report
/// carries, and `seconds`. A run that has left something to others has the member `left_to_others` in the
/// place of those: the answer comes of one that begins with what all of them have handed on.
View run_text(std::string_view text, std::string_view edits, const std::string& folder, RunContext& context,
              Sharing sharing = {});

/// The lists that a page starts from: `version`, `kinds` (name, summary, group), `examples` (name, title,
/// group, words, text, beside: the files it reads) and `samples` (name, summary, group, mechanisms).
Value catalogue_document();

/// The JSON Schema of the studies of a kind, "analysis/planar.four_bar"; null when there is no such kind.
Value schema_document(std::string_view kind);

}  // namespace linkwright::app
