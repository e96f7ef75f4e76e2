// object_motion.glsl against objects and mirrors at known positions.
#include "shader/object_motion_test.h"

#include "renderer/planar_views/planar_view.h"
#include "renderer/view_params.h"
#include "shader/harness.h"

#include <random>

namespace reflet::test::object_motion_test {
namespace {

constexpr uvec2 pixels{1280, 720};

Camera cameraAt(const vec3& position, bool orthographic) {
    Camera camera;
    camera.position = position;
    camera.target = {0.2F, 0.9F, -1.0F};
    if (orthographic) {
        camera.orthographicHeight = 6.0F;
        camera.near = 0.1F;
        camera.far = 50.0F;
    }
    return camera;
}

struct Cases {
    ViewParams view{};
    std::vector<MirroredThing> things;
    std::vector<ObjectMotion> expected;
};

vec2 uvOf(const mat4& worldToClip, const vec3& p) {
    const vec4 clip = worldToClip * vec4(p, 1.0F);
    return 0.5F + 0.5F * vec2(clip) / clip.w;
}

/// Objects above a mirror in the plane y = 0.1, some of them static, between two frames of a moving camera.
Cases makeCases(bool orthographic) {
    std::mt19937 random(7);
    const auto between = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    Cases cases;
    cases.view = makeViewParams(cameraAt({0.3F, 1.6F, 4.0F}, orthographic), pixels, 1, 0);
    const ViewParams before = makeViewParams(cameraAt({0.25F, 1.65F, 4.05F}, orthographic), pixels, 0, 0);
    cases.view.previousWorldToClip = before.worldToClip;
    const vec4 plane(0, 1, 0, -0.1F);
    for (int i = 0; i < 200; ++i) {
        const vec3 thing(between(-1.0F, 1.0F), between(0.2F, 1.5F), between(-2.0F, 0.5F));
        const vec3 step = 0.15F * vec3(between(-1, 1), between(-1, 1), between(-1, 1));
        const vec3 displacement = i % 4 == 0 ? vec3(0.0F) : step;
        const auto mirrored = [&](const vec3& p) { return vec3(reflectionIn(plane) * vec4(p, 1.0F)); };
        const vec3 image = mirrored(thing);
        const vec3 toEye = vec3(cases.view.eye) - image * cases.view.eye.w;
        const vec3 mirror = image + toEye * ((0.1F - image.y) / toEye.y);
        const vec2 uv = uvOf(cases.view.worldToClip, thing);
        const vec2 motion = uv - uvOf(before.worldToClip, thing - displacement);
        cases.things.push_back({thing, uv, vec3(motion, glm::dot(vec3(cases.view.viewPlane), displacement)), mirror});
        cases.expected.push_back(
            {displacement, uvOf(before.worldToClip, image) - uvOf(before.worldToClip, mirrored(thing - displacement))});
    }
    return cases;
}

class ObjectMotionTest : public ShaderTest, public ::testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(Cameras, ObjectMotionTest, ::testing::Bool());

TEST_P(ObjectMotionTest, TellsHowObjectsMovedInTheWorldAndTheirImagesBehindAMirror) {
    const Cases cases = makeCases(GetParam());
    const auto found = mapOnDevice<ObjectMotion>("object_motion_test.comp", cases.things, cases.view);
    for (size_t i = 0; i < found.size(); ++i) {
        ASSERT_LT(glm::distance(found[i].displacement, cases.expected[i].displacement), 1e-4F) << i;
        ASSERT_LT(glm::distance(found[i].ofImage, cases.expected[i].ofImage), 2e-5F) << i;
    }
}

TEST_P(ObjectMotionTest, IsExactlyZeroForStaticObjects) {
    const Cases cases = makeCases(GetParam());
    const auto found = mapOnDevice<ObjectMotion>("object_motion_test.comp", cases.things, cases.view);
    for (size_t i = 0; i < found.size(); i += 4) {
        ASSERT_EQ(found[i].displacement, vec3(0.0F)) << i;
        ASSERT_EQ(found[i].ofImage, vec2(0.0F)) << i;
    }
}

}  // namespace
}  // namespace reflet::test::object_motion_test
