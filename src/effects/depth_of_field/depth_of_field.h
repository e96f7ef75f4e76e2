// Depth of field: the blur of a lens with an aperture, from a sharp picture and its depth. Shared by C++ and GLSL.
//
// The signed circle of confusion (its radius in pixels, positive behind the plane of focus) follows from depth by the
// thin-lens formula. The picture is split, at half resolution, into what is in front of the plane of focus (near) and
// the rest (background), each with the share of the pixel that it covers and with mips. Both are gathered apart: a
// sample counts where its own disk reaches the pixel, with a weight of one over its disk's area, so that light is kept.
// The background is composited by distance, so that sharp surfaces do not leak into blurred ones behind them; where the
// near layer hides it, it is inpainted from its surroundings. The near layer goes on top, with its coverage. Surfaces
// in focus keep their full resolution. Highlights, far brighter than their surroundings, are taken out of the layers
// and drawn as full-resolution disks. (J. Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare,
// SIGGRAPH 2014; G. Abadie, A Life of a Bokeh, SIGGRAPH 2018; S. Gortler et al., The Lumigraph, 1996: pull-push; M.
// Potmesil, I. Chakravarty, A Lens and Aperture Camera Model for Synthetic Image Generation, 1981)
#ifndef REFLET_EFFECTS_DEPTH_OF_FIELD_H
#define REFLET_EFFECTS_DEPTH_OF_FIELD_H

#include "base/shared.h"
#include "effects/view.h"

SHARED_BEGIN

#define DOF_SETTINGS(VALUE, SWITCH, CHOICE)                                                                           \
    SWITCH(enabled, 1,                                                                                                \
           "Depth of field (DoF, bokeh) of cameras with an aperture (view files: aperture_radius or f_number). Cost " \
           "only with such a camera.")                                                                                \
    VALUE(uint, samples, 48, 24, 150,                                                                                 \
          "Samples per pixel and layer of depth of field, at half the picture's size; at a quarter for large disks. " \
          "More: sharper edges of disks, cost grows linearly.")                                                       \
    SWITCH(reflections, 1,                                                                                            \
           "Blur reflections by the distance of what they show, where they are most of a pixel's light. Off: by the " \
           "distance of the surface.")                                                                                \
    VALUE(float, maxRadius, 0.05, 0.001, 0.25,                                                                        \
          "Largest circle of confusion: its radius as a share of the picture's height. Larger blur is cut to it. "    \
          "Larger: right for wide apertures, coarser disks with the same samples.")
SETTINGS(DofSettings, DOF_SETTINGS)

// Side of a tile, in half-resolution pixels; tiles tell how far the layers reach.
const uint dofTile = 8;

// Lists of tiles; each pass runs over those that need it. Added up where there are two of a kind.
const uint dofGather = 0;       // blurred tiles; + dofFront
const uint dofGatherLarge = 2;  // of these, tiles with large disks; + dofFront
const uint dofComposite = 4;    // tiles that change; + dofHighlights + dofSmall
const uint dofCopy = 8;         // all other tiles
const uint dofBright = 9;       // tiles with highlights of their own
const uint dofLists = 10;
const uint dofFront = 1;       // disks of the near layer reach the tile
const uint dofHighlights = 1;  // highlights reach it
const uint dofSmall = 2;       // disks that are drawn at full resolution may reach it

// Groups per row of the indirect dispatch over a list. The lists are one image, of 10125 rows for 7680x4320 pixels:
// images of 16384 are everywhere.
const uint dofListRow = 128;
// Tiles per group of dofGatherLarge; of the other lists 1.
const uint dofGroupTiles = 4;

// An indirect dispatch over a list, and its number of tiles.
struct DofListHead {
    uint groups[3];
    uint count;
};

// Levels of the half-resolution layers, with level 0.
const uint dofLevels = 5;

struct DofCocParams {
    vec4 depthToDistance;  // of the view
    vec4 lens;  // radius in pixels of the picture at infinity, 1 / focus distance, 1 if orthographic, largest radius
    uvec2 size;
    uint hasPrevious;  // 1: the history holds the last frame
};

struct DofSizes {
    uvec2 size;      // of the picture
    uvec2 half2;     // half of it, rounded up
    vec2 toDepth;    // pixels of the depth buffer per pixel of the picture
    uint level;      // of mips: to make
    uint block;      // pixels along the side of a block, 4, 8 or 16: each has at most one highlight
    float fullDisk;  // largest radius of disks that are drawn at full resolution [pixels of the picture]
    float disk;      // 1 over the area of the aperture's shape with radius 1
    float turn;      // of the aperture [rad]
    uint blades;     // of the aperture, if it is a polygon
};

struct DofGatherParams {
    uvec2 half2;
    uint samples;  // of a disk, at most
    float disk;    // as in DofSizes
    float turn;
    uint blades;
};

SHARED_END

#ifdef __cplusplus

#include "effects/reflected_images/reflected_images.h"
#include "gpu/pass_list.h"

#include <optional>

namespace reflet {

/// A thin lens. Blades: corners of the aperture, a regular polygon inside the circle of apertureRadius; below 3: round.
struct Lens {
    float apertureRadius = 0.0F;  ///< metres; 0: a pinhole, no blur
    float focusDistance = 1.0F;   ///< metres along the view axis, > 0
    uint32_t blades = 0;
    float bladeRotation = 0.0F;  ///< radians, counter-clockwise as the camera sees the disks of what is far
};

struct DofInputs {
    gpu::Image radiance;     ///< RGBA16F or RGBA32F, of the picture's size; alpha is kept
    gpu::Image depth;        ///< reversed, of this size or smaller (temporal upscaling)
    gpu::Image motion;       ///< of the depth's size, in uv, without jitter; none: depth has no jitter
    const ViewParams& view;  ///< of `depth`
    Lens lens;
    DofSettings settings;
    std::optional<Reflections> reflections{};  ///< none: reflections are blurred by their surface's distance
};

struct DofImages {
    gpu::Image radiance;  ///< RGBA16F of the picture's size; the input without an effect
    gpu::Image coc;  ///< R32F of the depth's size: signed radius in pixels of the picture, negative in front of the
                     ///< plane of focus; none without an effect
};

/// Whether the picture is blurred at all.
bool blurs(const Lens& lens, const DofSettings& settings);

/// own: the history of DofImages::coc.
DofImages depthOfField(gpu::PassList& f, gpu::HistoryImage& own, const DofInputs& in);

}  // namespace reflet
#endif

#endif
