// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/server.h"

#include <fmt/core.h>
#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "linkwright/app/view.h"
#include "linkwright/core/platform/sockets.h"
#include "linkwright/serve/guard.h"
#include "linkwright/serve/jobs.h"
#include "linkwright/serve/page.h"
#include "linkwright/serve/run_request.h"
#include "linkwright/serve/study_file.h"
#include "linkwright/study/write.h"

namespace linkwright::serve {
namespace {
using Clock = std::chrono::steady_clock;
using platform::Direction;
using std::chrono::milliseconds;
using std::chrono::seconds;

// Threads that answer; more than there are runs, so that some are always free.
constexpr std::size_t threads = 12;
constexpr std::size_t max_waiting = 64;  // connections that wait for one of them; others are refused
constexpr int backlog = 128;             // connections that wait to be accepted
constexpr std::size_t largest_head = std::size_t{64} << 10;
constexpr seconds head_patience{5}, body_patience{30}, answer_patience{60};
constexpr milliseconds glance{100};  // between two looks whether the server ends

/// Time at which the connection of this thread came.
thread_local Clock::time_point arrived;

/// One connection with one request. All that is read together has a limit and a time, so that clients which
/// send for ever, or hardly at all, do not hold their thread.
class Connection final : public httplib::Stream {
 public:
  Connection(socket_t socket, const std::atomic<bool>& ending) : socket_(socket), ending_(ending) {}
  ~Connection() override {
    platform::end_sending(socket_);
    // Data left unread would reset the connection before the answer has arrived.
    const auto end = Clock::now() + (unread_ ? seconds(2) : seconds(0));
    char rest[16384];
    do {
      while (platform::receive_at_once(socket_, rest, sizeof rest) > 0 && Clock::now() < end) continue;
    } while (Clock::now() < end && wait(Direction::to_read, end) &&
             platform::incoming(socket_) == platform::Incoming::data);
    platform::close(socket_);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void within(seconds patience) { end_ = Clock::now() + patience; }
  /// Lets the body be read as well.
  void accept_body(std::size_t size) {
    allowance_ += size;
    unread_ = false;
    within(body_patience);
  }
  void leave_body() { unread_ = true; }
  bool gone() const { return platform::incoming(socket_) == platform::Incoming::end; }

  bool is_readable() const override { return begin_ < size_ || wait(Direction::to_read, end_); }
  bool is_writable() const override { return !gone() && wait(Direction::to_write, end_); }
  ssize_t read(char* to, std::size_t size) override {
    if (begin_ == size_) {
      if (allowance_ == 0 || !wait(Direction::to_read, end_)) return -1;
      const ssize_t count = platform::receive(socket_, buffer_, std::min(sizeof buffer_, allowance_));
      if (count <= 0) return count;
      begin_ = 0;
      size_ = static_cast<std::size_t>(count);
      allowance_ -= size_;
    }
    const std::size_t count = std::min(size, size_ - begin_);
    std::memcpy(to, buffer_ + begin_, count);
    begin_ += count;
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, std::size_t size) override {
    if (!wait(Direction::to_write, end_)) return -1;
    return platform::send_at_once(socket_, from, size);
  }
  void get_remote_ip_and_port(std::string&, int&) const override {}
  void get_local_ip_and_port(std::string&, int&) const override {}
  socket_t socket() const override { return socket_; }

 private:
  bool wait(Direction direction, Clock::time_point end) const {
    while (!ending_) {
      const auto left =
          std::max(std::chrono::duration_cast<milliseconds>(end - Clock::now()), milliseconds(0));
      const platform::Waited waited = platform::wait_for(socket_, direction, std::min(left, glance));
      if (waited == platform::Waited::ready) return true;
      if (waited == platform::Waited::failed || left == milliseconds(0)) return false;
    }
    return false;
  }

  const socket_t socket_;
  const std::atomic<bool>& ending_;
  Clock::time_point end_ = arrived + head_patience;
  std::size_t allowance_ = largest_head;
  bool unread_ = false;
  char buffer_[16384];
  std::size_t begin_ = 0, size_ = 0;
};

/// The connection that this thread is about, and whether it is one too many.
thread_local Connection* connection = nullptr;
thread_local bool refusing = false;

/// The threads that answer. Who comes when too many wait is refused by the thread that accepts.
class Workers final : public httplib::TaskQueue {
 public:
  Workers() {
    for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  }
  void enqueue(std::function<void()> task) override {
    {
      const std::lock_guard lock(mutex_);
      if (tasks_.size() < max_waiting) {
        tasks_.emplace_back(Clock::now(), std::move(task));
        came_.notify_one();
        return;
      }
    }
    refusing = true;
    task();
    refusing = false;
  }
  void shutdown() override {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    came_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  void work() {
    for (std::unique_lock lock(mutex_);;) {
      came_.wait(lock, [this] { return over_ || !tasks_.empty(); });
      if (tasks_.empty()) return;
      const auto [came, task] = std::move(tasks_.front());
      tasks_.pop_front();
      arrived = came;
      lock.unlock();
      task();
      lock.lock();
    }
  }

  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<std::pair<Clock::time_point, std::function<void()>>> tasks_;
  bool over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

/// cpp-httplib with connections of our own, one request each.
class Listener final : public httplib::Server {
 public:
  Listener() {
    new_task_queue = [] { return new Workers; };
    // Not SO_REUSEPORT, which lets a second program listen at the same port.
    set_socket_options([](socket_t socket) { platform::reuse_address(socket); });
    set_tcp_nodelay(true);
    set_payload_max_length(largest_body);
  }

  void run() {
    platform::listen(svr_sock_, backlog);
    thread_ = std::thread([this] { listen_after_bind(); });
    while (!is_running()) std::this_thread::sleep_for(milliseconds(1));
  }
  void end() {
    ending_ = true;
    if (!thread_.joinable()) return;
    stop();
    thread_.join();
  }

 private:
  bool process_and_close_socket(socket_t socket) override try {
    Connection own(socket, ending_);
    if (refusing) {
      constexpr std::string_view answer =
          "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
      platform::send_at_once(socket, answer.data(), answer.size());
      return false;
    }
    connection = &own;
    bool closed = false;
    const bool done = process_request(own, true, closed, [](httplib::Request& request) {
      // Nothing here is compressed, is asked for in parts, or is a form.
      for (const char* header : {"Accept-Encoding", "Content-Type"}) request.headers.erase(header);
      request.ranges.clear();
    });
    connection = nullptr;
    return done;
  } catch (const std::exception&) {  // no memory for it
    connection = nullptr;
    return false;
  }

  std::atomic<bool> ending_{false};
  std::thread thread_;
};

namespace {

void answer(httplib::Response& response, int status, const std::string& text) {
  response.status = status;
  response.set_content(text, "text/plain; charset=utf-8");
}

void answer(httplib::Response& response, const Value& document) {
  response.set_content(study::to_json(document), "application/json");
}

/// The value of a header that is there exactly once; nothing else.
std::optional<std::string> header(const httplib::Request& request, const char* name) {
  if (request.get_header_value_count(name) != 1) return std::nullopt;
  return request.get_header_value(name);
}

/// The size of the body that a request brings; nothing, with the answer to it, where it is refused.
std::optional<std::size_t> body_size(const httplib::Request& request, httplib::Response& response) {
  const bool brings = request.method == "POST" || request.method == "PUT";
  const auto length = header(request, "Content-Length");
  if (request.has_header("Transfer-Encoding") || (brings && !length) ||
      request.get_header_value_count("Content-Length") > 1) {
    answer(response, 411, "the length of the body must be given once, as Content-Length");
    return std::nullopt;
  }
  if (request.has_header("Content-Encoding")) {
    answer(response, 415, "the body must not be compressed");
    return std::nullopt;
  }
  if (!length) return 0;
  std::size_t size = 0;
  const char* const end = length->data() + length->size();
  const auto [last, error] = std::from_chars(length->data(), end, size);
  if (error == std::errc::invalid_argument || last != end) {
    answer(response, 400, "Content-Length must be a number");
    return std::nullopt;
  }
  if (error != std::errc() || size > largest_body) {
    answer(response, 413, fmt::format("the body is larger than {} MB", largest_body >> 20));
    return std::nullopt;
  }
  return size;
}

std::optional<std::string> body_of(const httplib::ContentReader& read, httplib::Response& response) {
  std::string body;
  const bool whole = read([&](const char* data, std::size_t size) {
    body.append(data, size);
    return body.size() <= largest_body;
  });
  if (!whole) {
    answer(response, 400, "the body has not come whole");
    return std::nullopt;
  }
  connection->within(answer_patience);
  return body;
}

}  // namespace

struct Server::Parts {
  explicit Parts(const ServerOptions& options)
      : folder(std::filesystem::current_path()), token(random_token()) {
    if (!options.study.empty()) {
      study.emplace(options.study);
      folder = study->path().parent_path();
    }
    jobs.emplace(folder, max_runs);
    for (Listener* listener : {&here, &here6}) set_up(*listener);
  }

  void set_up(Listener& listener);
  bool admit(const httplib::Request& request, httplib::Response& response);
  void run(const httplib::ContentReader& read, httplib::Response& response);
  void save(const httplib::Request& request, const httplib::ContentReader& read, httplib::Response& response);

  std::filesystem::path folder;
  const std::string token;
  int port = 0;
  std::optional<StudyFile> study;
  std::optional<Jobs> jobs;
  Listener here, here6;
};

/// True if a request is answered at all; else `response` says why not.
bool Server::Parts::admit(const httplib::Request& request, httplib::Response& response) {
  if (request.has_header("Content-Length") || request.has_header("Transfer-Encoding"))
    connection->leave_body();
  const auto host = header(request, "Host");
  if (!host || !is_own_host(*host, port)) {
    answer(response, 403, "only this machine itself is answered, by its own name");
    return false;
  }
  // An empty one names no page.
  const std::string origin = header(request, "Origin").value_or("given twice");
  if (request.has_header("Origin") && !origin.empty() && !is_own_origin(origin, *host)) {
    answer(response, 403, "only pages of this server are answered");
    return false;
  }
  const bool page = request.path == "/" && (request.method == "GET" || request.method == "HEAD");
  if (!page && !has_token(header(request, "Authorization").value_or(""), token)) {
    answer(response, 401, "open the address that linkwright serve has printed last");
    return false;
  }
  const auto size = body_size(request, response);
  if (!size) return false;
  connection->accept_body(*size);
  return true;
}

void Server::Parts::run(const httplib::ContentReader& read, httplib::Response& response) {
  const auto body = body_of(read, response);
  if (!body) return;
  std::string problem;
  auto request = read_run_request(*body, problem);
  if (!request) return answer(response, 400, problem);
  const std::shared_ptr<Job> job = jobs->start(std::move(*request));
  if (!job)
    return answer(response, 503, fmt::format("{} studies are running; end one of them, or wait", max_runs));
  response.set_chunked_content_provider(
      "application/octet-stream", [job](std::size_t, httplib::DataSink& sink) {
        const Job::News news = job->news(glance);
        connection->within(answer_patience);
        const bool there =
            news.frames.empty() ? !connection->gone() : sink.write(news.frames.data(), news.frames.size());
        if (!there) job->cancel();
        if (news.last) sink.done();
        return there;
      });
}

void Server::Parts::save(const httplib::Request& request, const httplib::ContentReader& read,
                         httplib::Response& response) {
  const auto body = body_of(read, response);
  if (!body) return;
  if (!study) return answer(response, 404, "the server was started without a study");
  std::string version = header(request, "If-Match").value_or("");
  if (version.size() < 2 || version.front() != '"' || version.back() != '"')
    return answer(response, 428, "the version that was changed must be given, as If-Match");
  version = version.substr(1, version.size() - 2);
  const StudyFile::Saved saved = study->save(*body, version);
  if (saved.outcome != StudyFile::Outcome::saved)
    return answer(response, saved.outcome == StudyFile::Outcome::changed ? 412 : 500,
                  fmt::format("{} {}", study->path().filename().string(), saved.problem));
  Value out = Value::object();
  out["version"] = saved.version;
  answer(response, out);
}

void Server::Parts::set_up(Listener& listener) {
  using Handled = httplib::Server::HandlerResponse;
  listener.set_default_headers(
      {{"Content-Security-Policy",
        "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
        "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
       {"X-Content-Type-Options", "nosniff"},
       {"Cache-Control", "no-store"},
       {"Referrer-Policy", "no-referrer"},
       {"Cross-Origin-Opener-Policy", "same-origin"},
       {"Cross-Origin-Resource-Policy", "same-origin"}});
  listener.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    return admit(request, response) ? Handled::Unhandled : Handled::Handled;
  });
  listener.set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, std::exception_ptr) {
        answer(response, 500, "the server has failed at this");
      });
  listener.Get("/", [](const httplib::Request&, httplib::Response& response) {
    connection->within(answer_patience);
    const std::string_view page = workbench_page();
    response.set_header("Content-Encoding", "gzip");
    response.set_content(page.data(), page.size(), "text/html; charset=utf-8");
  });
  listener.Get("/catalogue", [](const httplib::Request&, httplib::Response& response) {
    answer(response, app::catalogue_document());
  });
  listener.Get(R"(/schema/([a-z_./]+))", [](const httplib::Request& request, httplib::Response& response) {
    answer(response, app::schema_document(request.matches[1].str()));
  });
  listener.Post("/run", [this](const httplib::Request&, httplib::Response& response,
                               const httplib::ContentReader& read) { run(read, response); });
  listener.Post("/cancel", [this](const httplib::Request&, httplib::Response& response,
                                  const httplib::ContentReader& read) {
    const auto run = body_of(read, response);
    if (!run) return;
    jobs->cancel(*run);
    response.status = 204;
  });
  listener.Get("/study", [this](const httplib::Request&, httplib::Response& response) {
    if (!study) {
      response.status = 204;
      return;
    }
    const StudyFile::Text read = study->read();
    const std::string name = study->path().filename().string();
    if (!read.problem.empty()) return answer(response, 500, fmt::format("{} {}", name, read.problem));
    Value out = Value::object();
    out["name"] = name;
    out["text"] = read.text;
    out["version"] = read.version;
    answer(response, out);
  });
  listener.Put("/study", [this](const httplib::Request& request, httplib::Response& response,
                                const httplib::ContentReader& read) { save(request, read, response); });
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

std::unique_ptr<Server> Server::start(const ServerOptions& options, std::string& problem) {
  if (workbench_page().empty()) {
    problem = "this program was built without the pages of the viewer (LINKWRIGHT_REPORT_VIEWER=OFF)";
    return nullptr;
  }
  auto parts = std::make_unique<Parts>(options);
  errno = 0;
  parts->port = options.port;
  if (options.port == 0)
    parts->port = parts->here.bind_to_any_port("127.0.0.1");
  else if (!parts->here.bind_to_port("127.0.0.1", options.port))
    parts->port = -1;
  if (parts->port <= 0) {
    problem = errno == EADDRINUSE
                  ? fmt::format("port {} is taken by another program; leave --port out for a free one",
                                options.port)
                  : fmt::format("cannot listen at port {}: {}", options.port, std::strerror(errno));
    return nullptr;
  }
  parts->here.run();
  // Machines without it are served all the same.
  if (parts->here6.bind_to_port("::1", parts->port)) parts->here6.run();
  return std::unique_ptr<Server>(new Server(std::move(parts)));
}

Server::~Server() {
  parts_->jobs->cancel_all();
  for (Listener* listener : {&parts_->here, &parts_->here6}) listener->end();
}

int Server::port() const { return parts_->port; }
const std::string& Server::token() const { return parts_->token; }
std::string Server::address() const { return fmt::format("http://127.0.0.1:{}/#token={}", port(), token()); }

}  // namespace linkwright::serve
