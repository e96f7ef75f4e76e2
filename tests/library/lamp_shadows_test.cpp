// Shadows of a host's lamps, by maps of every kind that a host may have, against what rays find.
#include "library/library_fixture.h"

#include <glm/gtc/constants.hpp>

#include <cmath>
#include <optional>

namespace reflet::test::lamp_shadows_test {
namespace {

using glm::uvec3;

constexpr uint32_t width = HostRoom::width;
constexpr uint32_t height = HostRoom::height;
const vec3 eye(0.0F, 1.0F, 3.0F);
const vec3 lampAt(0.25F, 3.0F, 0.0F);
constexpr float casterHeight = 1.0F;
constexpr float casterHalf = 0.4F;
const vec2 casterMiddle(0.0F, -1.0F);  // x, z
constexpr float near = 0.1F;
constexpr float far = 20.0F;

// How far the caster, the floor or the wall is along a direction from the lamp, in lengths of it; 0: nothing.
float along(const vec3& direction) {
    float nearest = INFINITY;
    const auto meet = [&](float t) { nearest = t > 0.0F && t < nearest ? t : nearest; };
    if (direction.y < 0.0F) {
        meet(-lampAt.y / direction.y);
        const float t = (casterHeight - lampAt.y) / direction.y;
        const vec3 p = lampAt + t * direction;
        if (std::max(std::abs(p.x - casterMiddle.x), std::abs(p.z - casterMiddle.y)) < casterHalf) {
            meet(t);
        }
    }
    if (direction.z < 0.0F) {
        const float t = (-3.0F - lampAt.z) / direction.z;
        if (lampAt.y + t * direction.y < 2.0F) {
            meet(t);
        }
    }
    return std::isfinite(nearest) ? nearest : 0.0F;
}

// Of a perspective view with the lamp as eye; depth 0 near, 1 far.
mat4 viewFrom(const vec3& target, const vec3& up, float halfAngle) {
    const float zoom = 1.0F / std::tan(halfAngle);
    mat4 toClip(0.0F);
    toClip[0][0] = zoom;
    toClip[1][1] = -zoom;
    toClip[2][2] = far / (near - far);
    toClip[2][3] = -1.0F;
    toClip[3][2] = near * far / (near - far);
    return toClip * glm::lookAt(lampAt, target, up);
}

mat4 reversedDepth(mat4 toClip) {
    for (int column = 0; column < 4; ++column) {
        toClip[column].z = toClip[column].w - toClip[column].z;
    }
    return toClip;
}

// Draws a square of a 2D map by rays.
void drawTile(std::vector<float>& texels, uint32_t mapWidth, const uvec3& tile, const mat4& toClip, float nothing) {
    const mat4 toWorld = glm::inverse(toClip);
    for (uint32_t i = 0; i < tile.z * tile.z; ++i) {
        const uvec2 texel(i % tile.z, i / tile.z);
        const vec2 ndc = (2.0F * vec2(texel) + 1.0F) / float(tile.z) - 1.0F;
        const vec4 on = toWorld * vec4(ndc, 0.5F, 1.0F);
        const vec3 direction = vec3(on) / on.w - lampAt;
        const float t = along(direction);
        const vec4 clip = toClip * vec4(lampAt + t * direction, 1.0F);
        texels[(tile.y + texel.y) * mapWidth + tile.x + texel.x] = t > 0.0F ? clip.z / clip.w : nothing;
    }
}

vec3 faceDirection(uint32_t face, const vec2& at) {
    const vec3 all[] = {{1, -at.y, -at.x}, {-1, -at.y, at.x}, {at.x, 1, at.y},
                        {at.x, -1, -at.y}, {at.x, -at.y, 1},  {-at.x, -at.y, -1}};
    return all[face];
}

// The point that a pixel shows, if the lamp can light it.
struct Point {
    vec3 p;
    bool floor;
};

std::optional<Point> pointAt(uint32_t i) {
    const mat4 toView = glm::lookAt(eye, vec3(0.0F, 0.6F, 0.0F), vec3(0.0F, 1.0F, 0.0F));
    const vec2 uv((float(i % width) + 0.5F) / float(width), (float(i / width) + 0.5F) / float(height));
    const vec2 ndc = 2.0F * uv - 1.0F;
    const vec3 ray(glm::inverse(toView) * vec4(ndc.x * 0.5F * float(width) / float(height), -ndc.y * 0.5F, -1.0F, 0));
    const float toFloor = ray.y < 0.0F ? -eye.y / ray.y : INFINITY;
    const float toWall = (-3.0F - eye.z) / ray.z;
    const vec3 p = eye + std::min(toFloor, toWall) * ray;
    return p.y < 2.0F ? std::optional(Point{p, toFloor < toWall}) : std::nullopt;
}

// How far inside of the caster's shadow a point is, in metres at the caster; negative: in the light.
float shadowDepth(const vec3& p, const vec3& from) {
    const vec3 at = glm::mix(from, p, (from.y - casterHeight) / (from.y - p.y));
    return casterHalf - std::max(std::abs(at.x - casterMiddle.x), std::abs(at.z - casterMiddle.y));
}

class LampShadows : public Library {
protected:
    LampShadows() : room_(host_, {.still = true}) {
        context_ = host_.makeContext();
        settings_ = makeSettings("");
    }
    ~LampShadows() override {
        host_.host.waitForAll();
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }

    void set(const char* name, const char* value) { EXPECT_REFLET(refletSetSetting(settings_, name, value)); }

    static RefletLampShadow lamp(float radius) {
        RefletLampShadow lamp{};
        lamp.structSize = sizeof lamp;
        std::memcpy(lamp.position, &lampAt.x, sizeof lamp.position);
        lamp.radius = radius;
        return lamp;
    }
    static void store(float (&to)[16], const mat4& m) { std::memcpy(to, &m[0][0], sizeof to); }

    // A spot that looks down, with standard depth.
    RefletLampShadow spot(float radius, uint32_t side) {
        RefletLampShadow made = lamp(radius);
        made.direction[1] = -2.0F;
        made.direction[2] = -1.0F;
        made.coneAngle = 1.2F;
        std::vector<float> texels(size_t(side) * side);
        const mat4 toClip = viewFrom(lampAt + vec3(0, -2, -1), vec3(0, 0, -1), 1.25F);
        drawTile(texels, side, uvec3(0, 0, side), toClip, 1.0F);
        store(made.worldToClip[0], toClip);
        made.depth = REFLET_LAMP_DEPTH_STANDARD;
        made.map = host_.makeImage(VK_FORMAT_R32_SFLOAT, side, side, texels);
        return made;
    }

    // Six tiles with reversed depth, in an order of the host's, in a map with other things around.
    RefletLampShadow tiles(float radius, uint32_t side) {
        RefletLampShadow made = lamp(radius);
        made.kind = REFLET_LAMP_MAP_SIX_TILES;
        const uint32_t mapWidth = 3 * side + 5;
        std::vector<float> texels(size_t(mapWidth) * (2 * side + 3), NAN);
        const vec3 ways[] = {{0, -1, 0}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
        for (uint32_t face = 0; face < 6; ++face) {
            const vec3 up = ways[face].y != 0.0F ? vec3(1, 0, 0) : vec3(0, 1, 0);
            const mat4 toClip = reversedDepth(viewFrom(lampAt + ways[face], up, glm::quarter_pi<float>()));
            const uvec3 tile(5 + face % 3 * side, 3 + face / 3 * side, side);
            drawTile(texels, mapWidth, tile, toClip, 0.0F);
            store(made.worldToClip[face], toClip);
            std::memcpy(made.tiles[face], &tile, sizeof made.tiles[face]);
        }
        made.map = host_.makeImage(VK_FORMAT_R32_SFLOAT, mapWidth, 2 * side + 3, texels);
        return made;
    }

    // Of distances, as shares of the far plane, or of depth along the faces' axes.
    RefletLampShadow cube(float radius, uint32_t side, bool distances) {
        RefletLampShadow made = lamp(radius);
        made.kind = REFLET_LAMP_MAP_CUBE;
        made.depth = distances ? REFLET_LAMP_DEPTH_DISTANCE : REFLET_LAMP_DEPTH_STANDARD;
        made.distanceScale = distances ? far : 0.0F;
        made.nearPlane = near;
        made.farPlane = far;
        std::vector<float> texels;
        for (uint32_t i = 0; i < 6 * side * side; ++i) {
            const vec2 at = (2.0F * vec2(float(i % side), float(i / side % side)) + 1.0F) / float(side) - 1.0F;
            const vec3 direction = faceDirection(i / (side * side), at);
            const float t = along(direction);
            const float depth = t > 0.0F ? far * (t - near) / (t * (far - near)) : 1.0F;
            texels.push_back(distances ? t * glm::length(direction) / far : depth);
        }
        made.map = host_.makeCube(VK_FORMAT_R32_SFLOAT, side, texels);
        return made;
    }

    // Visibility of up to four lamps.
    std::vector<vec4> trace(const std::vector<RefletLampShadow>& lamps) {
        RefletView view = makeView(context_, 1);
        RefletImage visibility{};
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo info = room_.frame(commands, 0);
            EXPECT_REFLET(refletBeginFrame(view, &info));
            EXPECT_REFLET(
                refletLampShadows(view, settings_, lamps.data(), static_cast<uint32_t>(lamps.size()), &visibility));
            EXPECT_REFLET(refletEndFrame(view));
        });
        host_.host.waitForAll();
        std::vector<vec4> out;
        for (const uint32_t texel : texelsOf<uint32_t>(host_, visibility)) {
            out.push_back(glm::unpackUnorm4x8(texel));
        }
        refletDestroyView(view);
        return out;
    }

    HostRoom room_;
    RefletContext context_ = nullptr;
    RefletSettings settings_ = nullptr;
};

// Maps of different sizes in one call; all say the same of every pixel that is not at an edge.
TEST_F(LampShadows, AreThoseOfTheHostsMaps) {
    set("shadow.filter", "hard");
    const std::vector<vec4> seen =
        trace({spot(0.0F, 256), tiles(0.0F, 128), cube(0.0F, 256, true), cube(0.0F, 200, false)});
    size_t lit = 0;
    size_t dark = 0;
    for (uint32_t i = 0; i < seen.size(); ++i) {
        const std::optional<Point> point = pointAt(i);
        if (!point) {
            continue;
        }
        const float inside = shadowDepth(point->p, lampAt);
        if (std::abs(inside) < 0.05F || point->p.y > 1.9F || (!point->floor && point->p.y < 0.1F)) {
            continue;
        }
        const float wanted = inside > 0.0F ? 0.0F : 1.0F;
        (inside > 0.0F ? dark : lit) += 1;
        const float outOfCone = glm::dot(glm::normalize(point->p - lampAt), glm::normalize(vec3(0, -2, -1)));
        if (outOfCone > std::cos(1.15F)) {
            EXPECT_EQ(seen[i].x, wanted) << i % width << ' ' << i / width << ' ' << inside;
        }
        for (int k = 1; k < 4; ++k) {
            EXPECT_EQ(seen[i][k], wanted) << k << ": " << i % width << ' ' << i / width << ' ' << inside;
        }
    }
    EXPECT_GT(lit, 500U);
    EXPECT_GT(dark, 15U);
}

// The share of a disk of 20 cm that the caster leaves: PCSS assumes one height of blockers, which is right here.
TEST_F(LampShadows, ArePenumbrasOfTheLampsSize) {
    constexpr float radius = 0.2F;
    set("shadow.samples", "64");
    set("shadow.blocker_samples", "64");
    const std::vector<vec4> seen = trace({spot(radius, 256), cube(radius, 256, true)});
    double off[2] = {};
    size_t count = 0;
    for (uint32_t i = 0; i < seen.size(); ++i) {
        const std::optional<Point> point = pointAt(i);
        if (!point || !point->floor || std::abs(shadowDepth(point->p, lampAt)) > 0.2F) {
            continue;
        }
        const vec3 toLamp = glm::normalize(lampAt - point->p);
        const vec3 x = glm::normalize(glm::cross(toLamp, vec3(1, 0, 0)));
        const vec3 y = glm::cross(toLamp, x);
        float lit = 0.0F;
        for (int k = 0; k < 400; ++k) {
            const float turn = 2.399963F * float(k);
            const float r = radius * std::sqrt((float(k) + 0.5F) / 400.0F);
            const vec3 from = lampAt + r * std::cos(turn) * x + r * std::sin(turn) * y;
            lit += shadowDepth(point->p, from) > 0.0F ? 0.0F : 1.0F / 400.0F;
        }
        ++count;
        for (int k = 0; k < 2; ++k) {
            off[k] += std::abs(seen[i][k] - lit);
        }
    }
    ASSERT_GT(count, 50U);
    EXPECT_LT(off[0] / double(count), 0.06);
    EXPECT_LT(off[1] / double(count), 0.06);
    RecordProperty("spot", std::to_string(off[0] / double(count)));
    RecordProperty("cube", std::to_string(off[1] / double(count)));
}

}  // namespace
}  // namespace reflet::test::lamp_shadows_test
