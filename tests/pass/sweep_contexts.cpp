// Contexts of all settings. Lobes that a setting has nothing to do with are off: compiling their tracers takes most of
// a sweep's time.
#include "pass/sweep_contexts.h"

namespace reflet::test::sweep_test {
namespace {

// Captures of probes take twice as long with a sun's map of full size.
const char* const smallMap = "shadow.resolution=256";

const std::vector<Context>& contexts() {
    static const std::vector<Context> all{
        {"", {}},
        {"materials.mip", {}, "cubes"},
        {"materials.anisotropy", {}, "cubes"},
        {"materials.coats", {}, "glass"},
        {"shadow.", {"diffuse.rays=0", "specular.rays=0"}, "colonnade"},
        {"shadow.rays", {"diffuse.rays=0", "specular.rays=0", "shadow.filter=traced"}},
        {"shadow.constant_bias", {"diffuse.rays=0", "specular.rays=0", "shadow.bias_kind=constant"}},
        {"shadow.radius", {"diffuse.rays=0", "specular.rays=0", "shadow.filter=pcf"}},
        {"shadow.radius_unit", {"diffuse.rays=0", "specular.rays=0", "shadow.filter=pcf"}},
        {"shadow.rings", {"diffuse.rays=0", "specular.rays=0", "shadow.pattern=rings"}, "colonnade"},
        {"shadow.mirrored", {"diffuse.rays=0", "specular.rays=0", "shadow.pattern=rings"}, "colonnade"},
        {"shadow.cascade_", {"diffuse.rays=0", "specular.rays=0", "shadow.cascades=4"}, "colonnade"},
        {"shadow.lamp", {"diffuse.rays=0", "specular.rays=0"}, "cornell"},
        {"shadow.lamps", {"diffuse.rays=0", "specular.rays=0"}, "lamps"},
        {"shadow.denoise",
         {"diffuse.rays=0", "specular.rays=0", "shadow.filter=pcf", "shadow.radius=0.5"},
         "colonnade"},
        {"shadow.history", {"diffuse.rays=0", "specular.rays=0"}, "colonnade", 3},
        {"contact.", {"contact.distance=1", "contact.thickness=0.5"}, "colonnade"},
        {"contact.distance", {}, "colonnade"},
        {"trace_screen.step", {"diffuse.rays=0", "trace_screen.method=linear"}},
        {"trace_screen.min_step", {"diffuse.rays=0", "trace_screen.method=halving", "trace_screen.step=2"}},
        {"trace_screen.stride", {"diffuse.rays=0", "trace_screen.method=dda"}},
        {"trace_screen.first_steps", {"diffuse.rays=0", "trace_screen.count_steps=true"}},
        {"trace_screen.jitter", {"diffuse.rays=0", "trace_screen.method=linear"}},
        {"trace_screen.binary_steps", {"diffuse.rays=0", "trace_screen.method=linear"}},
        {"trace_screen.interpolate", {"diffuse.rays=0", "trace_screen.method=linear"}},
        {"trace_screen.distance_fade", {"diffuse.rays=0", "trace_screen.max_distance=3"}},
        {"trace_screen.", {"diffuse.rays=0"}},
        {"trace_screen.light", {}, "gloss", 2},
        {"trace_scene.", {"trace_scene.enabled=true", "diffuse.rays=1", "specular.rays=0"}},
        {"trace_scene.enabled", {}},
        {"trace_scene.bounces",
         {"trace_scene.enabled=true", "trace_scene.light=path", "diffuse.rays=1", "specular.rays=0"}},
        {"trace_scene.texture_size",
         {"trace_scene.enabled=true", "trace_screen.enabled=false", "diffuse.rays=1", "specular.rays=0"},
         "cubes"},
        {"trace_scene.shadows", {"trace_scene.enabled=true", "diffuse.rays=1", "specular.rays=0"}, "colonnade"},
        {"direct.reflected_suns", {}, "mirror-hall"},
        {"radiance_cache.",
         {"radiance_cache.enabled=true", "trace_scene.enabled=true", "trace_screen.light=previous", "diffuse.rays=1",
          "specular.rays=0"},
         "cornell",
         4},
        {"radiance_cache.enabled",
         {"trace_scene.enabled=true", "trace_screen.light=previous", "diffuse.rays=1", "specular.rays=0"},
         "cornell",
         4},
        {"probes.", {"probes.enabled=true", "probes.resolution=16", smallMap, "probes.count=1"}, "cornell"},
        {"probes.resolution", {"probes.enabled=true", "probes.count=1", "probes.bounces=0", smallMap}, "cornell"},
        {"probes.enabled", {"probes.resolution=16", smallMap}, "cornell"},
        {"probes.reach", {"probes.enabled=true", "probes.resolution=16", smallMap, "probes.count=4"}, "mirror-hall"},
        {"planar.", {"planar.enabled=true"}, "mirror-hall"},
        {"planar.enabled", {}, "mirror-hall"},
        {"planar.before_screen", {"planar.enabled=true", "planar.scale=0.25"}, "mirror-hall"},
        {"planar.margin", {"planar.enabled=true", "planar.max_roughness=1"}, "moving"},
        {"planar.max_roughness", {"planar.enabled=true"}, "moving"},
        {"planar.camera_", {"planar.enabled=true", "planar.form=camera"}, "mirror-hall"},
        {"live.", {"shadow.filter=none", "materials.anisotropy=1"}, "monitor"},
        {"environment.", {}, "mirror-hall"},
        {"dof.", {"dof.max_radius=0.25"}, "wide lens"},
        {"dof.reflections", {}, "wide mirror"},
        {"motion_blur.", {"motion_blur.enabled=true", "motion_blur.max_length=0.3"}, "moving", 2, 1.0F},
        {"ao.", {"ao.method=bitmask"}},
        {"ao.method", {}},
        {"ao.thickness", {"ao.method=bitmask", "ao.radius=10"}, "colonnade"},
        {"diffuse.slice_steps", {"diffuse.method=slices"}},
        {"diffuse.adaptive", {"denoise.enabled=true"}, "cave", 3},
        {"diffuse.reuse", {"diffuse.rays=1"}},
        {"specular.adaptive", {"denoise.enabled=true"}, "gloss", 3},
        {"specular.rough_rays", {"denoise.enabled=true"}, "cave"},
        {"specular.rough_fallback", {"specular.max_roughness=0.2"}},
        {"specular.max_roughness", {"specular.rough_fallback=mips"}},
        {"denoise.", {"denoise.enabled=true"}, "gloss", 3},
        {"denoise.enabled", {}},
        {"denoise.clip", {"denoise.enabled=true"}, "gloss", 4, 0.1F},
        {"denoise.fireflies", {"denoise.enabled=true", "diffuse.rays=1"}, "mirror-hall", 6},
        {"blend.", {}, "panes"},
        {"transmission.", {}, "glass"},
        {"accumulate.", {"accumulate.enabled=true"}, "gloss", 2},
        {"accumulate.enabled", {}, "gloss", 2},
        {"temporal.", {"temporal.enabled=true"}, "gloss", 4},
        {"temporal.enabled", {}, "gloss", 2},
        {"temporal.frames_in_motion", {"temporal.enabled=true"}, "gloss", 4, 0.1F},
        {"temporal.reflections", {"temporal.enabled=true"}, "gloss", 4, 0.1F},
        {"tonemap.adaptation", {"tonemap.auto_exposure=on"}, "gloss", 2, 0.1F},
    };
    return all;
}

}  // namespace

const Context& contextOf(const std::string& setting) {
    const Context* best = &contexts().front();
    for (const Context& context : contexts()) {
        if (setting.starts_with(context.setting) && context.setting.size() > best->setting.size()) {
            best = &context;
        }
    }
    return *best;
}

}  // namespace reflet::test::sweep_test
