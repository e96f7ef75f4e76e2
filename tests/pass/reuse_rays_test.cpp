// diffuse.reuse and specular.reuse: rays that neighbours share.
#include "compare/compare.h"
#include "pass/harness.h"
#include "scene/builtin.h"

#include <cmath>

namespace reflet::test::reuse_rays_test {
namespace {

constexpr uvec2 size(160, 90);

/// A ball on a floor under an even sky, of one roughness.
Scene ballUnderTheSky(float roughness) {
    Material material = lambertMaterial(vec3(0.7F));
    material.metallic = 1.0F;
    material.roughness = roughness;
    Scene scene = sceneOf(material, builtin::ground({6, 6}, {1, 1}, {1, 1}));
    builtin::place(scene, "ball", 0, builtin::sphere(0.8F, 48), builtin::at({0, 0.8F, 0}));
    return scene;
}

View viewOfBall() {
    View view;
    view.camera = builtin::camera("", {0, 1.8F, 4}, {0, 0.5F, 0}, 45);
    view.sun.irradiance = vec3(0.0F);
    view.environment.radiance = {0.25F, 1.0F, 3.0F};
    return view;
}

TEST(ReuseRays, ConstantLightStaysConstant) {
    const Scene scene = ballUnderTheSky(0.5F);
    const std::vector<std::string> skyOnly{"trace_screen.enabled=false", "diffuse.reuse=8", "specular.reuse=8",
                                           "diffuse.rays=1"};
    const Pictures p =
        render(scene, viewOfBall(), size, settingsOf(skyOnly), {"specular_radiance", "diffuse_radiance", "depth"});
    unsigned off = 0;
    for (unsigned y = 0; y < size.y; ++y) {
        for (unsigned x = 0; x < size.x; ++x) {
            if (p.hasSurface(x, y)) {
                const vec3 diffuse = p.color("diffuse_radiance", x, y);
                ASSERT_NEAR(diffuse.z, 3.0F, 0.004F) << x << ' ' << y;
                const vec3 specular = p.color("specular_radiance", x, y);
                off += std::abs(specular.z - 3.0F) > 0.004F ? 1 : 0;  // those at edges that find no neighbour
            }
        }
    }
    EXPECT_LT(off, size.x * size.y / 100);
    RecordProperty("off", std::to_string(off));
    expectSilentValidation("shared rays under an even sky");
}

TEST(ReuseRays, AMirrorBorrowsNothing) {
    const Scene scene = ballUnderTheSky(0.0F);
    const std::vector<std::string> shows{"specular_radiance"};
    const Pictures alone = render(scene, viewOfBall(), size, settingsOf({}), shows);
    const Pictures shared = render(scene, viewOfBall(), size, settingsOf({"specular.reuse=8"}), shows);
    // Shared rays are rounded between the passes; alone they are traced at once.
    EXPECT_LT(compareImages(shared.images.at("specular_radiance"), alone.images.at("specular_radiance"), {})
                  .difference.relativeMse,
              1e-6);
}

struct Lobe {
    const char* scene;
    const char* show;
    const char* rays;
    const char* reuse;
    double bias;   ///< of the mean over 16 frames, at most: neighbours do not see quite the same
    double error;  ///< relative MSE over that without, at most
};

class ReuseOfLobe : public ::testing::TestWithParam<Lobe> {};
INSTANTIATE_TEST_SUITE_P(
    Lobes, ReuseOfLobe,
    ::testing::Values(Lobe{"gloss", "indirect_specular", "specular.rays", "specular.reuse", 0.03, 0.6},
                      Lobe{"cave", "indirect_diffuse", "diffuse.rays", "diffuse.reuse", 0.07, 0.4}),
    [](const auto& lobe) { return std::string(lobe.param.scene); });

// Over 5 s: means of many frames, so that noise does not hide a bias.
TEST_P(ReuseOfLobe, KeepsTheMeanAndHasLessError) {
    const Lobe lobe = GetParam();
    const Scene scene = findBuiltinScene(lobe.scene)->make();
    const View view = defaultView(scene);
    const auto at = [&](const std::string& rays, const std::string& reuse, uint32_t frames = 1) {
        const Settings settings =
            settingsOf({std::string(lobe.rays) + "=" + rays, std::string(lobe.reuse) + "=" + reuse});
        return renderMean(scene, view, size, settings, {lobe.show}, frames).images.at(lobe.show);
    };
    const FloatImage truth = at("256", "0");
    const Difference alone = compareImages(at("1", "0"), truth, {}).difference;
    const Difference shared = compareImages(at("1", "8"), truth, {}).difference;
    const double aloneBias = compareImages(at("1", "0", 16), truth, {}).difference.bias;
    const double bias = compareImages(at("1", "8", 16), truth, {}).difference.bias;
    RecordProperty("alone", std::to_string(alone.relativeMse));
    RecordProperty("shared", std::to_string(shared.relativeMse));
    RecordProperty("aloneBias", std::to_string(aloneBias));
    RecordProperty("bias", std::to_string(bias));
    EXPECT_LT(std::abs(bias), lobe.bias);
    EXPECT_LT(shared.relativeMse, lobe.error * alone.relativeMse);
}

}  // namespace
}  // namespace reflet::test::reuse_rays_test
