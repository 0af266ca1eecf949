#include "core/base/manual_page.h"

#include <algorithm>

namespace arris {

namespace {

std::string escaped(std::string_view text) {
  std::string result;
  bool line_starts = true;
  for (const char c : text) {
    if (line_starts && (c == '.' || c == '\'')) result += "\\&";
    line_starts = c == '\n';
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;  // as typed, not a hyphen of a word
      case '\'':
        result += "\\(aq";
        break;
      case '"':
        result += "\\(dq";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// As an argument of a request: one line, in quotes.
std::string argument(std::string_view text) {
  std::string line = escaped(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return '"' + line + '"';
}

}  // namespace

ManualPage::ManualPage(std::string_view program, std::string_view version,
                       std::string_view summary) {
  std::string title(program);
  std::transform(title.begin(), title.end(), title.begin(),
                 [](char c) { return c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c; });
  // No date: the same program makes the same page.
  text_ = ".TH " + argument(title) + " 1 \"\" " + argument("Arris " + std::string(version)) + " " +
          argument("User Commands") + "\n.SH NAME\n" + escaped(program) + " \\- " +
          escaped(summary) + "\n";
}

void ManualPage::section(std::string_view title) { text_ += ".SH " + argument(title) + "\n"; }

void ManualPage::subsection(std::string_view title) { text_ += ".SS " + argument(title) + "\n"; }

void ManualPage::paragraph(std::string_view text) {
  text_ += ".PP\n";
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    if (start > 0) text_ += ".br\n";
    if (end > start) text_ += escaped(text.substr(start, end - start)) + "\n";
    start = end + 1;
  }
}

void ManualPage::example(std::string_view command) {
  text_ += ".PP\n.B " + argument(command) + "\n";
}

void ManualPage::entry(std::string_view name, std::string_view text) {
  text_ += ".TP\n.B " + argument(name) + "\n" + escaped(text.empty() ? " " : text) + "\n";
}

}  // namespace arris
