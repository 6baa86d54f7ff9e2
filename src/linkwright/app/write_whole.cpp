#include "linkwright/app/write_whole.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <system_error>

namespace linkwright::app {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view ending = ".part";

/// 0 or the error number. The file may be read and written by those who may with `older`, if that exists.
int write_and_sync(const fs::path& file, const fs::path& older, std::string_view text) {
  struct stat before = {};
  const bool replaces = ::stat(older.c_str(), &before) == 0 && S_ISREG(before.st_mode);
  const int descriptor =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, replaces ? 0600 : 0666);
  if (descriptor < 0) return errno;
  int problem = replaces && ::fchmod(descriptor, before.st_mode & 07777) != 0 ? errno : 0;
  while (!text.empty() && problem == 0) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count >= 0)
      text.remove_prefix(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      problem = errno;
  }
  // Some file systems cannot; the file is then as safe as they make it.
  if (problem == 0 && ::fsync(descriptor) != 0 && errno != EINVAL) problem = errno;
  if (::close(descriptor) != 0 && problem == 0) problem = errno;
  return problem;
}

/// Makes a renaming last.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

std::string write_whole(const fs::path& file, std::string_view text) {
  const fs::path temporary = fmt::format("{}.{}{}", file.string(), ::getpid(), ending);
  std::error_code error;
  if (const int problem = write_and_sync(temporary, file, text); problem != 0)
    error.assign(problem, std::generic_category());
  else
    fs::rename(temporary, file, error);
  if (!error) {
    sync_folder(file.parent_path());
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
    pid_t process = 0;
    const auto [last, problem] = std::from_chars(begin, end, process);
    if (problem == std::errc() && last == end && process > 0 && ::kill(process, 0) != 0 && errno == ESRCH)
      fs::remove(entry.path(), error);
  }
}

}  // namespace linkwright::app
