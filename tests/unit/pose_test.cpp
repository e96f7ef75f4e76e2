// Animation: keyframes, nodes and skins against closed forms.
#include "scene/pose.h"

#include "scene/builtin.h"
#include "scene/bvh.h"
#include "scene/sample_channel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace reflet::pose_test {
namespace {

Channel channelOf(Channel::Target target, Interpolation interpolation, std::vector<float> times,
                  std::vector<vec4> values) {
    return {.node = 0,
            .target = target,
            .interpolation = interpolation,
            .times = std::move(times),
            .values = std::move(values)};
}

Channel moving(Interpolation interpolation) {
    return channelOf(Channel::Target::translation, interpolation, {1.0F, 2.0F, 4.0F},
                     {vec4(0, 1, 2, 0), vec4(1, 1, 6, 0), vec4(3, 0, 0, 0)});
}

/// About the z axis.
vec4 turn(double degrees) {
    const double half = 0.5 * glm::radians(degrees);
    return {0, 0, static_cast<float>(std::sin(half)), static_cast<float>(std::cos(half))};
}

double degreesOf(const glm::dvec4& turned) {
    return glm::degrees(2.0 * std::atan2(turned.z, turned.w));
}

void expectNear(const vec3& a, const vec3& b, float tolerance = 1e-6F) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(SampleChannel, AStepHoldsEachKeyUntilTheNext) {
    const Channel c = moving(Interpolation::step);
    EXPECT_EQ(sampleChannel(c, 1.0), glm::dvec4(0, 1, 2, 0));
    EXPECT_EQ(sampleChannel(c, 1.999), glm::dvec4(0, 1, 2, 0));
    EXPECT_EQ(sampleChannel(c, 2.0), glm::dvec4(1, 1, 6, 0));
    EXPECT_EQ(sampleChannel(c, 3.999), glm::dvec4(1, 1, 6, 0));
}

TEST(SampleChannel, LinearInterpolationIsExactAtTheKeys) {
    const Channel c = moving(Interpolation::linear);
    EXPECT_EQ(sampleChannel(c, 1.0), glm::dvec4(0, 1, 2, 0));
    EXPECT_EQ(sampleChannel(c, 1.25), glm::dvec4(0.25, 1, 3, 0));
    EXPECT_EQ(sampleChannel(c, 2.0), glm::dvec4(1, 1, 6, 0));
    EXPECT_EQ(sampleChannel(c, 3.0), glm::dvec4(2, 0.5, 3, 0));
}

TEST(SampleChannel, IsConstantBeforeTheFirstKeyAndAfterTheLast) {
    for (const Interpolation i : {Interpolation::step, Interpolation::linear}) {
        EXPECT_EQ(sampleChannel(moving(i), 0.0), glm::dvec4(0, 1, 2, 0));
        EXPECT_EQ(sampleChannel(moving(i), 100.0), glm::dvec4(3, 0, 0, 0));
    }
}

TEST(SampleChannel, ASplineIsCubicHermiteWithTangentsPerSecond) {
    // From 0 at 1 s with a speed of 3/s to 5 at 3 s with a speed of -1/s.
    const Channel c = channelOf(Channel::Target::translation, Interpolation::cubicSpline, {1.0F, 3.0F},
                                {vec4(9), vec4(0), vec4(3), vec4(-1), vec4(5), vec4(9)});
    EXPECT_EQ(sampleChannel(c, 0.5).x, 0.0);
    EXPECT_EQ(sampleChannel(c, 1.0).x, 0.0);
    EXPECT_EQ(sampleChannel(c, 3.0).x, 5.0);
    EXPECT_EQ(sampleChannel(c, 9.0).x, 5.0);
    for (const double t : {0.125, 0.25, 0.5, 0.875}) {
        const double expected = (3 * t * t - 2 * t * t * t) * 5.0 + 2.0 * (t * t * t - 2 * t * t + t) * 3.0 +
                                2.0 * (t * t * t - t * t) * -1.0;
        EXPECT_NEAR(sampleChannel(c, 1.0 + 2.0 * t).x, expected, 1e-12) << t;
    }
    const double speed = (sampleChannel(c, 1.0 + 1e-6).x - sampleChannel(c, 1.0).x) / 1e-6;
    EXPECT_NEAR(speed, 3.0, 1e-4);
}

TEST(SampleChannel, RotationsHaveConstantSpeedAlongTheShorterArc) {
    const auto rotation = [](const vec4& from, const vec4& to) {
        return channelOf(Channel::Target::rotation, Interpolation::linear, {0.0F, 1.0F}, {from, to});
    };
    EXPECT_NEAR(degreesOf(sampleChannel(rotation(turn(0), turn(90)), 1.0 / 3.0)), 30.0, 1e-5);
    EXPECT_NEAR(degreesOf(sampleChannel(rotation(turn(10), turn(170)), 0.25)), 50.0, 1e-5);
    EXPECT_NEAR(degreesOf(sampleChannel(rotation(turn(10), -turn(170)), 0.25)), 50.0, 1e-5) << "the same rotation";
    EXPECT_NEAR(degreesOf(sampleChannel(rotation(turn(20), turn(20.0001)), 0.5)), 20.00005, 1e-5);
    EXPECT_NEAR(glm::length(sampleChannel(rotation(turn(10), turn(170)), 0.7)), 1.0, 1e-12);
}

TEST(SampleChannel, ASplineOfRotationsIsAUnitQuaternion) {
    const Channel c = channelOf(Channel::Target::rotation, Interpolation::cubicSpline, {0.0F, 1.0F},
                                {vec4(0), turn(0), vec4(0), vec4(0), turn(120), vec4(0)});
    EXPECT_NEAR(degreesOf(sampleChannel(c, 0.5)), 60.0, 1e-5) << "halfway by symmetry";
    EXPECT_NEAR(glm::length(sampleChannel(c, 0.3)), 1.0, 1e-12);
}

/// A node at (2, 0, 0), scaled by 2, that rotates about z by 90 degrees in 1 s; and a child at (1, 0, 0).
Scene carousel() {
    Scene scene;
    scene.nodes.resize(3);
    scene.nodes[0].translation = {2, 0, 0};
    scene.nodes[0].scale = glm::dvec3(2);
    scene.nodes[1].parent = 0;
    scene.nodes[1].translation = {1, 0, 0};
    scene.animations.push_back({"turn", {}});
    scene.animations[0].channels.push_back(
        channelOf(Channel::Target::rotation, Interpolation::linear, {0.0F, 1.0F}, {turn(0), turn(90)}));
    return scene;
}

TEST(ScenePose, ANodeIsScaledThenRotatedThenTranslatedThenTransformedByItsParent) {
    const ScenePose pose = scenePose(carousel(), 0.5);
    const float s = std::sqrt(0.5F);
    expectNear(vec3(pose.nodeToWorld[1] * vec4(0, 0, 0, 1)), {2 + 2 * s, 2 * s, 0});
    expectNear(vec3(pose.nodeToWorld[1] * vec4(1, 0, 0, 1)), {2 + 4 * s, 4 * s, 0});
    EXPECT_EQ(pose.moving, (std::vector<bool>{true, true, false})) << "its children move, too";
}

TEST(ScenePose, AllAnimationsPlayAndBeginAgainAtTheEndOfTheLongest) {
    Scene scene = carousel();
    scene.animations.push_back({"slide", {}});
    Channel slide = moving(Interpolation::linear);  // ends at 4 s
    slide.node = 2;
    scene.animations[1].channels.push_back(slide);
    EXPECT_EQ(animationDuration(scene), 4.0);
    for (const double time : {3.0, 7.0, 4003.0}) {
        const ScenePose pose = scenePose(scene, time);
        EXPECT_EQ(pose.time, 3.0);
        EXPECT_EQ(vec3(pose.nodeToWorld[2][3]), vec3(2, 0.5F, 3));
        expectNear(vec3(pose.nodeToWorld[0] * vec4(1, 0, 0, 1)), {2, 2, 0});  // at its end since 1 s
    }
    EXPECT_EQ(scenePose(scene, 4.0).time, 0.0);
}

TEST(ScenePose, WhatIsNotAnimatedKeepsItsTransformToTheBit) {
    Scene scene = carousel();
    const mat4 odd = glm::rotate(mat4(1.0F), 0.1F, vec3(1, 2, 3));
    scene.meshes.resize(1);
    scene.instances.push_back({"free", 0, odd});
    scene.instances.push_back({"on a static node", 0, odd, 2});
    scene.instances.push_back({"on an animated one", 0, odd, 1});
    const ScenePose pose = scenePose(scene, 0.5);
    EXPECT_EQ(pose.objectToWorld[0], odd);
    EXPECT_EQ(pose.objectToWorld[1], odd);
    EXPECT_EQ(pose.objectToWorld[2], pose.nodeToWorld[1]);
    EXPECT_FALSE(isAnimated(pose, scene.instances[0]) || isAnimated(pose, scene.instances[1]));
    EXPECT_TRUE(isAnimated(pose, scene.instances[2]));
    Scene still;
    still.instances.push_back({"free", 0, odd});
    EXPECT_EQ(scenePose(still, 12.0).time, 0.0) << "nothing is animated";
}

TEST(ScenePose, CamerasLampsAndTheSunMoveWithTheirNodes) {
    Scene scene = carousel();
    scene.animations[0].channels[0].values = {vec4(0, 0, 0, 1), vec4(0, std::sqrt(0.5F), 0, std::sqrt(0.5F))};  // +Y
    Camera camera;
    camera.node = 1;
    scene.cameras.push_back(camera);
    scene.sun = Sun{.irradiance = vec3(1), .node = 0};
    Lamp lamp;
    lamp.type = Lamp::Type::spot;
    lamp.node = 1;
    View view = defaultView(scene);
    view.time = 4.0;  // the animation ends at 1 s: its start
    EXPECT_EQ(posed(view, scene).time, 0.0);
    scene.animations[0].channels[0].times = {0.0F, 0.5F};
    scene.animations[0].channels[0].values.push_back(scene.animations[0].channels[0].values[1]);
    scene.animations[0].channels[0].times.push_back(5.0F);
    const View seen = posed(view, scene);  // rotated by 90 degrees: -Z became -X, +X became -Z
    expectNear(seen.camera.position, {2, 0, -2});
    expectNear(glm::normalize(seen.camera.target - seen.camera.position), {-1, 0, 0});
    expectNear(seen.sun.direction, {-1, 0, 0});
    const Lamp shining = posed(lamp, scenePose(scene, 4.0));
    expectNear(shining.position, {2, 0, -2});
    expectNear(shining.direction, {-1, 0, 0});
    view.camera.node = -1;
    EXPECT_EQ(posed(view, scene).camera.position, view.camera.position) << "a camera without a node stays";
}

/// A bar along x with three vertices at 0, 1, 2: the first follows a joint at 0, the last a joint at 1 that rotates
/// about z, the middle one both.
Scene bar() {
    Scene scene;
    scene.nodes.resize(2);
    scene.nodes[1].parent = 0;
    scene.nodes[1].translation = {1, 0, 0};
    scene.animations.push_back({"bend", {}});
    scene.animations[0].channels.push_back(
        channelOf(Channel::Target::rotation, Interpolation::linear, {0.0F, 1.0F, 2.0F}, {turn(0), turn(90), turn(90)}));
    scene.animations[0].channels[0].node = 1;
    Mesh mesh;
    mesh.positions = {vec3(0, 0, 0), vec3(1, 0, 1), vec3(2, 0, 0)};
    mesh.attributes.resize(3);
    mesh.indices = {0, 1, 2};
    mesh.jointWeights = {{0, 0.5F}, {1, 0.5F}, {0, 1.0F}, {1, 1.0F}};
    mesh.skin = {{2, 1}, {0, 2}, {3, 1}};
    for (const vec3& p : mesh.positions) {
        mesh.bounds.add(p);
    }
    scene.meshes.push_back(mesh);
    scene.materials.resize(1);
    scene.instances.push_back({"bar", 0, glm::translate(mat4(1.0F), vec3(7)), -1, 0});
    scene.skins.push_back({{0, 1}, {mat4(1.0F), glm::translate(mat4(1.0F), vec3(-1, 0, 0))}});
    return scene;
}

TEST(Skin, PlacesVerticesByTheirJointsRegardlessOfTheInstancesTransform) {
    const Scene scene = bar();
    const auto atStart = worldPositions(scene, scenePose(scene, 0.0), 0);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(atStart[i], scene.meshes[0].positions[i]) << "the bind pose";
    }
    const auto bent = worldPositions(scene, scenePose(scene, 1.0), 0);
    expectNear(bent[0], {0, 0, 0});
    expectNear(bent[1], {1, 0, 1});  // on the joint's axis
    expectNear(bent[2], {1, 1, 0});  // (2, 0, 0) about (1, 0, 0)
}

TEST(Skin, NormalsTurnWithTheirJointsAndAFrozenSceneHoldsThem) {
    Scene scene = bar();
    for (VertexAttributes& a : scene.meshes[0].attributes) {
        a.normal = {0, 1, 0};
        a.tangent = {1, 0, 0, 1};
    }
    const Scene still = frozen(scene, 1.0);
    ASSERT_TRUE(still.nodes.empty() && still.animations.empty() && still.skins.empty());
    ASSERT_EQ(still.instances[0].skin, -1);
    const Mesh& mesh = still.meshes.at(still.instances[0].mesh);
    expectNear(mesh.attributes[2].normal, {-1, 0, 0});
    expectNear(vec3(mesh.attributes[2].tangent), {0, 1, 0});
    expectNear(mesh.attributes[1].normal, glm::normalize(vec3(-0.5F, 0.5F, 0)));
    expectNear(mesh.positions[2], {1, 1, 0});
    EXPECT_EQ(still.instances[0].objectToWorld, mat4(1.0F));
}

TEST(Skin, AMirroringJointFlipsTrianglesAndTangentsButKeepsNormalsOutside) {
    Scene scene = bar();
    scene.nodes[0].scale = {1, 1, -1};
    scene.meshes[0].attributes[0].normal = {0, 0, 1};
    scene.meshes[0].attributes[0].tangent = {1, 0, 0, 1};
    EXPECT_TRUE(flipsWinding(scenePose(scene, 0.0).skins[0]));
    const Scene still = frozen(scene, 0.0);
    const Mesh& mesh = still.meshes.at(still.instances[0].mesh);
    EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 2, 1}));
    expectNear(mesh.attributes[0].normal, {0, 0, -1});
    EXPECT_EQ(mesh.attributes[0].tangent.w, -1.0F);
    EXPECT_EQ(sceneTriangles(scene)[0].flags & triangleMirrored, triangleMirrored);
}

TEST(Skin, BoundsHoldEveryVertexAtEveryTime) {
    const Scene scene = findBuiltinScene("moving")->make();
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const int32_t skin = scene.instances[i].skin;
        const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        const auto byJoint = jointBounds(mesh, skin < 0 ? 0 : scene.skins[static_cast<size_t>(skin)].joints.size());
        for (double time = 0.0; time < 4.0; time += 0.37) {
            const ScenePose pose = scenePose(scene, time);
            const Aabb box = instanceBounds(scene, pose, i, byJoint);
            Aabb exact;
            for (const vec3& p : worldPositions(scene, pose, i)) {
                exact.add(p);
            }
            EXPECT_TRUE(glm::all(glm::lessThanEqual(box.min, exact.min + 1e-5F))) << scene.instances[i].name;
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(box.max, exact.max - 1e-5F))) << scene.instances[i].name;
            EXPECT_LT(glm::length(box.size()), 1.6F * glm::length(exact.size()) + 1e-4F) << scene.instances[i].name;
        }
    }
}

TEST(BuiltinMoving, ABoxSlidesFromTimeZeroAndStandsStillFromOneSecondOnWhileOthersMove) {
    const Scene scene = findBuiltinScene("moving")->make();
    const auto place = [&](const std::string& name, double time) {
        for (size_t i = 0; i < scene.instances.size(); ++i) {
            if (scene.instances[i].name == name) {
                return worldPositions(scene, scenePose(scene, time), i);
            }
        }
        return std::vector<vec3>{};
    };
    EXPECT_NE(place("sliding box", 0.0), place("sliding box", 0.01));
    EXPECT_NE(place("sliding box", 0.99), place("sliding box", 1.0));
    EXPECT_EQ(place("sliding box", 1.0), place("sliding box", 3.9));
    EXPECT_NE(place("turning cube", 1.0), place("turning cube", 1.1));
    EXPECT_NE(place("bending tube", 0.0), place("bending tube", 0.01));
    EXPECT_NE(place("bending tube", 1.5), place("bending tube", 1.6));
}

}  // namespace
}  // namespace reflet::pose_test
