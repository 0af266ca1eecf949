#include "core/curvature_smoothing/smooth_curvature.h"
#include "core/base/words.h"

#include "core/document/operations/operations.h"
#include "core/document/operations/stages.h"

namespace arris {

namespace {

Result<Document> apply_smooth(const Document& document, const nlohmann::json& parameters,
                              const Context& context) {
  SmoothCurvatureOptions options;
  options.passes = parameters.at("passes");
  Result<CurvaturesPtr> smoothed =
      smooth_curvatures(*document.mesh, *document.curvatures, document.lines, options, context);
  if (!smoothed) return tl::unexpected<Error>(smoothed.error());
  Document result = document;
  result.smoothed = std::move(*smoothed);
  result.step("smooth_curvature") = Step{parameters, false};
  outdate_after(result, "smooth_curvature");
  return result;
}

std::string words_of_smooth(const nlohmann::json& parameters) {
  if (!parameters.contains("passes")) return "Smooth curvature";
  return "Smooth curvature, " + counted(parameters.value("passes", 0), "pass", "passes");
}

std::string outcome_of_smooth(const Document& document) {
  return counted(document.step("smooth_curvature")->parameters.value("passes", 0), "pass",
                 "passes");
}

}  // namespace

std::vector<OperationKind> smooth_curvature_rows() {
  return {{.name = "smooth_curvature",
           .title = "Smooth curvature",
           .help = "Averages curvature over neighbours, never across a line (section 4.4).",
           .parameters = {{.name = "passes",
                           .kind = ParameterKind::whole,
                           .label = "Passes",
                           .help = "Passes of eq. 20 over the whole part.",
                           .unit = "passes",
                           .least = 1,
                           .most = 100,
                           .otherwise = SmoothCurvatureOptions().passes,
                           .option = "smooth"}},
           .apply = apply_smooth,
           .words = words_of_smooth,
           .outcome = outcome_of_smooth}};
}

}  // namespace arris
