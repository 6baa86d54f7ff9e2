// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "linkwright/study/study.h"
#include "support/message.h"

namespace linkwright::study {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// The messages that a person sees of a text: one line a diagnostic.
std::string read_messages(std::string_view text, Syntax syntax = Syntax::toml) {
  Diagnostics diagnostics;
  const Value value = read_text(text, syntax, "s.toml", diagnostics);
  EXPECT_EQ(value.is_null(), has_errors(diagnostics));
  return test::lines_of(diagnostics);
}

Value read_good(std::string_view text, Syntax syntax) {
  Diagnostics diagnostics;
  Value value = read_text(text, syntax, "s", diagnostics);
  for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
  return value;
}

/// A folder of its own for a test, removed afterwards.
class Folder {
 public:
  Folder()
      : path_(fs::temp_directory_path() /
              ("linkwright-read-" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
               ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path file(std::string_view name, std::string_view text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(ReadToml, KeepsOrderTypesAndPositions) {
  const Value v = read_good(
      "zeta = 1\nalpha = 2.0   # comment with é\n\n[table]\n  b = \"ü\"\n  a = [1, 2.5]\n[[list]]\nx = "
      "true\n",
      Syntax::toml);
  ASSERT_EQ(v.as_object().size(), 4u);
  EXPECT_EQ(v.as_object()[0].key, "zeta");
  EXPECT_EQ(v.as_object()[1].key, "alpha");
  EXPECT_TRUE(v.find("zeta")->is_integer());
  EXPECT_FALSE(v.find("alpha")->is_integer());
  const Value* table = v.find("table");
  EXPECT_EQ(table->as_object()[0].key, "b");
  EXPECT_EQ(table->as_object()[0].key_position.line, 5);
  EXPECT_EQ(table->as_object()[0].key_position.column, 3);
  EXPECT_EQ(table->find("b")->position.column, 7);
  EXPECT_EQ(table->find("a")->as_array()[1].position.column, 11);
  EXPECT_TRUE(v.find("list")->as_array()[0].find("x")->as_bool());
}

TEST(ReadJson, PositionsOfEveryKeyAndValue) {
  const Value v =
      read_good("{\"zeta\": 12,\n \"a\": [1.5,\"x\\\"y\" ,{\"b\":null}],\n\"é\":true}", Syntax::json);
  ASSERT_EQ(v.as_object().size(), 3u);
  EXPECT_EQ(v.as_object()[0].key_position.column, 2);
  EXPECT_EQ(v.find("zeta")->position.column, 10);
  const Value* a = v.find("a");
  EXPECT_EQ(a->position.line, 2);
  EXPECT_EQ(a->position.column, 7);
  EXPECT_EQ(a->as_array()[0].position.column, 8);
  EXPECT_EQ(a->as_array()[1].position.column, 12);
  EXPECT_EQ(a->as_array()[1].as_string(), "x\"y");
  EXPECT_EQ(a->as_array()[2].position.column, 20);
  EXPECT_EQ(a->as_array()[2].as_object()[0].key_position.column, 21);
  EXPECT_EQ(a->as_array()[2].find("b")->position.column, 25);
  EXPECT_EQ(v.as_object()[2].key_position.line, 3);
  EXPECT_EQ(v.as_object()[2].value.position.column, 5);
}

TEST(ReadText, FrequentMistakesComeWithTheRemedy) {
  EXPECT_EQ(read_messages("a_mm = 100,5 # long\n"),
            "s.toml:1:11: error: '100,5' is not a number; write the decimal point: 100.5\n");
  EXPECT_EQ(read_messages("a_mm = 100,5 mm\n"),
            "s.toml:1:11: error: '100,5 mm' is not a number; the unit is in the key: a_mm = 100.5\n");
  EXPECT_EQ(read_messages("a_m = -1.5e3 mm\n"),
            "s.toml:1:14: error: '-1.5e3 mm' is not a number; the unit is in the key: a_mm = -1.5e3\n");
  EXPECT_EQ(read_messages("a = 5 mm\n"),
            "s.toml:1:7: error: '5 mm' is not a number; the unit is in the key: a_mm = 5\n");
  EXPECT_EQ(read_messages("a_mm = 5 furlongs\n"),
            "s.toml:1:10: error: '5 furlongs' is not a number; the unit is in the key: a_mm = 5\n");
  EXPECT_EQ(read_messages("a = 1\ntitle = My linkage # so\n"),
            "s.toml:2:9: error: text needs quotes; write title = \"My linkage\"\n");
  EXPECT_EQ(read_messages("dir = \"C:\\Users\\me\"\n"),
            "s.toml:1:7: error: in double quotes a backslash begins a special character; use / in paths, or "
            "single quotes: dir = 'C:\\Users\\me'\n");
  EXPECT_THAT(read_messages("a = [\n  1,\n  2\nb = 3\n"),
              HasSubstr("is a ] or a comma missing in the list that begins in line 1?"));
  // A line that says nothing of the kind keeps the words of the parser.
  EXPECT_THAT(read_messages("a = 1\na = 2\n"), HasSubstr("s.toml:2:5: error: the key 'a' is given twice\n"));
}

TEST(ReadText, SyntaxErrorsSayWhereAndWhat) {
  EXPECT_THAT(read_messages("a = 1\nb = \n"), HasSubstr("s.toml:2:5: error: is not valid TOML"));
  EXPECT_THAT(read_messages("a = 1\n["),
              HasSubstr("s.toml:2:2: error: the file ends in the middle of a table header"));
  EXPECT_THAT(read_messages("[\n"), HasSubstr("s.toml:1:2: error: is not valid TOML"));
  EXPECT_THAT(read_messages("a = \"text\nb = 2"),
              HasSubstr("s.toml:1:10: error: is not valid TOML: in a string"));
  EXPECT_THAT(read_messages("crank = 0.4 ]\n"),
              HasSubstr("s.toml:1:13: error: is not valid TOML: in a key-value pair"));
  EXPECT_THAT(read_messages("{\"a\": 1,}", Syntax::json),
              HasSubstr("s.toml:1:9: error: is not valid JSON: syntax error"));
  EXPECT_THAT(read_messages("{\"a\": 1e999}", Syntax::json), HasSubstr("is not valid JSON: number overflow"));
  EXPECT_THAT(read_messages("[1]", Syntax::json),
              HasSubstr("s.toml:1:1: error: the document must be an object { ... }, found array"));
  EXPECT_THAT(read_messages("when = 2024-01-01\n"),
              HasSubstr("s.toml:1:8: error: is a date or time, which no study uses"));
}

TEST(ReadText, AKeyMayStandOnce) {
  EXPECT_THAT(read_messages("a = 1\na = 2\n"), HasSubstr("s.toml:2:5: error: the key 'a' is given twice"));
  EXPECT_THAT(read_messages("[a]\nb = 1\n[a]\n"), HasSubstr("s.toml:3:1: error: the key 'a' is given twice"));
  EXPECT_THAT(read_messages("{\"a\": 1,\n \"a\": 2}", Syntax::json),
              HasSubstr("s.toml:2:2: error: the key 'a' is given twice"));
}

TEST(ReadText, OnlyUtf8AndAsciiOutsideStrings) {
  EXPECT_THAT(read_messages("a = 1 # ok\nb = \"\xFF\"\n"),
              HasSubstr("s.toml:2:6: error: the byte 0xFF is not UTF-8 text; save the file as UTF-8"));
  EXPECT_THAT(read_messages("a = \"\xED\xA0\x80\""), HasSubstr("the byte 0xED is not UTF-8 text"));
  EXPECT_THAT(read_messages("a = \"\xC0\xAF\""), HasSubstr("the byte 0xC0 is not UTF-8 text"));
  EXPECT_THAT(read_messages("a = \xE2\x80\x93"
                            "5\n"),
              HasSubstr("s.toml:1:5: error: the character '\xE2\x80\x93' (U+2013) is only allowed in strings "
                        "and comments"));
  EXPECT_THAT(read_messages("{\"a\": \xE2\x80\x9Cx\xE2\x80\x9D}", Syntax::json),
              HasSubstr("(U+201C) is only allowed in strings"));
  EXPECT_EQ(read_messages("\xEF\xBB\xBF"
                          "a = '''é \"''' # ü\nb = \"\"\"é\"\"\"\"\"\nc = \"\\\"é\"\n"),
            "");
}

// Left to toml++, these reach code that it believes unreachable.
TEST(ReadText, TextThatIsToldApartFromJsonIsCheckedBeforeItIsParsed) {
  // A study in TOML under a name of JSON is recognised, and characters that toml++ has no answer to are not
  // shown to it.
  EXPECT_THAT(read_messages("schema = 1\n", Syntax::json),
              HasSubstr("the text is TOML, but the name of the file says JSON"));
  EXPECT_THAT(read_messages("schema = 202\u0159\n", Syntax::json),
              testing::Not(HasSubstr("the text is TOML")));
  EXPECT_THAT(read_messages("schema = " + std::string(100'000, '['), Syntax::json),
              testing::Not(HasSubstr("the text is TOML")));
}

TEST(ReadText, QuotesInTheMiddleOfAValue) {
  EXPECT_THAT(read_messages("at = 202\"\u00e9\"\n"),
              HasSubstr("s.toml:1:9: error: is not valid TOML: a text cannot begin with \" here"));
  EXPECT_THAT(read_messages("a = 2.\"\u00e9\"\n"), HasSubstr("s.toml:1:7: error: is not valid TOML"));
  EXPECT_THAT(read_messages("a = [2.\"\u00e9\"]\n"), HasSubstr("s.toml:1:8: error: is not valid TOML"));
  EXPECT_EQ(read_messages("[a.\"\u00e9\"]\n[[b.'\u00e9']]\nc = { 2.'\u00e9' = [1, # x\n 2] }\n"), "");
  EXPECT_THAT(read_messages("a = 'x' '\u00e9'\n"), HasSubstr("s.toml:1:9: error: is not valid TOML"));
  EXPECT_EQ(read_messages("'a' . \"b\" = ['x', # 'y\n  \"z\", {'c' = 'd', \"e\" = ''}]\n'f' = 1\n"), "");
}

TEST(ReadText, EmptyDocuments) {
  EXPECT_THAT(read_messages(""), HasSubstr("s.toml: error: the file is empty"));
  EXPECT_THAT(read_messages(" \n\t\n"), HasSubstr("the file is empty"));
  EXPECT_THAT(read_messages("# nothing\n"), HasSubstr("the file has no keys"));
  EXPECT_THAT(read_messages("{}", Syntax::json), HasSubstr("the file has no keys"));
}

// Every way to nest deeply: a recursive parser or destructor without limit would overflow the stack here.
TEST(ReadText, DeepNestingIsRefused) {
  const auto repeat = [](std::string_view text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  EXPECT_THAT(read_messages("a = " + repeat("[", 200000)),
              HasSubstr("s.toml:1:69: error: tables and arrays are nested more than 64 deep"));
  EXPECT_THAT(read_messages("a = " + repeat("{a=", 200000)), HasSubstr("more than 64 deep"));
  EXPECT_THAT(read_messages(repeat("a.", 200000) + "a = 1"), HasSubstr("more than 64 deep"));
  EXPECT_THAT(read_messages("[" + repeat("a . ", 200000) + "a]"), HasSubstr("more than 64 deep"));
  EXPECT_THAT(read_messages("[" + repeat("\"a\".", 60) + "a]\n" + repeat("b.", 60) + "b = 1"),
              HasSubstr("more than 64 deep"));
  EXPECT_THAT(read_messages(repeat("{\"a\":", 200000), Syntax::json), HasSubstr("more than 64 deep"));
  EXPECT_EQ(read_messages("a = " + repeat("[", 60) + repeat("]", 60)), "");
}

TEST(ReadFile, WhatIsNoReadableFile) {
  const Folder folder;
  const auto message = [](const fs::path& file) {
    Diagnostics diagnostics;
    EXPECT_TRUE(read_file(file, diagnostics).is_null());
    return diagnostics.size() == 1 ? to_string(diagnostics[0]) : "?";
  };
  EXPECT_EQ(message(folder.path() / "none.toml"),
            (folder.path() / "none.toml").string() + ": error: there is no such file");
  EXPECT_THAT(message(folder.path()), HasSubstr("is a folder, expected a file"));
  EXPECT_THAT(message(folder.file("empty.toml", "")), HasSubstr("empty.toml: error: the file is empty"));
  EXPECT_THAT(message(folder.file("a.toml", "x") / "below.toml"),
              HasSubstr("below.toml: error: cannot be read: Not a directory"));
}

// The size is known before anything is read: a sparse file of 100 MB costs nothing.
TEST(ReadFile, HugeFileIsRefusedBeforeReading) {
  const Folder folder;
  const fs::path file = folder.file("huge.toml", "a = 1");
  fs::resize_file(file, 100'000'000);
  Diagnostics diagnostics;
  read_file(file, diagnostics);
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_THAT(
      to_string(diagnostics[0]),
      HasSubstr("huge.toml: error: the file has 100000000 bytes; at most 16777216 (16 MiB) are read"));
}

TEST(ReadFile, JsonByNameOrByContent) {
  const Folder folder;
  for (const char* name : {"a.json", "a.toml", "a"}) {
    Diagnostics diagnostics;
    const Value v = read_file(folder.file(name, "\n {\"a\": 1}"), diagnostics);
    ASSERT_TRUE(diagnostics.empty()) << to_string(diagnostics[0]);
    EXPECT_EQ(v.find("a")->as_integer(), 1);
  }
}

TEST(ReadValue, TomlValuesAndBareWords) {
  Diagnostics diagnostics;
  EXPECT_EQ(read_value("0.25", "--set", diagnostics), Value(0.25));
  EXPECT_EQ(read_value("grey_wolf", "--set", diagnostics), Value("grey_wolf"));
  EXPECT_EQ(read_value("true", "--set", diagnostics), Value(true));
  EXPECT_EQ(read_value("{ min = 1, max = 2 }", "--set", diagnostics).find("max")->as_integer(), 2);
  EXPECT_TRUE(diagnostics.empty());
  EXPECT_TRUE(read_value("[1, 2", "--set", diagnostics).is_null());
  ASSERT_EQ(diagnostics.size(), 1u);
  EXPECT_THAT(to_string(diagnostics[0]), HasSubstr("--set: error: '[1, 2' is not a value"));
  read_value("1\nother = 2", "--set", diagnostics);
  EXPECT_EQ(diagnostics.size(), 2u);
}

TEST(ReadFile, AllExamplesAreReadable) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(LINKWRIGHT_SOURCE_DIR) / "examples/studies")) {
    if (entry.path().extension() != ".toml") continue;
    Diagnostics diagnostics;
    EXPECT_FALSE(read_file(entry.path(), diagnostics).is_null());
    for (const Diagnostic& d : diagnostics) ADD_FAILURE() << to_string(d);
    ++files;
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace linkwright::study
