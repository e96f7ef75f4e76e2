// Checks that a loaded scene keeps the promises of scene/scene.h.
#include "valid_scene.h"

#include "scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::test {

namespace {

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// -1 or an index of an array of this size.
bool isIndexOrNone(int32_t index, size_t size) {
    return index >= -1 && index < static_cast<int64_t>(size);
}

void expectValidMaterials(const Scene& scene) {
    for (const TextureImage& image : scene.images) {
        ASSERT_EQ(image.rgba.size(), size_t(image.width) * image.height * 4);
        ASSERT_GT(image.rgba.size(), 0U);
    }
    for (const Material& m : scene.materials) {
        ASSERT_TRUE(isFinite(vec3(m.baseColor)) && std::isfinite(m.baseColor.w) && isFinite(m.emissive));
        ASSERT_TRUE(m.metallic >= 0.0F && m.metallic <= 1.0F && m.roughness >= 0.0F && m.roughness <= 1.0F);
        for (const TextureSlot* slot : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,
                                        &m.occlusionTexture, &m.emissiveTexture}) {
            ASSERT_TRUE(isIndexOrNone(slot->image, scene.images.size()));
            ASSERT_TRUE(isIndexOrNone(slot->sampler, scene.samplers.size()));
            ASSERT_LE(slot->uvSet, 1U);
            ASSERT_TRUE(isFinite(slot->uvTransform[0]) && isFinite(slot->uvTransform[1]));
        }
    }
}

void expectValidMesh(const Scene& scene, const Mesh& mesh) {
    ASSERT_EQ(mesh.attributes.size(), mesh.positions.size());
    ASSERT_TRUE(mesh.skin.empty() || mesh.skin.size() == mesh.positions.size());
    ASSERT_LT(mesh.material, scene.materials.size());
    ASSERT_EQ(mesh.indices.size() % 3, 0U);
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        ASSERT_TRUE(isFinite(mesh.positions[v]));
        ASSERT_NEAR(glm::length(mesh.attributes[v].normal), 1.0F, 1e-4F);
        ASSERT_NEAR(glm::length(vec3(mesh.attributes[v].tangent)), 1.0F, 1e-4F);
        ASSERT_TRUE(std::isfinite(mesh.attributes[v].uv0.x) && std::isfinite(mesh.attributes[v].uv1.y));
    }
    for (const uint32_t index : mesh.indices) {
        ASSERT_LT(index, mesh.positions.size());
    }
}

void expectValidInstances(const Scene& scene) {
    for (const Instance& instance : scene.instances) {
        ASSERT_LT(instance.mesh, scene.meshes.size());
        ASSERT_TRUE(isFinite(vec3(instance.objectToWorld[3])));
        ASSERT_TRUE(isIndexOrNone(instance.node, scene.nodes.size()));
        ASSERT_TRUE(isIndexOrNone(instance.skin, scene.skins.size()));
        const Mesh& mesh = scene.meshes[instance.mesh];
        ASSERT_TRUE(instance.skin < 0 || mesh.skin.size() == mesh.positions.size());
        for (size_t v = 0; instance.skin >= 0 && v < mesh.skin.size(); ++v) {
            for (const JointWeight& moved : mesh.jointsOf(v)) {
                ASSERT_LT(moved.joint, scene.skins[static_cast<size_t>(instance.skin)].joints.size());
            }
        }
    }
}

void expectValidMotion(const Scene& scene) {
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        ASSERT_TRUE(isIndexOrNone(scene.nodes[i].parent, i));
        ASSERT_NEAR(glm::length(scene.nodes[i].rotation), 1.0, 1e-6);
    }
    for (const Skin& skin : scene.skins) {
        ASSERT_FALSE(skin.joints.empty());
        ASSERT_EQ(skin.inverseBind.size(), skin.joints.size());
        for (const uint32_t joint : skin.joints) {
            ASSERT_LT(joint, scene.nodes.size());
        }
    }
    for (const Animation& animation : scene.animations) {
        for (const Channel& channel : animation.channels) {
            ASSERT_LT(channel.node, scene.nodes.size());
            ASSERT_FALSE(channel.times.empty());
            const size_t each = channel.interpolation == Interpolation::cubicSpline ? 3 : 1;
            const bool weights = channel.target == Channel::Target::weights;
            ASSERT_EQ(channel.values.size(), weights ? 0 : each * channel.times.size());
            ASSERT_EQ(channel.weights.size() % (each * channel.times.size()), 0U);
            ASSERT_NE(channel.weights.empty(), weights);
        }
    }
}

void expectValidLightsAndCameras(const Scene& scene) {
    for (const Lamp& lamp : scene.lamps) {
        ASSERT_TRUE(isFinite(lamp.position) && isFinite(lamp.intensity));
        ASSERT_NEAR(glm::length(lamp.direction), 1.0F, 1e-4F);
        ASSERT_TRUE(isIndexOrNone(lamp.node, scene.nodes.size()));
        ASSERT_TRUE(lamp.type != Lamp::Type::spot || lamp.innerAngle < lamp.outerAngle);
        ASSERT_TRUE(lamp.range >= 0.0F && lamp.radius >= 0.0F);
    }
    for (const Camera& camera : scene.cameras) {
        ASSERT_TRUE(isFinite(camera.position) && isFinite(camera.target) && isFinite(camera.up));
        ASSERT_GT(camera.near, 0.0F);
        ASSERT_TRUE(camera.orthographicHeight > 0.0F ? camera.far > camera.near : camera.fovY > 0.0F);
        ASSERT_TRUE(isIndexOrNone(camera.node, scene.nodes.size()));
    }
    ASSERT_TRUE(!scene.sun || isIndexOrNone(scene.sun->node, scene.nodes.size()));
}

void expectValidPose(const Scene& scene, double time) {
    const ScenePose pose = scenePose(scene, time);
    ASSERT_TRUE(std::isfinite(pose.time));
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        ASSERT_TRUE(isFinite(vec3(pose.objectToWorld[i][3])));
        ASSERT_EQ(worldPositions(scene, pose, i).size(), scene.meshes[scene.instances[i].mesh].positions.size());
    }
}

}  // namespace

void expectValid(const Scene& scene) {
    expectValidMaterials(scene);
    for (const Mesh& mesh : scene.meshes) {
        expectValidMesh(scene, mesh);
    }
    expectValidInstances(scene);
    expectValidMotion(scene);
    expectValidLightsAndCameras(scene);
    if (!::testing::Test::HasFatalFailure()) {
        expectValidPose(scene, 0.0);
        expectValidPose(scene, 1.3);
    }
}

}  // namespace reflet::test
