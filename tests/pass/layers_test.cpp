// Sheen, anisotropic reflection and dispersion: against the path tracer, their textures, and no cost without them.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"
#include "support/device_fixture.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace reflet::test::layers_test {
namespace {

using builtin::at;

constexpr uvec2 size(66, 48);

vec3 color(const FloatImage& image, unsigned x, unsigned y) {
    const float* texel = &image.data[(size_t(y) * image.width + x) * image.channels.size()];
    return {texel[0], texel[1], texel[2]};
}

View outdoors() {
    View view;
    view.camera.position = {0, 0.4F, 4};
    view.camera.target = vec3(0.0F);
    view.camera.fovY = glm::radians(24.0F);
    view.sun.direction = glm::normalize(vec3(0.3F, -0.8F, -0.6F));
    view.sun.irradiance = vec3(2);
    view.environment.radiance = vec3(0.6F);
    return view;
}

Scene ballOn(const Material& material, const vec3& ground) {
    Scene scene;
    builtin::place(scene, "ball", builtin::addMaterial(scene, material), builtin::sphere(0.6F, 64));
    builtin::place(scene, "floor", builtin::addMaterial(scene, lambertMaterial(ground)),
                   builtin::ground({8, 8}, {1, 1}, {1, 1}), at({0, -0.6F, 0}));
    return scene;
}

Material velvet() {
    Material m;
    m.baseColor = {0.1F, 0.02F, 0.04F, 1};
    m.metallic = 0.0F;
    m.roughness = 0.8F;
    m.sheen = {.color = {1.0F, 0.6F, 0.5F}, .roughness = 0.4F};
    return m;
}

Material brushed() {
    Material m;
    m.baseColor = {0.9F, 0.7F, 0.4F, 1};
    m.metallic = 1.0F;
    m.roughness = 0.25F;
    m.anisotropy = {.strength = 0.8F, .rotation = 0.6F};
    return m;
}

Material flint() {
    Material m = lambertMaterial(vec3(1.0F));
    m.roughness = 0.0F;
    m.ior = 1.6F;
    m.specular = 0.0F;  // no reflections
    m.transmission = {.factor = 1.0F, .thickness = 1.2F, .dispersion = 16.0F};
    return m;
}

constexpr uvec2 sizeOfBalls(40, 30);

// The ball in the reference and as rendered, 0 elsewhere.
struct Balls {
    FloatImage expected;
    FloatImage drawn;
    FloatImage bare;  // without the layer
};

Balls drawBalls(const Scene& scene, const Scene& bare, const std::vector<std::string>& settings) {
    ReferenceOptions options;
    options.samples = 256;
    options.filter = PixelFilter::center;
    const auto pictureOf = [&](const Scene& s) {
        const Pictures p = renderMean(s, outdoors(), sizeOfBalls, settingsOf(settings), {"final"}, 12);
        expectSilentValidation("layers");
        return p.images.at("final");
    };
    Balls balls{traceReference(scene, outdoors(), sizeOfBalls, options).final, pictureOf(scene), pictureOf(bare)};
    const Pictures shape = render(scene, outdoors(), sizeOfBalls, settingsOf({"transmission.layers=0"}), {"depth"});
    for (unsigned i = 0; i < sizeOfBalls.x * sizeOfBalls.y; ++i) {
        const uvec2 at(i % sizeOfBalls.x, i / sizeOfBalls.x);
        const bool ball = shape.hasSurface(at.x, at.y) && glm::length(shape.position(at.x, at.y)) < 0.61F;
        for (FloatImage* image : {&balls.expected, &balls.drawn, &balls.bare}) {
            for (unsigned c = 0; c < image->channels.size() && !ball; ++c) {
                image->data[i * image->channels.size() + c] = 0.0F;
            }
        }
    }
    return balls;
}

double errorOf(const FloatImage& image, const Balls& balls) {
    return compareImages(image, balls.expected, {}).difference.relativeMse;
}

TEST(Layers, ASheenIsThatOfTheReference) {
    Material bare = velvet();
    bare.sheen = {};
    const vec3 ground(0.3F, 0.5F, 0.3F);
    const Balls balls = drawBalls(ballOn(velvet(), ground), ballOn(bare, ground), {"diffuse.rays=16"});
    const double with = errorOf(balls.drawn, balls);
    const double without = errorOf(balls.bare, balls);
    RecordProperty("relative MSE", fmt::format("{} {}", without, with));
    EXPECT_LT(with, 0.005);
    EXPECT_GT(without, 10.0 * with);
}

TEST(Layers, ABrushedMetalIsThatOfTheReference) {
    Material bare = brushed();
    bare.anisotropy = {};
    const vec3 ground(0.3F, 0.5F, 0.3F);
    const Balls balls =
        drawBalls(ballOn(brushed(), ground), ballOn(bare, ground), {"specular.rays=16", "trace_scene.enabled=true"});
    const double with = errorOf(balls.drawn, balls);
    const double without = errorOf(balls.bare, balls);
    RecordProperty("relative MSE", fmt::format("{} {}", without, with));
    EXPECT_LT(with, 0.005);
    EXPECT_GT(without, 10.0 * with);
}

// Behind a slab that is turned by 50 degrees, the edge of a lit board is shifted by each channel's own index.
TEST(Layers, DispersionShiftsColoursAsTheReference) {
    View view = outdoors();
    view.camera.position = {0, 0, 4};
    view.camera.fovY = glm::radians(4.0F);
    view.sun.irradiance = vec3(0.0F);
    view.environment.radiance = vec3(0.0F);
    Material lamp = lambertMaterial(vec3(0.0F));
    lamp.emissive = vec3(1.0F);
    Scene scene;
    builtin::place(scene, "slab", builtin::addMaterial(scene, flint()), builtin::box({2, 2, 0.25F}),
                   glm::rotate(mat4(1.0F), glm::radians(50.0F), vec3(0, 1, 0)));
    builtin::place(scene, "board", builtin::addMaterial(scene, lamp),
                   builtin::patch({.right = {3, 0, 0}, .up = {0, 3, 0}}), at({3, 0, -2}));
    ReferenceOptions options;
    options.samples = 256;
    const FloatImage expected = traceReference(scene, view, size, options).final;
    const FloatImage drawn =
        render(scene, view, size, settingsOf({"transmission.exit_steps=8"}), {"final"}).images.at("final");
    // Columns that are dark, by the share of all light; the board is at the right.
    const auto edge = [](const FloatImage& image, int channel) {
        float sum = 0.0F;
        for (unsigned x = 0; x < size.x; ++x) {
            sum += color(image, x, 24)[channel];
        }
        return float(size.x) - sum / color(image, size.x - 2, 24)[channel];
    };
    const float shift = edge(expected, 0) - edge(expected, 2);
    RecordProperty("edges", fmt::format("{} {} {}, {} {} {}", edge(expected, 0), edge(expected, 1), edge(expected, 2),
                                        edge(drawn, 0), edge(drawn, 1), edge(drawn, 2)));
    EXPECT_GT(std::abs(shift), 3.0F) << "pixels";
    EXPECT_NEAR(edge(drawn, 0) - edge(drawn, 2), shift, 1.0F);
    for (const int channel : {0, 1, 2}) {  // rays show whole pixels, and the reference also light reflected inside
        EXPECT_NEAR(edge(drawn, channel), edge(expected, channel), 2.0F) << channel;
    }
}

// A wall that fills the picture, in white light from all sides, or in that of a sun.
Pictures wall(
    const Material& material, bool sun, const std::function<void(Scene&)>& paint = [](Scene&) {}) {
    Scene scene = sceneOf(material, builtin::patch({.right = {4, 0, 0}, .up = {0, 4, 0}}));
    paint(scene);
    View view;
    view.camera.position = {0, 0, 3};
    view.camera.target = vec3(0.0F);
    view.environment.radiance = vec3(sun ? 0.0F : 1.0F);
    view.sun.direction = glm::normalize(vec3(0.8F, 0, -1));
    view.sun.irradiance = vec3(sun ? 1.0F : 0.0F);
    return render(scene, view, size, settingsOf({"diffuse.rays=16", "specular.rays=16"}), {"final"});
}

TEST(Layers, WhiteOnesReturnAllLight) {
    Material white;
    white.metallic = 0.0F;
    white.sheen = {.color = vec3(1.0F), .roughness = 0.5F};
    EXPECT_NEAR(wall(white, false).value("final", 33, 24), 1.0F, 0.01F);
    white = brushed();
    white.baseColor = vec4(1.0F);
    const Pictures p = wall(white, false);
    float mean = 0.0F;
    for (unsigned i = 0; i < 64; ++i) {
        mean += p.value("final", 28 + i % 8, 20 + i / 8) / 64.0F;
    }
    EXPECT_NEAR(mean, 1.0F, 0.05F) << "compensated as an isotropic lobe";
}

TextureImage texels(const std::vector<std::array<uint8_t, 4>>& row) {
    TextureImage image{"row", static_cast<uint32_t>(row.size()), 1, {}};
    for (const auto& texel : row) {
        image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
    }
    return image;
}

constexpr Sampler sharp{.magLinear = false, .minLinear = false, .mips = false};

// The left half of the wall has the layer, the right half none.
TEST(Layers, TheirTexturesSayWhereTheyAre) {
    Material cloth = lambertMaterial(vec3(0.0F));
    cloth.specular = 0.0F;
    cloth.sheen = {.color = vec3(1.0F), .roughness = 0.6F};
    const float whole = wall(cloth, true).value("final", 24, 24);
    EXPECT_GT(whole, 0.002F);
    const auto paintColor = [](Scene& s) {
        s.materials.back().sheen.colorTexture =
            builtin::addTexture(s, texels({{255, 255, 255, 255}, {0, 0, 0, 255}}), sharp);
    };
    const auto paintRoughness = [](Scene& s) {
        s.materials.back().sheen.roughnessTexture =
            builtin::addTexture(s, texels({{0, 0, 0, 255}, {255, 255, 255, 20}}), sharp);
    };
    EXPECT_NEAR(wall(cloth, true, paintColor).value("final", 24, 24), whole, 0.02F * whole);
    EXPECT_NEAR(wall(cloth, true, paintColor).value("final", 40, 24), 0.0F, 1e-4F);
    EXPECT_NEAR(wall(cloth, true, paintRoughness).value("final", 24, 24), whole, 0.02F * whole);
    EXPECT_LT(wall(cloth, true, paintRoughness).value("final", 40, 24), 0.3F * whole);

    // The lobe reaches from the sun at the left to the eye along u, not across it. Rotation and texture add up.
    Material metal = brushed();
    metal.anisotropy.rotation = 0.0F;
    const float along = wall(metal, true).value("final", 24, 24);
    metal.anisotropy.rotation = 0.5F * pi;
    const float across = wall(metal, true).value("final", 24, 24);
    EXPECT_GT(along, 3.0F * across);
    const auto paintDirection = [](Scene& s) {
        s.materials.back().anisotropy.texture =
            builtin::addTexture(s, texels({{128, 255, 255, 255}, {255, 128, 255, 255}}), sharp);
    };
    const Pictures painted = wall(metal, true, paintDirection);
    EXPECT_NEAR(painted.value("final", 32, 24), along, 0.15F * along);
    EXPECT_LT(painted.value("final", 33, 24), 0.5F * along);
}

class LayersPasses : public DeviceTest {};

TEST_F(LayersPasses, ScenesWithoutThemRecordNothingOfThem) {
    const auto images = [](const Material& material) {
        const Scene scene = ballOn(material, vec3(0.5F));
        Renderer renderer(device(), scene, [](const std::string&) {});
        return renderer.render(outdoors(), size, 0, settingsOf({"diffuse.rays=0"})).g;
    };
    Material bare = velvet();
    bare.sheen = {};
    EXPECT_FALSE(images(bare).layers);
    EXPECT_EQ(images(bare).features & (materialFeatureSheen | materialFeatureAnisotropy), 0U);
    EXPECT_TRUE(images(velvet()).layers);
    EXPECT_TRUE(images(brushed()).layers);
}

}  // namespace
}  // namespace reflet::test::layers_test
