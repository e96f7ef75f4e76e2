// Shadows of point and spot lamps: no self-shadowing, no light leaks, and the width of penumbras.
#include "pass/lamp_room.h"

#include <algorithm>

namespace reflet::test::lamp_penumbra_test {
namespace {

constexpr uvec2 size(96, 54);
const std::vector<std::string> direct{"diffuse.rays=0", "specular.rays=0", "shadow.filter=hard"};

TEST(LampShadow, WallsAroundAPointLampAreLitWithoutSeamsWhereverItHangs) {
    for (const vec3& lamp : {vec3(0.0F), vec3(0.5F, 1.1F, -0.3F), vec3(2.9F, 0.1F, 0.2F), vec3(-2.8F, -2.8F, -2.8F)}) {
        Room room;
        room.scene.lamps.push_back(lampAt(Lamp::Type::point, lamp));
        for (const unsigned resolution : {64U, 512U}) {
            auto settings = direct;
            settings.emplace_back("shadow.lamp_resolution=" + std::to_string(resolution));
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

// Over 5 s: many places of the lamp.
TEST(LampShadow, AClosedBoxIsBlackInsideToATexelFromItsCreases) {
    for (const Lamp::Type type : {Lamp::Type::point, Lamp::Type::spot}) {
        for (const vec3& lamp : {vec3(0, 5, 0), vec3(4, 4, 4), vec3(0.3F, 0.2F, 3.2F), vec3(3.1F, 3.1F, 0)}) {
            Room room;
            room.scene.lamps.push_back(lampAt(type, lamp, -lamp));
            for (const unsigned resolution : {64U, 512U, 2048U}) {
                auto settings = direct;
                settings.emplace_back("shadow.lamp_resolution=" + std::to_string(resolution));
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
                scene, view, size, settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.lamp_resolution=1024"}),
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
            RecordProperty("width_over_truth_" + std::to_string(recorded++),
                           std::to_string(width / (tenPercent * penumbra)));
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

}  // namespace
}  // namespace reflet::test::lamp_penumbra_test
