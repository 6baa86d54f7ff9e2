// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace linkwright::app {

/// Writes a file whole or not at all: under a temporary name first, which it gets rid of when something goes
/// wrong, and on the disk before it takes the place of an older file, whose permissions it keeps. Returns
/// what went wrong, empty if nothing did.
std::string write_whole(const std::filesystem::path& file, std::string_view text);
/// The same of a file that is given in pieces; an empty one is the end.
std::string write_whole(const std::filesystem::path& file, const std::function<std::string_view()>& next);

/// Removes what writers of this file left behind when they were killed: temporary files of processes that
/// are no more.
void remove_leftovers(const std::filesystem::path& file);

}  // namespace linkwright::app
