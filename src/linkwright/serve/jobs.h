// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "linkwright/app/view.h"
#include "linkwright/core/run_context.h"
#include "linkwright/serve/run_request.h"

namespace linkwright::serve {

/// An answer as it goes over the line: the length of the document and the count of the numbers (each four
/// bytes), the numbers (eight bytes each) and the document. All numbers are as they are in memory, because
/// who reads them is on the same machine.
std::string frame(const app::View& view);

/// One run in a thread of its own.
class Job {
 public:
  /// Files that the study names are looked for in `folder`, or among those of the request if it brings any.
  Job(RunRequest request, std::filesystem::path folder);
  ~Job();  ///< cancels and waits
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  const std::string& name() const { return request_.run; }
  void cancel() { context_.cancel(); }
  bool finished() const;

  struct News {
    std::string frames;  ///< progress, or the answer; empty when there is nothing new
    bool last = false;   ///< the answer is among them
  };
  /// Returns the news since the last call; waits for it no longer than `patience`.
  News news(std::chrono::milliseconds patience);

 private:
  void run();
  void tell(const Progress& progress);

  const RunRequest request_;
  const std::filesystem::path folder_;
  RunContext context_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::string progress_;  ///< a frame that nobody has taken yet
  std::string answer_;    ///< a frame, when the run is over
  bool over_ = false;
  RunContext::Clock::time_point told_{};
  std::thread thread_;
};

/// The runs of all tabs.
class Jobs {
 public:
  /// `most`: runs at a time.
  Jobs(std::filesystem::path folder, std::size_t most) : folder_(std::move(folder)), max_(most) {}

  /// Starts a run and cancels an earlier one of the same tab; nullptr when too many are running.
  std::shared_ptr<Job> start(RunRequest request);
  /// Asks a run ("TAB.NUMBER") to end, which then has its best so far for an answer. Whether it was running.
  bool cancel(std::string_view run);
  void cancel_all();

 private:
  const std::filesystem::path folder_;
  const std::size_t max_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<Job>> running_;
};

}  // namespace linkwright::serve
