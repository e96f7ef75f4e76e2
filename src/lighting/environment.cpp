// Records the prefiltering of the environment.
#include "lighting/environment.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace reflet::lighting {

namespace {

// About the image's pixels per quarter turn. More than 256 would only matter for near-mirrors without rays; fewer than
// 64 would blur small images, which are read with nearest filtering.
uint32_t environmentSide(uint32_t imageWidth) {
    return imageWidth > 0 ? std::clamp(std::bit_ceil(imageWidth / 4), 64U, 256U) : 1U;
}

}  // namespace

EnvironmentParams environmentParams(const vec3& factor, float rotation) {
    return {factor, vec2(std::cos(rotation), std::sin(rotation))};
}

void prefilterEnvironment(gpu::PassList& f, CubeMap& cube, gpu::Image texels, uint32_t imageWidth) {
    const auto scope = f.scope("environment");
    const uint32_t side = environmentSide(imageWidth);
    if (cube.sharp.info().size.x != side) {
        cube = CubeMap(f.context(), side, 1, "environment");
    }
    reflet::prefilterEnvironment(f, cube, texels);
}

}  // namespace reflet::lighting
