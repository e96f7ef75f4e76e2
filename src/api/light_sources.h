// Light that a host has itself: RefletProbe, RefletPlanarView, images of light.
#pragma once

#include "api/frame.h"
#include "api/radiance_cache.h"
#include "lighting/host_sources.h"

#include <cstddef>
#include <vector>

namespace reflet::api {

/// As a call was given it. Images are there until their HostImages ends.
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

/// Throws Failure for what cannot be meant.
SourceInputs sourceInputs(const RefletView_T& view, const Frame& frame, const RefletIndirectLight& light,
                          HostImages& host);

/// The light that refletPrepare is told of, and a probe of a light, as this library knows the structs. Throw Failure
/// for wrong counts and sizes.
RefletIndirectLight preparedLight(const RefletPrepareInfo& info);
RefletProbe probeAt(const RefletIndirectLight& light, uint32_t i);

/// The environment as the stages take it; its maps are made anew when the host says that it has changed.
EnvironmentLight environmentLight(RefletView_T& view, const EnvironmentInputs& in);

/// Remembers the environment of a lobe, and what a change of it means for histories.
void noteEnvironment(RefletView_T& view, uint32_t lobe, const EnvironmentInputs& in);

/// What the host has for rays of a lobe that the screen does not answer.
lighting::HostLight hostLight(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                              const SourceInputs& in);

}  // namespace reflet::api
