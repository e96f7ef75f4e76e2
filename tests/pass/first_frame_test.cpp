// Rays that read the last picture, where there is none: nothing that reflections alone light is black in mirrors.
#include "pass/harness.h"
#include "scene/builtin.h"

namespace reflet::test::first_frame_test {
namespace {

constexpr uvec2 size{96, 54};

// Mirrors in mirrors, by the screen alone.
Settings screenAlone() {
    return settingsOf({"trace_screen.light=previous", "trace_screen.thickness_mode=second_layer", "specular.rays=1",
                       "diffuse.rays=2", "denoise.enabled=true", "denoise.history=16"});
}

// Share of the pixels that have less than a fifth of the light that they settle to.
double blackShare(const Pictures& picture, const Pictures& settled) {
    unsigned black = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            const vec3 wanted = settled.color("final", x, y);
            const vec3 is = picture.color("final", x, y);
            black += wanted.y > 0.05F && is.y < 0.2F * wanted.y ? 1 : 0;
        }
    }
    return double(black) / double(size.x * size.y);
}

TEST(FirstFrame, MirrorsShowMirrors) {
    const Scene scene = findBuiltinScene("mirror-hall")->make();
    const std::vector<Pictures> frames =
        renderPath(scene, std::vector<View>(8, defaultView(scene)), size, screenAlone(), {"final"});
    EXPECT_LT(blackShare(frames[0], frames[7]), 0.02);
    expectSilentValidation("first frame");
}

// What comes into view is not black in mirrors before it has been seen for a frame.
TEST(FirstFrame, MirrorsShowWhatComesIntoView) {
    const Scene scene = findBuiltinScene("mirror-hall")->make();
    View before = defaultView(scene);
    View now = before;
    before.camera.target.x += 0.3F;
    std::vector<View> path(8, before);
    path.insert(path.end(), 9, now);
    const std::vector<Pictures> frames = renderPath(scene, path, size, screenAlone(), {"final"});
    EXPECT_LT(blackShare(frames[8], frames[16]), 0.02);
}

}  // namespace
}  // namespace reflet::test::first_frame_test
