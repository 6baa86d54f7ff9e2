// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/guard.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace linkwright::serve {
namespace {

TEST(Guard, TokensAreLongAndNeverTheSame) {
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) {
    const std::string token = random_token();
    EXPECT_EQ(token.size(), 64u);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), token.npos);
    EXPECT_TRUE(seen.insert(token).second);
  }
}

TEST(Guard, SecretsAreTheSameOrNot) {
  EXPECT_TRUE(same_secret("", ""));
  EXPECT_TRUE(same_secret("abc", "abc"));
  for (const char* other : {"", "ab", "abcd", "abd", "bbc", "ABC"})
    EXPECT_FALSE(same_secret("abc", other)) << other;
  EXPECT_FALSE(same_secret(std::string_view("a\0b", 3), std::string_view("a\0c", 3)));
}

TEST(Guard, AnOwnHostIsThisMachineByItsOwnNameAndPort) {
  for (const char* host : {"127.0.0.1:8080", "localhost:8080", "[::1]:8080"})
    EXPECT_TRUE(is_own_host(host, 8080)) << host;
  for (const char* host :
       {"", "127.0.0.1", "127.0.0.1:", "127.0.0.1:80", "127.0.0.1:08080", "127.0.0.1:8080 ",
        "127.0.0.1:8080.example.org", "example.org:8080", "127.0.0.1.example.org:8080", "::1:8080",
        "localhost.:8080", "user@localhost:8080", "0.0.0.0:8080", "192.168.0.1:8080", "127.0.0.2:8080"})
    EXPECT_FALSE(is_own_host(host, 8080)) << host;
  EXPECT_TRUE(is_own_host("localhost", 80));
  EXPECT_TRUE(is_own_host("localhost:80", 80));
  EXPECT_FALSE(is_own_host("example.org", 80));
}

TEST(Guard, AnOwnOriginIsThatOfTheSameHost) {
  EXPECT_TRUE(is_own_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  for (const char* origin :
       {"", "null", "https://127.0.0.1:8080", "http://127.0.0.1:8081", "http://localhost:8080",
        "http://127.0.0.1:8080/", "http://127.0.0.1:8080.example.org", "file://"})
    EXPECT_FALSE(is_own_origin(origin, "127.0.0.1:8080")) << origin;
}

TEST(Guard, TheTokenComesAsBearer) {
  EXPECT_TRUE(has_token("Bearer 00ff", "00ff"));
  for (const char* header : {"", "Bearer", "Bearer ", "Bearer 00fe", "Bearer 00ff ", "Bearer 00f",
                             "bearer 00ff", "Basic 00ff", "00ff"})
    EXPECT_FALSE(has_token(header, "00ff")) << header;
}

}  // namespace
}  // namespace linkwright::serve
