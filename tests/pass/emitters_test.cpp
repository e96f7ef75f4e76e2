// Light of small emissive surfaces, for which lamps stand, against closed forms.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

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

// A glowing box above rough metal. half: of its sides.
Scene boxOverMetal(float roughness, const vec3& half) {
    Material metal;
    metal.baseColor = vec4(0.9F, 0.9F, 0.9F, 1.0F);
    metal.metallic = 1.0F;
    metal.roughness = roughness;
    Scene scene = sceneOf(metal, builtin::ground({4, 4}, {1, 1}, {1, 1}));
    Material glow = lambertMaterial(vec3(0.0F));
    glow.emissive = vec3(radiance);
    builtin::place(scene, "box", builtin::addMaterial(scene, glow), builtin::box(half), builtin::at({0, 0.5F, 0}));
    scene.cameras.push_back(builtin::camera("main", {0, 1.5F, 3.0F}, {0, 0.2F, 0}, 50));
    return scene;
}

struct Reflected {
    double error;  // relative MSE
    double bias;
};

// The reflections of the first frame, of one ray a pixel.
Reflected firstFrame(const Scene& scene, const std::vector<std::string>& settings = {}) {
    std::vector<std::string> all{"diffuse.rays=1", "specular.rays=1"};
    all.insert(all.end(), settings.begin(), settings.end());
    const View view = viewOf(scene);
    ReferenceOptions options;
    options.samples = 256;
    options.bounces = 1;
    options.filter = PixelFilter::center;
    const FloatImage expected = traceReference(scene, view, size, options).indirectSpecular;
    const Pictures drawn = render(scene, view, size, settingsOf(all), {"indirect_specular"});
    const auto found = compareImages(drawn.images.at("indirect_specular"), expected, {}).difference;
    return {found.relativeMse, found.bias};
}

TEST(Emitters, RoughMetalShowsHighlightsWithoutNoise) {
    const vec3 cube(0.05F);
    const vec3 tube(0.3F, 0.02F, 0.02F);
    const vec3 panel(0.15F, 0.1F, 0.01F);
    struct Case {
        float roughness;
        vec3 half;
    };
    for (const auto& [roughness, half] : {Case{0.15F, tube}, Case{0.3F, cube}, Case{0.3F, tube}, Case{0.6F, panel}}) {
        const Reflected found = firstFrame(boxOverMetal(roughness, half));
        const std::string label = fmt::format("{} {}", roughness, half.x);
        RecordProperty(label, fmt::format("{} {}", found.error, found.bias));
        const bool wide = roughness > 0.2F;  // than the box looks: its shape hardly matters
        EXPECT_LT(found.error, wide ? 0.005 : 0.3) << label;
        EXPECT_NEAR(found.bias, 0.0, wide ? 0.15 : 0.2) << label;
    }
    EXPECT_GT(firstFrame(boxOverMetal(0.3F, cube), {"direct.emitters=false"}).error, 0.1) << "rays alone";
}

// The screen, probes and the scene behind rays tell all light of the box but the highlight's.
TEST(Emitters, HighlightsCountOnceWhateverAnswersTheRays) {
    const Scene scene = boxOverMetal(0.4F, {0.05F, 0.05F, 0.05F});
    for (const std::string source : {"trace_screen.enabled=true", "probes.enabled=true", "trace_scene.enabled=true"}) {
        std::vector<std::string> settings{source};
        if (source != "trace_screen.enabled=true") {
            settings.emplace_back("trace_screen.enabled=false");
        }
        EXPECT_NEAR(firstFrame(scene, settings).bias, 0.0, 0.15) << source;
    }
}

}  // namespace
}  // namespace reflet::test::emitters_test
