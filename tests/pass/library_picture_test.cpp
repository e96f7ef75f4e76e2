// The C API gives what the renderer gives: the G-buffer and direct light of a scene, handed to the library in other
// conventions on a device of its own, come back as the renderer's picture.
#include "library/library_host.h"
#include "pass/harness.h"
#include "scene/builtin.h"
#include "support/device_fixture.h"

#include <glm/gtc/packing.hpp>

#include <cmath>
#include <cstring>

namespace reflet::test::library_picture_test {
namespace {

constexpr uvec2 size{96, 60};
constexpr size_t pixels = size_t(size.x) * size.y;

class LibraryPicture : public DeviceTest {};

struct Handed {
    RefletFrameInfo frame{};
    RefletIndirectLight light{};
};

void store(float (&to)[16], const mat4& m) {
    std::memcpy(to, &m[0][0], sizeof to);
}

// Standard depth of a finite projection, view-space normals, alpha, sRGB.
Handed handOver(LibraryHost& host, const Pictures& pictures, const Camera& camera) {
    constexpr float far = 200.0F;
    const mat4 toView = worldToView(camera);
    mat4 toClip = viewToClip(camera, float(size.x) / float(size.y));
    toClip[2][2] = far / (camera.near - far);
    toClip[3][2] = camera.near * far / (camera.near - far);
    std::vector<float> depth(pixels);
    std::vector<vec4> normal(pixels);
    std::vector<vec4> geometric(pixels);
    std::vector<vec4> color(pixels);
    std::vector<vec4> light(pixels);
    for (unsigned i = 0; i < pixels; ++i) {
        const unsigned x = i % size.x;
        const unsigned y = i / size.x;
        const float distance = pictures.value("depth", x, y);
        depth[i] = distance > 0.0F ? (far - camera.near * far / distance) / (far - camera.near) : 1.0F;
        const float roughness = pictures.value("roughness", x, y);
        normal[i] = vec4(glm::mat3(toView) * pictures.color("normal", x, y), roughness * roughness);
        geometric[i] = vec4(glm::mat3(toView) * pictures.color("geometric_normal", x, y), 0.0F);
        const vec3 linear = pictures.color("albedo", x, y);
        color[i].w = pictures.value("metallic", x, y);
        for (int k = 0; k < 3; ++k) {
            color[i][k] =
                linear[k] <= 0.0031308F ? 12.92F * linear[k] : 1.055F * std::pow(linear[k], 1.0F / 2.4F) - 0.055F;
        }
        light[i] = vec4(pictures.color("direct", x, y), 1.0F);
    }
    constexpr VkFormat four = VK_FORMAT_R32G32B32A32_SFLOAT;
    Handed out;
    out.frame.structSize = sizeof out.frame;
    store(out.frame.worldToView, toView);
    store(out.frame.viewToClip, toClip);
    RefletGBuffer& g = out.frame.gbuffer;
    g.depth = host.makeImage(VK_FORMAT_R32_SFLOAT, size.x, size.y, depth);
    g.depthKind = REFLET_DEPTH_STANDARD;
    g.normal = host.makeImage(four, size.x, size.y, normal);
    g.normalKind = REFLET_NORMAL_VECTOR_SNORM;
    g.normalsInViewSpace = 1;
    g.geometricNormal = host.makeImage(four, size.x, size.y, geometric);
    g.roughness = g.normal;
    g.roughnessChannel = 3;
    g.roughnessKind = REFLET_ROUGHNESS_ALPHA;
    g.baseColor = host.makeImage(four, size.x, size.y, color);
    g.baseColorKind = REFLET_COLOR_SRGB;
    g.metallic = g.baseColor;
    g.metallicChannel = 3;
    out.light.structSize = sizeof out.light;
    out.light.light = host.makeImage(four, size.x, size.y, light);
    return out;
}

std::vector<vec3> renderByLibrary(const Pictures& pictures, const Camera& camera, const Environment& environment,
                                  const std::vector<std::pair<const char*, const char*>>& assignments) {
    LibraryHost host;
    Handed handed = handOver(host, pictures, camera);
    std::memcpy(handed.light.environment.factor, &environment.radiance.x, sizeof handed.light.environment.factor);
    RefletContext context = host.makeContext();
    RefletSettings settings = nullptr;
    RefletView view = nullptr;
    const RefletViewInfo info{sizeof info, size.x, size.y, 3};
    EXPECT_REFLET(refletCreateView(context, &info, &view));
    EXPECT_REFLET(refletCreateSettings(nullptr, &settings));
    for (const auto& [name, value] : assignments) {
        EXPECT_REFLET(refletSetSetting(settings, name, value));
    }
    RefletComposite sum{sizeof sum, {}, {}, {}};
    host.host.frame([&](VkCommandBuffer commands) {
        RefletLobe lobe{};
        handed.frame.commandBuffer = commands;
        EXPECT_REFLET(refletBeginFrame(view, &handed.frame));
        EXPECT_REFLET(refletDiffuseGi(view, settings, &handed.light, &lobe));
        EXPECT_REFLET(refletReflections(view, settings, &handed.light, &lobe));
        EXPECT_REFLET(refletComposite(view, settings, nullptr, &sum));
        EXPECT_REFLET(refletEndFrame(view));
    });
    host.host.waitForAll();
    const std::vector<std::byte> bytes = host.read(sum.lit, sizeof(uint64_t));
    std::vector<vec3> picture(pixels);
    for (size_t i = 0; i < pixels; ++i) {
        uint64_t texel = 0;
        std::memcpy(&texel, &bytes[i * sizeof texel], sizeof texel);
        picture[i] = vec3(glm::unpackHalf4x16(texel));
    }
    refletDestroySettings(settings);
    refletDestroyView(view);
    refletDestroyContext(context);
    for (const std::string& message : host.host.messages()) {
        ADD_FAILURE() << message;
    }
    return picture;
}

// Within rounding, which may move a ray at an edge to another pixel.
TEST_F(LibraryPicture, IsThatOfTheRenderer) {
    const std::vector<std::pair<const char*, const char*>> assignments{
        {"diffuse.rays", "2"},         {"diffuse.downsample", "2"}, {"specular.downsample", "1"},
        {"trace_screen.light", "lit"}, {"denoise.enabled", "true"}, {"trace_screen.thickness", "0.2"}};
    std::vector<std::string> texts;
    for (const auto& [name, value] : assignments) {
        texts.push_back(std::string(name) + "=" + value);
    }
    for (const char* name : {"gloss", "cornell", "colonnade"}) {
        const Scene scene = findBuiltinScene(name)->make();
        const View view = defaultView(scene);
        const Pictures pictures = render(
            scene, view, size, settingsOf(texts),
            {"final", "direct", "depth", "normal", "geometric_normal", "albedo", "roughness", "metallic", "motion"});
        const std::vector<vec3> library = renderByLibrary(pictures, view.camera, view.environment, assignments);
        size_t others = 0;
        vec3 sums[2]{};
        for (unsigned i = 0; i < pixels; ++i) {
            const vec3 own = pictures.color("final", i % size.x, i / size.x);
            others += glm::distance(own, library[i]) > 0.02F * glm::length(own) + 0.002F ? 1 : 0;
            sums[0] += own;
            sums[1] += library[i];
        }
        EXPECT_LT(others, pixels / 500) << name;
        EXPECT_LT(glm::distance(sums[1] / sums[0], vec3(1.0F)), 0.0005F) << name << ' ' << sums[1].x / sums[0].x;
    }
}

}  // namespace
}  // namespace reflet::test::library_picture_test
