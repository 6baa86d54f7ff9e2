// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/progress.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "linkwright/cli/terminal.h"

namespace linkwright::cli {
namespace {

/// "0:07", "12:30", "1:05:00"
std::string clock_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                      : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

double share(const Progress& progress) {
  return std::isnan(progress.fraction) ? 0 : std::clamp(progress.fraction, 0.0, 1.0);
}

}  // namespace

std::string progress_line(const Progress& progress, const Pace& pace, std::size_t width) {
  constexpr int cells = 10;
  const int full = static_cast<int>(share(progress) * cells);
  std::vector<std::string> parts = {
      std::string(progress.stage),
      fmt::format("[{}{}]", std::string(static_cast<std::size_t>(full), '#'),
                  std::string(static_cast<std::size_t>(cells - full), '.')),
      fmt::format("{:3.0f}%", std::floor(100 * share(progress))),
      clock_text(pace.elapsed) +
          (std::isnan(pace.left) ? "" : fmt::format(", {} left", clock_text(pace.left)))};
  if (!std::isnan(progress.best)) {
    parts.push_back(fmt::format("best {:.6g}", progress.best));
    parts.emplace_back("Ctrl-C keeps the best");
  }
  const auto joined = [&] {
    std::string line;
    for (const std::string& part : parts) line += (line.empty() ? "" : "  ") + part;
    return line;
  };
  if (joined().size() > width) parts.erase(parts.begin() + 1);
  while (parts.size() > 1 && joined().size() > width) parts.pop_back();
  return joined().substr(0, width);
}

double time_left(double fraction, double seconds) {
  return seconds >= 1 && fraction >= 0.01 && fraction <= 1 ? seconds * (1 - fraction) / fraction : nan;
}

ProgressBar::ProgressBar(RunContext& context, bool quiet)
    : context_(context), active_(!quiet && is_terminal(Stream::err)) {
  if (active_) context_.set_progress([this](const Progress& progress) { show(progress); });
}

ProgressBar::~ProgressBar() {
  if (!active_) return;
  context_.set_progress({});
  if (shown_ > 0) fmt::print(stderr, "\r{:{}}\r", "", shown_);
  std::fflush(stderr);
}

void ProgressBar::show(const Progress& progress) {
  const auto now = Clock::now();
  if (progress.stage != stage_) {
    stage_ = progress.stage;
    stage_start_ = now;
  }
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  const auto since = [&](Clock::time_point then) {
    return std::chrono::duration<double>(now - then).count();
  };
  // The last column stays free: some terminals begin a new line after it.
  const std::string line = progress_line(
      progress, {since(start_), time_left(share(progress), since(stage_start_))}, terminal_width() - 1);
  fmt::print(stderr, "\r{:<{}}", line, shown_);
  std::fflush(stderr);
  shown_ = std::max(shown_, line.size());
}

}  // namespace linkwright::cli
