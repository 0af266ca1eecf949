#pragma once

#include <string>
#include <vector>

#include "core/base/file_source.h"

namespace arris {

/// Where a session finds scans that it names but does not hold: among the files that the user
/// pointed at, beside itself, then where they were. A file is taken only where its content is what
/// was opened then.
class ScanPlaces : public FileSource {
 public:
  /// `session`: the file of the session, beside which is looked; `located`: files pointed at.
  explicit ScanPlaces(std::string session, std::vector<std::string> located = {});
  Result<FileContent> find(const std::string& path, const std::string& hash,
                           const Context& context) const override;

 private:
  std::string session_;
  std::vector<std::string> located_;
};

}  // namespace arris
