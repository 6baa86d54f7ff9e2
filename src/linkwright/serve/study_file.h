// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <mutex>
#include <string>
#include <string_view>

namespace linkwright::serve {

/// The study that the server was started with. Every text of it has a version, by which is seen whether
/// somebody else has changed the file.
class StudyFile {
 public:
  explicit StudyFile(std::filesystem::path file);

  /// Path of the file, through symbolic links.
  const std::filesystem::path& path() const { return path_; }

  struct Text {
    std::string text, version;
    std::string problem;  ///< says why there is no text; else empty
  };
  Text read() const;

  enum class Outcome { saved, changed, failed };
  struct Saved {
    Outcome outcome;
    std::string version;  ///< version of the file on the disk now; empty if saving failed
    std::string problem;  ///< error message; empty when saved
  };
  /// Writes the text, whole or not at all, if the file still has the version that it was made from.
  Saved save(std::string_view text, std::string_view version);

 private:
  std::filesystem::path path_;
  std::mutex saving_;
};

}  // namespace linkwright::serve
