// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/write_whole.h"

#include <fmt/core.h>

#include <charconv>
#include <system_error>
#include <utility>

#include "linkwright/core/platform/files.h"
#include "linkwright/core/platform/processes.h"

namespace linkwright::app {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view ending = ".part";

}  // namespace

std::string write_whole(const fs::path& file, std::string_view text) {
  return write_whole(file, [&] { return std::exchange(text, {}); });
}

std::string write_whole(const fs::path& file, const std::function<std::string_view()>& next) {
  const fs::path temporary = fmt::format("{}.{}{}", file.string(), platform::process_id(), ending);
  std::error_code error = platform::write_to_disk(temporary, next, file);
  if (!error) fs::rename(temporary, file, error);
  if (!error) {
    platform::sync_folder(file.parent_path());
    return {};
  }
  std::error_code ignored;
  fs::remove(temporary, ignored);
  return error.message();
}

void remove_leftovers(const fs::path& file) {
  std::error_code error;
  const std::string prefix = file.filename().string() + ".";
  for (const auto& entry : fs::directory_iterator(file.has_parent_path() ? file.parent_path() : ".", error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix) || !name.ends_with(ending) || name.size() <= prefix.size() + ending.size())
      continue;
    const char *begin = name.data() + prefix.size(), *end = name.data() + name.size() - ending.size();
    int process = 0;
    const auto [last, problem] = std::from_chars(begin, end, process);
    if (problem == std::errc() && last == end && process > 0 && !platform::process_exists(process))
      fs::remove(entry.path(), error);
  }
}

}  // namespace linkwright::app
