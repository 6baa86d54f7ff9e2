// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "linkwright/core/status.h"

namespace linkwright {

/// Counts how often runs look whether they are to stop (RunContext::interruption), and lets all after a given
/// number of looks answer `cancelled`, while it lives: interruptions at a place that is the same on every
/// machine, for tests. One at a time, and not while a run is going on.
class LooksAllowed {
 public:
  /// `looks`: answers that are not touched, at least 0.
  explicit LooksAllowed(std::int64_t looks);
  ~LooksAllowed();
  LooksAllowed(const LooksAllowed&) = delete;
  LooksAllowed& operator=(const LooksAllowed&) = delete;

  /// Looks since it was made, of all threads.
  std::int64_t made() const;

 private:
  std::int64_t allowed_;
};

/// The status of a computation that ends with `status`: `status` itself, or `cancelled` when no more looks
/// are allowed.
Status counted_look(Status status) noexcept;

}  // namespace linkwright
