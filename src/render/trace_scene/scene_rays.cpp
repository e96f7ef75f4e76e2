// Uploads a scene's triangles and the hierarchy over them.
#include "render/trace_scene/scene_rays.h"

#include "base/error.h"
#include "gpu/device.h"
#include "gpu/pass.h"
#include "scene/bvh.h"

#include <span>

namespace reflet {

namespace {

template <class T>
gpu::Buffer upload(gpu::Device& device, const std::vector<T>& items, const char* name) {
    return gpu::uploadBuffer(device, std::as_bytes(std::span(items)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, name);
}

}  // namespace

SceneRays::SceneRays(gpu::Device& device, const Scene& scene) : SceneRays(device, scene, RayMethod::traversal) {}

SceneRays::SceneRays(gpu::Device& device, const Scene& scene, RayMethod method) : method_(method) {
    const std::vector<SceneTriangle> triangles = sceneTriangles(scene);
    triangleCount_ = static_cast<uint32_t>(triangles.size());
    const Bvh bvh = buildBvh(triangles);
    nodes_ = upload(device, bvh.nodes, "scene nodes");
    triangles_ = upload(device, bvh.triangles, "scene triangles");
}

std::string SceneRays::shader(std::string_view name) const {
    return std::string(name) + (method_ == RayMethod::query ? "_query.comp" : ".comp");
}

gpu::Pass& SceneRays::bind(gpu::Pass& pass) const {
    return pass.read("sceneNodes", nodes_.view()).read("sceneTriangles", triangles_.view());
}

}  // namespace reflet
