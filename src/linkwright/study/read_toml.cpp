// SPDX-License-Identifier: BSD-3-Clause

// toml++ 3.3 asserts on some malformed input ("[" and a new line, for one) which it otherwise reports as a
// syntax error, so its assertions are off whatever the build type.
#ifndef NDEBUG
#define NDEBUG
#endif
#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "linkwright/study/read_syntax.h"

namespace linkwright::study {
namespace {

Position to_position(const toml::source_position& position) {
  return {static_cast<int>(position.line), static_cast<int>(position.column)};
}

bool earlier(const Position& a, const Position& b) {
  return a.line != b.line ? a.line < b.line : a.column < b.column;
}

class Converter {
 public:
  explicit Converter(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  Value convert(const toml::node& node, int depth) {
    const Position position = to_position(node.source().begin);
    if (depth > deepest_nesting) {
      if (!has_errors(diagnostics_)) problem(position, nested_too_deep());
      return {};
    }
    Value value;
    if (const toml::table* table = node.as_table()) {
      Value::Object members;
      members.reserve(table->size());
      for (const auto& [key, child] : *table)
        members.push_back(
            {std::string(key.str()), convert(child, depth + 1), to_position(key.source().begin)});
      // toml++ sorts keys by name; people get them back in the order in which they wrote them.
      std::stable_sort(members.begin(), members.end(), [](const Value::Member& a, const Value::Member& b) {
        return earlier(a.key_position, b.key_position);
      });
      value = Value(std::move(members));
    } else if (const toml::array* array = node.as_array()) {
      Value::Array elements;
      elements.reserve(array->size());
      for (const toml::node& child : *array) elements.push_back(convert(child, depth + 1));
      value = Value(std::move(elements));
    } else if (const auto* text = node.as_string()) {
      value = Value(text->get());
    } else if (const auto* integer = node.as_integer()) {
      value = Value(integer->get());
    } else if (const auto* number = node.as_floating_point()) {
      value = Value(number->get());
    } else if (const auto* boolean = node.as_boolean()) {
      value = Value(boolean->get());
    } else {
      problem(position, "is a date or time, which no study uses; write it in quotes if it is a text");
    }
    value.position = position;
    return value;
  }

 private:
  void problem(Position position, std::string message) {
    diagnostics_.push_back({Diagnostic::Severity::error, {}, position, {}, std::move(message), {}});
  }
  Diagnostics& diagnostics_;
};

// "Error while parsing key-value pair: encountered end-of-file" -> what a person can act on.
std::string plain_words(std::string_view description) {
  if (const std::size_t at = description.find(": ");
      description.starts_with("Error while parsing") && at != std::string_view::npos) {
    const std::string_view what = description.substr(20, at - 20);
    const std::string_view why = description.substr(at + 2);
    if (why.starts_with("cannot redefine existing"))  // ... integer 'a' ...
      if (const std::size_t name = why.find('\''); name != std::string_view::npos)
        return fmt::format("the key {} is given twice", why.substr(name));
    const std::string_view article =
        std::string_view("aeiou").find(what.front()) != std::string_view::npos ? "an" : "a";
    if (why == "encountered end-of-file")
      return fmt::format("the file ends in the middle of {} {}", article, what);
    std::string reason(why);
    if (const std::size_t end = reason.find("saw '\\n'"); end != std::string::npos)
      reason.replace(end, 8, "saw the end of the line");
    return fmt::format("is not valid TOML: in {} {}, {}", article, what, reason);
  }
  return fmt::format("is not valid TOML: {}", description);
}

}  // namespace

Value parse_toml(std::string_view text, Diagnostics& diagnostics) {
  try {
    return Converter(diagnostics).convert(toml::parse(text), 0);
  } catch (const toml::parse_error& error) {
    Diagnostic problem{Diagnostic::Severity::error,      {}, to_position(error.source().begin), {},
                       plain_words(error.description()), {}};
    explain_toml(text, problem);
    diagnostics.push_back(std::move(problem));
    return {};
  }
}

}  // namespace linkwright::study
