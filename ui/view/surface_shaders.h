#pragma once

/// What Scene puts into the shaders that VTK writes for surfaces. "//VTK::…" stands for VTK's own
/// code at that place.
namespace arris::ui {

/// Normals of the vertices make a scan look smooth, those of the faces keep its sharp lines crisp
/// and flat sides flat: where the two differ much the face's is taken. The length of a vertex's
/// normal tells how much they do about it, so that a side whose corners are all sharp is even.
inline constexpr const char* normal_code = R"(
  float creased = length(normalVCVSOutput);
  //VTK::Normal::Impl
  float cutRim = clamp(fwidth(beyondVS), 1e-30, cutMost);  // thin on walls seen edge-on
  vec3 faceNormal = normalize(cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz)));
  if (faceNormal.z < 0.0) faceNormal = -faceNormal;
  float agreement = min(creased, dot(faceNormal, normalVCVSOutput));
  normalVCVSOutput = normalize(mix(faceNormal, normalVCVSOutput,
                                   smoothShare * smoothstep(0.80, 0.94, agreement)));
)";

/// Shades without ever changing a hue, and full colour where the surface faces the viewer; without
/// light colours on the part are those of the scalar bar everywhere. The back of the part is a dull
/// grey.
inline constexpr const char* light_code = R"(
  if (beyondVS > 0.0) discard;
  float key = max(dot(normalVCVSOutput, vec3(-0.38, 0.48, 0.79)), 0.0);
  float fill = max(dot(normalVCVSOutput, vec3(0.62, -0.30, 0.72)), 0.0);
  float head = max(normalVCVSOutput.z, 0.0);
  float bare = 0.30 + 0.52 * key + 0.18 * fill + 0.12 * head;
  float coloured = min(0.32 + 0.30 * key + 0.12 * fill + 0.3566 * head, 1.0);
  vec3 shaded = diffuseColor * mix(bare, coloured, colourShare);
  shaded += (1.0 - colourShare) * 0.10 * pow(key, 24.0);
  shaded = mix(diffuseColor, shaded, lightShare);
  if (!gl_FrontFacing) shaded = vec3(0.47, 0.48, 0.52) * (0.35 + 0.65 * head);
  gl_FragData[0] = vec4(shaded, opacity);
)";

/// Texels of undefined values are marked by their alpha. They are hatched and never lit: neither a
/// colour of the map nor its shade looks like that. Then a double rim shows where a section cuts,
/// whatever the colours there. Both come last: VTK lays textures over what is lit.
inline constexpr const char* rim_code = R"(
  //VTK::TCoord::Impl
  if (gl_FragData[0].a < 0.75 * opacity) {
    float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / hatchPeriod);
    vec3 ink = gl_FrontFacing ? undefinedColour : 0.7 * undefinedColour;
    gl_FragData[0] = vec4(stripe < 0.5 ? ink : mix(ink, vec3(1.0), 0.55), opacity);
  }
  float fromCut = -beyondVS / cutRim - cutRimWidth;
  vec3 rimmed = mix(vec3(1.0), gl_FragData[0].rgb,
                    smoothstep(cutRimWidth, cutRimWidth + 0.8, fromCut));
  gl_FragData[0].rgb = mix(vec3(0.06, 0.07, 0.10), rimmed, smoothstep(0.0, 0.8, fromCut));
)";

/// As VTK declares them, but taken within the triangle where only a part of a pixel is covered:
/// values at the end of a scale must not spill over to the colour beyond it.
inline constexpr const char* vertex_place_code =
    "in vec2 tcoord; centroid out vec2 tcoordVCVSOutput;";
inline constexpr const char* fragment_place_code = "centroid in vec2 tcoordVCVSOutput;";

inline constexpr const char* place_code = R"(
  //VTK::PositionVC::Impl
  gl_Position.z -= lift;
  beyondVS = dot(sectionPlane.xyz, vertexMC.xyz) - sectionPlane.w;
)";

}  // namespace arris::ui
