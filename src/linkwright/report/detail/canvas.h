// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/report/drawing.h"
#include "linkwright/report/svg.h"

/// The sheet on which svg() and its arrows draw.
namespace linkwright::report {

inline constexpr std::string_view ink = "#1d2935";
inline constexpr std::string_view paper = "#ffffff";

/// World (m, y up) to picture (px, y down).
class Canvas {
 public:
  static constexpr double margin = 64;  ///< px: room for ground hatching, labels and axis numbers

  Canvas(const Box& box, const SvgOptions& options) {
    const double size = std::max({box.width(), box.height(), 1e-12});
    // A scene that is flat in one direction still needs some room in it.
    const double width = std::max(box.width(), 0.2 * size), height = std::max(box.height(), 0.2 * size);
    scale_ = std::min((options.width - 2 * margin) / width, (options.max_height - 2 * margin) / height);
    width_ = options.width;
    height_ = std::ceil(height * scale_ + 2 * margin);
    centre_x_ = (box.x_min + box.x_max) / 2;
    centre_y_ = (box.y_min + box.y_max) / 2;
  }
  /// One of several pictures of one scale.
  Canvas(const Box& box, double scale, double width, double height)
      : scale_(scale),
        width_(width),
        height_(height),
        centre_x_((box.x_min + box.x_max) / 2),
        centre_y_((box.y_min + box.y_max) / 2) {}
  double x(double world) const { return width_ / 2 + (world - centre_x_) * scale_; }
  double y(double world) const { return height_ / 2 - (world - centre_y_) * scale_; }
  double world_x(double pixel) const { return centre_x_ + (pixel - width_ / 2) / scale_; }
  double world_y(double pixel) const { return centre_y_ - (pixel - height_ / 2) / scale_; }
  double width() const { return width_; }
  double height() const { return height_; }
  double scale() const { return scale_; }
  /// Times the usual width: bars are thinner where they are short, so that chains of many can be
  /// distinguished.
  double thickness() const { return thickness_; }
  void fit_bars(double length, double most = 1) {
    thickness_ = most * std::clamp(length * scale_ / 40, 0.22, 1.0);
  }

 private:
  double scale_, width_, height_, centre_x_, centre_y_, thickness_ = 1;
};

template <class... Args>
void put(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

/// Path data of a line in the picture; places without coordinates interrupt it, and then it is not closed
/// either. Points that move it by less than can be seen are left out.
inline std::string path_data(const std::vector<Place>& line, bool closed) {
  constexpr double unseen = 0.1;  // px
  std::string path;
  bool whole = true;
  std::vector<Place> run;
  const auto flush = [&] {
    char command = 'M';
    for (const Place& p : simplified(run, unseen)) {
      put(path, "{}{:.2f} {:.2f}", command, p.x, p.y);
      command = 'L';
    }
    run.clear();
  };
  for (const Place& p : line) {
    if (p.finite()) {
      run.push_back(p);
      continue;
    }
    whole = false;
    flush();
  }
  flush();
  if (closed && whole && !path.empty()) path += 'Z';
  return path;
}

}  // namespace linkwright::report
