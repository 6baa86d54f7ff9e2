#include "linkwright/core/platform/files.h"

#include <fcntl.h>
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
  const int descriptor =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, replaces ? 0600 : 0666);
  if (descriptor < 0) return failed();
  std::error_code error;
  if (replaces && ::fchmod(descriptor, before.st_mode & 07777) != 0) error = failed();
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
