// The layers: core knows neither the window toolkit nor the renderer, nor the layers above it.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
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

/// Shows each line of the sources and headers below a folder of the repository: visit(file, number,
/// line).
template <class Visit>
void for_each_line(const std::string& folder, const Visit& visit) {
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           std::filesystem::path(ARRIS_SOURCE_DIR) / folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".h" && ending != ".cpp") continue;
    std::ifstream file(entry.path());
    std::string line;
    for (std::size_t number = 1; std::getline(file, line); ++number)
      visit(entry.path(), number, line);
  }
}

/// All #include lines below a folder of the repository.
std::vector<Include> includes_below(const std::string& folder) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  for_each_line(folder, [&](const auto& file, std::size_t number, const std::string& line) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) includes.push_back({file, number, match[1]});
  });
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

// What an operating system is asked has its place in core/base, so that another one is told there.
TEST(Architecture, OnlyBaseAsksTheOperatingSystem) {
  static const std::regex system(
      R"(^(sys/.*|arpa/.*|netinet/.*|(unistd|fcntl|dlfcn|dirent|pthread|poll|pwd|sched|termios|io|)"
      R"(direct|process|[Ww]indows)\.h)$)");
  for (const char* folder : {"core", "ui", "app"})
    for (const Include& include : includes_below(folder))
      EXPECT_TRUE(include.file.parent_path().filename() == "base" ||
                  !std::regex_match(include.header, system))
          << include.file.string() << ":" << include.line << " includes " << include.header;
}

/// Whether `order` holds all folders below `top`, and none of them includes a later one.
void expect_order(const std::string& top, const std::vector<std::string>& order) {
  const auto place_of = [&](const std::string& folder) {
    return static_cast<std::size_t>(std::ranges::find(order, folder) - order.begin());
  };
  const std::filesystem::path root = std::filesystem::path(ARRIS_SOURCE_DIR) / top;
  const std::regex pattern("^" + top + "/([a-z_]+)/");
  for (const Include& include : includes_below(top)) {
    const std::string folder = std::filesystem::relative(include.file, root).begin()->string();
    ASSERT_LT(place_of(folder), order.size()) << folder << " has no place in the order";
    std::smatch match;
    if (!std::regex_search(include.header, match, pattern)) continue;
    EXPECT_LE(place_of(match[1]), place_of(folder))
        << include.file.string() << ":" << include.line << " includes " << include.header;
  }
}

const std::vector<std::string> core_order{
    "base",        "mesh",           "samples",       "curvature",
    "sharp_lines", "simplification", "edge_swapping", "curvature_smoothing",
    "partitions",  "document",       "guidance",      "report"};

TEST(Architecture, FoldersOfCoreKnowOnlyThoseBeforeThem) { expect_order("core", core_order); }

TEST(Architecture, FoldersOfTheWindowKnowOnlyThoseBeforeThem) {
  expect_order("ui", {"view", "panels", "window"});
}

/// Types that are defined for the whole program: outside other types and unnamed namespaces.
std::map<std::string, std::vector<std::string>> places_of_types(
    const std::vector<std::string>& folders) {
  static const std::regex pattern(R"(^(class|struct|enum class) (\w+)( final)?( :[^:].*| \{.*)$)");
  std::map<std::string, std::vector<std::string>> places;
  bool unnamed = false;
  for (const std::string& folder : folders)
    for_each_line(folder, [&](const auto& file, std::size_t number, const std::string& line) {
      if (number == 1 || line == "}  // namespace") unnamed = false;
      if (line == "namespace {") unnamed = true;
      std::smatch match;
      if (!unnamed && std::regex_match(line, match, pattern))
        places[match[2]].push_back(file.string() + ":" + std::to_string(number));
    });
  return places;
}

// Two types of one name in one namespace make a program that no compiler has to refuse; in two
// namespaces, one of which is inside the other, they mislead.
TEST(Architecture, NoTwoTypesHaveOneName) {
  const auto places = places_of_types({"core", "ui"});
  ASSERT_GT(places.size(), 150u) << "the types were not found";
  for (const auto& [name, where] : places) {
    std::string all;
    for (const std::string& place : where) all += place + "\n";
    EXPECT_EQ(where.size(), 1u) << name << " is defined in\n" << all;
  }
}

/// Names of the free functions that the headers below a folder declare.
std::map<std::string, std::string> functions_below(const std::string& folder) {
  static const std::regex pattern(
      R"re(^(?!return |using |template|class |struct |enum |namespace|friend |#|/|\}))re"
      R"re([\w:<>,&* ]+[ &*](\w+)\(.*$)re");
  std::map<std::string, std::string> places;
  for_each_line(folder, [&](const auto& file, std::size_t, const std::string& line) {
    std::smatch match;
    if (file.extension() == ".h" && !line.starts_with(' ') &&
        std::regex_match(line, match, pattern))
      places[match[1]] = file.string();
  });
  return places;
}

// A function of the window would hide one of the core without a word.
TEST(Architecture, TheWindowHidesNoFunctionOfTheCore) {
  const auto core = functions_below("core"), ui = functions_below("ui");
  ASSERT_GT(core.size(), 100u) << "the functions were not found";
  ASSERT_GT(ui.size(), 20u) << "the functions were not found";
  for (const auto& [name, where] : ui)
    EXPECT_FALSE(core.contains(name))
        << name << "() is declared in " << where << " and in " << core.at(name);
}

TEST(Architecture, CoreNamesItsOwnHeadersFromTheRoot) {
  for (const Include& include : includes_below("core"))
    EXPECT_EQ(include.header.find(".."), std::string::npos)
        << include.file.string() << ":" << include.line;
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(std::filesystem::path(ARRIS_SOURCE_DIR) / file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What a newcomer is told to open is there.
TEST(Architecture, ReadmeAndContributingNameFilesThatAreThere) {
  static const std::regex named("`((core|ui|app|tests|resources)/[A-Za-z0-9_/.*]+)`");
  for (const char* file : {"README.md", ".github/CONTRIBUTING.md"}) {
    const std::string text = content_of(file);
    std::size_t checked = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it) {
      const std::string path = (*it)[1];
      if (path.find('*') != std::string::npos) continue;
      const auto full = std::filesystem::path(ARRIS_SOURCE_DIR) / path;
      // A source file may be named without its ending.
      EXPECT_TRUE(std::filesystem::exists(full) || std::filesystem::exists(full.string() + ".cpp"))
          << file << ": " << path;
      ++checked;
    }
    EXPECT_GT(checked, 10u) << file;
  }
}

TEST(Architecture, ReadmeTellsTheOrderOfFoldersThatHolds) {
  std::string order;
  for (const std::string& folder : core_order) order += (order.empty() ? "" : ", ") + folder;
  EXPECT_NE(content_of("README.md").find("includes only those before it: " + order),
            std::string::npos)
      << order;
}

}  // namespace
}  // namespace arris
