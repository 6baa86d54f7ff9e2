// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/checkpoint_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/sha256.h"
#include "linkwright/app/write_whole.h"
#include "linkwright/core/check.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::app {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t format_version = 1;
constexpr std::size_t longest_header = 4096;
constexpr std::size_t max_text = 100;         // longest name
constexpr std::size_t max_lines = 1'000'000;  // ten for each seed that a study may have
constexpr std::chrono::duration<double> shortest_interval(0.5);
constexpr double writing_share = 0.05;  // largest share of the time of a run that is spent on writing

const char* const mend = "run without --resume to start again and replace it";

void refuse(Diagnostics& diagnostics, const std::string& file, std::string message) {
  diagnostics.push_back({Diagnostic::Severity::error, file, {}, {}, std::move(message), mend});
}

/// A line as a table, null if it is none.
Value table_of(std::string_view line) {
  Diagnostics ignored;
  if (line.empty() || line.front() != '{') return {};
  Value value = study::read_text(line, study::Syntax::json, {}, ignored);
  return value.is_object() ? value : Value();
}

/// A short text of printable characters: it goes into messages, and so to a terminal.
const std::string* printable_member(const Value& table, std::string_view key) {
  const Value* member = table.find(key);
  if (!member || !member->is_string() || member->as_string().size() > max_text) return nullptr;
  const std::string& text = member->as_string();
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; }) ? &text : nullptr;
}

}  // namespace

CheckpointOwner checkpoint_owner(const study::Study& study) {
  return {fmt::format("linkwright {}", version()), sha256(study::to_json(study.canonical))};
}

std::string checkpoint_line(std::string_view name, const Value& value) {
  LINKWRIGHT_REQUIRE(!name.empty() && name.size() <= max_text, "name of {} characters", name.size());
  Value entry;
  entry["name"] = name;
  entry["value"] = value;
  return study::to_json(entry);
}

std::pair<std::string, Value> checkpoint_entry(std::string_view line) {
  Value table = table_of(line);
  const std::string* name = printable_member(table, "name");
  if (!name || !table.find("value")) return {};
  return {*name, std::move(table["value"])};
}

Value checkpoint_value(std::string_view line) { return checkpoint_entry(line).second; }

std::string checkpoint_text(const CheckpointOwner& owner, const CheckpointLines& lines) {
  std::string body;
  for (const auto& [name, line] : lines) body.append(line).append("\n");
  Value header;
  header["checkpoint"] = format_version;
  header["tool"] = owner.tool;
  header["study_sha256"] = owner.study_sha256;
  header["bytes"] = body.size();
  header["sha256"] = sha256(body);
  return study::to_json(header) + "\n" + body;
}

std::optional<CheckpointLines> read_checkpoint(std::string_view text, const CheckpointOwner& owner,
                                               const std::string& file, Diagnostics& diagnostics) {
  const std::size_t end = text.substr(0, longest_header).find('\n');
  const Value header = end == std::string_view::npos ? Value() : table_of(text.substr(0, end));
  const Value *format = header.find("checkpoint"), *bytes = header.find("bytes");
  const std::string *tool = printable_member(header, "tool"),
                    *study = printable_member(header, "study_sha256"),
                    *sum = printable_member(header, "sha256");
  if (!format || !format->is_integer() || !tool || !study) {
    refuse(diagnostics, file, "is not a checkpoint, or its first line is damaged");
    return std::nullopt;
  }
  if (format->as_integer() != format_version || *tool != owner.tool) {
    refuse(diagnostics, file,
           fmt::format("was written by {} in format {}; this is {}, which continues only its own "
                       "checkpoints, in format {}",
                       *tool, format->as_integer(), owner.tool, format_version));
    return std::nullopt;
  }
  if (*study != owner.study_sha256) {
    refuse(diagnostics, file,
           fmt::format("belongs to another study (SHA-256 {:.12}..., this one has {:.12}...): the file was "
                       "changed since, or --seed or --set are not the same",
                       *study, owner.study_sha256));
    return std::nullopt;
  }
  text.remove_prefix(end + 1);
  if (!bytes || !bytes->is_integer() || !sum) {
    refuse(diagnostics, file, "is not a checkpoint, or its first line is damaged");
    return std::nullopt;
  }
  if (bytes->as_integer() != static_cast<std::int64_t>(text.size())) {
    refuse(diagnostics, file,
           fmt::format("is truncated or damaged: {} bytes after its first line, must be {}", text.size(),
                       bytes->as_integer()));
    return std::nullopt;
  }
  if (*sum != sha256(text)) {
    refuse(diagnostics, file, "is damaged: the SHA-256 of its lines is not the one in its first line");
    return std::nullopt;
  }
  CheckpointLines lines;
  for (int number = 2; !text.empty(); ++number) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, length);
    text.remove_prefix(std::min(length + 1, text.size()));
    const Value table = table_of(line);
    const std::string* name = printable_member(table, "name");
    if (!name || !table.find("value") || lines.size() == max_lines || !lines.emplace(*name, line).second) {
      refuse(diagnostics, file, fmt::format("is damaged: line {} names no value of its own", number));
      return std::nullopt;
    }
  }
  return lines;
}

Diagnostic unusable_checkpoint(const fs::path& file, const CheckpointError& error) {
  return {
      Diagnostic::Severity::error, file.string(), {}, {}, fmt::format("is damaged: {}", error.what()), mend};
}

CheckpointFile::CheckpointFile(fs::path file, CheckpointOwner owner, Shard shard)
    : file_(std::move(file)), owner_(std::move(owner)), shard_(shard), interval_(shortest_interval) {
  remove_leftovers(file_);
}

CheckpointFile::~CheckpointFile() { stop(); }

void CheckpointFile::discard() {
  std::error_code error;
  fs::remove(file_, error);
}

bool CheckpointFile::load(Diagnostics& diagnostics) {
  std::error_code error;
  if (fs::status(file_, error).type() == fs::file_type::not_found) return true;
  const auto size = fs::is_regular_file(file_, error) ? fs::file_size(file_, error) : std::uintmax_t{0};
  if (size > largest_checkpoint) {
    refuse(diagnostics, file_.string(),
           fmt::format("has {} bytes; at most {} ({} MiB) are read", size, largest_checkpoint,
                       largest_checkpoint >> 20));
    return false;
  }
  std::string text(static_cast<std::size_t>(size), '\0');
  std::ifstream stream;
  if (size > 0) stream.open(file_, std::ios::binary);
  if (size == 0 || !stream.read(text.data(), static_cast<std::streamsize>(size))) {
    refuse(diagnostics, file_.string(), "cannot be read, or is empty");
    return false;
  }
  auto lines = read_checkpoint(text, owner_, file_.string(), diagnostics);
  if (!lines) return false;
  lines_ = std::move(*lines);
  bytes_ = 0;
  for (const auto& [name, line] : lines_) bytes_ += line.size();
  return true;
}

std::size_t CheckpointFile::size() const {
  const std::lock_guard lock(mutex_);
  return lines_.size();
}

std::vector<std::string> CheckpointFile::names() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> all;
  for (const auto& [name, line] : lines_) all.push_back(name);
  return all;
}

Value CheckpointFile::find(std::string_view name) const {
  std::string line;
  {
    const std::lock_guard lock(mutex_);
    const auto found = lines_.find(name);
    if (found == lines_.end()) return {};
    line = found->second;
  }
  return checkpoint_value(line);
}

void CheckpointFile::keep(std::string_view name, const Value& value) {
  std::string line = checkpoint_line(name, value);
  const std::string below = std::string(name) + "/";

  const std::lock_guard lock(mutex_);
  const auto remove = [&](CheckpointLines::iterator at) {
    bytes_ -= at->second.size();
    return lines_.erase(at);
  };
  // A line that cannot be read back is not saved: an older state under this name is better.
  if (line.size() > study::largest_document || bytes_ + line.size() > largest_checkpoint ||
      lines_.size() == max_lines)
    return;
  if (const auto at = lines_.find(name); at != lines_.end()) remove(at);
  for (auto at = lines_.lower_bound(below); at != lines_.end() && at->first.starts_with(below);)
    at = remove(at);
  bytes_ += line.size();
  lines_.emplace(name, std::move(line));
  changed_ = true;
  if (!writer_.joinable() && !stopped_) writer_ = std::thread([this] { write_until_stopped(); });
  changes_.notify_one();
}

std::chrono::duration<double> CheckpointFile::interval() const {
  const std::lock_guard lock(mutex_);
  return interval_;
}

std::size_t CheckpointFile::own_piece(std::string_view, std::size_t from, std::size_t count) {
  return shard_.own_piece(from, count);
}

void CheckpointFile::rejoin(std::string_view) {
  if (shard_.count > 1) throw LeftToOthers();
}

void CheckpointFile::write_until_stopped() {
  std::unique_lock lock(mutex_);
  while (!stopped_) {
    changes_.wait(lock, [&] { return changed_ || stopped_; });
    // Changes that come during the wait are written with it.
    if (!changes_.wait_for(lock, interval_, [&] { return stopped_; })) write(lock);
  }
}

void CheckpointFile::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
  }
  changes_.notify_one();
  if (writer_.joinable()) writer_.join();
}

void CheckpointFile::write(std::unique_lock<std::mutex>& lock) {
  changed_ = false;
  const auto start = Clock::now();
  const std::string text = checkpoint_text(owner_, lines_);
  lock.unlock();  // a slow disk does not hold up the run
  std::string problem = write_whole(file_, text);
  lock.lock();
  problem_ = std::move(problem);
  const std::chrono::duration<double> took = Clock::now() - start;
  interval_ = std::max(shortest_interval, took / writing_share);
}

void CheckpointFile::finish(Diagnostics& diagnostics) {
  stop();
  std::unique_lock lock(mutex_);
  if (changed_ || !problem_.empty()) write(lock);
  if (!problem_.empty())
    diagnostics.push_back(
        {Diagnostic::Severity::warning,
         file_.string(),
         {},
         {},
         fmt::format("cannot be written: {}; an interrupted run could not be resumed", problem_),
         {}});
}

}  // namespace linkwright::app
