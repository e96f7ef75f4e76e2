// Import: turns a host's G-buffer and light, whatever their conventions, into the images that effects read. Values that
// are not finite become 0, and light is clamped, so that wrong values neither spread nor persist (bound_light.h).
// Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_IMPORT_H
#define REFLET_EFFECTS_IMPORT_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define INPUT_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    VALUE(float, maxRadiance, 10000.0, 0.01, 65504.0,                                                                 \
          "Maximum luminance of the radiance that the host gives: light, color, noisy lobes, not environments. What " \
          "is brighter keeps its hue. Images are half floats up to 65504, which sums must not reach: where what is "  \
          "lit is about 1, 10000 is 13 stops above it. Lower: fewer fireflies, less light of small bright emitters.")
SETTINGS(InputSettings, INPUT_SETTINGS)

const uint normalOctahedralSnorm = 0;
const uint normalOctahedralUnorm = 1;
const uint normalVectorSnorm = 2;
const uint normalVectorUnorm = 3;

const uint roughnessPerceptual = 0;
const uint roughnessAlpha = 1;
const uint roughnessSmoothness = 2;

struct ImportParams {
    ViewParams view;
    mat4 normalToWorld;  // rotation
    vec2 motionToUv;     // factor; 0: there is no motion image
    vec2 motionOffset;   // uv, added
    uint roughnessChannel;
    uint metallicChannel;
    uint excludedChannel;
    uint unlitChannel;
    uint reactiveChannel;
    // Of each image of a host, in the order of hostImage…: where the frame begins in it, x + 65536 y.
    uint origins[12];
};

const uint hostImageDepth = 0;
const uint hostImageNormal = 1;
const uint hostImageGeometricNormal = 2;
const uint hostImageRoughness = 3;
const uint hostImageMetallic = 4;
const uint hostImageBaseColor = 5;
const uint hostImageF0 = 6;
const uint hostImageMotion = 7;
const uint hostImageBackDepth = 8;
const uint hostImageExcluded = 9;
const uint hostImageUnlit = 10;
const uint hostImageReactive = 11;

struct ImportLightParams {
    uvec2 size;
    uvec2 origin;       // in the host's image
    float maxRadiance;  // luminance
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "effects/import/bound_light.h"
#include "gpu/pass_list.h"

namespace reflet {

/// A host's G-buffer and its conventions. Absent images have the defaults of reflet.h.
struct HostSurfaces {  // NOLINT(clang-analyzer-optin.performance.Padding): in the order of reflet.h
    gpu::Image depth;
    bool reversed = true;
    gpu::Image normal;           ///< none: toward the camera
    gpu::Image geometricNormal;  ///< none: from depth
    uint32_t normalKind = normalOctahedralSnorm;
    gpu::Image roughness;
    uint32_t roughnessChannel = 0;
    uint32_t roughnessKind = roughnessPerceptual;
    gpu::Image metallic;
    uint32_t metallicChannel = 0;
    gpu::Image baseColor;
    bool baseColorIsSrgb = false;
    gpu::Image f0;
    gpu::Image motion;
    gpu::Image backDepth;
    gpu::Image excluded;  ///< masks of reflet.h
    uint32_t excludedChannel = 0;
    gpu::Image unlit;
    uint32_t unlitChannel = 0;
    gpu::Image reactive;
    uint32_t reactiveChannel = 0;
};

struct ImportedSurfaces {
    GBuffer g;              ///< without emissive; depth is R32F
    gpu::Image backDepth;   ///< R32F, reversed; none if the host has none
    gpu::Image shownDepth;  ///< R32F, reversed: with what `g.depth` leaves out; none if the host excludes nothing
    gpu::Image reactive;    ///< R8; none if the host has none
};

/// params: without the channels and origins, which are set.
ImportedSurfaces importSurfaces(gpu::PassList& f, const HostSurfaces& host, ImportParams params);

struct LightImport {
    float maxRadiance = 65504.0F;  ///< luminance
    gpu::Image limits{};           ///< of LightBound; may be none
    bool keepAlpha = false;        ///< alpha: as given, else 1
    gpu::Image into{};             ///< where it is written; none: an image of this frame
};

/// RGBA16F of the same size: finite, 0 to 65504.
gpu::Image importLight(gpu::PassList& f, gpu::Image light, const LightImport& how = {});

}  // namespace reflet
#endif

#endif
