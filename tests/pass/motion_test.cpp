// Moving objects: exact motion vectors, and frames at a time against those of a static scene in the same pose.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "scene/builtin.h"

#include <cmath>

namespace reflet::test::motion_test {
namespace {

constexpr uvec2 size(96, 54);
const std::vector<std::string> plainly{"diffuse.rays=0", "specular.rays=0"};

View viewAt(double time, const vec3& position = {0, 0, 3}, const vec3& target = {0, 0, 0}) {
    View view;
    view.camera = builtin::camera("", position, target, 50);
    view.environment.radiance = vec3(1.0F);
    view.time = time;
    return view;
}

void addChannel(Scene& scene, Channel channel) {
    scene.animations.resize(1);
    scene.animations[0].channels.push_back(std::move(channel));
}

// A wall across the view; from 1 s to 2 s it moves by (0.5, 0.25, 0).
Scene slidingWall() {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::patch({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {3, 3}, {}}));
    scene.nodes.resize(1);
    scene.instances[0].node = 0;
    addChannel(scene, {.target = Channel::Target::translation,
                       .times = {0.0F, 1.0F, 2.0F, 3.0F},
                       .values = {vec4(0), vec4(0), vec4(0.5F, 0.25F, 0, 0), vec4(0.5F, 0.25F, 0, 0)}});
    return scene;
}

// Half floats have 11 bits, and may be truncated; the rest is rounding of interpolated vertex attributes.
float halfFloatTolerance(float value) {
    return std::abs(value) * 0x1p-10F + 4e-6F;
}

// uv now of a point less uv before, where `before` is where it was.
vec2 motionOf(const View& viewNow, const View& viewBefore, const vec3& now, const vec3& before) {
    const auto uv = [&](const View& view, const vec3& p) {
        const glm::dvec4 clip = glm::dmat4(makeViewParams(view.camera, size, 0, 0).worldToClip) * glm::dvec4(p, 1.0);
        return 0.5 + 0.5 * glm::dvec2(clip) / clip.w;
    };
    return uv(viewNow, now) - uv(viewBefore, before);
}

TEST(Motion, OfAWallThatSlidesIsTheSameInEveryPixelToAHalfFloatsPrecision) {
    const Pictures p =
        renderMoved(slidingWall(), viewAt(1.0), viewAt(1.5), size, settingsOf(plainly), {"motion", "depth"});
    const vec2 expected = motionOf(viewAt(0), viewAt(0), {0.25F, 0.125F, 0}, {0, 0, 0});
    EXPECT_GT(expected.x, 0.04F);
    EXPECT_LT(expected.y, -0.04F) << "uv is down where the world is up";
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            ASSERT_TRUE(p.hasSurface(x, y));
            ASSERT_NEAR(p.value("motion", x, y, 0), expected.x, halfFloatTolerance(expected.x)) << x << ", " << y;
            ASSERT_NEAR(p.value("motion", x, y, 1), expected.y, halfFloatTolerance(expected.y)) << x << ", " << y;
        }
    }
    expectSilentValidation("a sliding wall");
}

TEST(Motion, IsNoneInTheFirstFrameAndWhereTimeStandsStill) {
    const Scene scene = slidingWall();
    for (const uint32_t frames : {1U, 3U}) {
        const Range r =
            rangeOf(render(scene, viewAt(1.5), size, settingsOf(plainly), {"motion"}, frames).images.at("motion"));
        EXPECT_EQ(r.min, 0.0F);
        EXPECT_EQ(r.max, 0.0F);
    }
    const Pictures stopped = renderMoved(scene, viewAt(2.0), viewAt(2.5), size, settingsOf(plainly), {"motion"});
    EXPECT_EQ(rangeOf(stopped.images.at("motion")).max, 0.0F) << "it has stopped";
}

TEST(Motion, OfATurningWallUnderAMovingCameraIsThatOfItsPoints) {
    Scene scene = slidingWall();
    scene.animations.clear();
    const auto turned = [](double degrees) {
        const double half = 0.5 * glm::radians(degrees);
        return vec4(0, 0.6 * std::sin(half), 0.8 * std::sin(half), std::cos(half));
    };
    addChannel(scene, {.target = Channel::Target::rotation, .times = {0.0F, 1.0F}, .values = {turned(0), turned(40)}});
    const View before = viewAt(0.25);
    const View now = viewAt(0.5, {0.2F, 0.1F, 3.1F}, {0.05F, 0, 0});
    const Pictures p = renderMoved(scene, before, now, size, settingsOf(plainly), {"motion", "depth"});
    const mat4 nowToBefore =
        scenePose(scene, 0.25).objectToWorld[0] * glm::inverse(scenePose(scene, 0.5).objectToWorld[0]);
    for (unsigned y = 2; y < size.y; y += 5) {
        for (unsigned x = 2; x < size.x; x += 5) {
            ASSERT_TRUE(p.hasSurface(x, y));
            const vec3 here = p.position(x, y);
            const vec2 expected = motionOf(now, before, here, vec3(nowToBefore * vec4(here, 1.0F)));
            EXPECT_NEAR(p.value("motion", x, y, 0), expected.x, 1e-5F + halfFloatTolerance(expected.x));
            EXPECT_NEAR(p.value("motion", x, y, 1), expected.y, 1e-5F + halfFloatTolerance(expected.y));
        }
    }
    expectSilentValidation("a turning wall");
}

// The camera turns to the side and moves on, which the sky does not show.
TEST(Motion, OfTheSkyIsThatOfItsDirections) {
    const Scene scene;
    View before = viewAt(0);
    View now = viewAt(0, {0.2F, 0.1F, 3.1F}, {0.5F, 0.2F, 0});
    const Pictures p = renderMoved(scene, before, now, size, settingsOf(plainly), {"motion", "depth"});
    for (unsigned y = 2; y < size.y; y += 5) {
        for (unsigned x = 2; x < size.x; x += 5) {
            ASSERT_FALSE(p.hasSurface(x, y));
            const vec2 ndc = 2.0F * (vec2(x, y) + 0.5F) / vec2(size) - 1.0F;
            const vec4 ahead = p.view.clipToWorld * vec4(ndc, 0.5F, 1.0F);
            const vec3 direction = glm::normalize(vec3(ahead) / ahead.w - now.camera.position);
            const vec2 expected = motionOf(now, before, now.camera.position + 1e6F * direction,
                                           before.camera.position + 1e6F * direction);
            EXPECT_NEAR(p.value("motion", x, y, 0), expected.x, 1e-5F);
            EXPECT_NEAR(p.value("motion", x, y, 1), expected.y, 1e-5F);
        }
    }
    EXPECT_GT(rangeOf(p.images.at("motion")).max, 0.01F) << "the camera turns";
}

// Two walls: the left one hangs from a joint that stands, the right one from one that slides by (0, 0.5, 0) in 1 s.
Scene skinnedWalls() {
    Scene scene =
        sceneOf(lambertMaterial(vec3(0.5F)), builtin::patch({{-5, 0, 0}, {4.9F, 0, 0}, {0, 9, 0}, {1, 1}, {}}));
    Mesh& mesh = scene.meshes[0];
    const size_t left = mesh.positions.size();
    builtin::append(mesh, builtin::patch({{5, 0, 0}, {4.9F, 0, 0}, {0, 9, 0}, {1, 1}, {}}), mat4(1.0F));
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.addSkin(std::array{JointWeight{i < left ? 0U : 1U, 1.0F}});
    }
    scene.nodes.resize(2);
    scene.skins.push_back({{0, 1}, {mat4(1.0F), mat4(1.0F)}});
    scene.instances[0].skin = 0;
    scene.instances[0].objectToWorld = builtin::at({50, 0, 0});  // of no account
    addChannel(scene, {.node = 1,
                       .target = Channel::Target::translation,
                       .times = {0.0F, 1.0F},
                       .values = {vec4(0), vec4(0, 0.5F, 0, 0)}});
    return scene;
}

TEST(Motion, OfSkinnedVerticesIsThatOfTheirJoints) {
    const Pictures p = renderMoved(skinnedWalls(), viewAt(0.25), viewAt(0.5), size, settingsOf(plainly),
                                   {"motion", "depth", "normal"});
    const vec2 expected = motionOf(viewAt(0), viewAt(0), {1, 0.125F, 0}, {1, 0, 0});
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                continue;  // between the two
            }
            const vec2 here = x < size.x / 2 ? vec2(0.0F) : expected;
            ASSERT_NEAR(p.value("motion", x, y, 0), 0.0F, 4e-6F) << x << ", " << y;
            ASSERT_NEAR(p.value("motion", x, y, 1), here.y, halfFloatTolerance(here.y)) << x << ", " << y;
            ASSERT_NEAR(p.color("normal", x, y).z, 1.0F, 1e-4F);
        }
    }
    EXPECT_TRUE(p.hasSurface(20, 45) && p.hasSurface(140, 45));
    expectSilentValidation("skinned walls");
}

// Everything that depends on the pose, against a static scene in that pose.
TEST(Moving, APictureAtATimeIsThatOfASceneThatStandsThere) {
    const Scene scene = findBuiltinScene("moving")->make();
    View view = defaultView(scene);
    const std::vector<std::string> everything{
        "diffuse.rays=1",       "specular.rays=1",        "trace_scene.enabled=true",
        "planar.enabled=true",  "probes.enabled=true",    "probes.count=1",
        "probes.resolution=32", "shadow.resolution=1024", "shadow.history=32"};
    for (const double time : {0.0, 0.7, 2.6}) {
        const Scene still = frozen(scene, time);
        View there = view;
        there.time = time;
        // Probes are placed as at time 0.
        there.probes = std::vector<Probe>{{{0, 1.2F, 0.5F}, {{-3, 0, -2.5F}, {3, 3, 2.5F}}}};
        const Pictures moved = render(scene, there, size, settingsOf(everything), {"final", "depth", "sun_visibility"});
        const Pictures stood = render(still, there, size, settingsOf(everything), {"final", "depth", "sun_visibility"});
        EXPECT_GT(compareImages(moved.images.at("depth"), stood.images.at("depth"), {}).difference.psnr, 40.0) << time;
        EXPECT_GT(compareImages(moved.images.at("final"), stood.images.at("final"), {}).difference.psnr, 35.0) << time;
        expectSilentValidation("the moving scene");
    }
}

TEST(Moving, APictureAfterOthersAtOtherTimesIsThatOfItsOwnTime) {
    const Scene scene = findBuiltinScene("moving")->make();
    View before = defaultView(scene);
    before.sun.angularDiameter = 0.0F;  // one ray is as good as many
    View now = before;
    before.time = 0.2;
    now.time = 0.9;
    for (const char* shadow : {"shadow.filter=hard", "shadow.filter=traced"}) {
        const Settings settings =
            settingsOf({"diffuse.rays=0", "specular.rays=1", "planar.enabled=true", "probes.enabled=true",
                        "probes.count=1", "probes.resolution=32", "probes.refresh=moving", shadow});
        const Pictures after = renderMoved(scene, before, now, size, settings, {"direct", "depth", "probe_atlas"});
        const Pictures alone = render(scene, now, size, settings, {"direct", "depth", "probe_atlas"});
        EXPECT_EQ(after.images.at("depth").data, alone.images.at("depth").data);
        EXPECT_EQ(after.images.at("direct").data, alone.images.at("direct").data) << shadow;
        const Difference d =
            compareImages(after.images.at("probe_atlas"), alone.images.at("probe_atlas"), {}).difference;
        EXPECT_GT(d.psnr, 60.0);
        expectSilentValidation("two times");
    }
}

TEST(Moving, TheRendererShowsTheReferencesDepthAndDirectLightAtItsTime) {
    const Scene scene = findBuiltinScene("moving")->make();
    View view = defaultView(scene);
    view.time = 0.6;
    ReferenceOptions options;
    options.samples = 16;
    options.bounces = 0;
    options.filter = PixelFilter::center;
    const ReferencePicture truth = traceReference(scene, view, size, options);
    // The reference looks through pixels' centres at textures in full detail.
    const Settings settings =
        settingsOf({"diffuse.rays=0", "specular.rays=0", "materials.mips=off", "materials.anisotropy=1"});
    const Pictures p = render(scene, view, size, settings, {"depth", "direct"});
    size_t same = 0;
    for (size_t i = 0; i < truth.depth.data.size(); ++i) {
        const float d = truth.depth.data[i];
        same += std::abs(p.images.at("depth").data[i] - d) <= 1e-4F + 1e-3F * d ? 1 : 0;
    }
    EXPECT_GT(same, truth.depth.data.size() * 99 / 100);
    const auto psnr = [&](const Pictures& pictures) {
        return compareImages(pictures.images.at("direct"), truth.direct, {}).difference.psnr;
    };
    view.time = 0.4;
    EXPECT_GT(psnr(p), psnr(render(scene, view, size, settings, {"direct"})) + 3.0);
}

}  // namespace
}  // namespace reflet::test::motion_test
