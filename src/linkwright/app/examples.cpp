// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/examples.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "linkwright/app/catalogue.h"
#include "linkwright/study/study.h"

namespace linkwright::app {
namespace {

std::string_view folder_of(std::string_view path) { return path.substr(0, path.rfind('/') + 1); }
std::string_view file_of(std::string_view path) { return path.substr(path.rfind('/') + 1); }

/// Machines that everybody knows, in the order of lists.
constexpr std::string_view known_machines[] = {"fourbar-reactions",
                                               "engine-slider-crank",
                                               "whitworth-quick-return",
                                               "scotch-yoke",
                                               "toggle-press",
                                               "pantograph",
                                               "hoeken",
                                               "peaucellier",
                                               "jansen-leg",
                                               "klann-leg",
                                               "excavator-arm",
                                               "scissor-lift",
                                               "sweep",
                                               "packing-line"};

std::size_t place_among_known(std::string_view name) {
  return static_cast<std::size_t>(std::find(std::begin(known_machines), std::end(known_machines), name) -
                                  std::begin(known_machines));
}

/// A text of a document; empty if it has none.
std::string text_at(const Value* value) { return value && value->is_string() ? value->as_string() : ""; }

/// The text after "# words: " at the beginning of a line.
std::string_view words_comment(std::string_view text) {
  constexpr std::string_view mark = "\n# words: ";
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + mark.size());
  return text.substr(0, text.find_first_of("\r\n"));
}

/// The words of a text in small letters; what is neither letter nor digit separates them.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c >= 'A' && c <= 'Z')
      words.back() += static_cast<char>(c - 'A' + 'a');
    else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80)
      words.back() += c;
    else if (c != '\'' && !words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// All words of an example, one after the other.
std::vector<std::string> words_of(const Example& example) {
  return words_of(example.name + " " + example.title + " " + example.group + " " + example.words);
}

/// A word and what it may be the plural of.
std::vector<std::string> singulars(const std::string& word) {
  std::vector<std::string> out{word};
  if (word.size() > 3 && word.ends_with("s") && !word.ends_with("ss")) {
    out.push_back(word.substr(0, word.size() - 1));
    if (word.ends_with("es")) out.push_back(word.substr(0, word.size() - 2));
    if (word.ends_with("ies")) out.push_back(word.substr(0, word.size() - 3) + "y");
  }
  return out;
}

/// True if the word is among them, also in part, in the plural, or as two of them in one.
bool has_word(const std::vector<std::string>& words, const std::string& word) {
  constexpr std::size_t whole = 3;  // letters; a part of so few is found everywhere: cam in camera
  const auto fits = [&](std::string_view one, std::string_view asked) {
    return asked.size() > whole ? one.starts_with(asked)
                                : one == asked || (one.size() == asked.size() + 1 && one.ends_with('s') &&
                                                   one.starts_with(asked));
  };
  for (const std::string& asked : singulars(word))
    for (std::size_t i = 0; i < words.size(); ++i)
      if (fits(words[i], asked) || (i + 1 < words.size() && words[i] + words[i + 1] == asked)) return true;
  return false;
}

Example example_of(const EmbeddedFile& file) {
  Diagnostics diagnostics;
  const Value document =
      study::read_text(file.text, study::Syntax::toml, std::string(file.path), diagnostics);
  const auto type_of = [&](std::string_view table) {
    const Value* found = document.find(table);
    return found ? text_at(found->find("type")) : std::string();
  };
  std::string_view name = file_of(file.path);
  name.remove_suffix(std::string_view(".toml").size());
  const bool known = place_among_known(name) < std::size(known_machines);
  Example example{
      std::string(name),
      text_at(document.find("title")),
      std::string(known ? well_known
                        : group_of(text_at(document.find("kind")), type_of("mechanism"), type_of("target"))),
      std::string(words_comment(file.text)),
      file.text,
      {}};
  // A study names what it reads as a text of its own, and so do the studies that it names.
  std::vector<std::string_view> texts{file.text};
  for (std::size_t i = 0; i < texts.size(); ++i)
    for (const EmbeddedFile& other : example_files()) {
      const std::string_view named = file_of(other.path);
      const bool there = std::any_of(example.beside.begin(), example.beside.end(),
                                     [&](const auto& b) { return b.path == named; });
      if (there || other.path == file.path || folder_of(other.path) != folder_of(file.path) ||
          texts[i].find("\"" + std::string(named) + "\"") == std::string_view::npos)
        continue;
      example.beside.push_back({named, other.text});
      if (named.ends_with(".toml")) texts.push_back(other.text);
    }
  return example;
}

}  // namespace

std::span<const Example> examples() {
  static const auto all = [] {
    std::vector<Example> found;
    for (const EmbeddedFile& file : example_files())
      if (file.path.ends_with(".toml")) found.push_back(example_of(file));
    std::stable_sort(found.begin(), found.end(), [](const Example& a, const Example& b) {
      const auto place = [](const Example& e) {
        return std::pair(place_of_group(e.group), place_among_known(e.name));
      };
      return place(a) < place(b);
    });
    return found;
  }();
  return all;
}

std::vector<const Example*> find_examples(std::string_view text) {
  const std::vector<std::string> asked = words_of(text);
  std::vector<const Example*> found;
  for (const Example& example : examples()) {
    if (example.name == text) return {&example};
    const std::vector<std::string> words = words_of(example);
    if (example.name.starts_with(text) ||
        std::all_of(asked.begin(), asked.end(),
                    [&](const std::string& word) { return has_word(words, word); }))
      found.push_back(&example);
  }
  return found;
}

std::string nearest_example_words(std::string_view text) {
  std::vector<std::vector<std::string>> known;
  for (const Example& example : examples()) known.push_back(words_of(example));
  std::vector<std::string_view> allowed;
  for (const auto& words : known) allowed.insert(allowed.end(), words.begin(), words.end());
  std::string nearest;
  bool replaced = false;
  for (const std::string& word : words_of(text)) {
    const bool there =
        std::any_of(known.begin(), known.end(), [&](const auto& words) { return has_word(words, word); });
    const std::string_view meant = there ? std::string_view(word) : nearest_word(word, allowed);
    if (meant.empty()) return {};
    replaced = replaced || !there;
    nearest += (nearest.empty() ? "" : " ") + std::string(meant);
  }
  return replaced ? nearest : std::string();
}

Copied write_new(const std::string& file, std::string_view text, Diagnostics& diagnostics) {
  const auto refuse = [&](std::string message) {
    diagnostics.push_back({Diagnostic::Severity::error, file, {}, {}, std::move(message), {}});
    return Copied::refused;
  };
  // "x": the file must not exist; asked and made in one step.
  std::FILE* stream = std::fopen(file.c_str(), "wbx");
  if (!stream && errno == EEXIST) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
      return refuse("already exists, is not a plain file and is left unchanged");
    std::ifstream there(file, std::ios::binary);
    const std::string old((std::istreambuf_iterator<char>(there)), {});
    return there && old == text ? Copied::unchanged : refuse("already exists and is left unchanged");
  }
  const auto failed = [&](int error) {
    refuse(std::string("cannot be written: ") + std::strerror(error));
    return Copied::unwritten;
  };
  if (!stream) return failed(errno);
  const bool whole = std::fwrite(text.data(), 1, text.size(), stream) == text.size();
  const int error = whole ? 0 : errno;
  if (std::fclose(stream) == 0 && whole) return Copied::written;
  const int reason = whole ? errno : error;
  std::remove(file.c_str());  // half a study is none
  return failed(reason);
}

}  // namespace linkwright::app
