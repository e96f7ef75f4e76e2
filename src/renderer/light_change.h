// How much the lights have changed from one frame to the next.
#pragma once

#include "effects/lamps.h"
#include "scene/scene.h"

#include <optional>
#include <vector>

namespace reflet {

/// Remembers the lights of the last frame.
class LightChange {
public:
    /// The share of the light that has changed since the last call, 0 to 1, decaying over the frames after a change; 0
    /// at the first call. Light of a lamp that moves by a metre or turns by ten degrees counts as fully changed;
    /// smaller movements count proportionally.
    float update(const LampBlock& lamps, const View& view);
    void forget() { *this = {}; }

private:
    struct Light {
        vec3 intensity;  ///< as in LampParams; sun: intensity of a lamp with the same irradiance from 5 m away
        vec3 position;
        vec3 toLight;
    };
    struct Lights {
        std::vector<Light> all;
        Environment environment;
    };

    std::optional<Lights> last_;
    float echo_ = 0.0F;
};

}  // namespace reflet
