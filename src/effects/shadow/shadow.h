// Sun visibility: shadow maps, single or cascaded, fitted to the view frustum and its casters, looked up per pixel
// (hard, PCF, PCSS).
// Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_SHADOW_H
#define REFLET_EFFECTS_SHADOW_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define SHADOW_FILTERS(OPTION)    \
    OPTION(ShadowFilter, none, 0) \
    OPTION(ShadowFilter, hard, 1) \
    OPTION(ShadowFilter, pcf, 2)  \
    OPTION(ShadowFilter, pcss, 3) \
    OPTION(ShadowFilter, traced, 4)
CHOICES(ShadowFilter, SHADOW_FILTERS)

#define SHADOW_BIASES(OPTION)    \
    OPTION(ShadowBias, slope, 0) \
    OPTION(ShadowBias, constant, 1)
CHOICES(ShadowBias, SHADOW_BIASES)

#define SHADOW_PATTERNS(OPTION)     \
    OPTION(ShadowPattern, vogel, 0) \
    OPTION(ShadowPattern, rings, 1)
CHOICES(ShadowPattern, SHADOW_PATTERNS)

#define SHADOW_UNITS(OPTION)      \
    OPTION(ShadowUnit, metres, 0) \
    OPTION(ShadowUnit, texels, 1)
CHOICES(ShadowUnit, SHADOW_UNITS)

#define SHADOW_SETTINGS(VALUE, SWITCH, CHOICE)                                                                         \
    CHOICE(ShadowFilter, filter, pcss,                                                                                 \
           "Shadow technique. none: no shadows. hard: one texel per pixel. pcf: percentage-closer filtering over a "   \
           "disk of fixed `radius`. pcss: PCSS, blocker search, then a disk sized by the light and the blockers' "     \
           "distance, so penumbras widen with height. traced: ray-traced shadows, `rays` per pixel, no shadow maps; "  \
           "all lamps cast.")                                                                                          \
    VALUE(uint, rays, 1, 1, 64,                                                                                        \
          "Shadow rays per pixel toward the sun, and as many toward lamps (traced). More: less noise, cost grows "     \
          "linearly.")                                                                                                 \
    VALUE(uint, resolution, 2048, 64, 8192,                                                                            \
          "Side of the sun's shadow map in texels, per cascade. More: sharper contact, more memory and time.")         \
    VALUE(float, extent, 0.0, 0.0, 10000.0,                                                                            \
          "Half the side of a fixed, single shadow map centred on the world origin, in metres; everything outside is " \
          "lit. 0: fit the map to the view.")                                                                          \
    CHOICE(ShadowBias, biasKind, slope,                                                                                \
           "How self-shadowing (shadow acne) is prevented. slope: receiver-plane bias, evaluated at the texel's "      \
           "centre, plus `bias`. constant: `constant_bias` alone.")                                                    \
    VALUE(float, bias, 0.4, 0.0, 16.0,                                                                                 \
          "Shadow bias in texels of the shadow map (slope). More: less acne, but shadows detach from their casters.")  \
    VALUE(float, constantBias, 0.01, 0.0, 10.0,                                                                        \
          "Shadow bias toward the sun in metres (constant). More: less acne, but shadows detach from their casters.")  \
    VALUE(float, radius, 0.05, 0.0, 100.0,                                                                             \
          "Radius of the filter disk in `radius_unit` (pcf). Larger: softer shadows, more noise.")                     \
    CHOICE(ShadowUnit, radiusUnit, metres, "Unit of `radius`: metres, or texels of the shadow map (pcf).")             \
    VALUE(uint, samples, 16, 1, 256,                                                                                   \
          "Shadow map samples per pixel in the filter disk (pcf, pcss). More: less noise in penumbras, cost grows "    \
          "linearly.")                                                                                                 \
    VALUE(uint, blockerSamples, 16, 1, 256,                                                                            \
          "Samples per pixel of the blocker search (pcss). More: steadier penumbra widths, cost grows linearly.")      \
    SWITCH(earlyOut, 1,                                                                                                \
           "Use a min/max pyramid of the shadow map to shrink the blocker search, and to skip it where a pixel is "    \
           "fully lit or fully shadowed (pcss). Faster.")                                                              \
    CHOICE(                                                                                                            \
        ShadowPattern, pattern, vogel,                                                                                 \
        "Sample pattern in the filter disk. vogel: a Vogel (golden angle) disk with uniform density, rotated per "     \
        "pixel by blue noise. rings: a spiral of `rings` turns, denser at the centre, rotated per pixel by a hash.")   \
    VALUE(float, rings, 10.0, 0.0, 100.0, "Turns of the spiral (pattern rings).")                                      \
    SWITCH(mirrored, 0, "Make every second sample the mirror image of the one before (pattern rings).")                \
    VALUE(uint, cascades, 0, 0, 4,                                                                                     \
          "Number of cascades of the sun's cascaded shadow map, for large scenes. 0: as many as needed for fine "      \
          "texels where surfaces are nearest; small scenes need one map. 1: a single map fitted to everything in "     \
          "view. More: finer shadows near the camera; each cascade is one more map to draw.")                          \
    VALUE(                                                                                                             \
        float, cascadeSplit, 1.0, 0.0, 1.0,                                                                            \
        "Distribution of cascade splits along the view: 0 uniform, 1 logarithmic (near cascades shorter and finer).")  \
    VALUE(float, cascadeBlend, 0.1, 0.0, 1.0,                                                                          \
          "Fraction of each cascade's depth range, at its far end, that is blended into the next. 0: visible seams.")  \
    VALUE(uint, lamps, 8, 0, 16,                                                                                       \
          "Maximum number of lamps with shadows, besides the sun; the strongest are chosen, the others shine through " \
          "geometry.")                                                                                                 \
    VALUE(                                                                                                             \
        uint, lampResolution, 512, 64, 4096,                                                                           \
        "Side of a lamp's shadow map in texels. A point lamp has six maps, a spot lamp one, a directional lamp four, " \
        "each half as wide as the one before. More: sharper shadows, more memory and time.")                           \
    SWITCH(                                                                                                            \
        denoise, 1,                                                                                                    \
        "Denoise penumbras over neighbouring pixels and frames (pcf, pcss). Removes the noise of low sample counts.")  \
    VALUE(uint, history, 0, 0, 1024,                                                                                   \
          "Maximum history length of shadow denoising, in frames. More: less noise, slower reaction to moving "        \
          "shadows. 0: no history. At rest histories grow beyond it.")
SETTINGS(ShadowSettings, SHADOW_SETTINGS)

// Shadow space: x, y in clip space of the map, z reversed depth (1 nearest to the sun), all of it linear.
struct ShadowMapParams {
    mat4 worldToShadow;
    vec3 toSun;        // world space, unit
    float texelSize;   // metres that a texel spans (the longer side)
    float depthRange;  // metres from depth 1 to depth 0
};

const uint maxCascades = 4;
const float nearestSplit = 0.005;  // start of the logarithmic split, relative to the farthest distance

// Cascade i is a tile of the shadow image, at column i % 2 and row i / 2, `resolution` texels a side.
struct SunShadowParams {
    ShadowMapParams maps[maxCascades];  // from near to far
    float ends[maxCascades];            // far end of each: metres in front of the camera
    float blends[maxCascades];          // start of its blend into the next
    uint count;
};

struct ShadowVisibilityParams {
    ViewParams view;
    SunShadowParams sun;
    ShadowSettings settings;
    float sunSlope;  // tangent of half the sun's angular diameter
};

// The range image, a min/max pyramid: levels 1 to shadowRangeLevels - 1 in the layout of effects/levels.h. A cell of
// level l spans 4 · 2^l texels of the map.
const uint shadowRangeLevels = 11;
const uint shadowRangeTexels = 4;

struct ShadowRangeParams {
    uvec2 size;  // of the map
    uint level;  // 1, 3, 5 …: makes this one and the next
};

SHARED_END

#ifdef __cplusplus

#include "effects/gbuffer/gbuffer.h"
#include "gpu/pass_list.h"

namespace reflet {

/// Result of the shadow map lookup.
struct SunVisibility {
    gpu::Image visibility;  ///< R8, 1: lit, as is the sky. 1 everywhere with filter none
    gpu::Image penumbra;    ///< RG16F: x: full penumbra width perpendicular to the sun's direction [m], 0 where the
                          ///< visibility is exact, negative (minus the upper bound) where no blocker was found; y: mean
                          ///< blocker distance toward the sun [m], 0 none or unknown. None with filter none or hard
    gpu::Image cascadeIndex;  ///< R8: cascade index / 3, fractional where two blend; none with one cascade
};

/// The sun's shadow maps.
struct ShadowMap {
    gpu::Image
        image;  ///< tiles of drawShadowMap, or a host's map: a 2D image, or a view of a 2D array, a layer a cascade
    bool ofHost = false;
    bool reversed = true;   ///< of a host's: 1 near the sun
    uint32_t cascades = 1;  ///< of a host's: layers

    /// Texels of all tiles.
    [[nodiscard]] uvec2 size() const {
        const bool layers = ofHost && cascades > 1;
        return layers ? image.size * uvec2(2, cascades > 2 ? 2 : 1) : image.size;
    }
    explicit operator bool() const { return static_cast<bool>(image); }
};

struct ShadowInputs {
    ShadowMap map;     ///< may be none
    gpu::Image range;  ///< from makeShadowRange; may be none
    gpu::BufferView blueNoise;
};

/// Size of the range image of a map.
uvec2 shadowRangeSize(uvec2 map);

/// Writes the range image (RG32F) of a map: the largest depth (nearest to the sun) and the smallest of each cell.
void makeShadowRange(gpu::PassList& f, const ShadowMap& map, gpu::Image range);

/// Binds a map, and tells the shader how to read it; shaders: by who has drawn it.
struct ShadowShaders {
    const char* own;
    const char* host;
    const char* layers;

    [[nodiscard]] const char* of(const ShadowMap& map) const {
        return !map.ofHost ? own : map.cascades > 1 ? layers : host;
    }
};
gpu::ComputePass& bindShadowMap(gpu::ComputePass& pass, const ShadowMap& map);

SunVisibility sunVisibility(gpu::PassList& f, const GBuffer& g, const ShadowInputs& in,
                            const ShadowVisibilityParams& params);

}  // namespace reflet
#endif

#endif
