// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/drawing/drawing.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <string>

#include "linkwright/core/numbers.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

/// Length and box of a line, in mm.
struct Extent {
  double length = 0, left = infinity, bottom = infinity, right = -infinity, top = -infinity;
};

Extent extent_of(const DrawnLine& line) {
  Extent out;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const std::complex<double> p = 1e3 * line.points[i];
    if (i > 0 || line.closed)
      out.length += std::abs(p - 1e3 * (i > 0 ? line.points[i - 1] : line.points.back()));
    out.left = std::min(out.left, p.real()), out.right = std::max(out.right, p.real());
    out.bottom = std::min(out.bottom, p.imag()), out.top = std::max(out.top, p.imag());
  }
  return out;
}

// The same texts are read by the workbench, whose test compares them with the same lengths and boxes.
TEST(Drawings, AreReadAsTheWorkbenchReadsThem) {
  for (const Value& c : linkwright::test::published_cases("drawings.json").as_array()) {
    const std::string id = c.find("id")->as_string();
    Diagnostics problems;
    const auto line = read_drawing(c.find("text")->as_string(), "drawing", problems);
    if (const Value* refused = c.find("diagnostic")) {
      ASSERT_FALSE(line) << id;
      ASSERT_EQ(problems.size(), 1U) << id;
      EXPECT_EQ(linkwright::to_string(problems[0]), refused->as_string()) << id;
      continue;
    }
    ASSERT_TRUE(line) << id << ": " << linkwright::to_string(problems.at(0));
    EXPECT_TRUE(problems.empty()) << id;
    EXPECT_EQ(line->closed, c.find("closed")->as_bool()) << id;
    EXPECT_EQ(line->has_unit, c.find("has_unit")->as_bool()) << id;
    const Extent extent = extent_of(*line);
    const auto box = linkwright::test::numbers(*c.find("box_mm")),
               first = linkwright::test::numbers(*c.find("first_mm"));
    const double scale = 1e-9 * (1 + std::abs(box[2]) + std::abs(box[3]));
    EXPECT_NEAR(extent.length, linkwright::test::number_at(c, "length_mm"), 4 * scale) << id;
    EXPECT_NEAR(extent.left, box[0], scale) << id;
    EXPECT_NEAR(extent.bottom, box[1], scale) << id;
    EXPECT_NEAR(extent.right - extent.left, box[2], scale) << id;
    EXPECT_NEAR(extent.top - extent.bottom, box[3], scale) << id;
    EXPECT_NEAR(1e3 * line->points[0].real(), first[0], scale) << id;
    EXPECT_NEAR(1e3 * line->points[0].imag(), first[1], scale) << id;
    for (std::size_t i = 1; i < line->points.size(); ++i)
      ASSERT_NE(line->points[i], line->points[i - 1]) << id << " at " << i;
  }
}

TEST(Drawings, AreKnownByTheirFirstCharacters) {
  EXPECT_EQ(drawing_format("\n <svg/>"), DrawingFormat::svg);
  EXPECT_EQ(drawing_format(" m-.5 0"), DrawingFormat::svg_path);
  EXPECT_EQ(drawing_format("  0\r\nSECTION\r\n"), DrawingFormat::dxf);
  EXPECT_EQ(drawing_format("0\rLINE\r"), DrawingFormat::dxf);
  EXPECT_EQ(drawing_format("999\nremark\n"), DrawingFormat::dxf);
  EXPECT_EQ(drawing_format("AutoCAD Binary DXF\r\n"), DrawingFormat::dxf);
  for (const char* table : {"", "x_mm,y_mm\n0,0\n", "0\n1\n", "0,0\nLINE\n", "mm\n0 0\n", "999", "M"})
    EXPECT_EQ(drawing_format(table), DrawingFormat::none) << table;
  Diagnostics problems;
  EXPECT_FALSE(read_drawing("x_mm,y_mm\n", "path.csv", problems));
  EXPECT_THAT(linkwright::to_string(problems.at(0)),
              HasSubstr("neither an SVG file nor an ASCII DXF drawing"));
}

/// The diagnostic of a text; "read" where there is none. It must come quickly.
std::string said_at_once(const std::string& text) {
  Diagnostics problems;
  const auto begin = std::chrono::steady_clock::now();
  const auto line = read_drawing(text, "drawing", problems);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20)) << text.substr(0, 80);
  EXPECT_NE(line.has_value(), has_errors(problems));
  return line ? "read" : linkwright::to_string(problems.at(0));
}

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int k = 0; k < times; ++k) out += text;
  return out;
}

// A text that takes time by its square would take minutes here.
TEST(Drawings, OfAnySizeAreReadOrRefusedAtOnce) {
  constexpr int many = 300'000;
  EXPECT_THAT(said_at_once(repeated("<g>", many)), HasSubstr("lies within more than 100000 elements"));
  EXPECT_THAT(said_at_once("<svg>" + repeated("<g a='1' ", many)), HasSubstr("is damaged"));
  EXPECT_THAT(said_at_once(repeated("<!--", many)), HasSubstr("is not closed"));
  EXPECT_THAT(said_at_once("<!DOCTYPE " + repeated("[", many)), HasSubstr("is not closed"));
  EXPECT_THAT(said_at_once("<svg " + repeated(" a=''", many) + "/>"), HasSubstr("draws none of"));
  EXPECT_THAT(said_at_once("<path d='" + repeated("&", many) + "'/>"), HasSubstr("the entity '&"));
  EXPECT_THAT(said_at_once("<g transform='" + repeated("scale(1)", many) + "'/>"),
              HasSubstr("draws none of"));
  EXPECT_THAT(said_at_once("<g style='" + repeated(";:", many) + "'/>"), HasSubstr("draws none of"));
  EXPECT_THAT(said_at_once("M0 0" + repeated("L", many)), HasSubstr("has no number"));
  EXPECT_THAT(said_at_once("M0 0" + repeated("9", many)), HasSubstr("too large"));
  EXPECT_EQ(said_at_once("M0 0" + repeated("c3 1 1 2 2 2", many)), "read");
  EXPECT_THAT(said_at_once("M0 0" + repeated("h1m1 1", many)), HasSubstr("300000 separate lines"));
  EXPECT_THAT(said_at_once("M0 0h1e9" + repeated("M5 5h1e-3", many)), HasSubstr("separate lines"));
  EXPECT_THAT(said_at_once("0\nSECTION\n" + repeated("0\nVERTEX\n", many)), HasSubstr("only VERTEX"));
  EXPECT_EQ(said_at_once("0\nPOLYLINE\n" +
                         repeated("0\nVERTEX\n10\n1\n20\n2\n0\nVERTEX\n10\n2\n20\n1\n", many / 2)),
            "read");
}

TEST(Drawings, RefuseNumbersThatCannotBeHeld) {
  EXPECT_THAT(said_at_once("M0 0L1e999 1"), HasSubstr("too large"));
  EXPECT_EQ(said_at_once("M0 0L1e-999 1"), "read");
  EXPECT_THAT(said_at_once("M-1e308 0L1e308 1"), HasSubstr("more than 1e9 m from the origin"));
  EXPECT_THAT(said_at_once("<path d='M0 0L1 1' transform='rotate(nan)'/>"), HasSubstr("is not a number"));
}

/// A DXF with a block "bar", a line of 30 mm along x with a circle of 2 mm at its base point, and entities.
std::string with_block(const std::string& entities, const std::string& more_blocks = "") {
  return "  0\nSECTION\n  2\nBLOCKS\n  0\nBLOCK\n  2\nbar\n 10\n10\n 20\n0\n"
         "  0\nLINE\n  8\n0\n 10\n10\n 20\n0\n 11\n40\n 21\n0\n"
         "  0\nCIRCLE\n  8\nground\n 10\n10\n 20\n0\n 40\n2\n  0\nENDBLK\n" +
         more_blocks + "  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n" + entities + "  0\nENDSEC\n  0\nEOF\n";
}

TEST(Drawings, BlocksAreReadWhereTheyAreInserted) {
  Diagnostics diagnostics;
  // Twice as large, turned by 90 degrees, with its base point at (100, 50).
  const auto turned = read_shapes(
      with_block("  0\nINSERT\n  8\nlinks\n  2\nbar\n 10\n100\n 20\n50\n 41\n2\n 42\n2\n 50\n90\n"), "d.dxf",
      diagnostics);
  ASSERT_TRUE(turned);
  ASSERT_EQ(turned->shapes.size(), 2U);
  EXPECT_EQ(turned->shapes[0].layer, "links");  // what lies on the layer 0 takes that of its INSERT
  EXPECT_NEAR(std::abs(turned->shapes[0].points[1] - std::complex<double>(0.1, 0.11)), 0, 1e-15);
  EXPECT_EQ(turned->shapes[1].layer, "ground");
  EXPECT_NEAR(turned->shapes[1].radius, 0.004, 1e-15);
  EXPECT_NEAR(std::abs(turned->shapes[1].centre - std::complex<double>(0.1, 0.05)), 0, 1e-15);
  // Three columns 50 mm apart, within another block; stretched circles are no circles.
  const std::string row =
      "  0\nBLOCK\n  2\nrow\n  0\nINSERT\n  2\nbar\n 10\n0\n 20\n0\n 42\n-2\n 70\n3\n 44\n50\n"
      "  0\nENDBLK\n";
  const auto copies =
      read_shapes(with_block("  0\nINSERT\n  2\nrow\n 10\n5\n 20\n0\n", row), "d.dxf", diagnostics);
  ASSERT_TRUE(copies);
  ASSERT_EQ(copies->shapes.size(), 6U);
  EXPECT_NEAR(std::abs(copies->shapes[4].points[0] - 0.105), 0, 1e-15);
  EXPECT_EQ(copies->shapes[5].radius, 0);
  EXPECT_TRUE(copies->shapes[5].closed);
  EXPECT_TRUE(diagnostics.empty());
}

TEST(Drawings, BlocksThatGrowBeyondBoundsAreRefused) {
  const auto problem = [](const std::string& entities, const std::string& blocks) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_shapes(with_block(entities, blocks), "d.dxf", diagnostics));
    return diagnostics.empty() ? std::string() : to_string(diagnostics.front());
  };
  const std::string itself = "  0\nBLOCK\n  2\nloop\n  0\nINSERT\n  2\nloop\n 10\n0\n 20\n0\n  0\nENDBLK\n";
  EXPECT_THAT(problem("  0\nINSERT\n  2\nloop\n 10\n0\n 20\n0\n", itself),
              testing::HasSubstr("more than 8 blocks lie within each other"));
  std::string powers;  // each has a thousand of the one before
  for (int i = 1; i < 5; ++i)
    powers += fmt::format(
        "  0\nBLOCK\n  2\nb{}\n  0\nINSERT\n  2\n{}\n 10\n0\n 20\n0\n 70\n1000\n 44\n1\n  0\nENDBLK\n", i,
        i == 1 ? "bar" : fmt::format("b{}", i - 1));
  EXPECT_THAT(problem("  0\nINSERT\n  2\nb4\n 10\n0\n 20\n0\n", powers),
              testing::HasSubstr("the blocks of the drawing draw more than 20000 lines"));
  EXPECT_THAT(problem("  0\nINSERT\n  2\nbar\n 10\n0\n 20\n0\n 41\n1e308\n 42\n1e308\n", ""),
              testing::HasSubstr("lies too far away to be drawn"));
}

}  // namespace
}  // namespace linkwright::planar
