// A quay at dusk, of what renderers find hard: 300 m of ground with posts whose shadows need cascades, bulbs of a few
// centimetres, a sky whose sun is a few texels, wet paving, a lantern that swings, and blended cloth that moves.
// x points from the water to the houses, the camera looks along -z.
#include "scene/builtin/quay.h"
#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/scenes.h"
#include "scene/pose.h"
#include "scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace reflet::builtin {
namespace {

constexpr float tile = 2.5F;         // metres of the paving that its image shows
constexpr float edge = -5.0F;        // x of the water's edge
constexpr float houses = 12.5F;      // x of the houses' fronts
constexpr float nearEnd = 20.0F;     // z
constexpr float farEnd = -280.0F;    // z
constexpr float waterLevel = -1.2F;  // y
constexpr float skyShare = 0.4F;     // of the sky's light is left, not of the sun's: long shadows show
constexpr Aabb wetPart{{-2.5F, 0, -12.5F}, {5.0F, 0, 10.0F}};

struct Rectangle {
    vec2 from;  // x, z
    vec2 to;
};

// Paving whose joints meet those of its neighbours.
Mesh paved(const Rectangle& r) {
    const vec2 half = 0.5F * (r.to - r.from);
    const glm::uvec2 cells = glm::max(glm::uvec2(half / tile), 1U);
    Mesh mesh;
    append(mesh, ground(half, cells, 2.0F * half / tile), at({r.from.x + half.x, 0, r.from.y + half.y}));
    finish(mesh);
    return mesh;
}

// 0 dry, 1 a puddle. uv: of the wet part.
float wetness(const vec2& uv) {
    const vec2 border = glm::min(uv, 1.0F - uv);
    const float inside = glm::smoothstep(0.0F, 0.16F, std::min(border.x, 0.7F * border.y + 0.05F));
    const float cloud = fractalNoise(vec3(3.0F * uv.x, 9.0F * uv.y, 0.5F), 4, 61U);
    return inside * glm::smoothstep(-0.25F, 0.2F, cloud + 0.08F);
}

TextureImage wetRoughness() {
    Canvas canvas("wetness", 256, 512, 0);
    canvas.paint([](const vec2& uv) {
        const float rough = glm::mix(0.8F, 0.1F, wetness(uv));
        return static_cast<Hex>(std::lround(255.0F * rough)) << 8U;  // green
    });
    return canvas.finish();
}

void addPaving(Scene& scene) {
    const TextureSlot colors = addTexture(scene, pavingColors("paving", 512, 0x9A938A, 0x7E756B, 0x45413D));
    const TextureSlot relief = addTexture(scene, pavingNormals("paving relief", 512, tile));
    Material dry = textured("paving", colors, 0.8F);
    dry.normalTexture = relief;
    const uint32_t dryPaving = addMaterial(scene, dry);
    const vec2 low(wetPart.min.x, wetPart.min.z);
    const vec2 high(wetPart.max.x, wetPart.max.z);
    const std::array<Rectangle, 4> around{{{{edge, farEnd}, {houses, low.y}},
                                           {{edge, high.y}, {houses, nearEnd}},
                                           {{edge, low.y}, {low.x, high.y}},
                                           {{high.x, low.y}, {houses, high.y}}}};
    for (size_t i = 0; i < around.size(); ++i) {
        place(scene, "paving " + std::to_string(i), dryPaving, paved(around[i]));
    }
    Material wet = dry;
    wet.name = "wet paving";
    wet.roughness = 1.0F;
    wet.normalScale = 0.35F;
    wet.metallic = 0.0F;
    wet.metallicRoughnessTexture = addTexture(scene, wetRoughness(), {.wrapU = Wrap::clamp, .wrapV = Wrap::clamp});
    wet.metallicRoughnessTexture.uvSet = 1;
    const vec2 half = 0.5F * (high - low);
    Mesh mesh = ground(half, {24, 72}, 2.0F * half / tile);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        const vec2 uv = 0.5F + 0.5F * vec2(mesh.positions[i].x, mesh.positions[i].z) / half;
        mesh.attributes[i].uv1 = uv;
        mesh.attributes[i].color = vertexColor(vec3(1.0F - 0.55F * wetness(uv)));
    }
    place(scene, "wet paving", addMaterial(scene, wet), mesh, at({low.x + half.x, 0, low.y + half.y}));
}

void addWater(Scene& scene) {
    const uint32_t stone = addMaterial(scene, plain("kerb", {0x8A847A, 0.75F}));
    const float middle = 0.5F * (nearEnd + farEnd);
    const float length = nearEnd - farEnd;
    place(scene, "kerb", stone, box({0.25F, 0.9F, 0.5F * length}, 0.5F), at({edge - 0.25F, -0.8F, middle}));
    Material water = plain("water", {0x0B1418, 0.06F});
    water.normalTexture = addTexture(
        scene, normalMap("waves", 256, 9.0F, [](const vec2& uv) { return 0.05F * tilingNoise(uv, 4, 4, 62U); }));
    place(scene, "water", addMaterial(scene, water),
          ground({90.0F, 0.5F * length + 20.0F}, {10, 18}, {20.0F, 0.1111F * (length + 40.0F)}),
          at({edge - 90.0F, waterLevel, middle}));
    // The other shore.
    const uint32_t far = addMaterial(scene, plain("far shore", {0x3A4440, 0.95F}));
    const uint32_t hill = addMesh(scene, "hill", far, sphere(1.0F, 32));
    for (int i = 0; i < 7; ++i) {
        const float n = static_cast<float>(i);
        const vec3 size(40.0F + 20.0F * hash01(i, 0, 0, 63U), 9.0F + 12.0F * hash01(i, 1, 0, 63U), 22.0F);
        place(scene, "hill " + std::to_string(i), hill,
              glm::scale(at({-175.0F + 34.0F * n, waterLevel - 2.0F, farEnd - 15.0F - 5.0F * float(i % 2)}), size));
    }
}

// Toward its azimuth, which is the image's centre, the light of a low sun in a few texels.
std::shared_ptr<const FloatImage> dusk(float elevation) {
    const Sky sky = makeSky(elevation);
    auto image = std::make_shared<FloatImage>(FloatImage{512, 256, {"R", "G", "B"}, {}});
    image->data.resize(size_t{3} * image->width * image->height);
    for (size_t i = 0; i < image->data.size(); ++i) {
        const size_t row = i / (3 * image->width);
        const size_t column = i / 3 % image->width;
        const size_t from = 3 * (2 * row * sky.image.width + 2 * column) + i % 3;
        const size_t below = from + 3 * size_t{sky.image.width};
        const auto& all = sky.image.data;
        image->data[i] = skyShare * 0.25F * (all[from] + all[from + 3] + all[below] + all[below + 3]);
    }
    const auto row = static_cast<uint32_t>((0.5F - elevation / pi) * static_cast<float>(image->height));
    const float top = pi * static_cast<float>(row) / static_cast<float>(image->height);
    const float bottom = pi * static_cast<float>(row + 1) / static_cast<float>(image->height);
    const float solidAngle = 2.0F * pi / static_cast<float>(image->width) * (std::cos(top) - std::cos(bottom));
    for (uint32_t column = image->width / 2 - 1; column <= image->width / 2; ++column) {
        for (int c = 0; c < 3; ++c) {
            image->data[3 * (size_t{row} * image->width + column) + size_t(c)] +=
                sky.sunIrradiance[c] / (2.0F * solidAngle);
        }
    }
    return image;
}

}  // namespace

Scene makeQuay() {
    Scene scene;
    scene.name = "quay";
    addPaving(scene);
    addWater(scene);
    addHouses(scene, {houses, nearEnd, farEnd});
    addQuayLights(scene, {edge, nearEnd, farEnd});
    addQuayThings(scene);
    const ScenePose start = scenePose(scene, 0.0);
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        scene.instances[i].objectToWorld = start.objectToWorld[i];
    }
    scene.cameras.push_back(camera("main", {0.9F, 1.75F, 12.5F}, {-0.4F, 1.4F, -8.0F}, 48));
    scene.environment.image = dusk(glm::radians(10.0F));
    scene.environment.rotation = glm::radians(50.0F);  // the sun is over the water, ahead at the left
    return scene;
}

}  // namespace reflet::builtin
