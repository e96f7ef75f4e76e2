// Light of small emissive surfaces, for which lamps stand, against closed forms.
#include "pass/harness.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::emitters_test {
namespace {

constexpr uvec2 size(60, 34);
constexpr float radiance = 100.0F;
constexpr float radius = 0.05F;
constexpr float albedo = 0.5F;
const vec3 ball(0, 1, 0);

// A black ball that glows over a ground that reflects no light to itself.
Scene litGround() {
    Scene scene = sceneOf(lambertMaterial(vec3(albedo)), builtin::ground({4, 4}, {1, 1}, {1, 1}));
    Material glow = lambertMaterial(vec3(0.0F));
    glow.emissive = vec3(radiance);
    builtin::place(scene, "ball", builtin::addMaterial(scene, glow), builtin::sphere(radius, 48), builtin::at(ball));
    scene.cameras.push_back(builtin::camera("main", {0, 2.5F, 3.5F}, {0, 0.4F, 0}, 50));
    return scene;
}

View viewOf(const Scene& scene) {
    View view = defaultView(scene);
    view.sun.irradiance = vec3(0.0F);
    view.environment = {};
    return view;
}

const std::vector<std::string> fewRays{"diffuse.rays=1", "specular.rays=0", "materials.lambert_only=true"};

TEST(Emitters, LightTheGroundAsTheirSolidAngleSaysWithoutNoise) {
    const Scene scene = litGround();
    const Pictures p =
        render(scene, viewOf(scene), size, settingsOf(fewRays), {"final", "direct", "indirect_diffuse", "depth"});
    unsigned seen = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
            if (std::abs(at.y) > 0.01F) {
                continue;
            }
            ++seen;
            const float square = glm::dot(ball - at, ball - at);
            const float expected = albedo * radiance * radius * radius * ball.y / (square * std::sqrt(square));
            EXPECT_NEAR(p.value("final", x, y), expected, 0.03F * expected) << at.x << ", " << at.z;
            EXPECT_NEAR(p.value("indirect_diffuse", x, y), expected, 0.03F * expected) << "not in its layer";
            EXPECT_NEAR(p.value("direct", x, y), 0.0F, 0.01F * expected);
        }
    }
    EXPECT_GT(seen, size.x * size.y / 3);
}

TEST(Emitters, CastShadows) {
    Scene scene = litGround();
    builtin::place(scene, "lid", 0, builtin::box({0.3F, 0.02F, 0.3F}), builtin::at({0, 0.7F, 0}));
    const Pictures p = render(scene, viewOf(scene), size, settingsOf(fewRays), {"final", "depth"});
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = p.hasSurface(x, y) ? p.position(x, y) : vec3(0, 9, 0);
            if (std::abs(at.y) < 0.01F && std::max(std::abs(at.x), std::abs(at.z)) < 0.7F) {  // the edge is at 1
                EXPECT_LT(p.value("final", x, y), 0.01F) << at.x << ", " << at.z;
            }
        }
    }
}

}  // namespace
}  // namespace reflet::test::emitters_test
