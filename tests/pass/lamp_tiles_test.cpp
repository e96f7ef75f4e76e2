// Tiled light culling: the light equals that of all lamps, and no tile keeps many lamps that do not reach it.
#include "effects/direct/lamp_tiles.h"
#include "compare/compare.h"
#include "pass/lamp_room.h"
#include "reference/reference.h"
#include "scene/builtin.h"
#include "scene/builtin/noise.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::lamp_tiles_test {
namespace {

constexpr uvec2 size(150, 90);  // the last tiles are parts of tiles
const std::vector<std::string> direct{"diffuse.rays=0", "specular.rays=0"};

enum class Ends : uint8_t { all, some };

// One lamp per number: points and spots of all angles, many with short ranges, inside and outside the room. Ends::all:
// each has a range.
Lamp lampOf(int i, Ends ends) {
    const auto random = [&](int what) { return builtin::hash01(i, what, 0, 7); };
    const vec3 direction = vec3(random(0), random(1), random(2)) - 0.5F;
    Lamp lamp = lampAt(i % 2 == 0 ? Lamp::Type::point : Lamp::Type::spot,
                       2.6F * roomHalf * (vec3(random(3), random(4), random(5)) - 0.5F), direction);
    lamp.intensity = vec3(random(6), random(7), random(8));
    lamp.range = 0.1F + 2.0F * random(9) * random(9);
    if (ends == Ends::some && i % 7 == 0) {
        lamp.range = 0.0F;
    }
    if (ends == Ends::some && i % 31 == 0) {
        lamp.type = Lamp::Type::directional;
        lamp.intensity *= 0.1F;
    }
    lamp.outerAngle = glm::radians(2.0F + 88.0F * random(10));
    lamp.innerAngle = lamp.outerAngle * random(11);
    return lamp;
}

Room roomOf(int lamps, Ends ends) {
    Room room;
    for (int i = 0; i < lamps; ++i) {
        room.scene.lamps.push_back(lampOf(i, ends));
    }
    for (int i = 0; i < 6; ++i) {  // near and far in one tile, and shadows
        const auto random = [&](int what) { return builtin::hash01(i, what, 1, 7) - 0.5F; };
        room.add(boxAround(1.4F * roomHalf * vec3(random(0), random(1), random(2)), vec3(0.15F, 0.4F, 0.25F)));
    }
    return room;
}

// Two corners of the room, the middle (in many ranges, half of the lamps behind), outside with the sky around, along a
// wall, parallel.
std::vector<View> views() {
    std::vector<View> all = viewsOfRoom();
    const auto add = [&](const vec3& position, const vec3& target, float fovY) {
        View view;
        view.camera = builtin::camera("eye", position, target, fovY);
        all.push_back(view);
    };
    add(vec3(0.1F, -0.2F, 0.3F), {-3, 1, 2}, 70.0F);
    add({9, 6, 12}, {0, 0, 0}, 50.0F);
    add({-2.98F, 0.3F, 2.9F}, {-2.95F, 0, -3}, 100.0F);
    add({4, 5, 7}, {0, 0, 0}, 50.0F);
    all.back().camera.orthographicHeight = 9.0F;
    all.back().camera.far = 40.0F;
    return all;
}

Settings settingsWith(const std::vector<std::string>& more) {
    std::vector<std::string> all = direct;
    all.insert(all.end(), more.begin(), more.end());
    return settingsOf(all);
}

// Whether KHR_lights_punctual has any light here, as the renderer's formula says, with `margin` to spare.
bool reaches(const Lamp& lamp, const vec3& p, float margin) {
    const vec3 d = p - lamp.position;
    const float distance = glm::length(d);
    const bool inRange = lamp.range == 0.0F || distance < lamp.range * (1.0F - margin);
    const float cosine = glm::dot(d, lamp.direction) / distance;
    return inRange && (lamp.type != Lamp::Type::spot || cosine > std::cos(lamp.outerAngle) + margin);
}

struct TileSums {
    unsigned reaching = 0;  // lamps that reach a pixel's centre of their tile, over all tiles
    unsigned listed = 0;
    unsigned tiles = 0;
};

// Counts the lamps of each tile, and expects that no lamp is missing.
TileSums countLamps(const Scene& scene, const Pictures& p) {
    TileSums sums;
    const FloatImage& count = p.images.at("lamp_count");
    for (unsigned i = 0; i < count.width * count.height; ++i) {
        const uvec2 first = uvec2(i % count.width, i / count.width) * lampTileSide;
        const uvec2 end = glm::min(first + lampTileSide, p.size);
        std::vector<vec3> surfaces;
        for (unsigned y = first.y; y < end.y; ++y) {
            for (unsigned x = first.x; x < end.x; ++x) {
                if (p.hasSurface(x, y)) {
                    surfaces.push_back(p.position(x, y));
                }
            }
        }
        const auto reaching = static_cast<unsigned>(std::ranges::count_if(scene.lamps, [&](const Lamp& lamp) {
            return std::ranges::any_of(surfaces, [&](const vec3& at) { return reaches(lamp, at, 1e-4F); });
        }));
        const auto listed = static_cast<unsigned>(count.data[i]);
        EXPECT_LE(reaching, listed) << "tile at " << first.x << ", " << first.y;
        sums.reaching += reaching;
        sums.listed += listed;
        ++sums.tiles;
    }
    return sums;
}

TEST(LampTiles, TheLightIsToTheBitThatOfAllLamps) {
    const Room room = roomOf(199, Ends::some);  // two layers of masks, the last of them not full
    for (const View& view : views()) {
        const auto with = [&](const char* tiles) {
            return render(room.scene, view, size, settingsWith({tiles, "shadow.lamps=7"}),
                          {"direct", "lamp_visibility"});
        };
        const Pictures tiles = with("direct.lamp_tiles=true");
        const Pictures all = with("direct.lamp_tiles=false");
        EXPECT_EQ(tiles.images.at("direct").data, all.images.at("direct").data);
        EXPECT_EQ(tiles.images.at("lamp_visibility").data, all.images.at("lamp_visibility").data);
        EXPECT_GT(rangeOf(all.images.at("direct")).max, 0.01F);
    }
    expectSilentValidation("lamp tiles");
}

TEST(LampTiles, HoldEveryLampThatReachesTheTileAndFewOthers) {
    const Room room = roomOf(120, Ends::all);
    TileSums sum;
    for (const View& view : views()) {
        const Pictures p =
            render(room.scene, view, size, settingsWith({"shadow.filter=none"}), {"depth", "lamp_count"});
        const TileSums sums = countLamps(room.scene, p);
        sum.reaching += sums.reaching;
        sum.listed += sums.listed;
        sum.tiles += sums.tiles;
    }
    RecordProperty("listed_for_each_that_reaches", std::to_string(double(sum.listed) / sum.reaching));
    RecordProperty("listed_for_each_tile", std::to_string(double(sum.listed) / sum.tiles));
    EXPECT_GT(sum.reaching, sum.tiles);
    EXPECT_LT(sum.listed, 3 * sum.reaching);
}

TEST(LampTiles, WithoutASurfaceHoldNoLamp) {
    Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::ground({50, 50}, {1, 1}, {1, 1}));
    scene.lamps.push_back(lampAt(Lamp::Type::point, {0, 1, 0}));  // without end
    View view;
    view.camera = builtin::camera("eye", {0, 2, 6}, {0, 2, 0}, 60.0F);  // the horizon in the middle
    const Pictures p = render(scene, view, {64, 64}, settingsWith({}), {"lamp_count"});
    for (unsigned x = 0; x < 4; ++x) {
        EXPECT_EQ(p.value("lamp_count", x, 0), 0.0F);
        EXPECT_EQ(p.value("lamp_count", x, 3), 1.0F);
    }
}

// Over 5 s: the reference samples a hundred lamps.
TEST(LampTiles, AHundredLampsLightTheCourtAsThePathTracerSays) {
    const Scene scene = findBuiltinScene("lamps")->make();
    ASSERT_EQ(scene.lamps.size(), 100U);
    const View view = defaultView(scene);
    constexpr uvec2 picture(160, 90);
    const ReferencePicture truth =
        traceReference(scene, view, picture, {.bounces = 0, .samples = 64, .filter = PixelFilter::center});
    const Pictures p = render(scene, view, picture, settingsWith({}), {"direct"});
    const Difference d = compareImages(p.images.at("direct"), truth.direct, {}).difference;
    RecordProperty("relative_mse", std::to_string(d.relativeMse));
    RecordProperty("bias", std::to_string(d.bias));
    EXPECT_LT(d.relativeMse, 0.01);
    EXPECT_NEAR(d.bias, 0.0, 0.01);
    // Tiles have a fixed number of pixels: those of a larger picture see fewer lamps.
    const FloatImage count = render(scene, view, {320, 180}, settingsWith({}), {"lamp_count"}).images.at("lamp_count");
    double sum = 0.0;
    for (const float lamps : count.data) {
        sum += lamps;
    }
    RecordProperty("lamps_per_tile", std::to_string(sum / static_cast<double>(count.data.size())));
    EXPECT_LT(sum / static_cast<double>(count.data.size()), 5.0);
    expectSilentValidation("a hundred lamps");
}

}  // namespace
}  // namespace reflet::test::lamp_tiles_test
