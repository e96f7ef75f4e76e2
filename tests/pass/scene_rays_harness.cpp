// Traces rays through a scene on the device.
#include "pass/scene_rays_harness.h"

#include "pass/test_shaders.h"

#include <cstring>
#include <random>

namespace reflet::test {

void SceneRaysTest::SetUpTestSuite() {
    registerPassTestShaders();
}

std::vector<TestHit> SceneRaysTest::trace(const SceneRays& scene, const std::vector<TestRay>& rays, double* passMs,
                                          uint32_t which) {
    constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const gpu::Buffer in = gpu::uploadBuffer(device(), std::as_bytes(std::span(rays)), storage, "rays");
    const gpu::Buffer out(device(), rays.size() * sizeof(TestHit), storage, gpu::MemoryUse::readback, "hits");
    gpu::Frame& f = frame();
    f.begin();
    gpu::Pass pass = f.compute("scene_rays_test", scene.shader("scene_rays_test"));
    scene.bind(pass.read("rays", in.view()).write("hits", out.view()).constant("which", which))
        .dispatch(static_cast<uint32_t>(rays.size()));
    f.submit();
    f.wait();
    showToHost();
    std::vector<TestHit> hits(rays.size());
    std::memcpy(hits.data(), out.bytes().data(), out.bytes().size());
    if (passMs != nullptr) {
        *passMs = f.passTimes().at(1).ms;
    }
    return hits;
}

std::vector<TestRay> SceneRaysTest::randomRays(const Scene& scene, size_t count) {
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<float>(random() >> 8U) * 0x1p-24F; };
    const Aabb box = scene.bounds();
    const vec3 size = box.size();
    std::vector<TestRay> rays(count);
    for (TestRay& ray : rays) {
        const vec3 place(number(), number(), number());
        const float z = 2.0F * number() - 1.0F;
        const float angle = 2.0F * glm::pi<float>() * number();
        const float r = std::sqrt(1.0F - z * z);
        ray.origin = box.min + size * (1.2F * place - 0.1F);
        ray.direction = vec3(r * std::cos(angle), r * std::sin(angle), z);
        ray.nearest = 0.0F;
        ray.farthest = std::numeric_limits<float>::infinity();
    }
    return rays;
}

Scene withoutCutOuts(Scene scene) {
    for (Material& material : scene.materials) {
        material.alphaCutoff = 0.0F;
    }
    return scene;
}

}  // namespace reflet::test
