// Reports as arris-cli writes them, read by a reader of tags of their own.

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/cli_fixture.h"

namespace arris {
namespace {

using namespace testing;

/// What of a page does not close again, or closes what was not open; empty where all does.
std::string unbalanced(const std::string& markup) {
  static const std::regex tag("<(/?)([a-zA-Z0-9]+)([^<>]*)>");
  std::vector<std::string> open;
  for (std::sregex_iterator at(markup.begin(), markup.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2], rest = (*at)[3];
    if (name == "meta" || name == "img" || name == "br" || (!rest.empty() && rest.back() == '/'))
      continue;
    if ((*at)[1].length() == 0) {
      open.push_back(name);
    } else {
      if (open.empty() || open.back() != name) return "</" + name + ">";
      open.pop_back();
    }
  }
  return open.empty() ? "" : "<" + open.back() + ">";
}

/// The cells of each row of the table after a heading.
std::vector<std::vector<std::string>> rows_after(const std::string& page,
                                                 const std::string& heading) {
  const std::size_t from = page.find("<h2>" + heading + "</h2>");
  if (from == std::string::npos) return {};
  const std::string table = page.substr(from, page.find("</table>", from) - from);
  static const std::regex row("<tr[^>]*>(.*?)</tr>"), cell("<td[^>]*>(.*?)</td>");
  std::vector<std::vector<std::string>> rows;
  for (std::sregex_iterator at(table.begin(), table.end(), row), end; at != end; ++at) {
    const std::string inside = (*at)[1];
    std::vector<std::string> cells;
    for (std::sregex_iterator c(inside.begin(), inside.end(), cell); c != end; ++c)
      cells.push_back((*c)[1]);
    if (!cells.empty()) rows.push_back(cells);
  }
  return rows;
}

/// The figure of this name on the page.
std::string figure(const std::string& page, const std::string& name) {
  std::smatch found;
  const std::regex value("<span class=\"value\">([^<]*)</span><br>" + name);
  return std::regex_search(page, found, value) ? found[1].str() : "";
}

/// A cylinder with two closed lines and three partitions, as a session.
class Reports : public Cli {
 protected:
  void SetUp() override {
    expect_done({"segment", write_mesh(folder, "part.ply", capped_cylinder(5.0, 12.0, 48, 24, 10)),
                 "-o", folder.file("results"), "--session", folder.file("part.arris"), "--unit",
                 "mm"});
  }
  std::string report(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"report", folder.file("part.arris"), "-o",
                                       folder.file("report")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return folder.read("report/report.html");
  }
};

TEST_F(Reports, TellWhatTheSummaryTells) {
  const std::string page = report();
  EXPECT_EQ(unbalanced(page), "");
  const json summary = json::parse(folder.read("results/summary.json"));
  EXPECT_EQ(figure(page, "sharp lines"), std::to_string(summary["lines"]["count"].get<int>()));
  EXPECT_EQ(figure(page, "partitions"), std::to_string(summary["partitions"]["count"].get<int>()));
  const auto lines = rows_after(page, "Sharp lines");
  ASSERT_EQ(lines.size(), 2u);
  for (const auto& row : lines) {  // kind, line, angle, length, closed
    ASSERT_EQ(row.size(), 5u);
    EXPECT_EQ(row[0], "convex");
    EXPECT_NEAR(std::stod(row[3]), 2.0 * 3.14159265 * 5.0, 0.1);
    EXPECT_EQ(row[4], "yes");
  }
  const auto partitions = rows_after(page, "Partitions");
  ASSERT_EQ(partitions.size(), 3u);
  std::multiset<std::string> types;
  for (const auto& row : partitions) types.insert(row[5]);
  EXPECT_EQ(types, (std::multiset<std::string>{"cylinder", "plane", "plane"}));
  const auto steps = rows_after(page, "Steps");
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_NE(steps[0][1].find("Method: Normal jump"), std::string::npos) << steps[0][1];
  EXPECT_EQ(steps[0][1].find("Candidates"), std::string::npos) << "the walk's alone";
  EXPECT_NE(steps[0][1].find(" mm"), std::string::npos) << "lengths have a unit";
  EXPECT_NE(steps[0][1].find("°"), std::string::npos);
  EXPECT_EQ(steps[0][2].rfind("2 lines, ", 0), 0u) << steps[0][2];
  EXPECT_EQ(steps[1][1].find("Intervals"), std::string::npos) << "the fronts' alone";
  EXPECT_EQ(steps[1][2].rfind("3 partitions, ", 0), 0u) << steps[1][2];
  EXPECT_NE(page.find("<th align=\"right\""), std::string::npos);
  EXPECT_NE(page.find("Length (mm)"), std::string::npos);
  EXPECT_NE(page.find("<li>Find sharp lines, "), std::string::npos);
  // Every picture that it names lies beside it, and is one.
  static const std::regex source("src=\"([^\"]+)\"");
  int pictures = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), source), end; at != end;
       ++at, ++pictures) {
    const std::string svg = folder.read("report/" + (*at)[1].str());
    EXPECT_EQ(svg.rfind("<svg ", 0), 0u) << (*at)[1];
    EXPECT_EQ(unbalanced(svg), "");
  }
  EXPECT_EQ(pictures, 2);
}

TEST_F(Reports, AreTheSameAgainAndMarkWhatChanged) {
  const std::string first = report();
  EXPECT_EQ(first.find("class=\"changed\""), std::string::npos);
  EXPECT_EQ(first.find("class=\"was\""), std::string::npos);
  const std::string again = report();
  EXPECT_EQ(again.find("class=\"changed\""), std::string::npos) << "nothing did";
  EXPECT_EQ(again.find("class=\"was\""), std::string::npos);
  // One line less: the other rows of lines are as they were, partitions are not.
  std::string operations = folder.read("results/operations.jsonl");
  folder.write("less.jsonl", operations + R"({"operation":"delete_lines","lines":[1]})" + "\n");
  const Outcome outcome = run({"report", folder.file("less.jsonl"), "-o", folder.file("report")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::string less = folder.read("report/report.html");
  EXPECT_EQ(figure(less, "sharp lines"), "1");
  EXPECT_NE(less.find("sharp lines<br><span class=\"was\">was 2</span>"), std::string::npos);
  const auto lines = rows_after(less, "Sharp lines");
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(less.find("<h2>Corrected by hand</h2>\n<ul>\n<li>Delete line 1</li>"),
            std::string::npos);
}

TEST_F(Reports, TakeTitleCompanyLogoAndAPageOfOnesOwn) {
  folder.write("logo.png", "not really a picture");
  folder.write("page.html",
               "<html><body><h1>{{title}}</h1>{{company}}{{logo}}{{lines}}</body></html>\n");
  const std::string page = report({"--title", "A <b> & \"c\"", "--company", "Moulds & Co", "--logo",
                                   folder.file("logo.png"), "--page", folder.file("page.html")});
  EXPECT_NE(page.find("<h1>A &lt;b&gt; &amp; &quot;c&quot;</h1>Moulds &amp; Co"),
            std::string::npos);
  EXPECT_NE(page.find("<img src=\"logo.png\""), std::string::npos);
  EXPECT_EQ(folder.read("report/logo.png"), "not really a picture");
  EXPECT_EQ(rows_after(page, "Sharp lines").size(), 2u);
  EXPECT_EQ(page.find("<h2>Partitions</h2>"), std::string::npos) << "its page has no place for it";
  EXPECT_EQ(unbalanced(page), "");
}

TEST_F(Reports, AreSetInTheirOwnPageAsWithoutOne) {
  const std::string usual = report();
  expect_done({"report-page", "-o", folder.file("page.html")});
  std::filesystem::remove_all(folder.file("report"));
  EXPECT_EQ(report({"--page", folder.file("page.html")}), usual);
}

TEST_F(Reports, SayWhatIsWrong) {
  folder.write("page.html", "<h1>{{tilte}}</h1>");
  expect_bad_input({"report", folder.file("part.arris"), "-o", folder.file("report"), "--page",
                    folder.file("page.html")},
                   "{{tilte}}");
  expect_bad_input({"report", folder.file("part.arris"), "-o", folder.file("report"), "--page",
                    folder.file("none.html")},
                   "none.html");
  expect_bad_input({"report", folder.file("part.arris"), "-o", folder.file("part.arris")},
                   "part.arris");
  folder.write("empty.jsonl", "");
  expect_bad_input({"report", folder.file("empty.jsonl"), "-o", folder.file("report")}, "");
  EXPECT_FALSE(std::filesystem::exists(folder.file("report/report.html")));
}

TEST_F(Reports, ALastStateThatIsNoneMarksNothing) {
  report();
  folder.write("report/report.json", R"({"figures": 3, "line": [1], "partition": {"1": 2}})");
  const std::string page = report();
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_EQ(rows_after(page, "Partitions").size(), 3u);
}

}  // namespace
}  // namespace arris
