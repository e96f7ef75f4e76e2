// Prints docs/library.md's table of memory: what each effect adds to a view with an output of 1920x1080
// and 3840x2160. `fast` and `balanced` have frames of half of that to each side (temporal upscaling).
#include "library/library_host.h"

#include <cstdio>
#include <string_view>

using namespace reflet::test;

namespace {

double megabytes(RefletContext context, const char* preset, uint32_t effects, uint32_t width, uint32_t height,
                 const RefletGBuffer& gbuffer) {
    const uint32_t share = std::string_view(preset) == "quality" ? 1 : 2;
    const RefletViewInfo info{sizeof info, width / share, height / share, 1, 0, 0};
    RefletView view = nullptr;
    RefletSettings settings = nullptr;
    refletCreateView(context, &info, &view);
    refletSetOutputSize(view, width, height);
    refletCreateSettings(preset, &settings);
    RefletPrepareInfo prepare{};
    prepare.structSize = sizeof prepare;
    prepare.effects = effects;
    prepare.gbuffer = &gbuffer;
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
    struct Row {
        const char* name;
        uint32_t effects;
    };
    constexpr uint32_t composite = REFLET_EFFECT_COMPOSITE;
    const Row rows[] = {{"import of the G-buffer, tables", REFLET_EFFECT_TONE_MAP},
                        {"sun shadow, a map of 2048² texels", REFLET_EFFECT_SUN_SHADOW},
                        {"diffuse GI", REFLET_EFFECT_DIFFUSE_GI},
                        {"reflections", REFLET_EFFECT_REFLECTIONS},
                        {"composite", composite},
                        {"temporal antialiasing", REFLET_EFFECT_TEMPORAL},
                        {"all", REFLET_EFFECT_SUN_SHADOW | REFLET_EFFECT_DIFFUSE_GI | REFLET_EFFECT_REFLECTIONS |
                                    composite | REFLET_EFFECT_TEMPORAL | REFLET_EFFECT_TONE_MAP}};
    std::printf(
        "| MB of device memory | `fast`, 1920x1080 | 3840x2160 | `balanced`, 1920x1080 | 3840x2160 | `quality`, "
        "1920x1080 | 3840x2160 |\n|---|--:|--:|--:|--:|--:|--:|\n");
    for (const Row& row : rows) {
        std::printf("| %s |", row.name);
        for (const char* preset : {"fast", "balanced", "quality"}) {
            for (const uint32_t scale : {1U, 2U}) {
                const double all = megabytes(context, preset, row.effects, 1920 * scale, 1080 * scale, gbuffer);
                const bool own = &row > &rows[0] && row.effects != rows[6].effects;
                const double base =
                    own ? megabytes(context, preset, REFLET_EFFECT_TONE_MAP, 1920 * scale, 1080 * scale, gbuffer) : 0.0;
                std::printf(" %.0f |", all - base);
            }
        }
        std::printf("\n");
    }
    refletDestroyContext(context);
    return 0;
}
