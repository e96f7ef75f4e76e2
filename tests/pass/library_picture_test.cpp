// The renderer and the C API record the same stages: of the same surfaces under the same light, handed over without
// loss to a device of its own, the library makes the bytes that the renderer makes, frame after frame.
#include "capture/texels.h"
#include "library/library_host.h"
#include "lighting/camera.h"
#include "pass/harness.h"
#include "pass/raw_image.h"
#include "renderer/history.h"
#include "renderer/presets.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace reflet::test::library_picture_test {
namespace {

constexpr uvec2 size{96, 60};  // of the picture
constexpr uint32_t frameCount = 4;
constexpr float frameTime = 0.0625F;  // seconds, exact in binary

// ---- the renderer ---------------------------------------------------------------------------------------------------

struct Rendered {
    RawImages images;
    SunShadowParams sun{};
    uvec2 size{0};  // of the surfaces
};

std::map<std::string, gpu::Image> imagesOf(const FrameImages& images) {
    std::map<std::string, gpu::Image> all{{"depth", images.g.depth},
                                          {"normal", images.g.normal},
                                          {"geometric_normal", images.g.geometricNormal},
                                          {"base_color", images.g.baseColor},
                                          {"material", images.g.material},
                                          {"motion", images.g.motion},
                                          {"back_depth", images.backDepth},
                                          {"shadow_map", images.shadowMap},
                                          {"direct", images.direct},
                                          {"sun_visibility", images.sunVisibility},
                                          {"ambient_occlusion", images.ambientOcclusion},
                                          {"diffuse", images.diffuse.radiance},
                                          {"specular", images.specular.radiance},
                                          {"lit", images.unfiltered},
                                          {"antialiased", images.temporal},
                                          {"defocused", images.light.lit},
                                          {"display", images.display}};
    std::erase_if(all, [](const auto& named) { return !named.second; });
    return all;
}

Rendered renderOne(Renderer& renderer, const View& view, const Settings& settings) {
    std::map<std::string, std::pair<gpu::Image, gpu::Readback>> copies;
    Rendered out;
    renderer.render(view, size, 0, settings, [&](gpu::Frame& f, const FrameImages& images) {
        EXPECT_EQ(images.g.features, 0U) << "the library does not know such materials";
        out.sun = images.sun;
        out.size = images.g.depth.size;
        for (const auto& [name, image] : imagesOf(images)) {
            copies[name] = {image, f.readback(image)};
        }
    });
    for (const auto& [name, copy] : copies) {
        const std::span<const std::byte> bytes = renderer.frame().bytes(copy.second);
        out.images[name] = {copy.first.format, copy.first.size, {bytes.begin(), bytes.end()}};
    }
    return out;
}

// ---- cameras that matrices tell exactly -----------------------------------------------------------------------------

// A host's camera is two matrices of floats. Moves the camera by some last places, until the library finds the
// renderer's eye and angle of a pixel in them.
Camera exactCamera(Camera camera, const uvec2& rendered) {
    const float aspect = float(size.x) / float(size.y);
    const auto wanted = [&] { return resized(makeViewParams(camera, size, 0, 0), rendered); };
    const auto found = [&] { return lighting::viewOf(worldToView(camera), viewToClip(camera, aspect), rendered); };
    for (int i = 0; i < 1000 && wanted().pixelAngle != found().pixelAngle; ++i) {
        camera.fovY = std::nextafter(camera.fovY, 4.0F);
    }
    for (int i = 0; i < 1000 && wanted().eye != found().eye; ++i) {
        camera.position[i % 3] = std::nextafter(camera.position[i % 3], 100.0F);
    }
    EXPECT_EQ(wanted().eye, found().eye);
    EXPECT_EQ(wanted().pixelAngle, found().pixelAngle);
    return camera;
}

// A direction that normalizing leaves as it is.
vec3 exactDirection(vec3 direction) {
    for (int i = 0; i < 10; ++i) {
        direction = glm::normalize(direction);
    }
    return direction;
}

// Of halves that upload and import leave as they are: the brightest is about the largest half, so the renderer does not
// scale the image.
Environment environmentImage() {
    constexpr uint32_t width = 16;
    constexpr uint32_t height = 8;
    auto image = std::make_shared<FloatImage>(FloatImage{width, height, {"R", "G", "B"}, {}});
    for (uint32_t i = 0; i < width * height; ++i) {
        image->data.insert(image->data.end(), {i == 20 ? 40960.0F : 2048.0F, 1024.0F + 64.0F * float(i % width),
                                               256.0F * float(i / width + 1)});
    }
    Environment environment;
    environment.image = image;
    environment.intensity = 1.0F / 8192.0F;
    environment.rotation = 0.5F;
    return environment;
}

std::vector<View> pathOf(const Scene& scene, const uvec2& rendered) {
    std::vector<View> path;
    const Environment environment = environmentImage();
    for (uint32_t i = 0; i < frameCount; ++i) {
        View view = defaultView(scene);
        view.environment = environment;
        view.sun.direction = exactDirection(view.sun.direction);
        view.camera.position.x += 0.3F + 0.02F * float(i);  // not 0, near which last places are too fine
        view.camera.apertureRadius = 0.05F;
        view.camera.focusDistance = 6.0F;
        view.camera = exactCamera(view.camera, rendered);
        view.time = frameTime * i;
        path.push_back(view);
    }
    return path;
}

// ---- the library ----------------------------------------------------------------------------------------------------

void store(float (&to)[16], const mat4& m) {
    std::memcpy(to, &m[0][0], sizeof to);
}

void store(float (&to)[3], const vec3& v) {
    std::memcpy(to, &v.x, sizeof to);
}

class LibraryCamera {
public:
    LibraryCamera(LibraryHost& host, RefletContext context, RefletSettings settings, const uvec2& rendered)
        : host_(host), settings_(settings) {
        const RefletViewInfo info{sizeof info, rendered.x, rendered.y, 3, 0, 0};
        EXPECT_REFLET(refletCreateView(context, &info, &view_));
        EXPECT_REFLET(refletSetOutputSize(view_, size.x, size.y));
    }
    ~LibraryCamera() { refletDestroyView(view_); }
    LibraryCamera(const LibraryCamera&) = delete;
    LibraryCamera& operator=(const LibraryCamera&) = delete;

    RawImages render(const Rendered& from, const View& view) {
        RefletFrameInfo frame = frameInfo(from, view);
        const RefletIndirectLight light = lightInfo(from, view);
        const RefletSunShadow sun = sunInfo(from, view);
        const Camera& c = view.camera;
        const RefletLens lens{sizeof lens, c.apertureRadius, c.focusDistance, c.blades, c.bladeRotation};
        std::map<std::string, RefletImage> made;
        host_.host.frame([&](VkCommandBuffer commands) {
            RefletLobe lobe = emptyLobe();
            RefletComposite sum{sizeof sum, {}, {}, {}};
            frame.commandBuffer = commands;
            EXPECT_REFLET(refletBeginFrame(view_, &frame));
            for (const char* name : {"depth", "normal", "geometric_normal", "base_color", "material", "motion"}) {
                EXPECT_REFLET(refletFindImage(view_, name, &made[name]));
            }
            if (sun.map.image != VK_NULL_HANDLE) {
                EXPECT_REFLET(refletSunShadow(view_, settings_, &sun, &made["sun_visibility"]));
            }
            if (!is("ao.method", "none")) {
                EXPECT_REFLET(refletAmbientOcclusion(view_, settings_, &made["ambient_occlusion"]));
            }
            EXPECT_REFLET(refletDiffuseGi(view_, settings_, &light, &lobe));
            made["diffuse"] = lobe.radiance;
            EXPECT_REFLET(refletReflections(view_, settings_, &light, &lobe));
            made["specular"] = lobe.radiance;
            EXPECT_REFLET(refletComposite(view_, settings_, nullptr, &sum));
            made["lit"] = sum.lit;
            if (is("temporal.enabled", "true")) {
                EXPECT_REFLET(refletTemporal(view_, settings_, nullptr, &made["antialiased"]));
            }
            EXPECT_REFLET(refletDepthOfField(view_, settings_, &lens, nullptr, &made["defocused"]));
            EXPECT_REFLET(refletToneMap(view_, settings_, nullptr, 1, &made["display"]));
            EXPECT_REFLET(refletEndFrame(view_));
        });
        host_.host.waitForAll();
        RawImages out;
        for (const auto& [name, image] : made) {
            const std::vector<std::byte> texels = host_.read(image, gpu::bytesPerTexel(image.format));
            out[name] = {image.format, {image.width, image.height}, texels};
        }
        return out;
    }

private:
    bool is(const char* setting, const char* value) const {
        return std::strcmp(refletGetSetting(settings_, setting), value) == 0;
    }
    RefletImage given(const RawImage& image, VkFormat format) {
        return host_.makeImage(format, image.size.x, image.size.y, image.texels);
    }
    // Base colours are square roots in the G-buffer; a host has none such.
    RefletImage linear(const RawImage& image) {
        std::vector<vec4> texels;
        for (size_t i = 0; i < image.texels.size(); i += sizeof(uint32_t)) {
            uint32_t texel = 0;
            std::memcpy(&texel, &image.texels[i], sizeof texel);
            const vec4 root = glm::unpackUnorm3x10_1x2(texel);
            texels.push_back(root * root);
        }
        return host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, image.size.x, image.size.y, texels);
    }

    RefletFrameInfo frameInfo(const Rendered& from, const View& view) {
        RefletFrameInfo frame{};
        frame.structSize = sizeof frame;
        frame.frameIndex = frame_++;
        store(frame.worldToView, worldToView(view.camera));
        store(frame.viewToClip, viewToClip(view.camera, float(size.x) / float(size.y)));
        if (frame.frameIndex > 0) {
            std::memcpy(frame.previousWorldToView, last_.worldToView, sizeof last_.worldToView);
            std::memcpy(frame.previousViewToClip, last_.viewToClip, sizeof last_.viewToClip);
            std::memcpy(frame.previousJitter, last_.jitter, sizeof last_.jitter);
            frame.elapsed = frameTime;
            frame.backgroundIsEnvironment = 1;
        }
        if (is("temporal.enabled", "true")) {
            refletJitter(frame.frameIndex, frame.jitter);
        }
        RefletGBuffer& g = gbuffer_;
        g = {};
        g.structSize = sizeof g;
        frame.gbuffer = &g;
        g.depth = given(from.images.at("depth"), VK_FORMAT_R32_SFLOAT);
        g.normal = given(from.images.at("normal"), VK_FORMAT_R16G16_SNORM);
        g.geometricNormal = given(from.images.at("geometric_normal"), VK_FORMAT_R16G16_SNORM);
        g.roughness = given(from.images.at("material"), VK_FORMAT_R8G8B8A8_UNORM);
        g.metallic = g.roughness;
        g.metallicChannel = 1;
        g.baseColor = linear(from.images.at("base_color"));
        g.motion = given(from.images.at("motion"), VK_FORMAT_R16G16B16A16_SFLOAT);
        if (from.images.contains("back_depth")) {
            g.backDepth = given(from.images.at("back_depth"), VK_FORMAT_R32_SFLOAT);
        }
        last_ = frame;
        return frame;
    }
    RefletIndirectLight lightInfo(const Rendered& from, const View& view) {
        RefletIndirectLight light{};
        light.structSize = sizeof light;
        light.light = given(from.images.at("direct"), VK_FORMAT_R16G16B16A16_SFLOAT);
        around_.structSize = sizeof around_;
        store(around_.factor, vec3(view.environment.intensity));
        around_.rotation = view.environment.rotation;
        around_.image = environment(*view.environment.image);
        light.environment = &around_;
        return light;
    }
    RefletImage environment(const FloatImage& image) {
        if (environment_.image == VK_NULL_HANDLE) {
            std::vector<vec4> texels;
            for (size_t i = 0; i < image.data.size(); i += 3) {
                texels.emplace_back(image.data[i], image.data[i + 1], image.data[i + 2], 1.0F);
            }
            environment_ = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, image.width, image.height, texels);
        }
        return environment_;
    }
    RefletSunShadow sunInfo(const Rendered& from, const View& view) {
        RefletSunShadow sun{};
        sun.structSize = sizeof sun;
        if (!from.images.contains("shadow_map")) {
            return sun;
        }
        sun.map = given(from.images.at("shadow_map"), VK_FORMAT_R32_SFLOAT);
        sun.cascades = 1;
        store(sun.worldToClip[0], from.sun.maps[0].worldToShadow);
        store(sun.toSun, -view.sun.direction);
        sun.angularDiameter = view.sun.angularDiameter;
        sun.contactShadows = 1;
        return sun;
    }

    LibraryHost& host_;
    RefletSettings settings_;
    RefletView view_ = nullptr;
    RefletImage environment_{};
    RefletFrameInfo last_{};
    RefletGBuffer gbuffer_{};
    RefletEnvironment around_{};
    uint32_t frame_ = 0;
};

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
    if (preset == "image_based") {  // prefiltered light is what ambient occlusion dims
        settings.ao.method = AoMethod::horizon;
    }
    return settings;
}

// The library's settings, by its preset if it has that; all others as text. Both have the same in the end.
RefletSettings librarySettings(const std::string& preset, const Settings& settings) {
    const bool own = preset == "fast" || preset == "balanced" || preset == "quality";
    RefletSettings made = nullptr;
    EXPECT_REFLET(refletCreateSettings(own ? preset.c_str() : "", &made));
    for (uint32_t i = 0; i < refletSettingCount(); ++i) {
        RefletSettingInfo info{};
        info.structSize = sizeof info;
        EXPECT_REFLET(refletSettingInfo(i, &info));
        if (std::string_view(info.name).starts_with("input.")) {
            continue;  // of what a host gives: the renderer has no host
        }
        const std::string value = settingText(settings, findSetting(info.name));
        const std::string changed[] = {"shadow.resolution", "contact.distance", "tonemap.auto_exposure"};
        if (!own || std::ranges::find(changed, info.name) != std::end(changed)) {
            EXPECT_REFLET(refletSetSetting(made, info.name, value.c_str()));
        }
        EXPECT_EQ(refletGetSetting(made, info.name), value) << info.name;
    }
    return made;
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
