// Uploads skinned and morphed vertices and records the skinning pass.
#include "renderer/skin/skin.h"

#include "device/device.h"
#include "device/upload.h"

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

void SkinnedVertices::add(const Scene& scene, size_t instance, uint32_t firstSource) {
    const Instance& placed = scene.instances[instance];
    const Mesh& mesh = scene.meshes.at(placed.mesh);
    const uint32_t firstJoint = firstJointOf(scene, placed.skin);
    for (uint32_t i = 0; i < mesh.positions.size(); ++i) {
        SkinnedVertex v{firstSource + i, static_cast<uint32_t>(addedWeights_.size()), 0};
        if (placed.skin >= 0) {
            for (const JointWeight& moved : mesh.jointsOf(i)) {
                addedWeights_.push_back({firstJoint + moved.joint, moved.weight});
                ++v.jointCount;
            }
        }
        added_.push_back(v);
    }
    if (!placed.weights.empty()) {
        addMorph(scene, instance);
    }
}

// Instances of a mesh share its deltas.
void SkinnedVertices::addMorph(const Scene& scene, size_t instance) {
    const Instance& placed = scene.instances[instance];
    const Morph& morph = scene.meshes.at(placed.mesh).morph;
    const auto [first, isNew] = firstDelta_.try_emplace(placed.mesh, static_cast<uint32_t>(addedDeltas_.size()));
    if (isNew) {
        addedDeltas_.insert(addedDeltas_.end(), morph.deltas.begin(), morph.deltas.end());
    }
    addedMorphs_.resize(added_.size() - morph.vertices.size());
    for (const Morph::Range& range : morph.vertices) {
        addedMorphs_.push_back({first->second + range.first, range.count, weightCount_});
    }
    weightCount_ += static_cast<uint32_t>(placed.weights.size());
    morphed_.push_back(instance);
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
    joints_ = gpu::Buffer(device, VkDeviceSize(2) * std::max(jointCount_, 1U) * sizeof(glm::mat4x3),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryUse::upload, "joints");
    addedWeights_.resize(std::max<size_t>(addedWeights_.size(), 1));
    jointWeights_ = gpu::uploadVector(device, addedWeights_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "joint weights");
    added_ = {};
    addedWeights_ = {};
    if (weightCount_ > 0) {
        uploadMorphs(device);
    }
}

void SkinnedVertices::uploadMorphs(gpu::Device& device) {
    addedMorphs_.resize(count_);
    addedDeltas_.resize(std::max<size_t>(addedDeltas_.size(), 1));
    morphs_ = gpu::uploadVector(device, addedMorphs_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "morphed vertices");
    deltas_ = gpu::uploadVector(device, addedDeltas_, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "morph deltas");
    weights_ = gpu::Buffer(device, VkDeviceSize(2) * weightCount_ * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                           gpu::MemoryUse::upload, "morph weights");
    addedMorphs_ = {};
    addedDeltas_ = {};
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
    if (weightCount_ == 0) {
        return;
    }
    to = weights_.bytes().data();
    for (const ScenePose* pose : {&now, &before}) {
        for (const size_t instance : morphed_) {
            const std::vector<float>& weights = pose->weights[instance];
            std::memcpy(to, weights.data(), weights.size() * sizeof(float));
            to += weights.size() * sizeof(float);
        }
    }
}

void SkinnedVertices::record(gpu::PassList& f, const Buffers& vertices) const {
    if (empty()) {
        return;
    }
    const bool morphs = weightCount_ > 0;  // without, any buffer does: the shader does not read it
    f.compute("skin", "skin.comp")
        .constant("morphed", morphs ? 1U : 0U)
        .read("vertices", vertices_.view())
        .read("jointWeights", jointWeights_.view())
        .read("joints", joints_.view())
        .read("morphs", morphs ? morphs_.view() : vertices_.view())
        .read("deltas", morphs ? deltas_.view() : vertices_.view())
        .read("morphWeights", morphs ? weights_.view() : vertices_.view())
        .write("positions", vertices.positions)
        .write("previousPositions", vertices.previousPositions)
        .write("attributes", vertices.attributes)
        .params(SkinParams{firstVertex_, count_, jointCount_, weightCount_})
        .dispatch(count_);
    for (const gpu::BufferView buffer : {vertices.positions, vertices.previousPositions, vertices.attributes}) {
        f.readByDraws(buffer);
    }
}

}  // namespace reflet
