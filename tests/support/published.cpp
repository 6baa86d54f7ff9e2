// SPDX-License-Identifier: BSD-3-Clause
#include "support/published.h"

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace linkwright::test {
namespace {

Value convert(const nlohmann::ordered_json& json) {
  switch (json.type()) {
    case nlohmann::json::value_t::boolean:
      return json.get<bool>();
    case nlohmann::json::value_t::number_integer:
    case nlohmann::json::value_t::number_unsigned:
      return json.get<std::int64_t>();
    case nlohmann::json::value_t::number_float:
      return json.get<double>();
    case nlohmann::json::value_t::string:
      return json.get<std::string>();
    case nlohmann::json::value_t::array: {
      Value out = Value::array();
      for (const auto& item : json) out.push_back(convert(item));
      return out;
    }
    case nlohmann::json::value_t::object: {
      Value out = Value::object();
      for (const auto& [key, item] : json.items()) out[key] = convert(item);
      return out;
    }
    default:
      return nullptr;
  }
}

const Value& load(const std::string& file) {
  static std::map<std::string, Value> loaded;
  auto found = loaded.find(file);
  if (found == loaded.end()) {
    std::ifstream stream(std::string(LINKWRIGHT_SOURCE_DIR) + "/tests/published/" + file);
    if (!stream) throw std::runtime_error("cannot open tests/published/" + file);
    found = loaded.emplace(file, convert(nlohmann::ordered_json::parse(stream))).first;
  }
  return found->second;
}

}  // namespace

const Value& published_cases(const std::string& file) { return at(load(file), "cases"); }

const Value& published_case(const std::string& file, std::string_view id) {
  for (const Value& entry : published_cases(file).as_array())
    if (at(entry, "id").as_string() == id) return entry;
  throw std::runtime_error("no case " + std::string(id) + " in " + file);
}

std::vector<double> numbers(const Value& array) {
  std::vector<double> out;
  for (const Value& item : array.as_array()) out.push_back(item.as_number());
  return out;
}

const Value& at(const Value& value, std::string_view path) {
  const Value* here = &value;
  std::string_view rest = path;
  while (!rest.empty()) {
    const std::size_t dot = rest.find('.');
    const std::string_view key = rest.substr(0, dot);
    here = here->find(key);
    if (!here) throw std::runtime_error("no member " + std::string(key) + " of " + std::string(path));
    rest = dot == std::string_view::npos ? std::string_view() : rest.substr(dot + 1);
  }
  return *here;
}

double number_at(const Value& value, std::string_view path) { return at(value, path).as_number(); }

}  // namespace linkwright::test
