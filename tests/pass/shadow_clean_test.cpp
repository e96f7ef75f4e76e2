// Denoising of soft shadows: noise is removed; penumbras, edges, light and dark areas are preserved.
#include "pass/harness.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::shadow_clean_test {
namespace {

constexpr uvec2 size(320, 180);
constexpr float edgeHeight = 2.0F;
const std::vector<std::string> shown{"sun_visibility", "sun_visibility_raw", "depth"};

// Half of the world lies under a ceiling, whose edge runs along z; the sun is at its height.
Scene knifeEdge() {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({8, 8}, {1, 1}, {1, 1}));
    builtin::place(scene, "ceiling", 0, builtin::box({3.0F, 0.005F, 6.0F}), builtin::at({-3, edgeHeight, 0}));
    return scene;
}

View knifeView() {
    View view;
    view.camera.position = {0.4F, 1.5F, 4.5F};
    view.camera.target = {0.1F, 0, 0.5F};
    view.sun = builtin::sun({0, -1, 0}, vec3(1.0F));
    view.sun.angularDiameter = glm::radians(6.0F);
    return view;
}

float penumbraWidth(const View& view) {
    return 2.0F * edgeHeight * std::tan(0.5F * view.sun.angularDiameter);
}

// Share of a disk of radius 1 on one side of a line at this distance from its middle.
float diskShare(float distance) {
    const float t = std::clamp(distance, -1.0F, 1.0F);
    return 0.5F + (t * std::sqrt(1.0F - t * t) + std::asin(t)) / glm::pi<float>();
}

struct GroundPixel {
    float x = 0.0F;  // metres from the edge
    float visibility = 0.0F;
    float expected = 0.0F;
};

std::vector<GroundPixel> groundPixels(const Pictures& p, const View& view, const std::string& show) {
    std::vector<GroundPixel> pixels;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (!p.hasSurface(x, y)) {
                continue;
            }
            const vec3 at = p.position(x, y);
            if (std::abs(at.y) < 0.01F && std::abs(at.x) < 1.0F && std::abs(at.z) < 3.0F) {
                pixels.push_back({at.x, p.value(show, x, y), diskShare(2.0F * at.x / penumbraWidth(view))});
            }
        }
    }
    return pixels;
}

// Mean squared error inside the penumbra.
double errorOf(const std::vector<GroundPixel>& pixels, const View& view) {
    double sum = 0.0;
    double count = 0.0;
    for (const GroundPixel& p : pixels) {
        if (std::abs(p.x) < 0.5F * penumbraWidth(view)) {
            sum += (p.visibility - p.expected) * (p.visibility - p.expected);
            count += 1.0;
        }
    }
    EXPECT_GT(count, 500.0);
    return sum / count;
}

// Metres from where the mean visibility is 10 % to where it is 90 %.
float measuredWidth(const std::vector<GroundPixel>& pixels, const View& view) {
    constexpr int bins = 80;
    const float step = 2.0F * penumbraWidth(view) / bins;
    std::vector<vec2> sums(bins, vec2(0.0F));
    for (const GroundPixel& p : pixels) {
        const int bin = static_cast<int>(std::floor(p.x / step)) + bins / 2;
        if (bin >= 0 && bin < bins) {
            sums[static_cast<size_t>(bin)] += vec2(p.visibility, 1.0F);
        }
    }
    const auto crossing = [&](float level) {
        for (size_t i = 1; i < sums.size(); ++i) {
            const float before = sums[i - 1].x / sums[i - 1].y;
            const float after = sums[i].x / sums[i].y;
            if (before < level && after >= level) {
                return step * (static_cast<float>(i) - 1.0F + (level - before) / (after - before));
            }
        }
        ADD_FAILURE() << "no bin reaches " << level;
        return 0.0F;
    };
    return crossing(0.9F) - crossing(0.1F);
}

Settings settingsFor(std::vector<std::string> more) {
    more.insert(more.begin(), {"diffuse.rays=0", "specular.rays=0", "shadow.filter=pcss", "shadow.history=32"});
    return settingsOf(more);
}

TEST(ShadowClean, OfSixteenSamplesLeavesTheNoiseOfSixtyFourAndStillLessOverFrames) {
    const View view = knifeView();
    const Scene scene = knifeEdge();
    const Pictures first = render(scene, view, size, settingsFor({}), shown);
    const double raw = errorOf(groundPixels(first, view, "sun_visibility_raw"), view);
    const double once = errorOf(groundPixels(first, view, "sun_visibility"), view);
    const Pictures later = render(scene, view, size, settingsFor({}), shown, 32);
    const double rested = errorOf(groundPixels(later, view, "sun_visibility"), view);
    const double many = errorOf(
        groundPixels(render(scene, view, size, settingsFor({"shadow.samples=64"}), shown), view, "sun_visibility_raw"),
        view);
    EXPECT_LT(once, 1.2 * many);
    EXPECT_LT(once, 0.2 * raw);
    EXPECT_LT(rested, 0.25 * once);
    expectSilentValidation("cleaning");
}

TEST(ShadowClean, KeepsThePenumbrasWidthAndItsMean) {
    View view = knifeView();
    const Scene scene = knifeEdge();
    for (const float degrees : {3.0F, 6.0F, 10.0F}) {
        view.sun.angularDiameter = glm::radians(degrees);
        const Pictures p = render(scene, view, size, settingsFor({}), shown);
        const auto raw = groundPixels(p, view, "sun_visibility_raw");
        const auto cleaned = groundPixels(p, view, "sun_visibility");
        const float before = measuredWidth(raw, view);
        const float after = measuredWidth(cleaned, view);
        EXPECT_NEAR(after, before, 0.1F * before) << degrees << " degrees";
        double sumBefore = 0.0;
        double sumAfter = 0.0;
        for (size_t i = 0; i < raw.size(); ++i) {
            sumBefore += raw[i].visibility;
            sumAfter += cleaned[i].visibility;
        }
        EXPECT_NEAR(sumAfter, sumBefore, 0.005 * sumBefore) << degrees << " degrees";
    }
}

TEST(ShadowClean, LeavesFullLightAndFullShadowAsTheyAre) {
    const View view = knifeView();
    const Pictures p = render(knifeEdge(), view, size, settingsFor({}), shown);
    unsigned lit = 0;
    unsigned dark = 0;
    for (const GroundPixel& pixel : groundPixels(p, view, "sun_visibility")) {
        if (std::abs(pixel.x) > 0.75F * penumbraWidth(view)) {
            EXPECT_EQ(pixel.visibility, pixel.expected) << pixel.x;
            ++(pixel.expected > 0.5F ? lit : dark);
        }
    }
    EXPECT_GT(std::min(lit, dark), 1000U);
}

// A lit plate hides a part of the penumbra on the ground; the visible part beside the plate must get no light from it.
// With one sample any two pixels may be equal, so only their positions tell the surfaces apart.
TEST(ShadowClean, StopsWhereAnotherSurfaceBegins) {
    constexpr float plateHeight = 0.6F;
    const View view = knifeView();
    Scene scene = knifeEdge();
    builtin::place(scene, "plate", 0, builtin::box({0.25F, 0.005F, 1.0F}), builtin::at({0.38F, plateHeight, 0.5F}));
    const Pictures p = renderMean(scene, view, size, settingsFor({"shadow.samples=1", "shadow.history=0"}), shown, 32);
    const auto isPlate = [&](unsigned x, unsigned y) {
        return p.hasSurface(x, y) && std::abs(p.position(x, y).y - plateHeight) < 0.02F;
    };
    double excess = 0.0;
    double count = 0.0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x + 4 < size.x; ++x) {
            const bool beside = !isPlate(x, y) && (isPlate(x + 2, y) || isPlate(x + 4, y));
            const vec3 at = beside && p.hasSurface(x, y) ? p.position(x, y) : vec3(1.0F);
            if (std::abs(at.y) < 0.01F && std::abs(at.x) < 0.5F * penumbraWidth(view)) {
                excess += p.value("sun_visibility", x, y) - p.value("sun_visibility_raw", x, y);
                count += 1.0;
            }
        }
    }
    EXPECT_GT(count, 20.0);
    EXPECT_LT(excess / count, 0.0);  // the neighbours that are left lie farther in the shadow
}

TEST(ShadowClean, ForgetsAShadowThatHasMovedOn) {
    const View now = knifeView();
    View before = now;
    before.sun.direction = glm::normalize(vec3(0.15F, -1, 0));  // the edge lies 0.3 m farther
    const Scene scene = knifeEdge();
    const Pictures fresh = render(scene, now, size, settingsFor({"shadow.history=0"}), shown);
    const Pictures moved = renderMoved(scene, before, now, size, settingsFor({}), shown, 16);
    const double expected = errorOf(groundPixels(fresh, now, "sun_visibility"), now);
    const double got = errorOf(groundPixels(moved, now, "sun_visibility"), now);
    EXPECT_LT(got, 1.2 * expected);
    for (const GroundPixel& pixel : groundPixels(moved, now, "sun_visibility")) {
        EXPECT_NEAR(pixel.visibility, pixel.expected, 0.3F) << pixel.x;
    }
}

TEST(ShadowClean, KeepsItsHistoryWhenTheCameraMoves) {
    const View now = knifeView();
    View before = now;
    before.camera.position.x += 0.1F;
    const Scene scene = knifeEdge();
    const Pictures fresh = render(scene, now, size, settingsFor({"shadow.history=0"}), shown);
    const Pictures moved = renderMoved(scene, before, now, size, settingsFor({}), shown, 16);
    const double expected = errorOf(groundPixels(fresh, now, "sun_visibility"), now);
    const double got = errorOf(groundPixels(moved, now, "sun_visibility"), now);
    EXPECT_LT(got, 0.4 * expected);
}

}  // namespace
}  // namespace reflet::test::shadow_clean_test
