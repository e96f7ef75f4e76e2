// The room of the library's tests.
#include "library/library_host.h"

#include "base/math.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace reflet::test {

namespace {

void store(float (&to)[16], const mat4& m) {
    std::memcpy(to, &m[0][0], sizeof to);
}

vec2 octahedral(vec3 n) {
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (n.z >= 0.0F) {
        return {n.x, n.y};
    }
    return {(1.0F - std::abs(n.y)) * (n.x >= 0.0F ? 1.0F : -1.0F),
            (1.0F - std::abs(n.x)) * (n.y >= 0.0F ? 1.0F : -1.0F)};
}

float srgb(float linear) {
    return linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

constexpr float near = 0.1F;
constexpr float far = 100.0F;
constexpr float tangent = 0.5F;  // of half the field of view
const vec3 eye(0.0F, 1.0F, 3.0F);

mat4 projection(bool odd) {
    mat4 toClip(0.0F);
    toClip[0][0] = 1.0F / (tangent * float(HostRoom::width) / float(HostRoom::height));
    toClip[1][1] = odd ? 1.0F / tangent : -1.0F / tangent;
    toClip[2][3] = -1.0F;
    toClip[2][2] = odd ? far / (near - far) : 0.0F;
    toClip[3][2] = odd ? near * far / (near - far) : near;
    return toClip;
}

struct RoomImages {
    std::vector<float> depth;
    std::vector<vec4> normal;
    std::vector<vec4> color;
    std::vector<vec4> material;
    std::vector<vec4> motion;
    std::vector<vec4> lit;
};

// What a ray through the pixel meets: floor y = 0 in front of a wall at z = -3, 2 m high, and sky above.
void addPixel(RoomImages& images, uint32_t i, const mat4& toView, const RoomConventions& conventions) {
    const bool odd = conventions.unusual;
    const vec2 size(conventions.drawn.x > 0 ? conventions.drawn : uvec2(HostRoom::width, HostRoom::height));
    const vec2 pixel(float(i % HostRoom::width), float(i / HostRoom::width));
    if (pixel.x >= size.x || pixel.y >= size.y) {
        images.depth.push_back(NAN);
        for (std::vector<vec4>* image :
             {&images.normal, &images.color, &images.material, &images.motion, &images.lit}) {
            image->emplace_back(NAN);
        }
        return;
    }
    const vec2 uv = (pixel + 0.5F + conventions.jitter) / size;
    const vec2 ndc = 2.0F * uv - 1.0F;
    const vec3 ray(glm::inverse(toView) *
                   vec4(ndc.x / projection(odd)[0][0], -ndc.y * tangent, -1.0F, 0.0F));  // 1 m ahead
    const float toFloor = ray.y < 0.0F ? -eye.y / ray.y : INFINITY;
    const float toWall = (-3.0F - eye.z) / ray.z;
    const float distance = std::min(toFloor, toWall);
    const bool sky = toWall <= toFloor && (eye + toWall * ray).y > 2.0F;
    const bool floor = toFloor < toWall;
    const float depth = odd ? (far - near * far / distance) / (far - near) : near / distance;
    images.depth.push_back(sky ? (odd ? 1.0F : 0.0F) : depth);
    const vec3 n = floor ? vec3(0.0F, 1.0F, 0.0F) : vec3(0.0F, 0.0F, 1.0F);
    images.normal.push_back(odd ? vec4(0.5F * (glm::mat3(toView) * n) + 0.5F, 0.0F) : vec4(octahedral(n), 0.0F, 0.0F));
    const vec3 albedo = floor ? vec3(0.8F, 0.4F, 0.2F) : vec3(0.2F, 0.5F, 0.7F);
    images.color.push_back(odd ? vec4(srgb(albedo.x), srgb(albedo.y), srgb(albedo.z), 1.0F) : vec4(albedo, 1.0F));
    const float roughness = floor ? 0.25F : 0.8F;
    const float metallic = floor ? 1.0F : 0.0F;
    images.material.push_back(odd ? vec4(0.0F, metallic, 0.0F, roughness * roughness)
                                  : vec4(roughness, metallic, 0.0F, 0.0F));
    const vec2 moved = conventions.still ? vec2(0.0F) : vec2(0.01F, -0.02F);  // uv
    images.motion.push_back(odd ? vec4(-moved.x * size.x, -moved.y * size.y, 0.0F, 0.0F) : vec4(moved, 0.0F, 0.0F));
    const float spot = int(std::floor(8.0F * uv.x)) % 2 == 0 ? 1.0F : 0.3F;
    images.lit.push_back(sky ? vec4(0.5F, 0.6F, 0.8F, 1.0F) : vec4(spot * albedo, 1.0F));
}

void spoil(RoomImages& images) {
    constexpr float wrong[] = {NAN, INFINITY, -INFINITY, 65504.0F, 1e30F, -2.0F};
    const size_t count = images.depth.size();
    for (size_t i = 0; i < count; i += 5) {
        const float value = wrong[i / 5 % std::size(wrong)];
        images.depth[i] = value;
        images.normal[(i + 1) % count] = vec4(value);
        images.color[(i + 2) % count] = vec4(value);
        images.material[(i + 3) % count] = vec4(value);
        images.motion[(i + 4) % count] = vec4(value);
        images.lit[(i + 2) % count] = vec4(value);
    }
}

}  // namespace

namespace {

float nothingOf(float /*type*/) {
    return NAN;
}
vec4 nothingOf(const vec4& /*type*/) {
    return vec4(NAN);
}

// An image with the border of the conventions.
template <class T>
RefletImage makeFramed(LibraryHost& host, VkFormat format, const std::vector<T>& texels, uvec2 border) {
    const uvec2 size = uvec2(HostRoom::width, HostRoom::height) + 2U * border;
    std::vector<T> framed(size_t(size.x) * size.y, nothingOf(T()));
    for (uint32_t y = 0; y < HostRoom::height; ++y) {
        std::copy_n(texels.begin() + y * HostRoom::width, HostRoom::width,
                    framed.begin() + (y + border.y) * size.x + border.x);
    }
    RefletImage image = host.makeImage(format, size.x, size.y, framed);
    image.offset[0] = border.x;
    image.offset[1] = border.y;
    return image;
}

}  // namespace

// The camera looks a little downward.
HostRoom::HostRoom(LibraryHost& host, RoomConventions conventions) {
    const bool odd = conventions.unusual;
    const mat4 toView = glm::lookAt(eye, vec3(0.0F, 0.6F, 0.0F), vec3(0.0F, 1.0F, 0.0F));
    RoomImages images;
    for (uint32_t i = 0; i < width * height; ++i) {
        addPixel(images, i, toView, conventions);
    }
    if (conventions.spoiled) {
        spoil(images);
    }
    const auto make = [&](const auto& texels) {
        const bool one = sizeof texels[0] == sizeof(float);
        return makeFramed(host, one ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT, texels, conventions.border);
    };
    info_.structSize = sizeof info_;
    store(info_.worldToView, toView);
    store(info_.viewToClip, projection(odd));
    info_.clipYUp = odd ? 1 : 0;
    info_.jitter[0] = conventions.jitter.x;
    info_.jitter[1] = conventions.jitter.y;
    info_.renderSize[0] = conventions.drawn.x;
    info_.renderSize[1] = conventions.drawn.y;
    RefletGBuffer& g = gbuffer_;
    g.structSize = sizeof g;
    g.depth = make(images.depth);
    g.depthKind = odd ? REFLET_DEPTH_STANDARD : REFLET_DEPTH_REVERSED;
    g.normal = make(images.normal);
    g.normalKind = odd ? REFLET_NORMAL_VECTOR_UNORM : REFLET_NORMAL_OCTAHEDRAL_SNORM;
    g.normalsInViewSpace = odd ? 1 : 0;
    g.roughness = make(images.material);
    g.roughnessChannel = odd ? 3 : 0;
    g.roughnessKind = odd ? REFLET_ROUGHNESS_ALPHA : REFLET_ROUGHNESS_PERCEPTUAL;
    g.metallic = g.roughness;
    g.metallicChannel = 1;
    g.baseColor = make(images.color);
    g.baseColorKind = odd ? REFLET_COLOR_SRGB : REFLET_COLOR_LINEAR;
    g.motion = make(images.motion);
    g.motionKind = odd ? REFLET_MOTION_PIXELS : REFLET_MOTION_UV;
    g.motionScale[0] = g.motionScale[1] = odd ? -1.0F : 0.0F;
    environment_.structSize = sizeof environment_;
    environment_.factor[0] = 0.5F;
    environment_.factor[1] = 0.6F;
    environment_.factor[2] = 0.8F;
    lit_ = make(images.lit);
    shadowMap_ = host.makeImage(VK_FORMAT_R32_SFLOAT, 64, 64, std::vector<float>(size_t(64) * 64, 0.0F));
}

RefletFrameInfo HostRoom::frame(VkCommandBuffer commands, uint32_t index) const {
    RefletFrameInfo info = info_;
    info.commandBuffer = commands;
    info.frameIndex = index;
    info.gbuffer = &gbuffer_;
    info.elapsed = 0.04F;
    return info;
}

RefletIndirectLight HostRoom::light() const {
    RefletIndirectLight light{};
    light.structSize = sizeof light;
    light.light = lit_;
    light.environment = &environment_;
    return light;
}

RefletSunShadow HostRoom::sun() const {
    RefletSunShadow sun{};
    sun.structSize = sizeof sun;
    sun.map = shadowMap_;
    sun.cascades = 1;
    store(sun.worldToClip[0], glm::scale(mat4(1.0F), vec3(0.1F, 0.1F, 0.05F)));
    sun.toSun[1] = 1.0F;
    return sun;
}

RoomResults recordRoom(const HostRoom& room, RefletView view, RefletSettings settings, VkCommandBuffer commands,
                       uint32_t index) {
    return recordRoom(room, room.frame(commands, index), view, settings);
}

RoomResults recordRoom(const HostRoom& room, const RefletFrameInfo& frame, RefletView view, RefletSettings settings) {
    RoomResults out;
    const RefletSunShadow sun = room.sun();
    const RefletIndirectLight light = room.light();
    out.sum.structSize = sizeof out.sum;
    EXPECT_REFLET(refletBeginFrame(view, &frame));
    EXPECT_REFLET(refletSunShadow(view, settings, &sun, &out.visibility));
    if (std::strcmp(refletGetSetting(settings, "ao.method"), "none") != 0) {
        EXPECT_REFLET(refletAmbientOcclusion(view, settings, &out.occlusion));
    }
    EXPECT_REFLET(refletDiffuseGi(view, settings, &light, &out.diffuse));
    EXPECT_REFLET(refletReflections(view, settings, &light, &out.specular));
    EXPECT_REFLET(refletComposite(view, settings, nullptr, &out.sum));
    EXPECT_REFLET(refletTemporal(view, settings, nullptr, &out.antialiased));
    const RefletLens lens{sizeof lens, 0.2F, 3.0F, 6, 0.1F};
    EXPECT_REFLET(refletDepthOfField(view, settings, &lens, nullptr, &out.defocused));
    EXPECT_REFLET(refletToneMap(view, settings, nullptr, 1, &out.display));
    EXPECT_REFLET(refletEndFrame(view));
    return out;
}

}  // namespace reflet::test
