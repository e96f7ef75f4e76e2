// Screen-space tracing with ray tracing as fallback, against the path tracer with one bounce: with and without
// off-screen objects.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "scene/builtin.h"

#include <algorithm>
#include <cstdio>

namespace reflet::test::hybrid_test {
namespace {

constexpr uvec2 size(60, 34);

const std::vector<std::string> screenOnly{"diffuse.rays=128", "specular.rays=128", "trace_screen.light=direct",
                                          "trace_screen.thickness=0.05", "materials.mips=off"};

std::vector<std::string> with(std::vector<std::string> settings, const std::vector<std::string>& more) {
    settings.insert(settings.end(), more.begin(), more.end());
    return settings;
}

ReferencePicture oneBounce(const Scene& scene, const View& view, uint32_t samples, uint32_t seed) {
    return traceReference(scene, view, size,
                          {.bounces = 1, .samples = samples, .filter = PixelFilter::center, .seed = seed});
}

// Pixels at which two runs of the path tracer agree: where one mirror reflects the sun and another shows that, few
// samples hit it, but with large values.
std::vector<bool> settled(const FloatImage& a, const FloatImage& b, double limit) {
    std::vector<bool> mask;
    for (size_t i = 0; i < a.data.size(); i += 3) {
        double error = 0.0;
        for (size_t c = i; c < i + 3; ++c) {
            const double mean = 0.5 * (a.data[c] + b.data[c]);
            const double half = 0.5 * (a.data[c] - b.data[c]);
            error += half * half / (mean * mean + 0.01) / 3.0;
        }
        mask.push_back(error < limit);
    }
    return mask;
}

FloatImage meanOf(const FloatImage& a, const FloatImage& b) {
    FloatImage mean = a;
    for (size_t i = 0; i < a.data.size(); ++i) {
        mean.data[i] = 0.5F * (a.data[i] + b.data[i]);
    }
    return mean;
}

// Where the camera sees mirrors. What rough walls show of them is light of the sun by way of mirrors that few rays
// meet.
std::vector<bool> mirrors(const Scene& scene, const View& view) {
    const Settings settings = settingsOf({"diffuse.rays=0", "specular.rays=0"});
    const Pictures pictures = renderMean(scene, view, size, settings, {"roughness", "metallic"}, 1);
    std::vector<bool> mask;
    for (size_t i = 0; i < size_t(size.x) * size.y; ++i) {
        mask.push_back(pictures.images.at("metallic").data[i] > 0.5F && pictures.images.at("roughness").data[i] < 0.1F);
    }
    return mask;
}

struct HybridCase {
    const char* scene;
    const char* layer;
    double limit;              ///< of the relative MSE
    uint32_t pixels = 1800;    ///< that are compared, at least
    bool mirrorsOnly = false;  ///< where the camera sees them
};

class Hybrid : public testing::TestWithParam<HybridCase> {};

// Over 5 s: many rays, so that noise does not hide a bias.
TEST_P(Hybrid, IsThePathTracersPictureWhereTheScreenAloneIsNot) {
    const auto& [name, layer, limit, pixels, mirrorsOnly] = GetParam();
    const Scene scene = findBuiltinScene(name)->make();
    const View view = defaultView(scene);
    const ReferencePicture one = oneBounce(scene, view, 256, 1);
    const ReferencePicture two = oneBounce(scene, view, 256, 2);
    const bool diffuse = std::string(layer) == "indirect_diffuse";
    const FloatImage& a = diffuse ? one.indirectDiffuse : one.indirectSpecular;
    const FloatImage& b = diffuse ? two.indirectDiffuse : two.indirectSpecular;
    const std::string other = diffuse ? "specular.rays=0" : "diffuse.rays=0";
    // Two pictures with different noise.
    const auto draw = [&](const std::vector<std::string>& more, uint32_t seed) {
        const Settings settings = settingsOf(with(with(screenOnly, {other}), more));
        return renderMean(scene, view, size, settings, {layer}, 1, seed).images.at(layer);
    };
    const std::vector<std::string> sources{"trace_scene.enabled=on", "planar.enabled=on", "planar.count=2"};
    const std::pair scenes(draw(sources, 1), draw(sources, 2));
    CompareOptions options;
    options.mask = settled(a, b, 0.01);
    const std::vector<bool> ours = settled(scenes.first, scenes.second, 0.04);
    for (size_t i = 0; i < ours.size(); ++i) {
        options.mask[i] = options.mask[i] && ours[i];
    }
    const std::vector<bool> chosen = mirrorsOnly ? mirrors(scene, view) : std::vector<bool>(ours.size(), true);
    for (size_t i = 0; i < ours.size(); ++i) {
        options.mask[i] = options.mask[i] && chosen[i];
    }
    const auto errorOf = [&](const FloatImage& picture, const char* what) {
        const Difference d = compareImages(picture, meanOf(a, b), options).difference;
        std::printf("%s %s, %s: relative MSE %.4f, bias %+.3f, of %d pixels\n", name, layer, what, d.relativeMse,
                    d.bias, static_cast<int>(d.pixels));
        return d;
    };
    const Difference screen = errorOf(draw({}, 1), "screen alone");
    const Difference hybrid = errorOf(meanOf(scenes.first, scenes.second), "hybrid");
    EXPECT_LT(hybrid.relativeMse, limit);
    EXPECT_LT(hybrid.relativeMse, screen.relativeMse);
    EXPECT_GT(hybrid.pixels, pixels);
    expectSilentValidation(name);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Hybrid,
                         testing::Values(HybridCase{"mirror-hall", "indirect_specular", 0.01, 350, true},
                                         HybridCase{"gloss", "indirect_specular", 0.01},
                                         HybridCase{"cave", "indirect_diffuse", 0.02},
                                         HybridCase{"cornell", "indirect_diffuse", 0.02}),
                         [](const auto& c) {
                             std::string name(c.param.scene);
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace reflet::test::hybrid_test
