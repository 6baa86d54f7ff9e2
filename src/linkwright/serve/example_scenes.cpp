// SPDX-License-Identifier: BSD-3-Clause

// Writes what the page draws of the examples before it has an engine: a document of app::example_scene() a
//   line. example_scenes FOLDER    where the files go that examples read
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "linkwright/app/example_scene.h"
#include "linkwright/study/write.h"

int main(int count, char** words) {
  using namespace linkwright;
  if (count != 2) return 2;
  try {
    for (const app::Example& example : app::examples())
      fmt::print("{}\n", study::to_json(app::example_scene(example, words[1])));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
