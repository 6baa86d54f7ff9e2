// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "linkwright/study/read_syntax.h"

namespace linkwright::study {
namespace {

/// Follows the parser through the text. The parser may have taken one character more than the token it
/// reports, so the start of the last token is noted here when its first character goes by.
struct Tracker {
  Position next{1, 1};
  Position token{1, 1};  ///< start of the last value, key or opening bracket
  Position mark{1, 1};   ///< start of the last token of any sort
  bool in_token = false;
  bool in_string = false;
  bool escaped = false;

  void pass(char c) {
    const bool continuation = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    if (in_string) {
      if (!escaped && c == '"') in_string = in_token = false;
      escaped = !escaped && c == '\\';
    } else if (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == ':' || c == ']' ||
               c == '}') {
      in_token = false;
      if (c > ' ') mark = next;
    } else if (c == '{' || c == '[') {
      mark = token = next;
      in_token = false;
    } else if (!in_token) {
      mark = token = next;
      in_token = true;
      in_string = c == '"';
      escaped = false;
    }
    if (c == '\n')
      next = {next.line + 1, 1};
    else if (!continuation)
      ++next.column;
  }
};

class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, Tracker* tracker) : at_(at), tracker_(tracker) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    tracker_->pass(*at_);
    ++at_;
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const CountingIterator& a, const CountingIterator& b) { return a.at_ == b.at_; }

 private:
  const char* at_;
  Tracker* tracker_;
};

/// Builds the tree from the parser's events.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(const Tracker& tracker, Diagnostics& diagnostics) : tracker_(tracker), diagnostics_(diagnostics) {}

  bool null() override { return add(Value()); }
  bool boolean(bool value) override { return add(Value(value)); }
  bool number_integer(number_integer_t value) override { return add(Value(std::int64_t{value})); }
  bool number_unsigned(number_unsigned_t value) override {
    return add(value <= static_cast<number_unsigned_t>(INT64_MAX) ? Value(static_cast<std::int64_t>(value))
                                                                  : Value(static_cast<double>(value)));
  }
  bool number_float(number_float_t value, const string_t&) override { return add(Value(value)); }
  bool string(string_t& value) override { return add(Value(std::move(value))); }
  bool binary(binary_t&) override { return false; }  // not in JSON text

  bool start_object(std::size_t) override { return open(Value(Value::Object())); }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Value(Value::Array())); }
  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Level& level = open_.back();
    if (!level.keys.insert(name).second)
      problem(tracker_.token, fmt::format("the key '{}' is given twice", name));
    level.key = std::move(name);
    level.key_position = tracker_.token;
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing ..."
    std::string_view what = error.what();
    if (const std::size_t at = what.find("] "); at != std::string_view::npos) what.remove_prefix(at + 2);
    if (const std::size_t at = what.find(": ");
        what.starts_with("parse error") && at != std::string_view::npos)
      what.remove_prefix(at + 2);
    problem(tracker_.mark, fmt::format("is not valid JSON: {}", what));
    return false;
  }

  Value root;

 private:
  struct Level {
    Value value;
    std::string key;
    Position key_position;
    std::unordered_set<std::string> keys;
  };

  void problem(Position position, std::string message) {
    diagnostics_.push_back({Diagnostic::Severity::error, {}, position, {}, std::move(message), {}});
  }

  bool open(Value value) {
    value.position = tracker_.token;
    open_.push_back({std::move(value), {}, {}, {}});
    return true;
  }

  bool close() {
    Value value = std::move(open_.back().value);
    open_.pop_back();
    return place(std::move(value));
  }

  bool add(Value value) {
    value.position = tracker_.token;
    return place(std::move(value));
  }

  bool place(Value value) {
    if (open_.empty()) {
      root = std::move(value);
    } else if (Level& level = open_.back(); level.value.is_array()) {
      level.value.as_array().push_back(std::move(value));
    } else {
      level.value.as_object().push_back({std::move(level.key), std::move(value), level.key_position});
    }
    return true;
  }

  const Tracker& tracker_;
  Diagnostics& diagnostics_;
  std::vector<Level> open_;
};

}  // namespace

Value parse_json(std::string_view text, Diagnostics& diagnostics) {
  Tracker tracker;
  Builder builder(tracker, diagnostics);
  const bool parsed =
      nlohmann::json::sax_parse(CountingIterator(text.data(), &tracker),
                                CountingIterator(text.data() + text.size(), &tracker), &builder);
  if (!parsed) return {};
  if (!builder.root.is_object())
    diagnostics.push_back(
        {Diagnostic::Severity::error,
         {},
         builder.root.position,
         {},
         fmt::format("the document must be an object {{ ... }}, found {}", builder.root.type_name()),
         {}});
  return std::move(builder.root);
}

}  // namespace linkwright::study
