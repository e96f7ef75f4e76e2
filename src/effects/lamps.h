// Parameters of the scene's lamps (point, spot, directional) for passes. Shared by C++ and GLSL.
#ifndef REFLET_EFFECTS_LAMPS_H
#define REFLET_EFFECTS_LAMPS_H

#include "base/shared.h"

SHARED_BEGIN

// About as many as fit into Vulkan's guaranteed uniform buffer size (16 KiB).
const uint maxLamps = 200;

const uint lampPoint = 0;
const uint lampSpot = 1;
const uint lampDirectional = 2;
const uint lampEmitter = 3;          // small emissive surfaces, seen from afar
const uint lampReflected = 4;        // the sun in a flat mirror, which lights what the mirror faces
const float roughestView = 0.5;      // smoother metals do not look to a ray as they look to the camera
const float smoothestMirror = 0.05;  // roughness of mirrors that do: rougher ones blur the light, and rays find it

// A reflected sun stands for so many metres per metre of its mirror's diagonal from it, for its shadow map.
const float reflectedSunFar = 150.0;

const uint noLampShadow = 0xFFFFFFFFu;

// KHR_lights_punctual. An emitter has other values in members that mean nothing to it: its radiant intensity in the
// direction w is that of `intensity` times max(dot(toLamp, w) + length(S * w), 0). It lights the diffuse lobe; smooth
// reflections show the surfaces themselves, rough ones a highlight (shaders/emitter_highlight.glsl).
// A reflected sun shines as a directional light through the rectangle of its mirror, of which `intensity` is what it
// sends: of the mirror's centre, position = centre + distance · toLamp. Packed by reflectedSuns.
struct LampParams {
    vec3 position;  // world space
    uint type;
    vec3 toLamp;         // unit, opposite to the light's direction of travel (spot, directional)
    float inverseRange;  // 1 / range; 0: infinite range. Emitter: minus what is added to squared distances [m²].
                         // Reflected: minus 1 / distance of `position` from the mirror's centre
    vec3 intensity;      // [W/sr]; directional: irradiance [W/m²]
    float spotScale;     // factor = clamp(cos · scale + offset, 0, 1)². Emitter: S.xx, S.yy as halfs. Reflected: half
                         // the mirror's sides along right and up of FlatPiece [m] as halfs
    float spotOffset;    // emitter: S.zz, S.xy. Reflected: the mirror's normal, packUnitVector
    float cosOuter;      // spot, reflected: cosine of the outer cone angle, beyond which it is dark. Emitter: S.xz,
                         // S.yz
    vec3 extent;   // emitter: covariance of its points over the square of `radius`: xx, yy, zz, xy, xz, yz as halfs
    float radius;  // of its disk, for soft shadows [m]; directional: tangent of half its angular diameter
    uint shadow;   // index among the shadow-casting lamps, or noLampShadow
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

#ifdef __cplusplus

#include <algorithm>

namespace reflet {

inline bool anyOfType(const LampBlock& block, uint32_t type) {
    return std::any_of(block.lamps, block.lamps + block.count,
                       [=](const LampParams& lamp) { return lamp.type == type; });
}

inline bool anyEmitters(const LampBlock& block) {
    return anyOfType(block, lampEmitter);
}
inline bool anyReflected(const LampBlock& block) {
    return anyOfType(block, lampReflected);
}

}  // namespace reflet
#endif

#endif
