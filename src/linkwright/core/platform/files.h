// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

namespace linkwright::platform {

/// Writes a file, whose pieces `next` gives until it gives an empty one, and waits until it is on the disk.
/// It gets the owner and the permissions of `like`, if that is a file; an error where it cannot, and where
/// nobody may write `like`.
std::error_code write_to_disk(const std::filesystem::path& file,
                              const std::function<std::string_view()>& next,
                              const std::filesystem::path& like);

/// From now on a write beyond the limit of a file's size is an error of that write; it would end the program.
void report_size_limits();

/// Makes renamings in a folder last; does nothing where the system cannot.
void sync_folder(const std::filesystem::path& folder);

/// A new folder inside another one, with a name of its own, that only this user can read; empty with an
/// error where it cannot be made.
std::filesystem::path make_private_folder(const std::filesystem::path& parent, std::error_code& error);

}  // namespace linkwright::platform
