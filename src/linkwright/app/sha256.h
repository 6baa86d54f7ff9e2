// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace linkwright::app {

/// SHA-256 (FIPS 180-4) of bytes as 64 hexadecimal digits. Names studies; it guards nothing.
std::string sha256(std::string_view bytes);

}  // namespace linkwright::app
