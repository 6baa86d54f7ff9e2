#include "linkwright/report/json.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string_view>

#include "linkwright/report/markup.h"

namespace linkwright::report {
namespace {

void append_string(std::string& out, std::string_view text) {
  out += '"';
  for (const char c : valid_utf8(text)) {
    if (c == '"' || c == '\\') (out += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20) fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(c));
    else out += c;
  }
  out += '"';
}

void append(std::string& out, const Value& value) {
  if (value.is_bool()) {
    out += value.as_bool() ? "true" : "false";
  } else if (value.is_integer()) {
    fmt::format_to(std::back_inserter(out), "{}", value.as_integer());
  } else if (value.is_number() && std::isfinite(value.as_number())) {
    fmt::format_to(std::back_inserter(out), "{}", value.as_number());
  } else if (value.is_string()) {
    append_string(out, value.as_string());
  } else if (value.is_array()) {
    out += '[';
    for (const Value& item : value.as_array()) {
      if (&item != &value.as_array().front()) out += ',';
      append(out, item);
    }
    out += ']';
  } else if (value.is_object()) {
    out += '{';
    for (const auto& member : value.as_object()) {
      if (&member != &value.as_object().front()) out += ',';
      append_string(out, member.key);
      out += ':';
      append(out, member.value);
    }
    out += '}';
  } else {
    out += "null";
  }
}

}  // namespace

std::string to_json(const Value& value) {
  std::string out;
  append(out, value);
  return out;
}

}  // namespace linkwright::report
