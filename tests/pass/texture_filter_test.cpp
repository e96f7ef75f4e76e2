// The texture filter below the horizon, where a pixel sees thousands of repeats of a texture.
#include "pass/harness.h"
#include "scene/builtin/patterns.h"

#include <chrono>

namespace reflet::test::texture_filter_test {
namespace {

constexpr uvec2 size(33, 17);  // odd: the horizon goes through the centres of a row

/// A floor with half black, half white tiles of 1 m.
Scene floorOfTiles(bool mips) {
    Scene scene;
    builtin::Canvas tile("tile", 64, 64, 0xFFFFFF);
    tile.rectangle({0, 0, 32, 64}, 0x000000);
    Sampler sampler;
    sampler.mips = mips;
    Material m = lambertMaterial(vec3(1.0F));
    m.baseColorTexture = builtin::addTexture(scene, tile.finish(), sampler);
    builtin::place(scene, "floor", builtin::addMaterial(scene, m),
                   builtin::patch({{0, 0, 0}, {0, 0, 50}, {50, 0, 0}, {1, 1}, {100, 100}}));
    return scene;
}

/// pitch: of the camera, up, in radians.
View alongTheFloor(float pitch) {
    View view;
    view.camera = builtin::camera("eye", {0, 1, 40}, {0, 1.0F + 10.0F * pitch, 30}, 45.0F);
    return view;
}

/// Pictures of the floor with the horizon on and just above the centres of a row; in seconds.
double secondsWith(const std::string& anisotropy, bool mips) {
    const Settings settings = settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.filter=none",
                                          "materials.anisotropy=" + anisotropy, "materials.mip_bias=-2"});
    const Scene scene = floorOfTiles(mips);
    const auto start = std::chrono::steady_clock::now();
    for (const float pitch : {0.0F, 3e-7F, 1e-6F, 3e-6F, 1e-5F, 1e-4F}) {
        const Pictures seen = render(scene, alongTheFloor(pitch), size, settings, {"albedo"});
        for (unsigned x = 0; mips && x < size.x; ++x) {
            EXPECT_NEAR(seen.value("albedo", x, size.y / 2 + 1), 0.5F, 0.02F) << pitch << ", " << x;
        }
    }
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Mesa's CPU driver looked up each texel of a pixel's footprint, without a limit: 16 s for these pictures of 33x17.
TEST(TextureFilter, TakesNoLongerWhereTheHorizonGoesThroughAPixel) {
    for (const bool mips : {true, false}) {
        EXPECT_LT(secondsWith("16", mips), 4.0 * secondsWith("1", mips) + 2.0) << mips;
    }
}

}  // namespace
}  // namespace reflet::test::texture_filter_test
