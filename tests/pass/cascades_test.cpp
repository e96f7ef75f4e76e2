// Cascades of the sun's shadow map: their benefit, and that nothing flickers when the camera moves.
#include "pass/harness.h"
#include "reference/reference.h"
#include "renderer/draw_shadows/shadow_maps.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::cascades_test {
namespace {

const vec3 toSun = glm::normalize(vec3(0.35F, 1.0F, 0.2F));

Settings settingsWith(const std::string& cascades, const std::string& resolution) {
    return settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.filter=hard", "shadow.cascades=" + cascades,
                       "shadow.resolution=" + resolution});
}

constexpr float slabHalf = 2.5F;
constexpr float slabHeight = 3.0F;
constexpr float slabStep = 10.0F;

// 200 m of ground under thin slabs in rows and columns of 10 m; every second one is alpha-masked, with a texture that
// is opaque everywhere.
Scene slabsOverGround() {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({100, 100}, {1, 1}, {1, 1}));
    Material cutOut = lambertMaterial(vec3(0.5F));
    cutOut.alphaCutoff = 0.5F;
    const Mesh slab = builtin::box({slabHalf, 0.01F, slabHalf});
    const uint32_t meshes[] = {builtin::addMesh(scene, "slab", 0, slab),
                               builtin::addMesh(scene, "cut out", builtin::addMaterial(scene, cutOut), slab)};
    for (int x = -9; x <= 9; ++x) {
        for (int z = -9; z <= 9; ++z) {
            builtin::place(
                scene, "slab", meshes[(x + z) & 1],
                builtin::at({slabStep * static_cast<float>(x), slabHeight, slabStep * static_cast<float>(z)}));
        }
    }
    return scene;
}

// Metres of the ground point inside the nearest slab's shadow, negative outside.
float insideShadow(const vec3& ground) {
    const vec3 through = ground + toSun * (slabHeight / toSun.y);
    const auto fromMiddle = [](float x) { return std::abs(x - slabStep * std::round(x / slabStep)); };
    return slabHalf - std::max(fromMiddle(through.x), fromMiddle(through.z));
}

View walkingView(int frame) {
    const auto t = static_cast<float>(frame);
    View view;
    view.camera.position = {4.0F + 0.05F * t, 2.0F, 40.0F - 0.13F * t};
    const float turn = glm::radians(1.7F * t);
    view.camera.target = view.camera.position + vec3(std::sin(turn), -0.12F, -std::cos(turn));
    view.sun = builtin::sun(-toSun, vec3(1.0F));
    return view;
}

struct Counts {
    unsigned dark = 0;
    unsigned lit = 0;
    unsigned wrong = 0;
};

// Ground up to 60 m away, three texels and more from edges.
void countGround(const Pictures& p, const SunShadowParams& sun, Counts& counts) {
    for (unsigned y = 0; y < p.size.y; ++y) {
        for (unsigned x = 0; x < p.size.x; ++x) {
            const float distance = p.value("depth", x, y);
            const vec3 at = distance > 0.0F && distance < 60.0F ? p.position(x, y) : vec3(0, 9, 0);
            if (std::abs(at.y) > 0.02F || std::max(std::abs(at.x), std::abs(at.z)) > 90.0F) {
                continue;
            }
            uint coarsest = 0;
            while (coarsest + 1 < sun.count && distance > sun.blends[coarsest] - 0.01F) {
                ++coarsest;
            }
            const float inside = insideShadow(at);
            // Slabs are a little thick; and the sun's slant stretches a texel on the ground.
            if (std::abs(inside) > 3.0F * sun.maps[coarsest].texelSize / toSun.y + 0.03F) {
                const float truth = inside > 0.0F ? 0.0F : 1.0F;
                ++(inside > 0.0F ? counts.dark : counts.lit);
                counts.wrong += p.value("sun_visibility", x, y) == truth ? 0 : 1;
            }
        }
    }
}

// Over 5 s: 60 frames with four shadow maps each.
TEST(Cascades, NoPointInFullShadowOrFullLightChangesOver60FramesOfATurningWalk) {
    const Scene scene = slabsOverGround();
    std::vector<View> path(60);
    std::ranges::generate(path, [frame = 0]() mutable { return walkingView(frame++); });
    for (const auto& [cascades, filter] :
         {std::pair("1", "hard"), std::pair("2", "hard"), std::pair("4", "hard"), std::pair("4", "pcss")}) {
        Settings settings = settingsWith(cascades, "512");
        setSetting(settings, "shadow.filter", filter);
        settings.shadow.history = 32;
        const float reach =
            filterReach(scene.bounds(), settings.shadow, std::tan(0.5F * path.front().sun.angularDiameter));
        Counts counts;
        for (const Pictures& p : renderPath(scene, path, {96, 54}, settings, {"sun_visibility", "depth"})) {
            countGround(p, fitSunShadows(p.view, scene.bounds(), -toSun, settings.shadow, reach), counts);
        }
        EXPECT_EQ(counts.wrong, 0U) << cascades << " cascades, " << filter;
        EXPECT_GT(counts.dark, 5000U) << cascades << " cascades";
        EXPECT_GT(counts.lit, 20000U) << cascades << " cascades";
    }
    expectSilentValidation("cascades");
}

// Posts along 200 m of ground, seen from one end.
Scene posts() {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({100, 100}, {1, 1}, {1, 1}));
    const uint32_t post = builtin::addMesh(scene, "post", 0, builtin::box({0.04F, 0.75F, 0.04F}));
    for (int z = -99; z <= 99; ++z) {
        for (const float x : {-12.0F, -2.0F, 3.0F}) {
            builtin::place(scene, "post", post, builtin::at({x, 0.75F, static_cast<float>(z)}));
        }
    }
    return scene;
}

View alongThePosts() {
    View view;
    view.camera.position = {0, 1.7F, 98};
    view.camera.target = {0, 0.7F, 90};
    view.sun = builtin::sun(glm::normalize(vec3(-0.5F, -0.7F, 0.3F)), vec3(1.0F));
    view.sun.angularDiameter = 0.0F;
    return view;
}

TEST(Cascades, FourMakeLessThanAQuarterOfTheErrorThatOneMakesNearTheCameraInALongScene) {
    constexpr uvec2 size(320, 180);
    const Scene scene = posts();
    ReferenceOptions options;
    options.bounces = 0;
    options.samples = 1;
    options.filter = PixelFilter::center;
    const ReferencePicture truth = traceReference(scene, alongThePosts(), size, options);
    const auto error = [&](const char* cascades) {
        const Pictures p =
            render(scene, alongThePosts(), size, settingsWith(cascades, "1024"), {"sun_visibility", "depth"});
        double sum = 0.0;
        double pixels = 0.0;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                if (p.hasSurface(x, y) && p.value("depth", x, y) < 10.0F) {
                    sum += std::abs(p.value("sun_visibility", x, y) - truth.sunVisibility.data[y * size.x + x]);
                    pixels += 1.0;
                }
            }
        }
        return sum / pixels;
    };
    const double one = error("1");
    const double four = error("4");
    const double chosen = error("0");
    EXPECT_GT(one, 0.005);
    EXPECT_LT(four, 0.25 * one) << "of " << one;
    EXPECT_LT(chosen, 0.25 * one) << "of " << one;
    RecordProperty("one", std::to_string(one));
    RecordProperty("four", std::to_string(four));
}

TEST(Cascades, TheirNumbersAreThoseOfTheViewDistance) {
    const Scene scene = slabsOverGround();
    for (const char* cascades : {"2", "3", "4"}) {
        const Settings settings = settingsWith(cascades, "256");
        const View view = walkingView(0);
        const Pictures p = render(scene, view, {160, 90}, settings, {"cascade_index", "depth"});
        const SunShadowParams sun = fitSunShadows(p.view, scene.bounds(), view.sun.direction, settings.shadow);
        for (unsigned y = 0; y < p.size.y; ++y) {
            for (unsigned x = 0; x < p.size.x; ++x) {
                const float distance = p.value("depth", x, y);
                float expected = 0.0F;
                for (uint i = 0; i + 1 < sun.count; ++i) {
                    expected += std::clamp((distance - sun.blends[i]) / (sun.ends[i] - sun.blends[i]), 0.0F, 1.0F);
                }
                expected = p.hasSurface(x, y) ? expected : static_cast<float>(sun.count - 1);
                ASSERT_NEAR(p.value("cascade_index", x, y), expected, 0.01F) << distance;
            }
        }
        const Range range = rangeOf(p.images.at("cascade_index"));
        EXPECT_LT(range.min, 0.01F);
        EXPECT_FLOAT_EQ(range.max, static_cast<float>(sun.count - 1));
    }
}

// Hard shadows: each map says 0 or 1, so that a mixture is one of 0, the share of the next, that of this one, and 1.
TEST(Cascades, WhereTwoBlendTheVisibilityIsTheirMixture) {
    Settings settings = settingsWith("3", "128");
    settings.shadow.cascadeBlend = 0.6F;
    const Pictures p =
        render(slabsOverGround(), walkingView(0), {320, 180}, settings, {"sun_visibility", "cascade_index"});
    unsigned mixed = 0;
    unsigned alone = 0;
    for (unsigned y = 0; y < p.size.y; ++y) {
        for (unsigned x = 0; x < p.size.x; ++x) {
            const float index = p.value("cascade_index", x, y);
            const float next = index - std::floor(index);
            const float lit = p.value("sun_visibility", x, y);
            const float between = std::min({lit, 1.0F - lit, std::abs(lit - next), std::abs(lit - (1.0F - next))});
            ASSERT_LT(between, 0.011F) << x << ", " << y;
            mixed += lit > 0.05F && lit < 0.95F ? 1 : 0;
            alone += lit == 0.0F || lit == 1.0F ? 1 : 0;
        }
    }
    EXPECT_GT(mixed, 300U);
    EXPECT_GT(alone, 20000U);
}

}  // namespace
}  // namespace reflet::test::cascades_test
