// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/drawing/detail/xml_tags.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "linkwright/planar/drawing/detail/fault.h"

namespace linkwright::planar::drawing {
namespace {

constexpr std::size_t none = std::string_view::npos;

bool is_name_character(char c) { return !is_blank(c) && std::string_view("/<>\"'=").find(c) == none; }

std::string in_utf8(unsigned code) {
  std::string out;
  const auto part = [](unsigned bits) { return static_cast<char>(bits); };
  if (code < 0x80) {
    out += part(code);
  } else if (code < 0x800) {
    out += part(0xC0u | code >> 6), out += part(0x80u | (code & 0x3Fu));
  } else if (code < 0x10000) {
    out += part(0xE0u | code >> 12), out += part(0x80u | (code >> 6 & 0x3Fu));
    out += part(0x80u | (code & 0x3Fu));
  } else {
    out += part(0xF0u | code >> 18), out += part(0x80u | (code >> 12 & 0x3Fu));
    out += part(0x80u | (code >> 6 & 0x3Fu)), out += part(0x80u | (code & 0x3Fu));
  }
  return out;
}

/// The character of a reference without & and ;. None for another entity.
std::optional<std::string> character_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> words{
      {{"lt", "<"}, {"gt", ">"}, {"amp", "&"}, {"quot", "\""}, {"apos", "'"}}};
  for (const auto& [word, character] : words)
    if (name == word) return std::string(character);
  if (name.size() < 2 || name[0] != '#') return std::nullopt;
  const bool hexadecimal = name[1] == 'x' || name[1] == 'X';
  const std::string_view digits = name.substr(hexadecimal ? 2 : 1);
  unsigned code = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, code, hexadecimal ? 16 : 10);
  const bool is_character = code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  if (digits.empty() || error != std::errc() || stop != end || !is_character) return std::nullopt;
  return in_utf8(code);
}

}  // namespace

std::optional<std::string> XmlTag::value(std::string_view key) const {
  // An attribute that is given twice has its last value.
  const auto found = std::find_if(attributes.rbegin(), attributes.rend(),
                                  [&](const auto& attribute) { return attribute.first == key; });
  if (found == attributes.rend()) return std::nullopt;
  constexpr std::size_t longest_entity = 40;  // characters
  const std::string_view text = found->second;
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t mark = text.find('&', at);
    out += text.substr(at, mark == none ? none : mark - at);
    if (mark == none) break;
    const std::size_t end = text.substr(0, mark + longest_entity).find(';', mark);
    const auto character = end == none ? std::nullopt : character_of(text.substr(mark + 1, end - mark - 1));
    if (!character)
      throw Fault{line,
                  fmt::format("the entity '{}' is not replaced here",
                              shown(text.substr(mark, end == none ? 20 : end - mark + 1), 20)),
                  "save the file as plain SVG, without entities of its own"};
    out += *character;
    at = end + 1;
  }
  return out;
}

int XmlTags::line_at(std::size_t at) {
  line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(counted_),
                                       text_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  counted_ = at;
  return line_;
}

/// The position behind a declaration <!DOCTYPE ...>, with its own declarations in brackets; none where it
/// does not end.
std::size_t XmlTags::after_declaration(std::size_t at) const {
  int depth = 0;
  while ((at = text_.find_first_of("\"'[]<>", at)) != none) {
    const char mark = text_[at];
    if (mark == '<' && text_.substr(at, 4) == "<!--") {
      at = text_.find("-->", at + 4);
      if (at == none) return none;
      at += 3;
      continue;
    }
    ++at;
    if (mark == '[') ++depth;
    if (mark == ']') --depth;
    if (mark == '>' && depth <= 0) return at;
    if (mark != '"' && mark != '\'') continue;
    at = text_.find(mark, at);
    if (at == none) return none;
    ++at;
  }
  return none;
}

/// The position behind a comment, a declaration or an instruction that begins here; `at` itself where a tag
/// begins, none where it does not end.
std::size_t XmlTags::after_aside(std::size_t at) const {
  const auto until = [&](std::string_view closing) {
    const std::size_t end = text_.find(closing, at);
    return end == none ? none : end + closing.size();
  };
  const std::string_view rest = text_.substr(at);
  if (rest.starts_with("<!--")) return until("-->");
  if (rest.starts_with("<![CDATA[")) return until("]]>");
  if (rest.starts_with("<?")) return until("?>");
  if (rest.starts_with("<!")) return after_declaration(at + 2);
  return at;
}

/// Reads the tag that begins here. The position behind it; none where it is damaged.
std::size_t XmlTags::after_tag(std::size_t at, XmlTag& tag) const {
  const auto skip = [&](auto&& passes) {
    const std::size_t from = at;
    while (at < text_.size() && passes(text_[at])) ++at;
    return text_.substr(from, at - from);
  };
  const auto is_at = [&](char c) { return at < text_.size() && text_[at] == c; };
  tag.attributes.clear();
  ++at;
  const bool ends = is_at('/');
  if (ends) ++at;
  tag.name = skip(is_name_character);
  if (tag.name.empty()) return none;
  tag.name.remove_prefix(tag.name.rfind(':') == none ? 0 : tag.name.rfind(':') + 1);
  for (;;) {
    const bool apart = !skip(is_blank).empty();
    if (is_at('>') || is_at('/')) break;
    const std::string_view key = skip(is_name_character);
    skip(is_blank);
    if (!apart || key.empty() || !is_at('=')) return none;
    ++at;
    skip(is_blank);
    if (!is_at('"') && !is_at('\'')) return none;
    const std::size_t close = text_.find(text_[at], at + 1);
    if (close == none) return none;
    tag.attributes.emplace_back(key, text_.substr(at + 1, close - at - 1));
    at = close + 1;
  }
  const bool alone = is_at('/');
  if (alone) ++at;
  if (!is_at('>')) return none;
  tag.kind = ends ? TagKind::end : alone ? TagKind::alone : TagKind::begin;
  return at + 1;
}

bool XmlTags::next(XmlTag& tag) {
  while ((at_ = text_.find('<', at_)) != none) {
    const std::size_t begin = at_;
    std::size_t end = after_aside(begin);
    const bool is_tag = end == begin;
    if (is_tag) end = after_tag(begin, tag);
    if (end == none)
      throw Fault{line_at(begin),
                  fmt::format("'{}' is not closed, or is damaged",
                              trimmed(shown(text_.substr(begin, text_.find('\n', begin) - begin), 20))),
                  "copy or save the file once more: a part of it is missing"};
    at_ = end;
    if (!is_tag) continue;
    tag.line = line_at(begin);
    return true;
  }
  at_ = text_.size();
  return false;
}

}  // namespace linkwright::planar::drawing
