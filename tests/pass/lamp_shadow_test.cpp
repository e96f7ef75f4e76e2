// Shadows of point and spot lamps: where their edges lie, that nothing shadows itself, who casts them.
#include "pass/harness.h"

#include <algorithm>
#include <cmath>

namespace reflet::test {
namespace {

constexpr uvec2 size(160, 90);
const std::vector<std::string> direct{"diffuse.rays=0", "specular.rays=0", "shadow.filter=hard"};
constexpr float roomHalf = 3.0F;

Material bothSides() {
    Material material = lambertMaterial(vec3(0.5F));
    material.doubleSided = true;
    return material;
}

Lamp lampAt(Lamp::Type type, const vec3& position, const vec3& direction = {0, -1, 0}) {
    Lamp lamp;
    lamp.type = type;
    lamp.position = position;
    lamp.direction = glm::normalize(direction);
    lamp.intensity = vec3(10.0F);
    return lamp;
}

// Whether the way from p to the lamp meets a box.
bool meets(const Aabb& box, const vec3& p, const vec3& lamp) {
    float from = 0.0F;
    float to = 1.0F;
    for (int axis = 0; axis < 3; ++axis) {
        const float way = lamp[axis] - p[axis];
        const float a = (box.min[axis] - p[axis]) / way;
        const float b = (box.max[axis] - p[axis]) / way;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
    }
    return from < to;
}

Aabb boxAround(const vec3& center, const vec3& half) {
    return {center - half, center + half};
}

// A room of walls without thickness, and boxes in it.
struct Room {
    Scene scene = sceneOf(bothSides(), builtin::box(vec3(roomHalf)));
    std::vector<Aabb> boxes;

    void add(const Aabb& box) {
        boxes.push_back(box);
        builtin::place(scene, "box", 0, builtin::box(0.5F * box.size()), builtin::at(box.center()));
    }
};

// Views from one corner and from the opposite one: together they show all walls.
std::vector<View> viewsOfRoom() {
    std::vector<View> views(2);
    for (size_t i = 0; i < views.size(); ++i) {
        const float sign = i == 0 ? 1.0F : -1.0F;
        views[i].camera.position = vec3(sign * 0.95F * roomHalf);
        views[i].camera.target = vec3(0.0F);
        views[i].camera.fovY = glm::radians(95.0F);
    }
    return views;
}

// Metres from a point on a wall to the next wall.
float distanceToCrease(const vec3& p) {
    std::array<float, 3> toWalls{};
    for (int axis = 0; axis < 3; ++axis) {
        toWalls[static_cast<size_t>(axis)] = std::abs(roomHalf - std::abs(p[axis]));
    }
    std::ranges::sort(toWalls);
    return toWalls[1];
}

// Not on a box, and in no crease.
bool onOneWall(const vec3& p) {
    return std::abs(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) - roomHalf) < 1e-3F &&
           distanceToCrease(p) > 0.06F;
}

size_t wallOf(const vec3& p) {
    for (int axis = 0; axis < 2; ++axis) {
        if (std::abs(p[axis]) > roomHalf - 0.01F) {
            return 2U * static_cast<size_t>(axis) + (p[axis] < 0.0F ? 1U : 0U);
        }
    }
    return p.z < 0.0F ? 5U : 4U;
}

struct Counts {
    unsigned dark = 0;
    unsigned lit = 0;
    std::array<unsigned, 6> darkOnWall{};
};

// Every pixel of a room with one lamp against the answer by geometry. Skipped are pixels whose way to the lamp passes
// an edge of a box by less than `tolerance` metres, what is in no wall, and creases.
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

TEST(LampShadow, WallsAroundAPointLampAreLitWithoutSeamsWhereverItHangs) {
    for (const vec3& lamp : {vec3(0.0F), vec3(0.5F, 1.1F, -0.3F), vec3(2.9F, 0.1F, 0.2F), vec3(-2.8F, -2.8F, -2.8F)}) {
        Room room;
        room.scene.lamps.push_back(lampAt(Lamp::Type::point, lamp));
        for (const unsigned resolution : {64U, 512U}) {
            auto settings = direct;
            settings.emplace_back("shadow.lampResolution=" + std::to_string(resolution));
            for (const View& view : viewsOfRoom()) {
                const Pictures p = render(room.scene, view, size, settingsOf(settings), {"lamp_visibility", "depth"});
                unsigned dark = 0;
                for (unsigned y = 0; y < size.y; ++y) {
                    for (unsigned x = 0; x < size.x; ++x) {
                        const vec3 at = p.position(x, y);
                        // Creases are known to six texels.
                        const float crease = 12.0F / static_cast<float>(resolution) * glm::distance(at, lamp);
                        dark += distanceToCrease(at) > crease && p.value("lamp_visibility", x, y) < 1.0F ? 1U : 0U;
                    }
                }
                EXPECT_EQ(dark, 0U) << resolution << ", lamp at " << lamp.x << ", " << lamp.y << ", " << lamp.z;
            }
        }
    }
}

TEST(LampShadow, AClosedBoxIsBlackInsideToATexelFromItsCreases) {
    for (const Lamp::Type type : {Lamp::Type::point, Lamp::Type::spot}) {
        for (const vec3& lamp : {vec3(0, 5, 0), vec3(4, 4, 4), vec3(0.3F, 0.2F, 3.2F), vec3(3.1F, 3.1F, 0)}) {
            Room room;
            room.scene.lamps.push_back(lampAt(type, lamp, -lamp));
            for (const unsigned resolution : {64U, 512U, 2048U}) {
                auto settings = direct;
                settings.emplace_back("shadow.lampResolution=" + std::to_string(resolution));
                for (const View& view : viewsOfRoom()) {
                    const Pictures p = render(room.scene, view, size, settingsOf(settings), {"direct", "depth"});
                    for (unsigned y = 0; y < size.y; ++y) {
                        for (unsigned x = 0; x < size.x; ++x) {
                            const vec3 at = p.position(x, y);
                            const float texel = 2.0F / static_cast<float>(resolution) * glm::distance(at, lamp);
                            if (distanceToCrease(at) > texel) {
                                EXPECT_EQ(p.value("direct", x, y), 0.0F) << at.x << ", " << at.y << ", " << at.z;
                            }
                        }
                    }
                }
            }
        }
    }
}

// Where a rising profile first reaches `level`, in columns.
double crossing(const std::vector<double>& profile, double level) {
    for (size_t x = 1; x < profile.size(); ++x) {
        if (profile[x] >= level) {
            const double before = profile[x - 1];
            return static_cast<double>(x) - (profile[x] - level) / std::max(profile[x] - before, 1e-9);
        }
    }
    return static_cast<double>(profile.size());
}

TEST(LampShadow, OfAKnifeEdgeUnderALampsDiskIsAsWideAsSimilarTrianglesSayWithinATenth) {
    constexpr float lampHeight = 4.0F;
    int recorded = 0;
    constexpr double tenPercent = 0.6870;  // radii from its middle, a straight edge leaves a tenth of a disk open
    for (const Lamp::Type type : {Lamp::Type::spot, Lamp::Type::point}) {
        for (const auto& [radius, height] : {std::pair(0.2F, 0.5F), {0.2F, 2.0F}, {0.1F, 1.0F}, {0.1F, 3.0F}}) {
            Scene scene = sceneOf(bothSides(), builtin::ground({10, 10}, {1, 1}, {1, 1}));
            // Its edge is at x = 0, which light passes on the side of positive x.
            builtin::place(scene, "blade", 0, builtin::ground({3, 3}, {1, 1}, {1, 1}), builtin::at({-3, height, 0}));
            scene.lamps.push_back(lampAt(type, {0, lampHeight, 0}));
            View view;
            view.lampRadius = radius;
            const float penumbra = 2.0F * radius * height / (lampHeight - height);
            view.camera.position = {0, 0.4F, 0};
            view.camera.target = {0, 0, 0};
            view.camera.up = {0, 0, -1};
            view.camera.orthographicHeight = 2.0F * penumbra * static_cast<float>(size.y) / static_cast<float>(size.x);
            const Pictures p = renderMean(
                scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.lampResolution=1024"}),
                {"lamp_visibility"}, 4);
            std::vector<double> profile(size.x);
            for (unsigned x = 0; x < size.x; ++x) {
                for (unsigned y = 0; y < size.y; ++y) {
                    profile[x] += p.value("lamp_visibility", x, y) / size.y;
                }
            }
            const double width = (crossing(profile, 0.9) - crossing(profile, 0.1)) * 2.0 * penumbra / size.x;
            EXPECT_NEAR(width, tenPercent * penumbra, 0.1 * tenPercent * penumbra) << radius << ", " << height;
            EXPECT_NEAR(crossing(profile, 0.5) / size.x, 0.5, 0.03) << "its middle: " << radius << ", " << height;
            RecordProperty("width_over_truth_" + std::to_string(recorded++), std::to_string(width / (tenPercent * penumbra)));
        }
    }
}

TEST(LampShadow, OfALampsDiskLeavesWallsLitAndAClosedBoxBlackInEveryFilter) {
    for (const char* filter : {"shadow.filter=pcf", "shadow.filter=pcss"}) {
        for (const float radius : {0.0F, 0.1F}) {
            for (const vec3& lamp : {vec3(0.5F, 1.1F, -0.3F), vec3(0.4F, 5, 0.1F)}) {
                Room room;
                room.scene.lamps.push_back(lampAt(Lamp::Type::point, lamp));
                const bool inside = lamp.y < roomHalf;
                unsigned wrong = 0;
                for (View view : viewsOfRoom()) {
                    view.lampRadius = radius;
                    const Pictures p =
                        render(room.scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0", filter}),
                               {"lamp_visibility", "depth"});
                    for (unsigned y = 0; y < size.y; ++y) {
                        for (unsigned x = 0; x < size.x; ++x) {
                            const vec3 at = p.position(x, y);
                            if (distanceToCrease(at) > 0.13F) {
                                wrong += p.value("lamp_visibility", x, y) == (inside ? 1.0F : 0.0F) ? 0U : 1U;
                            }
                        }
                    }
                }
                EXPECT_EQ(wrong, 0U) << filter << ", radius " << radius << ", lamp at y = " << lamp.y;
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
    Image image{"half", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}};  // left half there, right half cut out
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
    std::vector<std::string> warnings;
    const auto plan = [&](uint32_t most, uint32_t resolution, uint32_t largestSide) {
        warnings.clear();
        LampBlock changed = lamps;
        ShadowSettings settings;
        settings.lamps = most;
        settings.lampResolution = resolution;
        const LampShadows shadows =
            planLampShadows(changed, settings, largestSide, [&](const std::string& text) { warnings.push_back(text); });
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
    EXPECT_EQ(warnings, std::vector<std::string>{"the scene has 3 point and spot lamps, of which the strongest 1 cast "
                                                 "shadows (shadow.lamps)"});
    EXPECT_EQ(plan(0, 512, 16384).first.count, 0U);
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
}  // namespace reflet::test
