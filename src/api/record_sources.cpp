// Records what rays find beyond the screen: the environment, and light of the host's own.
#include "api/light_sources.h"

namespace reflet::api {

namespace {

// Whether one is at least four times the other.
bool isStep(const vec3& a, const vec3& b) {
    constexpr float step = 4.0F;
    return glm::any(glm::greaterThan(a, step * b)) || glm::any(glm::greaterThan(b, step * a));
}

// The host's probes as maps, which stay until it says that they have changed.
ProbeMaps probeMaps(RefletView_T& view, const SourceInputs& in) {
    gpu::PassList& f = view.recorder;
    ProbeImages& own = view.store->probes;
    const bool write = own.key != in.probeKey || f.isDiscarded(own.list);
    if (write) {
        own.key.clear();  // making the maps may fail
    }
    const ProbeMaps maps = lighting::importProbes(f, own.maps, in.probes, write);
    if (write) {
        own.key = in.probeKey;
        own.list = f.listNumber();
        f.promise();
    }
    return maps;
}

}  // namespace

EnvironmentLight environmentLight(RefletView_T& view, const EnvironmentInputs& in) {
    gpu::PassList& f = view.recorder;
    EnvironmentImages& own = view.store->environment;
    const bool changed = own.generation != f.generation() || own.revision != in.revision || own.from != in.from;
    if (changed || f.isDiscarded(own.list)) {
        const gpu::Image texels =
            own.texels.storage(f, VK_FORMAT_R16G16B16A16_SFLOAT, in.image ? in.image.size : uvec2(1));
        if (in.image) {
            const auto scope = f.scope("environment");
            lighting::importLight(f, in.image, {.into = texels});
        } else {  // the factor is its radiance
            f.clear(texels, {{1.0F, 1.0F, 1.0F, 1.0F}});
        }
        lighting::prefilterEnvironment(f, own.cube, texels, in.image ? in.image.size.x : 0);
        own.generation = f.generation();
        own.revision = in.revision;
        own.from = in.from;
        own.list = f.listNumber();
        f.promise();
    }
    return {own.texels.last(), own.cube.lobes.image(), own.cube.irradiance.image(), in.params};
}

// An environment that changes ends what the host calls rest, from the next frame on: means must forget the last one.
// After a step of its factor the lobe's history starts anew, and rays do not read the last picture.
void noteEnvironment(RefletView_T& view, uint32_t lobe, const EnvironmentInputs& in) {
    ViewStore& own = *view.store;
    const KnownEnvironment now{in.from, in.revision, in.params.factor, in.params.turn};
    std::optional<KnownEnvironment>& known = own.environments[lobe];
    if (known && *known != now) {
        own.environmentRests = 0;
        if (isStep(known->factor, now.factor)) {
            own.of(lobe) = LobeStore();  // GCC 12 makes of `(a ? b : c) = {}` what no constructor has made
            view.composedLast = false;
        }
    }
    known = now;
}

// What the host has for rays of a lobe that the screen does not answer.
lighting::HostLight hostLight(RefletView_T& view, Frame& frame, const Settings& settings, uint32_t lobe,
                              const SourceInputs& in) {
    gpu::PassList& f = view.recorder;
    lighting::HostLight light;
    light.probes = in.probes.empty() ? ProbeMaps{} : probeMaps(view, in);
    for (ProbeParams& probe : light.probes.block.probes) {
        probe.radianceScale *= frame.preExposure;  // the maps outlive the frame, so the host gives them without it
    }
    light.mirrorsFirst = !in.planarAfterScreen;
    const bool diffuse = lobe == lobeDiffuse;
    const auto scope = f.scope(diffuse ? "diffuse" : "specular");
    if (const gpu::Image given = diffuse ? in.irradiance : in.specular) {
        light.image = {lighting::importLight(f, given, {.maxRadiance = settings.input.maxRadiance, .keepAlpha = true}),
                       diffuse ? in.irradianceScale : 1.0F};
    }
    for (const lighting::HostPlanarView& planar : in.planar) {
        if (!diffuse) {
            light.mirrors.push_back(lighting::importPlanarView(f, settings, planar, settings.input.maxRadiance));
        }
    }
    frame.probes = static_cast<uint32_t>(in.probes.size());
    frame.planarViews = static_cast<uint32_t>(in.planar.size());
    frame.hasFallback = frame.hasFallback || light.image.light;
    return light;
}

}  // namespace reflet::api
