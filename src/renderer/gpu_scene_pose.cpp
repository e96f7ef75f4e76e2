// Animated poses of the scene's draws, lamps and deformed meshes.
#include "renderer/gpu_scene.h"

namespace reflet {

// Each deformed instance has its own vertices, after those of all meshes.
void GpuScene::addSkinned(const Scene& scene, std::vector<vec3>& positions, std::vector<VertexAttributes>& attributes) {
    const auto first = static_cast<uint32_t>(positions.size());
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (!isDeformed(instance)) {
            continue;
        }
        const Mesh& mesh = scene.meshes.at(instance.mesh);
        skinnedFirst_[i] = static_cast<int32_t>(positions.size());
        const size_t joints = instance.skin < 0 ? 0 : scene.skins[static_cast<size_t>(instance.skin)].joints.size();
        skinnedBounds_[i] = jointBounds(mesh, joints);
        skinned_.add(scene, i, static_cast<uint32_t>(ranges_[instance.mesh].firstVertex));
        positions.insert(positions.end(), mesh.positions.begin(), mesh.positions.end());
        attributes.insert(attributes.end(), mesh.attributes.begin(), mesh.attributes.end());
    }
    skinned_.upload(device_, scene, first);
}

void GpuScene::pose(const Scene& scene, const ScenePose& now, const ScenePose& before) {
    if (posedTime_ != now.time) {
        posedTime_ = now.time;
        ++draws_.version;
    }
    draws_.boundsW = Aabb{};
    for (size_t i = 0; i < draws_.draws.size(); ++i) {
        const Instance& instance = scene.instances[i];
        Draw& draw = draws_.draws[i];
        if (isAnimated(now, instance)) {
            const bool deformed = isDeformed(instance);
            draw.objectToWorld = now.objectToWorld[i];
            draw.previousObjectToWorld = before.objectToWorld[i];
            draw.boundsW = instanceBounds(scene, now, i, deformed ? skinnedBounds_.at(i) : std::vector<JointBounds>{});
            draw.firstVertex = deformed ? skinnedFirst_.at(i) : draw.firstVertex;
            draw.turnedOver = instance.skin >= 0 && flipsWinding(now.skins[static_cast<size_t>(instance.skin)]);
        }
        draws_.boundsW.add(draw.boundsW);
    }
    for (size_t i = 0; i < lampSources_.size(); ++i) {
        lamps_.lamps[i] = lampParams(posed(scene.lamps[lampSources_[i]], now));
    }
    for (const auto& [index, material] : now.properties.materials) {
        poseMaterial(material, index);
    }
    emitters_->pose(now);
    for (LivePicture& picture : live_) {
        picture.posed = posed(picture.camera, now);
    }
    skinned_.pose(now, before);
}

void GpuScene::skin(gpu::PassList& f) const {
    skinned_.record(f, {positions_.view(), previousPositions_.view(), attributes_.view()});
}

}  // namespace reflet
