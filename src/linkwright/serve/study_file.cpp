// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/study_file.h"

#include <fmt/core.h>

#include <system_error>
#include <utility>

#include "linkwright/app/sha256.h"
#include "linkwright/app/write_whole.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/report/markup.h"
#include "linkwright/study/study.h"

namespace linkwright::serve {
namespace fs = std::filesystem;

StudyFile::StudyFile(fs::path file) : path_(std::move(file)) {
  // A link is to stay one when the file is replaced.
  std::error_code error;
  if (const fs::path real = fs::canonical(path_, error); !error) path_ = real;
  app::remove_leftovers(path_);
}

StudyFile::Text StudyFile::read() const {
  Diagnostics diagnostics;
  Text read;
  // A pipe that the shell gives can be read once, and not be saved to.
  if (std::error_code error; fs::exists(path_, error) && !fs::is_regular_file(path_, error))
    return {{}, {}, "is not a plain file"};
  read.text = study::load_file(path_, diagnostics);
  if (has_errors(diagnostics))
    read.problem = to_string(diagnostics.front().message);
  else if (report::valid_utf8(read.text) != read.text)
    read.problem = "is not UTF-8; convert it before it is edited here";
  if (!read.problem.empty()) return {{}, {}, read.problem};
  read.version = app::sha256(read.text);
  return read;
}

StudyFile::Saved StudyFile::save(std::string_view text, std::string_view version) {
  const std::lock_guard lock(saving_);
  const Text now = read();
  if (!now.problem.empty() || now.version != version)
    return {Outcome::changed, now.version, "was changed by another program since it was opened here"};
  if (const std::string problem = app::write_whole(path_, text); !problem.empty())
    return {Outcome::failed, {}, "cannot be written: " + problem};
  return {Outcome::saved, app::sha256(text), {}};
}

}  // namespace linkwright::serve
