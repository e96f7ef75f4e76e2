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
    /// The share of the light that has changed since the last call, 0 to 1, with its echoes in the frames after; 0 at
    /// the first one. What is lit by a lamp that moves by a metre or turns by ten degrees counts as changed, and by
    /// part of that as changed in part.
    float update(const LampBlock& lamps, const View& view);
    void forget() { *this = {}; }

private:
    struct Light {
        vec3 intensity;  ///< as of LampParams; of the sun: what a lamp would need that is as bright 5 m away
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
