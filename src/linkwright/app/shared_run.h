#pragma once

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

/// Tells all other ranks that there is nothing, or nothing more, to do.
void end_others(Ranks& ranks);

/// The checkpoint of rank 0, which puts the result together: hands out the pieces of a loop as they are asked
/// for, and keeps in one file what all ranks have done. The other ranks end with their first shared loop.
class LeadingRank final : public Checkpoint {
 public:
  /// Lets the other ranks begin, with what the file holds. Both must outlive this.
  LeadingRank(Ranks& ranks, CheckpointFile& kept, const CheckpointOwner& owner, RunContext& context);
  /// Lets them end, and waits for that.
  ~LeadingRank() override;

  Value find(std::string_view name) const override { return kept_.find(name); }
  void keep(std::string_view name, const Value& value) override { kept_.keep(name, value); }
  std::chrono::duration<double> interval() const override { return kept_.interval(); }
  std::size_t own_piece(std::string_view loop, std::size_t from, std::size_t count) override;
  void rejoin(std::string_view loop) override;

 private:
  void receive(int from, std::string_view message);
  void wait_for_others();

  Ranks& ranks_;
  CheckpointFile& kept_;
  RunContext& context_;
  std::mutex mutex_;  ///< guards the following
  std::condition_variable changes_;
  std::map<std::string, std::size_t, std::less<>> next_;  ///< piece of each loop that nobody has been given
  std::vector<bool> at_work_;                             ///< the ranks that have not ended
  bool leaving_ = false;                                  ///< this rank has ended
  bool stopping_ = false;                                 ///< the others were told to end
  std::thread watch_;  ///< ends the other ranks when the run is interrupted, or has ended
};

/// The checkpoint of any other rank: asks rank 0 for pieces and sends it what it has done.
class FollowingRank final : public Checkpoint {
 public:
  FollowingRank(Ranks& ranks, RunContext& context);
  /// Tells rank 0 that no more comes from here.
  ~FollowingRank() override;

  /// Waits for rank 0; false if it has nothing to do.
  bool begin();
  /// Takes up what rank 0 has begun with; false, with a diagnostic, if that is of another study.
  bool take_up(const CheckpointOwner& owner, Diagnostics& diagnostics);

  Value find(std::string_view name) const override;
  void keep(std::string_view name, const Value& value) override;
  std::chrono::duration<double> interval() const override { return std::chrono::seconds(1); }
  std::size_t own_piece(std::string_view loop, std::size_t from, std::size_t count) override;
  void rejoin(std::string_view) override { throw LeftToOthers(); }

 private:
  void receive(std::string_view message);

  Ranks& ranks_;
  RunContext& context_;
  std::mutex mutex_;  ///< guards the following
  std::condition_variable changes_;
  bool begun_ = false;
  bool ended_ = false;
  std::string found_;  ///< what rank 0 began with
  bool answered_ = false;
  std::size_t first_ = 0, last_ = 0;  ///< pieces that were given to this rank and not yet begun
  CheckpointLines lines_;
};

}  // namespace linkwright::app
