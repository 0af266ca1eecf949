#include "core/curvature_smoothing/smooth_curvature.h"
#include "core/base/words.h"

#include "core/document/operations/chain.h"
#include "core/document/operations/operations.h"

namespace arris {

namespace {

Result<nlohmann::json> resolve_smooth(const Document&, const nlohmann::json& given) {
  ParameterReader reader("smooth_curvature", given);
  reader.whole("passes", SmoothCurvatureOptions().passes, 1, 100);
  return reader.finish();
}

Result<Document> apply_smooth(const Document& document, const nlohmann::json& parameters,
                              const Context& context) {
  SmoothCurvatureOptions options;
  options.passes = parameters.at("passes");
  Result<CurvaturesPtr> smoothed =
      smooth_curvatures(*document.mesh, *document.curvatures, document.lines, options, context);
  if (!smoothed) return tl::unexpected<Error>(smoothed.error());
  Document result = document;
  result.smoothed = std::move(*smoothed);
  result.smooth_curvature = Step{parameters, false};
  outdate_after(result, "smooth_curvature");
  return result;
}

std::string words_of_smooth(const nlohmann::json& parameters) {
  if (!parameters.contains("passes")) return "Smooth curvature";
  return "Smooth curvature, " + counted(parameters.value("passes", 0), "pass", "passes");
}

}  // namespace

const OperationKind smooth_curvature_operation{
    "smooth_curvature", "Smooth curvature", 1, resolve_smooth, apply_smooth, words_of_smooth};

}  // namespace arris
