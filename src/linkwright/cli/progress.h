#pragma once

#include <chrono>
#include <string>

#include "linkwright/core/run_context.h"

namespace linkwright::cli {

/// One line of progress: "grey_wolf  [#####.....]  50%  best 0.00903", at most `width` characters.
std::string progress_line(const Progress& progress, std::size_t width = 79);

/// Shows the progress of a run on standard error while it lives; silent unless that is a terminal.
class ProgressBar {
 public:
  explicit ProgressBar(RunContext& context);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

 private:
  void show(const Progress& progress);

  RunContext& context_;
  bool terminal_;
  std::size_t shown_ = 0;
  std::chrono::steady_clock::time_point next_{};
};

}  // namespace linkwright::cli
