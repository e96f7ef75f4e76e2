// Uploads a scene's triangles and the hierarchy over them.
#include "render/trace_scene/scene_rays.h"

#include "base/error.h"
#include "gpu/device.h"
#include "gpu/pass.h"
#include "scene/bvh.h"

#include <algorithm>
#include <cstddef>
#include <span>

namespace reflet {

namespace {

template <class T>
gpu::Buffer upload(gpu::Device& device, const std::vector<T>& items, const char* name, VkBufferUsageFlags usage = 0) {
    return gpu::uploadBuffer(device, std::as_bytes(std::span(items)), usage | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, name);
}

// A triangle's corners, as acceleration structures are built from them, begin every 16 bytes.
constexpr size_t cornerStride = offsetof(SceneTriangle, b);
static_assert(sizeof(SceneTriangle) == 3 * cornerStride && offsetof(SceneTriangle, c) == 2 * cornerStride);

}  // namespace

SceneRays::SceneRays(gpu::Device& device, const Scene& scene, RayMethod method) : method_(method) {
    std::vector<SceneTriangle> triangles = sceneTriangles(scene);
    triangleCount_ = static_cast<uint32_t>(triangles.size());
    if (method == RayMethod::traversal) {
        const Bvh bvh = buildBvh(triangles);
        nodes_ = upload(device, bvh.nodes, "scene nodes");
        triangles_ = upload(device, bvh.triangles, "scene triangles");
        return;
    }
    if (!device.hasRayQuery()) {
        fail("the device '{}' has no ray query", device.description().name);
    }
    if (triangles.empty()) {
        triangles.push_back({});  // without area: nothing hits it
    }
    triangles_ = upload(device, triangles, "scene triangles", gpu::accelerationInput);
    const bool cutOut =
        std::ranges::any_of(triangles, [](const SceneTriangle& t) { return (t.flags & triangleCutOut) != 0; });
    acceleration_ = gpu::AccelerationStructure(
        device, {triangles_, static_cast<uint32_t>(cornerStride), static_cast<uint32_t>(triangles.size()), !cutOut});
}

std::string SceneRays::shader(std::string_view name) const {
    return std::string(name) + (method_ == RayMethod::query ? "_query.comp" : ".comp");
}

gpu::Pass& SceneRays::bind(gpu::Pass& pass) const {
    pass.read("sceneTriangles", triangles_.view());
    return method_ == RayMethod::query ? pass.read("sceneHierarchy", acceleration_.view())
                                       : pass.read("sceneNodes", nodes_.view());
}

}  // namespace reflet
