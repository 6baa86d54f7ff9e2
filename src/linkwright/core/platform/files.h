#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

namespace linkwright::platform {

/// Writes a file, whose pieces `next` gives until it gives an empty one, and waits until it is on the disk.
/// Who may read and write `like`, if that is a file, may do so with it too.
std::error_code write_to_disk(const std::filesystem::path& file,
                              const std::function<std::string_view()>& next,
                              const std::filesystem::path& like);

/// Makes renamings in a folder last; does nothing where the system cannot.
void sync_folder(const std::filesystem::path& folder);

/// A new folder inside another one, with a name of its own, that only this user can read; empty with an
/// error where it cannot be made.
std::filesystem::path make_private_folder(const std::filesystem::path& parent, std::error_code& error);

}  // namespace linkwright::platform
