#include "core/document/operation_manual.h"

#include <cctype>
#include <string>

#include "core/base/number_text.h"
#include "core/document/operation.h"

namespace arris {

namespace {

std::string value_in_words(const nlohmann::json& value) {
  if (value.is_number_float()) return number_text(value, 4);
  if (value.is_array() && value.empty()) return "none";
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// "A number from 0.1 to 179.9 (°); by default: from the noise of the scan."
std::string form_in_words(const Parameter& parameter) {
  std::string text = form_of(parameter);
  if (!parameter.unit.empty())
    text += parameter.unit == unit_of_part ? ", in the part's unit"
                                           : " (" + std::string(parameter.unit) + ")";
  if (!parameter.one_of.empty())
    text += "; one way to say " + std::string(parameter.one_of);
  else if (parameter.optional)
    text += "; may be left out";
  else if (!parameter.otherwise.there())
    text += "; must be given";
  else if (!parameter.otherwise.from().empty())
    text += "; by default: " + std::string(parameter.otherwise.from());
  else
    text += "; by default: " + value_in_words(parameter.otherwise.constant());
  if (!parameter.only_with.empty()) text += "; only with " + std::string(parameter.only_with);
  if (!parameter.method.empty()) text += "; counts with method " + std::string(parameter.method);
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text + ".";
}

}  // namespace

void add_operations(ManualPage& page) {
  for (const OperationKind& kind : operation_table()) {
    page.subsection(kind.name);
    page.paragraph(std::string(kind.title) + " (version " + std::to_string(kind.version) + "). " +
                   std::string(kind.help) +
                   (kind.parameters.empty() ? " It takes no parameter." : ""));
    std::string filled_in;
    for (const Parameter& parameter : kind.parameters) {
      if (!parameter.derived)
        page.entry(std::string(parameter.name), std::string(parameter.help) +
                                                    (parameter.help.ends_with('.') ? " " : ". ") +
                                                    form_in_words(parameter));
      for (const std::string_view name :
           {parameter.derived ? parameter.name : std::string_view(), parameter.anchors})
        if (!name.empty()) filled_in += (filled_in.empty() ? "" : ", ") + std::string(name);
    }
    if (!filled_in.empty())
      page.paragraph("Filled in when it is done, by which it is done again: " + filled_in + ".");
  }
}

}  // namespace arris
