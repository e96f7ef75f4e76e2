// Light that a host has itself: RefletProbe, RefletPlanarView, images of light.
#pragma once

#include "api/frame.h"
#include "api/radiance_cache.h"
#include "lighting/host_sources.h"

#include <cstddef>
#include <vector>

namespace reflet::api {

/// The sources as given to a call. Images are valid until their HostImages ends.
struct SourceInputs {
    std::vector<HostProbe> probes;
    std::vector<std::byte> probeKey;  ///< what the maps of the probes depend on
    gpu::Image specular;              ///< RefletIndirectLight::specularFallback
    gpu::Image irradiance;
    float irradianceScale = 1.0F;
    std::vector<lighting::HostPlanarView> planar;
    bool planarAfterScreen = false;
    std::shared_ptr<RefletRadianceCache_T> cache;  ///< may be none

    [[nodiscard]] bool any() const { return !probes.empty() || specular || irradiance || !planar.empty(); }
};

/// Throws Failure for invalid or contradictory inputs.
SourceInputs sourceInputs(const RefletView_T& view, const Frame& frame, const RefletIndirectLight& light,
                          HostImages& host);

/// The light given to refletPrepare, and a probe of a light, copied to this library's versions of the structs. Throw
/// Failure for wrong counts and sizes.
RefletIndirectLight preparedLight(const RefletPrepareInfo& info);
RefletProbe probeAt(const RefletIndirectLight& light, uint32_t i);

/// The environment in the stages' form; its maps are rebuilt when `revision` changes.
EnvironmentLight environmentLight(RefletView_T& view, const EnvironmentInputs& in);

/// Stores the environment of a lobe, and notes a change that affects histories.
void noteEnvironment(RefletView_T& view, uint32_t lobe, const EnvironmentInputs& in);

/// The host's sources of light for rays of a lobe that miss on the screen.
lighting::HostLight hostLight(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                              const SourceInputs& in);

}  // namespace reflet::api
