// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/field.h"
#include "linkwright/core/units.h"
#include "linkwright/core/value.h"
#include "linkwright/study/bind_traits.h"
#include "linkwright/study/kind.h"

// From documents to structs. A struct with a field list (core/field.h) is read by `reader.read(options)`;
// single values by `reader(field::length(...), member)`. Members may be double, bool, whole numbers,
// std::string, Range, an enum with `names`, std::array<double, 2 or 3>, a struct with a field list or a form
// of its own (HasOwnForm), std::optional of any of these, and std::vector of any of these but bool and
// optional. A table whose keys are names that the user gives is a std::vector of std::pair<std::string, any
// of these>.
// A choice is a std::variant of structs, each with
//
//     constexpr Word choice_word(const GreyWolfOptions&) { return {"grey_wolf", "pack hunting of Mirjalili et
//     al. 2014"}; }
//
// found by argument-dependent lookup; the word is at the variant's key and the keys of the chosen struct
// beside it in the same table. bind_write.h and bind_schema.h use the same lists.
namespace linkwright::study {

class ObjectReader;

/// Reads one document: collects what is wrong with it and which keys were asked for, so that `finish` can
/// report the unknown ones. Values that cannot be read keep what the member held before.
///
/// One mistake, one message: what could not be read is remembered, unknown keys included, and `finish` drops
/// what may only follow from it. Those are the errors of meaning (ObjectReader::error) of all tables, for
/// they refer to each other; of `output` and `check`, on which nothing builds, those of the same table. Where
/// a key is misspelt, that are also the keys which its table lacks or does not know without it.
class DocumentReader {
 public:
  /// `document` must outlive this; problems are appended to `diagnostics` under the name `file`.
  DocumentReader(const Value& document, std::string file, Diagnostics& diagnostics);
  DocumentReader(const DocumentReader&) = delete;
  DocumentReader& operator=(const DocumentReader&) = delete;

  ObjectReader root();

  /// Sets the answers to keys and words that are not here, but that a related kind has; must outlive this.
  void explain(std::span<const Absent> absent) { absent_ = absent; }

  /// Reports unknown and missing keys and puts all problems into the order of the file. Call once, when
  /// everything has been read. Where a reader gave up because of an error, it has not asked for all keys:
  /// then those that `schema` (JSON Schema of the document) allows are not unknown. It also says to which
  /// table an unknown key belongs.
  void finish(const std::function<Value()>& schema = nullptr);

  void report(Diagnostic::Severity severity, Position position, std::string key, std::string message,
              std::string hint = {});
  /// Adds an error of meaning that another reader found in a part of the document.
  void error(Diagnostic problem);
  /// Errors so far, those of `finish` not included.
  bool has_errors() const;
  const std::string& file() const { return file_; }

 private:
  friend class ObjectReader;
  struct Known {
    std::string base;
    Dimension dimension;
    std::string hint = {};  // hint if the key is missing
  };
  struct Record {  // notes on the reading of one table of the document
    std::string path;
    const Unit* unit = nullptr;
    std::vector<Known> known;
    std::vector<const Value::Member*> used;
    std::vector<Known> missing;
    std::vector<std::string> choices;  // keys whose words decide which others there are
    bool misspelt = false;             // a key on which others may depend
  };
  struct Meaning {
    std::size_t diagnostic;
    const Record* lacking = nullptr;  // reported for a missing key: only follows when one is misspelt
  };
  Record& open(const Value& object, std::string path, const Unit* unit);
  void finish_object(const Value& value, const std::vector<const Value*>& schemas);
  void finish_unknown(const Value& table, Record& record, const std::vector<const Value*>& schemas);
  void finish_missing(const Value& table, Record& record);
  bool has_unknown() const;
  void poison(std::string_view path);
  void drop_follow_ups();
  std::string_view reason_of_absence(std::string_view path, std::string_view word) const;

  const Value& document_;
  std::string file_;
  Diagnostics& diagnostics_;
  std::size_t first_;
  std::map<const Value*, Record> records_;
  std::vector<Meaning> meaning_;         // the diagnostics that may follow from others
  std::vector<std::string> unreadable_;  // top-level tables in which something could not be read
  std::vector<std::string> misspelt_;    // paths of the keys that unknown ones were probably meant to be
  std::span<const Absent> absent_;
  std::size_t unknown_ = 0;
  Value schema_;  // schema of the document, where it is needed to judge the unknown keys
  bool gave_up_ = false;
};

/// One table of a document; cheap to copy, valid as long as its DocumentReader. It is also the visitor that
/// field lists are read with.
class ObjectReader {
 public:
  /// Reads one member. True when the key is there and its value is good; false leaves the member as it is.
  template <class T>
  bool operator()(const Field& field, T& member);

  /// Reads a struct by its field list.
  template <HasFields T>
  void read(T& object) {
    fields(*this, object);
  }

  /// True if the key is there, with any unit.
  bool has(const Field& field);
  bool has(std::string_view key) { return has(field::entry(key)); }
  /// True if the key is there and is a table: for values that may be a plain value or a table.
  bool is_table(const Field& field);

  /// A table inside this one. Nothing when it is absent (an error if `field.is_required`) or no table (an
  /// error).
  std::optional<ObjectReader> table(const Field& field);
  std::optional<ObjectReader> table(std::string_view key) { return table(field::entry(key)); }
  /// Notes that a key which is not there is missing, and what to write.
  void missing(const Field& field, std::string hint);
  /// The tables of `[[key]]`; empty when absent.
  std::vector<ObjectReader> tables(const Field& field);
  std::vector<ObjectReader> tables(std::string_view key) { return tables(field::entry(key)); }
  /// All keys of a table whose keys are free (names that the user gives), each taken as known.
  const Value::Object& members();

  /// A word out of a list: its index in `words`.
  std::optional<std::size_t> word(const Field& field, std::span<const Word> words);

  /// An error of meaning at a key ("crank" finds crank_m or crank_mm): position and path are filled in. An
  /// absent key puts it at the table, an empty one names the table itself.
  void error(std::string_view key, std::string message, std::string hint = {});
  /// An error at a key that names something which is not there: "there is no joint 'crnk'", with the nearest
  /// of those that are, or all of them.
  void no_such(std::string_view key, std::string_view thing, std::string_view name,
               const std::vector<std::string_view>& known);
  /// An error that leaves others in its wake, such as two bodies of one name: those are dropped. At an absent
  /// key it is dropped itself where a misspelt one of the table may be the cause.
  void unreadable(std::string_view key, std::string message, std::string hint = {});
  void warning(std::string_view key, std::string message, std::string hint = {});

  /// "mechanism.parameters", empty for the document itself.
  const std::string& path() const;
  Position position() const { return object_->position; }
  const Value& value() const { return *object_; }
  DocumentReader& document() const { return *document_; }

  // ---- for types with a form of their own ----

  /// A value with the unit of its key and its path.
  struct Found {
    const Value* value;
    const Unit* unit;
    std::string path;
  };
  /// Reads it as what the result is.
  bool convert(const Found& found, const Field& field, double& result) {
    return number(found, field, result);
  }
  bool convert(const Found& found, const Field& field, bool& result);
  bool convert(const Found& found, const Field& field, std::string& result);
  bool convert(const Found& found, const Field& field, Range& result);
  template <class T>
  bool convert(const Found& found, const Field& field, T& result);
  std::optional<ObjectReader> open(const Found& found);
  void problem(const Found& found, std::string message, std::string hint = {});

 private:
  friend class DocumentReader;
  ObjectReader(DocumentReader& document, const Value& object, DocumentReader::Record& record)
      : document_(&document), object_(&object), record_(&record) {}

  /// The member of a field; problems with its unit and its absence are noted.
  std::optional<Found> find(const Field& field);
  const Value::Member* member_of(const Field& field) const;
  void report_at(std::string_view key, std::string message, std::string hint);
  void know(const Field& field);
  const Value::Array* elements(const Found& found, std::string_view expected);

  bool number(const Found& found, const Field& field, double& result, std::string_view expected = "a number");
  bool whole(const Found& found, const Field& field, std::int64_t lowest, std::int64_t highest,
             std::int64_t& result);
  bool numbers(const Found& found, const Field& field, std::span<double> result);
  std::optional<std::size_t> one_of(const Found& found, std::span<const Word> words);

  template <class... Options>
  bool choose(const Field& field, std::variant<Options...>& result);

  DocumentReader* document_;
  const Value* object_;
  DocumentReader::Record* record_;
};

// ---------------------------------------------------------------------------------------------------------------

template <class T>
bool ObjectReader::operator()(const Field& field, T& member) {
  if constexpr (is_variant<T>) {
    return choose(field, member);
  } else {
    const std::optional<Found> found = find(field);
    return found && convert(*found, field, member);
  }
}

template <class T>
bool ObjectReader::convert(const Found& found, const Field& field, T& result) {
  if constexpr (HasOwnForm<T>) {
    return read_value(*this, found, field, result);
  } else if constexpr (is_optional<T>) {
    typename T::value_type value{};
    const bool good = convert(found, field, value);
    if (good) result = std::move(value);
    return good;
  } else if constexpr (std::is_integral_v<T>) {
    std::int64_t value = 0;
    constexpr auto highest = std::numeric_limits<T>::max() > static_cast<std::uint64_t>(INT64_MAX)
                                 ? INT64_MAX
                                 : static_cast<std::int64_t>(std::numeric_limits<T>::max());
    if (!whole(found, field, static_cast<std::int64_t>(std::numeric_limits<T>::min()), highest, value))
      return false;
    result = static_cast<T>(value);
    return true;
  } else if constexpr (HasNames<T>) {
    const auto words = words_of<T>();
    const std::optional<std::size_t> index = one_of(found, words);
    if (index) result = names(T{})[*index].value;
    return index.has_value();
  } else if constexpr (is_number_array<T>) {
    return numbers(found, field, result);
  } else if constexpr (is_named<T>) {
    std::optional<ObjectReader> object = open(found);
    if (!object) return false;
    T all;
    bool good = true;
    for (const Value::Member& member : object->members()) {
      all.emplace_back(member.key, typename T::value_type::second_type{});
      const Found element{&member.value, found.unit, found.path + "." + member.key};
      good = convert(element, field, all.back().second) && good;
    }
    if (good) result = std::move(all);
    return good;
  } else if constexpr (is_vector<T>) {
    using Element = typename T::value_type;
    const Value::Array* array = elements(found, expected_elements<Element>());
    if (!array) return false;
    T all;
    all.reserve(array->size());
    bool good = true;
    for (std::size_t i = 0; i < array->size(); ++i) {
      all.emplace_back();
      const Found element{&(*array)[i], found.unit, found.path + "[" + std::to_string(i) + "]"};
      good = convert(element, field, all.back()) && good;
    }
    if (good) result = std::move(all);
    return good;
  } else {
    static_assert(HasFields<T>, "this type has neither a field list nor names()");
    std::optional<ObjectReader> object = open(found);
    if (object) object->read(result);
    return object.has_value();
  }
}

template <class... Options>
bool ObjectReader::choose(const Field& field, std::variant<Options...>& result) {
  const std::array<Word, sizeof...(Options)> words{choice_word(Options{})...};
  const std::optional<Found> found = find(field);
  record_->choices.emplace_back(field.key);
  if (found) {
    const std::optional<std::size_t> index = one_of(*found, words);
    if (!index) return false;
    if (*index != result.index()) {
      std::size_t i = 0;
      ((i++ == *index ? void(result.template emplace<Options>()) : void()), ...);
    }
  }
  std::visit([this](auto& options) { read(options); }, result);
  return found.has_value();
}

}  // namespace linkwright::study
