// Pre-exposure: the power of two by which all radiance is multiplied inside the renderer.
//
// Half floats hold radiance from about 1e-4, below which precision is lost, to 65504; suns in lux and lamps in candela
// exceed that. So lights and emission are multiplied where they enter the frame, and the factor is undone where light
// leaves it: in shows, in the metered exposure and in the displayed one. Passes need not know it. A power of two
// changes no mantissa bits, so scenes whose lights all differ by a power of two give the same pictures.
//
// S. Lagarde, C. de Rousiers: Moving Frostbite to Physically Based Rendering (SIGGRAPH 2014 course), 5.1.2, with an
// estimate from the scene's lights instead of the last frame's exposure, so that the first frame has it, too.
#pragma once

#include "effects/lamps.h"
#include "scene/scene.h"

#include <memory>
#include <vector>

namespace reflet {

class PreExposure {
public:
    explicit PreExposure(const Scene& scene);

    /// The pre-exposure for the lights of a frame. It changes only if they become brighter or darker by many stops.
    float update(const LampBlock& lamps, const View& view);
    [[nodiscard]] float value() const { return value_; }
    void forget() { value_ = 1.0F; }

private:
    [[nodiscard]] float reflectedFrom(const LampBlock& lamps) const;
    float meanOf(const Environment& environment);

    std::vector<vec3> places_;  ///< sample points on surfaces, at time 0
    float emitted_ = 0.0F;      ///< typical radiance where emissive materials are the only light
    std::shared_ptr<const FloatImage> image_;
    float imageMean_ = 0.0F;  ///< of image_
    float value_ = 1.0F;
};

}  // namespace reflet
