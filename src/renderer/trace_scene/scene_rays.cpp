// Uploads a scene's triangles and their BVH.
#include "renderer/trace_scene/scene_rays.h"

#include "base/error.h"
#include "device/device.h"
#include "device/upload.h"
#include "gpu/pass.h"
#include "scene/bvh.h"

#include <algorithm>
#include <cstddef>

namespace reflet {

namespace {

// Stride of a triangle's corners, for building acceleration structures.
constexpr size_t cornerStride = offsetof(SceneTriangle, b);
static_assert(sizeof(SceneTriangle) == 3 * cornerStride && offsetof(SceneTriangle, c) == 2 * cornerStride);

}  // namespace

SceneRays::SceneRays(gpu::Device& device, const Scene& scene, RayMethod method) : method_(method) {
    std::vector<SceneTriangle> triangles = sceneTriangles(scene);
    if (method == RayMethod::traversal) {
        upload(device, buildBvh(triangles));
    } else {
        upload(device, std::move(triangles));
    }
}

void SceneRays::pose(gpu::Device& device, const Scene& scene, const ScenePose& pose) {
    if (!standing_) {
        standing_ = sceneTriangles(scene, pose, Instances::stationary);
        if (method_ == RayMethod::traversal) {
            standingBvh_ = buildBvh(*standing_, bvhMaxDepth - 1);
            standing_->clear();
        }
    }
    std::vector<SceneTriangle> moving = sceneTriangles(scene, pose, Instances::moving);
    if (method_ == RayMethod::traversal) {
        upload(device, joined(*standingBvh_, buildBvh(moving, bvhMaxDepth - 1)));
    } else {
        moving.insert(moving.begin(), standing_->begin(), standing_->end());
        upload(device, std::move(moving));
    }
}

void SceneRays::upload(gpu::Device& device, const Bvh& bvh) {
    nodes_ = gpu::uploadVector(device, bvh.nodes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "scene nodes");
    triangles_ = gpu::uploadVector(device, bvh.triangles, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "scene triangles");
}

void SceneRays::upload(gpu::Device& device, std::vector<SceneTriangle> triangles) {
    if (!device.hasRayQuery()) {
        fail("the device '{}' does not support ray query; set trace_scene.ray_query=false", device.description().name);
    }
    if (triangles.empty()) {
        triangles.push_back({});  // degenerate: never hit
    }
    triangles_ = gpu::uploadVector(device, triangles, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | gpu::accelerationInput,
                                   "scene triangles");
    const bool cutOut =
        std::ranges::any_of(triangles, [](const SceneTriangle& t) { return (t.flags & triangleCutOut) != 0; });
    acceleration_ = gpu::AccelerationStructure(
        device, {triangles_, static_cast<uint32_t>(cornerStride), static_cast<uint32_t>(triangles.size()), !cutOut});
}

std::string SceneRays::shader(std::string_view name) const {
    return std::string(name) + (method_ == RayMethod::query ? "_query.comp" : ".comp");
}

gpu::ComputePass& SceneRays::bind(gpu::ComputePass& pass) const {
    pass.read("sceneTriangles", triangles_.view());
    return method_ == RayMethod::query ? pass.read("sceneHierarchy", acceleration_.view())
                                       : pass.read("sceneNodes", nodes_.view());
}

}  // namespace reflet
