// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "linkwright/core/check.h"

namespace linkwright::study {
namespace {

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

/// A string in quotes; JSON and TOML basic strings escape alike. Every byte that does not belong to a UTF-8
/// character becomes U+FFFD, so that the text can be read again.
void write_string(std::string& out, std::string_view text) {
  const auto continuation = [&](std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80;
  };
  out += '"';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += text[i];
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (c < 0x20 || c == 0x7F) {
      fmt::format_to(std::back_inserter(out), "\\u{:04X}", c);
    } else if (c < 0x80) {
      out += text[i];
    } else {
      const std::size_t length = c >= 0xF0 ? 4 : c >= 0xE0 ? 3 : 2;
      const unsigned second = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
      bool good = c >= 0xC2 && c <= 0xF4;
      for (std::size_t k = 1; k < length; ++k) good = good && continuation(i + k);
      // Overlong forms, surrogates and what lies beyond U+10FFFF.
      good = good && !(c == 0xE0 && second < 0xA0) && !(c == 0xED && second > 0x9F) &&
             !(c == 0xF0 && second < 0x90) && !(c == 0xF4 && second > 0x8F);
      out += good ? text.substr(i, length) : std::string_view("\xEF\xBF\xBD");
      if (good) i += length - 1;
    }
  }
  out += '"';
}

bool plain(const Value& value) { return !value.is_array() && !value.is_object(); }
bool all_plain(const Value::Array& array) { return std::all_of(array.begin(), array.end(), plain); }

void write_json(std::string& out, const Value& value, bool readable, std::size_t depth) {
  const auto new_line = [&](std::size_t level) {
    if (readable) out.append("\n").append(2 * level, ' ');
  };
  if (value.is_null()) {
    out += "null";
  } else if (value.is_bool()) {
    out += value.as_bool() ? "true" : "false";
  } else if (value.is_integer()) {
    fmt::format_to(std::back_inserter(out), "{}", value.as_integer());
  } else if (value.is_number()) {
    out += std::isfinite(value.as_number()) ? number_text(value.as_number()) : "null";
  } else if (value.is_string()) {
    write_string(out, value.as_string());
  } else if (value.is_array()) {
    const Value::Array& array = value.as_array();
    const bool lines = !all_plain(array);
    out += '[';
    for (std::size_t i = 0; i < array.size(); ++i) {
      if (i > 0) out += readable && !lines ? ", " : ",";
      if (lines) new_line(depth + 1);
      write_json(out, array[i], readable, depth + 1);
    }
    if (lines) new_line(depth);
    out += ']';
  } else {
    const Value::Object& object = value.as_object();
    out += '{';
    for (std::size_t i = 0; i < object.size(); ++i) {
      if (i > 0) out += ',';
      new_line(depth + 1);
      write_string(out, object[i].key);
      out += readable ? ": " : ":";
      write_json(out, object[i].value, readable, depth + 1);
    }
    if (!object.empty()) new_line(depth);
    out += '}';
  }
}

class TomlWriter {
 public:
  void table(const Value::Object& members, const std::string& path) {
    for (const Value::Member& member : members) {
      if (member.value.is_null() || is_section(member.value, path)) continue;
      out += key(member.key) + " = ";
      inline_value(member.value);
      out += '\n';
    }
    for (const Value::Member& member : members) {
      if (!is_section(member.value, path)) continue;
      const std::string name = path.empty() ? key(member.key) : path + "." + key(member.key);
      if (member.value.is_object()) {
        section("[" + name + "]", member.value, name);
      } else {
        for (const Value& element : member.value.as_array()) section("[[" + name + "]]", element, name);
      }
    }
  }

  std::string out;

 private:
  static std::string key(const std::string& name) {
    const bool bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
             c == '-';
    });
    if (bare) return name;
    std::string quoted;
    write_string(quoted, name);
    return quoted;
  }

  /// { min = 0.0, max = 50.0 } reads better in its line than as a section.
  static bool is_inline_table(const Value& value) {
    constexpr std::size_t longest = 4;
    const Value::Object& members = value.as_object();
    return members.size() <= longest &&
           std::all_of(members.begin(), members.end(), [](const Value::Member& member) {
             return plain(member.value) || (member.value.is_array() && all_plain(member.value.as_array()));
           });
  }

  /// True for every table of the document itself that is not empty.
  static bool is_section(const Value& value, const std::string& path) {
    if (value.is_object()) return path.empty() ? !value.as_object().empty() : !is_inline_table(value);
    if (!value.is_array()) return false;
    const Value::Array& array = value.as_array();
    return !array.empty() &&
           std::all_of(array.begin(), array.end(), [](const Value& v) { return v.is_object(); });
  }

  void section(const std::string& header, const Value& value, const std::string& path) {
    if (!out.empty()) out += '\n';
    out += header + '\n';
    table(value.as_object(), path);
  }

  void inline_value(const Value& value) {
    if (value.is_array()) {
      out += '[';
      bool first = true;
      for (const Value& element : value.as_array()) {
        if (element.is_null()) continue;
        if (!std::exchange(first, false)) out += ", ";
        inline_value(element);
      }
      out += ']';
    } else if (value.is_object()) {
      out += '{';
      bool first = true;
      for (const Value::Member& member : value.as_object()) {
        if (member.value.is_null()) continue;
        out += std::exchange(first, false) ? " " : ", ";
        out += key(member.key) + " = ";
        inline_value(member.value);
      }
      out += first ? "}" : " }";
    } else if (value.is_number() && !value.is_integer()) {
      out += number_text(value.as_number());
    } else {
      write_json(out, value, false, 0);
    }
  }
};

}  // namespace

std::string to_json(const Value& value) {
  std::string out;
  write_json(out, value, false, 0);
  return out;
}

std::string to_json_readable(const Value& value) {
  std::string out;
  write_json(out, value, true, 0);
  return out + '\n';
}

std::string to_toml(const Value& value) {
  LINKWRIGHT_REQUIRE(value.is_object(), "a TOML document is a table, got {}", value.type_name());
  TomlWriter writer;
  writer.table(value.as_object(), {});
  return std::move(writer.out);
}

}  // namespace linkwright::study
