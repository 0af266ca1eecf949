#pragma once

#include <string>
#include <utility>
#include <vector>

/// Compressed files, made in memory.
namespace arris::testing {

std::string gzipped(const std::string& content);
/// A ZIP archive of files with these names and contents.
std::string zipped(const std::vector<std::pair<std::string, std::string>>& files);
/// The XML of a 3MF model; `attributes` of its root ("unit=\"inch\""), what stands in its resources
/// and in its build.
std::string model_3mf(const std::string& attributes, const std::string& resources,
                      const std::string& build);

}  // namespace arris::testing
