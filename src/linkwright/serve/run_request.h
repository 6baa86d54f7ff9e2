// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace linkwright::serve {

/// A run that a page asks for.
struct RunRequest {
  std::string run;    ///< "TAB.NUMBER": of which tab, whose earlier run ends, and which of its runs
  std::string text;   ///< text of the study
  std::string edits;  ///< edits of the text, as app::run_text() takes them; empty = none
  std::map<std::string, std::string> files;  ///< files that the study reads: texts by names without a folder
  double seconds = 0;                        ///< after which the best so far is the answer; 0 = never
};

/// The tab in "TAB.NUMBER", 1 to 64 letters and digits; empty for any other text.
std::string_view tab_of(std::string_view run);

/// Reads the body of a request, JSON with the members of RunRequest, of which only `run` and `text` must be
/// there. Nothing, with the reason in `problem`, where it is anything else.
std::optional<RunRequest> read_run_request(std::string_view body, std::string& problem);

}  // namespace linkwright::serve
