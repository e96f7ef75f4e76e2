// The ground of the built-in scene "street": uneven asphalt with puddles, markings, kerbs and paved pavements.
#include "scene/builtin/assemble.h"
#include "scene/builtin/noise.h"
#include "scene/builtin/patterns.h"
#include "scene/builtin/street.h"

#include <algorithm>
#include <cmath>

namespace reflet::builtin::street {
namespace {

constexpr vec2 period{8.0F, 16.0F};  // metres after which the unevenness repeats; the road is narrower
constexpr float water = -0.014F;     // height of the water's surface
constexpr float cell = 0.1F;         // of the road's mesh

float frac(float a) {
    return a - std::floor(a);
}

// Height of the asphalt without water. uv: of the period.
float asphalt(const vec2& uv) {
    const vec2 wrapped(frac(uv.x), frac(uv.y));
    const float across = 2.0F * wrapped.x - 1.0F;  // -1 to 1 over 8 m
    const float ruts = -0.012F * std::cos(3.0F * pi * across);
    // A wide dip that the camera stands at.
    const vec2 dip = (wrapped - vec2(0.45F, 0.18F)) * period / vec2(2.6F, 2.0F);
    const float large = 0.03F * tilingNoise(wrapped, 4, 2, 21U) + 0.016F * tilingNoise(wrapped, 16, 3, 22U);
    return large + ruts + 0.006F - 0.055F * std::exp(-glm::dot(dip, dip));
}

// 0: wet asphalt, 1: a puddle.
float puddle(const vec2& uv) {
    return 1.0F - glm::smoothstep(water - 0.003F, water + 0.005F, asphalt(uv));
}

vec2 roadUv(const vec2& xz) {
    return {xz.x / period.x + 0.5F, xz.y / period.y};
}

TextureImage roughnessMap() {
    Canvas canvas("road wetness", 512, 1024, 0);
    canvas.paint([](const vec2& uv) {
        const float height = asphalt(uv);
        const float damp = 1.0F - glm::smoothstep(water, 0.035F, height);
        const float grain = hash01(static_cast<int>(uv.x * 512.0F), static_cast<int>(uv.y * 1024.0F), 0, 23U) - 0.5F;
        const float wet = glm::mix(0.42F, 0.2F, damp) + 0.08F * grain + 0.08F * tilingNoise(uv, 24, 3, 24U);
        const float rough = glm::mix(wet, 0.0F, puddle(uv));
        return static_cast<Hex>(std::lround(255.0F * std::clamp(rough, 0.0F, 1.0F))) << 8U;  // green
    });
    return canvas.finish();
}

// Grain where the asphalt is not under water. Ripples are in the vertices' normals: 8 bits are too few for them.
TextureImage reliefMap() {
    return normalMap("road relief", 512, period.x, [](const vec2& uv) {
        const float grain = hash01(static_cast<int>(uv.x * 512.0F), static_cast<int>(uv.y * 512.0F), 0, 25U);
        return (1.0F - puddle(uv)) * (0.0035F * grain + 0.006F * tilingNoise(uv, 48, 2, 26U));
    });
}

TextureImage asphaltColors() {
    Canvas canvas("asphalt", 256, 256, 0x2A2A2C);
    canvas.paint([](const vec2& uv) {
        const float cloud = 0.5F + 0.5F * tilingNoise(uv, 6, 5, 28U);
        const float stone = hash01(static_cast<int>(uv.x * 256.0F), static_cast<int>(uv.y * 256.0F), 1, 29U);
        return mixed(mixed(0x2C2D30, 0x444341, cloud), 0x77746E, stone > 0.9F ? 0.5F * stone : 0.0F);
    });
    canvas.grain(10.0F, 30U);
    return canvas.finish();
}

// A piece of the road's surface, `lift` above it.
struct Piece {
    vec2 from;  // x, z
    vec2 to;
    float step = cell;
    float lift = 0.0F;
};

Mesh surface(const Piece& p) {
    const vec2 size = p.to - p.from;
    const auto cells = glm::max(glm::uvec2(glm::round(size / p.step)), 1U);
    Mesh mesh;
    const float e = 0.5F * cell;
    for (unsigned row = 0; row <= cells.y; ++row) {
        for (unsigned column = 0; column <= cells.x; ++column) {
            const vec2 xz = p.from + size * vec2(column, row) / vec2(cells);
            const float right = roadHeight(xz + vec2(e, 0)) - roadHeight(xz - vec2(e, 0));
            const float near = roadHeight(xz + vec2(0, e)) - roadHeight(xz - vec2(0, e));
            const vec2 ripple = 0.0008F * puddle(roadUv(xz)) *
                                vec2(noise(vec3(5.0F * xz, 0.0F), 26U), noise(vec3(5.0F * xz, 9.0F), 27U));
            const uint32_t index =
                addVertex(mesh, {xz.x, roadHeight(xz) + p.lift, xz.y},
                          {-right / (2.0F * e) + ripple.x, 1.0F, -near / (2.0F * e) + ripple.y}, xz / 2.0F);
            mesh.attributes[index].uv1 = roadUv(xz);
            const float dark = puddle(roadUv(xz));
            mesh.attributes[index].color = vertexColor(vec3(1.0F - 0.75F * dark));
        }
    }
    for (unsigned row = 0; row < cells.y; ++row) {
        for (unsigned column = 0; column < cells.x; ++column) {
            const uint32_t a = row * (cells.x + 1) + column;
            const uint32_t b = a + cells.x + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        }
    }
    finish(mesh);
    return mesh;
}

TextureImage wornPaint() {
    Canvas canvas("worn paint", 256, 256, 0xD8D6CE);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            const vec2 uv = (vec2(x, y) + 0.5F) / 256.0F;
            const float wear = tilingNoise(uv, 7, 5, 31U) + 0.35F * (hash01(x, y, 0, 32U) - 0.5F);
            canvas.set(x, y, mixed(0xE2E0D8, 0x8A8880, 0.5F + 0.5F * tilingNoise(uv, 5, 3, 33U)),
                       wear > 0.2F ? 0 : 255);
        }
    }
    return canvas.finish();
}

void addRoad(Scene& scene) {
    const TextureSlot wetness = addTexture(scene, roughnessMap());
    const TextureSlot relief = addTexture(scene, reliefMap());
    Material road = textured("wet asphalt", addTexture(scene, asphaltColors()), 1.0F);
    road.metallicRoughnessTexture = wetness;
    road.metallicRoughnessTexture.uvSet = 1;
    road.normalTexture = relief;
    road.normalTexture.uvSet = 1;
    road.normalTexture.uvTransform[1] = {0, 1, 0};
    road.normalScale = 0.55F;
    const uint32_t material = addMaterial(scene, road);
    for (int i = 0; i < 6; ++i) {  // pieces, so that those behind the camera are not drawn
        const float from = nearEnd - 10.0F * static_cast<float>(i + 1);
        place(scene, "road " + std::to_string(i), material,
              surface({{-roadHalf - 0.05F, from}, {roadHalf + 0.05F, from + 10.0F}, i < 3 ? cell : 2.0F * cell}));
    }
    Material paint = textured("road paint", addTexture(scene, wornPaint()), 1.0F);
    paint.alphaCutoff = 0.5F;
    paint.metallicRoughnessTexture = road.metallicRoughnessTexture;
    const uint32_t white = addMaterial(scene, paint);
    for (int i = 0; i < 7; ++i) {  // a zebra crossing
        const float x = -3.1F + 0.95F * static_cast<float>(i);
        place(scene, "crossing " + std::to_string(i), white, surface({{x, -2.6F}, {x + 0.5F, 0.5F}, 0.1F, 0.004F}));
    }
    for (int i = 0; i < 9; ++i) {
        const float z = -8.0F - 4.5F * static_cast<float>(i);
        place(scene, "line " + std::to_string(i), white, surface({{-0.07F, z - 2.0F}, {0.07F, z}, 0.1F, 0.004F}));
    }
    place(scene, "manhole", addMaterial(scene, plain("manhole", {0x3A3A3C, 0.35F, 0.8F})), cylinder(0.33F, 0.02F, 32),
          at({-1.75F, roadHeight({-1.75F, -5.2F}) - 0.01F, -5.2F}));
}

void addPavements(Scene& scene) {
    Material slabs =
        textured("pavement", addTexture(scene, pavingColors("slabs", 256, 0x6E6A66, 0x57544F, 0x2B2A29)), 0.33F);
    slabs.normalTexture = addTexture(scene, pavingNormals("slab relief", 256, 2.0F));
    slabs.normalScale = 0.7F;
    const uint32_t pavement = addMaterial(scene, slabs);
    const uint32_t stone = addMaterial(scene, plain("kerb stone", {0x77736D, 0.35F}));
    const uint32_t kerb = addMesh(scene, "kerb", stone, boxMapped(roundedBox({0.09F, 0.15F, 0.995F}, 0.03F, 2), 1.0F));
    const float length = nearEnd - farEnd;
    const float half = 0.5F * (frontX - roadHalf);
    const Mesh mesh = ground({half, 0.5F * length}, {4, 60}, {half, 0.5F * length});
    for (const float s : {-1.0F, 1.0F}) {
        const std::string name = s < 0.0F ? "left" : "right";
        place(scene, name + " pavement", pavement, mesh,
              at({s * (roadHalf + half), pavementY, 0.5F * (nearEnd + farEnd)}));
        for (int i = 0; i < static_cast<int>(0.5F * length); ++i) {
            place(scene, name + " kerb " + std::to_string(i), kerb,
                  at({s * roadHalf, pavementY - 0.14F, nearEnd - 1.0F - 2.0F * static_cast<float>(i)}));
        }
    }
    place(scene, "far ground", addMaterial(scene, plain("far ground", {0x2A2A2C, 0.5F})),
          ground({60, 40}, {8, 6}, {1, 1}), at({0, -0.06F, farEnd - 39.0F}));
}

}  // namespace

float roadHeight(const vec2& xz) {
    const float height = asphalt(roadUv(xz));
    const float k = 0.004F;  // the water's edge is round
    const float h = std::clamp(0.5F + 0.5F * (height - water) / k, 0.0F, 1.0F);
    return glm::mix(water, height, h) + k * h * (1.0F - h);
}

void addGround(Scene& scene) {
    addRoad(scene);
    addPavements(scene);
}

}  // namespace reflet::builtin::street
