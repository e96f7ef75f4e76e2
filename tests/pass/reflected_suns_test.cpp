// The sun in flat mirrors as a light, in the renderer and in the reference, against closed forms.
#include "pass/harness.h"
#include "reference/reference.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::reflected_suns_test {
namespace {

constexpr uvec2 size(64, 36);
constexpr float albedo = 0.5F;
constexpr float irradiance = 4.0F;
const vec3 f0(0.9F, 0.7F, 0.5F);
// Toward the sun, which shines on a mirror of 2 by 2 m at the origin, from there at a wall at x = -2, and on the wall.
const vec3 toSun = glm::normalize(vec3(1.0F, 0.8F, 0.0F));

Material mirrorMaterial() {
    Material m;
    m.baseColor = vec4(f0, 1.0F);
    m.metallic = 1.0F;
    m.roughness = 0.0F;
    return m;
}

Scene mirrorAndWall(const Material& mirror) {
    Material wall = lambertMaterial(vec3(albedo));
    wall.specular = 0.0F;
    Scene scene = sceneOf(wall, builtin::patch({{-2, 2, 0}, {0, 0, -3}, {0, 2, 0}, {1, 1}, {1, 1}}));
    builtin::place(scene, "mirror", builtin::addMaterial(scene, mirror), builtin::ground({1, 1}, {1, 1}, {1, 1}));
    scene.cameras.push_back(builtin::camera("main", {3, 2, 0}, {-2, 1.6F, 0}, 60));
    return scene;
}

View viewOf(const Scene& scene, float degrees) {
    View view = defaultView(scene);
    view.sun.direction = -toSun;
    view.sun.irradiance = vec3(irradiance);
    view.sun.angularDiameter = glm::radians(degrees);
    view.environment = {};
    return view;
}

// Radiance of the wall under the sun alone.
const float sunOnWall = albedo / pi * irradiance * toSun.x;

// And what is added where it sees all of the sun in the mirror.
vec3 mirrorOnWall() {
    return sunOnWall * (f0 + (1.0F - f0) * std::pow(1.0F - toSun.y, 5.0F));
}

struct Seen {
    unsigned lit = 0;
    unsigned dark = 0;
};

// Checks all pixels of the wall that are clearly lit or clearly not.
Seen expectWindow(const FloatImage& picture, const Pictures& places, float tolerance) {
    Seen seen;
    const vec3 expected = mirrorOnWall();
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = places.hasSurface(x, y) ? places.position(x, y) : vec3(0);
            if (std::abs(at.x + 2.0F) > 0.01F) {
                continue;
            }
            // Back along the light, from the wall to the mirror's plane.
            const vec2 from(at.x + at.y * toSun.x / toSun.y, at.z);
            const float outside = std::max(std::abs(from.x), std::abs(from.y)) - 1.0F;
            const auto added = [&](int c) {
                return picture.data[3 * (size_t(y) * size.x + x) + size_t(c)] - sunOnWall;
            };
            if (outside < -0.15F) {
                ++seen.lit;
                for (int c = 0; c < 3; ++c) {
                    EXPECT_NEAR(added(c), expected[c], tolerance * expected[c]) << at.y << ", " << at.z;
                }
            } else if (outside > 0.15F) {
                ++seen.dark;
                EXPECT_NEAR(added(0), 0.0F, 0.02F * expected.x) << at.y << ", " << at.z;
            }
        }
    }
    return seen;
}

const std::vector<std::string> noIndirect{"diffuse.rays=0", "specular.rays=0"};

Settings suns(uint32_t count) {
    Settings settings = settingsOf(noIndirect);
    settings.direct.reflectedSuns = count;
    return settings;
}

TEST(ReflectedSuns, LightAWallThroughTheMirrorsRectangle) {
    const Scene scene = mirrorAndWall(mirrorMaterial());
    const View view = viewOf(scene, 0.5F);
    const Pictures p = render(scene, view, size, suns(1), {"final", "depth"});
    const Seen seen = expectWindow(p.images.at("final"), p, 0.02F);
    EXPECT_GT(seen.lit, 50U);
    EXPECT_GT(seen.dark, 100U);
    const ReferencePicture truth =
        traceReference(scene, view, size, {.bounces = 1, .samples = 16, .filter = PixelFilter::center});
    const Seen again = expectWindow(truth.final, p, 0.03F);
    EXPECT_EQ(again.lit, seen.lit);
    const Pictures off = render(scene, view, size, suns(0), {"final"});
    for (size_t i = 0; i < off.images.at("final").data.size(); ++i) {
        EXPECT_LE(off.images.at("final").data[i], p.images.at("final").data[i] * 1.001F);
    }
}

// One thing is between the sun and the mirror, one between the mirror and the wall.
TEST(ReflectedSuns, AreInTheShadowOfWhatIsBeforeAndBehindTheMirror) {
    Scene scene = mirrorAndWall(mirrorMaterial());
    const auto block = [&](const vec3& place) {
        builtin::place(scene, "block", 0, builtin::box({0.25F, 0.05F, 0.25F}), builtin::at(place));
    };
    block(vec3(0, 0, 0.5F) + 1.5F * toSun);
    block(vec3(0, 0, -0.5F) + 0.8F * vec3(-toSun.x, toSun.y, 0));
    const View view = viewOf(scene, 0.5F);
    const Pictures p = render(scene, view, size, suns(1), {"final", "depth"});
    const ReferencePicture truth =
        traceReference(scene, view, size, {.bounces = 1, .samples = 64, .filter = PixelFilter::center});
    const FloatImage& picture = p.images.at("final");
    const vec3 expected = mirrorOnWall();
    unsigned shadow = 0;
    unsigned differ = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const size_t i = 3 * (size_t(y) * size.x + x);
            if (!p.hasSurface(x, y) || std::abs(p.position(x, y).x + 2.0F) > 0.01F) {
                continue;
            }
            const vec3 at = p.position(x, y);
            const vec2 from(at.x + at.y * toSun.x / toSun.y, at.z);
            const bool within = std::max(std::abs(from.x), std::abs(from.y)) < 0.85F;
            shadow += within && std::abs(truth.final.data[i] - sunOnWall) < 0.1F * expected.x ? 1 : 0;
            differ += std::abs(picture.data[i] - truth.final.data[i]) > 0.3F * expected.x ? 1 : 0;
        }
    }
    EXPECT_GT(shadow, 15U) << "nothing is in the shadow";
    EXPECT_LT(differ, 40U) << "only edges may differ";
}

// Paths that hit the mirror by chance must not find the sun there once more: each would be a bright dot.
TEST(ReflectedSuns, AreNotFoundTwiceByTheReference) {
    const Scene scene = mirrorAndWall(mirrorMaterial());
    const ReferencePicture truth = traceReference(scene, viewOf(scene, 0.5F), size,
                                                  {.bounces = 2, .samples = 1024, .filter = PixelFilter::center});
    const float most = sunOnWall + mirrorOnWall().x;
    EXPECT_LT(*std::ranges::max_element(truth.indirectDiffuse.data), 1.1F * mirrorOnWall().x);
    EXPECT_LT(*std::ranges::max_element(truth.final.data), 1.1F * most);
}

}  // namespace
}  // namespace reflet::test::reflected_suns_test
