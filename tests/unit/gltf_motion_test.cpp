// Animations and skins of glTF files: what is loaded, and the errors of invalid ones.
#include "gltf_builder.h"
#include "scene/pose.h"

#include <gtest/gtest.h>

namespace reflet::test::gltf_motion_test {
namespace {

using nlohmann::json;

TEST(GltfMotion, AnAnimatedNodeIsWhereItsKeyFramesSay) {
    const Loaded loaded = load(slider());
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(animationDuration(loaded.scene), 2.0);
    EXPECT_EQ(vec3(scenePose(loaded.scene, 0.5).objectToWorld[0][3]), vec3(1, 0, 0));
    EXPECT_EQ(loaded.scene.animations[0].name, "slide");
}

TEST(GltfMotion, ChannelsFindTheirNodesWhateverTheirOrderInTheFile) {
    GltfBuilder b = slider();
    b.document["nodes"] = json::array({{{"mesh", 0}, {"name", "leaf"}}, {{"name", "root"}, {"children", {0}}}});
    b.document["scenes"][0]["nodes"] = {1};
    b.document["animations"][0]["channels"][0]["target"]["node"] = 1;  // the parent, which is listed last
    const Scene scene = load(std::move(b)).scene;
    EXPECT_EQ(vec3(scenePose(scene, 1.0).objectToWorld[0][3]), vec3(2, 0, 0));
}

TEST(GltfMotion, IntegersAndSplinesAreReadAsTheSpecificationHasThem) {
    GltfBuilder b = slider();
    const int times = b.addFloats({0, 1}, "SCALAR");
    const std::vector<int16_t> quarter{0, 0, 0, 32767, 0, 0, 23170, 23170};
    const int turns = b.addAccessor<int16_t>(quarter, "VEC4", shortType);
    b.document["accessors"][turns]["normalized"] = true;
    const int sizes = b.addFloats({0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 3, 3, 3, 0, 0, 0}, "VEC3");
    auto& animation = b.document["animations"][0];
    animation["samplers"].push_back({{"input", times}, {"output", turns}});
    animation["samplers"].push_back({{"input", times}, {"output", sizes}, {"interpolation", "CUBICSPLINE"}});
    animation["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}});
    animation["channels"].push_back({{"sampler", 2}, {"target", {{"node", 0}, {"path", "scale"}}}});
    const mat4 m = scenePose(load(std::move(b)).scene, 1.0).objectToWorld[0];
    EXPECT_NEAR(m[0].y, 3.0F, 1e-4F);  // +X became +Y, scaled by 3
    EXPECT_NEAR(m[3].x, 2.0F, 1e-6F);
}

TEST(GltfMotion, ASkinPutsVerticesWhereItsJointsAre) {
    const Loaded loaded = load(bent());
    EXPECT_TRUE(loaded.warnings.empty());
    const Scene& scene = loaded.scene;
    EXPECT_EQ(scene.meshes[0].jointsOf(0).size(), 1U) << "a joint of weight 0 is ignored";
    const auto positions = worldPositions(scene, scenePose(scene, 0.0), 0);
    EXPECT_EQ(positions[0], vec3(0, 0, 0));
    EXPECT_EQ(positions[1], vec3(1, 0, 0));
    EXPECT_EQ(positions[2], vec3(0, 1, 1.5F)) << "three quarters of 2";
    EXPECT_FALSE(scene.bounds().empty());
    EXPECT_EQ(scene.bounds().max.z, 2.0F) << "the mesh's node has no effect";
}

TEST(GltfMotion, UnsupportedFeaturesAreWarnedOf) {
    GltfBuilder b = slider();
    b.document["animations"][0]["channels"][0]["target"]["path"] = "pointer";
    Loaded loaded = load(b);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("the channel will be ignored: pointer is not supported"), std::string::npos);
    b.document["animations"][0]["channels"][0]["target"]["path"] = "translation";
    b.document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1};
    loaded = load(b);
    ASSERT_EQ(loaded.warnings.size(), 1U);
    EXPECT_NE(loaded.warnings[0].find("will not be animated: it has a matrix"), std::string::npos);
    EXPECT_EQ(vec3(scenePose(loaded.scene, 1.0).objectToWorld[0][3]), vec3(5, 0, 0));
}

TEST(GltfMotion, AFileWithoutAnimationsAndSkinsHasNoNodes) {
    const Scene scene = load(triangle()).scene;
    EXPECT_TRUE(scene.nodes.empty());
    EXPECT_EQ(scene.instances[0].node, -1);
}

struct BrokenMotion {
    GltfBuilder builder;
    const char* pointer;
    json value;
    const char* starts;       ///< of the message
    const char* consequence;  ///< of the warning if loading is not strict
};

TEST(GltfMotion, InvalidAnimationsAndSkinsAreErrorsIfStrictAndElseWarnings) {
    const GltfBuilder s = slider();
    const GltfBuilder k = bent();
    GltfBuilder back = slider();
    const int equalTimes = back.addFloats({1, 1}, "SCALAR");
    constexpr const char* noChannel = "the channel will be ignored";
    constexpr const char* noSkin = "the mesh will not be deformed";
    const std::vector<BrokenMotion> cases{
        {s, "/animations/0/channels/0/sampler", 1, "animations[0].channels[0].sampler: is 1", noChannel},
        {s, "/animations/0/channels/0/target/node", 4,
         "animations[0].channels[0].target.node: is 4, but there are 1 nodes", noChannel},
        {s, "/animations/0/samplers/0/output", 99, "animations[0].samplers[0].output: is 99", noChannel},
        {s, "/animations/0/samplers/0/interpolation", "SMOOTH",
         "animations[0].samplers[0].interpolation: is \"SMOOTH\"", "its default will be used"},
        {s, "/animations/0/samplers/0/interpolation", "CUBICSPLINE", "accessors[2]: has 2 elements for 2 keyframes",
         noChannel},
        {s, "/animations/0/samplers/0/input", 2, "accessors[2]: must hold the keyframes' times", noChannel},
        {s, "/animations/0/channels/0/target/path", "rotation", "accessors[2]: has 3 components", noChannel},
        {back, "/animations/0/samplers/0/input", equalTimes, "accessors[3]: time 1 is not later than", noChannel},
        {k, "/skins/0/joints", {1, 7}, "skins[0].joints[1]: is 7, but there are 3 nodes", noSkin},
        {k, "/skins/0/joints", json::array(), "skins[0].joints: is empty", noSkin},
        {k, "/skins/0/joints", {1, 2, 0}, "skins[0].inverseBindMatrices: has 2 matrices for 3 joints", noSkin},
        {k, "/skins/0/inverseBindMatrices", 0, "skins[0].inverseBindMatrices: is not an accessor of MAT4", noSkin},
        {k, "/skins/0/joints", {1}, "nodes[0].skin: its mesh names joint 1, but there are 1", noSkin}};
    for (const BrokenMotion& broken : cases) {
        GltfBuilder b = broken.builder;
        b.document[json::json_pointer(broken.pointer)] = broken.value;
        expectProblem(b.writeGltf(testFolder() / "a.gltf"), broken.starts, broken.consequence);
    }
}

}  // namespace
}  // namespace reflet::test::gltf_motion_test
