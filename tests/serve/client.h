// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>
#include <zlib.h>

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace linkwright::serve::test {

using Headers = std::multimap<std::string, std::string>;

struct Answer {
  int status = 0;
  std::string body;
  Headers headers;

  std::string get_header_value(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? "" : found->second;
  }
};

/// What gzip has packed; empty when it is damaged.
inline std::string unpacked(const std::string& packed) {
  z_stream stream{};
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) return {};
  std::string in = packed, out;
  stream.next_in = reinterpret_cast<Bytef*>(in.data());
  stream.avail_in = static_cast<uInt>(in.size());
  int status = Z_OK;
  while (status == Z_OK) {
    char part[1 << 16];
    stream.next_out = reinterpret_cast<Bytef*>(part);
    stream.avail_out = sizeof part;
    status = inflate(&stream, Z_NO_FLUSH);
    out.append(part, sizeof part - stream.avail_out);
  }
  inflateEnd(&stream);
  return status == Z_STREAM_END ? out : std::string();
}

/// Asks a server of this machine, one connection a request, and waits a minute for each part of an answer.
class Client {
 public:
  explicit Client(int port, bool version6 = false) : port_(port), version6_(version6) {}

  std::optional<Answer> Get(const std::string& path, const Headers& headers = {}) const {
    return ask("GET", path, headers);
  }
  std::optional<Answer> Options(const std::string& path) const { return ask("OPTIONS", path, {}); }
  std::optional<Answer> Post(const std::string& path, const Headers& headers, std::string_view body,
                             const std::string& type) const {
    return ask("POST", path, headers, body, type);
  }
  std::optional<Answer> Post(const std::string& path, std::string_view body, const std::string& type) const {
    return Post(path, {}, body, type);
  }
  std::optional<Answer> Put(const std::string& path, const Headers& headers, std::string_view body,
                            const std::string& type) const {
    return ask("PUT", path, headers, body, type);
  }
  std::optional<Answer> Put(const std::string& path, std::string_view body, const std::string& type) const {
    return Put(path, {}, body, type);
  }

 private:
  std::optional<Answer> ask(const std::string& method, const std::string& path, const Headers& headers,
                            std::string_view body = {}, const std::string& type = {}) const {
    std::string request = fmt::format("{} {} HTTP/1.1\r\n", method, path);
    if (headers.find("Host") == headers.end())
      request += fmt::format("Host: {}:{}\r\n", version6_ ? "[::1]" : "127.0.0.1", port_);
    for (const auto& [name, value] : headers) request += fmt::format("{}: {}\r\n", name, value);
    if (!type.empty())
      request += fmt::format("Content-Type: {}\r\nContent-Length: {}\r\n", type, body.size());
    request += "\r\n";
    request += body;

    const int socket = connected();
    if (socket < 0) return std::nullopt;
    for (std::string_view rest = request; !rest.empty();) {
      const ssize_t sent = ::send(socket, rest.data(), rest.size(), MSG_NOSIGNAL);
      if (sent <= 0) break;
      rest.remove_prefix(static_cast<std::size_t>(sent));
    }
    std::string answer;
    char buffer[65536];
    for (ssize_t count; (count = ::recv(socket, buffer, sizeof buffer, 0)) > 0;)
      answer.append(buffer, static_cast<std::size_t>(count));
    ::close(socket);
    return parsed(answer);
  }

  int connected() const {
    sockaddr_in6 to6 = {};
    to6.sin6_family = AF_INET6;
    to6.sin6_port = htons(static_cast<std::uint16_t>(port_));
    to6.sin6_addr = in6addr_loopback;
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_port = to6.sin6_port;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int socket = ::socket(version6_ ? AF_INET6 : AF_INET, SOCK_STREAM, 0);
    const timeval patience{60, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    const int failed = version6_ ? ::connect(socket, reinterpret_cast<const sockaddr*>(&to6), sizeof to6)
                                 : ::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to);
    if (!failed) return socket;
    ::close(socket);
    return -1;
  }

  static std::optional<Answer> parsed(std::string_view bytes) {
    boost::beast::http::response_parser<boost::beast::http::string_body> parser;
    parser.body_limit(std::numeric_limits<std::uint64_t>::max());
    parser.eager(true);
    boost::beast::error_code error;
    while (!bytes.empty() && !parser.is_done()) {
      bytes.remove_prefix(parser.put(boost::asio::buffer(bytes), error));
      if (error) return std::nullopt;
    }
    if (!parser.is_done()) return std::nullopt;
    const auto& message = parser.get();
    Answer answer{static_cast<int>(message.result_int()), message.body(), {}};
    for (const auto& field : message)
      answer.headers.emplace(std::string(field.name_string()), std::string(field.value()));
    return answer;
  }

  int port_;
  bool version6_;
};

}  // namespace linkwright::serve::test
