// Environment light: a prefiltered cube map for cones, made from an environment image.
#pragma once

#include "effects/cube_map/cube_map.h"
#include "effects/environment/environment_light.h"
#include "gpu/pass_list.h"

namespace reflet::lighting {

/// factor: scale of the image's values, or the constant radiance. rotation: about `up` [rad]. up: unit length, world
/// space: direction of the image's upper edge; the image is rotated there from +Y by the shortest arc.
EnvironmentParams environmentParams(const vec3& factor, float rotation, const vec3& up = vec3(0.0F, 1.0F, 0.0F));

/// Makes `cube` from the texels of an image. imageWidth: 0: constant radiance. Reuses the cube's memory if its size is
/// unchanged.
void prefilterEnvironment(gpu::PassList& f, CubeMap& cube, gpu::Image texels, uint32_t imageWidth);

}  // namespace reflet::lighting
