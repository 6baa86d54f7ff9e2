// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/value.h"

namespace linkwright::app {

/// The name in messages for the text of a page, which is no file.
inline constexpr const char* page_text = "study";

/// A change of the text of a study.
struct Edit {
  /// "mechanism.body[1].points_m.A"; the text may have it in another unit of the same dimension.
  std::string key;
  Value value;  ///< in the unit of `key`
};

/// True if a document has a value at a key, in whatever unit of the same dimension.
bool has_key(const Value& document, std::string_view key);

/// The text with some of its values replaced, and everything else - order, comments, units - as it was. What
/// the text does not name, because it is a default or comes from a sample, is put in: then the whole study is
/// rewritten, with all its numbers where a sample was opened (in the units of the study, lengths and
/// angles without one in mm and deg), and only the comment at its top is kept. Problems are appended to
/// `diagnostics`, and the text comes back as it is.
std::string edited(std::string_view text, std::span<const Edit> edits, Diagnostics& diagnostics);

}  // namespace linkwright::app
