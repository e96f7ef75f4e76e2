// Every effect, recorded by a host that is not the program: its own device and command buffers, three frames in flight.
#include "pass/effects_host.h"

#include "capture/texels.h"
#include "pass/host.h"
#include "renderer/shaders.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <memory>
#include <numeric>
#include <set>

namespace reflet::test::effects_host_test {
namespace {

ViewParams viewOf(uint32_t frame) {
    Camera camera;
    camera.position = vec3(0.0F);
    camera.target = vec3(0.0F, 0.0F, -1.0F);
    return makeViewParams(camera, size, frame, 1);
}

void expectLight(const gpu::Recorder& f, gpu::Readback readback, VkFormat format, const char* what) {
    double sum = 0.0;
    for (const vec4& texel : decodeTexels(format, f.bytes(readback))) {
        for (int i = 0; i < 3; ++i) {
            ASSERT_TRUE(std::isfinite(texel[i])) << what;
            ASSERT_GE(texel[i], 0.0F) << what;
            sum += texel[i];
        }
    }
    EXPECT_GT(sum, 0.1 * size.x * size.y) << what;
}

std::set<std::string> passesOf(const gpu::Recorder& f) {
    std::set<std::string> names;
    for (const gpu::PassTime& pass : f.passTimes()) {
        names.insert(pass.name);
    }
    return names;
}

// Of every effect.
constexpr const char* mainPasses[] = {"contact_shadow",
                                      "shadow_visibility",
                                      "shadow_clean.gather",
                                      "lamp_tiles",
                                      "lamp_visibility",
                                      "direct",
                                      "kept_depth",
                                      "pyramid.1",
                                      "light_mips.1",
                                      "dof.gather",
                                      "motion_blur.gather",
                                      "ao.slices_at_once",
                                      "ao.finish_ao",
                                      "diffuse.trace_at_once",
                                      "diffuse.denoise_gather",
                                      "settle_cache",
                                      "diffuse.feed_cache",
                                      "diffuse.remembered_light",
                                      "specular.share_rays",
                                      "specular.trace_screen",
                                      "composite",
                                      "accumulate",
                                      "temporal",
                                      "exposure.meter",
                                      "exposure.factor",
                                      "tonemap",
                                      "record_ray",
                                      "import.surfaces",
                                      "import.light",
                                      "shadow.import_lamp",
                                      "probe.import_probe",
                                      "specular.answer_probes",
                                      "specular.answer_image",
                                      "specular.trace_mirror"};

TEST(EffectsHost, RecordsEveryEffectBetweenItsOwnCommands) {
    Host host;
    {
        gpu::Context context(host.device());
        context.shaders().add(effectShaders());
        gpu::Recorder recorder(context, Host::framesInFlight);
        HostCamera camera(context);
        Results results;
        gpu::ObjectCounts made;
        for (uint32_t frame = 0; frame < 14; ++frame) {
            host.frame([&](VkCommandBuffer commands) {
                recorder.begin(commands);
                if (frame == 0) {
                    camera.makeInputs(recorder, viewOf(frame), false);
                }
                results = camera.record(recorder, viewOf(frame));
                recorder.end();
            });
            // The first frame of every slot makes what is its own, with either of the two images of each history.
            if (frame == 8) {
                made = context.counts();
            }
        }
        EXPECT_TRUE(made == context.counts())
            << "frames 9 to 13 made something: images " << made.images << ", " << context.counts().images
            << "; buffers " << made.buffers << ", " << context.counts().buffers << "; memory " << made.memoryBlocks
            << ", " << context.counts().memoryBlocks << "; pipelines " << made.pipelines << ", "
            << context.counts().pipelines << "; pools " << made.descriptorPools << ", "
            << context.counts().descriptorPools;
        host.waitForAll();
        recorder.finish();
        expectLight(recorder, results.lit, colorFormat, "lit");
        expectLight(recorder, results.accumulated, VK_FORMAT_R32G32B32A32_SFLOAT, "mean of frames");
        expectLight(recorder, results.temporal, colorFormat, "temporal antialiasing");
        expectLight(recorder, results.upscaled, colorFormat, "temporal upscaling");
        expectLight(recorder, results.display, VK_FORMAT_R8G8B8A8_UNORM, "display");
        const std::set<std::string> passes = passesOf(recorder);
        for (const char* pass : mainPasses) {
            EXPECT_TRUE(passes.contains(pass)) << pass;
        }
    }
    for (const std::string& message : host.messages()) {
        ADD_FAILURE() << message;
    }
}

// Ten rays are two batches at once, and three of lists.
TEST(EffectsHost, TracingAtOnceGivesTheLightOfLists) {
    Host host;
    {
        gpu::Context context(host.device());
        context.shaders().add(effectShaders());
        gpu::Recorder recorder(context, Host::framesInFlight);
        HostCamera camera(context);
        std::array<std::array<LobeReadbacks, 2>, 2> read;
        host.frame([&](VkCommandBuffer commands) {
            recorder.begin(commands);
            camera.makeInputs(recorder, viewOf(0), false);
            camera.record(recorder, viewOf(0));
            for (const uint32_t lobe : {lobeDiffuse, lobeSpecular}) {
                read[lobe] = camera.traceBothWays(recorder, viewOf(0), lobe);
            }
            recorder.end();
        });
        host.waitForAll();
        recorder.finish();
        const std::set<std::string> passes = passesOf(recorder);
        EXPECT_TRUE(passes.contains("diffuse.trace_at_once") && passes.contains("specular.trace_at_once"));
        EXPECT_TRUE(passes.contains("diffuse.resolve_rays") && passes.contains("specular.resolve_rays"));
        for (const auto& [atOnce, byLists] : read) {
            const auto texels = [&](gpu::Readback r, VkFormat format) {
                return decodeTexels(format, recorder.bytes(r));
            };
            const std::vector<vec4> a = texels(atOnce.radiance, colorFormat);
            const std::vector<vec4> b = texels(byLists.radiance, colorFormat);
            const std::vector<vec4> sourceA = texels(atOnce.source, colorFormat);
            const std::vector<vec4> sourceB = texels(byLists.source, colorFormat);
            const std::vector<vec4> stepsA = texels(atOnce.steps, VK_FORMAT_R32_SFLOAT);
            const std::vector<vec4> stepsB = texels(byLists.steps, VK_FORMAT_R32_SFLOAT);
            size_t hits = 0;
            size_t unlike = 0;
            for (size_t i = 0; i < a.size(); ++i) {
                hits += sourceA[i].a > 0.05F ? 1 : 0;
                const bool same =
                    glm::all(glm::lessThan(glm::abs(a[i] - b[i]), 0.01F * glm::max(a[i], b[i]) + 1e-3F)) &&
                    glm::all(glm::lessThan(glm::abs(sourceA[i] - sourceB[i]), vec4(0.01F))) &&
                    std::abs(stepsA[i].r - stepsB[i].r) <= 0.5F;
                unlike += same ? 0 : 1;
            }
            EXPECT_GT(hits, a.size() / 80) << "too few hits to compare";
            // A direction in 32 bits may miss what the exact one hits.
            EXPECT_LE(unlike, a.size() / 50);
        }
    }
    for (const std::string& message : host.messages()) {
        ADD_FAILURE() << message;
    }
}

TEST(EffectsHost, StaysFiniteWhateverTheInputsHold) {
    Host host;
    {
        gpu::Context context(host.device());
        context.shaders().add(effectShaders());
        gpu::Recorder recorder(context, Host::framesInFlight);
        HostCamera camera(context);
        Results results;
        for (uint32_t frame = 0; frame < 4; ++frame) {
            host.frame([&](VkCommandBuffer commands) {
                recorder.begin(commands);
                if (frame == 0) {
                    camera.makeInputs(recorder, viewOf(frame), true);
                }
                results = camera.record(recorder, viewOf(frame));
                recorder.end();
            });
        }
        host.waitForAll();
        recorder.finish();
        expectLight(recorder, results.lit, colorFormat, "lit");
        expectLight(recorder, results.accumulated, VK_FORMAT_R32G32B32A32_SFLOAT, "mean of frames");
        expectLight(recorder, results.temporal, colorFormat, "temporal antialiasing");
        expectLight(recorder, results.upscaled, colorFormat, "temporal upscaling");
        expectLight(recorder, results.display, VK_FORMAT_R8G8B8A8_UNORM, "display");
    }
    EXPECT_TRUE(host.messages().empty()) << host.messages().front();
}

// Stands between a context and the device, and adds up what it allocates.
struct DeviceMemory {
    static inline PFN_vkAllocateMemory allocate = nullptr;
    static inline PFN_vkFreeMemory release = nullptr;
    static inline std::map<VkDeviceMemory, VkDeviceSize> live;

    static VKAPI_ATTR VkResult VKAPI_CALL noteAllocate(VkDevice device, const VkMemoryAllocateInfo* info,
                                                       const VkAllocationCallbacks* host, VkDeviceMemory* memory) {
        const VkResult result = allocate(device, info, host, memory);
        live[*memory] = info->allocationSize;
        return result;
    }
    static VKAPI_ATTR void VKAPI_CALL noteFree(VkDevice device, VkDeviceMemory memory,
                                               const VkAllocationCallbacks* host) {
        live.erase(memory);
        release(device, memory, host);
    }
    static void listen(gpu::Context& context) {
        live.clear();
        allocate = std::exchange(context.vk.vkAllocateMemory, noteAllocate);
        release = std::exchange(context.vk.vkFreeMemory, noteFree);
    }
    static VkDeviceSize bytes() {
        return std::accumulate(live.begin(), live.end(), VkDeviceSize(0),
                               [](VkDeviceSize sum, const auto& block) { return sum + block.second; });
    }
};

TEST(EffectsHost, TellsTheMemoryThatItAllocates) {
    Host host;
    {
        gpu::Context context(host.device());
        DeviceMemory::listen(context);
        context.shaders().add(effectShaders());
        gpu::Recorder recorder(context, Host::framesInFlight);
        HostCamera camera(context);
        for (uint32_t frame = 0; frame < 4; ++frame) {
            host.frame([&](VkCommandBuffer commands) {
                recorder.begin(commands);
                if (frame == 0) {
                    camera.makeInputs(recorder, viewOf(frame), false);
                }
                camera.record(recorder, viewOf(frame));
                recorder.end();
            });
            EXPECT_EQ(context.memory().reserved(), DeviceMemory::bytes());
            EXPECT_GT(context.memory().used(gpu::MemoryUse::device), 0U);
        }
        EXPECT_LE(context.memory().used(gpu::MemoryUse::device), DeviceMemory::bytes());
        EXPECT_EQ(context.counts().memoryBlocks, DeviceMemory::live.size()) << "none was freed";
        host.waitForAll();
        recorder.finish();
    }
    EXPECT_EQ(DeviceMemory::bytes(), 0U) << "left behind";
}

// A new effect is to be recorded above, too.
TEST(EffectsHost, KnowsEveryEffect) {
    const std::set<std::string> recorded{"accumulate",
                                         "ambient_occlusion",
                                         "composite",
                                         "contact",
                                         "cube_map",
                                         "denoise",
                                         "depth_of_field",
                                         "direct",
                                         "environment",
                                         "exposure",
                                         "gbuffer",
                                         "light_mips",
                                         "lobe",
                                         "motion_blur",
                                         "planar",
                                         "import",
                                         "probe",
                                         "pyramid",
                                         "radiance_cache",
                                         "rescale",
                                         "reflected_images",
                                         "shadow",
                                         "temporal",
                                         "tonemap"};
    for (const auto& entry : std::filesystem::directory_iterator(REFLET_EFFECTS)) {
        if (entry.is_directory()) {
            EXPECT_TRUE(recorded.contains(entry.path().filename().string())) << entry.path();
        }
    }
}

}  // namespace
}  // namespace reflet::test::effects_host_test
