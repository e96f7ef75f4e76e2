// The renderer against the path tracer, which shares no shading code with it.
#include "reference/reference.h"
#include "compare/compare.h"
#include "pass/harness.h"
#include "scene/builtin.h"
#include "scene/image_suns.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace reflet::test::reference_test {
namespace {

constexpr uvec2 size(96, 54);

float at(const FloatImage& image, unsigned x, unsigned y, unsigned channel = 0) {
    return image.data[(size_t(y) * image.width + x) * image.channels.size() + channel];
}

vec3 colorAt(const FloatImage& image, unsigned x, unsigned y) {
    return {at(image, x, y, 0), at(image, x, y, 1), at(image, x, y, 2)};
}

// None of the eight neighbours is another surface or is lit differently: no silhouette, no crease, no shadow edge.
bool isSmooth(const ReferencePicture& truth, unsigned x, unsigned y) {
    const vec3 normal = colorAt(truth.normal, x, y);
    const float visibility = at(truth.sunVisibility, x, y);
    // Along a plane, 1 / depth is linear in the picture.
    const auto nearness = [&](unsigned i, unsigned j) {
        const float depth = at(truth.depth, i, j);
        return depth > 0.0F ? 1.0F / depth : 0.0F;
    };
    const float here = nearness(x, y);
    const float bend = std::max(std::abs(nearness(x - 1, y) + nearness(x + 1, y) - 2.0F * here),
                                std::abs(nearness(x, y - 1) + nearness(x, y + 1) - 2.0F * here));
    if (bend > 0.02F * here || (visibility > 0.0F && visibility < 1.0F)) {
        return false;
    }
    for (unsigned j = y - 1; j <= y + 1; ++j) {
        for (unsigned i = x - 1; i <= x + 1; ++i) {
            const bool sameSurface = (nearness(i, j) > 0.0F) == (here > 0.0F);
            const bool sameNormal = here == 0.0F || glm::dot(normal, colorAt(truth.normal, i, j)) > 0.9F;
            if (!sameSurface || !sameNormal || at(truth.sunVisibility, i, j) != visibility) {
                return false;
            }
        }
    }
    return true;
}

// Renderer and reference filter textures differently; pixels where that shows are not compared.
bool hasSameColor(const ReferencePicture& truth, const FloatImage& albedo, unsigned x, unsigned y) {
    const vec3 expected = colorAt(truth.albedo, x, y);
    return glm::length(colorAt(albedo, x, y) - expected) <= 0.02F * glm::length(expected) + 0.002F;
}

std::vector<bool> comparablePixels(const ReferencePicture& truth, const FloatImage& albedo) {
    std::vector<bool> mask(size_t(size.x) * size.y);
    for (unsigned y = 1; y + 1 < size.y; ++y) {
        for (unsigned x = 1; x + 1 < size.x; ++x) {
            mask[size_t(y) * size.x + x] = isSmooth(truth, x, y) && hasSameColor(truth, albedo, x, y);
        }
    }
    return mask;
}

class EveryBuiltinScene : public testing::TestWithParam<const BuiltinScene*> {};

// Leaves out pixels at the edges of lamp shadows: the fraction of unshadowed lamp light differs between neighbours.
void leaveOutLampShadowEdges(const FloatImage& lit, const FloatImage& open, std::vector<bool>& mask) {
    const auto share = [&](unsigned x, unsigned y) {
        const vec3 whole = colorAt(open, x, y);
        return glm::dot(colorAt(lit, x, y), vec3(1.0F)) / std::max(glm::dot(whole, vec3(1.0F)), 1e-6F);
    };
    for (unsigned y = 1; y + 1 < size.y; ++y) {
        for (unsigned x = 1; x + 1 < size.x; ++x) {
            for (unsigned i = 0; i < 9; ++i) {
                const float other = share(x + i % 3 - 1, y + i / 3 - 1);
                mask[size_t(y) * size.x + x] = mask[size_t(y) * size.x + x] && std::abs(other - share(x, y)) < 0.05F;
            }
        }
    }
}

// Relative MSE of direct light away from edges, with shadows of sun and lamps.
void expectTheDirectLightOfTheReference(Scene scene) {
    View view = defaultView(scene);
    if (view.environment.image) {  // to the reference, a sun in the image is light of the environment
        view = withImageSuns(view, findImageSuns(*view.environment.image), scene.lamps);
    }
    view.camera.apertureRadius = 0.0F;  // it is about light, not about blur
    ReferenceOptions options;
    options.bounces = 0;
    options.samples = 64;
    const ReferencePicture truth = traceReference(scene, view, size, options);
    const Pictures p =
        render(scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0", "materials.anisotropy=16"}),
               {"direct", "albedo"});
    std::vector<bool> mask = comparablePixels(truth, p.images.at("albedo"));
    options.lampShadows = false;
    leaveOutLampShadowEdges(truth.direct, traceReference(scene, view, size, options).direct, mask);
    const Difference d = compareImages(p.images.at("direct"), truth.direct, {.mask = mask}).difference;
    EXPECT_LT(d.relativeMse, 1e-3);
    // What glass or blended cloth covers is not compared: its albedo is that of what is behind.
    EXPECT_GT(d.pixels, size.x * size.y / (scene.name == "glass" || scene.name == "quay" ? 6 : 4));
    testing::Test::RecordProperty("relativeMse", std::to_string(d.relativeMse));
    expectSilentValidation("the reference's comparison");
}

TEST_P(EveryBuiltinScene, HasTheDirectLightOfTheReferenceAwayFromEdges) {
    expectTheDirectLightOfTheReference(GetParam()->make());
}

TEST(Reference, HasTheSameLightOfPointLampsAndSpotsAwayFromEdges) {
    Scene scene = findBuiltinScene("cubes")->make();
    scene.sun.reset();
    const Aabb box = scene.bounds();
    for (int i = 0; i < 3; ++i) {
        Lamp lamp;
        lamp.type = i == 2 ? Lamp::Type::spot : Lamp::Type::point;
        lamp.position = box.center() + vec3(0.2F, 0.6F + 0.1F * float(i), 0.15F * float(i) - 0.2F) * box.size();
        lamp.direction = glm::normalize(box.center() - lamp.position);
        lamp.intensity = vec3(4.0F, 2.0F + float(i), 5.0F - float(i)) * glm::dot(box.size(), box.size()) * 0.05F;
        lamp.innerAngle = glm::radians(20.0F);
        scene.lamps.push_back(lamp);
    }
    expectTheDirectLightOfTheReference(std::move(scene));
}

std::vector<const BuiltinScene*> allScenes() {
    std::vector<const BuiltinScene*> scenes;
    const bool all = std::getenv("REFLET_ALL_SCENES") != nullptr;  // NOLINT(concurrency-mt-unsafe): one thread
    for (const BuiltinScene& scene : builtinScenes()) {
        if (all || scene.name != "street") {  // it is large, and takes as long as all the others
            scenes.push_back(&scene);
        }
    }
    return scenes;
}

std::string sceneName(const testing::TestParamInfo<const BuiltinScene*>& info) {
    std::string name(info.param->name);
    std::ranges::replace(name, '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Reference, EveryBuiltinScene, testing::ValuesIn(allScenes()), sceneName);

}  // namespace
}  // namespace reflet::test::reference_test
