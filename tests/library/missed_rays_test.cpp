// A host's own source for rays that the screen does not answer.
#include "library/library_fixture.h"
#include "library/missed_rays_host.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace reflet::test {
namespace {

constexpr uint32_t width = HostRoom::width;
constexpr uint32_t height = HostRoom::height;

struct LobeTexels {
    std::vector<vec4> radiance;
    std::vector<vec4> confidence;
    std::vector<vec4> lit;
    uint32_t width = 0;  ///< of the first two
};

// How a lobe is traced.
struct Answering {
    RefletLobeKind kind = REFLET_LOBE_SPECULAR;
    bool asks = true;                    ///< the host; false: the effect itself
    std::optional<HiddenPlanes> planes;  ///< none: the host leaves the answers alone
    bool mirrors = false;                ///< every surface is one
    bool fills = false;                  ///< the host writes 1 into all answers, by a command that is no shader
    bool metals = true;                  ///< false: no surface is one
    uint32_t frames = 1;
};

class MissedRays : public Library {
protected:
    MissedRays() : room_(host_, {}), answerer_(host_) {
        const std::vector<vec4> texels(size_t(width) * height, vec4(0.0F, 1.0F, 0.0F, 0.0F));
        mirror_ = host_.makeImage(VK_FORMAT_R32G32B32A32_SFLOAT, width, height, texels);
        context_ = host_.makeContext();
        settings_ = makeSettings("balanced");
        set("temporal.scale", "1");
    }
    ~MissedRays() override {
        host_.host.waitForAll();
        refletDestroySettings(settings_);
        refletDestroyContext(context_);
    }

    void set(const char* name, const char* value) { EXPECT_REFLET(refletSetSetting(settings_, name, value)); }

    RefletLobe recordLobe(RefletView view, VkCommandBuffer commands, const Answering& how) {
        RefletLobe lobe = emptyLobe();
        const RefletIndirectLight light = room_.light();
        if (!how.asks) {
            const auto effect = how.kind == REFLET_LOBE_DIFFUSE ? refletDiffuseGi : refletReflections;
            EXPECT_REFLET(effect(view, settings_, &light, &lobe));
            return lobe;
        }
        RefletMissedRays missed{};
        missed.structSize = sizeof missed;
        EXPECT_REFLET(refletMissedRays(view, settings_, how.kind, &light, &missed));
        RefletRayAnswers answers{sizeof answers, 0, 0};
        if (how.fills) {
            answers = RayHost::fill(commands, missed, 1.0F);
        } else if (how.planes) {
            answers = answerer_.answer(commands, missed, *how.planes);
        }
        EXPECT_REFLET(refletAnswerRays(view, settings_, how.kind, &answers, &lobe));
        return lobe;
    }

    // The last of some frames of a view of its own.
    LobeTexels trace(const Answering& how) {
        RefletView view = makeView(context_, 3);
        RefletLobe lobe{};
        RefletComposite sum{sizeof sum, {}, {}, {}};
        for (uint32_t i = 0; i < how.frames; ++i) {
            host_.host.frame([&](VkCommandBuffer commands) {
                RefletFrameInfo info = room_.frame(commands, i);
                RefletGBuffer surfaces = *info.gbuffer;
                surfaces.roughness = how.mirrors ? mirror_ : surfaces.roughness;
                surfaces.metallic = how.mirrors ? mirror_ : how.metals ? surfaces.metallic : RefletImage{};
                info.gbuffer = &surfaces;
                EXPECT_REFLET(refletBeginFrame(view, &info));
                lobe = recordLobe(view, commands, how);
                EXPECT_REFLET(refletComposite(view, settings_, nullptr, &sum));
                EXPECT_REFLET(refletEndFrame(view));
            });
        }
        host_.host.waitForAll();
        LobeTexels out{halvesOf(host_, lobe.radiance), halvesOf(host_, lobe.confidence), halvesOf(host_, sum.lit),
                       lobe.radiance.width};
        refletDestroyView(view);
        return out;
    }

    HostRoom room_;
    RayHost answerer_;
    RefletImage mirror_{};
    RefletContext context_ = nullptr;
    RefletSettings settings_ = nullptr;
};

// What the mirror at the pixel shows of the host's planes; none where it shows anything else, or an edge.
std::optional<vec3> seenInMirror(uint32_t i, const HiddenPlanes& planes) {
    const vec3 eye(0.0F, 1.0F, 3.0F);
    const mat4 toView = glm::lookAt(eye, vec3(0.0F, 0.6F, 0.0F), vec3(0.0F, 1.0F, 0.0F));
    const vec2 uv((float(i % width) + 0.5F) / float(width), (float(i / width) + 0.5F) / float(height));
    const vec2 ndc = 2.0F * uv - 1.0F;
    const vec3 ray(glm::inverse(toView) * vec4(ndc.x * 0.5F * float(width) / float(height), -ndc.y * 0.5F, -1.0F, 0));
    const float toFloor = ray.y < 0.0F ? -eye.y / ray.y : INFINITY;
    const float toWall = (-3.0F - eye.z) / ray.z;
    const vec3 p = eye + std::min(toFloor, toWall) * ray;
    if (toFloor < toWall) {  // the floor shows what is above the wall
        const float rise = p.y + (-3.0F - p.z) / ray.z * -ray.y;
        return rise > 2.3F ? std::optional(vec3(planes.ceiling)) : std::nullopt;
    }
    const vec3 back(ray.x, ray.y, -ray.z);
    const float y = p.y + (planes.wall.w - p.z) / back.z * back.y;
    const bool shown = p.y < 1.8F && y > 0.1F && y < planes.ceiling.w - 0.1F;
    return shown ? std::optional(vec3(planes.wall)) : std::nullopt;
}

TEST_F(MissedRays, MirrorsShowWhatTheHostKnows) {
    set("denoise.enabled", "false");
    set("specular.downsample", "1");
    const HiddenPlanes planes;
    const LobeTexels without = trace({.asks = false, .mirrors = true});
    const LobeTexels with = trace({.planes = planes, .mirrors = true});
    size_t walls = 0;
    size_t ceilings = 0;
    for (uint32_t i = 0; i < with.radiance.size(); ++i) {
        const std::optional<vec3> wanted = seenInMirror(i, planes);
        if (!wanted) {
            continue;
        }
        (*wanted == vec3(planes.wall) ? walls : ceilings) += 1;
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(with.radiance[i][c], (*wanted)[c], 0.02F * (*wanted)[c]) << i % width << ' ' << i / width;
        }
        ASSERT_GT(with.confidence[i].w, 0.99F);
        ASSERT_LT(without.confidence[i].w, 0.01F);
        ASSERT_LT(without.radiance[i].x, 0.6F) << "the environment";
    }
    EXPECT_GT(walls, 100U);
    EXPECT_GT(ceilings, 100U);
}

TEST_F(MissedRays, ConfidenceIsTheShareOfTheHost) {
    set("denoise.enabled", "false");
    HiddenPlanes planes;
    const LobeTexels all = trace({.planes = planes});
    planes.confidence = 0.0F;
    const LobeTexels none = trace({.planes = planes});
    planes.confidence = 0.25F;
    const LobeTexels some = trace({.planes = planes});
    double most = 0.0;
    for (size_t i = 0; i < all.radiance.size(); ++i) {
        const vec3 wanted = 0.25F * vec3(all.radiance[i]) + 0.75F * vec3(none.radiance[i]);
        for (int c = 0; c < 3; ++c) {
            ASSERT_NEAR(some.radiance[i][c], wanted[c], 0.004F * wanted[c] + 1e-3F) << i;
        }
        most = std::max<double>(most, glm::distance(vec3(all.radiance[i]), vec3(none.radiance[i])));
    }
    EXPECT_GT(most, 1.0);
}

TEST_F(MissedRays, TellWhereTheyStart) {
    set("denoise.enabled", "false");
    for (const uint32_t scale : {1U, 2U, 3U}) {
        set("specular.downsample", std::to_string(scale).c_str());
        HiddenPlanes planes;
        planes.tells = 1.0F;
        const LobeTexels told = trace({.planes = planes, .mirrors = true});
        EXPECT_EQ(told.width, (width + scale - 1) / scale);
        size_t found = 0;
        for (uint32_t i = 0; i < told.radiance.size(); ++i) {
            const uvec2 pixel = uvec2(i % told.width, i / told.width) * scale + (scale - 1) / 2;
            if (pixel.x >= width || pixel.y >= height || !seenInMirror(pixel.y * width + pixel.x, planes)) {
                continue;
            }
            ++found;
            ASSERT_NEAR(told.radiance[i].x, float(pixel.x), 0.02F * float(pixel.x));
            ASSERT_NEAR(told.radiance[i].y, float(pixel.y), 0.02F * float(pixel.y));
            ASSERT_NEAR(told.radiance[i].z, 0.5F, 0.02F) << "ray 0 of the specular lobe of a mirror";
        }
        EXPECT_GT(found, 200 / (scale * scale));
    }
}

TEST_F(MissedRays, AreAnsweredByAnyCommand) {
    set("denoise.enabled", "false");
    set("specular.downsample", "1");
    const LobeTexels white = trace({.mirrors = true, .fills = true});
    size_t found = 0;
    for (uint32_t i = 0; i < white.radiance.size(); ++i) {
        if (seenInMirror(i, {})) {
            ++found;
            for (int c = 0; c < 4; ++c) {  // radiance, and a distance of 1 m
                ASSERT_NEAR(white.radiance[i][c], 1.0F, 0.02F) << i % width << ' ' << i / width;
            }
        }
    }
    EXPECT_GT(found, 200U);
}

// Settings of a way to trace, and whether the effect itself keeps rays in memory, too: then all bytes are the same.
struct Way {
    const char* name;
    RefletLobeKind kind;
    std::vector<std::pair<const char*, const char*>> settings;
    bool exact = true;
};

TEST_F(MissedRays, WithoutConfidenceAreThoseOfTheEffect) {
    const Way ways[] = {
        {"reuse", REFLET_LOBE_SPECULAR, {{"specular.reuse", "2"}}},
        {"coarse", REFLET_LOBE_SPECULAR, {{"specular.reuse", "2"}, {"specular.downsample", "2"}}},
        {"rays", REFLET_LOBE_SPECULAR, {{"specular.reuse", "1"}, {"specular.rays", "3"}}},
        {"cones",
         REFLET_LOBE_SPECULAR,
         {{"specular.reuse", "1"}, {"specular.max_roughness", "0.2"}, {"specular.rough_fallback", "mips"}}},
        {"adaptive", REFLET_LOBE_DIFFUSE, {{"diffuse.adaptive", "true"}, {"diffuse.rays", "2"}}},
        {"adaptive", REFLET_LOBE_SPECULAR, {{"specular.adaptive", "true"}, {"specular.rays", "2"}}},
        {"diffuse", REFLET_LOBE_DIFFUSE, {{"diffuse.reuse", "2"}, {"diffuse.downsample", "3"}}},
        {"slices", REFLET_LOBE_DIFFUSE, {{"diffuse.method", "slices"}, {"diffuse.reuse", "1"}}},
        {"normal", REFLET_LOBE_DIFFUSE, {{"diffuse.distribution", "normal"}, {"diffuse.reuse", "1"}}},
        {"no screen", REFLET_LOBE_SPECULAR, {{"trace_screen.enabled", "false"}, {"specular.reuse", "1"}}},
        {"at once", REFLET_LOBE_SPECULAR, {{"specular.adaptive", "false"}}, false},
        {"slices at once", REFLET_LOBE_DIFFUSE, {{"diffuse.method", "slices"}}, false},
        {"batches", REFLET_LOBE_DIFFUSE, {{"diffuse.method", "rays"}, {"diffuse.rays", "16"}}, false}};
    for (const Way& way : ways) {
        SCOPED_TRACE(way.name);
        refletDestroySettings(settings_);
        settings_ = makeSettings("balanced");
        set("diffuse.adaptive", "false");
        set("diffuse.method", "rays");
        for (const auto& [name, value] : way.settings) {
            set(name, value);
        }
        HiddenPlanes planes;
        planes.confidence = 0.0F;
        planes.missDistance = 0.0F;
        // What smooth metals show the camera answers rays of the effect alone.
        const LobeTexels effect = trace({.kind = way.kind, .asks = false, .metals = false, .frames = 3});
        const LobeTexels silent = trace({.kind = way.kind, .metals = false, .frames = 3});
        const LobeTexels unsure = trace({.kind = way.kind, .planes = planes, .metals = false, .frames = 3});
        EXPECT_EQ(silent.radiance, unsure.radiance);
        EXPECT_EQ(silent.lit, unsure.lit);
        if (way.exact) {
            EXPECT_EQ(effect.radiance, silent.radiance);
            EXPECT_EQ(effect.confidence, silent.confidence);
            EXPECT_EQ(effect.lit, silent.lit);
            continue;
        }
        double difference = 0.0;
        double sum = 0.0;
        for (size_t i = 0; i < effect.lit.size(); ++i) {
            difference += glm::distance(vec3(effect.lit[i]), vec3(silent.lit[i]));
            sum += glm::length(vec3(effect.lit[i]));
        }
        EXPECT_LT(difference, 0.002 * sum) << "directions are rounded in memory";
    }
}

// Both lobes in a frame, the second of which reads the light of the first; the effects behind them run on it.
TEST_F(MissedRays, OfBothLobesLightTheRoom) {
    HiddenPlanes planes;
    RefletView view = makeView(context_, 3);
    RoomResults out;
    out.sum.structSize = sizeof out.sum;
    std::vector<vec4> means;
    for (const bool asks : {false, true}) {
        EXPECT_REFLET(refletResetView(view));
        for (uint32_t i = 0; i < 6; ++i) {
            host_.host.frame([&](VkCommandBuffer commands) {
                const RefletFrameInfo info = room_.frame(commands, i);
                EXPECT_REFLET(refletBeginFrame(view, &info));
                out.diffuse = recordLobe(view, commands, {REFLET_LOBE_DIFFUSE, asks, planes});
                out.specular = recordLobe(view, commands, {REFLET_LOBE_SPECULAR, asks, planes});
                EXPECT_REFLET(refletComposite(view, settings_, nullptr, &out.sum));
                EXPECT_REFLET(refletTemporal(view, settings_, nullptr, &out.antialiased));
                EXPECT_REFLET(refletToneMap(view, settings_, nullptr, 0, &out.display));
                EXPECT_REFLET(refletEndFrame(view));
            });
        }
        host_.host.waitForAll();
        vec4 sum(0.0F);
        for (const vec4& texel : halvesOf(host_, out.antialiased)) {
            ASSERT_TRUE(std::isfinite(texel.x + texel.y + texel.z));
            sum += texel;
        }
        means.push_back(sum);
    }
    EXPECT_GT(means[1].y, 1.2F * means[0].y) << "the planes are brighter than the environment";
    refletDestroyView(view);
}

TEST_F(MissedRays, ArePreparedAndMakeNothingInLaterFrames) {
    using Made = LibraryHost::Made;
    RefletView view = makeView(context_, 3);
    const RefletFrameInfo frame = room_.frame(VK_NULL_HANDLE, 0);
    RefletPrepareInfo info{};
    info.structSize = sizeof info;
    info.effects = REFLET_EFFECT_MISSED_DIFFUSE_RAYS | REFLET_EFFECT_MISSED_REFLECTION_RAYS | REFLET_EFFECT_COMPOSITE;
    info.gbuffer = frame.gbuffer;
    uint32_t left = 1;
    while (left > 0) {
        ASSERT_EQ(refletPrepare(view, settings_, &info, 64, &left), REFLET_SUCCESS) << refletLastError();
    }
    Made made = LibraryHost::made();
    RefletComposite sum{sizeof sum, {}, {}, {}};
    for (uint32_t i = 0; i < 12; ++i) {
        host_.host.frame([&](VkCommandBuffer commands) {
            const RefletFrameInfo now = room_.frame(commands, i);
            EXPECT_REFLET(refletBeginFrame(view, &now));
            recordLobe(view, commands, {REFLET_LOBE_DIFFUSE, true, HiddenPlanes{}});
            recordLobe(view, commands, {REFLET_LOBE_SPECULAR, true, HiddenPlanes{}});
            EXPECT_REFLET(refletComposite(view, settings_, nullptr, &sum));
            EXPECT_REFLET(refletEndFrame(view));
        });
        EXPECT_EQ(LibraryHost::made().pipelines, made.pipelines) << "frame " << i << " made pipelines";
        if (i == 5) {
            made = LibraryHost::made();
        }
    }
    EXPECT_TRUE(LibraryHost::made() == made) << "a later frame made something";
    host_.host.waitForAll();
    refletDestroyView(view);
}

}  // namespace
}  // namespace reflet::test
