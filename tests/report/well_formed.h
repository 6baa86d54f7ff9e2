// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace linkwright::test {}
namespace linkwright::report::test {
using namespace linkwright::test;  // shared by the tests of all modules

/// Empty when tags of an XML text without declarations nest and close properly and no attribute or text holds
/// a bare < or &; else what is wrong first. Enough for what our writers emit, not an XML parser.
inline std::string fault_of_xml(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '&' && text.compare(i, 5, "&amp;") != 0 && text.compare(i, 4, "&lt;") != 0 &&
        text.compare(i, 4, "&gt;") != 0 && text.compare(i, 6, "&quot;") != 0 &&
        text.compare(i, 5, "&#39;") != 0)
      return "bare & at " + text.substr(i, 20);
    if (text[i] != '<') continue;
    std::size_t end = i + 1;
    for (bool quoted = false; end < text.size() && (quoted || text[end] != '>'); ++end) {
      if (text[end] == '"') quoted = !quoted;
      if (text[end] == '<') return "< inside a tag at " + text.substr(i, 40);
    }
    if (end >= text.size()) return "tag without end at " + text.substr(i, 40);
    const std::string tag = text.substr(i + 1, end - i - 1);
    const std::string name = tag.substr(0, tag.find_first_of(" \n/", 1));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != tag.substr(1)) return "closes what is not open: " + tag;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    i = end;
  }
  return open.empty() ? "" : "never closed: " + open.back();
}

/// The number of occurrences of a part in a text.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace linkwright::report::test
