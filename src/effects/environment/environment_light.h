// The environment on the device: its equirectangular image, and prefiltered cube maps for image-based lighting. Shared
// by C++ and GLSL.
#ifndef REFLET_EFFECTS_ENVIRONMENT_LIGHT_H
#define REFLET_EFFECTS_ENVIRONMENT_LIGHT_H

#include "base/shared.h"

SHARED_BEGIN

struct EnvironmentParams {
    vec3 factor;  // scale of all image values
    vec4 turn;    // quaternion (x, y, z; w): world directions to those of the image, which is stored unturned
};

SHARED_END

#ifdef __cplusplus

#include "effects/cube_map/cube_map.h"
#include "gpu/pass_list.h"

namespace reflet {

/// The environment for passes. Valid as long as its images.
struct EnvironmentLight {
    gpu::Image texels;      ///< RGBA16F, equirectangular, radiance / factor
    gpu::Image lobes;       ///< CubeMap::lobes
    gpu::Image irradiance;  ///< CubeMap::irradiance
    EnvironmentParams params{};
};

/// Binds environment.glsl's resources, for exact radiance.
void bindEnvironment(gpu::ComputePass& pass, const EnvironmentLight& light);

/// Binds environment_lobes.glsl's additional resources, for prefiltered radiance.
void bindEnvironmentLobes(gpu::ComputePass& pass, gpu::Context& context, const EnvironmentLight& light);

/// Records the prefiltering of an equirectangular image (RGBA16F) into the cube map.
void prefilterEnvironment(gpu::PassList& f, const CubeMap& cube, gpu::Image texels);

}  // namespace reflet
#endif

#endif
