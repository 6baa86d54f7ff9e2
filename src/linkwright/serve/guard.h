// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

/// Admission to the server of the workbench: only pages that it has served itself, opened with its token, may
/// ask. All is decided by the head of a request, before its body is read.
namespace linkwright::serve {

/// 256 bits of the system's random source as 64 hexadecimal digits. Throws std::system_error where the system
/// has none.
std::string random_token();

/// True if two secrets are the same, in a time that does not say where they differ.
bool same_secret(std::string_view a, std::string_view b);

/// True if the header Host names this machine itself and the port: "127.0.0.1:8080", "localhost:8080" or
/// "[::1]:8080"; at port 80 also without it. A name that somebody has made point here is none of them.
bool is_own_host(std::string_view host, int port);

/// True if the header Origin is the origin of a page of `host`.
bool is_own_origin(std::string_view origin, std::string_view host);

/// True if the header Authorization is "Bearer TOKEN" with this token.
bool has_token(std::string_view authorization, std::string_view token);

}  // namespace linkwright::serve
