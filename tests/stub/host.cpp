// What a host without a device passes to the effects.
#include "stub/host.h"

#include "base/math.h"

#include <cstring>

namespace reflet::stub {

namespace {

template <class To>
void store(To& to, const mat4& m) {
    std::memcpy(&to, &m[0][0], sizeof to);
}

// Reversed depth, without a far plane.
mat4 perspective(float tangentX, float tangentY) {
    mat4 m(0.0F);
    m[0][0] = 1.0F / tangentX;
    m[1][1] = -1.0F / tangentY;
    m[2][3] = -1.0F;
    m[3][2] = 0.1F;
    return m;
}

thread_local uint64_t nextImage = 0;

RefletImage another(VkFormat format, uint32_t width, uint32_t height) {
    return hostImage(nextImage++, format, width, height);
}

RefletImage cubeImage(VkFormat format, uint32_t side) {
    return another(format, side, side);
}

}  // namespace

RefletImage hostImage(uint64_t number, VkFormat format, uint32_t width, uint32_t height) {
    RefletImage image{};
    image.image = hostHandle<VkImage>(1000 + 2 * number);
    image.view = hostHandle<VkImageView>(1001 + 2 * number);
    image.format = format;
    image.width = width;
    image.height = height;
    image.layout = VK_IMAGE_LAYOUT_GENERAL;
    return image;
}

void HostFrame::look(float angle) {
    const mat4 toView = glm::lookAt(vec3(std::sin(angle), 1.0F, std::cos(angle)), vec3(0.0F), vec3(0.0F, 1.0F, 0.0F));
    std::memcpy(frame.previousWorldToView, frame.worldToView, sizeof frame.worldToView);
    std::memcpy(frame.previousViewToClip, frame.viewToClip, sizeof frame.viewToClip);
    store(frame.worldToView, toView);
    store(frame.viewToClip, perspective(0.8F, 0.5F));
    store(planarViews[0].worldToView, toView * glm::scale(mat4(1.0F), vec3(1.0F, -1.0F, 1.0F)));
    store(planarViews[0].viewToClip, perspective(0.8F, 0.5F));
}

namespace {

void fillGBuffer(RefletGBuffer& g, uint32_t width, uint32_t height) {
    g.structSize = sizeof g;
    g.depth = another(VK_FORMAT_D32_SFLOAT, width, height);
    g.normal = another(VK_FORMAT_R16G16_SNORM, width, height);
    g.geometricNormal = another(VK_FORMAT_R16G16_SNORM, width, height);
    g.roughness = another(VK_FORMAT_R8G8B8A8_UNORM, width, height);
    g.metallic = g.roughness;
    g.metallicChannel = 1;
    g.baseColor = another(VK_FORMAT_R8G8B8A8_SRGB, width, height);
    g.motion = another(VK_FORMAT_R16G16_SFLOAT, width, height);
    g.backDepth = another(VK_FORMAT_D32_SFLOAT, width, height);
    g.excluded = g.unlit = g.reactive = another(VK_FORMAT_R8G8B8A8_UNORM, width, height);
    g.unlitChannel = 1;
    g.reactiveChannel = 2;
}

void fillSun(RefletSunShadow& sun) {
    sun.structSize = sizeof sun;
    sun.map = another(VK_FORMAT_D32_SFLOAT, 256, 256);
    sun.cascades = 2;
    sun.toSun[1] = 1.0F;
    sun.contactShadows = 1;
    for (uint32_t i = 0; i < 4; ++i) {
        store(sun.worldToClip[i], glm::scale(mat4(1.0F), vec3(0.1F, 0.1F, 0.02F)));
        sun.cascadeSplits[i] = 5.0F * static_cast<float>(i + 1);
    }
}

void fillLamps(std::array<RefletLampShadow, 3>& lamps) {
    const vec3 eye(0.0F, 3.0F, 0.0F);
    const vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (RefletLampShadow& lamp : lamps) {
        lamp.structSize = sizeof lamp;
        lamp.position[1] = eye.y;
        lamp.radius = 0.1F;
        for (size_t face = 0; face < 6; ++face) {
            const vec3 up = std::abs(axes[face].y) > 0.5F ? vec3(0, 0, 1) : vec3(0, 1, 0);
            store(lamp.worldToClip[face], perspective(1.0F, 1.0F) * glm::lookAt(eye, eye + axes[face], up));
        }
    }
    lamps[0].direction[0] = 1.0F;
    lamps[0].coneAngle = 0.7F;
    lamps[0].map = another(VK_FORMAT_D32_SFLOAT, 64, 64);
    lamps[1].kind = REFLET_LAMP_MAP_CUBE;
    lamps[1].map = cubeImage(VK_FORMAT_R16_SFLOAT, 32);
    lamps[1].depth = REFLET_LAMP_DEPTH_DISTANCE;
    lamps[2].kind = REFLET_LAMP_MAP_SIX_TILES;
    lamps[2].map = another(VK_FORMAT_D32_SFLOAT, 96, 64);
    for (uint32_t face = 0; face < 6; ++face) {
        lamps[2].tiles[face][0] = 32 * (face % 3);
        lamps[2].tiles[face][1] = 32 * (face / 3);
        lamps[2].tiles[face][2] = 32;
    }
}

void fillProbes(HostFrame& host) {
    host.harmonics[0] = host.harmonics[1] = host.harmonics[2] = 1.0F;
    for (RefletProbe& probe : host.probes) {
        probe.structSize = sizeof probe;
        for (float& half : probe.boxHalfExtents) {
            half = 5.0F;
        }
        probe.blend = 0.5F;
        probe.radiance = cubeImage(VK_FORMAT_R16G16B16A16_SFLOAT, 32);
        probe.revision = 1;
    }
    host.probes[0].parallax = REFLET_PARALLAX_DEPTH;
    host.probes[0].distance = cubeImage(VK_FORMAT_R16_SFLOAT, 32);
    host.probes[0].sphericalHarmonics = host.harmonics.data();
    host.probes[1].irradiance = cubeImage(VK_FORMAT_R16G16B16A16_SFLOAT, 8);
}

void fillLight(HostFrame& host, uint32_t width, uint32_t height) {
    RefletEnvironment& environment = host.environment;
    environment.structSize = sizeof environment;
    environment.image = another(VK_FORMAT_R16G16B16A16_SFLOAT, 64, 32);
    environment.revision = 1;
    RefletPlanarView& planar = host.planarViews[0];
    planar.structSize = sizeof planar;
    planar.color = another(VK_FORMAT_R16G16B16A16_SFLOAT, 40, 25);
    planar.depth = another(VK_FORMAT_D32_SFLOAT, 40, 25);
    planar.plane[1] = 1.0F;
    RefletIndirectLight& light = host.light;
    light.structSize = sizeof light;
    light.light = another(VK_FORMAT_R16G16B16A16_SFLOAT, width, height);
    light.environment = &environment;
    light.specularFallback = another(VK_FORMAT_R16G16B16A16_SFLOAT, width, height);
    light.irradiance = another(VK_FORMAT_R16G16B16A16_SFLOAT, width, height);
    light.probes = host.probes.data();
    light.probeCount = static_cast<uint32_t>(host.probes.size());
    light.planarViews = host.planarViews.data();
    light.planarViewCount = static_cast<uint32_t>(host.planarViews.size());
}

}  // namespace

HostFrame::HostFrame(uint32_t width, uint32_t height, uint64_t first) {
    nextImage = first;
    fillGBuffer(gbuffer, width, height);
    frame.structSize = sizeof frame;
    frame.gbuffer = &gbuffer;
    frame.elapsed = 0.016F;
    look(0.0F);
    fillSun(sun);
    fillLamps(lamps);
    contact.structSize = sizeof contact;
    contact.light[1] = 1.0F;
    fillProbes(*this);
    fillLight(*this, width, height);
    color = another(VK_FORMAT_R16G16B16A16_SFLOAT, width, height);
    output = another(VK_FORMAT_R8G8B8A8_UNORM, width, height);
    exposure = another(VK_FORMAT_R32_SFLOAT, 1, 1);
    lens = {sizeof lens, 0.02F, 3.0F, 6, 0.1F};
    toneMap.structSize = sizeof toneMap;
    toneMap.autoExposure = 1;
    answers.structSize = sizeof answers;
    prepare.structSize = sizeof prepare;
    prepare.effects = 2 * REFLET_EFFECT_MOTION_BLUR - 1;
    prepare.gbuffer = &gbuffer;
    prepare.hasEnvironmentImage = 1;
    prepare.cascades = 2;
    prepare.shadowMapSide = 256;
    prepare.lampMapSide = 64;
    prepare.lampMapTiles = 13;
    prepare.autoExposure = 1;
    prepare.changesSize = 1;
    prepare.light = &light;
    prepare.toneMap = &toneMap;
}

}  // namespace reflet::stub
