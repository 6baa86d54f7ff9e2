// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/server.h"

#include <fmt/core.h>

#include <array>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/chunk_encode.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/app/view.h"
#include "linkwright/core/platform/sockets.h"
#include "linkwright/serve/connection.h"
#include "linkwright/serve/guard.h"
#include "linkwright/serve/jobs.h"
#include "linkwright/serve/listener.h"
#include "linkwright/serve/page.h"
#include "linkwright/serve/run_request.h"
#include "linkwright/serve/study_file.h"
#include "linkwright/study/write.h"

namespace linkwright::serve {
namespace {
namespace net = boost::asio;
namespace http = boost::beast::http;
using boost::beast::error_code;
using http::field;
using http::status;
using http::verb;
using std::chrono::seconds;
using Request = http::request<http::string_body>;
using Parser = http::request_parser<http::string_body>;

constexpr int backlog = 128;  // connections that wait to be accepted
constexpr std::uint32_t largest_head = std::uint32_t{64} << 10;
constexpr std::size_t longest_target = 8192;
constexpr seconds body_patience{30}, answer_patience{60};

/// A connection as Beast reads and writes it. No request and no answer ends by the end of the connection,
/// which is an error therefore.
class Stream {
 public:
  explicit Stream(Connection& connection) : connection_(connection) {}

  template <class Buffers>
  std::size_t read_some(const Buffers& buffers, error_code& error) {
    const net::mutable_buffer to = *net::buffer_sequence_begin(buffers);
    return done(connection_.read(static_cast<char*>(to.data()), to.size()), error);
  }
  template <class Buffers>
  std::size_t write_some(const Buffers& buffers, error_code& error) {
    for (auto part = net::buffer_sequence_begin(buffers); part != net::buffer_sequence_end(buffers); ++part) {
      const net::const_buffer from = *part;
      if (from.size() > 0)
        return done(connection_.write(static_cast<const char*>(from.data()), from.size()), error);
    }
    error = {};
    return 0;
  }
  template <class Buffers>
  std::size_t read_some(const Buffers& buffers) {
    return checked(&Stream::read_some<Buffers>, buffers);
  }
  template <class Buffers>
  std::size_t write_some(const Buffers& buffers) {
    return checked(&Stream::write_some<Buffers>, buffers);
  }

 private:
  static std::size_t done(long count, error_code& error) {
    error = {};
    if (count == 0) error = net::error::eof;
    if (count < 0) error = net::error::timed_out;
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  template <class Buffers>
  std::size_t checked(std::size_t (Stream::*some)(const Buffers&, error_code&), const Buffers& buffers) {
    error_code error;
    const std::size_t count = (this->*some)(buffers, error);
    if (error) throw boost::system::system_error(error);
    return count;
  }

  Connection& connection_;
};

struct Answer {
  status code = status::ok;
  std::string_view type = {};
  std::string body = {};
  std::shared_ptr<Job> job = nullptr;  ///< its frames come in place of the body
  bool packed = false;                 ///< the body is compressed by gzip
};

Answer text(status code, std::string words) {
  return {.code = code, .type = "text/plain; charset=utf-8", .body = std::move(words)};
}

Answer json(const Value& document) { return {.type = "application/json", .body = study::to_json(document)}; }

std::string_view view(boost::beast::string_view words) { return {words.data(), words.size()}; }

/// The value of a header that is there exactly once; nothing else.
std::optional<std::string_view> header(const Request& request, field name) {
  if (request.count(name) != 1) return std::nullopt;
  return view(request[name]);
}

std::string_view path_of(const Request& request) {
  const std::string_view target = view(request.target());
  return target.substr(0, target.find_first_of("?#"));
}

template <class Body>
http::response<Body> head_of(const Answer& answer) {
  http::response<Body> head(answer.code, 11);
  head.set("Content-Security-Policy",
           "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
           "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  head.set("X-Content-Type-Options", "nosniff");
  head.set(field::cache_control, "no-store");
  head.set("Referrer-Policy", "no-referrer");
  head.set("Cross-Origin-Opener-Policy", "same-origin");
  head.set("Cross-Origin-Resource-Policy", "same-origin");
  head.set(field::connection, "close");
  if (answer.packed) head.set(field::content_encoding, "gzip");
  if (!answer.type.empty()) head.set(field::content_type, {answer.type.data(), answer.type.size()});
  return head;
}

void send(Stream& stream, Answer answer, bool head_only) {
  auto response = head_of<http::string_body>(answer);
  response.body() = std::move(answer.body);
  response.prepare_payload();
  http::response_serializer<http::string_body> serializer(response);
  error_code error;
  if (head_only)
    http::write_header(stream, serializer, error);
  else
    http::write(stream, serializer, error);
}

/// Sends the frames of a run as they come; the run ends with its page.
void send_frames(Stream& stream, Connection& connection, const Answer& answer) {
  auto response = head_of<http::empty_body>(answer);
  response.chunked(true);
  http::response_serializer<http::empty_body> serializer(response);
  error_code error;
  http::write_header(stream, serializer, error);
  for (bool over = false; !error && !over;) {
    const Job::News news = answer.job->news(glance);
    connection.within(answer_patience);
    over = news.last;
    if (!news.frames.empty())
      net::write(stream, http::make_chunk(net::buffer(news.frames)), error);
    else if (connection.gone())
      error = net::error::eof;
  }
  if (error) return answer.job->cancel();
  net::write(stream, http::make_chunk_last(), error);
}

/// The answer to a head that cannot be read.
Answer unreadable(const Request& request, error_code error) {
  const bool length_before =
      request.count(field::content_length) + request.count(field::transfer_encoding) > 0;
  if (error == http::error::bad_transfer_encoding ||
      (error == http::error::bad_content_length && length_before))
    return text(status::length_required, "the length of the body must be given once, as Content-Length");
  if (error == http::error::bad_content_length)
    return text(status::bad_request, "Content-Length must be a number");
  return {.code = status::bad_request};
}

/// The answer to a body that is refused before it is read.
std::optional<Answer> refused_body(const Parser& parser) {
  const Request& request = parser.get();
  const bool brings = request.method() == verb::post || request.method() == verb::put;
  if (request.count(field::transfer_encoding) > 0 || request.count(field::content_length) > 1 ||
      (brings && request.count(field::content_length) == 0))
    return text(status::length_required, "the length of the body must be given once, as Content-Length");
  if (request.count(field::content_encoding) > 0)
    return text(status::unsupported_media_type, "the body must not be compressed");
  if (parser.content_length().value_or(0) > largest_body)
    return text(status::payload_too_large, fmt::format("the body is larger than {} MB", largest_body >> 20));
  return std::nullopt;
}

}  // namespace

struct Server::Parts {
  /// What answers a method at a path, or at all paths that begin like it and go on.
  struct Route {
    verb method;
    std::string_view path;
    bool goes_on;
    Answer (Parts::*answer)(const Request&);
  };

  explicit Parts(const ServerOptions& options)
      : folder(std::filesystem::current_path()), token(random_token()) {
    if (!options.study.empty()) {
      study.emplace(options.study);
      folder = study->path().parent_path();
    }
    jobs.emplace(folder, max_runs);
  }

  void listen(platform::Socket socket) {
    listeners.push_back(std::make_unique<Listener>(socket, [this](Connection& c) { converse(c); }));
  }
  void converse(Connection& connection);
  Answer answer(Stream& stream, Connection& connection, boost::beast::flat_buffer& buffer, Parser& parser);
  std::optional<Answer> refused(const Request& request) const;

  Answer page(const Request& request);
  Answer catalogue(const Request& request);
  Answer schema(const Request& request);
  Answer run(const Request& request);
  Answer cancel(const Request& request);
  Answer open(const Request& request);
  Answer save(const Request& request);

  std::filesystem::path folder;
  const std::string token;
  int port = 0;
  std::optional<StudyFile> study;
  std::optional<Jobs> jobs;
  std::vector<std::unique_ptr<Listener>> listeners;
};

/// One request and its answer.
void Server::Parts::converse(Connection& connection) try {
  Stream stream(connection);
  boost::beast::flat_buffer buffer;
  Parser parser;
  parser.header_limit(largest_head);
  parser.body_limit(std::numeric_limits<std::uint64_t>::max());  // refused with words
  error_code error;
  http::read_header(stream, buffer, parser, error);
  if (error && !parser.got_some()) return;
  Answer out;
  try {
    out = error ? unreadable(parser.get(), error) : answer(stream, connection, buffer, parser);
  } catch (const std::exception&) {
    out = text(status::internal_server_error, "the server has failed at this");
  }
  const bool broken = error == net::error::timed_out || error == http::error::partial_message;
  if (!broken && !parser.is_done()) connection.leave_unread();
  if (out.job)
    send_frames(stream, connection, out);
  else
    send(stream, std::move(out), parser.get().method() == verb::head);
} catch (const std::exception&) {  // no memory for it
}

/// The answer to a request whose head was read; reads the body where there is one.
Answer Server::Parts::answer(Stream& stream, Connection& connection, boost::beast::flat_buffer& buffer,
                             Parser& parser) {
  static constexpr std::array routes = {
      Route{verb::get, "/", false, &Parts::page},
      Route{verb::get, "/catalogue", false, &Parts::catalogue},
      Route{verb::get, "/schema/", true, &Parts::schema},
      Route{verb::post, "/run", false, &Parts::run},
      Route{verb::post, "/cancel", false, &Parts::cancel},
      Route{verb::get, "/study", false, &Parts::open},
      Route{verb::put, "/study", false, &Parts::save},
  };
  const Request& request = parser.get();
  if (auto no = refused(request)) return *no;
  if (auto no = refused_body(parser)) return *no;
  const verb method = request.method() == verb::head ? verb::get : request.method();
  const std::string_view path = path_of(request);
  for (const Route& route : routes) {
    if (route.method != method || !path.starts_with(route.path) ||
        (path.size() > route.path.size()) != route.goes_on)
      continue;
    if (!parser.is_done()) {
      connection.within(body_patience);
      error_code error;
      if (view(request[field::expect]) == "100-continue")
        net::write(stream, net::buffer(std::string_view("HTTP/1.1 100 Continue\r\n\r\n")), error);
      http::read(stream, buffer, parser, error);
      if (error) return text(status::bad_request, "the body has not come whole");
    }
    connection.within(answer_patience);
    return (this->*route.answer)(request);
  }
  return {.code = status::not_found};
}

/// The answer to a request that this server does not serve at all.
std::optional<Answer> Server::Parts::refused(const Request& request) const {
  if (request.target().size() > longest_target) return Answer{.code = status::uri_too_long};
  if (request.method() == verb::unknown) return Answer{.code = status::bad_request};
  const auto host = header(request, field::host);
  if (!host || !is_own_host(*host, port))
    return text(status::forbidden, "only this machine itself is answered, by its own name");
  // An empty one names no page.
  const std::string_view origin = header(request, field::origin).value_or("given twice");
  if (request.count(field::origin) > 0 && !origin.empty() && !is_own_origin(origin, *host))
    return text(status::forbidden, "only pages of this server are answered");
  const bool page =
      path_of(request) == "/" && (request.method() == verb::get || request.method() == verb::head);
  if (!page && !has_token(header(request, field::authorization).value_or(""), token))
    return text(status::unauthorized, "open the address that linkwright serve has printed last");
  return std::nullopt;
}

Answer Server::Parts::page(const Request&) {
  return {.type = "text/html; charset=utf-8", .body = std::string(workbench_page()), .packed = true};
}

Answer Server::Parts::catalogue(const Request&) { return json(app::catalogue_document()); }

Answer Server::Parts::schema(const Request& request) {
  const std::string_view kind = path_of(request).substr(std::string_view("/schema/").size());
  if (kind.find_first_not_of("abcdefghijklmnopqrstuvwxyz_./") != kind.npos)
    return {.code = status::not_found};
  return json(app::schema_document(std::string(kind)));
}

Answer Server::Parts::run(const Request& request) {
  std::string problem;
  auto asked = read_run_request(request.body(), problem);
  if (!asked) return text(status::bad_request, problem);
  std::shared_ptr<Job> job = jobs->start(std::move(*asked));
  if (!job)
    return text(status::service_unavailable,
                fmt::format("{} studies are running; end one of them, or wait", max_runs));
  return {.type = "application/octet-stream", .job = std::move(job)};
}

Answer Server::Parts::cancel(const Request& request) {
  jobs->cancel(request.body());
  return {.code = status::no_content};
}

Answer Server::Parts::open(const Request&) {
  if (!study) return {.code = status::no_content};
  const StudyFile::Text read = study->read();
  const std::string name = study->path().filename().string();
  if (!read.problem.empty())
    return text(status::internal_server_error, fmt::format("{} {}", name, read.problem));
  Value out = Value::object();
  out["name"] = name;
  out["text"] = read.text;
  out["version"] = read.version;
  return json(out);
}

Answer Server::Parts::save(const Request& request) {
  if (!study) return text(status::not_found, "the server was started without a study");
  const std::string_view version = header(request, field::if_match).value_or("");
  if (version.size() < 2 || version.front() != '"' || version.back() != '"')
    return text(status::precondition_required, "the version that was changed must be given, as If-Match");
  const StudyFile::Saved saved =
      study->save(request.body(), std::string(version.substr(1, version.size() - 2)));
  if (saved.outcome != StudyFile::Outcome::saved)
    return text(saved.outcome == StudyFile::Outcome::changed ? status::precondition_failed
                                                             : status::internal_server_error,
                fmt::format("{} {}", study->path().filename().string(), saved.problem));
  Value out = Value::object();
  out["version"] = saved.version;
  return json(out);
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

std::unique_ptr<Server> Server::start(const ServerOptions& options, std::string& problem) {
  if (workbench_page().empty()) {
    problem = "this program was built without the pages of the viewer (LINKWRIGHT_REPORT_VIEWER=OFF)";
    return nullptr;
  }
  auto parts = std::make_unique<Parts>(options);
  const platform::Socket here = platform::listen(platform::Loopback::version4, options.port, backlog);
  if (here < 0) {
    problem = errno == EADDRINUSE
                  ? fmt::format("port {} is taken by another program; leave --port out for a free one",
                                options.port)
                  : fmt::format("cannot listen at port {}: {}", options.port, std::strerror(errno));
    return nullptr;
  }
  parts->port = platform::port_of(here);
  parts->listen(here);
  // Machines without it are served all the same.
  const platform::Socket here6 = platform::listen(platform::Loopback::version6, parts->port, backlog);
  if (here6 >= 0) parts->listen(here6);
  return std::unique_ptr<Server>(new Server(std::move(parts)));
}

Server::~Server() {
  parts_->jobs->cancel_all();
  parts_->listeners.clear();
}

int Server::port() const { return parts_->port; }
const std::string& Server::token() const { return parts_->token; }
std::string Server::address() const { return fmt::format("http://127.0.0.1:{}/#token={}", port(), token()); }

}  // namespace linkwright::serve
