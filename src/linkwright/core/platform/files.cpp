// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/files.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>

namespace linkwright::platform {
namespace fs = std::filesystem;

std::error_code write_to_disk(const fs::path& file, const std::function<std::string_view()>& next,
                              const fs::path& like) {
  const auto failed = [] { return std::error_code(errno, std::generic_category()); };
  struct stat before = {};
  const bool replaces = ::stat(like.c_str(), &before) == 0 && S_ISREG(before.st_mode);
  // A folder that may be written would let a file be replaced that may not; root may write any.
  if (replaces && ((before.st_mode & 0222) == 0 || ::access(like.c_str(), W_OK) != 0))
    return std::make_error_code(std::errc::permission_denied);
  const int descriptor =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, replaces ? 0600 : 0666);
  if (descriptor < 0) return failed();
  std::error_code error;
  struct stat made = {};
  if (replaces && ::fstat(descriptor, &made) != 0) error = failed();
  if (replaces && !error && (made.st_uid != before.st_uid || made.st_gid != before.st_gid) &&
      ::fchown(descriptor, before.st_uid, before.st_gid) != 0)
    error = failed();
  // Set after the owner, whose change takes some of them away.
  if (replaces && !error && ::fchmod(descriptor, before.st_mode & 07777) != 0) error = failed();
  std::string_view text;
  while (!error && !(text.empty() && (text = next()).empty())) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    if (count >= 0)
      text.remove_prefix(static_cast<std::size_t>(count));
    else if (errno != EINTR)
      error = failed();
  }
  // Some file systems cannot; the file is then as safe as they make it.
  if (!error && ::fsync(descriptor) != 0 && errno != EINVAL) error = failed();
  if (::close(descriptor) != 0 && !error) error = failed();
  return error;
}

void report_size_limits() { ::signal(SIGXFSZ, SIG_IGN); }

void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

fs::path make_private_folder(const fs::path& parent, std::error_code& error) {
  std::string name = (parent / "linkwright-XXXXXX").string();
  const bool made = ::mkdtemp(name.data()) != nullptr;
  error = made ? std::error_code() : std::error_code(errno, std::generic_category());
  return made ? fs::path(name) : fs::path();
}

}  // namespace linkwright::platform
