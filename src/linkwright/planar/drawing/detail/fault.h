// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace linkwright::planar::drawing {

/// The reason why a text is no drawing of one line; `read_drawing` catches it and makes a diagnostic of it.
struct Fault {
  int line = 0;         ///< of the file, from 1; 0 = no line in particular
  std::string message;  ///< what was found
  std::string hint;     ///< how to mend it
};

/// The beginning of a text that may be long, for messages, without breaking a character of UTF-8.
inline std::string shown(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u) --end;
  return std::string(text.substr(0, end));
}

/// True for the characters that separate words of a drawing.
inline bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// A text without the blanks around it.
inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace linkwright::planar::drawing
