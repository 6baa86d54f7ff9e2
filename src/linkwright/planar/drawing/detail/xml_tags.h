// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The tags of an XML text, one after the other. Entities of a file's own are not expanded, so that no text
// grows while it is read.
namespace linkwright::planar::drawing {

/// Kinds of tags.
enum class TagKind {
  begin,  ///< <a>
  end,    ///< </a>
  alone   ///< <a/>
};

/// A tag; it refers to the text that it was found in.
struct XmlTag {
  TagKind kind = TagKind::begin;
  std::string_view name;                                                  ///< without its prefix
  int line = 1;                                                           ///< in the text, from 1
  std::vector<std::pair<std::string_view, std::string_view>> attributes;  ///< as they are written

  /// The value of an attribute with references to characters replaced; none where it is not given. Throws
  /// Fault for an entity that is no character.
  std::optional<std::string> value(std::string_view key) const;
};

/// Goes through the tags of a text; comments, declarations and instructions are passed over.
class XmlTags {
 public:
  explicit XmlTags(std::string_view text) : text_(text) {}

  /// Takes the next tag; false at the end of the text. Throws Fault for a tag that is damaged or cut off.
  bool next(XmlTag& tag);

 private:
  std::size_t after_aside(std::size_t at) const;
  std::size_t after_declaration(std::size_t at) const;
  std::size_t after_tag(std::size_t at, XmlTag& tag) const;
  int line_at(std::size_t at);

  std::string_view text_;
  std::size_t at_ = 0, counted_ = 0;
  int line_ = 1;
};

}  // namespace linkwright::planar::drawing
