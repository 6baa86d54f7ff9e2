// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

// Logs of minimisations stay within bounded memory, however many generations there are.
namespace linkwright::optimise {

inline constexpr int max_logged = 1 << 16;

/// Generations from one entry of a log to the next: 1, and twice as many whenever the log would grow beyond
/// `max_logged` entries. After `generations` of them a log has generations / log_interval(generations)
/// entries, of the generations that this interval divides.
inline int log_interval(int generations) {
  int interval = 1;
  while (generations / interval > max_logged) interval *= 2;
  return interval;
}

/// Adds the entry of the last generation, where the interval asks for it, and drops every other entry where
/// the interval has doubled. `make` makes the entry. True when entries before it were dropped.
template <class Entry, class Make>
bool log_generation(std::vector<Entry>& log, int generations, Make&& make) {
  const int interval = log_interval(generations);
  const bool doubled = log.size() > static_cast<std::size_t>(generations / interval);
  if (doubled) {
    std::size_t kept = 0;
    for (std::size_t k = 1; k < log.size(); k += 2) log[kept++] = log[k];
    log.resize(kept);
  }
  if (generations % interval == 0) log.push_back(make());
  return doubled;
}

}  // namespace linkwright::optimise
