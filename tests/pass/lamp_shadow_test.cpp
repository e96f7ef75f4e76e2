// Shadows of point and spot lamps: the position of their edges, and their casters.
#include "pass/lamp_room.h"
#include "renderer/draw_shadows/lamp_shadow_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reflet::test::lamp_shadow_test {
namespace {

constexpr uvec2 size(160, 90);
const std::vector<std::string> direct{"diffuse.rays=0", "specular.rays=0", "shadow.filter=hard"};

struct Counts {
    unsigned dark = 0;
    unsigned lit = 0;
    std::array<unsigned, 6> darkOnWall{};
};

// Every pixel of a room with one lamp against the geometric result. Skips pixels whose light ray passes the edge of a
// box within `tolerance` metres, pixels that are not on a wall, and creases.
Counts compareWithGeometry(const Room& room, const View& view, const Settings& settings, float tolerance) {
    const Pictures p = render(room.scene, view, size, settings, {"lamp_visibility", "depth"});
    const vec3 lamp = room.scene.lamps.front().position;
    Counts counts;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = p.position(x, y);
            if (!onOneWall(at)) {
                continue;
            }
            const auto shadowed = [&](float grown) {
                return std::ranges::any_of(room.boxes, [&](const Aabb& box) {
                    return meets({box.min - grown, box.max + grown}, at, lamp);
                });
            };
            const float visibility = p.value("lamp_visibility", x, y);
            if (shadowed(-tolerance)) {
                EXPECT_EQ(visibility, 0.0F) << at.x << ", " << at.y << ", " << at.z;
                ++counts.dark;
                ++counts.darkOnWall[wallOf(at)];
            } else if (!shadowed(tolerance)) {
                EXPECT_EQ(visibility, 1.0F) << at.x << ", " << at.y << ", " << at.z;
                ++counts.lit;
            }
        }
    }
    return counts;
}

TEST(LampShadow, OfASpotHasItsEdgeWhereTheLampProjectsIt) {
    for (const vec3& direction : {vec3(0, -1, 0), vec3(0.4F, -1, 0.3F), vec3(-1, -0.2F, 0.1F)}) {
        Room room;
        Lamp lamp = lampAt(Lamp::Type::spot, {0.3F, 1.5F, 0.2F}, direction);
        lamp.outerAngle = glm::radians(45.0F);
        room.scene.lamps.push_back(lamp);
        room.add(boxAround(lamp.position + 1.2F * lamp.direction, vec3(0.25F, 0.3F, 0.35F)));
        Counts sum;
        for (const View& view : viewsOfRoom()) {
            const Pictures p = render(room.scene, view, size, settingsOf(direct), {"lamp_visibility", "depth"});
            for (unsigned y = 0; y < size.y; ++y) {
                for (unsigned x = 0; x < size.x; ++x) {
                    const vec3 at = p.position(x, y);
                    const float cosine = glm::dot(glm::normalize(at - lamp.position), lamp.direction);
                    if (!onOneWall(at)) {
                        continue;
                    }
                    const auto shadowed = [&](float grown) {
                        return meets({room.boxes[0].min - grown, room.boxes[0].max + grown}, at, lamp.position);
                    };
                    if (cosine < std::cos(lamp.outerAngle) - 1e-3F || shadowed(-0.01F)) {
                        EXPECT_EQ(p.value("lamp_visibility", x, y), 0.0F) << at.x << ", " << at.y << ", " << at.z;
                        sum.dark += cosine > std::cos(lamp.outerAngle) ? 1U : 0U;
                    } else if (cosine > std::cos(lamp.outerAngle) + 1e-3F && !shadowed(0.01F)) {
                        EXPECT_EQ(p.value("lamp_visibility", x, y), 1.0F) << at.x << ", " << at.y << ", " << at.z;
                        ++sum.lit;
                    }
                }
            }
        }
        EXPECT_GT(std::min(sum.dark, sum.lit), 200U);
    }
    expectSilentValidation("shadows of spots");
}

TEST(LampShadow, OfAPointLampFallsInAllSixDirections) {
    Room room;
    const vec3 lamp(0.2F, -0.3F, 0.4F);
    room.scene.lamps.push_back(lampAt(Lamp::Type::point, lamp));
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0F, 1.0F}) {
            vec3 center = lamp;
            center[axis] += sign;
            vec3 half(0.3F, 0.4F, 0.35F);
            half[axis] = 0.05F;
            room.add(boxAround(center, half));
        }
    }
    Counts sum;
    for (const View& view : viewsOfRoom()) {
        const Counts counts = compareWithGeometry(room, view, settingsOf(direct), 0.01F);
        sum.lit += counts.lit;
        for (size_t i = 0; i < 6; ++i) {
            sum.darkOnWall[i] += counts.darkOnWall[i];
        }
    }
    EXPECT_GT(sum.lit, 2000U);
    EXPECT_GT(std::ranges::min(sum.darkOnWall), 50U);
    expectSilentValidation("shadows of point lamps");
}

TEST(LampShadow, OfAWideSpotIsThatOfAPointLamp) {
    Room room;
    Lamp lamp = lampAt(Lamp::Type::spot, {0.2F, 2.0F, 0.4F});
    lamp.outerAngle = glm::radians(89.0F);
    room.scene.lamps.push_back(lamp);
    room.add(boxAround({1.5F, 1.2F, 0.4F}, {0.2F, 0.2F, 0.4F}));
    room.add(boxAround({0.2F, 0.5F, 0.5F}, {0.4F, 0.1F, 0.4F}));
    for (const View& view : viewsOfRoom()) {
        const Pictures wide = render(room.scene, view, size, settingsOf(direct), {"lamp_visibility", "depth"});
        room.scene.lamps.front().type = Lamp::Type::point;
        const Pictures point = render(room.scene, view, size, settingsOf(direct), {"lamp_visibility"});
        room.scene.lamps.front().type = Lamp::Type::spot;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                if (wide.position(x, y).y < lamp.position.y - 0.2F) {  // in the cone
                    EXPECT_EQ(wide.value("lamp_visibility", x, y), point.value("lamp_visibility", x, y));
                }
            }
        }
    }
}

TEST(LampShadow, IsCastByNothingNearerToTheLampThanItsRadius) {
    Room room;
    room.scene.lamps.push_back(lampAt(Lamp::Type::point, {0.2F, 0.1F, 0}));
    builtin::place(room.scene, "shade", 0, builtin::sphere(0.098F, 32), builtin::at({0.2F, 0.1F, 0}));
    View view = viewsOfRoom().front();
    const auto brightest = [&] {
        const Pictures p = render(room.scene, view, size, settingsOf(direct), {"lamp_visibility", "depth"});
        float most = 0.0F;
        for (unsigned y = 0; y < size.y; ++y) {
            for (unsigned x = 0; x < size.x; ++x) {
                const vec3 at = glm::abs(p.position(x, y));
                most = std::max({at.x, at.y, at.z}) > 2.9F ? std::max(most, p.value("lamp_visibility", x, y)) : most;
            }
        }
        return most;
    };
    EXPECT_EQ(brightest(), 0.0F) << "a point in its shade";
    view.lampRadius = 0.1F;
    EXPECT_EQ(brightest(), 1.0F);
}

TEST(LampShadow, CutOutMaterialsCastOnlyWhatIsThere) {
    Room room;
    room.scene.lamps.push_back(lampAt(Lamp::Type::point, {0, 2, 0}));
    TextureImage image{"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}};  // left half there, right half cut out
    Sampler nearest;
    nearest.magLinear = nearest.minLinear = nearest.mips = false;
    nearest.wrapU = nearest.wrapV = Wrap::clamp;
    Material material = builtin::textured("cut out", builtin::addTexture(room.scene, image, nearest), 1.0F);
    material.alphaCutoff = 0.5F;
    builtin::place(room.scene, "sheet", builtin::addMaterial(room.scene, material),
                   builtin::ground({1, 1}, {1, 1}, {1, 1}), builtin::at({0, 1, 0}));
    const View view = viewsOfRoom().front();
    const Pictures p = render(room.scene, view, size, settingsOf(direct), {"lamp_visibility", "depth"});
    unsigned dark = 0;
    unsigned lit = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 at = p.position(x, y);
            if (at.y < -roomHalf + 0.01F && std::abs(at.x) > 0.05F && std::max(std::abs(at.x), std::abs(at.z)) < 2.9F) {
                EXPECT_EQ(p.value("lamp_visibility", x, y), at.x < 0.0F ? 0.0F : 1.0F) << at.x << ", " << at.z;
                ++(at.x < 0.0F ? dark : lit);
            }
        }
    }
    EXPECT_GT(std::min(dark, lit), 100U);
}

TEST(LampShadow, IsCastByTheStrongestAndTheOthersShineThroughEverythingWithAWarning) {
    LampBlock lamps{};
    lamps.count = 4;
    for (uint32_t i = 0; i < lamps.count; ++i) {
        lamps.lamps[i].intensity = vec3(1.0F, static_cast<float>(i), 0.0F);
        lamps.lamps[i].shadow = noLampShadow;
    }
    lamps.lamps[3].type = lampDirectional;
    LampShadowScene scene;  // empty: there is nothing that a directional lamp's tiles could show
    std::vector<std::string> warnings;
    const auto plan = [&](uint32_t most, uint32_t resolution, uint32_t largestSide) {
        warnings.clear();
        LampBlock changed = lamps;
        ShadowSettings settings;
        settings.lamps = most;
        settings.lampResolution = resolution;
        const LampShadows shadows = planLampShadows(changed, settings, largestSide, scene,
                                                    [&](const std::string& text) { warnings.push_back(text); });
        std::vector<uint32_t> indices;
        for (uint32_t i = 0; i < lamps.count; ++i) {
            indices.push_back(changed.lamps[i].shadow);
        }
        return std::pair(shadows, indices);
    };
    constexpr uint32_t none = noLampShadow;
    EXPECT_EQ(plan(8, 512, 16384).second, (std::vector<uint32_t>{1, 2, 0, none}));
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(plan(1, 512, 16384).second, (std::vector<uint32_t>{none, none, 0, none}));
    EXPECT_EQ(warnings, std::vector<std::string>{"the scene has 3 lamps, but only the strongest 1 cast shadows: "
                                                 "shadow.lamps is the limit"});
    EXPECT_EQ(plan(0, 512, 16384).first.count, 0U);
    scene.bounds = {vec3(-1.0F), vec3(1.0F)};
    EXPECT_EQ(plan(8, 512, 16384).second, (std::vector<uint32_t>{2, 3, 1, 0})) << "as at 5 m";
    scene.bounds = {};
    const LampShadows smaller = plan(8, 512, 2048).first;  // 18 tiles, 5 in a row
    EXPECT_EQ(smaller.tileSize, 256U);
    EXPECT_EQ(smaller.columns, 5U);
    EXPECT_EQ(warnings.size(), 1U);
}

TEST(LampShadow, WithoutShadowsLampsShineThroughEverything) {
    Room room;
    room.scene.lamps.push_back(lampAt(Lamp::Type::point, {0.2F, 0.1F, 0}));
    room.scene.lamps.push_back(lampAt(Lamp::Type::point, {0.2F, 0.1F, 0}));
    room.scene.lamps[1].intensity = vec3(1.0F);
    room.add(boxAround({0.2F, 0.1F, 0}, vec3(0.3F)));
    const View view = viewsOfRoom().front();
    const auto wall = [&](const char* setting) {
        auto settings = direct;
        settings.emplace_back(setting);
        return render(room.scene, view, size, settingsOf(settings), {"direct"}).value("direct", 2, 2);
    };
    const float both = wall("shadow.lamps=0");
    EXPECT_GT(both, 0.0F);
    EXPECT_EQ(wall("shadow.filter=none"), both);
    EXPECT_NEAR(wall("shadow.lamps=1"), both / 11.0F, 0.002F * both) << "the stronger one is in the box";
    EXPECT_EQ(wall("shadow.lamps=2"), 0.0F);
}

}  // namespace
}  // namespace reflet::test::lamp_shadow_test
