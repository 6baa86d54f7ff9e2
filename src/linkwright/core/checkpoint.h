// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/value.h"

namespace linkwright {

/// A checkpoint that a run of this study cannot have saved: somebody changed it. The message says what is
/// wrong.
class CheckpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The finished parts of a run, saved under names, so that a later run of the same study loads them and ends
/// with the same bits. The run decides what it saves and what the names mean; it does not know where the
/// parts are saved. Usable from any thread.
///
/// Names form a tree: "seed 7" is above "seed 7/positive".
class Checkpoint {
 public:
  Checkpoint() = default;
  virtual ~Checkpoint() = default;
  Checkpoint(const Checkpoint&) = delete;
  Checkpoint& operator=(const Checkpoint&) = delete;

  /// Returns the value saved under a name, null if there is none.
  virtual Value find(std::string_view name) const = 0;

  /// Saves a value, which replaces everything saved under this name and below it. Numbers that must come
  /// back with the same bits are packed, see pack_numbers. Never throws for want of space or of permission:
  /// a run continues without its checkpoint.
  virtual void keep(std::string_view name, const Value& value) = 0;

  /// Shortest time between two saves of a loop: a short loop would otherwise do little but save.
  virtual std::chrono::duration<double> interval() const = 0;

  /// Several runs of the same study may share the pieces 0, 1, ... count - 1 of a loop that know nothing of
  /// each other, for example its seeds. Returns the first one at or after `from` that is for this run to do,
  /// `count` if there is none; each is given once. `loop` is a name that only this loop has.
  virtual std::size_t own_piece(std::string_view /*loop*/, std::size_t from, std::size_t /*count*/) {
    return from;
  }

  /// Called when this run has done its pieces of a loop, but knows nothing of some others: returns when
  /// find() has what the other runs have come to. Throws LeftToOthers where another run puts it together.
  virtual void rejoin(std::string_view /*loop*/) {}
};

/// The run is one of several that share a study, and has done and saved its own part: there is a result
/// when the saved parts of all are put together and the study run with it.
class LeftToOthers : public std::runtime_error {
 public:
  LeftToOthers() : std::runtime_error("the rest of the study is left to other runs") {}
};

/// Doubles as text, 16 hexadecimal digits each: every bit comes back, also of infinities and NaN.
Value pack_numbers(std::span<const double> numbers);

/// The doubles of such a text. Throws CheckpointError, naming `what`, if it is none.
std::vector<double> unpack_numbers(const Value& value, std::string_view what);

/// Member of a table. Throws CheckpointError, naming `what`, if there is none.
const Value& load_member(const Value& table, std::string_view key, std::string_view what);

/// Integer member of a table in [least, most]. Throws CheckpointError, naming `what`.
std::int64_t load_integer(const Value& table, std::string_view key, std::int64_t least, std::int64_t most,
                          std::string_view what);

}  // namespace linkwright
