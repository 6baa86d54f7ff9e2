#pragma once

#include <cstddef>
#include <string_view>

/// Facts in short: what a reader sees first, and what is folded away.
namespace linkwright::report {

/// A text in two parts, which together are the text.
struct Brief {
  std::string_view head;  ///< the figure with its unit and place; needs no context
  std::string_view rest;  ///< the explanation; empty when the text is short
};

/// Letters that a head has at most.
inline constexpr std::size_t longest_head = 40;

/// The longest beginning of at most `longest_head` letters that needs no context: it ends before punctuation
/// or a bracket, or else before a place or a condition ("at", "in", "of", "for", "and", "+"); failing all, it
/// is a whole number of words. Brackets in it are closed, and the coordinates of a place stay together.
Brief brief(std::string_view text);

}  // namespace linkwright::report
