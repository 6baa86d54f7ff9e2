// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/server.h"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "linkwright/serve/page.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"
#include "tests/serve/client.h"
#include "tests/serve/long_study.h"

namespace linkwright::serve {
namespace {
namespace fs = std::filesystem;
using namespace std::chrono_literals;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ServerTest : public ::testing::Test {
 protected:
  ServerTest() : folder_(fs::temp_directory_path() / ("linkwright-serve-" + std::to_string(::getpid()))) {
    if (workbench_page().empty()) return;
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    std::ofstream(folder_ / "s.toml") << test::example("hoeken");
    std::string problem;
    server_ = Server::start({folder_ / "s.toml", 0}, problem);
    EXPECT_EQ(problem, "");
  }
  ~ServerTest() override { fs::remove_all(folder_); }
  void SetUp() override {
    if (!server_) GTEST_SKIP() << "built without the pages of the viewer";
  }

  test::Client client() const { return test::Client(server_->port()); }
  test::Headers token() const { return {{"Authorization", "Bearer " + server_->token()}}; }
  test::Headers with(const char* header, const std::string& value) const {
    test::Headers headers = token();
    headers.emplace(header, value);
    return headers;
  }
  static std::string run_body(const std::string& run, const std::string& text) {
    Value body = Value::object();
    body["run"] = run;
    body["text"] = text;
    return study::to_json(body);
  }

  int connected() const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(server_->port()));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    return socket;
  }
  /// The answer to some bytes, up to the end of the connection.
  std::string exchange(std::string_view bytes) const {
    const int socket = connected();
    const timeval patience{30, 0};
    ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) break;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    ::shutdown(socket, SHUT_WR);
    std::string answer;
    char buffer[65536];
    for (ssize_t count; (count = ::recv(socket, buffer, sizeof buffer, 0)) > 0;) answer.append(buffer, count);
    ::close(socket);
    return answer;
  }
  std::string head(const std::string& first, const std::string& more) const {
    return fmt::format("{} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\n", first, server_->port(), more);
  }
  std::string bearer() const { return "Authorization: Bearer " + server_->token() + "\r\n"; }
  void expect_alive() const {
    auto answer = client().Get("/study", token());
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 200);
  }

  const fs::path folder_;
  std::unique_ptr<Server> server_;
};

TEST_F(ServerTest, ThePageIsForEverybodyAndSaysWhatItMayDo) {
  auto answer = client().Get("/");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Encoding"), "gzip");
  const std::string page = test::unpacked(answer->body);
  EXPECT_THAT(page, StartsWith("<!doctype html>"));
  EXPECT_THAT(page, HasSubstr("script-src 'sha256-"));
  EXPECT_EQ(page.find(server_->token()), std::string::npos);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(answer->get_header_value("X-Content-Type-Options"), "nosniff");
  EXPECT_EQ(answer->get_header_value("Cache-Control"), "no-store");
  EXPECT_EQ(answer->get_header_value("Referrer-Policy"), "no-referrer");
  EXPECT_THAT(answer->get_header_value("Content-Security-Policy"), HasSubstr("frame-ancestors 'none'"));
  for (const auto& [name, value] : answer->headers)
    EXPECT_THAT(name, ::testing::Not(StartsWith("Access-Control")));
  EXPECT_EQ(server_->address(),
            fmt::format("http://127.0.0.1:{}/#token={}", server_->port(), server_->token()));
}

TEST_F(ServerTest, AllElseNeedsTheToken) {
  for (const char* path :
       {"/catalogue", "/schema/analysis/planar.four_bar", "/study", "/nothing", "/favicon.ico"}) {
    EXPECT_EQ(client().Get(path)->status, 401) << path;
    EXPECT_EQ(client().Get(path, {{"Authorization", "Bearer " + std::string(64, '0')}})->status, 401) << path;
  }
  EXPECT_EQ(client().Post("/run", "{}", "text/plain")->status, 401);
  EXPECT_EQ(client().Post("/cancel", "a.1", "text/plain")->status, 401);
  EXPECT_EQ(client().Put("/study", "", "text/plain")->status, 401);
  EXPECT_EQ(client().Options("/run")->status, 401);
  test::Headers twice = token();
  twice.emplace("Authorization", "Bearer " + server_->token());
  EXPECT_EQ(client().Get("/study", twice)->status, 401);
  EXPECT_EQ(client().Get("/study", token())->status, 200);
  EXPECT_EQ(client().Get("/nothing", token())->status, 404);
  EXPECT_THAT(client().Get("/catalogue", token())->body, HasSubstr("\"jansen-leg\""));
  EXPECT_THAT(client().Get("/schema/analysis/planar.four_bar", token())->body, HasSubstr("\"crank_m\""));
  EXPECT_EQ(client().Get("/schema/analysis/nothing", token())->body, "null");
}

TEST_F(ServerTest, HostAndOriginAreItsOwn) {
  const std::string port = std::to_string(server_->port());
  for (const char* path : {"/", "/study"}) {
    for (const std::string& host : {"localhost:" + port, "[::1]:" + port})
      EXPECT_EQ(client().Get(path, with("Host", host))->status, 200) << host;
    for (const std::string& host :
         {std::string("example.org"), "example.org:" + port, std::string("127.0.0.1"), "192.168.0.1:" + port})
      EXPECT_EQ(client().Get(path, with("Host", host))->status, 403) << host;
    EXPECT_EQ(client().Get(path, with("Origin", "http://127.0.0.1:" + port))->status, 200);
    for (const std::string& origin : {std::string("null"), std::string("http://example.org"),
                                      "http://localhost:" + port, "https://127.0.0.1:" + port})
      EXPECT_EQ(client().Get(path, with("Origin", origin))->status, 403) << origin;
    EXPECT_THAT(exchange(fmt::format("GET {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nAuthorization: Bearer {}\r\n"
                                     "Origin:\r\nConnection: close\r\n\r\n",
                                     path, port, server_->token())),
                HasSubstr(" 200 "));
  }
  EXPECT_THAT(
      exchange(fmt::format("GET / HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nHost: example.org\r\n\r\n", port)),
      HasSubstr(" 403 "));
  EXPECT_THAT(exchange("GET / HTTP/1.0\r\n\r\n"), HasSubstr(" 403 "));
}

TEST_F(ServerTest, IsAtTheOtherLoopbackTooWhereThereIsOne) {
  const test::Client client(server_->port(), true);
  const auto answer = client.Get("/study", token());
  if (!answer) GTEST_SKIP() << "this machine has no ::1";
  EXPECT_EQ(answer->status, 200);
}

TEST_F(ServerTest, BodiesHaveALengthAndALimit) {
  EXPECT_THAT(exchange(head("POST /run", bearer() + "Content-Length: 16777217\r\n")), HasSubstr(" 413 "));
  EXPECT_THAT(exchange(head("POST /run", bearer() + "Content-Length: 99999999999999999999999\r\n")),
              HasSubstr(" 400 "));
  EXPECT_THAT(exchange(head("POST /run", bearer() + "Content-Length: -1\r\n")), HasSubstr(" 400 "));
  EXPECT_THAT(exchange(head("POST /run", bearer())), HasSubstr(" 411 "));
  EXPECT_THAT(exchange(head("POST /run", bearer() + "Content-Length: 1\r\nContent-Length: 2\r\n") + "{}"),
              HasSubstr(" 411 "));
  EXPECT_THAT(
      exchange(head("POST /run", bearer() + "Transfer-Encoding: chunked\r\n") + "2\r\n{}\r\n0\r\n\r\n"),
      HasSubstr(" 411 "));
  EXPECT_THAT(
      exchange(head("POST /run", bearer() + "Content-Length: 2\r\nContent-Encoding: gzip\r\n") + "{}"),
      HasSubstr(" 415 "));
  auto answer = client().Post("/run", token(), std::string(largest_body + 1, ' '), "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 413);
  EXPECT_EQ(answer->body, "the body is larger than 16 MB");
  answer = client().Post("/run", token(), std::string(largest_body, ' '), "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 400);
}

TEST_F(ServerTest, RunsAStudyAndShowsItsErrors) {
  auto answer = client().Post("/run", token(), run_body("a.1", test::example("hoeken")),
                              "multipart/form-data; boundary=x");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->get_header_value("Content-Type"), "application/octet-stream");
  EXPECT_THAT(answer->body, HasSubstr("\"diagnostics\":[]"));
  EXPECT_THAT(answer->body, HasSubstr("\"canonical\":{"));
  answer = client().Post(
      "/run", token(),
      run_body("a.2",
               "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nsampel = \"x\""),
      "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_THAT(answer->body, HasSubstr("did you mean 'sample'?"));
  EXPECT_EQ(client().Post("/run", token(), "{", "text/plain")->status, 400);
  EXPECT_EQ(client().Post("/run", token(), R"({"run": "a", "text": ""})", "text/plain")->body,
            "run: must be TAB.NUMBER, with at most 64 letters and digits for the tab");
}

TEST_F(ServerTest, ALongRunIsEndedByItsPage) {
  std::string got;
  std::thread asks([&] {
    const auto answer = client().Post("/run", token(), run_body("a.1", test::long_study()), "text/plain");
    if (answer) got = answer->body;
  });
  std::this_thread::sleep_for(500ms);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(client().Post("/cancel", token(), "a.1", "text/plain")->status, 204);
  asks.join();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
  EXPECT_THAT(got, HasSubstr("{\"progress\":{\"stage\":"));
  EXPECT_THAT(got, HasSubstr("\"status\":\"cancelled\""));
}

TEST_F(ServerTest, RunsOfPagesThatAreGoneEnd) {
  const std::string body = run_body("a.1", test::long_study());
  std::vector<int> open;
  for (std::size_t i = 0; i < max_runs; ++i) {
    const std::string own = run_body(fmt::format("tab{}.1", i), test::long_study());
    const std::string request =
        head("POST /run", bearer() + fmt::format("Content-Length: {}\r\n", own.size())) + own;
    open.push_back(connected());
    ASSERT_EQ(::send(open.back(), request.data(), request.size(), 0), static_cast<ssize_t>(request.size()));
    // The head of the answer comes when the run has its place.
    char first[12];
    ASSERT_EQ(::recv(open.back(), first, sizeof first, MSG_WAITALL), static_cast<ssize_t>(sizeof first));
    ASSERT_EQ(std::string_view(first, sizeof first), "HTTP/1.1 200");
  }
  const auto more = [&] {
    return client().Post("/run", token(), run_body("more.1", "schema = 1"), "text/plain");
  };
  auto answer = more();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 503);
  for (const int socket : open) ::close(socket);
  for (int wait = 0; wait < 3000 && answer && answer->status == 503; ++wait) {
    std::this_thread::sleep_for(20ms);
    answer = more();
  }
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
}

TEST_F(ServerTest, TheFileIsReadAndSavedUnlessSomebodyElseHasChangedIt) {
  const auto read = [&] {
    Diagnostics diagnostics;
    return study::read_text(client().Get("/study", token())->body, study::Syntax::json, "answer",
                            diagnostics);
  };
  const Value opened = read();
  EXPECT_EQ(opened.find("name")->as_string(), "s.toml");
  EXPECT_EQ(opened.find("text")->as_string(), test::example("hoeken"));
  const std::string version = '"' + opened.find("version")->as_string() + '"';
  EXPECT_EQ(client().Put("/study", token(), "x", "text/plain")->status, 428);
  EXPECT_EQ(client().Put("/study", with("If-Match", "\"0\""), "x", "text/plain")->status, 412);
  EXPECT_EQ(read().find("text")->as_string(), test::example("hoeken"));
  auto answer = client().Put("/study", with("If-Match", version), "title = \"Mine\"\n", "text/plain");
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(answer->body, fmt::format("{{\"version\":\"{}\"}}", read().find("version")->as_string()));
  EXPECT_EQ(read().find("text")->as_string(), "title = \"Mine\"\n");
  answer = client().Put("/study", with("If-Match", version), "x", "text/plain");
  EXPECT_EQ(answer->status, 412);
  EXPECT_EQ(answer->body, "s.toml was changed by another program since it was opened here");
}

TEST_F(ServerTest, WithoutAStudyThereIsNoneToOpenOrToSave) {
  std::string problem;
  const auto bare = Server::start({}, problem);
  const test::Client client(bare->port());
  test::Headers headers = {{"Authorization", "Bearer " + bare->token()}, {"If-Match", "\"\""}};
  EXPECT_EQ(client.Get("/study", headers)->status, 204);
  EXPECT_EQ(client.Put("/study", headers, "x", "text/plain")->status, 404);
}

TEST_F(ServerTest, ATakenPortIsSaid) {
  std::string problem;
  EXPECT_EQ(Server::start({{}, server_->port()}, problem), nullptr);
  EXPECT_EQ(problem, fmt::format("port {} is taken by another program; leave --port out for a free one",
                                 server_->port()));
  const int port = server_->port();
  server_.reset();
  problem.clear();
  server_ =
      Server::start({folder_ / "s.toml", port}, problem);  // and is free at once when its server has ended
  ASSERT_TRUE(server_) << problem;
  expect_alive();
}

TEST_F(ServerTest, HeadsHaveAnEnd) {
  std::string many;
  while (many.size() < (std::size_t{4} << 20)) many += "a: b\r\n";
  EXPECT_EQ(exchange(head("GET /", many)).find("200"), std::string::npos);
  EXPECT_THAT(exchange("GET /" + std::string(100000, 'x') + " HTTP/1.1\r\n\r\n"), HasSubstr(" 400 "));
  std::string ranges = "Range: bytes=0-0";
  while (ranges.size() < 8000) ranges += ",0-";
  EXPECT_LT(exchange(head("GET /", ranges + "\r\n")).size(), 2 * workbench_page().size());
  expect_alive();
}

TEST_F(ServerTest, ClientsThatSayNothingHoldNobodyForLong) {
  std::vector<int> silent;
  for (int i = 0; i < 100; ++i) silent.push_back(connected());
  const auto begin = std::chrono::steady_clock::now();
  int status = 0;
  while (status != 200 && std::chrono::steady_clock::now() - begin < 60s) {
    const auto answer = client().Get("/study", token());
    status = answer ? answer->status : 0;
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_EQ(status, 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin,
            20s);  // 5 s for all of them together, and slow machines
  for (const int socket : silent) ::close(socket);
}

TEST_F(ServerTest, AThousandRequestsAtOnceAreAnsweredOrRefused) {
  const std::string text = test::example("hoeken");
  std::atomic<int> answered{0}, refused{0}, neither{0};
  std::vector<std::thread> clients;
  for (int c = 0; c < 50; ++c)
    clients.emplace_back([&, c] {
      for (int i = 0; i < 20; ++i) {
        const std::string body = run_body(fmt::format("tab{}.{}", c, i), text);
        const std::string answer = exchange(
            i % 2 ? head("POST /run", bearer() + fmt::format("Content-Length: {}\r\n", body.size())) + body
                  : head("GET /catalogue", bearer()));
        ++(answer.starts_with("HTTP/1.1 200")                     ? answered
           : answer.empty() || answer.starts_with("HTTP/1.1 503") ? refused
                                                                  : neither);
      }
    });
  for (std::thread& thread : clients) thread.join();
  EXPECT_EQ(answered + refused, 1000);
  EXPECT_EQ(neither, 0);
  EXPECT_GT(answered, 100);
  expect_alive();
}

TEST_F(ServerTest, AThousandMalformedRequestsAtOnceDoNoHarm) {
  const std::string good = head("POST /run", bearer() + "Content-Length: 30\r\nExpect: 100-continue\r\n") +
                           R"({"run": "a.1", "text": "x=1"})";
  std::vector<std::thread> clients;
  std::atomic<int> strange{0};
  for (unsigned c = 0; c < 20; ++c)
    clients.emplace_back([&, c] {
      std::mt19937 random(c);
      for (int i = 0; i < 50; ++i) {
        std::string bytes = good;
        for (unsigned n = 1 + random() % 8; n > 0 && !bytes.empty(); --n) {
          const std::size_t at = random() % bytes.size();
          switch (random() % 5) {
            case 0:
              bytes[at] = static_cast<char>(random());
              break;
            case 1:
              bytes.erase(at, random() % 40);
              break;
            case 2:
              bytes.insert(at, random() % 2000, static_cast<char>(random()));
              break;
            case 3:
              bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 60));
              break;
            default:
              bytes.resize(at);
              break;
          }
        }
        const std::string answer = exchange(bytes);
        if (!answer.empty() && !answer.starts_with("HTTP/1.")) ++strange;
      }
    });
  for (std::thread& thread : clients) thread.join();
  EXPECT_EQ(strange, 0);
  expect_alive();
  rusage use = {};
  ::getrusage(RUSAGE_SELF, &use);
  EXPECT_LT(use.ru_maxrss, 2 << 20);  // kB
}

}  // namespace
}  // namespace linkwright::serve
