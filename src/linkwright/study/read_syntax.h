// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/value.h"
#include "linkwright/study/study.h"

// The parts of reading that read.cpp puts together; each parser has its translation unit because of its heavy
// header. Diagnostics carry no file name here.
namespace linkwright::study {

/// UTF-8 throughout, ASCII outside strings and comments, no nesting deeper than the limit: checked before the
/// parsers see the text, because their own handling of these ranges from vague messages to stack overflow.
Diagnostics check_characters(std::string_view text, Syntax syntax);

Value parse_toml(std::string_view text, Diagnostics& diagnostics);
/// Says what to write instead, where the line of a syntax error shows a frequent mistake: a decimal comma, a
/// unit behind a number, text without quotes, backslashes, a list that is not closed.
void explain_toml(std::string_view text, Diagnostic& error);
Value parse_json(std::string_view text, Diagnostics& diagnostics);

/// Forgets where a value came from.
void clear_positions(Value& value);

}  // namespace linkwright::study
