// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>

#include "linkwright/core/run_context.h"

namespace linkwright {

/// Leaves a computation whose partial result is unusable, when its run is to stop: the value of a candidate,
/// a pass over all nodes of a grid. Who holds the best so far catches it and returns that with the status; at
/// the latest `study::run_study` does. It never leaves a function that returns a Status.
class Interrupted : public std::exception {
 public:
  /// `status`: deadline or cancelled.
  explicit Interrupted(Status status) : status_(status) {}
  Status status() const noexcept { return status_; }
  const char* what() const noexcept override { return "the run was interrupted"; }

 private:
  Status status_;
};

/// Throws Interrupted when the run is to stop. Without a context nobody can ask for that. To be called at
/// least every 50 ms of work or so; a call costs about as much as reading a clock.
inline void throw_if_interrupted(const RunContext* context) {
  if (!context) return;
  if (const Status why = context->interruption(); why != Status::done) throw Interrupted(why);
}
inline void throw_if_interrupted(const RunContext& context) { throw_if_interrupted(&context); }

}  // namespace linkwright
