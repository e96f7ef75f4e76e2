// A camera of the renderer, and one of a host of the C API that is handed the renderer's surfaces and light.
#pragma once

#include "capture/texels.h"
#include "library/library_host.h"
#include "lighting/camera.h"
#include "pass/harness.h"
#include "pass/raw_image.h"
#include "renderer/history.h"
#include "renderer/presets.h"

#include <glm/gtc/packing.hpp>

#include <cstring>
#include <map>

namespace reflet::test::library_camera {

inline constexpr uvec2 size{96, 60};  // of the picture
inline constexpr uint32_t frameCount = 4;
inline constexpr float frameTime = 0.0625F;  // seconds, exact in binary

// ---- the renderer ---------------------------------------------------------------------------------------------------

struct Rendered {
    RawImages images;
    SunShadowParams sun{};
    uvec2 size{0};  // of the surfaces
};

inline std::map<std::string, gpu::Image> imagesOf(const FrameImages& images) {
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
                                          {"display", images.display},
                                          {"probe_atlas", images.probeAtlas}};
    std::erase_if(all, [](const auto& named) { return !named.second; });
    return all;
}

inline Rendered renderOne(Renderer& renderer, const View& view, const Settings& settings) {
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
inline Camera exactCamera(Camera camera, const uvec2& rendered) {
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
inline vec3 exactDirection(vec3 direction) {
    for (int i = 0; i < 10; ++i) {
        direction = glm::normalize(direction);
    }
    return direction;
}

// Of halves that upload and import leave as they are: the brightest is about the largest half, so the renderer does not
// scale the image.
inline Environment environmentImage() {
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

inline std::vector<View> pathOf(const Scene& scene, const uvec2& rendered) {
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
        view.probes = {{{-2.0F, 1.0F, 0.0F}, {vec3(-6.0F, -0.125F, -6.0F), vec3(0.5F, 4.0F, 6.0F)}},
                       {{2.0F, 1.0F, 0.5F}, {vec3(0.5F, -0.125F, -6.0F), vec3(6.0F, 4.0F, 6.0F)}}};
        path.push_back(view);
    }
    return path;
}

// ---- the library ----------------------------------------------------------------------------------------------------

inline void store(float (&to)[16], const mat4& m) {
    std::memcpy(to, &m[0][0], sizeof to);
}

inline void store(float (&to)[3], const vec3& v) {
    std::memcpy(to, &v.x, sizeof to);
}

// The library's settings, by its preset if it has that; all others as text. Both have the same in the end.
inline RefletSettings librarySettings(const std::string& preset, const Settings& settings) {
    const bool own = preset == "fast" || preset == "balanced" || preset == "quality";
    RefletSettings made = nullptr;
    EXPECT_REFLET(refletCreateSettings(own ? preset.c_str() : "", &made));
    const auto set = [&](const std::string& name) {
        EXPECT_REFLET(refletSetSetting(made, name.c_str(), settingText(settings, findSetting(name)).c_str()));
    };
    for (uint32_t i = 0; i < refletSettingCount(); ++i) {
        RefletSettingInfo info{};
        info.structSize = sizeof info;
        EXPECT_REFLET(refletSettingInfo(i, &info));
        const std::string name = info.name;
        if (name.starts_with("input.")) {
            continue;  // of what a host gives: the renderer has no host
        }
        if (!own || name == "contact.distance" || name == "tonemap.auto_exposure") {
            set(name);
        }
        EXPECT_EQ(refletGetSetting(made, info.name), settingText(settings, findSetting(name))) << name;
    }
    set("temporal.enabled");  // not listed, but LibraryCamera looks them up
    set("radiance_cache.enabled");
    return made;
}

class LibraryCamera {
public:
    LibraryCamera(LibraryHost& host, RefletContext context, RefletSettings settings, const uvec2& rendered)
        : host_(host), settings_(settings) {
        const RefletViewInfo info{sizeof info, rendered.x, rendered.y, 3, 0, 0};
        EXPECT_REFLET(refletCreateView(context, &info, &view_));
        EXPECT_REFLET(refletSetOutputSize(view_, size.x, size.y));
        if (is("radiance_cache.enabled", "true")) {
            EXPECT_REFLET(refletCreateRadianceCache(context, &cache_));
        }
    }
    ~LibraryCamera() {
        refletDestroyView(view_);
        refletDestroyRadianceCache(cache_);
    }
    LibraryCamera(const LibraryCamera&) = delete;
    LibraryCamera& operator=(const LibraryCamera&) = delete;

    RawImages render(const Rendered& from, const View& view) {
        RefletFrameInfo frame = frameInfo(from, view);
        const RefletIndirectLight light = lightInfo(from, view);
        const RefletSunShadow sun = sunInfo(from, view);
        std::map<std::string, RefletImage> made;
        host_.host.frame([&](VkCommandBuffer commands) {
            RefletLobe lobe = emptyLobe();
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
            finish(view.camera, made);
        });
        return read(made);
    }

protected:
    // What follows the lobes.
    void finish(const Camera& c, std::map<std::string, RefletImage>& made) {
        const RefletLens lens{sizeof lens, c.apertureRadius, c.focusDistance, c.blades, c.bladeRotation};
        RefletComposite sum{sizeof sum, {}, {}, {}};
        EXPECT_REFLET(refletComposite(view_, settings_, nullptr, &sum));
        made["lit"] = sum.lit;
        if (is("temporal.enabled", "true")) {
            EXPECT_REFLET(refletTemporal(view_, settings_, nullptr, &made["antialiased"]));
        }
        EXPECT_REFLET(refletDepthOfField(view_, settings_, &lens, nullptr, &made["defocused"]));
        EXPECT_REFLET(refletToneMap(view_, settings_, nullptr, 1, &made["display"]));
        EXPECT_REFLET(refletEndFrame(view_));
    }
    RawImages read(const std::map<std::string, RefletImage>& made) {
        host_.host.waitForAll();
        RawImages out;
        for (const auto& [name, image] : made) {
            const std::vector<std::byte> texels = host_.read(image, gpu::bytesPerTexel(image.format));
            out[name] = {image.format, {image.width, image.height}, texels};
        }
        return out;
    }
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
        light.radianceCache = cache_;
        light.light = given(from.images.at("direct"), VK_FORMAT_R16G16B16A16_SFLOAT);
        around_.structSize = sizeof around_;
        const Environment& environment = view.environment;
        store(around_.factor, environment.image ? vec3(environment.intensity) : environment.radiance);
        around_.rotation = environment.rotation;
        around_.image = environment.image ? environmentImageOf(*environment.image) : RefletImage{};
        light.environment = &around_;
        if (from.images.contains("probe_atlas") && view.probes) {
            addProbes(light, from.images.at("probe_atlas"), *view.probes);
        }
        return light;
    }
    // As the renderer has captured them: a row of six faces for each.
    void addProbes(RefletIndirectLight& light, const RawImage& atlas, const std::vector<Probe>& probes) {
        const uint32_t side = atlas.size.x / 6;
        const size_t texel = bytesOfTexel(atlas);
        for (size_t i = probes_.size(); i < probes.size(); ++i) {
            std::vector<std::byte> faces;
            for (uint32_t face = 0; face < 6; ++face) {
                for (uint32_t y = 0; y < side; ++y) {
                    const auto* row = &atlas.texels[((i * side + y) * atlas.size.x + face * side) * texel];
                    faces.insert(faces.end(), row, row + side * texel);
                }
            }
            RefletProbe& probe = probes_.emplace_back();
            probe.structSize = sizeof probe;
            probe.radiance = host_.makeCube(atlas.format, side, faces);
            probe.alphaIsCoverage = 1;
            const Aabb& box = probes[i].box;
            store(probe.position, probes[i].position);
            store(probe.boxCenter, 0.5F * (box.min + box.max));
            store(probe.boxHalfExtents, 0.5F * box.size());
            probe.blend = ProbesSettings().reach * glm::length(box.size());
        }
        light.probes = probes_.data();
        light.probeCount = static_cast<uint32_t>(probes_.size());
    }
    RefletImage environmentImageOf(const FloatImage& image) {
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
    RefletRadianceCache cache_ = nullptr;
    RefletView view_ = nullptr;

private:
    RefletImage environment_{};
    RefletFrameInfo last_{};
    RefletGBuffer gbuffer_{};
    RefletEnvironment around_{};
    std::vector<RefletProbe> probes_;
    uint32_t frame_ = 0;
};

}  // namespace reflet::test::library_camera
