// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/bind_schema.h"

#include <fmt/core.h>

#include <cmath>

namespace linkwright::study {
namespace {

/// A table of which only these members are known yet.
Value with(std::string_view key, Value value) {
  Value object;
  object[key] = std::move(value);
  return object;
}

}  // namespace

Dimension key_dimension(const Field& field) {
  return field.inherits_unit ? Dimension::none : field.dimension;
}

Value SchemaWriter::number(const Field& field, std::string_view type) {
  Value schema = with("type", type);
  if (std::isfinite(field.minimum))
    schema[field.exclusive_minimum ? "exclusiveMinimum" : "minimum"] = field.minimum;
  if (std::isfinite(field.maximum)) schema["maximum"] = field.maximum;
  return schema;
}

Value SchemaWriter::range(const Field& field) {
  Value bounds = with("type", "object");
  bounds["properties"]["min"] = number(field, "number");
  bounds["properties"]["max"] = number(field, "number");
  bounds["required"] = Value(Value::Array{"min", "max"});
  bounds["additionalProperties"] = false;
  return schema_any_of({number(field, "number"), std::move(bounds)});
}

Value SchemaWriter::words(std::span<const Word> words) {
  Value::Array all;
  for (const Word& word : words) {
    Value one = with("const", word.name);
    if (!word.summary.empty()) one["description"] = word.summary;
    all.push_back(std::move(one));
  }
  return with("oneOf", Value(std::move(all)));
}

Value SchemaWriter::array(Value items, std::size_t count) {
  Value schema = with("type", "array");
  schema["items"] = std::move(items);
  if (count > 0) {
    schema["minItems"] = count;
    schema["maxItems"] = count;
  }
  return schema;
}

void SchemaWriter::property(const Field& field, Value schema) {
  const Dimension dimension = key_dimension(field);
  const std::string key = si_key(field.key, dimension);
  if (!field.summary.empty()) schema["description"] = field.summary;
  if (field.dimension != Dimension::none) schema["unit"] = units(field.dimension).front().suffix;
  properties_[key] = std::move(schema);
  if (dimension == Dimension::none) {
    if (field.is_required) required_.push_back(Value(key));
    return;
  }
  // The same key in the other units of its dimension; limits in SI do not apply to them.
  std::string others;
  Value::Array either;
  for (const Unit& unit : units(dimension)) {
    either.push_back(with("required", Value(Value::Array{fmt::format("{}_{}", field.key, unit.suffix)})));
    if (&unit != &units(dimension).front()) others.append(others.empty() ? "" : "|").append(unit.suffix);
  }
  patterns_[fmt::format("^{}_({})$", field.key, others)] =
      with("description", "as " + key + ", in another unit");
  if (field.is_required) one_of_units_.push_back(with("oneOf", Value(std::move(either))));
}

void SchemaWriter::alternative(const Field& field, const Word& word, SchemaWriter options, bool chosen,
                               Value::Array& alternatives) {
  Value schema = std::move(options).finish();
  // Keys of the surrounding table are beside these.
  std::erase_if(schema.as_object(),
                [](const Value::Member& member) { return member.key == "unevaluatedProperties"; });
  schema["properties"][field.key] = with("const", word.name);
  if (!word.summary.empty()) schema["description"] = word.summary;
  // Without the key just one option holds, so that exactly one fits.
  if (!chosen) schema["required"].push_back(Value(field.key));
  alternatives.push_back(std::move(schema));
}

Value SchemaWriter::finish() && {
  Value schema = with("type", "object");
  schema["properties"] = std::move(properties_);
  if (!patterns_.as_object().empty()) schema["patternProperties"] = std::move(patterns_);
  if (!required_.empty()) schema["required"] = Value(std::move(required_));
  Value::Array all = std::move(one_of_units_);
  if (choices_.size() == 1)
    schema["oneOf"] = Value(std::move(choices_.front()));
  else
    for (Value::Array& options : choices_) all.push_back(with("oneOf", Value(std::move(options))));
  if (!all.empty()) schema["allOf"] = Value(std::move(all));
  schema["unevaluatedProperties"] = false;
  return schema;
}

Value schema_array(Value items) {
  Value schema = with("type", "array");
  schema["items"] = std::move(items);
  return schema;
}

Value schema_number() {
  Value schema;
  schema["type"] = "number";
  return schema;
}

Value schema_any_of(Value::Array alternatives) { return with("anyOf", Value(std::move(alternatives))); }

}  // namespace linkwright::study
