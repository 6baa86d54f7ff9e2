// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/read_syntax.h"

#include <fmt/core.h>

#include <string>

namespace linkwright::study {
namespace {

/// Length of the well-formed UTF-8 character at `at` (RFC 3629: no overlong forms, no surrogates), 0 if there
/// is none.
std::size_t utf8_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(at);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(at + 1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF)
    return follows(at + 1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF) && follows(at + 2) ? 3
                                                                                                        : 0;
  if (first >= 0xF0 && first <= 0xF4)
    return follows(at + 1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF) && follows(at + 2) &&
                   follows(at + 3)
               ? 4
               : 0;
  return 0;
}

unsigned code_point(std::string_view character) {
  const auto bits = [&](std::size_t i) { return static_cast<unsigned char>(character[i]) & 0x3Fu; };
  const unsigned first = static_cast<unsigned char>(character[0]);
  if (character.size() == 2) return (first & 0x1Fu) << 6 | bits(1);
  if (character.size() == 3) return (first & 0x0Fu) << 12 | bits(1) << 6 | bits(2);
  return (first & 0x07u) << 18 | bits(1) << 12 | bits(2) << 6 | bits(3);
}

/// Walks over a text character by character and knows which of them are in strings and comments.
class Scanner {
 public:
  Scanner(std::string_view text, Syntax syntax) : text_(text), syntax_(syntax) {}

  Diagnostics run() {
    while (at_ < text_.size() && problems_.empty()) {
      const std::size_t length = utf8_length(text_, at_);
      if (length == 0) {
        problem(fmt::format("the byte 0x{:02X} is not UTF-8 text", static_cast<unsigned char>(text_[at_])),
                "save the file as UTF-8");
        break;
      }
      if (length == 1)
        ascii(text_[at_]);
      else if (quote_ == 0 && !comment_)
        problem(fmt::format("the character '{}' (U+{:04X}) is only allowed in strings and comments",
                            text_.substr(at_, length), code_point(text_.substr(at_, length))),
                "use plain ASCII characters, or quotes around the text");
      advance(length);
    }
    return std::move(problems_);
  }

 private:
  void problem(std::string message, std::string hint) {
    problems_.push_back(
        {Diagnostic::Severity::error, {}, position_, {}, std::move(message), std::move(hint)});
  }

  void advance(std::size_t length) {
    if (text_[at_] == '\n')
      position_ = {position_.line + 1, 1};
    else
      ++position_.column;
    at_ += length;
  }

  void ascii(char c) {
    if (comment_) {
      comment_ = c != '\n';
      if (!comment_) outside(c);
    } else if (quote_ != 0) {
      in_string(c);
    } else if (c == '"' || (c == '\'' && syntax_ == Syntax::toml)) {
      // In `a = 202"x"` toml++ takes the quotes as part of a number; it must not see what we take for a
      // string.
      if (syntax_ == Syntax::toml && !may_begin_string_)
        problem(fmt::format("is not valid TOML: a text cannot begin with {} here", c),
                "is there a , or = missing?");
      else
        open_string(c);
    } else if (c == '#' && syntax_ == Syntax::toml) {
      comment_ = true;
    } else {
      outside(c);
    }
  }

  void open_string(char c) {
    quote_ = c;
    may_begin_string_ = false;
    long_string_ = syntax_ == Syntax::toml && text_.substr(at_, 3) == std::string(3, c);
    if (!long_string_) return;
    advance(1);
    advance(1);
  }

  void in_string(char c) {
    if (c == '\\' && quote_ == '"' && at_ + 1 < text_.size() &&
        static_cast<unsigned char>(text_[at_ + 1]) < 0x80 && text_[at_ + 1] != '\n') {
      advance(1);  // the escaped character is no quote
    } else if (long_string_) {
      if (text_.substr(at_, 3) != std::string(3, quote_)) return;
      // Up to two quotes may precede the closing three.
      std::size_t run = 3;
      while (run < 5 && at_ + run < text_.size() && text_[at_ + run] == quote_) ++run;
      for (std::size_t i = 1; i < run; ++i) advance(1);
      quote_ = 0;
    } else if (c == quote_ || c == '\n') {
      quote_ = 0;  // a string that its line does not end is the parser's to report
      if (c == '\n') outside(c);
    }
  }

  void outside(char c) {
    follow(c);
    // "a.b.c" nests as deep as brackets do.
    if (c == '.')
      ++dots_;
    else if (c == '=' || c == ',' || c == '\n' || c == '[' || c == '{')
      dots_ = 0;
    if (open_.size() > deepest_nesting || dots_ > deepest_nesting) problem(nested_too_deep(), {});
  }

  /// Keeps track of whether a key or a value is due, and so whether a string may begin. It needs to be right
  /// for good TOML only: at what is wrong before, the parser stops.
  void follow(char c) {
    if (c == ' ' || c == '\t' || c == '\r') return;
    may_begin_string_ =
        c == '\n' || c == '=' || c == ',' || c == '[' || c == '{' || (c == '.' && key_is_due_);
    if (c == '[' || c == '{') {
      open_ += c;
      if (c == '{') key_is_due_ = true;
    } else if ((c == ']' || c == '}') && !open_.empty()) {
      open_.pop_back();
    } else if (c == '=') {
      key_is_due_ = false;
    } else if (c == ',') {
      key_is_due_ = !open_.empty() && open_.back() == '{';
    } else if (c == '\n' && open_.empty()) {
      key_is_due_ = true;
    }
  }

  std::string_view text_;
  Syntax syntax_;
  std::size_t at_ = 0;
  Position position_{1, 1};
  char quote_ = 0;  // the quote that ends the string we are in
  bool long_string_ = false;
  bool may_begin_string_ = true;
  bool key_is_due_ = true;
  bool comment_ = false;
  std::string open_;  // brackets
  int dots_ = 0;
  Diagnostics problems_;
};

}  // namespace

std::string nested_too_deep() {
  return fmt::format("tables and arrays are nested more than {} deep", deepest_nesting);
}

Diagnostics check_characters(std::string_view text, Syntax syntax) { return Scanner(text, syntax).run(); }

void clear_positions(Value& value) {
  value.position = {};
  if (value.is_array()) {
    for (Value& element : value.as_array()) clear_positions(element);
  } else if (value.is_object()) {
    for (Value::Member& member : value.as_object()) {
      member.key_position = {};
      clear_positions(member.value);
    }
  }
}

}  // namespace linkwright::study
