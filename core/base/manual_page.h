#pragma once

#include <string>
#include <string_view>

namespace arris {

/// A page for man(1), written from top to bottom. Texts are plain: whatever means something to the
/// formatter is escaped.
class ManualPage {
 public:
  /// Of a program: "arris-cli", "0.1.0", "sharp lines and partitions of scanned moulds".
  ManualPage(std::string_view program, std::string_view version, std::string_view summary);

  void section(std::string_view title);     ///< "OPTIONS"
  void subsection(std::string_view title);  ///< "segment"
  void paragraph(std::string_view text);    ///< Its line breaks stay.
  /// A command as it is typed.
  void example(std::string_view command);
  /// Something with its explanation under it: "--unit U".
  void entry(std::string_view name, std::string_view text);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace arris
