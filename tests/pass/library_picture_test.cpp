// The renderer and the C API record the same stages: of the same surfaces under the same light, handed over without
// loss to a device of its own, the library makes the bytes that the renderer makes, frame after frame.
#include "pass/library_camera.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

namespace reflet::test::library_picture_test {
namespace {

using namespace library_camera;

// ---- both -----------------------------------------------------------------------------------------------------------

// What a host cannot have is off.
Settings settingsOfPreset(const std::string& preset) {
    Settings settings;
    applyPreset(settings, preset);
    for (const char* assignment : {"planar.enabled=false", "probes.enabled=false", "trace_scene.enabled=false",
                                   "materials.lambert_only=false", "accumulate.enabled=false", "composite.layers=true",
                                   "shadow.resolution=256", "contact.distance=0.2", "tonemap.auto_exposure=on"}) {
        setSetting(settings, assignment);
    }
    if (settings.shadow.filter == ShadowFilter::traced) {
        settings.shadow.filter = ShadowFilter::pcss;
    }
    if (preset == "screen_probes") {  // captured by the renderer, handed to the library
        settings.probes.enabled = 1;
        settings.probes.parallax = ProbeParallax::box;  // distances are no image of the renderer's
        settings.probes.resolution = 32;
    }
    if (preset == "image_based") {  // prefiltered light is what ambient occlusion dims
        settings.ao.method = AoMethod::horizon;
    }
    return settings;
}

class LibraryPicture : public DeviceTest, public ::testing::WithParamInterface<std::string> {};

// Of the G-buffer what effects read: numbers, and nothing but the depth where no surface is. Directions at a seam of
// the octahedron have two codes, and the import may choose the other one, as it may turn -0 into 0.
void decodeSurfaces(RawImages& images) {
    const std::vector<vec4> depth = decodeTexels(VK_FORMAT_R32_SFLOAT, images.at("depth").texels);
    for (const char* name : {"normal", "geometric_normal", "base_color", "material", "motion"}) {
        RawImage& image = images.at(name);
        std::vector<vec4> values = decodeTexels(image.format, image.texels);
        for (size_t i = 0; i < depth.size(); ++i) {
            values[i] = depth[i].x > 0.0F ? values[i] + 0.0F : vec4(0.0F);
        }
        const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
        image.texels.assign(bytes.begin(), bytes.end());
    }
}

TEST_P(LibraryPicture, HasTheRenderersBytes) {
    const Settings settings = settingsOfPreset(GetParam());
    const uvec2 rendered = renderSize(settings, size);
    const Scene scene = findBuiltinScene("gloss")->make();
    Renderer renderer(device(), scene, [](const std::string&) {});
    LibraryHost host;
    RefletContext context = host.makeContext();
    RefletSettings handed = librarySettings(GetParam(), settings);
    {
        LibraryCamera library(host, context, handed, rendered);
        uint32_t number = 0;
        for (const View& view : pathOf(scene, rendered)) {
            Rendered one = renderOne(renderer, view, settings);
            RawImages other = library.render(one, view);
            decodeSurfaces(one.images);
            decodeSurfaces(other);
            for (const auto& [name, image] : other) {
                const std::string where = fmt::format("{}, frame {}, {}", GetParam(), number, name);
                ASSERT_TRUE(one.images.contains(name)) << where;
                expectSame(where, one.images.at(name), image);
            }
            ++number;
        }
    }
    refletDestroySettings(handed);
    refletDestroyContext(context);
    for (const std::string& message : host.host.messages()) {
        ADD_FAILURE() << message;
    }
}

std::vector<std::string> presetNames() {
    std::vector<std::string> names;
    for (const Preset& preset : presets()) {
        names.push_back(preset.name);
    }
    return names;
}

std::string nameOf(const ::testing::TestParamInfo<std::string>& preset) {
    return preset.param;
}

INSTANTIATE_TEST_SUITE_P(Presets, LibraryPicture, ::testing::ValuesIn(presetNames()), nameOf);

}  // namespace
}  // namespace reflet::test::library_picture_test
