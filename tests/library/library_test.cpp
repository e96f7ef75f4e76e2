// The C API on a host's device: results, conventions, settings.
#include "library/library_fixture.h"

#include <glm/gtx/component_wise.hpp>

#include <cmath>

namespace reflet::test {
namespace {

vec3 meanOf(const std::vector<vec4>& texels) {
    vec3 sum(0.0F);
    for (const vec4& texel : texels) {
        sum += vec3(texel);
    }
    return sum / float(texels.size());
}

TEST_F(Library, LightsARoom) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("balanced");
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    const RoomResults results = renderFrames(room, view, settings, 8);
    EXPECT_EQ(results.sum.lit.format, VK_FORMAT_R16G16B16A16_SFLOAT);
    EXPECT_EQ(results.diffuse.downsample, 2U);
    EXPECT_EQ(results.diffuse.radiance.width, HostRoom::width / 2);
    EXPECT_EQ(results.visibility.width, HostRoom::width);
    const std::vector<vec4> diffuse = halvesOf(host_, results.sum.indirectDiffuse);
    const std::vector<vec4> specular = halvesOf(host_, results.sum.indirectSpecular);
    const std::vector<vec4> lit = halvesOf(host_, results.sum.lit);
    // The wall is not metallic, the floor is: the one has diffuse light, the other only reflections.
    const uint32_t wall = HostRoom::width / 2 + HostRoom::width * (HostRoom::height / 3);
    const uint32_t floor = HostRoom::width / 2 + HostRoom::width * (HostRoom::height - 4);
    EXPECT_GT(diffuse[wall].y, 0.02F);
    EXPECT_LT(diffuse[floor].y, 1e-3F);
    EXPECT_GT(specular[floor].x, 0.05F);
    EXPECT_GT(specular[floor].x, 1.5F * specular[floor].z) << "reflections of a metal have its colour";
    EXPECT_NEAR(lit[0].w, 0.0F, 1e-6F) << "the sky has no distance";
    const std::vector<uint32_t> display = texelsOf<uint32_t>(host_, results.display);
    EXPECT_GT(display[wall] & 0xFFU, 20U);
    for (const vec4& texel : halvesOf(host_, results.antialiased)) {
        ASSERT_TRUE(std::isfinite(texel.x) && texel.x >= 0.0F);
    }
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

// The floor before a wall, 2 m high and 4.8 m to each side in the picture: covered as its form factor says.
TEST_F(Library, KnowsHowMuchAWallCovers) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings(nullptr);
    for (const auto& [name, value] : {std::pair{"ao.method", "bitmask"},
                                      {"ao.radius", "100"},
                                      {"ao.thickness", "10"},
                                      {"ao.slices", "16"},
                                      {"ao.steps", "16"},
                                      {"denoise.enabled", "false"}}) {
        EXPECT_REFLET(refletSetSetting(settings, name, value));
    }
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    const RefletImage occlusion = renderFrames(room, view, settings, 8).occlusion;
    EXPECT_EQ(occlusion.format, VK_FORMAT_R16G16B16A16_SFLOAT);
    ASSERT_EQ(occlusion.width, HostRoom::width);
    const std::vector<vec4> texels = halvesOf(host_, occlusion);
    EXPECT_EQ(texels[0], vec4(0, 0, 0, 1)) << "the sky";
    unsigned count = 0;
    for (uint32_t y = HostRoom::height / 2; y < HostRoom::height; ++y) {
        const float down = (2.0F * float(y) + 1.0F) / HostRoom::height - 1.0F;
        const vec3 ray = vec3(0.0F, -0.4F, -3.0F) + 0.5F * down * vec3(0.0F, -3.0F, 0.4F);  // of the room's camera
        const float d = 6.0F + ray.z / -ray.y;
        if (d < 0.5F || d > 2.0F) {
            continue;
        }
        vec4 seen(0.0F);
        for (uint32_t x = 24; x < 40; ++x) {
            const vec4 texel = texels[x + size_t(HostRoom::width) * y];
            EXPECT_NEAR(glm::length(vec3(texel)), 1.0F, 0.02F);
            seen += texel / 16.0F;
        }
        const float away = std::hypot(d, 2.0F);
        const float covered = (std::atan(4.8F / d) - d / away * std::atan(4.8F / away)) / 3.14159265F;
        EXPECT_NEAR(seen.w, 1.0F - covered, 0.03F) << "d " << d;
        EXPECT_GT(seen.z, 0.05F) << "the bent normal turns away from the wall";
        EXPECT_GT(seen.y, 0.5F);
        ++count;
    }
    EXPECT_GE(count, 3U);
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

TEST_F(Library, SlicesGatherTheDiffuseLightThatRaysDo) {
    RefletContext context = host_.makeContext();
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    vec3 mean[2];
    for (const char* method : {"rays", "slices"}) {
        RefletSettings settings = makeSettings(nullptr);
        EXPECT_REFLET(refletSetSetting(settings, "diffuse.method", method));
        EXPECT_REFLET(refletResetView(view));
        mean[method[0] == 's'] = meanOf(halvesOf(host_, renderFrames(room, view, settings, 8).sum.indirectDiffuse));
        refletDestroySettings(settings);
    }
    EXPECT_GT(mean[0].y, 0.01F);
    EXPECT_NEAR(mean[1].y, mean[0].y, 0.05F * mean[0].y);
    EXPECT_NE(mean[1].y, mean[0].y);
    refletDestroyView(view);
    refletDestroyContext(context);
}

// Standard depth, y up, view space, sRGB, alpha and pixels give what reversed depth, y down, world space, linear
// colours, perceptual roughness and uv give.
TEST_F(Library, ConventionsDoNotMatter) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("fast");
    struct Imported {
        std::vector<float> depth;
        std::vector<uint32_t> normal;
        std::vector<uint32_t> color;
        std::vector<uint32_t> material;
        std::vector<vec4> motion;
        std::vector<vec4> lit;
    };
    Imported both[2];
    for (int i = 0; i < 2; ++i) {
        RefletView view = makeView(context, 3);
        const HostRoom room(host_, {.unusual = i == 1});
        const RoomResults results = renderFrames(room, view, settings, 1);
        const auto find = [&](const char* name) {
            RefletImage image{};
            EXPECT_REFLET(refletFindImage(view, name, &image));
            return image;
        };
        both[i] = {texelsOf<float>(host_, find("depth")),
                   texelsOf<uint32_t>(host_, find("normal")),
                   texelsOf<uint32_t>(host_, find("base_color")),
                   texelsOf<uint32_t>(host_, find("material")),
                   halvesOf(host_, find("motion")),
                   halvesOf(host_, results.sum.lit)};
        refletDestroyView(view);
    }
    // depth: near / distance against near · (far / distance - 1) / (far - near)
    size_t surfaces = 0;
    for (size_t i = 0; i < both[0].depth.size(); ++i) {
        const float infinite = both[0].depth[i];
        ASSERT_NEAR(both[1].depth[i], infinite == 0.0F ? 0.0F : (100.0F * infinite - 0.1F) / 99.9F, 2e-5F) << i;
        ASSERT_EQ(infinite == 0.0F, both[1].depth[i] == 0.0F) << i;
        if (infinite == 0.0F) {
            continue;
        }
        ++surfaces;
        const vec2 a = glm::unpackSnorm2x16(both[0].normal[i]);
        const vec2 b = glm::unpackSnorm2x16(both[1].normal[i]);
        ASSERT_LT(glm::distance(a, b), 2e-3F) << i;
        for (int channel = 0; channel < 3; ++channel) {
            const auto color = [&](const Imported& from) { return int(from.color[i] >> (10 * channel) & 1023U); };
            const auto material = [&](const Imported& from) { return int(from.material[i] >> (8 * channel) & 255U); };
            ASSERT_LE(std::abs(color(both[0]) - color(both[1])), 1) << i;
            ASSERT_LE(std::abs(material(both[0]) - material(both[1])), 1) << i;
        }
        ASSERT_LT(glm::distance(vec2(both[0].motion[i]), vec2(both[1].motion[i])), 2e-5F) << i;
        ASSERT_NEAR(both[0].motion[i].x, 0.01F, 2e-5F);
        ASSERT_NEAR(both[0].motion[i].y, -0.02F, 2e-5F);
    }
    EXPECT_GT(surfaces, both[0].depth.size() / 2);
    const vec3 ratio = meanOf(both[1].lit) / meanOf(both[0].lit);
    EXPECT_LT(glm::distance(ratio, vec3(1.0F)), 0.01F) << ratio.x << ' ' << ratio.y << ' ' << ratio.z;
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

// Floor and wall are planes, so the normals that come from depth are exact, up to the picture's edges.
TEST_F(Library, NormalsFromDepthAreThoseOfThePlanes) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("fast");
    for (const bool unusual : {false, true}) {
        RefletView view = makeView(context, 3);
        const HostRoom room(host_, {.unusual = unusual});
        renderFrames(room, view, settings, 1);
        RefletImage images[3];
        for (int i = 0; i < 3; ++i) {
            const char* names[] = {"depth", "normal", "geometric_normal"};
            EXPECT_REFLET(refletFindImage(view, names[i], &images[i]));
        }
        const auto depth = texelsOf<float>(host_, images[0]);
        const auto normal = texelsOf<uint32_t>(host_, images[1]);
        const auto fromDepth = texelsOf<uint32_t>(host_, images[2]);
        for (size_t i = 0; i < depth.size(); ++i) {
            const vec2 wanted = glm::unpackSnorm2x16(normal[i]);
            const vec2 found = glm::unpackSnorm2x16(fromDepth[i]);
            ASSERT_TRUE(depth[i] == 0.0F || glm::distance(wanted, found) < 0.02F)
                << i % HostRoom::width << ' ' << i / HostRoom::width << ": " << found.x << ' ' << found.y;
        }
        refletDestroyView(view);
    }
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

TEST_F(Library, StaysFiniteWhateverTheHostDraws) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("balanced");
    EXPECT_REFLET(refletSetSetting(settings, "ao.method", "horizon"));
    for (const bool unusual : {false, true}) {
        RefletView view = makeView(context, 3);
        const HostRoom room(host_, {.spoiled = true, .unusual = unusual});
        EXPECT_REFLET(refletSetSetting(settings, "diffuse.method", unusual ? "slices" : "rays"));
        const RoomResults results = renderFrames(room, view, settings, 4);
        for (const RefletImage& image :
             {results.sum.lit, results.sum.indirectDiffuse, results.sum.indirectSpecular, results.antialiased}) {
            for (const vec4& texel : halvesOf(host_, image)) {
                ASSERT_TRUE(std::isfinite(texel.x + texel.y + texel.z) && glm::compMin(vec3(texel)) >= 0.0F);
            }
        }
        refletDestroyView(view);
    }
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

TEST_F(Library, MakesLargerPicturesOfSmallerFrames) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("balanced");
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    EXPECT_REFLET(refletSetOutputSize(view, 2 * HostRoom::width, 2 * HostRoom::height));
    const RoomResults large = renderFrames(room, view, settings, 8);
    EXPECT_EQ(large.antialiased.width, 2 * HostRoom::width);
    EXPECT_EQ(large.display.height, 2 * HostRoom::height);
    EXPECT_EQ(large.sum.lit.width, HostRoom::width);
    const auto meanOf = [&](const RefletImage& image) {
        vec4 sum(0.0F);
        const std::vector<vec4> texels = halvesOf(host_, image);
        for (const vec4& texel : texels) {
            sum += texel;
        }
        return sum / static_cast<float>(texels.size());
    };
    const vec4 mean = meanOf(large.antialiased);
    EXPECT_GT(mean.w, 1.5F) << "samples in the history: one in four frames lies in a pixel";
    const vec4 lit = meanOf(large.sum.lit);
    EXPECT_NEAR(mean.y, lit.y, 0.05F * lit.y);
    // Smaller than the frames: the frame goes on without it.
    EXPECT_REFLET(refletSetOutputSize(view, HostRoom::width - 1, HostRoom::height));
    host_.host.frame([&](VkCommandBuffer commands) {
        const RefletFrameInfo frame = room.frame(commands, 8);
        const RefletIndirectLight light = room.light();
        RefletLobe lobe = emptyLobe();
        RefletComposite sum{};
        sum.structSize = sizeof sum;
        RefletImage image{};
        EXPECT_REFLET(refletBeginFrame(view, &frame));
        EXPECT_REFLET(refletDiffuseGi(view, settings, &light, &lobe));
        EXPECT_REFLET(refletComposite(view, settings, nullptr, &sum));
        EXPECT_EQ(refletTemporal(view, settings, nullptr, &image), REFLET_ERROR_INVALID_ARGUMENT);
        EXPECT_NE(std::string(refletLastError()).find("refletSetOutputSize"), std::string::npos) << refletLastError();
        EXPECT_REFLET(refletEndFrame(view));
    });
    host_.host.waitForAll();
    EXPECT_REFLET(refletSetOutputSize(view, 0, 0));
    EXPECT_EQ(renderFrames(room, view, settings, 1).display.width, HostRoom::width);
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

TEST_F(Library, DenoisesALobeOfTheHost) {
    RefletContext context = host_.makeContext();
    RefletSettings settings = makeSettings("fast");
    RefletView view = makeView(context, 3);
    const HostRoom room(host_, {});
    // Half of the samples are 2, half 0: the mean is 1.
    std::vector<std::vector<float>> noisy(16, std::vector<float>(size_t(4) * HostRoom::width * HostRoom::height));
    std::vector<RefletImage> images;
    uint32_t state = 1;
    for (std::vector<float>& texels : noisy) {
        for (size_t i = 0; i < texels.size(); i += 4) {
            state = state * 1664525U + 1013904223U;
            const float value = (state >> 31U) != 0 ? 2.0F : 0.0F;
            texels[i] = texels[i + 1] = texels[i + 2] = value;
            texels[i + 3] = 2.0F;
        }
        images.push_back(host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, HostRoom::width, HostRoom::height, texels));
    }
    RefletLobe clean = emptyLobe();
    for (uint32_t i = 0; i < images.size(); ++i) {
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo frame = room.frame(commands, i);
            EXPECT_REFLET(refletBeginFrame(view, &frame));
            EXPECT_REFLET(refletDenoise(view, settings, REFLET_LOBE_DIFFUSE, &images[i], &clean));
            EXPECT_REFLET(refletEndFrame(view));
        });
    }
    host_.host.waitForAll();
    const std::vector<vec4> texels = halvesOf(host_, clean.radiance);
    double sum = 0.0;
    double square = 0.0;
    size_t count = 0;
    for (uint32_t y = HostRoom::height / 4; y < HostRoom::height / 3; ++y) {  // on the wall, which has diffuse light
        for (uint32_t x = 8; x < HostRoom::width - 8; ++x) {
            const double value = texels[size_t(y) * HostRoom::width + x].x;
            sum += value;
            square += value * value;
            ++count;
        }
    }
    const double mean = sum / double(count);
    EXPECT_NEAR(mean, 1.0, 0.1);
    EXPECT_LT(square / double(count) - mean * mean, 0.05) << "the noise had a variance of 1";
    refletDestroyView(view);
    refletDestroySettings(settings);
    refletDestroyContext(context);
}

TEST(LibrarySettings, AreListedSetAndRead) {
    RefletSettings settings = nullptr;
    EXPECT_REFLET(refletCreateSettings(nullptr, &settings));
    const uint32_t count = refletSettingCount();
    EXPECT_GT(count, 40U);
    for (uint32_t i = 0; i < count; ++i) {
        RefletSettingInfo info{};
        info.structSize = sizeof info;
        EXPECT_REFLET(refletSettingInfo(i, &info));
        EXPECT_STREQ(refletGetSetting(settings, info.name), info.defaultValue) << info.name;
        EXPECT_REFLET(refletSetSetting(settings, info.name, info.defaultValue));
        EXPECT_GT(std::strlen(info.help), 10U);
    }
    EXPECT_REFLET(refletApplyPreset(settings, "balanced"));
    EXPECT_STREQ(refletGetSetting(settings, "diffuse.downsample"), "2");
    EXPECT_EQ(refletSetSetting(settings, "diffuse.ray", "2"), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(refletLastError()).find("diffuse.rays"), std::string::npos) << refletLastError();
    EXPECT_EQ(refletSetSetting(settings, "diffuse.rays", "many"), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(refletLastError()).find("0 to 256"), std::string::npos) << refletLastError();
    EXPECT_EQ(refletApplyPreset(settings, "hybrid"), REFLET_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(refletGetSetting(settings, "nothing"), nullptr);
    refletDestroySettings(settings);
}

}  // namespace
}  // namespace reflet::test
