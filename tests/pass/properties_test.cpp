// Animated materials, lamps and visibility in frames: as a scene that stands there, and as the reference.
#include "compare/compare.h"
#include "pass/harness.h"
#include "reference/reference.h"

#include <cmath>

namespace reflet::test::properties_test {
namespace {

constexpr uvec2 size(96, 54);

PropertyChannel property(Property property, uint32_t target, const vec4& from, const vec4& to) {
    return {.property = property,
            .targets = {target},
            .keys = {.target = Channel::Target::property, .times = {0.0F, 1.0F}, .values = {from, to}}};
}

/// A textured floor whose colour, roughness and texture change, a wall that is there from 0.5 s on, and a lamp that
/// goes on.
Scene changing() {
    Scene scene =
        sceneOf(lambertMaterial(vec3(0.8F)), builtin::patch({{0, -0.5F, 0}, {2, 0, 0}, {0, 0, -2}, {4, 4}, {}}));
    scene.images.push_back({"stripes", 2, 1, {255, 255, 255, 255, 40, 40, 40, 255}});
    scene.materials[0].baseColorTexture.image = 0;
    scene.meshes.push_back(builtin::patch({{0, 0, -1.5F}, {2, 0, 0}, {0, 2, 0}, {1, 1}, {}}));
    scene.meshes.back().material = 1;
    scene.materials.push_back(lambertMaterial(vec3(0.1F, 0.2F, 0.9F)));
    scene.instances.push_back({"wall", 1, mat4(1.0F)});
    scene.nodes.resize(2);
    scene.instances[1].node = 0;
    Lamp lamp;
    lamp.position = {0.5F, 1.0F, 0.5F};
    lamp.node = 1;
    scene.nodes[1].translation = lamp.position;
    scene.lamps.push_back(lamp);
    PropertyChannel shown = property(Property::visible, 0, vec4(0), vec4(1));
    shown.keys.interpolation = Interpolation::step;
    shown.keys.times = {0.0F, 0.5F};
    PropertyChannel slides = property(Property::uvOffset, 0, vec4(0), vec4(1, 0, 0, 0));
    scene.animations.push_back({"all",
                                {},
                                {property(Property::baseColor, 0, vec4(1), vec4(1, 0.2F, 0, 1)), slides,
                                 property(Property::lightIntensity, 1, vec4(0), vec4(6)), shown,
                                 property(Property::emissiveStrength, 1, vec4(0), vec4(2))}});
    PropertyChannel color = property(Property::lightColor, 1, vec4(1), vec4(1));
    PropertyChannel glow = property(Property::emissiveFactor, 1, vec4(0.3F), vec4(0.3F));
    scene.resting = {color, glow};
    applyLargestProperties(scene);
    return scene;
}

View viewAt(double time) {
    View view;
    view.camera = builtin::camera("", {0, 0, 3}, {0, 0, 0}, 50);
    view.environment.radiance = vec3(0.3F);
    view.time = time;
    return view;
}

TEST(Properties, AFrameIsThatOfASceneThatStandsThere) {
    const Scene scene = changing();
    const Settings settings = settingsOf({"diffuse.rays=1", "specular.rays=1", "trace_scene.enabled=true",
                                          "trace_screen.enabled=false", "shadow.resolution=512"});
    for (const double time : {0.25, 0.75}) {
        const Pictures moved = render(scene, viewAt(time), size, settings, {"final", "depth"});
        const Pictures stood = render(frozen(scene, time), viewAt(time), size, settings, {"final", "depth"});
        EXPECT_GT(compareImages(moved.images.at("depth"), stood.images.at("depth"), {}).difference.psnr, 60.0) << time;
        EXPECT_GT(compareImages(moved.images.at("final"), stood.images.at("final"), {}).difference.psnr, 40.0) << time;
        expectSilentValidation("animated properties");
    }
}

TEST(Properties, AFrameAfterOthersHasTheValuesOfItsOwnTime) {
    const Scene scene = changing();
    const Settings settings = settingsOf({"diffuse.rays=0", "specular.rays=0", "shadow.filter=hard"});
    for (const double time : {0.25, 0.75}) {
        const Pictures after =
            renderMoved(scene, viewAt(1.0 - time), viewAt(time), size, settings, {"direct", "depth", "albedo"});
        const Pictures alone = render(scene, viewAt(time), size, settings, {"direct", "depth", "albedo"});
        for (const char* image : {"direct", "depth", "albedo"}) {
            EXPECT_EQ(after.images.at(image).data, alone.images.at(image).data) << image << " at " << time;
        }
    }
}

TEST(Properties, TheRendererShowsTheReferencesLightAtItsTime) {
    const Scene scene = changing();
    ReferenceOptions options;
    options.samples = 16;
    options.bounces = 0;
    options.filter = PixelFilter::center;
    const Settings settings =
        settingsOf({"diffuse.rays=0", "specular.rays=0", "materials.mips=off", "materials.anisotropy=1"});
    for (const double time : {0.25, 0.75}) {
        const ReferencePicture truth = traceReference(scene, viewAt(time), size, options);
        const Pictures p = render(scene, viewAt(time), size, settings, {"depth", "direct"});
        size_t same = 0;
        size_t alike = 0;
        for (size_t i = 0; i < truth.depth.data.size(); ++i) {
            const float d = truth.depth.data[i];
            same += std::abs(p.images.at("depth").data[i] - d) <= 1e-4F + 1e-3F * d ? 1 : 0;
            const float green = truth.direct.data[3 * i + 1];
            const float drawn = p.images.at("direct").data[3 * i + 1];
            alike += std::abs(drawn - green) <= 0.01F + 0.03F * green ? 1 : 0;
        }
        EXPECT_GT(same, truth.depth.data.size() * 98 / 100) << time;
        EXPECT_GT(alike, truth.depth.data.size() * 95 / 100) << time;
    }
}

}  // namespace
}  // namespace reflet::test::properties_test
