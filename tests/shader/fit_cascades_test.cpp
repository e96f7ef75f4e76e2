// fitCascades: every visible point is in the map of its distance, and texels stay aligned when the camera moves.
#include "renderer/draw_shadows/shadow_maps.h"
#include "shader/cascades_test.h"
#include "shader/fit_cases.h"
#include "shader/harness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace reflet::test::fit_cascades_test {
namespace {

constexpr uvec2 pixels{640, 360};

const Aabb& large() {
    static const Aabb box = boxOf({-100, -1, -120}, {90, 20, 100});
    return box;
}

ShadowSettings settingsWith(uint cascades) {
    ShadowSettings settings;
    settings.resolution = 1024;
    settings.cascades = cascades;
    settings.cascadeBlend = 0.3F;
    return settings;
}

std::vector<Camera> cameras() {
    Camera narrow = cameraAt({160, 30, 0}, {0, 0, 0});
    narrow.fovY = glm::radians(15.0F);
    Camera inside = cameraAt({-90, 5, 0}, {60, 4, 0});
    inside.fovY = glm::radians(15.0F);
    Camera orthographic = cameraAt({40, 60, 30}, {0, 0, 0});
    orthographic.orthographicHeight = 30.0F;
    return {cameraAt({3, 2, 1}, {-1, 1, 0}),
            cameraAt({3, 9, 1}, {3, 0, 1}),
            cameraAt({-99, 1, 80}, {0, 0, 0}),
            narrow,
            inside,
            orthographic};
}

template <class Check>
void forEveryFit(float reach, Check check) {
    for (const Camera& camera : cameras()) {
        const ViewParams view = makeViewParams(camera, pixels, 0, 0);
        for (const Aabb& box : {large(), boxOf({-5, 0, -5}, {5, 4, 5})}) {
            for (const vec3& sun : sunDirections()) {
                for (const uint count : {2U, 3U, 4U}) {
                    SCOPED_TRACE(::testing::Message()
                                 << "camera at " << camera.position.x << ", box of " << box.size().x << ", sun "
                                 << sun.x << ' ' << sun.y << ' ' << sun.z << ", " << count << " cascades");
                    check(view, box, fitCascades(view, box, sun, settingsWith(count), reach));
                }
            }
        }
    }
}

float distanceOf(const ViewParams& view, const vec3& p) {
    return glm::dot(view.viewPlane, vec4(p, 1.0F));
}

// Points of the box in the view, its edges included.
std::vector<vec3> pointsSeen(const ViewParams& view, const Aabb& box) {
    std::mt19937 random(7);
    const auto number = [&] { return static_cast<float>(random() >> 8U) / 16777216.0F; };
    std::vector<vec3> points;
    for (int i = 0; i < 400; ++i) {
        const vec2 ndc = glm::clamp(3.0F * vec2(number(), number()) - 1.5F, -1.0F, 1.0F) * 0.9999F;
        const vec4 clip = view.clipToWorld * vec4(ndc, 0.5F, 1.0F);
        const vec3 on = vec3(clip) / clip.w;
        const vec3 ahead = view.eye.w > 0.0F ? on - vec3(view.eye) : vec3(view.viewPlane);
        const vec3 start = view.eye.w > 0.0F ? vec3(view.eye) : on - ahead * distanceOf(view, on);
        const vec3 p = start + ahead * (200.0F * number() * number() / glm::dot(vec3(view.viewPlane), ahead));
        if (p == glm::clamp(p, box.min, box.max) && isVisible(view, p)) {
            points.push_back(p);
        }
    }
    return points;
}

// Distances of a point to the four sides of a map, negative outside; sides with no scene beyond them do not count.
float distanceInside(const ShadowMapParams& map, const Aabb& scene, const vec3& p) {
    Aabb all;
    for (unsigned i = 0; i < 8; ++i) {
        all.add(inMap(map, scene.corner(i)));
    }
    const vec3 s = inMap(map, p);
    float least = std::numeric_limits<float>::max();
    const glm::mat4 rows = glm::transpose(map.worldToShadow);
    for (int axis = 0; axis < 2; ++axis) {
        const float metres = 1.0F / glm::length(vec3(rows[axis]));
        if (all.max[axis] > 1.0F) {
            least = std::min(least, (1.0F - s[axis]) * metres);
        }
        if (all.min[axis] < -1.0F) {
            least = std::min(least, (1.0F + s[axis]) * metres);
        }
    }
    return least;
}

TEST(FitCascades, holdsEveryVisiblePointInTheMapsOfItsDistanceAndTheReachAroundIt) {
    for (const float reach : {0.0F, 0.7F}) {
        size_t visible = 0;
        size_t bounded = 0;
        forEveryFit(reach, [&](const ViewParams& view, const Aabb& box, const SunShadowParams& sun) {
            for (const vec3& p : pointsSeen(view, box)) {
                const float distance = distanceOf(view, p);
                ASSERT_LE(distance, sun.ends[sun.count - 1]);
                for (uint i = 0; i < sun.count; ++i) {
                    const float begin = i == 0 ? 0.0F : sun.blends[i - 1];
                    if (distance >= begin && distance <= sun.ends[i]) {
                        const float inside = distanceInside(sun.maps[i], box, p);
                        ASSERT_GE(inside, reach) << "cascade " << i;
                        bounded += inside < 1e30F ? 1 : 0;
                        ++visible;
                    }
                }
            }
        });
        EXPECT_GT(visible, 20000U);
        EXPECT_GT(bounded, 20000U);
    }
}

TEST(FitCascades, holdsEveryCasterAndEveryReceiverInDepth) {
    forEveryFit(0.0F, [&](const ViewParams&, const Aabb& box, const SunShadowParams& sun) {
        for (uint i = 0; i < sun.count; ++i) {
            for (unsigned corner = 0; corner < 8; ++corner) {
                const float depth = inMap(sun.maps[i], box.corner(corner)).z;
                ASSERT_GT(depth, 0.0F);
                ASSERT_LT(depth, 1.0F);
            }
        }
    });
}

TEST(FitCascades, endsLieOneBehindTheOtherAndTexelsGrow) {
    forEveryFit(0.0F, [&](const ViewParams&, const Aabb&, const SunShadowParams& sun) {
        for (uint i = 0; i < sun.count; ++i) {
            ASSERT_LT(sun.blends[i], sun.ends[i]);
            ASSERT_GT(sun.blends[i], i == 0 ? 0.0F : sun.ends[i - 1]);
            ASSERT_GE(sun.maps[i].texelSize, i == 0 ? 0.0F : sun.maps[i - 1].texelSize);
        }
    });
    const ViewParams view = makeViewParams(cameras()[0], pixels, 0, 0);
    const SunShadowParams sun = fitCascades(view, large(), sunDirections()[9], settingsWith(4));
    EXPECT_LT(sun.maps[0].texelSize * 20.0F, sun.maps[3].texelSize);
}

TEST(FitCascades, splitsAtEqualStepsOrAtEqualRatios) {
    const ViewParams view = makeViewParams(cameras()[0], pixels, 0, 0);
    ShadowSettings settings = settingsWith(4);
    settings.cascadeSplit = 0.0F;
    SunShadowParams sun = fitCascades(view, large(), {0, -1, 0}, settings);
    EXPECT_NEAR(sun.ends[1] - sun.ends[0], sun.ends[3] - sun.ends[2], 1e-3F);
    settings.cascadeSplit = 1.0F;
    sun = fitCascades(view, large(), {0, -1, 0}, settings);
    EXPECT_NEAR(sun.ends[1] / sun.ends[0], sun.ends[3] / sun.ends[2], 1e-3F);
}

// Turns by 6 degrees from pose to pose, and walks.
std::vector<ViewParams> poses() {
    std::vector<ViewParams> views;
    for (int i = 0; i < 60; ++i) {
        const float angle = glm::radians(6.0F * static_cast<float>(i));
        const vec3 position = vec3(3, 2, 1) + 0.037F * static_cast<float>(i) * vec3(1, 0.1F, -0.5F);
        const vec3 ahead(std::cos(angle), 0.3F * std::sin(0.7F * angle), std::sin(angle));
        views.push_back(makeViewParams(cameraAt(position, position + ahead), pixels, 0, 0));
    }
    return views;
}

vec2 texelOf(const ShadowMapParams& map, const vec3& p, uint resolution) {
    return (0.5F + 0.5F * vec2(inMap(map, p))) * static_cast<float>(resolution);
}

// Expects that points lie in the same places of their texels in both maps; returns by how many texels the grid moved.
float expectSameGrid(const ShadowMapParams& a, const ShadowMapParams& b, uint resolution) {
    float moved = 0.0F;
    for (const vec3& p : {vec3(3, 0, 1), vec3(-2, 1, 4), vec3(9, 0.3F, -6)}) {
        const vec2 by = texelOf(b, p, resolution) - texelOf(a, p, resolution);
        EXPECT_LT(glm::length(by - glm::round(by)), 0.02F) << by.x << ' ' << by.y;
        moved = std::max(moved, glm::length(by));
    }
    return moved;
}

TEST(FitCascades, texelsKeepTheirSizeAndTheirPlacesWhileTheCameraTurnsAndWalks) {
    const auto views = poses();
    for (const vec3& sun : sunDirections()) {
        for (const uint count : {2U, 4U}) {
            const ShadowSettings settings = settingsWith(count);
            const SunShadowParams first = fitCascades(views[0], large(), sun, settings);
            float moved = 0.0F;
            for (const ViewParams& view : views) {
                const SunShadowParams now = fitCascades(view, large(), sun, settings);
                for (uint i = 0; i < count; ++i) {
                    ASSERT_EQ(now.ends[i], first.ends[i]);
                    ASSERT_EQ(now.maps[i].texelSize, first.maps[i].texelSize);
                    ASSERT_EQ(now.maps[i].depthRange, first.maps[i].depthRange);
                    moved = std::max(moved, expectSameGrid(first.maps[i], now.maps[i], settings.resolution));
                }
            }
            EXPECT_GT(moved, 100.0F) << "the maps follow the camera";
        }
    }
}

TEST(FitSunShadow, texelsOfOneSizeKeepTheirPlacesWhileTheCameraTurnsAndWalks) {
    constexpr uint resolution = 1024;
    for (const vec3& sun : sunDirections()) {
        std::vector<ShadowMapParams> kinds;  // one of each size and shape
        int again = 0;
        for (const ViewParams& view : poses()) {
            const ShadowMapParams now = fitSunShadow(view.clipToWorld, large(), sun, resolution);
            const auto sameSize = [&](const ShadowMapParams& m) {
                return mat3(m.worldToShadow) == mat3(now.worldToShadow);
            };
            const auto same = std::ranges::find_if(kinds, sameSize);
            if (same == kinds.end()) {
                kinds.push_back(now);
            } else {
                expectSameGrid(*same, now, resolution);
                ++again;
            }
        }
        EXPECT_GT(again, 15) << kinds.size();
    }
}

TEST(FitSunShadows, areOneMapWhereTheExtentIsGiven) {
    ShadowSettings settings = settingsWith(4);
    settings.extent = 10.0F;
    const SunShadowParams sun = fitSunShadows(poses()[0], large(), {0, -1, 0}, settings);
    EXPECT_EQ(sun.count, 1U);
    EXPECT_EQ(sun.maps[0].worldToShadow,
              centredSunShadow(large(), {0, -1, 0}, 10.0F, settings.resolution).worldToShadow);
}

// A camera at the origin that looks along -Z.
ViewParams straightAhead() {
    return makeViewParams(cameraAt({0, 0, 0}, {0, 0, -1}), pixels, 0, 0);
}

float nearestOf(const std::vector<Draw>& draws) {
    DrawList list;
    list.draws = draws;
    return nearestSurface(straightAhead(), list);
}

Draw drawOf(const Aabb& box) {
    Draw draw;
    draw.boundsW = box;
    return draw;
}

TEST(NearestSurface, isWhereBoxesComeIntoView) {
    EXPECT_EQ(nearestOf({drawOf(boxOf({-1, -1, 3}, {1, 1, 5}))}), std::numeric_limits<float>::max());
    EXPECT_NEAR(nearestOf({drawOf(boxOf({-1, -1, -9}, {1, 1, -7})), drawOf(boxOf({30, 0, -20}, {31, 1, -5}))}), 7.0F,
                0.01F);
    // Ground below the camera is first seen where the view's lower edge meets it.
    const float slope = 0.5F * straightAhead().pixelAngle * static_cast<float>(pixels.y);
    EXPECT_NEAR(nearestOf({drawOf(boxOf({-99, -3, -99}, {99, -2, 99}))}), 2.0F / slope, 0.05F);
}

TEST(NearestSurface, isThatOfAMeshesPartsWhereItsBoxHoldsTheCamera) {
    const Aabb parts[] = {boxOf({-5, -5, -5}, {5, -4, 5}), boxOf({-5, -5, -5}, {5, 5, -4})};
    Draw room = drawOf(boxOf({-10, -10, -10}, {10, 10, 10}));
    EXPECT_LT(nearestOf({room}), 0.2F);
    room.pieces = parts;
    room.objectToWorld = glm::scale(mat4(1.0F), vec3(2.0F));
    EXPECT_NEAR(nearestOf({room}), 8.0F, 0.01F);
}

TEST(FitSunShadows, chooseOneMapForARoomAndFineOnesForALongRoad) {
    ShadowSettings settings;
    const vec3 sun = glm::normalize(vec3(0.5F, -0.4F, 0.3F));
    const ViewParams view = straightAhead();
    const Aabb room = boxOf({-4, -2, -8}, {4, 3, 2});
    const Aabb road = boxOf({-200, -2, -1000}, {200, 6, 10});
    const float slope = std::tan(glm::radians(0.265F));
    const auto fit = [&](const Aabb& scene, float nearest) {
        return fitSunShadows(view, scene, sun, settings, filterReach(scene, settings, slope), nearest);
    };
    EXPECT_EQ(fit(room, 2.0F).count, 1U);
    EXPECT_EQ(fit(road, 0.0F).count, 1U);
    EXPECT_EQ(fit(road, 300.0F).count, 1U);
    const SunShadowParams cascades = fit(road, 4.0F);
    EXPECT_GT(cascades.count, 1U);
    EXPECT_LT(cascades.maps[0].texelSize, 0.02F);
    EXPECT_GE(cascades.ends[cascades.count - 1], 1000.0F);
    // The grid stays where it is while the nearest surface changes a little.
    EXPECT_EQ(fit(road, 4.7F).maps[0].worldToShadow, cascades.maps[0].worldToShadow);
}

class Cascades : public ShaderTest {};

TEST_F(Cascades, followOneAnotherByDistanceAndBlendEvenly) {
    SunShadowParams sun{};
    sun.count = 3;
    const float ends[] = {2, 10, 30};
    const float blends[] = {1.5F, 10, 29};  // the second does not blend
    std::ranges::copy(ends, sun.ends);
    std::ranges::copy(blends, sun.blends);
    const std::vector<float> distances{0, 1, 1.5F, 1.75F, 1.99F, 2, 5, 9.99F, 10, 29, 29.5F, 30, 1000};
    const std::vector<CascadeAnswer> expected{{0, 0}, {0, 0}, {0, 0}, {0, 0.5F}, {0, 0.98F}, {1, 0}, {1, 0},
                                              {1, 0}, {2, 0}, {2, 0}, {2, 0},    {2, 0},     {2, 0}};
    const auto answers = mapOnDevice<CascadeAnswer>("cascades_test.comp", distances, sun);
    for (size_t i = 0; i < distances.size(); ++i) {
        EXPECT_EQ(answers[i].index, expected[i].index) << distances[i];
        EXPECT_NEAR(answers[i].next, expected[i].next, 1e-5F) << distances[i];
    }
}

}  // namespace
}  // namespace reflet::test::fit_cascades_test
