// Morph targets of glTF files: shapes, normals and bounds against hand-computed values, and the errors of invalid ones.
#include "gltf_encoders.h"
#include "scene/morph.h"
#include "scene/pose.h"

#include <gtest/gtest.h>

namespace reflet::test::gltf_morph_test {
namespace {

using nlohmann::json;

std::vector<vec3> shapeAt(const Scene& scene, double time, size_t instance = 0) {
    return worldPositions(scene, scenePose(scene, time), instance);
}

json& primitiveOf(GltfBuilder& b) {
    return b.document["meshes"][0]["primitives"][0];
}

GltfBuilder withoutAnimation() {
    GltfBuilder b = morphing();
    b.document.erase("animations");
    return b;
}

TEST(GltfMorph, AnAnimatedMeshIsTheWeightedSumOfItsTargets) {
    const Loaded loaded = load(morphing());
    EXPECT_TRUE(loaded.warnings.empty());
    const Scene& scene = loaded.scene;
    EXPECT_EQ(animationDuration(scene), 2.0);
    EXPECT_EQ(shapeAt(scene, 0.0), scene.meshes[0].positions);
    EXPECT_EQ(shapeAt(scene, 1.0), (std::vector<vec3>{{0, 0, 0}, {1.25F, 0, 0}, {0, 1, 1}}));
    EXPECT_EQ(shapeAt(scene, 1.5), (std::vector<vec3>{{0, 0, 0}, {1.375F, 0, 0}, {0, 1, 1.5F}}));
    EXPECT_TRUE(isDeformed(scene.instances[0]));
    EXPECT_EQ(scene.meshes[0].morph.deltas.size(), 2U) << "vertices that a target leaves alone have none";
    const Scene still = frozen(scene, 1.0);
    const Mesh& mesh = still.meshes.at(still.instances[0].mesh);
    EXPECT_EQ(mesh.positions, shapeAt(scene, 1.0));
    const vec3 expected = glm::normalize(vec3(0, -0.5F, 1));
    EXPECT_NEAR(glm::distance(mesh.attributes[2].normal, expected), 0.0F, 1e-6F);
    EXPECT_EQ(mesh.attributes[0].normal, vec3(0, 0, 1));
    EXPECT_FALSE(isDeformed(still.instances[0]));
}

TEST(GltfMorph, SplinesAndIntegersAreReadAsTheSpecificationHasThem) {
    GltfBuilder b = morphing();
    // Per key: in-tangents of both targets, values, out-tangents. From 0 with a speed of 1/s to 0.5 with one of 0; the
    // second target stays 1.
    auto& sampler = b.document["animations"][0]["samplers"][0];
    sampler["output"] = b.addFloats({0, 0, 0, 1, 1, 0, 0, 0, 0.5F, 1, 0, 0}, "SCALAR");
    sampler["interpolation"] = "CUBICSPLINE";
    const auto middle = shapeAt(load(b).scene, 1.0);  // Hermite at 1/2: 0.5 · 0.5 + 2 s · 0.125 · 1
    EXPECT_EQ(middle[2], vec3(0, 1, 2 * 0.5F));
    EXPECT_EQ(middle[1], vec3(2, 0, 0));
    const int bytes = b.addAccessor<uint8_t>({0, 255, 255, 0}, "SCALAR", ubyteType);
    b.document["accessors"][bytes]["normalized"] = true;
    sampler["output"] = bytes;
    sampler["interpolation"] = "STEP";
    EXPECT_EQ(shapeAt(load(b).scene, 1.9)[1], vec3(2, 0, 0));
    EXPECT_EQ(shapeAt(load(b).scene, 1.9)[2], vec3(0, 1, 0));
}

TEST(GltfMorph, WeightsThatNeverChangeAreThoseOfTheNodeElseOfTheMesh) {
    GltfBuilder b = withoutAnimation();
    b.document["meshes"][0]["weights"] = {0.5, 0};
    b.addRoot({{"mesh", 0}, {"weights", {0, -1}}});
    b.addRoot({{"mesh", 0}, {"weights", {0, 0}}});
    b.addRoot({{"mesh", 0}});
    const Scene scene = load(b).scene;
    ASSERT_EQ(scene.instances.size(), 4U);
    EXPECT_EQ(shapeAt(scene, 0.0, 0)[2], vec3(0, 1, 1));
    EXPECT_EQ(shapeAt(scene, 0.0, 1), (std::vector<vec3>{{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}));
    EXPECT_EQ(shapeAt(scene, 0.0, 2), scene.meshes[0].positions);
    EXPECT_EQ(scene.instances[3].mesh, scene.instances[0].mesh) << "the same weights, the same mesh";
    EXPECT_EQ(scene.meshes.size(), 3U);
    for (const Instance& instance : scene.instances) {
        EXPECT_FALSE(isDeformed(instance)) << "they cost nothing per frame";
    }
    EXPECT_TRUE(scene.nodes.empty());
    EXPECT_EQ(scene.meshes[scene.instances[0].mesh].bounds.max, vec3(1, 1, 1));
}

TEST(GltfMorph, TheSkinDeformsTheMorphedMesh) {
    GltfBuilder b = bent();  // the third vertex goes by 0.75 of (0, 0, 2)
    primitiveOf(b)["targets"] = json::array({{{"POSITION", b.addFloats({0, 0, 0, 0, 0, 0, 4, 0, 0}, "VEC3")}}});
    const int times = b.addFloats({0, 1}, "SCALAR");
    b.add("animations", {{"samplers", {{{"input", times}, {"output", b.addFloats({0, 1}, "SCALAR")}}}},
                         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    const Scene scene = load(b).scene;
    EXPECT_EQ(shapeAt(scene, 0.5)[2], vec3(2, 1, 1.5F));
    const Scene still = frozen(scene, 0.5);
    EXPECT_EQ(still.meshes.at(still.instances[0].mesh).positions[2], vec3(2, 1, 1.5F));
    EXPECT_EQ(scene.bounds().max.x, 1.0F);
    const ScenePose pose = scenePose(scene, 0.5);
    const Aabb box = instanceBounds(scene, pose, 0, jointBounds(scene.meshes[0], 2));
    EXPECT_GE(box.max.x, 2.0F);
}

TEST(GltfMorph, WithoutNormalsEachTargetHasFlatOnes) {
    GltfBuilder b = withoutAnimation();
    primitiveOf(b)["attributes"].erase("NORMAL");
    for (const double weight : {0.0, 1.0, -1.0}) {
        b.document["meshes"][0]["weights"] = {weight, 0};
        const Scene scene = load(b).scene;
        const Mesh& mesh = scene.meshes[scene.instances[0].mesh];
        // The triangle (0, 0, 0), (1, 0, 0), (0, 1, 2w), where the deltas are linear in w.
        const vec3 flat = glm::normalize(vec3(0, -2, 1)) - vec3(0, 0, 1);
        const vec3 expected = glm::normalize(vec3(0, 0, 1) + float(weight) * flat);
        for (const VertexAttributes& vertex : mesh.attributes) {
            EXPECT_NEAR(glm::distance(vertex.normal, expected), 0.0F, 1e-6F) << weight;
        }
    }
}

TEST(GltfMorph, BoundsHoldEveryVertexAtEveryTime) {
    GltfBuilder b = morphing();
    b.document["animations"][0]["samplers"][0]["output"] = b.addFloats({-3, 1, 2, -1}, "SCALAR");
    b.document["nodes"][0]["rotation"] = {0.6, 0, 0.8, 0};
    const Scene scene = load(b).scene;
    for (double time = 0.0; time < 2.0; time += 0.25) {
        const ScenePose pose = scenePose(scene, time);
        const Aabb box = instanceBounds(scene, pose, 0, {});
        for (const vec3& p : worldPositions(scene, pose, 0)) {
            EXPECT_TRUE(glm::all(glm::lessThanEqual(box.min, p + 1e-5F))) << time;
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(box.max, p - 1e-5F))) << time;
        }
    }
    EXPECT_FALSE(morphedBounds(scene.meshes[0], scene.meshes[0].bounds, {3e38F, 0}).empty());
    EXPECT_TRUE(isFinite(vec4(morphedPosition(scene.meshes[0], 2, {3e38F, 0}), 1.0F))) << "2 times that overflows";
}

TEST(GltfMorph, QuantizedDeltasAreConverted) {
    GltfBuilder b = withoutAnimation();
    const int raise = b.addAccessor<int8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, -127, 127, 0}, "VEC4", byteType);
    b.document["accessors"][raise].update({{"normalized", true}, {"type", "VEC3"}, {"count", 3}});
    b.document["bufferViews"][b.document["accessors"][raise]["bufferView"].get<size_t>()]["byteStride"] = 4;
    primitiveOf(b)["targets"][0] = {{"POSITION", raise}};
    b.document["meshes"][0]["weights"] = {1, 0};
    const Scene scene = load(b).scene;
    EXPECT_EQ(shapeAt(scene, 0.0)[2], vec3(0, 0, 1)) << "0, 1, 0 less 0, 1, -1";
}

TEST(GltfMorph, InvalidTargetsAndWeightsAreErrors) {
    const auto complaintOf = [](const auto& change) {
        GltfBuilder b = morphing();
        change(b);
        return complaint(b.writeGltf(testFolder() / "a.gltf"));
    };
    const auto starts = [](const std::string& message, const std::string& start) {
        EXPECT_EQ(message.rfind(start, 0), 0U) << message;
    };
    starts(complaintOf([](GltfBuilder& b) { b.document["meshes"][0]["weights"] = {1}; }),
           "meshes[0].weights: has 1 weights for 2 morph targets");
    starts(complaintOf([](GltfBuilder& b) {
               b.document["nodes"][0]["weights"] = {1, 2, 3};
           }),
           "nodes[0].weights: has 3 weights for 2 morph targets");
    starts(complaintOf([](GltfBuilder& b) {
               b.document["nodes"][0]["weights"] = {"much", 2};
           }),
           "nodes[0].weights[0]: is a string");
    starts(complaintOf([](GltfBuilder& b) {
               primitiveOf(b)["targets"][0]["POSITION"] = b.addFloats({1, 2, 3}, "VEC3");
           }),
           "meshes[0].primitives[0].targets[0].POSITION: has 1 elements, but POSITION has 3");
    starts(complaintOf([](GltfBuilder& b) {
               primitiveOf(b)["targets"][1]["POSITION"] = b.addFloats({1, 2, 3}, "SCALAR");
           }),
           "meshes[0].primitives[0].targets[1].POSITION: is not an accessor of VEC3");
    starts(complaintOf([](GltfBuilder& b) {
               b.document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
           }),
           "meshes[0].primitives[1].targets: has 0 morph targets, but primitives[0] has 2");
    starts(complaintOf([](GltfBuilder& b) {
               b.document["animations"][0]["samplers"][0]["output"] = b.addFloats({0, 1}, "SCALAR");
           }),
           "accessors[7]: has 2 elements for 2 keyframes, must have 2 for each");
    starts(complaintOf([](GltfBuilder& b) {
               b.document["animations"][0]["samplers"][0]["output"] = primitiveOf(b)["attributes"]["POSITION"];
           }),
           "accessors[0]: has 3 components, but a weight has 1");
}

TEST(GltfMorph, AWeightsChannelOfANodeWithoutTargetsIsIgnoredWithAWarning) {
    GltfBuilder b = morphing();
    primitiveOf(b).erase("targets");
    const Loaded loaded = load(b);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("the channel will be ignored: nodes[0] has no mesh with morph targets"),
              std::string::npos);
    EXPECT_FALSE(isDeformed(loaded.scene.instances[0]));
}

}  // namespace
}  // namespace reflet::test::gltf_morph_test
