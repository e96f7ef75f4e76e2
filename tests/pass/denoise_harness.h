// Runs the denoiser on synthetic light on a wall that faces the camera.
#pragma once

#include "device/frame.h"
#include "effects/denoise/denoise.h"
#include "scene/scene.h"

#include <functional>
#include <optional>
#include <vector>

namespace reflet::test {

/// The camera looks at the wall from z = 0 along -Z.
constexpr float wallDistance = 4.0F;

struct LitPixel {
    vec3 radiance{0.0F};
    float hitDistance = 100.0F;
    bool sky = false;
};
using LitWall = std::function<LitPixel(uvec2 pixel)>;

struct WallFrame {
    float cameraX = 0.0F;              ///< metres
    vec2 wallMotion{0.0F};             ///< of the wall itself, pixels
    float roughness = 0.5F;            ///< of the wall
    vec2 imageMotion{0.0F};            ///< object motion of what the wall mirrors, pixels
    std::optional<vec4> remembered{};  ///< LobeLight::remembered, in all pixels
};

class DenoiseRun {
public:
    DenoiseRun(gpu::Device& device, uvec2 size, uint32_t lobe, const DenoiseSettings& settings);

    /// Radiance and hit distance after this frame, by rows.
    std::vector<vec4> add(const LitWall& light, const WallFrame& wall = {});

    /// Pixels by which objects at this distance move on the screen if the camera moves one metre.
    [[nodiscard]] float pixelsPerMetre(float distance) const;

private:
    [[nodiscard]] ViewParams viewAt(float x) const;

    gpu::Frame frame_;
    DenoiseStore store_;
    uvec2 size_;
    uint32_t lobe_;
    DenoiseSettings settings_;
    uint32_t count_ = 0;
    float previousX_ = 0.0F;
};

/// Mean of the channels of all pixels.
vec3 meanOf(const std::vector<vec4>& texels);

}  // namespace reflet::test
