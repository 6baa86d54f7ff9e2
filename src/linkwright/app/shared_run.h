// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "linkwright/app/checkpoint_file.h"
#include "linkwright/app/ranks.h"
#include "linkwright/core/checkpoint.h"
#include "linkwright/core/run_context.h"

namespace linkwright::app {

/// The start of the ranks of a run. Starting MPI takes a while; without saved work of an earlier run the
/// ranks meanwhile do a first share of the pieces, which is divided beforehand.
enum class RanksBegin { at_once, with_what_was_kept };

/// Informs all other ranks that there is nothing, or nothing more, to do.
void end_others(Ranks& ranks);

/// The checkpoint of rank 0, which puts the result together: hands out the pieces of a loop as they are asked
/// for, and keeps in one file what all ranks have done. The other ranks end with their first shared loop.
class LeadingRank final : public Checkpoint {
 public:
  /// Lets the other ranks begin, with what the file holds. Both must outlive this.
  LeadingRank(Ranks& ranks, CheckpointFile& kept, const CheckpointOwner& owner, RanksBegin begin,
              RunContext& context);
  /// Lets them end, and waits for that.
  ~LeadingRank() override;

  Value find(std::string_view name) const override { return kept_.find(name); }
  void keep(std::string_view name, const Value& value) override { kept_.keep(name, value); }
  std::chrono::duration<double> interval() const override { return kept_.interval(); }
  std::size_t own_piece(std::string_view loop, std::size_t from, std::size_t count) override;
  void rejoin(std::string_view loop) override;

 private:
  void receive(int from, std::string_view message);
  std::size_t& next_of(std::string_view loop, std::size_t count);
  void wait_for_others();

  Ranks& ranks_;
  CheckpointFile& kept_;
  RunContext& context_;
  const RanksBegin begin_;
  std::mutex mutex_;  ///< guards the following
  std::condition_variable changes_;
  std::map<std::string, std::size_t, std::less<>> next_;  ///< piece of each loop that nobody has been given
  std::vector<bool> at_work_;                             ///< the ranks that have not ended
  bool leaving_ = false;                                  ///< this rank has ended
  bool stopping_ = false;                                 ///< the others were ordered to end
  std::thread watch_;  ///< ends the other ranks when the run is interrupted, or has ended
};

/// The checkpoint of any other rank: asks rank 0 for pieces and sends it what it has done.
class FollowingRank final : public Checkpoint {
 public:
  FollowingRank(Ranks& ranks, const CheckpointOwner& owner, RanksBegin begin, RunContext& context);
  ~FollowingRank() override { finish(); }

  /// Waits for what rank 0 begins with, unless it need not; false if there is nothing to do.
  bool begin();
  /// Waits until rank 0 has begun, and informs it that no more comes from here. Returns why it has taken
  /// nothing of this rank, if its study is another one.
  Diagnostics finish();

  Value find(std::string_view name) const override;
  void keep(std::string_view name, const Value& value) override;
  std::chrono::duration<double> interval() const override { return std::chrono::seconds(1); }
  std::size_t own_piece(std::string_view loop, std::size_t from, std::size_t count) override;
  void rejoin(std::string_view) override { throw LeftToOthers(); }

 private:
  void receive(std::string_view message);
  void take_up(std::string_view kept);

  Ranks& ranks_;
  const CheckpointOwner owner_;
  const RanksBegin begin_;
  RunContext& context_;
  std::mutex mutex_;  ///< guards the following
  std::condition_variable changes_;
  bool begun_ = false;  ///< rank 0 has, with the same study
  bool ended_ = false;
  bool finished_ = false;
  Diagnostics problems_;
  std::vector<std::string> unsent_;  ///< done before rank 0 was heard of
  /// Pieces that are given to this rank, the last one excluded.
  struct Pieces {
    std::size_t first = 0, last = 0;
  };
  enum class Asking { no, asked, answered };
  bool at_work_ = false;  ///< has asked for a piece
  Pieces own_;            ///< not yet begun
  Pieces answer_;         ///< pieces after those in hand
  Asking asking_ = Asking::no;
  double given_ = 0;                               ///< pieces that the loop has had from here
  std::chrono::steady_clock::time_point began_{};  ///< start of the first of them
  CheckpointLines lines_;  ///< saved lines that rank 0 began with, which nothing changes after that
};

}  // namespace linkwright::app
