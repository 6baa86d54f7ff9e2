// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/study/study.h"

namespace linkwright::app {

/// Name of the file in the folder of the results.
inline constexpr const char* checkpoint_name = "checkpoint.jsonl";
/// Neither written nor read beyond this.
inline constexpr std::size_t largest_checkpoint = std::size_t{512} << 20;

/// The owner of a checkpoint file: no other study or program can continue with it.
struct CheckpointOwner {
  std::string tool;          ///< "linkwright 0.1.0"
  std::string study_sha256;  ///< hash of the canonical study, as in result.json
};
CheckpointOwner checkpoint_owner(const study::Study& study);

/// The number of a run among those that share a study: of the pieces of a loop it does index, index + count,
/// ...
struct Shard {
  std::size_t index = 0;  ///< from 0
  std::size_t count = 1;  ///< 1 = nothing is shared

  /// The first of its pieces at or after `from`; `pieces` if there is none.
  std::size_t own_piece(std::size_t from, std::size_t pieces) const {
    return std::min(from + (index + count - from % count) % count, pieces);
  }
};

/// The saved values: one line of JSON, `{"name":"seed 7","value":...}`, under each name.
using CheckpointLines = std::map<std::string, std::string, std::less<>>;
/// Such a line, and its name and value, or its value, again; no name and null for no line.
std::string checkpoint_line(std::string_view name, const Value& value);
std::pair<std::string, Value> checkpoint_entry(std::string_view line);
Value checkpoint_value(std::string_view line);

/// Text of a file: a line that names the owner, the number of bytes after it and their SHA-256; then the
/// lines.
std::string checkpoint_text(const CheckpointOwner& owner, const CheckpointLines& lines);

/// Reads such a text. Nothing, and one diagnostic that says what is wrong and how to fix it, for the file
/// of another program version or study and for what is damaged, truncated or no checkpoint at all.
std::optional<CheckpointLines> read_checkpoint(std::string_view text, const CheckpointOwner& owner,
                                               const std::string& file, Diagnostics& diagnostics);

/// For a file that could be read, but does not hold what a run of the study saves.
Diagnostic unusable_checkpoint(const std::filesystem::path& file, const CheckpointError& error);

/// Keeps a run's checkpoint in a file, which a thread of its own rewrites, whole or not at all, half a
/// second after something was saved, or later where writing would else take more than a twentieth of the
/// time.
class CheckpointFile final : public Checkpoint {
 public:
  CheckpointFile(std::filesystem::path file, CheckpointOwner owner, Shard shard = {});
  ~CheckpointFile() override;

  /// Begins without the checkpoint of an earlier run.
  void discard();
  /// Loads the checkpoint of an earlier run; nothing if there is no such file. False, with a diagnostic, if
  /// it cannot be used; then the file is left as it is.
  bool load(Diagnostics& diagnostics);
  /// Number of saved lines.
  std::size_t size() const;
  const Shard& shard() const { return shard_; }
  /// The names of the lines, in order.
  std::vector<std::string> names() const;

  Value find(std::string_view name) const override;
  void keep(std::string_view name, const Value& value) override;
  std::chrono::duration<double> interval() const override;
  std::size_t own_piece(std::string_view loop, std::size_t from, std::size_t count) override;
  void rejoin(std::string_view loop) override;

  /// Writes what is not on the disk yet; call when the run has ended. A failure is a warning.
  void finish(Diagnostics& diagnostics);

 private:
  void write_until_stopped();
  void stop();
  void write(std::unique_lock<std::mutex>& lock);

  const std::filesystem::path file_;
  const CheckpointOwner owner_;
  const Shard shard_;
  mutable std::mutex mutex_;
  std::condition_variable changes_;
  CheckpointLines lines_;
  std::size_t bytes_ = 0;  ///< size of the lines
  bool changed_ = false;   ///< since the last write
  bool stopped_ = false;
  std::chrono::duration<double> interval_;
  std::string problem_;  ///< says why the last write failed
  std::thread writer_;   ///< begins with the first line saved
};

}  // namespace linkwright::app
