// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "linkwright/app/checkpoint_file.h"
#include "linkwright/app/shard.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/value.h"
#include "linkwright/study/study.h"

namespace linkwright::app {

/// File of a shard in its folder: "shard-3-of-64.jsonl", a checkpoint. Shards of a study may share a folder.
std::string shard_name(const Shard& shard);

/// Writes a study beside its shards, as it was written, with the changes from the command line, so that
/// `merge` needs nothing but the files that it names (CSV tables), looked for in the folder of the file
/// `study`. False, with a diagnostic, if it cannot be written or the shards in the folder are those of
/// another.
bool write_shard_study(const Value& as_written, const std::filesystem::path& study,
                       const std::filesystem::path& folder, Diagnostics& diagnostics);

/// Notes in a shard that its part is done, and which one it is.
void end_shard(CheckpointFile& shard);

/// The shards of a study, put together: a run with `kept` as its checkpoint ends with the bits of one that
/// was not shared.
struct Merged {
  study::Study study;
  std::unique_ptr<ShardCheckpoint> kept;
};

/// Reads all shards in the folders. Nothing, with diagnostics that name them, if shards are missing, damaged,
/// copies of others, have not ended, or are not of one study and one number of shards.
std::optional<Merged> read_shards(std::span<const std::filesystem::path> folders,
                                  std::span<const study::Kind> kinds, Diagnostics& diagnostics);

}  // namespace linkwright::app
