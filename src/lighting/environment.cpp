// Records the prefiltering of the environment.
#include "lighting/environment.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <bit>

namespace reflet::lighting {

namespace {

// About the image's pixels per quarter turn. More than 256 would only matter for near-mirrors without rays; fewer than
// 64 would blur small images, which are read with nearest filtering.
uint32_t environmentSide(uint32_t imageWidth) {
    return imageWidth > 0 ? std::clamp(std::bit_ceil(imageWidth / 4), 64U, 256U) : 1U;
}

// The shortest rotation that takes a direction to another one, both of unit length.
glm::quat quaternion(const vec3& from, const vec3& to) {
    const float cosine = glm::dot(from, to);
    if (cosine < -0.9999F) {  // half a turn, around any axis across
        return glm::angleAxis(glm::pi<float>(), vec3(1.0F, 0.0F, 0.0F));
    }
    const vec3 axis = glm::cross(from, to);
    return glm::normalize(glm::quat(1.0F + cosine, axis.x, axis.y, axis.z));
}

}  // namespace

EnvironmentParams environmentParams(const vec3& factor, float rotation, const vec3& up) {
    const glm::quat upright = quaternion(up, vec3(0.0F, 1.0F, 0.0F));
    const glm::quat turn = glm::angleAxis(-rotation, vec3(0.0F, 1.0F, 0.0F)) * upright;
    return {factor, vec4(turn.x, turn.y, turn.z, turn.w)};
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
