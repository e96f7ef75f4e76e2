// Hosts that give no geometric normals: those from depth are right at edges and on what is a pixel wide.
#include "library/library_fixture.h"

#include <cmath>

namespace reflet::test::flat_normal_test {
namespace {

constexpr uint32_t width = 96;
constexpr uint32_t height = 64;
constexpr VkFormat four = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr float tangent = 0.5F;  // of half the vertical field of view
constexpr float aspect = float(width) / float(height);
const vec3 eye(0.0F, 1.5F, 4.0F);

struct Hit {
    float away = 1e6F;  // along the view axis
    vec3 normal{0.0F};
};

// A box that stands on the floor, turned about +Y.
void meetBox(vec3 from, vec3 ray, vec3 middle, vec3 half, float turn, Hit& hit) {
    const auto turned = [&](vec3 v) {
        return vec3(std::cos(turn) * v.x - std::sin(turn) * v.z, v.y, std::sin(turn) * v.x + std::cos(turn) * v.z);
    };
    const vec3 o = turned(from - middle);
    const vec3 d = turned(ray);
    float enter = -1e6F;
    float leave = 1e6F;
    vec3 normal(0.0F);
    for (int i = 0; i < 3; ++i) {
        const float a = (-half[i] - o[i]) / d[i];
        const float b = (half[i] - o[i]) / d[i];
        if (std::min(a, b) > enter) {
            enter = std::min(a, b);
            normal = vec3(0.0F);
            normal[i] = d[i] > 0.0F ? -1.0F : 1.0F;
        }
        leave = std::min(leave, std::max(a, b));
    }
    if (enter > 0.0F && enter < leave && enter < hit.away) {
        hit.away = enter;
        hit.normal = vec3(std::cos(turn) * normal.x + std::sin(turn) * normal.z, normal.y,
                          -std::sin(turn) * normal.x + std::cos(turn) * normal.z);
    }
}

// A floor with a box, posts of one to two pixels and steps of two, and sky.
Hit meet(vec3 ray) {
    Hit hit;
    if (ray.y < -1e-3F) {
        hit = {eye.y / -ray.y, vec3(0, 1, 0)};
    }
    meetBox(eye, ray, vec3(-0.6F, 0.5F, 0.5F), vec3(0.5F), 0.6F, hit);
    for (int i = 0; i < 6; ++i) {
        const float thick = 0.03F + 0.01F * float(i);
        meetBox(eye, ray, vec3(0.3F + 0.25F * float(i), 0.6F, 0.3F), vec3(thick, 0.6F, thick), 0.3F * float(i), hit);
        meetBox(eye, ray, vec3(1.2F, 0.04F + 0.08F * float(i), 1.4F - 0.12F * float(i)), vec3(0.5F, 0.04F, 0.06F), 0.2F,
                hit);
    }
    return hit;
}

class FlatNormals : public Library {
protected:
    FlatNormals() {
        std::vector<float> depths;
        std::vector<vec4> shaded;
        for (uint32_t i = 0; i < width * height; ++i) {
            const vec2 ndc = 2.0F * (vec2(i % width, i / width) + 0.5F) / vec2(width, height) - 1.0F;
            const vec3 ahead = glm::normalize(vec3(0, -0.3F, -1.0F));
            const vec3 right(1, 0, 0);
            const vec3 up = glm::cross(right, ahead);
            const vec3 ray = ahead + tangent * (aspect * ndc.x * right - ndc.y * up);
            const Hit hit = meet(ray);
            const bool sky = hit.away > 30.0F;
            depths.push_back(sky ? 0.0F : 0.1F / hit.away);
            true_.push_back(sky ? vec4(0.0F) : vec4(hit.normal, 0.0F));
            // As a normal map bends it, by up to 8 degrees.
            const vec3 p = eye + hit.away * ray;
            const vec3 bent =
                hit.normal + 0.08F * vec3(std::sin(23.0F * p.x), std::sin(31.0F * p.y), std::sin(29.0F * p.z));
            shaded.push_back(sky ? vec4(0.0F) : vec4(glm::normalize(bent), 0.0F));
        }
        depth_ = host_.makeImage(VK_FORMAT_R32_SFLOAT, width, height, depths);
        shaded_ = host_.makeImage(four, width, height, shaded);
        geometric_ = host_.makeImage(four, width, height, true_);
    }

    [[nodiscard]] RefletFrameInfo frameOf(VkCommandBuffer commands, bool given) {
        RefletFrameInfo info{};
        info.structSize = sizeof info;
        info.commandBuffer = commands;
        const mat4 toView = glm::lookAt(eye, eye + vec3(0, -0.3F, -1.0F), vec3(0, 1, 0));
        std::memcpy(info.worldToView, &toView, sizeof info.worldToView);
        info.viewToClip[0] = 1.0F / (tangent * aspect);
        info.viewToClip[5] = -1.0F / tangent;
        info.viewToClip[11] = -1.0F;
        info.viewToClip[14] = 0.1F;
        gbuffer_ = {};
        gbuffer_.structSize = sizeof gbuffer_;
        gbuffer_.depth = depth_;
        gbuffer_.normal = shaded_;
        gbuffer_.normalKind = REFLET_NORMAL_VECTOR_SNORM;
        gbuffer_.geometricNormal = given ? geometric_ : RefletImage{};
        info.gbuffer = &gbuffer_;
        return info;
    }

    struct Found {
        std::vector<uint32_t> normals;  // as two snorm16, octahedral
        std::vector<vec4> occlusion;
    };
    Found find(bool given) {
        RefletContext context = host_.makeContext();
        RefletSettings settings = makeSettings(nullptr);
        EXPECT_REFLET(refletSetSetting(settings, "ao.method", "horizon"));
        RefletView view = makeView(context, 3, width, height);
        RefletImage occlusion{};
        RefletImage normals{};
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo info = frameOf(commands, given);
            EXPECT_REFLET(refletBeginFrame(view, &info));
            EXPECT_REFLET(refletAmbientOcclusion(view, settings, &occlusion));
            EXPECT_REFLET(refletEndFrame(view));
        });
        host_.host.waitForAll();
        EXPECT_REFLET(refletFindImage(view, "geometric_normal", &normals));
        const Found found{texelsOf<uint32_t>(host_, normals), halvesOf(host_, occlusion)};
        refletDestroyView(view);
        refletDestroySettings(settings);
        refletDestroyContext(context);
        return found;
    }

    std::vector<vec4> true_;
    RefletGBuffer gbuffer_{};
    RefletImage depth_{};
    RefletImage shaded_{};
    RefletImage geometric_{};
};

vec3 unpacked(uint32_t packed) {
    const vec2 at = glm::unpackSnorm2x16(packed);
    vec3 n(at, 1.0F - std::abs(at.x) - std::abs(at.y));
    const float fold = std::max(-n.z, 0.0F);
    n.x += n.x >= 0.0F ? -fold : fold;
    n.y += n.y >= 0.0F ? -fold : fold;
    return glm::normalize(n);
}

TEST_F(FlatNormals, FromDepthAreThoseOfTheTriangles) {
    const Found with = find(true);
    const Found without = find(false);
    unsigned surfaces = 0;
    unsigned off = 0;
    unsigned darker = 0;
    for (size_t i = 0; i < true_.size(); ++i) {
        if (true_[i] == vec4(0.0F)) {
            continue;
        }
        ++surfaces;
        off += glm::dot(unpacked(without.normals[i]), vec3(true_[i])) < 0.9848F ? 1 : 0;  // 10 degrees
        darker += without.occlusion[i].w < with.occlusion[i].w - 0.1F ? 1 : 0;
        EXPECT_GT(glm::dot(unpacked(with.normals[i]), vec3(true_[i])), 0.9999F);
    }
    EXPECT_LT(double(off) / surfaces, 0.015);
    EXPECT_LT(double(darker) / surfaces, 0.005);
}

}  // namespace
}  // namespace reflet::test::flat_normal_test
