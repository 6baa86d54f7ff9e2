// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/merge.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/app/run.h"
#include "linkwright/app/write_whole.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::app {
namespace fs = std::filesystem;
namespace {

constexpr const char* study_name = "study.json";
constexpr const char* end_name = "shard";  // a shard that is done saves its name under this one
constexpr std::size_t max_named = 10;      // missing shards in a message

void refuse_shards(Diagnostics& diagnostics, const fs::path& file, std::string message, std::string hint) {
  diagnostics.push_back(
      {Diagnostic::Severity::error, file.string(), {}, {}, std::move(message), std::move(hint)});
}

/// "shard-3-of-64.jsonl" -> {2, 64}
std::optional<Shard> shard_of(const std::string& name) {
  std::size_t number = 0, count = 0;
  const char* end = name.data() + name.size();
  const auto after = [&](const char* at, std::string_view word) {
    return at && std::string_view(at, static_cast<std::size_t>(end - at)).starts_with(word) ? at + word.size()
                                                                                            : nullptr;
  };
  const auto read = [&](const char* at, std::size_t& into) {
    if (!at) return at;
    const auto [next, error] = std::from_chars(at, end, into);
    return error == std::errc() ? next : nullptr;
  };
  const char* at = read(after(name.data(), "shard-"), number);
  at = after(read(after(at, "-of-"), count), ".jsonl");
  if (at != end || number < 1 || number > count) return std::nullopt;
  return Shard{number - 1, count};
}

struct File {
  fs::path path;
  Shard shard;
};

/// All shards in the folders, in the order of their numbers.
std::vector<File> files_in(std::span<const fs::path> folders, Diagnostics& diagnostics) {
  std::vector<File> files;
  for (const fs::path& folder : folders) {
    const std::size_t before = files.size();
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
      if (const auto shard = shard_of(entry.path().filename().string()))
        files.push_back({entry.path(), *shard});
    if (files.size() == before)
      refuse_shards(diagnostics, folder, error ? error.message() : "holds no shards of a study",
                    "name folders that `linkwright run STUDY --shard K/N --out FOLDER` has written");
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) {
    return std::pair(a.shard.index, a.path) < std::pair(b.shard.index, b.path);
  });
  return files;
}

std::string listed(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < std::min(numbers.size(), max_named); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", numbers[i]);
  if (numbers.size() > max_named) text += fmt::format(" and {} more", numbers.size() - max_named);
  return text;
}

/// True if every shard of the study is given at least once.
bool all_there(const std::vector<File>& files, const fs::path& folder, Diagnostics& diagnostics) {
  const File& first = files.front();
  for (const File& file : files)
    if (file.shard.count != first.shard.count) {
      refuse_shards(diagnostics, file.path,
                    fmt::format("is one of {} shards, but {} is one of {}", file.shard.count,
                                first.path.string(), first.shard.count),
                    "only shards of one division go together");
      return false;
    }
  std::set<std::size_t> found;
  for (const File& file : files) found.insert(file.shard.index);
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < first.shard.count; ++i)
    if (!found.contains(i)) missing.push_back(i + 1);
  if (missing.empty()) return true;
  refuse_shards(diagnostics, folder,
                fmt::format("{} {} of {} {} missing", missing.size() == 1 ? "shard" : "shards",
                            listed(missing), first.shard.count, missing.size() == 1 ? "is" : "are"),
                fmt::format("run `linkwright run STUDY --shard {}/{}`, or name its folder as well",
                            missing.front(), first.shard.count));
  return false;
}

}  // namespace

std::string shard_name(const Shard& shard) {
  return fmt::format("shard-{}-of-{}.jsonl", shard.index + 1, shard.count);
}

bool write_shard_study(const Value& as_written, const fs::path& study, const fs::path& folder,
                       Diagnostics& diagnostics) {
  const fs::path file = folder / study_name;
  Value kept = Value::object();
  kept["study"] = as_written;
  kept["name"] = study.string();
  std::error_code error;
  kept["folder"] = fs::absolute(study.parent_path(), error).lexically_normal().string();
  const std::string text = study::to_json_readable(kept);
  if (fs::exists(file)) {
    Diagnostics unreadable;
    const std::string there = study::load_file(file, unreadable);
    if (there == text) return true;
    Diagnostics none;
    const std::vector<fs::path> here = {folder};
    if (!files_in(here, none).empty()) {
      refuse_shards(diagnostics, file, "is another study, whose shards are in this folder",
                    "choose another folder with --out, or remove its shards");
      return false;
    }
  }
  const std::string problem = write_whole(file, text);
  if (!problem.empty()) refuse_shards(diagnostics, file, fmt::format("cannot be written: {}", problem), {});
  return problem.empty();
}

void end_shard(CheckpointFile& shard) { shard.keep(end_name, Value(shard_name(shard.shard()))); }

std::optional<Merged> read_shards(std::span<const fs::path> folders, std::span<const study::Kind> kinds,
                                  Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const std::vector<File> files = files_in(folders, diagnostics);
  if (diagnostics.size() != before || !all_there(files, folders.front(), diagnostics)) return std::nullopt;
  const fs::path study_file = files.front().path.parent_path() / study_name;
  const Value kept = study::read_file(study_file, diagnostics);
  const Value *document = kept.find("study"), *name = kept.find("name"), *folder = kept.find("folder");
  const bool complete = document && name && name->is_string() && folder && folder->is_string();
  if (diagnostics.size() == before && !complete)
    refuse_shards(diagnostics, study_file, "is not the study of the shards beside it", "run a shard again");
  if (diagnostics.size() != before) return std::nullopt;
  auto study = study::prepare(*document, name->as_string(), folder->as_string(), kinds, diagnostics);
  if (!study) return std::nullopt;
  const std::size_t remarks = diagnostics.size();
  const CheckpointOwner owner = checkpoint_owner(*study);
  Merged merged{std::move(*study), std::make_unique<ShardCheckpoint>(Shard{}, owner)};
  // A part that was done twice, in two folders, counts where it has ended.
  std::map<std::size_t, fs::path> open;
  std::set<std::size_t> ended;
  for (const File& file : files) {
    CheckpointFile shard(file.path, owner);
    if (!shard.load(diagnostics)) {
      diagnostics.back().hint = fmt::format("run shard {}/{} again", file.shard.index + 1, file.shard.count);
      continue;
    }
    const Value end = shard.find(end_name);
    if (end.is_null()) {
      open.emplace(file.shard.index, file.path);
    } else if (end == Value(shard_name(file.shard))) {
      ended.insert(file.shard.index);
    } else {
      refuse_shards(diagnostics, file.path, "holds another shard than its name says",
                    fmt::format("run shard {}/{} again", file.shard.index + 1, file.shard.count));
      continue;
    }
    for (const std::string& piece : shard.names()) merged.kept->keep(piece, shard.find(piece));
  }
  for (const auto& [index, path] : open)
    if (!ended.contains(index))
      refuse_shards(diagnostics, path, "has not ended",
                    "run it again with --resume, which continues from there");
  if (diagnostics.size() != remarks) return std::nullopt;
  return merged;
}

}  // namespace linkwright::app
