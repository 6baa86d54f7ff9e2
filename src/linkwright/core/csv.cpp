// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/csv.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"

namespace linkwright {
namespace {

constexpr std::size_t max_columns = 1000, max_problems = 20;

void append_utf8(std::string& out, std::uint32_t code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0 | code >> 6);
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    out += static_cast<char>(0xE0 | code >> 12);
    out += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    out += static_cast<char>(0xF0 | code >> 18);
    out += static_cast<char>(0x80 | (code >> 12 & 0x3F));
    out += static_cast<char>(0x80 | (code >> 6 & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  }
}

std::optional<std::string> from_utf16(std::string_view bytes, bool big_endian) {
  if (bytes.size() % 2 != 0) return std::nullopt;
  const auto unit = [&](std::size_t i) {
    const auto a = static_cast<unsigned char>(bytes[i]), b = static_cast<unsigned char>(bytes[i + 1]);
    return static_cast<std::uint32_t>(big_endian ? a << 8 | b : b << 8 | a);
  };
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code >= 0xD800 && code < 0xE000) {  // a pair of surrogates
      if (code >= 0xDC00 || i + 3 >= bytes.size()) return std::nullopt;
      const std::uint32_t low = unit(i + 2);
      if (low < 0xDC00 || low >= 0xE000) return std::nullopt;
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
      i += 2;
    }
    append_utf8(out, code);
  }
  return out;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
    };
    const unsigned first = byte(0);
    std::size_t length = 1;
    if (first >= 0x80) {
      length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
      if (first < 0xC2 || first > 0xF4) return false;
      for (std::size_t k = 1; k < length; ++k)
        if ((byte(k) & 0xC0) != 0x80) return false;
      if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) >= 0xA0) ||
          (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) >= 0x90))
        return false;
    }
    i += length;
  }
  return true;
}

std::string from_windows_1252(std::string_view bytes) {
  // The letters that Windows has where Latin-1 has control characters; those it leaves free stay.
  constexpr std::array<std::uint16_t, 32> upper{
      0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
      0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
      0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};
  std::string out;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    append_utf8(out, byte >= 0x80 && byte < 0xA0 ? upper[byte - 0x80] : byte);
  }
  return out;
}

/// True if these are characters of ASCII with a zero byte before or behind each.
bool is_plain_utf16(std::string_view bytes, bool big_endian) {
  if (bytes.size() < 4 || bytes.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 16); i += 2)
    if (bytes[i + (big_endian ? 0 : 1)] != 0 || bytes[i + (big_endian ? 1 : 0)] == 0) return false;
  return true;
}

struct Cell {
  std::string text;
  Position position;
  bool quoted = false;
};

// Splits text into rows of cells; quotes may hold separators and line ends.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  bool done() const { return at_ >= text_.size(); }
  /// The rest of the line that begins here.
  std::string_view line() const {
    const std::string_view rest = text_.substr(at_);
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    return rest.substr(0, end > 0 && rest[end - 1] == '\r' ? end - 1 : end);
  }
  void skip_line() {
    at_ = std::min(text_.find('\n', at_), text_.size());
    if (!done()) ++at_;
    ++line_;
    line_start_ = at_;
  }
  int line_number() const { return line_; }

  /// False when a quote is not closed.
  bool row(char separator, std::vector<Cell>& cells) {
    cells.clear();
    bool closed = true;
    const auto ends = [&](char c) { return c == separator || c == '\n' || c == '\r'; };
    while (true) {
      Cell cell{{}, {line_, static_cast<int>(at_ - line_start_) + 1}, !done() && text_[at_] == '"'};
      if (cell.quoted) closed = quoted(cell.text) && closed;
      while (!done() && !ends(text_[at_])) cell.text += text_[at_++];
      cells.push_back(std::move(cell));
      if (done() || text_[at_] != separator) break;
      ++at_;
    }
    if (!done() && text_[at_] == '\r') ++at_;
    if (!done() && text_[at_] == '\n') ++at_;
    ++line_;
    line_start_ = at_;
    return closed;
  }

 private:
  bool quoted(std::string& out) {
    for (++at_; !done(); ++at_) {
      if (text_[at_] == '\n') ++line_, line_start_ = at_ + 1;
      if (text_[at_] != '"') {
        out += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        out += text_[++at_];
      } else {
        ++at_;
        return true;
      }
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

std::string_view trimmed(std::string_view s) {
  // The last of them marks the beginning of a file, and is inside one that was joined from several.
  constexpr std::string_view spaces[] = {" ", "\t", "\xC2\xA0", "\xEF\xBB\xBF"};
  for (bool again = true; again;) {
    again = false;
    for (const std::string_view space : spaces) {
      if (s.starts_with(space))
        s.remove_prefix(space.size()), again = true;
      else if (s.ends_with(space))
        s.remove_suffix(space.size()), again = true;
    }
  }
  return s;
}

std::string shown(std::string_view text) {
  std::string out(text.substr(0, 40));
  while (!out.empty() && !is_utf8(out)) out.pop_back();
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  return out;
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t i = 0; (i = text.find(from, i)) != std::string::npos; i += to.size())
    text.replace(i, from.size(), to);
  return text;
}

/// "X [mm]" and "x (mm)" as the key x_mm, what is no such heading as it is.
std::string key_of(std::string_view heading) {
  const std::string_view text = trimmed(heading);
  if (text.empty() || (text.back() != ']' && text.back() != ')')) return std::string(text);
  const std::size_t open = text.rfind(text.back() == ']' ? '[' : '(');
  if (open == std::string_view::npos || open == 0) return std::string(text);
  std::string unit(trimmed(text.substr(open + 1, text.size() - open - 2)));
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> spellings{
      {{"\xC2\xB0", "deg"},  // degree sign
       {"\xC2\xB5", "u"},    // micro sign
       {"\xCE\xBC", "u"},    // Greek mu
       {"\xC2\xB2", "2"},    // superscript two
       {"\xC2\xB7", "_"},    // middle dot
       {"^", ""},
       {"/", "_per_"},
       {" ", "_"},
       {"*", "_"}}};
  for (const auto& [from, to] : spellings) unit = replaced(std::move(unit), from, to);
  const std::string whole = "x_" + unit;
  const auto parts = split_unit(whole);
  if (!parts || parts->base != "x") return std::string(text);
  std::string base;
  for (const char c : trimmed(text.substr(0, open))) {
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))
      base += c;
    else if (c >= 'A' && c <= 'Z')
      base += static_cast<char>(c - 'A' + 'a');
    else if (!base.empty() && base.back() != '_')
      base += '_';
  }
  while (!base.empty() && base.back() == '_') base.pop_back();
  return base.empty() ? std::string(text) : base + "_" + unit;
}

bool is_number(std::string_view text) {
  const std::string point = replaced(std::string(trimmed(text)), ",", ".");
  double number;
  const char* end = point.data() + point.size();
  return !point.empty() && std::from_chars(point.data(), end, number).ptr == end;
}

/// True if a line is a remark; the error values of spreadsheets begin with the same character.
bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  if (!text.starts_with('#')) return false;
  for (const std::string_view error : {"#DIV/0!", "#N/A", "#REF!", "#VALUE!", "#NAME?", "#NUM!", "#NULL!"})
    if (text.starts_with(error)) return false;
  return true;
}

/// The character that separates the columns of a header line.
char separator_of(std::string_view line) {
  std::array<int, 3> count{};
  constexpr std::string_view candidates = ";\t,";
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (const std::size_t k = candidates.find(c); !quoted && k != std::string_view::npos) ++count[k];
  }
  // A table of our own has commas, whatever its keys hold.
  if (line.ends_with(",status")) return ',';
  return count[0] > 0 ? ';' : count[1] > 0 ? '\t' : ',';
}

/// One cell as a number; a message if it is none.
struct Number {
  double value = nan;
  std::string message = {}, hint = {};
};

class NumberReader {
 public:
  explicit NumberReader(char separator) : separator_(separator) {}

  Number read(const Cell& source) {
    std::string cell = replaced(std::string(trimmed(source.text)), "\xE2\x88\x92", "-");  // minus sign
    if (cell.empty()) return {};
    if (cell.starts_with('+')) cell.erase(0, 1);
    const bool comma = cell.find(',') != std::string::npos, point = cell.find('.') != std::string::npos;
    if (comma && point)
      return {.message = fmt::format("'{}' is not a number", shown(source.text)),
              .hint = "write thousands without a separator, like 1000.5"};
    if (comma && (separator_ != ',' || source.quoted)) cell = replaced(std::move(cell), ",", ".");
    Number out;
    const char* end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, out.value);
    if (error != std::errc() || stop != end) {
      out.message = fmt::format("'{}' is not a number", shown(source.text));
      out.hint = fmt::format("write numbers like 0.25 or 1e-3, columns separated by {}",
                             separator_ == ';'    ? "semicolons"
                             : separator_ == '\t' ? "tabs"
                                                  : "commas");
      out.value = nan;
      return out;
    }
    if (!std::isfinite(out.value)) {
      out.message = fmt::format("'{}' is not finite", shown(source.text));
      return out;
    }
    if ((comma && decimal_ == '.') || (point && decimal_ == ','))
      out.message = fmt::format("'{}' has a decimal {}, numbers before it have a decimal {}",
                                shown(source.text), comma ? "comma" : "point", comma ? "point" : "comma");
    if (comma) decimal_ = ',';
    if (point) decimal_ = '.';
    return out;
  }

 private:
  char separator_, decimal_ = 0;
};

}  // namespace

bool is_workbook(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04") || bytes.starts_with("\xD0\xCF\x11\xE0");
}

std::optional<std::string> to_utf8(std::string_view bytes, std::string& problem) {
  if (is_workbook(bytes)) {
    problem = "this is an Excel workbook or another packed file; save it as CSV or plain text";
    return std::nullopt;
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const bool little = bytes.starts_with("\xFF\xFE"), big = bytes.starts_with("\xFE\xFF");
  std::optional<std::string> text;
  if (little || big || is_plain_utf16(bytes, false) || is_plain_utf16(bytes, true)) {
    text =
        from_utf16(little || big ? bytes.substr(2) : bytes, big || (!little && is_plain_utf16(bytes, true)));
    if (!text) problem = "this is UTF-16 text that breaks off or is damaged; save it as UTF-8";
  } else {
    text = is_utf8(bytes) ? std::string(bytes) : from_windows_1252(bytes);
  }
  // A file that was marked twice is of no other text.
  while (text && text->starts_with("\xEF\xBB\xBF")) text->erase(0, 3);
  if (text && text->find('\0') != std::string::npos) {
    problem = "this is not a text file: it holds zero bytes";
    return std::nullopt;
  }
  return text;
}

std::optional<Table> read_csv(std::string_view bytes, const std::string& file, Diagnostics& diagnostics,
                              std::vector<int>* lines) {
  const std::size_t before = diagnostics.size();
  const auto problem = [&](Position position, std::string key, std::string message, std::string hint = {}) {
    if (diagnostics.size() - before < max_problems)
      diagnostics.push_back(
          {Diagnostic::Severity::error, file, position, std::move(key), std::move(message), std::move(hint)});
  };
  if (lines) lines->clear();
  std::string no_text;
  const std::optional<std::string> text = to_utf8(bytes, no_text);
  if (!text) {
    problem({1, 1}, {}, no_text);
    return std::nullopt;
  }
  Scanner scanner(*text);
  std::optional<char> separator;
  while (!scanner.done()) {
    const std::string_view line = trimmed(scanner.line());
    if (line.size() == 5 && line.starts_with("sep="))
      separator = line.back();
    else if (!line.empty() && !is_comment(line))
      break;
    scanner.skip_line();
  }
  if (scanner.done()) {
    problem({1, 1}, {}, "the file is empty",
            "give a header line with the column keys, for example x_mm,y_mm");
    return std::nullopt;
  }
  if (!separator) separator = separator_of(scanner.line());
  std::vector<Cell> cells;
  if (!scanner.row(*separator, cells)) problem(cells.back().position, {}, "a quote is not closed");
  while (cells.size() > 1 && trimmed(cells.back().text).empty()) cells.pop_back();
  if (cells.size() > max_columns) {
    problem({1, 1}, {}, fmt::format("{} columns, at most {} are allowed", cells.size(), max_columns));
    return std::nullopt;
  }
  if (std::all_of(cells.begin(), cells.end(), [](const Cell& c) { return is_number(c.text); })) {
    problem(cells[0].position, {},
            fmt::format("the first line holds numbers ('{}'): the header line is missing",
                        shown(trimmed(cells[0].text))),
            "write the column keys with their units above them, for example x_mm,y_mm");
    return std::nullopt;
  }
  Table table;
  const bool has_status = trimmed(cells.back().text) == "status";
  const std::string_view heading = trimmed(cells[0].text);
  const std::size_t first = heading == "name" || heading == "Name" || heading == "NAME" ? 1 : 0;
  for (std::size_t c = first; c + (has_status ? 1 : 0) < cells.size(); ++c) {
    const std::string key = key_of(cells[c].text);
    const bool control = std::any_of(key.begin(), key.end(),
                                     [](char letter) { return static_cast<unsigned char>(letter) < 0x20; });
    if (key.empty() || control || is_number(key))
      problem(cells[c].position, {},
              fmt::format("the header has '{}' where a column key is expected", shown(key)),
              "the first line names the columns, for example x_mm,y_mm");
    else if (table.find(key))
      problem(cells[c].position, shown(key), "duplicate column");
    table.add(key, key);
  }
  if (table.columns.empty())
    problem(cells[0].position, {}, "the header names no column of numbers",
            "the first line names the columns, for example x_mm,y_mm");
  const std::size_t expected = first + table.columns.size() + (has_status ? 1 : 0);
  NumberReader numbers(*separator);
  while (!scanner.done()) {
    if (is_comment(scanner.line())) {
      scanner.skip_line();
      continue;
    }
    const int line = scanner.line_number();
    if (!scanner.row(*separator, cells)) problem(cells.back().position, {}, "a quote is not closed");
    if (std::all_of(cells.begin(), cells.end(),
                    [](const Cell& c) { return !c.quoted && trimmed(c.text).empty(); }))
      continue;
    while (cells.size() > expected && trimmed(cells.back().text).empty()) cells.pop_back();
    if (cells.size() != expected) {
      const bool decimals = *separator == ',' && cells.size() == 2 * expected;
      problem(cells[0].position, {},
              fmt::format("{} values, the header has {} column{}", cells.size(), expected,
                          expected == 1 ? "" : "s"),
              decimals ? "with decimal commas separate the columns by semicolons" : std::string());
      if (decimals) return std::nullopt;  // so has every line
      continue;
    }
    if (lines) lines->push_back(line);
    if (first == 1) table.names.emplace_back(trimmed(cells[0].text));
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      Number number = numbers.read(cells[first + c]);
      if (!number.message.empty())
        problem(cells[first + c].position, shown(table.columns[c].key), std::move(number.message),
                std::move(number.hint));
      table.columns[c].values.push_back(number.value);
    }
    if (has_status) table.status.push_back(cells.back().text);
  }
  if (diagnostics.size() > before) return std::nullopt;
  return table;
}

}  // namespace linkwright
