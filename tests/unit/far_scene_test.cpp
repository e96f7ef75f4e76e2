// Scenes far from the origin of their files.
#include "scene/camera_path.h"
#include "scene/gltf/origin.h"
#include "scene/pose.h"
#include "scene/view_file.h"

#include "gltf_builder.h"

#include <gtest/gtest.h>

namespace reflet::test::far_scene_test {
namespace {

using nlohmann::json;

// A triangle, a camera and a lamp below a node at that place.
GltfBuilder at(const glm::dvec3& place) {
    GltfBuilder b = slider();
    b.document["cameras"] = json::array({{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}});
    b.document["extensionsUsed"] = json::array({"KHR_lights_punctual"});
    b.document["extensions"]["KHR_lights_punctual"]["lights"] = json::array({{{"type", "point"}}});
    json& nodes = b.document["nodes"];
    json children = b.document["scenes"][0]["nodes"];
    for (const json& node :
         {json{{"camera", 0}, {"translation", {0.25, 1.5, 3.0}}},
          json{{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"translation", {0.1, 2.0, 0.3}}},
          json{{"mesh", 0}, {"translation", {0.3, 0.0, -0.7}}}}) {
        children.push_back(static_cast<int>(nodes.size()));
        nodes.push_back(node);
    }
    nodes.push_back({{"translation", {place.x, place.y, place.z}}, {"children", children}});
    b.document["scenes"][0]["nodes"] = json::array({static_cast<int>(nodes.size()) - 1});
    return b;
}

void expectNear(const vec3& actual, const vec3& expected) {
    EXPECT_LT(glm::distance(actual, expected), 1e-6F) << actual.x << " " << actual.y << " " << actual.z;
}

TEST(FarScene, IsTheSceneAtTheOriginMoved) {
    const Scene near = load(at({0, 0, 0})).scene;
    EXPECT_EQ(near.origin, glm::dvec3(0.0));
    for (const glm::dvec3& place : {glm::dvec3(1e5, 0, 1e5), glm::dvec3(-1e7, 2e6, 3.0)}) {
        const Scene far = load(at(place)).scene;
        const vec3 moved(place - far.origin);
        EXPECT_LT(glm::length(moved), 8.0F);
        ASSERT_EQ(far.instances.size(), near.instances.size());
        for (const double time : {0.0, 0.7}) {
            const ScenePose before = scenePose(near, time);
            const ScenePose after = scenePose(far, time);
            for (size_t i = 0; i < near.instances.size(); ++i) {
                expectNear(vec3(after.objectToWorld[i][3]), moved + vec3(before.objectToWorld[i][3]));
            }
        }
        expectNear(far.cameras.at(0).position, moved + near.cameras.at(0).position);
        expectNear(far.cameras.at(0).target, moved + near.cameras.at(0).target);
        expectNear(far.lamps.at(0).position, moved + near.lamps.at(0).position);
    }
}

TEST(FarScene, ViewFilesAndPathsSpeakTheFilesCoordinates) {
    const Scene far = load(at({1e5, 0, 1e5})).scene;
    View view = defaultView(far);
    const json file = json::parse(R"({"camera": {"position": [100000.125, 1.1, 100003.3], "target": [100000, 0, 1e5],
        "aperture_radius": 0.01, "focus": [100000, 0.5, 100000]},
        "probes": [{"position": [100000, 1, 1e5], "box_min": [99999, 0, 99999], "box_max": [100001, 2, 100001]}]})");
    applyViewJson(file, "view.json", view);
    expectNear(view.camera.position, vec3(glm::dvec3(100000.125, 1.1, 100003.3) - far.origin));
    expectNear(view.camera.focus.at(0).point, vec3(glm::dvec3(1e5, 0.5, 1e5) - far.origin));
    expectNear(view.probes->at(0).box.min, vec3(glm::dvec3(99999, 0, 99999) - far.origin));
    const json written = json(viewJson(view));
    EXPECT_NEAR(written["camera"]["position"][2].get<double>(), 100003.3, 1e-6);
    View again = defaultView(far);
    applyViewJson(written, "view.json", again);
    EXPECT_EQ(again.camera, view.camera);
    EXPECT_EQ(again.probes, view.probes);
    const auto path = testFolder() / "path.json";
    writeBytes(path,
               R"({"keyframes": [{"time": 0, "position": [100001.3, 2, 100000], "target": [100000, 0, 100000]}]})");
    expectNear(loadCameraPath(path, view.camera, far.origin).at(0.0).position,
               vec3(glm::dvec3(100001.3, 2, 1e5) - far.origin));
}

TEST(FarScene, WhatIsLargeDecidesNothing) {
    Scene scene = load(at({1e5, 0, 1e5})).scene;
    scene.origin = glm::dvec3(0.0);
    EXPECT_EQ(nearbyOrigin(scene), glm::dvec3(0.0));  // it is at the origin of the world
    EXPECT_EQ(nearbyOrigin(Scene{}), glm::dvec3(0.0));
    // Of a scene of its size, that distance is not far.
    Scene wide = load(at({100, 0, 0})).scene;
    EXPECT_EQ(wide.origin, glm::dvec3(0.0));
}

}  // namespace
}  // namespace reflet::test::far_scene_test
