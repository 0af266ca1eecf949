#include "core/document/scan_places.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "core/mesh/within_memory.h"

namespace arris {

namespace {

/// The last part of a path, whichever system wrote it.
std::string name_of_file(const std::string& path) {
  const std::size_t slash = path.find_last_of("/\\");
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

}  // namespace

ScanPlaces::ScanPlaces(std::string session, std::vector<std::string> located)
    : session_(std::move(session)), located_(std::move(located)) {}

Result<FileContent> ScanPlaces::find(const std::string& path, const std::string& hash,
                                     const Context& context) const {
  std::vector<std::string> places = located_;
  const std::string name = name_of_file(path);
  if (!name.empty() && name != "." && name != "..")
    places.push_back((std::filesystem::path(session_).parent_path() / name).string());
  if (std::ranges::find(places, path) == places.end()) places.push_back(path);

  std::string changed;  // one that is there, but is another file by now
  for (const std::string& place : places) {
    std::error_code ignored;  // what is not there, or may not be looked at, is no such place
    if (!std::filesystem::is_regular_file(place, ignored)) continue;
    Result<FileContent> content = within_memory(place, [&] { return read_file(place, context); });
    if (!content && content.error().cancelled) return content;
    if (content && hash_of_content(content->view()) == hash) return content;
    changed = place;
  }
  if (!changed.empty())
    return fail(changed + " is not the file that was opened then: its content has changed.");
  return fail(path + ": there is no such file, nor is " + name + " beside " + session_ + ".");
}

}  // namespace arris
