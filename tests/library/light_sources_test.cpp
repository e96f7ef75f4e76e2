// Light of the host's own where the screen has none: probes, planar views, images.
#include "library/library_fixture.h"

#include <glm/gtc/constants.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace reflet::test::light_sources_test {
namespace {

constexpr uint32_t width = HostRoom::width;
constexpr uint32_t height = HostRoom::height;
const vec3 eye(0.0F, 1.0F, 3.0F);

// What the room does not show: a wall behind the camera, a ceiling, and more to the sides.
constexpr vec3 boxMin(-20.0F, -0.1F, -3.0F);
constexpr vec3 boxMax(20.0F, 6.0F, 5.0F);
constexpr vec3 wall(3.0F, 2.0F, 1.0F);
constexpr vec3 ceiling(0.5F, 4.0F, 2.0F);
constexpr vec3 side(0.25F, 0.125F, 0.5F);

// Where a ray from inside of the box leaves it: its radiance, and how far that is.
vec4 boxAlong(const vec3& from, const vec3& direction) {
    vec3 t;
    for (int a = 0; a < 3; ++a) {
        const float wanted = direction[a] > 0.0F ? boxMax[a] : boxMin[a];
        t[a] = std::abs(direction[a]) > 1e-6F ? (wanted - from[a]) / direction[a] : 1e6F;
    }
    if (t.z < std::min(t.x, t.y)) {
        return {direction.z > 0.0F ? wall : side, t.z};
    }
    return {t.y < t.x && direction.y > 0.0F ? ceiling : side, std::min(t.x, t.y)};
}

vec3 faceDirection(uint32_t face, const vec2& at) {
    switch (face) {
        case 0:
            return {1.0F, -at.y, -at.x};
        case 1:
            return {-1.0F, -at.y, at.x};
        case 2:
            return {at.x, 1.0F, at.y};
        case 3:
            return {at.x, -1.0F, -at.y};
        case 4:
            return {at.x, -at.y, 1.0F};
        default:
            return {-at.x, -at.y, -1.0F};
    }
}

struct LobeTexels {
    std::vector<vec4> radiance;
    std::vector<vec4> lit;
};

class LightSources : public Library {
protected:
    LightSources() : room_(host_, {.still = true}) {
        const std::vector<vec4> texels(size_t(width) * height, vec4(0.0F, 1.0F, 0.0F, 0.0F));
        mirror_ = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, width, height, texels);
        context_ = host_.makeContext();
        settings_ = makeSettings("quality");
        set("denoise.enabled", "false");
        set("specular.downsample", "1");
        set("diffuse.downsample", "1");
    }
    ~LightSources() override {
        host_.host.waitForAll();
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }

    void set(const char* name, const char* value) { EXPECT_REFLET(refletSetSetting(settings_, name, value)); }

    // Of the box around `position`.
    RefletImage boxCube(const vec3& position, bool distances) {
        constexpr uint32_t faceSide = 128;
        std::vector<vec4> texels;
        for (uint32_t i = 0; i < 6 * faceSide * faceSide; ++i) {
            const uvec2 texel(i % faceSide, i / faceSide % faceSide);
            const vec2 at = (2.0F * vec2(texel) + 1.0F) / float(faceSide) - 1.0F;
            const vec3 direction = glm::normalize(faceDirection(i / (faceSide * faceSide), at));
            const vec4 seen = boxAlong(position, direction);
            texels.push_back(distances ? vec4(seen.w) : vec4(vec3(seen), 1.0F));
        }
        return host_.makeCube(VK_FORMAT_R32G32B32A32_SFLOAT, faceSide, texels);
    }

    RefletProbe boxProbe(const vec3& position) {
        RefletProbe probe{};
        probe.structSize = sizeof probe;
        const vec3 middle = 0.5F * (boxMin + boxMax);
        const vec3 half = 0.5F * (boxMax - boxMin);
        for (int i = 0; i < 3; ++i) {
            probe.position[i] = position[i];
            probe.boxCenter[i] = middle[i];
            probe.boxHalfExtents[i] = half[i];
        }
        probe.radiance = boxCube(position, false);
        return probe;
    }

    // One frame of a view of its own, all surfaces mirrors if the lobe is the specular one.
    LobeTexels trace(RefletLobeKind kind, const std::function<void(RefletIndirectLight&)>& change) {
        RefletView view = makeView(context_, 1);
        RefletLobe lobe = emptyLobe();
        RefletComposite sum{sizeof sum, {}, {}, {}};
        host_.host.frame([&](VkCommandBuffer commands) {
            RefletFrameInfo info = room_.frame(commands, 0);
            RefletGBuffer surfaces = *info.gbuffer;
            surfaces.roughness = mirror_;
            surfaces.metallic = mirror_;
            info.gbuffer = &surfaces;
            RefletIndirectLight light = room_.light();
            change(light);
            EXPECT_REFLET(refletBeginFrame(view, &info));
            const auto effect = kind == REFLET_LOBE_DIFFUSE ? refletDiffuseGi : refletReflections;
            EXPECT_REFLET(effect(view, settings_, &light, &lobe));
            EXPECT_REFLET(refletComposite(view, settings_, nullptr, &sum));
            EXPECT_REFLET(refletEndFrame(view));
        });
        host_.host.waitForAll();
        LobeTexels out{halvesOf(host_, lobe.radiance), halvesOf(host_, sum.lit)};
        refletDestroyView(view);
        return out;
    }

    HostRoom room_;
    RefletImage mirror_{};
    RefletContext context_ = nullptr;
    RefletSettings settings_ = nullptr;
};

struct Seen {
    vec3 from;
    vec3 direction;  ///< of the reflection
    bool floor;
};

// The mirror that a pixel shows; none where it shows the sky.
std::optional<Seen> mirrorAt(uint32_t i) {
    const mat4 toView = glm::lookAt(eye, vec3(0.0F, 0.6F, 0.0F), vec3(0.0F, 1.0F, 0.0F));
    const vec2 uv((float(i % width) + 0.5F) / float(width), (float(i / width) + 0.5F) / float(height));
    const vec2 ndc = 2.0F * uv - 1.0F;
    const vec3 ray(glm::inverse(toView) * vec4(ndc.x * 0.5F * float(width) / float(height), -ndc.y * 0.5F, -1.0F, 0));
    const float toFloor = ray.y < 0.0F ? -eye.y / ray.y : INFINITY;
    const float toWall = (-3.0F - eye.z) / ray.z;
    const bool floor = toFloor < toWall;
    const vec3 p = eye + std::min(toFloor, toWall) * ray;
    if (!floor && p.y > 1.95F) {
        return std::nullopt;
    }
    return Seen{p, glm::normalize(floor ? vec3(ray.x, -ray.y, ray.z) : vec3(ray.x, ray.y, -ray.z)), floor};
}

// What the mirrors of the room show of the box; none at edges, and where the screen answers.
std::optional<vec3> boxInMirror(uint32_t i) {
    const std::optional<Seen> seen = mirrorAt(i);
    if (!seen || seen->floor) {  // the floor shows the wall, or the sky above
        return std::nullopt;
    }
    const vec4 at = boxAlong(seen->from, seen->direction);
    const vec3 hit = seen->from + at.w * seen->direction;
    const bool inside = hit.y > 0.3F && hit.y < boxMax.y - 0.3F && std::abs(hit.x) < boxMax.x - 0.3F;
    return inside && at.w > 0.5F ? std::optional(vec3(at)) : std::nullopt;
}

size_t expectBox(const LobeTexels& with, float factor = 1.0F) {
    size_t compared = 0;
    for (uint32_t i = 0; i < with.radiance.size(); ++i) {
        if (const std::optional<vec3> wanted = boxInMirror(i)) {
            ++compared;
            for (int c = 0; c < 3; ++c) {
                const float light = factor * (*wanted)[c];
                EXPECT_NEAR(with.radiance[i][c], light, 0.02F * light) << i % width << ' ' << i / width;
            }
        }
    }
    return compared;
}

// Box projection and distances both find the walls, also from a probe that is far from the surfaces; without parallax
// the picture is another one, and coverage leaves rays to the environment.
TEST_F(LightSources, ProbesShowTheirSurroundingsInMirrors) {
    RefletProbe probe = boxProbe(vec3(2.0F, 3.0F, 1.0F));
    const auto withProbe = [&](RefletIndirectLight& light) {
        light.probes = &probe;
        light.probeCount = 1;
    };
    EXPECT_GT(expectBox(trace(REFLET_LOBE_SPECULAR, withProbe)), 300U);
    probe.parallax = REFLET_PARALLAX_DEPTH;
    probe.distance = boxCube(vec3(2.0F, 3.0F, 1.0F), true);
    EXPECT_GT(expectBox(trace(REFLET_LOBE_SPECULAR, withProbe)), 300U);
    probe.distance = {};
    probe.parallax = REFLET_PARALLAX_BOX;
    probe.factor = 4096.0F;
    EXPECT_GT(expectBox(trace(REFLET_LOBE_SPECULAR, withProbe), probe.factor), 300U);
    probe.factor = 0.0F;
    // The host's box ends before the wall: the environment is there.
    probe.boxCenter[2] = 3.0F;
    probe.boxHalfExtents[2] = 0.5F;
    const LobeTexels outside = trace(REFLET_LOBE_SPECULAR, withProbe);
    for (uint32_t i = 0; i < outside.radiance.size(); ++i) {
        if (boxInMirror(i)) {
            EXPECT_NEAR(outside.radiance[i].z, 0.8F, 0.01F) << "the environment's blue";
        }
    }
}

// E and E / pi, as coefficients and as a cube map; constant, so that every normal gets the same.
TEST_F(LightSources, ProbesLightByTheirIrradiance) {
    set("diffuse.distribution", "normal");
    set("trace_screen.enabled", "false");
    RefletProbe probe = boxProbe(vec3(2.0F, 3.0F, 1.0F));
    float coefficients[27] = {3.0F / 0.282095F, 2.0F / 0.282095F, 1.0F / 0.282095F};
    const std::vector<vec4> faces(size_t(6) * 4 * 4, vec4(3.0F, 2.0F, 1.0F, 0.0F));
    const RefletImage cube = host_.makeCube(VK_FORMAT_R32G32B32A32_SFLOAT, 4, faces);
    for (const bool over : {false, true}) {
        probe.irradianceKind = over ? REFLET_IRRADIANCE_OVER_PI : REFLET_IRRADIANCE;
        for (const bool asCube : {false, true}) {
            probe.sphericalHarmonics = asCube ? nullptr : coefficients;
            probe.irradiance = asCube ? cube : RefletImage{};
            const LobeTexels texels = trace(REFLET_LOBE_DIFFUSE, [&](RefletIndirectLight& light) {
                light.probes = &probe;
                light.probeCount = 1;
            });
            const vec3 wanted = vec3(3.0F, 2.0F, 1.0F) * (over ? 1.0F : glm::one_over_pi<float>());
            for (uint32_t i = 0; i < texels.radiance.size(); ++i) {
                const std::optional<Seen> seen = mirrorAt(i);
                for (int c = 0; seen && c < 3; ++c) {
                    ASSERT_NEAR(texels.radiance[i][c], wanted[c], 0.01F * wanted[c]) << i << ' ' << over << asCube;
                }
            }
        }
    }
}

// Half of what the screen does not know comes from the image, half from the environment.
TEST_F(LightSources, ImagesAnswerByTheirConfidence) {
    std::vector<vec4> texels;
    for (uint32_t i = 0; i < width * height; ++i) {
        texels.emplace_back(float(i % 7), 2.0F, 4.0F, i % 3 == 0 ? 0.0F : 0.5F);
    }
    const RefletImage image = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, width, height, texels);
    const LobeTexels with =
        trace(REFLET_LOBE_SPECULAR, [&](RefletIndirectLight& light) { light.specularFallback = image; });
    size_t compared = 0;
    for (uint32_t i = 0; i < with.radiance.size(); ++i) {
        if (boxInMirror(i)) {
            const float share = texels[i].w;
            ++compared;
            EXPECT_NEAR(with.radiance[i].z, share * texels[i].z + (1.0F - share) * 0.8F, 0.02F) << i;
            EXPECT_NEAR(with.radiance[i].x, share * texels[i].x + (1.0F - share) * 0.5F, 0.02F) << i;
        }
    }
    EXPECT_GT(compared, 300U);
    set("trace_screen.enabled", "false");
    const LobeTexels lit = trace(REFLET_LOBE_DIFFUSE, [&](RefletIndirectLight& light) {
        light.irradiance = image;
        light.irradianceKind = REFLET_IRRADIANCE;
    });
    for (uint32_t i = 0; i < lit.radiance.size(); ++i) {
        if (mirrorAt(i)) {
            const float wanted = texels[i].w * texels[i].z * glm::one_over_pi<float>() + (1.0F - texels[i].w) * 0.8F;
            ASSERT_NEAR(lit.radiance[i].z, wanted, 0.02F) << i;
        }
    }
}

// The mirrored camera below the floor sees the wall up to 2.5 m, of which the picture has only 2 m.
TEST_F(LightSources, PlanarViewsShowWhatIsAboveThePicture) {
    const mat4 below = glm::lookAt(eye, vec3(0.0F, 0.6F, 0.0F), vec3(0.0F, 1.0F, 0.0F)) *
                       glm::scale(mat4(1.0F), vec3(1.0F, -1.0F, 1.0F));
    const RefletFrameInfo camera = room_.frame(VK_NULL_HANDLE, 0);
    std::vector<float> depth;
    std::vector<vec4> color;
    for (uint32_t i = 0; i < width * height; ++i) {
        const vec2 uv((float(i % width) + 0.5F) / float(width), (float(i / width) + 0.5F) / float(height));
        const vec2 ndc = 2.0F * uv - 1.0F;
        const vec3 ray(glm::inverse(below) *
                       vec4(ndc.x * 0.5F * float(width) / float(height), -ndc.y * 0.5F, -1.0F, 0.0F));
        const float toWall = (-3.0F - eye.z) / ray.z;
        const float y = -eye.y + toWall * ray.y;
        const bool sky = y > 2.5F || y < 0.0F;  // below the floor nothing is drawn
        depth.push_back(sky ? 0.0F : 0.1F / toWall);
        color.emplace_back(sky ? vec3(7.0F) : y > 2.0F ? wall : side, 1.0F);
    }
    RefletPlanarView planar{};
    planar.structSize = sizeof planar;
    planar.color = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, width, height, color);
    planar.depth = host_.makeImage(VK_FORMAT_R32_SFLOAT, width, height, depth);
    std::memcpy(planar.worldToView, &below[0][0], sizeof planar.worldToView);
    std::memcpy(planar.viewToClip, camera.viewToClip, sizeof planar.viewToClip);
    planar.plane[1] = 1.0F;
    const LobeTexels with = trace(REFLET_LOBE_SPECULAR, [&](RefletIndirectLight& light) {
        light.planarViews = &planar;
        light.planarViewCount = 1;
    });
    size_t high = 0;
    size_t sky = 0;
    for (uint32_t i = 0; i < with.radiance.size(); ++i) {
        const std::optional<Seen> seen = mirrorAt(i);
        if (!seen || !seen->floor) {
            continue;
        }
        const float y = (-3.0F - seen->from.z) / seen->direction.z * seen->direction.y;
        if (std::abs(y - 2.0F) < 0.1F || std::abs(y - 2.5F) < 0.1F || y < 0.3F) {
            continue;
        }
        const vec3 wanted = y > 2.5F ? vec3(7.0F) : y > 2.0F ? wall : side;
        (y > 2.5F ? sky : high) += y > 2.0F ? 1 : 0;
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(with.radiance[i][c], wanted[c], 0.02F * wanted[c]) << i % width << ' ' << i / width << ' ' << y;
        }
    }
    EXPECT_GT(high, 30U);
    EXPECT_GT(sky, 10U);
}

// Every kind at once: no frame makes a pipeline after refletPrepare, and the second frame makes nothing of the probes'
// maps again.
TEST_F(LightSources, ArePrepared) {
    set("denoise.enabled", "true");
    std::array<RefletProbe, 3> probes{boxProbe(vec3(2.0F, 3.0F, 1.0F)), boxProbe(vec3(-2.0F, 3.0F, 1.0F)),
                                      boxProbe(vec3(0.0F, 3.0F, 1.0F))};
    const std::array<float, 27> coefficients{};
    probes[0].parallax = REFLET_PARALLAX_DEPTH;
    probes[0].distance = boxCube(vec3(2.0F, 3.0F, 1.0F), true);
    probes[1].sphericalHarmonics = coefficients.data();
    probes[2].irradiance = probes[2].radiance;
    const RefletFrameInfo drawn = room_.frame(VK_NULL_HANDLE, 0);
    RefletPlanarView planar{};
    planar.structSize = sizeof planar;
    planar.color = room_.light().light;
    planar.depth = drawn.gbuffer->depth;
    std::memcpy(planar.worldToView, drawn.worldToView, sizeof planar.worldToView);
    std::memcpy(planar.viewToClip, drawn.viewToClip, sizeof planar.viewToClip);
    planar.plane[1] = 1.0F;
    RefletIndirectLight light = room_.light();
    light.specularFallback = light.irradiance = light.light;
    light.probes = probes.data();
    light.probeCount = uint32_t(probes.size());
    light.planarViews = &planar;
    light.planarViewCount = 1;
    RefletLampShadow lamp{};
    lamp.structSize = sizeof lamp;
    lamp.kind = REFLET_LAMP_MAP_CUBE;
    lamp.depth = REFLET_LAMP_DEPTH_DISTANCE;
    lamp.map = probes[0].distance;
    RefletView view = makeView(context_, 1);
    RefletPrepareInfo info{};
    info.structSize = sizeof info;
    info.effects =
        REFLET_EFFECT_DIFFUSE_GI | REFLET_EFFECT_REFLECTIONS | REFLET_EFFECT_COMPOSITE | REFLET_EFFECT_LAMP_SHADOWS;
    info.gbuffer = drawn.gbuffer;
    info.light = &light;
    info.lampMapSide = 128;
    uint32_t left = 0;
    EXPECT_REFLET(refletPrepare(view, settings_, &info, 1000, &left));
    const uint64_t made = LibraryHost::made().pipelines;
    EXPECT_GT(made, 20U);
    std::array<uint32_t, 3> passes{};
    for (uint32_t i = 0; i < passes.size(); ++i) {
        RefletLobe lobe = emptyLobe();
        RefletComposite sum{sizeof sum, {}, {}, {}};
        RefletImage visibility{};
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo frame = room_.frame(commands, i);
            EXPECT_REFLET(refletBeginFrame(view, &frame));
            EXPECT_REFLET(refletLampShadows(view, settings_, &lamp, 1, &visibility));
            EXPECT_REFLET(refletDiffuseGi(view, settings_, &light, &lobe));
            EXPECT_REFLET(refletReflections(view, settings_, &light, &lobe));
            EXPECT_REFLET(refletComposite(view, settings_, nullptr, &sum));
            EXPECT_REFLET(refletEndFrame(view));
        });
        host_.host.waitForAll();
        EXPECT_REFLET(refletFinishView(view));
        std::array<RefletPassTime, 256> times{};
        uint32_t count = uint32_t(times.size());
        EXPECT_REFLET(refletPassTimes(view, &count, times.data()));
        for (uint32_t k = 0; k < count; ++k) {
            passes[i] += std::string(times[k].name).starts_with("probe.") ? 1 : 0;
        }
    }
    EXPECT_EQ(LibraryHost::made().pipelines, made);
    EXPECT_GT(passes[0], 0U);
    EXPECT_EQ(passes[1], 0U);
    EXPECT_EQ(passes[2], 0U);
    refletDestroyView(view);
}

}  // namespace
}  // namespace reflet::test::light_sources_test
