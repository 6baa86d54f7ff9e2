#include "linkwright/cli/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace linkwright::cli {

std::string progress_line(const Progress& progress, std::size_t width) {
  constexpr int cells = 20;
  const double fraction = std::isnan(progress.fraction) ? 0 : std::clamp(progress.fraction, 0.0, 1.0);
  const int full = static_cast<int>(fraction * cells);
  std::string line =
      fmt::format("{}  [{}{}] {:3.0f}%", progress.stage, std::string(static_cast<std::size_t>(full), '#'),
                  std::string(static_cast<std::size_t>(cells - full), '.'), std::floor(100 * fraction));
  if (!std::isnan(progress.best)) line += fmt::format("  best {:.6g}", progress.best);
  if (line.size() > width) line.resize(width);
  return line;
}

ProgressBar::ProgressBar(RunContext& context) : context_(context), terminal_(::isatty(STDERR_FILENO) == 1) {
  if (terminal_) context_.set_progress([this](const Progress& progress) { show(progress); });
}

ProgressBar::~ProgressBar() {
  if (!terminal_) return;
  context_.set_progress({});
  if (shown_ > 0) fmt::print(stderr, "\r{:{}}\r", "", shown_);
  std::fflush(stderr);
}

void ProgressBar::show(const Progress& progress) {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  const std::string line = progress_line(progress);
  fmt::print(stderr, "\r{:<{}}", line, shown_);
  std::fflush(stderr);
  shown_ = std::max(shown_, line.size());
}

}  // namespace linkwright::cli
