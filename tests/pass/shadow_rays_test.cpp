// The shadow map against rays toward the sun, on every built-in scene.
#include "pass/harness.h"
#include "scene/builtin.h"

#include <algorithm>

namespace reflet::test::shadow_rays_test {
namespace {

struct Triangle {
    vec3 a;
    vec3 ab;
    vec3 ac;
};

// Of all that casts a whole shadow; cut-out materials are left to the shadow map's own test.
std::vector<Triangle> casters(const Scene& scene) {
    std::vector<Triangle> triangles;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto at = [&](size_t i) {
            return vec3(instance.objectToWorld * vec4(mesh.positions[mesh.indices[i]], 1));
        };
        for (size_t i = 0; i < mesh.indices.size() && scene.materials[mesh.material].alphaCutoff == 0.0F; i += 3) {
            triangles.push_back({at(i), at(i + 1) - at(i), at(i + 2) - at(i)});
        }
    }
    return triangles;
}

// Möller and Trumbore 1997; only what is farther than `nearest`.
bool hits(const Triangle& t, const vec3& origin, const vec3& direction, float nearest) {
    const vec3 p = glm::cross(direction, t.ac);
    const float determinant = glm::dot(t.ab, p);
    const vec3 s = origin - t.a;
    const vec3 q = glm::cross(s, t.ab);
    const float u = glm::dot(s, p) / determinant;
    const float v = glm::dot(direction, q) / determinant;
    return u >= 0.0F && v >= 0.0F && u + v <= 1.0F && glm::dot(t.ac, q) / determinant > nearest;
}

class ShadowRays : public testing::TestWithParam<const char*> {};

TEST_P(ShadowRays, FindTheSameSunAsTheShadowMap) {
    constexpr uvec2 size(80, 45);
    const Scene scene = findBuiltinScene(GetParam())->make();
    const View view = defaultView(scene);
    const std::vector<Triangle> triangles = casters(scene);
    const Pictures p = render(scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0"}),
                              {"sun_visibility", "depth", "geometric_normal"});
    const vec3 toSun = -view.sun.direction;
    unsigned seen = 0;
    unsigned different = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                continue;
            }
            const vec3 n = p.color("geometric_normal", x, y);
            const vec3 origin = p.position(x, y) + 2e-3F * n;
            const bool dark = glm::dot(n, toSun) <= 0.0F || std::ranges::any_of(triangles, [&](const Triangle& t) {
                                  return hits(t, origin, toSun, 1e-3F);
                              });
            different += (p.value("sun_visibility", x, y) > 0.5F) == dark ? 1 : 0;
            ++seen;
        }
    }
    EXPECT_GT(seen, 500U);
    // Pixels that an edge of a shadow crosses, and the pierced panel of the colonnade.
    EXPECT_LT(different, seen / 50) << "of " << seen;
    RecordProperty("different", static_cast<int>(different));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShadowRays,
                         testing::Values("cubes", "tilted-cube", "cornell", "cave", "gloss", "colonnade",
                                         "mirror-hall"),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace reflet::test::shadow_rays_test
