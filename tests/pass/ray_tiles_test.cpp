// Tiles of rays: their classes, their number of rays, and how adaptive sampling follows the noise.
#include "effects/lobe/ray_tiles.h"
#include "compare/compare.h"
#include "pass/harness.h"
#include "scene/builtin.h"

#include <algorithm>
#include <cmath>

namespace reflet::test::ray_tiles_test {
namespace {

constexpr uvec2 size(148, 84);  // tiles go over the picture's edges

uvec2 tilesOf(uvec2 pixels) {
    return (pixels + rayTileSide - 1U) / rayTileSide;
}

Settings adaptive(const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"denoise.enabled=true", "diffuse.adaptive=true", "specular.adaptive=true",
                                 "diffuse.rays=2", "specular.rays=2"};
    all.insert(all.end(), more.begin(), more.end());
    return settingsOf(all);
}

// Three boxes in the sky: a mirror, a glossy one, one that touches both.
Scene boxes() {
    Scene scene;
    const auto add = [&](float roughness, const vec3& center, const vec3& halfSize) {
        const uint32_t material = builtin::addMaterial(scene, builtin::plain("", {0xC0C0C0, roughness, 1.0F}));
        builtin::place(scene, "box", material, builtin::box(halfSize), builtin::at(center));
    };
    add(0.0F, {-2.0F, 0.5F, 0.0F}, {1.5F, 1.0F, 0.1F});
    add(0.3F, {2.0F, 0.5F, 0.0F}, {1.5F, 1.0F, 0.1F});
    add(0.005F, {0.0F, -1.2F, 0.0F}, {2.0F, 0.4F, 0.1F});
    return scene;
}

View frontOf(const Scene& scene) {
    View view = defaultView(scene);
    view.camera = builtin::camera("front", {0, 0, 6}, {0, 0, 0}, 50.0F);
    return view;
}

// As the pixels of the tile say.
uint32_t classOf(const Pictures& p, uvec2 tile, bool lambert) {
    uint32_t surfaces = 0;
    uint32_t glossy = 0;
    for (uint32_t y = tile.y * rayTileSide; y < std::min((tile.y + 1) * rayTileSide, p.size.y); ++y) {
        for (uint32_t x = tile.x * rayTileSide; x < std::min((tile.x + 1) * rayTileSide, p.size.x); ++x) {
            if (p.hasSurface(x, y)) {
                ++surfaces;
                glossy += p.value("roughness", x, y) > mirrorRoughness ? 1 : 0;
            }
        }
    }
    if (surfaces == 0 || lambert) {
        return surfaces == 0 ? tileSky : tileMatt;
    }
    return glossy > 0 ? tileGlossy : tileMirror;
}

uint32_t surfacesIn(const Pictures& p, uvec2 tile) {
    uint32_t count = 0;
    for (uint32_t y = tile.y * rayTileSide; y < std::min((tile.y + 1) * rayTileSide, p.size.y); ++y) {
        for (uint32_t x = tile.x * rayTileSide; x < std::min((tile.x + 1) * rayTileSide, p.size.x); ++x) {
            count += p.hasSurface(x, y) ? 1 : 0;
        }
    }
    return count;
}

template <class Visit>
void forTiles(uvec2 pixels, Visit visit) {
    const uvec2 tiles = tilesOf(pixels);
    for (uvec2 tile(0); tile.y < tiles.y; ++tile.y) {
        for (tile.x = 0; tile.x < tiles.x; ++tile.x) {
            visit(tile);
        }
    }
}

// Mean rays per pixel over the surfaces.
double meanRays(const Pictures& p, const std::string& show) {
    double rays = 0.0;
    double surfaces = 0.0;
    forTiles(p.size, [&](uvec2 tile) {
        const uint32_t pixels = surfacesIn(p, tile);
        rays += double(pixels) * double(p.value(show, tile.x, tile.y));
        surfaces += pixels;
    });
    return rays / surfaces;
}

const std::vector<std::string> shown{"tile_class", "diffuse_rays", "specular_rays", "depth", "roughness"};

TEST(RayTiles, AreSkyMattGlossyOrMirrorsAsTheirPixelsAre) {
    const Scene scene = boxes();
    for (const char* lambert : {"false", "true"}) {
        const bool matt = std::string(lambert) == "true";
        const Pictures p =
            render(scene, frontOf(scene), size,
                   settingsOf({"specular.rays=3", std::string("materials.lambert_only=") + lambert}), shown);
        ASSERT_EQ(uvec2(p.images.at("tile_class").width, p.images.at("tile_class").height), tilesOf(size));
        std::map<uint32_t, uint32_t> seen;
        forTiles(size, [&](uvec2 tile) {
            const uint32_t expected = classOf(p, tile, matt);
            ++seen[expected];
            EXPECT_EQ(uint32_t(p.value("tile_class", tile.x, tile.y)), expected) << tile.x << ", " << tile.y;
            EXPECT_EQ(p.value("diffuse_rays", tile.x, tile.y), expected == tileSky ? 0.0F : 4.0F);
            const float reflections = expected == tileGlossy ? 3.0F : (expected == tileMirror ? 1.0F : 0.0F);
            EXPECT_EQ(p.value("specular_rays", tile.x, tile.y), reflections) << tile.x << ", " << tile.y;
        });
        EXPECT_GT(seen[tileSky], 20U);
        EXPECT_EQ(seen[tileMatt] > 20, matt);
        EXPECT_EQ(seen[tileGlossy] > 5, !matt);
        EXPECT_EQ(seen[tileMirror] > 5, !matt);
    }
    expectSilentValidation("classes of tiles");
}

TEST(RayTiles, OneRayOfAMirrorSaysWhatManySay) {
    const Scene scene = findBuiltinScene("mirror-hall")->make();
    // Five rays need two batches. A method that starts its steps at random is not exact: it keeps them all.
    const Pictures one = render(scene, defaultView(scene), size, settingsOf({"specular.rays=1"}),
                                {"specular_radiance", "specular_rays", "tile_class"});
    const Pictures five = render(scene, defaultView(scene), size, settingsOf({"specular.rays=5"}),
                                 {"specular_radiance", "specular_rays", "tile_class"});
    uint32_t mirrors = 0;
    for (uint32_t y = 0; y < size.y; ++y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            if (five.value("tile_class", x / rayTileSide, y / rayTileSide) == float(tileMirror)) {
                ++mirrors;
                EXPECT_EQ(five.value("specular_rays", x / rayTileSide, y / rayTileSide), 1.0F);
                EXPECT_EQ(five.color("specular_radiance", x, y), one.color("specular_radiance", x, y));
            }
        }
    }
    EXPECT_GT(mirrors, 500U);
    const Pictures jittered = render(scene, defaultView(scene), size,
                                     settingsOf({"specular.rays=5", "trace_screen.method=dda"}), {"specular_rays"});
    EXPECT_EQ(rangeOf(jittered.images.at("specular_rays")).max, 5.0F);
    expectSilentValidation("rays of mirrors");
}

TEST(AdaptiveRays, AreTheSameEverywhereWithoutHistory) {
    const Scene scene = findBuiltinScene("gloss")->make();
    for (const Settings& settings :
         {adaptive(), adaptive({"denoise.history=0"}), adaptive({"denoise.enabled=false"})}) {
        const Pictures p = render(scene, defaultView(scene), size, settings, shown);
        forTiles(size, [&](uvec2 tile) {
            const uint32_t kind = classOf(p, tile, false);
            if (kind != tileSky) {
                EXPECT_NEAR(p.value("diffuse_rays", tile.x, tile.y), 2.0F, 0.05F);
            }
            if (kind == tileGlossy) {
                EXPECT_NEAR(p.value("specular_rays", tile.x, tile.y), 2.0F, 0.05F);
            }
        });
    }
    expectSilentValidation("nothing remembered");
}

TEST(AdaptiveRays, MakeTheSameFirstPictureAsEvenOnes) {
    const Scene scene = findBuiltinScene("cave")->make();
    const auto picture = [&](const std::vector<std::string>& more) {
        return renderResized(scene, defaultView(scene), {96, 64}, size, adaptive(more), {"final"}).images.at("final");
    };
    // Rays of changing numbers are rounded between the passes, even ones are traced at once.
    const FloatImage even = picture({"diffuse.adaptive=false", "specular.adaptive=false"});
    EXPECT_LT(compareImages(picture({}), even, {}).difference.relativeMse, 2e-5);
}

// Over 5 s: means of many frames.
TEST(AdaptiveRays, KeepTheirMeanWhateverTheNoise) {
    for (const char* name : {"gloss", "colonnade", "mirror-hall"}) {
        const Scene scene = findBuiltinScene(name)->make();
        for (const uint32_t rays : {1U, 3U}) {
            const std::string count = std::to_string(rays);
            const Pictures p = render(scene, defaultView(scene), size,
                                      adaptive({"diffuse.rays=" + count, "specular.rays=" + count}), shown, 6);
            for (const char* show : {"diffuse_rays", "specular_rays"}) {
                const double mean = meanRays(p, show);
                EXPECT_LE(mean, rays * 1.0001) << name << " " << show;
                EXPECT_GT(mean, rays * 0.95) << name << " " << show;
                EXPECT_LE(rangeOf(p.images.at(show)).max, float(std::min(4 * rays, 8U)));
                EXPECT_GT(rangeOf(p.images.at(show)).max, 1.2F * float(rays)) << name << " " << show;
            }
        }
    }
    expectSilentValidation("budgets");
}

TEST(AdaptiveRays, AreMoreWhereSurfacesAreDisoccluded) {
    const Scene scene = findBuiltinScene("cave")->make();
    const View before = defaultView(scene);
    View now = before;
    const vec3 forward = glm::normalize(now.camera.target - now.camera.position);
    now.camera.target +=
        0.6F * glm::cross(forward, vec3(0, 1, 0)) * glm::length(now.camera.target - now.camera.position);
    const Pictures p = renderMoved(scene, before, now, size, adaptive(), shown, 16);
    const uvec2 tiles = tilesOf(size);
    double seen = 0.0;
    double fresh = 0.0;
    for (uint32_t y = 0; y < tiles.y; ++y) {
        seen += p.value("diffuse_rays", 0, y) / tiles.y;
        fresh += p.value("diffuse_rays", tiles.x - 2, y) / tiles.y;
    }
    EXPECT_GT(fresh, 2.0 * seen);
    EXPECT_LE(meanRays(p, "diffuse_rays"), 2.0001);
    expectSilentValidation("what comes into view");
}

// Without blur and clamping, only the mean over frames and the spreading of fireflies are between rays and image.
TEST(AdaptiveRays, HaveTheSameMeanLightAsEvenOnes) {
    const Scene scene = findBuiltinScene("cornell")->make();
    const auto mean = [&](const char* on) {
        const Settings settings = adaptive({"diffuse.rays=1", "specular.rays=1", std::string("diffuse.adaptive=") + on,
                                            std::string("specular.adaptive=") + on, "denoise.passes=0",
                                            "denoise.clip=0", "denoise.history=1024", "trace_screen.light=direct"});
        return render(scene, defaultView(scene), {64, 36}, settings, {"indirect_diffuse", "indirect_specular"}, 64);
    };
    const Pictures even = mean("false");
    const Pictures uneven = mean("true");
    for (const char* show : {"indirect_diffuse", "indirect_specular"}) {
        const Difference d = compareImages(uneven.images.at(show), even.images.at(show), {}).difference;
        EXPECT_LT(std::abs(d.bias), 0.025) << show;
        RecordProperty(show, std::to_string(d.bias));
    }
    expectSilentValidation("means");
}

TEST(AdaptiveRays, GiveTheSameBytesEachTime) {
    const Scene scene = findBuiltinScene("gloss")->make();
    const auto once = [&] {
        return render(scene, defaultView(scene), size, adaptive(), {"final"}, 5).images.at("final").data;
    };
    const std::vector<float> first = once();
    EXPECT_EQ(first, once());
}

}  // namespace
}  // namespace reflet::test::ray_tiles_test
