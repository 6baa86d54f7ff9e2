// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/cli/program_fixture.h"

namespace linkwright::cli::test {

inline constexpr const char *four_bar = "analysis/planar.four_bar",
                            *path = "synthesis/planar.four_bar/path_points",
                            *linkage = "analysis/planar.linkage", *corner = "analysis/suspension.corner";

/// A passage of a template and what stands there instead; "a ... b" is all from a up to b.
struct Edit {
  std::string from, to;
};
struct Row {
  std::string mistake;
  const char* kind;  ///< the study is its template with these changes; none: only the files
  std::vector<Edit> edits;
  std::map<std::string, std::string> files;
  std::string message;
  std::vector<std::string> command = {"check", "s.toml"};
};

inline const std::string all_points = "points_mm = [ ... # or: points_file",
                         all_hard_points = "[mechanism.hard_points.points_mm] ... [mechanism.wheel]";
inline const std::string workbook("PK\x03\x04\x14\0\x06\0\x08\0", 10);

inline std::string listed(const std::string& unit) {
  return "[mechanism.hard_points]\nfile = \"points.txt\"\nunit = \"" + unit + "\"\n\n";
}
inline std::string hard_points() {
  return "lower_front 180.0 370.0 -110.0\n"
         "lower_rear -170.0 370.0 -100.0\n"
         "lower_ball 8.0 715.0 -130.0\n"
         "upper_front 120.0 440.0 165.0\n"
         "upper_rear -140.0 440.0 150.0\n"
         "upper_ball -22.0 665.0 215.0\n"
         "tie_inner -125.0 415.0 -47.0\n"
         "tie_outer -140.0 700.0 -42.0\n"
         "spring_top -10.0 500.0 330.0\n"
         "spring_bottom 0.0 570.0 -105.0\n"
         "wheel_centre 0.0 760.0 0.0\n";
}
/// Little-endian with its mark, as spreadsheets write "Unicode text"; of ASCII.
inline std::string utf16(std::string_view text) {
  std::string out = "\xFF\xFE";
  for (const char c : text) out += {c, '\0'};
  return out;
}
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t gap = from.find(" ... ");
  const std::size_t begin = text.find(from.substr(0, gap));
  EXPECT_NE(begin, std::string::npos) << from;
  if (begin == std::string::npos) return text;
  const std::size_t end =
      gap == std::string::npos ? begin + from.size() : text.find(from.substr(gap + 5), begin);
  return text.replace(begin, end - begin, to);
}

class Messages : public ProgramFixture {
 protected:
  Messages() : ProgramFixture(LINKWRIGHT_PROGRAM) {}

  void expect(const std::vector<Row>& rows) {
    for (const Row& row : rows) {
      SCOPED_TRACE(row.mistake);
      if (row.kind) {
        ASSERT_EQ(run({"new", row.kind, "-"}), 0);
        // Without the line for editors, which is not the user's.
        std::string study = out_.substr(out_.starts_with("#:schema") ? out_.find('\n') + 1 : 0);
        for (const Edit& edit : row.edits) study = replaced(std::move(study), edit.from, edit.to);
        write("s.toml", study);
      }
      for (const auto& [name, text] : row.files) write(name, text);
      const bool fails = row.message.find("error: ") != std::string::npos || row.command[0] != "check";
      EXPECT_EQ(run(row.command), fails ? 2 : 0);
      EXPECT_EQ(err_, row.message);
    }
  }
};

}  // namespace linkwright::cli::test
