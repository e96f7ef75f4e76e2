// Runs the denoiser on synthetic light on a wall that faces the camera.
#include "pass/denoise_harness.h"

#include "capture/texels.h"
#include "device/device.h"
#include "pass/test_shaders.h"
#include "renderer/view_params.h"

#include <numeric>

namespace reflet::test {

namespace {

constexpr uint32_t packedTowardCamera = 0;  // packUnitVector of +Z: the middle of the octahedron

}  // namespace

DenoiseRun::DenoiseRun(gpu::Device& device, uvec2 size, uint32_t lobe, const DenoiseSettings& settings)
    : frame_(device), size_(size), lobe_(lobe), settings_(settings) {
    addPassTestShaders(device);
}

ViewParams DenoiseRun::viewAt(float x) const {
    Camera camera;
    camera.position = vec3(x, 0.0F, 0.0F);
    camera.target = vec3(x, 0.0F, -1.0F);
    return makeViewParams(camera, size_, count_, 1);
}

float DenoiseRun::pixelsPerMetre(float distance) const {
    return 1.0F / (viewAt(0.0F).pixelAngle * distance);
}

std::vector<vec4> DenoiseRun::add(const LitWall& light, const WallFrame& wall) {
    ViewParams view = viewAt(wall.cameraX);
    view.previousWorldToClip = viewAt(previousX_).worldToClip;
    // A step of the camera to the right moves what it sees to the left.
    const vec2 motion = wall.wallMotion - vec2((wall.cameraX - previousX_) * pixelsPerMetre(wallDistance), 0.0F);
    const size_t count = size_t(size_.x) * size_.y;
    const vec4 onWall = view.worldToClip * vec4(wall.cameraX, 0.0F, -wallDistance, 1.0F);
    std::vector<vec4> radiance(count);
    std::vector<float> depth(count);
    for (uint32_t i = 0; i < count; ++i) {
        const LitPixel p = light({i % size_.x, i / size_.x});
        radiance[i] = vec4(p.radiance, p.hitDistance);
        depth[i] = p.sky ? 0.0F : onWall.z / onWall.w;
    }
    frame_.begin();
    Filler filler(frame_, size_);
    GBuffer g{};
    const std::vector<uint32_t> normals(count, packedTowardCamera);
    g.depth = filler.fill("depth", VK_FORMAT_R32_SFLOAT, "fill_image_test.comp", depth);
    g.normal = filler.fill("normal", VK_FORMAT_R32_UINT, "fill_bits_test.comp", normals);
    g.geometricNormal = g.normal;
    g.material = filler.colors("material", std::vector<vec4>(count, vec4(wall.roughness, 0.0F, 1.0F, 0.0F)));
    g.motion = filler.colors("motion", std::vector<vec4>(count, vec4(motion / vec2(size_), 0.0F, 0.0F)));
    LobeLight lobe{};
    lobe.from = RaySurfaces{g, view, 1};
    lobe.radiance = filler.colors("radiance", radiance);
    lobe.imageMotion = filler.fill("image_motion", VK_FORMAT_R16G16_SFLOAT, "fill_pair_test.comp",
                                   std::vector<vec4>(count, vec4(wall.imageMotion / vec2(size_), 0.0F, 0.0F)));
    if (wall.remembered) {
        lobe.remembered = filler.colors("remembered", std::vector<vec4>(count, *wall.remembered));
    }
    const LobeLight clean = denoise(frame_, &store_, lobe, lobe_, view, settings_);
    const gpu::Readback copy = frame_.readback(clean.radiance);
    frame_.submit();
    frame_.wait();
    ++count_;
    previousX_ = wall.cameraX;
    return decodeTexels(VK_FORMAT_R16G16B16A16_SFLOAT, frame_.bytes(copy));
}

vec3 meanOf(const std::vector<vec4>& texels) {
    const vec4 sum = std::accumulate(texels.begin(), texels.end(), vec4(0.0F));
    return vec3(sum) / static_cast<float>(texels.size());
}

}  // namespace reflet::test
