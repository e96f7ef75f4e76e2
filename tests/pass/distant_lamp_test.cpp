// Shadows of directional lamps other than the sun: position, no self-shadowing, penumbras, and the nested tiles.
#include "renderer/draw_shadows/distant_lamp.h"
#include "pass/lamp_room.h"
#include "reference/reference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet::test::distant_lamp_test {
namespace {

constexpr uvec2 size(160, 90);
const std::vector<std::string> direct{"diffuse.rays=0", "specular.rays=0"};

Lamp distantLamp(const vec3& direction, float radius = 0.0F) {
    Lamp lamp = lampAt(Lamp::Type::directional, vec3(0.0F), direction);
    lamp.radius = radius;
    return lamp;
}

// Boxes on a ground of 120 m, near and far.
struct Yard {
    Scene scene = sceneOf(bothSides(), builtin::ground({60, 60}, {1, 1}, {1, 1}));
    std::vector<Aabb> boxes;

    void add(const Aabb& box) {
        boxes.push_back(box);
        builtin::place(scene, "box", 0, builtin::box(0.5F * box.size()), builtin::at(box.center()));
    }
    Yard() {
        for (const vec3& foot : {vec3(-1, 0, -1), vec3(1.5F, 0, 0.5F), vec3(0.5F, 0, -4)}) {
            add({foot - vec3(0.4F, 0, 0.4F), foot + vec3(0.4F, 1, 0.4F)});
        }
        for (const vec3& foot : {vec3(-12, 0, -25), vec3(4, 0, -32), vec3(20, 0, -42)}) {
            add({foot - vec3(2, 0, 2), foot + vec3(2, 7, 2)});
        }
    }
};

View viewOfYard() {
    View view;
    view.camera.position = {0, 3, 5};
    view.camera.target = {0, 0.5F, -4};
    return view;
}

TEST(DistantLamp, CastsShadowsWhereTheyMustBeNearAndFar) {
    Yard yard;
    const std::array directions{vec3(0.5F, -0.6F, 0.2F), vec3(-0.9F, -0.5F, -0.3F)};
    for (const vec3& direction : directions) {
        yard.scene.lamps.push_back(distantLamp(direction));
    }
    auto settings = direct;
    settings.emplace_back("shadow.filter=hard");
    const Pictures p = render(yard.scene, viewOfYard(), size, settingsOf(settings), {"lamp_visibility", "depth"});
    for (unsigned i = 0; i < directions.size(); ++i) {
        const vec3 way = -200.0F * glm::normalize(directions.at(i));
        std::array<unsigned, 2> dark{};
        std::array<unsigned, 2> lit{};
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                if (!p.hasSurface(x, y) || std::abs(p.position(x, y).y) > 1e-3F) {
                    continue;
                }
                const vec3 at = p.position(x, y);
                const bool far = at.z < -15.0F;
                const auto shadowed = [&](float grown) {
                    return std::ranges::any_of(yard.boxes, [&](const Aabb& box) {
                        return meets({box.min - grown, box.max + grown}, at, at + way);
                    });
                };
                const float tolerance = far ? 0.6F : 0.1F;  // about two texels
                const float visibility = p.value("lamp_visibility", x, y, i);
                if (shadowed(-tolerance)) {
                    EXPECT_EQ(visibility, 0.0F) << i << ": " << at.x << ", " << at.z;
                    ++dark.at(far ? 1 : 0);
                } else if (!shadowed(tolerance)) {
                    EXPECT_EQ(visibility, 1.0F) << i << ": " << at.x << ", " << at.z;
                    ++lit.at(far ? 1 : 0);
                }
            }
        }
        EXPECT_GT(std::min(dark[0], lit[0]), 100U) << i;
        EXPECT_GT(std::min(dark[1], lit[1]), 20U) << i;
    }
    expectSilentValidation("shadows of directional lamps");
}

TEST(DistantLamp, AtGrazingLightLeavesALargeGroundLit) {
    Scene scene = sceneOf(bothSides(), builtin::ground({60, 60}, {1, 1}, {1, 1}));
    builtin::place(scene, "post", 0, builtin::box({0.1F, 4, 0.1F}), builtin::at({-50, 4, 55}));  // behind the camera
    scene.lamps = {distantLamp({0.9F, -0.1F, -0.3F}), distantLamp({0.3F, -0.05F, 1}, 0.01F)};
    for (const char* filter : {"shadow.filter=hard", "shadow.filter=pcf", "shadow.filter=pcss"}) {
        auto settings = direct;
        settings.emplace_back(filter);
        const Pictures p = render(scene, viewOfYard(), size, settingsOf(settings), {"lamp_visibility", "depth"});
        unsigned dark = 0;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                const bool both =
                    std::min(p.value("lamp_visibility", x, y), p.value("lamp_visibility", x, y, 1)) == 1.0F;
                dark += p.hasSurface(x, y) && !both ? 1U : 0U;
            }
        }
        EXPECT_EQ(dark, 0U) << filter;
    }
}

// Where a rising profile first reaches `level`, in columns.
double crossing(const std::vector<double>& profile, double level) {
    const auto found = std::ranges::find_if(profile, [=](double value) { return value >= level; });
    return static_cast<double>(found - profile.begin());
}

FloatImage referenceOf(const Scene& scene, const View& view, uvec2 pixels) {
    ReferenceOptions options;
    options.samples = 32;
    options.bounces = 0;
    options.lambertOnly = true;
    return traceReference(scene, view, pixels, options).final;
}

FloatImage directOf(const Scene& scene, const View& view, uvec2 pixels, const std::string& filter) {
    const Settings settings = settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.lamp_resolution=1024",
                                          "shadow.rays=4", "materials.lambert_only=true", filter});
    return renderMean(scene, view, pixels, settings, {"direct"}, 4).images.at("direct");
}

TEST(DistantLamp, HasPenumbrasAsWideAsItsDiskSays) {
    constexpr double tenPercent = 0.6870;  // radii from its middle, a straight edge leaves a tenth of a disk open
    constexpr uvec2 wide(150, 34);
    for (const std::string source : {"shadow.filter=pcss", "shadow.filter=traced", "reference"}) {
        for (const auto& [tangent, height] : {std::pair(0.05F, 1.0F), {0.02F, 3.0F}}) {
            Scene scene = sceneOf(bothSides(), builtin::ground({10, 10}, {1, 1}, {1, 1}));
            builtin::place(scene, "blade", 0, builtin::ground({3, 3}, {1, 1}, {1, 1}), builtin::at({-3, height, 0}));
            scene.lamps.push_back(distantLamp({0, -1, 0}, tangent));
            const float penumbra = 2.0F * tangent * height;
            View view;
            view.lampRadius = 1.0F;  // of point and spot lamps alone
            view.camera.position = {0, 0.4F, 0};
            view.camera.target = {0, 0, 0};
            view.camera.up = {0, 0, -1};
            view.camera.orthographicHeight = 2.0F * penumbra * static_cast<float>(wide.y) / static_cast<float>(wide.x);
            const FloatImage lit =
                source == "reference" ? referenceOf(scene, view, wide) : directOf(scene, view, wide, source);
            std::vector<double> profile(wide.x);
            for (size_t i = 0; i < size_t{wide.x} * wide.y; ++i) {
                profile[i % wide.x] += double(lit.data[lit.channels.size() * i]) / (wide.y * 0.5 / pi * 10.0);
            }
            const double width = (crossing(profile, 0.9) - crossing(profile, 0.1)) * 2.0 * penumbra / wide.x;
            EXPECT_NEAR(width, tenPercent * penumbra, 0.12 * tenPercent * penumbra) << source << ", " << tangent;
            EXPECT_NEAR(crossing(profile, 0.5) / wide.x, 0.5, 0.03) << source << ", " << tangent;
        }
    }
}

std::array<vec2, nestedTiles> middlesOf(const LampShadow& shadow) {
    return {vec2(0.0F), shadow.middle1, shadow.middle2, shadow.middle3};
}

TEST(DistantLamp, HasTilesWithinOneAnotherWhateverTheCameraSees) {
    LampParams lamp{};
    lamp.type = lampDirectional;
    lamp.toLamp = glm::normalize(vec3(0.3F, 0.8F, -0.4F));
    const Aabb bounds{{-60, -1, -50}, {40, 12, 70}};
    for (const vec3& eye : {vec3(0, 2, 0), vec3(39, 2, 69), vec3(0, 300, 0), vec3(-500, 2, 0)}) {
        for (const vec3& ahead : {vec3(0, 0, -1), vec3(0, -1, 0), glm::normalize(vec3(1, -0.2F, 1))}) {
            const LampShadow shadow = nestedShadow(lamp, 0, 0, 512, {bounds, eye, ahead});
            const auto middles = middlesOf(shadow);
            for (uint32_t i = 0; i < nestedTiles; ++i) {
                const mat4 toClip = worldToNestedTile(shadow, i);
                EXPECT_NEAR((toClip * vec4(shadow.lamp.position, 1.0F)).z, 1.0F, 1e-5F);
                const float half = std::ldexp(shadow.halfTangent, -static_cast<int>(i));
                const vec2 off = i > 0 ? glm::abs(middles.at(i) - middles.at(i - 1)) : vec2(0.0F);
                EXPECT_LE(std::max(off.x, off.y), 1.001F * half) << i;
            }
            for (unsigned corner = 0; corner < 8; ++corner) {
                const vec4 clip = worldToNestedTile(shadow, 0) * vec4(bounds.corner(corner), 1.0F);
                EXPECT_LT(std::max(std::abs(clip.x), std::abs(clip.y)), 1.0F);
                EXPECT_GT(clip.z, 0.0F);
                EXPECT_LT(clip.z, 1.0F);
            }
        }
    }
    // What is in front of the camera is in the finest tile.
    const LampShadow shadow = nestedShadow(lamp, 0, 0, 512, {bounds, vec3(0, 2, 0), vec3(0, 0, -1)});
    const vec4 near = worldToNestedTile(shadow, 3) * vec4(0, 0, -4, 1);
    EXPECT_LT(std::max(std::abs(near.x), std::abs(near.y)), 1.0F);
}

TEST(DistantLamp, HasTilesThatMoveByWholeTexels) {
    LampParams lamp{};
    lamp.type = lampDirectional;
    lamp.toLamp = glm::normalize(vec3(0.3F, 0.8F, -0.4F));
    const Aabb bounds{{-60, -1, -60}, {60, 12, 60}};
    for (float x = 0.0F; x < 3.0F; x += 0.37F) {
        const LampShadow a = nestedShadow(lamp, 0, 0, 512, {bounds, vec3(0, 2, 0), vec3(0, 0, -1)});
        const LampShadow b = nestedShadow(lamp, 0, 0, 512, {bounds, vec3(x, 2, -x), vec3(0, 0, -1)});
        EXPECT_EQ(a.lamp.position, b.lamp.position);
        for (uint32_t i = 1; i < nestedTiles; ++i) {
            const float texel = 2.0F * std::ldexp(a.halfTangent, -static_cast<int>(i)) / 512.0F;
            const vec2 moved = (middlesOf(b).at(i) - middlesOf(a).at(i)) / texel;
            EXPECT_LT(glm::length(moved - glm::round(moved)), 1e-2F) << x << ", " << i;
        }
    }
}

}  // namespace
}  // namespace reflet::test::distant_lamp_test
