// The layers: core knows neither the window toolkit nor the renderer, nor the layers above it.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace arris {
namespace {

struct Include {
  std::filesystem::path file;
  std::size_t line;
  std::string header;
};

/// All #include lines below a folder of the repository.
std::vector<Include> includes_below(const std::string& folder) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           std::filesystem::path(ARRIS_SOURCE_DIR) / folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".h" && ending != ".cpp") continue;
    std::ifstream file(entry.path());
    std::string line;
    std::smatch match;
    for (std::size_t number = 1; std::getline(file, line); ++number)
      if (std::regex_search(line, match, pattern))
        includes.push_back({entry.path(), number, match[1]});
  }
  return includes;
}

void expect_none(const std::vector<Include>& includes, const std::regex& forbidden) {
  ASSERT_GT(includes.size(), 50u) << "the sources were not found";
  for (const Include& include : includes)
    EXPECT_FALSE(std::regex_search(include.header, forbidden))
        << include.file.string() << ":" << include.line << " includes " << include.header;
}

TEST(Architecture, CoreKnowsNeitherQtNorVtk) {
  expect_none(includes_below("core"), std::regex("^(Q[A-Z]|Qt|q[a-z]+\\.h$|vtk|VTK)"));
}

TEST(Architecture, CoreKnowsNothingAboveIt) {
  expect_none(includes_below("core"), std::regex("^(\\.\\./)*(ui|app|tests)/"));
}

TEST(Architecture, CoreNamesItsOwnHeadersFromTheRoot) {
  for (const Include& include : includes_below("core"))
    EXPECT_EQ(include.header.find(".."), std::string::npos)
        << include.file.string() << ":" << include.line;
}

}  // namespace
}  // namespace arris
