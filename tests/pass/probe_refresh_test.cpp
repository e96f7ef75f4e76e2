// When probes are captured anew.
#include "pass/probe_room.h"

#include "compare/compare.h"
#include "renderer/renderer.h"
#include "scene/builtin.h"
#include "scene/builtin/shapes.h"
#include "support/device_fixture.h"

#include <algorithm>

namespace reflet::test::probe_refresh_test {
namespace {

// The probe maps after this many frames, and the images rendered with them.
Pictures afterFrames(const Scene& scene, const View& view, const char* refresh, uint32_t frames) {
    return render(scene, view, {60, 34},
                  probeSettings({"probes.bounces=0", "probes.resolution=32", std::string("probes.refresh=") + refresh}),
                  {"probe_atlas", "specular_radiance", "specular_source"}, frames);
}

TEST(Probe, IsAfterSixFramesOfAFaceEachWhatItIsAtOnce) {
    const Scene scene = findBuiltinScene("cornell")->make();
    View view = defaultView(scene);
    view.probes = {{{{0, 2.2F, 0.5F}, {vec3(-3, 0, -2.3F), vec3(3, 4, 2.3F)}}}};
    const Pictures once = afterFrames(scene, view, "once", 6);
    const Pictures sixth = afterFrames(scene, view, "face", 6);
    EXPECT_EQ(once.images.at("probe_atlas").data, sixth.images.at("probe_atlas").data);
    // Not bit-exact: which rays a device looks up together in a cube map is left to chance, and the rounding of
    // llvmpipe's filter depends on whether one of them is near an edge.
    const Difference looked =
        compareImages(once.images.at("specular_radiance"), sixth.images.at("specular_radiance"), {}).difference;
    EXPECT_LT(looked.relativeMse, 1e-8);
    const Pictures fifth = afterFrames(scene, view, "face", 5);
    for (unsigned x = 0; x < fifth.size.x; ++x) {
        EXPECT_LT(fifth.value("specular_source", x, 18, 0), 0.3F) << "until then the environment answers";
    }
    EXPECT_NE(once.images.at("probe_atlas").data, fifth.images.at("probe_atlas").data);
    expectSilentValidation("captures of a face each");
}

TEST(Probe, IsCapturedAnewWhenLightChangesAndOnlyThen) {
    const Scene scene = findBuiltinScene("cornell")->make();
    View view = defaultView(scene);
    view.probes = {{{{0, 2.2F, 0.5F}, {vec3(-3, 0, -2.3F), vec3(3, 4, 2.3F)}}}};
    View darker = view;
    darker.sun.irradiance *= 0.25F;
    View elsewhere = darker;
    elsewhere.camera.position += vec3(0.5F);
    const std::vector<Pictures> p = renderPath(scene, {view, darker, elsewhere, view}, {36, 20},
                                               probeSettings({"probes.resolution=32"}), {"probe_atlas"});
    const auto atlas = [&](size_t i) { return p[i].images.at("probe_atlas").data; };
    EXPECT_NE(atlas(0), atlas(1));
    EXPECT_EQ(atlas(1), atlas(2));
    EXPECT_EQ(atlas(0), atlas(3));
}

class ProbePasses : public DeviceTest {};

TEST_F(ProbePasses, FacesThatSeeMuchOfTheSceneShareAShadowMap) {
    const auto maps = [](const vec3& half, const vec3& eye) {
        Scene scene = sceneOf(lambertMaterial(vec3(0.5F)), builtin::box(half));
        View view = defaultView(scene);
        view.sun = {.direction = glm::normalize(vec3(0.3F, -1, 0.2F)), .irradiance = vec3(2.0F)};
        view.probes = {{{eye, {-half, half}}}};
        Renderer renderer(device(), scene, [](const std::string&) {});
        renderer.listPasses();
        renderer.render(view, {60, 34}, 0, probeSettings({"probes.resolution=32", "shadow.filter=hard"}));
        return std::ranges::count(renderer.frame().listing().passes, "probe.shadow_map", &gpu::PassListing::Pass::name);
    };
    EXPECT_EQ(maps(vec3(4.0F), vec3(0.0F)), 2) << "one map: opaque surfaces, then others";
    EXPECT_GT(maps({40, 2, 40}, vec3(0.0F)), 2) << "the view down has its own";
    expectSilentValidation("shared shadow maps");
}

}  // namespace
}  // namespace reflet::test::probe_refresh_test
