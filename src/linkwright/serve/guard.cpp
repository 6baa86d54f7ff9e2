// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/guard.h"

#include <fmt/core.h>

#include <array>

#include "linkwright/core/platform/machine.h"

namespace linkwright::serve {

std::string random_token() {
  std::array<unsigned char, 32> bytes{};
  platform::fill_random(bytes);
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool same_secret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  volatile unsigned char differs = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    differs = static_cast<unsigned char>(
        differs | (static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i])));
  return differs == 0;
}

bool is_own_host(std::string_view host, int port) {
  for (const std::string_view name : {"127.0.0.1", "localhost", "[::1]"})
    if (host == fmt::format("{}:{}", name, port) || (port == 80 && host == name)) return true;
  return false;
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  return origin == fmt::format("http://{}", host);
}

bool has_token(std::string_view authorization, std::string_view token) {
  constexpr std::string_view scheme = "Bearer ";
  return authorization.starts_with(scheme) && same_secret(authorization.substr(scheme.size()), token);
}

}  // namespace linkwright::serve
