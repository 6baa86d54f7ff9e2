// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/jobs.h"

#include <cstdint>
#include <exception>
#include <map>
#include <new>
#include <system_error>
#include <utility>

#include "linkwright/app/write_whole.h"
#include "linkwright/core/platform/files.h"
#include "linkwright/core/value.h"
#include "linkwright/study/write.h"

namespace linkwright::serve {
namespace fs = std::filesystem;
namespace {

/// A folder for this run alone, with the files that came with it.
class Scratch {
 public:
  explicit Scratch(const std::map<std::string, std::string>& files) {
    const fs::path parent = fs::temp_directory_path();
    std::error_code error;
    folder_ = platform::make_private_folder(parent, error);
    if (error) throw std::system_error(error, parent.string());
    for (const auto& [file, text] : files)
      if (const std::string problem = app::write_whole(folder_ / file, text); !problem.empty())
        throw std::runtime_error(file + ": " + problem);
  }
  ~Scratch() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

app::View failure(std::string message) {
  Value out = Value::object();
  out["failure"] = std::move(message);
  return {study::to_json(out), {}};
}

app::View run_safely(const RunRequest& request, const fs::path& folder, RunContext& context) try {
  if (request.files.empty()) return app::run_text(request.text, request.edits, folder.string(), context);
  const Scratch scratch(request.files);
  return app::run_text(request.text, request.edits, scratch.folder().string(), context);
} catch (const std::bad_alloc&) {
  return failure("there is not enough memory for this study");
} catch (const std::exception& error) {
  return failure(error.what());
}

}  // namespace

std::string frame(const app::View& view) {
  const std::uint32_t sizes[] = {static_cast<std::uint32_t>(view.json.size()),
                                 static_cast<std::uint32_t>(view.numbers.size())};
  std::string out;
  out.reserve(sizeof sizes + 8 * view.numbers.size() + view.json.size());
  out.append(reinterpret_cast<const char*>(sizes), sizeof sizes);
  out.append(reinterpret_cast<const char*>(view.numbers.data()), 8 * view.numbers.size());
  return out += view.json;
}

Job::Job(RunRequest request, fs::path folder) : request_(std::move(request)), folder_(std::move(folder)) {
  if (request_.seconds > 0) context_.set_time_limit(std::chrono::duration<double>(request_.seconds));
  context_.set_progress([this](const Progress& progress) { tell(progress); });
  thread_ = std::thread([this] { run(); });
}

Job::~Job() {
  cancel();
  thread_.join();
}

bool Job::finished() const {
  const std::lock_guard lock(mutex_);
  return over_;
}

void Job::run() {
  std::string last = frame(run_safely(request_, folder_, context_));
  const std::lock_guard lock(mutex_);
  answer_ = std::move(last);
  over_ = true;
  changed_.notify_all();
}

void Job::tell(const Progress& progress) {
  constexpr auto often = std::chrono::milliseconds(100);
  const auto now = RunContext::Clock::now();
  if (now - told_ < often) return;
  told_ = now;
  Value out = Value::object();
  Value& state = out["progress"];
  state["stage"] = progress.stage;
  state["fraction"] = progress.fraction;
  state["best"] = progress.best;
  std::string next = frame({study::to_json(out), {}});
  const std::lock_guard lock(mutex_);
  progress_ = std::move(next);
  changed_.notify_all();
}

Job::News Job::news(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, patience, [this] { return over_ || !progress_.empty(); });
  if (over_) return {std::move(answer_), true};
  return {std::exchange(progress_, {}), false};
}

std::shared_ptr<Job> Jobs::start(RunRequest request) {
  const std::lock_guard lock(mutex_);
  std::erase_if(running_, [](const std::shared_ptr<Job>& job) { return job->finished(); });
  for (const std::shared_ptr<Job>& job : running_)
    if (tab_of(job->name()) == tab_of(request.run)) job->cancel();
  if (running_.size() >= max_) return nullptr;
  try {
    running_.push_back(std::make_shared<Job>(std::move(request), folder_));
  } catch (const std::system_error&) {
    return nullptr;  // the system has no more threads
  }
  return running_.back();
}

bool Jobs::cancel(std::string_view run) {
  const std::lock_guard lock(mutex_);
  for (const std::shared_ptr<Job>& job : running_) {
    if (job->name() != run || job->finished()) continue;
    job->cancel();
    return true;
  }
  return false;
}

void Jobs::cancel_all() {
  const std::lock_guard lock(mutex_);
  for (const std::shared_ptr<Job>& job : running_) job->cancel();
}

}  // namespace linkwright::serve
