// The second depth layer: the far side of visible objects, found from geometry alone.
#include "renderer/draw_gbuffer/back_depth.h"

#include "capture/texels.h"
#include "device/frame.h"
#include "pass/harness.h"
#include "renderer/draw_gbuffer/draw_gbuffer.h"
#include "renderer/gpu_scene.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <iterator>
#include <optional>

namespace reflet::test::back_depth_test {
namespace {

constexpr uvec2 size(160, 90);

// View distances of both layers in metres, 0: nothing.
struct Layers {
    std::vector<float> front;
    std::vector<float> back;
};

class BackDepth : public DeviceTest {
protected:
    static Layers draw(const Scene& scene, const Camera& camera) {
        const GpuScene onDevice(device(), scene, [](const std::string&) {});
        const ViewParams view = makeViewParams(camera, size, 0, 0);
        gpu::Frame& f = frame();
        f.begin();
        const GBuffer g = drawGBuffer(f, onDevice.draws(), view, {});
        const gpu::Readback front = f.readback(g.depth);
        const gpu::Readback back = f.readback(drawBackDepth(f, onDevice.draws(), g.depth, view));
        f.submit();
        f.wait();
        return {distances(f.bytes(front), view), distances(f.bytes(back), view)};
    }

private:
    static std::vector<float> distances(std::span<const std::byte> bytes, const ViewParams& view) {
        std::vector<float> metres;
        for (const vec4& texel : decodeTexels(VK_FORMAT_D32_SFLOAT, bytes)) {
            const vec4& d = view.depthToDistance;
            metres.push_back(texel.x > 0.0F ? (d.x + d.y * texel.x) / (d.z + d.w * texel.x) : 0.0F);
        }
        return metres;
    }
};

// Where a ray enters and leaves an axis-aligned box, in units of its direction.
std::optional<vec2> throughBox(const vec3& origin, const vec3& direction, const vec3& half) {
    const vec3 low = (-half - origin) / direction;
    const vec3 high = (half - origin) / direction;
    const vec3 in = glm::min(low, high);
    const vec3 out = glm::max(low, high);
    const vec2 span(std::max({in.x, in.y, in.z}), std::min({out.x, out.y, out.z}));
    return span.x < span.y ? std::optional(span) : std::nullopt;
}

TEST_F(BackDepth, OfABoxLiesBehindItsFrontByTheLengthOfTheRayInside) {
    const vec3 half(1.0F, 0.6F, 0.8F);
    const View view = viewFrom({2.4F, 1.8F, 3}, {0, 0, 0});
    const Layers layers = draw(sceneOf(lambertMaterial(vec3(0.5F)), builtin::box(half)), view.camera);
    const vec3 forward = glm::normalize(view.camera.target - view.camera.position);
    unsigned checked = 0;
    for (unsigned i = 0; i < size.x * size.y; ++i) {
        const vec3 d = pixelDirection(view.camera, size, i % size.x, i / size.x);
        const auto chord = throughBox(view.camera.position, d, half);
        EXPECT_EQ(layers.back[i] > 0.0F, layers.front[i] > 0.0F) << "a closed box has both sides or none";
        if (chord && layers.front[i] > 0.0F) {
            const float along = glm::dot(d, forward);
            ASSERT_NEAR(layers.back[i] - layers.front[i], along * (chord->y - chord->x), 1e-3F) << i;
            ++checked;
        }
    }
    EXPECT_GT(checked, 1000U);
}

TEST_F(BackDepth, OfABoxInAnOrthographicViewIsItsFarSide) {
    View view = viewFrom({0, 0, 10}, {0, 0, 0});
    view.camera.orthographicHeight = 4.0F;
    const Layers layers = draw(sceneOf(lambertMaterial(vec3(0.5F)), builtin::box(vec3(1.0F))), view.camera);
    const size_t middle = size_t(size.y / 2) * size.x + size.x / 2;
    EXPECT_NEAR(layers.front[middle], 9.0F, 1e-3F);
    EXPECT_NEAR(layers.back[middle], 11.0F, 1e-3F);
    EXPECT_EQ(layers.back[0], 0.0F);
}

TEST_F(BackDepth, OfTwoBoxesIsThatOfTheNearerOne) {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::box(vec3(1.0F)));
    builtin::place(scene, "behind", 0, builtin::box(vec3(1.0F)), builtin::at({0, 0, -4}));
    const Layers layers = draw(scene, viewFrom({0, 0, 10}, {0, 0, 0}).camera);
    const size_t middle = size_t(size.y / 2) * size.x + size.x / 2;
    EXPECT_NEAR(layers.front[middle], 9.0F, 1e-3F);
    EXPECT_NEAR(layers.back[middle], 11.0F, 1e-3F);
}

// From all sides, also at grazing angles, in both projections: rounding must not peel a surface from itself.
TEST_F(BackDepth, OfASingleSheetIsNoneSeenFromEitherSide) {
    for (const bool doubleSided : {false, true}) {
        Material material = lambertMaterial(vec3(0.5F));
        material.doubleSided = doubleSided;
        const Scene scene = sceneOf(material, builtin::ground({5, 5}, {7, 7}, {1, 1}));
        for (const vec3& eye : {vec3(0.1F, 5, 0.2F), vec3(3, 0.3F, 6), vec3(2, -4, 1), vec3(-7, -0.2F, 3)}) {
            for (const float height : {0.0F, 6.0F}) {
                View view = viewFrom(eye, {0.3F, 0, 0});
                view.camera.orthographicHeight = height;
                const Layers layers = draw(scene, view.camera);
                const auto seen = std::ranges::count_if(layers.front, [](float d) { return d > 0.0F; });
                EXPECT_EQ(seen > 500, doubleSided || eye.y > 0.0F) << seen;
                if (seen > 0) {
                    EXPECT_EQ(std::ranges::count(layers.back, 0.0F), std::ssize(layers.back))
                        << "eye " << eye.x << ' ' << eye.y << ' ' << eye.z << ", height " << height;
                }
            }
        }
    }
}

TEST_F(BackDepth, LooksThroughWhatIsCutOut) {
    // A sheet that faces away, its right half cut out, between a wall and the camera... which sees the wall's front,
    // then the sheet's back behind it.
    Scene scene =
        sceneOf(lambertMaterial(vec3(0.5F)), builtin::patch({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {1, 1}, {1, 1}}));
    TextureImage image{"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}};  // left half there, right half cut out
    Sampler nearest;
    nearest.magLinear = nearest.minLinear = nearest.mips = false;
    nearest.wrapU = nearest.wrapV = Wrap::clamp;
    Material material = builtin::textured("cut out", builtin::addTexture(scene, image, nearest), 1.0F);
    material.alphaCutoff = 0.5F;
    builtin::place(scene, "sheet", builtin::addMaterial(scene, material),
                   builtin::patch({{0, 0, -1}, {-3, 0, 0}, {0, 3, 0}, {1, 1}, {1, 1}}));
    const Layers layers = draw(scene, viewFrom({0, 0, 4}, {0, 0, 0}).camera);
    for (unsigned x = 40; x < 120; ++x) {  // the sheet's left half, seen from behind, is on the right
        const size_t i = size_t(size.y / 2) * size.x + x;
        EXPECT_NEAR(layers.front[i], 4.0F, 1e-3F) << x;
        EXPECT_NEAR(layers.back[i], x < 80 ? 0.0F : 5.0F, 1e-3F) << x;
    }
}

}  // namespace
}  // namespace reflet::test::back_depth_test
