// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

#include "linkwright/app/checkpoint_file.h"
#include "linkwright/core/checkpoint.h"

namespace linkwright::app {

/// The checkpoint, in memory, that a run sharing a study starts from and hands on.
class ShardCheckpoint final : public Checkpoint {
 public:
  ShardCheckpoint(Shard shard, CheckpointOwner owner) : shard_(shard), owner_(std::move(owner)) {}

  /// Takes what another run of the study has handed on; false, with a diagnostic, if it cannot be used.
  bool take(std::string_view text, Diagnostics& diagnostics);

  /// Receives all saved values, each a text for take(); call before the run starts.
  void set_hand_on(std::function<void(const std::string& text)> hand_on) { hand_on_ = std::move(hand_on); }
  /// Called, once, when the run finds that it leaves pieces to others; call before the run starts.
  void set_leaves(std::function<void()> leaves) { leaves_ = std::move(leaves); }

  Value find(std::string_view name) const override;
  void keep(std::string_view name, const Value& value) override;
  std::chrono::duration<double> interval() const override { return std::chrono::seconds(1); }
  std::size_t own_piece(std::string_view loop, std::size_t from, std::size_t count) override;
  void rejoin(std::string_view loop) override;

 private:
  const Shard shard_;
  const CheckpointOwner owner_;
  std::function<void(const std::string&)> hand_on_;
  std::function<void()> leaves_;
  mutable std::mutex mutex_;
  bool leaves_some_ = false;
  CheckpointLines lines_;
};

}  // namespace linkwright::app
