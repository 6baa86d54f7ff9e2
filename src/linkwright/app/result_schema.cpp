// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/result_schema.h"

#include <string_view>

#include "linkwright/core/check.h"
#include "linkwright/core/status.h"
#include "linkwright/study/answer.h"
#include "linkwright/study/study.h"

namespace linkwright::app {
namespace {

constexpr std::string_view text = R"json({
"$schema": "https://json-schema.org/draft/2020-12/schema",
"title": "linkwright result",
"description": "What linkwright writes as result.json. Keys carry their units; NaN is written as null. Two runs of one study differ only in `run`.",
"type": "object",
"required": ["schema", "tool", "study", "study_sha256", "status", "answer", "checks", "best", "solutions",
             "comparisons", "statistics", "log", "tables", "diagnostics", "run"],
"additionalProperties": false,
"properties": {
  "schema": {"const": 1, "description": "version of this document"},
  "tool": {"type": "string", "description": "program and version"},
  "study": {"type": "object", "description": "the study with its defaults, in SI units"},
  "study_sha256": {"type": "string", "pattern": "^[0-9a-f]{64}$"},
  "status": {"$ref": "#/$defs/status"},
  "answer": {
    "type": "object",
    "description": "the answer in short",
    "required": ["headline", "verdict", "reasons", "first_trouble", "worst_trouble", "facts"],
    "additionalProperties": false,
    "properties": {
      "headline": {"type": "string", "description": "one sentence"},
      "verdict": {"$ref": "#/$defs/verdict"},
      "reasons": {"type": "array", "items": {"type": "string"}, "description": "why not `passed`"},
      "first_trouble": {"$ref": "#/$defs/trouble", "description": "first in time or along the sweep"},
      "worst_trouble": {"$ref": "#/$defs/trouble", "description": "farthest beyond its limit, or the longest stretch"},
      "facts": {"type": "array", "items": {"$ref": "#/$defs/fact"}}
    }
  },
  "checks": {"type": "array", "items": {
    "type": "object",
    "required": ["quantity", "value", "limit", "passed"],
    "additionalProperties": false,
    "properties": {
      "quantity": {"type": "string"},
      "at": {"type": "string", "description": "row of the table"},
      "value": {"type": ["number", "null"]},
      "limit": {"type": "string"},
      "passed": {"type": "boolean"},
      "message": {"type": "string", "description": "why there is no value"}
    }
  }},
  "best": {"anyOf": [{"$ref": "#/$defs/solution"}, {"type": "null"}]},
  "solutions": {"type": "array", "items": {"$ref": "#/$defs/solution"}, "description": "distinct answers, best first"},
  "changes": {"type": "array", "description": "from the first design to the answer", "items": {
    "type": "object",
    "required": ["quantity", "measure", "before", "after", "change_percent", "objective"],
    "additionalProperties": false,
    "properties": {
      "quantity": {"type": "string"},
      "measure": {"type": "string"},
      "before": {"type": ["number", "null"]},
      "after": {"type": ["number", "null"]},
      "change_percent": {"type": ["number", "null"]},
      "objective": {"type": "boolean", "description": "whether it was to become small"}
    }
  }},
  "comparisons": {"type": "array", "description": "with published numbers", "items": {
    "type": "object",
    "required": ["item", "source", "published", "ours", "verdict", "note"],
    "additionalProperties": false,
    "properties": {
      "item": {"type": "string"},
      "source": {"type": "string"},
      "published": {"type": ["number", "null"]},
      "ours": {"type": ["number", "null"]},
      "verdict": {"type": "string"},
      "note": {"type": "string"}
    }
  }},
  "statistics": {
    "type": "object",
    "description": "over seeds, of the cost that is searched; a study adds figures of its own",
    "properties": {
      "method": {"type": "string"},
      "seeds": {"type": "integer", "description": "that ran"},
      "feasible_seeds": {"type": "integer"},
      "best": {"type": ["number", "null"]},
      "quantile10": {"type": ["number", "null"], "description": "that a tenth of the seeds reached"},
      "median": {"type": ["number", "null"]},
      "quantile90": {"type": ["number", "null"], "description": "that nine tenths of the seeds reached"},
      "worst": {"type": ["number", "null"]},
      "success_threshold": {"type": ["number", "null"], "description": "a seed that reached it counts as a success"},
      "success_rate": {"type": ["number", "null"], "description": "successes by seeds"},
      "evaluations": {"type": "integer", "description": "of all seeds"},
      "median_evaluations": {"type": ["number", "null"]}
    }
  },
  "log": {"type": "array", "description": "one object a seed"},
  "tables": {"type": "array", "items": {
    "type": "object",
    "required": ["name", "columns"],
    "oneOf": [{"required": ["data"]}, {"required": ["file", "rows"]}],
    "additionalProperties": false,
    "properties": {
      "name": {"type": "string"},
      "names": {"type": "array", "items": {"type": "string"}, "description": "of the rows"},
      "columns": {"type": "array", "items": {
        "type": "object",
        "required": ["key", "unit", "label"],
        "additionalProperties": false,
        "properties": {"key": {"type": "string"}, "unit": {"type": "string"}, "label": {"type": "string"}}
      }},
      "data": {"type": "array", "description": "an array for each column; the last one holds the status of each row",
               "items": {"type": "array", "items": {"type": ["number", "string", "null"]}}},
      "file": {"type": "string", "description": "of more than a million rows: NumPy's file beside this one that holds them"},
      "rows": {"type": "integer", "description": "number of rows in that file"}
    }
  }},
  "diagnostics": {"type": "array", "items": {
    "type": "object",
    "required": ["severity", "message"],
    "additionalProperties": false,
    "properties": {
      "severity": {"enum": ["error", "warning"]},
      "file": {"type": "string"},
      "line": {"type": "integer"},
      "column": {"type": "integer"},
      "key": {"type": "string"},
      "message": {"type": "string"},
      "hint": {"type": "string", "description": "how to fix it"}
    }
  }},
  "run": {
    "type": "object",
    "description": "what differs between two runs",
    "required": ["started", "seconds", "host", "threads"],
    "additionalProperties": false,
    "properties": {
      "started": {"type": "string", "description": "UTC"},
      "seconds": {"type": "number"},
      "host": {"type": "string"},
      "threads": {"type": "integer", "description": "0 = all"}
    }
  }
},
"$defs": {
  "status": {},
  "verdict": {},
  "fact": {
    "type": "object",
    "required": ["key", "label", "text", "verdict"],
    "additionalProperties": false,
    "properties": {
      "key": {"type": "string", "description": "the label as an identifier"},
      "label": {"type": "string"},
      "text": {"type": "string"},
      "value": {"type": ["number", "null"], "description": "unrounded, in its unit: the first number of the text that says no place, or the one that the text says in words; null where it is not finite"},
      "unit": {"type": "string", "description": "of the value; empty of a plain number"},
      "at": {"type": "object", "additionalProperties": {"type": ["number", "null"]}, "description": "where: keys with units"},
      "verdict": {"enum": ["plain", "good", "bad"]}
    }
  },
  "trouble": {"anyOf": [{"type": "null"}, {
    "type": "object",
    "required": ["what", "where", "why"],
    "additionalProperties": false,
    "properties": {
      "what": {"type": "string"},
      "where": {"type": "object", "description": "inputs, time and place, as far as they are known",
                "additionalProperties": {"type": ["number", "null"]}},
      "share_of_limit": {"type": "number", "description": "1.2 = 20 % more than allowed"},
      "why": {"type": "string"}
    }
  }]},
  "solution": {
    "type": "object",
    "required": ["label", "parameters", "objectives", "classification", "defects"],
    "additionalProperties": false,
    "properties": {
      "label": {"type": "string"},
      "parameters": {"type": "object", "additionalProperties": {"type": ["number", "null"]}},
      "objectives": {"type": "object"},
      "classification": {"type": "object"},
      "defects": {"type": "array", "items": {"type": "string"}},
      "study": {"type": "object", "description": "a study of this design, in the units of the study that found it"}
    }
  }
}
})json";

template <class List>
void put_names(Value& definition, const List& list) {
  definition["enum"] = Value::array();
  for (const auto& entry : list) definition["enum"].push_back(Value(entry.name));
}

}  // namespace

Value result_schema() {
  Diagnostics problems;
  Value schema = study::read_text(text, study::Syntax::json, "result schema", problems);
  LINKWRIGHT_REQUIRE(problems.empty(), "{}", to_string(problems.front()));
  put_names(schema["$defs"]["status"], names(Status{}));
  put_names(schema["$defs"]["verdict"], names(study::Verdict{}));
  return schema;
}

}  // namespace linkwright::app
