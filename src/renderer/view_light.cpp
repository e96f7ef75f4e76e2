// Records the light that reflections read.
#include "renderer/view_light.h"

#include "lighting/indirect.h"
#include "renderer/glass/glass_layers.h"

namespace reflet {

BlendedSurfaces lightForReflections(gpu::PassList& f, const ViewInputs& in, const Settings& settings,
                                    const LobeLight& diffuse, TracedView& seen, ScreenReaders readers, bool layers) {
    const bool read = readers == ScreenReaders::others || readsScreenLight(in, settings, seen);
    ScreenImages& screen = seen.screen;
    if (read) {
        screen.light = lighting::lightSoFar(f, contextOf(in, settings), settings, screen, diffuse);
    }
    BlendedSurfaces blended = lightBlended(f, in, settings, seen, layers);
    if (!read || settings.specular.rays == 0) {
        return blended;
    }
    const auto scope = f.scope("specular");
    screen.light = withBlended(f, blended.behindGlass.lit, screen.light);
    screen.light = withBlended(f, blended.front.lit, screen.light);
    lighting::prefilterLight(f, settings, screen);
    return blended;
}

void addGlassForReflections(gpu::PassList& f, const ViewInputs& in, const Settings& settings, TracedView& seen) {
    const bool read = settings.specular.rays > 0 && readsScreenLight(in, settings, seen);
    if (!read || settings.traceScreen.light == HitLight::previous || !showsGlass(in, settings)) {
        return;
    }
    const auto scope = f.scope("specular");
    const gpu::Image light = seen.screen.light;
    seen.screen.light = throughGlass(f, in, settings, seen, LightLayers{light, {}, {}, light}).light.lit;
}

}  // namespace reflet
