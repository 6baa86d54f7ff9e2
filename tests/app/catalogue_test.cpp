// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/catalogue.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

#include "linkwright/study/reproduction.h"
#include "linkwright/study/study.h"
#include "tests/study/sample_kind.h"

namespace linkwright::app {
namespace {
using ::testing::HasSubstr;

TEST(Catalogue, FindsKindsByNameAndUnambiguousBeginning) {
  const auto kinds = study::sample::kinds();
  const auto find = [&](std::string_view name) {
    Diagnostics diagnostics;
    const study::Kind* kind = find_kind(name, kinds, diagnostics);
    EXPECT_EQ(kind == nullptr, has_errors(diagnostics));
    return kind ? study::name_of(*kind) : to_string(diagnostics.at(0));
  };
  EXPECT_EQ(find("synthesis/sample.lever/angle"), "synthesis/sample.lever/angle");
  EXPECT_EQ(find("analysis"), "analysis/sample.wheel");
  EXPECT_EQ(find("synthesis/sample.lever"),
            "error: several kinds of study fit 'synthesis/sample.lever'; write one of:\n"
            "  synthesis/sample.lever/angle\n      Turns a lever.\n"
            "  synthesis/sample.lever/point\n      Turns a lever.");
  EXPECT_EQ(find("wheel"), "analysis/sample.wheel");
  EXPECT_EQ(find("lever/point"), "synthesis/sample.lever/point");
  EXPECT_THAT(
      find("analysis/sample.weel"),
      HasSubstr("there is no kind of study 'analysis/sample.weel'; did you mean 'analysis/sample.wheel'?"));
  EXPECT_EQ(find("x"), "error: there is no kind of study 'x'; `linkwright catalogue` lists them");
  EXPECT_EQ(find(""), "error: there is no kind of study ''; `linkwright catalogue` lists them");
}

TEST(Catalogue, EveryKindHasAGroup) {
  EXPECT_EQ(group_of("analysis", "planar.linkage", ""), "Find motion and forces");
  EXPECT_EQ(group_of("analysis", "planar.serial_arm", ""), "Robots and Pi-joints");
  EXPECT_EQ(group_of("balancing", "planar.four_bar", ""), "Balance a machine");
  EXPECT_EQ(group_of("synthesis", "planar.slider_crank", "path_points"), "Follow a path");
  EXPECT_EQ(group_of("synthesis", "planar.four_bar", "poses"), "Guide a body");
  EXPECT_EQ(group_of("synthesis", "planar.six_bar", "dwell"), "Generate a function");
  EXPECT_EQ(group_of("enumeration", "planar.chain", ""), "Choose a structure");
  EXPECT_EQ(group_of("analysis", "suspension.corner", ""), "Wheel suspensions");
  EXPECT_EQ(group_of("analysis", "sample.wheel", ""), "Other studies");
  EXPECT_EQ(place_of_group(well_known), 0u);
  EXPECT_LT(place_of_group("Find motion and forces"), place_of_group("Follow a path"));
  EXPECT_LT(place_of_group("Balance a machine"), place_of_group("Wheel suspensions"));
  EXPECT_LT(place_of_group("Flexible links"), place_of_group("Other studies"));
  for (const study::Kind& kind : catalogue())
    EXPECT_NE(group_of(kind.kind, kind.mechanism, kind.target), "Other studies") << study::name_of(kind);
}

TEST(Catalogue, ListsHoldEveryWordWhateverItsCase) {
  const std::vector<std::string> words = {"FOUR", "path"};
  EXPECT_TRUE(holds_words(words, {"synthesis/planar.four_bar", "traces a Path"}));
  EXPECT_FALSE(holds_words(words, {"synthesis/planar.four_bar", "balances"}));
  EXPECT_TRUE(holds_words({}, {"anything"}));
}

TEST(Catalogue, EveryExampleReadsAndThoseThatTakeMillisecondsPassTheirChecks) {
  int read = 0, ran = 0;
  for (const char* name : {"robots", "studies", "suspension"}) {
    const std::filesystem::path folder = std::filesystem::path(LINKWRIGHT_SOURCE_DIR) / "examples" / name;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".toml") continue;
      Diagnostics diagnostics;
      const Value document = study::read_file(entry.path(), diagnostics);
      const auto study = study::prepare(document, entry.path().string(), folder, catalogue(), diagnostics);
      // Coupled wheels are told of the pin that is one too many.
      if (entry.path().stem() == "coupled-wheels" && diagnostics.size() == 1) {
        EXPECT_NE(to_string(diagnostics[0]).find("holds one direction too many"), std::string::npos);
        diagnostics.clear();
      }
      EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics[0]);
      ASSERT_TRUE(study) << entry.path();
      ++read;
      const bool motion = study->kind->kind == "analysis" && study->kind->mechanism.starts_with("planar.");
      if (!motion && !study->kind->mechanism.starts_with("suspension")) continue;
      RunContext context;
      const study::Result result = study::run_study(*study, context);
      EXPECT_EQ(result.status, Status::done) << entry.path() << to_string(result.headline);
      for (const study::Check& check : result.checks)
        EXPECT_TRUE(check.passed) << entry.path() << check.quantity;
      ++ran;
    }
  }
  EXPECT_GE(read, 40);
  EXPECT_GE(ran, 40);
}

TEST(Catalogue, TablesAreFoundByIdByBeginningOrAllTogether) {
  const std::vector<study::Reproduction> all = {{.id = "a-1", .title{}, .source{}, .notes{}, .run{}},
                                                {.id = "a-10", .title{}, .source{}, .notes{}, .run{}},
                                                {.id = "b-1", .title{}, .source{}, .notes{}, .run{}}};
  Diagnostics diagnostics;
  const auto ids = [&](std::string_view id) {
    std::string out;
    for (const study::Reproduction* r : find_reproductions(id, all, diagnostics)) out += r->id + " ";
    return out;
  };
  EXPECT_EQ(ids("a-1"), "a-1 ");
  EXPECT_EQ(ids("a"), "a-1 a-10 ");
  EXPECT_EQ(ids("all"), "a-1 a-10 b-1 ");
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_EQ(ids("c-1"), "");
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_THAT(to_string(diagnostics[0]), HasSubstr("there is no published table 'c-1'; did you mean 'a-1'?"));
}

// The list of published tables names every ID that there is, and none that there is not.
TEST(Catalogue, TheListOfPublishedTablesIsTrue) {
  std::ifstream file(LINKWRIGHT_SOURCE_DIR "/docs/published-tables.md");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  std::set<std::string> listed, there;
  const std::regex id(
      "`((?:boskovic|burmester|hauenstein|milutinovic|morgan-wampler|poznanovic|varedi|wampler)-[a-z0-9.-]+)"
      "`");
  for (std::sregex_iterator i(text.begin(), text.end(), id), end; i != end; ++i) listed.insert((*i)[1]);
  for (const study::Reproduction& r : reproductions()) there.insert(r.id);
  EXPECT_EQ(listed, there);
  EXPECT_GE(there.size(), 24u);
}

// Holds for whatever the domains register: names are unique and every example is a study of its kind without
// errors.
TEST(Catalogue, EveryKindHasAGoodExampleAndASchema) {
  std::set<std::string> names;
  for (const study::Kind& kind : catalogue()) {
    const std::string name = study::name_of(kind);
    EXPECT_TRUE(names.insert(name).second) << name << " stands twice";
    EXPECT_FALSE(kind.summary.empty()) << name;
    Diagnostics diagnostics;
    const Value document = study::read_text(kind.example, study::Syntax::toml, name, diagnostics);
    ASSERT_TRUE(document.is_object()) << name;
    const auto example =
        study::prepare(document, name, LINKWRIGHT_SOURCE_DIR "/examples/studies", catalogue(), diagnostics);
    for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
    ASSERT_TRUE(example) << name;
    EXPECT_EQ(study::name_of(*example->kind), name);
    const bool has_mechanism = study::schema_of(kind).find("properties")->find("mechanism") != nullptr;
    EXPECT_EQ(has_mechanism, !kind.mechanism.empty()) << name;
  }
}

}  // namespace
}  // namespace linkwright::app
