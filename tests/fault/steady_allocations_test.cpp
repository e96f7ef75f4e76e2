// A frame like the last one takes next to no memory of the host's.
#include "device/device.h"
#include "fault/allocations.h"
#include "renderer/presets.h"
#include "renderer/renderer.h"
#include "renderer/settings.h"
#include "renderer/shaders.h"
#include "scene/builtin.h"

#include <gtest/gtest.h>

namespace reflet::fault {
namespace {

// Over 5 s: the preset compiles its own shaders.
TEST(SteadyFrame, AllocatesLittle) {
    gpu::DeviceOptions options;
    options.shaders = {effectShaders(), rendererShaders()};
    gpu::Device device(options);
    const Scene scene = findBuiltinScene("cornell")->make();
    const View view = defaultView(scene);
    Settings settings;
    applyPreset(settings, "balanced");
    settings.probes.resolution = 16;  // large ones take most of the time, and twice that with large shadow maps
    settings.shadow.resolution = 256;
    Renderer renderer(device, scene, [](const std::string&) {});
    for (int i = 0; i < 40; ++i) {  // by then its memory has the right size (gpu::Recorder)
        renderer.render(view, {48, 32}, 0, settings);
    }
    // What is left: sources of rays as functions, the key of the probes, lists of lamps that cast shadows.
    constexpr uint64_t few = 32;
    for (int i = 0; i < 4; ++i) {
        const FailingAllocation counting(Allocator::operatorNew, 0, false);
        renderer.render(view, {48, 32}, 0, settings);
        EXPECT_LE(FailingAllocation::count(), few);
    }
}

}  // namespace
}  // namespace reflet::fault
