// The environment of a scene on the device.
#pragma once

#include "lighting/environment.h"
#include "scene/scene.h"

#include <memory>

namespace reflet {

/// Owns the environment's images. Constant radiance is an image of one white texel.
class EnvironmentMaps {
public:
    EnvironmentMaps() = default;
    /// prefilters: false: makes only the texels, no prefiltered cube map.
    explicit EnvironmentMaps(bool prefilters) : prefilters_(prefilters) {}

    /// Records the upload and prefiltering of the image if it has changed; intensity and rotation may change freely.
    /// Values beyond half floats are kept up to 6.7e7, or as many times the image's mean, and clamped above: images are
    /// stored divided by a power of two.
    EnvironmentLight update(gpu::PassList& f, const Environment& environment);

private:
    void load(gpu::PassList& f);

    bool prefilters_ = true;
    std::shared_ptr<const FloatImage> image_;
    gpu::KeptImage texels_{"environment"};
    CubeMap cube_;
    float scale_ = 1.0F;  ///< factor from radiance to stored values
};

}  // namespace reflet
