// Uploads skinned vertices and records the skinning pass.
#include "render/skin/skin.h"

#include "gpu/device.h"

#include <algorithm>
#include <cstring>

namespace reflet {

namespace {

uint32_t firstJointOf(const Scene& scene, int32_t skin) {
    uint32_t first = 0;
    for (int32_t i = 0; i < skin; ++i) {
        first += static_cast<uint32_t>(scene.skins[static_cast<size_t>(i)].joints.size());
    }
    return first;
}

}  // namespace

void SkinnedVertices::add(const Scene& scene, const Instance& instance, uint32_t firstSource) {
    const uint32_t firstJoint = firstJointOf(scene, instance.skin);
    uint32_t source = firstSource;
    for (const VertexSkin& skin : scene.meshes.at(instance.mesh).skin) {
        SkinnedVertex v{source++, {}, skin.weights};
        for (int k = 0; k < 4; ++k) {
            v.joints[k] = firstJoint + skin.joints[k];
        }
        added_.push_back(v);
    }
}

void SkinnedVertices::upload(gpu::Device& device, const Scene& scene, uint32_t firstVertex) {
    firstVertex_ = firstVertex;
    count_ = static_cast<uint32_t>(added_.size());
    jointCount_ = firstJointOf(scene, static_cast<int32_t>(scene.skins.size()));
    if (empty()) {
        return;
    }
    vertices_ = gpu::uploadBuffer(device, std::as_bytes(std::span(added_)), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                  "skinned vertices");
    joints_ = gpu::Buffer(device, VkDeviceSize(2) * jointCount_ * sizeof(glm::mat4x3),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryUse::upload, "joints");
    added_ = {};
}

void SkinnedVertices::pose(const ScenePose& now, const ScenePose& before) {
    if (empty()) {
        return;
    }
    std::byte* to = joints_.bytes().data();
    for (const ScenePose* pose : {&now, &before}) {
        for (const std::vector<mat4>& skin : pose->skins) {
            for (const mat4& joint : skin) {
                const glm::mat4x3 rows(joint);
                std::memcpy(to, &rows, sizeof(rows));
                to += sizeof(rows);
            }
        }
    }
}

void SkinnedVertices::record(gpu::Frame& f, const Buffers& vertices) const {
    if (empty()) {
        return;
    }
    f.compute("skin", "skin.comp")
        .read("vertices", vertices_.view())
        .read("joints", joints_.view())
        .write("positions", vertices.positions)
        .write("previousPositions", vertices.previousPositions)
        .write("attributes", vertices.attributes)
        .params(SkinParams{firstVertex_, count_, jointCount_})
        .dispatch(count_);
    for (const gpu::BufferView buffer : {vertices.positions, vertices.previousPositions, vertices.attributes}) {
        f.readByDraws(buffer);
    }
}

}  // namespace reflet
