// The environment's light: a cube map for cones, made from an image around.
#pragma once

#include "effects/cube_map/cube_map.h"
#include "effects/environment/environment_light.h"
#include "gpu/pass_list.h"

namespace reflet::lighting {

/// factor: scale of the image's values, or the constant radiance. rotation: about `up` [rad]. up: unit length, world
/// space; where the upper edge of the image is, turned there from +Y by the shortest way.
EnvironmentParams environmentParams(const vec3& factor, float rotation, const vec3& up = vec3(0.0F, 1.0F, 0.0F));

/// Makes `cube` of the texels of an image; imageWidth: 0: these are of constant radiance. Keeps the cube's memory if it
/// has the size already.
void prefilterEnvironment(gpu::PassList& f, CubeMap& cube, gpu::Image texels, uint32_t imageWidth);

}  // namespace reflet::lighting
