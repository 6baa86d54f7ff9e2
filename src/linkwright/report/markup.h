// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "linkwright/core/sentence.h"
#include "linkwright/core/value.h"

/// Text that is safe inside HTML, SVG and script elements.
namespace linkwright::report {

/// The text with every byte that is not part of a UTF-8 character (RFC 3629) replaced by U+FFFD.
std::string valid_utf8(std::string_view text);

/// Text for element content and for attributes in either quotes: & < > " ' become references, control
/// characters that XML forbids become U+FFFD, as do bytes that are not UTF-8.
std::string escape(std::string_view text);

/// A number for people: `digits` significant digits, "–" for NaN.
std::string number(double value, int digits = 6);

/// A sentence as a page shows it: true minus signs, powers of ten, spaces that do not break between a number
/// and its unit; numbers that come from rounding alone say so.
std::string typeset(const Sentence& sentence);

/// A fact as pages show it: its value, then in smaller letters what is said of it.
struct FactText {
  std::string value;     ///< all of a short fact, and of one without value
  std::string rest;      ///< goes on from there
  bool is_long = false;  ///< too long to stand beside its name
};
FactText fact_text(const Sentence& fact);

/// A scalar for people: text as it is, numbers by number(), "yes"/"no"; arrays and objects joined by commas.
std::string display(const Value& value);

}  // namespace linkwright::report
