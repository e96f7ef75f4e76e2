// The lamps of a scene as passes see them. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_LAMPS_H
#define REFLET_RENDER_LAMPS_H

#include "base/shared.h"

SHARED_BEGIN

// As many as the smallest uniform buffer that Vulkan promises (16 KiB) holds.
const uint maxLamps = 200;

const uint lampPoint = 0;
const uint lampSpot = 1;
const uint lampDirectional = 2;

const uint noLampShadow = 0xFFFFFFFFu;

// KHR_lights_punctual.
struct LampParams {
    vec3 position;  // world space
    uint type;
    vec3 toLamp;         // unit, against the way the light travels (spot, directional)
    float inverseRange;  // 1 / range; 0: without end
    vec3 intensity;      // [W/sr]; directional: irradiance [W/m²]
    float spotScale;     // factor = clamp(cos · scale + offset, 0, 1)²
    float spotOffset;
    float cosOuter;  // spot: of the angle from the axis past which it is dark
    float radius;    // of its disk, which softens its shadow [m]
    uint shadow;     // index among the lamps that cast shadows, or noLampShadow
};

struct LampBlock {
    uint count;
    LampParams lamps[maxLamps];
};

// Which lamps may light which tile of the screen: a bit for each lamp, in RGBA32_UINT images with a texel for each
// tile. Lamp i is bit i % 32 of component i / 32 % 4 of layer i / 128.
const uint lampTileShift = 4;
const uint lampTileSide = 1u << lampTileShift;  // pixels
const uint lampsPerLayer = 128;

SHARED_END

#endif
