#pragma once

#include <string>
#include <vector>

#include "core/base/context.h"
#include "core/base/result.h"
#include "core/document/history.h"

namespace arris {

/// A picture that lies beside the report.
struct ReportPicture {
  std::string file;
  std::string caption;
  double proportion = 1.6;  ///< Of width to height.
};

struct ReportOptions {
  std::string title;                    // the name of the part
  std::string date;                     // as it is to be read; empty: none
  std::string company;                  // who reports; empty: nobody is named
  std::string logo;                     // a picture beside the report; empty: none
  std::string program;                  // "Arris 0.2.0"
  std::vector<ReportPicture> pictures;  // in their order
  std::string page;    // a page of one's own with places as {{title}}; empty: report_page()
  std::string before;  // report_state of the last report of this part; empty: it is the first
};

/// A report and what belongs beside it, each with its file name: the page itself, its histograms,
/// and the state by which the next one knows what changed.
struct ReportFile {
  std::string name, content;
};

constexpr const char* report_name = "report.html";
constexpr const char* report_state = "report.json";

/// The page that reports are made with: HTML with places for what a report tells, {{title}},
/// {{date}}, {{company}}, {{logo}}, {{program}}, {{style}} and its sections. A company changes a
/// copy of it.
std::string report_page();

/// What a person would tell of a part that was segmented: figures, pictures, how the scan came, the
/// steps with their parameters, distributions with the thresholds, tables of lines, partitions and
/// boundaries, what was corrected by hand, what is left to do, versions beside this one, and the
/// operations. What changed since the report before is marked. Plain enough HTML for text editors
/// and for paper. Errors: no part is open, a page with a place that there is nothing for;
/// cancelled.
Result<std::vector<ReportFile>> make_report(const History& history, const ReportOptions& options,
                                            const Context& context = {});

/// A report as files: where it goes and what it is made with.
struct ReportRequest {
  std::string folder;     // made where it is not there; a report in it is the one before
  ReportOptions options;  // page, logo and before are not read
  std::string page;       // file of a page of one's own; empty: report_page()
  std::string logo;       // file of a picture, copied beside the report; empty: none
};

/// Makes a report and writes it. Errors: those of make_report(), a file that cannot be read or
/// written.
Result<void> write_report(const History& history, ReportRequest request,
                          const Context& context = {});

/// Of the computer's clock, "2026-11-28".
std::string today();

}  // namespace arris
