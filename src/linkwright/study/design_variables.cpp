// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/design_variables.h"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "linkwright/core/check.h"

namespace linkwright::study {
namespace {

bool is_designed(const Value& value) {
  return value.is_object() && value.find("min") && value.find("max") && value.as_object().size() <= 3;
}

class Taker {
 public:
  Taker(ObjectReader& document, std::vector<DesignVariable>& numbers)
      : document_(document), numbers_(numbers) {}

  void visit(Value& value, const std::string& key, const UnitKey& unit) {
    if (is_designed(value)) return take(value, key, unit);
    place_.push_back(0);
    if (value.is_object()) {
      for (Value::Member& member : value.as_object()) {
        const auto own = split_unit(member.key);
        // Keys below one with a unit inherit it: points_mm = { A = [0, 0] }.
        visit(member.value, joined(key, member.key), own ? *own : unit);
        ++place_.back();
      }
    } else if (value.is_array()) {
      for (Value& element : value.as_array()) {
        const Value* name = element.find("name");
        visit(element,
              name && name->is_string() ? joined(key, name->as_string())
                                        : joined(key, std::to_string(place_.back() + 1)),
              unit);
        ++place_.back();
      }
    }
    place_.pop_back();
  }

 private:
  static std::string joined(const std::string& path, std::string_view key) {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }

  void take(Value& value, const std::string& key, const UnitKey& unit) {
    DesignVariable number{.key = key, .unit = unit, .place = place_};
    const auto error = [&](std::string message, std::string hint) {
      document_.document().report(Diagnostic::Severity::error, value.position, key, std::move(message),
                                  std::move(hint));
    };
    bool good = true;
    const auto read = [&](std::string_view name, double& result) {
      const Value* found = value.find(name);
      if (found && found->is_number() && std::isfinite(found->as_number())) {
        result = found->as_number();
      } else if (found) {
        good = false;
        error(fmt::format("{} must be a number", name), {});
      } else {
        good = false;
        error(fmt::format("the design variable lacks `{}`", name),
              "write { min = ..., max = ..., initial = ... }: the initial design is what the answer is "
              "compared with");
      }
    };
    read("min", number.lower);
    read("max", number.upper);
    read("initial", number.initial);
    if (good && number.lower > number.upper) {
      good = false;
      error(fmt::format("min is {}, more than max, which is {}", number.lower, number.upper), "swap them");
    }
    const Position position = value.position;
    value = Value(good ? number.initial : 1.0);
    value.position = position;
    // Most are in the mechanism, which goes without saying.
    constexpr std::string_view mechanism = "mechanism.";
    if (number.key.starts_with(mechanism)) number.key.erase(0, mechanism.size());
    if (good) numbers_.push_back(std::move(number));
  }

  ObjectReader& document_;
  std::vector<DesignVariable>& numbers_;
  std::vector<std::size_t> place_;
};

Value& at(Value& value, std::span<const std::size_t> place) {
  Value* here = &value;
  for (std::size_t i : place) here = here->is_object() ? &here->as_object()[i].value : &here->as_array()[i];
  return *here;
}

}  // namespace

DesignedTables take_designed(ObjectReader& document, std::span<const std::string_view> keys) {
  DesignedTables out;
  out.tables = Value::object();
  out.tables.position = document.position();
  for (std::string_view key : keys) {
    document.has(key);  // one that is absent is known as well
    for (const Value::Member& member : document.value().as_object()) {
      if (member.key != key) continue;
      out.tables.as_object().push_back(member);
      // One of the two says that the key is known; nothing more is read here.
      if (member.value.is_array())
        for (ObjectReader& table : document.tables(key)) table.members();
      else if (auto table = document.table(key))
        table->members();
    }
  }
  Taker(document, out.numbers).visit(out.tables, {}, {});
  return out;
}

std::vector<DesignedStep> steps_to(const Value& tables, std::span<const std::size_t> place) {
  std::vector<DesignedStep> out;
  const Value* here = &tables;
  for (std::size_t i : place) {
    if (here->is_object()) {
      out.push_back({here->as_object()[i].key, std::nullopt});
      here = &here->as_object()[i].value;
    } else {
      out.push_back({{}, i});
      here = &here->as_array()[i];
    }
  }
  return out;
}

std::string base_of(std::string_view key) {
  const auto unit = split_unit(key);
  return std::string(unit ? unit->base : key);
}

void put(Value& tables, std::span<const DesignVariable> numbers, std::span<const double> x) {
  LINKWRIGHT_REQUIRE(x.size() == numbers.size(), "{} numbers for {} design variables", x.size(),
                     numbers.size());
  for (std::size_t j = 0; j < x.size(); ++j) {
    Value& value = at(tables, numbers[j].place);
    const Position position = value.position;
    value = Value(x[j]);
    value.position = position;
  }
}

}  // namespace linkwright::study
