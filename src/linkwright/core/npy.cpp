// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/npy.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

constexpr std::size_t piece_size = std::size_t{1} << 20;
constexpr std::string_view plain_status = "done";

/// Bytes of the longest text, in steps of 8 so that numbers stay where processors like them.
std::size_t field_size(const std::vector<std::string>& texts, std::size_t least) {
  for (const std::string& text : texts) least = std::max(least, text.size());
  return std::max<std::size_t>(8, (least + 7) / 8 * 8);
}

std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

void put_text(std::string& out, std::string_view text, std::size_t size) {
  out += text;
  out.append(size - text.size(), '\0');
}

/// A number in bytes, the least first.
void put_size(std::string& out, std::size_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

}  // namespace

NpyPieces::NpyPieces(const Table& table) : table_(table) {
  require_whole(table);
  if (!table.names.empty()) name_size_ = field_size(table.names, 0);
  status_size_ = field_size(table.status, plain_status.size());
}

void NpyPieces::header() {
  std::string fields;
  if (name_size_ > 0) fields += fmt::format("('name', '|S{}'), ", name_size_);
  constexpr char order = std::endian::native == std::endian::little ? '<' : '>';
  for (const Column& column : table_.columns)
    fields += fmt::format("({}, '{}f8'), ", quoted(column.key), order);
  fields += fmt::format("('status', '|S{}')", status_size_);
  std::string text =
      fmt::format("{{'descr': [{}], 'fortran_order': False, 'shape': ({},), }}", fields, table_.rows());
  // Version 1.0, which all readers know, has two bytes for the size and Latin letters; version 3.0 four, and
  // UTF-8.
  const bool plain = text.size() < 65000 && std::all_of(text.begin(), text.end(), [](char c) {
                       return static_cast<unsigned char>(c) < 128;
                     });
  const std::size_t before = plain ? 10 : 12;
  text.append(63 - (before + text.size()) % 64, ' ');  // the rows begin at a multiple of 64
  text += '\n';
  piece_ = "\x93NUMPY";
  piece_ += plain ? '\x01' : '\x03';
  piece_ += '\0';
  put_size(piece_, text.size(), plain ? 2 : 4);
  piece_ += text;
}

std::string_view NpyPieces::next() {
  piece_.clear();
  if (!begun_) {
    begun_ = true;
    header();
    return piece_;
  }
  for (; row_ < table_.rows() && piece_.size() < piece_size; ++row_) {
    if (name_size_ > 0) put_text(piece_, table_.names[row_], name_size_);
    for (const Column& column : table_.columns)
      piece_.append(reinterpret_cast<const char*>(&column.values[row_]), sizeof(double));
    put_text(piece_, table_.status.empty() ? plain_status : std::string_view(table_.status[row_]),
             status_size_);
  }
  return piece_;
}

}  // namespace linkwright
