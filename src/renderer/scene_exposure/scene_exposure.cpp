// Decides about automatic exposure.
#include "renderer/scene_exposure/scene_exposure.h"

#include "effects/exposure/exposure.h"
#include "lighting/settings.h"
#include "scene/scene.h"

namespace reflet {

bool exposesAutomatically(const TonemapSettings& settings, const Scene& scene) {
    return settings.autoExposure == AutoExposure::on ||
           (settings.autoExposure == AutoExposure::files && scene.fromFile && !isUnlit(scene));
}

TonemapSettings exposedAs(const TonemapSettings& settings, const Scene& scene, const FloatImage& radiance,
                          const FloatImage& depth) {
    TonemapSettings exposed = settings;
    exposed.autoExposure = AutoExposure::off;
    if (exposesAutomatically(settings, scene)) {
        exposed.exposure += meteredExposure(radiance, depth);
    }
    return exposed;
}

}  // namespace reflet
