// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/cli/messages_fixture.h"

// Mistakes in first studies, and the answers of the real program: whole messages, so that each change of one
// is seen here.
namespace linkwright::cli {
namespace {

using namespace linkwright::cli::test;

// Numbers, units and words of a study.
std::vector<Row> keys_and_values() {
  return {
      {"no unit",
       four_bar,
       {{"crank_mm   = 100.0", "crank = 100"}},
       {},
       "s.toml:12:1: error: mechanism.parameters.crank: the unit is missing; write crank_m, crank_mm, "
       "crank_cm, crank_um or crank_in\n"},
      {"inches", four_bar, {{"crank_mm   = 100.0", "crank_in = 4"}}, {}, ""},
      {"number in quotes",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = \"100\""}},
       {},
       "s.toml:12:12: error: mechanism.parameters.crank_mm: is the text '100', must be a number\n"},
      {"misspelt and missing",
       four_bar,
       {{"coupler_mm = 400.0", "cupler_mm = 400.0"}},
       {},
       "s.toml:13:1: error: mechanism.parameters.cupler_mm: unknown key; did you mean 'coupler_mm'?\n"},
      {"key missing",
       four_bar,
       {{"rocker_mm  = 320.0\n", ""}},
       {},
       "s.toml:10:1: error: mechanism.parameters.rocker_m: this key is missing; write rocker_m, rocker_mm, "
       "rocker_cm, rocker_um or rocker_in\n"},
      {"twice with units",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = 100\ncrank_m = 0.1"}},
       {},
       "s.toml:13:1: error: mechanism.parameters.crank_m: is given twice, as crank_mm and crank_m; keep one "
       "of them\n"},
      {"negative",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = -100"}},
       {},
       "s.toml:12:12: error: mechanism.parameters.crank_mm: is -100 mm, must be more than 0 mm\n"},
      {"zero",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = 0"}},
       {},
       "s.toml:12:12: error: mechanism.parameters.crank_mm: is 0 mm, must be more than 0 mm\n"},
      {"kind",
       four_bar,
       {{"\"analysis\"", "\"analyse\""}},
       {},
       "s.toml:3:10: error: kind: is 'analyse', must be one of: synthesis, enumeration, analysis, "
       "simulation, "
       "speed_fluctuation, balancing, rest, sweep; did you mean 'analysis'?\n"},
      {"type fourbar",
       four_bar,
       {{"\"planar.four_bar\"", "\"fourbar\""}},
       {},
       "s.toml:7:10: error: mechanism.type: is 'fourbar', must be one of: planar.four_bar, planar.linkage, "
       "planar.slider_crank, planar.serial_arm, planar.cam, suspension.corner, suspension.beam_axle, "
       "parallel.pi_joint, "
       "parallel.delta, "
       "parallel.hexa, parallel.five_bar, parallel.constant_orientation, parallel.serial_pi_arm, "
       "flexible.hub_link, clearance.linkage; did you mean 'planar.four_bar'?\n"},
      {"type 4bar",
       four_bar,
       {{"\"planar.four_bar\"", "\"planar.4bar\""}},
       {},
       "s.toml:7:10: error: mechanism.type: is 'planar.4bar', must be one of: planar.four_bar, "
       "planar.linkage, planar.slider_crank, planar.serial_arm, planar.cam, suspension.corner, "
       "suspension.beam_axle, parallel.pi_joint, "
       "parallel.delta, parallel.hexa, parallel.five_bar, parallel.constant_orientation, "
       "parallel.serial_pi_arm, flexible.hub_link, clearance.linkage; did you mean 'planar.four_bar'?\n"},
      {"samples 1",
       four_bar,
       {{"samples  = 361", "samples = 1"}},
       {},
       "s.toml:43:11: error: sweep.crank_angle.samples: is 1, must be at least 2\n"},
      {"samples 1e9",
       four_bar,
       {{"samples  = 361", "samples = 1000000000"}},
       {},
       "s.toml:43:11: error: sweep.crank_angle.samples: is 1000000000, must be at most 100000\n"},
      {"1e308",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = 1e308"}},
       {},
       "s.toml:12:12: error: mechanism.parameters.crank_mm: is 1e+308 mm, must be at most 1e+12 mm\n"},
      {"nan",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = nan"}},
       {},
       "s.toml:12:12: error: mechanism.parameters.crank_mm: is nan, must be a finite number\n"},
      {"kurbel",
       four_bar,
       {{"crank_mm   = 100.0", "kurbel_mm = 100"}},
       {},
       "s.toml:12:1: error: mechanism.parameters.kurbel_mm: unknown key; did you mean 'crank_mm'?\n"},
      {"Koppel",
       four_bar,
       {{"coupler_mm = 400.0", "koppel_mm = 400.0"}},
       {},
       "s.toml:13:1: error: mechanism.parameters.koppel_mm: unknown key; did you mean 'coupler_mm'?\n"},
      {"Open",
       four_bar,
       {{"\"open\"  ", "\"Open\"  "}},
       {},
       "s.toml:8:10: error: mechanism.branch: is 'Open', must be one of: open, crossed; did you mean "
       "'open'?\n"},
      {"to_rad = 360",
       four_bar,
       {{"to_deg   = 360.0", "to_rad = 360.0"}},
       {},
       "s.toml:42:10: warning: sweep.crank_angle.to_rad: is 360 rad, 57 turns; if degrees are meant, write "
       "to_deg\n"},
      {"speed_hz",
       four_bar,
       {{"speed_rpm = 300.0", "speed_hz = 5"}},
       {},
       "s.toml:35:1: error: drive.speed_hz: unknown key; 'hz' is not a unit of an angular speed here; write "
       "speed_rad_per_s, speed_deg_per_s or speed_rpm\n"},
  };
}

// Syntax of a study.
std::vector<Row> syntax() {
  return {
      {"decimal comma",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = 100,5"}},
       {},
       "s.toml:12:15: error: '100,5' is not a number; write the decimal point: 100.5\n"},
      {"unit in the value",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = 100 mm"}},
       {},
       "s.toml:12:16: error: '100 mm' is not a number; the unit is in the key: crank_mm = 100\n"},
      {"unit in the value, no blank",
       four_bar,
       {{"crank_mm   = 100.0", "crank_mm = 100mm"}},
       {},
       "s.toml:12:15: error: '100mm' is not a number; the unit is in the key: crank_mm = 100\n"},
      {"no schema",
       four_bar,
       {{"schema = 1\n", ""}},
       {},
       "s.toml:1:1: error: schema: this key is missing; add schema = 1\n"},
      {"schema 2",
       four_bar,
       {{"schema = 1", "schema = 2"}},
       {},
       "s.toml:2:10: error: schema: is 2, must be 1; this program reads studies of that version\n"},
      {"curly quotes",
       four_bar,
       {{"\"Forces of my four-bar\"", "“Forces”"}},
       {},
       "s.toml:4:10: error: the character '“' (U+201C) is only allowed in strings and comments; use plain "
       "ASCII characters, or quotes around the text\n"},
      {"degree sign",
       four_bar,
       {{"from_deg = 0.0", "from_deg = 0°"}},
       {},
       "s.toml:41:13: error: the character '°' (U+00B0) is only allowed in strings and comments; use plain "
       "ASCII characters, or quotes around the text\n"},
      {"bracket of a table",
       four_bar,
       {{"[mechanism]", "[mechanism"}},
       {},
       "s.toml:6:11: error: is not valid TOML: in a table header, expected ']', saw the end of the line\n"},
      {"table twice",
       four_bar,
       {{"[drive]", "[mechanism]\n[drive]"}},
       {},
       "s.toml:33:1: error: the key 'mechanism' is given twice\n"},
      {"BOM",
       four_bar,
       {{"# linkwright",
         "\xEF\xBB\xBF"
         "# linkwright"}},
       {},
       ""},
      {"UTF-16 study",
       nullptr,
       {},
       {{"s.toml", utf16("schema = 1\n")}},
       "s.toml:1:1: error: the byte 0xFF is not UTF-8 text; save the file as UTF-8\n"},
      {"Latin-1 study",
       four_bar,
       {{"\"Forces of my four-bar\"",
         "\"Kr\xE4"
         "fte\""}},
       {},
       "s.toml:4:13: error: the byte 0xE4 is not UTF-8 text; save the file as UTF-8\n"},
      {"title without quotes",
       four_bar,
       {{"\"Forces of my four-bar\"", "Forces of my four-bar"}},
       {},
       "s.toml:4:10: error: text needs quotes; write title = \"Forces of my four-bar\"\n"},
      {"word without quotes",
       four_bar,
       {{"\"crank\"\n", "crank\n"}},
       {},
       "s.toml:34:13: error: text needs quotes; write input = \"crank\"\n"},
      {"backslashes",
       four_bar,
       {{"[output] ", "[output]\ndir = \"C:\\Users\\me\"\n#"}},
       {},
       "s.toml:46:7: error: in double quotes a backslash begins a special character; use / in paths, or "
       "single quotes: dir = 'C:\\Users\\me'\n"},
      {"backslashes, allowed escapes",
       four_bar,
       {{"[output] ", "[output]\ndir = \"C:\\temp\\new\"\n#"}},
       {},
       "s.toml:46:7: error: output.dir: has a special character in it, which a backslash in double quotes "
       "makes; use / in paths, or single quotes\n"},
      {"empty",
       nullptr,
       {},
       {{"s.toml", ""}},
       "s.toml: error: the file is empty; write a first study with `linkwright new`\n"},
      {"xlsx as study",
       nullptr,
       {},
       {{"s.toml", workbook}},
       "s.toml: error: this is an Excel workbook or another packed file, a study is a text file; save its "
       "tables as CSV and name them in a study\n"},
      {"TOML in a file named JSON",
       nullptr,
       {},
       {{"s.json", "schema = 1\nkind = \"analysis\"\n"}},
       "s.json: error: the text is TOML, but the name of the file says JSON; let it end in .toml\n",
       {"check", "s.json"}},
      {"JSON in a file named TOML",
       nullptr,
       {},
       {{"s.toml", "{\"schema\": 1, \"kind\": \"analysis\"}"}},
       "s.toml:1:1: error: mechanism: this key is missing\n"},
      {"CRLF", four_bar, {{"schema = 1\n", "schema = 1\r\n"}}, {}, ""},
      {"xlsx as study by its name",
       nullptr,
       {},
       {{"s.xlsx", workbook}},
       "s.xlsx: error: this is an Excel workbook or another packed file, a study is a text file; save its "
       "tables as CSV and name them in a study\n",
       {"check", "s.xlsx"}},
      {"missing bracket",
       path,
       {{"[500, 1100],", "[500, 1100"}},
       {},
       "s.toml:19:14: error: is not valid TOML: in an array, expected comma or closing ']', saw '['; is a ] "
       "or a comma missing in the list that begins in line 18?\n"},
      {"missing closing bracket",
       path,
       {{"  [200, 300], [400, 500], [600, 900],\n]\n", "  [200, 300], [400, 500], [600, 900],\n"}},
       {},
       "s.toml:26:3: error: is not valid TOML: in a value, could not determine value type; is a ] or a comma "
       "missing in the list that begins in line 18?\n"},
  };
}

// Points from a spreadsheet.
std::vector<Row> spreadsheets() {
  return {
      {"xlsx as CSV",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", workbook}},
       "s.toml:18:15: error: target.points_file: 'path.csv' cannot be read: this is an Excel workbook or "
       "another packed file; save it as CSV or plain text\n"},
      {"semicolons",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm;y_mm\r\n0.5;0.5\r\n100.5;50.5\r\n200.5;80.5\r\n300.5;50.5\r\n400.5;0.5\r\n"}},
       ""},
      {"semicolons and comma",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm;y_mm\r\n0,5;0,5\r\n100,5;50,5\r\n200,5;80,5\r\n300,5;50,5\r\n400,5;0,5\r\n"}},
       ""},
      {"commas and decimal comma",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm,y_mm\r\n0,5,0,5\r\n100,5,50,5\r\n200,5,80,5\r\n300,5,50,5\r\n400,5,0,5\r\n"}},
       "s.toml:18:15: error: target.points_file: path.csv:2:1: 4 values, the header has 2 columns; with "
       "decimal commas separate the columns by semicolons\n"},
      {"X [mm]",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "X [mm],Y [mm]\r\n0.5,0.5\r\n100.5,50.5\r\n200.5,80.5\r\n300.5,50.5\r\n400.5,0.5\r\n"}},
       ""},
      {"x,y",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x,y\r\n0.5,0.5\r\n100.5,50.5\r\n200.5,80.5\r\n300.5,50.5\r\n400.5,0.5\r\n"}},
       "s.toml:18:15: error: target.points_file: 'path.csv' has the columns x, y, but needs x, y, each with "
       "a "
       "unit of length; name them x_mm,y_mm; a heading like X [mm] will do, too\n"},
      {"other columns",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "Breite [mm];Tiefe [mm]\r\n0,5;0,5\r\n100,5;50,5\r\n200,5;80,5\r\n"}},
       "s.toml:18:15: error: target.points_file: 'path.csv' has the columns breite_mm, tiefe_mm, but needs "
       "x, y, "
       "each with a unit of length; name them x_mm,y_mm; a heading like X [mm] will do, too\n"},
      {"one column of another name",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "X [mm],Z [mm]\r\n0.5,0.5\r\n100.5,50.5\r\n200.5,80.5\r\n"}},
       "s.toml:18:15: error: target.points_file: 'path.csv' has the columns x_mm, z_mm, but needs x, y, each "
       "with a unit of length; name them x_mm,y_mm; a heading like X [mm] will do, too\n"},
      {"gates",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "from_x_mm,from_y_mm,to_x_mm\r\n0,0,1\r\n"}},
       "s.toml:18:15: error: target.points_file: 'path.csv' has the columns from_x_mm, from_y_mm, to_x_mm, "
       "but needs from_x, from_y, to_x, to_y, each with a unit of length; name them "
       "from_x_mm,from_y_mm,to_x_mm,to_y_mm; a heading like X [mm] will do, too\n"},
      {"no header",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "0,0\n100,50\n200,80\n300,50\n400,0\n"}},
       "s.toml:18:15: error: target.points_file: path.csv:1:1: the first line holds numbers ('0'): the "
       "header line is missing; write the column keys with their units above them, for example x_mm,y_mm\n"},
      {"tabs",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv",
         "x_mm\ty_mm\r\n0.5\t0.5\r\n100.5\t50.5\r\n200.5\t80.5\r\n300.5\t50.5\r\n400.5\t0.5\r\n"}},
       ""},
      {"sep=",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv",
         "sep=;\r\nx_mm;y_mm\r\n0,5;0,5\r\n100,5;50,5\r\n200,5;80,5\r\n300,5;50,5\r\n400,5;0,5\r\n"}},
       ""},
      {"#DIV/0!",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm,y_mm\n0,0\n#DIV/0!,50\n200,80\n"}},
       "s.toml:18:15: error: target.points_file: path.csv:3:1: x_mm: '#DIV/0!' is not a number; write "
       "numbers like 0.25 or 1e-3, columns separated by commas\n"},
      {"trailing columns",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm,y_mm,,\n0,0,,\n100,50,,\n200,80,,\n300,50,,\n400,0,,\n"}},
       ""},
      {"thousands",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm,y_mm\n\"1,000.5\",0\n100,50\n"}},
       "s.toml:18:15: error: target.points_file: path.csv:2:1: x_mm: '1,000.5' is not a number; write "
       "thousands without a separator, like 1000.5\n"},
      {"empty rows",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm,y_mm\n0,0\n,\n100,50\n200,80\n300,50\n,\n400,0\n"}},
       ""},
      {"half a row",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm,y_mm\n0,0\n100,\n200,80\n300,50\n400,0\n"}},
       "s.toml:18:15: error: target.points_file: 'path.csv': point 2 is incomplete; give it a number in "
       "column y_mm\n"},
      {"UTF-16 CSV",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv",
         utf16("x_mm\ty_mm\r\n0,5\t0,5\r\n100,5\t50,5\r\n200,5\t80,5\r\n300,5\t50,5\r\n400,5\t0,5\r\n")}},
       ""},
      {"unicode minus",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm,y_mm\n0,0\n100,−50\n200,80\n300,50\n400,0\n"}},
       ""},
      {"column twice",
       path,
       {{all_points, "points_file = \"path.csv\""}},
       {{"path.csv", "x_mm,y_mm,y_mm\n0,0,1\n"}},
       "s.toml:18:15: error: target.points_file: path.csv:1:11: y_mm: duplicate column\n"},
      {"missing CSV",
       path,
       {{all_points, "points_file = \"pfad.csv\""}},
       {},
       "s.toml:18:15: error: target.points_file: cannot read 'pfad.csv'; file names are relative to the "
       "folder of the study\n"},
  };
}

// The command line.
std::vector<Row> command_line() {
  return {
      {"bounds cannot close",
       path,
       {{"[target]",
         "[mechanism.parameters]\nground_mm = { min = 1000, max = 2000 }\ncrank_mm = { min = 5, max = 20 "
         "}\ncoupler_mm = { min = 5, max = 20 }\nrocker_mm = { min = 5, max = 20 }\n\n[target]"}},
       {},
       "s.toml:14:1: error: mechanism.parameters: the bounds do not let the four-bar close: the ground is at "
       "least 1000 mm long, the other links together at most 60 mm; widen the bounds\n",
       {"run", "s.toml"}},
      {"--time-limit 0",
       four_bar,
       {},
       {},
       "--time-limit: is '0', must be a number of seconds, more than 0\nRun with --help for more "
       "information.\n",
       {"run", "s.toml", "--time-limit", "0"}},
      {"--seed without seeds",
       four_bar,
       {},
       {},
       "--seed 3: error: this kind of study has no seeds; leave out --seed\n",
       {"run", "s.toml", "--seed", "3"}},
      {"an option misspelt",
       four_bar,
       {},
       {},
       "The following arguments were not expected: 3 --sed\nRun with --help for more information.\n"
       "did you mean '--set'?\n",
       {"run", "s.toml", "--sed", "3"}},
      {"a command that there is not",
       nullptr,
       {},
       {},
       "error: there is no command 'simulate'; `linkwright help` lists the commands; a study in FILE.toml "
       "runs "
       "by `linkwright FILE.toml`\n",
       {"simulate"}},
      {"a command misspelt",
       nullptr,
       {},
       {},
       "error: there is no command 'rnu'; did you mean 'run'?\n",
       {"rnu", "s.toml"}},
      {"folder is a file",
       four_bar,
       {},
       {},
       "s.toml: error: the folder cannot be made: Not a directory\n",
       {"run", "s.toml", "--out", "s.toml"}},
      {"folder in a file",
       four_bar,
       {},
       {},
       "s.toml/x: error: the folder cannot be made: Not a directory\n",
       {"run", "s.toml", "--out", "s.toml/x"}},
  };
}

TEST_F(Messages, KeysAndValues) { expect(keys_and_values()); }
TEST_F(Messages, Syntax) { expect(syntax()); }
TEST_F(Messages, Spreadsheets) { expect(spreadsheets()); }
TEST_F(Messages, CommandLine) { expect(command_line()); }

TEST_F(Messages, EmptyFiles) {
  write("s.toml", "");
  for (const std::string file : {"s.toml", "/dev/null"}) {
    EXPECT_EQ(run({"check", file}), 2);
    EXPECT_EQ(err_, file + ": error: the file is empty; write a first study with `linkwright new`\n");
  }
}

TEST_F(Messages, NoCommandListsTheCommands) {
  EXPECT_EQ(run({}), 2);
  EXPECT_THAT(err_,
              ::testing::AllOf(::testing::HasSubstr("\n  run         run a study and write its results\n"),
                               ::testing::HasSubstr("\nTo begin: linkwright examples;")));
}

TEST_F(Messages, NamesInAnyScript) {
  const std::string folder = "\xC3\xA4 \xC3\xB6/\xE6\x9C\xBA\xE6\x9E\x84";  // ä ö/机构
  std::filesystem::create_directories(folder_ / folder);
  ASSERT_EQ(run({"new", four_bar, folder + "/\xC3\xBC b.toml"}), 0);
  EXPECT_EQ(run({folder + "/\xC3\xBC b.toml", "--out", folder + "/aus"}), 0) << err_;
  EXPECT_THAT(out_, ::testing::EndsWith("\nopen " + folder + "/aus/report.html\n"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / folder / "aus" / "report.html"));
}

TEST_F(Messages, LinkagesThatDoNotCloseSayByHowMuch) {
  const auto headline = [&](const char* coupler, const char* rocker, const char* ground) {
    EXPECT_EQ(run({"new", four_bar, "-"}), 0);
    std::string study = replaced(out_, "coupler_mm = 400.0", std::string("coupler_mm = ") + coupler);
    study = replaced(std::move(study), "rocker_mm  = 320.0", std::string("rocker_mm = ") + rocker);
    write("s.toml", replaced(std::move(study), "ground_mm  = 600.0", std::string("ground_mm = ") + ground));
    EXPECT_EQ(run({"run", "s.toml", "--out", "out"}), 3);
    return out_;
  };
  EXPECT_THAT(
      headline("80", "90", "400"),
      ::testing::AllOf(::testing::HasSubstr("coupler + rocker cannot close, a gap of 130 mm is left at 0"),
                       ::testing::HasSubstr("one link is longer than the others together")));
  EXPECT_THAT(headline("120", "120", "300"), ::testing::HasSubstr("assembles from -45.0 to 45.0 deg"));
}

}  // namespace
}  // namespace linkwright::cli
