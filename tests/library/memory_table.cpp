// Prints docs/library.md's table of memory: what each effect adds to a view with an output of 1920x1080
// and 3840x2160. `fast` and `balanced` have frames of half of that to each side (temporal upscaling).
#include "library/library_host.h"

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <vector>

using namespace reflet::test;
using reflet::uvec2;

namespace {

double megabytes(RefletContext context, const char* preset, uint32_t effects, uvec2 size, const RefletGBuffer& gbuffer,
                 const RefletIndirectLight* light) {
    const uint32_t share = std::string_view(preset) == "quality" ? 1 : 2;
    const RefletViewInfo info{sizeof info, size.x / share, size.y / share, 1, 0, 0};
    RefletView view = nullptr;
    RefletSettings settings = nullptr;
    refletCreateView(context, &info, &view);
    refletSetOutputSize(view, size.x, size.y);
    refletCreateSettings(preset, &settings);
    if ((effects & REFLET_EFFECT_AMBIENT_OCCLUSION) != 0) {
        refletSetSetting(settings, "ao.method", "horizon");
    }
    RefletPrepareInfo prepare{};
    prepare.structSize = sizeof prepare;
    prepare.effects = effects;
    prepare.gbuffer = &gbuffer;
    prepare.lampMapSide = 1024;
    prepare.lampMapTiles = 4;
    prepare.light = light;
    uint32_t left = 0;
    if (refletPrepare(view, settings, &prepare, 0, &left) != REFLET_SUCCESS) {
        std::fprintf(stderr, "%s\n", refletLastError());
    }
    uint64_t bytes = 0;
    refletViewMemory(view, &bytes);
    refletDestroySettings(settings);
    refletDestroyView(view);
    return double(bytes) * 1e-6;
}

}  // namespace

int main() {
    LibraryHost host;
    RefletContext context = host.makeContext();
    const HostRoom room(host, {});
    const RefletGBuffer gbuffer = *room.frame(nullptr, 0).gbuffer;
    std::vector<RefletProbe> probes(4);
    for (RefletProbe& probe : probes) {
        probe.structSize = sizeof probe;
        std::ranges::fill(probe.boxHalfExtents, 2.0F);
        probe.radiance = host.makeCube(VK_FORMAT_R32_SFLOAT, 128, std::vector<float>(size_t(6) * 128 * 128));
    }
    RefletIndirectLight withProbes = room.light();
    withProbes.probes = probes.data();
    withProbes.probeCount = 4;
    struct Row {
        const char* name;
        uint32_t effects;
        uint32_t base;  // effects whose memory is taken off
        bool probes = false;
    };
    constexpr uint32_t bare = REFLET_EFFECT_TONE_MAP;
    constexpr uint32_t whole = REFLET_EFFECT_SUN_SHADOW | REFLET_EFFECT_DIFFUSE_GI | REFLET_EFFECT_REFLECTIONS |
                               REFLET_EFFECT_COMPOSITE | REFLET_EFFECT_TEMPORAL | REFLET_EFFECT_TONE_MAP;
    constexpr uint32_t more =
        REFLET_EFFECT_AMBIENT_OCCLUSION | REFLET_EFFECT_DEPTH_OF_FIELD | REFLET_EFFECT_LAMP_SHADOWS;
    const Row rows[] = {{"import of the G-buffer, tables", bare, 0},
                        {"sun shadow, a map of 2048² texels", REFLET_EFFECT_SUN_SHADOW, bare},
                        {"diffuse GI", REFLET_EFFECT_DIFFUSE_GI, bare},
                        {"reflections", REFLET_EFFECT_REFLECTIONS, bare},
                        {"composite", REFLET_EFFECT_COMPOSITE, bare},
                        {"temporal antialiasing", REFLET_EFFECT_TEMPORAL, bare},
                        {"all of these", whole, 0},
                        {"with ambient occlusion", whole | REFLET_EFFECT_AMBIENT_OCCLUSION, whole},
                        {"with depth of field", whole | REFLET_EFFECT_DEPTH_OF_FIELD, whole},
                        {"with lamps, four maps of 1024² texels", whole | REFLET_EFFECT_LAMP_SHADOWS, whole},
                        {"with four probes of 128² texels a face", whole, whole, true},
                        {"all", whole | more, 0, true}};
    std::printf(
        "| MB of device memory | `fast`, 1920x1080 | 3840x2160 | `balanced`, 1920x1080 | 3840x2160 | `quality`, "
        "1920x1080 | 3840x2160 |\n|---|--:|--:|--:|--:|--:|--:|\n");
    for (const Row& row : rows) {
        std::printf("| %s |", row.name);
        for (const char* preset : {"fast", "balanced", "quality"}) {
            for (const uint32_t scale : {1U, 2U}) {
                const uvec2 size = scale * uvec2(1920, 1080);
                const double all =
                    megabytes(context, preset, row.effects, size, gbuffer, row.probes ? &withProbes : nullptr);
                const double base = row.base != 0 ? megabytes(context, preset, row.base, size, gbuffer, nullptr) : 0.0;
                std::printf(" %.0f |", all - base);
            }
        }
        std::printf("\n");
    }
    refletDestroyContext(context);
    return 0;
}
