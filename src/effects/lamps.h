// Parameters of the scene's lamps (point, spot, directional) for passes. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_LAMPS_H
#define REFLET_EFFECTS_LAMPS_H

#include "base/shared.h"

SHARED_BEGIN

// As many as fit into Vulkan's guaranteed uniform buffer size (16 KiB).
const uint maxLamps = 200;

const uint lampPoint = 0;
const uint lampSpot = 1;
const uint lampDirectional = 2;

const uint noLampShadow = 0xFFFFFFFFu;

// KHR_lights_punctual.
struct LampParams {
    vec3 position;  // world space
    uint type;
    vec3 toLamp;         // unit, opposite to the light's direction of travel (spot, directional)
    float inverseRange;  // 1 / range; 0: infinite range
    vec3 intensity;      // [W/sr]; directional: irradiance [W/m²]
    float spotScale;     // factor = clamp(cos · scale + offset, 0, 1)²
    float spotOffset;
    float cosOuter;  // spot: cosine of the outer cone angle, beyond which it is dark
    float radius;    // of its disk, for soft shadows [m]
    uint shadow;     // index among the shadow-casting lamps, or noLampShadow
};

struct LampBlock {
    uint count;
    LampParams lamps[maxLamps];
};

// Tiled light culling: a bit mask of the lamps that may light each screen tile, in RGBA32_UINT images with a texel per
// tile. Lamp i is bit i % 32 of component i / 32 % 4 of layer i / 128.
const uint lampTileShift = 4;
const uint lampTileSide = 1u << lampTileShift;  // pixels
const uint lampsPerLayer = 128;

SHARED_END

#endif
