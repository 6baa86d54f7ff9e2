// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/result_json.h"

#include <gtest/gtest.h>

#include "linkwright/app/run.h"
#include "linkwright/app/sha256.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"
#include "tests/study/sample_kind.h"

namespace linkwright::app {
namespace {

study::Study example(std::span<const study::Kind> kinds) {
  Diagnostics diagnostics;
  const Value document = study::read_text(study::sample::example, study::Syntax::toml, "s", diagnostics);
  return study::prepare(document, "s", ".", kinds, diagnostics).value();
}

TEST(ResultJson, HoldsWhatItsReadersCountOn) {
  const auto kinds = study::sample::kinds();
  const study::Study study = example(kinds);
  RunContext context;
  const RunOutcome outcome = run_and_record(study, context);
  const Value v = result_json(study, presented(study, outcome.result), outcome.record);
  std::string keys;
  for (const Value::Member& member : v.as_object()) keys += member.key + " ";
  EXPECT_EQ(keys,
            "schema tool study study_sha256 status answer checks best solutions comparisons statistics log "
            "tables diagnostics run ");
  EXPECT_EQ(v.find("tool")->as_string(), "linkwright 0.1.0");
  EXPECT_EQ(v.find("study_sha256")->as_string(), sha256(study::to_json(study.canonical)));
  EXPECT_EQ(
      study::to_json(*v.find("checks")),
      R"([{"quantity":"best.height_mm","value":400.0,"limit":"equals 400 within 1e-09","passed":true}])");
  EXPECT_EQ(
      study::to_json(*v.find("best")),
      R"({"label":"lever","parameters":{"length_m":0.4},"objectives":{"height_m":0.4},"classification":{"type":"lever"},"defects":[]})");
  EXPECT_EQ(
      study::to_json(*v.find("tables")),
      R"json([{"name":"sweep","columns":[{"key":"angle_rad","unit":"rad","label":"angle (rad)"},)json"
      R"json({"key":"height_m","unit":"m","label":"height (m)"},{"key":"status","unit":"","label":"status"}],)json"
      R"json("data":[[0.0,0.7853981633974483,1.5707963267948966],[0.0,null,0.4],["done","no_assembly","done"]]}])json");
}

TEST(ResultJson, CarriesTheAnswer) {
  const auto kinds = study::sample::kinds();
  const study::Study study = example(kinds);
  RunContext context;
  const RunOutcome outcome = run_and_record(study, context);
  EXPECT_EQ(
      study::to_json(*result_json(study, presented(study, outcome.result), outcome.record).find("answer")),
      R"({"headline":"The lever turns","verdict":"passed","reasons":[],)"
      R"("first_trouble":{"what":"no_assembly","where":{"angle_rad":0.7853981633974483},"why":"1 of 3 rows of 'sweep' are no_assembly"},)"
      R"("worst_trouble":{"what":"no_assembly","where":{"angle_rad":0.7853981633974483},"why":"1 of 3 rows of 'sweep' are no_assembly"},)"
      R"("facts":[{"key":"length","label":"length","text":"0.4 m","value":0.4,"unit":"m","verdict":"good"}]})");
}

TEST(ResultJson, InTheUnitsAndDigitsThatTheStudyAsksFor) {
  const auto kinds = study::sample::kinds();
  study::Study study = example(kinds);
  study.common.output.units = {study::OutputUnits::Choice::list, {"mm", "deg"}};
  study.common.output.digits = study::Digits::six;
  RunContext context;
  const RunOutcome outcome = run_and_record(study, context);
  const Value v = result_json(study, presented(study, outcome.result), outcome.record);
  EXPECT_EQ(study::to_json(*v.find("best")->find("parameters")), R"({"length_mm":400.0})");
  EXPECT_EQ(study::to_json(*v.find("best")->find("objectives")), R"({"height_mm":400.0})");
  EXPECT_EQ(study::to_json(*v.find("tables")->as_array()[0].find("data")),
            R"([[0.0,45.0,90.0],[0.0,null,400.0],["done","no_assembly","done"]])");
  EXPECT_EQ(v.find("tables")->as_array()[0].find("columns")->as_array()[0].find("unit")->as_string(), "deg");
  EXPECT_EQ(v.find("answer")->find("first_trouble")->find("where")->find("angle_deg")->as_number(), 45.0);
}

TEST(ResultJson, TwoRunsDifferOnlyInRun) {
  const auto kinds = study::sample::kinds();
  const study::Study study = example(kinds);
  RunContext one, other;
  other.set_threads(2);
  const RunOutcome a = run_and_record(study, one), b = run_and_record(study, other);
  Value first = result_json(study, presented(study, a.result), a.record),
        second = result_json(study, presented(study, b.result), b.record);
  EXPECT_FALSE(first == second);
  first["run"] = second["run"] = nullptr;
  EXPECT_EQ(study::to_json(first), study::to_json(second));
}

TEST(ResultJson, NoSolution) {
  const auto kinds = study::sample::kinds();
  study::Result result;
  result.status = Status::no_assembly;
  const Value v = result_json(example(kinds), presented(example(kinds), result), {});
  EXPECT_TRUE(v.find("best")->is_null());
  EXPECT_EQ(v.find("status")->as_string(), "no_assembly");
  EXPECT_EQ(study::to_json(*v.find("solutions")), "[]");
}

}  // namespace
}  // namespace linkwright::app
