// The environment on the device: its equirectangular image, and prefiltered cube maps for image-based lighting. Shared
// by C++ and GLSL.
#ifndef REFLET_RENDER_ENVIRONMENT_LIGHT_H
#define REFLET_RENDER_ENVIRONMENT_LIGHT_H

#include "base/shared.h"

SHARED_BEGIN

struct EnvironmentParams {
    vec3 factor;  // scale of all image values
    vec2 turn;    // cosine and sine of the rotation; images are stored unrotated
};

SHARED_END

#ifdef __cplusplus

#include "gpu/recorder.h"
#include "render/cube_map/cube_map.h"
#include "scene/scene.h"

#include <memory>

namespace reflet {

/// The environment for passes. Valid until the next update of its EnvironmentMaps.
struct EnvironmentLight {
    gpu::Image texels;      ///< RGBA16F, equirectangular, radiance / factor
    gpu::Image lobes;       ///< CubeMap::lobes
    gpu::Image irradiance;  ///< CubeMap::irradiance
    EnvironmentParams params{};
};

/// Binds environment.glsl's resources, for exact radiance.
void bindEnvironment(gpu::Pass& pass, const EnvironmentLight& light);

/// Binds environment_lobes.glsl's additional resources, for prefiltered radiance.
void bindEnvironmentLobes(gpu::Pass& pass, gpu::Context& context, const EnvironmentLight& light);

/// Owns the images. Constant radiance is an image of one white texel.
class EnvironmentMaps {
public:
    EnvironmentMaps() = default;
    /// prefilters: false: makes only the texels.
    explicit EnvironmentMaps(bool prefilters) : prefilters_(prefilters) {}

    /// Records the upload and prefiltering of the image if it has changed; intensity and rotation may change freely.
    /// Values beyond half floats are kept up to 6.7e7 and clamped above: images are stored divided by a power of two of
    /// up to 1024.
    EnvironmentLight update(gpu::Recorder& f, const Environment& environment);

private:
    void load(gpu::Recorder& f);

    bool prefilters_ = true;
    std::shared_ptr<const FloatImage> image_;
    gpu::KeptImage texels_{"environment"};
    CubeMap cube_;
    float scale_ = 1.0F;  ///< from radiance to stored values
};

}  // namespace reflet
#endif

#endif
