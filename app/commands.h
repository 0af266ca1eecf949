#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/document/flow.h"
#include "core/document/operation.h"
#include "core/report/report.h"

/// What the commands of arris-cli do, each with its exit code: 0 done, 1 bad input. What goes wrong
/// is said on standard error.
namespace arris::commands {

inline constexpr int bad_input = 1;
inline constexpr int bad_usage = 2;

/// How a scan is opened.
struct Opening {
  std::string scan;
  bool weld = true;
  std::string unit;  ///< Empty: as the file says.

  std::vector<Operation> operations() const;
};

/// Where a run leaves what it found.
struct ResultPlaces {
  std::string folder;
  std::string session;  ///< *.arris; empty: none.
};

/// A session or list of operations, run again.
struct Replaying {
  std::string operations;
  std::string scan;     ///< Opened instead of the one it names; empty: that one.
  std::string version;  ///< By its name; empty: the last state.
  std::string unit;     ///< Empty: as it says.
};

int info(const Opening& opening, bool as_json);
int curvature(const Opening& opening, const std::string& output);
int simplify(const Opening& opening, const std::string& output, const nlohmann::json& parameters);
/// From one scan to its partitions.
int segment(const Opening& opening, const ResultPlaces& places, Flow flow,
            const StepParameters& wanted);
int replay(const Replaying& replaying, const ResultPlaces& places);
int export_one(const Replaying& replaying, const std::string& what, const std::string& output);
int report(const Replaying& replaying, ReportRequest request);
int report_page(const std::string& output);
int compare(const std::string& operations, const std::array<std::string, 2>& versions,
            bool as_json);
int sample(const std::string& output);
int schema();
int thumbnail(const std::string& session, const std::string& output);

/// The names of what can be exported, each once, or the endings of one of them.
std::string exports_text(const std::string& what);

}  // namespace arris::commands
