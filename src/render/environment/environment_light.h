// The environment on the device: its exact texels, and cube maps of it for wide looks. Shared by C++ and GLSL.
#ifndef REFLET_RENDER_ENVIRONMENT_LIGHT_H
#define REFLET_RENDER_ENVIRONMENT_LIGHT_H

#include "base/shared.h"

SHARED_BEGIN

struct EnvironmentParams {
    vec3 factor;  // on all that the images hold
    vec2 turn;    // cosine and sine of the rotation: images are kept unrotated
};

SHARED_END

#ifdef __cplusplus

#include "gpu/frame.h"
#include "render/cube_map/cube_map.h"
#include "scene/scene.h"

#include <memory>

namespace reflet {

/// What passes take. Valid as long as its EnvironmentMaps, until their next update.
struct EnvironmentLight {
    gpu::Image texels;      ///< RGBA16F, equirectangular, radiance over the factor
    gpu::Image lobes;       ///< CubeMap::lobes
    gpu::Image irradiance;  ///< CubeMap::irradiance
    EnvironmentParams params{};
};

/// Binds what environment.glsl declares, for the exact radiance along a direction.
void bindEnvironment(gpu::Pass& pass, const EnvironmentLight& light);

/// Binds what environment_lobes.glsl declares, besides: radiance around directions.
void bindEnvironmentLobes(gpu::Pass& pass, gpu::Device& device, const EnvironmentLight& light);

/// Owns the images. Constant radiance is an image of one white texel.
class EnvironmentMaps {
public:
    /// Filters the image, and waits for it, when it is another one than last time; its intensity and rotation are free
    /// to change. Values above what 16-bit floats hold are kept as long as the image's
    /// largest value is at most 6.7e7, and cut off there: images are stored over a power of two of up to 1024.
    EnvironmentLight update(gpu::Device& device, const Environment& environment);

private:
    void load(gpu::Device& device);

    std::shared_ptr<const FloatImage> image_;
    gpu::Texture texels_;
    CubeMap cube_;
    float scale_ = 1.0F;  ///< of radiance, to what the images hold
};

}  // namespace reflet
#endif

#endif
