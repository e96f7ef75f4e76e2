// Backgrounds: they show what they should, change no light, and cover pixels as the reference's do. The sky as light.
#include "scene/background.h"
#include "capture/show.h"
#include "effects/tonemap/tone_map_image.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "renderer/background/background.h"
#include "scene/builtin.h"
#include "scene/default_light.h"
#include "scene/environment.h"
#include "support/device_fixture.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace reflet::test::background_test {
namespace {

using Mode = Background::Mode;
constexpr uvec2 size(96, 60);
constexpr uvec2 small(48, 30);

class BackgroundImage : public DeviceTest {
protected:
    // The display image of the last of `frames`, with its alpha.
    static Bitmap display(const Scene& scene, const View& view, const Settings& settings, uint32_t frames) {
        Renderer renderer(device(), scene, [](const std::string&) {});
        gpu::Readback copy;
        for (uint32_t i = 0; i < frames; ++i) {
            renderer.render(view, size, 0, settings,
                            [&](gpu::Frame& f, const FrameImages& images) { copy = f.readback(images.display); });
        }
        return fetchDisplay(renderer.frame(), copy, size, /*alpha=*/true);
    }
};

View skyView(const Scene& scene) {
    View view = defaultView(scene);
    chooseEnvironment(view, {.name = "sky", .base = {}, .keepsSun = true});
    view.background = {};
    return view;
}

Background of(Mode mode, const vec3& color = vec3(0.0F)) {
    return {mode, color};
}

// What reads the last frame's image, light mips and mirrors, which might meet the background.
const std::vector<std::vector<std::string>> looks{
    {"trace_screen.light=previous", "denoise.enabled=true", "temporal.enabled=false", "diffuse.rays=1"},
    {"specular.rough_fallback=mips", "specular.max_roughness=0.2", "planar.enabled=true"}};

// Over 5 s: all effects are on, since each could see the background.
TEST_F(BackgroundImage, ChangesNoLightOnSurfaces) {
    const Scene scene = findBuiltinScene("gloss")->make();
    View view = skyView(scene);
    view.camera.position.y += 2.0F;  // sees the sky, and its own edges in reflections
    for (const std::vector<std::string>& look : looks) {
        const auto shown = [&](const Background& background) {
            view.background = background;
            return render(scene, view, small, settingsOf(look), {"final", "direct", "depth"}, 2);
        };
        const Pictures plain = shown({});
        size_t sky = 0;
        for (const Background& b : {of(Mode::blur), of(Mode::color, {1, 0, 0}), of(Mode::transparent)}) {
            const Pictures other = shown(b);
            size_t different = 0;
            for (unsigned y = 0; y < small.y; ++y) {
                for (unsigned x = 0; x < small.x; ++x) {
                    if (plain.hasSurface(x, y)) {
                        ASSERT_EQ(other.color("final", x, y), plain.color("final", x, y)) << x << ", " << y;
                        ASSERT_EQ(other.color("direct", x, y), plain.color("direct", x, y)) << x << ", " << y;
                    } else {
                        ++sky;
                        different += other.color("final", x, y) != plain.color("final", x, y) ? 1 : 0;
                    }
                }
            }
            EXPECT_GT(different, 30U);
        }
        EXPECT_GT(sky, 100U);
    }
    expectSilentValidation("backgrounds");
}

TEST_F(BackgroundImage, IsTheBlurredEnvironmentInEveryDirection) {
    const Scene scene = sceneOf(lambertMaterial(vec3(1.0F)), builtin::sphere(1e-3F, 6));
    View view;
    view.camera.position = {1000, 0, 0};
    view.camera.target = {1000, 3, -10};
    chooseEnvironment(view, {.name = "studio"});
    view.environment.rotation = 0.7F;
    view.environment.intensity = 2.0F;
    const Environment blurred =
        environmentBehind(view, std::make_shared<FloatImage>(blurredImage(*view.environment.image)));
    const Pictures p = render(scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0"}), {"final", "depth"});
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 expected = radianceFrom(blurred, pixelDirection(view.camera, size, x, y));
            ASSERT_NEAR(p.color("final", x, y).g, expected.g, 0.01F * expected.g) << x << ", " << y;
        }
    }
    ReferenceOptions options;
    options.filter = PixelFilter::center;
    options.samples = 1;
    const ReferencePicture truth = traceReference(scene, view, size, options);
    const FloatImage& image = p.images.at("final");
    for (size_t i = 0; i < image.data.size(); ++i) {
        ASSERT_NEAR(image.data[i], truth.final.data[i], 0.01F * truth.final.data[i]);
    }
}

Scene glowingSphere() {
    Material material = lambertMaterial(vec3(0.0F));
    material.emissive = vec3(0.5F, 0.25F, 0.1F);
    return sceneOf(material, builtin::sphere(1.0F, 64));
}

View sphereView(const Background& background) {
    View view;
    view.camera.position = {0, 0, 4};
    view.background = background;
    return view;
}

// A sphere of one radiance on a sky of 50 W/(m² sr): its edge has the sphere's colour at every alpha, and the alpha is
// the area that the reference counts.
TEST_F(BackgroundImage, OfTransparentImagesLeavesStraightColorsAndTheAreaAsAlpha) {
    const Scene scene = glowingSphere();
    View view = sphereView(of(Mode::transparent));
    view.environment.radiance = vec3(50.0F);
    ReferenceOptions options;
    options.samples = 64;
    options.bounces = 0;
    const ReferencePicture truth = traceReference(scene, view, size, options);
    for (const char* averaging : {"temporal.enabled=true", "accumulate.enabled=true"}) {
        const Settings settings =
            settingsOf({averaging, "environment.enabled=false", "diffuse.rays=0", "specular.rays=0"});
        const Bitmap shown = display(scene, view, settings, 32);
        const uint8_t* center = &shown.data[4 * (size_t(size.y / 2) * size.x + size.x / 2)];
        unsigned edges = 0;
        double difference = 0.0;
        double fringe = 0.0;
        for (size_t i = 0; i < truth.coverage.data.size(); ++i) {
            const uint8_t* texel = &shown.data[4 * i];
            const float expected = 255.0F * truth.coverage.data[i];
            difference += std::abs(static_cast<float>(texel[3]) - expected);
            if (expected == 0.0F) {
                ASSERT_LE(texel[3], 8) << i;
            }
            if (texel[3] > 0 && texel[3] < 255) {
                ++edges;
                for (int channel = 0; channel < 3; ++channel) {
                    // Weighted as it will be seen.
                    const double off = (texel[channel] - center[channel]) * (texel[3] / 255.0);
                    ASSERT_NEAR(off, 0.0, 5.0) << averaging << ", alpha " << int{texel[3]};
                    fringe += std::abs(off);
                }
            }
        }
        EXPECT_EQ(center[3], 255);
        EXPECT_GT(edges, 50U) << averaging;
        EXPECT_LT(fringe / (3.0 * edges), 3.0) << averaging;
        EXPECT_LT(difference / static_cast<double>(edges), 40.0) << averaging;
    }
}

TEST_F(BackgroundImage, OfAColorIsThatDisplayValueWhateverTheExposure) {
    const Scene scene = glowingSphere();
    const View view = sphereView(of(Mode::color, {1.0F, 0.2F, 0.6F}));
    for (const char* exposure : {"tonemap.exposure=-6", "tonemap.exposure=4"}) {
        const Bitmap shown = display(scene, view, settingsOf({exposure}), 1);
        EXPECT_EQ((std::vector<uint8_t>(shown.data.begin(), shown.data.begin() + 4)),
                  (std::vector<uint8_t>{255, 51, 153, 255}))
            << exposure;
    }
    ReferenceOptions options;
    options.samples = 16;
    const ReferencePicture truth = traceReference(scene, view, size, options);
    EXPECT_EQ(truth.final.data[0], 0.0F);
    const FloatImage straight = straightRadiance(truth.final, truth.coverage, view.background);
    const Bitmap host = overBackground(toneMapped(straight, {}), truth.coverage, view.background);
    EXPECT_EQ((std::vector<uint8_t>(host.data.begin(), host.data.begin() + 3)), (std::vector<uint8_t>{255, 51, 153}));
}

// Irradiance of the sky's image on a surface, by its texels.
vec3 irradiance(const Environment& environment, const vec3& normal) {
    const FloatImage& image = *environment.image;
    glm::dvec3 sum(0.0);
    for (uint32_t row = 0; row < image.height; ++row) {
        const double solidAngle = 2.0 * glm::pi<double>() * glm::pi<double>() / (image.width * image.height) *
                                  std::sin(glm::pi<double>() * (row + 0.5) / image.height);
        for (uint32_t column = 0; column < image.width; ++column) {
            const vec2 uv = (vec2(column, row) + 0.5F) / vec2(image.width, image.height);
            const vec3 d = environmentDirection(uv, environment.rotation);
            sum += solidAngle * std::max(glm::dot(d, normal), 0.0F) * glm::dvec3(radianceFrom(environment, d));
        }
    }
    return sum;
}

// A white square facing a direction, under the sky alone: its radiance is the sky's irradiance over pi.
TEST(Sky, GivesItsOwnIntegralAsIrradianceInTheRendererAndTheReference) {
    View view;
    chooseEnvironment(view, {.name = "sky"});
    view.sun.irradiance = vec3(0.0F);
    for (const vec3& normal :
         {vec3(0, 1, 0), glm::normalize(vec3(-0.5F, 0.4F, 0.6F)), glm::normalize(vec3(1, -0.3F, 0))}) {
        const vec3 aside = glm::normalize(glm::cross(normal, vec3(0.3F, 0.2F, 0.9F)));
        const vec3 up = glm::cross(normal, aside);
        const Scene scene = sceneOf(lambertMaterial(vec3(1.0F)), builtin::patch({.right = aside, .up = up}));
        view.camera.position = 2.0F * normal;
        view.camera.target = {0, 0, 0};
        view.camera.up = up;
        view.camera.fovY = glm::radians(5.0F);
        const vec3 expected = irradiance(view.environment, normal) / glm::pi<float>();
        const auto mean = [&](const FloatImage& image) {
            glm::dvec3 sum(0.0);
            for (size_t i = 0; i < image.data.size(); i += 3) {
                sum += glm::dvec3(image.data[i], image.data[i + 1], image.data[i + 2]);
            }
            return vec3(sum / (double(image.data.size()) / 3.0));
        };
        const Pictures prefiltered =
            render(scene, view, {16, 16},
                   settingsOf({"trace_screen.enabled=false", "specular.rays=0", "diffuse.distribution=normal",
                               "diffuse.rays=1", "materials.lambert_only=true"}),
                   {"indirect_diffuse"});
        const Pictures rays = render(scene, view, {16, 16},
                                     settingsOf({"specular.rays=0", "diffuse.rays=64", "materials.lambert_only=true"}),
                                     {"indirect_diffuse"});
        ReferenceOptions options;
        options.samples = 64;
        options.bounces = 1;
        options.lambertOnly = true;
        const vec3 traced = mean(traceReference(scene, view, {16, 16}, options).final);
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(mean(prefiltered.images.at("indirect_diffuse"))[channel], expected[channel],
                        0.02F * expected[channel]);
            EXPECT_NEAR(mean(rays.images.at("indirect_diffuse"))[channel], expected[channel],
                        0.02F * expected[channel]);
            EXPECT_NEAR(traced[channel], expected[channel], 0.02F * expected[channel]);
        }
    }
}

}  // namespace
}  // namespace reflet::test::background_test
