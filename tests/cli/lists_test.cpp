// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/lists.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "linkwright/study/study.h"
#include "tests/cli/program_fixture.h"
#include "tests/study/sample_kind.h"

namespace linkwright::cli {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The program with the sample domain, whose lists are short.
class Lists : public test::ProgramFixture {
 protected:
  Lists() : ProgramFixture(LINKWRIGHT_SAMPLE_PROGRAM) {}
};
/// The program as users have it.
class RealLists : public test::ProgramFixture {
 protected:
  RealLists() : ProgramFixture(LINKWRIGHT_PROGRAM) {}
};

TEST_F(Lists, CatalogueInGroupsFilteredAndForMachines) {
  EXPECT_EQ(run({"catalogue"}), 0);
  EXPECT_EQ(out_,
            "Other studies\n"
            "  synthesis/sample.lever/angle\n      Turns a lever.\n"
            "  analysis/sample.wheel\n      Turns a wheel.\n"
            "  synthesis/sample.lever/point\n      Turns a lever.\n"
            "\nTo begin with one: linkwright new KIND\n");
  EXPECT_EQ(run({"catalogue", "LEVER", "point"}), 0);
  EXPECT_EQ(out_,
            "Other studies\n  synthesis/sample.lever/point\n      Turns a lever.\n"
            "\nTo begin with one: linkwright new KIND\n");
  EXPECT_EQ(run({"catalogue", "gear", "box"}), 2);
  EXPECT_EQ(err_, "error: nothing in the list holds 'gear box'; `linkwright catalogue` lists all\n");
  EXPECT_EQ(run({"catalogue", "wheel", "--json"}), 0);
  Diagnostics diagnostics;
  const Value all = study::read_text("{\"all\": " + out_ + "}", study::Syntax::json, "list", diagnostics);
  ASSERT_TRUE(diagnostics.empty()) << to_string(diagnostics[0]);
  ASSERT_EQ(all.find("all")->as_array().size(), 1u);
  const Value& wheel = all.find("all")->as_array()[0];
  EXPECT_EQ(wheel.find("name")->as_string(), "analysis/sample.wheel");
  EXPECT_EQ(wheel.find("group")->as_string(), "Other studies");
  EXPECT_EQ(wheel.find("summary")->as_string(), "Turns a wheel.");
}

TEST_F(RealLists, TheCatalogueIsInUsersWords) {
  EXPECT_EQ(run({"catalogue"}), 0);
  for (const char* group : {"Find motion and forces\n", "\nFollow a path\n", "\nBalance a machine\n",
                            "\nWheel suspensions\n", "\nRobots and Pi-joints\n", "\nFlexible links\n"})
    EXPECT_THAT(out_, HasSubstr(group));
}

TEST_F(RealLists, ColumnsAreListedWithoutARun) {
  EXPECT_EQ(run({"columns", "analysis/planar.four_bar"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("sweep\n"));
  EXPECT_THAT(out_, ::testing::ContainsRegex("  crank_speed_rad_per_s +crank speed \\(rad/s\\)\n"));
  EXPECT_THAT(out_, HasSubstr("linkwright new analysis/planar.four_bar"));
  EXPECT_EQ(run({"columns", "analysis/suspension.corner", "--json"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("\"key\": \"toe_by_travel_rad_per_m\""));
  EXPECT_EQ(run({"columns", "synthesis/planar.four_bar/path_points"}), 0) << err_;
  EXPECT_THAT(out_, HasSubstr("known from a run alone"));
  EXPECT_EQ(run({"columns", "six-bar-car"}), 2);
  EXPECT_THAT(err_, HasSubstr("there is no kind of study 'six-bar-car'"));
  EXPECT_EQ(run({"columns", "absent.toml"}), 2);
  EXPECT_THAT(err_, HasSubstr("absent.toml: error: there is no such file"));
}

TEST_F(Lists, NewWritesAStudyOnce) {
  EXPECT_EQ(run({"new", "lever/angle"}), 0) << err_;
  EXPECT_EQ(out_,
            "synthesis-sample.lever-angle.toml written; run it with: linkwright run "
            "synthesis-sample.lever-angle.toml\n"
            "for keys completed by your editor: linkwright schema synthesis/sample.lever/angle -o "
            "synthesis-sample.lever-angle.schema.json\n");
  const std::string text =
      "#:schema ./synthesis-sample.lever-angle.schema.json\n" + std::string(study::sample::example);
  EXPECT_EQ(text_of(folder_ / "synthesis-sample.lever-angle.toml"), text);
  EXPECT_EQ(run({"check", "synthesis-sample.lever-angle.toml"}), 0);
  write("s.toml", "mine");
  EXPECT_EQ(run({"new", "synthesis/sample.lever/angle", "s.toml"}), 2);
  EXPECT_EQ(err_, "s.toml: error: already exists and is left unchanged\n");
  EXPECT_EQ(text_of(folder_ / "s.toml"), "mine");
  EXPECT_EQ(run({"new", "lever/angle", "-"}), 0);
  EXPECT_EQ(out_, text);
  EXPECT_EQ(run({"new", "lever"}), 2);
  EXPECT_EQ(err_,
            "error: several kinds of study fit 'lever'; write one of:\n"
            "  synthesis/sample.lever/angle\n      Turns a lever.\n"
            "  synthesis/sample.lever/point\n      Turns a lever.\n");
  EXPECT_EQ(run({"new", "analisis/sample.wheel"}), 2);
  EXPECT_THAT(err_, HasSubstr("did you mean 'analysis/sample.wheel'?"));
}

TEST_F(Lists, TheCatalogueSaysWhatThereIsUnderAnotherName) {
  for (const auto& [word, answer] : {std::pair{"cam", "cam: disc cams are analysis/planar.cam"},
                                     {"gear", "is a joint of type \"gear\""},
                                     {"Rack", "is moved_by = \"rack\" of a link"},
                                     {"stewart", "are not modelled. Nearest: analysis/parallel.hexa"},
                                     {"Panhard", "and links, are analysis/suspension.beam_axle"},
                                     {"scara", "is analysis/planar.serial_arm with two revolute links"}}) {
    EXPECT_EQ(run({"catalogue", word}), 0) << word;
    EXPECT_THAT(out_, ::testing::HasSubstr(answer));
    EXPECT_THAT(out_, ::testing::Not(::testing::HasSubstr("camber")));
  }
}

TEST_F(Lists, SchemasAreWhereStudiesLookForThem) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"schema"}, {"schema", "analysis"}}) {
    EXPECT_EQ(run(words), 0);
    Diagnostics diagnostics;
    EXPECT_TRUE(study::read_text(out_, study::Syntax::json, "schema", diagnostics).is_object());
  }
  const std::string printed = out_;
  EXPECT_EQ(run({"schema", "analysis", "-o", "a.schema.json"}), 0);
  EXPECT_EQ(out_, "a.schema.json written\n");
  EXPECT_EQ(text_of(folder_ / "a.schema.json"), printed);
  EXPECT_EQ(run({"schema", "analysis", "-o", "none/a.json"}), 3);
  EXPECT_EQ(err_, "none/a.json: error: cannot be written: No such file or directory\n");
  // A study beside its schema says no more about it.
  EXPECT_EQ(run({"schema", "analysis", "-o", "analysis-sample.wheel.schema.json"}), 0);
  EXPECT_EQ(run({"new", "analysis"}), 0);
  EXPECT_EQ(out_,
            "analysis-sample.wheel.toml written; run it with: linkwright run analysis-sample.wheel.toml\n");
}

TEST_F(Lists, ReproduceListsAndRefuses) {
  EXPECT_EQ(run({"reproduce"}), 0);
  EXPECT_EQ(out_, "");  // this program has no tables
  EXPECT_EQ(run({"reproduce", "table-1"}), 2);
  EXPECT_THAT(err_, HasSubstr("there is no published table 'table-1'"));
}

TEST_F(RealLists, TablesAtOnceAreShownInTheirOrder) {
  ASSERT_EQ(run({"reproduce", "milutinovic-2014", "-j", "1"}), 0) << err_;
  const std::string one_by_one = out_;
  EXPECT_THAT(one_by_one, HasSubstr("milutinovic-2014-stiffness: "));
  ASSERT_EQ(run({"reproduce", "milutinovic-2014", "-j", "4"}), 0) << err_;
  EXPECT_EQ(out_, one_by_one);
}

TEST_F(RealLists, ExamplesByPartAndCopied) {
  EXPECT_EQ(run({"examples", "hoek"}), 0);
  EXPECT_EQ(out_,
            "Well-known machines\n"
            "  hoeken             Hoeken straight-line linkage\n"
            "\nReal joints: clearance and tolerances\n"
            "  tolerances-hoeken  Hoeken's straight line with joint clearances\n"
            "\nTo try one: linkwright examples --copy NAME\n");
  EXPECT_EQ(run({"examples", "--copy", "bump", "new/folder"}), 0) << err_;
  EXPECT_EQ(out_,
            "new/folder/hardpoints.txt written\nnew/folder/bump-steer.toml written\n"
            "run it with: linkwright run new/folder/bump-steer.toml\n");
  EXPECT_EQ(run({"check", "new/folder/bump-steer.toml"}), 0) << err_;
  EXPECT_EQ(run({"examples", "--copy", "compliance", "new/folder"}), 0) << err_;
  EXPECT_EQ(out_,
            "new/folder/hardpoints.txt is here already\nnew/folder/compliance.toml written\n"
            "run it with: linkwright run new/folder/compliance.toml\n");
  write("hoeken.toml", "mine");
  EXPECT_EQ(run({"examples", "--copy", "hoeken"}), 2);
  EXPECT_EQ(err_, "hoeken.toml: error: already exists and is left unchanged\n");
  EXPECT_EQ(text_of(folder_ / "hoeken.toml"), "mine");
  EXPECT_EQ(run({"examples", "--copy", "fourbar-18-points-free-timing-2"}), 0);
  EXPECT_EQ(run({"examples", "--copy", "balance-arm"}), 2);
  EXPECT_EQ(err_,
            "error: several examples fit 'balance-arm'; write one of:\n"
            "  balance-arm-counterweights: Counterweights of an arm of two links\n"
            "  balance-arm-law: Motion law of an arm of two links\n"
            "  counterbalance-arm: Arm that a spring carries\n");
  EXPECT_EQ(run({"examples", "--copy", "submarine"}), 2);
  EXPECT_EQ(err_, "error: there is no example 'submarine'; `linkwright examples` lists all\n");
  EXPECT_EQ(run({"examples", "--copy", "scisor-lift"}), 2);
  EXPECT_EQ(err_, "error: there is no example 'scisor-lift'; did you mean 'scissor lift'?\n");
  EXPECT_EQ(run({"examples", "--copy"}), 2);
  EXPECT_EQ(err_, "error: --copy needs the name of an example; `linkwright examples` lists all\n");
  EXPECT_EQ(run({"examples", "--copy", "scissor", "lift", "here"}), 2);
  EXPECT_EQ(
      err_,
      "error: --copy takes an example and a folder, not 3 words; `linkwright examples scissor lift here` "
      "finds the name\n");
}

TEST_F(RealLists, ExamplesByTheWordsOfTheTrade) {
  EXPECT_EQ(run({"examples", "windshield", "Wipers"}), 0);
  EXPECT_EQ(out_,
            "Find motion and forces\n"
            "  windscreen-wiper  Windscreen wiper: two arms from one crank\n"
            "\nTo try one: linkwright examples --copy NAME\n");
  // A word that nobody has: the nearest that somebody has.
  EXPECT_EQ(run({"examples", "excavater"}), 2);
  EXPECT_EQ(err_, "error: nothing in the list holds 'excavater'; did you mean 'excavator'?\n");
  EXPECT_EQ(run({"examples", "helicopter"}), 2);
  EXPECT_EQ(err_, "error: nothing in the list holds 'helicopter'; `linkwright examples` lists all\n");
  // Things that are not modelled, or are called otherwise here, are answered as the catalogue does.
  for (const char* word : {"ratchet", "winch", "drawers"}) {
    EXPECT_EQ(run({"catalogue", word}), 0) << word;
    const std::string answer = out_;
    EXPECT_EQ(run({"examples", word}), 0) << word;
    EXPECT_EQ(out_, answer);
  }
  EXPECT_EQ(run({"examples", "cam"}), 0);
  EXPECT_THAT(out_, HasSubstr("  dwell "));
  EXPECT_THAT(out_, HasSubstr("\n\ncam: disc cams are analysis/planar.cam"));
  EXPECT_EQ(run({"examples", "gear"}), 0);
  EXPECT_THAT(out_, HasSubstr("  geared-five-bar "));
  EXPECT_THAT(out_, HasSubstr("\n\ngear: a pair of gears is a joint of type \"gear\""));
}

TEST_F(RealLists, SamplesSayWhichMechanismTakesThem) {
  EXPECT_EQ(run({"samples", "leg"}), 0);
  EXPECT_EQ(out_,
            "Planar linkages (type = \"planar.linkage\" or \"clearance.linkage\")\n"
            "  klann_leg   A walking leg: the foot runs almost straight over half a turn.\n"
            "  jansen_leg  A leg of the Strandbeest: the foot stays level on the ground.\n"
            "\n`sample = \"NAME\"` in [mechanism] takes one of them, with its dimensions and masses.\n");
  EXPECT_EQ(run({"samples", "helicopter"}), 2);
  EXPECT_EQ(err_, "error: nothing in the list holds 'helicopter'; `linkwright samples` lists all\n");
  // A search in the wrong list is shown the right ones.
  EXPECT_EQ(run({"catalogue", "jansen"}), 2);
  EXPECT_EQ(
      err_,
      "error: nothing in the list holds 'jansen'; `linkwright catalogue` lists all; `linkwright samples "
      "jansen` finds 1; `linkwright examples jansen` finds 1\n");
}

}  // namespace
}  // namespace linkwright::cli
