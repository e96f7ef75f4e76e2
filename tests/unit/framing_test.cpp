// The camera of scenes that bring none, measured by projecting what it has to show.
#include "scene/framing.h"

#include "gltf_builder.h"
#include "scene/builtin/assemble.h"
#include "scene/camera_path.h"
#include "scene/pose.h"

#include <gtest/gtest.h>

#include <random>

namespace reflet::framing_test {
namespace {

constexpr std::array aspects{16.0F / 9.0F, 1.0F, 9.0F / 16.0F, 0.2F};

// One triangle per point and its two successors.
Mesh meshOf(const std::vector<vec3>& points) {
    Mesh mesh;
    for (const vec3& p : points) {
        mesh.positions.push_back(p);
        mesh.bounds.add(p);
    }
    const auto count = static_cast<uint32_t>(points.size());
    for (uint32_t i = 0; i < count; ++i) {
        mesh.indices.insert(mesh.indices.end(), {i, (i + 1) % count, (i + 2) % count});
    }
    return mesh;
}

// Four corners, counter-clockwise seen from its front.
Mesh quad(const std::array<vec3, 4>& corners) {
    Mesh mesh = meshOf({corners.begin(), corners.end()});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

Mesh box(const vec3& min, const vec3& max, bool inward = false) {
    std::vector<vec3> corners;
    Aabb bounds;
    bounds.add(min);
    bounds.add(max);
    for (unsigned i = 0; i < 8; ++i) {
        corners.push_back(bounds.corner(i));
    }
    Mesh mesh = meshOf(corners);
    mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    for (size_t i = 0; inward && i < mesh.indices.size(); i += 3) {
        std::swap(mesh.indices[i], mesh.indices[i + 1]);
    }
    return mesh;
}

Scene sceneOf(std::vector<Mesh> meshes, bool doubleSided = false) {
    Scene scene;
    scene.materials.emplace_back().doubleSided = doubleSided;
    for (Mesh& mesh : meshes) {
        builtin::place(scene, "", 0, std::move(mesh));
    }
    return scene;
}

std::vector<vec3> allPoints(const Scene& scene, double time = 0.0) {
    const ScenePose pose = scenePose(scene, time);
    std::vector<vec3> points;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const std::vector<vec3> positions = worldPositions(scene, pose, i);
        points.insert(points.end(), positions.begin(), positions.end());
    }
    return points;
}

struct Extent {
    vec2 low{2.0F};    // uv
    vec2 high{-1.0F};  // uv
    float nearest = std::numeric_limits<float>::max();
};

Extent extentOf(const Camera& camera, const std::vector<vec3>& points, float aspect) {
    const mat4 toView = worldToView(camera);
    const mat4 toClip = viewToClip(camera, aspect);
    Extent extent;
    for (const vec3& p : points) {
        const vec4 clip = toClip * (toView * vec4(p, 1.0F));
        const vec2 uv = 0.5F + 0.5F * vec2(clip) / clip.w;
        extent.low = glm::min(extent.low, uv);
        extent.high = glm::max(extent.high, uv);
        extent.nearest = std::min(extent.nearest, clip.w);
    }
    return extent;
}

// 85 % of the width or of the height, at most that of the other, both centred; nothing clipped by the near plane.
void expectFramed(const Camera& camera, const std::vector<vec3>& points, float aspect) {
    const Extent extent = extentOf(camera, points, aspect);
    const vec2 size = extent.high - extent.low;
    EXPECT_NEAR(std::max(size.x, size.y), framedShare, 0.005F) << aspect;
    EXPECT_NEAR(extent.low.x + extent.high.x, 1.0F, 0.005F) << aspect;
    EXPECT_NEAR(extent.low.y + extent.high.y, 1.0F, 0.005F) << aspect;
    EXPECT_LT(camera.near, extent.nearest);
    EXPECT_GE(camera.near, 1e-4F * extent.nearest);
}

void expectFramed(const Scene& scene) {
    for (const float aspect : aspects) {
        expectFramed(framingCamera(scene, aspect), allPoints(scene), aspect);
    }
}

vec3 sideSeen(const Scene& scene) {
    const Camera camera = framingCamera(scene, 1.0F);
    return glm::normalize(camera.position - camera.target);
}

TEST(Framing, ABoxIsSeenFromTheFrontTheRightAndAboveAndFillsTheImage) {
    const Scene scene = sceneOf({box({-1, 0, -2}, {1, 3, 2})});
    expectFramed(scene);
    EXPECT_GT(sideSeen(scene).z, 0.7F);
    EXPECT_GT(sideSeen(scene).x, 0.3F);
    EXPECT_GT(sideSeen(scene).y, 0.2F);
}

TEST(Framing, AWholeTurnShowsEverythingAndFillsTheImage) {
    for (const Scene& scene : {sceneOf({box({-1, 0, -2}, {1, 3, 2})}), sceneOf({box({3, -1, 5}, {9, -0.9F, 5.2F})}),
                               sceneOf({meshOf({vec3(0), vec3(1, -2, 0.5F), vec3(7, 0, 0)})}, true)}) {
        for (const float aspect : aspects) {
            const TurningCamera turning = turningCamera(scene, aspect, 0.0, std::nullopt);
            Extent all;
            for (int i = 0; i < 64; ++i) {
                const Camera camera = orbit(turning.camera, turning.pivot, i / 64.0);
                const Extent extent = extentOf(camera, allPoints(scene), aspect);
                all.low = glm::min(all.low, extent.low);
                all.high = glm::max(all.high, extent.high);
                EXPECT_LT(camera.near, extent.nearest);
            }
            const vec2 size = all.high - all.low;
            EXPECT_NEAR(std::max(size.x, size.y), framedShare, 0.01F) << aspect;
            EXPECT_NEAR(all.low.x + all.high.x, 1.0F, 0.01F) << aspect;
            EXPECT_NEAR(all.low.y + all.high.y, 1.0F, 0.01F) << aspect;
        }
    }
}

TEST(Framing, ATurnInAClosedRoomIsAroundTheCamera) {
    const Scene room = sceneOf({box({-3, 0, -5}, {3, 3, 5}, true)}, true);
    const TurningCamera turning = turningCamera(room, 1.5F, 0.0, std::nullopt);
    EXPECT_EQ(turning.pivot, turning.camera.position);
    EXPECT_EQ(turning.camera, framingCamera(room, 1.5F));
    EXPECT_NE(turningCamera(room, 1.5F, 0.0, vec3(0, 0, -1)).pivot, turning.pivot) << "as asked, from outside";
}

TEST(Framing, NeedlesFillTheImageInEveryDirection) {
    for (const vec3& along : {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, -2, 0.5F)}) {
        expectFramed(sceneOf({meshOf({vec3(0), along, along + vec3(0.001F, 0.002F, 0)})}, true));
    }
}

TEST(Framing, ANeedleThatPointsAtTheCameraIsInFrontOfIt) {
    const vec3 ahead = glm::normalize(vec3(-1, -1, -2));
    const Camera camera = fitCamera({vec3(0), 4.0F * ahead}, ahead, 0.8F, 1.5F);
    const Extent extent = extentOf(camera, {vec3(0), 4.0F * ahead}, 1.5F);
    EXPECT_GT(extent.nearest, camera.near);
    EXPECT_NEAR(extent.low.x, 0.5F, 1e-3F);
    EXPECT_NEAR(extent.high.y, 0.5F, 1e-3F);
}

TEST(Framing, RandomCloudsFillTheImageWhereverTheyAreAndHoweverLarge) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    for (const float size : {1e-4F, 1e-2F, 1.0F, 1e3F, 1e5F}) {
        for (const float offset : {0.0F, 1.0F, 100.0F}) {  // times the size
            std::vector<vec3> points;
            for (int i = 0; i < 200; ++i) {
                const vec3 p{uniform(random), uniform(random), uniform(random)};
                points.push_back(size * (p * p * p + offset));
            }
            expectFramed(sceneOf({meshOf(points)}, true));
        }
    }
    expectFramed(sceneOf({box({1e6F, 1e6F, -1e6F}, {1.01e6F, 1.02e6F, -0.99e6F})}));
}

TEST(Framing, ASkinnedFigureIsFramedWhereItsPosePutsIt) {
    test::GltfBuilder b = test::bent();
    b.document["nodes"][1]["translation"] = {50, -20, 30};
    b.document["nodes"][1]["scale"] = {3, 3, 3};
    b.add("materials", {{"doubleSided", true}});
    b.document["meshes"][0]["primitives"][0]["material"] = 0;
    const Scene scene = test::load(b).scene;
    ASSERT_GT(allPoints(scene)[0].x, 40.0F);
    expectFramed(scene);
}

TEST(Framing, ACameraOfAnyDirectionFramesTheSceneWithoutTurning) {
    const Scene scene = sceneOf({box({-1, 0, -2}, {3, 1, 4})});
    for (const float height : {0.0F, 1.0F}) {
        for (const vec3& up : {vec3(0, 1, 0), vec3(1, 0.2F, 0)}) {
            for (const float aspect : aspects) {
                Camera camera;
                camera.position = {0.5F, 9, 1};
                camera.target = {1, 0, 2};
                camera.up = up;
                camera.orthographicHeight = height;
                camera.far = 0.2F;
                camera.node = 3;
                const vec3 forward = glm::normalize(camera.target - camera.position);
                frameScene(camera, scene, aspect);
                const std::vector<vec3> points = allPoints(scene);
                const Extent extent = extentOf(camera, points, aspect);
                const vec2 size = extent.high - extent.low;
                EXPECT_NEAR(std::max(size.x, size.y), framedShare, 0.005F) << aspect;
                EXPECT_NEAR(extent.low.x + extent.high.x, 1.0F, 0.005F) << aspect;
                EXPECT_NEAR(extent.low.y + extent.high.y, 1.0F, 0.005F) << aspect;
                EXPECT_NEAR(glm::distance(glm::normalize(camera.target - camera.position), forward), 0.0F, 1e-5F);
                EXPECT_EQ(camera.node, -1);
                const mat4 toClip = viewToClip(camera, aspect) * worldToView(camera);
                for (const vec3& p : points) {  // reversed depth, between the planes
                    const vec4 clip = toClip * vec4(p, 1.0F);
                    EXPECT_GE(clip.z / clip.w, 0.0F);
                    EXPECT_LE(clip.z / clip.w, 1.0F);
                }
            }
        }
    }
}

TEST(Framing, WhatMovesIsFramedAtTheTimeThatIsAskedFor) {
    const Scene scene = test::load(test::slider()).scene;
    const Camera camera = framingCamera(scene, 1.0F, 1.0);
    expectFramed(camera, allPoints(scene, 1.0), 1.0F);
    EXPECT_LT(extentOf(camera, allPoints(scene, 0.0), 1.0F).low.x, 0.0F);
}

TEST(Framing, FlatThingsAreSeenFromTheirFront) {
    const Mesh floor = quad({vec3(0, 0, 1), vec3(1, 0, 1), vec3(1, 0, 0), vec3(0, 0, 0)});
    const Mesh ceiling = quad({vec3(0, 0, 0), vec3(1, 0, 0), vec3(1, 0, 1), vec3(0, 0, 1)});
    const Mesh left = quad({vec3(0, 0, 0), vec3(0, 0, 1), vec3(0, 1, 1), vec3(0, 1, 0)});
    const Mesh back = quad({vec3(1, 0, 0), vec3(0, 0, 0), vec3(0, 1, 0), vec3(1, 1, 0)});
    const std::array<std::pair<const Mesh*, vec3>, 4> cases{
        {{&floor, vec3(0, 1, 0)}, {&ceiling, vec3(0, -1, 0)}, {&left, vec3(-1, 0, 0)}, {&back, vec3(0, 0, -1)}}};
    for (const auto& [mesh, normal] : cases) {
        const Scene scene = sceneOf({*mesh});
        EXPECT_GT(glm::dot(sideSeen(scene), normal), 0.6F) << glm::dot(sideSeen(scene), vec3(1, 10, 100));
        expectFramed(scene);
    }
}

TEST(Framing, ABoxThatIsOpenToOneSideIsSeenFromThere) {
    Mesh room = box({0, 0, 0}, {1, 1, 1}, true);
    room.indices.resize(30);  // without the wall at z = 1, the last one
    EXPECT_GT(sideSeen(sceneOf({room}, true)).z, 0.9F);
    expectFramed(sceneOf({room}, true));
}

TEST(Framing, ManyEqualLargeThingsAreSeenAsOne) {  // so many that only some of them are drawn
    Mesh room = box({0, 0, 0}, {1, 1, 1}, true);
    room.indices.resize(30);
    const std::vector<uint32_t> one = room.indices;
    for (int i = 0; i < 4000; ++i) {
        room.indices.insert(room.indices.end(), one.begin(), one.end());
    }
    EXPECT_GT(sideSeen(sceneOf({room}, true)).z, 0.9F);
}

TEST(Framing, AClosedRoomIsSeenFromInsideAlongItsLongerSide) {
    const Scene scene = sceneOf({box({0, 0, 0}, {8, 3, 4}, true), box({1, 0, 1}, {2, 1, 2})}, true);
    const Camera camera = framingCamera(scene, 1.5F);
    EXPECT_GT(camera.position.x, 6.0F);
    EXPECT_LT(camera.position.x, 8.0F);
    EXPECT_NEAR(camera.position.z, 2.0F, 0.01F);
    EXPECT_LT(camera.target.x, camera.position.x);
    EXPECT_LT(camera.near, 0.2F);
}

TEST(Framing, WallsWithoutBacksAreLookedThrough) {
    expectFramed(sceneOf({box({0, 0, 0}, {8, 3, 4}, true)}));
}

TEST(Framing, SkyAndGroundFarLargerThanTheRestAreBackground) {
    const Mesh figure = box({-1, 0, -1}, {1, 2, 1});
    const Mesh sky = box(vec3(-500), vec3(500), true);
    const Mesh ground = quad({vec3(-90, 0, 90), vec3(90, 0, 90), vec3(90, 0, -90), vec3(-90, 0, -90)});
    const std::vector<vec3> wanted = allPoints(sceneOf({figure}));
    expectFramed(framingCamera(sceneOf({sky, ground, figure}), 1.5F), wanted, 1.5F);
    expectFramed(framingCamera(sceneOf({figure, ground}), 1.5F), wanted, 1.5F);
    expectFramed(sceneOf({figure, box({0, 0, 0}, {20, 20, 20})}));  // a large object is none
}

TEST(Framing, WithoutExtentOrContentThereIsStillACamera) {
    const std::vector<vec3> same(3, vec3(2, 2, 2));
    for (const Scene& scene : {Scene{}, sceneOf({Mesh{}}), sceneOf({meshOf(same)}),
                               sceneOf({meshOf({vec3(1e30F), vec3(std::numeric_limits<float>::infinity())})})}) {
        const Camera camera = framingCamera(scene, 1.5F);
        EXPECT_GT(camera.near, 0.0F);
        EXPECT_TRUE(std::isfinite(glm::length(camera.position)));
        EXPECT_GT(glm::distance(camera.position, camera.target), camera.near);
    }
    const Camera camera = framingCamera(sceneOf({meshOf(same)}), 1.5F);
    EXPECT_NEAR(extentOf(camera, same, 1.5F).low.x, 0.5F, 1e-3F);
}

}  // namespace
}  // namespace reflet::framing_test
