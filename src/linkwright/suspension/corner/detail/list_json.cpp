// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/detail/list_json.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace linkwright::suspension::lists {
namespace {

constexpr int max_depth = 64;

bool is_no_point(std::string_view key) {
  constexpr std::array<std::string_view, 7> words{"inertia", "axis",  "direction", "orientation",
                                                  "colour",  "color", "gravity"};
  const std::string plain = plain_name(key);
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return plain.find(word) != plain.npos; });
}

/// Goes through a text once. The first error ends it.
class JsonScanner {
 public:
  JsonScanner(std::string_view text, const Unit* unit, ListCollector& collect)
      : text_(text), unit_(unit), collect_(collect) {}

  void scan() {
    skip();
    value("", "", 0);
    skip();
    if (good_ && at_ < text_.size()) fail("text follows the object", "one object holds the whole file");
  }

 private:
  struct Number {
    double value = 0;
    ListNumber place;
  };

  void fail(std::string message, std::string hint) {
    if (good_) collect_.problem(line_, {}, std::move(message), std::move(hint));
    good_ = false;
  }

  char next() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  /// Passes blanks and comments.
  void skip() {
    while (at_ < text_.size()) {
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with("//")) {
        at_ += std::min(rest.find('\n'), rest.size());
      } else if (rest.starts_with("/*")) {
        const std::size_t end = std::min(rest.find("*/", 2), rest.size() - 2) + 2;
        line_ +=
            static_cast<int>(std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
        at_ += end;
      } else if (std::string_view(" \t\r\n").find(rest[0]) != std::string_view::npos) {
        line_ += rest[0] == '\n';
        ++at_;
      } else {
        return;
      }
    }
  }

  bool take(char c) {
    skip();
    if (next() != c || at_ == text_.size()) return false;
    ++at_;
    return true;
  }

  std::string string() {
    std::string out;
    for (++at_; at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n'; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
      out += text_[at_];
    }
    if (next() != '"' || at_ >= text_.size()) fail("a text has no end", "close it with \"");
    ++at_;
    return out;
  }

  Number number() {
    Number out;
    const char* const begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), out.value);
    if (error != std::errc() || end == begin) {
      const std::size_t stop = std::min(text_.find_first_of(",]}\n", at_), text_.size());
      fail(fmt::format("{} is not a value of JSON", quoted(text_.substr(at_, stop - at_))),
           "points are arrays of three numbers");
      return out;
    }
    out.place = {at_, static_cast<std::size_t>(end - begin), unit_, false};
    at_ += out.place.size;
    return out;
  }

  bool at_number() const { return is_digit(next()) || next() == '-'; }

  /// A value under `key` in the objects `path`. Returns its number, if it is one.
  std::optional<Number> value(const std::string& path, const std::string& key, int depth) {
    skip();
    if (depth > max_depth) fail("objects are nested too deep", "at most 64 deep");
    if (!good_) return std::nullopt;
    if (at_number()) return number();
    if (next() == '{')
      object(path.empty() ? key : path + " " + key, depth);
    else if (next() == '[')
      array(path, key, depth);
    else if (next() == '"')
      string();
    else if (const auto word =
                 std::find_if(words.begin(), words.end(),
                              [&](std::string_view w) { return text_.substr(at_).starts_with(w); });
             word != words.end())
      at_ += word->size();
    else
      number();  // reports what stands there
    return std::nullopt;
  }

  void object(const std::string& path, int depth) {
    ++at_;
    if (take('}')) return;
    do {
      skip();
      if (next() != '"' || at_ >= text_.size()) return fail("a key is missing", "write \"name\": [x, y, z]");
      const std::string key = string();
      if (good_ && !take(':'))
        fail(fmt::format("':' is missing after \"{}\"", key), "write \"name\": [x, y, z]");
      if (good_) value(path, key, depth + 1);
      if (!good_) return;
    } while (take(','));
    if (!take('}')) fail("an object has no end", "close it with }");
  }

  void array(const std::string& path, const std::string& key, int depth) {
    const int line = line_;
    std::vector<Number> numbers;
    std::size_t count = 0;
    ++at_;
    if (take(']')) return;
    ++arrays_;
    do {
      ++count;
      if (const auto n = value(path, key, depth + 1)) numbers.push_back(*n);
      if (!good_) return;
    } while (take(','));
    --arrays_;
    if (!take(']')) return fail("an array has no end", "close it with ]");
    if (arrays_ > 0 || count != 3 || numbers.size() != 3) return;
    if (!path.empty() && is_no_point(key)) return;
    const Vec3 at{unit_->to_si(numbers[0].value), unit_->to_si(numbers[1].value),
                  unit_->to_si(numbers[2].value)};
    collect_.add(line, path.empty() ? key : path + " " + key, at,
                 {numbers[0].place, numbers[1].place, numbers[2].place});
  }

  static constexpr std::array<std::string_view, 3> words{"true", "false", "null"};
  std::string_view text_;
  const Unit* unit_;
  ListCollector& collect_;
  std::size_t at_ = 0;
  int line_ = 1;
  int arrays_ = 0;  ///< arrays around the current value
  bool good_ = true;
};

}  // namespace

bool is_json(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos || text[first] != '{') return false;
  const std::size_t second = text.find_first_not_of(" \t\r\n", first + 1);
  return second != text.npos &&
         (text[second] == '"' || text[second] == '}' || text.substr(second).starts_with("//"));
}

std::optional<std::vector<ListedPoint>> read_json_points(std::string_view text, const std::string& file,
                                                         const Unit* unit, Diagnostics& diagnostics) {
  ListCollector collect(file, diagnostics);
  JsonScanner(text, unit, collect).scan();
  return collect.finish();
}

}  // namespace linkwright::suspension::lists
