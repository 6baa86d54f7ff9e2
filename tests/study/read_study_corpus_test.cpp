#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace linkwright::study {
namespace {
namespace fs = std::filesystem;

TEST(ReadStudyCorpus, EveryKeptInputIsSurvived) {
  int inputs = 0;
  for (const char* folder : {"fuzz/corpus/read_study", "examples/studies"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(LINKWRIGHT_SOURCE_DIR) / folder)) {
      std::ostringstream text;
      text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      const std::string bytes = text.str();
      SCOPED_TRACE(entry.path());
      EXPECT_EQ(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()), 0);
      ++inputs;
    }
  }
  EXPECT_GE(inputs, 20);
}

}  // namespace
}  // namespace linkwright::study
