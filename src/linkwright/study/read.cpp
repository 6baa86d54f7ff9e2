// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "linkwright/core/csv.h"
#include "linkwright/study/read_syntax.h"
#include "linkwright/study/study.h"

namespace linkwright::study {
namespace fs = std::filesystem;
namespace {

void refuse(Diagnostics& diagnostics, const std::string& file, std::string message, std::string hint = {}) {
  diagnostics.push_back({Diagnostic::Severity::error, file, {}, {}, std::move(message), std::move(hint)});
}

bool blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string_view without_byte_order_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

bool is_bare_word(std::string_view text) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && letter(text.front()) &&
         std::all_of(text.begin(), text.end(),
                     [&](char c) {
                       return letter(c) || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '/';
                     }) &&
         text != "true" && text != "false" && text != "nan" && text != "inf";
}

bool is_study_in_toml(std::string_view text) {
  Diagnostics problems = check_characters(text, Syntax::toml);
  return problems.empty() && parse_toml(text, problems).find("schema") && problems.empty();
}

}  // namespace

Syntax syntax_of(const fs::path& file, std::string_view text) {
  if (file.extension() == ".json") return Syntax::json;
  text = without_byte_order_mark(text);
  const auto first = std::find_if_not(text.begin(), text.end(), blank);
  return first != text.end() && *first == '{' ? Syntax::json : Syntax::toml;
}

Value read_text(std::string_view text, Syntax syntax, const std::string& file, Diagnostics& diagnostics) {
  text = without_byte_order_mark(text);
  if (text.size() > largest_document) {
    refuse(diagnostics, file,
           fmt::format("the text has {} bytes; a study may have at most {}", text.size(), largest_document));
    return {};
  }
  if (is_workbook(text)) {
    refuse(diagnostics, file, "this is an Excel workbook or another packed file, a study is a text file",
           "save its tables as CSV and name them in a study");
    return {};
  }
  if (std::all_of(text.begin(), text.end(), blank)) {
    refuse(diagnostics, file, "the file is empty", "write a first study with `linkwright new`");
    return {};
  }
  Diagnostics problems = check_characters(text, syntax);
  Value root;
  if (problems.empty())
    root = syntax == Syntax::toml ? parse_toml(text, problems) : parse_json(text, problems);
  if (syntax == Syntax::json && !problems.empty() && is_study_in_toml(text)) {
    problems.clear();
    refuse(problems, {}, "the text is TOML, but the name of the file says JSON", "let it end in .toml");
  }
  if (problems.empty() && root.is_object() && root.as_object().empty())
    refuse(problems, {}, "the file has no keys, only comments or brackets",
           "write a first study with `linkwright new`");
  if (has_errors(problems)) root = Value();
  for (Diagnostic& problem : problems) {
    problem.file = file;
    diagnostics.push_back(std::move(problem));
  }
  return root;
}

std::string load_file(const fs::path& file, Diagnostics& diagnostics) {
  const std::string name = file.string();
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) {
    const bool absent = !error || error == std::errc::no_such_file_or_directory;
    refuse(diagnostics, name, absent ? "there is no such file" : "cannot be read: " + error.message());
    return {};
  }
  if (fs::is_directory(status)) {
    refuse(diagnostics, name, "is a folder, expected a file");
    return {};
  }
  // A pipe or a device may never come to an end; what the shell gives as a file does.
  const bool from_shell = name == "/dev/stdin" || name == "/dev/null" || name.starts_with("/dev/fd/") ||
                          name.starts_with("/proc/self/fd/");
  if (!fs::is_regular_file(status) && !from_shell) {
    refuse(diagnostics, name, "is not a plain file, but a pipe or a device",
           "write the study to a file, or give - and the study as standard input");
    return {};
  }
  // The size is asked before reading so that a huge file is refused at once; what has no size (a pipe) is
  // read up to the limit.
  if (fs::is_regular_file(status)) {
    const auto size = fs::file_size(file, error);
    if (!error && size > largest_document) {
      refuse(diagnostics, name,
             fmt::format("the file has {} bytes; at most {} ({} MiB) are read", size, largest_document,
                         largest_document >> 20),
             "keep long point lists in a CSV file of their own");
      return {};
    }
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    refuse(diagnostics, name, fmt::format("cannot be read: {}", std::strerror(errno)));
    return {};
  }
  std::string text;
  constexpr std::size_t piece = std::size_t{64} << 10;  // a study; more is read as it comes
  while (stream && text.size() <= largest_document) {
    const std::size_t before = text.size();
    text.resize(std::min(before + std::max(before, piece), largest_document + 1));
    stream.read(text.data() + before, static_cast<std::streamsize>(text.size() - before));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) {
    refuse(diagnostics, name, fmt::format("cannot be read: {}", std::strerror(errno)));
    return {};
  }
  if (text.size() > largest_document) {
    refuse(diagnostics, name,
           fmt::format("has more than {} bytes ({} MiB)", largest_document, largest_document >> 20));
    return {};
  }
  return text;
}

Value read_file(const fs::path& file, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.size();
  const std::string text = load_file(file, diagnostics);
  if (diagnostics.size() != before) return {};
  return read_text(text, syntax_of(file, text), file.string(), diagnostics);
}

Value read_value(std::string_view text, const std::string& origin, Diagnostics& diagnostics) {
  if (is_bare_word(text)) return Value(text);
  Value document;
  Diagnostics problems;
  if (text.find('\n') == std::string_view::npos)
    document = read_text("value = " + std::string(text), Syntax::toml, {}, problems);
  const Value* value = document.find("value");
  if (value && document.as_object().size() == 1) {
    Value plain = *value;
    clear_positions(plain);
    return plain;
  }
  std::string message = fmt::format("'{}' is not a value", text);
  if (!problems.empty()) message += ": " + to_string(problems.front().message);
  refuse(diagnostics, origin, message, "write a number, true, false, a word, [ ... ] or { ... } as in TOML");
  return {};
}

}  // namespace linkwright::study
